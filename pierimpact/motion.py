"""The motion of engine, body and pier, propagated exactly from one change of regime to the next.

Between two changes every spring is on one straight line and the friction slides or sticks, so
the motion is linear. It is summed there as its Taylor series, whose terms follow from the
equations of motion and whose truncation is below round-off for the step taken; no step is bound
by accuracy. A step that would carry a spring or the friction past its regime is shortened to
the instant of the change.

The unknowns are the crushes δ1, δ2 and the pier's displacement x_p, with their rates. Each
number is a float for one collision or an array of shape (n,) for n collisions side by side:
the same lines serve both, with the few functions that differ handed in as `ops`.
"""

import math
from collections.abc import Callable
from operator import mul
from typing import Any, NamedTuple, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Real: TypeAlias = Any  # a float, or an array of shape (n,)
Flag: TypeAlias = Any  # a bool, or an array of shape (n,)
Watched: TypeAlias = tuple[Real, Real, Real]  # a quantity [-], its rate, and the rate's rate

FREE, ELASTIC, PLATEAU, STEEP = range(4)

TERMS = 22
PHASE = 2.0  # largest ω h of a step [rad]: PHASE**TERMS/TERMS! = 4e-15
RECIPROCALS = [1.0 / n for n in range(1, TERMS)]
TOLERANCE = 1e-13  # of a watched quantity, relative to its scale
HOLD = 1e-4  # weighs the holding force, whose round-off is larger by the stiffness
FAR = 1e9  # stands for a bound that is never reached, without the NaN of ∞ − ∞
STEPS = 100_000  # no collision of the studied domain takes a hundredth of these


class Ops(NamedTuple):
    """What differs between floats and arrays."""

    where: Callable[[Flag, Real, Real], Real]
    sqrt: Callable[[Real], Real]
    negate: Callable[[Flag], Flag]
    some: Callable[[Flag], bool]


FLOATS = Ops(lambda flag, yes, no: yes if flag else no, math.sqrt, lambda flag: not flag, bool)
ARRAYS = Ops(np.where, np.sqrt, np.logical_not, np.any)


class Spring(NamedTuple):
    """A crush law (`pierimpact.crush`) and the mass behind it."""

    mass: Real
    plateau_force: Real
    plateau_length: Real
    stiffness: Real
    unloading_stiffness: Real


class Collision(NamedTuple):
    """What is given: truck, pier and speed."""

    engine: Spring
    body: Spring
    friction_force: Real
    on_pier: Flag
    pier_mass: Real
    pier_stiffness: Real
    pier_damping: Real
    speed: Real


class Branch(NamedTuple):
    """The straight line F = intercept + slope δ that a spring is on, and where it ends."""

    regime: Real
    largest: Real
    slope: Real
    intercept: Real
    lower: Real
    upper: Real


class Position(NamedTuple):
    """Crushes, pier displacement and their rates."""

    d1: Real
    u1: Real
    d2: Real
    u2: Real
    xp: Real
    vp: Real


class State(NamedTuple):
    """Where a collision stands: its motion, its regime, and what it has shown so far."""

    time: Real
    at: Position
    engine: Branch
    body: Branch
    slip: Real  # direction of sliding: 1, −1, or 0 while it sticks or does not act
    stuck: Flag
    changed: Real  # time of the last change of regime
    engine_contact: Real
    cargo_contact: Real
    engine_peak: Real  # largest x_p before cargo contact
    engine_peak_time: Real
    cargo_peak: Real  # largest x_p from cargo contact on
    cargo_peak_time: Real


class Law(NamedTuple):
    """The linear equations of motion of one regime.

    x_p'' = wp (F1 + γ F2 + on_pier Fs) − B x_p − C x_p'
    δ1'' = −w1 F1 − x_p''
    δ2'' = −w2 (F2 + Fs) − γ x_p''

    γ = 0 where body and pier stick together and move as one mass; w2 = 0 where the body sticks.
    """

    w1: Real
    w2: Real
    wp: Real
    gamma: Real
    b: Real
    c: Real
    s1: Real
    s2: Real
    intercept1: Real
    intercept2: Real
    friction: Real
    on_pier: Flag


def branch(spring: Spring, regime: Real, largest: Real, ops: Ops) -> Branch:
    """Return the line of `regime` after a largest crush of `largest` [m].

    The unused spring counts as unloaded from its elastic limit P/k_u, so that first loading is
    one more ride on the elastic line.
    """
    where = ops.where
    P, d, k, ku = spring[1:]
    residual = largest - where(largest < d, P, P + k * (largest - d)) / ku
    free, elastic, plateau = regime == FREE, regime == ELASTIC, regime == PLATEAU
    return Branch(
        regime,
        largest,
        slope=where(elastic, ku, where(regime == STEEP, k, 0.0)),
        intercept=where(elastic, -ku * residual, where(plateau, P, where(free, 0.0, P - k * d))),
        lower=where(elastic, residual, -FAR),
        upper=where(free, residual, where(elastic, largest, where(plateau, d, FAR))),
    )


def start(case: Collision, ops: Ops) -> State:
    """Return the state at first touch: both springs at rest, both bodies at full speed."""
    nought = 0.0 * case.speed
    unknown = nought + math.nan
    first = ELASTIC + nought
    return State(
        time=nought,
        at=Position(nought, case.speed, nought, case.speed, nought, nought),
        engine=branch(case.engine, first, _elastic_limit(case.engine), ops),
        body=branch(case.body, first, _elastic_limit(case.body), ops),
        slip=1.0 + nought,
        stuck=nought != 0.0,
        changed=nought,
        engine_contact=unknown,
        cargo_contact=unknown,
        engine_peak=nought,
        engine_peak_time=nought,
        cargo_peak=unknown,
        cargo_peak_time=unknown,
    )


def _elastic_limit(spring: Spring) -> Real:
    return spring.plateau_force / spring.unloading_stiffness


def linearise(case: Collision, state: State, ops: Ops) -> Law:
    """Return the equations of motion of the state's regime."""
    where = ops.where
    stuck_to_pier = state.stuck & case.on_pier
    wp = where(stuck_to_pier, 1.0 / (case.pier_mass + case.body.mass), 1.0 / case.pier_mass)
    return Law(
        w1=1.0 / case.engine.mass,
        w2=where(state.stuck, 0.0, 1.0 / case.body.mass),
        wp=wp,
        gamma=where(stuck_to_pier, 0.0, 1.0),
        b=wp * case.pier_stiffness,
        c=wp * case.pier_damping,
        s1=state.engine.slope,
        s2=state.body.slope,
        intercept1=state.engine.intercept,
        intercept2=state.body.intercept,
        friction=state.slip * case.friction_force,
        on_pier=case.on_pier,
    )


def accelerations(law: Law, at: Position) -> tuple[Real, Real, Real]:
    """Return δ1'', δ2'' and x_p'' [m/s²]."""
    F1 = law.intercept1 + law.s1 * at.d1
    F2 = law.intercept2 + law.s2 * at.d2
    Fs = law.friction
    ap = law.wp * (F1 + law.gamma * F2 + law.on_pier * Fs) - law.b * at.xp - law.c * at.vp
    return -law.w1 * F1 - ap, -law.w2 * (F2 + Fs) - law.gamma * ap, ap


Series: TypeAlias = tuple[list[Real], list[Real], list[Real]]


def expand(law: Law, at: Position) -> Series:
    """Return the time derivatives, from order 0 on, of δ1, δ2 and x_p."""
    a1, a2, ap = accelerations(law, at)
    d1, d2, xp = [at.d1, at.u1, a1], [at.d2, at.u2, a2], [at.xp, at.vp, ap]
    g1, g2 = law.w1 * law.s1, law.w2 * law.s2
    p1, p2 = law.wp * law.s1, law.wp * law.gamma * law.s2
    b, c, gamma = law.b, law.c, law.gamma
    for n in range(1, TERMS - 2):
        pier = p1 * d1[n] + p2 * d2[n] - b * xp[n] - c * xp[n + 1]
        xp.append(pier)
        d1.append(-g1 * d1[n] - pier)
        d2.append(-g2 * d2[n] - gamma * pier)
    return d1, d2, xp


def evaluate(series: Series, h: Real) -> Position:
    """Return the position after a time `h`, by summing the series."""
    d1, d2, xp = series
    weight = h * 0.0 + 1.0
    weights = [weight]
    for reciprocal in RECIPROCALS:
        weight = weight * h * reciprocal
        weights.append(weight)
    return Position(
        sum(map(mul, weights, d1)),
        sum(map(mul, weights, d1[1:])),
        sum(map(mul, weights, d2)),
        sum(map(mul, weights, d2[1:])),
        sum(map(mul, weights, xp)),
        sum(map(mul, weights, xp[1:])),
    )


def longest_step(law: Law, ops: Ops) -> Real:
    """Return the step in which no mode of the regime turns by more than PHASE."""
    g1, g2 = law.w1 * law.s1, law.w2 * law.s2
    square = law.b + law.wp * (law.s1 + law.s2) + ops.where(g1 > g2, g1, g2) + law.c**2
    return PHASE / ops.sqrt(square)


# What is watched, in this order; a regime holds while every watched quantity is below zero.
UPPER, LOWER, TURN = range(3)  # of the engine's spring; the body's follow three places on
FORWARD, BACKWARD, PIER_TURN = range(6, 9)
NONE = -1


def watch(case: Collision, state: State, law: Law, at: Position, ops: Ops) -> list[Watched]:
    """Return the watched quantities [-], their rates [1/s] and the rates' rates [1/s²]."""
    where = ops.where
    a1, a2, ap = accelerations(law, at)
    f1, f2 = law.s1 * at.u1, law.s2 * at.u2
    jp = law.wp * (f1 + law.gamma * f2) - law.b * at.vp - law.c * ap
    j1, j2 = -law.w1 * f1 - jp, -law.w2 * f2 - law.gamma * jp
    V = case.speed
    watched = []
    for spring, line, d, u, a, jerk in (
        (case.engine, state.engine, at.d1, at.u1, a1, j1),
        (case.body, state.body, at.d2, at.u2, a2, j2),
    ):
        length = spring.plateau_length
        loading = line.regime >= PLATEAU
        watched.append(((d - line.upper) / length, u / length, a / length))
        watched.append(((line.lower - d) / length, -u / length, -a / length))
        watched.append((where(loading, -u / V, -1.0), where(loading, -a / V, 0.0), -jerk / V))

    # Sliding ends where the relative velocity would reverse; sticking ends where the force that
    # holds the body exceeds c_s, forward or backward.
    acts = case.friction_force > 0.0
    slides, sticks = acts & (state.slip != 0.0), acts & state.stuck
    relative = -state.slip * (at.u2 + where(case.on_pier, 0.0, at.vp)) / V
    relative_rate = -state.slip * (a2 + where(case.on_pier, 0.0, ap)) / V
    relative_second = -state.slip * (j2 + where(case.on_pier, 0.0, jp)) / V
    inertia = where(case.on_pier, case.body.mass, 0.0)
    scale = HOLD / where(acts, case.friction_force, 1.0)
    hold = -scale * (law.intercept2 + law.s2 * at.d2 + inertia * ap)
    hold_rate = -scale * (f2 + inertia * jp)
    forward = where(slides, relative, where(sticks, hold - HOLD, -1.0))
    forward_rate = where(slides, relative_rate, where(sticks, hold_rate, 0.0))
    watched.append((forward, forward_rate, where(slides, relative_second, 0.0)))
    watched.append((where(sticks, -hold - HOLD, -1.0), where(sticks, -hold_rate, 0.0), 0.0))
    watched.append((-at.vp / V, -ap / V, -jp / V))
    return watched


def predict(watched: list[Watched], longest: Real, ops: Ops) -> Real:
    """Return a first trial step: the longest, or to where the first watched rate leads."""
    where = ops.where
    h = longest
    for value, rate, _ in watched[:PIER_TURN]:
        approaches = (value < -TOLERANCE) & (rate > 0.0)
        arrival = -value / where(approaches, rate, 1.0)
        h = where(approaches & (arrival < h), arrival, h)
    return h


def first_change(
    before: list[Watched], after: list[Watched], h: Real, records: Flag, ops: Ops
) -> tuple[Real, Real]:
    """Find what changes first in a trial step.

    Parameters
    ----------
    before, after : list of pairs
        The watched quantities at the start and at the end of the step.
    h : Real
        The step [s].
    records : Flag
        Whether a turn of the pier in this step may raise a peak; others are passed over.

    Returns
    -------
    event : Real
        Which change the step ends in, or NONE.
    sooner : Real
        A shorter step to try where the step oversteps a change; `h` where it does not; zero
        where the change is due at the start [s].
    """
    where, negate, some = ops.where, ops.negate, ops.some
    event, sooner = NONE + 0.0 * h, h
    for which, (start, end) in enumerate(zip(before, after, strict=True)):
        (g, rate, second), (g_h, rate_h, second_h) = start, end
        armed = g < -TOLERANCE
        counts = (armed & records) if which == PIER_TURN else True
        over = (g_h > TOLERANCE) & counts
        near = (g_h >= -TOLERANCE) & counts
        turns = (rate > 0.0) & (rate_h < 0.0) & counts
        # A rate that keeps its sign may still have lost it in between; see `_lost_between`.
        wavers = (rate * rate_h > 0.0) & (rate * second < 0.0) & (rate_h * second_h > 0.0)
        wavers = wavers & counts & (h * (abs(rate) + abs(rate_h)) > -g)
        if not some(near | turns | wavers):
            continue
        wavers = wavers & negate(over) & _lost_between(rate, second, rate_h, second_h, h, ops)
        highest = _crest(start, end, h, turns, ops)
        humps = turns & negate(over) & (highest > TOLERANCE)
        # What starts on its bound and moves on is due at once. Friction that has just let go is
        # not: it starts with no relative velocity, nor acceleration but for round-off.
        leaves = g > TOLERANCE if which in (FORWARD, BACKWARD) else rate > TOLERANCE
        due = over & negate(armed) & (leaves | (g > TOLERANCE))
        root = crossing(g, rate, where(over, g_h, g + 1.0), rate_h, h, ops)
        trial = where(
            over,
            where(armed, root, where(due, 0.0, 0.5 * h)),
            where(
                humps,
                h * rate / where(humps, rate - rate_h, 1.0),
                where(wavers, h * second / where(wavers, second - second_h, 1.0), h),
            ),
        )
        first = trial < sooner
        sooner = where(first, trial, sooner)
        hit = near & armed & negate(over) & (sooner >= h)
        event = where(first, where(due, which, NONE), where(hit, which, event))
    return event, sooner


def _crest(start: Watched, end: Watched, h: Real, turns: Flag, ops: Ops) -> Real:
    """Return how high a quantity may be between the ends of a step; only where it `turns`.

    Where it is concave at both ends its tangents meet above it; where at one end only, that
    end's parabola tells, with half of its rise added for prudence.
    """
    where = ops.where
    (g, rate, second), (g_h, rate_h, second_h) = start, end
    meet = g + rate * (g_h - g - rate_h * h) / where(turns, rate - rate_h, 1.0)
    falls, falls_h = second < 0.0, second_h < 0.0
    left = where(falls, g - 0.75 * rate**2 / where(falls, second, 1.0), FAR)
    right = where(falls_h, g_h - 0.75 * rate_h**2 / where(falls_h, second_h, 1.0), left)
    return where(falls & falls_h, meet, right)


def _lost_between(
    rate: Real, second: Real, rate_h: Real, second_h: Real, h: Real, ops: Ops
) -> Flag:
    """Say whether a rate of one sign at both ends may have had the other in between.

    The mark of it is that the rate first makes for zero and at last away from it, and that its
    tangents meet beyond zero, or not far from it.
    """
    differs = second != second_h
    meeting = rate + second * (rate_h - rate - second_h * h) / ops.where(
        differs, second - second_h, 1.0
    )
    closer = (rate * (2.0 * meeting - rate) < 0.0) & (rate * (2.0 * meeting - rate_h) < 0.0)
    return differs & closer


def crossing(g: Real, rate: Real, g_h: Real, rate_h: Real, h: Real, ops: Ops) -> Real:
    """Estimate where a quantity that is negative at 0 and positive at `h` crosses zero.

    Inverse cubic interpolation on values and rates; where that would not be monotone, the
    tangent at `h` or the chord, whichever is beyond the crossing if the rate only grows or falls.
    """
    where = ops.where
    mean = (g_h - g) / h
    r = -g / (g_h - g)
    cubic = (3.0 * rate > mean) & (3.0 * rate_h > mean)
    shift = (1.0 - r) / where(cubic, rate, 1.0) - r / where(cubic, rate_h, 1.0)
    curved = h * r * r * (3.0 - 2.0 * r) + (g_h - g) * r * (1.0 - r) * shift
    gathers = rate_h > mean
    straight = where(gathers, h - g_h / where(gathers, rate_h, 1.0), r * h)
    return where(cubic & (curved < h), curved, straight)


def advance(
    case: Collision, state: State, law: Law, there: Position, h: Real, event: Real, ops: Ops
) -> State:
    """Return the state after a step `h` to `there` that ends in `event`."""
    where, negate = ops.where, ops.negate
    time = state.time + h
    engine, body, slip, stuck, at = state.engine, state.body, state.slip, state.stuck, there
    changes = (event != NONE) & (event != PIER_TURN)
    if ops.some(changes):
        engine = change(case.engine, engine, event, at.d1, ops)
        body = change(case.body, body, event - 3, at.d2, ops)
        slip, stuck, at = rub(case, law, state, body, at, event, ops)
        # A rate left over from round-off would fire the next change at once, for ever.
        at = at._replace(
            u1=where(event == TURN, 0.0, at.u1), u2=where(event == TURN + 3, 0.0, at.u2)
        )

    contact = state.cargo_contact == state.cargo_contact
    raises = negate(contact) & (at.xp > state.engine_peak)
    raises_cargo = contact & (at.xp > state.cargo_peak)
    meets_engine = (engine.regime == STEEP) & (state.engine_contact != state.engine_contact)
    meets_cargo = (body.regime == STEEP) & negate(contact)
    starts_or_raises = meets_cargo | raises_cargo
    return State(
        time=time,
        at=at,
        engine=engine,
        body=body,
        slip=slip,
        stuck=stuck,
        changed=where(changes, time, state.changed),
        engine_contact=where(meets_engine, time, state.engine_contact),
        cargo_contact=where(meets_cargo, time, state.cargo_contact),
        engine_peak=where(raises, at.xp, state.engine_peak),
        engine_peak_time=where(raises, time, state.engine_peak_time),
        cargo_peak=where(starts_or_raises, at.xp, state.cargo_peak),
        cargo_peak_time=where(starts_or_raises, time, state.cargo_peak_time),
    )


def change(spring: Spring, line: Branch, event: Real, crush: Real, ops: Ops) -> Branch:
    """Return the spring's line after `event`, one of UPPER, LOWER and TURN or none of its own."""
    where = ops.where
    upper, turn = event == UPPER, event == TURN
    virgin = where(line.largest < spring.plateau_length, PLATEAU, STEEP)
    above = where(line.regime == FREE, ELASTIC, where(line.regime == ELASTIC, virgin, STEEP))
    regime = where(upper, above, where(event == LOWER, FREE, where(turn, ELASTIC, line.regime)))
    return branch(spring, regime, where(turn, crush, line.largest), ops)


def rub(
    case: Collision, law: Law, state: State, body: Branch, at: Position, event: Real, ops: Ops
) -> tuple[Real, Flag, Position]:
    """Return the friction's direction, whether it sticks, and the position, after `event`."""
    where, negate = ops.where, ops.negate
    cs, m2 = case.friction_force, case.body.mass
    F1 = law.intercept1 + law.s1 * at.d1
    F2 = law.intercept2 + law.s2 * at.d2
    together = F1 - case.pier_stiffness * at.xp - case.pier_damping * at.vp
    hold = -F2 - where(case.on_pier, m2 / (m2 + case.pier_mass), 0.0) * together

    ends = (event == FORWARD) & negate(state.stuck)
    sticks = ends & (hold <= cs) & (hold >= -cs)
    forward = (event == FORWARD) & (state.stuck | (hold > cs))
    backward = (event == BACKWARD) | (ends & (hold < -cs))
    stuck = (state.stuck & negate(forward | backward)) | sticks
    slip = where(forward, 1.0, where(backward, -1.0, where(stuck, 0.0, state.slip)))

    # Friction on the pier acts while spring 2 is in contact, and begins anew with the contact.
    apart = case.on_pier & (body.regime == FREE)
    anew = case.on_pier & (state.body.regime == FREE) & (body.regime != FREE)
    slip = where(apart, 0.0, where(anew, 1.0, slip))
    stuck = stuck & negate(apart)
    rest = where(case.on_pier, 0.0, -at.vp)
    return slip, stuck, at._replace(u2=where(stuck, rest, at.u2))


def finished(case: Collision, state: State, ops: Ops) -> Flag:
    """Say whether no later instant can raise a peak or bring a first contact.

    Either the energy that can still reach the pier does not suffice, or both bodies are out of
    reach and the pier has swung freely for a whole period. A body in contact with nothing but
    the pier can only be pushed back, so that a body moving back brings nothing; friction on the
    pier can drag it forward.
    """
    where = ops.where
    at = state.at
    v1, v2 = at.u1 + at.vp, at.u2 + at.vp
    energy = 0.5 * (case.pier_stiffness * at.xp**2 + case.pier_mass * at.vp**2)
    energy = energy + where(v1 > 0.0, 0.5 * case.engine.mass * v1**2, 0.0)
    energy = energy + where((v2 > 0.0) | case.on_pier, 0.5 * case.body.mass * v2**2, 0.0)
    no_contact: Flag = True
    for spring, line, d, contact in (
        (case.engine, state.engine, at.d1, state.engine_contact),
        (case.body, state.body, at.d2, state.cargo_contact),
    ):
        force = line.intercept + line.slope * d
        energy = energy + 0.5 * force**2 / spring.unloading_stiffness
        largest = where(d > line.largest, d, line.largest)
        missing = spring.plateau_force * (spring.plateau_length - largest)
        no_contact = no_contact & ((contact == contact) | (missing > energy))
    met = state.cargo_contact == state.cargo_contact
    highest = where(met, state.cargo_peak, state.engine_peak)
    spent = 2.0 * energy <= case.pier_stiffness * highest**2 * (1.0 + 1e-9)

    period = (
        2.0
        * math.pi
        * ops.sqrt(
            (case.pier_mass + where(case.on_pier, case.body.mass, 0.0)) / case.pier_stiffness
        )
    )
    left_engine = (state.engine.regime == FREE) & (v1 <= 0.0)
    left_body = ((state.body.regime == FREE) & (v2 <= 0.0)) | state.stuck
    swung = left_engine & left_body & (state.time > state.changed + period)
    return (no_contact & spent) | swung


def may_raise_peak(state: State, there: Position, h: Real, ops: Ops) -> Flag:
    """Say whether the pier may swing beyond the present peak within a step to `there`."""
    where = ops.where
    contact = state.cargo_contact == state.cargo_contact
    highest = where(contact, state.cargo_peak, state.engine_peak)
    at = state.at
    end = where(at.xp > there.xp, at.xp, there.xp)
    fast = where(abs(at.vp) > abs(there.vp), abs(at.vp), abs(there.vp))
    return end + h * fast > highest


class Step(NamedTuple):
    """All that follows from a state until its regime changes."""

    law: Law
    series: Series
    watched: list[Watched]
    length: Real  # a first trial [s]


def prepare(case: Collision, state: State, ops: Ops) -> Step:
    """Return the step that starts from `state`."""
    law = linearise(case, state, ops)
    watched = watch(case, state, law, state.at, ops)
    length = predict(watched, longest_step(law, ops), ops)
    return Step(law, expand(law, state.at), watched, length)


def attempt(
    case: Collision, state: State, step: Step, h: Real, ops: Ops
) -> tuple[State, Flag, Real]:
    """Try a step of length `h`.

    Returns
    -------
    state : State
        The state after the step; the old one where the step was too long.
    moved : Flag
        Whether the step held.
    length : Real
        The step taken; where it did not hold, the one to try next [s].
    """
    where = ops.where
    there = evaluate(step.series, h)
    after = watch(case, state, step.law, there, ops)
    records = may_raise_peak(state, there, h, ops)
    event, sooner = first_change(step.watched, after, h, records, ops)
    due = (event != NONE) & (sooner < h)
    moved = due | (sooner >= h)
    full = moved & ops.negate(due)
    there = Position(*(where(full, new, old) for new, old in zip(there, state.at, strict=True)))
    event = where(moved, event, NONE)
    state = advance(case, state, step.law, there, where(full, h, 0.0), event, ops)
    return state, moved, sooner


def follow(
    case: Collision,
    duration: float = 0.0,
    record: Callable[[State, Step, float], None] = lambda state, step, h: None,
) -> State:
    """Propagate one collision until nothing more can happen, and to `duration` at least.

    Parameters
    ----------
    case : Collision
        Floats.
    duration : float, optional
        Time to propagate at least [s].
    record : callable, optional
        Called after each step with the state it started from, the step and its length [s].

    Returns
    -------
    State
        The last state.

    Raises
    ------
    RuntimeError
        When the collision does not come to an end.
    """
    state = start(case, FLOATS)
    for _ in range(STEPS):
        step = prepare(case, state, FLOATS)
        h, moved = step.length, False
        while not moved:
            new, moved, h = attempt(case, state, step, h, FLOATS)
        record(state, step, h)
        state = new
        if state.time >= duration and finished(case, state, FLOATS):
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


def follow_all(case: Collision, state: State | None = None) -> NDArray[np.float64]:
    """Propagate collisions side by side until nothing more can happen in any.

    Parameters
    ----------
    case : Collision
        Arrays of shape (n,).
    state : State, optional
        Where to start from, instead of first touch; arrays of shape (n,).

    Returns
    -------
    ndarray, shape (6, n)
        The OUTCOMES of the last states.

    Raises
    ------
    RuntimeError
        When a collision does not come to an end.
    """
    state = start(case, ARRAYS) if state is None else state
    outcomes = np.empty((len(OUTCOMES), len(case.speed)))
    left = np.arange(len(case.speed))
    moved: Flag = True
    h: Real = 0.0
    done = np.zeros(len(left), dtype=bool)
    for _ in range(STEPS):
        step = prepare(case, state, ARRAYS)
        state, moved, h = attempt(case, state, step, np.where(moved, step.length, h), ARRAYS)
        done |= moved & finished(case, state, ARRAYS)
        # Taking cases out costs about as much as a step: wait until a fifth of them is done.
        if 5 * np.count_nonzero(done) > len(done) or done.all():
            outcomes[:, left[done]] = [getattr(state, name)[done] for name in OUTCOMES]
            going = ~done
            if not going.any():
                return outcomes
            left, moved, h, done = left[going], moved[going], h[going], done[going]
            case, state = _take(case, going), _take(state, going)
    raise RuntimeError("a collision did not come to an end")


T = TypeVar("T", bound=tuple[Any, ...])


def _take(group: T, mask: NDArray[np.bool_]) -> T:
    return type(group)(
        *(_take(item, mask) if isinstance(item, tuple) else item[mask] for item in group)
    )
