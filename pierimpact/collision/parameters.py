"""From trucks, piers and speeds to the plain numbers of the equations."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import InputError, positive_array, ratio_array
from pierimpact.collision.groups import CHUNK
from pierimpact.collision.regimes import Collision, Spring
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.truck import Truck


def collision(truck: Truck, pier: EquivalentPier, speed: float) -> Collision:
    """Return one collision, in floats.

    Raises
    ------
    InputError
        When `truck` or `pier` is not what it should be.
    """
    if not isinstance(truck, Truck):
        raise InputError(f"truck must be a Truck, got {type(truck).__name__}")
    if not isinstance(pier, EquivalentPier):
        raise InputError(f"pier must be an EquivalentPier, got {type(pier).__name__}")
    return Collision(
        engine=_spring(truck.engine_mass, truck.engine_spring),
        body=_spring(truck.body_mass, truck.body_spring),
        friction_force=truck.friction_force,
        on_pier=truck.friction_on == "pier",
        pier_mass=pier.mass,
        pier_stiffness=pier.stiffness,
        pier_damping=pier.damping,
        speed=speed,
    )


def collisions(
    truck: Truck | Sequence[Truck],
    pier_mass: ArrayLike,
    pier_stiffness: ArrayLike,
    damping_ratio: ArrayLike,
    speed: ArrayLike,
) -> tuple[tuple[int, ...], Iterator[tuple[slice, Collision]]]:
    """Return the shape to which all broadcast, and the collisions of its flat order in chunks.

    Parameters
    ----------
    truck : Truck or sequence of Truck
        One truck for all, or one for each; a sequence of n broadcasts as shape (n,).
    pier_mass, pier_stiffness : array_like
        Equivalent mass [kg] and stiffness [N/m] of the piers.
    damping_ratio : array_like
        Fraction of critical damping, from 0 to below 1 [-].
    speed : array_like
        Speeds at first touch [m/s].

    Raises
    ------
    InputError
        When a value is out of range or the shapes do not broadcast.
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
    }
    which = np.arange(len(trucks)) if many else np.zeros((), dtype=int)
    try:
        which, *arrays = np.broadcast_arrays(which, *inputs.values())
    except ValueError:
        shapes = {"truck": which.shape} | {name: x.shape for name, x in inputs.items()}
        listed = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise InputError(f"shapes must broadcast against each other, got {listed}") from None
    return which.shape, _chunks(_table(trucks), which, arrays)


def _chunks(
    table: NDArray[np.float64], which: NDArray[np.int_], arrays: Sequence[NDArray[np.float64]]
) -> Iterator[tuple[slice, Collision]]:
    which = which.reshape(-1)
    mass, stiffness, ratio, speed = (array.reshape(-1) for array in arrays)
    for first in range(0, len(which), CHUNK):
        part = slice(first, first + CHUNK)
        columns = table[:, which[part]]
        yield (
            part,
            Collision(
                engine=Spring(*columns[0:5]),
                body=Spring(*columns[5:10]),
                friction_force=columns[10],
                on_pier=columns[11] > 0.0,
                pier_mass=mass[part],
                pier_stiffness=stiffness[part],
                pier_damping=2.0 * ratio[part] * np.sqrt(stiffness[part] * mass[part]),
                speed=speed[part],
            ),
        )


def _table(trucks: Sequence[Truck]) -> NDArray[np.float64]:
    """Return one column of parameters a truck, in the order of the equations' structures."""
    rows = [
        (
            *_spring(truck.engine_mass, truck.engine_spring),
            *_spring(truck.body_mass, truck.body_spring),
            truck.friction_force,
            float(truck.friction_on == "pier"),
        )
        for truck in trucks
    ]
    return np.array(rows).reshape(-1, 12).T


def _spring(mass: float, spring: CrushSpring) -> Spring:
    return Spring(
        mass,
        spring.plateau_force,
        spring.plateau_length,
        spring.stiffness,
        spring.unloading_stiffness,
    )
