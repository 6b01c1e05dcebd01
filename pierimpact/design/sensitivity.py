"""How the reaction changes with speed, truck mass, impact height and pier frequency."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.parameters import Collision
from pierimpact.collision.simulate import peak_reactions
from pierimpact.design.reaction import design_reactions
from pierimpact.pier.column import PierColumn
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.vehicle.truck import Truck

Array: TypeAlias = NDArray[np.float64]

#: The changes that a reviewer asks for, this project's choice: of speed, round in the units of the
#: sheet, 10 km/h or 5 mph [m/s]; and of the share of the truck's mass.
SPEED_CHANGES = {"SI": 10.0 / 3.6, "US": 5.0 * 0.44704}
MASS_CHANGE = 0.2
#: Share by which impact height, or the nearest calculated, and pier frequency change: this
#: project's choice.
NEAR = 0.1

#: Curves run over these shares of the case's value, and that of the height of an impact at the
#: ground over these heights [m]: this project's choice.
SHARES = np.linspace(0.5, 1.5, 31)
_FROM_GROUND = np.linspace(0.0, 1.0, 31)
# And over these frequencies: this project's choice [Hz].
_FREQUENCIES = np.geomspace(2.0, 200.0, 259)


class Variation(NamedTuple):
    """Reactions while one quantity changes and all else stays; arrays of shape (n,) in SI units."""

    values: Array  #: of the quantity
    engine: Array  #: peak of the full model [N]
    cargo: Array  #: the same; nan without cargo contact [N]
    design_engine: Array  #: reaction by the design procedure [N]
    design_cargo: Array  #: the same [N]
    by_engine: NDArray[np.bool_]  #: whether the engine makes its peak, and not sheet metal before

    @property
    def model(self) -> Array:
        """Governing peak of the full model, shape (n,) [N]."""
        return np.fmax(self.engine, self.cargo)

    @property
    def design(self) -> Array:
        """Governing reaction of the design procedure, shape (n,) [N]."""
        return np.fmax(self.design_engine, self.design_cargo)


class Sensitivity(NamedTuple):
    """The variations about one case.

    The last four are for one value each, changed by `speed_change` or MASS_CHANGE; None where
    there is no such speed or mass.
    """

    speed_change: float  #: [m/s]
    speed: Variation  #: over speed [m/s]
    mass: Variation  #: over the truck's total mass [kg]
    impact_height: Variation  #: over the nominal impact height [m]
    frequency: Variation  #: over the pier's frequency, at its own mass and damping [Hz]
    slower: Variation | None
    faster: Variation | None
    lighter: Variation | None
    heavier: Variation | None


def sensitivity(
    truck: Truck,
    column: PierColumn,
    pier: EquivalentPier,
    impact_height: float,
    speed: float,
    speed_change: float = SPEED_CHANGES["SI"],
) -> Sensitivity:
    """Return the variations about a case.

    Parameters
    ----------
    truck, pier, speed
        As in `Collision`; the pier is the column as struck at the impact height.
    column : PierColumn
        The column.
    impact_height : float
        Nominal impact height [m].
    speed_change : float, optional
        How much slower and faster the last variations are [m/s].
    """

    def at_speed(value: float) -> Collision | None:
        return Collision(truck, pier, value) if value > 0.0 else None

    def at_mass(value: float) -> Collision | None:
        if value <= truck.engine_mass:
            return None
        return Collision(truck.loaded_to(value), pier, speed)

    def at_height(value: float) -> Collision | None:
        if value >= column.height:
            return None
        other = column.struck_at(value).equivalent(pier.damping_ratio)
        return Collision(truck, other, speed)

    def at_frequency(value: float) -> Collision:
        other = EquivalentPier.from_frequency(pier.mass, value, pier.damping_ratio)
        return Collision(truck, other, speed)

    mass = truck.mass
    around = pier.frequency * np.array([1.0 - NEAR, 1.0, 1.0 + NEAR])
    asked: dict[str, tuple[Any, Callable[[float], Collision | None]]] = {
        "speed": (speed * SHARES, at_speed),
        "mass": (mass * SHARES, at_mass),
        "impact_height": (impact_height * SHARES if impact_height else _FROM_GROUND, at_height),
        "frequency": (np.unique(np.append(_FREQUENCIES, around)), at_frequency),
        "slower": ([speed - speed_change], at_speed),
        "faster": ([speed + speed_change], at_speed),
        "lighter": ([mass * (1.0 - MASS_CHANGE)], at_mass),
        "heavier": ([mass * (1.0 + MASS_CHANGE)], at_mass),
    }
    collisions = {
        name: {float(value): changed for value in values if (changed := at(float(value)))}
        for name, (values, at) in asked.items()
    }
    return Sensitivity(speed_change, **_reactions(collisions))  # type: ignore[arg-type]


def _reactions(collisions: Mapping[str, Mapping[float, Collision]]) -> dict[str, Variation | None]:
    """Return the variations by name, None for those without a value; all in one go."""
    together = [collision for part in collisions.values() for collision in part.values()]
    trucks = [collision.truck for collision in together]
    piers = [collision.equivalent_pier for collision in together]
    mass, stiffness, ratio = np.array([(p.mass, p.stiffness, p.damping_ratio) for p in piers]).T
    speed = [collision.speed for collision in together]
    peaks = peak_reactions(trucks, mass, stiffness, ratio, speed)
    design = design_reactions(trucks, mass, stiffness, ratio, speed, level="short")
    by_engine = peaks.engine_contact_time <= peaks.engine_time
    results = (peaks.engine, peaks.cargo, design.engine, design.cargo, by_engine)
    ends = np.cumsum([len(part) for part in collisions.values()])
    return {
        name: Variation._make(
            (np.array(list(part)), *(result[end - len(part) : end] for result in results))
        )
        if part
        else None
        for (name, part), end in zip(collisions.items(), ends, strict=True)
    }
