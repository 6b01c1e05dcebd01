import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from pierimpact import CrushSpring, InputError

ENGINE = {
    "plateau_force": 150e3,
    "plateau_length": 0.5,
    "stiffness": 150e6,
    "unloading_stiffness": 900e6,
}


@st.composite
def springs(draw):
    stiffness = draw(st.floats(1e6, 5e8))
    unloading_stiffness = stiffness * draw(st.floats(1.0, 10.0))
    plateau_force = draw(st.floats(1e4, 1e6))
    slack = draw(st.floats(0.0, 2.0))
    return CrushSpring(
        plateau_force=plateau_force,
        plateau_length=plateau_force / unloading_stiffness + slack,
        stiffness=stiffness,
        unloading_stiffness=unloading_stiffness,
    )


def test_envelope_of_the_engine_spring():
    spring = CrushSpring(**ENGINE)
    limit = 150e3 / 900e6
    assert spring.elastic_limit == limit
    crush = [0.0, limit / 2.0, limit, 0.3, 0.5, 0.51]
    force = [0.0, 75e3, 150e3, 150e3, 150e3, 150e3 + 150e6 * 0.01]
    np.testing.assert_allclose(spring.envelope(crush), force, rtol=1e-12)
    assert spring.envelope(np.zeros((2, 3))).shape == (2, 3)
    assert spring.envelope(0.3).shape == ()


@given(springs())
def test_envelope_is_continuous_with_the_three_slopes(spring):
    limit, length = spring.elastic_limit, spring.plateau_length
    assert spring.envelope(limit) == pytest.approx(spring.plateau_force, rel=1e-12)
    assert spring.envelope(length) == pytest.approx(spring.plateau_force, rel=1e-12)
    beyond = length + np.array([0.1, 0.2])
    rise = np.diff(spring.envelope(beyond))[0] / np.diff(beyond)[0]
    assert rise == pytest.approx(spring.stiffness, rel=1e-9)
    within = limit * np.array([0.25, 0.75])
    slope = np.diff(spring.envelope(within))[0] / np.diff(within)[0]
    assert slope == pytest.approx(spring.unloading_stiffness, rel=1e-9)
    if length > limit:
        assert spring.envelope((limit + length) / 2.0) == spring.plateau_force


@given(springs(), st.floats(0.0, 1.5))
def test_dissipated_is_the_work_in_less_the_work_out(spring, fraction):
    largest = fraction * spring.plateau_length
    corners = [c for c in (spring.elastic_limit, spring.plateau_length) if 0.0 < c < largest]
    work_in, _ = quad(spring.envelope, 0.0, largest, points=corners or None, epsabs=0.0)
    force = float(spring.envelope(largest))
    slope = spring.unloading_stiffness
    release = largest - force / slope
    work_out, _ = quad(lambda crush: slope * (crush - release), release, largest, epsabs=0.0)
    lost = spring.dissipated(largest)
    assert lost == pytest.approx(work_in - work_out, rel=1e-8, abs=1e-9 * work_in)
    assert lost >= -1e-9 * work_in


@given(springs(), st.floats(0.0, 1.0))
def test_nothing_is_lost_below_the_elastic_limit(spring, fraction):
    crush = fraction * spring.elastic_limit
    largest_energy = 0.5 * spring.plateau_force * spring.elastic_limit
    assert abs(spring.dissipated(crush)) <= 1e-12 * largest_energy


@given(springs())
def test_dissipated_grows_with_the_crush(spring):
    crush = np.linspace(0.0, 2.0 * spring.plateau_length, 50)
    lost = spring.dissipated(crush)
    assert lost.shape == crush.shape
    round_off = 1e-12 * spring.envelope(crush[-1]) * crush[-1]
    assert (np.diff(lost) >= -round_off).all()


@pytest.mark.parametrize("ratio", [1.0, 1.7, 6.0, 10.0])
def test_restitution_is_the_rebound_from_the_steep_part_alone(ratio):
    # A mass thrown on a rigid wall; the plateau's force and length are too small to matter.
    spring = CrushSpring(
        plateau_force=1e-3, plateau_length=1e-9, stiffness=1e6, unloading_stiffness=ratio * 1e6
    )
    mass, speed = 100.0, 2.0

    def crushing(time, state):
        return [state[1], -float(spring.envelope(max(state[0], 0.0))) / mass]

    def stopped(time, state):
        return state[1]

    stopped.terminal = True
    run = solve_ivp(crushing, (0.0, 1.0), [0.0, speed], events=stopped, rtol=1e-9, atol=1e-12)
    largest = run.y_events[0][0][0]
    kept = 0.5 * mass * speed**2 - spring.dissipated(largest)
    assert math.sqrt(2.0 * kept / mass) / speed == pytest.approx(spring.restitution, rel=1e-6)


@pytest.mark.parametrize("name", list(ENGINE))
@pytest.mark.parametrize(
    ("value", "rule"),
    [
        (0.0, "be positive, got 0"),
        (-1.0, "be positive, got -1"),
        (math.nan, "be finite, got nan"),
        ("soft", "be a number, got 'soft'"),
    ],
)
def test_bad_values_are_named(name, value, rule):
    with pytest.raises(InputError, match=f"^{name} must {rule}$"):
        CrushSpring(**(ENGINE | {name: value}))


def test_unloading_is_not_softer_than_loading():
    with pytest.raises(
        InputError,
        match=r"^unloading_stiffness must be at least stiffness \(1\.5e\+08 N/m\), got 1e\+08 N/m$",
    ):
        CrushSpring(**(ENGINE | {"unloading_stiffness": 100e6}))


def test_plateau_reaches_beyond_the_elastic_limit():
    limit = 150e3 / 900e6
    CrushSpring(**(ENGINE | {"plateau_length": limit}))
    with pytest.raises(
        InputError,
        match=r"^plateau_length must be at least plateau_force/unloading_stiffness "
        r"\(0\.000166667 m\), got 0\.0001 m$",
    ):
        CrushSpring(**(ENGINE | {"plateau_length": 1e-4}))
