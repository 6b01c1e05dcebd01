"""Contact forces of many collisions against the histories of each."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from generated_columns import round_column

from pierimpact import (
    Collision,
    EquivalentPier,
    load_truck,
    peak_reactions,
    reaction_band,
    simulate,
)
from pierimpact.checks import InputError
from pierimpact.collision.averages import largest_average_force
from pierimpact.collision.contact_forces import contact_forces
from pierimpact.collision.parameters import parameter_chunks
from pierimpact.collision.reactions import full_model
from pierimpact.design import domain
from pierimpact.design.band import spreads_of
from pierimpact.design.quick_band import SIZE, quick_reactions, sampled_trucks
from pierimpact.pier.equivalent import damping_coefficient

COUNT = 60
WINDOW = 0.025


@pytest.fixture(scope="module")
def collisions():
    """Trucks of all masses with either friction on piers of the domain, from slow to fast."""
    random = np.random.default_rng(4)
    drawn = domain.sample(COUNT, 8)
    mass, stiffness = drawn.pier_mass, drawn.pier_stiffness
    ratio = drawn.pier_damping / damping_coefficient(mass, stiffness, 1.0)
    base = load_truck("single-unit-8t")
    trucks = [
        replace(base.loaded_to(total), friction_on=end, friction_force=friction)
        for total, end, friction in zip(
            random.uniform(6e3, 20e3, COUNT),
            random.choice(["road", "pier"], COUNT),
            random.choice([0.0, 28e3, 250e3], COUNT) * random.random(COUNT),
            strict=True,
        )
    ]
    return trucks, mass, stiffness, ratio, drawn.speed * random.uniform(0.1, 1.2, COUNT)


def one_by_one(trucks, *numbers):
    """The same as collisions."""
    return [
        Collision(truck, EquivalentPier(mass=mass, stiffness=stiffness, damping_ratio=ratio), speed)
        for truck, mass, stiffness, ratio, speed in zip(trucks, *numbers, strict=True)
    ]


def test_they_are_those_of_the_histories(collisions):
    each = one_by_one(*collisions)
    peaks, forces = contact_forces(each, [WINDOW, 0.01])
    # `peak_reactions` passes over cycles whose forces are wanted here: the same but for round-off.
    np.testing.assert_allclose(peaks.governing, peak_reactions(*collisions).governing, rtol=1e-12)
    for i, own in enumerate(each):
        history = simulate(own.truck, own.pier, own.speed)
        averages = [largest_average_force(history, window).force for window in (WINDOW, 0.01)]
        assert forces.averages[:, i] == pytest.approx(averages, rel=1e-5)
        # Its samples miss a maximum by 0.2 % at most.
        assert forces.largest[i] == pytest.approx(1.001 * history.contact_force.max(), rel=2e-3)
        for short in (1e-4, 0.002):
            shortest = largest_average_force(history, short).force
            assert shortest <= history.contact_force.max() * (1.0 + 1e-9)


@pytest.mark.parametrize(
    ("frequency", "speed"), [(3.0, 3.0), (3.0, 5.0), (6.0, 30.0), (10.0, 31.0)]
)
@pytest.mark.parametrize("mass", [1e3, 3e3, 8e3])
def test_they_are_the_largest_of_the_force_itself_where_friction_on_the_pier_turns(
    frequency, speed, mass
):
    truck = replace(load_truck("single-unit-8t"), friction_on="pier", friction_force=200e3)
    pier = EquivalentPier.from_frequency(mass, frequency, damping_ratio=0.05)
    history = simulate(truck, pier, speed)
    time = np.linspace(-WINDOW, history.time[-1], 400_001)
    force = history.contact_force_at(time)
    impulse = np.concatenate(([0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(time))))
    starts = time[time <= time[-1] - WINDOW]
    average = (np.interp(starts + WINDOW, time, impulse) - impulse[: len(starts)]).max() / WINDOW
    _, found = contact_forces([Collision(truck, pier, speed)], [WINDOW])
    of_history = largest_average_force(history, WINDOW).force
    assert of_history == pytest.approx(average, rel=1e-4)
    assert found.averages[0] == pytest.approx(of_history, rel=1e-5)
    assert history.contact_force.max() == pytest.approx(force.max(), rel=2e-3)
    assert found.largest == pytest.approx(force.max(), rel=1e-4)


def test_the_longer_the_window_the_smaller_the_average(collisions):
    each = one_by_one(*collisions)
    _, forces = contact_forces(each, [1e-4, 0.01, 0.04])
    for shorter, longer in pairwise(forces.averages):
        assert np.all(longer <= shorter * (1.0 + 1e-9))
    assert np.all(forces.averages[0] <= forces.largest * (1.0 + 1e-6))
    assert contact_forces(each, [])[1].averages.shape == (0, COUNT)
    with pytest.raises(InputError, match="windows must be positive, got 0 at index 1"):
        contact_forces(each, [0.01, 0.0])


def test_those_that_end_before_the_window_are_followed_further_and_those_that_yield(collisions):
    windows = [0.01, 2.0]
    each = one_by_one(*collisions)[:5]
    pier = EquivalentPier(mass=8e3, stiffness=284e6, yield_reaction=1.5e6)
    each += [replace(own, pier=pier) for own in each]
    peaks, forces = contact_forces(each, windows)
    for i, own in enumerate(each):
        history = simulate(own.truck, own.pier, own.speed, duration=2.0)
        averages = [largest_average_force(history, window).force for window in windows]
        assert forces.averages[:, i] == pytest.approx(averages, rel=1e-9)
        assert peaks.governing[i] == pytest.approx(history.governing_peak.reaction, rel=1e-9)


def test_what_vibrates_for_long_is_looked_at_alone():
    # A very light, stiff pier under a heavy truck: thousands of cycles before anything changes.
    trucks = [load_truck("single-unit-8t")] * 2
    each = one_by_one(trucks, [1.0, 8e3], [2e9, 284e6], [1e-6] * 2, [22.2] * 2)
    peaks, forces = contact_forces(each, [WINDOW])
    average = largest_average_force(simulate(trucks[1], each[1].pier, 22.2), WINDOW).force
    assert forces.averages[0, 1] == pytest.approx(average, rel=1e-5)
    assert math.isfinite(peaks.governing[0])


def test_quick_reactions_make_about_the_band_of_the_full_model(collisions):
    few = 6
    trucks, *given = (values[:few] for values in collisions)
    speed = np.full(few, 22.2)
    trucks = [load_truck("single-unit-8t").loaded_to(own.mass) for own in trucks]
    ((_, parameters),) = parameter_chunks(trucks, *given[:3], speed)[1]
    reactions = peak_reactions(trucks, *given[:3], speed).governing
    found = quick_reactions(parameters, reactions, spreads_of(trucks[0]))
    low, high = np.quantile(found.governing, (0.05, 0.95), axis=1)
    for i, truck in enumerate(trucks):
        pier = EquivalentPier(mass=given[0][i], stiffness=given[1][i], damping_ratio=given[2][i])
        expected = reaction_band(truck, pier, 22.2, size=256).quantiles()
        assert [low[i], high[i]] == pytest.approx(expected[[0, 2]], rel=0.12)
    # A truck that is known exactly is all of its trucks.
    known = quick_reactions(parameters, reactions, {}).governing
    np.testing.assert_allclose(known, np.repeat(reactions[:, None], SIZE, axis=1), rtol=1e-9)


@pytest.mark.parametrize("name", ["single-unit-8t", "tractor-trailer-36t"])
def test_quick_reactions_hold_where_the_closed_spectra_do_not(name):
    # Among them trucks of which the engine or the cargo arrives in a part of the spread only.
    random, truck = np.random.default_rng(8), load_truck(name)
    columns = [
        round_column(random.uniform(4.0, 9.0), random.uniform(0.6, 1.6), "fixed", top)
        for top in ("pinned", "fixed", "free") * 12
    ]
    piers = [column.struck_at(1.2).equivalent(0.05) for column in columns]
    mass, stiffness = np.array([(pier.mass, pier.stiffness) for pier in piers]).T
    speed = random.uniform(30.0, 110.0, len(piers)) / 3.6
    spreads = spreads_of(truck)
    ((_, parameters),) = parameter_chunks(truck, mass, stiffness, 0.05, speed)[1]
    nominal = full_model(parameters).governing
    found = quick_reactions(parameters, nominal, spreads)
    model = full_model(sampled_trucks(parameters, spreads))
    ends = [
        np.quantile(own.governing.reshape(-1, SIZE), (0.05, 0.95), axis=1) for own in (found, model)
    ]
    low, high = ends[0] / ends[1]
    assert np.all((low > 0.92) & (low < 1.12))
    assert np.all((high > 0.92) & (high < 1.1))
    assert np.quantile(np.abs(ends[0] / ends[1] - 1.0), 0.9) < 0.04
    arriving = [np.isfinite(own.cargo.reshape(-1, SIZE)).mean(axis=1) for own in (found, model)]
    assert arriving[0] == pytest.approx(arriving[1], abs=0.12)
