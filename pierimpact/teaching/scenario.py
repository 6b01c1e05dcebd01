"""One collision of the explorers: truck, column and speed, with its history and spectra."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from pierimpact.checks import InputError
from pierimpact.collision.history import CollisionHistory
from pierimpact.collision.simulate import simulate
from pierimpact.design.reaction import DesignReaction, design_reaction
from pierimpact.files.trucks import load_truck
from pierimpact.pier.column import PierColumn, StruckColumn
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.pier.sections import CircularSection
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.truck import Truck

REFERENCE = load_truck("single-unit-8t")
#: Names of the parameters of a crush law.
SPRING = tuple(CrushSpring.__dataclass_fields__)
# A history on show covers so much time at least, and more in steps, so that its axis keeps still
# while a slider moves [s].
_SHORTEST, _STEP = 0.16, 0.02
#: Ends of the spectra in the notebooks [Hz].
FREQUENCIES = 2.0, 200.0


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """The values behind the sliders, in SI units; names are those of case and truck files.

    Parameters
    ----------
    speed, truck_mass : float
        Speed at first touch [m/s] and total mass of the truck [kg].
    column_diameter, column_height, impact_height : float
        Of the column [m].
    base, top : {"fixed", "pinned", "free"}
        Its ends.
    damping_ratio : float
        Of the pier [-].
    elastic_modulus, density : float
        Of the column's concrete [Pa], [kg/m³]; usual values, assumed.
    pier_mass, pier_frequency : float or None
        Equivalent mass [kg] and frequency [Hz], where they are given instead of a column.
    engine_mass, friction_force and the crush-law parameters : float
        Of the truck; the reference truck's by default.
    traffic_volume, truck_share, distance_from_road : float
        Of the traffic beside the pier: vehicles in a time [1/s], share of trucks [-], distance [m].
    mean_mass, mean_speed : float
        Of its trucks [kg], [m/s].
    resistance : float
        Reaction that the pier resists [N].
    risk_pier : str
        Pier of the risk, by its frequency.

    Raises
    ------
    InputError
        When a value breaks a rule, by the first property that rests on it.
    """

    speed: float = 80.0 / 3.6
    truck_mass: float = REFERENCE.mass
    column_diameter: float = 0.914
    column_height: float = 5.0
    impact_height: float = 1.2
    base: str = "fixed"
    top: str = "pinned"
    damping_ratio: float = 0.05
    elastic_modulus: float = 25e9
    density: float = 2400.0
    pier_mass: float | None = None
    pier_frequency: float | None = None
    engine_mass: float = REFERENCE.engine_mass
    friction_force: float = REFERENCE.friction_force
    engine_plateau_force: float = REFERENCE.engine_spring.plateau_force
    engine_plateau_length: float = REFERENCE.engine_spring.plateau_length
    engine_stiffness: float = REFERENCE.engine_spring.stiffness
    engine_unloading_stiffness: float = REFERENCE.engine_spring.unloading_stiffness
    body_plateau_force: float = REFERENCE.body_spring.plateau_force
    body_plateau_length: float = REFERENCE.body_spring.plateau_length
    body_stiffness: float = REFERENCE.body_spring.stiffness
    body_unloading_stiffness: float = REFERENCE.body_spring.unloading_stiffness
    traffic_volume: float = 20e3 / 86400.0
    truck_share: float = 0.15
    distance_from_road: float = 6.0
    mean_mass: float = 20e3
    mean_speed: float = 80.0 / 3.6
    resistance: float = 5e6
    risk_pier: str = "30 Hz"

    @cached_property
    def truck(self) -> Truck:
        """The truck."""
        own: dict[str, Any] = {
            name: getattr(self, name) for name in ("engine_mass", "friction_force")
        }
        for body in ("engine", "body"):
            law = {name: getattr(self, f"{body}_{name}") for name in SPRING}
            try:
                own[f"{body}_spring"] = CrushSpring(**law)
            except InputError as error:
                raise InputError(f"{body} spring: {error}") from None
        return replace(REFERENCE, **own).loaded_to(self.truck_mass)

    @cached_property
    def column(self) -> PierColumn:
        """The column."""
        return PierColumn(
            height=self.column_height,
            section=CircularSection(diameter=self.column_diameter),
            elastic_modulus=self.elastic_modulus,
            density=self.density,
            base=self.base,
            top=self.top,
        )

    @cached_property
    def struck_column(self) -> StruckColumn | None:
        """The column as struck; None where only the pier's mass and frequency are given."""
        given = self.pier_mass is not None and self.pier_frequency is not None
        return None if given else self.column.struck_at(self.impact_height)

    @cached_property
    def pier(self) -> EquivalentPier:
        """The pier."""
        mass, frequency = self.pier_mass, self.pier_frequency
        if mass is not None and frequency is not None:
            return EquivalentPier.from_frequency(mass, frequency, self.damping_ratio)
        return self.column.struck_at(self.impact_height).equivalent(self.damping_ratio)

    @cached_property
    def history(self) -> CollisionHistory:
        """The collision by the full model, until a while after its last peak."""
        history = simulate(self.truck, self.pier, self.speed, _SHORTEST)
        last = max(peak.time for peak in history.peaks.values() if peak is not None)
        end = max(_SHORTEST, _STEP * math.ceil(1.1 * last / _STEP))
        if history.end.time < end:
            history = simulate(self.truck, self.pier, self.speed, end)
        steps = [
            (state, law, min(length, end - state.time))
            for state, law, length in history.steps
            if state.time < end
        ]
        return replace(history, steps=steps)  # its peaks stay those of the whole

    def design(self, level: str) -> DesignReaction:
        """Return the design reaction of the collision by one of the levels."""
        return design_reaction(self.truck, self.pier, self.speed, level)


#: The pier of the lessons on reduction and spectra: between soft and stiff.
EXAMPLE = Scenario(pier_mass=8e3, pier_frequency=30.0)
