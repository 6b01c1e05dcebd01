"""The collision at a glance, to scale: column, truck, impact height, reaction, and the section."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

from pierimpact.pier.column import PierColumn
from pierimpact.pier.sections import FreeSection, Section
from pierimpact.plots.dimension import draw_dimension
from pierimpact.plots.elevation import draw_column, draw_ground, widest
from pierimpact.plots.labels import Label, place
from pierimpact.plots.section import draw_section, outline
from pierimpact.plots.style import INK, MUTED, PALE, VERMILION, page_figure
from pierimpact.plots.svg import to_svg
from pierimpact.plots.words import named, shown
from pierimpact.vehicle.truck import Truck

#: Size of the drawing [mm].
WIDTH, HEIGHT = 92.0, 88.0

# To which it is drawn, one to so many: the finest that fits.
_SCALES: tuple[float, ...] = (
    *(5, 10, 15, 20, 25, 30, 40, 50, 75),
    *(step * 10**power for power in range(2, 7) for step in (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 7.5)),
)
# On paper [mm]: sizes of supports and gaps; what is kept free right of the column, above it and
# below it, and between it and the truck; the largest depth of the column; the middle of the truck's
# mass from the left at least; room for the section, and within it for the section itself.
_UNIT, _RIGHT, _ABOVE, _BELOW, _GAP, _DEEPEST = 2.2, 26.0, 10.0, 10.0, 16.0, 22.0
_FROM_CUT = 11.0
_ROOM, _FITS = (46.0, 34.0), (22.0, 20.0)
# Outline of a truck with a bonnet, its nose at zero, driving to the right [m].
_CAB = ((0.0, 0.45), (0.0, 1.05), (-0.15, 1.45), (-1.25, 1.6), (-1.75, 2.55), (-2.9, 2.6),
        (-2.9, 0.45))  # fmt: skip
_GLASS = ((-1.42, 1.68), (-1.82, 2.4), (-2.35, 2.4), (-2.35, 1.68))
_BOX = ((-3.1, 0.85), (-3.1, 3.2), (-9.0, 3.2), (-9.0, 0.85))
_WHEEL, _WHEELS = 0.48, (-0.95, -6.9, -8.0)
_TALLEST = 3.2


def draw_situation(
    column: PierColumn, impact_height: float, truck: Truck, reaction: float, system: str
) -> str:
    """Draw column and truck to scale, the reaction where it acts, and the section; return SVG.

    92 × 88 mm, and to the scales that it states where it is printed at that size. The section is
    the one that is struck.

    Parameters
    ----------
    column : PierColumn
        The column.
    impact_height : float
        Nominal impact height [m].
    truck : Truck
        The truck, drawn as any truck with a bonnet.
    reaction : float
        The reaction to be written at its arrow [N].
    system : {"SI", "US"}
        Units to print in.
    """
    struck = next(own for own, low, high in column.stretches if low <= impact_height <= high)
    with page_figure(WIDTH, HEIGHT) as figure:
        scale = _scale_of(column)
        mm = scale / 1e3  # on paper, in metres of the drawing
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set_axis_off()
        right = 0.5 * widest(column) + _RIGHT * mm
        left, bottom = right - WIDTH * mm, -column.embedment - _BELOW * mm
        axes.set(xlim=(left, right), ylim=(bottom, bottom + HEIGHT * mm))
        draw_ground(axes, left + mm, right - mm, _UNIT * mm)
        face = -0.5 * struck.extent
        _draw_truck(axes, face - _GAP * mm, left + 2.0 * mm)
        labels = draw_column(axes, column, _UNIT * mm, system)
        arrow: Any = {"arrowstyle": "-|>", "color": VERMILION, "linewidth": 2.0, "shrinkB": 0.0}
        start = (face - (_GAP - 1.5) * mm, impact_height)
        axes.annotate("", (face, impact_height), start, arrowprops=arrow)
        words, bold = f"$R$ = {shown(reaction, 'force', system)}", {"weight": "bold"}
        along = [(face - share * _GAP * mm, impact_height) for share in (0.3, 0.5, 0.7)]
        labels.insert(0, Label(axes, words, along, (0.0, 1.0), bold))
        labels += _draw_heights(axes, column, impact_height, -face, mm, system)
        mass = f"{shown(truck.mass, 'mass', system, given=True)}"
        cab = max(face - _GAP * mm - 2.2, left + _FROM_CUT * mm)
        labels.append(Label(axes, mass, (cab, 1.1), (0.0, 0.0)))
        axes.text(0.01, 0.01, f"Elevation 1:{scale:.0f}", transform=axes.transAxes)
        place(figure, _add_section(figure, struck, system) + labels)
        return to_svg(figure)


def _scale_of(column: PierColumn) -> float:
    """Return the scale of the elevation: column, truck, and section above the truck find room."""
    needs = (
        (column.height + column.embedment, HEIGHT - _ABOVE - _BELOW),
        (_TALLEST + column.embedment, HEIGHT - _ROOM[1] - _BELOW),
        (widest(column), _DEEPEST),
    )
    return next(own for own in _SCALES if all(1e3 * size <= own * room for size, room in needs))


def _draw_heights(
    axes: Axes, column: PierColumn, impact_height: float, face: float, mm: float, system: str
) -> list[Label]:
    """Draw the dimensions of the heights on the right of the column; return their labels."""
    labels, end = [], 0.5 * widest(column)
    for name, low, high, gap in (
        ("z", 0.0, impact_height, 4.0),
        ("He", -column.embedment, 0.0, 4.0),
        ("H", 0.0, column.height, _RIGHT - 2.0),
    ):
        if high > low:
            x = end + gap * mm
            own = column.stretches[-1][0].extent / 2.0 if name == "H" else face
            for z in {low, high} - {0.0}:
                axes.plot([own + mm, x + mm], [z, z], color=INK, linewidth=0.4)
            draw_dimension(axes, (x, low), (x, high), "")
            turned = {"rotation": 90.0} if name == "H" else {}
            words, point = named(name, high - low, system), (x, 0.5 * (low + high))
            side = (-1.0, 0.0) if name == "H" else (1.0, 0.0)
            labels.append(Label(axes, words, point, side, turned))
    return labels[::-1]


def _draw_truck(axes: Axes, nose: float, cut: float) -> None:
    """Draw a truck with its nose at a place, as far as where it is cut off [m]."""
    line: Any = {"edgecolor": MUTED, "linewidth": 0.8, "joinstyle": "round"}
    parts: list[Any] = [
        Polygon(np.add(points, (nose, 0.0)), facecolor=colour, **line)
        for points, colour in ((_BOX, "white"), (_CAB, "#f3f6f9"), (_GLASS, PALE))
    ]
    parts += [
        Circle((nose + x, _WHEEL), radius, color=colour)
        for x in _WHEELS
        for radius, colour in ((_WHEEL, MUTED), (0.5 * _WHEEL, PALE))
    ]
    for part in parts:
        axes.add_artist(part)
        part.set_clip_path(Rectangle((cut, 0.0), nose - cut + 1.0, 4.0, transform=axes.transData))


def _add_section(figure: Figure, section: Section, system: str) -> list[Label]:
    """Draw the section at the top left, to a scale of its own; return its labels."""
    width, height = _ROOM
    axes = figure.add_axes((0.0, 1.0 - height / HEIGHT, width / WIDTH, height / HEIGHT))
    axes.set_axis_off()
    if isinstance(section, FreeSection):
        values = {"A": section.area, "I": section.second_moment, "Av": section.shear_area}
        words = [named(name, value, system) for name, value in values.items()]
        corner: Any = {"transform": axes.transAxes, "va": "top"}
        axes.text(0.02, 0.97, "\n".join(("Section of any shape", *words)), **corner)
        return []
    sizes = np.ptp(outline(section), axis=0)
    scale = next(own for own in _SCALES if np.all(1e3 * sizes <= own * np.array(_FITS)))
    mm = scale / 1e3
    x, y = 0.5 * width - 1.0, 0.5 * height + 0.5  # of the middle of the section, on paper
    axes.set(xlim=(-x * mm, (width - x) * mm), ylim=(-y * mm, (height - y) * mm))
    axes.text(0.02, 0.99, f"Section 1:{scale:.0f}", transform=axes.transAxes, va="top")
    return draw_section(axes, section, _UNIT * mm, system)
