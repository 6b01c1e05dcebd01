"""The closed formulas behind the design procedure, each one equation with its symbols.

All are derived here: the source paper's own are not in its surviving text. Numbers are floats
or arrays of one shape.
"""

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np

Real: TypeAlias = Any  # a float, or an array

# The coefficients of the closed spectrum, fitted by `study`, and of the two rules for
# the cargo, chosen on its cases.
HUMP = 1.45
HUMP_END = 3.1
HUMP_DECLINE = 3.1
MASS_EFFECT = 1.4
DAMPING_EFFECT = 5.3
RINGING_SHARE = 0.6
RINGING_BETA = 2.0


class Motion(NamedTuple):
    """A displacement [m] and a velocity [m/s]."""

    x: Real
    v: Real


def hump(
    beta: Real,
    mu: Real,
    zeta: Real,
    height: float = HUMP,
    end: float = HUMP_END,
    decline: float = HUMP_DECLINE,
    mass_effect: float = MASS_EFFECT,
    damping_effect: float = DAMPING_EFFECT,
) -> Real:
    """Return what the motion of the pier adds to the static part of the unified spectrum [-].

    h = 1.45 e^(−5.3 ζ) / {[1 + (β/3.1)^3.1] (1 + 1.4 μ/β)}.
    """
    decays = (1.0 + (beta / end) ** decline) * (1.0 + mass_effect * mu / beta)
    return height * np.exp(-damping_effect * zeta) / decays


def joined(beta: Real, mu: Real, e: Real, h: Real) -> Real:
    """Return the amplification S: its impulsive and its static part, joined [-].

    1/S² = 1/[(1 + e) β]² + (1 + μ/β²)/(1 + h)².
    """
    impulsive, static = 1.0 / ((1.0 + e) * beta), np.sqrt(1.0 + mu / beta**2) / (1.0 + h)
    return 1.0 / np.hypot(impulsive, static)


def amplification(beta: Real, mu: Real, e: Real, zeta: Real) -> Real:
    """Return the amplification S of the unified spectrum, in closed form [-].

    It meets exactly: S → (1 + e) β for a soft heavy pier (impulse), S → 1 for a stiff heavy one,
    S → 1/√(1 + k_i/k_p) for a massless one, as k_i/k_p = μ/β².
    """
    return joined(beta, mu, e, hump(beta, mu, zeta))


def swing(start: Motion, omega: Real, zeta: Real, t: Real) -> Motion:
    """Return the free swing of the pier about its rest, `t` after it had the motion `start`."""
    omega_d = omega * np.sqrt(1.0 - zeta**2)
    decay, s, c = np.exp(-zeta * omega * t), np.sin(omega_d * t), np.cos(omega_d * t)
    return Motion(
        decay * (start.x * c + (start.v + zeta * omega * start.x) / omega_d * s),
        decay * (start.v * c - (omega**2 * start.x + zeta * omega * start.v) / omega_d * s),
    )


def approach_speed(speed: Real, deceleration: Real, length: Real) -> Real:
    """Return the speed v = √(V² − 2 a d) left after a body was slowed over a length d [m/s].

    From the energy balance. Zero where the body stops before.
    """
    return np.sqrt(np.maximum(speed**2 - 2.0 * deceleration * length, 0.0))


def closing_time(speed: Real, deceleration: Real, length: Real) -> Real:
    """Return the time 2 d/(V + v) in which a body slowed from V to v covers d [s].

    Where it stops short of d, the time 2 d/V of the body that would just reach it.
    """
    return 2.0 * length / (speed + approach_speed(speed, deceleration, length))


class Pulse(NamedTuple):
    """The engine's blow on a free pier, and the oscillator it follows from.

    Reduced mass [kg], its circular frequency on the spring [rad/s], impulse [N s], time of the
    centroid after contact [s] and spread about it [s].
    """

    mass: Real
    omega: Real
    impulse: Real
    centroid: Real
    spread: Real


def engine_pulse(mass: Real, stiffness: Real, e: Real, pier_mass: Real, speed: Real) -> Pulse:
    """Return the blow of a mass on a free pier: a quarter sine up, and down a quarter cosine.

    Up it lasts π/2 ω_r, with the reduced mass m_r = m/(1 + m/m_p) and ω_r = √(k/m_r), down e
    times as long. Its impulse is (1 + e) m_r v; centroid and spread are the mean and the
    standard deviation of time, weighted by the force.
    """
    reduced = mass / (1.0 + mass / pier_mass)
    omega = np.sqrt(stiffness / reduced)
    half = 0.5 * math.pi
    # Areas, first and second moments of the two quarters over ω_r t, those of the second about
    # its own start shifted by π/2.
    area = 1.0 + e
    first = 1.0 + e * half + e**2 * (half - 1.0)
    second = 2.0 * (half - 1.0) + e * half**2 + 2.0 * half * e**2 * (half - 1.0)
    second = second + e**3 * (half**2 - 2.0)
    mean = first / area
    return Pulse(
        mass=reduced,
        omega=omega,
        impulse=(1.0 + e) * reduced * speed,
        centroid=mean / omega,
        spread=np.sqrt(second / area - mean**2) / omega,
    )


class Mode(NamedTuple):
    """A damped mode of the pier's displacement, e^(−σt) (a cos ωt + b sin ωt)."""

    omega: Real
    body: Real  # motion of the body over that of the pier
    sigma: Real
    cosine: Real
    sine: Real
    amplitude: Real
    phase: Real
    crest: Real  # angle ωt of the first crest, from 0 to 2π [rad]

    def at(self, t: Real) -> Real:
        """Return the displacement A e^(−σt) cos(ωt − φ) at a time `t`."""
        return self.amplitude * np.exp(-self.sigma * t) * np.cos(self.omega * t - self.phase)


class ContactModes(NamedTuple):
    """The two modes of pier and body on the steep spring, and what their shapes follow from."""

    gamma: Real
    root: Real
    slow: Mode
    fast: Mode


def contact_modes(
    beta: Real, mu: Real, omega: Real, zeta: Real, pier: Motion, body: Motion
) -> ContactModes:
    """Return the motion of pier and body joined by the steep spring, as two modes.

    With γ = (β² + μ − 1)/2 and λ = √(γ² + μ) the body moves ψ_s = (λ + γ)/μ times as far as the
    pier in the slow mode and ψ_f = −1/(λ + γ) times in the fast one, at ω_f = ω_i √(1 + γ + λ)
    and ω_s = ω_p ω_i/ω_f. The damper's effect on a mode is kept, the coupling it makes between
    the two is not.

    Parameters
    ----------
    beta, mu : array_like
        Frequency ratio ω_p/ω_i and mass ratio m_i/m_p of the body on its steep spring [-].
    omega, zeta : array_like
        Circular frequency [rad/s] and damping ratio [-] of the pier.
    pier, body : Motion
        Motions at contact, from the position of rest of the joined system.
    """
    own = omega / beta
    gamma = 0.5 * (beta**2 + mu - 1.0)
    root = np.sqrt(gamma**2 + mu)
    # As λ² − γ² = μ, λ + γ can be had without cancellation whatever the sign of γ.
    total = np.where(gamma > 0.0, root + gamma, mu / (root + np.abs(gamma)))
    fast_omega = own * np.sqrt(1.0 + gamma + root)
    modes = []
    for mode_omega, ratio in ((omega * own / fast_omega, total / mu), (fast_omega, -1.0 / total)):
        share = 1.0 / (1.0 + mu * ratio**2)  # m_p over the modal mass
        sigma = zeta * omega * share
        cosine = share * (pier.x + mu * ratio * body.x)
        sine = (share * (pier.v + mu * ratio * body.v) + sigma * cosine) / mode_omega
        amplitude, phase = np.hypot(cosine, sine), np.arctan2(sine, cosine)
        crest = np.mod(phase - np.arctan(sigma / mode_omega), 2.0 * math.pi)
        modes.append(Mode(mode_omega, ratio, sigma, cosine, sine, amplitude, phase, crest))
    return ContactModes(gamma, root, *modes)


class Crests(NamedTuple):
    """When two modes and their sum crest [s]: the slow mode, the sum before it and after it.

    `share` is the weight of the fast mode, `turns` the number of its whole turns before.
    """

    slow: Real
    share: Real
    turns: Real
    early: Real
    late: Real


def crests(slow: Mode, fast: Mode) -> Crests:
    """Return when the sum of two modes crests, before and after the slow one does.

    Near its crest each mode is a parabola of curvature A ω², so that the sum has its crest at
    the mean of both crests weighted by the curvatures; the fast mode has a crest before and one
    after the slow mode's.
    """
    t = slow.crest / slow.omega
    weight = fast.amplitude * fast.omega**2 * np.exp((slow.sigma - fast.sigma) * t)
    share = weight / (weight + slow.amplitude * slow.omega**2)
    turn = 2.0 * math.pi
    turns = np.floor((fast.omega * t - fast.crest) / turn)
    before = (fast.crest + turn * turns) / fast.omega
    early, late = t + share * (before - t), t + share * (before + turn / fast.omega - t)
    return Crests(t, share, turns, np.maximum(early, 0.0), late)
