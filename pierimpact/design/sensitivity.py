"""How the reaction changes with speed, truck mass, impact height and pier frequency."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.parameters import Collision
from pierimpact.collision.simulate import peak_reactions
from pierimpact.design.reaction import design_reactions
from pierimpact.pier.column import PierColumn
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.vehicle.truck import Truck

Array: TypeAlias = NDArray[np.float64]

#: The changes that a reviewer asks for: of speed [m/s], and of the share of the truck's mass.
SPEED_CHANGE, MASS_CHANGE = 10.0 / 3.6, 0.2

# Curves run over these shares of the case's value, and over these frequencies [Hz].
_SHARES = np.linspace(0.5, 1.5, 31)
_FREQUENCIES = np.geomspace(2.0, 200.0, 130)


@dataclass(frozen=True, kw_only=True)
class Variation:
    """Reactions while one quantity changes and all else stays.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Values of the quantity [SI].
    engine, cargo : ndarray, shape (n,)
        Peaks of the full model; `cargo` is nan without cargo contact [N].
    design_engine, design_cargo : ndarray, shape (n,)
        The same by the design procedure [N].
    """

    values: Array
    engine: Array
    cargo: Array
    design_engine: Array
    design_cargo: Array

    @property
    def model(self) -> Array:
        """Governing peak of the full model, shape (n,) [N]."""
        return np.fmax(self.engine, self.cargo)

    @property
    def design(self) -> Array:
        """Governing reaction of the design procedure, shape (n,) [N]."""
        return np.fmax(self.design_engine, self.design_cargo)


@dataclass(frozen=True, kw_only=True)
class Sensitivity:
    """The variations about one case.

    Parameters
    ----------
    speed, mass, impact_height, frequency : Variation
        Over speed [m/s], total mass of the truck [kg], nominal impact height [m] and, at the
        pier's own mass and damping, its frequency [Hz].
    slower, faster, lighter, heavier : Variation or None
        The speed changed by SPEED_CHANGE, the mass by MASS_CHANGE: one value each; None where
        there is no such speed or mass.
    """

    speed: Variation
    mass: Variation
    impact_height: Variation
    frequency: Variation
    slower: Variation | None
    faster: Variation | None
    lighter: Variation | None
    heavier: Variation | None


def sensitivity(
    truck: Truck, column: PierColumn, pier: EquivalentPier, impact_height: float, speed: float
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
    """

    def at_speed(value: float) -> Collision | None:
        return Collision(truck, pier, value) if value > 0.0 else None

    def at_mass(value: float) -> Collision | None:
        if value <= truck.engine_mass:
            return None
        return Collision(truck.with_mass(value), pier, speed)

    def at_height(value: float) -> Collision | None:
        if value >= column.height:
            return None
        return Collision(truck, column.equivalent(value, pier.damping_ratio), speed)

    def at_frequency(value: float) -> Collision:
        other = EquivalentPier.from_frequency(pier.mass, value, pier.damping_ratio)
        return Collision(truck, other, speed)

    mass = truck.mass
    asked: dict[str, tuple[Any, Callable[[float], Collision | None]]] = {
        "speed": (speed * _SHARES, at_speed),
        "mass": (mass * _SHARES, at_mass),
        "impact_height": (impact_height * _SHARES, at_height),
        "frequency": (np.unique(np.append(_FREQUENCIES, pier.frequency)), at_frequency),
        "slower": ([speed - SPEED_CHANGE], at_speed),
        "faster": ([speed + SPEED_CHANGE], at_speed),
        "lighter": ([mass * (1.0 - MASS_CHANGE)], at_mass),
        "heavier": ([mass * (1.0 + MASS_CHANGE)], at_mass),
    }
    collisions = {
        name: {float(value): changed for value in values if (changed := at(float(value)))}
        for name, (values, at) in asked.items()
    }
    return Sensitivity(**_reactions(collisions))  # type: ignore[arg-type]


def _reactions(
    collisions: Mapping[str, Mapping[float, Collision]],
) -> dict[str, Variation | None]:
    """Return the variations by name, None for those without a value; all in one go."""
    together = [collision for part in collisions.values() for collision in part.values()]
    trucks = [collision.truck for collision in together]
    piers = [(c.pier.mass, c.pier.stiffness, c.pier.damping_ratio, c.speed) for c in together]
    mass, stiffness, ratio, speed = np.array(piers).T
    peaks = peak_reactions(trucks, mass, stiffness, ratio, speed)
    design = design_reactions(trucks, mass, stiffness, ratio, speed, level="long")
    found: dict[str, Variation | None] = {}
    first = 0
    for name, part in collisions.items():
        where = slice(first, first + len(part))
        first += len(part)
        found[name] = (
            Variation(
                values=np.array(list(part)),
                engine=peaks.engine[where],
                cargo=peaks.cargo[where],
                design_engine=design.engine[where],
                design_cargo=design.cargo[where],
            )
            if part
            else None
        )
    return found
