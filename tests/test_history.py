import dataclasses
import math

import numpy as np
import pytest
from generated_collisions import HARD, collisions
from scipy.interpolate import BPoly

from pierimpact import EquivalentPier, load_truck, simulate

GENERATED = collisions(100, seed=30)
EVERY = pytest.mark.parametrize(
    "case",
    [*GENERATED, *HARD.values()],
    ids=[*(f"generated {number}" for number in range(len(GENERATED))), *HARD],
)

ARRAYS = (
    "time",
    "reaction",
    "contact_force",
    "pier_displacement",
    "pier_velocity",
    "engine_crush",
    "engine_velocity",
    "engine_force",
    "body_crush",
    "body_velocity",
    "body_force",
    "friction_force",
)


@EVERY
def test_arrays_begin_at_first_touch_and_belong_together(case):
    history = simulate(*case)
    assert {getattr(history, name).shape for name in ARRAYS} == {history.time.shape}
    assert all(np.isfinite(getattr(history, name)).all() for name in ARRAYS)
    assert history.time[0] == 0.0
    assert (np.diff(history.time) > 0.0).all()
    for name in ("pier_displacement", "pier_velocity", "engine_crush", "body_crush"):
        assert getattr(history, name)[0] == 0.0
    for name in ("engine_velocity", "body_velocity"):
        assert getattr(history, name)[0] == pytest.approx(case.speed, rel=1e-14)
    np.testing.assert_array_equal(history.reaction, case.pier.stiffness * history.pier_displacement)


@EVERY
def test_springs_obey_the_crush_law(case):
    """The forces again, from nothing but the crush up to each instant."""
    history, truck = simulate(*case), case.truck
    for spring, crush, force in (
        (truck.engine_spring, history.engine_crush, history.engine_force),
        (truck.body_spring, history.body_crush, history.body_force),
    ):
        # Loading below P/k_u is a ride on the unloading line from there.
        largest = np.maximum(np.maximum.accumulate(crush), spring.elastic_limit)
        line = spring.envelope(largest) - spring.unloading_stiffness * (largest - crush)
        round_off = 1e-12 * spring.unloading_stiffness * largest[-1]
        np.testing.assert_allclose(force, np.maximum(line, 0.0), rtol=0.0, atol=round_off)


def path_under_friction(history):
    """What the body has slid over: the road, or the pier [m]."""
    if history.truck.friction_on == "pier":
        return history.body_crush
    return history.body_crush + history.pier_displacement


@EVERY
def test_friction_is_coulombs(case):
    history, truck = simulate(*case), case.truck
    limit, friction = truck.friction_force, history.friction_force
    on_pier = truck.friction_on == "pier"
    total = history.engine_force + history.body_force
    before, after = history.contact_force_beside
    np.testing.assert_array_equal(after, total + on_pier * friction)
    # It jumps by friction alone, and then counts with the larger value.
    np.testing.assert_array_equal(history.contact_force, np.maximum(before, after))
    jumps = np.abs(before - after)
    assert jumps.max() <= 2.0 * on_pier * limit + 1e-9 * after.max()
    assert (np.abs(friction) <= limit * (1.0 + 1e-9)).all()

    # A sample's friction is that of the interval which it begins.
    friction, path = friction[:-1], path_under_friction(history)
    slid = np.diff(path)
    sliding = np.abs(slid) > 1e-12 * np.abs(path).max()
    if on_pier:
        contact = np.maximum(history.body_force[:-1], history.body_force[1:])
        np.testing.assert_array_equal(friction[contact == 0.0], 0.0)
        sliding &= contact > 1e-9 * truck.body_spring.plateau_force
    np.testing.assert_allclose(friction[sliding], limit * np.sign(slid[sliding]), rtol=1e-12)
    velocity = history.body_velocity - on_pier * history.pier_velocity
    held = (np.abs(friction) > 0.0) & (np.abs(friction) < limit * (1.0 - 1e-9))
    assert np.abs(velocity[:-1][held]).max(initial=0.0) <= 1e-9 * case.speed


@EVERY
def test_energy_and_momentum_are_accounted_for(case):
    history, (truck, pier, speed) = simulate(*case), case
    assert history.energy_error < 1e-8
    assert history.momentum_error < 1e-8
    energy, given = history.energy, 0.5 * truck.mass * speed**2
    moving = (
        truck.engine_mass * history.engine_velocity**2
        + truck.body_mass * history.body_velocity**2
        + pier.mass * history.pier_velocity**2
    )
    springs = (
        (truck.engine_spring, history.engine_crush, history.engine_force),
        (truck.body_spring, history.body_crush, history.body_force),
    )
    rubbed = history.friction_force[:-1] * np.diff(path_under_friction(history))
    expected = {
        "kinetic": 0.5 * moving,
        "pier_elastic": 0.5 * pier.stiffness * history.pier_displacement**2,
        "truck_elastic": sum(0.5 * f**2 / s.unloading_stiffness for s, _, f in springs),
        "crush": sum(s.dissipated(np.maximum.accumulate(crush)) for s, crush, _ in springs),
        "friction": np.append(0.0, np.cumsum(rubbed)),
    }
    for name, share in expected.items():
        np.testing.assert_allclose(getattr(energy, name), share, rtol=0.0, atol=1e-10 * given)
    # What is left goes into the damper: the balance closes by its own integral.
    for lost in (energy.crush, energy.friction, energy.damping):
        assert abs(lost[0]) <= 1e-12 * given
        assert (np.diff(lost) >= -1e-12 * given).all()
    np.testing.assert_allclose(energy.total, given, rtol=1e-8)


@EVERY
def test_no_sample_exceeds_the_peaks(case):
    history = simulate(*case)
    contact = history.cargo_contact_time
    before = history.time < (math.inf if contact is None else contact)
    peaks = [(history.engine_peak, history.reaction[before])]
    if history.cargo_peak:
        peaks.append((history.cargo_peak, history.reaction[~before]))
    for peak, samples in peaks:
        assert samples.max() <= peak.reaction * (1.0 + 1e-12)


@EVERY
def test_peaks_lie_on_the_history(case):
    # Friction on the road, for the pier's acceleration not to jump.
    truck, pier, speed = dataclasses.replace(case.truck, friction_on="road"), *case[1:]
    history = simulate(truck, pier, speed)
    load = history.contact_force - pier.damping * history.pier_velocity - history.reaction
    motion = [history.pier_displacement, history.pier_velocity, load / pier.mass]
    drawn = BPoly.from_derivatives(history.time, np.transpose(motion))
    for peak in (history.engine_peak, history.cargo_peak):
        if peak:
            assert pier.stiffness * drawn(peak.time) == pytest.approx(peak.reaction, rel=1e-8)
    if history.cargo_peak:
        assert history.engine_peak.time <= history.cargo_contact_time <= history.cargo_peak.time


@EVERY
def test_contacts_are_where_the_crush_first_reaches_d(case):
    history, truck = simulate(*case), case.truck
    for spring, crush, contact in (
        (truck.engine_spring, history.engine_crush, history.engine_contact_time),
        (truck.body_spring, history.body_crush, history.cargo_contact_time),
    ):
        length = spring.plateau_length
        if contact is None:
            assert crush.max() < length
        else:
            assert crush[history.time < contact].max() < length
            at = np.argmin(np.abs(history.time - contact))
            assert history.time[at] == pytest.approx(contact, rel=1e-12)
            assert crush[at] == pytest.approx(length, rel=1e-12)


@EVERY
def test_a_longer_history_shows_nothing_new(case):
    history = simulate(*case)
    end = history.time[-1]
    shorter, longer = (simulate(*case, duration=factor * end) for factor in (0.5, 3.0))
    assert shorter.time[-1] == end
    assert longer.time[-1] >= 3.0 * end
    for other in (shorter, longer):
        assert other.engine_peak == history.engine_peak
        assert other.cargo_peak == history.cargo_peak
        assert other.engine_contact_time == history.engine_contact_time
        assert other.cargo_contact_time == history.cargo_contact_time
        assert other.energy_error < 1e-8
        assert other.momentum_error < 1e-8


def test_a_truck_that_has_left_flies_freely_and_the_pier_rings_on():
    left = 0
    for case in collisions(30, seed=31):
        truck, pier, speed = dataclasses.replace(case.truck, friction_force=0.0), *case[1:]
        history = simulate(truck, pier, speed, duration=1.5)
        pushed = np.flatnonzero(history.contact_force > 0.0)[-1]
        time = history.time[pushed + 1 :] - history.time[pushed + 1]
        if len(time) < 20:
            continue
        left += 1
        for crush, velocity in (
            (history.engine_crush, history.engine_velocity),
            (history.body_crush, history.body_velocity),
        ):
            path = (crush + history.pier_displacement)[pushed + 1 :]
            np.testing.assert_allclose(velocity[pushed + 1 :], velocity[pushed + 1], rtol=1e-12)
            np.testing.assert_allclose(
                path, path[0] + velocity[-1] * time, rtol=0.0, atol=1e-12 * speed
            )
        zeta, omega = pier.damping_ratio, math.sqrt(pier.stiffness / pier.mass)
        damped = omega * math.sqrt(1.0 - zeta**2)
        x, v = history.pier_displacement[pushed + 1], history.pier_velocity[pushed + 1]
        ringing = np.exp(-zeta * omega * time) * (
            x * np.cos(damped * time) + (v + zeta * omega * x) / damped * np.sin(damped * time)
        )
        np.testing.assert_allclose(
            history.pier_displacement[pushed + 1 :],
            ringing,
            rtol=0.0,
            atol=1e-10 * np.abs(history.pier_displacement).max(),
        )
    assert left >= 10


@pytest.mark.parametrize("case", GENERATED[::3])
def test_the_pier_never_swings_further_back_than_is_said(case):
    longer, history = 0.0, simulate(*case)
    while not history.has_swung_back:
        longer = history.time[-1] + 1.0 / case.pier.frequency
        history = simulate(*case, longer)
    lowest = history.lowest
    far = simulate(*case, 2.0 * history.time[-1] + 5.0 / case.pier.frequency)
    fine = far.reaction_at(np.linspace(0.0, far.time[-1], 200_001))
    largest = far.governing_peak.reaction
    assert lowest.reaction <= fine.min() + 1e-6 * largest
    assert history.reaction_at([lowest.time]) == pytest.approx(lowest.reaction, rel=1e-9, abs=1e-3)
    assert lowest.reaction <= 0.0


def test_a_pier_that_has_not_swung_back_is_known():
    # The truck still presses as its last peak is over.
    truck = dataclasses.replace(load_truck("tractor-trailer-36t"), friction_force=0.0)
    pier = EquivalentPier.from_frequency(mass=160e3, frequency=3.4, damping_ratio=0.05)
    history = simulate(truck, pier, 25.0)
    assert not history.has_swung_back
    assert simulate(truck, pier, 25.0, duration=5.0).has_swung_back
    assert simulate(truck, pier, 25.0, duration=5.0).lowest.reaction < history.lowest.reaction
