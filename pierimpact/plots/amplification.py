"""The amplification of engine or cargo against the frequency ratio, with its limits."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from pierimpact.plots.style import (
    BODIES,
    FORMULA,
    MUTED,
    ORANGE,
    PIXEL,
    key,
    logarithmic,
    mark_here,
    panel,
    round_out,
    round_up,
)

Array = NDArray[np.float64]

_THIN = 1.4 * PIXEL
_LINES: dict[str, Any] = {
    "impulse": {"color": ORANGE, "linewidth": _THIN},
    "static": {"color": MUTED, "linewidth": _THIN},
    "closed form": FORMULA,
}


@dataclass(frozen=True, kw_only=True, eq=False)
class Amplification:
    """The amplification S of one body, each array of shape (n,) over the frequency ratio [-].

    Parameters
    ----------
    ratio : ndarray
        Frequency ratios β.
    exact, closed : ndarray
        S of the two-degree-of-freedom system, and by the closed form.
    impulse, static : ndarray
        Its limits for a soft, heavy pier and for a stiff one.
    """

    ratio: Array
    exact: Array
    closed: Array
    impulse: Array
    static: Array


def amplification_panel(figure: Figure, body: str) -> Axes:
    """Return the axes of `draw_amplification`, for "engine" or "cargo"."""
    axes = panel(
        figure,
        body.capitalize(),
        "Frequency ratio $\\beta = f_\\mathrm{p} / f_i$ [-]",
        "Amplification S [-]",
    )
    logarithmic(axes, (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200))
    lines = {**_LINES, "exact": {"color": BODIES[body], "linewidth": 2.2 * PIXEL}}
    key(axes, {name: Line2D([], [], **style) for name, style in lines.items()}, columnspacing=1.0)
    return axes


def draw_amplification(axes: Axes, curves: Amplification, *, body: str) -> None:
    """Draw the amplification of a body, exact and closed, between its limits."""
    for values, style in zip(
        (curves.impulse, curves.static, curves.closed), _LINES.values(), strict=True
    ):
        axes.plot(curves.ratio, values, **style)
    axes.plot(curves.ratio, curves.exact, color=BODIES[body], linewidth=2.2 * PIXEL)


def draw_here(axes: Axes, curves: Amplification, ratio: float, value: float, *, body: str) -> None:
    """Mark one pier on the amplification of a body, and set the limits of the axes."""
    axes.set_xlim(round_out(float(curves.ratio[0]), float(curves.ratio[-1]), ratio))
    axes.set_ylim(0.0, round_up(1.2 * max(float(curves.exact.max()), value)))
    mark_here(axes, ratio, value, BODIES[body], f"S = {value:.3f}")
