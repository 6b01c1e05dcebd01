"""Moving averages of the contact force, against closed forms and an independent impulse."""

import dataclasses

import numpy as np
import pytest

from pierimpact import CrushSpring, EquivalentPier, Truck, load_truck, simulate
from pierimpact.checks import InputError
from pierimpact.collision.averages import largest_average_force

PIER = EquivalentPier(mass=8e3, stiffness=284e6, damping_ratio=0.05)


def history(speed=22.0, pier=PIER, **changes):
    truck = dataclasses.replace(load_truck("single-unit-8t"), **changes)
    return simulate(truck, pier, speed=speed, duration=0.3)


@pytest.mark.parametrize("speed", [8.0, 15.0, 22.0, 30.0])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.05])
@pytest.mark.parametrize("frequency", [4.0, 30.0, 90.0])
def test_the_impulse_is_the_momentum_that_the_truck_loses(speed, damping_ratio, frequency):
    pier = EquivalentPier(
        mass=8e3, stiffness=8e3 * (2.0 * np.pi * frequency) ** 2, damping_ratio=damping_ratio
    )
    found = history(speed, pier, friction_force=0.0)
    lost = found.truck.engine_mass * (speed - found.engine_velocity)
    lost += found.truck.body_mass * (speed - found.body_velocity)
    given = found.truck.mass * speed
    np.testing.assert_allclose(found.impulse, lost, rtol=0.0, atol=1e-12 * given)


@pytest.mark.parametrize("window", [0.004, 0.010, 0.025, 0.060])
@pytest.mark.parametrize("speed", [9.0, 22.0, 31.0])
def test_no_window_has_a_larger_average(speed, window):
    found = history(speed, friction_force=0.0)
    largest = largest_average_force(found, window)
    lost = found.truck.engine_mass * (speed - found.engine_velocity)
    lost += found.truck.body_mass * (speed - found.body_velocity)
    starts = np.linspace(0.0, found.time[-1] - window, 20001)
    averages = np.interp(starts + window, found.time, lost) - np.interp(starts, found.time, lost)
    assert averages.max() / window == pytest.approx(largest.force, rel=2e-3)
    here = np.interp(largest.start + np.array([0.0, window]), found.time, lost)
    assert (here[1] - here[0]) / window == pytest.approx(largest.force, rel=2e-3)


def test_on_the_plateau_it_is_the_plateau_force():
    found = history(speed=5.0)  # neither engine nor cargo gets past its plateau
    assert found.engine_contact_time is None
    assert found.cargo_contact_time is None
    plateau = found.truck.engine_spring.plateau_force + found.truck.body_spring.plateau_force
    assert largest_average_force(found, 0.005).force == pytest.approx(plateau, rel=2e-6)


def test_a_short_window_comes_to_the_largest_force_and_a_long_one_below():
    found = history()
    largest = float(found.contact_force.max())
    averages = [largest_average_force(found, w).force for w in (1e-5, 0.01, 0.025, 0.1, 0.3)]
    assert averages[0] == pytest.approx(largest, rel=1e-3)
    assert averages == sorted(averages, reverse=True)


def test_a_blow_shorter_than_the_window_counts_with_what_is_before_and_after():
    spring = CrushSpring(
        plateau_force=1.0, plateau_length=1e-3, stiffness=1e6, unloading_stiffness=1e6
    )
    truck = Truck(
        name="ball",
        engine_mass=100.0,
        body_mass=1e-6,
        engine_spring=spring,
        body_spring=spring,
    )
    wall = EquivalentPier(mass=1e3, stiffness=1e12)
    found = simulate(truck, wall, speed=5.0, duration=0.2)
    half_period = np.pi * np.sqrt(100.0 / 1e6)
    assert half_period < 0.05
    # All of the momentum, twice over: the ball comes back as fast as it came.
    assert largest_average_force(found, 0.05).force == pytest.approx(20e3, rel=1e-3)


@pytest.mark.parametrize(
    ("window", "message"),
    [(0.0, "window must be positive, got 0"), (9.0, "window must be at most the history's")],
)
def test_windows_that_cannot_be(window, message):
    with pytest.raises(InputError, match=message):
        largest_average_force(history(), window)
