"""The amplification of engine or cargo against the frequency ratio, with its limits."""

from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pierimpact.plots import style

Array = NDArray[np.float64]


class Amplification(NamedTuple):
    """The amplification S of one body, each array of shape (n,) over the frequency ratio [-].

    Parameters
    ----------
    ratio : ndarray
        Frequency ratios β.
    impulse, static : ndarray
        The limits of S for a soft pier, without damping, and for a stiff one.
    closed, exact : ndarray
        S by the closed form, and of the two-degree-of-freedom system.
    """

    ratio: Array
    impulse: Array
    static: Array
    closed: Array
    exact: Array


def _lines(body: str) -> dict[str, dict[str, Any]]:
    """Return the styles of the curves of an `Amplification`, by their names in the style.key."""
    return {
        "impulse": {"color": style.ORANGE, "linewidth": 1.4 * style.PIXEL},
        "static": {"color": style.MUTED, "linewidth": 1.4 * style.PIXEL},
        "closed form": style.FORMULA,
        "exact": {"color": style.BODIES[body], "linewidth": 2.2 * style.PIXEL},
    }


def amplification_panel(figure: Figure, body: str) -> Axes:
    """Return the axes of `draw_amplification`, for "engine" or "cargo"."""
    ratio = "Frequency ratio $\\beta = f_\\mathrm{p} / f_i$ [-]"
    axes = style.panel(figure, body.capitalize(), ratio, "Amplification S [-]")
    style.logarithmic(axes, (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200))
    style.key(axes, _lines(body), columnspacing=1.0)
    return axes


def draw_amplification(axes: Axes, curves: Amplification, *, body: str) -> None:
    """Draw the amplification of a body, exact and closed, between its limits."""
    for values, line in zip(curves[1:], _lines(body).values(), strict=True):
        axes.plot(curves.ratio, values, **line)


def draw_here(axes: Axes, curves: Amplification, ratio: float, value: float, *, body: str) -> None:
    """Mark one pier on the amplification of a body, and set the limits of the axes."""
    axes.set_xlim(style.round_out(float(curves.ratio[0]), float(curves.ratio[-1]), ratio))
    axes.set_ylim(0.0, style.round_up(1.2 * max(float(curves.exact.max()), value)))
    style.mark_here(axes, ratio, value, style.BODIES[body], f"S = {value:.3f}")
