"""One collision against time, for a page: reaction, contact force, peaks and contacts."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from pierimpact.collision.history import CollisionHistory, Peak
from pierimpact.plots.labels import Label, place
from pierimpact.plots.style import BLUE, INK, PALE, TEXT_WIDTH, page_figure
from pierimpact.plots.svg import to_svg
from pierimpact.plots.words import shown
from pierimpact.units import unit_of, unit_size

Array = NDArray[np.float64]

_REACTION: Any = {"color": BLUE, "linewidth": 1.7}
_CONTACT: Any = {"color": INK, "linewidth": 0.7}
_ROW = 0.7  # height of a bar, over that of its row


def draw_history(history: CollisionHistory, system: str) -> str:
    """Draw reaction and contact force against time, and below when the springs press; return SVG.

    168 × 64 mm. The bars are pale while sheet metal crumples, and dark from when engine or cargo
    meets the pier until it leaves it.

    Parameters
    ----------
    history : CollisionHistory
        The collision.
    system : {"SI", "US"}
        Units to print in.
    """
    ms, force = unit_size("time", system), unit_size("force", system)
    margins = {"left": 15.0, "right": 3.0, "bottom": 8.0, "top": 2.0}
    with page_figure(TEXT_WIDTH, 64.0, **margins, hspace=0.06) as figure:
        axes, strip = figure.subplots(2, 1, sharex=True, height_ratios=(6.0, 1.0))
        until = _end(history)
        part = history.time <= until
        time = history.time[part] / ms
        axes.axhline(0.0, color=INK, linewidth=0.5)
        axes.plot(time, history.contact_force[part] / force, **_CONTACT)
        axes.plot(time, history.reaction[part] / force, **_REACTION)
        axes.set_ylabel(f"Force [{unit_of('force', system)}]")
        axes.set_xlim(0.0, until / ms)
        axes.margins(y=0.16)
        axes.tick_params(axis="x", labelbottom=False)
        labels = [_mark(axes, *found, system) for found in _peaks(history).items()]
        for words, values, line in (
            ("reaction $R$", history.reaction, _REACTION),
            ("contact force", history.contact_force, _CONTACT),
        ):
            points = _along(time, values[part] / force)
            labels.append(Label(axes, words, points, options={"color": line["color"]}))
        place(figure, labels + _draw_contacts(strip, history, system))
        strip.set_xlabel(f"Time after first touch [{unit_of('time', system)}]")
        return to_svg(figure)


def _peaks(history: CollisionHistory) -> dict[str, Peak]:
    """Return the peaks there are, and the lowest reaction where it is below zero."""
    names = {"engine": history.before_cargo, "cargo": "cargo"}
    peaks = {f"{names[name].capitalize()} peak": own for name, own in history.peaks.items() if own}
    lowest = history.lowest
    if lowest.reaction < 0.0:
        # It may lie beyond what was followed.
        peaks["Lowest" if lowest.time < history.time[-1] else "Lowest so far"] = lowest
    return peaks


def _end(history: CollisionHistory) -> float:
    """Return the time up to which a collision is drawn: a little beyond all that happens [s]."""
    forces = (history.engine_force, history.body_force)
    last = max(
        *(peak.time for peak in _peaks(history).values()),
        *(float(history.time[force > 0.0].max(initial=0.0)) for force in forces),
    )
    return min(1.05 * last, float(history.time[-1]))


def _mark(axes: Axes, name: str, peak: Peak, system: str) -> Label:
    point = peak.time / unit_size("time", system), peak.reaction / unit_size("force", system)
    axes.plot(*point, "o", color=BLUE, markersize=4.0, zorder=5)
    words = f"{name} {shown(peak.reaction, 'force', system)}\nat {shown(peak.time, 'time', system)}"
    return Label(axes, words, point, (1.0, 1.0 if peak.reaction > 0.0 else -1.0))


def _along(time: Array, values: Array) -> Array:
    """Return points of a curve that a name may stand beside: where it is away from zero."""
    far = np.flatnonzero(np.abs(values) > 0.15 * np.max(np.abs(values)))
    some = far[np.unique(np.linspace(0, len(far) - 1, 20).astype(int))]
    return np.stack((time[some], values[some]), axis=-1)


def _draw_contacts(axes: Axes, history: CollisionHistory, system: str) -> list[Label]:
    """Draw when each spring presses on the pier; return the words for when a body meets it."""
    axes.set(ylim=(1.5, -0.5))
    axes.set_yticks((0, 1), ("engine", "cargo"))
    axes.tick_params(axis="y", length=0.0)
    labels, ms = [], unit_size("time", system)
    for row, (force, met) in enumerate(
        (
            (history.engine_force, history.engine_contact_time),
            (history.body_force, history.cargo_contact_time),
        )
    ):
        contacts = [] if met is None else _stretches(history.time, force, met)
        crumples = _stretches(history.time, force, 0.0)
        for bars, colour in ((crumples, PALE), (contacts, INK)):
            for start, end in bars:
                place = row, (end - start) / ms, _ROW, start / ms
                axes.barh(*place, color=colour, edgecolor=INK, linewidth=0.5)
        words = "no contact"
        if contacts:
            ends = (f"{value / ms:.1f}" for value in contacts[0])
            words = "–".join(ends) + f" {unit_of('time', system)}"
            words += f", and {len(contacts) - 1} more" if len(contacts) > 1 else ""
        last = (contacts or crumples)[-1][1]
        labels.append(Label(axes, words, (last / ms, row), (1.0, 0.0)))
    return labels


def _stretches(time: Array, force: Array, start: float) -> list[tuple[float, float]]:
    """Return the stretches of time, not before a start, in which there is a force."""
    presses = np.concatenate(([False], (force > 0.0) & (time >= start), [False]))
    ends = np.flatnonzero(np.diff(presses.astype(int)))
    last = len(time) - 1
    return [(float(time[i]), float(time[min(j, last)])) for i, j in ends.reshape(-1, 2)]
