"""Values that are legal but unusual are named, with what is usual."""

import pytest
from sheet_page import US_CASE

from pierimpact.files.case import case_from
from pierimpact.files.inputs import PHYSICAL_KEYS
from pierimpact.files.plausible import USUAL, unusual
from pierimpact.report.calculation import calculate
from pierimpact.report.warnings import warnings_of


def test_an_ordinary_case_has_nothing_unusual():
    assert not list(unusual(case_from(US_CASE).inputs))


@pytest.mark.parametrize(
    ("change", "key", "words"),
    [
        (
            {"elastic_modulus": "3.2 GPa", "units": "SI"},
            "elastic_modulus",
            "Unusual: elastic modulus 3.2 GPa, where 10 to 60 is usual.",
        ),
        (
            {"column_height": "40 m", "units": "SI"},
            "column_height",
            "Unusual: column height 40 m, where 2.0 to 30 is usual.",
        ),
        (
            {"speed": "180 mph"},
            "speed",
            "Unusual: speed at first touch 180 mph, where 6.2 to 99 is usual.",
        ),
    ],
)
def test_an_unusual_value_is_named_on_page_one(change, key, words):
    steel = {"concrete_strength": None, "elastic_modulus": "25 GPa", "member_forces": "static"}
    case = case_from(US_CASE | steel | change)
    assert [found.key for found in unusual(case.inputs)] == [key]
    assert any(str(line).startswith(words) for line in warnings_of(calculate(case)))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            {"column_width": "8 m", "impact_height": "1.35 m"},
            ("8 m wide", "2.5 m wide", "5.2 m at"),
        ),
        ({"column_width": "12 m"}, ("12 m wide", "4.6 m at")),  # auto: the lower height
        ({"column_width": "5.3 m", "impact_height": "1.35 m"}, ("5.3 m wide", "5.2 m at")),
        ({"column_width": "5.1 m", "impact_height": "1.35 m"}, ()),
        ({"column_width": "8 ft"}, ()),
    ],
)
def test_of_a_wall_the_sheet_says_how_much_a_truck_engages(change, words):
    static = {"units": "SI", "member_forces": "static", "shear_resistance": "90 MN"}
    case = case_from(US_CASE | static | {"moment_resistance": "90 MN*m"} | change)
    found = [line for line in warnings_of(calculate(case))[:4] if "a rule of this project" in line]
    assert len(found) == bool(words)
    assert all(word in line for line in found for word in words)


def test_only_the_section_that_is_struck_is_a_wall():
    step = {"height": "2 m", "column_shape": "rectangular"}
    wide, narrow = ({"column_width": width, "column_depth": "1 m"} for width in ("8 m", "2 m"))
    for low, high, is_wall in ((wide, narrow, True), (narrow, wide, False)):
        values = low | {"steps": [step | high], "member_forces": "static"}
        lines = warnings_of(calculate(case_from(US_CASE | values)))
        assert any("as one beam" in line for line in lines) == is_wall


CIRCLE = {"column_shape": "circular", "column_width": None, "column_depth": None}


def test_the_sections_of_steps_are_looked_at_as_well():
    steps = [
        {"height": "2 m", "column_shape": "circular", "column_diameter": "1 m"},
        {"height": "3 m", "column_shape": "circular", "column_diameter": "8 m"},
    ]
    case = case_from(US_CASE | CIRCLE | {"column_diameter": "1.2 m", "steps": steps, "units": "SI"})
    (found,) = unusual(case.inputs)
    assert found == ("column_diameter", 8.0, *USUAL["column_diameter"], 2)
    assert found.sentence("SI").startswith("Unusual: column diameter 8 m in step 2, where 0.30 to")


@pytest.mark.parametrize(
    ("density", "modulus", "named"),
    [
        ("2400 kg/m^3", "3.2 GPa", True),
        ("2400 kg/m^3", "9.9 GPa", True),
        ("2400 kg/m^3", "10 GPa", False),
        ("2400 kg/m^3", "60 GPa", False),
        ("2400 kg/m^3", "200 GPa", True),  # steel, or a slip
        ("7850 kg/m^3", "200 GPa", False),
        ("7850 kg/m^3", "29000 ksi", False),
        ("7850 kg/m^3", "30 GPa", True),
        ("7850 kg/m^3", "230 GPa", True),
    ],
)
def test_what_modulus_is_usual_depends_on_the_material(density, modulus, named):
    change = {"density": density, "elastic_modulus": modulus, "concrete_strength": None}
    found = [found.key for found in unusual(case_from(US_CASE | change).inputs)]
    assert found == ["elastic_modulus"] * named


def test_ranges_are_of_physical_keys():
    assert set(USUAL) <= set(PHYSICAL_KEYS)
    assert all(0.0 < least < most for least, most in USUAL.values())


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            {"truck_mass": "29 t", "units": "SI"},
            "A 29 000 kg mass on the springs of single-unit-8t is ",
        ),
        (
            {"truck_mass": "64000 lb"},
            "A 64 000 lb mass on the springs of single-unit-8t is another",
        ),
        ({"truck_mass": "9 t"}, ""),
        ({"truck_mass": "29 t", "truck": "tractor-trailer-36t"}, ""),
        (
            {"truck_mass": "19 t", "truck": "tractor-trailer-36t"},
            "A 41 900 lb (19 000 kg) mass on the springs of tra",
        ),
    ],
)
def test_a_mass_beyond_the_trucks_range_is_named_on_page_one(change, words):
    case = case_from(US_CASE | {"member_forces": "static"} | change)
    found = [str(line) for line in warnings_of(calculate(case)) if "another truck" in str(line)]
    assert len(found) == bool(words)
    assert not words or found[0].startswith(words)
    assert not words or "The range is assumed: judgement of this project" in found[0]
