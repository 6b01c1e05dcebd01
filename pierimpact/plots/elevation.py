"""The column in elevation, to scale: its parts, what holds it, its mass at the top, the impact."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Rectangle

from pierimpact.pier.arrangement import Support
from pierimpact.pier.column import StruckColumn
from pierimpact.plots.style import INK, MUTED, PALE, VERMILION, sheet_figure, to_svg
from pierimpact.symbols import SYMBOLS
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
    sections = [column.section, *(step.section for step in column.steps)]
    joints = [bottom, *(step.height for step in column.steps), top]
    widest = max(section.extent for section in sections)
    unit = 0.045 * (top - bottom)  # of all gaps
    with sheet_figure(3.4, left=0.0, right=1.0, bottom=0.0, top=1.0) as figure:
        axes = figure.add_subplot()
        axes.set_axis_off()
        axes.set(aspect="equal")
        edge: Any = {"edgecolor": INK, "linewidth": 0.7}
        for section, start, end in zip(sections, joints, joints[1:], strict=False):
            half = 0.5 * section.extent
            colour: Any = {"facecolor": _CONCRETE, **edge}
            axes.add_artist(Rectangle((-half, start), 2.0 * half, end - start, **colour))
        if column.embedment:
            half = 0.5 * sections[0].extent
            axes.add_artist(
                Rectangle((-half, bottom), 2.0 * half, -bottom, facecolor=_BURIED, **edge)
            )
        reach = 0.5 * widest + 9.0 * unit
        axes.plot([-reach, reach], [0.0, 0.0], color=MUTED, linewidth=0.8)
        axes.fill_between([-reach, reach], -0.35 * unit, 0.0, color=PALE, linewidth=0.0, zorder=0)
        base, above = column.supports
        _draw_support(axes, base, ("kb", "krb"), bottom, -1.0, sections[0].extent, unit, system)
        cap = _draw_cap(axes, column.top_mass, top, sections[-1].extent, unit, system)
        _draw_support(axes, above, ("kt", "krt"), top + cap, 1.0, sections[-1].extent, unit, system)
        _draw_impact(axes, struck, 0.5 * widest, unit, system)
        place = 0.5 * widest + 5.0 * unit
        for low, high, name in ((0.0, top, "H"), (bottom, 0.0, "He")):
            if high > low:
                _dimension(axes, place, low, high, f"${SYMBOLS[name].latex}$", system)
        for step in column.steps:
            _dimension(axes, 0.5 * widest + 2.5 * unit, 0.0, step.height, "", system)
        axes.set_xlim(-0.5 * widest - 11.0 * unit, 0.5 * widest + 11.0 * unit)
        axes.set_ylim(bottom - 5.0 * unit, top + cap + 5.0 * unit)
        return to_svg(figure)


def _draw_impact(axes: Axes, struck: StruckColumn, face: float, unit: float, system: str) -> None:
    """Draw the impact and its height on the left."""
    impact = struck.impact_height
    arrow = {"arrowstyle": "-|>", "color": VERMILION, "linewidth": 1.6, "shrinkB": 0.0}
    axes.annotate("", (-face, impact), (-face - 4.0 * unit, impact), arrowprops=arrow)
    axes.text(-face - 4.2 * unit, impact, "truck", ha="right", va="center", color=VERMILION)
    name = f"${SYMBOLS['z'].latex}$"
    if impact > 0.0:
        _dimension(axes, -face - 2.0 * unit, 0.0, impact, name, system, leftward=True)


def _draw_cap(axes: Axes, mass: float, top: float, width: float, unit: float, system: str) -> float:
    """Draw a mass at the top; return its height in the drawing, which is not to scale."""
    if not mass:
        return 0.0
    height, half = 1.5 * unit, 0.5 * width + 2.0 * unit
    style: Any = {"facecolor": "white", "edgecolor": INK, "linewidth": 0.7, "linestyle": "--"}
    axes.add_artist(Rectangle((-half, top), 2.0 * half, height, **style))
    axes.text(half + 0.5 * unit, top + 0.5 * height, _named("mt", mass, system), va="center")
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
        words.append(_named(names[0], support.stiffness, system))
    if 0.0 < support.rotation_stiffness < math.inf:
        centre = (0.0, z + outward * 0.8 * unit)
        for size in (0.8, 1.3):
            axes.add_artist(
                Arc(centre, size * unit, size * unit, theta1=-30.0, theta2=250.0, color=INK)
            )
        words.append(_named(names[1], support.rotation_stiffness, system))
    if words:
        place = (half + 1.6 * unit, z + outward * 1.4 * unit)
        axes.text(*place, "\n".join(words), va="bottom" if outward > 0.0 else "top")


def _named(name: str, value: float, system: str) -> str:
    shown = str(printed(value, SYMBOLS[name].quantity, system, given=True))
    return f"${SYMBOLS[name].latex}$ = " + shown.replace("\u202f", " ")  # which the font has not


def _dimension(
    axes: Axes,
    x: float,
    low: float,
    high: float,
    name: str,
    system: str,
    *,
    leftward: bool = False,
) -> None:
    """Draw an upright dimension line with its length."""
    arrow: Any = {"arrowstyle": "<|-|>", "mutation_scale": 6.0, "shrinkA": 0.0, "shrinkB": 0.0}
    axes.annotate("", (x, low), (x, high), arrowprops=arrow | {"color": INK, "linewidth": 0.6})
    shown = str(printed(high - low, "length", system, given=True))
    words = f"{name} = {shown}" if name else shown
    offset, align = ((-4.0, 0.0), "right") if leftward else ((4.0, 0.0), "left")
    middle = (x, 0.5 * (low + high))
    axes.annotate(words, middle, offset, textcoords="offset points", ha=align, va="center")
