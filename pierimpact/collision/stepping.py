"""Stepping: the coupled motion, summed as its Taylor series up to the next change of regime.

The terms follow from the equations of motion, and their truncation is below round-off for the
step taken, so that no step is bound by accuracy. A step that would carry a spring or the
friction past its regime ends at the instant of the change, found on the series itself.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.coasting import coast
from pierimpact.collision.groups import CHUNK, join, select
from pierimpact.collision.parameters import Parameters
from pierimpact.collision.regimes import (
    BACKWARD,
    ELASTIC,
    FAR,
    FORWARD,
    FREE,
    LOWER,
    NONE,
    PLATEAU,
    TURN,
    UPPER,
    Law,
    Position,
    State,
    accelerations,
    change_regime,
    linearise,
    raise_peak,
    start,
)
from pierimpact.collision.series import (
    ARRAYS,
    END,
    FLOATS,
    NEVER,
    PHASE,
    Flag,
    Ops,
    Real,
    Terms,
    Watched,
    terms_needed,
)

ENGINE, BODY, PIER = range(3)  # as in a series
PIER_TURN = 8  # the pier's displacement is at its top; not a change of regime

TOLERANCE = 1e-13  # by which a bound is passed before its regime ends, relative to its scale
HOLD = 1e-4  # weighs the holding force, whose round-off is larger by the stiffness
STEPS = 100_000  # no collision of the studied domain takes a hundredth of these

Motion: TypeAlias = tuple[Real, Real, Real]  # value, rate, second rate
Motions: TypeAlias = tuple[Motion, Motion, Motion]  # of δ1, δ2 and x_p
Series: TypeAlias = tuple[Terms, Terms, Terms]  # of δ1, δ2 and x_p


def motions(law: Law, at: Position) -> Motions:
    """Return δ1, δ2 and x_p, each with its first two rates."""
    a1, a2, ap = accelerations(law, at)
    return (at.d1, at.u1, a1), (at.d2, at.u2, a2), (at.xp, at.vp, ap)


def expand(law: Law, moving: Motions, h: Real, count: int, ops: Ops) -> Series:
    """Return the first `count` terms of δ1, δ2 and x_p over a step `h`."""
    d1, d2, xp = ops.blank(h, count)
    square = h * h
    for terms, (value, rate, second) in zip((d1, d2, xp), moving, strict=True):
        terms[0], terms[1], terms[2] = value, rate * h, second * square
    # The equations of motion once more, with the step as the unit of time.
    g1, g2 = law.w1 * law.s1 * square, law.w2 * law.s2 * square
    p1, p2 = law.wp * law.s1 * square, law.wp * law.gamma * law.s2 * square
    b, c, gamma = law.b * square, law.c * h, law.gamma
    for n in range(1, count - 2):
        pier = p1 * d1[n] + p2 * d2[n] - b * xp[n] - c * xp[n + 1]
        xp[n + 2] = pier
        d1[n + 2] = -g1 * d1[n] - pier
        d2[n + 2] = -g2 * d2[n] - gamma * pier
    return d1, d2, xp


def evaluate(series: Series, h: Real, theta: Real, ops: Ops) -> Position:
    """Return the position at the fraction `theta` of a step `h`."""
    d1, d2, xp = series
    dot, weights = ops.dot, ops.weights(theta, len(d1))
    return Position(
        d1=dot(weights, d1),
        u1=dot(weights, d1[1:]) / h,
        d2=dot(weights, d2),
        u2=dot(weights, d2[1:]) / h,
        xp=dot(weights, xp),
        vp=dot(weights, xp[1:]) / h,
    )


def longest_step(law: Law, ops: Ops) -> Real:
    """Return the step in which no mode of the regime turns by more than PHASE."""
    g1, g2 = law.w1 * law.s1, law.w2 * law.s2
    square = law.b + law.wp * (law.s1 + law.s2) + ops.where(g1 > g2, g1, g2) + law.c * law.c
    return PHASE / ops.lib.sqrt(square)


def watch(parameters: Parameters, state: State, law: Law, ops: Ops) -> list[Watched]:
    """Return the quantities that end the regime when they rise above zero [-]."""
    where, some, negate = ops.where, ops.some, ops.negate
    watched = []
    per_speed = 1.0 / parameters.speed
    for which, spring, line in (
        (ENGINE, parameters.engine, state.engine),
        (BODY, parameters.body, state.body),
    ):
        first, per_length = 3 * which, 1.0 / spring.plateau_length
        loading = line.regime >= PLATEAU
        if some(line.upper < FAR):
            level = -line.upper * per_length - TOLERANCE
            watched.append(Watched(first + UPPER, 0, ((per_length, which),), level))
        if some(line.regime == ELASTIC):
            level = line.lower * per_length - TOLERANCE
            watched.append(Watched(first + LOWER, 0, ((-per_length, which),), level))
        if some(loading):
            level = where(loading, -TOLERANCE, -FAR)
            watched.append(Watched(first + TURN, 1, ((-per_speed, which),), level))

    # Sliding ends where the relative velocity would reverse.
    acts = parameters.friction_force > 0.0
    slides = acts & (state.slip != 0.0)
    if some(slides):
        level, back = where(slides, -TOLERANCE, -FAR), -state.slip * per_speed
        parts = ((back, BODY), (where(parameters.on_pier, 0.0, back), PIER))
        watched.append(Watched(FORWARD, 1, parts, level))

    # Sticking ends where the force that holds the body exceeds c_s, forward or backward. Against
    # the pier it is F2 + m2 x_p'' with F2 constant.
    if some(state.stuck):
        scale = HOLD / where(acts, parameters.friction_force, 1.0)
        slope, inertia = scale * law.s2, scale * parameters.body.mass
        force = scale * law.intercept2 + where(parameters.on_pier, slope * state.at.d2, 0.0)
        for stuck, order, weight, which in (
            (state.stuck & negate(parameters.on_pier), 0, slope, BODY),
            (state.stuck & parameters.on_pier, 2, inertia, PIER),
        ):
            level = where(acts & stuck, -HOLD - TOLERANCE, -FAR)
            watched.append(Watched(FORWARD, order, ((-weight, which),), level - force))
            watched.append(Watched(BACKWARD, order, ((weight, which),), level + force))
    return watched


def trial_step(longest: Real, moving: Motions, watched: list[Watched], ops: Ops) -> Real:
    """Return the longest step, or four times that to where the first watched rate leads."""
    where, h = ops.where, longest
    for _, order, parts, level in watched:
        if order == 2:
            continue
        value, rate = level, 0.0
        for weight, which in parts:
            value = value + weight * moving[which][order]
            rate = rate + weight * moving[which][order + 1]
        nears = (value < 0.0) & (rate * h > -4.0 * value)
        h = where(nears, -4.0 * value / where(nears, rate, 1.0), h)
    return h


def may_rise(
    watched: list[Watched], series: Series, spread: list[Real], h: Real, ops: Ops
) -> list[tuple[Watched, Flag]]:
    """Return the watched quantities per step, each with whether it may rise above zero.

    No rate departs from its start by more than `spread`, the sum of its further terms, and no
    motion from its tangent by more than half of that.
    """
    where = ops.where
    flagged = []
    for quantity in watched:
        event, order, parts, most = quantity
        if order:
            parts = tuple([(weight / h**order, which) for weight, which in parts])
            quantity = Watched(event, order, parts, quantity.level)
            for weight, which in parts:
                most = most + weight * series[which][order] + abs(weight) * spread[which]
        else:
            for weight, which in parts:
                ahead = weight * series[which][1]
                most = most + weight * series[which][0] + where(ahead > 0.0, ahead, 0.0)
                most = most + 0.5 * abs(weight) * spread[which]
        flagged.append((quantity, most > 0.0))
    return flagged


def move(parameters: Parameters, state: State, law: Law, ops: Ops) -> tuple[State, Real]:
    """Return the state after one step, at most up to the first change, and the step's length."""
    where = ops.where
    watched, moving = watch(parameters, state, law, ops), motions(law, state.at)
    longest = longest_step(law, ops)
    h = trial_step(longest, moving, watched, ops)
    count = terms_needed(ops.largest(h / longest))
    series = expand(law, moving, h, count, ops)
    spread = [ops.fixed(END, ops.sizes(terms[2:])) for terms in series]
    flagged = may_rise(watched, series, spread, h, ops)

    # The pier's turn is looked for where it may bring a peak.
    xp, vp = series[PIER][0], abs(series[PIER][1])
    met = state.cargo_contact == state.cargo_contact
    highest = where(met, state.cargo_peak, state.engine_peak)
    tops = (spread[PIER] > vp) & (xp + vp + spread[PIER] > highest)
    flagged.append((Watched(PIER_TURN, 1, ((0.0 * h - 1.0, PIER),), 0.0 * h), tops))

    event, theta, top = NONE + 0.0 * h, 1.0 + 0.0 * h, NEVER + 0.0 * h
    for which, fraction, happens in ops.rises(flagged, series):
        if which == PIER_TURN:
            top = where(happens, fraction, NEVER)
        else:
            sooner = fraction < theta
            theta = where(sooner, fraction, theta)
            event = where(sooner, where(happens, which, NONE), event)
    passed = top < theta
    if ops.some(passed):
        weights = ops.weights(where(passed, top, 0.0), count)
        time = state.time + top * h
        state = raise_peak(state, ops.dot(weights, series[PIER]), time, passed, ops)
    length = theta * h
    state = state._replace(time=state.time + length, at=evaluate(series, h, theta, ops))
    state = raise_peak(state, state.at.xp, state.time, True, ops)
    return change_regime(parameters, state, law, event, ops), length


def finished(parameters: Parameters, state: State, ops: Ops) -> Flag:
    """Say whether no later instant can raise a peak or bring a first contact.

    Either the energy that can still reach the pier does not suffice, or both bodies are out of
    reach and the pier has swung freely for a whole period. A body in contact with nothing but
    the pier can only be pushed back, so that a body moving back brings nothing; friction on the
    pier can drag it forward.
    """
    where = ops.where
    at = state.at
    v1, v2 = at.u1 + at.vp, at.u2 + at.vp
    energy = 0.5 * (parameters.pier_stiffness * at.xp**2 + parameters.pier_mass * at.vp**2)
    energy = energy + where(v1 > 0.0, 0.5 * parameters.engine.mass * v1**2, 0.0)
    energy = energy + where(
        (v2 > 0.0) | parameters.on_pier, 0.5 * parameters.body.mass * v2**2, 0.0
    )
    no_contact: Flag = True
    for spring, line, d, contact in (
        (parameters.engine, state.engine, at.d1, state.engine_contact),
        (parameters.body, state.body, at.d2, state.cargo_contact),
    ):
        force = line.intercept + line.slope * d
        energy = energy + 0.5 * force**2 / spring.unloading_stiffness
        crushed = where(d > line.largest, d, line.largest)
        missing = spring.plateau_force * (spring.plateau_length - crushed)
        no_contact = no_contact & ((contact == contact) | (missing > energy))
    met = state.cargo_contact == state.cargo_contact
    highest = where(met, state.cargo_peak, state.engine_peak)
    highest = where(highest > 0.0, highest, 0.0)
    spent = 2.0 * energy <= parameters.pier_stiffness * highest**2 * (1.0 + 1e-9)

    swinging = parameters.pier_mass + where(parameters.on_pier, parameters.body.mass, 0.0)
    period = 2.0 * math.pi * ops.lib.sqrt(swinging / parameters.pier_stiffness)
    left_engine = (state.engine.regime == FREE) & (v1 <= 0.0)
    left_body = ((state.body.regime == FREE) & (v2 <= 0.0)) | state.stuck
    swung = left_engine & left_body & (state.time > state.changed + period)
    return (no_contact & spent) | swung


def follow(
    parameters: Parameters,
    duration: float = 0.0,
    record: Callable[[State, Law, float], None] = lambda state, law, h: None,
) -> State:
    """Propagate one collision until nothing more can happen, and to `duration` at least.

    Parameters
    ----------
    parameters : Parameters
        Floats.
    duration : float, optional
        Time to propagate at least [s].
    record : callable, optional
        Called after each step with the state it started from, its law and its length [s].

    Returns
    -------
    State
        The last state.

    Raises
    ------
    RuntimeError
        When the collision does not come to an end.
    """
    state = start(parameters, FLOATS)
    for _ in range(STEPS):
        law = linearise(parameters, state, FLOATS)
        new, h = coast(parameters, state, law, FLOATS)
        record(state, law, h)
        state, h = move(parameters, new, law, FLOATS)
        record(new, law, h)
        if state.time >= duration and finished(parameters, state, FLOATS):
            return state
    raise RuntimeError("the collision did not come to an end")


OUTCOMES = (
    "engine_contact",
    "cargo_contact",
    "engine_peak",
    "engine_peak_time",
    "cargo_peak",
    "cargo_peak_time",
)


class Running(NamedTuple):
    """Collisions under way, side by side."""

    parameters: Parameters
    state: State
    place: NDArray[np.int_]  # among the outcomes
    steps: NDArray[np.int_]  # taken so far


def follow_all(
    parts: Iterable[Parameters],
    size: int,
    begin: Callable[[Parameters, Ops], State] = start,
    progress: Callable[[int], object] = lambda count: None,
) -> NDArray[np.float64]:
    """Propagate collisions side by side until nothing more can happen in any.

    Those that are done make room for the next part, so that the arrays neither grow with the
    number of collisions nor run almost empty.

    Parameters
    ----------
    parts : iterable of Parameters
        Some collisions at a time; arrays of shape (m,).
    size : int
        Number n of the collisions in all parts.
    begin : callable, optional
        From collisions to the states they start from; first touch unless another is given.
    progress : callable, optional
        Called with the number of collisions done since the last call.

    Returns
    -------
    ndarray, shape (6, n)
        The OUTCOMES of the last states.

    Raises
    ------
    RuntimeError
        When a collision does not come to an end.
    """
    outcomes = np.empty((len(OUTCOMES), size))
    waiting = _started(parts, begin)
    running = next(waiting, None)
    while running:
        parameters, state, place, steps = running
        done = np.zeros(len(place), dtype=bool)
        # Taking cases out costs about as much as a step: wait until a fifth of them is done.
        while 5 * np.count_nonzero(done) <= len(done) and not done.all():
            law = linearise(parameters, state, ARRAYS)
            state, _h = coast(parameters, state, law, ARRAYS)
            state, _h = move(parameters, state, law, ARRAYS)
            done |= finished(parameters, state, ARRAYS)
            steps = steps + 1
            if steps.max() > STEPS:
                raise RuntimeError("a collision did not come to an end")
        outcomes[:, place[done]] = [getattr(state, name)[done] for name in OUTCOMES]
        progress(int(np.count_nonzero(done)))
        running = select(Running(parameters, state, place, steps), ~done)
        if 2 * len(running.place) < CHUNK:
            more = next(waiting, None)
            running = join(running, more) if more else running
        if not len(running.place):
            break
    return outcomes


def _started(
    parts: Iterable[Parameters], begin: Callable[[Parameters, Ops], State]
) -> Iterator[Running]:
    first = 0
    for parameters in parts:
        place = np.arange(first, first + len(parameters.speed))
        first += len(place)
        yield Running(parameters, begin(parameters, ARRAYS), place, 0 * place)
