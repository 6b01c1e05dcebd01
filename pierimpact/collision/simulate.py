"""The collision by the coupled mass-spring-damper (CMSD) model."""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import not_negative
from pierimpact.collision.beam import ModalMotion, propagate_beam
from pierimpact.collision.beam_history import BeamCollisionHistory
from pierimpact.collision.history import CollisionHistory, RecordedStep
from pierimpact.collision.parameters import Collision, parameter_chunks
from pierimpact.collision.propagation import Outcomes, propagate, propagate_all
from pierimpact.collision.regimes import LinearMotion, State
from pierimpact.pier.beam import BeamPier
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.vehicle.truck import Truck

SHORTEST = 1e-13  # numerical: step recorded; shorter ones are round-off [s]


def simulate(
    truck: Truck, pier: EquivalentPier | BeamPier, speed: float, duration: float = 0.0
) -> CollisionHistory:
    """Simulate one collision.

    Parameters
    ----------
    truck, pier, speed
        As in `Collision`.
    duration : float, optional
        Time that the history covers at least [s]. It always goes on until no later instant can
        raise a peak, bring a first contact or let the pier yield, and a beam has vibrated for a
        period of its first mode since the last change.

    Returns
    -------
    CollisionHistory
        Peaks, contact times and time histories; with a beam, member forces.

    Raises
    ------
    InputError
        As in `Collision`, and when the duration is negative.
    RuntimeError
        When the collision does not come to an end within a limit of steps, far beyond what any
        real truck and pier need.

    Examples
    --------
    >>> from pierimpact import EquivalentPier, load_truck, simulate
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    >>> history = simulate(load_truck("single-unit-8t"), pier, speed=22.2)
    >>> history.governs
    'cargo'
    >>> round(history.governing_peak.reaction / 1e6, 2)  # MN
    4.88
    """
    collision, duration = Collision(truck, pier, speed), not_negative("duration", duration)
    if isinstance(collision.pier, BeamPier):
        return _simulate_beam(collision, collision.pier, duration)
    steps: list[RecordedStep] = []

    def record(state: State, motion: LinearMotion, length: float) -> None:
        if length > SHORTEST:
            steps.append((state, motion, length))

    end = propagate(collision.parameters, duration, record)
    return CollisionHistory(collision=collision, steps=steps, end=end)


def _simulate_beam(collision: Collision, beam: BeamPier, duration: float) -> BeamCollisionHistory:
    steps: list[RecordedStep] = []
    modal_steps: list[tuple[ModalMotion, NDArray[np.float64]]] = []

    def record(
        state: State,
        motion: LinearMotion,
        length: float,
        modal: ModalMotion,
        y: NDArray[np.float64],
    ) -> None:
        if length > SHORTEST:
            steps.append((state, motion, length))
            modal_steps.append((modal, y))

    end = propagate_beam(collision, beam, duration, record)
    return BeamCollisionHistory(
        collision=collision, steps=steps, end=end, beam=beam, modal_steps=modal_steps
    )


class PeakReactions(NamedTuple):
    """The peaks of many collisions, each an array of the shape the inputs broadcast to.

    Examples
    --------
    >>> from pierimpact import load_truck, peak_reactions
    >>> peaks = peak_reactions(load_truck("single-unit-8t"), 8e3, 300e6, 0.05, [10.0, 22.2])
    >>> (peaks.governing / 1e6).round(2)  # MN
    array([1.2 , 4.97])
    >>> peaks.cargo_contact_time.round(3)  # s; a slow truck stops before its cargo arrives
    array([  nan, 0.103])
    """

    engine: NDArray[np.float64]  #: peak reaction before cargo contact [N]
    cargo: NDArray[np.float64]  #: peak reaction from cargo contact on; nan without it [N]
    engine_time: NDArray[np.float64]  #: when the peaks occur [s]
    cargo_time: NDArray[np.float64]
    engine_contact_time: NDArray[np.float64]  #: when engine and cargo first meet the pier; nan
    cargo_contact_time: NDArray[np.float64]  #: where they do not [s]
    ductility: NDArray[np.float64]  #: largest |x_p| over R_y/k_p; zero where R_y is infinite [-]
    residual_displacement: NDArray[np.float64]  #: plastic part of x_p at the end [m]
    plastic_energy: NDArray[np.float64]  #: dissipated by the yielding pier [J]

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
    yield_reaction: ArrayLike = math.inf,
    progress: Callable[[int], object] = lambda count: None,
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
    yield_reaction : array_like, optional
        Reactions at which the piers yield; infinite where they never do [N].
    progress : callable, optional
        Called now and then with the number of collisions done since the last call; the `update`
        of a progress bar of `tqdm`, say.

    Returns
    -------
    PeakReactions
        Arrays of the shape to which the inputs broadcast.

    Raises
    ------
    InputError
        When a value is out of range or the shapes do not broadcast.

    Warns
    -----
    UnfinishedWarning
        When a collision does not come to an end within a limit of steps; all its results are nan,
        and the warning has its index. None is known to: a pier that has less than a twentieth of
        the truck's mass and hardly resists, far below 1 Hz or with a yield reaction of some kN,
        bounces on the truck thousands of times before it has stopped it and takes a quarter of the
        limit and some seconds; no real truck and pier need a thousandth.

    Examples
    --------
    >>> from pierimpact import load_truck, peak_reactions
    >>> peaks = peak_reactions(
    ...     load_truck("single-unit-8t"),
    ...     pier_mass=8e3,
    ...     pier_stiffness=[100e6, 300e6],
    ...     damping_ratio=0.05,
    ...     speed=22.2,
    ... )
    >>> (peaks.engine / 1e6).round(2)  # MN
    array([2.18, 2.8 ])
    """
    shape, chunks = parameter_chunks(
        truck, pier_mass, pier_stiffness, damping_ratio, speed, yield_reaction
    )
    parameters = (chunk for _, chunk in chunks)
    found = propagate_all(parameters, shape, progress=progress)
    return peak_reactions_of(found, pier_stiffness, yield_reaction)


def peak_reactions_of(
    found: Outcomes, pier_stiffness: ArrayLike, yield_reaction: ArrayLike
) -> PeakReactions:
    """Return the peaks of collisions from their outcomes, arguments as in `peak_reactions`."""
    stiffness, resistance = (np.asarray(x, dtype=float) for x in (pier_stiffness, yield_reaction))
    return PeakReactions(
        engine=np.minimum(stiffness * found.engine_peak, resistance),
        cargo=np.minimum(stiffness * found.cargo_peak, resistance),
        engine_time=found.engine_peak_time,
        cargo_time=found.cargo_peak_time,
        engine_contact_time=found.engine_contact,
        cargo_contact_time=found.cargo_contact,
        ductility=stiffness * found.largest / resistance,
        residual_displacement=found.displacement,
        # An infinite resistance has no path to be multiplied by.
        plastic_energy=np.where(np.isfinite(resistance), resistance, 0.0) * found.path,
    )
