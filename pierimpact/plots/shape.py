"""The column as one degree of freedom: its shape function, stiffness and mass."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pierimpact.pier.column import StruckColumn
from pierimpact.plots.style import (
    GREEN,
    MUTED,
    PIXEL,
    VERMILION,
    key,
    mark_here,
    note,
    panel,
    round_up,
)

Array = NDArray[np.float64]

_SQUARE = "#d5ebe4"
_SHAPE: Any = {"color": GREEN, "linewidth": 2.6 * PIXEL}
# What depends on the impact height: its symbol and equation, the unit shown, and that in SI.
_ALONG = {
    "stiffness": ("$k_\\mathrm{p}$ (Eq. 3)", "GN/m", 1e9),
    "mass": ("$m_\\mathrm{p}$ (Eq. 1)", "t", 1e3),
}


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
