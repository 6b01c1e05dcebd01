"""The column in elevation, to scale: its parts, what holds it, its mass at the top, the impact."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Rectangle

from pierimpact.pier.arrangement import Support
from pierimpact.pier.column import StruckColumn
from pierimpact.plots.dimension import draw_dimension, named
from pierimpact.plots.style import INK, MUTED, PALE, VERMILION, sheet_figure, to_svg
from pierimpact.units import printed

_CONCRETE, _BURIED = "#dcd8d0", "#efece6"


def draw_elevation(struck: StruckColumn, system: str) -> str:
    """Draw a column with its impact to scale, the travel from left to right; return SVG.

    Parameters
    ----------
    struck : StruckColumn
        The column and where it is struck.
    system : {"SI", "US"}
        Units to print in.
    """
    column = struck.column
    bottom, top = 0.0 - column.embedment, column.height
    widths = [section.extent for section, _, _ in column.stretches]
    widest = max(widths)
    unit = 0.045 * (top - bottom)  # of all gaps
    with sheet_figure(3.4, left=0.0, right=1.0, bottom=0.0, top=1.0) as figure:
        axes = figure.add_subplot()
        axes.set_axis_off()
        axes.set(aspect="equal")
        edge: Any = {"edgecolor": INK, "linewidth": 0.7}
        for section, start, end in column.stretches:
            corner, width = (-0.5 * section.extent, start), section.extent
            axes.add_artist(Rectangle(corner, width, end - start, facecolor=_CONCRETE, **edge))
        if column.embedment:
            corner, width = (-0.5 * widths[0], bottom), widths[0]
            axes.add_artist(Rectangle(corner, width, -bottom, facecolor=_BURIED, **edge))
        reach = 0.5 * widest + 9.0 * unit
        axes.plot([-reach, reach], [0.0, 0.0], color=MUTED, linewidth=0.8)
        axes.fill_between([-reach, reach], -0.35 * unit, 0.0, color=PALE, linewidth=0.0, zorder=0)
        base, above = column.supports
        _draw_support(axes, base, ("kb", "krb"), bottom, -1.0, widths[0], unit, system)
        cap = _draw_cap(axes, column.top_mass, top, widths[-1], unit, system)
        _draw_support(axes, above, ("kt", "krt"), top + cap, 1.0, widths[-1], unit, system)
        _draw_impact(axes, struck, 0.5 * widest, unit, system)
        place = 0.5 * widest + 5.0 * unit
        for low, high, name in ((0.0, top, "H"), (bottom, 0.0, "He")):
            if high > low:
                words = named(name, high - low, system)
                draw_dimension(axes, (place, low), (place, high), words)
        place = 0.5 * widest + 2.5 * unit
        for step in column.steps:
            words = str(printed(step.height, "length", system, given=True))
            draw_dimension(axes, (place, 0.0), (place, step.height), words)
        axes.set_xlim(-0.5 * widest - 11.0 * unit, 0.5 * widest + 11.0 * unit)
        axes.set_ylim(bottom - 5.0 * unit, top + cap + 5.0 * unit)
        return to_svg(figure)


def _draw_impact(axes: Axes, struck: StruckColumn, face: float, unit: float, system: str) -> None:
    """Draw the impact and its height on the left."""
    impact = struck.impact_height
    arrow = {"arrowstyle": "-|>", "color": VERMILION, "linewidth": 1.6, "shrinkB": 0.0}
    axes.annotate("", (-face, impact), (-face - 4.0 * unit, impact), arrowprops=arrow)
    axes.text(-face - 4.2 * unit, impact, "truck", ha="right", va="center", color=VERMILION)
    if impact > 0.0:
        place, words = -face - 2.0 * unit, named("z", impact, system)
        draw_dimension(axes, (place, 0.0), (place, impact), words, "left")


def _draw_cap(axes: Axes, mass: float, top: float, width: float, unit: float, system: str) -> float:
    """Draw a mass at the top; return its height in the drawing, which is not to scale."""
    if not mass:
        return 0.0
    height, half = 1.5 * unit, 0.5 * width + 2.0 * unit
    style: Any = {"facecolor": "white", "edgecolor": INK, "linewidth": 0.7, "linestyle": "--"}
    axes.add_artist(Rectangle((-half, top), 2.0 * half, height, **style))
    axes.text(half + 0.5 * unit, top + 0.5 * height, named("mt", mass, system), va="center")
    return height


def _draw_support(
    axes: Axes,
    support: Support,
    names: tuple[str, str],
    z: float,
    outward: float,
    width: float,
    unit: float,
    system: str,
) -> None:
    """Draw what holds an end: a block where it is fixed, a pin, springs with their stiffness."""
    half, words = 0.5 * width, []
    rigid, turning = math.isinf(support.stiffness), math.isinf(support.rotation_stiffness)
    if rigid or turning:
        block: Any = {"facecolor": "#b4bac0", "edgecolor": "none", "hatch": "////", "zorder": 0.5}
        gap = 0.0 if turning else 0.7 * unit
        corner = (-half - unit, z + outward * gap if outward > 0 else z - gap - 0.7 * unit)
        axes.add_artist(Rectangle(corner, width + 2.0 * unit, 0.7 * unit, **block))
        if not turning:
            pin: Any = {"facecolor": "white", "edgecolor": INK, "linewidth": 0.8}
            axes.add_artist(Circle((0.0, z + outward * 0.35 * unit), 0.35 * unit, **pin))
    if 0.0 < support.stiffness < math.inf:
        x = np.linspace(half, half + 3.0 * unit, 15)
        zigzag = z - outward * 0.6 * unit + 0.3 * unit * np.array([0, *[1, -1] * 6, 0, 0])
        axes.plot(x, zigzag, color=INK, linewidth=0.9)
        axes.plot([x[-1]] * 2, [zigzag[-1] - unit, zigzag[-1] + unit], color=INK, linewidth=1.6)
        words.append(named(names[0], support.stiffness, system))
    if 0.0 < support.rotation_stiffness < math.inf:
        centre = (0.0, z + outward * 0.8 * unit)
        for size in (0.8, 1.3):
            axes.add_artist(
                Arc(centre, size * unit, size * unit, theta1=-30.0, theta2=250.0, color=INK)
            )
        words.append(named(names[1], support.rotation_stiffness, system))
    if words:
        place = (half + 1.6 * unit, z + outward * 1.4 * unit)
        axes.text(*place, "\n".join(words), va="bottom" if outward > 0.0 else "top")
