"""A truck strikes a pier: the collision as users give it, and the plain numbers of its equations.

In `Parameters` and `Spring` each number is a float for one collision, or an array of shape (n,)
for n collisions side by side.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from pierimpact.checks import (
    InputError,
    positive,
    positive_array,
    positive_or_infinite_array,
    ratio_array,
)
from pierimpact.collision.groups import CHUNK, select
from pierimpact.collision.series import Flag, Real
from pierimpact.pier.beam import BeamPier
from pierimpact.pier.equivalent import EquivalentPier, damping_coefficient
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.truck import Truck


class Spring(NamedTuple):
    """A crush law (`pierimpact.vehicle.crush`) and the mass behind it."""

    mass: Real
    plateau_force: Real
    plateau_length: Real
    stiffness: Real
    unloading_stiffness: Real


class Parameters(NamedTuple):
    """Truck, pier and speed as the numbers of the equations of motion, in SI units."""

    engine: Spring
    body: Spring
    friction_force: Real
    on_pier: Flag
    pier_mass: Real
    pier_stiffness: Real
    pier_damping: Real
    speed: Real
    yield_reaction: Real | None = None  # None where no pier can yield


@dataclass(frozen=True)
class Collision:
    """A truck that strikes a pier.

    Parameters
    ----------
    truck : Truck
        The truck.
    pier : EquivalentPier or BeamPier
        The pier.
    speed : float
        Speed of the truck at first touch [m/s].

    Raises
    ------
    InputError
        When truck or pier is of another type, a beam is to yield, or the speed is not positive.

    Examples
    --------
    >>> from pierimpact import Collision, EquivalentPier, load_truck
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    >>> collision = Collision(load_truck("single-unit-8t"), pier, speed=20.0)
    >>> round(collision.energy / 1e6, 3)  # MJ
    1.6
    """

    truck: Truck
    pier: EquivalentPier | BeamPier
    speed: float

    def __post_init__(self) -> None:
        if not isinstance(self.truck, Truck):
            raise InputError(f"truck must be a Truck, got {type(self.truck).__name__}")
        if not isinstance(self.pier, EquivalentPier | BeamPier):
            raise InputError(
                f"pier must be an EquivalentPier or a BeamPier, got {type(self.pier).__name__}"
            )
        if isinstance(self.pier, BeamPier) and self.pier.equivalent.yields:
            raise InputError(
                f"pier must be an EquivalentPier where it yields, for a BeamPier is elastic, got a "
                f"BeamPier with yield_reaction {self.pier.equivalent.yield_reaction:g} N"
            )
        object.__setattr__(self, "speed", positive("speed", self.speed))

    @property
    def energy(self) -> float:
        """Kinetic energy ½ (m1 + m2) V² of the truck at first touch [J]."""
        return 0.5 * self.truck.mass * self.speed**2

    @property
    def equivalent_pier(self) -> EquivalentPier:
        """The pier as one degree of freedom."""
        return self.pier.equivalent if isinstance(self.pier, BeamPier) else self.pier

    @cached_property
    def parameters(self) -> Parameters:
        """The same as floats, the pier as one degree of freedom."""
        pier = self.equivalent_pier
        numbers = pier.mass, pier.stiffness, pier.damping, self.speed
        return _parameters(_row(self.truck), *numbers, pier.yield_reaction if pier.yields else None)


def parameter_chunks(
    truck: Truck | Sequence[Truck],
    pier_mass: ArrayLike,
    pier_stiffness: ArrayLike,
    damping_ratio: ArrayLike,
    speed: ArrayLike,
    yield_reaction: ArrayLike = math.inf,
) -> tuple[tuple[int, ...], Iterator[tuple[slice, Parameters]]]:
    """Return the shape to which all broadcast, and the parameters of its flat order in chunks.

    Arguments and errors as in `peak_reactions`.
    """
    many = isinstance(truck, Sequence)
    trucks = list(truck) if isinstance(truck, Sequence) else [truck]
    for item in trucks:
        if not isinstance(item, Truck):
            raise InputError(
                f"truck must be a Truck or a sequence of them, got {type(item).__name__}"
            )
    inputs = {
        "pier_mass": positive_array("pier_mass", pier_mass),
        "pier_stiffness": positive_array("pier_stiffness", pier_stiffness),
        "damping_ratio": ratio_array("damping_ratio", damping_ratio),
        "speed": positive_array("speed", speed),
        "yield_reaction": positive_or_infinite_array("yield_reaction", yield_reaction),
    }
    yields = bool(np.isfinite(inputs["yield_reaction"]).any())
    which = np.arange(len(trucks)) if many else np.zeros((), dtype=int)
    try:
        which, *arrays = np.broadcast_arrays(which, *inputs.values())
    except ValueError:
        shapes = {"truck": which.shape} | {name: x.shape for name, x in inputs.items()}
        if not yields:  # nobody has asked for it
            del shapes["yield_reaction"]
        listed = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise InputError(f"shapes must broadcast against each other, got {listed}") from None
    table = np.array([_row(item) for item in trucks]).reshape(-1, 12).T
    flat = [array.reshape(-1) for array in (which, *arrays)]

    def chunks() -> Iterator[tuple[slice, Parameters]]:
        for first in range(0, which.size, CHUNK):
            part = slice(first, first + CHUNK)
            row, mass, stiffness, ratio, velocity, resistance = (array[part] for array in flat)
            numbers = mass, stiffness, damping_coefficient(mass, stiffness, ratio), velocity
            yield part, _parameters(table[:, row], *numbers, resistance if yields else None)

    return which.shape, chunks()


def collision_chunks(collisions: Sequence[Collision]) -> Iterator[tuple[slice, Parameters]]:
    """Return the parameters of collisions in order, in chunks; piers as one degree of freedom."""
    numbers = [
        (pier.mass, pier.stiffness, pier.damping_ratio, own.speed, pier.yield_reaction)
        for own in collisions
        for pier in [own.equivalent_pier]
    ]
    return parameter_chunks([own.truck for own in collisions], *zip(*numbers, strict=True))[1]


def in_chunks(parameters: Parameters) -> Iterator[Parameters]:
    """Return the parameters of many collisions in order, CHUNK at a time."""
    for first in range(0, len(parameters.speed), CHUNK):
        yield select(parameters, slice(first, first + CHUNK))


def _row(truck: Truck) -> tuple[float, ...]:
    """Return a truck as numbers: springs, friction force, and 1 for friction on the pier."""
    return (
        *_spring(truck.engine_mass, truck.engine_spring),
        *_spring(truck.body_mass, truck.body_spring),
        truck.friction_force,
        float(truck.friction_on == "pier"),
    )


def _spring(mass: float, spring: CrushSpring) -> Spring:
    return Spring(mass, *attrgetter(*Spring._fields[1:])(spring))


def _parameters(truck: Any, *pier_and_speed: Real | None) -> Parameters:
    """Return parameters from the numbers of a truck, or of many side by side."""
    engine, body, friction_force, on_pier = truck[:5], truck[5:10], truck[10], truck[11] > 0.0
    return Parameters(Spring(*engine), Spring(*body), friction_force, on_pier, *pier_and_speed)
