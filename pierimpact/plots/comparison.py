"""Forces side by side as bars: full model, design procedure and codes."""

from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pierimpact.plots.style import name_rows, note, panel, round_up
from pierimpact.units import printed


class Bar(NamedTuple):
    """One force; `value` is None where there is none [N]."""

    name: str
    value: float | None
    colour: str
    remark: str


def bars_panel(figure: Figure, names: Sequence[str]) -> Axes:
    """Return the axes of `draw_bars`, one row for each name, from above."""
    axes = panel(figure, "", "Force [kN]", "", left=172.0, right=30.0, top=6.0)
    name_rows(axes, names)
    return axes


def draw_bars(axes: Axes, bars: Sequence[Bar]) -> None:
    """Draw the bars in the order of the names, each with its value and remark."""
    largest = max(bar.value for bar in bars if bar.value is not None)
    axes.set_xlim(0.0, 1e-3 * round_up(1.6 * largest))  # room for the words
    values = [1e-3 * (bar.value or 0.0) for bar in bars]
    axes.barh(range(len(bars)), values, height=0.66, color=[bar.colour for bar in bars])
    for row, (bar, value) in enumerate(zip(bars, values, strict=True)):
        words = "none" if bar.value is None else str(printed(bar.value, "force", "SI"))
        shown = f"{words}: {bar.remark}" if bar.remark else words
        note(axes, shown, (value, row), (4.0, 0.0), va="center")
