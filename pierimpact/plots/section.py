"""The section of the column in plan: outline, hole or steel, dimensions and travel."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Polygon
from numpy.typing import NDArray

from pierimpact.pier.sections import RegularPolygonSection, Section
from pierimpact.plots.dimension import draw_dimension
from pierimpact.plots.labels import Label
from pierimpact.plots.style import INK, MUTED, VERMILION
from pierimpact.plots.words import named

_CONCRETE, _STEEL = "#dcd8d0", "#5b7083"


def draw_section(axes: Axes, section: Section, unit: float, system: str) -> list[Label]:
    """Draw a section about zero, its dimensions and the direction of travel; return its labels.

    Parameters
    ----------
    axes : Axes
        Axes in metres.
    section : Section
        A section with an outline: any but a `FreeSection`.
    unit : float
        Size of gaps [m].
    system : {"SI", "US"}
        Units to print in.
    """
    values, depth, outer = section.values, section.extent, outline(section)
    width = float(np.ptp(outer[:, 1]))
    edge: Any = {"edgecolor": INK, "linewidth": 0.7}
    filled, labels = "Am" in values, []
    axes.add_artist(Polygon(outer, facecolor=_STEEL if filled else _CONCRETE, **edge))
    if "t" in values:
        inner = outline(section, values["t"])
        axes.add_artist(Polygon(inner, facecolor=_CONCRETE if filled else "white", **edge))
        wall = 0.5 * width - 0.5 * values["t"]
        point = (0.5 * wall, 0.75**0.5 * wall) if "D" in values else (0.25 * depth, wall)
        axes.plot(*point, ".", color="white" if filled else INK, markersize=2.5)
        labels.append(Label(axes, named("t", values["t"], system), point))
    along = next(name for name in ("D", "h", "Df") if name in values)
    half, below = 0.5 * values[along], -0.5 * width - unit
    draw_dimension(axes, (-half, below), (half, below), "")
    labels.insert(0, Label(axes, named(along, values[along], system), (0.0, below), (0.0, -1.0)))
    if "b" in values:
        half, beside = 0.5 * values["b"], 0.5 * depth + unit
        draw_dimension(axes, (beside, -half), (beside, half), "")
        words, turned = named("b", values["b"], system), {"rotation": 90.0}
        labels.insert(0, Label(axes, words, (beside, 0.0), (1.0, 0.0), turned))
    if isinstance(section, RegularPolygonSection) and section.sides % 2:
        inscribed = 0.5 * section.across_flats
        dotted: Any = {"fill": False, "edgecolor": MUTED, "linestyle": ":", "linewidth": 0.8}
        axes.add_artist(Circle((0.0, 0.0), inscribed, **dotted))
    face = float(outer[:, 0].min())
    arrow = {"arrowstyle": "-|>", "color": VERMILION, "linewidth": 1.6, "shrinkB": 0.0}
    axes.annotate("", (face - 0.3 * unit, 0.0), (face - 4.0 * unit, 0.0), arrowprops=arrow)
    middle, colour = (face - 2.2 * unit, 0.0), {"color": VERMILION}
    return [*labels, Label(axes, "travel", middle, (0.0, 1.0), colour)]


def outline(section: Section, inset: float = 0.0) -> NDArray[np.float64]:
    """Return the outline of a section about its centre, along and across the travel.

    Parameters
    ----------
    section : Section
        The section.
    inset : float, optional
        Distance of the outline within that of the section [m].

    Returns
    -------
    ndarray, shape (n, 2)
        Corners, and points along curves [m].
    """
    values, turn = section.values, np.linspace(0.0, 2.0 * np.pi, 240, endpoint=False)
    if isinstance(section, RegularPolygonSection):  # the struck face on the left
        return np.asarray(section.corners[:, ::-1] * (-1.0, 1.0))
    if "D" in values:
        return (0.5 * values["D"] - inset) * np.array([np.cos(turn), np.sin(turn)]).T
    half = 0.5 * np.array([values["h"], values["b"]]) - inset
    if "r" in values:
        ends = np.array([np.cos(turn), np.sin(turn)]).T
        return np.asarray(values["r"] * ends + np.sign(ends.round(9)) * (half - values["r"]))
    corners = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
    return np.asarray(half * corners)
