"""One collision against time: the forces with their regimes and peaks, and the energy."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pierimpact.collision.history import CollisionHistory
from pierimpact.plots.style import (
    BLUE,
    BODIES,
    GREEN,
    INK,
    MUTED,
    ORANGE,
    PIXEL,
    PURPLE,
    SKY,
    VERMILION,
    key,
    note,
    panel,
    round_up,
)
from pierimpact.units import printed, unit_size

_TIME = "Time after first touch [ms]"
_FORCES: dict[str, dict[str, Any]] = {
    "engine spring": {"color": VERMILION, "linewidth": 1.2 * PIXEL},
    "body spring": {"color": BLUE, "linewidth": 1.2 * PIXEL},
    "reaction R": {"color": INK, "linewidth": 2.2 * PIXEL},
}
# The shares of energy from the bottom up: attribute, words, colour.
_SHARES = (
    ("kinetic", "motion", SKY),
    ("pier_elastic", "pier", GREEN),
    ("truck_elastic", "springs", ORANGE),
    ("crush", "crush", "#b0493c"),
    ("friction", "friction", "#a9b1b8"),
    ("damping", "damping", PURPLE),
)
_YIELDING = ("pier_plastic", "yielding", INK)  # one more share where the pier yields


class Regime(NamedTuple):
    """A stretch of time by what presses on the pier."""

    name: str
    start: float
    end: float


def regimes(history: CollisionHistory) -> list[Regime]:
    """Return what presses on the pier and when, in order; times in [s]."""
    time = history.time
    end = float(time[-1])
    contacts = {
        "engine": (history.engine_contact_time, history.engine_force),
        "cargo": (history.cargo_contact_time, history.body_force),
    }
    pressing = np.flatnonzero(history.engine_force + history.body_force > 0.0)
    last = float(time[min(pressing[-1] + 1, len(time) - 1)])
    first = min([start for start, _ in contacts.values() if start is not None], default=last)
    found = [Regime("crumpling", 0.0, first)]
    for name, (start, force) in contacts.items():
        if start is not None:
            gone = time[(time >= start) & (force <= 0.0)]
            found.append(Regime(name, start, float(gone[0]) if len(gone) else end))
    return found


def forces_panel(figure: Figure) -> Axes:
    """Return the axes of `draw_forces`."""
    axes = panel(figure, "Forces", _TIME, "Force [MN]")
    key(axes, _FORCES)
    return axes


def draw_forces(axes: Axes, history: CollisionHistory) -> None:
    """Draw the forces of both springs and the reaction, with the regimes and the peaks."""
    time = 1e3 * history.time
    forces = [1e-6 * f for f in (history.engine_force, history.body_force, history.reaction)]
    top = round_up(1.22 * max(float(force.max()) for force in forces))
    # Downwards in quarters of the height above, which seldom change.
    depth = math.ceil(-4.0 * min(float(forces[-1].min()), 0.0) / top)
    axes.set(xlim=_span(history), ylim=(-0.25 * depth * top, top))
    for name, start, end in regimes(history):
        colour = BODIES.get(name, MUTED)
        axes.axvspan(1e3 * start, 1e3 * end, color=colour, alpha=0.13, linewidth=0.0)
        if 1e3 * (end - start) > 0.016 * len(name) * axes.get_xlim()[1]:
            note(
                axes,
                name,
                (500.0 * (start + end), 0.0),
                (0.0, 4.0 * PIXEL),
                xycoords=("data", "axes fraction"),
                ha="center",
                color=colour,
                fontsize=10.0 * PIXEL,
            )
    for force, line in zip(forces, _FORCES.values(), strict=True):
        axes.plot(time, force, **line)
    mark_peaks(axes, history, "SI", 1e6, BODIES)


def mark_peaks(
    axes: Axes, history: CollisionHistory, system: str, unit: float, colours: Mapping[str, str]
) -> None:
    """Mark the peaks of engine and cargo on the reaction against time, with their values.

    Parameters
    ----------
    axes : Axes
        Where the reaction is drawn.
    history : CollisionHistory
        The collision.
    system : {"SI", "US"}
        Units that the values are printed in.
    unit : float
        Unit of the vertical axis [N].
    colours : mapping
        Colours of "engine" and "cargo".
    """
    for name, peak in history.peaks.items():
        if peak is None:
            continue
        x, y = peak.time / unit_size("time", system), peak.reaction / unit
        late = x > 0.6 * axes.get_xlim()[1]  # no room on the right
        axes.plot([x], [y], "o", color=colours[name], markersize=5.0, zorder=5)
        words = f"{name.capitalize()} peak {printed(peak.reaction, 'force', system)}"
        pale = {"facecolor": "white", "edgecolor": "none", "alpha": 0.6, "pad": 0.5}
        offset, align = ((-6, 5), "right") if late else ((6, 5), "left")
        note(axes, words, (x, y), offset, ha=align, bbox=pale)


def energy_panel(figure: Figure) -> Axes:
    """Return the axes of `draw_energy`."""
    axes = panel(figure, "Energy", _TIME, "Share of the truck’s energy [%]")
    axes.set_ylim(0.0, 100.0)
    _name_shares(axes, _SHARES)
    return axes


def _name_shares(axes: Axes, shares: Sequence[tuple[str, str, str]]) -> None:
    key(
        axes,
        {words: colour for _, words, colour in shares},
        handlelength=0.8,
        handleheight=0.8,
        handletextpad=0.4,
        columnspacing=0.7,
        fontsize=10.0 * PIXEL,
    )


def draw_energy(axes: Axes, history: CollisionHistory) -> None:
    """Draw where the truck's energy is, as shares that add up to all of it."""
    axes.set_xlim(_span(history))
    energy, whole = history.energy, history.collision.energy
    few = np.linspace(0.0, history.time[-1], 250)  # samples are enough for its outlines
    drawn = (*_SHARES, _YIELDING) if history.pier.yields else _SHARES
    if history.pier.yields:
        _name_shares(axes, drawn)
    names, _, colours = zip(*drawn, strict=True)
    shares = [100.0 / whole * np.interp(few, history.time, getattr(energy, n)) for n in names]
    axes.stackplot(1e3 * few, *shares, colors=colours, linewidth=0.0)


def draw_instant(axes: Axes, time: float, reaction: float | None = None) -> None:
    """Mark an instant [s], and where it is on the reaction [N] if that is drawn."""
    axes.axvline(1e3 * time, color=INK, linewidth=PIXEL, dashes=(3, 2))
    if reaction is not None:
        dot: Any = {"color": INK, "markersize": 7.0 * PIXEL, "zorder": 6}
        axes.plot([1e3 * time], [1e-6 * reaction], "o", **dot)


def _span(history: CollisionHistory) -> tuple[float, float]:
    """Return the ends of the time axis [ms], without round-off."""
    return 0.0, round(1e3 * float(history.time[-1]), 3)
