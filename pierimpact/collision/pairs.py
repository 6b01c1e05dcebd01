"""A body and a stiff pier as a pair, for many cycles at once and for many collisions side by side.

While one spring alone is at work, the other's force is constant, its body moves on a parabola, and
the pair vibrates in two modes: a slow one, in which the body swings and the pier follows, and a
fast one, in which the pier rings. A stiff pier passes through many cycles before anything changes;
one step covers them all. It ends at a node of a grid in time up to which no regime can change,
whatever the phase of the fast mode, and no peak is passed over that a later instant of the same
regime does not exceed.

With λ of a mode, s the body's displacement as seen from the road, g = k/m and p = k/m_p, both about
where the pair would rest:

fast: s = φ x_p, φ = g/(g + λ²), λ² + C λ + B + p (1 − φ) = 0
slow: x_p = ψ s, ψ = p/(λ² + C λ + B + p), λ² + g (1 − ψ) = 0

As the equations of motion are symmetric in s and x_p, their sum weighted by one mode is free of the
other. Derived here.
"""

import math
from typing import NamedTuple

import numpy as np

from pierimpact.collision.parameters import Parameters
from pierimpact.collision.regimes import LinearMotion, Position, State, raise_peak
from pierimpact.collision.series import ARRAYS, EventFunction, Flag, Real
from pierimpact.collision.stepping import PASSES, PIER, event_functions, longest_step

# Numerical settings.
GAP = 8.0  # least ratio of the pier's frequency to that of the body on its spring
REFINED = 5  # steps of Newton's method to a mode, which at that ratio starts within some per cent
NODES, SPAN = 32, 2.5  # of the grid, and how far the slow mode turns over it at least [rad]
WORTHWHILE = 2.0  # ordinary steps that a long one must replace


class Mode(NamedTuple):
    """A mode: the real part of amplitude × exp(λ t)."""

    rate: Real  # λ, shape (n,) [1/s]
    amplitudes: Real  # of δ1, δ2 and x_p, shape (3, n) [m]


class PairMotion(NamedTuple):
    """The motion of a pair and the other body: base + rate t + ½ second t² + the modes."""

    base: Real  # of δ1, δ2 and x_p, shape (3, n) [m]
    rate: Real
    second: Real
    slow: Mode
    fast: Mode

    def after(self, t: Real) -> Position:
        """Return the position after a time `t`."""
        x, v = self.base + t * (self.rate + 0.5 * t * self.second), self.rate + t * self.second
        for mode in (self.slow, self.fast):
            z = mode.amplitudes * np.exp(mode.rate * t)
            x, v = x + z.real, v + (mode.rate * z).real
        return Position(x[0], v[0], x[1], v[1], x[2], v[2])


def are_pairs(state: State, motion: LinearMotion) -> Flag:
    """Say where one spring alone is at work, on a body that a stiff pier forms a pair with.

    And where, as the speed is, neither spring comes to its end in what is worthwhile.
    """
    position, time = state.position, WORTHWHILE * longest_step(motion, ARRAYS)
    lasts = position.d1 + time * position.u1 < state.engine.upper
    lasts &= position.d2 + time * position.u2 < state.body.upper
    slope1, slope2 = motion.slope1, motion.gamma * motion.slope2
    g = motion.inverse_m1 * slope1 + motion.inverse_m2 * slope2
    square = motion.b + motion.inverse_mp * (slope1 + slope2)
    stiff = (square > GAP**2 * g) & (square > motion.c**2) & (motion.b > 0.0)
    return lasts & stiff & (g > 0.0) & (slope1 * slope2 == 0.0)


def pair_motion(motion: LinearMotion, position: Position) -> PairMotion:
    """Return the motion of pairs, and of the body that is in none."""
    engine, b, c, nothing = motion.slope1 > 0.0, motion.b, motion.c, 0.0 * motion.b
    (F1, F2), gamma = motion.forces(position), motion.gamma
    d1, u1, d2, u2, xp, vp = position
    # Of the pair's body, and of the other one.
    d, other_d = _either(engine, d1, d2)
    u, other_u = _either(engine, u1, u2)
    inverse_m, other_inverse_m = _either(engine, motion.inverse_m1, motion.inverse_m2)
    friction, other_friction = _either(engine, nothing, motion.friction)
    intercept, _ = _either(engine, motion.intercept1, motion.intercept2)
    slope, _ = _either(engine, motion.slope1, motion.slope2)
    _, other_force = _either(engine, F1, F2)
    _, other_gamma = _either(engine, 1.0 + nothing, gamma)

    # Where the pair would rest, and the motion about it.
    force = other_gamma * other_force + motion.pier_force - friction
    rest, d_rest = motion.inverse_mp * force / b, -(intercept + friction) / slope
    x, s, v = xp - rest, d + xp - d_rest - rest, u + vp
    g, p = inverse_m * slope, motion.inverse_mp * slope

    rate, share, by_rate = _fast_mode(b, c, g, p)
    # Twice, as the conjugate mode has as much.
    of_pier = 2.0 * (p / g * share * (rate * s + v) + (rate + c) * x + vp) / by_rate
    fast = Mode(rate, _in_order(engine, (share - 1.0) * of_pier, -other_gamma * of_pier, of_pier))

    rate, share, by_rate = _slow_mode(b, c, g, p)
    of_body = 2.0 * (rate * s + v + g / p * share * ((rate + c) * x + vp)) / by_rate
    of_pier, crush = share * of_body, -rate * rate / g * of_body
    slow = Mode(rate, _in_order(engine, crush, -other_gamma * of_pier, of_pier))

    second = -other_inverse_m * (other_force + other_friction)
    return PairMotion(
        base=_in_order(engine, d_rest, other_d + other_gamma * x, rest),
        rate=_in_order(engine, nothing, other_u + other_gamma * vp, nothing),
        second=_in_order(engine, nothing, second, nothing),
        slow=slow,
        fast=fast,
    )


def _either(engine: Real, of_engine: Real, of_body: Real) -> tuple[Real, Real]:
    """Return what the pair's body has, which may be the engine, and what the other one has."""
    return np.where(engine, of_engine, of_body), np.where(engine, of_body, of_engine)


def _in_order(engine: Real, of_pair: Real, of_other: Real, of_pier: Real) -> Real:
    """Return what belongs to δ1, δ2 and x_p, shape (3, n)."""
    return np.stack([*_either(engine, of_pair, of_other), of_pier])


def _fast_mode(b: Real, c: Real, g: Real, p: Real) -> tuple[Real, Real, Real]:
    """Return λ and φ of the fast mode, and the derivative by λ of what is zero there."""
    rate = 1j * np.sqrt(b + p - 0.25 * c * c) - 0.5 * c
    for _ in range(REFINED):
        share = g / (g + rate * rate)
        by_rate = 2.0 * rate * (1.0 + p / g * share * share) + c
        rate = rate - (rate * (rate + c) + b + p * (1.0 - share)) / by_rate
    return rate, share, by_rate


def _slow_mode(b: Real, c: Real, g: Real, p: Real) -> tuple[Real, Real, Real]:
    """Return λ and ψ of the slow mode, and the derivative by λ of what is zero there."""
    rate = 1j * np.sqrt(g * b / (b + p))
    for _ in range(REFINED):
        held = rate * (rate + c) + b
        share = p / (held + p)
        by_rate = 2.0 * rate + g / p * share * share * (2.0 * rate + c)
        rate = rate - (rate * rate + g * held / (held + p)) / by_rate
    return rate, share, by_rate


class Quantity(NamedTuple):
    """A quantity of the motion: level + rate t + ½ second t² + the modes."""

    level: Real
    rate: Real
    second: Real
    slow: Real  # complex amplitude
    bulge: Real  # what the slow part can rise above its chord between two nodes
    reach: Real  # of the fast mode, whatever its phase

    def at(self, t: Real, phase: Real) -> Real:
        """Return the slow part where its mode has a phase e^{λt}."""
        return self.level + t * (self.rate + 0.5 * t * self.second) + (self.slow * phase).real


def quantity(function: EventFunction, pair: PairMotion, spacing: Real) -> Quantity:
    """Return a function of the motion, between nodes so far apart [s]."""
    _, order, parts, level = function

    def total(of_each: Real) -> Real:
        return sum(weight * of_each[which] for weight, which in parts)

    slow, fast = (total(mode.amplitudes) * mode.rate**order for mode in (pair.slow, pair.fast))
    polynomial = [total(each) for each in (pair.base, pair.rate, pair.second)][order:]
    constant, rate, second = polynomial + [0.0 * spacing] * order
    bends = abs(slow) * abs(pair.slow.rate) ** 2 + abs(second)
    bulge = 0.5 * (0.5 * spacing) ** 2 * bends
    return Quantity(level + constant, rate, second, slow, bulge, abs(fast))


def nodes_ahead(
    parameters: Parameters, state: State, motion: LinearMotion, pair: PairMotion, spacing: Real
) -> Real:
    """Return how many nodes there are ahead up to which no regime ends and no peak is lost."""
    nothing, yielding = 0.0 * spacing, state.yielding
    functions, top = event_functions(parameters, state, motion, ARRAYS), state.peak(ARRAYS)
    if yielding is not None:
        top = np.minimum(top, yielding.largest - yielding.displacement)
        lowest = -yielding.displacement - yielding.largest
        functions.append(EventFunction(PASSES, 0, ((nothing - 1.0, PIER),), lowest))
    *bounds, pier = [
        quantity(function, pair, spacing)
        for function in (*functions, EventFunction(PASSES, 0, ((nothing + 1.0, PIER),), nothing))
    ]
    turn, decay = np.exp(pair.slow.rate * spacing), np.exp(pair.fast.rate.real * spacing)
    phase, t, left = nothing + 1.0 + 0.0j, nothing, nothing + 1.0
    ahead, goes_on = nothing - 1.0, nothing == 0.0
    heights, reached = [], nothing - math.inf
    for node in range(NODES + 1):
        for each in bounds:
            goes_on = goes_on & (each.at(t, phase) + each.bulge + each.reach * left <= 0.0)
        if not goes_on.any():
            break
        ahead = np.where(goes_on, node, ahead)
        height, reach = pier.at(t, phase), pier.reach * left
        reached = np.where(goes_on & (height - reach > reached), height - reach, reached)
        heights.append(height + pier.bulge + reach)
        phase, t = phase * turn, t + spacing
        left = left * decay if node else left  # before a node is what the one before it has left
    # What the pier comes to later may be passed over before.
    known = np.maximum(top, reached)
    passed, goes_on = nothing - 1.0, nothing == 0.0
    for node, height in enumerate(heights):
        goes_on = goes_on & (height <= known) & (ahead >= node)
        passed = np.where(goes_on, node, passed)
    return passed


def pass_cycles(parameters: Parameters, state: State, motion: LinearMotion) -> State:
    """Return the states of pairs after as many cycles as can safely be passed over, or none."""
    pair, ordinary = pair_motion(motion, state.position), longest_step(motion, ARRAYS)
    spacing = np.maximum(ordinary, SPAN / NODES / abs(pair.slow.rate))
    h = spacing * nodes_ahead(parameters, state, motion, pair, spacing)
    worthwhile = h > WORTHWHILE * ordinary
    if not worthwhile.any():
        return state
    h = np.where(worthwhile, h, 0.0)
    end = Position(*map(np.where, [worthwhile] * 6, pair.after(h), state.position))
    state = state._replace(time=state.time + h, position=end)
    return raise_peak(state, end.xp, state.time, worthwhile, ARRAYS)
