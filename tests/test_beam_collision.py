import dataclasses
import math
from typing import NamedTuple

import numpy as np
import pytest
import test_history
from beam_reference import solve
from generated_collisions import HARD, Case, collisions
from generated_columns import round_column

import pierimpact.collision.beam
import pierimpact.collision.beam_history
import pierimpact.pier.beam
from pierimpact import (
    CrushSpring,
    EquivalentPier,
    PierColumn,
    Truck,
    load_truck,
    simulate,
)
from pierimpact.pier.beam import BeamPier

TRUCK = load_truck("single-unit-8t")
ENDS = [("fixed", "pinned"), ("fixed", "fixed"), ("fixed", "free"), ("pinned", "pinned")]


class Struck(NamedTuple):
    """A collision with a column."""

    truck: Truck
    column: PierColumn
    impact_height: float
    damping_ratio: float
    speed: float

    def beam(self, modes=None):
        return self.column.beam(self.impact_height, self.damping_ratio, modes=modes)

    @property
    def case(self):
        return Case(self.truck, self.beam(), self.speed)


def struck_columns(count, seed):
    """Trucks of the studied domain against columns of all kinds."""
    generator = np.random.default_rng(seed)
    found = []
    for number, (truck, _, speed) in enumerate(collisions(count, seed=seed)):
        height = generator.uniform(3.0, 9.0)
        struck = round_column(height, height * generator.uniform(0.12, 0.3), *ENDS[number % 4])
        ratio = generator.choice([0.02, 0.05, 0.1])
        found.append(Struck(truck, struck, generator.uniform(0.8, 1.6), ratio, speed))
    return found


GENERATED = struck_columns(8, seed=50)
EVERY = pytest.mark.parametrize("struck", GENERATED, ids=range(len(GENERATED)))


# One mode is one degree of freedom.


def one_mode(pier):
    """A beam of one mode with the mass and stiffness of `pier`."""
    omega, unit = (
        np.array([math.sqrt(pier.stiffness / pier.mass)]),
        np.array([1.0 / math.sqrt(pier.mass)]),
    )
    nothing = np.zeros((1, 1))
    return BeamPier(
        equivalent=pier,
        circular_frequencies=omega,
        impact_deflection=unit,
        z=np.zeros(1),
        deflection=nothing,
        shear=nothing,
        moment=nothing,
    )


def outcome(history):
    cargo = history.cargo_peak
    values = {
        "engine": history.engine_peak.reaction,
        "cargo": cargo.reaction if cargo else None,
        "engine_contact": history.engine_contact_time,
        "cargo_contact": history.cargo_contact_time,
    }
    return {name: math.nan if value is None else value for name, value in values.items()}


ONE_DEGREE = [*collisions(40, seed=51), *HARD.values()]


@pytest.mark.parametrize("case", ONE_DEGREE, ids=range(len(ONE_DEGREE)))
def test_one_mode_is_the_pier_with_one_degree_of_freedom(case):
    truck, pier, speed = case
    expected, found = simulate(truck, pier, speed), simulate(truck, one_mode(pier), speed)
    assert outcome(found) == pytest.approx(outcome(expected), rel=1e-9, nan_ok=True)
    assert found.energy_error < 1e-8
    assert found.momentum_error < 1e-9


def test_the_first_mode_alone_is_the_pier_with_its_mass_and_stiffness():
    beam = round_column(5.0, 0.914).beam(1.2)
    mass = 1.0 / beam.impact_deflection[0] ** 2
    stiffness = mass * beam.circular_frequencies[0] ** 2
    pier = EquivalentPier(mass=mass, stiffness=stiffness)
    names = ("circular_frequencies", "impact_deflection", "deflection", "shear", "moment")
    first = dataclasses.replace(
        beam, equivalent=pier, **{name: getattr(beam, name)[:1] for name in names}
    )
    expected, found = (simulate(TRUCK, struck, 22.2) for struck in (pier, first))
    assert outcome(found) == pytest.approx(outcome(expected), rel=1e-9)
    assert found.member_forces.shear.shape == (len(found.time), len(beam.z))


# What holds for any history.


@EVERY
@pytest.mark.parametrize(
    "holds",
    [
        test_history.test_springs_obey_the_crush_law,
        test_history.test_friction_is_coulombs,
        test_history.test_no_sample_exceeds_the_peaks,
        test_history.test_contacts_are_where_the_crush_first_reaches_d,
    ],
    ids=lambda test: test.__name__.removeprefix("test_"),
)
def test_the_history_is_a_collision(struck, holds):
    holds(struck.case)


@EVERY
def test_energy_and_momentum_are_accounted_for(struck):
    history = simulate(*struck.case)
    assert history.energy_error < 1e-8
    assert history.momentum_error < 1e-9
    given = 0.5 * struck.truck.mass * struck.speed**2
    for lost in (history.energy.crush, history.energy.friction, history.energy.damping):
        assert (np.diff(lost) >= -1e-9 * given).all()


@EVERY
def test_the_beam_keeps_the_impulse_that_its_supports_do_not_take(struck):
    """∫ F dt − ∫ (V(0) − V(H)) dt = m̄ ∫ w' dz, from shear, and from deflection over the height."""
    history = simulate(*struck.case)
    forces, z = history.member_forces, history.member_forces.z
    supports = forces.shear[:, 0] - forces.shear[:, -1]
    taken = integrals(supports, history.time)[-1]
    deflection = history.beam.deflection
    areas = np.sum(0.5 * (deflection[:, 1:] + deflection[:, :-1]) * np.diff(z), axis=1)
    _, rates = history.modal_coordinates
    momentum = struck.column.mass_per_length * rates[-1] @ areas
    assert history.impulse[-1] - taken == pytest.approx(momentum, abs=2e-3 * history.impulse[-1])


def integrals(values, time):
    return np.append(0.0, np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(time)))


@pytest.mark.parametrize("on", ["road", "pier"])
def test_shapes_that_have_died_out_may_be_left_out(on, monkeypatch):
    truck = dataclasses.replace(TRUCK, friction_on=on)
    tall = round_column(16.0, 1.2, top="free").beam(1.2, damping_ratio=0.1)
    found = simulate(truck, tall, 22.2)
    monkeypatch.setattr(pierimpact.collision.beam, "STILL", 0.0)
    expected = simulate(truck, tall, 22.2, duration=found.end.time)
    assert len(found.steps) < 0.6 * len(expected.steps)
    assert outcome(found) == pytest.approx(outcome(expected), rel=1e-10)
    # The last state of all shapes, as the long history has it at that time.
    last = np.searchsorted([state.time for state, _, _ in expected.steps], found.end.time) - 1
    motion, state = expected.modal_steps[last]
    passed = (found.end.time - expected.steps[last][0].time) / motion.step
    coordinates, _ = np.split(motion.coordinates @ motion.propagator(passed) @ state, 2)
    for field, extremes in (
        (tall.shear, found.member_forces.shear_extremes),
        (tall.moment, found.member_forces.moment_extremes),
    ):
        apart = (found.modal_coordinates[0][-1] - coordinates) @ field
        assert np.abs(apart).max() < 1e-9 * abs(extremes.governing.value)


# Shear and moment.


def test_one_degree_of_freedom_has_no_member_forces_in_time():
    assert simulate(TRUCK, round_column(5.0, 0.914).equivalent(1.2), 22.2).member_forces is None


@pytest.mark.parametrize(("base", "top"), ENDS)
def test_under_a_slow_load_they_are_the_static_member_forces(base, top):
    """Two soft springs, of which the plateaus last: after the rise the load stands still."""
    spring = CrushSpring(
        plateau_force=100e3, plateau_length=5.0, stiffness=1e6, unloading_stiffness=1e6
    )
    truck = Truck(
        name="slow",
        engine_mass=6e4,
        body_mass=6e4,
        engine_spring=spring,
        body_spring=spring,
    )
    struck = round_column(5.0, 1.0, base, top)
    history = simulate(truck, struck.beam(1.2, damping_ratio=0.3), 1.0, duration=0.5)
    at = np.searchsorted(history.time, 0.45)
    assert history.contact_force[at] == pytest.approx(200e3)
    found, expected = history.member_forces, struck.member_forces(200e3, 1.2)
    impact = np.flatnonzero(found.z == 1.2)
    corners = [0, *impact, len(found.z) - 1]
    assert found.shear[at, corners] == pytest.approx(expected.shear, rel=0.0, abs=50.0)
    assert found.moment[at, corners] == pytest.approx(expected.moment, rel=0.0, abs=50.0)


@EVERY
def test_envelopes_bound_the_histories(struck):
    history = simulate(*struck.case)
    forces = history.member_forces
    for values, largest, smallest in (
        (forces.shear, forces.largest_shear, forces.smallest_shear),
        (forces.moment, forces.largest_moment, forces.smallest_moment),
    ):
        assert values.shape == (len(history.time), len(forces.z))
        assert (values <= largest).all()
        assert (values >= smallest).all()
        # Envelopes run through the peaks between the samples.
        assert np.abs(largest - values.max(axis=0)).max() < 0.02 * largest.max()
        assert np.abs(smallest - values.min(axis=0)).max() < 0.02 * largest.max()


@pytest.mark.parametrize("struck", GENERATED[:4], ids=range(4))
def test_extremes_are_those_of_a_finer_history_of_more_heights(struck, monkeypatch):
    found = simulate(*struck.case).member_forces
    monkeypatch.setattr(pierimpact.collision.beam_history, "FEWEST", 20)
    monkeypatch.setattr(pierimpact.pier.beam, "INTERVALS", 300)
    fine = simulate(*struck.case).member_forces
    for extremes, values in (
        (found.shear_extremes, fine.shear),
        (found.moment_extremes, fine.moment),
    ):
        scale = np.abs(values).max()
        assert abs(extremes.governing.value) == pytest.approx(scale, rel=3e-4)
        for extreme, expected in (
            (extremes.largest, values.max()),
            (extremes.smallest, values.min()),
        ):
            assert extreme.value == pytest.approx(expected, abs=1e-3 * scale)
            # At its time and height the fine history has this value.
            rows = np.abs(fine.time - extreme.time).argsort()[:3]
            columns = np.abs(fine.z - extreme.z).argsort()[:3]
            near = values[np.ix_(rows, columns)]
            assert np.abs(near - extreme.value).min() < 5e-3 * scale


def governing(history):
    """Shear and moment of the largest magnitude."""
    forces = history.member_forces
    return abs(forces.shear_extremes.governing.value), abs(forces.moment_extremes.governing.value)


# Stiff and short, slender and tall, struck beside a support, at the tip.
EXTREME = [
    Struck(TRUCK, round_column(height, diameter, *ends), impact_height, 0.05, 22.2)
    for height, diameter, ends, impact_height in (
        (3.0, 1.5, ("fixed", "fixed"), 0.4),
        (5.0, 2.5, ("fixed", "pinned"), 1.2),
        (5.0, 0.6, ("pinned", "pinned"), 4.7),
        (20.0, 1.0, ("fixed", "free"), 1.2),
        (6.0, 1.0, ("fixed", "free"), 6.0),
    )
]


@pytest.mark.parametrize("struck", GENERATED + EXTREME, ids=range(len(GENERATED + EXTREME)))
def test_twice_as_many_modes_change_shear_and_moment_by_less_than_half_a_percent(struck):
    truck, beam, speed = struck.case
    twice = 2 * len(beam.frequencies)
    few, many = (simulate(truck, struck.beam(n), speed) for n in (None, twice))
    assert governing(few) == pytest.approx(governing(many), rel=5e-3)
    assert few.governing_peak.reaction == pytest.approx(many.governing_peak.reaction, rel=1e-3)


def test_a_third_of_the_modes_would_not_do():
    apart = []
    for struck in EXTREME[:3]:
        truck, beam, speed = struck.case
        third = struck.beam(max(1, len(beam.frequencies) // 3))
        few, many = (np.array(governing(simulate(truck, b, speed))) for b in (third, beam))
        apart.append(np.abs(few / many - 1.0).max())
    assert np.max(apart) > 5e-3


@pytest.mark.parametrize("struck", GENERATED[:4], ids=range(4))
def test_a_longer_history_shows_no_larger_shear_and_moment(struck):
    history = simulate(*struck.case)
    longer = simulate(*struck.case, duration=2.0 * history.time[-1])
    assert longer.governing_peak == history.governing_peak
    assert governing(longer) == pytest.approx(governing(history), rel=1e-3)


# Against finite elements in small steps of time.

EXAMPLES = [  # height, diameter, ends, speed
    (5.0, 0.914, ("fixed", "pinned"), 80.0 / 3.6),
    (8.0, 1.2, ("fixed", "pinned"), 80.0 / 3.6),
    (6.0, 1.2, ("fixed", "fixed"), 80.0 / 3.6),
    (8.0, 1.2, ("fixed", "free"), 80.0 / 3.6),
    (9.0, 1.5, ("fixed", "free"), 62.0 / 3.6),
]


COLLISIONS = [
    Struck(TRUCK, round_column(height, diameter, *ends), 1.2, 0.05, speed)
    for height, diameter, ends, speed in EXAMPLES
] + struck_columns(4, seed=52)


@pytest.mark.parametrize(
    ("struck", "on"),
    [(struck, ("road", "pier")[number % 2]) for number, struck in enumerate(COLLISIONS)],
    ids=range(len(COLLISIONS)),
)
def test_shear_and_moment_are_those_of_finite_elements(struck, on):
    truck, column = dataclasses.replace(struck.truck, friction_on=on), struck.column
    history = simulate(truck, struck.beam(), struck.speed)
    reference = solve(
        truck,
        column,
        struck.impact_height,
        struck.damping_ratio,
        struck.speed,
        duration=min(0.12, history.time[-1]),
        elements=80,
        step=2e-5,
    )
    forces = history.member_forces
    within = history.time <= reference.time[-1]
    impact = np.flatnonzero(forces.z == struck.impact_height)
    corners = [0, *impact, len(forces.z) - 1]

    def in_between(values):
        return np.interp(reference.time, history.time, values)

    displacement = in_between(history.pier_displacement)
    assert displacement == pytest.approx(
        reference.displacement, rel=0.0, abs=1e-2 * reference.displacement.max()
    )
    for values, expected in ((forces.shear, reference.shear), (forces.moment, reference.moment)):
        largest = np.abs(expected).max()
        assert np.abs(values[within][:, corners]).max() == pytest.approx(largest, rel=3e-3)
        # From instant to instant, but for the fronts of waves, which pass in no time.
        apart = np.stack([in_between(values[:, corner]) for corner in corners], axis=1) - expected
        assert np.quantile(np.abs(apart), 0.99) < 0.01 * largest


def test_a_long_duration_is_no_collision_without_end(monkeypatch):
    # Far more blocks of steps than the limit, in which nothing changes.
    monkeypatch.setattr(pierimpact.collision.beam, "STEPS", 60)
    history = simulate(TRUCK, round_column(5.0, 0.914).beam(1.2, 0.0), 22.2, duration=2.0)
    assert history.end.time >= 2.0
    monkeypatch.setattr(pierimpact.collision.beam, "STEPS", 2)
    with pytest.raises(RuntimeError, match="did not come to an end"):
        simulate(TRUCK, round_column(5.0, 0.914).beam(1.2, 0.0), 22.2)
