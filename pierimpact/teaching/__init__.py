"""The explorers and exercises of the teaching notebooks.

What an explorer calculates and draws is JavaScript, which `browser` takes from `templates/page` and
`javascript` from the design procedure: `page` makes one file of it, `explorer` a widget, whose
values are a `scenario`.
A `lesson` is a prediction and `questions`, with `numbers` of the student's own; `reading` and
`checker` judge the answers, `work` keeps them, `predictions` and `exercises` are their widgets.
`marks` collects the files of a class, `teacher` prints the answers. `tables` and `maps` show
studies, `markup` is the HTML of all of them.
"""
