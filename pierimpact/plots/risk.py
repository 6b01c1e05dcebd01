"""Figures of the risk from traffic: how often a reaction is exceeded, and by which trucks."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from pierimpact.plots.style import BLUE, GREY, ORANGE, VERMILION, sheet_figure
from pierimpact.plots.svg import to_svg
from pierimpact.risk.analysis import Risk
from pierimpact.risk.exceedance import Exceedance
from pierimpact.risk.traffic import YEAR
from pierimpact.units import unit_of, unit_size

Array = NDArray[np.float64]

#: The curves: the full model, and the formula of JCSS.
CURVES = {"full model, 95 % band": BLUE, "v √(k m) of JCSS": ORANGE}
_POINTS = 300  # of a curve
DARK = "#5a5a5a"  # grey of words
_LOWEST = 1e-7  # frequency shown [1/year]
_CELLS = (48, 40)  # of the map, over mass and over speed
_BESIDE = 0.045  # between two names, of the axis
_SMOOTH = 1.4  # standard deviation by which the map is smoothed [cells]


def reactions(risk: Risk, count: int = _POINTS) -> Array:
    """Return reactions at which the curve is drawn and written, shape (count,) [N]."""
    most = float(risk.reaction.value(_LOWEST / YEAR).value)
    top = most or float(np.max(risk.strikes.reaction, initial=1e6))
    return np.linspace(0.0, top, count + 1)[1:]


def draw_exceedance(
    risk: Risk, marks: Mapping[str, float], levels: Mapping[str, float], system: str
) -> str:
    """Draw how often a reaction is exceeded, and in what share of all hits; return SVG.

    Parameters
    ----------
    risk : Risk
        The risk.
    marks : mapping of str to float
        Reactions to mark, by their names [N].
    levels : mapping of str to float
        Frequencies to mark, by their names [1/year].
    system : {"SI", "US"}
        Units to print in.
    """
    size, x = unit_size("force", system), reactions(risk)
    margins = {"left": 0.09, "right": 0.985, "top": 0.86, "bottom": 0.15, "wspace": 0.26}
    with sheet_figure(3.3, **margins) as figure:
        often, share = figure.subplots(1, 2, width_ratios=(1.5, 1.0))
        for exceedance, colour in zip(
            (risk.reaction, risk.hard_impact), CURVES.values(), strict=True
        ):
            _curve(often, exceedance, x / size, x, colour)
            total = float(exceedance.total.value) or 1.0
            share.plot(x / size, 100.0 * exceedance.rate(x).value / total, color=colour)
        often.set_yscale("log")
        highest = 3.0 * YEAR * float(risk.reaction.total.high) or 1.0
        often.set_ylim(_LOWEST, max(highest, 3e-3))
        often.set(ylabel="Times a year that it is exceeded", title="How often")
        share.set(ylabel="Share of all hits [%]", ylim=(0.0, 103.0), title="Given a hit: fragility")
        for axes in (often, share):
            axes.set_xlim(0.0, x[-1] / size)
            axes.set_xlabel(f"Reaction [{unit_of('force', system)}]")
            for value in marks.values():
                if value < x[-1]:
                    axes.axvline(value / size, color=VERMILION, linewidth=0.8, dashes=(4, 2))
        for name, level in levels.items():
            often.axhline(level, color=GREY, linewidth=0.7)
            often.text(
                0.99, level, name, ha="right", va="bottom", fontsize=7.5,
                transform=often.get_yaxis_transform(),
            )  # fmt: skip
        _name_marks(often, {name: value / size for name, value in marks.items()})
        figure.legend(
            [*often.lines[:2]], list(CURVES), loc="upper right", ncols=2, bbox_to_anchor=(0.99, 1.0)
        )
        return to_svg(figure)


def _curve(axes: Axes, exceedance: Exceedance, shown: Array, x: Array, colour: str) -> None:
    rate = exceedance.rate(x)
    value, low, high = (YEAR * np.maximum(part, 1e-30) for part in rate)
    axes.plot(shown, np.where(value > 0.1 * _LOWEST, value, np.nan), color=colour)
    axes.fill_between(shown, low, high, color=colour, alpha=0.25, linewidth=0.0)


def _name_marks(axes: Axes, marks: Mapping[str, float]) -> None:
    """Write names along their marks, each beside the line before where that is near."""
    most = axes.get_xlim()[1]
    shown = sorted((value, name) for name, value in marks.items() if value < most)
    right = -math.inf
    for value, name in shown:
        right = max(value, right + _BESIDE * most)
        axes.text(
            right, 0.03, f" {name}", rotation=90, ha="right", va="bottom", fontsize=7.5,
            color=VERMILION, transform=axes.get_xaxis_transform(),
        )  # fmt: skip


def draw_feared(risk: Risk, level: float, system: str) -> str:
    """Draw which trucks bring about reactions above a value, beside all that strike; return SVG.

    Parameters
    ----------
    risk : Risk
        The risk.
    level : float
        The reaction [N].
    system : {"SI", "US"}
        Units to print in.
    """
    strikes = risk.strikes
    large, unit = (1e3, "t") if system == "SI" else (1e3 * unit_size("mass", "US"), "1000 lb")
    mass, speed = strikes.mass / large, strikes.speed / unit_size("speed", system)
    above, every = strikes.weight * (strikes.reaction > level), strikes.weight
    edges = [
        np.linspace(0.0, _end(values, every), cells + 1)
        for values, cells in zip((mass, speed), _CELLS, strict=True)
    ]
    of_above, of_every = (
        gaussian_filter(
            np.histogram2d(mass, speed, bins=(edges[0], edges[1]), weights=weights)[0], _SMOOTH
        )
        for weights in (above, every)
    )
    margins = {"left": 0.085, "right": 0.985, "top": 0.97, "bottom": 0.14}
    with sheet_figure(3.6, **margins, wspace=0.05, hspace=0.08) as figure:
        (heavy, corner), (axes, fast) = figure.subplots(
            2, 2, width_ratios=(4.0, 1.0), height_ratios=(1.0, 3.2), sharex="col", sharey="row"
        )
        corner.set_axis_off()
        shown = np.where(of_above > 0.01 * of_above.max(), of_above, np.nan)
        axes.pcolormesh(edges[0], edges[1], shown.T, cmap="YlOrRd", rasterized=True)
        _contours(axes, edges, of_every)
        axes.set(xlabel=f"Mass of the truck [{unit}]")
        axes.set_ylabel(f"Speed at the pier [{unit_of('speed', system)}]")
        for side, edge, axis, vertical in ((heavy, edges[0], 1, True), (fast, edges[1], 0, False)):
            for table, colour, alpha in ((of_every, GREY, 0.45), (of_above, VERMILION, 0.6)):
                part = table.sum(axis=axis) / max(table.sum(), 1e-300)
                fill: Any = side.fill_between if vertical else side.fill_betweenx
                fill(0.5 * (edge[1:] + edge[:-1]), 0.0, part, color=colour, alpha=alpha, lw=0.0)
            side.tick_params(left=False, bottom=False, labelleft=False, labelbottom=False)
            for spine in side.spines.values():
                spine.set_visible(False)
        place: Any = {"transform": corner.transAxes, "fontsize": 8.0, "va": "top"}
        corner.text(0.02, 0.95, "grey: all that strike\n(lines: 50 and 90 %)", color=DARK, **place)
        corner.text(0.02, 0.4, "red: those above", color=VERMILION, **place)
        figure.set_dpi(200)
        return to_svg(figure)


def _end(values: Array, weights: Array) -> float:
    """Return where an axis ends: where nearly all of the weights are below."""
    order = np.argsort(values)
    sums = np.cumsum(weights[order])
    place = int(np.searchsorted(sums, 0.9995 * sums[-1])) if len(sums) and sums[-1] > 0.0 else 0
    return 1.05 * float(values[order][min(place, len(values) - 1)]) or 1.0


def _contours(axes: Axes, edges: list[Array], table: Array) -> None:
    """Draw the lines within which the densest 50 and 90 % of the weights are."""
    flat = np.sort(table.ravel())[::-1]
    if not flat[0] > 0.0:
        return
    sums = np.cumsum(flat) / flat.sum()
    levels = sorted({float(flat[np.searchsorted(sums, share)]) for share in (0.9, 0.5)})
    if len(levels) < 2:
        return
    middles = [0.5 * (edge[1:] + edge[:-1]) for edge in edges]
    axes.contour(*middles, table.T, levels=levels, colors=[GREY], linewidths=0.9)
