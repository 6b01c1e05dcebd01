"""`pierimpact schema`: takes what the reader of case files takes, and refuses plain slips."""

import json

import pytest
import test_arranged_sheet
import test_casefile
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from sheet_page import US_CASE
from test_casefile import CASE, OTHER, SECTIONS

from pierimpact import cli
from pierimpact.checks import InputError
from pierimpact.files.case import SHAPES, case_from, read_case_file
from pierimpact.files.inputs import KEYS, RevisionInputs, StepInputs
from pierimpact.files.new_case import new_case
from pierimpact.files.plausible import USUAL
from pierimpact.files.schema import case_schema
from pierimpact.resources import shipped
from pierimpact.units import DIMENSIONS, SYSTEMS, parse, pattern

EXAMPLE = shipped("notebooks") / "tti-column.yaml"
SCHEMA = case_schema()
VALIDATOR = Draft202012Validator(SCHEMA)


def refusals(values):
    return [error.message for error in VALIDATOR.iter_errors(values)]


def test_it_is_a_schema_of_every_key():
    Draft202012Validator.check_schema(SCHEMA)
    assert tuple(SCHEMA["properties"]) == KEYS
    for name, model in (("StepInputs", StepInputs), ("RevisionInputs", RevisionInputs)):
        assert list(SCHEMA["$defs"][name]["properties"]) == list(model.model_fields)
    for part in (SCHEMA, SCHEMA["$defs"]["StepInputs"], SCHEMA["$defs"]["RevisionInputs"]):
        assert part["additionalProperties"] is False
        assert all(len(value["description"]) > 5 for value in part["properties"].values())
    for key in USUAL:
        assert ". Usual: " in SCHEMA["properties"][key]["description"]


def plain(case_file):
    own = case_file.parameters
    return {key: own[key] for key in own if key in KEYS}


def good_cases(folder):
    for shape in SHAPES:
        yield OTHER | {"column_shape": shape} | SECTIONS[shape]
        for system in SYSTEMS:
            path = folder / "case.yaml"
            path.write_text(new_case(shape=shape, system=system), encoding="utf-8")
            yield plain(read_case_file(path))
    yield plain(read_case_file(EXAMPLE))
    yield from (CASE, US_CASE, test_arranged_sheet.CASE)
    yield US_CASE | {"column_height": "16'-6 1/2\"", "speed": "80 km h^-1", "density": "2.4 t/m³"}
    yield CASE | {
        "annexes": "all",
        "revisions": [{"revision": "A", "date": "2026-01-31"}],
        "assumed": {"speed": "posted"},
        "stiffness_factor": 0.5,
        "effective_stiffness": None,
        "truck": "folder/mine.toml",
        "notes": None,
    }


def test_good_cases_are_taken(tmp_path):
    cases = list(good_cases(tmp_path))
    assert len(cases) > 3 * len(SHAPES)
    assert [refusals(case) for case in cases] == [[]] * len(cases)


BAD = [
    {"colunm_height": "5 m"},
    {"speed": None},
    {"speed": 80},
    {"speed": "80"},
    {"speed": "80 km"},
    {"speed": "80 kmh"},
    {"speed": "fast"},
    {"truck_mass": "80 kip"},
    {"truck": "single"},
    {"column_shape": "round"},
    {"column_diameter": None},
    {"column_width": "1 m"},
    {"column_shape": "hollow circular"},
    {"column_sides": 8},
    {"stiffness_factor": "35 %"},
    {"stiffness_factor": 0.5, "effective_stiffness": "250 MN*m^2"},
    {"elastic_modulus": None},
    {"elastic_modulus": "25 mPa"},
    {"concrete_strength": "28 MPa"},
    {"base": "fix"},
    {"impact_height": "automatic"},
    {"damping_ratio": "5 %"},
    {"damping_ratio": 1.0},
    {"damping_ratio": -0.05},
    {"damping_ratio": True},
    {"poisson_ratio": 0.6},
    {"units": "metric"},
    {"job_number": 7},
    {"notes": "one"},
    {"notes": [1]},
    {"assumed": ["base"]},
    {"assumed": {"bse": "x"}},
    {"assumed": {"base": 1}},
    {"annexes": ["pyer"]},
    {"annexes": "pier"},
    {"member_forces": "both"},
    {"revisions": [{"revision": "A"}]},
    {"revisions": [{"revision": "A", "date": "2026-01-31"}] * 9},
    {"steps": [{"column_shape": "circular", "column_diameter": "1 m"}]},
    {"steps": [{"height": "2 m", "column_shape": "circular", "column_width": "1 m"}]},
    {"steps": [{"height": "2 m", "column_shape": "circular", "speed": "1 m/s"}]},
]


@pytest.mark.parametrize("change", BAD, ids=str)
def test_bad_cases_are_refused_by_the_schema_and_by_the_reader(change):
    assert refusals(CASE | change)
    with pytest.raises(InputError):
        case_from(CASE | change)


NUMBER = st.sampled_from(["5", "-5", "+2.5", "1e3", ".5", "3.", "5e-2", "1,5", "nan", ""])
SINGLE = [
    *("m", "mm", "in", "ins", "inch", "ft", "yd", "mile", "kg", "t", "lb", "g", "s", "ms", "h"),
    *("min", "N", "kN", "MN", "lbf", "kip", "kips", "MPa", "psi", "ksi", "J", "Hz", "mph", "kph"),
    *("rad", "mN", "mPa", "meter", "x"),
]
UNIT = st.sampled_from(
    [*SINGLE, "km/h", "kg/m³", "lb/ft^3", "MN*m", "kN·m", "in2", "N*m/rad", "MN/m"]
)
POWER = st.sampled_from(["", "", "^2", "²", "**3", "4", "^-1", "⁴", "0"])
FACTORS = st.lists(st.builds("{}{}{}".format, st.sampled_from("*/· "), UNIT, POWER), max_size=2)
QUANTITY = st.builds(
    lambda number, space, unit, power, more: f"{number}{space}{unit}{power}{''.join(more)}",
    *(NUMBER, st.sampled_from(["", " "]), UNIT, POWER, FACTORS),
)
INCHES = st.sampled_from(["", "6", "6 1/2", "3/4", "11.5", "13", "6-1/2"])
FEET_AND_INCHES = st.builds(
    "{}{}{}{}{}".format,
    st.sampled_from(["", "24", " 6", "1/2", "2.5"]),
    st.sampled_from(["", " ft", "'", "′", "ft.", "’"]),
    st.sampled_from(["", " ", "-", " - "]),
    INCHES,
    st.sampled_from(["", " in", '"', "″", " in.", "inch", "”"]),
)
PATTERNS = {
    dimension: Draft202012Validator({"pattern": pattern(dimension)}) for dimension in DIMENSIONS
}


def is_parsed(text, dimension):
    try:
        return bool(parse("value", text, dimension))
    except InputError:
        return False


@settings(max_examples=500)
@given(st.sampled_from(sorted(DIMENSIONS)), QUANTITY | FEET_AND_INCHES)
def test_the_pattern_of_a_quantity_matches_all_that_is_parsed(dimension, text):
    assert PATTERNS[dimension].is_valid(text) or not is_parsed(text, dimension)


@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_a_single_unit_is_matched_only_where_it_is_parsed(dimension):
    for unit in SINGLE:
        for text in (f"5 {unit}", f"2.5e3{unit}"):
            assert PATTERNS[dimension].is_valid(text) == is_parsed(text, dimension), text


@settings(max_examples=200)
@given(st.sampled_from(KEYS), test_casefile.VALUES | QUANTITY | st.sampled_from(["auto", "all"]))
def test_no_case_is_refused_that_the_reader_takes(key, value):
    try:
        case_from(CASE | {key: value})
    except InputError:
        return
    assert refusals(CASE | {key: value}) == []


def test_the_command_prints_it(capsys):
    assert cli.main(["schema"]) == 0
    assert json.loads(capsys.readouterr().out) == SCHEMA
