"""Coasting: motion under constant contact forces or none, in closed form.

On a plateau or out of contact the forces do not depend on the motion, so that engine and body move
on parabolas and the pier vibrates freely. A stiff pier then goes through many cycles before
anything changes; one step covers them all and ends safely before the first possible change. So
does one step where a body that sticks to the road pushes a yielding pier ever more slowly. A pier
that yields otherwise, or may yield on its next swing, does not coast.
"""

import math
from typing import NamedTuple

from pierimpact.collision.parameters import Parameters
from pierimpact.collision.regimes import (
    FREE,
    NO_BOUND,
    PLATEAU,
    LinearMotion,
    Position,
    State,
    raise_peak,
)
from pierimpact.collision.series import PHASE, Flag, Ops, Real
from pierimpact.collision.yielding import HARDLY, ROUND_OFF, Yielding

# Numerical: share of the time to the earliest change, which round-off must not pass; and the time
# in which a vibration dies out, in units of 1/σ.
SAFETY, DIES_OUT = 0.999, 40.0
# Numerical: (ω/ω_0)² of a vibration that round-off cannot tell from a critically damped one.
LEAST_SQUARE = 1e-16


def period(b: Real, sigma: Real, ops: Ops) -> Real:
    """Return the period of a vibration x'' = −b x − 2 σ x', or the time in which it dies out."""
    square, least = b - sigma * sigma, (2.0 * math.pi / DIES_OUT * sigma) ** 2
    return 2.0 * math.pi / ops.lib.sqrt(ops.where(square > least, square, least))


class FreeVibration(NamedTuple):
    """The pier's free damped vibration about its static displacement.

    x_p = static + exp(−σ t) (y cos ω t + q sin ω t)
    x_p' = exp(−σ t) (v cos ω t − s sin ω t)
    """

    static: Real
    sigma: Real
    omega: Real
    y: Real
    q: Real
    v: Real
    s: Real

    def after(self, t: Real, ops: Ops) -> tuple[Real, Real]:
        """Return displacement and velocity after a time `t`."""
        lib = ops.lib
        decay, cos, sin = lib.exp(-self.sigma * t), lib.cos(self.omega * t), lib.sin(self.omega * t)
        xp = self.static + decay * (self.y * cos + self.q * sin)
        return xp, decay * (self.v * cos - self.s * sin)

    def reach(self, ops: Ops) -> Real:
        """Return a bound, whatever the phase, of the distance from the static displacement."""
        return self._bound(self.y, self.q, ops)

    def fastest(self, ops: Ops) -> Real:
        """Return a bound, whatever the phase, of the speed."""
        return self._bound(self.v, self.s, ops)

    def _bound(self, cosine: Real, sine: Real, ops: Ops) -> Real:
        """Return a bound of exp(−σ t) (cosine cos ω t + sine sin ω t), also where ω is small.

        For |sin ω t| is at most ω t, and t exp(−σ t) at most 1/(e σ).
        """
        rate = ops.where(math.e * self.sigma > self.omega, math.e * self.sigma, self.omega)
        near_critical = abs(cosine) + abs(sine) * self.omega / rate
        any_phase = ops.lib.hypot(cosine, sine)
        return ops.where(near_critical < any_phase, near_critical, any_phase)

    def first_maximum(self, ops: Ops) -> Real:
        """Return the time of the first maximum; no later one is higher."""
        return ops.lib.atan2(self.v, self.s) % (2.0 * math.pi) / self.omega

    def first_minimum(self, ops: Ops) -> Real:
        """Return the time of the first minimum; no later one is lower."""
        return ops.lib.atan2(-self.v, -self.s) % (2.0 * math.pi) / self.omega


def free_vibration(motion: LinearMotion, position: Position, ops: Ops) -> FreeVibration:
    """Return the pier's vibration under the constant forces of `motion`."""
    b, sigma = motion.b, 0.5 * motion.c
    square, least = b - sigma * sigma, LEAST_SQUARE * b
    omega = ops.lib.sqrt(ops.where(square > least, square, least))
    force = motion.intercept1 + motion.gamma * motion.intercept2 + motion.pier_force
    static = motion.inverse_mp * force / b
    y, v = position.xp - static, position.vp
    q, s = (v + sigma * y) / omega, (b * y + sigma * v) / omega
    return FreeVibration(static, sigma, omega, y, q, v, s)


class Creep(NamedTuple):
    """The yielding pier's overdamped motion to rest, against nothing but its damper.

    x_p = rest + A exp(−α t) + B exp(−β t)
    """

    rest: Real
    fast: Real  # A
    alpha: Real
    slow: Real  # B
    beta: Real

    def after(self, t: Real, ops: Ops) -> tuple[Real, Real]:
        """Return displacement and velocity after a time `t`."""
        exp = ops.lib.exp
        fast, slow = self.fast * exp(-self.alpha * t), self.slow * exp(-self.beta * t)
        return self.rest + fast + slow, -self.alpha * fast - self.beta * slow


def creep(motion: LinearMotion, position: Position, ops: Ops) -> Creep:
    """Return the creep of a pier that yields under the spring of a body at rest.

    Where the motion is not overdamped β is zero, and where it turns back B is positive.
    """
    where, sigma = ops.where, 0.5 * motion.c
    square = motion.inverse_mp * motion.slope2
    # Closer to critical damping the two rates are too near each other, and steps are few.
    overdamped = (square > 0.0) & (sigma * sigma > 1.5 * square)
    square = where(overdamped, square, 0.0)
    alpha = sigma + ops.lib.sqrt(where(overdamped, sigma * sigma - square, 1.0))
    beta = square / alpha
    left = (motion.forces(position)[1] + motion.pier_force) / where(overdamped, motion.slope2, 1.0)
    slow = (position.vp - alpha * left) / (alpha - beta)
    return Creep(position.xp + left, -left - slow, alpha, slow, beta)


def coasting_position(
    motion: LinearMotion, position: Position, vibration: FreeVibration | Creep, t: Real, ops: Ops
) -> Position:
    """Return the position after coasting for a time `t`."""
    d1, u1, d2, u2, x0, v0 = position
    xp, vp = vibration.after(t, ops)
    gamma = motion.gamma
    a1, a2 = _constant_accelerations(motion)
    return Position(
        d1=d1 + x0 - xp + t * (u1 + v0 + 0.5 * a1 * t),
        u1=u1 + v0 - vp + a1 * t,
        d2=d2 + gamma * (x0 - xp) + t * (u2 + gamma * v0 + 0.5 * a2 * t),
        u2=u2 + gamma * (v0 - vp) + a2 * t,
        xp=xp,
        vp=vp,
    )


def _constant_accelerations(motion: LinearMotion) -> tuple[Real, Real]:
    """Return the accelerations of engine and body under constant forces."""
    force2 = motion.intercept2 + motion.friction
    return -motion.inverse_m1 * motion.intercept1, -motion.inverse_m2 * force2


def time_without_change(
    parameters: Parameters, state: State, motion: LinearMotion, vibration: FreeVibration, ops: Ops
) -> Real:
    """Return a time in which no regime can change, NO_BOUND where none ever will."""
    where, lib = ops.where, ops.lib
    d1, u1, d2, u2, xp, vp = state.position
    a1, a2 = _constant_accelerations(motion)
    reach, fastest = vibration.reach(ops), vibration.fastest(ops)
    bounds = []
    for line, d, u, a in ((state.engine, d1, u1, a1), (state.body, d2, u2, a2)):
        v = u + vp
        gap = line.upper + vibration.static - reach - d - xp
        square = v * v + 2.0 * a * gap
        arrives = (v > 0.0) & (square >= 0.0)
        root = lib.sqrt(where(arrives, square, 0.0))
        arrives = arrives & ((v + root) * NO_BOUND > 2.0 * gap)
        arrival = where(arrives, 2.0 * gap / where(arrives, v + root, 1.0), NO_BOUND)
        arrival = where(gap > 0.0, arrival, 0.0)
        # Loading goes on while the body is faster than the pier can be.
        slows = a < 0.0
        turn = where(slows, (fastest - v) / where(slows, a, 1.0), where(v > fastest, NO_BOUND, 0.0))
        turn = where(line.regime >= PLATEAU, turn, NO_BOUND)
        bounds.append(where(arrival < turn, arrival, turn))
    bound, of_body = bounds
    if state.yielding is not None:
        of_body = where(state.stuck & parameters.on_pier, NO_BOUND, of_body)
    bound = where(of_body < bound, of_body, bound)
    # Friction on the road may bring the body to rest.
    stops = (motion.friction != 0.0) & ops.negate(parameters.on_pier) & (v * a < 0.0)
    stop = where(stops, -v / where(stops, a, 1.0), NO_BOUND)
    return where(stop < bound, stop, bound)


def creep_to_rest(
    state: State, yielding: Yielding, motion: LinearMotion, ops: Ops
) -> tuple[State, Real]:
    """Return the state once a creeping pier has all but come to rest, and the time it takes.

    On its way nothing can happen: the spring of the body at rest unloads to R_y, and the engine has
    left.
    """
    where, position = ops.where, state.position
    engine_left = (state.engine.regime == FREE) & (position.u1 + position.vp <= 0.0)
    on_road = state.stuck & ops.negate(motion.on_pier)
    creeps = on_road & engine_left & (yielding.direction > 0.0)
    if not ops.some(creeps):
        return state, 0.0
    creeping = creep(motion, position, ops)
    creeps = creeps & (creeping.beta > 0.0) & (creeping.slow < 0.0)
    ratio = -creeping.slow / where(creeps, 0.5 * HARDLY * yielding.largest, 1.0)
    creeps = creeps & (ratio > 1.0)
    if not ops.some(creeps):
        return state, 0.0
    h = ops.lib.log(where(creeps, ratio, 1.0)) / where(creeps, creeping.beta, 1.0)
    end = coasting_position(motion, position, creeping, h, ops)
    end = Position(*map(where, [creeps] * len(end), end, position))
    state = state._replace(time=state.time + h, position=end)
    return raise_peak(state, end.xp, state.time, creeps, ops), h


def coast(
    parameters: Parameters, state: State, motion: LinearMotion, ops: Ops
) -> tuple[State, Real]:
    """Return the state at the end of coasting, and its length: zero where there is none."""
    where, some = ops.where, ops.some
    yielding, together, crept = state.yielding, state.stuck & parameters.on_pier, 0.0
    constant: Flag = (motion.slope1 == 0.0) & (motion.slope2 == 0.0) & ops.negate(together)
    if yielding is not None:
        constant = (constant | (motion.slope1 == 0.0) & together) & (yielding.direction == 0.0)
        state, crept = creep_to_rest(state, yielding, motion, ops)
    if not some(constant):
        return state, crept
    if yielding is not None:  # those that yield are left out in the end, but have no frequency
        motion = motion._replace(b=motion.inverse_mp * parameters.pier_stiffness)
    vibration = free_vibration(motion, state.position, ops)
    bound = time_without_change(parameters, state, motion, vibration, ops)
    # Where nothing ever changes, one period brings the highest peak; numerical: 1 % to spare.
    h = where(bound < NO_BOUND, SAFETY * bound, 1.01 * period(motion.b, vibration.sigma, ops))
    worthwhile = constant & (h * ops.lib.sqrt(motion.b) > PHASE)
    if yielding is not None:
        farthest = abs(vibration.static) + vibration.reach(ops)
        # What holds the body to the pier is F2 + m2 x_p''.
        held = abs(motion.forces(state.position)[1])
        held = held + parameters.body.mass * ops.lib.sqrt(motion.b) * vibration.fastest(ops)
        worthwhile = (
            worthwhile
            & (farthest <= yielding.limit * (1.0 + ROUND_OFF))
            & (ops.negate(together) | (held <= parameters.friction_force))
        )
    if not some(worthwhile):
        return state, crept
    h = where(worthwhile, h, 0.0)
    extremes = [vibration.first_maximum(ops)]
    if yielding is not None:
        extremes.append(vibration.first_minimum(ops))
    time = state.time
    for t in extremes:
        state = raise_peak(state, vibration.after(t, ops)[0], time + t, t < h, ops)
    end = coasting_position(motion, state.position, vibration, h, ops)
    end = Position(*map(where, [worthwhile] * len(end), end, state.position))
    state = state._replace(time=state.time + h, position=end)
    return raise_peak(state, end.xp, state.time, worthwhile, ops), h + crept
