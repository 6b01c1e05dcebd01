"""The values and sentences that explorers show beside their figures."""

import html
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.history import CollisionHistory, Peak
from pierimpact.plots.style import BODIES
from pierimpact.symbols import SYMBOLS
from pierimpact.teaching import explorer_data, markup
from pierimpact.teaching.markup import paragraph
from pierimpact.teaching.scenario import Scenario
from pierimpact.units import printed


class Readout(NamedTuple):
    """Values as HTML, and in sentences what they and the figures show."""

    values: str
    words: str
    warnings: Sequence[str] = ()

    @property
    def html(self) -> str:
        """The readout as HTML."""
        warned = "".join(markup.warning(f"{words}.") for words in self.warnings)
        return self.values + paragraph(html.escape(self.words)) + warned


def force(value: float | None) -> str:
    """Return a force in meganewtons, as in all explorers; "none" where there is none [N]."""
    return "none" if value is None or math.isnan(value) else f"{1e-6 * value:.2f} MN"


def mass(value: float) -> str:
    """Return a mass in tonnes, as in all explorers [kg]."""
    return f"{1e-3 * value:.4g} t"


def reaction(peak: Peak | None) -> str:
    """Return the reaction of a peak as it is printed, "none" without one."""
    return force(None if peak is None else peak.reaction)


def peak_at(peak: Peak) -> str:
    """Return the reaction and the time of a peak as they are printed."""
    return f"{force(peak.reaction)} at {printed(peak.time, 'time', 'SI')}"


#: Name of the largest reaction before cargo contact, where that is the engine's doing.
ENGINE_PEAK = "Engine peak"


def first_peak_name(history: CollisionHistory) -> str:
    """Return what the largest reaction before cargo contact truly is.

    It is the engine's peak where the engine has struck before, and where it is a peak: not where
    metal alone is crushed, nor where the reaction still rises as the cargo arrives.
    """
    contact, cargo = history.engine_contact_time, history.cargo_contact_time
    time = history.engine_peak.time
    rising = cargo is not None and math.isclose(time, cargo, rel_tol=1e-6)
    if contact is not None and contact <= time and not rising:
        return ENGINE_PEAK
    return "Largest reaction" if cargo is None else "Largest reaction before cargo contact"


def outcome(scenario: Scenario) -> str:
    """Return the outcome of a collision in sentences."""
    history = scenario.history
    engine, cargo = history.engine_peak, history.cargo_peak
    if history.engine_contact_time is None and cargo is None:
        return (
            "Neither engine nor cargo reaches the pier: the sheet metal in front of them stops "
            f"the truck. The largest reaction is {peak_at(engine)}."
        )
    name = first_peak_name(history)
    words = f"{name} {peak_at(engine)}"
    if history.engine_contact_time is None:
        words = (
            "The engine stops short of the pier; the largest reaction before the cargo arrives is "
            f"{force(engine.reaction)}"
        )
    if cargo is None:
        return f"{words}. The cargo stops short of the pier: there is no cargo peak."
    governs = f"The {history.governs} governs."
    if history.governs == "engine" and name != ENGINE_PEAK:
        governs = "The first is the larger."
    return f"{words}; cargo peak {peak_at(cargo)}. {governs}"


def collision(scenario: Scenario) -> Readout:
    """Return the values of the pier and of the collision."""
    pier, history = scenario.pier, scenario.history
    return _readout(
        outcome(scenario),
        _named("fp", pier.frequency),
        _named("kp", pier.stiffness),
        _named("mp", pier.mass),
        ("Truck’s energy", printed(scenario.collision.energy, "energy", "SI"), "½ (m₁ + m₂) V²"),
        (
            first_peak_name(history),
            reaction(history.engine_peak),
            "largest reaction before cargo contact",
        ),
        ("Cargo peak", reaction(history.cargo_peak), "largest reaction after cargo contact"),
    )


def shape(scenario: Scenario) -> Readout:
    """Return the values of Eqs 1–3, and the shares of column mass and of shear deflection."""
    column, pier = scenario.column, scenario.pier
    struck = column.struck_at(scenario.impact_height)
    whole = column.mass_per_length * column.height
    shear = struck.values["xs"] / struck.values["xn"]
    return _readout(
        f"The pier moves as if {struck.mass / whole:.0%} of the column’s mass were concentrated "
        f"at the impact height. Shear accounts for {shear:.0%} of the deflection there, flexure "
        "for the rest.",
        _named("kp", pier.stiffness, ", Eq. 3"),
        _named("mp", pier.mass, ", Eq. 1"),
        _named("fp", pier.frequency, ", √(k_p/m_p)/2π"),
        ("Whole column", mass(whole), "mass per length times height"),
    )


def amplification(scenario: Scenario, values: dict[str, float]) -> Readout:
    """Return the steps from contact speed to reaction beside the full model’s."""
    heads = ("body", "contact speed", "β", "μ", "e", "S", "two degrees of freedom", "full model")
    rows, words = [], []
    for i, (body, peak) in enumerate(scenario.history.peaks.items(), 1):
        speed, reduced = printed(values[f"v{i}"], "speed", "SI"), values[f"R{i}"]
        terms = [f"{values[f'{name}{i}']:.3f}" for name in ("beta", "mu", "e", "S")]
        rows.append((body, str(speed), *terms, force(reduced), reaction(peak)))
        if math.isnan(reduced) or peak is None:
            words.append(f"There is no {body} peak.")
        else:
            words.append(
                f"For the {body} S = {terms[-1]}, and the reaction is "
                f"{reduced / peak.reaction:.2f} times the full model’s."
            )
    numbers = range(1, len(heads))
    table = markup.table(heads, rows, right=numbers, colours=tuple(BODIES.values()))
    return Readout(table, " ".join(words))


def design(scenario: Scenario) -> Readout:
    """Return the design reaction beside the full model’s, with its warnings."""
    design = scenario.design("long")
    ratio = design.reaction / scenario.history.governing_peak.reaction
    return _readout(
        f"Design reaction {force(design.reaction)}, {ratio:.2f} times the full "
        f"model’s. The {design.governs} governs.",
        _named("fp", scenario.pier.frequency),
        ("Design, engine", force(design.engine), "long level"),
        ("Design, cargo", force(design.cargo), "long level"),
        ("Design reaction", force(design.reaction), "the larger of the two"),
    )._replace(warnings=design.warnings)


def influence(scenario: Scenario, changes: dict[str, NDArray[np.float64] | None]) -> Readout:
    """Return the values of the collision and the parameter that each peak is most sensitive to."""
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
    return Readout(collision(scenario).html, " ".join(words))


def _named(name: str, value: float, remark: str = "") -> tuple[str, object, str]:
    """Return the symbol, the value and the meaning of one of `SYMBOLS`."""
    symbol = SYMBOLS[name]
    shown = mass(value) if symbol.quantity == "mass" else printed(value, symbol.quantity, "SI")
    return markup.symbol(symbol.latex), shown, symbol.meaning + remark


def _readout(words: str, *items: tuple[str, object, str]) -> Readout:
    return Readout(markup.named_values(items), words)
