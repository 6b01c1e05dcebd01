"""What each parameter of the truck does to a peak, as bars to both sides."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter
from numpy.typing import NDArray

from pierimpact.plots.style import INK, MUTED, ORANGE, PIXEL, SKY, key, name_rows, panel, round_up

Array = NDArray[np.float64]

_COLOURS = (SKY, ORANGE)  # of the parameter made smaller and larger


def influence_panel(figure: Figure, body: str, names: Sequence[str], change: float) -> Axes:
    """Return the axes of `draw_influence`.

    Parameters
    ----------
    figure : Figure
        The figure.
    body : {"engine", "cargo"}
        Whose peak it is.
    names : sequence of str
        The parameters, from above.
    change : float
        The share by which each is made smaller and larger [-].
    """
    axes = panel(figure, f"{body.capitalize()} peak", "Change of the peak", "", left=178.0)
    name_rows(axes, names)
    axes.xaxis.set_major_formatter(PercentFormatter(1.0))
    axes.locator_params(axis="x", nbins=5)
    axes.axvline(0.0, color=MUTED, linewidth=PIXEL)
    words = (f"−{change:.0%}", f"+{change:.0%}")
    key(axes, dict(zip(words, _COLOURS, strict=True)), handlelength=0.8, handleheight=0.8)
    return axes


def draw_influence(axes: Axes, changes: Array | None, *, body: str) -> None:
    """Draw the relative change of a peak for each parameter.

    Parameters
    ----------
    axes : Axes
        Axes of an `influence_panel`.
    changes : ndarray, shape (n, 2), or None
        Relative change with the parameter smaller and larger; nan where the peak is gone [-].
        None where there is no peak to change.
    body : {"engine", "cargo"}
        Whose peak it is.
    """
    if changes is None:
        words = f"The {body} does not reach the pier."
        axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", color=MUTED)
        return
    widest = round_up(max(0.1, 1.05 * float(np.nanmax(np.abs(changes)))))
    axes.set_xlim(-widest, widest)
    rows = np.arange(len(changes))
    for column, colour in zip(changes.T, _COLOURS, strict=True):
        known = np.isfinite(column)
        axes.barh(rows[known], column[known], height=0.7, color=colour)
    for row in rows[~np.isfinite(changes).all(axis=1)]:
        axes.text(0.0, row, " no peak", va="center", color=INK, fontsize=10.0 * PIXEL)
