"""The map of static member forces: where they stand for those of the column as a beam."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from pierimpact.design.static_forces import AS_LARGE
from pierimpact.design.static_study import ENDS, FORCES, Columns, Found, column_kinds
from pierimpact.pier.static_forces import LOWEST_FREQUENCY, TOO_LOW, TOP
from pierimpact.plots import style
from pierimpact.plots.style import INK, PIXEL

_COLOURS = (style.BLUE, style.GREEN, style.PURPLE, style.VERMILION, style.SKY, style.ORANGE)
_ENDS = {f"{base}–{top}": colour for (base, top), colour in zip(ENDS, _COLOURS, strict=True)}
_DOT: Any = {"linestyle": "none", "marker": "o", "markersize": 2.4, "markeredgewidth": 0.0}
_LABEL: Any = {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.6}
_TOO_LOW = "#fbe3d6"
_SPAN = (0.15, 2.2)  # of the ratios


class Quantity(NamedTuple):
    """What the ratios are drawn over, and from where on the static forces hold by a rule."""

    name: str  #: field of `Found`
    heading: str
    span: tuple[float, float]
    ticks: tuple[float, ...]
    limit: float


_QUANTITIES = (
    Quantity(
        "frequency",
        "Frequency of the pier $f_\\mathrm{p}$ [Hz]",
        (1.0, 700.0),
        (1, 2, 5, 10, 20, 50, 100, 200, 500),
        LOWEST_FREQUENCY,
    ),
    Quantity(
        "reaction",
        "Reaction over largest contact force [-]",
        (0.08, 2.2),
        (0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2),
        AS_LARGE,
    ),
)


def map_figure(columns: Columns, marked: Mapping[str, Found]) -> Figure:
    """Return the map: static over beam's shear and moment, against frequency and reaction.

    Parameters
    ----------
    columns : mapping of str to ndarray, shape (n,)
        What the study found.
    marked : mapping of str to Found
        Columns to mark, by name.
    """
    with rc_context(style.SCREEN):
        figure = Figure(figsize=(9.6, 7.4), dpi=144.0)
        panels: Any = figure.subplots(2, 2, sharex="row", sharey=True)
        figure.subplots_adjust(
            left=0.065, right=0.99, bottom=0.1, top=0.965, wspace=0.05, hspace=0.25
        )
        for row, quantity in zip(panels, _QUANTITIES, strict=True):
            for axes, force in zip(row, FORCES, strict=True):
                _draw(axes, columns, marked, quantity, force)
            row[0].set_ylabel("Static force over that of the beam [-]")
        for axes, force in zip(panels[0], FORCES, strict=True):
            axes.set_title(f"Largest {force}")
        dots = [Line2D([], [], color=colour, **_DOT) for colour in _ENDS.values()]
        figure.legend(dots, list(_ENDS), loc="lower center", ncols=6, markerscale=2.5)
        return figure


def _draw(
    axes: Axes, columns: Columns, marked: Mapping[str, Found], quantity: Quantity, force: str
) -> None:
    values, ratios = columns[quantity.name], columns[force]
    axes.axhspan(_SPAN[0], TOO_LOW, color=_TOO_LOW, zorder=0.4)
    axes.axhline(1.0, color=INK, linewidth=PIXEL)
    axes.axvline(quantity.limit, color=INK, linewidth=1.4 * PIXEL, dashes=(4, 2.5))
    for number, colour in reversed(list(enumerate(_COLOURS))):
        here = columns["ends"] == number
        axes.plot(values[here], ratios[here], color=colour, rasterized=True, alpha=0.7, **_DOT)
    others = np.array(column_kinds(columns)) != TOP
    slow = values < quantity.limit
    for side, place, alignment in ((slow, 0.02, "left"), (~slow, 0.98, "right")):
        share = np.mean(ratios[others & side] < TOO_LOW)
        words, corner = f"{share:.0%} too low", (place, 0.03)
        axes.text(*corner, words, transform=axes.transAxes, ha=alignment, weight="bold")
    for name, found in marked.items():
        x, y = getattr(found, quantity.name), getattr(found, force)
        axes.plot([x], [y], "D", color=INK, markerfacecolor="white", markersize=5.0, zorder=7)
        style.note(axes, name, (x, y), (-3.5, 6.0), weight="bold", zorder=6, bbox=_LABEL)
    axes.set(xlabel=quantity.heading, xlim=quantity.span, yscale="log", ylim=_SPAN)
    style.logarithmic(axes, quantity.ticks)
    axes.set_yticks((0.2, 0.3, 0.5, 0.7, 1, 1.5, 2), ("0.2", "0.3", "0.5", "0.7", "1", "1.5", "2"))
    axes.minorticks_off()
