"""The numbers of the explorers, and the sentences that say what their figures show."""

import html
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pierimpact.plots.schematic import Frame
from pierimpact.plots.style import BODIES, INK, MUTED, ORANGE
from pierimpact.teaching import theory
from pierimpact.teaching.scenario import Scenario
from pierimpact.units import printed


def force(value: float) -> str:
    """Return a force as it is printed."""
    return str(printed(value, "force", "SI"))


def milliseconds(value: float) -> str:
    """Return a time as it is printed."""
    return str(printed(value, "time", "SI"))


def outcome(scenario: Scenario) -> str:
    """Say in sentences what the collision did."""
    history = scenario.history
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


def instant(frame: Frame, phase: str) -> str:
    """Return what goes on at one instant of a collision, as HTML."""
    return (
        f'<div style="color:{INK};line-height:1.45;font-size:14px">'
        f'<b style="font-size:16px;padding-right:14px">{1e3 * frame.time:.1f} ms</b>'
        f"{html.escape(phase)} R = {force(frame.reaction)}.</div>"
    )


def collision_readout(scenario: Scenario) -> str:
    """Return the numbers of the pier and of the collision, as HTML."""
    pier, history = scenario.pier, scenario.history
    items = [
        ("f_p", printed(pier.frequency, "frequency", "SI"), "pier frequency"),
        ("k_p", printed(pier.stiffness, "stiffness", "SI"), "pier stiffness"),
        ("m_p", printed(pier.mass, "mass", "SI"), "pier mass"),
        ("Truck’s energy", printed(scenario.collision.energy, "energy", "SI"), "½ (m₁ + m₂) V²"),
        ("Engine peak", force(history.engine_peak.reaction), "largest reaction before the cargo"),
        (
            "Cargo peak",
            force(history.cargo_peak.reaction) if history.cargo_peak else "none",
            "largest reaction from cargo contact on",
        ),
    ]
    return _table_line(items) + _sentence(outcome(scenario))


def shape_words(scenario: Scenario) -> str:
    """Say what share of the column takes part."""
    column = scenario.column
    struck = column.struck_at(scenario.impact_height)
    whole = column.mass_per_length * column.height
    shear = struck.shear_deflection / struck.impact_deflection
    return (
        f"The pier moves as if {struck.mass / whole:.0%} of the column’s mass sat at the impact "
        f"height. Shear makes {shear:.0%} of the deflection there, flexure the rest."
    )


def shape_readout(scenario: Scenario) -> str:
    """Return the numbers of Eqs 1–3, as HTML."""
    column = scenario.column
    pier = scenario.pier
    whole = column.mass_per_length * column.height
    items = [
        ("k_p", printed(pier.stiffness, "stiffness", "SI"), "stiffness, Eq. 3"),
        ("m_p", printed(pier.mass, "mass", "SI"), "equivalent mass, Eq. 1"),
        ("f_p", printed(pier.frequency, "frequency", "SI"), "frequency √(k_p/m_p)/2π"),
        ("Whole column", printed(whole, "mass", "SI"), "mass per length times height"),
    ]
    return _table_line(items) + _sentence(shape_words(scenario))


def amplification_words(scenario: Scenario, values: dict[str, float]) -> str:
    """Say how the reduction compares with the full model."""
    history = scenario.history
    peaks = {"engine": history.engine_peak, "cargo": history.cargo_peak}
    words = []
    for i, (body, peak) in enumerate(peaks.items(), 1):
        reaction = values[f"R{i}"]
        if math.isnan(reaction) or peak is None:
            words.append(f"The {body} makes no spike.")
            continue
        ratio = reaction / peak.reaction
        words.append(
            f"S of the {body} is {values[f'S{i}']:.3f}, and gives {ratio:.2f} of the full "
            "model’s peak."
        )
    return " ".join(words)


def amplification_readout(scenario: Scenario, values: dict[str, float]) -> str:
    """Return the steps from contact speed to reaction beside the full model's, as HTML."""
    history = scenario.history
    peaks = {"engine": history.engine_peak, "cargo": history.cargo_peak}
    rows = ""
    for i, (body, colour) in enumerate(BODIES.items(), 1):
        reaction, peak = values[f"R{i}"], peaks[body]
        cells = [
            str(printed(values[f"v{i}"], "speed", "SI")),
            f"{values[f'mu{i}']:.3f}",
            f"{values[f'e{i}']:.3f}",
            f"{values[f'beta{i}']:.3f}",
            f"{values[f'S{i}']:.3f}",
            "none" if math.isnan(reaction) else force(reaction),
            "none" if peak is None else force(peak.reaction),
        ]
        rows += (
            f'<tr><th style="text-align:left;color:{colour};padding:2px 14px 2px 0">{body}</th>'
            + "".join(f'<td style="text-align:right;padding:2px 10px">{c}</td>' for c in cells)
            + "</tr>"
        )
    heads = ("", "contact speed", "μ", "e", "β", "S", "two degrees of freedom", "full model")
    head = "".join(
        f'<th style="text-align:right;font-weight:400;color:{MUTED};padding:2px 10px">{h}</th>'
        for h in heads
    )
    table = f'<table style="border-collapse:collapse;font-size:13px">{head}{rows}</table>'
    return table + _sentence(amplification_words(scenario, values))


def design_words(scenario: Scenario) -> str:
    """Say what the design procedure found."""
    design = scenario.design()
    ratio = design.reaction / scenario.history.governing_peak.reaction
    return (
        f"Design reaction {force(design.reaction)}, {ratio:.2f} of the full model’s. "
        f"The {design.governs} governs."
    )


def design_readout(scenario: Scenario) -> str:
    """Return what the design procedure found, with its warnings, as HTML."""
    design = scenario.design()
    cargo = "none" if design.cargo is None else force(design.cargo)
    items = [
        ("f_p", printed(scenario.pier.frequency, "frequency", "SI"), "pier frequency"),
        ("Design, engine", force(design.engine), "refined level"),
        ("Design, cargo", cargo, "refined level"),
        ("Design reaction", force(design.reaction), "the larger of the two"),
    ]
    warned = "".join(
        f'<div style="color:#8a5300">{html.escape(words)}.</div>' for words in design.warnings
    )
    return _table_line(items) + _sentence(design_words(scenario)) + warned


def influence_words(changes: dict[str, NDArray[np.float64] | None]) -> str:
    """Say which parameter moves each peak most."""
    words = []
    for body, change in changes.items():
        if change is None:
            words.append(f"The {body} does not reach the pier, and has no peak to change.")
            continue
        largest = np.where(np.isfinite(change), np.abs(change), np.inf).max(axis=1)
        most = int(np.argmax(largest))
        name = theory.PARAMETERS[most].partition(" $")[0]
        name = name.replace(": ", "’s ").lower() if ":" in name else name.lower()
        how = "makes it vanish" if np.isinf(largest[most]) else f"by {largest[most]:.0%}"
        words.append(f"The {body} peak changes most with the {name}: {how}.")
    return " ".join(words)


def influence_readout(scenario: Scenario, changes: dict[str, NDArray[np.float64] | None]) -> str:
    """Return the numbers of the collision and what moves its peaks most, as HTML."""
    return collision_readout(scenario) + _sentence(influence_words(changes))


def refusal(words: str) -> str:
    """Return, as HTML, the sentence that stands where a figure would be."""
    return (
        f'<div role="alert" style="border-left:4px solid {ORANGE};background:#fff8ec;color:{INK};'
        f'padding:14px 16px;line-height:1.45">{html.escape(words)}</div>'
    )


def _table_line(items: Sequence[tuple[str, Any, str]]) -> str:
    """Return named numbers side by side, as HTML."""
    cells = "".join(
        f'<div title="{html.escape(hint)}" style="padding:2px 18px 2px 0">'
        f'<div style="font-size:11px;color:{MUTED}">{_subscripts(name)}</div>'
        f'<div style="font-size:16px;font-weight:600;color:{INK};white-space:nowrap">'
        f"{html.escape(str(value))}</div></div>"
        for name, value, hint in items
    )
    return f'<div style="display:flex;flex-wrap:wrap;line-height:1.35">{cells}</div>'


def _sentence(words: str) -> str:
    return f'<div style="color:{INK};line-height:1.45;padding:3px 0">{html.escape(words)}</div>'


def _subscripts(name: str) -> str:
    head, mark, index = html.escape(name).partition("_")
    return f"<i>{head}</i><sub>{index}</sub>" if mark else head
