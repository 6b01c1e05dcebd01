"""Rows of bars with words beside their ends, for a page."""

from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.axes import Axes

from pierimpact.plots.svg import size_of

_APART = 3.0  # between the end of a bar and its words [pt]
_ROUNDS = 30  # in which the ends of an axis find their places


class End(NamedTuple):
    """Words at the end of a bar."""

    row: float
    value: float
    words: str
    right: bool = True  #: whether they stand on the right of the value


def name_bars(axes: Axes, names: Sequence[str]) -> None:
    """Name the rows from above, without ticks."""
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.45, -0.55)
    axes.tick_params(axis="y", length=0.0)
    axes.spines["left"].set_visible(False)


def write_ends(axes: Axes, ends: Sequence[End], lowest: float | None = None) -> None:
    """Write words beside bars, and set the ends of the horizontal axis so that they find room.

    Parameters
    ----------
    axes : Axes
        The axes, in their place in the figure.
    ends : sequence of End
        The words.
    lowest : float, optional
        Where the axis begins; unless given, where words on the left do.
    """
    values = [end.value for end in ends]
    low, high = min(values) if lowest is None else lowest, max(values)
    shares, width = [], 72.0 * axes.bbox.width / axes.figure.dpi  # [pt]
    for end in ends:
        offset, side = (_APART, "left") if end.right else (-_APART, "right")
        text = axes.annotate(
            end.words,
            (end.value, end.row),
            (offset, 0.0),
            textcoords="offset points",
            ha=side,
            va="center",
        )
        shares.append((size_of(text)[0] + 2.0 * _APART) / width)
    for _ in range(_ROUNDS):
        for end, share in zip(ends, shares, strict=True):
            if end.right:
                high = max(high, low + (end.value - low) / (1.0 - share))
            elif lowest is None:
                low = min(low, high - (high - end.value) / (1.0 - share))
    axes.set_xlim(low, high)
