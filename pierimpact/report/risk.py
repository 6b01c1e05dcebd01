"""The risk of a case from its traffic: what it comes to, on a terminal or for a program."""

import json
import math
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError
from pierimpact.files.case import Case, Part
from pierimpact.files.traffic import NEEDED, CaseTraffic
from pierimpact.pier.beam import BeamPier
from pierimpact.plain_text import WIDTH, text_item, text_table
from pierimpact.report.calculation import Calculation, calculate
from pierimpact.risk.analysis import SIZE, Feared, Risk, Run, in_turn, risk, weighted_quantiles
from pierimpact.risk.beam_strikes import beam_strikes
from pierimpact.risk.exceedance import Estimate, Exceedance, probability
from pierimpact.risk.traffic import YEAR, Traffic
from pierimpact.units import printed, rounded, stated, unit_of, unit_size

Array: TypeAlias = NDArray[np.float64]

#: Frequencies a year at which the reaction is stated: this project's choice.
RATES = (1e-3, 1e-4)
#: Below so many hits a year TxDOT asks for no check, as read in its LRFD manual [1/year].
TXDOT = 1e-3
#: Resistances, and what is exceeded.
RESISTANCES = {"shear": "shear_resistance", "moment": "moment_resistance"}
#: What the beam has over the static forces is told of reactions within this share of one: this
#: project's choice.
_NEAR = 0.2
#: What the table of a terminal has room for in each column [characters].
_WIDEST = (30, 30, WIDTH - 64)


class Check(NamedTuple):
    """A resistance of the case, and how often it, or that of any part, is exceeded."""

    name: str  #: "shear" or "moment"
    resistance: float  #: of the lowest part of the column [N] or [N m]
    reaction: float  #: that is exceeded as often; infinite where no truck does [N]
    rate: Estimate  #: [1/year]


@dataclass(frozen=True, kw_only=True, eq=False)
class CaseRisk:
    """The risk of a case: of each truck the larger effect of all its nominal impact heights."""

    case: Case
    calculation: Calculation  #: of the case, its own truck at its own speed
    traffic: CaseTraffic
    risk: Risk

    @property
    def hits(self) -> Estimate:
        """Trucks that reach the pier [1/year]."""
        return yearly(self.risk.reaction.total)

    @property
    def heights(self) -> list[float]:
        """The nominal impact heights [m]."""
        return [impact.struck.impact_height for impact in self.calculation.impacts]

    @cached_property
    def static(self) -> dict[str, Array]:
        """Largest "shear" and "moment" under the reaction of each truck as a static force."""
        return {name: self._static(name, [(self.case.whole, 1.0)]) for name in RESISTANCES}

    def _static(self, name: str, weighted: Sequence[tuple[Part, float]]) -> Array:
        """Return the largest on any of these parts, each times its weight."""
        effects = [
            max(
                getattr(impact.struck.member_forces(1.0), f"{name}_within")(part.low, part.high)
                * weight
                for part, weight in weighted
            )
            for impact in self.calculation.impacts
        ]
        largest: Array = (self.risk.strikes.reactions * effects).max(axis=1)
        return largest

    @cached_property
    def as_beam(self) -> dict[str, Array]:
        """The same of the first trucks with the column as a beam.

        Empty where the case asks for static ones.
        """
        return beam_strikes(self.risk, self._beams)._asdict() if self._beams else {}

    @property
    def _beams(self) -> list[BeamPier]:
        return [impact.beam for impact in self.calculation.impacts if impact.beam is not None]

    @cached_property
    def effects(self) -> dict[str, Exceedance]:
        """How often "shear" and "moment" are exceeded by the method that the case asks for.

        Static ones are those of all trucks; what the beam makes of the first corrects them.
        """
        by_beam = self.as_beam
        return {name: self._exceedance(own, by_beam.get(name)) for name, own in self.static.items()}

    def _exceedance(self, static: Array, better: Array | None) -> Exceedance:
        if better is not None and self.case.inputs.member_forces == "larger":
            better = np.maximum(better, static[: len(better)])
        return self.risk.exceedance(static, better)

    @cached_property
    def against(self) -> Mapping[str, Exceedance]:
        """How often "shear" and "moment" are exceeded, each against what its part resists.

        Of parts that resist differently as `effects` would be if all resisted what the base does.
        """
        if not self.case.differing:
            return self.effects
        beams = [
            beam.weighted(*(self.case.weakness(name, beam.z) for name in RESISTANCES))
            for beam in self._beams
        ]
        by_beam = beam_strikes(self.risk, beams)._asdict() if beams else {}
        found = {}
        for name, base in self.calculation.resistances.items():
            weighted = [(part, base / part.resistances[name]) for part in self.case.parts]
            found[name] = self._exceedance(self._static(name, weighted), by_beam.get(name))
        return found

    @cached_property
    def beam(self) -> dict[str, tuple[float, float, float]]:
        """Shear and moment of the column as a beam over those of the reaction as a static force.

        What 5, 50 and 95 % stay below of the trucks whose reaction is about that exceeded once in
        10 000 years; empty where there is none, or the case asks for static ones.
        """
        near, weight = self._near, self.risk.strikes.weight
        if not self.as_beam or not near.any():
            return {}
        return {
            name: weighted_quantiles(
                own[near] / self.static[name][: len(own)][near], weight[: len(own)][near]
            )
            for name, own in self.as_beam.items()
        }

    @cached_property
    def _near(self) -> NDArray[np.bool_]:
        """Which of the trucks with the column as a beam are told of."""
        at = float(self.risk.reaction.value(RATES[-1] / YEAR).value)
        count = len(next(iter(self.as_beam.values()), ()))
        reaction, weight = (
            own[:count] for own in (self.risk.strikes.reaction, self.risk.strikes.weight)
        )
        return (weight > 0.0) & (at > 0.0) & (abs(reaction - at) <= _NEAR * at)

    @cached_property
    def checks(self) -> list[Check]:
        """How often each resistance is exceeded."""
        found = []
        for name, key in RESISTANCES.items():
            resistance = getattr(self.case.inputs, key)
            if resistance is not None:
                rate = self.against[name].rate(resistance)
                found.append(Check(name, resistance, self.as_often(rate), yearly(rate)))
        return found

    def as_often(self, rate: Estimate) -> float:
        """Return the reaction that is exceeded as often, infinite where nothing is [N]."""
        if not rate.value > 0.0:
            return math.inf
        return float(self.risk.reaction.value(float(rate.value)).value)

    @cached_property
    def level(self) -> float:
        """The reaction whose trucks are looked at [N].

        The lowest that is exceeded as often as a resistance, or else the one exceeded once in
        10 000 years; the lowest of both levels that any truck brings about.
        """
        at = [check.reaction for check in self.checks]
        at = [min(at)] if at else []
        at += [float(self.risk.reaction.value(rate / YEAR).value) for rate in RATES[::-1]]
        return next((each for each in at if self.risk.feared(each)), 0.0)

    @property
    def feared(self) -> Feared | None:
        """The trucks that bring about more than `level`."""
        return self.risk.feared(self.level)

    @cached_property
    def warnings(self) -> list[str]:
        """What to know before relying on it."""
        found = [
            "The chance of leaving the road and the way from there to the pier are those of the "
            "JCSS model code, which calls its estimates quite conservative; a barrier in between "
            "is not considered. The confidence band is that of the number of trucks drawn, not of "
            "these laws, nor of the parameters of the trucks beyond their spread.",
        ]
        feared = self.feared
        if feared is not None and feared.beyond > 0.05:  # this project's choice
            found.append(
                f"{100.0 * feared.beyond:.0f} % of the trucks that bring about more than "
                f"{self.force(self.level)} are heavier or lighter than the springs of their truck "
                "stand for: give trucks of your own for those masses (traffic_trucks)."
            )
        statuses = sorted({file.status.words for file in self.traffic.truck_files})
        found.append(
            f"The trucks are {' and '.join(statuses)}: {', '.join(self.truck_names)}. A reaction "
            "is as good as their parameters."
        )
        for name, (least, middle, most) in self.beam.items():
            found.append(
                f"The column as a beam has {rounded(middle, 2)} ({rounded(least, 2)}–"
                f"{rounded(most, 2)}) times the {name} under the reaction as a static force: "
                f"median, and 5 to 95 % of {int(self._near.sum())} collisions about the reaction "
                f"at {RATES[-1]:g} a year. How often a {name} is exceeded rests on "
                f"{len(self.as_beam[name]):,} collisions of the beam, and its band shows that."
            )
        return found

    @property
    def truck_names(self) -> list[str]:
        """Names of the trucks that go with any mass of the traffic."""
        used = set(self.risk.strikes.truck.tolist())
        return [truck.name for number, truck in enumerate(self.risk.trucks) if number in used]

    def force(self, value: float) -> str:
        """Return a force as it prints."""
        return str(printed(value, "force", self.case.inputs.units))


def yearly(rate: Estimate) -> Estimate:
    """Return a rate [1/s] per year."""
    return Estimate(*(YEAR * part for part in rate))


def case_risk(
    case: Case,
    size: int = SIZE,
    seed: int = 0,
    *,
    run: Run = in_turn,
    progress: Callable[[int], object] = lambda count: None,
) -> CaseRisk:
    """Return the risk of a case from its traffic; arguments as in `risk.analysis.risk`.

    Raises
    ------
    InputError
        When the case gives no traffic, or size or seed is out of range.
    """
    if case.traffic is None:
        raise InputError(missing_traffic(case))
    calculation = calculate(case)
    found = risk(
        case.traffic.traffic,
        [file.truck for file in case.traffic.truck_files],
        [impact.history.pier for impact in calculation.impacts],
        size,
        seed,
        run=run,
        progress=progress,
    )
    return CaseRisk(case=case, calculation=calculation, traffic=case.traffic, risk=found)


def missing_traffic(case: Case) -> str:
    """Return what a case without traffic does not give, in one line."""
    missing = next(key for key in NEEDED if getattr(case.inputs, key) is None)
    return f"{missing} is missing: a risk needs {', '.join(NEEDED)}"


class Line(NamedTuple):
    """A result: what it is, its value, and a remark."""

    label: str
    value: str
    remark: str


def statement(result: CaseRisk) -> str:
    """Return in a sentence or two how often the pier is struck, and what that does to it."""
    hits = float(result.hits.value)
    often = f"A truck strikes the pier {_frequency(hits)}"
    side = "below" if hits < TXDOT else "above"
    words = f"{often}, {side} the 0.001 a year under which TxDOT asks for no check."
    for check in result.checks:
        rate = float(check.rate.value)
        words += f" The {check.name} resistance is exceeded {_frequency(rate)}."
    return words


def _frequency(rate: float) -> str:
    """Return a frequency [1/year] in words."""
    if rate <= 0.0:
        return "by none of the trucks drawn"
    return f"{rounded(rate, 3)} times a year, once in {rounded(1.0 / rate, 3)} years"


def lines(result: CaseRisk) -> Iterator[Line]:
    """Yield the results, the first ones first."""
    system, found = result.case.inputs.units, result.risk
    yield Line(
        "Hits",
        rate_text(result.hits),
        f"trucks that reach the pier; {rounded(float(result.hits.value) / TXDOT, 3)} times "
        "TxDOT’s 0.001 a year",
    )
    for rate in RATES:
        value, simple = (of.value(rate / YEAR) for of in (found.reaction, found.hard_impact))
        yield Line(
            f"Reaction at {rate:g} a year",
            value_text(value, "force", system),
            f"exceeded once in {1.0 / rate:,.0f} years; v √(k m) of JCSS "
            f"{value_text(simple, 'force', system, band=False)}".replace(",", "\u202f", 1),
        )
    for check in result.checks:
        quantity = "force" if check.name == "shear" else "moment"
        name, of_parts = check.name.capitalize(), check.name in result.case.differing
        resistance = printed(check.resistance, quantity, system, given=True)
        yield Line(
            f"{name} resistance of a part" if of_parts else f"{name} above {resistance}",
            rate_text(check.rate),
            _as_often(result, check),
        )
    design = result.calculation.design_force
    yield Line(
        "Above the design reaction",
        rate_text(yearly(found.reaction.rate(design))),
        f"{result.force(design)}, of the case’s own truck at its own speed; "
        f"{share_text(result, found.reaction.rate(design))} of all hits",
    )
    feared = result.feared
    if feared is not None:
        mass, speed = (
            f"{rounded(values[1] / size, 3)} {unit} ({rounded(values[0] / size, 3)}–"
            f"{rounded(values[2] / size, 3)})"
            for values, size, unit in (
                (feared.mass, *large_mass(system)),
                (feared.speed, unit_size("speed", system), unit_of("speed", system)),
            )
        )
        yield Line(
            "Truck that the pier fears",
            f"{mass}, {speed}",
            f"mass and speed at the pier of those above {result.force(result.level)}: median, and "
            f"5 to 95 %; {100.0 * feared.by_engine:.0f} % by the engine’s peak",
        )


def large_mass(system: str) -> tuple[float, str]:
    """Return the size of the unit for masses of trucks, and the unit."""
    return (1e3, "t") if system == "SI" else (unit_size("mass", "US"), unit_of("mass", "US"))


def _as_often(result: CaseRisk, check: Check) -> str:
    """Return what a resistance's frequency is like."""
    if check.reaction == math.inf:
        return "by none of the trucks drawn"
    share = share_text(result, result.against[check.name].rate(check.resistance))
    return f"as often as a reaction of {result.force(check.reaction)}; {share} of all hits"


def share_text(result: CaseRisk, rate: Estimate) -> str:
    """Return the share of all hits that a rate [1/s] is, as it prints."""
    of = float(result.risk.reaction.total.value)
    return f"{rounded(100.0 * float(rate.value) / of, 2)} %" if of > 0.0 else "none"


def rate_text(rate: Estimate) -> str:
    """Return a frequency [1/year] with its band, as it prints."""
    value, low, high = (rounded(float(part), 3) for part in rate)
    return f"{value} a year ({low}–{high})"


def value_text(value: Estimate, quantity: str, system: str, *, band: bool = True) -> str:
    """Return a value with its band, as it prints."""
    middle, low, high = map(float, value)
    if middle == 0.0:
        return "no hit so often"
    number = printed(middle, quantity, system)
    if not band:
        return str(number)
    ends = "–".join(
        "more" if end == float("inf") else printed(end, quantity, system).number
        for end in (low, high)
    )
    return f"{number} ({ends})"


def laws(traffic: Traffic) -> Iterator[Line]:
    """Yield what the traffic follows, each with its status."""
    statuses = {
        "Mass": traffic.mass,
        "Speed on the road": traffic.speed,
        "Deceleration off it": traffic.deceleration,
        "Angle to the road": traffic.angle,
    }
    for label, law in statuses.items():
        own = getattr(traffic.mass, "speed", None) is not None and label.startswith("Speed")
        status = getattr(law, "status", None)
        remark = "given" if status is None else f"default; {status.standard_words}"
        yield Line(label, "of the weighed trucks" if own else law.words, "given" if own else remark)


def drawn(result: CaseRisk) -> str:
    """Return how many trucks were drawn, and with which seed."""
    size, seed = result.risk.size, result.risk.seed
    return f"{size:,} truck{'' if size == 1 else 's'} drawn with seed {seed}"


def heights_text(result: CaseRisk) -> str:
    """Return in a sentence at which height the trucks strike."""
    system = result.case.inputs.units
    shown = [stated(height, "length", system) for height in result.heights]
    if len(shown) == 1:
        return f"The trucks strike at a nominal height of {shown[0]}."
    return (
        f"The trucks strike at nominal heights of {' and '.join(shown)}; of each the larger "
        "reaction, shear and moment count."
    )


def risk_text(name: str, result: CaseRisk) -> str:
    """Return the risk of a case in plain text.

    Parameters
    ----------
    name : str
        What the case is called.
    result : CaseRisk
        Its risk.
    """
    return "\n".join(
        [
            name,
            *textwrap.wrap(statement(result), WIDTH),
            "",
            text_table(list(lines(result)), widest=_WIDEST),
            *textwrap.wrap(heights_text(result), WIDTH),
            "",
            f"Traffic ({drawn(result)}; bands hold 95 %)",
            text_table(list(laws(result.traffic.traffic)), widest=_WIDEST),
            "",
            "Before you rely on this",
            *map(text_item, result.warnings),
        ]
    )


def risk_json(name: str, result: CaseRisk) -> str:
    """Return the risk of a case as a JSON object in one line, in SI units, frequencies a year.

    An estimate is a list of value, lower and upper end of the band. Parameters as in `risk_text`.
    """
    found, feared = result.risk, result.feared
    data: dict[str, Any] = {
        "case": name,
        "samples": found.size,
        "seed": found.seed,
        "trucks": result.truck_names,
        "hits": _floats(result.hits),
        "annual_hit_probability": float(probability(result.hits.value, 1.0)),
        "txdot_hit_frequency": TXDOT,
        "reactions": {f"{rate:g}": _floats(found.reaction.value(rate / YEAR)) for rate in RATES},
        "hard_impacts": {
            f"{rate:g}": _floats(found.hard_impact.value(rate / YEAR)) for rate in RATES
        },
        "design_reaction": result.calculation.design_force,
        "design_reaction_exceeded": _floats(
            yearly(found.reaction.rate(result.calculation.design_force))
        ),
        "checks": {
            check.name: {
                "resistance": check.resistance,
                "reaction": _finite(check.reaction),
                "exceeded": _floats(check.rate),
                "return_period": _finite(1.0 / check.rate.value if check.rate.value else None),
            }
            for check in result.checks
        },
        "impact_heights": result.heights,
        "beam_over_static": result.beam,
        "feared": None if feared is None else {"above": result.level} | feared._asdict(),
        "warnings": result.warnings,
    }
    return json.dumps(data)


def _floats(estimate: Estimate) -> list[float | None]:
    return [_finite(part) for part in estimate]


def _finite(value: Any) -> float | None:
    """Return a number as JSON has it; none where it is infinite."""
    return float(value) if value is not None and abs(float(value)) != float("inf") else None
