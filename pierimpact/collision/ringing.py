"""Ringing: a slow motion with a fast vibration on it, followed for many cycles at once.

Where stiff springs join a light pier to a heavy truck, the fast vibration passes through thousands
of cycles before anything changes. Both are parts of one linear motion: the fast part is what the
eigenvectors of the largest eigenvalues span, the rest is slow and has a Taylor series of its own.
No regime ends as long as the slow part keeps away from every bound by more than the fast part can
reach; and no peak is passed over that a later instant of the same regime does not exceed.

It is rare, and so for one collision at a time.
"""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.parameters import Parameters
from pierimpact.collision.regimes import LinearMotion, Position, State, accelerations, raise_peak
from pierimpact.collision.series import FLOATS, PHASE, TERMS, EventFunction, weights_of_one
from pierimpact.collision.stepping import (
    INACTIVE,
    PASSES,
    PIER,
    Rates,
    event_functions,
    longest_step,
    swing,
    trial_step,
)

Matrix: TypeAlias = NDArray[Any]

# Numerical settings.
GAP = 10.0  # least ratio of the slowest fast eigenvalue to the fastest slow one
CONDITION = 1e10  # of the fast eigenvectors, beyond which the parts are not told apart
WORTHWHILE = 8.0  # ordinary steps that a long one must replace
LONGEST = 1e7  # such steps that a long one may replace
SAFETY = 0.999  # share of the time to the earliest change


class Parts(NamedTuple):
    """The two parts of a linear motion; the velocities in it are over the `scale` [1/s]."""

    slow: Matrix  # terms of its series over the length, shape (TERMS, 6)
    length: float  # [s]
    vectors: Matrix  # of the fast part, shape (6, n)
    values: Matrix  # its eigenvalues [1/s], shape (n,)
    amplitudes: Matrix  # at the start, shape (n,)
    scale: float

    def over(self, length: float) -> "Parts":
        """Return the same with the slow part's series over another length [s]."""
        powers = (length / self.length) ** np.arange(TERMS)
        return self._replace(slow=powers[:, None] * self.slow, length=length)

    def at(self, fraction: float) -> Position:
        """Return the position at a fraction of the length."""
        decay = np.exp(self.values * (fraction * self.length))
        fast = (self.vectors @ (self.amplitudes * decay)).real
        z = np.array(weights_of_one(fraction)) @ self.slow + fast
        z[1::2] *= self.scale
        return Position(*z.tolist())

    def rates(self) -> list[Rates]:
        """Return δ1, δ2 and x_p of the slow part, each with its first two rates."""
        h = self.length
        value, rate, second = (self.slow[n, 0::2] / h**n for n in range(3))
        return list(zip(value.tolist(), rate.tolist(), second.tolist(), strict=True))

    def reach(self, order: int, parts: Sequence[tuple[float, int]]) -> float:
        """Return what of Σ weight × a motion's derivative the fast part can make up."""
        row = sum(weight * self.vectors[2 * which] for weight, which in parts)
        return float(np.abs(row * self.values**order) @ np.abs(self.amplitudes))

    def first(self, functions: Sequence[EventFunction]) -> float:
        """Return the fraction at which the slow part makes the first of them rise above zero."""
        series = [terms.tolist() for terms in self.slow.T[0::2]]
        flagged = []
        for event, order, parts, level in functions:
            if level == INACTIVE:
                continue
            parts = tuple((weight / self.length**order, which) for weight, which in parts)
            if level + sum(weight * series[which][order] for weight, which in parts) > 0.0:
                return 0.0
            flagged.append((EventFunction(event, order, parts, level), True))
        return min([1.0, *(float(fraction) for _, fraction, _ in FLOATS.rises(flagged, series))])

    def bounded(self, functions: Sequence[EventFunction]) -> list[EventFunction]:
        """Return functions of the slow part that are above zero where the whole may make them."""
        return [
            EventFunction(event, order, parts, level + self.reach(order, parts))
            for event, order, parts, level in functions
        ]


def parts_of(motion: LinearMotion, position: Position) -> Iterator[Parts]:
    """Return the ways to split a motion in two, those with most in the fast part first."""
    # Velocities over a rate, and that as the unit of time, so that all numbers are alike.
    scale = PHASE / longest_step(motion, FLOATS)
    forceless = motion._replace(intercept1=0.0, intercept2=0.0, friction=0.0, pier_force=0.0)
    matrix, constant, z = np.zeros((6, 6)), np.zeros(6), np.array(position)
    matrix[0::2] = np.eye(6)[1::2]
    unit = np.eye(6) * np.where(np.arange(6) % 2, scale, 1.0)
    matrix[1::2] = np.array(accelerations(forceless, Position(*unit))) / scale**2
    constant[1::2] = np.array(accelerations(motion, Position(*[0.0] * 6))) / scale**2
    z[1::2] /= scale
    values, right = np.linalg.eig(matrix)
    others, left = np.linalg.eig(matrix.T)
    order, other = np.argsort(np.abs(values)), np.argsort(np.abs(others))
    sizes = np.abs(values)[order]
    for count in np.flatnonzero(sizes[1:] > GAP * sizes[:-1]) + 1:
        fast, vectors = values[order[count:]], right[:, order[count:]]
        rows = left[:, other[count:]].T
        product = rows @ vectors
        if np.linalg.cond(product) > CONDITION:
            continue
        rows = np.linalg.solve(product, rows)
        # The fast part vibrates about where the constant forces hold it.
        amplitudes = rows @ z + (rows @ constant) / fast
        slowly = matrix - ((vectors * fast) @ rows).real
        length = min(PHASE / max(sizes[count - 1], 1e-300), LONGEST * PHASE / sizes[-1])
        terms = np.empty((TERMS, 6))
        terms[0] = z - (vectors @ amplitudes).real
        rate = matrix @ terms[0] + constant
        terms[1] = length * (rate - (vectors @ (rows @ rate)).real)
        for n in range(1, TERMS - 1):
            terms[n + 1] = length * (slowly @ terms[n])
        fast = np.minimum(fast.real, 0.0) + 1j * fast.imag
        yield Parts(terms, length / scale, vectors, scale * fast, amplitudes, scale)


def time_ahead(parameters: Parameters, state: State, motion: LinearMotion, parts: Parts) -> Parts:
    """Return the parts over a time in which no regime ends and no peak is lost."""
    functions = parts.bounded(event_functions(parameters, state, motion, FLOATS))
    yielding, above, below = state.yielding, ((1.0, PIER),), ((-1.0, PIER),)
    top = state.peak(FLOATS)
    if yielding is not None:
        largest, moved = yielding.largest, yielding.displacement
        top = min(top, largest - moved)
        if yielding.direction == 0.0:
            functions += parts.bounded([EventFunction(PASSES, 0, below, -moved - largest)])
    parts = parts.over(trial_step(parts.length, parts.rates(), functions, FLOATS))
    stop = parts.first(functions)
    if stop == 1.0:  # nothing in sight
        # Numerical: a period, and 1 % to spare.
        parts = parts.over(min(parts.length, 1.01 * swing(parameters, FLOATS)))
    if yielding is not None and yielding.direction != 0.0:  # it goes one way
        return parts.over(SAFETY * stop * parts.length)
    rises = parts.first(parts.bounded([EventFunction(PASSES, 0, above, -top)]))
    if rises < stop:
        # What the pier reaches on its way is less than what it reaches at the end of it.
        turn = min(stop, parts.first([EventFunction(PASSES, 1, below, 0.0)]))
        end = float(np.array(weights_of_one(turn)) @ parts.slow[:, 2 * PIER])
        level = 2.0 * parts.reach(0, above) - end
        stop = max(rises, min(turn, parts.first([EventFunction(PASSES, 0, above, level)])))
    return parts.over(SAFETY * stop * parts.length)


def ring(parameters: Parameters, state: State, motion: LinearMotion) -> tuple[State, float]:
    """Return the state of one collision once it has rung, and how long: zero where not worthwhile.

    The motion goes on in the regime of the state.
    """
    least = WORTHWHILE * longest_step(motion, FLOATS)
    for parts in parts_of(motion, state.position):
        if parts.length <= least:
            continue
        parts = time_ahead(parameters, state, motion, parts)
        if parts.length > least:
            position = parts.at(1.0)
            state = state._replace(time=state.time + parts.length, position=position)
            return raise_peak(state, position.xp, state.time, True, FLOATS), parts.length
    return state, 0.0
