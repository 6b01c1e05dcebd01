"""The design procedure by closed formulas, from truck, pier and speed to the design reaction.

`formulas` are the equations; `procedure` puts them in order, with `engine_equations`,
`cargo_equations` and their common `terms` beside it for print, gathered in `equations`; `domain`
says what they were checked for; `reaction` is what callers use.
"""
