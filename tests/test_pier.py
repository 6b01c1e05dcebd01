import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pierimpact import EquivalentPier, InputError


@given(st.floats(1e3, 1e6), st.floats(1e6, 1e11), st.floats(0.0, 0.99))
def test_frequency_and_damping_are_those_of_the_free_vibration(mass, stiffness, damping_ratio):
    pier = EquivalentPier(mass=mass, stiffness=stiffness, damping_ratio=damping_ratio)
    # x'' + 2 ζ ω x' + ω² x = 0 has the roots ω (−ζ ± i √(1 − ζ²)).
    omega = 2.0 * math.pi * pier.frequency
    expected = omega * complex(-damping_ratio, math.sqrt(1.0 - damping_ratio**2))
    roots = np.roots([mass, pier.damping, stiffness])
    assert roots[np.argmax(roots.imag)] == pytest.approx(expected, rel=1e-6)


@given(st.floats(1e3, 1e6), st.floats(1.0, 500.0), st.floats(0.0, 0.99))
def test_a_pier_of_a_frequency_has_it(mass, frequency, damping_ratio):
    pier = EquivalentPier.from_frequency(mass, frequency, damping_ratio)
    assert (pier.mass, pier.damping_ratio) == (mass, damping_ratio)
    assert pier.frequency == pytest.approx(frequency, rel=1e-14)


@pytest.mark.parametrize(
    ("mass", "frequency", "message"),
    [
        (0.0, 30.0, "mass must be positive, got 0"),
        (8e3, 0.0, "frequency must be positive, got 0"),
        ("heavy", 30.0, "mass must be a number, got 'heavy'"),
    ],
)
def test_what_is_no_mass_or_frequency(mass, frequency, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        EquivalentPier.from_frequency(mass, frequency)


def test_damping_ratio_by_default():
    assert EquivalentPier(mass=8e3, stiffness=284e6).damping_ratio == 0.05


def test_values_become_floats_and_stay():
    pier = EquivalentPier(mass=np.int64(8000), stiffness=np.float32(284e6), damping_ratio=0)
    assert [type(value) for value in dataclasses.astuple(pier)] == [float] * 4
    with pytest.raises(dataclasses.FrozenInstanceError):
        pier.mass = 1.0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"mass": 0.0}, "mass must be positive, got 0"),
        ({"mass": None}, "mass must be a number, got None"),
        ({"stiffness": -1.0}, "stiffness must be positive, got -1"),
        ({"stiffness": math.inf}, "stiffness must be finite, got inf"),
        ({"damping_ratio": -0.01}, r"damping_ratio must not be negative, got -0\.01"),
        ({"damping_ratio": 1.0}, "damping_ratio must be below 1, got 1"),
        ({"yield_reaction": 0.0}, "yield_reaction must be positive or infinite, got 0"),
        ({"yield_reaction": math.nan}, "yield_reaction must be positive or infinite, got nan"),
        ({"yield_reaction": "strong"}, "yield_reaction must be a number, got 'strong'"),
    ],
)
def test_bad_values_are_named(changes, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        EquivalentPier(**({"mass": 8e3, "stiffness": 284e6} | changes))
