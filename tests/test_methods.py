"""The methods beside the codes: closed forms, limits, and what the lessons say of them."""

import dataclasses
import math
import re
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp
from scipy.optimize import fsolve

from pierimpact import CrushSpring, EquivalentPier, InputError, Truck, load_truck, maps, simulate
from pierimpact.collision.averages import largest_average_force
from pierimpact.collision.parameters import Collision
from pierimpact.design.codes import JCSS_STIFFNESS, aashto_lrfd, hard_impact, jcss_hard_impact
from pierimpact.design.methods import (
    METHODS,
    WINDOW,
    _energy_after_blows,
    compare_methods,
    hertz_impact,
    hertz_stiffness,
)
from pierimpact.plots.methods import _spread, methods_figure
from pierimpact.teaching.scenario import Scenario

TRUCK = load_truck("single-unit-8t")
USUAL = Scenario()
speeds, masses = st.floats(1.0, 40.0), st.floats(500.0, 50e3)
radii = st.floats(0.1, 3.0)
moduli = st.floats(1e9, 1e11)


# Hard impact and its plastic bound.


@given(speeds, masses, st.floats(1e4, 1e9))
def test_hard_impact_stops_the_mass_on_a_spring(speed, mass, stiffness):
    force = float(hard_impact(speed, mass, stiffness))
    assert 0.5 * force**2 / stiffness == pytest.approx(0.5 * mass * speed**2, rel=1e-12)


@pytest.mark.parametrize(("resistance", "speed"), [(150e3, 8.0), (150e3, 20.0), (400e3, 20.0)])
def test_the_full_model_of_a_weak_pier_meets_the_plastic_bound(resistance, speed):
    truck = dataclasses.replace(TRUCK, friction_force=0.0)
    pier = EquivalentPier(mass=20.0, stiffness=1e9, damping_ratio=0.0, yield_reaction=resistance)
    bound = float(compare_methods(truck, pier, speed, truck.mass, 1e10).plastic)
    history = simulate(truck, pier, speed)
    assert history.governing_peak.reaction == bound
    # The pier goes along with the truck until both stop.
    stops = history.time[int(np.argmax(history.pier_displacement))]
    assert stops == pytest.approx(truck.mass * speed / bound, rel=0.005)


# Hertz's contact.


@given(radii, moduli, st.floats(0.0, 0.5))
def test_equal_cylinders_touch_as_a_sphere_and_a_plane(radius, modulus, nu):
    stiffness = hertz_stiffness(radius, 2.0 * radius, modulus, nu)
    expected = 4.0 / 3.0 * modulus / (1.0 - nu**2) * math.sqrt(radius)
    assert stiffness == pytest.approx(expected, rel=1e-12)


def potential(a, b, power_a, power_b):
    """The integral of 1/√((a² + w)(b² + w) w) over w > 0, over (a² + w)^power_a (b² + w)^power_b.

    With w = (b tan s)².
    """

    def integrand(s):
        w = (b * math.tan(s)) ** 2
        root = math.sqrt((a**2 + w) * (b**2 + w))
        return 2.0 * b / math.cos(s) ** 2 / (root * (a**2 + w) ** power_a * (b**2 + w) ** power_b)

    return quad(integrand, 0.0, 0.5 * math.pi, epsabs=0.0, epsrel=1e-11)[0]


@settings(max_examples=25)
@given(st.floats(0.01, 100.0), radii, st.floats(1e3, 1e7))
def test_unequal_cylinders_touch_as_the_potential_of_the_pressure_tells(ratio, radius, force):
    effective = 30e9 / (1.0 - 0.2**2)
    stiffness = hertz_stiffness(ratio * radius, 2.0 * radius, 30e9)
    curvatures = sorted((0.5 / radius, 0.5 / (ratio * radius)))
    factor = 3.0 * force / (4.0 * math.pi * effective)

    def residuals(logarithms):
        a, b = np.exp(logarithms)
        found = factor * potential(a, b, 1, 0), factor * potential(a, b, 0, 1)
        return np.log(np.divide(found, curvatures))

    start = (force * radius / effective) ** (1.0 / 3.0)
    spread = (curvatures[1] / curvatures[0]) ** (1.0 / 3.0)
    a, b = np.exp(fsolve(residuals, np.log([start * spread, start / spread]), xtol=1e-12))
    assert np.abs(residuals(np.log([a, b]))).max() < 1e-9
    approach = factor * potential(a, b, 0, 0)
    assert stiffness * approach**1.5 == pytest.approx(force, rel=1e-8)


@given(radii, radii, moduli)
def test_it_does_not_matter_which_cylinder_is_which(one, other, modulus):
    there = hertz_stiffness(one, 2.0 * other, modulus)
    assert there == pytest.approx(hertz_stiffness(other, 2.0 * one, modulus), rel=1e-9)
    assert hertz_stiffness(2.0 * one, 2.0 * other, modulus) > there


@settings(max_examples=20)
@given(speeds, masses, st.floats(1e9, 1e11))
def test_the_hertz_impact_is_that_of_its_equation_of_motion(speed, mass, stiffness):
    force = hertz_impact(speed, mass, stiffness)
    scale = (force / stiffness) ** (2.0 / 3.0)
    period = scale / speed

    def motion(_, state):
        x, v = state
        return [v, -stiffness * period**2 / mass * math.sqrt(scale) * max(x, 0.0) ** 1.5]

    def stops(_, state):
        return state[1]

    stops.terminal = True
    done = solve_ivp(motion, (0.0, 3.0), [0.0, 1.0], events=stops, rtol=1e-10, atol=1e-12)
    assert done.y_events[0][0][0] == pytest.approx(1.0, rel=1e-8)
    # The known duration of the approach, 2.94 δ/v there and back.
    gammas = math.gamma(1.4) / math.gamma(0.9)
    assert done.t_events[0][0] == pytest.approx(math.sqrt(math.pi) * gammas, rel=1e-8)
    energy = 0.4 * stiffness * scale**2.5
    assert energy == pytest.approx(0.5 * mass * speed**2, rel=1e-12)


@given(speeds, masses, st.floats(1e8, 1e11), st.floats(1.1, 10.0))
def test_the_hertz_force_grows_by_its_powers(speed, mass, stiffness, factor):
    force = hertz_impact(speed, mass, stiffness)
    for power, more in (
        (1.2, hertz_impact(factor * speed, mass, stiffness)),
        (0.6, hertz_impact(speed, factor * mass, stiffness)),
        (0.4, hertz_impact(speed, mass, factor * stiffness)),
    ):
        assert more == pytest.approx(factor**power * force, rel=1e-12)


# The energy check.


def hammer(engine_mass, body_mass, restitution):
    """Two bodies that strike like hammers: next to no plateau, and stiff springs."""
    engine_spring, body_spring = (
        CrushSpring(
            plateau_force=1.0,
            plateau_length=0.01,
            stiffness=stiffness,
            unloading_stiffness=stiffness / restitution**2,
        )
        for stiffness in (1e9, 1e12)
    )
    return Truck(
        name="hammer",
        engine_mass=engine_mass,
        body_mass=body_mass,
        engine_spring=engine_spring,
        body_spring=body_spring,
    )


def energy_of(truck, pier, speed):
    """What the pier has after the blows."""
    return _energy_after_blows(Collision(truck, pier, speed))


def work_of(pier, displacement):
    """What the pier can take up until it is displaced so far."""
    elastic = min(displacement, pier.yield_reaction / pier.stiffness)
    return pier.stiffness * elastic * (displacement - 0.5 * elastic)


def test_the_check_is_one_where_the_pier_just_gets_to():
    random, elastic = np.random.default_rng(81), 0
    for _ in range(40):
        mass, frequency = random.uniform(5e3, 50e3), random.uniform(1.0, 10.0)
        speed, restitution = random.uniform(1.0, 40.0), random.uniform(0.3, 1.0)
        # Lighter than e times the pier the body flies back, and never meets the pier again. The
        # engine weighs next to nothing.
        truck = hammer(1.0, random.uniform(0.1, 0.8) * restitution * mass, restitution)
        pier = EquivalentPier.from_frequency(mass, frequency, damping_ratio=0.0)
        energy = energy_of(truck, pier, speed)
        whole = math.sqrt(2.0 * pier.stiffness * energy)
        pier = dataclasses.replace(pier, yield_reaction=random.uniform(0.1, 1.2) * whole)
        history = simulate(truck, pier, speed)
        reached = history.ductility * pier.yield_reaction / pier.stiffness
        # What is left is the time that the blow takes, and the kilogram.
        assert energy == pytest.approx(work_of(pier, reached), rel=3e-4)
        reaction = compare_methods(truck, pier, speed, truck.mass, 1e10).energy_reaction
        assert reaction == pytest.approx(history.governing_peak.reaction, rel=3e-4)
        elastic += history.ductility < 1.0
    assert 3 <= elastic <= 20


@given(speeds)
def test_a_heavy_pier_takes_up_the_momentum_of_both_blows(speed):
    pier = EquivalentPier(mass=1e12, stiffness=1e9)
    momentum = 0.0
    for mass, spring, force in (
        (TRUCK.engine_mass, TRUCK.engine_spring, 0.0),
        (TRUCK.body_mass, TRUCK.body_spring, TRUCK.friction_force),
    ):
        lost = 2.0 * (spring.plateau_force + force) * spring.plateau_length / mass
        arrival = math.sqrt(max(speed**2 - lost, 0.0))
        momentum += (1.0 + spring.restitution) * mass * arrival
    energy = energy_of(TRUCK, pier, speed)
    assert energy == pytest.approx(0.5 * momentum**2 / pier.mass, rel=1e-6)


@given(st.floats(500.0, 5e4), st.floats(500.0, 5e4), st.floats(0.0001, 1.0), st.floats(1e3, 1e5))
def test_the_blows_leave_no_more_energy_than_there_was(engine, body, restitution, mass):
    truck = hammer(engine, body, restitution)
    energy = energy_of(truck, EquivalentPier(mass=mass, stiffness=1e9), 20.0)
    assert energy <= 0.5 * truck.mass * 20.0**2 * (1.0 + 1e-9)


# The comparison.


@pytest.fixture(scope="module")
def contact():
    return hertz_stiffness(0.5, USUAL.column_diameter, USUAL.elastic_modulus)


@pytest.fixture(scope="module")
def over_speed(contact):
    kilometres = np.arange(20.0, 131.0, 5.0)
    return compare_methods(TRUCK, USUAL.pier, kilometres / 3.6, TRUCK.mass, contact)


@pytest.fixture(scope="module")
def over_mass(contact):
    tonnes = np.append(np.arange(3.0, 10.0), np.arange(10.0, 41.0, 5.0))
    return compare_methods(TRUCK, USUAL.pier, 80.0 / 3.6, 1e3 * tonnes, contact)


def test_every_line_is_that_of_its_method(contact):
    speed, mass = np.array([[15.0], [25.0]]), np.array([4e3, 8e3, 30e3])
    pier = dataclasses.replace(USUAL.pier, yield_reaction=5e6)
    found = compare_methods(TRUCK, pier, speed, mass, contact)
    for row, column in np.ndindex(2, 3):
        v, m = float(speed[row, 0]), float(mass[column])
        history = simulate(TRUCK.loaded_to(m), pier, v)
        average = largest_average_force(history, WINDOW).force
        expected = {
            "peak_reaction": history.governing_peak.reaction,
            "average_force": average,
            "hard": jcss_hard_impact(v, m).along.value,
            "hertz": hertz_impact(v, m, contact),
            "energy_reaction": min(
                math.sqrt(2.0 * pier.stiffness * energy_of(TRUCK.loaded_to(m), pier, v)), 5e6
            ),
        }
        for name, value in expected.items():
            assert getattr(found, name)[row, column] == pytest.approx(value, rel=1e-9), name
        assert found.plastic[row, column] == 650e3
    assert aashto_lrfd() in found.codes
    assert {value.shape for value in (found.speed, found.mass, found.hertz)} == {(2, 3)}


def test_methods_say_what_they_rest_on():
    assert [method.status for method in METHODS] == [
        *["read in a public copy"] * 2,
        *["derived here"] * 2,
    ]
    for method in METHODS:
        assert method.assumptions.count(".") == 1
        assert method.errs.startswith(("High", "Low"))


def test_the_lesson_is_right(over_speed, over_mass, contact):
    for found in (over_speed, over_mass):
        ratio = found.hertz / found.peak_reaction
        assert ratio.min() > 10.0
        assert ratio.max() < 75.0
        assert (found.hard < found.peak_reaction).all()
        assert (found.hertz.max() / contact) ** (2.0 / 3.0) < 0.065  # the approach [m]
    kilometres = np.round(3.6 * over_speed.speed)
    slow, middle = kilometres <= 50.0, (kilometres >= 40.0) & (kilometres <= 60.0)
    assert over_speed.average_force[slow] == pytest.approx(over_speed.plastic[slow], rel=0.01)
    assert (over_speed.peak_reaction[slow] > 1.8 * over_speed.plastic[slow]).all()
    assert (over_speed.energy_reaction[slow] == 0.0).all()
    assert over_speed.hard[middle] == pytest.approx(over_speed.average_force[middle], rel=0.2)
    fast = kilometres >= 65.0
    assert (over_speed.energy_reaction[fast] > 3.0 * over_speed.peak_reaction[fast]).all()
    assert (over_speed.plastic[fast] < 0.5 * over_speed.average_force[fast]).all()
    v, m = 80.0 / 3.6, TRUCK.mass
    assert v * math.sqrt(m / JCSS_STIFFNESS) == pytest.approx(3.6, abs=0.05)
    wider = hertz_stiffness(1.0, USUAL.column_diameter, USUAL.elastic_modulus)
    assert (wider / contact) ** 0.4 == pytest.approx(1.08, abs=0.005)
    code = aashto_lrfd().along.value
    assert 65.0 < np.interp(code, over_speed.average_force[slow.sum() :], kilometres[~slow]) < 75.0
    assert 5.5e3 < np.interp(code, over_mass.average_force, over_mass.mass) < 6.7e3


def test_the_check_errs_as_it_says():
    def ratio(mass, pier_mass, frequency, resistance):
        pier = EquivalentPier.from_frequency(pier_mass, frequency)
        pier = dataclasses.replace(pier, yield_reaction=resistance)
        truck = TRUCK.loaded_to(mass)
        history = simulate(truck, pier, 80.0 / 3.6)
        reached = history.ductility * resistance / pier.stiffness
        return energy_of(truck, pier, 80.0 / 3.6) / work_of(pier, reached)

    assert ratio(8e3, 6.4e3, 86.0, 4e6) > 20.0  # stiff
    assert ratio(8e3, 6e3, 5.0, 1e6) == pytest.approx(1.0, abs=0.2)  # soft
    assert ratio(30e3, 6e3, 5.0, 1e6) < 0.5  # pushed on


# The figure.


def test_the_figure_shows_every_line_and_its_name(over_speed, over_mass):
    figure = methods_figure(over_speed, over_mass)
    figure.canvas.draw()
    for axes, found in zip(figure.axes, (over_speed, over_mass), strict=True):
        curves = [line.get_ydata() for line in axes.lines if len(line.get_ydata()) > 2]
        assert len(curves) == 8  # two codes of 1000 kN share a line
        for force in (found.peak_reaction, found.average_force, found.hertz):
            assert any(np.array_equal(force, curve) for curve in curves)
        boxes = sorted((text.get_window_extent() for text in axes.texts), key=lambda box: box.y0)
        assert len(boxes) == len(curves)
        assert all(a.y1 <= b.y0 for a, b in pairwise(boxes))
        assert all(box.x1 < figure.bbox.x1 for box in boxes)
        names = [text.get_text() for text in axes.texts]
        assert "JTG D60\nEN 1991-1-7, motorway (unverified)" in names


@given(st.lists(st.tuples(st.floats(0.0, 100.0), st.floats(1.0, 20.0)), min_size=1, max_size=8))
def test_names_are_moved_apart_and_no_further(wanted_and_sizes):
    wanted, sizes = np.array(wanted_and_sizes).T
    places = _spread(wanted, sizes)
    order = np.argsort(wanted, kind="stable")
    gaps = np.diff(places[order]) - 0.5 * (sizes[order][1:] + sizes[order][:-1])
    assert (gaps >= -1e-9).all()
    if (np.diff(wanted[order]) >= 0.5 * (sizes[order][1:] + sizes[order][:-1])).all():
        np.testing.assert_allclose(places, wanted, atol=1e-9)
    assert np.mean(places) == pytest.approx(np.mean(wanted), abs=1e-9)


def test_the_lesson_shows_figure_and_assumptions(monkeypatch, over_speed, over_mass):
    found = iter((over_speed, over_mass))
    monkeypatch.setattr(maps, "compare_methods", lambda *arguments: next(found))
    page = maps.methods().data
    assert page.count("data:image/png;base64,") == 1
    rows = re.findall(r"<tr.*?</tr>", page)[1:]
    for row, method in zip(rows, METHODS, strict=True):
        assert method.name in row
        assert method.status in row


# Bad input.


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: hertz_stiffness(0.0, 1.0, 3e10), "striker_radius must be positive, got 0"),
        (lambda: hertz_stiffness(1.0, -1.0, 3e10), "column_diameter must be positive, got -1"),
        (lambda: hertz_stiffness(1.0, 1.0, math.inf), "elastic_modulus must be finite, got inf"),
        (lambda: hertz_stiffness(1.0, 1.0, 3e10, 0.6), "poisson_ratio must be at most 0.5, got .*"),
        (lambda: hertz_impact(20.0, 8e3, 0.0), "stiffness must be positive, got 0"),
        (
            lambda: compare_methods(TRUCK, USUAL.pier, 0.0, 8e3, 1e10),
            "speed must be positive, got 0",
        ),
        (
            lambda: compare_methods(TRUCK, USUAL.pier, 20.0, [8e3, -1.0], 1e10),
            "mass must be positive, got -1 at index 1",
        ),
        (
            lambda: compare_methods(TRUCK, USUAL.pier, [1.0, 2.0], [1.0, 2.0, 3.0], 1e10),
            r"shapes must broadcast against each other, got speed \(2,\), mass \(3,\)",
        ),
        (
            lambda: compare_methods(TRUCK, USUAL.pier, 20.0, 600.0, 1e10),
            "mass must exceed the engine's 700 kg, got 600 kg",
        ),
    ],
)
def test_bad_input_is_refused(call, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        call()
