"""The two-degree-of-freedom system against closed forms and an independent integration."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from two_degrees import amplification

from pierimpact import InputError
from pierimpact.design.reduction import exact_amplification

GENERATED = settings(max_examples=30)

RATIOS = st.floats(0.05, 10.0)
MASSES = st.floats(0.01, 3.0)
RESTITUTIONS = st.floats(0.1, 1.0)
DAMPING = st.floats(0.0, 0.3)


@pytest.mark.parametrize("seed", range(16))
def test_agrees_with_an_independent_integration(seed):
    random = np.random.default_rng(seed)
    beta = math.exp(random.uniform(math.log(0.1), math.log(10.0)))
    mu = math.exp(random.uniform(math.log(0.01), math.log(2.0)))
    e, zeta = random.uniform(0.2, 1.0), random.uniform(0.0, 0.2)
    assert float(exact_amplification(beta, mu, e, zeta)) == pytest.approx(
        amplification(beta, mu, e, zeta), rel=2e-6
    )


@pytest.mark.parametrize("beta", [1e-3, 1e-5])
def test_a_soft_heavy_pier_feels_the_impulse(beta):
    random = np.random.default_rng(1)
    e, zeta = random.uniform(0.1, 1.0, 30), random.uniform(0.0, 0.9, 30)
    # The swing of a damped oscillator after an impulse, which lasts no time.
    swing = np.exp(-zeta * np.arccos(zeta) / np.sqrt(1.0 - zeta**2))
    found = exact_amplification(beta, beta**2, e, zeta)
    np.testing.assert_allclose(found, (1.0 + e) * beta * swing, rtol=5.0 * beta)


@pytest.mark.parametrize("beta", [15.0, 60.0])
def test_a_stiff_heavy_pier_is_a_wall(beta):
    random = np.random.default_rng(2)
    mu, e = random.uniform(0.01, 1.0, 30), random.uniform(0.1, 1.0, 30)
    zeta = random.uniform(0.0, 0.5, 30)
    found = exact_amplification(beta, mu, e, zeta)
    np.testing.assert_allclose(found, 1.0, atol=1.5 / beta)


@pytest.mark.parametrize("beta", [10.0, 25.0])
def test_a_massless_pier_is_a_spring_in_series(beta):
    # k_i/k_p = μ/β² is held; the pier's own ringing dies out with its mass.
    random = np.random.default_rng(3)
    ratio, e = np.exp(random.uniform(-3.0, 3.0, 30)), random.uniform(0.1, 1.0, 30)
    found = exact_amplification(beta, ratio * beta**2, e, 0.0)
    np.testing.assert_allclose(found, 1.0 / np.sqrt(1.0 + ratio), rtol=1.5 / beta)


@GENERATED
@given(st.floats(0.2, 6.0), MASSES)
def test_an_elastic_undamped_collision_is_the_sum_of_two_modes(beta, mu):
    # x'' + (mode shapes) in closed form; with e = 1 the law is linear until the contact ends.
    matrix = np.array([[1.0, -1.0], [-mu, mu + beta**2]])
    squares, shapes = (part.real for part in np.linalg.eig(matrix))  # complex since NumPy 2.5
    omegas = np.sqrt(squares)
    amplitudes = np.linalg.solve(shapes, [1.0, 0.0]) / omegas
    t = np.linspace(0.0, 20.0 * math.pi, 60_001)
    motion = np.sin(np.outer(t, omegas)) * amplitudes @ shapes.T
    crush = motion[:, 0] - motion[:, 1]
    contact = int(np.argmax(crush[1:] < 0.0)) + 1
    turns = int(np.argmax(np.diff(crush) < 0.0))  # below it, loading alone decides the least peak
    least = beta**2 / mu * motion[: turns + 1, 1].max()
    found = float(exact_amplification(beta, mu, 1.0, 0.0))
    assert found >= least * (1.0 - 1e-7)
    # After contact the pier swings freely about zero with what it has.
    x, v = motion[contact, 1], np.gradient(motion[:, 1], t)[contact]
    free = math.hypot(x, v / beta)
    exact = beta**2 / mu * max(motion[: contact + 1, 1].max(), free)
    later_contact = found > exact * (1.0 + 1e-5)
    assert later_contact or found == pytest.approx(exact, rel=1e-5)
    # A second contact needs a pier that comes back faster than the body leaves.
    if later_contact:
        body_speed = -np.gradient(motion[:, 0], t)[contact]
        assert body_speed < beta * free


@GENERATED
@given(RATIOS, st.floats(0.01, 1.0), RESTITUTIONS, DAMPING)
def test_energy_bounds_the_peak(beta, mu, e, zeta):
    # R²/2k_p cannot exceed the body's energy.
    found = float(exact_amplification(beta, mu, e, zeta))
    assert 0.0 < found <= math.sqrt(beta**2 / mu) * (1.0 + 1e-9)


def test_arrays_broadcast_and_agree_with_single_values():
    random = np.random.default_rng(4)
    beta, mu = random.uniform(0.2, 5.0, (3, 1)), random.uniform(0.05, 1.0, 2500)
    found = exact_amplification(beta, mu, 0.4, 0.05)
    assert found.shape == (3, 2500)
    for i, j in ((0, 0), (1, 2047), (2, 2048), (2, 2499)):
        single = float(exact_amplification(beta[i, 0], mu[j], 0.4, 0.05))
        assert found[i, j] == pytest.approx(single, rel=1e-9)
    assert exact_amplification([], 0.1, 0.4, 0.05).shape == (0,)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ((0.0, 0.1, 0.4, 0.05), "frequency_ratio must be positive, got 0"),
        ((1.0, -1.0, 0.4, 0.05), "mass_ratio must be positive, got -1"),
        ((1.0, 0.1, 0.0, 0.05), "restitution must be positive, got 0"),
        ((1.0, 0.1, 1.1, 0.05), "restitution must be at most 1, got 1.1"),
        ((1.0, 0.1, 0.4, 1.0), "damping_ratio must lie from 0 to below 1, got 1"),
        ((math.nan, 0.1, 0.4, 0.05), "frequency_ratio must be finite, got nan"),
        (
            ([1.0, 2.0], [1.0, 2.0, 3.0], 1.0, 0.0),
            r"shapes must broadcast against each other, got frequency_ratio \(2,\), mass_ratio "
            r"\(3,\), restitution \(\), damping_ratio \(\)",
        ),
    ],
)
def test_bad_values_are_named(values, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        exact_amplification(*values)
