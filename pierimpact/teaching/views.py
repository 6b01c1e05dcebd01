"""The explorers' figures, each one SVG, and the sentences beside them."""

import html
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from pierimpact.teaching.chart import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PALE,
    PURPLE,
    SKY,
    VERMILION,
    Panel,
    canvas,
    figure,
    text,
)
from pierimpact.teaching.scenario import Strike
from pierimpact.units import printed

#: One colour a body, in every view: the engine, the body with its cargo, and the pier.
BODIES = {"engine": VERMILION, "cargo": BLUE}

_SHARES = (
    ("kinetic", "in motion", SKY),
    ("pier_elastic", "pier", GREEN),
    ("truck_elastic", "springs", ORANGE),
    ("crush", "crush", "#b0493c"),
    ("friction", "friction", GREY),
    ("damping", "damping", PURPLE),
)


def force(value: float) -> str:
    """Return a force as it is printed."""
    return str(printed(value, "force", "SI"))


def milliseconds(value: float) -> str:
    """Return a time as it is printed."""
    return str(printed(value, "time", "SI"))


def round_up(value: float) -> float:
    """Return the next round number, as the end of an axis."""
    unit = 10.0 ** math.floor(math.log10(value))
    return next(
        unit * n for n in (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
        if unit * n >= value * 0.999
    )  # fmt: skip


class TimePanels:
    """Forces and energy against time, and the instant that the picture shows.

    Parameters
    ----------
    strike : Strike
        The collision.
    beside : bool
        Whether the energy stands beside the forces, or else below them.
    """

    def __init__(self, strike: Strike, *, beside: bool) -> None:
        self.strike = strike
        self.time = 1e3 * strike.history.time
        self.forces, self.energy = self._forces(), self._energy()
        self.shift = (self.forces.width, 0.0) if beside else (0.0, self.forces.height)
        self.width = self.forces.width + self.shift[0]
        self.height = self.forces.height + self.shift[1] + 20.0

    def svg(self) -> str:
        """Draw both panels."""
        keys, x = "", 50.0
        for _, words, colour in _SHARES:
            keys += f'<rect x="{x:g}" y="216" width="10" height="9" fill="{colour}"/>'
            keys += text(x + 13.0, 224.0, words, INK, 10.5)
            x += 20.0 + 5.5 * len(words)
        content = (
            f'<rect width="{self.width:g}" height="{self.height:g}" fill="white"/>'
            f'{self.forces.svg()}<g transform="translate({self.shift[0]:g} {self.shift[1]:g})">'
            f"{self.energy.svg()}{keys}</g>"
        )
        return canvas(self.width, self.height, content, f"Forces. {outcome(self.strike)}")

    def cursor(self, at: float) -> str:
        """Draw the instant `at` [s] for laying over the panels."""
        x = float(self.forces.x(1e3 * at))
        y = float(self.forces.y(1e-6 * self.strike.reaction(at)))
        _, top, _, bottom = self.forces.frame
        right, down = self.shift
        content = (
            f'<path d="M{x:.1f} {top:g}V{bottom:g}M{x + right:.1f} {top + down:g}'
            f'V{bottom + down:g}" stroke="{INK}" stroke-width="1" stroke-dasharray="3 2"/>'
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{INK}"/>'
        )
        return canvas(self.width, self.height, content)

    def _forces(self) -> Panel:
        history = self.strike.history
        engine, body, reaction = (
            1e-6 * x for x in (history.engine_force, history.body_force, history.reaction)
        )
        highest = max(float(x.max()) for x in (engine, body, reaction))
        lowest = min(float(reaction.min()), 0.0)
        top = round_up(1.12 * highest)
        panel = Panel(
            title="Forces",
            x_label="Time after first touch [ms]",
            y_label="Force [MN]",
            x_range=(0.0, float(self.time[-1])),
            y_range=(top / 4.0 * math.floor(4.0 * lowest / top), top),
        )
        for name, start, end in regimes(self.strike):
            panel.band(1e3 * start, 1e3 * end, BODIES.get(name, GREY), name)
        panel.line(self.time, engine, VERMILION, "engine spring", width=1.2)
        panel.line(self.time, body, BLUE, "body spring", width=1.2)
        fine = np.linspace(0.0, history.time[-1], 801)
        panel.line(1e3 * fine, 1e-6 * self.strike.reaction(fine), INK, "reaction R", width=2.2)
        for name, peak in (("engine", history.engine_peak), ("cargo", history.cargo_peak)):
            if peak is not None:
                panel.mark(1e3 * peak.time, 1e-6 * peak.reaction, BODIES[name],
                           force(peak.reaction))  # fmt: skip
        return panel

    def _energy(self) -> Panel:
        shares = self.strike.history.energy
        whole = 0.5 * self.strike.truck.mass * self.strike.speed**2
        panel = Panel(
            title=f"Energy: where the truck’s {1e-6 * whole:.3g} MJ are",
            x_label="Time after first touch [ms]",
            y_label="Share [%]",
            x_range=(0.0, float(self.time[-1])),
            y_range=(0.0, 100.0),
        )
        below = np.zeros_like(self.time)
        few = _few(len(self.time))
        for name, _, colour in _SHARES:
            above = below + 100.0 * getattr(shares, name) / whole
            panel.area(self.time[few], below[few], above[few], colour)
            below = above
        return panel


def regimes(strike: Strike) -> list[tuple[str, float, float]]:
    """Return what presses on the pier and when: (name, start, end) in order [s]."""
    history = strike.history
    time = history.time
    found = []
    end = float(time[-1])
    contacts = {
        "engine": (history.engine_contact_time, history.engine_force),
        "cargo": (history.cargo_contact_time, history.body_force),
    }
    first = min([start for start, _ in contacts.values() if start is not None], default=end)
    found.append(("crumpling", 0.0, first))
    for name, (start, spring) in contacts.items():
        if start is not None:
            later = time >= start
            gone = time[later & (spring <= 0.0)]
            found.append((name, start, float(gone[0]) if len(gone) else end))
    return found


def spectra_figure(strike: Strike) -> str:
    """Draw the peaks of engine and cargo against pier frequency, with this pier's place."""
    spectra, history = strike.curves, strike.history
    frequency = strike.pier.frequency
    low = min(spectra.frequency[0], frequency / 1.1)
    high = max(spectra.frequency[-1], frequency * 1.1)
    peaks = {"engine": history.engine_peak, "cargo": history.cargo_peak}
    rows = []
    for name, colour in BODIES.items():
        full, reduced = spectra.full[name], spectra.reduced[name]
        peak = peaks[name]
        known = [*full[np.isfinite(full)], *reduced[np.isfinite(reduced)]]
        highest = max([*known, peak.reaction if peak else 0.0, 1e5])
        panel = Panel(
            title=f"{name.capitalize()} peak",
            x_label="Pier frequency f_p [Hz], at this pier’s mass and damping",
            y_label="Peak reaction [MN]",
            x_range=(low, high),
            y_range=(0.0, round_up(1.2e-6 * highest)),
            x_log=True,
            height=220.0,
        )
        panel.upright(frequency, PALE)
        if np.isfinite(full).any() or np.isfinite(reduced).any():
            panel.line(spectra.frequency, 1e-6 * full, colour, "full model")
            panel.line(
                spectra.frequency,
                1e-6 * reduced,
                INK,
                "two-degree formula",
                width=1.2,
                dash="5 3",
            )
        else:
            panel.note(f"The {name} does not reach the pier at this speed.")
        if peak is not None:
            panel.mark(
                frequency, 1e-6 * peak.reaction, colour, force(peak.reaction), ring=True,
                name_on_top=True,
            )  # fmt: skip
        rows.append([panel])
    return figure(rows, f"Spectra of engine and cargo peaks. {outcome(strike)}")


def outcome(strike: Strike) -> str:
    """Say in sentences what the collision did."""
    history = strike.history
    engine, cargo = history.engine_peak, history.cargo_peak
    if history.engine_contact_time is None and cargo is None:
        return (
            f"Neither engine nor cargo reaches the pier: the sheet metal in front of them stops "
            f"the truck. The largest reaction is {force(engine.reaction)}, after "
            f"{milliseconds(engine.time)}."
        )
    words = f"Engine peak {force(engine.reaction)} after {milliseconds(engine.time)}"
    if history.engine_contact_time is None:
        words = (
            f"The engine stops short of the pier; peak before the cargo {force(engine.reaction)}"
        )
    if cargo is None:
        return f"{words}. The cargo stops short of the pier: it has no peak."
    words += f"; cargo peak {force(cargo.reaction)} after {milliseconds(cargo.time)}. "
    name = "cargo" if history.governing_peak == cargo else "engine"
    return f"{words}The {name} governs."


def readout(strike: Strike) -> str:
    """Return the numbers of the pier and of the collision, as HTML."""
    pier, history = strike.pier, strike.history
    items = [
        ("f_p", printed(pier.frequency, "frequency", "SI"), "pier frequency"),
        ("k_p", printed(pier.stiffness, "stiffness", "SI"), "pier stiffness"),
        ("m_p", printed(pier.mass, "mass", "SI"), "pier mass"),
        ("Engine peak", force(history.engine_peak.reaction), "largest reaction before the cargo"),
        (
            "Cargo peak",
            force(history.cargo_peak.reaction) if history.cargo_peak else "none",
            "largest reaction from cargo contact on",
        ),
    ]
    return table_line(items) + sentence(outcome(strike))


def table_line(items: Sequence[tuple[str, Any, str]]) -> str:
    """Return named numbers side by side, as HTML."""
    cells = "".join(
        f'<div title="{html.escape(hint)}" style="padding:2px 18px 2px 0">'
        f'<div style="font-size:11px;color:{GREY}">{_subscripts(name)}</div>'
        f'<div style="font-size:16px;font-weight:600;color:{INK};white-space:nowrap">'
        f"{html.escape(str(value))}</div></div>"
        for name, value, hint in items
    )
    return f'<div style="display:flex;flex-wrap:wrap;line-height:1.35">{cells}</div>'


def sentence(words: str) -> str:
    """Return a sentence as HTML."""
    return f'<div style="color:{INK};line-height:1.45;padding:3px 0">{html.escape(words)}</div>'


def refusal(words: str) -> str:
    """Return, as HTML, the sentence that stands where a figure would be."""
    return (
        f'<div role="alert" style="border-left:4px solid {ORANGE};background:#fff8ec;color:{INK};'
        f'padding:14px 16px;line-height:1.45">{html.escape(words)}</div>'
    )


def _subscripts(name: str) -> str:
    head, mark, index = html.escape(name).partition("_")
    return f"<i>{head}</i><sub>{index}</sub>" if mark else head


def _few(count: int, most: int = 240) -> np.ndarray[Any, np.dtype[np.intp]]:
    """Return places of at most `most` samples, first and last among them."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).astype(int))
