"""The collision with a beam, propagated exactly.

Regimes and events are those of the pier with one degree of freedom. The motion of a regime is a
matrix, which holds the modal coordinates of the beam: the states after steps of one length follow
from its powers, many at once, and each step is searched for the first event by its Taylor series.
"""

import math
from collections.abc import Callable
from typing import TypeAlias

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
    STEPS,
    event_functions,
    first_event,
    longest_step,
    may_rise,
    prospects,
)
from pierimpact.pier.beam import BeamPier

Array: TypeAlias = NDArray[np.float64]

BLOCK = 16  # steps taken together


class ModalMotion:
    """The motion of one regime as a matrix.

    With n shapes, the state y is δ1, δ1', δ2, δ2', q (n,), q' (n,) and three constants: the
    intercepts of the springs' lines and the friction.

    q'' = φ F − 2 ζ ω q' − ω² q, where x_p = Σ φ q. The contact force is F = m_e x_p'' + S with
    m_e = 1/Σ φ² and the beam's resistance S = m_e Σ φ (2 ζ ω q' + ω² q). So δ1, δ2 and x_p obey
    the equations of `LinearMotion` with m_e for the pier's mass and S for its spring and damper.

    Parameters
    ----------
    motion : LinearMotion
        Equations of motion of the regime, m_p being m_e.
    beam : BeamPier
        The pier.
    """

    def __init__(self, motion: LinearMotion, beam: BeamPier) -> None:
        omega, phi, mass = beam.circular_frequencies, beam.impact_deflection, beam.effective_mass
        n = len(omega)
        size = 2 * n + 7
        d1, u1, d2, u2 = np.eye(4, size)
        q, p = np.eye(n, size, k=4), np.eye(n, size, k=4 + n)
        intercept1, intercept2, friction = np.eye(3, size, k=size - 3)
        restoring = omega[:, None] ** 2 * q + beam.damping[:, None] * p
        self.resistance = mass * phi @ restoring
        rows = motion._replace(
            b=motion.inverse_mp,
            c=0.0,
            intercept1=intercept1,
            intercept2=intercept2,
            friction=friction,
        )
        a1, a2, ap = accelerations(rows, Position(d1, u1, d2, u2, self.resistance, 0.0))
        modal = np.outer(phi, mass * ap + self.resistance) - restoring
        rates = np.vstack((u1, a1, u2, a2, p, modal, np.zeros((3, size))))

        self.step = longest_step(motion._replace(b=omega.max() ** 2, c=0.0), FLOATS)
        # Term k of the Taylor series of a state y over one step is powers[k] y.
        self.powers = np.empty((TERMS, size, size))
        self.powers[0] = np.eye(size)
        for k in range(1, TERMS):
            self.powers[k] = self.step * (rates @ self.powers[k - 1])
        # Those of δ1, δ2 and x_p.
        self.terms = np.einsum("wi,kij->wkj", np.stack((d1, d2, phi @ q)), self.powers)
        whole, steps = self.propagator(1.0), [np.eye(size)]
        for _ in range(BLOCK):
            steps.append(whole @ steps[-1])
        self.steps = np.stack(steps)

    def propagator(self, theta: float) -> Array:
        """Return the matrix that carries a state over a fraction of the step."""
        matrix: Array = np.tensordot(weights_of_one(theta), self.powers, axes=1)
        return matrix


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
        self.parameters = collision.parameters._replace(pier_mass=beam.effective_mass)
        self.state = start(self.parameters, FLOATS)
        n = len(beam.circular_frequencies)
        self.q, self.p = slice(4, 4 + n), slice(4 + n, 4 + 2 * n)
        self.y = np.zeros(2 * n + 7)
        self.y[:4] = self.state.position[:4]
        self.motions: dict[tuple[float, ...], ModalMotion] = {}

    def modal_motion(self, motion: LinearMotion) -> ModalMotion:
        """Return the motion as a matrix; regimes that differ only in constants share it."""
        key = (motion.inverse_m2, motion.inverse_mp, motion.slope1, motion.slope2)
        if key not in self.motions:
            self.motions[key] = ModalMotion(motion, self.beam)
        return self.motions[key]

    def position(self, y: Array) -> Position:
        """Return the position of a state."""
        phi = self.beam.impact_deflection
        d1, u1, d2, u2 = y[:4].tolist()
        return Position(d1, u1, d2, u2, float(phi @ y[self.q]), float(phi @ y[self.p]))

    def advance(self, record: Record) -> None:
        """Take a block of steps, or as many as there are up to the first event."""
        parameters, state = self.parameters, self.state
        motion = linear_motion(parameters, state, FLOATS)
        modal = self.modal_motion(motion)
        h, begin = modal.step, state.time
        self.y[-3:] = motion.intercept1, motion.intercept2, motion.friction
        states = modal.steps @ self.y
        series = modal.terms @ states[:-1].T

        functions = event_functions(parameters, state, motion, FLOATS)
        flagged = may_rise(functions, series, state.peak(FLOATS), h, ARRAYS)
        last, event, theta = BLOCK - 1, NO_EVENT, 1.0
        for number in np.flatnonzero(np.any([flag for _, flag in flagged], axis=0)).tolist():
            here = [(function, flag[number]) for function, flag in flagged]
            state = state._replace(time=begin + number * h)
            terms = series[:, :, number].tolist()
            state, event, theta = first_event(here, terms, state, h, FLOATS)
            if theta < 1.0 or event != NO_EVENT:
                last = number
                break

        for number in range(last + 1):
            time, length = begin + number * h, h * (theta if number == last else 1.0)
            at = self.state._replace(time=time, position=self.position(states[number]))
            record(at, motion, length, modal, states[number])
        self.y = modal.propagator(theta) @ states[last] if theta < 1.0 else states[last + 1]
        position, time = self.position(self.y), begin + (last + theta) * h
        state = state._replace(time=time, position=position)
        state = raise_peak(state, position.xp, time, True, FLOATS)
        resistance = float(modal.resistance @ self.y)
        self.state = change_regime(parameters, state, motion, resistance, event, FLOATS)
        self.y[3] = self.state.position.u2

    def finished(self) -> bool:
        """Say whether no later instant matters.

        The truck has left, or can raise no peak of the reaction and bring no first contact; and
        the beam has vibrated for a whole period of its first mode since the last change.
        """
        parameters, omega = self.parameters, self.beam.circular_frequencies
        rates = np.concatenate((omega * self.y[self.q], self.y[self.p]))
        energy = 0.5 * float(rates @ rates)
        decided, left = prospects(parameters, self.state, energy, FLOATS)
        # A body that sticks to the beam slows it down, by Dunkerley's bound.
        square = omega[0] ** -2
        if parameters.on_pier:
            square += parameters.body.mass / parameters.pier_stiffness
        period = 2.0 * math.pi * math.sqrt(square)
        return bool((decided or left) and self.state.time > self.state.last_change + period)


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
    propagation = BeamPropagation(collision, beam)
    for _ in range(STEPS):
        propagation.advance(record)
        if propagation.state.time >= duration and propagation.finished():
            return propagation.state
    raise RuntimeError("the collision did not come to an end")
