"""Member forces of many trucks on one beam, against one collision at a time."""

import dataclasses
import math

import numpy as np
import pytest
from generated_columns import GENERATED as EXAMPLES
from generated_columns import arranged_columns, round_column
from hypothesis import given
from test_beam_collision import one_mode, struck_columns

from pierimpact import Collision, CrushSpring, load_truck, reaction_band, simulate
from pierimpact.collision.beams import largest_member_forces
from pierimpact.collision.groups import join, repeat, select
from pierimpact.design.beam_band import beam_band

TRUCK = load_truck("single-unit-8t")
COLUMN = round_column(8.0, 1.2)
BEAM = COLUMN.beam(1.2, 0.05)
SPEED = 80.0 / 3.6


def exact(truck, beam, speed):
    """Largest shear and moment by `simulate`, and when it ends."""
    history = simulate(truck, beam, speed)
    forces = history.member_forces
    both = forces.shear_extremes, forces.moment_extremes
    return [abs(extremes.governing.value) for extremes in both], history.end.time


def by_steps(truck, beam, speed, duration):
    parameters = repeat(Collision(truck, beam, speed).parameters, 1)
    return np.ravel(largest_member_forces(parameters, beam, duration))


@pytest.mark.parametrize("seed", range(4))
def test_they_are_those_of_simulate(seed):
    ratios = []
    for struck in struck_columns(24, seed=900 + seed):
        one, end = exact(*struck.case)
        ratios.append(by_steps(*struck.case, 1.5 * end) / one)
    assert np.all(np.abs(np.array(ratios) - 1.0) < 0.03)
    assert np.all(np.abs(np.mean(ratios, axis=0) - 1.0) < 0.003)


def test_many_side_by_side_are_each_alone():
    cases = [struck.case for struck in struck_columns(6, seed=31)]
    beam = cases[0].pier
    rows = [repeat(Collision(case.truck, beam, case.speed).parameters, 1) for case in cases]
    together = rows[0]
    for row in rows[1:]:
        together = join(together, row)
    found = largest_member_forces(together, beam, 0.5)
    for number in range(len(cases)):
        alone = largest_member_forces(select(together, slice(number, number + 1)), beam, 0.5)
        here = select(found, slice(number, number + 1))
        assert np.ravel(here) == pytest.approx(np.ravel(alone), rel=0.01)  # its steps may be longer


@given(arranged_columns())
@EXAMPLES
def test_fewer_shapes_stay_exact_for_a_static_force(case):
    column, impact_height = case
    beam = column.beam(impact_height)
    for frequency, most in ((0.0, 9), (float(beam.frequencies[3]), 9), (math.inf, 2)):
        fewer = beam.up_to(frequency, most)
        count = min(max(1, int(np.sum(beam.frequencies <= frequency))), most)
        assert len(fewer.circular_frequencies) == count + 1
        assert fewer.circular_frequencies[:-1] == pytest.approx(
            beam.circular_frequencies[:count], rel=1e-15
        )
        for name in ("impact_deflection", "deflection", "shear", "moment"):
            all_of_it, some = (
                (own.impact_deflection / own.circular_frequencies**2) @ getattr(own, name)
                for own in (beam, fewer)
            )
            scale = np.max(np.abs(all_of_it))
            assert some == pytest.approx(all_of_it, rel=1e-9, abs=1e-9 * scale)


def test_all_shapes_kept_are_the_same_beam():
    same = BEAM.up_to(math.inf)
    for name in ("circular_frequencies", "impact_deflection", "shear", "moment"):
        assert getattr(same, name) == pytest.approx(getattr(BEAM, name), rel=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_a_part_of_a_beam_has_its_own_largest_forces(seed):
    random, errors = np.random.default_rng(seed), []
    for struck in struck_columns(12, seed=940 + seed):
        truck, beam, speed = struck.case
        low, high = np.sort(random.choice(np.unique(beam.z), 2, replace=False))
        history = simulate(truck, beam, speed)
        part = history.member_forces.between(low, high)
        assert np.array_equal(part.z, beam.between(low, high).z)
        assert (part.z[0], part.z[-1]) == (low, high)
        exact_there = [
            abs(extremes.governing.value)
            for extremes in (part.shear_extremes, part.moment_extremes)
        ]
        found = by_steps(truck, beam.between(low, high), speed, 1.5 * history.end.time)
        whole, _ = exact(truck, beam, speed)
        errors.append((found - exact_there) / np.array(whole))
        assert np.all(np.array(exact_there) <= np.array(whole) * (1.0 + 1e-12))
    assert np.all(np.abs(errors) < 0.03)


def test_blows_that_no_step_resolves():
    # They are over before the beam moves, and their impulse counts: only in shear waves is more.
    engine = CrushSpring(
        plateau_force=1e4, plateau_length=0.01, stiffness=5e11, unloading_stiffness=1e12
    )
    hard = dataclasses.replace(TRUCK, engine_mass=50.0, engine_spring=engine)
    (shear, moment), end = exact(hard, BEAM, 5.0)
    found_shear, found_moment = by_steps(hard, BEAM, 5.0, 1.5 * end)
    assert found_moment == pytest.approx(moment, rel=0.03)
    assert 0.0 < found_shear < shear


# Bands.


def test_a_band_is_that_of_trucks_one_by_one():
    band = reaction_band(TRUCK, BEAM, SPEED, size=64)
    (shear, moment), end = exact(TRUCK, BEAM, SPEED)
    each = [
        exact(own.truck, BEAM, own.speed)[0]
        for number in range(64)
        for own in [band.sampled(number)]
    ]
    found = beam_band(band.collision.parameters, band.parameters, BEAM, end)
    for name, nominal, column in (("shear", shear, 0), ("moment", moment, 1)):
        of_each = np.array(each)[:, column]
        assert getattr(found.nominal, name) == pytest.approx(nominal, rel=0.01)
        assert getattr(found.sampled, name) == pytest.approx(of_each, rel=0.02)
        assert found.ratios(name) == pytest.approx(of_each / nominal, rel=0.01)


def test_trucks_without_spread_are_the_nominal_one():
    band = reaction_band(TRUCK, BEAM, SPEED, spread={}, size=8)
    found = beam_band(band.collision.parameters, band.parameters, BEAM, 0.3)
    assert len(found.sampled.shear) == 8
    for name in ("shear", "moment"):
        assert found.ratios(name) == pytest.approx(np.ones(8), rel=1e-12)


def test_under_one_mode_member_forces_go_with_the_reaction():
    # A beam of one mode is the pier with one degree of freedom: all its forces are q times one.
    pier = COLUMN.equivalent(1.2, 0.05)
    mode = one_mode(pier)
    beam = dataclasses.replace(mode, shear=np.ones((1, 1)), moment=np.full((1, 1), 2.0))
    band = reaction_band(TRUCK, pier, SPEED, size=64)
    found = beam_band(band.collision.parameters, band.parameters, beam, 0.3)
    ratios = found.sampled.moment / found.sampled.shear
    assert ratios == pytest.approx(np.full(64, 2.0), rel=1e-12)
    assert found.sampled.shear / found.nominal.shear == pytest.approx(
        band.governing / band.nominal, rel=0.03
    )
