"""Spreads against SciPy's distributions and their own moments."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.stats import lognorm, uniform

from pierimpact import InputError, Lognormal, Uniform, load_truck
from pierimpact.vehicle.spread import checked_spreads

FRACTIONS = np.linspace(0.001, 0.999, 41)
shares = st.floats(0.0, 0.99)


@given(low=st.floats(0.0, 1.0), high=st.floats(1.0, 5.0))
def test_uniform_factors_are_those_of_the_distribution(low, high):
    spread = Uniform(low, high)
    expected = uniform(low, high - low).ppf(FRACTIONS) if high > low else np.ones_like(FRACTIONS)
    assert spread.factor(FRACTIONS) == pytest.approx(expected, rel=1e-12)
    assert spread.ends == (low, high)


@given(share=shares)
def test_a_share_is_to_either_side(share):
    low, high = Uniform.about(share).ends
    assert (1.0 - low, high - 1.0) == pytest.approx((share, share), abs=1e-15)


@given(variation=st.floats(1e-3, 0.99))
def test_lognormal_factors_are_those_of_the_distribution(variation):
    sigma = math.sqrt(math.log(1.0 + variation**2))
    median = 1.0 / math.sqrt(1.0 + variation**2)
    expected = lognorm(sigma, scale=median).ppf
    spread = Lognormal(variation)
    assert spread.factor(FRACTIONS) == pytest.approx(expected(FRACTIONS), rel=1e-9)
    assert spread.ends == pytest.approx(expected([0.05, 0.95]), rel=1e-9)


@pytest.mark.parametrize("variation", [0.02, 0.1, 0.4])
def test_the_value_is_the_mean_of_a_lognormal(variation):
    spread = Lognormal(variation)

    def moment(power):
        return quad(lambda u: float(spread.factor(np.array(u))) ** power, 0.0, 1.0, limit=200)[0]

    assert moment(1) == pytest.approx(1.0, rel=1e-5)
    assert moment(2) - moment(1) ** 2 == pytest.approx(variation**2, rel=1e-3)


def test_what_has_no_width_is_one():
    for spread in (Uniform.about(0.0), Lognormal(0.0)):
        assert spread.ends == (1.0, 1.0)
        assert np.all(spread.factor(FRACTIONS) == 1.0)


@pytest.mark.parametrize(
    ("spread", "words"),
    [
        (Uniform.about(0.3), "±30 %"),
        (Uniform.about(0.125), "±12.5 %"),
        (Uniform(0.8, 1.5), "−20 % to +50 %"),
        (Lognormal(0.1), "c.o.v. 10 %"),
    ],
)
def test_spreads_in_words(spread, words):
    assert spread.words == words


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: Uniform(1.1, 1.2),
            "low and high must be factors with 0 ≤ low ≤ 1 ≤ high, got 1.1",
        ),
        (
            lambda: Uniform(0.5, 0.9),
            "low and high must be factors with 0 ≤ low ≤ 1 ≤ high, got 0.5",
        ),
        (lambda: Uniform(-0.1, 1.9), "low and high must be factors"),
        (lambda: Uniform(0.5, math.inf), "high must be finite, got inf"),
        (lambda: Uniform.about(1.0), "spread must lie from 0 to below 1, got 1"),
        (lambda: Uniform.about("wide"), "spread must be a number, got 'wide'"),
        (lambda: Lognormal(-0.1), "coefficient_of_variation must lie from 0 to below 1, got -0.1"),
        (lambda: checked_spreads({"b": Uniform(0.5, 2)}, ["a"]), "'b' is not a parameter with a s"),
        (lambda: checked_spreads({"a": 0.3}, ["a"]), "spread of a must be Uniform or Lognormal"),
        (lambda: checked_spreads({"a": Uniform(0.0, 2)}, ["a"]), "spread of a must not begin at z"),
    ],
)
def test_bad_spreads_are_one_line(make, message):
    with pytest.raises(InputError, match=f"^{message}") as caught:
        make()
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("spread", [None, 0.3, ["speed"]])
def test_spreads_are_a_mapping(spread):
    with pytest.raises(InputError, match=r"^spread must be a mapping of parameters, got "):
        replace(load_truck("single-unit-8t"), spread=spread)
