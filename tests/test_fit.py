"""A truck is found again in records of the model's own; what they do not show is named."""

import dataclasses
import math

import numpy as np
import pytest

from pierimpact import EquivalentPier, InputError, fit_truck, load_truck
from pierimpact.collision.records import Record
from pierimpact.design.fit import (
    PARAMETERS,
    fit_records,
    parameter,
    with_parameters,
)

START = load_truck("single-unit-8t")
FLEXIBLE = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
ENGINE, BODY = "engine_spring", "body_spring"


def truck_about(seed, share=0.3):
    """The start with every parameter changed by up to a share."""
    random = np.random.default_rng(seed)
    return with_parameters(
        START,
        {
            name: parameter(START, name) * random.uniform(1 - share, 1 + share)
            for name in PARAMETERS
        },
    )


def record_of(truck, noise=0.05, rate=5e3, duration=0.2, seed=1, **given):
    """What a truck leaves in a record with noise of a share of the peak."""
    time = np.arange(0.0, duration, 1.0 / rate)
    clean = Record(time=time, force=np.ones_like(time), **({"speed": 22.2} | given))
    force = clean.modelled(clean.collision(truck))
    random = np.random.default_rng(seed)
    scatter = noise * force.max() * random.standard_normal(len(force))
    return dataclasses.replace(clean, force=force + scatter)


# Records with noise.


@pytest.fixture(
    scope="module",
    params=[
        (1, None, "contact force"),
        (3, FLEXIBLE, "reaction"),
    ],
    ids=["rigid", "flexible"],
)
def noisy(request):
    seed, pier, quantity = request.param
    truth = truck_about(seed)
    record = record_of(truth, rate=20e3, seed=seed, pier=pier, quantity=quantity)
    return truth, fit_records([record], START)


def test_what_is_identified_returns_within_5_per_cent(noisy):
    truth, fit = noisy
    identified = set(fit.estimates) - set(fit.not_identified)
    assert f"{BODY}.plateau_length" in identified
    for name in identified:
        assert parameter(fit.truck, name) == pytest.approx(parameter(truth, name), rel=0.05)


def test_error_bars_cover_the_truth(noisy):
    # Of a hundred trials benchmarks/fit.py counts them; here one deviation may take along those
    # that it goes together with.
    truth, fit = noisy
    off = [
        abs(parameter(fit.truck, name) - parameter(truth, name)) / error
        for name, error in fit.standard_errors.items()
    ]
    assert len(off) >= 6
    assert np.mean(np.array(off) <= 2.0) > 0.7
    assert max(off) < 4.0


def test_what_is_left_is_the_noise(noisy):
    _, fit = noisy
    assert fit.residual.share == pytest.approx(0.05, rel=0.15)
    left = fit.modelled - fit.records[0].force
    assert fit.residual.rms == pytest.approx(left.std(), rel=1e-2)


def test_total_mass_stays(noisy):
    _, fit = noisy
    assert fit.truck.mass == pytest.approx(START.mass)


def test_correlations(noisy):
    _, fit = noisy
    assert fit.correlations.shape == 2 * (len(fit.estimates),)
    np.testing.assert_allclose(np.diag(fit.correlations), 1.0)
    np.testing.assert_allclose(fit.correlations, fit.correlations.T, atol=1e-9)
    assert np.linalg.eigvalsh(fit.correlations).min() > 0.0


# Standard errors against independent figures.


def test_standard_error_of_a_plateau_is_that_of_a_mean():
    # A truck too slow for contacts: one force over n samples, known to noise/√n.
    truth = START
    record = record_of(truth, speed=4.0, duration=0.04, noise=0.1)
    fit = fit_records([record], START, parameters=[f"{BODY}.plateau_force"], spread=10.0)
    level = START.engine_spring.plateau_force + START.body_spring.plateau_force
    expected = 0.1 * level / math.sqrt(len(record.time))
    assert fit.standard_errors[f"{BODY}.plateau_force"] == pytest.approx(expected, rel=0.15)


def test_standard_errors_fall_with_the_number_of_records():
    names = [f"{BODY}.plateau_force", f"{BODY}.stiffness"]
    record = record_of(START)
    one, four = (fit_records([record] * count, START, parameters=names) for count in (1, 4))
    for name in names:
        assert four.standard_errors[name] == pytest.approx(
            0.5 * one.standard_errors[name], rel=0.05
        )


def test_filtered_noise_counts_by_its_power():
    # A filter takes away noise that a plateau averages out anyway.
    name = f"{BODY}.plateau_force"
    raw = record_of(START)
    one, other = (
        fit_records([record], START, parameters=[name]).standard_errors[name]
        for record in (raw, raw.low_passed(200.0))
    )
    assert other == pytest.approx(one, rel=0.35)


# Records without noise.


def test_a_clean_record_gives_its_truck():
    truth = truck_about(5, share=0.2)
    record = record_of(truth, pier=FLEXIBLE, noise=0.0)
    fit = fit_records([record], START)
    assert fit.not_identified == {}
    for name in PARAMETERS:
        assert parameter(fit.truck, name) == pytest.approx(parameter(truth, name), rel=1e-3)
    assert fit.residual.share < 1e-4


def test_a_start_far_off():
    names = [f"{ENGINE}.plateau_length", f"{BODY}.plateau_length"]
    truth = with_parameters(START, {names[0]: 0.25, names[1]: 3.4})
    record = record_of(truth, noise=0.02, duration=0.3)
    fit = fit_records([record], START, parameters=names, spread=1.0)
    for name in names:
        assert parameter(fit.truck, name) == pytest.approx(parameter(truth, name), rel=0.02)


def test_the_information_of_two_records_adds_up():
    name = f"{BODY}.stiffness"
    records = [record_of(START, speed=speed, seed=int(speed)) for speed in (18.0, 25.0)]
    both, *single = (
        fit_records(few, START, parameters=[name]).standard_errors[name]
        for few in (records, records[:1], records[1:])
    )
    assert both**-2 == pytest.approx(sum(error**-2 for error in single), rel=0.1)


def test_a_clock_that_starts_before_first_touch():
    truth = truck_about(6, share=0.1)
    record = record_of(truth, noise=0.0)
    names = [f"{BODY}.plateau_length", f"{ENGINE}.plateau_length"]
    fit = fit_truck(
        np.concatenate((record.time[:100] - 0.02, record.time)) + 0.05,
        np.concatenate((np.zeros(100), record.force)),
        start=with_parameters(truth, {name: parameter(START, name) for name in names}),
        speed=22.2,
        first_touch=0.05,
        parameters=names,
    )
    for name in names:
        assert parameter(fit.truck, name) == pytest.approx(parameter(truth, name), rel=1e-4)


# What a record does not show.


def test_a_filter_longer_than_the_first_spike_hides_the_engines_stiffness():
    record = record_of(truck_about(4), noise=0.01)
    names = ["engine_mass", f"{ENGINE}.stiffness", f"{ENGINE}.unloading_stiffness"]
    names += [f"{ENGINE}.plateau_length", f"{BODY}.plateau_length"]
    fit = fit_truck(
        record.time, record.force, start=START, speed=22.2, filter=60.0, parameters=names
    )
    for name in ("stiffness", "unloading_stiffness"):
        assert "8.33 ms" in fit.not_identified[f"{ENGINE}.{name}"]
        assert getattr(fit.truck.engine_spring, name) == getattr(START.engine_spring, name)
        assert f"{ENGINE}.{name}" not in fit.standard_errors
    assert f"{BODY}.plateau_length" not in fit.not_identified


def test_an_average_longer_than_the_first_spike_hides_it_too():
    names = ["engine_mass", f"{ENGINE}.stiffness", f"{ENGINE}.plateau_length"]
    truth = with_parameters(START, dict(zip(names, (800.0, 180e6, 0.55), strict=True)))
    record = record_of(truth, noise=0.005, window=0.01)
    fit = fit_records([record], START, parameters=names)
    assert "moving average" in fit.not_identified[f"{ENGINE}.stiffness"]
    assert fit.truck.engine_spring.stiffness == START.engine_spring.stiffness


def test_without_cargo_contact_the_cargo_does_not_show():
    record = record_of(START, speed=12.0, noise=0.0)
    assert record.collision(START).cargo_contact_time is None
    start = truck_about(9, share=0.15)
    names = [f"{BODY}.{name}" for name in ("plateau_force", "plateau_length", "stiffness")]
    fit = fit_records([record], start, parameters=names)
    assert f"{BODY}.plateau_force" in fit.standard_errors
    for name in ("stiffness", "plateau_length"):
        assert fit.not_identified[f"{BODY}.{name}"].startswith("the cargo does not reach the pier")
        assert getattr(fit.truck.body_spring, name) == getattr(start.body_spring, name)


def test_a_contact_that_noise_could_be_does_not_count():
    # The engine stops 0.1 mm before it would reach the pier, or 0.1 mm after it has.
    name = f"{ENGINE}.plateau_length"
    record = record_of(START, speed=12.0, noise=0.1)
    reached = float(record.collision(with_parameters(START, {name: 9.0})).engine_crush.max())
    for length in (reached - 1e-4, reached + 1e-4):
        truth = with_parameters(START, {name: length})
        fit = fit_records([record_of(truth, speed=12.0, noise=0.1)], truth, parameters=[name])
        assert "does not" in fit.not_identified[name]
        assert fit.truck.engine_spring.plateau_length == length


def test_a_plateau_shorter_than_the_crush_does_not_come_back():
    name = f"{BODY}.plateau_length"
    truth = with_parameters(START, {name: 2.4})
    record = record_of(truth, speed=16.0)
    assert record.collision(truth).cargo_contact_time is None
    start = with_parameters(START, {name: 1.2})
    fit = fit_records([record], start, parameters=[name, f"{BODY}.plateau_force"])
    assert fit.not_identified[name].endswith("its plateau is longer than at the start")
    history = record.collision(truth)
    crush = np.max(history.body_crush[history.time <= record.time[-1]])
    assert fit.truck.body_spring.plateau_length > 0.99 * crush
    assert fit.residual.share == pytest.approx(0.05, rel=0.15)


def test_a_record_that_ends_early_shows_no_unloading():
    record = record_of(START, noise=0.0, duration=0.12)
    fit = fit_records([record], START, parameters=[f"{BODY}.unloading_stiffness"])
    reason = "the cargo’s spring never unloads in the record"
    assert fit.not_identified[f"{BODY}.unloading_stiffness"] == reason


def test_a_soft_pier_hides_the_engine():
    soft = EquivalentPier.from_frequency(mass=50e3, frequency=5.0)
    names = ["engine_mass", f"{ENGINE}.stiffness", f"{ENGINE}.unloading_stiffness"]
    record = record_of(START, pier=soft, quantity="reaction")
    fit = fit_records([record], START, parameters=names)
    assert "hardly shows it" in fit.not_identified[f"{ENGINE}.stiffness"]
    assert fit.truck.engine_spring.stiffness == START.engine_spring.stiffness


def test_noise_leaves_less_identified():
    names = ["engine_mass", f"{ENGINE}.stiffness", f"{BODY}.stiffness", f"{BODY}.plateau_force"]
    found = [
        fit_records([record_of(START, noise=noise)], START, parameters=names)
        for noise in (0.0, 0.05, 0.5)
    ]
    counts = [len(fit.not_identified) for fit in found]
    assert counts == sorted(counts)
    assert counts[0] == 0
    assert counts[-1] == len(names)


def test_standard_errors_are_a_third_of_the_accuracy_or_less():
    names = [f"{ENGINE}.stiffness", f"{BODY}.stiffness"]
    record = record_of(START)
    for accuracy in (0.02, 0.05, 0.2):
        fit = fit_records([record], START, parameters=names, accuracy=accuracy)
        for name in names:
            share = fit.standard_errors[name] / parameter(fit.truck, name)
            assert (name in fit.not_identified) == (share > accuracy / 3.0)


# Bad input.


def test_what_cannot_be_fitted_is_refused():
    record = record_of(START)
    with pytest.raises(InputError, match="stifness' is not a parameter that can be fitted; did"):
        fit_records([record], START, parameters=["engine_spring.stifness"])
    free = dataclasses.replace(START, friction_force=0.0)
    with pytest.raises(InputError, match="friction_force must be positive at the start"):
        fit_records([record], free, parameters=["friction_force"])
    with pytest.raises(InputError, match="at least one record"):
        fit_records([], START)
    with pytest.raises(InputError, match="at least one, got none"):
        fit_records([record], START, parameters=[])
    with pytest.raises(InputError, match="accuracy must be positive"):
        fit_records([record], START, accuracy=0.0)


def test_a_start_without_friction_keeps_it_so():
    free = dataclasses.replace(START, friction_force=0.0)
    record = record_of(free, noise=0.0, duration=0.02)
    fit = fit_records([record], free, spread=0.1)
    assert "friction_force" not in fit.estimates
    assert fit.truck.friction_force == 0.0


def test_rules_of_the_crush_law_are_kept():
    changed = with_parameters(START, {f"{ENGINE}.stiffness": 2e9, f"{BODY}.plateau_length": 1e-3})
    assert changed.engine_spring.unloading_stiffness == 2e9
    assert changed.body_spring.plateau_length == changed.body_spring.elastic_limit
