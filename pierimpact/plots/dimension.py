"""Dimensions on drawings to scale: a line between two ends, and its words."""

from typing import Any

from matplotlib.axes import Axes

from pierimpact.plots.style import INK


def draw_dimension(
    axes: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    words: str,
    side: str = "right",
) -> None:
    """Draw a dimension line with its words to the "right" or "left" of it, or "below" it."""
    arrow: Any = {"arrowstyle": "<|-|>", "mutation_scale": 6.0, "shrinkA": 0.0, "shrinkB": 0.0}
    axes.annotate("", start, end, arrowprops=arrow | {"color": INK, "linewidth": 0.6})
    offset, ha, va = {
        "right": ((4.0, 0.0), "left", "center"),
        "left": ((-4.0, 0.0), "right", "center"),
        "below": ((0.0, -4.0), "center", "top"),
    }[side]
    middle = (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1]))
    axes.annotate(words, middle, offset, textcoords="offset points", ha=ha, va=va)
