import dataclasses
import math

import numpy as np
import pytest
from generated_collisions import HARD, collisions, side_by_side

from pierimpact import InputError, load_truck, peak_reactions, simulate

TRUCK = load_truck("single-unit-8t")
FIELDS = (
    "engine",
    "cargo",
    "engine_time",
    "cargo_time",
    "engine_contact_time",
    "cargo_contact_time",
)


def known(value):
    return math.nan if value is None else value


def of_one(case):
    """What `simulate` finds, in the order of FIELDS."""
    history = simulate(*case)
    engine, cargo = history.engine_peak, history.cargo_peak
    return [
        engine.reaction,
        cargo.reaction if cargo else math.nan,
        engine.time,
        cargo.time if cargo else math.nan,
        known(history.engine_contact_time),
        known(history.cargo_contact_time),
    ]


def assert_same(found, expected):
    """Arrays in the order of FIELDS agree but for round-off, and in what does not happen."""
    for field, one, other in zip(FIELDS, found, expected, strict=True):
        # The instant of a flat maximum is known to the root of the maximum's own error.
        rtol = 1e-6 if field in ("engine_time", "cargo_time") else 1e-12
        np.testing.assert_allclose(one, other, rtol=rtol, err_msg=field)


def fields(peaks):
    return [getattr(peaks, field) for field in FIELDS]


def test_peaks_are_those_of_simulate():
    cases = [*collisions(150, seed=40), *HARD.values()]
    found = peak_reactions(**side_by_side(cases))
    assert_same(fields(found), np.array([of_one(case) for case in cases]).T)


def test_results_depend_neither_on_place_nor_on_neighbours():
    cases = collisions(150, seed=41)
    once = fields(peak_reactions(**side_by_side(cases)))
    # Many times over in changing order, so that each meets other neighbours in other places.
    shuffle = np.random.default_rng(41).permutation
    order = np.concatenate([shuffle(len(cases)) for _ in range(30)])
    many = fields(peak_reactions(**side_by_side([cases[number] for number in order])))
    assert_same(many, [values[order] for values in once])
    for number in range(0, 150, 10):
        alone = fields(peak_reactions(**side_by_side(cases[number : number + 1])))
        assert_same(alone, [values[number : number + 1] for values in once])


def test_inputs_broadcast():
    mass, speed = np.array([[5e3], [20e3], [80e3]]), np.array([8.0, 15.0, 22.0, 30.0])
    peaks = peak_reactions(TRUCK, mass, 300e6, 0.05, speed)
    masses, speeds = np.broadcast_arrays(mass, speed)
    each = peak_reactions(TRUCK, masses.ravel(), [300e6] * 12, [0.05] * 12, speeds.ravel())
    assert {values.shape for values in fields(peaks)} == {(3, 4)}
    assert_same([values.ravel() for values in fields(peaks)], fields(each))
    np.testing.assert_array_equal(peaks.governing, np.fmax(peaks.engine, peaks.cargo))
    assert np.isnan(peaks.cargo).any()
    assert not np.isnan(peaks.governing).any()


def test_plain_numbers_give_arrays_without_axes():
    peaks = peak_reactions(TRUCK, 8e3, 284e6, 0.05, 22.2)
    one = peak_reactions(TRUCK, [8e3], [284e6], [0.05], [22.2])
    assert {values.shape for values in fields(peaks)} == {()}
    assert_same(fields(peaks), [values[0] for values in fields(one)])


def test_progress_counts_every_collision_once():
    calls = []
    peak_reactions(TRUCK, 8e3, np.geomspace(1e6, 1e10, 5000), 0.05, 22.2, progress=calls.append)
    assert sum(calls) == 5000
    assert len(calls) > 5
    assert min(calls) > 0


def test_no_collisions_give_no_peaks():
    peaks = peak_reactions(TRUCK, [], 284e6, 0.05, 22.2)
    assert {values.shape for values in fields(peaks)} == {(0,)}


def test_a_sequence_of_trucks_is_an_axis():
    trucks = [TRUCK.loaded_to(mass) for mass in (8e3, 16e3, 32e3)]
    trucks.append(dataclasses.replace(TRUCK, friction_on="pier"))
    stiffness = np.array([[50e6], [500e6]])
    peaks = peak_reactions(trucks, 8e3, stiffness, 0.05, 22.2)
    for column, truck in enumerate(trucks):
        alone = peak_reactions(truck, 8e3, stiffness[:, 0], 0.05, 22.2)
        assert_same([values[:, column] for values in fields(peaks)], fields(alone))
    assert peaks.engine.shape == (2, 4)
    assert peak_reactions(trucks[:1], 8e3, 284e6, 0.05, 22.2).engine.shape == (1,)


def test_any_kind_of_sequence_will_do():
    trucks = [TRUCK, TRUCK.loaded_to(20e3)]
    arrays = peak_reactions(trucks, np.array([8e3, 9e3]), 284e6, 0.05, np.array([20.0, 22.0]))
    plain = peak_reactions(tuple(trucks), [8000, 9000], 284e6, 0.05, (20, 22))
    assert_same(fields(plain), fields(arrays))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"pier_mass": 0.0}, "pier_mass must be positive, got 0"),
        ({"pier_mass": [8e3, -1.0]}, "pier_mass must be positive, got -1 at index 1"),
        ({"pier_stiffness": math.nan}, "pier_stiffness must be finite, got nan"),
        (
            {"pier_stiffness": [[1e8, 2e8], [0.0, 1e8]]},
            r"pier_stiffness must be positive, got 0 at index \(1, 0\)",
        ),
        ({"damping_ratio": -0.01}, r"damping_ratio must lie from 0 to below 1, got -0\.01"),
        (
            {"damping_ratio": [0.05, 1.0]},
            "damping_ratio must lie from 0 to below 1, got 1 at index 1",
        ),
        ({"speed": [22.0, math.inf]}, "speed must be finite, got inf at index 1"),
        ({"speed": -22.0}, "speed must be positive, got -22"),
        (
            {"yield_reaction": [2e6, -1.0]},
            "yield_reaction must be positive or infinite, got -1 at index 1",
        ),
        ({"yield_reaction": math.nan}, "yield_reaction must be positive or infinite, got nan"),
        (
            {"pier_mass": [8e3, 8e3], "yield_reaction": [1e6, 2e6, 3e6]},
            r"shapes must broadcast against each other, got truck \(\), pier_mass \(2,\), "
            r"pier_stiffness \(\), damping_ratio \(\), speed \(\), yield_reaction \(3,\)",
        ),
        ({"speed": "fast"}, "speed must be an array of numbers, got 'fast'"),
        (
            {"pier_mass": [8e3] * 2, "speed": [22.0] * 3},
            r"shapes must broadcast against each other, got truck \(\), pier_mass \(2,\), "
            r"pier_stiffness \(\), damping_ratio \(\), speed \(3,\)",
        ),
        (
            {"truck": [TRUCK] * 2, "speed": [22.0] * 3},
            r"shapes must broadcast against each other, got truck \(2,\), pier_mass \(\), "
            r"pier_stiffness \(\), damping_ratio \(\), speed \(3,\)",
        ),
    ],
)
def test_bad_values_are_named(arguments, message):
    given = {
        "truck": TRUCK,
        "pier_mass": 8e3,
        "pier_stiffness": 284e6,
        "damping_ratio": 0.05,
        "speed": 22.2,
    }
    with pytest.raises(InputError, match=f"^{message}$"):
        peak_reactions(**(given | arguments))
