"""The regimes of a collision: what holds between two changes, and what a change brings.

In a regime every spring is on one straight line and the friction slides, sticks or does not
act, so the equations of motion are linear.

The unknowns are the crushes δ1, δ2 and the pier's displacement x_p, with their rates. Each
number is a float for one collision or an array of shape (n,) for n collisions side by side,
and `ops` brings the functions that differ (`pierimpact.collision.series`).
"""

import math
from typing import NamedTuple

from pierimpact.collision.parameters import Parameters, Spring
from pierimpact.collision.series import Flag, Ops, Real

FREE, ELASTIC, PLATEAU, STEEP = range(4)

# What can end a regime. The body's spring follows three places after the engine's.
UPPER, LOWER, TURN = range(3)  # the crush leaves its line, or turns back
FORWARD, BACKWARD = 6, 7  # the body comes to rest, or begins to slide
NONE = -1

FAR = 1e9  # stands for a bound that is never reached, without the NaN of ∞ − ∞
SAME = 1e-13  # a later swing to the same height, but for so much of it, is no new peak


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


def start(parameters: Parameters, ops: Ops) -> State:
    """Return the state at first touch: both springs at rest, both bodies at full speed."""
    nought = 0.0 * parameters.speed
    unknown = nought + math.nan
    first = ELASTIC + nought
    return State(
        time=nought,
        at=Position(nought, parameters.speed, nought, parameters.speed, nought, nought),
        engine=branch(parameters.engine, first, _elastic_limit(parameters.engine), ops),
        body=branch(parameters.body, first, _elastic_limit(parameters.body), ops),
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


def linearise(parameters: Parameters, state: State, ops: Ops) -> Law:
    """Return the equations of motion of the state's regime."""
    where = ops.where
    stuck_to_pier = state.stuck & parameters.on_pier
    wp = where(
        stuck_to_pier,
        1.0 / (parameters.pier_mass + parameters.body.mass),
        1.0 / parameters.pier_mass,
    )
    return Law(
        w1=1.0 / parameters.engine.mass,
        w2=where(state.stuck, 0.0, 1.0 / parameters.body.mass),
        wp=wp,
        gamma=where(stuck_to_pier, 0.0, 1.0),
        b=wp * parameters.pier_stiffness,
        c=wp * parameters.pier_damping,
        s1=state.engine.slope,
        s2=state.body.slope,
        intercept1=state.engine.intercept,
        intercept2=state.body.intercept,
        friction=state.slip * parameters.friction_force,
        on_pier=parameters.on_pier,
    )


def accelerations(law: Law, at: Position) -> tuple[Real, Real, Real]:
    """Return δ1'', δ2'' and x_p'' [m/s²]."""
    F1 = law.intercept1 + law.s1 * at.d1
    F2 = law.intercept2 + law.s2 * at.d2
    Fs = law.friction
    ap = law.wp * (F1 + law.gamma * F2 + law.on_pier * Fs) - law.b * at.xp - law.c * at.vp
    return -law.w1 * F1 - ap, -law.w2 * (F2 + Fs) - law.gamma * ap, ap


def raise_peak(state: State, xp: Real, time: Real, counts: Flag, ops: Ops) -> State:
    """Return the state with its present peak raised to `xp` where that `counts` and is higher."""
    where = ops.where
    met = state.cargo_contact == state.cargo_contact
    counts = counts & (xp > where(met, state.cargo_peak, state.engine_peak) + SAME * abs(xp))
    raises, raises_cargo = counts & ops.negate(met), counts & met
    if not ops.some(counts):
        return state
    return state._replace(
        engine_peak=where(raises, xp, state.engine_peak),
        engine_peak_time=where(raises, time, state.engine_peak_time),
        cargo_peak=where(raises_cargo, xp, state.cargo_peak),
        cargo_peak_time=where(raises_cargo, time, state.cargo_peak_time),
    )


def change_regime(parameters: Parameters, state: State, law: Law, event: Real, ops: Ops) -> State:
    """Return the state once `event` has ended the regime of `law`."""
    where = ops.where
    changes = event != NONE
    if not ops.some(changes):
        return state
    at, time = state.at, state.time
    engine = change(parameters.engine, state.engine, event, at.d1, ops)
    body = change(parameters.body, state.body, event - 3, at.d2, ops)
    slip, stuck, u2 = rub(parameters, law, state, body, event, ops)
    meets_engine = (engine.regime == STEEP) & (state.engine_contact != state.engine_contact)
    meets_cargo = (body.regime == STEEP) & (state.cargo_contact != state.cargo_contact)
    return state._replace(
        at=at._replace(u2=u2),
        engine=engine,
        body=body,
        slip=slip,
        stuck=stuck,
        changed=where(changes, time, state.changed),
        engine_contact=where(meets_engine, time, state.engine_contact),
        cargo_contact=where(meets_cargo, time, state.cargo_contact),
        cargo_peak=where(meets_cargo, at.xp, state.cargo_peak),
        cargo_peak_time=where(meets_cargo, time, state.cargo_peak_time),
    )


def change(spring: Spring, line: Branch, event: Real, crush: Real, ops: Ops) -> Branch:
    """Return the spring's line after `event`, one of UPPER, LOWER and TURN or none of its own."""
    where = ops.where
    if not ops.some((event >= UPPER) & (event <= TURN)):
        return line
    upper, turn = event == UPPER, event == TURN
    virgin = where(line.largest < spring.plateau_length, PLATEAU, STEEP)
    above = where(line.regime == FREE, ELASTIC, where(line.regime == ELASTIC, virgin, STEEP))
    regime = where(upper, above, where(event == LOWER, FREE, where(turn, ELASTIC, line.regime)))
    return branch(spring, regime, where(turn, crush, line.largest), ops)


def rub(
    parameters: Parameters, law: Law, state: State, body: Branch, event: Real, ops: Ops
) -> tuple[Real, Flag, Real]:
    """Return the friction's direction, whether it sticks, and the rate of δ2, after `event`."""
    at = state.at
    where, negate = ops.where, ops.negate
    # While it slides on the road, the springs do not concern it.
    if not ops.some((event >= FORWARD) | state.stuck | parameters.on_pier):
        return state.slip, state.stuck, at.u2
    cs, m2 = parameters.friction_force, parameters.body.mass
    F1 = law.intercept1 + law.s1 * at.d1
    F2 = law.intercept2 + law.s2 * at.d2
    together = F1 - parameters.pier_stiffness * at.xp - parameters.pier_damping * at.vp
    hold = -F2 - where(parameters.on_pier, m2 / (m2 + parameters.pier_mass), 0.0) * together

    ends = (event == FORWARD) & negate(state.stuck)
    sticks = ends & (hold <= cs) & (hold >= -cs)
    forward = (event == FORWARD) & (state.stuck | (hold > cs))
    backward = (event == BACKWARD) | (ends & (hold < -cs))
    stuck = (state.stuck & negate(forward | backward)) | sticks
    slip = where(forward, 1.0, where(backward, -1.0, where(stuck, 0.0, state.slip)))

    # Friction on the pier acts while spring 2 is in contact, and begins anew with the contact.
    apart = parameters.on_pier & (body.regime == FREE)
    anew = parameters.on_pier & (state.body.regime == FREE) & (body.regime != FREE)
    slip = where(apart, 0.0, where(anew, 1.0, slip))
    stuck = stuck & negate(apart)
    rest = where(parameters.on_pier, 0.0, -at.vp)
    return slip, stuck, where(stuck, rest, at.u2)
