"""The column as one degree of freedom: its shape function, stiffness and mass."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pierimpact.pier.column import StruckColumn
from pierimpact.plots.ends import end_labels, mark_ends
from pierimpact.plots.labels import Label, place
from pierimpact.plots.style import (
    BLUE,
    GREEN,
    INK,
    MUTED,
    PIXEL,
    VERMILION,
    key,
    mark_here,
    note,
    page_figure,
    panel,
    round_up,
    to_svg,
)
from pierimpact.plots.words import named
from pierimpact.units import rounded, unit_of, unit_size

Array = NDArray[np.float64]

_SQUARE = "#d5ebe4"
_SHAPE: Any = {"color": GREEN, "linewidth": 2.6 * PIXEL}
# What depends on the impact height: its symbol and equation, the unit shown, and that in SI.
_ALONG = {
    "stiffness": ("$k_\\mathrm{p}$ (Eq. 3)", "GN/m", 1e9),
    "mass": ("$m_\\mathrm{p}$ (Eq. 1)", "t", 1e3),
}


def draw_shape_function(struck: StruckColumn, system: str) -> str:
    """Draw the shape function of a column over its height, for a page; return SVG.

    60 × 70 mm; with 1 at the impact, the largest value, the column at rest and its ends.

    Parameters
    ----------
    struck : StruckColumn
        The column and where it is struck.
    system : {"SI", "US"}
        Units to print in.
    """
    column, impact, size = struck.column, struck.impact_height, unit_size("length", system)
    z = np.union1d(np.linspace(0.0 - column.embedment, column.height, 301), impact)
    shape = struck.shape(z)
    most = int(np.argmax(np.abs(shape)))
    largest, place_of_it, unit = float(shape[most]), float(z[most]), unit_of("length", system)
    with page_figure(60.0, 70.0, left=13.0, right=2.0, bottom=9.0, top=3.0) as figure:
        axes = figure.add_subplot()
        axes.plot([0.0, 0.0], [z[0] / size, z[-1] / size], color=INK, linewidth=0.8)
        axes.plot(shape, z / size, color=BLUE, linewidth=1.6)
        axes.plot([0.0, 1.0], [impact / size] * 2, color=INK, linewidth=0.6, dashes=(4, 3))
        axes.plot([1.0], [impact / size], "o", color=BLUE, markersize=4.0)
        axes.margins(x=0.12, y=0.12)
        axes.set_xlabel("Shape function $\\varphi$ [-]")
        axes.set_ylabel(f"Height $z$ [{unit}]")
        axes.locator_params(nbins=5)
        mark_ends(axes, column, size)
        labels = [Label(axes, f"1 at {named('z', impact, system)}", (1.0, impact / size))]
        if abs(largest) > 1.0 + 1e-6:
            words = f"{rounded(largest, 3)} at {rounded(place_of_it / size, 3)} {unit}"
            axes.plot([largest], [place_of_it / size], "o", color=BLUE, markersize=4.0, mfc="w")
            labels.append(Label(axes, f"largest {words}", (largest, place_of_it / size)))
        place(figure, labels + end_labels(axes, column, size))
        return to_svg(figure)


def shape_panel(figure: Figure) -> Axes:
    """Return the axes of `draw_shape`."""
    axes = panel(figure, "Shape function", "φ, φ² [-]", "Height z [m]")
    key(axes, {"φ": _SHAPE, "φ²": _SQUARE})
    return axes


def draw_shape(axes: Axes, struck: StruckColumn) -> None:
    """Draw the shape function of a column and its square, with the impact height."""
    height, impact = struck.column.height, struck.impact_height
    z = np.union1d(np.linspace(0.0, height, 121), impact)
    shape = struck.shape(z)
    square = shape**2
    lowest, highest = float(shape.min()), float(max(shape.max(), square.max()))
    axes.set_ylim(0.0, math.ceil(height))
    axes.set_xlim(-round_up(-1.05 * lowest) if lowest < 0.0 else 0.0, round_up(1.05 * highest))
    axes.fill_betweenx(z, 0.0, square, color=_SQUARE, linewidth=0.0)
    axes.axvline(0.0, color=MUTED, linewidth=PIXEL)
    axes.plot(shape, z, **_SHAPE)
    if height < math.ceil(height):
        axes.axhline(height, color=MUTED, linewidth=PIXEL)
    axes.axhline(impact, color=VERMILION, linewidth=1.2 * PIXEL, dashes=(4, 3))
    axes.plot([1.0], [impact], "o", color=VERMILION, markerfacecolor="white")
    note(
        axes,
        "impact height",
        (1.0, impact),
        (0.0, 4.0 * PIXEL),
        xycoords=("axes fraction", "data"),
        ha="right",
        color=VERMILION,
        fontsize=10.0 * PIXEL,
    )


def along_panel(figure: Figure, quantity: str) -> Axes:
    """Return the axes of `draw_along`, for "stiffness" or "mass"."""
    name, (symbol, unit, _) = quantity.capitalize(), _ALONG[quantity]
    height = "Impact height $z_\\mathrm{n}$ [m]"
    return panel(figure, f"{name} {symbol}", height, f"{name} [{unit}]")


def draw_along(
    axes: Axes, heights: Array, values: Array, impact: float, value: float, *, quantity: str
) -> None:
    """Draw what depends on the impact height, and one impact.

    Parameters
    ----------
    axes : Axes
        Axes of an `along_panel`.
    heights, values : ndarray, shape (n,)
        Impact heights along the column [m], and values in SI units.
    impact, value : float
        Height and value of the one impact.
    quantity : {"stiffness", "mass"}
        What the values are of.
    """
    _, unit, size = _ALONG[quantity]
    values, value = values / size, value / size
    # Next to a support the stiffness has no bound: the curve is cut off above.
    top = round_up(min(1.05 * float(values.max()), 4.0 * value))
    axes.set(xlim=(0.0, math.ceil(heights[-1])), ylim=(0.0, top))
    axes.plot(heights, values, color=GREEN, linewidth=2.2 * PIXEL)
    mark_here(axes, impact, value, VERMILION, f"{value:.3g} {unit}")
