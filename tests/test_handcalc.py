"""Calculations that compute and print: what prints is what is computed, and only what applies."""

import ast
import math
from math import pi

import mathml
import numpy as np
import pytest
from numpy import arctan2, exp, floor, hypot, maximum, minimum, mod, nan, sqrt, where

from pierimpact.design.procedure import LEVELS
from pierimpact.handcalc import Calculation, Step
from pierimpact.latex import CalculationError
from pierimpact.pier import rigidities, sections
from pierimpact.pier.equivalent import equivalent_mass, vibration
from pierimpact.pier.unit_force import BY_ENDS
from pierimpact.symbols import SYMBOLS

FACTOR = 2.5
LIMIT, SHADOWED, TINY, LONG = -3.0, 7.0, 2e-5, 0.123456789


def calculations_in(module):
    """Return the calculations of a module by name."""
    return [(name, found) for name, found in vars(module).items() if type(found) is Calculation]


EVERY = {
    **{f"section {name}": found for name, found in calculations_in(sections)},
    **{f"rigidities {name}": found for name, found in calculations_in(rigidities)},
    "mass": equivalent_mass,
    "vibration": vibration,
    **LEVELS,
    **{"-".join(ends): calculation for ends, calculation in BY_ENDS.items()},
}


def halved(x):
    """Return half of x."""
    return x / 2


def scaled(x, factor=FACTOR):
    return factor * x


def pair(x, y):
    total = x + y
    root = sqrt(total)  # of the sum
    return total, root


@Calculation
def example(a, b, c, other=pair):
    d = where((a > 0) & (b > 1), a * b, halved(a - b))
    total, e = pair(a**2, b**2)
    f, g = other(total, e)
    unused = c / 0.5
    h = where(g > c, scaled(f), minimum(f, d))  # chosen
    return locals()


SHOWN = {name: name for name in ("a", "b", "c", "d", "e", "f", "g", "h", "total", "unused")}


def steps(a, b, c, *results):
    with np.errstate(all="ignore"):
        values = example(a=a, b=b, c=c)
    return values, {step.name: step for step in example.steps(values, results)}


def test_it_computes_on_floats_and_on_arrays():
    a, b, c = np.array([1.0, -2.0]), np.array([3.0, 0.5]), np.array([1.0, 9.0])
    together = example(a=a, b=b, c=c)
    for i in range(2):
        one = {n: float(v) for n, v in example(a=a[i], b=b[i], c=c[i]).items()}
        assert {name: float(value[i]) for name, value in together.items()} == pytest.approx(one)
    assert together["d"][0] == 3.0
    assert "other" not in together


def test_only_what_the_results_rest_on_is_printed():
    _, found = steps(1.0, 3.0, 1.0, "h")
    assert list(found) == ["total", "e", "f", "g", "h"]
    _, found = steps(1.0, 3.0, 100.0, "h")
    assert list(found) == ["d", "total", "e", "f", "g", "h"]
    _, found = steps(1.0, 3.0, 1.0, "d")
    assert list(found) == ["d"]
    assert example.names == ("d", "total", "e", "f", "g", "unused", "h")
    assert example.given == ("a", "b", "c")


@pytest.mark.parametrize(
    ("a", "b", "formula", "conditions"),
    [
        (1.0, 3.0, r"a \, b", ["a > 0", "b > 1"]),
        (-1.0, 3.0, r"\frac{a - b}{2}", [r"a \le 0"]),
        (1.0, 0.5, r"\frac{a - b}{2}", [r"b \le 1"]),
    ],
)
def test_a_condition_prints_as_the_side_that_applies_and_why(a, b, formula, conditions):
    _, found = steps(a, b, 1.0, "d")
    assert found["d"].latex(SHOWN) == formula
    assert [condition.latex(SHOWN) for condition in found["d"].conditions] == conditions


def test_parts_print_under_the_names_of_their_caller_with_their_remarks():
    _, found = steps(1.0, 3.0, 1.0, "h")
    assert found["total"].latex(SHOWN) == "a^{2} + b^{2}"
    assert found["e"].latex(SHOWN) == r"\sqrt{total}"
    assert found["f"].latex(SHOWN) == "total + e"
    assert (found["e"].remark, found["h"].remark, found["f"].remark) == ("of the sum", "chosen", "")


def test_formulas_and_constants_print_in_full():
    _, found = steps(1.0, 3.0, 1.0, "h")
    assert found["h"].latex(SHOWN) == r"2.5 \, f"
    assert found["h"].latex({"f": "7.0"}, r"\times") == r"2.5 \times 7.0"


def shadowed(x):
    return SHADOWED * x


@Calculation
def with_constants(x, SHADOWED):
    a = where(x > LIMIT, TINY * x, LONG * x)
    b = shadowed(x)
    c = where(scaled(x) > 1, x, LIMIT * pi - x)
    d = x - LONG / (1 + x)
    return locals()


def larger(x, y):
    return where(x > y, x, y)


@Calculation
def repeated(x, y):
    a = where(x > y, x, y) + larger(x, y) * larger(y, x)
    return locals()


def test_a_condition_is_noted_once():
    (step,) = repeated.steps(repeated(x=1.0, y=2.0), ["a"])
    shown = {"x": "x", "y": "y"}
    assert step.latex(shown) == r"y + y \, y"
    assert [each.latex(shown) for each in step.conditions] == [r"x \le y", "y > x"]


def test_constants_print_as_what_they_are_wherever_they_stand():
    values = with_constants(x=0.25, SHADOWED=2.0)
    assert values["b"] == 7.0 * 0.25
    found = {step.name: step for step in with_constants.steps(values, with_constants.names)}
    shown = {"x": "x", "SHADOWED": "s"}
    assert {name: step.latex(shown) for name, step in found.items()} == {
        "a": r"2 \times 10^{-5} \, x",
        "b": r"7 \, x",
        "c": r"(-3) \pi - x",
        "d": r"x - \frac{0.123456789}{1 + x}",
    }
    assert [each.latex(shown) for each in found["a"].conditions] == ["x > -3"]
    assert [each.latex(shown) for each in found["c"].conditions] == [r"2.5 \, x \le 1"]
    assert found["a"].names == {"x"}


@Calculation
def powers(x, y):
    r = -(x**2) * exp(-x * y / 2)
    s = hypot(x - y, 2 * pi * y) - (x - (y - 1))
    t = mod(arctan2(-x, y) + floor(x / y), 2 * pi)
    u = maximum(maximum(x, y), minimum(y, -x)) / (x / y)
    v = (x + y) * (x - y) ** 3 - -x
    w = x / (y * (1 + x**2)) * ((y + 1) / 2)
    p = (x / (1 + y)) ** 2 + (x**2) ** y + exp(x / y) ** 2 + exp(-x / y * y)
    q = 1 / sqrt((x + 2) / (y + 1)) + hypot(x / (1 + y), y**2)
    o = mod(x, y) * y + mod(x, y) ** 2
    return locals()


def test_what_prints_is_what_is_computed():
    random, formulas, expected = np.random.default_rng(1), [], []
    for x, y in np.round(random.uniform(0.1, 9.0, (25, 2)), 3).tolist():
        values = powers(x=x, y=y)
        for step in powers.steps(values, powers.names):
            formulas.append(step.latex({"x": "x", "y": "y"}))
            formulas.append(step.latex({"x": f"{x:.3f}", "y": f"{y:.3f}"}, r"\times"))
            expected += [(x, y, float(values[step.name]))] * 2
    for formula, (x, y, value) in zip(mathml.converted(formulas), expected, strict=True):
        (words,) = mathml.rows(formula)
        found, _ = mathml.evaluate(words, {("x",): (x, 0.0), ("y",): (y, 0.0)})
        assert found == pytest.approx(value, rel=1e-9, abs=1e-12), formula


def test_brackets_stand_where_the_tree_needs_them_and_nowhere_else():
    found = {step.name: step.latex({"x": "x", "y": "y"}) for step in powers.steps(
        powers(x=1.0, y=2.0), powers.names)}  # fmt: skip
    assert found["r"] == r"-x^{2} \, \mathrm{e}^{-x \, y / 2}"
    assert found["s"] == r"\sqrt{\left(x - y\right)^2 + \left(2 \pi \, y\right)^2} - " + (
        r"\left[x - \left(y - 1\right)\right]"
    )
    assert found["u"] == r"\frac{\max(x, y, \min(y, -x))}{x / y}"
    assert found["o"] == r"\left(x \bmod y\right) \, y + \left(x \bmod y\right)^{2}"
    assert found["v"] == r"\left(x + y\right) \, \left(x - y\right)^{3} - \left(-x\right)"


def test_values_with_a_sign_a_unit_or_a_power_of_ten_are_in_brackets_where_needed():
    shown = {"x": r"-1.5 \times 10^{3}", "y": r"2\ \text{m}"}
    found = {step.name: step.latex(shown, r"\times") for step in powers.steps(
        powers(x=-1.5, y=2.0), ["v", "w"])}  # fmt: skip
    assert found["v"].startswith(r"\left(-1.5 \times 10^{3} + 2\ \text{m}\right)")
    assert r"(-1.5 \times 10^{3})^{2}" in found["w"]


@Calculation
def repeats(x):
    total = 0
    for each in x:
        total = total + each
    return locals()


@Calculation
def unknown(x):
    y = np.interp(x, [0, 1], [0, 2])
    return locals()


@Calculation
def with_method(x):
    y = x.sum()
    return locals()


def longer(x):
    y = x + 1
    return y * 2


@Calculation
def calls_longer(x):
    y = longer(x)
    return locals()


def hides(x):
    inner = x + 1
    outer = inner**2
    return (outer,)


@Calculation
def with_hidden(x):
    (y,) = hides(x)
    return locals()


@Calculation
def compares(x):
    y = where((x > 1) | (x < 0), x, 0)
    return locals()


@Calculation
def names_arguments(x):
    y = scaled(x, factor=3)
    return locals()


@Calculation
def equals(x):
    y = where(x == 1, x, 0)
    return locals()


@Calculation
def gives_twice(x):
    y = x + 1
    y = 2 * y
    return locals()


@pytest.mark.parametrize(
    ("calculation", "given", "words"),
    [
        (names_arguments, {"x": 1.0}, "cannot print: scaled(x, factor=3)"),
        (equals, {"x": 1.0}, "cannot print: x == 1"),
        (gives_twice, {"x": 1.0}, "gives_twice gives y twice"),
        (repeats, {"x": [1.0]}, "repeats has what a calculation cannot print: for each in x"),
        (unknown, {"x": 0.5}, "cannot print: np.interp(x, [0, 1], [0, 2])"),
        (with_method, {"x": np.ones(2)}, "cannot print: x.sum()"),
        (
            calls_longer,
            {"x": 1.0},
            "the formula longer has what a calculation cannot print: y = x + 1",
        ),
        (with_hidden, {"x": 1.0}, "hides must return every symbol that it gives"),
        (compares, {"x": 2.0}, r"the condition has what a calculation cannot print: (x > 1) | (x"),
    ],
)
def test_what_does_not_print_is_refused_and_named(calculation, given, words):
    values = calculation(**given)
    with pytest.raises(CalculationError) as error:
        printed(calculation, values)
    assert words in str(error.value)


def printed(calculation, values):
    for step in calculation.steps(values, ["y" if "y" in values else "total"]):
        for condition in step.conditions:
            condition.latex({"x": "x"})


def test_symbols_that_are_products_stay_together():
    @Calculation
    def quotient(x, y):
        q = x / y + x**3 / (3 * y) + (x / y) ** 2
        return locals()

    (step,) = quotient.steps(quotient(x=1.0, y=2.0), ["q"])
    found = step.latex({"x": "H", "y": r"\kappa GA"})
    assert found == (
        r"\frac{H}{\kappa GA} + \frac{H^{3}}{3 \, \kappa GA} + \left(\frac{H}{\kappa GA}\right)^{2}"
    )


# The package's own calculations


@pytest.mark.parametrize("name", EVERY)
def test_every_calculation_can_be_printed(name):
    calculation = EVERY[name]
    expressions = [line.expression for line in calculation._lines]
    assert expressions
    random = np.random.default_rng(3)
    for _ in range(30):
        given = {name: float(random.uniform(0.05, 0.5)) for name in calculation.given}
        given |= {"on_pier": bool(random.integers(2))} if "on_pier" in given else {}
        with np.errstate(all="ignore"):
            values = calculation(**given)
        for step in calculation.steps(values, calculation.names):
            assert isinstance(step, Step)
            assert step.latex({n: SYMBOLS[n].latex for n in step.names})
            if "where" not in ast.unparse(step.expression) and not math.isnan(values[step.name]):
                assert set(step.names) <= set(values)


@pytest.mark.parametrize("name", EVERY)
def test_every_symbol_of_a_calculation_is_in_the_table_and_unlike_the_others(name):
    names = (*EVERY[name].given, *EVERY[name].names)
    assert set(names) <= set(SYMBOLS)
    latex = [SYMBOLS[name].latex for name in names]
    assert len(set(latex)) == len(latex)


def test_steps_split_at_names_even_where_these_are_not_printed():
    values, _ = steps(1.0, 3.0, 1.0, "h")
    found = example.split(example.steps(values, ["h"]), "total", "unused")
    assert [[step.name for step in part] for part in found] == [[], ["total", "e", "f", "g"], ["h"]]


def test_nan_on_the_side_not_taken_does_no_harm():
    @Calculation
    def rooted(x):
        y = where(x > 0, sqrt(x), nan)
        return locals()

    assert [step.latex({"x": "x"}) for step in rooted.steps({"x": 4.0, "y": 2.0}, ["y"])] == [
        r"\sqrt{x}"
    ]
