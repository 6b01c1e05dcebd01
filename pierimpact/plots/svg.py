"""The way to SVG, with words measured and formulas read once, rather than once in each figure."""

import io
from contextvars import ContextVar
from threading import Lock
from typing import Any

from matplotlib.backends.backend_mixed import MixedModeRenderer
from matplotlib.backends.backend_svg import RendererSVG
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.textpath import text_to_path

_POINTS = 72.0  # an inch, as SVG counts
_DOTS = 100.0  # an inch, of what is rasterized


class _Vector(RendererSVG):
    """Draws with the outlines of letters that all share, which remember the formulas they read."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)  # type: ignore[no-untyped-call]
        self._text2path = text_to_path


class _Renderer(MixedModeRenderer):
    """Draws a figure as SVG, and what is to be rasterized as a picture in it.

    As matplotlib keeps the measures of words by renderer, all of these count as one.
    """

    def __init__(self, figure: Figure, file: io.StringIO) -> None:
        width, height = figure.get_size_inches()
        size = width * _POINTS, height * _POINTS
        vector = _Vector(*size, file, image_dpi=_DOTS, metadata={"Date": None})
        super().__init__(figure, width, height, _DOTS, vector)  # type: ignore[no-untyped-call]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Renderer)

    def __hash__(self) -> int:
        return hash(_Renderer)


_MEASURE: Any = _Renderer(Figure(), io.StringIO())  # as it lasts, the measures do
_ONE_AT_A_TIME = Lock()  # of the threads, as they share fonts

#: The figures that are drawn, where somebody asks for them.
KEPT: ContextVar[list[Figure] | None] = ContextVar("KEPT", default=None)


def size_of(text: Text) -> tuple[float, float]:
    """Return width and height of words in a figure [pt]."""
    with _ONE_AT_A_TIME:
        extent = Text.get_window_extent(text, _MEASURE, _POINTS)  # without an annotation's arrow
    return extent.width, extent.height


def to_svg(figure: Figure) -> str:
    """Return a figure as SVG, without its date."""
    if (kept := KEPT.get()) is not None:
        kept.append(figure)
    file, dots = io.StringIO(), figure.dpi
    figure.set_dpi(_POINTS)
    renderer: Any = _Renderer(figure, file)
    with _ONE_AT_A_TIME:
        figure.draw(renderer)
    renderer.finalize()
    figure.set_dpi(dots)
    return file.getvalue()
