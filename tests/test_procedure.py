"""Each closed formula against an independent solution of what it stands for."""

import inspect
import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from pierimpact.design.procedure import (
    amplification,
    centroid,
    contact_speed,
    contact_time,
    free_v,
    free_x,
    frequencies,
    maxima,
    mode,
    of_mode,
    resonance,
    second_moment,
    step_v,
    step_x,
)

SEEDS = range(8)


def ratios(size, seed=0):
    """Return β, μ, e and ζ over more than the studied range."""
    random = np.random.default_rng(seed)
    beta = np.exp(random.uniform(np.log(0.02), np.log(50.0), size))
    mu = np.exp(random.uniform(np.log(1e-3), np.log(20.0), size))
    return beta, mu, random.uniform(0.1, 1.0, size), random.uniform(0.0, 0.3, size)


# The unified spectrum


@pytest.mark.parametrize("power", range(2, 9, 2))
def test_the_spectrum_meets_the_impulse(power):
    _, _, e, zeta = ratios(50)
    beta = 10.0**-power
    found = amplification(beta, beta**3, e, zeta)
    np.testing.assert_allclose(found, (1.0 + e) * beta, rtol=5.0 * beta)


@pytest.mark.parametrize("power", range(2, 9, 2))
def test_the_spectrum_meets_the_rigid_wall(power):
    _, mu, e, zeta = ratios(50)
    beta = 10.0**power
    found = amplification(beta, mu * 10.0**-power, e, zeta)
    # The resonance term falls off as (β/3.1)^−3.1, the impulse's part as β^−2.
    np.testing.assert_allclose(found, 1.0, atol=60.0 * beta**-2)


@pytest.mark.parametrize("power", range(2, 9, 2))
def test_the_spectrum_meets_the_massless_pier(power):
    _, ratio, e, zeta = ratios(50)
    beta = 10.0**power
    found = amplification(beta, ratio * beta**2, e, zeta)
    np.testing.assert_allclose(found, 1.0 / np.sqrt(1.0 + ratio), rtol=60.0 * beta**-2)


@pytest.mark.parametrize("which", range(4))
def test_the_spectrum_is_continuous(which):
    values = list(ratios(200))
    before = amplification(*values)
    for step in (1e-4, 1e-8):
        moved = list(values)
        moved[which] = values[which] + step * np.maximum(values[which], 1.0 * (which == 3))
        change = np.abs(amplification(*moved) / before - 1.0)
        assert change.max() < 10.0 * step
        assert change.max() > 0.0


def test_the_spectrum_is_never_above_what_a_pulse_can_do():
    beta, mu, e, zeta = ratios(5000)
    found = amplification(beta, mu, e, zeta)
    assert (found > 0.0).all()
    assert (found < (1.0 + e) * beta).all()
    assert (found < 1.0 + resonance(beta, mu, zeta)).all()


def test_a_checker_can_evaluate_the_spectrum():
    # At β = 2, μ = 0.1, e = 0.4, ζ = 0.05, from the equations as printed in the docstrings.
    h = 1.45 * math.exp(-5.3 * 0.05) / ((1.0 + (2.0 / 3.1) ** 3.1) * (1.0 + 1.4 * 0.1 / 2.0))
    s = 1.0 / math.sqrt(1.0 / (1.4 * 2.0) ** 2 + (1.0 + 0.1 / 4.0) / (1.0 + h) ** 2)
    assert amplification(2.0, 0.1, 0.4, 0.05) == pytest.approx(s, rel=1e-14)


def test_the_spectrum_has_few_coefficients():
    fitted = [
        p for p in inspect.signature(resonance).parameters.values() if p.default is not p.empty
    ]
    assert len(fitted) <= 6


# Motion of the pier and of slowed bodies


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("pushed", [False, True])
def test_the_motion_of_the_pier_is_that_of_the_damped_oscillator(seed, pushed):
    random = np.random.default_rng(seed)
    omega, zeta = random.uniform(5.0, 900.0), random.uniform(0.0, 0.9)
    mass, force = random.uniform(1e3, 1e5), random.uniform(1e5, 1e7) if pushed else 0.0
    x, v = (0.0, 0.0) if pushed else random.normal(size=2) * [1.0, omega]
    t = np.linspace(0.0, 20.0 / omega, 20)
    run = solve_ivp(
        lambda t, y: [y[1], force / mass - omega**2 * y[0] - 2.0 * zeta * omega * y[1]],
        (0.0, t[-1]),
        [x, v],
        t_eval=t,
        rtol=1e-11,
        atol=1e-13,
    )
    motion = (omega, omega * math.sqrt(1.0 - zeta**2), zeta, t)
    if pushed:
        found = step_x(force, mass * omega**2, *motion), step_v(force, mass, *motion)
    else:
        found = free_x(x, v, *motion), free_v(x, v, *motion)
    scale = max(abs(run.y[0]).max(), 1e-3)
    np.testing.assert_allclose(found[0], run.y[0], atol=1e-8 * scale)
    np.testing.assert_allclose(found[1], run.y[1], atol=1e-8 * scale * omega)


@pytest.mark.parametrize("seed", SEEDS)
def test_slowed_body(seed):
    random = np.random.default_rng(seed)
    speed, deceleration = random.uniform(3.0, 40.0), random.uniform(10.0, 500.0)
    stops = speed**2 / (2.0 * deceleration)
    length = random.uniform(0.05, 0.99) * stops
    time = contact_time(speed, deceleration, length)
    left = contact_speed(speed, deceleration, length)
    assert speed * time - 0.5 * deceleration * time**2 == pytest.approx(length, rel=1e-12)
    assert speed - deceleration * time == pytest.approx(left, rel=1e-12)
    assert left > 0.0
    assert contact_speed(speed, deceleration, 1.01 * stops) == 0.0
    assert contact_time(speed, deceleration, 1.01 * stops) == pytest.approx(2.02 * stops / speed)


# The engine's impact


@pytest.mark.parametrize("seed", SEEDS)
def test_moments_of_the_impact(seed):
    random = np.random.default_rng(seed)
    mass, pier_mass = random.uniform(300.0, 2e3), np.exp(random.uniform(6.0, 14.0))
    stiffness, speed = random.uniform(5e7, 5e8), random.uniform(1.0, 30.0)
    e = random.uniform(0.1, 1.0)
    # The exact motion: the gap between mass and free pier is an oscillator of the reduced mass.
    omega = math.sqrt(stiffness * (1.0 / mass + 1.0 / pier_mass))
    up, down = 0.5 * math.pi / omega, 0.5 * math.pi * e / omega
    largest = speed / omega * stiffness

    def moment(n):
        return (
            quad(lambda t: t**n * largest * math.sin(omega * t), 0.0, up)[0]
            + quad(lambda t: t**n * largest * math.cos(omega * (t - up) / e), up, up + down)[0]
        )

    assert centroid(e) / omega == pytest.approx(moment(1) / moment(0), rel=1e-9)
    assert second_moment(e) / omega**2 == pytest.approx(moment(2) / moment(0), rel=1e-7)
    # What the pier gains is what the mass loses: the relative speed turns round to e times.
    impulse = (1.0 + e) * speed / (1.0 / mass + 1.0 / pier_mass)
    assert impulse == pytest.approx(moment(0), rel=1e-9)


# Pier and cargo in contact


class Mode:
    """A mode as the procedure gives it, from the motions of pier and body at contact."""

    def __init__(self, omega_i, psi, mu, omega, zeta, pier, body):
        self.omega, self.body = omega_i, psi
        # Measured from where both would rest, with a plateau force that shifts the body.
        gap = body[0] - pier[0]
        self.sigma, self.a, self.b, self.amplitude, self.phase, self.crest = mode(
            omega_i, psi, mu, omega, zeta, pier[0], pier[1], body[1], 0.0, gap, 1.0
        )

    def at(self, t):
        return of_mode(t, self.amplitude, self.sigma, self.omega, self.phase)


def in_contact(seed, damping=0.0):
    random = np.random.default_rng(seed)
    mass, pier_mass = random.uniform(3e3, 4e4), np.exp(random.uniform(7.0, 13.0))
    stiffness = random.uniform(3e6, 5e7)
    pier_stiffness = np.exp(random.uniform(np.log(1e7), np.log(1e10)))
    omega = math.sqrt(pier_stiffness / pier_mass)
    beta, mu = omega / math.sqrt(stiffness / mass), mass / pier_mass
    pier = random.normal() * 1e-3, random.normal()
    body = random.normal() * 1e-2, random.uniform(1.0, 30.0)
    _, _, _, omega_s, psi_s, omega_f, psi_f = frequencies(beta, mu, omega)
    slow, fast = (
        Mode(omega_i, psi, mu, omega, damping, pier, body)
        for omega_i, psi in ((omega_s, psi_s), (omega_f, psi_f))
    )
    return (mass, stiffness, pier_mass, pier_stiffness), slow, fast, pier, body


@pytest.mark.parametrize("seed", range(20))
def test_modes_are_the_eigenvectors(seed):
    (m, k, mp, kp), slow, fast, _, _ = in_contact(seed)
    matrix = np.array([[(k + kp) / mp, -k / mp], [-k / m, k / m]])
    squares, shapes = (part.real for part in np.linalg.eig(matrix))  # complex since NumPy 2.5
    order = np.argsort(squares)
    for found, i in zip((slow, fast), order, strict=True):
        assert found.omega == pytest.approx(math.sqrt(squares[i]), rel=1e-8)
        assert found.body == pytest.approx(shapes[1, i] / shapes[0, i], rel=1e-6)


@pytest.mark.parametrize("zeta", [0.0, 0.05, 0.2])
@pytest.mark.parametrize("seed", range(8))
def test_modes_start_from_the_motions_given(seed, zeta):
    _, slow, fast, pier, body = in_contact(seed, zeta)
    h = 1e-7 / fast.omega

    def motion(t):
        q = np.array([slow.at(t), fast.at(t)])
        return np.array([q.sum(), q @ [slow.body, fast.body]])

    np.testing.assert_allclose(motion(0.0), [pier[0], body[0]], atol=1e-12)
    velocity = (motion(h) - motion(-h)) / (2.0 * h)
    np.testing.assert_allclose(velocity, [pier[1], body[1]], rtol=1e-6, atol=1e-5)


@pytest.mark.parametrize("seed", range(8))
def test_undamped_modes_are_the_motion(seed):
    (m, k, mp, kp), slow, fast, pier, body = in_contact(seed)
    t = np.linspace(0.0, 3.0 / slow.omega, 30)
    run = solve_ivp(
        lambda t, y: [y[2], y[3], (k * (y[1] - y[0]) - kp * y[0]) / mp, -k * (y[1] - y[0]) / m],
        (0.0, t[-1]),
        [pier[0], body[0], pier[1], body[1]],
        method="DOP853",
        t_eval=t,
        rtol=1e-10,
        atol=1e-13,
    )
    scale = np.abs(run.y[0]).max()
    np.testing.assert_allclose(slow.at(t) + fast.at(t), run.y[0], atol=1e-6 * scale)


@pytest.mark.parametrize("seed", range(8))
def test_the_modes_damping_is_right_for_light_damping(seed):
    # The exact damped eigenvalues differ by what is quadratic in ζ.
    (m, k, mp, kp), *_ = in_contact(seed)
    errors = []
    for zeta in (0.02, 0.01):
        c = 2.0 * zeta * math.sqrt(kp * mp)
        _, slow, fast, _, _ = in_contact(seed, zeta)
        matrix = np.array(
            [
                [0.0, 0.0, 1.0, 0.0],
                [0.0, 0.0, 0.0, 1.0],
                [-(k + kp) / mp, k / mp, -c / mp, 0.0],
                [k / m, -k / m, 0.0, 0.0],
            ]
        )
        exact = np.linalg.eigvals(matrix)
        exact = exact[exact.imag > 0.0]
        exact = exact[np.argsort(exact.imag)]
        sigma = np.array([slow.sigma, fast.sigma])
        errors.append(np.abs(-exact.real - sigma).max() / sigma.max())
    assert errors[0] < 0.02
    assert errors[1] < 0.3 * errors[0] + 1e-9


def test_modes_survive_extreme_mass_ratios():
    for mu in (1e-18, 1e-9, 1e9):
        for beta in (0.1, 1.0, 10.0):
            gamma, lam, total, omega_s, psi_s, omega_f, psi_f = frequencies(beta, mu, 100.0)
            numbers = [gamma, lam, total, omega_s, psi_s, omega_f, psi_f]
            for omega_i, psi in ((omega_s, psi_s), (omega_f, psi_f)):
                numbers += mode(omega_i, psi, mu, 100.0, 0.05, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0)
            assert np.isfinite(numbers).all()
            # Orthogonal to each other in the masses.
            assert 1.0 + mu * psi_s * psi_f == pytest.approx(0.0, abs=1e-9)


class Synthetic:
    """A mode of given frequency, amplitude, phase and decay."""

    def __init__(self, omega, amplitude, phase, sigma=0.0):
        self.omega, self.amplitude, self.phase, self.sigma = omega, amplitude, phase, sigma
        self.crest = (phase - math.atan(sigma / omega)) % (2.0 * math.pi)

    def at(self, t):
        return of_mode(t, self.amplitude, self.sigma, self.omega, self.phase)


def crests(slow, fast):
    """Return when the slow mode, and both before and after it, are largest."""
    tu, _, _, ta, tb = maxima(
        slow.amplitude, slow.sigma, slow.omega, slow.crest,
        fast.amplitude, fast.sigma, fast.omega, fast.crest,
    )  # fmt: skip
    return tu, ta, tb


@pytest.mark.parametrize("seed", range(12))
def test_crests_of_well_separated_modes(seed):
    random = np.random.default_rng(seed)
    slow = Synthetic(
        random.uniform(10.0, 60.0), 1.0, random.uniform(0.8, 2.5), random.uniform(0.0, 1.0)
    )
    fast = Synthetic(
        slow.omega * random.uniform(8.0, 30.0),
        random.uniform(0.05, 0.5),
        random.uniform(-math.pi, math.pi),
        random.uniform(0.0, 5.0),
    )
    turn, early, late = crests(slow, fast)
    # The slow mode's own crest.
    t = np.linspace(0.0, 2.0 * math.pi / slow.omega, 400_001)
    assert turn == pytest.approx(t[np.argmax(slow.at(t))], abs=2.0 * t[1])
    # One crest of the fast mode lies on either side of it, and the sum's highest is one of them.
    assert max(early, 0.0) <= turn <= late
    assert late - early <= 2.0 * math.pi / fast.omega * (1.0 + 1e-12)
    total = slow.at(t) + fast.at(t)
    highest = max(float(slow.at(at) + fast.at(at)) for at in (early, late))
    # A crest missed by a phase ε lowers the fast part by ε²/2 at most.
    assert highest <= total.max() + (fast.omega * t[1]) ** 2  # the grid's own miss
    assert highest == pytest.approx(total.max(), abs=0.06 * fast.amplitude)


def test_crests_are_exact_where_both_modes_crest_together():
    slow, fast = Synthetic(20.0, 1.0, 1.0), Synthetic(200.0, 0.3, 10.0 - 2.0 * math.pi)
    turn, early, late = crests(slow, fast)
    assert turn == pytest.approx(0.05, rel=1e-12)
    assert min(abs(early - 0.05), abs(late - 0.05)) < 1e-12


def test_formulas_take_floats_and_arrays_alike():
    arrays = ratios(5)
    together = amplification(*arrays)
    for i in range(5):
        assert together[i] == pytest.approx(float(amplification(*(x[i] for x in arrays))))
    assert resonance(1.0, 0.1, 0.05) > 0.0
