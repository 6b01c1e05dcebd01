"""The collision under numbers far beyond any real truck and pier."""

import dataclasses
import math

import numpy as np
import pytest
from generated_collisions import Case, side_by_side
from reference import solve
from wide_collisions import wide_collisions

from pierimpact import CrushSpring, EquivalentPier, Truck, load_truck, peak_reactions, simulate
from pierimpact.collision import history, propagation
from pierimpact.collision.series import FLOATS
from pierimpact.collision.stepping import longest_step

TRUCK = load_truck("single-unit-8t")
WIDE = wide_collisions(1000, seed=90)
# For one by one, those that take no thousand steps.
FEW = WIDE[:160]


def together(cases):
    """Peaks of many, no floating-point error raised on the way."""
    resistances = [case.pier.yield_reaction for case in cases]
    with np.errstate(divide="raise", over="raise", invalid="raise"):
        return peak_reactions(**side_by_side(cases), yield_reaction=resistances)


def cycles(history):
    """Ordinary steps that a history has room for, above the cycles of its fastest vibration."""
    return sum(h / longest_step(motion, FLOATS) for _, motion, h in history.steps)


@pytest.fixture(scope="module")
def found():
    return together(WIDE)


def test_every_one_ends(found):
    assert np.isfinite(found.governing).all()
    assert (found.engine >= 0.0).all()
    np.testing.assert_array_equal(np.isnan(found.cargo), np.isnan(found.cargo_contact_time))
    np.testing.assert_array_equal(np.isnan(found.cargo), np.isnan(found.cargo_time))


@pytest.mark.attack
@pytest.mark.parametrize("chunk", range(25))
def test_every_one_of_a_hundred_thousand_ends(chunk):
    test_every_one_ends(together(wide_collisions(4000, seed=1000 + chunk)))


def test_the_energy_bounds_every_peak(found):
    energy = np.array([0.5 * truck.mass * speed**2 for truck, _, speed in WIDE])
    stiffness = np.array([pier.stiffness for _, pier, _ in WIDE])
    assert (found.governing <= np.sqrt(2.0 * energy * stiffness) * (1.0 + 1e-9)).all()
    assert (found.plastic_energy <= energy * (1.0 + 1e-9)).all()


def test_companions_and_order_change_no_bit(found):
    order = np.random.default_rng(91).permutation(len(WIDE))[:150]
    again = together([WIDE[number] for number in order])
    for values, others in zip(found, again, strict=True):
        np.testing.assert_array_equal(values[order], others)
    for number in order[:5]:
        alone = together([WIDE[number]])
        for values, others in zip(found, alone, strict=True):
            np.testing.assert_array_equal(values[number], others[0])


def test_each_alone_is_as_among_the_others(found):
    for number, case in enumerate(FEW):
        history = simulate(*case)
        cargo = history.cargo_peak
        assert history.engine_peak.reaction == pytest.approx(found.engine[number], rel=1e-9)
        assert (cargo.reaction if cargo else math.nan) == pytest.approx(
            found.cargo[number], rel=1e-9, nan_ok=True
        )
        assert history.ductility == pytest.approx(found.ductility[number], rel=1e-9)


def test_a_longer_history_raises_no_peak():
    for case in FEW[::4]:
        history = simulate(*case)
        longer = simulate(*case, duration=1.5 * history.end.time)
        for peak, same in zip(history.peaks.values(), longer.peaks.values(), strict=True):
            assert (peak is None) == (same is None)
            if peak:
                assert same.reaction == pytest.approx(peak.reaction, rel=1e-9)


def test_energy_and_momentum_are_accounted_for():
    for case in FEW[::3]:
        history = simulate(*case)
        if cycles(history) > 1000.0:
            continue
        assert history.energy_error < 1e-8
        # The pier's impulses back and forth may be far larger than what the truck brings.
        pushed = np.abs(np.diff(history.impulse)).sum() / (case.truck.mass * case.speed)
        assert history.momentum_error < 1e-8 * max(1.0, pushed)


def test_one_that_does_not_end_is_named_and_spares_the_others(monkeypatch):
    cases = WIDE[:40]
    whole = together(cases).governing
    monkeypatch.setattr(propagation, "STEPS", 30)
    with pytest.warns(
        propagation.UnfinishedWarning, match=r"^collision at index (\d+), .* 30 steps"
    ) as caught:
        found = together(cases)
    endless = np.isnan(found.governing)
    assert 0 < endless.sum() < 40
    first = int(str(caught[0].message).split("index ")[1].split(",")[0])
    assert first == np.flatnonzero(endless)[0]
    np.testing.assert_array_equal(found.governing[~endless], whole[~endless])
    assert all(np.isnan(values[endless]).all() for values in found)
    with pytest.raises(RuntimeError, match=r"^the collision did not come to an end in 30 steps$"):
        simulate(*cases[first])


def test_a_history_of_too_many_cycles_says_so(monkeypatch):
    monkeypatch.setattr(history, "MOST_PIECES", 50)
    pier = EquivalentPier.from_frequency(mass=1e5, frequency=3e3, damping_ratio=0.0)
    found = simulate(TRUCK, pier, speed=5.0)
    assert found.governing_peak.reaction > 0.0
    with pytest.raises(RuntimeError, match=r"^the pier vibrates too often for a history"):
        _ = found.reaction


# Against the independent solution, at corners.

LENGTH = 1e-9  # a plateau [m]


def corner(ratio=0.05, spring=None, **changes):
    """The reference truck with other springs, both the same, on a pier of 8 t and 30 Hz."""
    values = {"name": "corner", "engine_mass": 700.0, "body_mass": 7300.0}
    engine, body = (spring, spring) if spring else (TRUCK.engine_spring, TRUCK.body_spring)
    values |= {"engine_spring": engine, "body_spring": body} | changes
    pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0, damping_ratio=ratio)
    return Case(Truck(**values), pier, 15.0)


ALIKE = CrushSpring(plateau_force=2e5, plateau_length=0.3, stiffness=2e7, unloading_stiffness=2e7)
SHORT = CrushSpring(
    plateau_force=1e5, plateau_length=1e5 / 5e7, stiffness=5e7, unloading_stiffness=5e7
)
CORNERS = {
    **{f"damping {ratio}": corner(ratio) for ratio in (0.0, 0.9, 0.99, 1.0 - 1e-6, 1.0 - 1e-15)},
    "springs alike, elastic": corner(spring=ALIKE),
    "all at one instant": corner(spring=ALIKE, engine_mass=4e3, body_mass=4e3),
    "no plateau, elastic": corner(0.0, spring=SHORT),
    "no plateau, elastic, damped": corner(spring=SHORT),
    "friction that holds the truck": corner(friction_force=5e5),
    "friction on the pier": corner(friction_force=2e5, friction_on="pier"),
    "friction on the pier, no damping": corner(0.0, friction_force=2e5, friction_on="pier"),
}


@pytest.mark.parametrize("case", CORNERS.values(), ids=CORNERS)
def test_corners_are_those_of_the_reference(case):
    history, reference = simulate(*case), solve(*case)
    cargo = history.cargo_peak
    found = [history.engine_peak.reaction, cargo.reaction if cargo else math.nan]
    assert found == pytest.approx([reference.engine, reference.cargo], rel=1e-8, nan_ok=True)


@pytest.mark.parametrize(
    ("ratio", "changes"),
    [(0.0, {}), (0.02, {"friction_force": 2e4})],
    ids=["no damping", "friction"],
)
def test_hundreds_of_contacts_are_those_of_the_reference(ratio, changes):
    pier = EquivalentPier.from_frequency(mass=100.0, frequency=3.0, damping_ratio=ratio)
    case = Case(dataclasses.replace(TRUCK, **changes), pier, 15.0)
    history, reference = simulate(*case), solve(*case)
    cargo = history.cargo_peak
    found = [history.engine_peak.reaction, cargo.reaction if cargo else math.nan]
    assert len(reference.changes) > 300
    assert found == pytest.approx([reference.engine, reference.cargo], rel=1e-7, nan_ok=True)


@pytest.mark.parametrize("number", [677, 858], ids=["hops", "yields"])
def test_a_pier_that_for_ever_presses_against_a_truck_at_rest_ends(monkeypatch, number):
    """It hops on a body that friction holds, undamped; or yields under its spring with just R_y."""
    monkeypatch.setattr(propagation, "STEPS", 10_000)
    case = wide_collisions(number + 1, seed=1015)[number]
    history = simulate(*case)
    longer = simulate(*case, duration=1.2 * history.end.time)
    assert longer.ductility == pytest.approx(history.ductility, rel=1e-9)
    for peak, same in zip(history.peaks.values(), longer.peaks.values(), strict=True):
        assert (peak and peak.reaction) == (same and same.reaction)
    assert longer.cargo_contact_time == history.cargo_contact_time


def test_a_plateau_of_a_nanometre_before_a_pier_that_yields_ends():
    force = 0.5 * LENGTH * 1e9
    spring = CrushSpring(
        plateau_force=force, plateau_length=LENGTH, stiffness=1e8, unloading_stiffness=1e9
    )
    truck, pier, speed = corner(0.0, spring=spring)
    pier = EquivalentPier(
        mass=pier.mass, stiffness=pier.stiffness, damping_ratio=0.0, yield_reaction=1e6
    )
    history, reference = simulate(truck, pier, speed), solve(truck, pier, speed)
    assert len(history.steps) < 200
    assert history.ductility * 1e6 / pier.stiffness == pytest.approx(
        reference.largest_displacement, rel=1e-7
    )
