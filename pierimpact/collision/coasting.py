"""Coasting: engine and body push with constant forces or not at all, and the pier rings.

On a plateau or out of contact the three bodies do not feel each other's motion, and each has an
elementary closed form. A stiff pier then rings many times before anything changes; all of it is
passed in one step that ends safely before the first possible change of regime.
"""

import math
from typing import NamedTuple

from pierimpact.collision.parameters import Parameters
from pierimpact.collision.regimes import (
    FAR,
    PLATEAU,
    Law,
    Position,
    State,
    raise_peak,
)
from pierimpact.collision.series import PHASE, Flag, Ops, Real

SHORT = 0.999  # of the way to the earliest change, so that it lies ahead despite round-off


class Ringing(NamedTuple):
    """The pier's free damped vibration about its static displacement.

    x_p = rest + exp(−σ t) (y cos ω t + q sin ω t)
    x_p' = exp(−σ t) (v cos ω t − s sin ω t)
    """

    rest: Real
    sigma: Real
    omega: Real
    y: Real
    q: Real
    v: Real
    s: Real

    def after(self, t: Real, ops: Ops) -> tuple[Real, Real]:
        """Return displacement and velocity after a time `t`."""
        lib = ops.lib
        fade, cos, sin = lib.exp(-self.sigma * t), lib.cos(self.omega * t), lib.sin(self.omega * t)
        xp = self.rest + fade * (self.y * cos + self.q * sin)
        return xp, fade * (self.v * cos - self.s * sin)

    def first_top(self, ops: Ops) -> Real:
        """Return the time of the first maximum; no later one is higher."""
        return (0.5 * math.pi - ops.lib.atan2(self.s, self.v)) % (2.0 * math.pi) / self.omega


def ringing(law: Law, at: Position, ops: Ops) -> Ringing:
    """Return the pier's vibration under the constant forces of `law`."""
    sigma = 0.5 * law.c
    omega = ops.lib.sqrt(law.b - sigma * sigma)
    force = law.intercept1 + law.gamma * law.intercept2 + law.on_pier * law.friction
    rest = law.wp * force / law.b
    y, v = at.xp - rest, at.vp
    return Ringing(
        rest, sigma, omega, y, (v + sigma * y) / omega, v, (law.b * y + sigma * v) / omega
    )


def coasted(law: Law, at: Position, ring: Ringing, t: Real, ops: Ops) -> Position:
    """Return the position after coasting for a time `t`; engine and body follow parabolas."""
    xp, vp = ring.after(t, ops)
    gamma = law.gamma
    a1, a2 = _pushes(law)
    return Position(
        d1=at.d1 + at.xp - xp + t * (at.u1 + at.vp + 0.5 * a1 * t),
        u1=at.u1 + at.vp - vp + a1 * t,
        d2=at.d2 + gamma * (at.xp - xp) + t * (at.u2 + gamma * at.vp + 0.5 * a2 * t),
        u2=at.u2 + gamma * (at.vp - vp) + a2 * t,
        xp=xp,
        vp=vp,
    )


def _pushes(law: Law) -> tuple[Real, Real]:
    """Return the accelerations of engine and body under constant forces."""
    return -law.w1 * law.intercept1, -law.w2 * (law.intercept2 + law.friction)


def undisturbed(parameters: Parameters, state: State, law: Law, ring: Ringing, ops: Ops) -> Real:
    """Return a time in which no regime can change, FAR where none ever will."""
    where, lib, at = ops.where, ops.lib, state.at
    # Whatever its phase, the pier stays within this reach of its rest, and below this speed.
    reach, fastest = lib.hypot(ring.y, ring.q), lib.hypot(ring.v, ring.s)
    bound = FAR
    for line, d, u, a in zip(
        (state.engine, state.body), (at.d1, at.d2), (at.u1, at.u2), _pushes(law), strict=True
    ):
        v = u + at.vp
        gap = line.upper + ring.rest - reach - d - at.xp
        square = v * v + 2.0 * a * gap
        arrives = (v > 0.0) & (square >= 0.0)
        root = lib.sqrt(where(arrives, square, 0.0))
        arrival = where(arrives, 2.0 * gap / where(arrives, v + root, 1.0), FAR)
        arrival = where(gap > 0.0, arrival, 0.0)
        # Under load the crush must keep growing, faster than the pier can get away.
        slows = a < 0.0
        lead = where(slows, (fastest - v) / where(slows, a, 1.0), where(v > fastest, FAR, 0.0))
        lead = where(line.regime >= PLATEAU, lead, FAR)
        bound = where(arrival < bound, arrival, bound)
        bound = where(lead < bound, lead, bound)
    # The friction of the road brings the body to rest.
    stops = (law.friction != 0.0) & ops.negate(parameters.on_pier) & (v * a < 0.0)
    stop = where(stops, -v / where(stops, a, 1.0), FAR)
    return where(stop < bound, stop, bound)


def coast(parameters: Parameters, state: State, law: Law, ops: Ops) -> tuple[State, Real]:
    """Return the state at the end of coasting, and its length: zero where there is none."""
    where, some = ops.where, ops.some
    constant: Flag = (
        (law.s1 == 0.0) & (law.s2 == 0.0) & ops.negate(state.stuck & parameters.on_pier)
    )
    if not some(constant):
        return state, 0.0
    ring = ringing(law, state.at, ops)
    bound = undisturbed(parameters, state, law, ring, ops)
    # Where nothing ever changes, one period brings the highest peak.
    h = where(bound < FAR, SHORT * bound, 1.01 * 2.0 * math.pi / ring.omega)
    worthwhile = constant & (h * ring.omega > PHASE)
    if not some(worthwhile):
        return state, 0.0
    h = where(worthwhile, h, 0.0)
    top = ring.first_top(ops)
    state = raise_peak(state, ring.after(top, ops)[0], state.time + top, top < h, ops)
    there = coasted(law, state.at, ring, h, ops)
    there = Position(*map(where, [worthwhile] * len(there), there, state.at))
    state = state._replace(time=state.time + h, at=there)
    return raise_peak(state, there.xp, state.time, worthwhile, ops), h
