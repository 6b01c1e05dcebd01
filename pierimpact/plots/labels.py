"""Labels that find their places: as near as may be to what they name, where nothing is drawn.

A figure is drawn once without them. A label may stand wherever its box covers nothing but white
and pale areas; of these places it takes the one nearest to its point, with a thin line to it where
that is not near. What it covers is taken for the labels that come after it.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from pierimpact.plots.style import INK
from pierimpact.plots.svg import size_of

_FINE = 2  # picture elements a point
_STEP = (3, 1)  # from one place to the next, across and upward [pt]
_PAD = np.array([[3.0], [1.5]])  # left free beside a label, and above and below it [pt]
_NEAR = 7.0  # distance beyond which it has a line [pt]
_PALE = 200.0  # of 255: areas as bright as this may lie under a label
_SIDE = 0.15  # what a place on the wrong side costs, over what distance costs
_LINE, _LABEL = 2, 30  # what a line to a label costs where it crosses what is drawn, or a label
_TRIED = 200  # of the nearest places, and of all, whose lines are looked at


class Label(NamedTuple):
    """Words for a point of a figure, or for whichever of several is the best."""

    axes: Axes
    words: str
    points: ArrayLike  #: shape (2,) or (n, 2), in the coordinates of the axes' data
    toward: tuple[float, float] = (1.0, 1.0)  #: on which side of the point it best stands
    options: Mapping[str, Any] = MappingProxyType({})  #: of the text


def place(figure: Figure, labels: Sequence[Label]) -> None:
    """Write labels on a figure of `style` where nothing else is, the first of them first."""
    figure.set_dpi(72.0 * _FINE)
    canvas: Any = figure.canvas
    with _without_axis(figure):
        canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())
    pixels = pixels[::-1, :, :3]  # from below, as coordinates are
    ink = pixels @ np.array([0.299, 0.587, 0.114]) < _PALE  # by their luminance
    rows, columns = (count // _FINE for count in ink.shape)
    squares = ink[: rows * _FINE, : columns * _FINE].reshape(rows, _FINE, columns, _FINE)
    taken = np.where(squares.any(axis=(1, 3)), _LINE, 0)
    figure.set_dpi(72.0)  # a square is a point, and the figure's coordinates are squares
    for label in labels:
        _write(label, taken)


@contextmanager
def _without_axis(figure: Figure) -> Iterator[None]:
    """Hide numbers, ticks and names of axes: they stand beside these, where no label comes."""
    shown = [
        axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis) if axis.get_visible()
    ]
    for axis in shown:
        axis.set_visible(False)
    yield
    for axis in shown:
        axis.set_visible(True)


def _write(label: Label, taken: NDArray[np.int_]) -> None:
    """Write one label, and note what it and its line cover."""
    axes, points = label.axes, np.atleast_2d(np.asarray(label.points, dtype=float))
    text = axes.text(points[0, 0], points[0, 1], label.words, **label.options)
    size = np.reshape(size_of(text), (2, 1))
    text.remove()
    corners = _PAD + _places(taken > 0, np.ceil(size + 2.0 * _PAD)[:, 0].astype(int), axes)
    limits = np.array([taken.shape[::-1]]) - 1.0
    ends = np.clip(axes.transData.transform(points), 0.0, limits).T[..., None]
    wanted = ends + 0.5 * size[:, None] * np.reshape(label.toward, (2, 1, 1))
    nearest = np.clip(ends, corners[:, None], (corners + size)[:, None])
    gaps = _length(ends - nearest)
    costs = gaps + _SIDE * _length((corners + 0.5 * size)[:, None] - wanted)
    which = np.argmin(costs, axis=0)
    gap, cost = (values[which, np.arange(which.size)] for values in (gaps, costs))
    best = np.argmin(cost)
    if gap[best] > _NEAR:
        order = np.argsort(cost, kind="stable")
        tried = np.concatenate((order[:_TRIED], order[:: len(order) // _TRIED + 1]))
        own = which[tried]
        crossed = taken[_line(nearest[:, own, tried], ends[:, own, 0])].sum(axis=0)
        best = tried[np.argmin(cost[tried] + np.where(gap[tried] > _NEAR, crossed, 0))]
    corner, near, end = corners[:, best], nearest[:, which[best], best], ends[:, which[best], 0]
    line: dict[str, Any] = {}
    if gap[best] > _NEAR:
        style = {"arrowstyle": "-", "color": INK, "linewidth": 0.5, "shrinkA": 0.5, "shrinkB": 2.0}
        line["arrowprops"] = style | {"relpos": tuple((near - corner) / size[:, 0])}
        taken[_line(near, end)] = _LINE
    axes.annotate(
        label.words,
        tuple(points[which[best]]),
        tuple(corner - end),
        textcoords="offset points",
        annotation_clip=False,
        **{"ha": "left", "va": "bottom", **line, **label.options},
    )
    (left, bottom), (right, top) = corner.astype(int), (corner + size[:, 0]).astype(int) + 1
    taken[bottom:top, left:right] = _LABEL


def _places(taken: NDArray[np.bool_], size: NDArray[np.int_], axes: Axes) -> NDArray[np.int_]:
    """Return where a box may have its lower left corner: where it covers least, shape (2, n)."""
    width, height = size
    left, bottom = (max(int(np.ceil(end)), 0) for end in axes.bbox.p0)
    right, top = (min(int(end), n) for end, n in zip(axes.bbox.p1, taken.T.shape, strict=True))
    right, top = max(right, left + width), max(top, bottom + height)
    sums = np.zeros((top - bottom + 1, right - left + 1), dtype=np.int32)
    sums[1:, 1:] = taken[bottom:top, left:right]
    for axis in (0, 1):
        np.cumsum(sums, axis=axis, out=sums)
    rows = sums[height :: _STEP[1]] - sums[: -height : _STEP[1]]
    covered = rows[:, width :: _STEP[0]] - rows[:, : -width : _STEP[0]]
    y, x = np.nonzero(covered == covered.min())
    return np.stack((left + _STEP[0] * x, bottom + _STEP[1] * y))


def _length(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the length of vectors, shape (2, ...), in half the time that `hypot` takes."""
    x, y = vectors
    length: NDArray[np.float64] = np.sqrt(x * x + y * y)
    return length


def _line(start: NDArray[np.float64], end: NDArray[np.float64]) -> tuple[NDArray[np.int_], ...]:
    """Return rows and columns of the picture along a line, or along several side by side."""
    share = np.linspace(0.0, 1.0, 60).reshape(-1, *[1] * start.ndim)
    x, y = np.moveaxis((start + share * (end - start)).astype(int), 1, 0)
    return y, x
