"""Piers that yield."""

import dataclasses
import math

import numpy as np
import pytest
from generated_collisions import Case, collisions, side_by_side
from generated_columns import GENERATED, round_column, struck_columns
from hypothesis import given
from hypothesis import strategies as st
from reference import solve

from pierimpact import EquivalentPier, InputError, load_truck, peak_reactions, simulate
from pierimpact.collision import propagation

TRUCK = load_truck("single-unit-8t")


def known(value):
    return math.nan if value is None else value


def yielding(size, seed):
    """Generated collisions whose piers yield, by shares of the elastic reaction.

    A few are undamped, a few all but critically damped. In every fourth the friction on the pier
    can pull it back as far as it yields.
    """
    random = np.random.default_rng(seed)
    cases = []
    for number, (truck, pier, speed) in enumerate(collisions(size, seed)):
        resistance = random.uniform(0.1, 1.0) * simulate(truck, pier, speed).governing_peak.reaction
        if number % 4 == 1:
            friction = random.uniform(50e3, 300e3)
            truck = dataclasses.replace(truck, friction_on="pier", friction_force=friction)
            resistance = random.uniform(0.3, 0.9) * friction
        ratio = {2: 0.0, 5: 0.9}.get(number % 6, pier.damping_ratio)
        pier = dataclasses.replace(pier, damping_ratio=ratio, yield_reaction=resistance)
        cases.append(Case(truck, pier, speed))
    return cases


YIELDING = yielding(24, seed=73)
EVERY = pytest.mark.parametrize("case", YIELDING, ids=[str(n) for n in range(len(YIELDING))])


def of_one(case):
    """What is found of a collision, by `simulate`, by name."""
    history = simulate(*case)
    cargo = history.cargo_peak
    return {
        "engine": history.engine_peak.reaction,
        "cargo": cargo.reaction if cargo else math.nan,
        "engine_time": history.engine_peak.time,
        "cargo_time": cargo.time if cargo else math.nan,
        "engine_contact_time": known(history.engine_contact_time),
        "cargo_contact_time": known(history.cargo_contact_time),
        "ductility": history.ductility,
        "residual_displacement": history.residual_displacement,
        "plastic_energy": history.pier_plastic_energy,
    }


def together(cases):
    """The same by `peak_reactions`, each an array."""
    resistances = [case.pier.yield_reaction for case in cases]
    return peak_reactions(**side_by_side(cases), yield_reaction=resistances)._asdict()


def assert_same(found, expected, cases):
    """Results by name agree but for round-off."""
    # What never yields has no residual displacement.
    elastic = [min(case.pier.yield_reaction / case.pier.stiffness, 1.0) for case in cases]
    energy = np.array([0.5 * case.truck.mass * case.speed**2 for case in cases])
    scales = {
        "residual_displacement": elastic * np.asarray(expected["ductility"]),
        "plastic_energy": energy,
    }
    for name, values in found.items():
        scale = scales.get(name, np.abs(expected[name]))
        # The instant of a flat maximum is known to the root of the maximum's own error.
        rtol = 1e-6 if name in ("engine_time", "cargo_time") else 1e-9
        error = np.abs(np.asarray(values) - expected[name])
        np.testing.assert_array_equal(np.isnan(values), np.isnan(expected[name]), err_msg=name)
        assert not (error > rtol * scale).any(), name


def test_generated_piers_yield_forward_backward_and_again():
    forward, backward, again, stuck = 0, 0, 0, 0
    for case in YIELDING:
        states = [state for state, _, _ in simulate(*case).steps]
        each = [state.yielding.direction for state in states]
        starts = [b for a, b in zip([0.0, *each], each, strict=False) if b not in (0.0, a)]
        forward, backward = forward + (1.0 in starts), backward + (-1.0 in starts)
        again += len(starts) > 1
        on_pier = case.truck.friction_on == "pier"
        stuck += any(on_pier and state.stuck and state.yielding.direction for state in states)
    assert forward >= 20
    assert backward >= 2
    assert again >= 5
    assert stuck >= 1


# Against the independent solution.


@pytest.mark.parametrize("number", range(12))
def test_results_are_those_of_the_reference(number):
    case = YIELDING[number]
    pier, reference, found = case.pier, solve(*case), of_one(case)
    assert reference.energy_error < 1e-8
    assert reference.momentum_error < 1e-8
    expected = {
        "engine": reference.engine,
        "cargo": reference.cargo,
        "engine_contact_time": reference.engine_contact_time,
        "cargo_contact_time": reference.cargo_contact_time,
        "ductility": reference.largest_displacement * pier.stiffness / pier.yield_reaction,
    }
    assert {name: found[name] for name in expected} == pytest.approx(
        expected, rel=1e-7, nan_ok=True
    )
    displacement, energy = reference.largest_displacement, 0.5 * case.truck.mass * case.speed**2
    assert found["residual_displacement"] == pytest.approx(
        reference.plastic_displacement, rel=0.0, abs=1e-7 * displacement
    )
    assert found["plastic_energy"] == pytest.approx(
        reference.plastic_work, rel=0.0, abs=1e-7 * energy
    )
    if pier.damping_ratio > 0.0:  # else later maxima are equal but for the reference's error
        times = {"engine_time": reference.engine_time, "cargo_time": reference.cargo_time}
        assert {name: found[name] for name in times} == pytest.approx(times, rel=1e-6, nan_ok=True)


# Limits.


@pytest.mark.parametrize("case", collisions(20, seed=61))
def test_a_pier_that_is_strong_enough_is_elastic(case):
    elastic = simulate(*case)
    demand = np.abs(elastic.reaction).max()
    resistance = max(demand, elastic.governing_peak.reaction) * (1.0 + 1e-9)
    strong = simulate(
        case.truck, dataclasses.replace(case.pier, yield_reaction=resistance), case.speed
    )
    for peak, same in zip(strong.peaks.values(), elastic.peaks.values(), strict=True):
        assert peak == (None if same is None else pytest.approx(same, rel=1e-11))
    assert strong.residual_displacement == strong.pier_plastic_energy == 0.0
    assert strong.ductility == pytest.approx(1.0, rel=1e-3)
    assert strong.ductility <= 1.0
    assert elastic.ductility == elastic.residual_displacement == elastic.pier_plastic_energy == 0.0
    infinite = together([case])
    assert [infinite[name].item() for name in ("ductility", "plastic_energy")] == [0.0, 0.0]


@pytest.mark.parametrize("resistance", [1e16, 1e18, 1e30])
def test_a_pier_that_is_beyond_strong_is_hardly_strained(resistance):
    mass, stiffness = 8e3, 1e8
    pier = EquivalentPier(mass=mass, stiffness=stiffness, yield_reaction=resistance)
    history = simulate(TRUCK, pier, 22.2)
    expected = np.abs(history.reaction).max() / resistance
    assert history.ductility == pytest.approx(expected, rel=1e-3)
    peaks = peak_reactions(TRUCK, mass, stiffness, pier.damping_ratio, 22.2, resistance)
    assert peaks.ductility == pytest.approx(history.ductility, rel=1e-9)


@pytest.mark.parametrize("case", collisions(2, seed=62))
def test_a_rigid_plastic_pier_stops_the_truck_at_its_resistance(case):
    """JCSS Probabilistic Model Code 2.18: a force F_y for a time m v/F_y, in total momentum."""
    truck, _, speed = dataclasses.replace(case.truck, friction_force=0.0), *case[1:]
    # Hardly any mass, so that the pier's resistance is the force on the truck, which it does not
    # crush.
    resistance = 0.4 * min(truck.engine_spring.plateau_force, truck.body_spring.plateau_force)
    pier = EquivalentPier(mass=150.0, stiffness=1e10, damping_ratio=0.0, yield_reaction=resistance)
    history = simulate(truck, pier, speed)
    stop, momentum = truck.mass * speed / resistance, truck.mass * speed
    energy = 0.5 * momentum * speed
    assert history.engine_contact_time is None
    assert history.cargo_contact_time is None
    assert history.governing_peak.reaction == pytest.approx(resistance, rel=1e-12)
    velocity = history.engine_velocity * truck.engine_mass + history.body_velocity * truck.body_mass
    still = history.time[np.argmax(velocity <= 1e-3 * momentum)]
    assert still == pytest.approx(stop, rel=2e-2)
    at_stop = np.interp(stop, history.time, history.impulse)
    assert at_stop == pytest.approx(momentum, rel=2e-2)
    assert history.energy.crush[-1] < 2e-2 * energy
    assert history.pier_plastic_energy == pytest.approx(energy, rel=2e-2)
    assert history.residual_displacement == pytest.approx(energy / resistance, rel=2e-2)


# Invariants.


@EVERY
def test_energy_and_momentum_are_accounted_for(case):
    history, (truck, pier, speed) = simulate(*case), case
    assert history.energy_error < 1e-11
    assert history.momentum_error < 1e-11
    given = 0.5 * truck.mass * speed**2
    plastic = history.pier_displacement - history.reaction / pier.stiffness
    work = np.append(0.0, np.cumsum(np.abs(np.diff(plastic)))) * pier.yield_reaction
    np.testing.assert_allclose(history.energy.pier_plastic, work, rtol=0.0, atol=1e-10 * given)
    strain = 0.5 * history.reaction**2 / pier.stiffness
    np.testing.assert_allclose(history.energy.pier_elastic, strain, rtol=0.0, atol=1e-10 * given)
    assert (np.diff(history.energy.pier_plastic) >= -1e-12 * given).all()
    assert history.pier_plastic_energy == history.energy.pier_plastic[-1]
    assert history.energy.damping[-1] >= -1e-12 * given


@EVERY
def test_the_reaction_follows_from_the_displacement_alone(case):
    """The elastic–perfectly plastic law once more, step by step from sample to sample."""
    history, pier = simulate(*case), case.pier
    resistance, reaction, expected = pier.yield_reaction, 0.0, [0.0]
    for step in np.diff(history.pier_displacement).tolist():
        reaction = min(max(reaction + pier.stiffness * step, -resistance), resistance)
        expected.append(reaction)
    round_off = 1e-12 * pier.stiffness * np.abs(history.pier_displacement).max()
    np.testing.assert_allclose(
        history.reaction, expected, rtol=0.0, atol=round_off + 1e-9 * resistance
    )
    assert np.abs(history.reaction).max() <= resistance
    assert history.governing_peak.reaction <= resistance
    plastic = history.pier_displacement[-1] - history.reaction[-1] / pier.stiffness
    largest = history.ductility * resistance / pier.stiffness
    assert history.residual_displacement == pytest.approx(plastic, rel=0.0, abs=1e-9 * largest)
    assert np.abs(history.pier_displacement).max() <= largest * (1.0 + 1e-12)
    assert np.abs(history.pier_displacement).max() >= largest * (1.0 - 5e-3)


@EVERY
def test_the_impulse_is_the_integral_of_the_contact_force(case):
    history, truck = simulate(*case), case.truck
    if truck.friction_on == "pier":  # the force jumps
        return
    force = history.contact_force
    impulse = np.append(0.0, np.cumsum(np.diff(history.time) * (force[:-1] + force[1:]) / 2.0))
    momentum = truck.mass * case.speed
    np.testing.assert_allclose(history.impulse, impulse, rtol=0.0, atol=2e-3 * momentum)


@EVERY
def test_a_longer_history_shows_nothing_new(case):
    found = of_one(case)
    longer = simulate(*case, duration=3.0 * simulate(*case).time[-1])
    assert longer.ductility == pytest.approx(found["ductility"], rel=1e-9)
    largest = found["ductility"] * case.pier.yield_reaction / case.pier.stiffness
    assert longer.residual_displacement == pytest.approx(
        found["residual_displacement"], rel=0.0, abs=1e-9 * largest
    )
    assert longer.governing_peak.reaction == pytest.approx(
        max(found["engine"], np.nan_to_num(found["cargo"])), rel=1e-9
    )


# Many at a time.


def test_many_are_as_each_alone():
    cases = [*YIELDING, *collisions(20, seed=63)]  # some never yield
    alone = [of_one(case) for case in cases]
    expected = {name: np.array([each[name] for each in alone]) for name in alone[0]}
    found = together(cases)
    assert_same(found, expected, cases)
    order = np.random.default_rng(64).permutation(np.repeat(np.arange(len(cases)), 20))
    many = together([cases[number] for number in order])
    again = {name: values[order] for name, values in found.items()}
    assert_same(many, again, [cases[number] for number in order])
    for number in (0, 5, 9, 31):
        one = together(cases[number : number + 1])
        assert_same(one, {k: v[number : number + 1] for k, v in found.items()}, [cases[number]])


def test_a_yield_reaction_is_an_axis():
    resistance = np.array([[1e6], [3e6], [np.inf]])
    peaks = peak_reactions(TRUCK, 8e3, [100e6, 300e6], 0.05, 22.2, yield_reaction=resistance)
    assert {values.shape for values in peaks} == {(3, 2)}
    elastic = peak_reactions(TRUCK, 8e3, [100e6, 300e6], 0.05, 22.2)
    np.testing.assert_allclose(peaks.governing[2], elastic.governing, rtol=1e-12)
    np.testing.assert_array_equal(peaks.ductility[2], 0.0)
    assert (peaks.governing <= resistance).all()
    assert (np.diff(peaks.plastic_energy, axis=0) < 0.0).all()


def held_by_friction(size, seed):
    """Generated collisions with friction that can hold the truck against a pier that yields."""
    random, cases = np.random.default_rng(seed), []
    generated = collisions(size, seed)
    elastic = peak_reactions(**side_by_side(generated)).governing
    for (truck, pier, speed), peak in zip(generated, elastic, strict=True):
        friction_on, friction = random.choice(["road", "pier"]), random.uniform(20e3, 400e3)
        truck = dataclasses.replace(truck, friction_on=friction_on, friction_force=friction)
        resistance = max(0.02 * peak, random.uniform(0.1, 0.9) * friction)
        ratio = random.choice([0.01, 0.05, 0.2, 0.9])
        pier = dataclasses.replace(pier, damping_ratio=ratio, yield_reaction=resistance)
        cases.append(Case(truck, pier, speed))
    return cases


def test_the_steps_are_few(monkeypatch):
    """Also where a body at rest pushes the pier ever more slowly, or an engine comes slowly."""
    monkeypatch.setattr(propagation, "STEPS", 600)
    assert (together(held_by_friction(200, seed=80))["ductility"] > 1.0).sum() > 150


def test_a_creeping_pier_comes_to_rest_under_its_resistance():
    creeping, random = 0, np.random.default_rng(76)
    for truck, _, speed in collisions(12, seed=76):
        friction, mass = random.uniform(300e3, 500e3), random.uniform(20e3, 100e3)
        truck = dataclasses.replace(truck, friction_on="road", friction_force=friction)
        resistance = random.uniform(0.1, 0.4) * friction
        stiffness = mass * (2.0 * math.pi * random.uniform(20.0, 60.0)) ** 2
        pier = EquivalentPier(
            mass=mass,
            stiffness=stiffness,
            damping_ratio=random.uniform(0.3, 0.9),
            yield_reaction=resistance,
        )
        case = Case(truck, pier, speed)
        history = simulate(*case)
        if history.end.yielding.direction == 0.0:
            continue
        creeping += 1
        assert history.energy_error < 1e-11
        # The impulses of pier and road add up over a long time.
        impulses = 1.0 + resistance * history.time[-1] / (truck.mass * speed)
        assert history.momentum_error < 1e-11 * impulses
        largest = history.pier_displacement[-1]
        round_off = 1e-10 * (truck.body_spring.unloading_stiffness * largest + resistance)
        assert history.body_force[-1] == pytest.approx(resistance, rel=0.0, abs=round_off)
        assert abs(history.body_velocity[-1]) < 1e-9 * speed
        assert (np.diff(history.pier_displacement[-1000:]) >= -1e-15 * largest).all()
        found = together([case])
        assert found["residual_displacement"] == pytest.approx(
            history.residual_displacement, rel=1e-9
        )
    assert creeping >= 3


# The resistance of a column.


@GENERATED
@given(struck_columns(), st.floats(1e3, 1e9))
def test_the_largest_moment_at_yielding_is_the_resistance(struck, resistance):
    column, height = struck
    reaction = column.struck_at(height).yield_reaction(resistance)
    forces = column.member_forces(reaction, height)
    assert abs(forces.largest_moment.value) == pytest.approx(resistance, rel=1e-12)
    assert np.abs(forces.moment).max() <= resistance * (1.0 + 1e-12)


@given(st.floats(0.1, 5.9))
def test_a_cantilever_yields_at_its_base(height):
    struck = round_column(6.0, 1.0, "fixed", "free").struck_at(height)
    assert struck.yield_reaction(4e6) == pytest.approx(4e6 / height, rel=1e-12)
    between_pins = round_column(6.0, 1.0, "pinned", "pinned").struck_at(height)
    moment = height * (6.0 - height) / 6.0
    assert between_pins.yield_reaction(4e6) == pytest.approx(4e6 / moment, rel=1e-12)


# Bad inputs.


def test_a_beam_does_not_yield():
    beam = round_column(5.0, 1.0).beam(1.2)
    pier = dataclasses.replace(beam.equivalent, yield_reaction=2e6)
    message = (
        "^pier must be an EquivalentPier where it yields, for a BeamPier is elastic, got a "
        r"BeamPier with yield_reaction 2e\+06 N$"
    )
    with pytest.raises(InputError, match=message):
        simulate(TRUCK, dataclasses.replace(beam, equivalent=pier), 22.2)


def test_a_moment_resistance_is_positive():
    with pytest.raises(InputError, match=r"^moment_resistance must be positive, got 0$"):
        round_column(5.0, 1.0).struck_at(1.2).yield_reaction(0.0)
