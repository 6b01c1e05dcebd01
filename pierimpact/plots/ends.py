"""The ends of a column beside what is drawn over its height: their marks and their words."""

from typing import Any

from matplotlib.axes import Axes

from pierimpact.pier.arrangement import Support
from pierimpact.pier.column import PierColumn
from pierimpact.plots.labels import Label
from pierimpact.plots.style import INK

_FIXED: Any = {"marker": "_", "markersize": 14.0, "markeredgewidth": 3.0}
_PINNED: Any = {"marker": "o", "markersize": 4.5, "markerfacecolor": "white"}
_SPRING: Any = {"marker": "_", "markersize": 10.0, "markeredgewidth": 1.0}
_MARKS: dict[str, dict[str, Any]] = {"fixed": _FIXED, "pinned": _PINNED, "on springs": _SPRING}


def mark_ends(axes: Axes, column: PierColumn, size: float) -> None:
    """Mark what holds base and top at zero of axes over the height, whose unit has that size."""
    for z, support in _ends(column):
        mark = _MARKS.get(support.kind)
        if mark:
            axes.plot(
                [0.0], [z / size], color=INK, linestyle="none", zorder=4, clip_on=False, **mark
            )


def end_labels(axes: Axes, column: PierColumn, size: float) -> list[Label]:
    """Return the words of the same ends, to be placed."""
    return [
        Label(axes, f"{name} {support.kind}", (0.0, z / size), (1.0, side))
        for name, side, (z, support) in zip(
            ("base", "top"), (-1.0, 1.0), _ends(column), strict=True
        )
    ]


def _ends(column: PierColumn) -> tuple[tuple[float, Support], tuple[float, Support]]:
    base, top = column.supports
    return (0.0 - column.embedment, base), (column.height, top)
