"""Figures, drawn with matplotlib from results that are already computed.

`style` is under all of them, `dimension` under drawings to scale. One subject a file:
`collision` (forces and energy in time), `spectrum`, `amplification`, `shape`, `comparison`,
`influence` and `schematic` draw on axes and know nothing of notebooks; `elevation`, `section`,
`figures`, `band`, `evidence`, `static_forces`, `methods` and `validation` make whole figures for
pages.
"""
