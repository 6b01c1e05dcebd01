"""The closed formulas behind the design procedure, each one equation with its symbols.

All are derived here: the source paper's own are not in its surviving text. Numbers are floats
or arrays of one shape.
"""

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np

Real: TypeAlias = Any  # a float, or an array

# The coefficients of the closed spectrum, fitted by `pierimpact.study`, and of the two rules for
# the cargo, chosen on its cases.
HUMP = 1.44
HUMP_END = 3.08
HUMP_DECLINE = 3.1
MASS_EFFECT = 1.42
DAMPING_EFFECT = 5.2
RINGING_SHARE = 0.6
RINGING_BETA = 2.0
LATE_SHARE = 0.8


class Motion(NamedTuple):
    """A displacement [m] and a velocity [m/s]."""

    x: Real
    v: Real


def amplification(
    beta: Real,
    mu: Real,
    e: Real,
    zeta: Real,
    hump: float = HUMP,
    end: float = HUMP_END,
    decline: float = HUMP_DECLINE,
    mass_effect: float = MASS_EFFECT,
    damping_effect: float = DAMPING_EFFECT,
) -> Real:
    """Return the amplification S of the unified spectrum, in closed form [-].

    1/S² = 1/[(1 + e) β]² + (1 + μ/β²)/Q², with the hump
    Q = 1 + 1.44 e^(−5.2 ζ) / {[1 + (β/3.08)^3.1] (1 + 1.42 μ/β)}.

    It meets exactly: S → (1 + e) β for a soft heavy pier (impulse), S → 1 for a stiff heavy one,
    S → 1/√(1 + k_i/k_p) for a massless one, as k_i/k_p = μ/β².
    """
    hump = hump * np.exp(-damping_effect * zeta)
    hump = hump / ((1.0 + (beta / end) ** decline) * (1.0 + mass_effect * mu / beta))
    impulsive, static = 1.0 / ((1.0 + e) * beta), np.sqrt(1.0 + mu / beta**2) / (1.0 + hump)
    return 1.0 / np.hypot(impulsive, static)


def swing(start: Motion, omega: Real, zeta: Real, t: Real) -> Motion:
    """Return the free swing of the pier about its rest, `t` after it had the motion `start`."""
    omega_d = omega * np.sqrt(1.0 - zeta**2)
    decay, s, c = np.exp(-zeta * omega * t), np.sin(omega_d * t), np.cos(omega_d * t)
    return Motion(
        decay * (start.x * c + (start.v + zeta * omega * start.x) / omega_d * s),
        decay * (start.v * c - (omega**2 * start.x + zeta * omega * start.v) / omega_d * s),
    )


def closing_time(speed: Real, deceleration: Real, length: Real) -> Real:
    """Return the time 2 d/(V + v) in which a body slowed from V to v = √(V² − 2 a d) covers d [s].

    Where it stops short of d, the time 2 d/V of the body that would just reach it.
    """
    left = np.sqrt(np.maximum(speed**2 - 2.0 * deceleration * length, 0.0))
    return 2.0 * length / (speed + left)


class Pulse(NamedTuple):
    """The engine's blow: impulse [N s], time of its centroid after contact [s], spread [s]."""

    impulse: Real
    centroid: Real
    spread: Real


def engine_pulse(mass: Real, stiffness: Real, e: Real, pier_mass: Real, speed: Real) -> Pulse:
    """Return the blow of a mass on a free pier.

    A quarter sine up, and down a quarter cosine that is e as long.

    With the reduced mass m_r = m/(1 + m/m_p) and ω_r = √(k/m_r) its impulse is
    (1 + e) m_r v, and centroid and spread are the first two moments of its area over time.
    """
    reduced = mass / (1.0 + mass / pier_mass)
    omega = np.sqrt(stiffness / reduced)
    half = 0.5 * math.pi
    # Areas, first and second moments of the two quarters over ω t, the second shifted to π/2.
    area = 1.0 + e
    first = 1.0 + e * half + e**2 * (half - 1.0)
    second = 2.0 * (half - 1.0) + e * half**2 + 2.0 * half * e**2 * (half - 1.0)
    second = second + e**3 * (half**2 - 2.0)
    centroid = first / area
    return Pulse(
        (1.0 + e) * reduced * speed,
        centroid / omega,
        np.sqrt(second / area - centroid**2) / omega,
    )


class Mode(NamedTuple):
    """A damped mode: value e^(−σt) (cosine cos ωt + sine sin ωt), and the body's part of it."""

    omega: Real
    sigma: Real
    cosine: Real
    sine: Real
    body: Real  # motion of the body over that of the pier

    def at(self, t: Real) -> Real:
        """Value after a time `t`."""
        turn = self.omega * t
        return np.exp(-self.sigma * t) * (self.cosine * np.cos(turn) + self.sine * np.sin(turn))

    def times(self, factor: Real) -> "Mode":
        """Return the mode with its value multiplied by `factor`."""
        return self._replace(cosine=factor * self.cosine, sine=factor * self.sine)


def contact_modes(
    mass: Real,
    stiffness: Real,
    pier_mass: Real,
    pier_stiffness: Real,
    pier_damping: Real,
    pier: Motion,
    body: Motion,
) -> tuple[Mode, Mode]:
    """Return the slow and the fast mode of pier and body joined by the steep spring.

    λ² − λ [(1 + μ) ω_i² + ω_p²] + ω_i² ω_p² = 0 gives ω² = λ; the body moves ω_i²/(ω_i² − λ) as
    far as the pier. The damper's effect on a mode is kept, the coupling it makes between the two
    is not.

    Parameters
    ----------
    mass, stiffness : array_like
        Body m_i [kg] and steep spring k_i [N/m].
    pier_mass, pier_stiffness, pier_damping : array_like
        Pier [kg], [N/m], [N s/m].
    pier, body : Motion
        Motions at contact, from the position of rest of the joined system.
    """
    own, square = stiffness / mass, pier_stiffness / pier_mass
    total = own * (1.0 + mass / pier_mass) + square
    root = np.sqrt(total**2 - 4.0 * own * square)
    modes = []
    for eigenvalue in (2.0 * own * square / (total + root), 0.5 * (total + root)):
        ratio = own / (own - eigenvalue)
        modal_mass = pier_mass + mass * ratio**2
        omega = np.sqrt(eigenvalue)
        sigma = 0.5 * pier_damping / modal_mass
        displacement = (pier_mass * pier.x + mass * ratio * body.x) / modal_mass
        velocity = (pier_mass * pier.v + mass * ratio * body.v) / modal_mass
        sine = (velocity + sigma * displacement) / omega
        modes.append(Mode(omega, sigma, displacement, sine, ratio))
    slow, fast = modes
    return slow, fast


def crests(slow: Mode, fast: Mode) -> tuple[Real, Real]:
    """Return when the sum of both modes crests, before and after the slow mode does [s].

    Near its crest each mode is a parabola of curvature amplitude times ω², so that the sum has
    its crest at the mean of both crests weighted by the curvatures.
    """
    t_slow = _phase(slow) / slow.omega
    weight_slow = np.hypot(slow.cosine, slow.sine) * slow.omega**2
    weight_fast = (
        np.hypot(fast.cosine, fast.sine)
        * fast.omega**2
        * np.exp(-(fast.sigma - slow.sigma) * t_slow)
    )
    share = weight_fast / (weight_fast + weight_slow)
    turns = np.floor((t_slow * fast.omega - _phase(fast)) / (2.0 * math.pi))
    early = (_phase(fast) + 2.0 * math.pi * turns) / fast.omega
    late = early + 2.0 * math.pi / fast.omega
    return (
        np.maximum(t_slow + share * (early - t_slow), 0.0),
        t_slow + share * (late - t_slow),
    )


def _phase(mode: Mode) -> Real:
    """Return the angle ω t of a mode's first crest, from 0 to 2π [rad]."""
    angle = np.arctan2(mode.sine, mode.cosine) - np.arctan2(mode.sigma, mode.omega)
    return np.mod(angle, 2.0 * math.pi)
