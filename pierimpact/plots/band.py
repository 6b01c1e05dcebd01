"""The band of a reaction, and which parameter moves it most."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pierimpact.design.band import REACTIONS, ReactionBand
from pierimpact.plots.style import BLUE, GREY, ORANGE, PALE, SKY, key, name_rows, note, sheet_figure
from pierimpact.plots.svg import size_of, to_svg
from pierimpact.symbols import BY_KEY
from pierimpact.units import unit_of, unit_size

_ROW = 0.2  # height of a row [in]
_TOP, _GAP, _BOTTOM = 0.25, 0.5, 0.45  # above the rows, between the panels and below them [in]
# Over the width of the figure: where the panels end at most, and the columns beside them.
_PANELS, _COLUMNS = 0.79, (0.92, 0.994)
_APART = 9.0  # between a panel and the column of spreads [pt]
_BESIDE: Any = {"xycoords": ("figure fraction", "data")}


def draw_band(band: ReactionBand, system: str) -> str:
    """Draw the band of each peak, and the governing reaction with one parameter changed; SVG.

    Parameters
    ----------
    band : ReactionBand
        The band.
    system : {"SI", "US"}
        Units to print in.
    """
    rows = len(REACTIONS), max(len(band.spread), 1)
    height = _TOP + _GAP + _BOTTOM + _ROW * sum(rows)
    margins = {"left": 0.405, "top": 1.0 - _TOP / height, "bottom": _BOTTOM / height}
    gap = _GAP / (0.5 * _ROW * sum(rows))  # over the mean height of a panel
    with sheet_figure(height, **margins, hspace=gap) as figure:
        figure.subplots_adjust(right=_end_of_panels(figure, band))
        strips, tornado = figure.subplots(2, 1, sharex=True, height_ratios=rows)
        size = unit_size("force", system)
        for axes in (strips, tornado):
            axes.axvline(band.nominal / size, color="black", linewidth=0.8)
            axes.tick_params(axis="y", length=0.0)
        _draw_strips(strips, band, size)
        _draw_tornado(tornado, band, size)
        tornado.set_xlabel(f"Reaction [{unit_of('force', system)}]")
        tornado.set_xlim(left=0.0)
        return to_svg(figure)


def _end_of_panels(figure: Figure, band: ReactionBand) -> float:
    """Return where the panels end, so that the widest spread finds room beside them."""
    widest = 0.0
    for spread in band.spread.values():
        text = figure.text(0.0, 0.0, spread.words)
        widest = max(widest, size_of(text)[0])
        text.remove()
    return min(_PANELS, _COLUMNS[0] - (widest + _APART) / (72.0 * figure.get_figwidth()))


def _draw_strips(axes: Axes, band: ReactionBand, size: float) -> None:
    _name(axes, [f"{name.capitalize()} reaction" for name in REACTIONS])
    for row, name in enumerate(REACTIONS):
        low, middle, high = band.quantiles(of=name) / size
        if np.isnan(middle):
            note(axes, "no contact", (0.0, row), (4.0, 0.0), va="center")
            continue
        colour = BLUE if name == "governing" else GREY
        axes.barh(row, high - low, left=low, height=0.6, color=colour, alpha=0.45)
        axes.plot([middle, middle], [row - 0.3, row + 0.3], color=colour, linewidth=2.0)
    if 0.0 < band.cargo_contact < 1.0:
        words = f"in {100.0 * band.cargo_contact:.0f} % of collisions"
        place: Any = {"xycoords": ("axes fraction", "data"), "va": "center"}
        note(axes, words, (1.03, REACTIONS.index("cargo")), (0.0, 0.0), **place)
    axes.set_title("From 5 to 95 %, with median; black: parameters at their values")


def _draw_tornado(axes: Axes, band: ReactionBand, size: float) -> None:
    _name(axes, [f"{BY_KEY[name].heading} ${BY_KEY[name].latex}$" for name in band.spread])
    if not band.spread:
        words = "All parameters are known exactly."
        axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", va="center")
        return
    nominal = band.nominal / size
    for row, (name, ends) in enumerate(band.tornado.items()):
        share = f"{100.0 * band.influence[name]:.0f} %"
        moves = np.divide(ends, size) - nominal
        # Where both go the same way, the shorter is in front.
        for move, colour in sorted(
            zip(moves, (SKY, ORANGE), strict=True), key=lambda m: -abs(m[0])
        ):
            axes.barh(row, move, left=nominal, height=0.7, color=colour)
        for words, x in zip((band.spread[name].words, share), _COLUMNS, strict=True):
            note(axes, words, (x, row), (0.0, 0.0), va="center", ha="right", **_BESIDE)
    for words, x in zip(("Spread", "Share of\nvariance"), _COLUMNS, strict=True):
        note(axes, words, (x, -0.6), (0.0, 3.0), va="bottom", ha="right", **_BESIDE)
    key(
        axes,
        {"parameter at its low end": SKY, "high end": ORANGE},
        handlelength=0.8,
        handleheight=0.8,
    )


def _name(axes: Axes, names: Sequence[str]) -> None:
    """Name the rows, with the look of the sheet."""
    name_rows(axes, names)
    axes.tick_params(axis="y", labelsize=8.5, labelcolor="black")
    axes.grid(axis="x", color=PALE, linewidth=0.6)
    axes.set_axisbelow(True)
