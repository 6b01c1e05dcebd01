"""Every step of the sheet, calculated again from the values it prints."""

import dataclasses
import math
import re

import pytest
from mathml import half_unit

from pierimpact.files.case import case_from
from pierimpact.report.calculation import calculate
from pierimpact.report.document.numbered import CONTINUED
from pierimpact.report.sheet import design_procedure as design_steps
from pierimpact.report.sheet import equivalent_pier as pier_steps
from pierimpact.report.sheet import shape_steps
from pierimpact.units import _unit

SHAPES = {
    "circular": {"column_diameter": "36 in"},
    "rectangular": {"column_width": "1.3 m", "column_depth": "0.8 m"},
}
ENDS = [
    ("fixed", "free"),
    ("free", "fixed"),
    ("pinned", "pinned"),
    ("fixed", "pinned"),
    ("pinned", "fixed"),
    ("fixed", "fixed"),
]


def calculation(shape="circular", ends=("fixed", "pinned"), units="SI", **changes):
    values = {
        "column_shape": shape,
        "column_height": "5.3 m",
        "elastic_modulus": "27 GPa",
        "poisson_ratio": 0.17,
        "density": "2450 kg/m^3",
        "base": ends[0],
        "top": ends[1],
        "truck": "single-unit-8t",
        "speed": "70 km/h",
        "impact_height": "1.17 m",
        "units": units,
    }
    return calculate(case_from(values | SHAPES[shape] | changes))


def all_steps(result):
    functions = (
        pier_steps.section_steps,
        pier_steps.unit_force_steps,
        pier_steps.stiffness_steps,
        shape_steps.mass_steps,
    )
    steps = [equation for function in functions for equation in function(result).equations]
    return [*steps, *shape_steps.shape_steps(result).equations[:-2]]  # the last two are in s


GROUP = r"\{((?:[^{}]|\{[^{}]*\})*)\}"
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?")


def as_python(tex):
    """Return a formula with numbers and units put in as an expression in SI units."""

    def unit(match):
        return f"*unit('{match[1].translate(str.maketrans('²³⁴·', '234*'))}')"

    text = tex.replace(r"\left", "").replace(r"\right", "").replace(CONTINUED, "")
    text = text.replace("[", "(").replace("]", ")")
    text = re.sub(r"(?<=\d)\\,(?=\d)", "", text)  # thousands
    text = re.sub(r"10\^\{(-?\d+)\}", r"10**(\1)", text)
    text = re.sub(r"\\ \\text\{([^}]*)\}", unit, text)
    while "frac" in text or r"\sqrt" in text:
        text = re.sub(rf"\\sqrt{GROUP}", r"math.sqrt(\1)", text)
        text = re.sub(rf"\\frac{GROUP}{GROUP}", r"((\1)/(\2))", text)
    text = text.replace(r"\pi", "math.pi").replace(r"\times", "*").replace("^", "**")
    text = text.replace(r"\,", "*")
    return re.sub(r"(?<=[\d)i]) *(?=\(|math)", "*", text)  # a product without a cross


def value(expression):
    return eval(expression, {"math": math, "unit": lambda text: _unit(text)[0]})


def spread(expression):
    """Return how far the rounding of the numbers in an expression can move its value."""
    whole = 0.0
    for match in NUMBER.finditer(expression):
        moved = float(match[0]) + half_unit(match[0])
        changed = f"{expression[: match.start()]}{moved!r}{expression[match.end() :]}"
        whole += abs(value(changed) - value(expression))
    return whole


def check(equation):
    """Check that the values put in give the result, as far as the printed digits tell."""
    whole = " = ".join(equation.lines).replace(f" = {CONTINUED}", " ")
    sides = whole.split(" = ")
    if len(sides) < 2:
        return  # nothing to put in
    put_in, shown = sides[-2:]
    if r"\text" not in put_in:  # in units of length and force, as the result
        shown = re.sub(r"\\ \\text\{[^}]*\}", "", shown)
    substitution, result = as_python(put_in), as_python(shown)
    allowed = 1.01 * (spread(substitution) + spread(result))
    assert value(substitution) == pytest.approx(value(result), rel=1e-12, abs=allowed), equation


@pytest.mark.parametrize("units", ["SI", "US"])
@pytest.mark.parametrize("shape", sorted(SHAPES))
@pytest.mark.parametrize("ends", ENDS, ids="-".join)
def test_every_step_can_be_repeated_by_hand(shape, ends, units):
    result = calculation(shape, ends, units)
    equations = all_steps(result)
    assert len({equation.label for equation in equations}) == len(equations)
    for equation in equations:
        check(equation)


def test_the_check_would_notice_a_wrong_digit():
    right = all_steps(calculation())[0]
    wrong = dataclasses.replace(right, lines=[right.lines[0], right.lines[1].replace("656", "657")])
    check(right)
    with pytest.raises(AssertionError):
        check(wrong)


@pytest.mark.parametrize("ends", ENDS, ids="-".join)
def test_the_results_are_those_of_the_calculation(ends):
    result = calculation(ends=ends)
    printed = {
        step.label: value(as_python(step.lines[-1].split(" = ")[-1])) for step in all_steps(result)
    }
    expected = {
        "eq-kp": result.pier.stiffness,
        "eq-mp": result.pier.mass,
        "eq-fp": result.pier.frequency,
        "eq-cp": result.pier.damping,
        "eq-Rt": result.struck.unit_forces.top_force,
        "eq-Mt": result.struck.unit_forces.top_moment,
    }
    for label, number in expected.items():
        assert printed[label] == pytest.approx(number, rel=5e-4), label


def test_modulus_from_strength_says_where_it_is_from():
    result = calculation(elastic_modulus=None, concrete_strength="28 MPa")
    modulus = pier_steps.section_steps(result).equations[0]
    assert "unverified: check against the standard" in modulus.source
    check(modulus)


def test_the_shape_polynomials_and_the_table_agree():
    result = calculation()
    below, above = shape_steps.shape_steps(result).equations[-2:]
    height, impact = 5.3, 1.17
    for row in shape_steps.shape_table(result).rows:
        z, phi = (float(str(cell)) for cell in row[:2])
        equation, s = (below, z / height) if z <= impact else (above, (height - z) / height)
        text = as_python(equation.lines[1].partition(r" \quad")[0].replace(r"\, s", f"*{s!r}"))
        assert value(text) == pytest.approx(phi, rel=1e-3, abs=1e-4)


@pytest.mark.parametrize(("speed", "stops"), [("30 km/h", True), ("80 km/h", False)])
def test_the_time_of_a_contact_that_does_not_come_about_says_so(speed, stops):
    case = calculation(speed=speed)
    for part, label in (("engine", "eq-engine_time"), ("contact", "eq-cargo_time")):
        steps = design_steps.procedure_steps(case, part).equations
        (source,) = (step.source for step in steps if step.label == label)
        assert ("stops before" in source) == stops
