import math
from fractions import Fraction

import numpy as np
import pandas as pd
import pytest

from pierimpact import (
    CircularSection,
    EquivalentPier,
    InputError,
    PierColumn,
    RegularPolygonSection,
    load_truck,
    peak_reactions,
    reaction_band,
)
from pierimpact.checks import (
    finite_array,
    not_negative,
    number,
    one_of,
    positive,
    ratio,
    told_from,
    whole,
)


@pytest.mark.parametrize("check", [number, positive, not_negative])
@pytest.mark.parametrize("value", [2, 2.0, np.float32(2.0), np.int64(2), np.array(2.0)])
def test_numbers_become_floats(check, value):
    result = check("speed", value)
    assert type(result) is float
    assert result == 2.0


@pytest.mark.parametrize(
    ("check", "value", "message"),
    [
        (number, "fast", "speed must be a number, got 'fast'"),
        (number, None, "speed must be a number, got None"),
        (number, [1.0, 2.0], r"speed must be a number, got \[1\.0, 2\.0\]"),
        (number, 1j, "speed must be a number, got 1j"),
        (number, "3", "speed must be a number, got '3'"),
        (number, b"3", "speed must be a number, got b'3'"),
        (number, True, "speed must be a number, got True"),
        (number, np.True_, "speed must be a number, got np.True_"),
        (number, np.array("3"), r"speed must be a number, got array\('3', dtype='<U1'\)"),
        (number, 10**400, "speed must be a number, got 1000.*…"),
        (number, math.nan, "speed must be finite, got nan"),
        (number, -math.inf, "speed must be finite, got -inf"),
        (positive, 0.0, "speed must be positive, got 0"),
        (positive, math.nan, "speed must be finite, got nan"),
        (not_negative, -1e-9, "speed must not be negative, got -1e-09"),
    ],
)
def test_broken_rules_are_named(check, value, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        check("speed", value)


@pytest.mark.parametrize(
    "values",
    [
        [2, 3.0],
        (2.0, 3.0),
        np.array([2, 3], dtype=np.uint8),
        np.array([2, 3], dtype=np.float32),
        np.array([2, 3.0], dtype=object),
        [Fraction(2), Fraction(3)],
        pd.Series([2, 3]),
        pd.Series([2.0, 3.0], index=["a", "b"]),
    ],
)
def test_numbers_in_a_row_become_an_array_of_floats(values):
    array = finite_array("speed", values)
    assert array.dtype == float
    np.testing.assert_array_equal(array, [2.0, 3.0])


@pytest.mark.parametrize(
    ("values", "shown"),
    [
        ("3", "'3'"),
        (["2", "3"], r"\['2', '3'\]"),
        ([2.0, "3"], r"\[2\.0, '3'\]"),
        ([b"3"], r"\[b'3'\]"),
        (True, "True"),
        ([True, False], r"\[True, False\]"),
        (np.array([2, True], dtype=object), r"array\(\[2, True\], dtype=object\)"),
        (np.array([1 + 2j]), r"array\(\[1\.\+2\.j\]\)"),
        (None, "None"),
        ({}, r"\{\}"),
        ([[1.0], [1.0, 2.0]], r"\[\[1\.0\], \[1\.0, 2\.0\]\]"),
        (10**400, "1000.*…"),
        (np.array([["a", "b"], ["c", "d"]]), r"array\(\[\['a', 'b'\], \['c', 'd'\]\], .*\)"),
    ],
)
def test_what_are_no_numbers_in_a_row(values, shown):
    with pytest.raises(InputError, match=f"^speed must be an array of numbers, got {shown}$"):
        finite_array("speed", values)


def test_limits_are_inside():
    assert not_negative("speed", 0.0) == 0.0
    assert positive("speed", 5e-324) == 5e-324


def test_shares_and_whole_numbers():
    assert ratio("spread", 0) == 0.0
    assert whole("size", np.int64(3), 3) == 3
    for value, message in (
        (1, "lie from 0 to below 1, got 1"),
        (-1e-9, "lie from 0 .*, got -1e-09"),
    ):
        with pytest.raises(InputError, match=f"^spread must {message}$"):
            ratio("spread", value)
    for value, message in (
        (2, "be at least 3, got 2"),
        (3.0, r"be a whole number, got 3\.0"),
        ("3", "be a whole number, got '3'"),
        (True, "be a whole number, got True"),
    ):
        with pytest.raises(InputError, match=f"^size must {message}$"):
            whole("size", value, 3)


@pytest.mark.parametrize("limit", [0.5, 1.0, 1.27, 1e8, 3e-9, 2.5e-300])
def test_a_value_is_told_from_the_limit_that_it_broke(limit):
    assert told_from(limit, limit) == f"{limit:g}"
    for exponent in range(1, 16):
        for value in (limit * (1.0 - 10.0**-exponent), limit * (1.0 + 10.0**-exponent)):
            shown = told_from(value, limit)
            assert shown != f"{limit:g}"
            assert float(shown) == pytest.approx(value, rel=5e-6)
    column = PierColumn(
        section=CircularSection(diameter=0.4), height=1.27, elastic_modulus=25e9, density=2400.0,
        poisson_ratio=0.2, base="fixed", top="pinned",
    )  # fmt: skip
    with pytest.raises(InputError, match=r"height 1\.27 m .*, got 1\.2700000000000002 m$"):
        column.struck_at(math.nextafter(1.27, 2.0))


def test_one_of():
    assert one_of("base", "fixed", ("fixed", "pinned")) == "fixed"
    with pytest.raises(InputError, match=r"^base must be one of fixed, pinned, got 'Fixed'$"):
        one_of("base", "Fixed", ("fixed", "pinned"))
    with pytest.raises(InputError, match=r"^base must be one of fixed, pinned, got array\(\[1\."):
        one_of("base", np.array([1.0, 2.0]), ("fixed", "pinned"))


def test_text_and_booleans_are_no_numbers_of_a_pier():
    for mass in ("3", True, np.ones(3, dtype=bool)):
        with pytest.raises(InputError, match=r"^mass must be a number, got "):
            EquivalentPier(mass=mass, stiffness=1e8)
    for sides in ("3", True):
        with pytest.raises(InputError, match=r"^sides must be a number, got "):
            RegularPolygonSection(sides=sides, across_flats=1.0)
    truck = load_truck("single-unit-8t")
    with pytest.raises(InputError, match=r"^pier_mass must be an array of numbers, got '3'$"):
        peak_reactions(truck, "3", 1e8, 0.05, 20.0)
    with pytest.raises(InputError, match=r"^speed must be an array of numbers, got True$"):
        peak_reactions(truck, 8e3, 1e8, 0.05, True)
    with pytest.raises(InputError, match=r"^size must be a whole number, got True$"):
        reaction_band(truck, EquivalentPier(mass=8e3, stiffness=1e8), 22.0, size=True)


def test_input_errors_are_value_errors():
    assert issubclass(InputError, ValueError)
