"""The collision by the coupled mass-spring-damper (CMSD) model."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import InputError, not_negative, positive, positive_array, ratio_array
from pierimpact.crush import CrushSpring
from pierimpact.history import CollisionHistory, RecordedStep
from pierimpact.motion import OUTCOMES, Collision, Spring, State, Step, follow, follow_all
from pierimpact.pier import EquivalentPier
from pierimpact.truck import Truck

CHUNK = 2048  # collisions side by side: their arrays stay in the processor's cache


def simulate(
    truck: Truck, pier: EquivalentPier, speed: float, duration: float = 0.0
) -> CollisionHistory:
    """Simulate one collision.

    Parameters
    ----------
    truck : Truck
        The truck.
    pier : EquivalentPier
        The pier.
    speed : float
        Speed of the truck at first touch [m/s].
    duration : float, optional
        Time that the history covers at least [s]. It always goes on until no later instant can
        raise a peak or bring a first contact.

    Returns
    -------
    CollisionHistory
        Peaks, contact times and time histories.

    Raises
    ------
    InputError
        When the speed is not positive or the duration is negative.
    """
    speed, duration = positive("speed", speed), not_negative("duration", duration)
    case = Collision(
        engine=_spring(truck.engine_mass, truck.engine_spring),
        body=_spring(truck.body_mass, truck.body_spring),
        friction_force=truck.friction_force,
        on_pier=truck.friction_on == "pier",
        pier_mass=pier.mass,
        pier_stiffness=pier.stiffness,
        pier_damping=pier.damping,
        speed=speed,
    )
    steps: list[RecordedStep] = []

    def record(state: State, step: Step, length: float) -> None:
        if length > 0.0:
            steps.append((state, step, length))

    end = follow(case, duration, record)
    return CollisionHistory(truck=truck, pier=pier, speed=speed, case=case, steps=steps, end=end)


def _spring(mass: float, spring: CrushSpring) -> Spring:
    return Spring(
        mass,
        spring.plateau_force,
        spring.plateau_length,
        spring.stiffness,
        spring.unloading_stiffness,
    )


@dataclass(frozen=True, kw_only=True)
class PeakReactions:
    """The peaks of many collisions, each an array of the shape the inputs broadcast to.

    Parameters
    ----------
    engine, cargo : ndarray
        Peak reactions before and from cargo contact on; `cargo` is nan without it [N].
    engine_time, cargo_time : ndarray
        When they occur [s].
    engine_contact_time, cargo_contact_time : ndarray
        When engine and cargo first meet the pier; nan where they do not [s].
    """

    engine: NDArray[np.float64]
    cargo: NDArray[np.float64]
    engine_time: NDArray[np.float64]
    cargo_time: NDArray[np.float64]
    engine_contact_time: NDArray[np.float64]
    cargo_contact_time: NDArray[np.float64]

    @property
    def governing(self) -> NDArray[np.float64]:
        """The larger of the two peaks [N]."""
        return np.fmax(self.engine, self.cargo)


def peak_reactions(
    truck: Truck | Sequence[Truck],
    pier_mass: ArrayLike,
    pier_stiffness: ArrayLike,
    damping_ratio: ArrayLike,
    speed: ArrayLike,
) -> PeakReactions:
    """Return the peak reactions of many collisions.

    The collisions advance side by side by the same equations as in `simulate`; memory does not
    grow beyond inputs and results.

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

    Returns
    -------
    PeakReactions
        Arrays of the shape to which the inputs broadcast.

    Raises
    ------
    InputError
        When a value is out of range or the shapes do not broadcast.
    """
    trucks = [truck] if isinstance(truck, Truck) else list(truck)
    inputs = {
        "pier_mass": positive_array("pier_mass", pier_mass),
        "pier_stiffness": positive_array("pier_stiffness", pier_stiffness),
        "damping_ratio": ratio_array("damping_ratio", damping_ratio),
        "speed": positive_array("speed", speed),
    }
    which = np.zeros((), dtype=int) if isinstance(truck, Truck) else np.arange(len(trucks))
    try:
        which, *arrays = np.broadcast_arrays(which, *inputs.values())
    except ValueError:
        shapes = {"truck": which.shape} | {name: np.shape(x) for name, x in inputs.items()}
        listed = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise InputError(f"shapes must broadcast against each other, got {listed}") from None
    table = _table(trucks)
    shape, size = which.shape, which.size
    which, mass, stiffness, ratio, speeds = (array.reshape(-1) for array in (which, *arrays))
    outcomes = np.empty((len(OUTCOMES), size))
    for first in range(0, size, CHUNK):
        part = slice(first, first + CHUNK)
        columns = table[:, which[part]]
        case = Collision(
            engine=Spring(*columns[0:5]),
            body=Spring(*columns[5:10]),
            friction_force=columns[10],
            on_pier=columns[11] > 0.0,
            pier_mass=mass[part],
            pier_stiffness=stiffness[part],
            pier_damping=2.0 * ratio[part] * np.sqrt(stiffness[part] * mass[part]),
            speed=speeds[part],
        )
        outcomes[:, part] = follow_all(case)
    found = dict(zip(OUTCOMES, outcomes.reshape(-1, *shape), strict=True))
    whole = stiffness.reshape(shape)
    return PeakReactions(
        engine=whole * found["engine_peak"],
        cargo=whole * found["cargo_peak"],
        engine_time=found["engine_peak_time"],
        cargo_time=found["cargo_peak_time"],
        engine_contact_time=found["engine_contact"],
        cargo_contact_time=found["cargo_contact"],
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
