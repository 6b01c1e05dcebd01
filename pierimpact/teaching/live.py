"""Views in a notebook that are redrawn as their contents change: figures and words.

Axes with their ticks, labels and legends cost most of the drawing of a figure, and seldom change.
They are drawn once and kept as a picture. All else is in layers, from the ground up; a redraw
begins at the lowest layer whose results are new.
"""

import base64
import html
import io
from collections.abc import Callable
from typing import Any

import ipywidgets as ipw
from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from pierimpact.plots.style import PIXEL, SCREEN

#: Width beside the controls on an ordinary screen [px].
ROOM = 890.0
#: Dots of the picture a pixel of the page: sharp on screens of high density too.
DENSITY = 2.0
_DOTS_PER_INCH = DENSITY * 72.0 / PIXEL


class LiveWords:
    """Words in a notebook."""

    def __init__(self) -> None:
        self.widget = ipw.HTML(layout=ipw.Layout(flex="1 1 100%"))

    def show(self, content: str) -> None:
        """Show words, as HTML."""
        self.widget.value = content

    def still(self, *_: str) -> str:
        """Return the words as they are."""
        return f'<div style="flex:1 1 100%">{self.widget.value}</div>'


class LiveFigure:
    """A figure in a notebook.

    Parameters
    ----------
    name : str
        Its contents, in a few words.
    size : tuple of float
        Width and height at which letters have their size, in pixels of the page; the figure
        grows and shrinks with the room it has.
    prepare : callable
        Draws the parts that never change on an empty figure, and returns its axes.
    layers : callable
        Each draws a layer on the axes from its results, and may set the limits of the axes.
    **options
        Passed on to `prepare` and to each of the layers.
    """

    def __init__(
        self,
        name: str,
        size: tuple[float, float],
        prepare: Callable[..., Axes],
        *layers: Callable[..., None],
        **options: str,
    ) -> None:
        self.name = name
        width, height = (pixels * PIXEL / 72.0 for pixels in size)
        with rc_context(SCREEN):
            self._figure = Figure(figsize=(width, height), dpi=_DOTS_PER_INCH)
            self._canvas: Any = FigureCanvasAgg(self._figure)
            self._axes = prepare(self._figure, **options)
        self._layers, self._options = layers, options
        self._results: list[tuple[Any, ...] | None] = [None for _ in layers]
        self._artists: list[list[Artist]] = [[] for _ in layers]
        self._limits: tuple[float, ...] = ()
        self._grounds: list[Any] = [None for _ in layers]  # what each layer is drawn on
        self._palette: Image.Image | None = None
        # Not so small that letters cannot be read, and no more in a row than belong together.
        self._basis = f"max({80.0 * size[0] / ROOM:.0f}%, {0.8 * size[0]:.0f}px)"
        self._widest = f"{1.4 * size[0]:.0f}px"
        room = {"flex": f"1 1 {self._basis}", "min_width": "0", "max_width": self._widest}
        layout = ipw.Layout(**room, height="auto", align_self="flex-start")
        self.widget = ipw.Image(format="png", layout=layout)

    def show(self, *results: tuple[Any, ...]) -> None:
        """Show results, one tuple of arguments a layer; the same object or number is not new."""
        changed = [
            index
            for index, (new, old) in enumerate(zip(results, self._results, strict=True))
            if old is None or not all(map(_same, new, old))
        ]
        if not changed:
            return
        with rc_context(SCREEN):
            for index in changed:
                self._results[index] = None  # until all of it is drawn
                self._draw(index, results[index])
                self._results[index] = results[index]
            self._paint(changed[0])
        self.widget.value = self._encoded()

    def _draw(self, index: int, results: tuple[Any, ...]) -> None:
        """Replace the artists of a layer."""
        while self._artists[index]:
            self._artists[index].pop().remove()
        before = set(self._axes.get_children())
        try:
            self._layers[index](self._axes, *results, **self._options)
        finally:  # so that what was drawn before an error goes, too
            new = [artist for artist in self._axes.get_children() if artist not in before]
            for artist in new:
                artist.set_animated(True)
            self._artists[index] = sorted(new, key=Artist.get_zorder)

    def _paint(self, first: int) -> None:
        """Paint the layers from the first that changed; all, where the limits moved."""
        limits = (*self._axes.get_xlim(), *self._axes.get_ylim())
        if limits != self._limits:
            self._canvas.draw()  # which leaves out what is animated
            self._grounds[0] = self._canvas.copy_from_bbox(self._figure.bbox)
            self._limits, first = limits, 0
            self._palette = None
        self._canvas.restore_region(self._grounds[first])
        for index in range(first, len(self._layers)):
            if index > first:
                self._grounds[index] = self._canvas.copy_from_bbox(self._figure.bbox)
            for artist in self._artists[index]:
                self._axes.draw_artist(artist)

    def _encoded(self) -> bytes:
        """Return the picture as PNG, in few colours: that is four times faster than in all."""
        size, dots = self._canvas.get_width_height(), self._canvas.buffer_rgba()
        picture = Image.frombuffer("RGBA", size, dots, "raw", "RGBA", 0, 1).convert("RGB")
        if self._palette is None:
            self._palette = _palette(picture)
        file = io.BytesIO()
        few = picture.quantize(palette=self._palette, dither=Image.Dither.NONE)
        few.save(file, "png", compress_level=1)
        return file.getvalue()

    def still(self, words: str, basis: str = "") -> str:
        """Return the figure as HTML that needs nothing else.

        Parameters
        ----------
        words : str
            Description for those who cannot see it.
        basis : str, optional
            Smallest width at which it stands beside others, where not its own.
        """
        data = base64.b64encode(self.widget.value).decode()
        alt = html.escape(f"{self.name}. {words}")
        return (
            f'<img src="data:image/png;base64,{data}" alt="{alt}" style="flex:1 1 '
            f'{basis or self._basis};min-width:0;max-width:{self._widest}">'
        )


def _same(new: Any, old: Any) -> bool:
    return new is old or (isinstance(new, float) and isinstance(old, float) and new == old)


def _palette(picture: Image.Image) -> Image.Image:
    """Return the 256 colours that are nearest to those of a picture, white among them."""
    few = picture.quantize(256, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    palette = Image.new("P", (1, 1))
    # The white that was found is not quite white, and would stand out on a page.
    palette.putpalette([255 if light > 251 else light for light in few.getpalette() or []])
    return palette
