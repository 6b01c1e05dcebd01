"""The calculation of a case: from the nominal impact height to reactions and member forces."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError
from pierimpact.collision.averages import AverageForce, largest_average_force
from pierimpact.collision.history import CollisionHistory, Peak
from pierimpact.collision.simulate import simulate
from pierimpact.design.band import ReactionBand, quantiles, reaction_band
from pierimpact.design.beam_band import beam_band
from pierimpact.design.codes import CodeForce, aashto_lrfd, code_forces
from pierimpact.design.reaction import DesignReaction, design_reaction
from pierimpact.design.sensitivity import SPEED_CHANGES, Sensitivity, sensitivity
from pierimpact.design.static_forces import StaticForcesInCollision
from pierimpact.files.case import Case, Part
from pierimpact.pier.beam import BeamPier
from pierimpact.pier.column import StruckColumn
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.pier.member_forces import BeamExtreme, MemberForceHistory, MemberForces

Array: TypeAlias = NDArray[np.float64]

#: Windows of the moving averages that crash tests report: 10 and 25 ms as read in NCHRP Report 892,
#: 50 ms from memory [s].
WINDOWS = (0.010, 0.025, 0.050)
#: The one that the force of AASHTO LRFD was taken from, as read in NCHRP Report 892 [s].
AVERAGE = 0.025
# Numerical: how often a collision is followed for longer, each time by a quarter of it at least.
_EXTENSIONS = 12


class Demand(NamedTuple):
    """The largest magnitude of shear [N] or moment [N m] anywhere on the column, by two methods."""

    static: float  #: under the design reaction as a static force
    beam: float | None  #: during the collision with the column as a beam; None if not calculated
    asked: str  #: "larger", "beam" or "static"

    @property
    def method(self) -> str:
        """The method that governs: "beam" or "static"."""
        if self.asked != "larger":
            return self.asked
        return "beam" if self.beam is not None and self.beam > self.static else "static"

    @property
    def value(self) -> float:
        """The governing one."""
        return self.beam if self.method == "beam" and self.beam is not None else self.static

    @property
    def ratio(self) -> float | None:
        """Static over beam [-]."""
        return None if self.beam is None else self.static / self.beam


class Use(NamedTuple):
    """The largest "shear" or "moment" on a part of the column, and what that part resists."""

    part: Part
    demand: Demand
    resistance: float  #: [N] or [N m]

    @property
    def utilisation(self) -> float:
        """Demand over resistance [-]."""
        return self.demand.value / self.resistance


class Yielding(NamedTuple):
    """The collision with a pier that yields in bending."""

    struck: StruckColumn
    part: Part  #: that yields
    history: CollisionHistory
    shear: float  #: utilisation in shear when it yields; zero without a shear resistance [-]


class CodeEffect(NamedTuple):
    """What the force of a clause does to the column."""

    code: CodeForce
    height: float  #: of the clause, or else that of this calculation [m]
    member_forces: MemberForces | None  #: None where the force acts above it or on a support


@dataclass(frozen=True, kw_only=True)
class Impact:
    """The collision of a case at one nominal impact height."""

    case: Case
    struck: StruckColumn  #: the column under a unit force at that height
    history: CollisionHistory  #: the collision by the full model

    @property
    def reaction(self) -> float:
        """The larger of engine and cargo peak [N]."""
        return self.history.governing_peak.reaction

    @property
    def member_forces(self) -> MemberForces:
        """Member forces under the reaction as a static force."""
        return self.struck.member_forces(self.reaction)

    @property
    def reversed_forces(self) -> MemberForces:
        """Member forces under the smallest reaction, as the pier swings back."""
        return self.struck.member_forces(self.history.lowest.reaction)

    @cached_property
    def beam(self) -> BeamPier | None:
        """The column as a beam; None where the case asks for static member forces."""
        inputs = self.case.inputs
        if inputs.member_forces == "static":
            return None
        return self.case.column.beam(self.struck.impact_height, inputs.damping_ratio)

    @cached_property
    def beam_forces(self) -> MemberForceHistory | None:
        """Member forces of the column as a beam; None where the case asks for static ones."""
        if self.beam is None:
            return None
        return simulate(self.case.truck, self.beam, self.case.inputs.speed).member_forces

    @property
    def demands(self) -> dict[str, Demand]:
        """Largest "shear" and "moment"."""
        return self.demands_of(self.case.whole)

    def demands_of(self, part: Part) -> dict[str, Demand]:
        """Return the same on a part of the column."""
        static, asked, ends = self.member_forces, self.case.inputs.member_forces, part[:2]
        beam = self.beam_forces and self.beam_forces.between(*ends)
        shear, moment = (
            (None, None)
            if beam is None
            else (
                abs(extremes.governing.value)
                for extremes in (beam.shear_extremes, beam.moment_extremes)
            )
        )
        return {
            "shear": Demand(static.shear_within(*ends), shear, asked),
            "moment": Demand(static.moment_within(*ends), moment, asked),
        }

    def sampled_demands(
        self, part: Part, band: ReactionBand, reactions: Array
    ) -> dict[str, dict[str, Array]]:
        """Return the same of the sampled trucks of a band, by method.

        By "static", from their `reactions` here, and, where there is a beam, by "beam" and the
        "larger" of both.
        """
        per_reaction, demands = reactions / self.reaction, self.demands_of(part)
        found = {name: {"static": demand.static * per_reaction} for name, demand in demands.items()}
        if self.beam is not None and self.beam_forces is not None:
            beam, duration = self.beam.between(*part[:2]), float(self.beam_forces.time[-1])
            by_beam = beam_band(band.collision.parameters, band.parameters, beam, duration)
            for name, demand in demands.items():
                own = found[name]
                own["beam"] = (demand.beam or math.nan) * by_beam.ratios(name)
                own["larger"] = np.fmax(own["static"], own["beam"])
        return found


@dataclass(frozen=True, kw_only=True)
class Calculation:
    """A case, calculated at its nominal impact height, or at both where a range is asked for.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.report.calculation import calculate
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> result = calculate(file.case)
    >>> round(result.design_force / 1e6, 2), result.governs  # MN
    (7.16, 'engine')
    >>> round(result.demands["shear"].value / 1e6, 2), result.demands["shear"].method  # MN
    (6.57, 'static')
    """

    case: Case
    impacts: tuple[Impact, ...]  #: by height, upward

    @cached_property
    def governing(self) -> Impact:
        """The impact with the larger reaction."""
        return max(self.impacts, key=lambda impact: impact.reaction)

    @property
    def struck(self) -> StruckColumn:
        """The column under a unit force at the height that governs."""
        return self.governing.struck

    @property
    def history(self) -> CollisionHistory:
        """The collision by the full model at the height that governs."""
        return self.governing.history

    @property
    def pier(self) -> EquivalentPier:
        """The pier as one degree of freedom."""
        return self.history.pier

    @property
    def governing_peak(self) -> Peak:
        """The larger of engine and cargo peak of the full model."""
        return self.history.governing_peak

    @property
    def design_force(self) -> float:
        """The result: the governing peak of the full model [N]."""
        return self.governing.reaction

    @property
    def governs(self) -> str:
        """What makes the result: engine, sheet metal where the engine does not, or cargo."""
        history = self.history
        return history.before_cargo if history.governs == "engine" else "cargo"

    @cached_property
    def short(self) -> DesignReaction:
        """The spectrum method: the design procedure at its short level, the check by hand."""
        return design_reaction(self.case.truck, self.pier, self.case.inputs.speed, "short")

    @cached_property
    def long(self) -> DesignReaction:
        """The design procedure at its long level."""
        return design_reaction(self.case.truck, self.pier, self.case.inputs.speed, "long")

    @property
    def ratio(self) -> float:
        """Reaction of the check by hand over that of the full model [-]."""
        return self.short.reaction / self.design_force

    @property
    def checked_by_hand(self) -> bool:
        """Whether the check by hand was tried on cases like this one."""
        return not (self.short.outside or self.short.overlapping)

    @cached_property
    def sensitivity(self) -> Sensitivity:
        """The reaction as speed, truck mass, impact height and pier frequency change."""
        return sensitivity(
            self.case.truck,
            self.case.column,
            self.pier,
            self.struck.impact_height,
            self.case.inputs.speed,
            SPEED_CHANGES[self.case.inputs.units],
        )

    @cached_property
    def band(self) -> ReactionBand:
        """The reactions that the spread of the truck's parameters makes."""
        return reaction_band(self.case.truck, self.pier, self.case.inputs.speed)

    @cached_property
    def reaction_band(self) -> tuple[float, float, float] | None:
        """Reactions that 5, 50 and 95 % of the sampled trucks stay below; None without a spread.

        Of each truck the larger of all impacts.
        """
        if not self.band.spread:
            return None
        low, middle, high = quantiles(self._largest_sampled).tolist()
        return low, middle, high

    @property
    def share_above(self) -> float:
        """Share of the sampled trucks whose reaction is above the design reaction [-]."""
        return float(np.mean(self._largest_sampled > self.design_force))

    @cached_property
    def _largest_sampled(self) -> Array:
        """The larger reaction of all impacts, of each sampled truck."""
        largest: Array = np.fmax.reduce(self._sampled_reactions)
        return largest

    @cached_property
    def _sampled_reactions(self) -> list[Array]:
        """The reactions of the sampled trucks, by impact."""
        return [self.band.on(impact.history.pier).governing for impact in self.impacts]

    @cached_property
    def sampled_demands(self) -> dict[str, dict[str, Array]]:
        """Largest "shear" and "moment" of the sampled trucks, as in `Impact.sampled_demands`.

        Of each truck the larger of all impacts. Empty without a spread.
        """
        if not self.band.spread:
            return {}
        return _largest_of(self._sampled_by_part)

    @cached_property
    def _sampled_by_part(self) -> list[dict[str, dict[str, Array]]]:
        """The same for each part of the column that has resistances of its own."""
        return [
            _largest_of(
                [
                    impact.sampled_demands(part, self.band, reactions)
                    for impact, reactions in zip(self.impacts, self._sampled_reactions, strict=True)
                ]
            )
            for part in self.resisting
        ]

    def demand_bands_by(self, method: str) -> dict[str, tuple[float, float]]:
        """Return "shear" and "moment" that 5 and 95 % of the sampled trucks stay below by a method.

        One of those of `sampled_demands`. Empty without a spread.
        """
        found = {name: quantiles(own[method]) for name, own in self.sampled_demands.items()}
        return {name: (float(low), float(high)) for name, (low, _, high) in found.items()}

    @cached_property
    def demand_bands(self) -> dict[str, tuple[float, float]]:
        """The same by the method that is asked for, or of each truck by the larger."""
        return self.demand_bands_by(self.case.inputs.member_forces)

    @property
    def member_forces(self) -> MemberForces:
        """Member forces under the design reaction as a static force."""
        return self.governing.member_forces

    @property
    def static_forces(self) -> StaticForcesInCollision:
        """Whether these member forces hold for a column that vibrates."""
        largest = float(self.history.contact_force.max())
        return StaticForcesInCollision(self.struck.static_forces, self.design_force, largest)

    @cached_property
    def demands(self) -> dict[str, Demand]:
        """Largest "shear" and "moment" of all impacts, each by the method that governs."""
        return self.demands_of(self.case.whole)

    def demands_of(self, part: Part) -> dict[str, Demand]:
        """Return the same on a part of the column."""
        of_each = [impact.demands_of(part) for impact in self.impacts]

        def largest(name: str) -> Demand:
            beams = [beam for own in of_each if (beam := own[name].beam) is not None]
            return Demand(
                max(own[name].static for own in of_each),
                max(beams, default=None),
                self.case.inputs.member_forces,
            )

        return {name: largest(name) for name in ("shear", "moment")}

    @property
    def resisting(self) -> tuple[Part, ...]:
        """The parts of the column, or the whole where all resist the same."""
        return self.case.parts if self.case.differing else (self.case.whole,)

    def largest_of_beam(self, name: str) -> tuple[BeamExtreme, Impact] | None:
        """Return the largest "shear" or "moment" of the column as a beam, and of which impact."""
        found = [
            (getattr(impact.beam_forces, f"{name}_extremes").governing, impact)
            for impact in self.impacts
            if impact.beam_forces is not None
        ]
        return max(found, key=lambda own: abs(own[0].value), default=None)

    @cached_property
    def yielding(self) -> Yielding | None:
        """The collision with a pier that yields in bending; None where it does not.

        By the static reaction at the height, and in the part, where that exceeds the moment
        resistance most. None also where the case gives no moment resistance.
        """
        if "moment" not in self.resistances:
            return None
        limits = {
            (impact.reaction / limit, limit): (impact, part)
            for impact in self.impacts
            for part in self.resisting
            for limit in (_limit(impact.struck, part),)
        }
        most, limit = max(limits)
        if most <= 1.0:
            return None
        impact, part = limits[most, limit]
        pier = replace(impact.history.pier, yield_reaction=limit)
        history = simulate(self.case.truck, pier, self.case.inputs.speed)
        forces = impact.struck.member_forces(limit)
        shear = self.utilisations_under(forces).get("shear", 0.0)
        return Yielding(impact.struck, part, history, shear)

    @cached_property
    def average_forces(self) -> dict[float, AverageForce]:
        """The largest moving averages by window [s]."""
        return {window: largest_average_force(self.history, window) for window in WINDOWS}

    @property
    def code_ratio(self) -> float:
        """The 25 ms average over the force of AASHTO LRFD, which is such an average [-]."""
        return self.average_forces[AVERAGE].force / aashto_lrfd().along.value

    @cached_property
    def code_effects(self) -> list[CodeEffect]:
        """The forces of codes along the travel, each on this column."""
        column, effects, inputs = self.case.column, [], self.case.inputs
        for code in code_forces(inputs.speed, self.case.truck.mass, inputs.units):
            height = code.height.value if code.height else self.struck.impact_height
            try:
                forces = column.struck_at(height).member_forces(code.along.value)
            except InputError:  # above the column, or where a support holds it
                forces = None
            effects.append(CodeEffect(code, height, forces))
        return effects

    @cached_property
    def aashto_effect(self) -> CodeEffect:
        """What the force of AASHTO LRFD does to the column."""
        code = aashto_lrfd().code
        return next(effect for effect in self.code_effects if effect.code.code == code)

    def utilisations_under(self, forces: MemberForces) -> dict[str, float]:
        """Return what these member forces come to, as `utilisations` do."""
        return {
            name: max(
                getattr(forces, f"{name}_within")(*part[:2]) / part.resistances[name]
                for part in self.resisting
            )
            for name in self.resistances
        }

    @property
    def resistances(self) -> Mapping[str, float]:
        """The resistances that the case gives at the base, to "shear" [N] and "moment" [N m]."""
        return self.case.parts[0].resistances

    @cached_property
    def uses(self) -> dict[str, Use]:
        """Where "shear" and "moment" use most of what the column resists, if it is given."""
        found = {}
        for name in self.resistances:
            uses = [
                Use(part, self.demands_of(part)[name], part.resistances[name])
                for part in self.resisting
            ]
            found[name] = max(uses, key=lambda use: use.utilisation)
        return found

    @property
    def utilisations(self) -> dict[str, float]:
        """Demand over resistance, "shear" and "moment", where the case gives a resistance [-]."""
        return {name: use.utilisation for name, use in self.uses.items()}

    @property
    def upper_utilisations(self) -> dict[str, float]:
        """What 95 % of the sampled trucks stay below; empty without a spread [-]."""
        return self.upper_utilisations_by(self.case.inputs.member_forces)

    def upper_utilisations_by(self, method: str) -> dict[str, float]:
        """Return them by one of the methods of `sampled_demands`."""
        if not self.band.spread:
            return {}
        return {name: self._upper_utilisation(name, method) for name in self.resistances}

    def _upper_utilisation(self, name: str, method: str) -> float:
        of_parts = [
            sampled[name][method] / part.resistances[name]
            for part, sampled in zip(self.resisting, self._sampled_by_part, strict=True)
        ]
        return float(quantiles(np.fmax.reduce(of_parts))[-1])

    def to_dataframe(self) -> Any:
        """Return the results as a pandas table: a row for each, its value in SI units and its unit.

        What there is none of, as the peak of a cargo that does not meet the pier, is nan. The
        column "value" of several cases side by side is their summary: `pandas.concat`.

        Raises
        ------
        ModuleNotFoundError
            When pandas is not installed.
        """
        try:
            from pandas import DataFrame
        except ModuleNotFoundError as error:
            message = "to_dataframe needs pandas: pip install pandas"
            raise ModuleNotFoundError(message, name=error.name) from None
        history, cargo = self.history, self.history.cargo_peak
        low, _, high = self.reaction_band or (None, None, None)
        utilisations, upper = self.utilisations, self.upper_utilisations
        (_, shear_high), (_, moment_high) = (
            self.demand_bands.get(name, (None, None)) for name in ("shear", "moment")
        )
        rows = {
            "impact_height": (self.struck.impact_height, "m"),
            "pier_mass": (self.pier.mass, "kg"),
            "pier_stiffness": (self.pier.stiffness, "N/m"),
            "pier_frequency": (self.pier.frequency, "Hz"),
            "engine_peak": (history.engine_peak.reaction, "N"),
            "cargo_peak": (None if cargo is None else cargo.reaction, "N"),
            "design_reaction": (self.design_force, "N"),
            "hand_reaction": (self.short.reaction, "N"),
            "band_low": (low, "N"),
            "band_high": (high, "N"),
            "largest_shear": (self.demands["shear"].value, "N"),
            "largest_moment": (self.demands["moment"].value, "N m"),
            "shear_high": (shear_high, "N"),
            "moment_high": (moment_high, "N m"),
            "code_ratio": (self.code_ratio, "-"),
            "shear_utilisation": (utilisations.get("shear"), "-"),
            "moment_utilisation": (utilisations.get("moment"), "-"),
            "upper_shear_utilisation": (upper.get("shear"), "-"),
            "upper_moment_utilisation": (upper.get("moment"), "-"),
        }
        frame = DataFrame.from_dict(rows, orient="index", columns=["value", "unit"])
        return frame.astype({"value": float})


def calculate(case: Case) -> Calculation:
    """Calculate a case."""

    def impact(height: float) -> Impact:
        struck = case.column.struck_at(height)
        pier = struck.equivalent(case.inputs.damping_ratio)
        return Impact(case=case, struck=struck, history=_with_reversal(case, pier))

    return Calculation(case=case, impacts=tuple(map(impact, case.impact_heights)))


def _largest_of(found: Sequence[dict[str, dict[str, Array]]]) -> dict[str, dict[str, Array]]:
    """Return the largest of what each of several has, by name and method."""
    return {
        name: {method: np.fmax.reduce([own[name][method] for own in found]) for method in by_method}
        for name, by_method in found[0].items()
    }


def _limit(struck: StruckColumn, part: Part) -> float:
    """Return the reaction that makes a part yield in bending [N]."""
    largest = struck.member_forces(1.0).moment_within(*part[:2])
    return part.resistances["moment"] / largest if largest > 0.0 else math.inf


def _with_reversal(case: Case, pier: EquivalentPier) -> CollisionHistory:
    """Return the collision, followed for all windows and until the pier has swung back.

    Without damping it may throw a truck about for ever, of which a part is enough.
    """
    history = simulate(case.truck, pier, case.inputs.speed, max(WINDOWS))
    for _ in range(_EXTENSIONS):
        if history.has_swung_back:
            break
        longer = 1.25 * history.end.time + 1.0 / pier.frequency  # numerical: any would do
        history = simulate(case.truck, pier, case.inputs.speed, longer)
    return history
