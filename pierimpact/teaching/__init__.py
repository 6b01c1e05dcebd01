"""The explorers and exercises of the teaching notebooks.

What is drawn is JavaScript, which `browser` takes from `templates/page`: `page` makes one file of
it, `explorer` a widget. `scenario` and `explorer_data` compute what needs Python, `charts` and
`readouts` put it in pictures, numbers and sentences.
A `lesson` is a prediction and `questions`, with `numbers` of the student's own; `reading` and
`checker` judge the answers, `work` keeps them, `predictions` and `exercises` are their widgets.
`marks` collects the files of a class, `teacher` prints the answers. `tables` and `maps` show
studies, `markup` is the HTML of all of them.
"""
