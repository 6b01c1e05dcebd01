"""Stepping: the coupled motion, summed as its Taylor series up to the next change of regime.

The terms follow from the equations of motion, and their truncation is below round-off for the
step taken, so that no step is bound by accuracy. A step that would carry a spring or the
friction past its regime ends at the instant of the change, found on the series itself.
"""

import math
from collections.abc import Sequence
from typing import TypeAlias

from pierimpact.collision.coasting import period
from pierimpact.collision.parameters import Parameters
from pierimpact.collision.regimes import (
    BACKWARD,
    ELASTIC,
    FORWARD,
    FREE,
    LOWER,
    NO_BOUND,
    NO_EVENT,
    PLATEAU,
    TURN,
    UPPER,
    LinearMotion,
    Position,
    State,
    accelerations,
    change_regime,
    raise_peak,
)
from pierimpact.collision.series import (
    END,
    NEVER,
    PHASE,
    EventFunction,
    Flag,
    Ops,
    Real,
    Terms,
)
from pierimpact.collision.yielding import (
    HARDLY,
    ROUND_OFF,
    YIELDING_ENDS,
    YIELDS_BACKWARD,
    YIELDS_FORWARD,
    Yielding,
)

ENGINE, BODY, PIER = range(3)  # order of δ1, δ2 and x_p in a series
PIER_EXTREME = 8  # of its displacement: an event, but not a change of regime
PASSES = 20  # a quantity passes a value: no change of regime either

# Numerical settings.
LATE = 10.0  # swings of the pier after which a body at rest is looked at more closely
TOLERANCE = 1e-13  # by which a bound is passed before its regime ends, relative to its scale
INACTIVE = -math.inf  # level of a quantity that ends no regime
HOLDING_WEIGHT = 1e-4  # of the holding force: its round-off is larger, by the stiffness

Rates: TypeAlias = tuple[Real, Real, Real]  # value, first and second rate
Series: TypeAlias = tuple[Terms, Terms, Terms]  # of δ1, δ2 and x_p


def rates(motion: LinearMotion, position: Position) -> tuple[Rates, Rates, Rates]:
    """Return δ1, δ2 and x_p, each with its first two rates."""
    d1, u1, d2, u2, xp, vp = position
    a1, a2, ap = accelerations(motion, position)
    return (d1, u1, a1), (d2, u2, a2), (xp, vp, ap)


def expand(motion: LinearMotion, initial: Sequence[Rates], h: Real, count: int, ops: Ops) -> Series:
    """Return the first `count` terms of δ1, δ2 and x_p over a step `h`."""
    d1, d2, xp = ops.blank(h, count)
    square = h * h
    for terms, (value, rate, second) in zip((d1, d2, xp), initial, strict=True):
        terms[0], terms[1], terms[2] = value, rate * h, second * square
    # The equations of motion once more, with the step as the unit of time.
    slope1, slope2, gamma = motion.slope1, motion.slope2, motion.gamma
    g1, g2 = -motion.inverse_m1 * slope1 * square, -motion.inverse_m2 * slope2 * square
    p1, p2 = motion.inverse_mp * slope1 * square, motion.inverse_mp * gamma * slope2 * square
    b, c = motion.b * square, motion.c * h
    for n in range(1, count - 2):
        pier = p1 * d1[n] + p2 * d2[n] - b * xp[n] - c * xp[n + 1]
        xp[n + 2] = pier
        d1[n + 2] = g1 * d1[n] - pier
        d2[n + 2] = g2 * d2[n] - gamma * pier
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


def longest_step(motion: LinearMotion, ops: Ops) -> Real:
    """Return the step in which no mode of the regime turns by more than PHASE."""
    slope1, slope2, c = motion.slope1, motion.slope2, motion.c
    g1, g2 = motion.inverse_m1 * slope1, motion.inverse_m2 * slope2
    square = motion.pace + motion.inverse_mp * (slope1 + motion.gamma * slope2)
    return PHASE / ops.lib.sqrt(square + ops.where(g1 > g2, g1, g2) + c * c)


def event_functions(
    parameters: Parameters, state: State, motion: LinearMotion, ops: Ops
) -> list[EventFunction]:
    """Return the quantities that end the regime when they rise above zero [-]."""
    where, some, negate = ops.where, ops.some, ops.negate
    functions = []
    per_speed = 1.0 / parameters.speed
    for which, spring, line in (
        (ENGINE, parameters.engine, state.engine),
        (BODY, parameters.body, state.body),
    ):
        # A plateau may be much shorter than what the steep part gives.
        scale = where(line.largest > spring.plateau_length, line.largest, spring.plateau_length)
        first, per_length = 3 * which, 1.0 / scale
        loading = line.regime >= PLATEAU
        if some(line.upper < NO_BOUND):
            level = -line.upper * per_length - TOLERANCE
            functions.append(EventFunction(first + UPPER, 0, ((per_length, which),), level))
        if some(line.regime == ELASTIC):
            level = line.lower * per_length - TOLERANCE
            functions.append(EventFunction(first + LOWER, 0, ((-per_length, which),), level))
        if some(loading):
            level = where(loading, -TOLERANCE, INACTIVE)
            functions.append(EventFunction(first + TURN, 1, ((-per_speed, which),), level))

    # Sliding ends where the relative velocity would reverse.
    acts = parameters.friction_force > 0.0
    slides = acts & (state.slip != 0.0)
    if some(slides):
        level, back = where(slides, -TOLERANCE, INACTIVE), -state.slip * per_speed
        parts = ((back, BODY), (where(parameters.on_pier, 0.0, back), PIER))
        functions.append(EventFunction(FORWARD, 1, parts, level))

    # Sticking ends where the force that holds the body exceeds c_s, forward or backward. Against
    # the pier it is F2 + m2 x_p'' with F2 constant.
    if some(state.stuck):
        scale = HOLDING_WEIGHT / where(acts, parameters.friction_force, 1.0)
        slope, inertia = scale * motion.slope2, scale * parameters.body.mass
        force = scale * motion.intercept2 + where(
            parameters.on_pier, slope * state.position.d2, 0.0
        )
        for stuck, order, weight, which in (
            (state.stuck & negate(parameters.on_pier), 0, slope, BODY),
            (state.stuck & parameters.on_pier, 2, inertia, PIER),
        ):
            level = where(acts & stuck, -HOLDING_WEIGHT - TOLERANCE, INACTIVE)
            functions.append(EventFunction(FORWARD, order, ((-weight, which),), level - force))
            functions.append(EventFunction(BACKWARD, order, ((weight, which),), level + force))

    # The pier begins to yield at either limit, and is elastic again where it turns back.
    if state.yielding is not None:
        direction = state.yielding.direction
        elastic, yields = direction == 0.0, direction != 0.0
        if some(elastic):
            per_limit = where(elastic, 1.0 / state.yielding.limit, 0.0)
            level = where(elastic, -1.0 - TOLERANCE, INACTIVE)
            functions.append(EventFunction(YIELDS_FORWARD, 0, ((per_limit, PIER),), level))
            functions.append(EventFunction(YIELDS_BACKWARD, 0, ((-per_limit, PIER),), level))
        if some(yields):
            # The truck's momentum gives a heavy pier no more than a share of its speed.
            truck = parameters.engine.mass + parameters.body.mass
            back = -direction * per_speed * (1.0 + parameters.pier_mass / truck)
            level = where(yields, -TOLERANCE, INACTIVE)
            functions.append(EventFunction(YIELDING_ENDS, 1, ((back, PIER),), level))
    return functions


def trial_step(
    longest: Real, initial: Sequence[Rates], functions: list[EventFunction], ops: Ops
) -> Real:
    """Return the longest step, or four times that to the first zero by the initial rates."""
    where, h = ops.where, longest
    for _, order, parts, level in functions:
        if order == 2:
            continue
        value, rate = level, 0.0
        for weight, which in parts:
            value = value + weight * initial[which][order]
            rate = rate + weight * initial[which][order + 1]
        nears = (value < 0.0) & (rate * h > -4.0 * value)
        h = where(nears, -4.0 * value / where(nears, rate, 1.0), h)
    return h


def may_rise(
    functions: list[EventFunction],
    series: Series,
    peak: Real,
    h: Real,
    ops: Ops,
    yielding: Yielding | None = None,
) -> list[tuple[EventFunction, Flag]]:
    """Return the functions per step, each with whether it may rise above zero.

    Added is the maximum of the pier's displacement, which matters only where it may exceed the
    `peak` so far; and of a pier that can yield the minimum, where it may be the largest so far.
    """
    where = ops.where
    # No rate departs from its start by more than the sum of its further terms, and no displacement
    # from its tangent by more than half of that.
    spread = [ops.fixed(END, ops.sizes(terms[2:])) for terms in series]
    flagged = []
    for function in functions:
        event, order, parts, most = function
        if order:
            parts = tuple([(weight / h**order, which) for weight, which in parts])
            function = EventFunction(event, order, parts, function.level)
            for weight, which in parts:
                most = most + weight * series[which][order] + abs(weight) * spread[which]
        else:
            for weight, which in parts:
                ahead = weight * series[which][1]
                most = most + weight * series[which][0] + where(ahead > 0.0, ahead, 0.0)
                most = most + 0.5 * abs(weight) * spread[which]
        flagged.append((function, most > 0.0))
    xp, vp = series[PIER][0], abs(series[PIER][1])
    may_peak = (spread[PIER] > vp) & (xp + vp + spread[PIER] > peak)
    if yielding is not None:
        elastic, farthest = yielding.direction == 0.0, vp + spread[PIER] - yielding.displacement
        may_dip = (spread[PIER] > vp) & (farthest - xp > yielding.largest) & elastic
        dip = EventFunction(PIER_EXTREME, 1, ((0.0 * h + 1.0, PIER),), 0.0 * h)
        flagged.append((dip, may_dip))
        may_peak = may_peak & elastic
    flagged.append((EventFunction(PIER_EXTREME, 1, ((0.0 * h - 1.0, PIER),), 0.0 * h), may_peak))
    return flagged


def first_event(
    flagged: list[tuple[EventFunction, Flag]], series: Series, state: State, h: Real, ops: Ops
) -> tuple[State, Real, Real]:
    """Return the state with its peak raised, the event that ends the step, and at what fraction."""
    where = ops.where
    event, theta, extremes = NO_EVENT + 0.0 * h, 1.0 + 0.0 * h, []
    for which, fraction, happens in ops.rises(flagged, series):
        if which == PIER_EXTREME:
            extremes.append(where(happens, fraction, NEVER))
        else:
            sooner = fraction < theta
            theta = where(sooner, fraction, theta)
            event = where(sooner, where(happens, which, NO_EVENT), event)
    for extreme in extremes:
        passed = extreme < theta
        if ops.some(passed):
            weights = ops.weights(where(passed, extreme, 0.0), len(series[PIER]))
            time = state.time + extreme * h
            state = raise_peak(state, ops.dot(weights, series[PIER]), time, passed, ops)
    return state, event, theta


def advance(
    parameters: Parameters, state: State, motion: LinearMotion, ops: Ops
) -> tuple[State, Real]:
    """Return the state after one step, at most up to the first change, and the step's length."""
    functions = event_functions(parameters, state, motion, ops)
    initial = rates(motion, state.position)
    longest = longest_step(motion, ops)
    h = trial_step(longest, initial, functions, ops)
    series = expand(motion, initial, h, ops.terms(h / longest), ops)
    flagged = may_rise(functions, series, state.peak(ops), h, ops, state.yielding)
    state, event, theta = first_event(flagged, series, state, h, ops)
    length, position = theta * h, evaluate(series, h, theta, ops)
    state = state._replace(time=state.time + length, position=position)
    state = raise_peak(state, position.xp, state.time, True, ops)
    reaction = parameters.pier_stiffness * state.elastic_displacement(ops)
    resistance = reaction + parameters.pier_damping * position.vp
    return change_regime(parameters, state, motion, resistance, event, ops), length


def prospects(
    parameters: Parameters, state: State, pier_energy: Real, ops: Ops
) -> tuple[Flag, Flag]:
    """Say whether no peak can be raised and no first contact come, and whether the truck has left.

    A peak counts as raised where the pier yields, too, for its displacement grows.
    Nothing can come where the energy that can still reach the pier does not suffice. The pier can
    only push a body back, so that the energy of a body moving back does not count, unless friction
    on the pier can drag it forward. The truck has left where both bodies have separated from the
    pier.
    """
    where = ops.where
    engine, body = parameters.engine, parameters.body
    d1, u1, d2, u2, _, vp = state.position
    v1, v2 = u1 + vp, u2 + vp
    energy = pier_energy + where(v1 > 0.0, 0.5 * engine.mass * v1**2, 0.0)
    drags = parameters.on_pier & (parameters.friction_force > 0.0)
    energy = energy + where((v2 > 0.0) | drags, 0.5 * body.mass * v2**2, 0.0)
    F1 = state.engine.intercept + state.engine.slope * d1
    F2 = state.body.intercept + state.body.slope * d2
    energy = energy + 0.5 * F1**2 / engine.unloading_stiffness
    in_all = energy = energy + 0.5 * F2**2 / body.unloading_stiffness
    if state.yielding is not None:
        energy = energy - kept_by_spring(parameters, state, F2, state.yielding, ops)
    no_contact: Flag = True
    for spring, line, d, contact in (
        (engine, state.engine, d1, state.engine_contact),
        (body, state.body, d2, state.cargo_contact),
    ):
        crushed = where(d > line.largest, d, line.largest)
        # The plateau's work, and what the spring holds at its end.
        held = 0.5 * spring.plateau_force**2 / spring.unloading_stiffness
        needed = held + spring.plateau_force * (spring.plateau_length - crushed)
        no_contact = no_contact & ((contact == contact) | (needed > in_all))
    peak = state.peak(ops)
    peak = where(peak > 0.0, peak, 0.0)
    no_peak = 2.0 * energy <= parameters.pier_stiffness * peak**2 * (1.0 + 1e-9)
    if state.yielding is not None:
        limit = state.yielding.limit
        yields_no_more = 2.0 * energy <= parameters.pier_stiffness * limit**2 * (1.0 + ROUND_OFF)
        no_peak = (no_peak | (peak >= limit * (1.0 - ROUND_OFF))) & yields_no_more

    engine_left = (state.engine.regime == FREE) & (v1 <= 0.0)
    body_left = ((state.body.regime == FREE) & (v2 <= 0.0)) | state.stuck
    decided = no_contact & no_peak
    late = engine_left & ops.negate(parameters.on_pier) & (v2 <= 0.0)
    late = late & (state.time > LATE * swing(parameters, ops))
    if ops.some(late):
        decided = decided | (late & at_rest(parameters, state, pier_energy, F2, v2, peak, ops))
    return decided, engine_left & body_left


def at_rest(
    parameters: Parameters,
    state: State,
    pier_energy: Real,
    force: Real,
    speed: Real,
    peak: Real,
    ops: Ops,
) -> Flag:
    """Say whether nothing can come of a pier that swings against a body at rest on the road.

    An undamped pier moves such a body back a little at each swing, ever less, and would go on for
    thousands. The engine has left, and the body's spring, whose force is F2 now, can only push the
    body back, with a speed v2 now. For the pier to reach a displacement x, the body may stay, and
    its spring keeps F²/(2 k_u) of the energy, F being its force there; or slide back until that is
    c_s, which takes c_s per length: (c_s F − c_s²/2)/k_u in all. Derived here.
    """
    where, body = ops.where, parameters.body
    stiffness, friction = body.unloading_stiffness, parameters.friction_force
    # What the force would be at a displacement, with a gap as a negative one.
    gap = state.position.d2 - state.body.upper
    now = where(state.body.regime == FREE, stiffness * gap, force)
    energy = pier_energy + 0.5 * (force**2 / stiffness + body.mass * speed**2)
    target = peak
    if state.yielding is not None:
        limit = state.yielding.limit
        target = where(peak >= limit * (1.0 - ROUND_OFF), limit, peak)
    there = now - stiffness * (target - state.position.xp)
    there = where(there > 0.0, there, 0.0)
    kept = _held_back(there, friction, ops) / stiffness
    out_of_reach = 2.0 * energy <= parameters.pier_stiffness * target**2 * (1.0 + 1e-9) + 2.0 * kept
    # Neither does the pier come back to the engine, nor the body's spring to its end. There the
    # pier still has energy: k_p x²/2, or if k_p x exceeds c_s, less by what the body slides back.
    behind = state.position.d1 + state.position.xp - state.engine.upper
    apart = (behind < 0.0) & (parameters.pier_stiffness * behind**2 > 2.0 * energy)
    needed = 0.5 * body.plateau_force**2 / stiffness
    needed = needed + body.plateau_force * (body.plateau_length - state.body.largest)
    end = state.elastic_displacement(ops) + state.position.d2 - body.plateau_length
    pull = parameters.pier_stiffness * end
    needed = needed + _held_back(pull, friction, ops) / parameters.pier_stiffness
    no_contact = (state.cargo_contact == state.cargo_contact) | (needed > energy)
    return out_of_reach & apart & no_contact


def _held_back(force: Real, friction: Real, ops: Ops) -> Real:
    """Return F²/2, or where a force F exceeds friction c_s what sliding leaves, c_s F − c_s²/2."""
    return ops.where(force > friction, friction * (force - 0.5 * friction), 0.5 * force**2)


def kept_by_spring(
    parameters: Parameters, state: State, force: Real, yielding: Yielding, ops: Ops
) -> Real:
    """Return what the body's spring, with a force F2, keeps of its energy before the pier yields.

    On the pier, what friction takes while it unloads; against a body at rest on the road, what is
    left in it when the pier gets as far as R_y, and no more than the friction can hold.
    """
    where, friction = ops.where, parameters.friction_force
    stiffness = parameters.body.unloading_stiffness
    left = force - stiffness * (yielding.limit - state.position.xp)
    left = where(state.stuck & (left > 0.0), where(left < friction, left, friction), 0.0)
    rest = where(force > friction, force - friction, 0.0)
    square = where(parameters.on_pier, force * force - rest * rest, left * left)
    return 0.5 * square / stiffness


def finished(parameters: Parameters, state: State, ops: Ops) -> Flag:
    """Say whether no later instant can raise a peak, bring a first contact or let the pier yield.

    Either the energy does not suffice, or the truck has left and the pier has vibrated freely for
    a whole period. A pier that yields comes to rest before, unless the spring of a body that sticks
    to the road still holds it with just about R_y.
    """
    mass, stiffness, yielding = parameters.pier_mass, parameters.pier_stiffness, state.yielding
    elastic = state.elastic_displacement(ops)
    energy = 0.5 * (stiffness * elastic**2 + mass * state.position.vp**2)
    decided, left = prospects(parameters, state, energy, ops)
    late = state.time > state.last_change + swing(parameters, ops)
    left = left & late
    if yielding is not None:
        elastic, rests = yielding.direction == 0.0, held(parameters, state, yielding)
        decided, left = decided & (elastic | (late & rests)), left & (elastic | rests)
    return decided | left


def swing(parameters: Parameters, ops: Ops) -> Real:
    """Return how long the pier swings until nothing new comes, a body that sticks to it or not."""
    mass = parameters.pier_mass
    moving = mass + ops.where(parameters.on_pier, parameters.body.mass, 0.0)
    sigma = 0.5 * parameters.pier_damping * ops.lib.sqrt(1.0 / (mass * moving))
    return period(parameters.pier_stiffness / moving, sigma, ops)


def held(parameters: Parameters, state: State, yielding: Yielding) -> Flag:
    """Say whether a pier that yields hardly moves under the spring of a body at rest.

    About the force R_y of the spring it vibrates with no more than its present amplitude. An engine
    that still touches it adds its force.
    """
    line, position = state.body, state.position
    surplus = line.intercept + line.slope * position.d2
    surplus = surplus + state.engine.intercept + state.engine.slope * position.d1
    surplus = surplus - yielding.direction * yielding.limit * parameters.pier_stiffness
    square = surplus**2 + line.slope * parameters.pier_mass * position.vp**2
    return square <= (HARDLY * line.slope * yielding.largest) ** 2
