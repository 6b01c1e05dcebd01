"""The column in elevation, to scale: its parts, what holds it, and its mass at the top."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Rectangle

from pierimpact.pier.arrangement import Support
from pierimpact.pier.column import PierColumn
from pierimpact.plots.labels import Label
from pierimpact.plots.style import INK
from pierimpact.plots.words import named, shown

_BEYOND = 2.0  # of a mass at the top on either side of the column, as drawn, over `unit`
_CONCRETE, _BURIED, _SOIL = "#dcd8d0", "#efece6", "#b4bac0"


def widest(column: PierColumn) -> float:
    """Return the largest extent of a column in the direction of travel [m]."""
    return max(section.extent for section, _, _ in column.stretches)


def draw_ground(axes: Axes, left: float, right: float, unit: float) -> None:
    """Draw the ground from one place to another [m]."""
    axes.plot([left, right], [0.0, 0.0], color=INK, linewidth=0.9, zorder=0.8)
    for x in np.arange(left, right - 0.6 * unit, 1.2 * unit):
        axes.plot([x, x + 0.6 * unit], [-0.5 * unit, 0.0], color=INK, linewidth=0.4, zorder=0.2)


def draw_column(axes: Axes, column: PierColumn, unit: float, system: str) -> list[Label]:
    """Draw a column about x = 0, what holds it and its mass at the top; return its labels.

    Parameters
    ----------
    axes : Axes
        Axes in metres, with their limits set.
    column : PierColumn
        The column.
    unit : float
        Size of supports and gaps [m].
    system : {"SI", "US"}
        Units to print in.
    """
    edge: Any = {"edgecolor": INK, "linewidth": 0.7}
    for section, start, end in column.stretches:
        for low, high, colour in (
            (start, min(end, 0.0), _BURIED),
            (max(start, 0.0), end, _CONCRETE),
        ):
            if high > low:
                corner = (-0.5 * section.extent, low)
                axes.add_artist(
                    Rectangle(corner, section.extent, high - low, facecolor=colour, **edge)
                )
    labels = [
        Label(axes, shown(step.height, "length", system, given=True), (x, step.height), (side, 0.0))
        for step in column.steps
        for side, x in [(1.0, 0.5 * step.section.extent)]
    ]
    (first, bottom, _), (last, _, top) = column.stretches[0], column.stretches[-1]
    base, above = column.supports
    cap, words = _draw_cap(axes, column.top_mass, top, last.extent, unit, system)
    labels += words
    labels += _draw_support(axes, base, ("kb", "krb"), bottom, -1.0, first.extent, unit, system)
    width = last.extent + (2.0 * _BEYOND * unit if cap else 0.0)
    labels += _draw_support(axes, above, ("kt", "krt"), top + cap, 1.0, width, unit, system)
    return labels


def _draw_cap(
    axes: Axes, mass: float, top: float, width: float, unit: float, system: str
) -> tuple[float, list[Label]]:
    """Draw a mass at the top; return its height as drawn, not to scale, and its label."""
    if not mass:
        return 0.0, []
    height, half = 1.5 * unit, 0.5 * width + _BEYOND * unit
    style: Any = {"facecolor": "white", "edgecolor": INK, "linewidth": 0.7, "linestyle": "--"}
    axes.add_artist(Rectangle((-half, top), 2.0 * half, height, **style))
    point = (half, top + 0.5 * height)
    return height, [Label(axes, named("mt", mass, system), point, (1.0, 0.0))]


def _draw_support(
    axes: Axes,
    support: Support,
    names: tuple[str, str],
    z: float,
    outward: float,
    width: float,
    unit: float,
    system: str,
) -> list[Label]:
    """Draw what holds an end: a block where it is fixed, a pin, springs; return their labels."""
    half, labels = 0.5 * width, []
    rigid, turning = math.isinf(support.stiffness), math.isinf(support.rotation_stiffness)
    springs = 0.0 < support.rotation_stiffness < math.inf
    if rigid or turning:
        block: Any = {"facecolor": "white", "edgecolor": INK, "linewidth": 0.5, "hatch": "//////"}
        gap = 0.0 if turning else 1.7 * unit if springs else 0.7 * unit
        corner = (-half - unit, z + outward * gap if outward > 0 else z - gap - 0.7 * unit)
        axes.add_artist(Rectangle(corner, width + 2.0 * unit, 0.7 * unit, zorder=0.9, **block))
        if not (turning or springs):
            pin: Any = {"facecolor": "white", "edgecolor": INK, "linewidth": 0.8}
            axes.add_artist(Circle((0.0, z + outward * 0.35 * unit), 0.35 * unit, **pin))
    if 0.0 < support.stiffness < math.inf:
        x = np.linspace(-half, -half - 3.0 * unit, 15)
        zigzag = z - outward * 0.6 * unit + 0.3 * unit * np.array([0, *[1, -1] * 6, 0, 0])
        axes.plot(x, zigzag, color=INK, linewidth=0.9)
        axes.plot([x[-1]] * 2, [zigzag[-1] - unit, zigzag[-1] + unit], color=INK, linewidth=1.6)
        words = named(names[0], support.stiffness, system)
        labels.append(Label(axes, words, (x[-1], zigzag[-1]), (-1.0, 0.0)))
    if springs:
        centre = (0.0, z + outward * 0.8 * unit)
        for size in (0.8, 1.3):
            arc = Arc(centre, size * unit, size * unit, theta1=-30.0, theta2=250.0, color=INK)
            axes.add_artist(arc)
        words = named(names[1], support.rotation_stiffness, system)
        labels.append(Label(axes, words, (0.65 * unit, centre[1]), (1.0, outward)))
    return labels
