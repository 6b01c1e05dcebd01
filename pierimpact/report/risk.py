"""The risk of a case from its traffic: what it comes to, on a terminal or for a program."""

import json
import textwrap
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from pierimpact.checks import InputError
from pierimpact.collision.simulate import simulate
from pierimpact.files.case import Case
from pierimpact.files.traffic import NEEDED, CaseTraffic
from pierimpact.pier.column import StruckColumn
from pierimpact.plain_text import WIDTH, text_item, text_table
from pierimpact.report.calculation import Calculation, calculate
from pierimpact.risk.analysis import SIZE, Feared, Risk, Run, Strike, in_turn, risk
from pierimpact.risk.exceedance import Estimate, probability
from pierimpact.risk.traffic import YEAR, Traffic
from pierimpact.units import printed, rounded, unit_of, unit_size

#: Frequencies a year at which the reaction is stated: this project's choice.
RATES = (1e-3, 1e-4)
#: Below so many hits a year TxDOT asks for no check, as read in its LRFD manual [1/year].
TXDOT = 1e-3
#: Resistances, and what is exceeded.
RESISTANCES = {"shear": "shear_resistance", "moment": "moment_resistance"}
#: So many collisions are followed with the column as a beam: this project's choice.
_AS_BEAM = 7
#: What the table of a terminal has room for in each column [characters].
_WIDEST = (30, 30, WIDTH - 64)


class Check(NamedTuple):
    """A resistance of the case, and how often it is exceeded."""

    name: str  #: "shear" or "moment"
    resistance: float  #: [N] or [N m]
    reaction: float  #: reaction that brings it about [N]
    rate: Estimate  #: [1/year]


@dataclass(frozen=True, kw_only=True, eq=False)
class CaseRisk:
    """The risk of a case at the nominal impact height that governs its design."""

    case: Case
    calculation: Calculation  #: of the case, its own truck at its own speed
    traffic: CaseTraffic
    risk: Risk

    @property
    def struck(self) -> StruckColumn:
        """The column under a unit force at the impact height."""
        return self.calculation.struck

    @property
    def hits(self) -> Estimate:
        """Trucks that reach the pier [1/year]."""
        return yearly(self.risk.reaction.total)

    @cached_property
    def _as_beam(self) -> list[Strike]:
        """A few of the collisions about the reaction that is exceeded once in 10 000 years.

        Empty where no reaction is exceeded so often.
        """
        reaction = float(self.risk.reaction.value(RATES[-1] / YEAR).value)
        return self.risk.nearest(reaction, _AS_BEAM) if reaction > 0.0 else []

    @cached_property
    def beam(self) -> dict[str, tuple[float, float, float]]:
        """Shear and moment of the column as a beam over those of the reaction as a static force.

        The least, the median and the largest of a few of the collisions about the reaction that is
        exceeded once in 10 000 years; empty where there is none, or the case asks for static ones.
        """
        inputs, column = self.case.inputs, self.case.column
        if inputs.member_forces == "static" or not self._as_beam:
            return {}
        beam = column.beam(self.struck.impact_height, inputs.damping_ratio)
        ratios = []
        for truck, speed, reaction in self._as_beam:
            own = simulate(truck, beam, speed).member_forces
            assert own is not None
            static = self.struck.member_forces(reaction)
            ratios.append(
                [
                    abs(own.shear_extremes.governing.value / static.largest_shear.value),
                    abs(own.moment_extremes.governing.value / static.largest_moment.value),
                ]
            )
        least, middle, most = np.quantile(ratios, (0.0, 0.5, 1.0), axis=0).tolist()
        return dict(zip(RESISTANCES, zip(least, middle, most, strict=True), strict=True))

    @cached_property
    def effects(self) -> dict[str, float]:
        """Largest shear [-] and moment [m] anywhere over the reaction that brings it about.

        By the method that the case asks for: under the reaction as a static force, times the median
        ratio of `beam` or the larger of that and one.
        """
        forces, asked = self.struck.member_forces(1.0), self.case.inputs.member_forces
        static = {"shear": forces.largest_shear.value, "moment": forces.largest_moment.value}
        found = {}
        for name, value in static.items():
            ratio = self.beam.get(name, (1.0, 1.0, 1.0))[1]
            found[name] = abs(value) * (ratio if asked == "beam" else max(ratio, 1.0))
        return found

    @cached_property
    def checks(self) -> list[Check]:
        """How often each resistance is exceeded."""
        found = []
        for name, key in RESISTANCES.items():
            resistance = getattr(self.case.inputs, key)
            if resistance is not None:
                reaction = resistance / self.effects[name]
                rate = yearly(self.risk.reaction.rate(reaction))
                found.append(Check(name, resistance, reaction, rate))
        return found

    @cached_property
    def level(self) -> float:
        """The reaction whose trucks are looked at [N].

        The lowest that a resistance stands for, or else the one exceeded once in 10 000 years; the
        lowest of both levels that any truck brings about.
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
        count = len(self._as_beam)
        for name, (least, middle, most) in self.beam.items():
            found.append(
                f"The largest {name} is taken as {rounded(self.effects[name], 3)} times the "
                f"reaction{' in metres' * (name == 'moment')}. The column as a beam has "
                f"{rounded(middle, 2)} ({rounded(least, 2)}–{rounded(most, 2)}) times the {name} "
                f"under the reaction as a static force, in {count} collision{'s' * (count != 1)} "
                f"about the reaction at {RATES[-1]:g} a year."
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
        calculation.pier,
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
        resistance = printed(check.resistance, quantity, system, given=True)
        yield Line(
            f"{check.name.capitalize()} above {resistance}",
            rate_text(check.rate),
            f"from a reaction of {result.force(check.reaction)} on; "
            f"{share_text(result, check.reaction)} of all hits",
        )
    design = result.calculation.design_force
    yield Line(
        "Above the design reaction",
        rate_text(yearly(found.reaction.rate(design))),
        f"{result.force(design)}, of the case’s own truck at its own speed; "
        f"{share_text(result, design)} of all hits",
    )
    feared = result.feared
    if feared is not None:
        mass, speed = (
            f"{rounded(values[1] / size, 3)} {unit} ({rounded(values[0] / size, 3)}–"
            f"{rounded(values[2] / size, 3)})"
            for values, size, unit in (
                (feared.mass, *_large_mass(system)),
                (feared.speed, unit_size("speed", system), unit_of("speed", system)),
            )
        )
        yield Line(
            "Truck that the pier fears",
            f"{mass}, {speed}",
            f"mass and speed at the pier of those above {result.force(result.level)}: median, and "
            f"5 to 95 %; {100.0 * feared.by_engine:.0f} % by the engine’s peak",
        )


def _large_mass(system: str) -> tuple[float, str]:
    """Return the size of the unit for masses of trucks, and the unit."""
    return (1e3, "t") if system == "SI" else (unit_size("mass", "US"), unit_of("mass", "US"))


def share_text(result: CaseRisk, reaction: float) -> str:
    """Return the share of all hits whose reaction is above a value [N], as it prints."""
    above, of = result.risk.reaction.rate(reaction).value, result.risk.reaction.total.value
    return f"{rounded(100.0 * float(above / of), 2)} %" if of > 0.0 else "none"


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
                "reaction": check.reaction,
                "exceeded": _floats(check.rate),
                "return_period": _finite(1.0 / check.rate.value if check.rate.value else None),
            }
            for check in result.checks
        },
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
