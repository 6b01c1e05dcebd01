import math

import numpy as np
import pytest

from pierimpact import CircularSection, InputError, PierColumn
from pierimpact.checks import (
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
    for value, message in ((2, "be at least 3, got 2"), (3.0, r"be a whole number, got 3\.0")):
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


def test_input_errors_are_value_errors():
    assert issubclass(InputError, ValueError)
