"""The variations about a case, against the same reactions one by one."""

import numpy as np
import pytest

from pierimpact import (
    CircularSection,
    EquivalentPier,
    PierColumn,
    design_reaction,
    load_truck,
    peak_reactions,
    simulate,
)
from pierimpact.design.sensitivity import SPEED_CHANGES, sensitivity

TRUCK = load_truck("single-unit-8t")
COLUMN = PierColumn(
    height=1.6,
    section=CircularSection(diameter=0.6),
    elastic_modulus=25e9,
    density=2400.0,
    base="fixed",
    top="pinned",
)
HEIGHT, SPEED = 1.2, 21.0
PIER = COLUMN.equivalent(HEIGHT, 0.04)


@pytest.fixture(scope="module")
def found():
    return sensitivity(TRUCK, COLUMN, PIER, HEIGHT, SPEED)


def changed(name, value):
    """Return truck, pier and speed with one of them changed."""
    if name == "mass":
        return TRUCK.loaded_to(value), PIER, SPEED
    if name == "impact_height":
        return TRUCK, COLUMN.equivalent(value, 0.04), SPEED
    if name == "frequency":
        stiffness = PIER.mass * (2.0 * np.pi * value) ** 2
        return TRUCK, EquivalentPier(mass=PIER.mass, stiffness=stiffness, damping_ratio=0.04), SPEED
    return TRUCK, PIER, value


@pytest.mark.parametrize("name", ["speed", "mass", "impact_height", "frequency"])
def test_each_value_is_that_of_a_calculation_of_its_own(found, name):
    variation = getattr(found, name)
    for index in range(0, len(variation.values), 7):
        truck, pier, speed = changed(name, float(variation.values[index]))
        history = simulate(truck, pier, speed)
        design = design_reaction(truck, pier, speed)
        assert variation.model[index] == pytest.approx(history.governing_peak.reaction, rel=1e-6)
        assert variation.design[index] == pytest.approx(design.reaction, rel=1e-9)
        assert np.isnan(variation.cargo[index]) == (history.cargo_peak is None)
        assert variation.engine[index] == pytest.approx(history.engine_peak.reaction, rel=1e-6)
        assert variation.design_engine[index] == pytest.approx(design.engine, rel=1e-9)
        if history.cargo_peak is not None:
            assert variation.cargo[index] == pytest.approx(history.cargo_peak.reaction, rel=1e-6)
        if design.cargo is not None:
            assert variation.design_cargo[index] == pytest.approx(design.cargo, rel=1e-9)


def test_the_changes_of_a_reviewer(found):
    step = 10.0 / 3.6  # 10 km/h
    assert found.speed_change == step
    assert found.slower.values == pytest.approx([SPEED - step])
    assert found.faster.values == pytest.approx([SPEED + step])
    assert found.lighter.values == pytest.approx([0.8 * TRUCK.mass])
    assert found.heavier.values == pytest.approx([1.2 * TRUCK.mass])
    assert found.slower.model[0] < found.faster.model[0]
    history = simulate(TRUCK, PIER, SPEED + step)
    assert found.faster.model[0] == pytest.approx(history.governing_peak.reaction, rel=1e-6)


def test_the_change_of_speed_can_be_another():
    change = 5 * 1609.344 / 3600  # 5 mph
    assert change == pytest.approx(SPEED_CHANGES["US"], rel=1e-15)
    other = sensitivity(TRUCK, COLUMN, PIER, HEIGHT, SPEED, SPEED_CHANGES["US"])
    assert other.speed_change == SPEED_CHANGES["US"]
    assert other.slower.values == pytest.approx([SPEED - change])
    assert other.faster.values == pytest.approx([SPEED + change])


def test_the_curves_run_over_half_the_value_to_either_side(found):
    for variation, value in ((found.speed, SPEED), (found.mass, TRUCK.mass)):
        low, high = variation.values[[0, -1]]
        assert (low, high) == pytest.approx((0.5 * value, 1.5 * value))
        assert len(variation.values) > 20
    assert found.impact_height.values[0] == pytest.approx(0.5 * HEIGHT)
    spectrum = found.frequency.values[found.frequency.values < 201.0]
    assert spectrum[[0, -1]] == pytest.approx([2.0, 200.0])


def test_heights_stay_on_the_column_and_this_pier_is_in_the_spectrum(found):
    assert found.impact_height.values[-1] < COLUMN.height
    assert PIER.frequency in found.frequency.values


@pytest.mark.parametrize("frequency", [2.1, 190.0, 700.0])
def test_a_pier_at_an_end_of_the_spectrum_has_neighbours_on_both_sides(frequency):
    pier = EquivalentPier.from_frequency(PIER.mass, frequency, 0.05)
    values = sensitivity(TRUCK, COLUMN, pier, HEIGHT, SPEED).frequency.values
    for share in (0.9, 1.1):
        assert np.min(np.abs(values / (share * frequency) - 1.0)) < 1e-12


def test_between_its_frequencies_a_spectrum_is_straight(found):
    there = np.exp(np.random.default_rng(5).uniform(np.log(2.0), np.log(200.0), 150))
    stiffness = PIER.mass * (2.0 * np.pi * there) ** 2
    peaks = peak_reactions(TRUCK, PIER.mass, stiffness, PIER.damping_ratio, SPEED)
    for name in ("engine", "cargo"):
        curve, exact = getattr(found.frequency, name), getattr(peaks, name)
        drawn = np.interp(np.log(there), np.log(found.frequency.values), curve)
        known = np.isfinite(drawn) & np.isfinite(exact)
        assert np.sum(known) > 100
        assert np.max(np.abs(drawn - exact)[known]) < 0.01 * np.max(exact[known])


def test_changes_that_cannot_be_are_left_out():
    light = TRUCK.loaded_to(1.2 * TRUCK.engine_mass)
    slow = sensitivity(light, COLUMN, PIER, HEIGHT, 2.0)
    assert slow.slower is None
    assert slow.lighter is None
    assert slow.faster is not None
    assert np.all(slow.mass.values > TRUCK.engine_mass)
