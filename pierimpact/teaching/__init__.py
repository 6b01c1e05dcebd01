"""What stands behind the explorers and the exercises of the teaching notebooks.

`scenario` and `theory` compute, `animation` turns a collision into frames, `readouts` says it in
numbers and sentences, `live` redraws figures, `explorer` joins them to sliders. `checker` and
`questions` are the exercises.
"""
