"""Small line charts as SVG text: drawn in a millisecond, sharp at any size, alike everywhere.

A redraw while a slider moves has a tenth of a second for everything; a plotting library spends
that on text and ticks alone.
"""

import html
import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Colours of Okabe and Ito, told apart by colour-blind readers too.
BLUE, VERMILION, GREEN, SKY, ORANGE, PURPLE = (
    "#0072b2",
    "#d55e00",
    "#009e73",
    "#56b4e9",
    "#e69f00",
    "#cc79a7",
)
INK, GREY, PALE = "#24292f", "#6e7781", "#d8dee4"
FONT = "system-ui, 'Segoe UI', 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif"

_LEFT, _RIGHT, _TOP, _BOTTOM = 50.0, 12.0, 24.0, 34.0
_INDEX = re.compile(r"\b(\w)_(\w)\b(.?)")
_MINUS = str.maketrans("-", "−")


@dataclass(kw_only=True)
class Panel:
    """A pair of axes and what is drawn in it, in the order of drawing.

    Parameters
    ----------
    title, x_label, y_label : str
        Headings, with units.
    x_range, y_range : tuple of float
        Ends of the axes, in the units of the labels.
    x_log : bool, optional
        Whether the horizontal axis is logarithmic.
    x_ticks : sequence of (float, str), optional
        Ticks with their text; by default at round numbers.
    width, height : float, optional
        Size in pixels of the drawing.
    """

    title: str
    x_label: str
    y_label: str
    x_range: tuple[float, float]
    y_range: tuple[float, float]
    x_log: bool = False
    x_ticks: Sequence[tuple[float, str]] | None = None
    width: float = 400.0
    height: float = 210.0
    _under: list[str] = field(default_factory=list)
    _over: list[str] = field(default_factory=list)
    _legend: list[tuple[str, str, str]] = field(default_factory=list)

    def x(self, value: ArrayLike) -> NDArray[np.float64]:
        """Return where values lie on the horizontal axis [px]."""
        low, high = self.x_range
        at = np.asarray(value, dtype=float)
        if self.x_log:
            at, low, high = np.log(at), math.log(low), math.log(high)
        return np.asarray(_LEFT + (at - low) / (high - low) * (self.width - _LEFT - _RIGHT))

    def y(self, value: ArrayLike) -> NDArray[np.float64]:
        """Return where values lie on the vertical axis [px]."""
        low, high = self.y_range
        share = (np.asarray(value, dtype=float) - low) / (high - low)
        return np.asarray(self.height - _BOTTOM - share * (self.height - _TOP - _BOTTOM))

    @property
    def frame(self) -> tuple[float, float, float, float]:
        """Left, top, right and bottom of the plot within the panel [px]."""
        return _LEFT, _TOP, self.width - _RIGHT, self.height - _BOTTOM

    def line(
        self,
        x: ArrayLike,
        y: ArrayLike,
        colour: str,
        name: str = "",
        *,
        width: float = 1.8,
        dash: str = "",
    ) -> None:
        """Draw a line; it is interrupted where `y` is nan."""
        px, py = self.x(x), self.y(y)
        known = np.isfinite(px) & np.isfinite(py)
        path = ""
        for run in _runs(known):
            path += "M" + "L".join(_points(px[run], py[run]))
        self._over.append(
            f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width:g}" '
            f'stroke-linejoin="round" stroke-dasharray="{dash}"/>'
        )
        if name:
            self._legend.append((name, colour, dash))

    def area(
        self, x: ArrayLike, lower: ArrayLike, upper: ArrayLike, colour: str, name: str = ""
    ) -> None:
        """Fill between two curves."""
        self.fill(
            np.concatenate([np.asarray(x), np.asarray(x)[::-1]]),
            np.concatenate([np.asarray(upper), np.asarray(lower)[::-1]]),
            colour,
            name,
        )

    def fill(self, x: ArrayLike, y: ArrayLike, colour: str, name: str = "") -> None:
        """Fill the outline through points."""
        outline = "L".join(_points(self.x(x), self.y(y)))
        self._under.append(f'<path d="M{outline}Z" fill="{colour}"/>')
        if name:
            self._legend.append((name, colour, "area"))

    def band(self, start: float, end: float, colour: str, name: str = "") -> None:
        """Shade a stretch of the horizontal axis, with its name along the bottom."""
        left, top, right, bottom = self.frame
        x0, x1 = (min(max(float(self.x(value)), left), right) for value in (start, end))
        if x1 - x0 < 0.5:
            return
        self._under.append(
            f'<rect x="{x0:.1f}" y="{top:g}" width="{x1 - x0:.1f}" height="{bottom - top:g}" '
            f'fill="{colour}" fill-opacity="0.13"/>'
        )
        if name and x1 - x0 > 6.0 * len(name):
            self._under.append(text((x0 + x1) / 2.0, bottom - 5.0, name, colour, 10, "middle"))

    def level(self, value: float, colour: str, name: str, *, dash: str = "5 4") -> None:
        """Draw a horizontal line across, with its name on it."""
        left, _, right, _ = self.frame
        y = float(self.y(value))
        self._over.append(
            f'<path d="M{left:g} {y:.1f}H{right:g}" stroke="{colour}" stroke-width="1.2" '
            f'stroke-dasharray="{dash}"/>' + text(right - 3, y - 4.0, name, colour, 10, "end")
        )

    def mark(
        self,
        x: float,
        y: float,
        colour: str,
        name: str = "",
        *,
        ring: bool = False,
        name_on_top: bool = False,
    ) -> None:
        """Mark a point, with its name beside it, or on top of the panel where lines run."""
        left, top, right, _ = self.frame
        px, py = float(self.x(x)), float(self.y(y))
        fill = "white" if ring else colour
        self._over.append(
            f'<circle cx="{px:.1f}" cy="{py:.1f}" r="4.5" fill="{fill}" stroke="{colour}" '
            f'stroke-width="2"/>'
        )
        if name:
            before = px > left + 0.62 * (right - left)
            self._over.append(
                text(
                    px - 8.0 if before else px + 8.0,
                    top + 11.0 if name_on_top else max(py - 7.0, top + 9.0),
                    name,
                    INK,
                    11,
                    "end" if before else "start",
                    halo=True,
                )
            )

    def upright(self, x: float, colour: str) -> None:
        """Draw a vertical line from bottom to top."""
        _, top, _, bottom = self.frame
        self._under.append(
            f'<path d="M{float(self.x(x)):.1f} {top:g}V{bottom:g}" stroke="{colour}" '
            f'stroke-width="1.2"/>'
        )

    def note(self, words: str) -> None:
        """Write a sentence in the middle, where there is nothing to draw."""
        left, top, right, bottom = self.frame
        self._over.append(text((left + right) / 2, (top + bottom) / 2, words, GREY, 12, "middle"))

    def svg(self) -> str:
        """Return the panel as the content of an SVG group."""
        left, top, right, bottom = self.frame
        parts = [
            f'<rect width="{self.width:g}" height="{self.height:g}" fill="white"/>',
            text(left, 14.0, self.title, INK, 12.5, "start", weight=600),
            *self._grid(),
            *self._under,
            f'<path d="M{left:g} {top:g}V{bottom:g}H{right:g}" fill="none" stroke="{GREY}"/>',
            *self._over,
            text((left + right) / 2, self.height - 5.0, self.x_label, GREY, 11, "middle"),
            f'<g transform="translate(11 {(top + bottom) / 2:g}) rotate(-90)">'
            + text(0.0, 0.0, self.y_label, GREY, 11, "middle")
            + "</g>",
            *self._keys(),
        ]
        return "".join(parts)

    def _grid(self) -> Iterable[str]:
        left, _, right, bottom = self.frame
        x_ticks = self.x_ticks
        if x_ticks is None:
            values = decades(*self.x_range) if self.x_log else ticks(*self.x_range, 7)
            x_ticks = [(value, plain(value)) for value in values]
        for value, words in x_ticks:
            x = float(self.x(value))
            yield f'<path d="M{x:.1f} {bottom:g}v4" stroke="{GREY}"/>'
            yield text(x, bottom + 15.0, words, GREY, 10.5, "middle")
        for value in ticks(*self.y_range, 5):
            y = float(self.y(value))
            yield f'<path d="M{left:g} {y:.1f}H{right:g}" stroke="{PALE}" stroke-width="0.8"/>'
            yield text(left - 5.0, y + 3.5, plain(value), GREY, 10.5, "end")

    def _keys(self) -> Iterable[str]:
        """Return the legend, along the title's line from the right."""
        x = self.frame[2]
        for name, colour, dash in reversed(self._legend):
            x -= 5.6 * len(name) + 4.0
            yield text(x, 14.0, name, INK, 10.5, "start")
            if dash == "area":
                yield f'<rect x="{x - 14.0:.1f}" y="6" width="10" height="9" fill="{colour}"/>'
                x -= 22.0
            else:
                yield (
                    f'<path d="M{x - 22.0:.1f} 10.5h18" stroke="{colour}" stroke-width="2.2" '
                    f'stroke-dasharray="{dash}"/>'
                )
                x -= 32.0


def figure(panels: Sequence[Sequence[Panel]], alt: str) -> str:
    """Return rows of panels as one SVG that fills the width it is given.

    Parameters
    ----------
    panels : sequence of sequences of Panel
        Rows, each of panels of one height.
    alt : str
        What the figure shows, for those who do not see it.
    """
    placed, y, width = [], 0.0, 0.0
    for row in panels:
        x = 0.0
        for panel in row:
            placed.append(f'<g transform="translate({x:g} {y:g})">{panel.svg()}</g>')
            x += panel.width
        width, y = max(width, x), y + row[0].height
    return canvas(width, y, "".join(placed), alt)


def canvas(width: float, height: float, content: str, alt: str = "") -> str:
    """Return an SVG of the given size in its own pixels; it scales to the width it is given."""
    what = f'role="img" aria-label="{html.escape(alt)}"' if alt else 'aria-hidden="true"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" {what} '
        f'font-family="{FONT}" style="display:block;width:100%;height:auto;max-height:none">'
        f"{content}</svg>"
    )


def ticks(low: float, high: float, count: int) -> NDArray[np.float64]:
    """Return at most `count` or so round numbers from `low` to `high`."""
    raw = (high - low) / count
    unit = 10.0 ** math.floor(math.log10(raw))
    step = next(unit * factor for factor in (1.0, 2.0, 5.0, 10.0) if unit * factor >= raw * 0.999)
    first = math.ceil(low / step - 1e-9)
    return np.asarray(step * np.arange(first, math.floor(high / step + 1e-9) + 1))


def decades(low: float, high: float) -> list[float]:
    """Return 1, 2 and 5 times the powers of ten from `low` to `high`."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    values = [factor * 10.0**power for power in powers for factor in (1.0, 2.0, 5.0)]
    return [value for value in values if low * 0.999 <= value <= high * 1.001]


def plain(value: float) -> str:
    """Return a tick's number as it is written by hand."""
    return f"{value:.6g}".translate(_MINUS)


def text(
    x: float,
    y: float,
    words: str,
    colour: str = INK,
    size: float = 12.0,
    anchor: str = "start",
    *,
    weight: int = 400,
    halo: bool = False,
) -> str:
    """Return a line of text; f_p is written with an index, `halo` keeps it legible on lines."""
    index = r'\1<tspan dy="3" font-size="75%">\2</tspan><tspan dy="-3">\3</tspan>'
    written = _INDEX.sub(index, html.escape(words))
    around = ' stroke="white" stroke-width="3" paint-order="stroke"' if halo else ""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" fill="{colour}" font-size="{size:g}" '
        f'text-anchor="{anchor}" font-weight="{weight}"{around}>{written}</text>'
    )


def _runs(known: NDArray[np.bool_]) -> list[slice]:
    """Return the stretches without a gap."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], known.astype(int), [0]))))
    return [slice(start, end) for start, end in zip(edges[::2], edges[1::2], strict=True)]


def _points(x: NDArray[np.float64], y: NDArray[np.float64]) -> list[str]:
    return [f"{a:.1f} {b:.1f}" for a, b in zip(x.tolist(), y.tolist(), strict=True)]
