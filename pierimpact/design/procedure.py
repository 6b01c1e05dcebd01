"""The design procedure, every equation once, in the order of a collision.

The plateau forces push the pier aside; the engine strikes it and leaves it vibrating; the cargo
strikes it meanwhile. Two levels, both in closed form. The short one is the method to follow: it
fits on a page and needs a calculator. The long one is for who wants to see why: it keeps the
phase of the vibration, and lets the pier's own motion correct times and speeds of contact. All is
derived here: the source paper's own formulas are not in its surviving text. What each symbol
stands for is in `pierimpact.symbols`, how the lines are printed in `pierimpact.handcalc`.
"""

from collections.abc import Callable
from math import pi
from typing import TypeAlias

import numpy as np
from numpy import (
    abs,
    arctan,
    arctan2,
    cos,
    exp,
    floor,
    hypot,
    maximum,
    minimum,
    mod,
    nan,
    sin,
    sqrt,
    where,
)

from pierimpact.checks import one_of
from pierimpact.collision.parameters import Parameters
from pierimpact.handcalc import Calculation, Real
from pierimpact.pier.equivalent import damping_coefficient

Values: TypeAlias = dict[str, Real]

# The coefficients of the unified spectrum, fitted by `study`, and of the rule for the vibration
# that is left when the cargo arrives, chosen on its cases.
RESONANCE = 1.45
RESONANCE_END = 3.1
RESONANCE_DECLINE = 3.1
MASS_EFFECT = 1.4
DAMPING_EFFECT = 5.3
VIBRATION_SHARE = 0.6
VIBRATION_BETA = 2.0


# The motion of a body that a constant force slows down


def contact_speed(V: Real, a: Real, d: Real) -> Real:
    """Return the speed left after a length d; zero where the body stops before [m/s]."""
    return sqrt(maximum(V**2 - 2 * a * d, 0))


def contact_time(V, a, d):
    """Return the time to cover d; where it stops before, of a body that just reaches it [s]."""
    return 2 * d / (V + contact_speed(V, a, d))


# The motion of the pier


def step_x(F, k, omega, omega_d, zeta, t):
    """Return the displacement under a force that acts suddenly from t = 0 on [m]."""
    return F / k * (
        1 - exp(-zeta * omega * t) * (cos(omega_d * t) + zeta * omega / omega_d * sin(omega_d * t))
    )  # fmt: skip


def step_v(F, m, omega, omega_d, zeta, t):
    """Return the velocity of the same [m/s]."""
    return F / (m * omega_d) * exp(-zeta * omega * t) * sin(omega_d * t)


def free_x(x, v, omega, omega_d, zeta, t):
    """Return the displacement of a free damped vibration, t after it was x with velocity v [m]."""
    return exp(-zeta * omega * t) * (
        x * cos(omega_d * t) + (v + zeta * omega * x) / omega_d * sin(omega_d * t)
    )


def free_v(x, v, omega, omega_d, zeta, t):
    """Return the velocity of the same [m/s]."""
    return exp(-zeta * omega * t) * (
        v * cos(omega_d * t) - (omega**2 * x + zeta * omega * v) / omega_d * sin(omega_d * t)
    )


# The unified spectrum


def resonance(
    beta: Real,
    mu: Real,
    zeta: Real,
    height: float = RESONANCE,
    end: float = RESONANCE_END,
    decline: float = RESONANCE_DECLINE,
    mass_effect: float = MASS_EFFECT,
    damping_effect: float = DAMPING_EFFECT,
) -> Real:
    """Return what the motion of the pier adds to the static part of the unified spectrum [-]."""
    return height * exp(-damping_effect * zeta) / (
        (1 + (beta / end) ** decline) * (1 + mass_effect * mu / beta)
    )  # fmt: skip


def combined(beta: Real, mu: Real, e: Real, h: Real) -> Real:
    """Return the amplification S: its impulsive and its static part, combined [-]."""
    return 1 / sqrt(1 / ((1 + e) * beta) ** 2 + (1 + mu / beta**2) / (1 + h) ** 2)


def unified_spectrum(beta: Real, mu: Real, e: Real, zeta: Real) -> tuple[Real, Real]:
    """Return resonance term h and amplification S [-]."""
    h = resonance(beta, mu, zeta)  # coefficients fitted to the full model
    S = combined(beta, mu, e, h)
    return h, S


def amplification(beta: Real, mu: Real, e: Real, zeta: Real) -> Real:
    """Return the amplification S of the unified spectrum, in closed form [-].

    It meets exactly: S → (1 + e) β for a soft heavy pier (impulse), S → 1 for a stiff heavy one,
    S → 1/√(1 + k_i/k_p) for a massless one, as k_i/k_p = μ/β².
    """
    return unified_spectrum(beta, mu, e, zeta)[1]


# What both levels have in common


def ratios(omega, mp, m, k, ku):
    """Return frequency ratio, mass ratio and restitution of a body on its steep spring [-]."""
    beta = omega / sqrt(k / m)
    mu = m / mp
    e = sqrt(k / ku)
    return beta, mu, e


def plateau(m1, P1, m2, P2, cs, mp, kp, zeta, on_pier):
    """Return what the pier is, and how the plateau forces push it and slow the truck."""
    omega = sqrt(kp / mp)
    omega_d = omega * sqrt(1 - zeta**2)
    Q = where(on_pier, P2 + cs, P2)
    Fpl = P1 + Q
    Rpl = Fpl * (1 + exp(-pi * zeta * omega / omega_d))  # step force
    a1 = P1 / m1
    Fb = P2 + cs
    a2 = Fb / m2
    return omega, omega_d, Q, Fpl, Rpl, a1, Fb, a2


def engine_impact(m1, k1, kp, omega, omega_d, Q, Rpl, t1, x1, dx1, v1, S1):
    """Return the free vibration that the engine's impact leaves, and the engine's reaction."""
    u1 = maximum(v1 - dx1, 0)
    Rv1 = hypot(kp * x1 - Q, kp * dx1 / omega + S1 * u1 * sqrt(k1 * m1))
    R0 = where(omega_d * t1 >= pi, Rpl, 0)
    R1 = where(v1 > 0, maximum(Q + Rv1, R0), Rpl)
    return u1, Rv1, R0, R1


# The short level


@Calculation
def short(
    V, m1, P1, d1, k1, ku1, m2, P2, d2,
    k2, ku2, cs, mp, kp, zeta, on_pier,
    spectrum=unified_spectrum,
):  # fmt: skip
    """The pier stands still until it is struck; of its vibration, a share is added."""
    omega, omega_d, Q, Fpl, Rpl, a1, Fb, a2 = plateau(m1, P1, m2, P2, cs, mp, kp, zeta, on_pier)
    # Engine
    t1 = contact_time(V, a1, d1)
    x1 = step_x(Fpl, kp, omega, omega_d, zeta, t1)
    dx1 = step_v(Fpl, mp, omega, omega_d, zeta, t1)
    v1 = contact_speed(V, a1, d1)
    beta1, mu1, e1 = ratios(omega, mp, m1, k1, ku1)
    h1, S1 = spectrum(beta1, mu1, e1, zeta)
    u1, Rv1, R0, R1 = engine_impact(m1, k1, kp, omega, omega_d, Q, Rpl, t1, x1, dx1, v1, S1)
    # Cargo
    t2 = contact_time(V, a2, d2)
    v2 = contact_speed(V, a2, d2)
    beta2, mu2, e2 = ratios(omega, mp, m2, k2, ku2)
    h2, S2 = spectrum(beta2, mu2, e2, zeta)
    F2 = sqrt(Fb**2 + k2 * m2 * v2**2) - Fb
    Rv2 = where(v1 > 0, Rv1 * exp(-zeta * omega * (t2 - t1)), Fpl * exp(-zeta * omega * t2))
    eta = VIBRATION_SHARE / (1 + (VIBRATION_BETA / beta2) ** 2)  # chosen on the study's cases
    R2 = where(v2 > 0, Q + S2 * F2 + eta * Rv2, nan)
    return locals()


# The long level


def pier_x(t, tJ, xJ, dxJ, Q, Fpl, kp, omega, omega_d, zeta):
    """Return the displacement of the pier before cargo contact [m]."""
    return where(
        t > tJ,
        Q / kp + free_x(xJ, dxJ, omega, omega_d, zeta, t - tJ),
        step_x(Fpl, kp, omega, omega_d, zeta, t),
    )


def centroid(e):
    """Return the mean time of an impact weighted by its force, over ω_r t [-].

    The force rises in a quarter of a sine and falls in a quarter of a cosine, e times as long.
    """
    return (1 + pi / 2 * e + (pi / 2 - 1) * e**2) / (1 + e)


def second_moment(e):
    """Return the mean square of the time of the same [-]."""
    return (
        pi - 2 + pi**2 / 4 * e + pi * (pi / 2 - 1) * e**2 + (pi**2 / 4 - 2) * e**3
    ) / (1 + e)  # fmt: skip


def frequencies(beta2, mu2, omega):
    """Return circular frequencies of the two modes of pier and cargo in contact, and their shapes.

    A shape is the displacement of the body over the pier's.
    """
    gamma = (beta2**2 + mu2 - 1) / 2
    lam = sqrt(gamma**2 + mu2)
    Lam = where(gamma > 0, lam + gamma, mu2 / (lam + abs(gamma)))  # written to avoid cancellation
    omega_s = omega / sqrt(1 + gamma + lam)
    psi_s = Lam / mu2
    omega_f = omega / beta2 * sqrt(1 + gamma + lam)
    psi_f = -1 / Lam
    return gamma, lam, Lam, omega_s, psi_s, omega_f, psi_f


def mode(omega_i, psi, mu2, omega, zeta, x2, dx2, v2, x0, Fb, k2):
    """Return one of the two modes of pier and cargo in contact, from their motion at contact.

    Its decay rate, cosine and sine part, amplitude, phase and angle of the first maximum. The
    damper's effect on a mode is kept, the coupling that it makes between the two is not.
    """
    sigma = zeta * omega / (1 + mu2 * psi**2)
    a = (x2 - x0 + mu2 * psi * (x2 - x0 + Fb / k2)) / (1 + mu2 * psi**2)
    b = 1 / omega_i * ((dx2 + mu2 * psi * v2) / (1 + mu2 * psi**2) + sigma * a)
    X = hypot(a, b)
    phi = arctan2(b, a)
    theta = mod(phi - arctan(sigma / omega_i), 2 * pi)
    return sigma, a, b, X, phi, theta


def both_modes(t, x0, X_s, sigma_s, omega_s, phi_s, X_f, sigma_f, omega_f, phi_f):
    """Return the displacement of the pier in contact with the cargo, t after contact [m]."""
    return x0 + of_mode(t, X_s, sigma_s, omega_s, phi_s) + of_mode(t, X_f, sigma_f, omega_f, phi_f)


def of_mode(t, X, sigma, omega, phi):
    """Return the displacement of one mode [m]."""
    return X * exp(-sigma * t) * cos(omega * t - phi)


def curvature(X, omega):
    """Return the curvature of a mode at its maximum [m/s²]."""
    return X * omega**2


def fast_maximum(n, theta_f, omega_f):
    """Return the time of the fast mode's maximum after n periods [s]."""
    return (theta_f + 2 * pi * n) / omega_f


def maxima(X_s, sigma_s, omega_s, theta_s, X_f, sigma_f, omega_f, theta_f):
    """Return when both modes together are largest, before and after the slow one is.

    Near its maximum each mode is a parabola, so that the sum has its maximum at the mean of both
    maxima, weighted by the curvatures; the fast mode has one before and one after the slow mode's.
    """
    tu = theta_s / omega_s
    w = 1 / (
        1 + curvature(X_s, omega_s) / (curvature(X_f, omega_f) * exp((sigma_s - sigma_f) * tu))
    )
    n = floor((omega_f * tu - theta_f) / (2 * pi))
    ta = maximum(tu + w * (fast_maximum(n, theta_f, omega_f) - tu), 0)
    tb = tu + w * (fast_maximum(n + 1, theta_f, omega_f) - tu)
    return tu, w, n, ta, tb


@Calculation
def long(
    V, m1, P1, d1, k1, ku1, m2, P2, d2,
    k2, ku2, cs, mp, kp, zeta, on_pier,
    spectrum=unified_spectrum,
):  # fmt: skip
    """The pier's own motion corrects times and speeds of contact; its vibration keeps its phase."""
    omega, omega_d, Q, Fpl, Rpl, a1, Fb, a2 = plateau(m1, P1, m2, P2, cs, mp, kp, zeta, on_pier)
    # Engine
    t1_0 = contact_time(V, a1, d1)
    x1_0 = step_x(Fpl, kp, omega, omega_d, zeta, t1_0)
    t1 = contact_time(V, a1, d1 + x1_0)
    x1 = step_x(Fpl, kp, omega, omega_d, zeta, t1)
    dx1 = step_v(Fpl, mp, omega, omega_d, zeta, t1)
    v1 = contact_speed(V, a1, d1 + x1)
    beta1, mu1, e1 = ratios(omega, mp, m1, k1, ku1)
    h1, S1 = spectrum(beta1, mu1, e1, zeta)
    u1, Rv1, R0, R1_0 = engine_impact(m1, k1, kp, omega, omega_d, Q, Rpl, t1, x1, dx1, v1, S1)
    # Free vibration: the impact acts on the pier as if at one instant, its centroid; a slow one
    # excites a fast pier less. Without contact the engine stops on its plateau, and pushes no more.
    mr = m1 / (1 + m1 / mp)
    omega_r = sqrt(k1 / mr)
    tbar = 1 / omega_r * centroid(e1)  # quarter sine up, quarter cosine down, e times as long
    sigma_J = sqrt(1 / omega_r**2 * second_moment(e1) - tbar**2)  # of the same pulse
    J = where(v1 > 0, (1 + e1) * mr * u1 * exp(-(omega**2) * sigma_J**2 / 2), 0)
    tJ = where(v1 > 0, t1 + tbar, V / a1)
    xJ = step_x(Fpl, kp, omega, omega_d, zeta, tJ) - Q / kp
    dxJ = step_v(Fpl, mp, omega, omega_d, zeta, tJ) + J / mp
    # Arrival of the cargo
    t2_0 = contact_time(V, a2, d2)
    x2_0 = pier_x(t2_0, tJ, xJ, dxJ, Q, Fpl, kp, omega, omega_d, zeta)
    t2 = contact_time(V, a2, d2 + x2_0)
    x2 = pier_x(t2, tJ, xJ, dxJ, Q, Fpl, kp, omega, omega_d, zeta)
    dx2 = where(
        t2 > tJ,
        free_v(xJ, dxJ, omega, omega_d, zeta, t2 - tJ),
        step_v(Fpl, mp, omega, omega_d, zeta, t2),
    )
    v2 = contact_speed(V, a2, d2 + x2)
    tc = tJ + arctan2(dxJ * omega_d, omega**2 * xJ + zeta * omega * dxJ) / omega_d
    R1 = where(
        (v1 > 0) & (v2 > 0) & (t2 < tc), minimum(maximum(kp * x2, R0), R1_0), R1_0
    )  # fmt: skip
    # Cargo: the two modes of body and pier
    beta2, mu2, e2 = ratios(omega, mp, m2, k2, ku2)
    x0 = (Q - Fb) / kp
    gamma, lam, Lam, omega_s, psi_s, omega_f, psi_f = frequencies(beta2, mu2, omega)
    sigma_s, a_s, b_s, X_s, phi_s, theta_s = mode(
        omega_s, psi_s, mu2, omega, zeta, x2, dx2, v2, x0, Fb, k2
    )
    sigma_f, a_f, b_f, X_f, phi_f, theta_f = mode(
        omega_f, psi_f, mu2, omega, zeta, x2, dx2, v2, x0, Fb, k2
    )
    tu, w, n, ta, tb = maxima(X_s, sigma_s, omega_s, theta_s, X_f, sigma_f, omega_f, theta_f)
    xu = both_modes(tu, x0, X_s, sigma_s, omega_s, phi_s, X_f, sigma_f, omega_f, phi_f)
    xa = both_modes(ta, x0, X_s, sigma_s, omega_s, phi_s, X_f, sigma_f, omega_f, phi_f)
    # As the slow mode is largest the spring turns to unloading on k_u. The modes would push the
    # pier as much again from there on; the spring does only e times as much.
    xb = xu + (1 + e2) / 2 * (
        both_modes(tb, x0, X_s, sigma_s, omega_s, phi_s, X_f, sigma_f, omega_f, phi_f) - xu
    )
    R2 = where(v2 > 0, kp * maximum(maximum(x2, xa), xb), nan)
    return locals()


LEVELS = {"short": short, "long": long}
#: Names by which the levels were known before, which scripts of others have.
ALIASES = {"hand": "short", "refined": "long"}


def design_values(
    parameters: Parameters,
    level: str = "short",
    spectrum: Callable[[Real, Real, Real, Real], Real] | None = None,
) -> Values:
    """Return every value of the procedure by the name of its symbol.

    Parameters
    ----------
    parameters : Parameters
        Floats, or arrays of one shape.
    level : {"short", "long"}, optional
        Level of the procedure; "hand" and "refined" are other names of the two.
    spectrum : callable, optional
        Amplification S of β, μ, e and ζ to use in place of the closed form.

    Returns
    -------
    dict
        Values in SI, each a float or an array. Where a body does not meet the pier, the values
        of its contact mean nothing; R2 is nan.
    """
    given = by_symbol(parameters)
    if spectrum is not None:
        given["spectrum"] = lambda *arguments: (nan, spectrum(*arguments))
    # Both sides of every condition are computed; the side not taken may well overflow.
    with np.errstate(all="ignore"):
        return calculation_of(level)(**given)


def calculation_of(level: str) -> Calculation:
    """Return the calculation of a level.

    Raises
    ------
    InputError
        When there is no such level.
    """
    name = ALIASES.get(level, level) if isinstance(level, str) else level
    return LEVELS[one_of("level", name, tuple(LEVELS))]


def by_symbol(parameters: Parameters) -> Values:
    """Return truck, pier and speed by the names of their symbols."""
    values: Values = {"V": parameters.speed}
    for i, spring in ((1, parameters.engine), (2, parameters.body)):
        values |= {
            f"{name}{i}": value
            for name, value in zip(("m", "P", "d", "k", "ku"), spring, strict=True)
        }
    mass, stiffness = parameters.pier_mass, parameters.pier_stiffness
    return values | {
        "cs": parameters.friction_force,
        "mp": mass,
        "kp": stiffness,
        "zeta": parameters.pier_damping / damping_coefficient(mass, stiffness, 1.0),
        "on_pier": parameters.on_pier,
    }
