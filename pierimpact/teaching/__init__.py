"""The explorers and exercises of the teaching notebooks.

`scenario` and `explorer_data` compute, `animation` turns a collision into frames, `readouts` puts
it in numbers and sentences, `live` redraws figures, `explorer` joins them to the controls.
A `lesson` is a prediction and `questions`, with `numbers` of the student's own; `reading` and
`checker` judge the answers, `work` keeps them, `predictions` and `exercises` are their widgets.
`marks` collects the files of a class, `teacher` prints the answers. `tables` and `maps` show
studies, `markup` is the HTML of all of them. `page` writes the explorer that needs no Python.
"""
