"""The collision with a beam, propagated exactly.

Regimes and events are those of the pier with one degree of freedom. The motion of a regime is a
matrix, which holds the modal coordinates of the beam: the states after steps of one length follow
from its powers, many at once, and each step is searched for the first event by its Taylor series.

The steps are as short as the highest shape needs. Where the contact force does not depend on the
motion the shapes are independent, and those whose vibration has died out are left out.
"""

import math
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.parameters import Collision
from pierimpact.collision.regimes import (
    NO_EVENT,
    LinearMotion,
    Position,
    State,
    accelerations,
    change_regime,
    linear_motion,
    raise_peak,
    start,
)
from pierimpact.collision.series import ARRAYS, FLOATS, TERMS, weights_of_one
from pierimpact.collision.stepping import (
    event_functions,
    first_event,
    longest_step,
    may_rise,
    prospects,
)
from pierimpact.pier.beam import BeamPier

Array: TypeAlias = NDArray[np.float64]

# Numerical settings.
STEPS = 10_000  # limit of blocks of steps that change a regime, or come after all was over
DOUBLINGS = 4  # of the number of steps taken together, from one on
FEWEST_MOVING = 8  # shapes that are always followed
STILL = 1e-26  # share of the energy below which the vibration of a shape has died out


class ModalMotion:
    """The motion of one regime as a matrix.

    With n moving shapes, the state y is δ1, δ1', δ2, δ2', q (n,), q' (n,) and three constants: the
    intercepts of the springs' lines and the friction.

    q'' = φ F − 2 ζ ω q' − ω² q, where x_p = Σ φ q. The contact force is F = m_e x_p'' + S with
    m_e = 1/Σ φ² and the beam's resistance S = m_e Σ φ (2 ζ ω q' + ω² q). So δ1, δ2 and x_p obey
    the equations of `LinearMotion` with m_e for the pier's mass and S for its spring and damper.

    Further shapes stand still, each at φ F/ω², which a constant contact force allows: F is the sum
    of the constants.

    Parameters
    ----------
    motion : LinearMotion
        Equations of motion of the regime, m_p being m_e.
    beam : BeamPier
        The pier.
    moving : int
        Number of moving shapes n, the first ones.
    """

    def __init__(self, motion: LinearMotion, beam: BeamPier, moving: int) -> None:
        n, size = moving, 2 * moving + 7
        omega, phi = beam.circular_frequencies[:n], beam.impact_deflection[:n]
        self.moving = moving
        d1, u1, d2, u2 = np.eye(4, size)
        q, p = np.eye(n, size, k=4), np.eye(n, size, k=4 + n)
        intercept1, intercept2, friction = np.eye(3, size, k=size - 3)
        force = intercept1 + intercept2 + motion.on_pier * friction
        still = np.outer(beam.impact_deflection[n:] / beam.circular_frequencies[n:] ** 2, force)
        # The coordinates q and q' of all shapes are this times a state.
        self.coordinates = np.vstack((q, still, p, 0.0 * still))

        if n < len(beam.impact_deflection):
            motion = motion._replace(inverse_mp=float(phi @ phi))
        stiffness, viscous = omega[:, None] ** 2, beam.damping[:n, None]
        mass = 1.0 / (phi @ phi)
        resistance = mass * phi @ (stiffness * q + viscous * p)
        rows = motion._replace(
            b=motion.inverse_mp,
            c=0.0,
            intercept1=intercept1,
            intercept2=intercept2,
            friction=friction,
            pier_force=motion.on_pier * friction,
        )
        a1, a2, ap = accelerations(rows, Position(d1, u1, d2, u2, resistance, 0.0))
        forces = np.stack((a1, a2, mass * ap + resistance))

        self.step = longest_step(motion._replace(pace=omega.max() ** 2, c=0.0), FLOATS)
        # Term k of the Taylor series of a state y over one step is powers[k] y.
        self.powers = np.zeros((TERMS, size, size))
        self.powers[0] = np.eye(size)
        for k in range(1, TERMS):
            # The rates of the term before; most of their matrix would be zero.
            before, after = self.step * self.powers[k - 1], self.powers[k]
            rates, moves = before[4 + n : 4 + 2 * n], before[4 : 4 + n]
            after[0], after[2], after[4 : 4 + n] = before[1], before[3], rates
            after[1], after[3], force = forces @ before
            after[4 + n : 4 + 2 * n] = np.outer(phi, force) - stiffness * moves - viscous * rates
        # Those of δ1, δ2 and x_p.
        displacement = beam.impact_deflection @ np.vstack((q, still))
        self.terms: Any = np.moveaxis(np.stack((d1, d2, displacement)) @ self.powers, 1, 0)
        self.doublings = [self.propagator(1.0)]  # over one step, two, four, …
        for _ in range(1, DOUBLINGS):
            self.doublings.append(self.doublings[-1] @ self.doublings[-1])

    def propagator(self, theta: float) -> Array:
        """Return the matrix that carries a state over a fraction of the step."""
        matrix: Array = np.tensordot(weights_of_one(theta), self.powers, axes=1)
        return matrix

    def steps(self, y: Array) -> Array:
        """Return the states in which a block of steps starts, one a column."""
        states = y[:, None]
        for matrix in self.doublings:
            states = np.hstack((states, matrix @ states))
        return states


Record: TypeAlias = Callable[[State, LinearMotion, float, ModalMotion, Array], None]


class BeamPropagation:
    """A collision with a beam, propagated from first touch.

    Parameters
    ----------
    collision : Collision
        The collision.
    beam : BeamPier
        Its pier.
    """

    def __init__(self, collision: Collision, beam: BeamPier) -> None:
        self.beam = beam
        self.energy = collision.energy
        self.parameters = collision.parameters._replace(pier_mass=beam.effective_mass)
        self.state = start(self.parameters, FLOATS)
        self.q, self.p = np.zeros((2, len(beam.circular_frequencies)))
        self.motions: dict[tuple[float, ...], ModalMotion] = {}

    def modal_motion(self, motion: LinearMotion) -> ModalMotion:
        """Return the motion as a matrix; regimes that differ only in constants share it."""
        moving = self.moving(motion)
        key = (motion.inverse_m2, motion.inverse_mp, motion.slope1, motion.slope2, moving)
        if key not in self.motions:
            self.motions[key] = ModalMotion(motion, self.beam, moving)
        return self.motions[key]

    def moving(self, motion: LinearMotion) -> int:
        """Return how many shapes have to be followed: all, or a half, a quarter, an eighth of them.

        Under a constant force each shape vibrates for itself, and the higher ones die out first.
        """
        count = len(self.q)
        if motion.slope1 or motion.slope2 or not motion.gamma:
            return count
        omega, phi = self.beam.circular_frequencies, self.beam.impact_deflection
        force = motion.intercept1 + motion.intercept2 + motion.pier_force
        rates = np.hypot(omega * self.q - phi * force / omega, self.p)
        vibrating = np.flatnonzero(0.5 * rates**2 > STILL * self.energy)
        least = max(FEWEST_MOVING, vibrating[-1] + 1 if len(vibrating) else 0)
        while count >= 2 * least:
            count //= 2
        return count

    def advance(self, record: Record) -> None:
        """Take a block of steps, or as many as there are up to the first event."""
        parameters, state = self.parameters, self.state
        motion = linear_motion(parameters, state, FLOATS)
        modal = self.modal_motion(motion)
        h, begin = modal.step, state.time
        states = modal.steps(self.modal_state(motion, modal.moving))
        series = modal.terms @ states

        functions = event_functions(parameters, state, motion, FLOATS)
        flagged = may_rise(functions, series, state.peak(FLOATS), h, ARRAYS)
        last, event, theta = states.shape[1] - 1, NO_EVENT, 1.0
        for number in np.flatnonzero(np.any([flag for _, flag in flagged], axis=0)).tolist():
            here = [(function, flag[number]) for function, flag in flagged]
            state = state._replace(time=begin + number * h)
            terms = series[:, :, number].tolist()
            state, event, theta = first_event(here, terms, state, h, FLOATS)
            if theta < 1.0 or event != NO_EVENT:
                last = number
                break

        for number in range(last + 1):
            at = self.state._replace(time=begin + number * h)
            record(at, motion, h * (theta if number == last else 1.0), modal, states[:, number])
        end = (modal.propagator(theta) if theta < 1.0 else modal.doublings[0]) @ states[:, last]
        self.q, self.p = np.split(modal.coordinates @ end, 2)
        phi, time = self.beam.impact_deflection, begin + (last + theta) * h
        d1, u1, d2, u2 = end[:4].tolist()
        position = Position(d1, u1, d2, u2, float(phi @ self.q), float(phi @ self.p))
        state = state._replace(time=time, position=position)
        state = raise_peak(state, position.xp, time, True, FLOATS)
        self.state = change_regime(parameters, state, motion, self.resistance, event, FLOATS)

    def modal_state(self, motion: LinearMotion, moving: int) -> Array:
        """Return the present state of the moving shapes, as `ModalMotion` takes it."""
        constants = (motion.intercept1, motion.intercept2, motion.friction)
        truck = self.state.position[:4]
        return np.concatenate((truck, self.q[:moving], self.p[:moving], constants))

    @property
    def resistance(self) -> float:
        """Force of the beam's stiffness and damping at the impact, as in `ModalMotion` [N]."""
        beam = self.beam
        restoring = beam.circular_frequencies**2 * self.q + beam.damping * self.p
        return beam.effective_mass * float(beam.impact_deflection @ restoring)

    def finished(self) -> bool:
        """Say whether no later instant matters.

        The truck has left, or can raise no peak of the reaction and bring no first contact; and
        the beam has vibrated for a whole period of its first mode since the last change.
        """
        omega = self.beam.circular_frequencies
        energy = 0.5 * float(np.sum((omega * self.q) ** 2 + self.p**2))
        decided, left = prospects(self.parameters, self.state, energy, FLOATS)
        return bool((decided or left) and self.has_vibrated)

    @property
    def has_vibrated(self) -> bool:
        """Whether the beam has vibrated for a period of its first mode since the last change."""
        # A body that sticks to the beam slows it down, by Dunkerley's bound.
        square = self.beam.circular_frequencies[0] ** -2
        if self.parameters.on_pier:
            square += self.parameters.body.mass / self.parameters.pier_stiffness
        return bool(self.state.time > self.state.last_change + 2.0 * math.pi * math.sqrt(square))


def propagate_beam(collision: Collision, beam: BeamPier, duration: float, record: Record) -> State:
    """Propagate one collision with a beam until it is finished, and to `duration` at least.

    Parameters
    ----------
    collision, beam
        As in `BeamPropagation`.
    duration : float
        Time to propagate at least [s].
    record : callable
        Called for each step with the state it started from, its equations of motion, its length
        [s], its motion as a matrix and the state that this applies to.

    Returns
    -------
    State
        The last state.

    Raises
    ------
    RuntimeError
        When the collision does not come to an end.
    """
    propagation, blocks = BeamPropagation(collision, beam), 0
    while blocks < STEPS:
        propagation.advance(record)
        late = propagation.state.time >= duration
        if late and propagation.finished():
            return propagation.state
        changed = propagation.state.last_change == propagation.state.time
        blocks += changed or (late and propagation.has_vibrated)
    raise RuntimeError("the collision did not come to an end")
