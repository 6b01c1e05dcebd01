"""The values and sentences that explorers show beside their figures."""

import html
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.history import Peak
from pierimpact.plots.schematic import Frame
from pierimpact.plots.style import BODIES
from pierimpact.symbols import SYMBOLS
from pierimpact.teaching import explorer_data, markup
from pierimpact.teaching.markup import named_values, paragraph, table
from pierimpact.teaching.scenario import Scenario
from pierimpact.units import printed


def force(value: float) -> str:
    """Return a force as it is printed."""
    return str(printed(value, "force", "SI"))


def reaction(peak: Peak | None) -> str:
    """Return the reaction of a peak as it is printed, "none" without one."""
    return "none" if peak is None else force(peak.reaction)


def peak_at(peak: Peak) -> str:
    """Return the reaction and the time of a peak as they are printed."""
    return f"{force(peak.reaction)} at {printed(peak.time, 'time', 'SI')}"


def outcome(scenario: Scenario) -> str:
    """Return the outcome of a collision in sentences."""
    history = scenario.history
    engine, cargo = history.engine_peak, history.cargo_peak
    if history.engine_contact_time is None and cargo is None:
        return (
            "Neither engine nor cargo reaches the pier: the sheet metal in front of them stops "
            f"the truck. The largest reaction is {peak_at(engine)}."
        )
    words = f"Engine peak {peak_at(engine)}"
    if history.engine_contact_time is None:
        words = (
            "The engine stops short of the pier; the largest reaction before the cargo arrives is "
            f"{force(engine.reaction)}"
        )
    if cargo is None:
        return f"{words}. The cargo stops short of the pier: there is no cargo peak."
    name = "cargo" if history.governing_peak == cargo else "engine"
    return f"{words}; cargo peak {peak_at(cargo)}. The {name} governs."


def instant(frame: Frame, phase: str) -> str:
    """Return the time, phase and reaction at one instant of a collision, as HTML."""
    return paragraph(
        f'<b style="font-size:16px;padding-right:14px">{1e3 * frame.time:.1f} ms</b>'
        f"{html.escape(phase)} R = {force(frame.reaction)}.",
        "font-size:14px",
    )


def collision_readout(scenario: Scenario) -> str:
    """Return the values of the pier and of the collision, as HTML."""
    pier, history = scenario.pier, scenario.history
    items = [
        _named("fp", pier.frequency),
        _named("kp", pier.stiffness),
        _named("mp", pier.mass),
        ("Truck’s energy", printed(scenario.collision.energy, "energy", "SI"), "½ (m₁ + m₂) V²"),
        ("Engine peak", reaction(history.engine_peak), "largest reaction before cargo contact"),
        ("Cargo peak", reaction(history.cargo_peak), "largest reaction after cargo contact"),
    ]
    return _readout(items, outcome(scenario))


def shape_words(scenario: Scenario) -> str:
    """Return the share of the column’s mass and of the shear deflection, in sentences."""
    column = scenario.column
    struck = column.struck_at(scenario.impact_height)
    whole = column.mass_per_length * column.height
    shear = struck.shear_deflection / struck.impact_deflection
    return (
        f"The pier moves as if {struck.mass / whole:.0%} of the column’s mass were concentrated "
        f"at the impact height. Shear accounts for {shear:.0%} of the deflection there, flexure "
        "for the rest."
    )


def shape_readout(scenario: Scenario) -> str:
    """Return the values of Eqs 1–3, as HTML."""
    column = scenario.column
    pier = scenario.pier
    whole = column.mass_per_length * column.height
    items = [
        _named("kp", pier.stiffness, ", Eq. 3"),
        _named("mp", pier.mass, ", Eq. 1"),
        _named("fp", pier.frequency, ", √(k_p/m_p)/2π"),
        ("Whole column", printed(whole, "mass", "SI"), "mass per length times height"),
    ]
    return _readout(items, shape_words(scenario))


def amplification_words(scenario: Scenario, values: dict[str, float]) -> str:
    """Compare the reduction to two degrees of freedom with the full model, in sentences."""
    words = []
    for i, (body, peak) in enumerate(scenario.peaks.items(), 1):
        if math.isnan(values[f"R{i}"]) or peak is None:
            words.append(f"There is no {body} peak.")
            continue
        words.append(
            f"For the {body} S = {values[f'S{i}']:.3f}, and the reaction is "
            f"{values[f'R{i}'] / peak.reaction:.2f} times the full model’s."
        )
    return " ".join(words)


def amplification_readout(scenario: Scenario, values: dict[str, float]) -> str:
    """Return the steps from contact speed to reaction beside the full model’s, as HTML."""
    heads = ("", "contact speed", "μ", "e", "β", "S", "two degrees of freedom", "full model")
    rows = [
        (
            body,
            str(printed(values[f"v{i}"], "speed", "SI")),
            *(f"{values[f'{name}{i}']:.3f}" for name in ("mu", "e", "beta", "S")),
            "none" if math.isnan(values[f"R{i}"]) else force(values[f"R{i}"]),
            reaction(peak),
        )
        for i, (body, peak) in enumerate(scenario.peaks.items(), 1)
    ]
    numbers = range(1, len(heads))
    shown = table(heads, rows, right=numbers, colours=tuple(BODIES.values()))
    return shown + paragraph(amplification_words(scenario, values))


def design_words(scenario: Scenario) -> str:
    """Compare the design reaction with the full model, in sentences."""
    design = scenario.design("long")
    ratio = design.reaction / scenario.history.governing_peak.reaction
    return (
        f"Design reaction {force(design.reaction)}, {ratio:.2f} times the full "
        f"model’s. The {design.governs} governs."
    )


def design_readout(scenario: Scenario) -> str:
    """Return the design reaction with its warnings, as HTML."""
    design = scenario.design("long")
    cargo = "none" if design.cargo is None else force(design.cargo)
    items = [
        _named("fp", scenario.pier.frequency),
        ("Design, engine", force(design.engine), "long level"),
        ("Design, cargo", cargo, "long level"),
        ("Design reaction", force(design.reaction), "the larger of the two"),
    ]
    warned = "".join(
        f'<div style="color:#8a5300">{html.escape(words)}.</div>' for words in design.warnings
    )
    return _readout(items, design_words(scenario)) + warned


def influence_words(changes: dict[str, NDArray[np.float64] | None]) -> str:
    """Name the parameter that each peak is most sensitive to, in sentences."""
    words = []
    for body, change in changes.items():
        if change is None:
            words.append(f"The {body} does not reach the pier: there is no peak to change.")
            continue
        largest = np.where(np.isfinite(change), np.abs(change), np.inf).max(axis=1)
        most = int(np.argmax(largest))
        name = explorer_data.PARAMETERS[most].meaning
        how = "disappears" if np.isinf(largest[most]) else f"changes by {largest[most]:.0%}"
        words.append(f"The {body} peak is most sensitive to the {name}: it {how}.")
    return " ".join(words)


def influence_readout(scenario: Scenario, changes: dict[str, NDArray[np.float64] | None]) -> str:
    """Return the values of the collision and what its peaks are most sensitive to, as HTML."""
    return collision_readout(scenario) + paragraph(html.escape(influence_words(changes)))


def _named(name: str, value: float, remark: str = "") -> tuple[str, object, str]:
    """Return the symbol, the value and the meaning of one of `SYMBOLS`."""
    symbol = SYMBOLS[name]
    shown = printed(value, symbol.quantity, "SI")
    return markup.symbol(symbol.latex), shown, symbol.meaning + remark


def _readout(items: Sequence[tuple[str, object, str]], words: str) -> str:
    return named_values(items) + paragraph(html.escape(words))
