"""The ends of a column beside what is drawn over its height: their marks and their words."""

import math
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
        mark = _MARKS.get(kind_of(support))
        if mark:
            axes.plot(
                [0.0], [z / size], color=INK, linestyle="none", zorder=4, clip_on=False, **mark
            )


def end_labels(axes: Axes, column: PierColumn, size: float) -> list[Label]:
    """Return the words of the same ends, to be placed."""
    return [
        Label(axes, f"{name} {kind_of(support)}", (0.0, z / size), (1.0, side))
        for name, side, (z, support) in zip(
            ("base", "top"), (-1.0, 1.0), _ends(column), strict=True
        )
    ]


def kind_of(support: Support) -> str:
    """Return what holds an end in a word or two."""
    if 0.0 < support.stiffness < math.inf or 0.0 < support.rotation_stiffness < math.inf:
        return "on springs"
    if support.stiffness == 0.0:
        return "free" if support.rotation_stiffness == 0.0 else "held in rotation"
    return "pinned" if support.rotation_stiffness == 0.0 else "fixed"


def _ends(column: PierColumn) -> tuple[tuple[float, Support], tuple[float, Support]]:
    base, top = column.supports
    return (0.0 - column.embedment, base), (column.height, top)
