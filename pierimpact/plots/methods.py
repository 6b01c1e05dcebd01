"""The forces by every method, over speed and over mass."""

from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pierimpact.design.methods import (
    ENERGY_CHECK,
    HARD_IMPACT,
    HERTZ_IMPACT,
    PLASTIC_IMPACT,
    WINDOW,
    Comparison,
)
from pierimpact.plots import style
from pierimpact.plots.style import PIXEL

Array: TypeAlias = NDArray[np.float64]

_TICKS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500)
_CODE: Any = {"color": style.MUTED, "linewidth": 1.2 * PIXEL, "dashes": (4, 2.5)}
_LEAST = 1e5  # that is drawn [N]
_DENSITY = 1.5  # dots to a pixel
_APART = 13.0  # height of a name [px]


class Line(NamedTuple):
    """One line of the figure."""

    name: str
    force: Array  #: shape (n,) [N]
    look: dict[str, Any]


def methods_figure(over_speed: Comparison, over_mass: Comparison) -> Figure:
    """Return the figure: forces over speed and over mass, each line named at its end.

    Parameters
    ----------
    over_speed, over_mass : Comparison
        Arrays of shape (n,), the speed or the mass of which rises.
    """
    with rc_context(style.SCREEN):
        figure = Figure(figsize=(9.6, 8.4), dpi=96.0 * _DENSITY)
        panels = figure.subplots(2, 1, sharey=True)
        figure.subplots_adjust(left=0.065, right=0.69, bottom=0.06, top=0.965, hspace=0.24)
        mass, speed = 1e-3 * over_speed.mass[0], 3.6 * over_mass.speed[0]
        panels[0].set(title=f"A truck of {mass:g} t", xlabel="Speed [km/h]")
        panels[1].set(title=f"A truck at {speed:g} km/h", xlabel="Mass of the truck [t]")
        lines = [_lines(found) for found in (over_speed, over_mass)]
        forces = np.concatenate([line.force for each in lines for line in each])
        least = float(np.min(forces[forces > 0.0]))
        panels[0].set(yscale="log", ylim=(max(0.7 * least, _LEAST), 1.4 * np.max(forces)))
        for axes, x, each in zip(
            panels, (3.6 * over_speed.speed, 1e-3 * over_mass.mass), lines, strict=True
        ):
            _draw(axes, x, each)
        return figure


def _lines(found: Comparison) -> list[Line]:
    thick = {"linewidth": 2.6 * PIXEL}
    average = f"Full model: contact force, {1e3 * WINDOW:g} ms average"
    lines = [
        Line("Full model: peak reaction", found.peak_reaction, {"color": style.BLUE} | thick),
        Line(average, found.average_force, {"color": style.SKY} | thick),
        Line(HERTZ_IMPACT.name, found.hertz, {"color": style.VERMILION}),
        Line(ENERGY_CHECK.name, found.energy_reaction, {"color": style.PURPLE}),
        Line(f"{HARD_IMPACT.name} (JCSS)", found.hard, {"color": style.GREEN}),
        Line(f"{PLASTIC_IMPACT.name} (JCSS)", found.plastic, {"color": style.ORANGE}),
    ]
    names: dict[float, list[str]] = {}  # codes of the same force share a line
    for code in found.codes:
        unverified = "" if code.along.verified else " (unverified)"
        names.setdefault(code.along.value, []).append(code.code + unverified)
    return lines + [
        Line("\n".join(words), np.full_like(found.speed, force), _CODE)
        for force, words in names.items()
    ]


def _draw(axes: Axes, x: Array, lines: Sequence[Line]) -> None:
    low, high = axes.get_ylim()
    for line in lines:
        axes.plot(x, np.where(line.force > 0.0, line.force, np.nan), **line.look)
    ticks = [tick for tick in _TICKS if low < 1e6 * tick < high]
    axes.set_yticks([1e6 * tick for tick in ticks], [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set(ylabel="Force [MN]", xlim=(x[0], x[-1]), ylim=(low, high))
    _name(axes, lines, np.clip([line.force[-1] for line in lines], low, high))


def _name(axes: Axes, lines: Sequence[Line], ends: Array) -> None:
    """Name the lines beside their ends [N], none over another, with a leader to each."""
    shift = axes.transData.transform([(axes.get_xlim()[1], end) for end in ends])[:, 1]
    sizes = np.array([_APART * _DENSITY * (1 + line.name.count("\n")) for line in lines])
    places = axes.transData.inverted().transform([(0.0, y) for y in _spread(shift, sizes)])[:, 1]
    beside: Any = {"transform": axes.get_yaxis_transform(), "clip_on": False}
    for line, end, place in zip(lines, ends, places, strict=True):
        colour = line.look["color"]
        axes.plot([1.0, 1.03], [end, place], color=colour, linewidth=PIXEL, **beside)
        axes.text(1.04, place, line.name, color=colour, va="center", **beside)


def _spread(wanted: Array, sizes: Array) -> Array:
    """Return places as near to those wanted as may be, at which things of these sizes are apart."""
    blocks: list[tuple[list[int], float]] = []  # things that touch, and where the first begins
    for number in np.argsort(wanted, kind="stable").tolist():
        members, start = [number], float(wanted[number] - 0.5 * sizes[number])
        while blocks and blocks[-1][1] + sizes[blocks[-1][0]].sum() > start:
            members = blocks.pop()[0] + members
            start = float(np.mean(wanted[members] - _middles(sizes[members])))
        blocks.append((members, start))
    places = np.empty_like(wanted)
    for members, start in blocks:
        places[members] = start + _middles(sizes[members])
    return places


def _middles(sizes: Array) -> Array:
    return np.asarray(np.cumsum(sizes) - 0.5 * sizes)
