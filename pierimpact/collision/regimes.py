"""The regimes of a collision: the equations of motion in each, and the changes between them.

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
from pierimpact.collision.yielding import YIELDING_ENDS, Yielding

FREE, ELASTIC, PLATEAU, STEEP = range(4)

# Events that end a regime; those of the body's spring are numbered three higher.
UPPER, LOWER, TURN = range(3)  # the crush leaves its line, or turns back
FORWARD, BACKWARD = 6, 7  # the body comes to rest, or begins to slide
NO_EVENT = -1

# Numerical settings.
NO_BOUND = 1e9  # stands for a bound that is never reached, without the NaN of ∞ − ∞
PEAK_TOLERANCE = 1e-13  # relative: a later maximum must exceed a peak by this to replace it


class Branch(NamedTuple):
    """The straight line F = intercept + slope δ that a spring is on, and where it ends."""

    regime: Real
    largest: Real
    slope: Real
    intercept: Real
    lower: Real
    upper: Real


class Position(NamedTuple):
    """Crushes, pier displacement and their rates.

    The displacement is from where the pier's spring is unstressed (`yielding`).
    """

    d1: Real
    u1: Real
    d2: Real
    u2: Real
    xp: Real
    vp: Real


class State(NamedTuple):
    """The state of a collision: position, regime, and contacts and peaks so far."""

    time: Real
    position: Position
    engine: Branch
    body: Branch
    slip: Real  # direction of sliding: 1, −1, or 0 while it sticks or does not act
    stuck: Flag
    last_change: Real  # time of the last change of regime, but for the spring of a body at rest
    engine_contact: Real  # time of the first contact; nan before it
    cargo_contact: Real
    engine_peak: Real  # largest R/k_p before cargo contact
    engine_peak_time: Real
    cargo_peak: Real  # largest R/k_p from cargo contact on
    cargo_peak_time: Real
    yielding: Yielding | None = None  # None where no pier can yield

    def elastic_displacement(self, ops: Ops) -> Real:
        """Return the elastic part R/k_p of the pier's displacement [m]."""
        xp = self.position.xp
        return xp if self.yielding is None else self.yielding.elastic_part(xp, ops)

    def peak(self, ops: Ops) -> Real:
        """Return the largest R/k_p so far, of those before or those from cargo contact on."""
        contact = self.cargo_contact
        return ops.where(contact == contact, self.cargo_peak, self.engine_peak)


class LinearMotion(NamedTuple):
    """The linear equations of motion of one regime.

    x_p'' = (F1 + γ F2 + F_c)/m_p − B x_p − C x_p', with B = k_p/m_p and C = c_p/m_p
    δ1'' = −F1/m1 − x_p''
    δ2'' = −(F2 + F_f)/m2 − γ x_p''

    Where the body sticks, 1/m2 = 0; where it sticks to the pier, both move as one mass, γ = 0
    and m_p includes m2. F_c is the friction where it acts on the pier; where the pier yields, B = 0
    and ∓R_y is in F_c.
    """

    inverse_m1: Real
    inverse_m2: Real
    inverse_mp: Real
    gamma: Real
    b: Real
    c: Real
    slope1: Real
    slope2: Real
    intercept1: Real
    intercept2: Real
    friction: Real
    on_pier: Flag
    pier_force: Real  # F_c
    pace: Real  # B, and what bounds the step instead where the pier yields [1/s²]

    def forces(self, position: Position) -> tuple[Real, Real]:
        """Return the forces F1 and F2 of the springs [N]."""
        return (
            self.intercept1 + self.slope1 * position.d1,
            self.intercept2 + self.slope2 * position.d2,
        )


def branch(spring: Spring, regime: Real, largest: Real, ops: Ops) -> Branch:
    """Return the line of `regime` after a largest crush of `largest` [m].

    The unused spring counts as unloaded from its elastic limit P/k_u, so that first loading
    follows the elastic line like any reloading.
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
        lower=where(elastic, residual, -NO_BOUND),
        upper=where(free, residual, where(elastic, largest, where(plateau, d, NO_BOUND))),
    )


def start(parameters: Parameters, ops: Ops) -> State:
    """Return the state at first touch: both springs at rest, both bodies at full speed."""
    zero = 0.0 * parameters.speed
    unknown = zero + math.nan
    yielding: Yielding | None = None
    if parameters.yield_reaction is not None:
        limit = parameters.yield_reaction / parameters.pier_stiffness
        limit = ops.where(limit < NO_BOUND, limit, NO_BOUND)
        yielding = Yielding(limit, zero, zero, zero, zero)
    first = ELASTIC + zero
    return State(
        time=zero,
        position=Position(zero, parameters.speed, zero, parameters.speed, zero, zero),
        engine=branch(parameters.engine, first, _elastic_limit(parameters.engine), ops),
        body=branch(parameters.body, first, _elastic_limit(parameters.body), ops),
        slip=1.0 + zero,
        stuck=zero != 0.0,
        last_change=zero,
        engine_contact=unknown,
        cargo_contact=unknown,
        engine_peak=zero,
        engine_peak_time=zero,
        cargo_peak=unknown,
        cargo_peak_time=unknown,
        yielding=yielding,
    )


def _elastic_limit(spring: Spring) -> Real:
    return spring.plateau_force / spring.unloading_stiffness


def linear_motion(parameters: Parameters, state: State, ops: Ops) -> LinearMotion:
    """Return the equations of motion of the state's regime."""
    where = ops.where
    stuck_to_pier = state.stuck & parameters.on_pier
    inverse_mp = where(
        stuck_to_pier,
        1.0 / (parameters.pier_mass + parameters.body.mass),
        1.0 / parameters.pier_mass,
    )
    friction, b = state.slip * parameters.friction_force, inverse_mp * parameters.pier_stiffness
    motion = LinearMotion(
        inverse_m1=1.0 / parameters.engine.mass,
        inverse_m2=where(state.stuck, 0.0, 1.0 / parameters.body.mass),
        inverse_mp=inverse_mp,
        gamma=where(stuck_to_pier, 0.0, 1.0),
        b=b,
        c=inverse_mp * parameters.pier_damping,
        slope1=state.engine.slope,
        slope2=state.body.slope,
        intercept1=state.engine.intercept,
        intercept2=state.body.intercept,
        friction=friction,
        on_pier=parameters.on_pier,
        pier_force=parameters.on_pier * friction,
        pace=b,
    )
    if state.yielding is None:
        return motion
    direction, limit = state.yielding.direction, state.yielding.limit
    yields = direction != 0.0
    # Numerical, so that round-off stays small: ten times as long as it takes to crush the truck, or
    # to stop it.
    engine, body, resistance = parameters.engine, parameters.body, limit * parameters.pier_stiffness
    length = engine.plateau_length + body.plateau_length
    to_stop = (engine.mass + body.mass + parameters.pier_mass) * parameters.speed / resistance
    rate = 1.0 / (10.0 * length / parameters.speed + to_stop)
    return motion._replace(
        b=where(yields, 0.0, b),
        pier_force=motion.pier_force - direction * resistance,
        pace=where(yields, rate * rate, b),
    )


def accelerations(motion: LinearMotion, position: Position) -> tuple[Real, Real, Real]:
    """Return δ1'', δ2'' and x_p'' [m/s²]."""
    F1, F2 = motion.forces(position)
    Fs, gamma = motion.friction, motion.gamma
    force = F1 + gamma * F2 + motion.pier_force
    ap = motion.inverse_mp * force - motion.b * position.xp - motion.c * position.vp
    return -motion.inverse_m1 * F1 - ap, -motion.inverse_m2 * (F2 + Fs) - gamma * ap, ap


def raise_peak(state: State, xp: Real, time: Real, counts: Flag, ops: Ops) -> State:
    """Return the state with its present peak raised to `xp` where that `counts` and is higher.

    So is the largest displacement of a pier that can yield; `xp` may be its lowest one too.
    """
    where, yielding = ops.where, state.yielding
    if yielding is not None:
        state = state._replace(yielding=yielding.reach(xp, counts, ops))
        xp = yielding.elastic_part(xp, ops)
    counts = counts & (xp > state.peak(ops) + PEAK_TOLERANCE * abs(xp))
    if not ops.some(counts):
        return state
    cargo_in_contact = state.cargo_contact == state.cargo_contact
    raises, raises_cargo = counts & ops.negate(cargo_in_contact), counts & cargo_in_contact
    return state._replace(
        engine_peak=where(raises, xp, state.engine_peak),
        engine_peak_time=where(raises, time, state.engine_peak_time),
        cargo_peak=where(raises_cargo, xp, state.cargo_peak),
        cargo_peak_time=where(raises_cargo, time, state.cargo_peak_time),
    )


def change_regime(
    parameters: Parameters,
    state: State,
    motion: LinearMotion,
    resistance: Real,
    event: Real,
    ops: Ops,
) -> State:
    """Return the state once `event` has ended the regime of `motion`.

    The `resistance` is the force of the pier's spring and damper [N].
    """
    where = ops.where
    changes = event != NO_EVENT
    if not ops.some(changes):
        return state
    position, time = state.position, state.time
    engine = next_branch(parameters.engine, state.engine, event, position.d1, ops)
    body = next_branch(parameters.body, state.body, event - 3, position.d2, ops)
    slip, stuck, u2 = update_friction(parameters, motion, resistance, state, body, event, ops)
    yielding, position = state.yielding, position._replace(u2=u2)
    if yielding is not None:
        yielding, xp = yielding.after(event, position.xp, ops)
        # At rest to the last digit, or an undamped pier would yield a little more each time.
        vp = where(event == YIELDING_ENDS, position.vp, 0.0)
        position = position._replace(
            u1=position.u1 + vp,
            u2=position.u2 + where(stuck & parameters.on_pier, 0.0, vp),
            xp=xp,
            vp=position.vp - vp,
        )
    meets_engine = (engine.regime == STEEP) & (state.engine_contact != state.engine_contact)
    meets_cargo = (body.regime == STEEP) & (state.cargo_contact != state.cargo_contact)
    # Against a body that rests on the road the pier swings no farther each time.
    matters = changes & ops.negate(
        state.stuck & stuck & ops.negate(parameters.on_pier) & (event >= 3) & (event < FORWARD)
    )
    return state._replace(
        position=position,
        engine=engine,
        body=body,
        slip=slip,
        stuck=stuck,
        last_change=where(matters, time, state.last_change),
        engine_contact=where(meets_engine, time, state.engine_contact),
        cargo_contact=where(meets_cargo, time, state.cargo_contact),
        cargo_peak=where(meets_cargo, state.elastic_displacement(ops), state.cargo_peak),
        cargo_peak_time=where(meets_cargo, time, state.cargo_peak_time),
        yielding=yielding,
    )


def next_branch(spring: Spring, line: Branch, event: Real, crush: Real, ops: Ops) -> Branch:
    """Return the spring's line after `event`, which is UPPER, LOWER, TURN or not one of its own."""
    where = ops.where
    if not ops.some((event >= UPPER) & (event <= TURN)):
        return line
    upper, turn = event == UPPER, event == TURN
    virgin = where(line.largest < spring.plateau_length, PLATEAU, STEEP)
    above = where(line.regime == FREE, ELASTIC, where(line.regime == ELASTIC, virgin, STEEP))
    regime = where(upper, above, where(event == LOWER, FREE, where(turn, ELASTIC, line.regime)))
    return branch(spring, regime, where(turn, crush, line.largest), ops)


def update_friction(
    parameters: Parameters,
    motion: LinearMotion,
    resistance: Real,
    state: State,
    body: Branch,
    event: Real,
    ops: Ops,
) -> tuple[Real, Flag, Real]:
    """Return the friction's direction, whether it sticks, and the rate of δ2, after `event`."""
    position = state.position
    where, negate = ops.where, ops.negate
    # Sliding on the road does not depend on the springs.
    if not ops.some((event >= FORWARD) | state.stuck | parameters.on_pier):
        return state.slip, state.stuck, position.u2
    cs, m2 = parameters.friction_force, parameters.body.mass
    F1, F2 = motion.forces(position)
    # The force that would hold the body to the road, or to the pier in their common motion.
    share = where(parameters.on_pier, m2 / (m2 + parameters.pier_mass), 0.0)
    holding = -F2 - share * (F1 - resistance)

    stops = (event == FORWARD) & negate(state.stuck)
    sticks = stops & (holding <= cs) & (holding >= -cs)
    forward = (event == FORWARD) & (state.stuck | (holding > cs))
    backward = (event == BACKWARD) | (stops & (holding < -cs))
    stuck = (state.stuck & negate(forward | backward)) | sticks
    slip = where(forward, 1.0, where(backward, -1.0, where(stuck, 0.0, state.slip)))

    # Friction on the pier acts while spring 2 is in contact, and starts again with the contact.
    apart = parameters.on_pier & (body.regime == FREE)
    touches = parameters.on_pier & (state.body.regime == FREE) & (body.regime != FREE)
    slip = where(apart, 0.0, where(touches, 1.0, slip))
    stuck = stuck & negate(apart)
    rate_at_rest = where(parameters.on_pier, 0.0, -position.vp)
    return slip, stuck, where(stuck, rate_at_rest, position.u2)
