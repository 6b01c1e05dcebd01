"""Contact forces of many collisions at a time: the largest, and the largest moving average.

The impulse on the pier is what the truck has lost of its momentum, but for the road's friction, so
that it is known at the ends and in the middle of every step with its first three rates. Over a half
it follows the polynomial of the seventh degree through both, which is exact where the forces are
constant. Derived here; the histories of single collisions (`averages`) have the same from the
motion of the pier.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import one_row, positive_array
from pierimpact.collision.averages import BESIDE, largest_average_force
from pierimpact.collision.groups import select
from pierimpact.collision.parameters import Collision, collision_chunks
from pierimpact.collision.propagation import Running, propagate_all
from pierimpact.collision.regimes import LinearMotion, Position, State, accelerations
from pierimpact.collision.series import ARRAYS, TERMS
from pierimpact.collision.simulate import SHORTEST, PeakReactions, peak_reactions_of, simulate
from pierimpact.collision.stepping import evaluate, expand, longest_step, rates

Array: TypeAlias = NDArray[np.float64]

# Numerical: halvings of the stretch in which an average turns from rising to falling.
HALVINGS = 20
# From what is missing at the end of a step of length one, and in its first three rates, to the
# coefficients of s⁴ to s⁷ that make up for it.
_TO_THE_END = np.linalg.inv([[math.perm(n, rate) for n in range(4, 8)] for rate in range(4)])


class ContactForces(NamedTuple):
    """Contact forces of n collisions."""

    largest: Array  #: shape (n,) [N]
    #: Largest moving averages by window, shape (windows, n) [N]; a collision that is over before
    #: the longest window is followed on to its end.
    averages: Array


class _Steps(NamedTuple):
    """Halves of steps: when each begins, its length, and the impulse at both ends with rates.

    A step under constant forces is whole. Arrays of shape (n,), ordered by collision and time.
    """

    column: Any  # number of the collision
    start: Array
    length: Array
    gained: Array  # impulse over the step [N s]
    force: Array  # at the start [N]
    force_after: Array  # at the end [N]
    rate: Array  # of the force, at the start [N/s]
    rate_after: Array
    bend: Array  # rate of that rate, at the start [N/s²]
    bend_after: Array


class _Recorder:
    """Takes down the steps of collisions side by side."""

    def __init__(self) -> None:
        self._steps: list[_Steps] = []
        self.passed_over: set[int] = set()

    def step(
        self, running: Running, motion: LinearMotion, after: State, h: Array, goes_on: Any
    ) -> None:
        h = h + 0.0 * running.state.time
        taken = goes_on & (h > SHORTEST)
        # Forces change under a spring, and with what sticks to the pier. A longer step coasts.
        held = running.state.stuck & running.parameters.on_pier
        changes = (motion.slope1 > 0.0) | (motion.slope2 > 0.0) | held
        halved = taken & changes & (h <= longest_step(motion, ARRAYS))
        whole = taken & ~halved
        moving, end = select(motion, whole), select(after.position, whole)
        self._add(select(running, whole), moving, end, h[whole])
        own, moving = select(running, halved), select(motion, halved)
        end, half, start = select(after.position, halved), 0.5 * h[halved], own.state
        series = expand(moving, rates(moving, start.position), half, TERMS, ARRAYS)
        middle = evaluate(series, half, np.ones_like(half), ARRAYS)
        self._add(own, moving, middle, half)
        later = start._replace(time=start.time + half, position=middle)
        self._add(own._replace(state=later), moving, end, half)

    def _add(self, running: Running, motion: LinearMotion, after: Position, h: Array) -> None:
        """Take down steps, or halves of them, that end in the positions `after`."""
        parameters, before = running.parameters, running.state
        m1, m2, on_pier = parameters.engine.mass, parameters.body.mass, parameters.on_pier
        ends = []
        for position in (before.position, after):
            F1, F2 = motion.forces(position)
            d1, d2, ap = accelerations(motion, position)
            rate1, rate2 = motion.slope1 * position.u1, motion.slope2 * position.u2
            bend1, bend2 = motion.slope1 * d1, motion.slope2 * d2
            # What sticks to the pier takes its share of the engine's force, and moves with it.
            jerk = motion.inverse_mp * rate1 - motion.b * position.vp - motion.c * ap
            common = motion.inverse_mp * bend1 - motion.b * ap - motion.c * jerk
            held = before.stuck & on_pier
            force = F1 + np.where(on_pier, -m2 * (d2 + ap), F2)
            rate = rate1 + np.where(held, -m2 * jerk, rate2)
            bend = bend1 + np.where(held, -m2 * common, bend2)
            momentum = m1 * (position.u1 + position.vp), m2 * (position.u2 + position.vp)
            ends.append((force, rate, bend, F2, rate2, *momentum))
        (force, rate, bend, F2, rate2, p1, p2), (*after_it, F2a, rate2a, p1a, p2a) = ends
        # A body that sticks to the road loses to the pier what the road gives it.
        at_rest = 0.5 * h * (F2 + F2a) + h * h * (rate2 - rate2a) / 12.0
        sliding = p2 - p2a - np.where(on_pier, 0.0, motion.friction) * h
        gained = p1 - p1a + np.where(before.stuck & ~on_pier, at_rest, sliding)
        pairs = (force, after_it[0], rate, after_it[1], bend, after_it[2])
        step = (running.column, before.time, h, gained, *pairs)
        self._steps.append(_Steps(*step))

    def pass_over(self, column: NDArray[np.int_]) -> None:
        self.passed_over.update(column.tolist())

    def steps(self) -> _Steps:
        """Return all steps by collision and time."""
        joined = [np.concatenate(values) for values in zip(*self._steps, strict=True)]
        order = np.argsort(joined[0], kind="stable")
        return _Steps(*(values[order] for values in joined))


def contact_forces(
    collisions: Sequence[Collision], windows: Sequence[float]
) -> tuple[PeakReactions, ContactForces]:
    """Return the peak reactions of n collisions, as `peak_reactions`, and their contact forces.

    Memory grows with the number of collisions, by some 10 kB each.

    Parameters
    ----------
    collisions : sequence of Collision, length n
        The collisions; a beam counts as its one degree of freedom.
    windows : sequence of float
        Lengths of the moving windows [s].

    Raises
    ------
    InputError
        When a window is not positive.

    Warns
    -----
    UnfinishedWarning
        As in `peak_reactions`.
    """
    lengths = one_row("windows", positive_array("windows", windows)).tolist()
    size, recorder = len(collisions), _Recorder()
    chunks = (chunk for _, chunk in collision_chunks(collisions))
    outcomes = propagate_all(chunks, (size,), recorder=recorder)
    steps = recorder.steps()
    averages = [_largest_average(steps, size, window) for window in lengths]
    forces = ContactForces(_largest(steps, size), np.reshape(averages, (len(lengths), size)))
    piers = [own.equivalent_pier for own in collisions]
    # Such a pier may creep, which no polynomial follows.
    alone = np.array([pier.yields for pier in piers], dtype=bool)
    alone |= np.isnan(forces.averages).any(axis=0)
    for column in recorder.passed_over.union(np.flatnonzero(alone).tolist()):
        own = _of_one(collisions[column], lengths)
        forces.largest[column], *forces.averages[:, column] = own
    given = [pier.stiffness for pier in piers], [pier.yield_reaction for pier in piers]
    return peak_reactions_of(outcomes, *given), forces


def _of_one(collision: Collision, windows: Sequence[float]) -> list[float]:
    """Return largest contact force and averages of a collision, from its history."""
    longest = max(windows, default=0.0)
    try:
        history = simulate(collision.truck, collision.equivalent_pier, collision.speed, longest)
        largest = float(history.contact_force.max())
    except RuntimeError:  # it does not come to an end, or vibrates too often for a history
        return [math.nan] * (1 + len(windows))
    return [largest, *(largest_average_force(history, window).force for window in windows)]


def _largest(steps: _Steps, size: int) -> Array:
    """Return the largest contact force of each collision: at a step's ends, or in between."""
    rises_and_falls = (steps.rate > 0.0) & (steps.rate_after < 0.0)
    inner = _Steps(*(values[rises_and_falls] for values in steps))
    places = np.linspace(0.0, 1.0, 17)[1:-1, None]
    between = _force(inner, places).max(axis=0) if len(inner.start) else inner.force
    found = np.zeros(size)
    for column, force in (
        (steps.column, steps.force),
        (steps.column, steps.force_after),
        (inner.column, between),
    ):
        np.maximum.at(found, column, force)
    return found


def _impulse(steps: _Steps, s: Array) -> Array:
    """Return the impulse gained up to the fraction `s` of steps [N s]."""
    h, rest = steps.length, _rest(steps)
    known = s * h * (steps.force + s * h * (steps.rate / 2.0 + s * h * steps.bend / 6.0))
    more = s**4 * sum(c * s**n for n, c in enumerate(rest))
    return np.where(s < 1.0, known + more, steps.gained)


def _force(steps: _Steps, s: Array) -> Array:
    """Return the contact force at the fraction `s` of steps [N]."""
    h, rest = steps.length, _rest(steps)
    known = steps.force + s * h * (steps.rate + s * h * steps.bend / 2.0)
    more: Array = s**3 * sum((4 + n) * c * s**n for n, c in enumerate(rest)) / h
    return known + more


def _rest(steps: _Steps) -> Array:
    """Return the coefficients of s⁴ to s⁷ that lead to the end of the step, derived here."""
    h = steps.length
    F, G, H = h * steps.force, h**2 * steps.rate, h**3 * steps.bend
    missing = (
        steps.gained - F - G / 2.0 - H / 6.0,
        h * steps.force_after - F - G - H / 2.0,
        h**2 * steps.rate_after - G - H,
        h**3 * steps.bend_after - H,
    )
    rest: Array = np.tensordot(_TO_THE_END, missing, axes=1)
    return rest


def _largest_average(steps: _Steps, size: int, window: float) -> Array:
    """Return the largest moving average of each collision; nan where it is over sooner."""
    first = np.flatnonzero(np.diff(steps.column, prepend=-1))
    last = np.append(first[1:], len(steps.column)) - 1
    ends = np.full(size, -math.inf)
    ends[steps.column[last]] = steps.start[last] + steps.length[last]
    total = np.cumsum(steps.gained)
    begun = np.repeat(total[first] - steps.gained[first], last - first + 1)
    before = total - steps.gained - begun  # impulse before each step
    # All steps on one line: each collision has its own stretch of time on it.
    span = max(ends.max(), window) + 2.0 * window
    keys = steps.column * span + steps.start

    def at(column: Any, time: Array) -> tuple[Array, Array]:
        """Return the impulse since first touch and the force."""
        place = np.searchsorted(keys, column * span + np.maximum(time, 0.0), side="right") - 1
        own = _Steps(*(values[place] for values in steps))
        s = np.clip((time - own.start) / own.length, 0.0, 1.0)
        touching = time > 0.0
        impulse = before[place] + _impulse(own, s)
        return np.where(touching, impulse, 0.0), np.where(touching, _force(own, s), 0.0)

    def average(column: Any, start: Array) -> tuple[Array, Array]:
        """Return the average and its rate."""
        (before_it, F0), (after_it, F1) = at(column, start), at(column, start + window)
        return (after_it - before_it) / window, (F1 - F0) / window

    # Between neighbouring starts neither end of the window passes the end of a step.
    column = np.concatenate((steps.column, steps.column, steps.column[last]))
    start = np.concatenate((steps.start, steps.start - window, ends[steps.column[last]] - window))
    fits = (start <= ends[column] - window) & (ends[column] >= window)
    column, start = column[fits], start[fits]
    order = np.lexsort((start, column))
    column, start = column[order], start[order]
    found = np.full(size, -math.inf)
    np.maximum.at(found, column, average(column, start)[0])
    # Where a stretch ends the force may jump.
    same = np.flatnonzero(column[1:] == column[:-1])
    column, low, high = column[same], start[same], start[same + 1]
    rises = average(column, low + BESIDE * (high - low))[1] > 0.0
    column, low, high = column[rises], low[rises], high[rises]
    falls = average(column, high - BESIDE * (high - low))[1] < 0.0
    column, low, high = column[falls], low[falls], high[falls]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        value, rate = average(column, middle)
        low, high = np.where(rate > 0.0, middle, low), np.where(rate > 0.0, high, middle)
    np.maximum.at(found, column, value)
    return np.where(np.isfinite(found), found, math.nan)
