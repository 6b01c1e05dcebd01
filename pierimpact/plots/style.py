"""What all figures share: colours, the styles of sheet and screen, and axes."""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from matplotlib import get_data_path, rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import fontManager
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

# Colours of Okabe and Ito, told apart by colour-blind readers too.
BLUE, VERMILION, GREEN = "#0072b2", "#d55e00", "#009e73"
SKY, ORANGE, PURPLE = "#56b4e9", "#e69f00", "#cc79a7"
GREY = "#8a8a8a"
# Of words and lines on a screen.
INK, MUTED, PALE = "#24292f", "#5f6973", "#d8dee4"

#: One colour a body, in every view: the engine, and the body with its cargo.
BODIES = {"engine": VERMILION, "cargo": BLUE}

_SHEET: Any = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "axes.labelsize": 9.0,
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "svg.fonttype": "path",
    "svg.hashsalt": "pierimpact",  # the same drawing gives the same bytes
}


def complete_fonts() -> None:
    """Add the fonts that come with matplotlib where its cache, in the user's home, lacks them.

    That happens where the cache was written while an environment was being removed.
    """
    if _SHEET["font.family"] not in {font.name for font in fontManager.ttflist}:
        for path in Path(get_data_path(), "fonts", "ttf").glob("*.ttf"):
            fontManager.addfont(path)


complete_fonts()

# Of figures that are printed at their natural size.
_PAGE: Any = {
    "font.size": 8.0,
    "axes.labelsize": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelpad": 2.0,
    "axes.titlepad": 3.0,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "xtick.major.pad": 2.0,
    "ytick.major.pad": 2.0,
    "text.hinting": "none",
}
MILLIMETRES = 25.4  # in an inch
#: Width of the text of the sheet [mm].
TEXT_WIDTH = 168.0

#: Ticks of an axis of frequencies [Hz].
FREQUENCY_TICKS = (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)

PIXEL = 0.75  # of a style sheet, 1/96 inch [pt]
SCREEN: Any = {
    "font.family": "DejaVu Sans",
    "mathtext.fontset": "dejavusans",
    "font.size": 11.0 * PIXEL,
    "text.color": INK,
    "text.hinting": "none",  # quicker, and not missed at two dots a pixel
    "axes.titlesize": 12.5 * PIXEL,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.titlepad": 8.0 * PIXEL,
    "axes.labelsize": 11.0 * PIXEL,
    "axes.labelcolor": MUTED,
    "axes.labelpad": 3.0 * PIXEL,
    "axes.edgecolor": MUTED,
    "axes.linewidth": PIXEL,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.grid": True,
    "axes.grid.axis": "y",
    "grid.color": PALE,
    "grid.linewidth": 0.8 * PIXEL,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelsize": 10.5 * PIXEL,
    "ytick.labelsize": 10.5 * PIXEL,
    "xtick.major.size": 4.0 * PIXEL,
    "ytick.major.size": 0.0,
    "legend.fontsize": 10.5 * PIXEL,
    "legend.frameon": False,
    "legend.borderpad": 0.0,
    "legend.borderaxespad": 0.0,
    "legend.handlelength": 1.7,
    "legend.handletextpad": 0.5,
    "legend.columnspacing": 1.4,
    "lines.linewidth": 1.8 * PIXEL,
    "lines.markersize": 9.0 * PIXEL,
    "lines.markeredgewidth": 2.0 * PIXEL,
}


def _figure(width: float, height: float) -> Figure:
    """Return a figure whose words can be measured as it is drawn; its sides in inches."""
    figure = Figure(figsize=(width, height))
    FigureCanvasAgg(figure)
    return figure


@contextmanager
def sheet_figure(height: float, **margins: float) -> Iterator[Figure]:
    """Give a figure as wide as the text of the sheet, in its style; height in inches."""
    with rc_context(_SHEET):
        figure = _figure(6.5, height)
        figure.subplots_adjust(**margins)
        yield figure


@contextmanager
def page_figure(
    width: float,
    height: float,
    *,
    left: float = 0.0,
    right: float = 0.0,
    bottom: float = 0.0,
    top: float = 0.0,
    **spacing: Any,
) -> Iterator[Figure]:
    """Give a figure of the sheet with its size and its margins in millimetres."""
    with rc_context(_SHEET | _PAGE):
        figure = _figure(width / MILLIMETRES, height / MILLIMETRES)
        figure.subplots_adjust(
            left=left / width,
            right=1.0 - right / width,
            bottom=bottom / height,
            top=1.0 - top / height,
            **spacing,
        )
        yield figure


def logarithmic(axes: Axes, ticks: Sequence[float] = FREQUENCY_TICKS) -> None:
    """Make the horizontal axis logarithmic, with ticks at these values."""
    axes.set_xscale("log")
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()


def key(axes: Axes, styles: Mapping[str, dict[str, Any] | str], **options: Any) -> None:
    """Name lines, by their style, and areas, by their colour, above the axes at the right."""
    handles = [
        Patch(color=style) if isinstance(style, str) else Line2D([], [], **style)
        for style in styles.values()
    ]
    place: Any = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.02), "ncols": len(styles)}
    axes.legend(handles, list(styles), **place, **options)


def note(
    axes: Axes, words: str, place: tuple[Any, Any], offset: tuple[float, float], **options: Any
) -> None:
    """Write words at an offset [pt] from a place on the axes."""
    axes.annotate(words, place, xytext=offset, textcoords="offset points", **options)


def trim_ticks(axes: Axes, margin: float, lowest: float = -math.inf) -> None:
    """Leave only those ticks of the horizontal axis whose numbers stay beside the axes.

    Parameters
    ----------
    axes : Axes
        The axes, with their limits set.
    margin : float
        What is left free of them at either end, over the width of the axes [-].
    lowest : float, optional
        The smallest number that there may be.
    """
    (low, high), ticks = axes.get_xlim(), axes.get_xticks()
    edge = margin * (high - low)
    inside = (ticks >= lowest) & (ticks > low + edge) & (ticks < high - edge)
    axes.set_xticks(ticks[inside])


def name_rows(axes: Axes, names: Sequence[str]) -> None:
    """Name the rows of horizontal bars, from above, with a grid across them."""
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.tick_params(axis="y", labelsize=11.0 * PIXEL, labelcolor=INK)
    axes.grid(visible=False, axis="y")
    axes.grid(visible=True, axis="x")


def round_out(low: float, high: float, value: float) -> tuple[float, float]:
    """Return the ends of a logarithmic axis, moved out in steps where a value lies beyond them."""
    if value < 1.05 * low:
        low = 10.0 ** (math.floor(3.0 * math.log10(value / 1.05)) / 3.0)
    if value > high / 1.05:
        high = 10.0 ** (math.ceil(3.0 * math.log10(value * 1.05)) / 3.0)
    return low, high
