"""The equations as printed, evaluated from the values printed before them."""

import dataclasses
import math
import re

import latex_formulas
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pierimpact.design.equations import GIVEN

from pierimpact import EquivalentPier, design_reaction, load_truck
from pierimpact.design.procedure import LEVELS

GENERATED = settings(max_examples=80)
TRUCK = load_truck("single-unit-8t")
PIER = EquivalentPier(mass=8e3, stiffness=284e6, damping_ratio=0.05)

# A pier and a speed for each way that the collision can go.
WAYS = {
    "both meet": (PIER, 80.0 / 3.6),
    "engine only": (PIER, 55.0 / 3.6),
    "neither meets": (PIER, 20.0 / 3.6),
    "engine cut short": (EquivalentPier(mass=80e3, stiffness=60e6), 28.0),
    "plateaus crest before the engine": (EquivalentPier(mass=9e4, stiffness=1.5e9), 15.0),
}


def check(design, tolerance=1e-9):
    """Evaluate every formula of a design from what stands before it."""
    values = {step.name: float(step.value) for step in design.given}
    for step in design.steps:
        found = latex_formulas.evaluate(step.formula, values)
        scale = {"m": 1e-6, "m/s": 1e-3, "rad": 1.0}.get(step.unit, 0.0)
        assert step.value == pytest.approx(found, rel=tolerance, abs=tolerance * scale), step
        values[step.name] = step.value
    return values


@pytest.mark.parametrize("level", LEVELS)
@GENERATED
@given(
    st.floats(math.log(2.0), math.log(200.0)),
    st.floats(math.log(2e3), math.log(2e5)),
    st.floats(0.0, 0.2),
    st.floats(3.0, 36.0),
    st.sampled_from(["road", "pier"]),
    st.floats(5e3, 40e3),
)
def test_every_value_follows_from_those_before_it(
    level, frequency, mass, damping, speed, friction_on, truck_mass
):
    pier = EquivalentPier(
        mass=math.exp(mass),
        stiffness=math.exp(mass) * (2.0 * math.pi * math.exp(frequency)) ** 2,
        damping_ratio=damping,
    )
    truck = dataclasses.replace(TRUCK, friction_on=friction_on).with_mass(truck_mass)
    design = design_reaction(truck, pier, speed, level=level)
    values = check(design)
    assert values["engine"] == design.engine
    assert values.get("cargo") == design.cargo


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("way", WAYS)
def test_steps_of_each_way_it_can_go(way, level):
    pier, speed = WAYS[way]
    design = design_reaction(TRUCK, pier, speed, level=level)
    check(design)
    names = [step.name for step in design.steps]
    assert ("engine_S" in names) == design.engine_contact == (way != "neither meets")
    assert ("cargo" in names) == (design.cargo is not None)
    if way == "engine cut short" and level == "refined":
        assert "cargo_pier_x" in by_name(design)["engine"].formula
    if way == "plateaus crest before the engine":
        assert (
            "overshoot" in by_name(design)["engine" if level == "hand" else "engine_alone"].formula
        )


def by_name(design):
    return {step.name: step for step in design.steps}


def test_the_check_would_notice_a_wrong_number_and_a_wrong_formula():
    design = design_reaction(TRUCK, PIER, 80.0 / 3.6)
    steps = list(design.steps)
    place = next(i for i, step in enumerate(steps) if step.name == "late_x")
    for wrong in (
        steps[place]._replace(value=steps[place].value * 1.0001),
        steps[place]._replace(formula=steps[place].formula.replace("1 + <cargo_e>", "<cargo_e>")),
    ):
        broken = dataclasses.replace(design)
        broken.__dict__["steps"] = (*steps[:place], wrong, *steps[place + 1 :])
        with pytest.raises(AssertionError):
            check(broken)


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("way", WAYS)
def test_symbols_are_unique_and_equations_hold_no_names(way, level):
    pier, speed = WAYS[way]
    design = design_reaction(TRUCK, pier, speed, level=level)
    every = [*design.given, *design.steps]
    symbols = [step.symbol for step in every]
    assert len(set(symbols)) == len(symbols)
    for step in every:
        assert not re.search(r"[<>]", step.equation)
        assert step.meaning
        assert step.unit
        assert step.equation.count("{") == step.equation.count("}")
        assert step.equation.count(r"\left") == step.equation.count(r"\right")
    assert all(step.equation == step.formula == "" for step in design.given)
    assert all(step.equation for step in design.steps)


def test_given_are_truck_pier_and_speed():
    given_values = {step.name: step.value for step in design_reaction(TRUCK, PIER, 20.0).given}
    assert list(given_values) == list(GIVEN)
    expected = {
        "V": 20.0,
        "m1": 700.0,
        "P2": 500e3,
        "ku2": 60e6,
        "cs": 21.5e3,
        "mp": 8e3,
        "kp": 284e6,
        "zeta": 0.05,
    }
    for name, value in expected.items():
        assert given_values[name] == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("level", LEVELS)
def test_a_calculation_with_printed_digits_comes_out_the_same(level):
    # A checker starts from rounded numbers: five figures carried give the reaction to 1 %.
    design = design_reaction(TRUCK, PIER, 80.0 / 3.6, level=level)
    values = {step.name: float(f"{step.value:.5g}") for step in design.given}
    for step in design.steps:
        values[step.name] = float(f"{latex_formulas.evaluate(step.formula, values):.5g}")
    assert values["engine"] == pytest.approx(design.engine, rel=0.01)
    assert values["cargo"] == pytest.approx(design.cargo, rel=0.01)


def test_the_evaluator_reads_latex():
    values = {"a": 2.0, "b": -3.0}
    for formula, expected in {
        r"\frac{<a>}{1 + \sqrt{<a> <x> 8}}": 0.4,
        r"\max(<a>, <b>) - \min(<a>, <b>)": 5.0,
        r"<b>^2 / (<a> - 5)": -3.0,
        r"\left[1 - e^{-<a> / 2}\right]": 1.0 - math.exp(-1.0),
        r"\operatorname{atan2}(<a>, <b>) \bmod (2 \pi)": math.atan2(2.0, -3.0),
        r"\left\lfloor \frac{<b>}{<a>} \right\rfloor": -2.0,
        r"[(1 + <a>) <x> <a>]^{1.5}": 6.0**1.5,
        r"\cos(<a>) + \arctan(<b>)": math.cos(2.0) - math.atan(3.0),
    }.items():
        assert latex_formulas.evaluate(formula, values) == pytest.approx(expected, rel=1e-14)
