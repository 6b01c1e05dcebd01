import dataclasses
import math

import numpy as np
import pytest
from generated_collisions import HARD, Case, collisions
from reference import solve

from pierimpact import EquivalentPier, InputError, load_truck, peak_reactions, simulate

SPREAD = collisions(80, seed=3)
TRUCK = load_truck("single-unit-8t")
PIER = EquivalentPier(mass=8e3, stiffness=8e3 * (2.0 * math.pi * 30.0) ** 2, damping_ratio=0.05)


def spring_of(truck, which):
    return truck.engine_spring if which == "engine" else truck.body_spring


def mass_of(truck, which):
    return truck.engine_mass if which == "engine" else truck.body_mass


def lost_before_contact(truck, which):
    """Energy that a mass has left in plateau and friction when its crush reaches d."""
    spring = spring_of(truck, which)
    friction = truck.friction_force if which == "body" else 0.0
    plateau = spring.plateau_force * (spring.plateau_length - 0.5 * spring.elastic_limit)
    return plateau + friction * spring.plateau_length


# Against the independent solution.


@pytest.mark.parametrize(
    "case",
    [*SPREAD, *HARD.values()],
    ids=[*(f"generated {number}" for number in range(len(SPREAD))), *HARD],
)
def test_peaks_and_contacts_are_those_of_the_reference(case):
    history, reference = simulate(*case), solve(*case)
    # The reference is itself sound.
    assert reference.energy_error < 1e-9
    assert reference.momentum_error < 1e-9

    def known(value):
        return math.nan if value is None else value

    cargo = history.cargo_peak
    found = {
        "engine": history.engine_peak.reaction,
        "cargo": cargo.reaction if cargo else math.nan,
        "engine_contact_time": known(history.engine_contact_time),
        "cargo_contact_time": known(history.cargo_contact_time),
    }
    expected = {name: getattr(reference, name) for name in found}
    assert found == pytest.approx(expected, rel=1e-8, nan_ok=True)
    # A flat maximum; of the equal ones of an undamped pier both take the first.
    assert history.engine_peak.time == pytest.approx(reference.engine_time, rel=1e-6)
    if cargo:
        assert cargo.time == pytest.approx(reference.cargo_time, rel=1e-6)


def test_generated_collisions_show_every_outcome():
    histories = [simulate(*case) for case in SPREAD]
    met = {(h.engine_contact_time is None, h.cargo_contact_time is None) for h in histories}
    assert met == {(False, False), (False, True), (True, False), (True, True)}


# Closed forms.


@pytest.mark.parametrize("case", collisions(24, seed=21))
def test_plateaus_push_the_pier_as_a_constant_force(case):
    truck, pier, speed = case
    rigid_elastic = {"unloading_stiffness": 1e12}  # the plateaus begin at once
    truck = dataclasses.replace(
        truck,
        engine_spring=dataclasses.replace(truck.engine_spring, **rigid_elastic),
        body_spring=dataclasses.replace(truck.body_spring, **rigid_elastic),
    )
    history = simulate(truck, pier, speed)
    crushing = (
        (history.engine_velocity > history.pier_velocity)
        & (history.body_velocity > history.pier_velocity)
        & (history.engine_crush < truck.engine_spring.plateau_length)
        & (history.body_crush < truck.body_spring.plateau_length)
    )
    until = np.argmin(crushing)
    assert until > 2
    force = truck.engine_spring.plateau_force + truck.body_spring.plateau_force
    if truck.friction_on == "pier":
        force += truck.friction_force
    zeta, time = pier.damping_ratio, history.time[:until]
    omega = math.sqrt(pier.stiffness / pier.mass)
    damped = omega * math.sqrt(1.0 - zeta**2)
    decay = np.exp(-zeta * omega * time)
    swing = np.cos(damped * time) + zeta / math.sqrt(1.0 - zeta**2) * np.sin(damped * time)
    # The elastic rise withholds at most P for P/k_u at half the speed; an impulse I moves the
    # reaction by no more than I ω_p/√(1 − ζ²).
    withheld = sum(
        spring.plateau_force * spring.elastic_limit / (0.5 * speed)
        for spring in (truck.engine_spring, truck.body_spring)
    )
    bound = withheld * omega / math.sqrt(1.0 - zeta**2)
    np.testing.assert_allclose(
        history.reaction[:until], force * (1.0 - decay * swing), rtol=0.0, atol=bound
    )


@pytest.mark.parametrize("case", collisions(16, seed=22))
def test_rigid_pier_feels_the_spring_force_of_the_energy_balance(case):
    truck, _, speed = case
    # Restitution 1, so that the force turns smoothly; at ζ = √½ a pier of frequency ω follows
    # a force of frequency ω_i but for ½ (ω_i/ω)⁴.
    truck = dataclasses.replace(
        truck,
        friction_on="road",
        engine_spring=dataclasses.replace(
            truck.engine_spring, unloading_stiffness=truck.engine_spring.stiffness
        ),
        body_spring=dataclasses.replace(
            truck.body_spring, unloading_stiffness=truck.body_spring.stiffness
        ),
    )
    rigid = 2.0 * math.pi * 5e3
    pier = EquivalentPier(mass=1e6, stiffness=1e6 * rigid**2, damping_ratio=math.sqrt(0.5))
    history = simulate(truck, pier, speed)

    def force_at_turn(which):
        """From ½ m v² = (P + c_s) s + ½ k s² beyond d."""
        spring, mass = spring_of(truck, which), mass_of(truck, which)
        friction = truck.friction_force if which == "body" else 0.0
        left = 0.5 * mass * speed**2 - lost_before_contact(truck, which)
        if left < 0.0:
            return None
        resisting = spring.plateau_force + friction
        return math.sqrt(resisting**2 + 2.0 * spring.stiffness * left) - friction

    engine, cargo = force_at_turn("engine"), force_at_turn("body")
    assert (history.engine_contact_time is None) == (engine is None)
    assert (history.cargo_contact_time is None) == (cargo is None)
    if engine is not None:
        body = truck.body_spring.plateau_force
        softness = truck.engine_spring.stiffness / (truck.engine_mass * rigid**2)
        give = truck.engine_spring.stiffness / pier.stiffness
        assert history.engine_peak.reaction == pytest.approx(engine + body, rel=softness**2 + give)
    if cargo is not None:  # by then the engine has left
        softness = truck.body_spring.stiffness / (truck.body_mass * rigid**2)
        give = truck.body_spring.stiffness / pier.stiffness
        assert history.cargo_peak.reaction == pytest.approx(cargo, rel=softness**2 + give)


HEAVY = EquivalentPier(mass=1e9, stiffness=1e9 * (2.0 * math.pi * 200.0) ** 2)


@pytest.mark.parametrize("case", collisions(20, seed=23))
@pytest.mark.parametrize("which", ["engine", "body"])
def test_rebound_from_a_rigid_pier(case, which):
    truck = dataclasses.replace(case.truck, friction_force=0.0)
    spring, mass = spring_of(truck, which), mass_of(truck, which)
    left = 2.0 * lost_before_contact(truck, which) / mass
    speed = math.sqrt(left + case.speed**2)  # so that it arrives at case.speed
    history = simulate(truck, HEAVY, speed, duration=2.0)
    velocity = history.engine_velocity if which == "engine" else history.body_velocity
    force = history.engine_force if which == "engine" else history.body_force
    assert force[-1] == 0.0
    # Restitution √(k/k_u) of the steep part; the plateau's own elastic energy comes on top.
    elastic = spring.plateau_force**2 / (spring.unloading_stiffness * mass)
    rebound = math.sqrt((spring.restitution * case.speed) ** 2 + elastic)
    give = spring.unloading_stiffness / HEAVY.stiffness + mass / HEAVY.mass
    assert velocity[-1] == pytest.approx(-rebound, rel=20.0 * give)


@pytest.mark.parametrize("case", collisions(20, seed=24))
@pytest.mark.parametrize("which", ["engine", "body"])
def test_contact_is_made_where_the_energy_reaches(case, which):
    truck = case.truck
    least = math.sqrt(2.0 * lost_before_contact(truck, which) / mass_of(truck, which))
    below, above = (simulate(truck, HEAVY, least * factor) for factor in (1.0 - 1e-6, 1.0 + 1e-6))
    name = "engine_contact_time" if which == "engine" else "cargo_contact_time"
    assert getattr(below, name) is None
    assert getattr(above, name) is not None
    assert which == "engine" or (below.cargo_peak is None and above.cargo_peak is not None)


# The reference truck's figures.


@pytest.mark.parametrize(
    ("friction", "engine", "engine_time", "contact", "cargo", "cargo_time"),
    [
        (0.0, 2.702453, 36.7, 101.61, 4.925271, 133.9),
        (21.5e3, None, None, 102.64, 4.881359, None),
    ],
)
def test_figures_of_the_reference_truck(friction, engine, engine_time, contact, cargo, cargo_time):
    truck = dataclasses.replace(TRUCK, friction_force=friction)
    history = simulate(truck, PIER, speed=80.0 / 3.6)
    # Each to half its last digit.
    assert history.cargo_contact_time * 1e3 == pytest.approx(contact, abs=5e-3)
    assert history.cargo_peak.reaction / 1e6 == pytest.approx(cargo, abs=5e-7)
    if engine:
        assert history.engine_peak.reaction / 1e6 == pytest.approx(engine, abs=5e-7)
        assert history.engine_peak.time * 1e3 == pytest.approx(engine_time, abs=5e-2)
        assert history.cargo_peak.time * 1e3 == pytest.approx(cargo_time, abs=5e-2)


def test_reference_truck_makes_no_contact_at_20_km_h():
    history = simulate(TRUCK, PIER, speed=20.0 / 3.6)
    assert history.engine_contact_time is None
    assert history.cargo_contact_time is None
    assert history.cargo_peak is None
    assert history.governing_peak == history.engine_peak
    assert history.engine_peak.reaction / 1e6 == pytest.approx(1.203002, abs=5e-7)


@pytest.mark.parametrize("mass", [8e3, 40e3])
def test_governing_peak_is_the_larger(mass):
    for stiffness in np.geomspace(1e6, 1e10, 9):
        pier = EquivalentPier(mass=8e3, stiffness=stiffness)
        history = simulate(TRUCK.loaded_to(mass), pier, speed=25.0)
        reactions = [history.engine_peak.reaction, history.cargo_peak.reaction]
        assert history.governing_peak.reaction == max(reactions)
        peaks = peak_reactions(TRUCK.loaded_to(mass), 8e3, stiffness, 0.05, 25.0)
        assert peaks.governing == max(peaks.engine, peaks.cargo)


# Dimensional similarity.


def scaled(case, mass, length, time):
    """The same collision in other units of mass, length and time."""
    force, stiffness = mass * length / time**2, mass / time**2
    truck, pier, speed = case

    def other(spring):
        return dataclasses.replace(
            spring,
            plateau_force=force * spring.plateau_force,
            plateau_length=length * spring.plateau_length,
            stiffness=stiffness * spring.stiffness,
            unloading_stiffness=stiffness * spring.unloading_stiffness,
        )

    truck = dataclasses.replace(
        truck,
        engine_mass=mass * truck.engine_mass,
        body_mass=mass * truck.body_mass,
        engine_spring=other(truck.engine_spring),
        body_spring=other(truck.body_spring),
        friction_force=force * truck.friction_force,
    )
    pier = dataclasses.replace(pier, mass=mass * pier.mass, stiffness=stiffness * pier.stiffness)
    return Case(truck, pier, speed * length / time)


@pytest.mark.parametrize(("mass", "length", "time"), [(0.03, 1, 1), (1, 20, 1), (1, 1, 0.07)])
def test_similar_collisions_have_similar_peaks(mass, length, time):
    force = mass * length / time**2
    for case in SPREAD[:20]:
        one, other = simulate(*case), simulate(*scaled(case, mass, length, time))
        scales = [(one.engine_peak, other.engine_peak), (one.cargo_peak, other.cargo_peak)]
        for peak, similar in scales:
            assert (peak is None) == (similar is None)
            if peak:
                assert similar.reaction == pytest.approx(force * peak.reaction, rel=1e-9)
        for name in ("engine_contact_time", "cargo_contact_time"):
            at, similarly = getattr(one, name), getattr(other, name)
            assert similarly == (None if at is None else pytest.approx(time * at, rel=1e-9))


# Bad inputs.


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"speed": 0.0}, "speed must be positive, got 0"),
        ({"speed": -22.2}, r"speed must be positive, got -22\.2"),
        ({"speed": math.nan}, "speed must be finite, got nan"),
        ({"speed": math.inf}, "speed must be finite, got inf"),
        ({"speed": "fast"}, "speed must be a number, got 'fast'"),
        ({"speed": None}, "speed must be a number, got None"),
        ({"duration": -0.1}, r"duration must not be negative, got -0\.1"),
        ({"duration": math.inf}, "duration must be finite, got inf"),
        ({"duration": "long"}, "duration must be a number, got 'long'"),
    ],
)
def test_bad_values_are_named(arguments, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        simulate(TRUCK, PIER, **({"speed": 22.2} | arguments))
