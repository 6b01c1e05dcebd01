"""The explorers and exercises of the teaching notebooks.

`scenario` and `explorer_data` compute, `animation` turns a collision into frames, `readouts` puts
it in numbers and sentences, `live` redraws figures, `explorer` joins them to the controls.
`checker` and `questions` are the exercises, `tables` and `maps` show studies, `markup` is the
HTML of all of them. `page` writes the explorer that needs no Python.
"""
