"""The column as one degree of freedom: its shape function, stiffness and mass."""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from pierimpact.pier.column import StruckColumn
from pierimpact.plots.style import GREEN, MUTED, PIXEL, VERMILION, key, mark_here, panel, round_up

Array = NDArray[np.float64]

_HEIGHT = "Impact height $z_\\mathrm{n}$ [m]"
_SQUARE = "#d5ebe4"


def shape_panel(figure: Figure) -> Axes:
    """Return the axes of `draw_shape`."""
    axes = panel(figure, "Shape function", "φ, φ² [-]", "Height z [m]")
    handles = {"φ": Line2D([], [], color=GREEN, linewidth=2.6 * PIXEL), "φ²": Patch(color=_SQUARE)}
    key(axes, handles)
    return axes


def draw_shape(axes: Axes, struck: StruckColumn) -> None:
    """Draw the shape function of a column and its square, with the impact height."""
    height, impact = struck.column.height, struck.impact_height
    z = np.union1d(np.linspace(0.0, height, 121), impact)
    shape = struck.shape(z)
    square = shape**2
    lowest, highest = float(shape.min()), max(float(shape.max()), float(square.max()))
    axes.set_ylim(0.0, math.ceil(height))
    axes.set_xlim(-round_up(-1.05 * lowest) if lowest < 0.0 else 0.0, round_up(1.05 * highest))
    axes.fill_betweenx(z, 0.0, square, color=_SQUARE, linewidth=0.0)
    axes.axvline(0.0, color=MUTED, linewidth=PIXEL)
    axes.plot(shape, z, color=GREEN, linewidth=2.6 * PIXEL)
    if height < math.ceil(height):
        axes.axhline(height, color=MUTED, linewidth=PIXEL)
    axes.axhline(impact, color=VERMILION, linewidth=1.2 * PIXEL, dashes=(4, 3))
    axes.plot([1.0], [impact], "o", color=VERMILION, markerfacecolor="white")
    axes.annotate(
        "impact height",
        (1.0, impact),
        xycoords=("axes fraction", "data"),
        xytext=(0.0, 4.0 * PIXEL),
        textcoords="offset points",
        horizontalalignment="right",
        color=VERMILION,
        fontsize=10.0 * PIXEL,
    )


def stiffness_panel(figure: Figure) -> Axes:
    """Return the axes of `draw_along` for the stiffness."""
    return panel(figure, "Stiffness $k_\\mathrm{p}$ (Eq. 3)", _HEIGHT, "Stiffness [GN/m]")


def mass_panel(figure: Figure) -> Axes:
    """Return the axes of `draw_along` for the mass."""
    return panel(figure, "Mass $m_\\mathrm{p}$ (Eq. 1)", _HEIGHT, "Mass [t]")


def draw_along(
    axes: Axes, heights: Array, values: Array, impact: float, value: float, *, unit: str
) -> None:
    """Draw what depends on the impact height, and one impact.

    Parameters
    ----------
    axes : Axes
        Axes of a panel above.
    heights, values : ndarray, shape (n,)
        Impact heights along the column [m], and values in the unit of the axis.
    impact, value : float
        Height and value of the one impact.
    unit : str
        Unit of the values.
    """
    # Next to a support the stiffness has no bound: the curve is cut off above.
    axes.set(
        xlim=(0.0, math.ceil(heights[-1])),
        ylim=(0.0, round_up(min(1.05 * float(values.max()), 4.0 * value))),
    )
    axes.plot(heights, values, color=GREEN, linewidth=2.2 * PIXEL)
    mark_here(axes, impact, value, VERMILION, f"{value:.3g} {unit}")
