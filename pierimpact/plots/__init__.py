"""Figures, drawn with matplotlib from results that are already computed.

`style` is under all of them; `words`, `labels`, `dimension`, `ends` and `bars` under those for
pages. One subject a file: `collision` (forces and energy in time), `spectrum`, `amplification`,
`shape`, `comparison`, `influence` and `schematic` draw on axes and know nothing of notebooks;
`elevation` and `section` draw what `situation` shows; `situation`, `crush`, `history`, `spectra`,
`envelopes`, `code_bars`, `tornado`, `figures`, `band`, `evidence`, `static_forces`, `methods` and
`validation` make whole figures for pages.
"""
