"""What collides in a figure: words with words, with its edge and with anything that is drawn.

Found from the figure's artists, by their outlines, once they have been laid out.
"""

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import Collection
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from matplotlib.markers import MarkerStyle
from matplotlib.patches import Patch
from matplotlib.path import Path
from matplotlib.text import Annotation, Text
from matplotlib.transforms import Bbox

SMALLEST = 7.5  # of words [pt]
# By so much a text's box is larger than its ink [pt], and so dark an area does not lie under words.
SLACK, DARK = 0.6, 0.6


@rc_context({"text.hinting": "none"})  # as in SVG
def collisions(figure):
    """Return a line for each collision of a figure, and for each word that is too small to read."""
    figure.set_dpi(144.0)
    FigureCanvasAgg(figure).draw()
    hidden, ticks = _not_drawn(figure)
    texts = [
        text
        for text in figure.findobj(Text)
        if text.get_visible() and text.get_text().strip() and text not in hidden
    ]
    boxes = [_box(text) for text in texts]
    found = [f"{t.get_text()!r} is small" for t in texts if t.get_fontsize() < SMALLEST]
    found += [
        f"{text.get_text()!r} is cut off"
        for text, box in zip(texts, boxes, strict=True)
        if not (figure.bbox.contains(*box.p0) and figure.bbox.contains(*box.p1))
    ]
    found += [
        f"{text.get_text()!r} on {other.get_text()!r}"
        for i, (text, box) in enumerate(zip(texts, boxes, strict=True))
        for other, their in zip(texts[:i], boxes[:i], strict=True)
        if box.overlaps(their)
    ]
    for artist in _drawn(figure, ticks | hidden):
        own = next((t for t in texts if getattr(t, "arrow_patch", None) is artist), None)
        found += [
            f"{text.get_text()!r} on {type(artist).__name__}"
            for text, box in zip(texts, boxes, strict=True)
            if text is not own and _touches(artist, box)
        ]
    return found


def _box(text):
    """Return the box of a text without its arrow and a little within its ink's."""
    box, slack = Text.get_window_extent(text), SLACK * 2.0
    return Bbox([box.p0 + slack, box.p1 - slack])


def _not_drawn(figure):
    """Return the texts and lines of ticks beyond their axes, and the lines of all ticks."""
    hidden, lines = set(), set()
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            slack = 1e-9 * (high - low)
            for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
                lines |= {tick.tick1line, tick.tick2line}
                if not (axes.axison and low - slack <= tick.get_loc() <= high + slack):
                    hidden |= {tick.label1, tick.label2, tick.gridline}
            if not axes.axison:
                hidden |= {axis.label, axis.offsetText, *axes.spines.values()}
    return hidden, lines


def _drawn(figure, left_out):
    """Return the artists that have outlines; the paper is none."""
    paper = {figure.patch, *(axes.patch for axes in figure.axes)}
    arrows = [text.arrow_patch for text in figure.findobj(Annotation) if text.arrow_patch]
    artists = [*figure.findobj(lambda a: isinstance(a, Line2D | Patch | Collection)), *arrows]
    return {a for a in artists if a.get_visible() and a not in left_out and a not in paper}


def _touches(artist, box):
    """Whether a box lies on the outline of an artist, or on a dark area of it."""
    if artist.get_clip_on() and artist.axes is not None:
        box = Bbox.intersection(box, artist.axes.bbox)
        if box is None:
            return False
    transform = artist.get_transform()
    if isinstance(artist, Collection):
        outlined = np.max(artist.get_linewidths(), initial=0.0) > 0.0
        paths = artist.get_paths() if outlined and len(artist.get_edgecolors()) else ()
        return any(_crosses(transform.transform_path(path), box) for path in paths)
    path = transform.transform_path(artist.get_path())
    if isinstance(artist, Line2D):
        return (_lined(artist) and _crosses(path, box)) or _marks(artist, path, box)
    outlined = artist.get_linewidth() > 0.0 and artist.get_edgecolor()[3] > 0.0
    return (outlined and _crosses(path, box)) or (_dark(artist) and _crosses(path, box, True))


def _crosses(path, box, filled=False):
    return any(
        Path(outline).intersects_bbox(box, filled=filled)
        for outline in path.to_polygons(closed_only=False)
    )


def _lined(line):
    return line.get_linestyle() not in ("None", " ", "") and line.get_linewidth() > 0.0


def _marks(line, path, box):
    if line.get_marker() in ("None", None, "", " "):
        return False
    style, size = (
        MarkerStyle(line.get_marker()),
        2.0 * line.get_markersize(),
    )  # elements of the picture
    mark = style.get_path().transformed(style.get_transform()).get_extents()
    edge = line.get_markeredgewidth()
    reach = Bbox([size * mark.p0 - edge, size * mark.p1 + edge])
    return any(Bbox(reach.get_points() + point).overlaps(box) for point in path.vertices)


def _dark(patch):
    if not patch.get_fill():
        return False
    *colour, alpha = to_rgba(patch.get_facecolor())
    return 1.0 - alpha * (1.0 - np.dot(colour, (0.299, 0.587, 0.114))) < DARK or bool(
        patch.get_hatch()
    )
