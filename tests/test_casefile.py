import datetime
import hashlib
import json
import math
import os
import re
import shutil
from pathlib import Path
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st
from papermill.translators import PythonTranslator

import pierimpact
from pierimpact.checks import InputError
from pierimpact.files.case import (
    NOTEBOOK_PARAMETERS,
    SHAPES,
    Case,
    case_from,
    case_from_notebook,
    concrete_modulus,
    read_case_file,
)
from pierimpact.files.inputs import KEYS, PHYSICAL_KEYS, Inputs
from pierimpact.report.calculation import calculate
from pierimpact.report.results import Results
from pierimpact.report.sheet import Sheet
from pierimpact.report.summary import column_in_words
from pierimpact.report.write import report_notebook

CASE = {
    "project": "Example overpass",
    "column_shape": "circular",
    "column_diameter": "36 in",
    "column_height": "5.0 m",
    "elastic_modulus": "25 GPa",
    "density": "2400 kg/m^3",
    "base": "fixed",
    "top": "pinned",
    "truck": "single-unit-8t",
    "truck_mass": "9 t",
    "speed": "80 km/h",
    "impact_height": "1.2 m",
}


def test_a_case_becomes_the_core_objects():
    case = case_from(CASE)
    assert case.column.section.diameter == pytest.approx(0.9144, rel=1e-15)
    assert (case.column.height, case.column.elastic_modulus) == (5.0, 25e9)
    assert (case.column.base, case.column.top) == ("fixed", "pinned")
    assert (case.truck.mass, case.truck.engine_mass) == (9000.0, 700.0)
    assert case.truck_file.truck.mass == 8000.0
    assert case.inputs.speed == pytest.approx(80 / 3.6)
    assert case.impact_heights == (1.2,)
    assert (case.inputs.damping_ratio, case.inputs.poisson_ratio, case.inputs.units) == (
        0.05,
        0.2,
        "SI",
    )
    assert case.given == CASE


def test_the_case_is_frozen():
    case = case_from(CASE)
    with pytest.raises(AttributeError):
        case.column = None
    with pytest.raises(ValueError, match="frozen"):
        case.inputs.speed = 1.0


def test_rectangular_column_of_concrete():
    values = CASE | {
        "column_shape": "rectangular",
        "column_diameter": None,
        "column_width": "4 ft",
        "column_depth": "900 mm",
        "elastic_modulus": None,
        "concrete_strength": "28 MPa",
        "impact_height": "auto",
        "date": "2026-01-31",
    }
    case = case_from(values)
    assert case.column.section.width == pytest.approx(1.2192)
    assert case.column.section.depth == pytest.approx(0.9)
    assert case.column.elastic_modulus == pytest.approx(4700e6 * math.sqrt(28.0))
    assert case.impact_heights == (1.05, 1.35)
    for written in ("Auto", " AUTO "):
        assert case_from(values | {"impact_height": written}).impact_heights == (1.05, 1.35)
    assert case.inputs.date == datetime.date(2026, 1, 31)


def test_the_formula_for_concrete_is_that_of_the_unit_of_its_strength():
    values = CASE | {"elastic_modulus": None, "concrete_strength": "4000 psi", "units": "US"}
    psi = 0.45359237 * 9.80665 / 0.0254**2
    expected = 57000.0 * math.sqrt(4000.0) * psi
    assert case_from(values).column.elastic_modulus == pytest.approx(expected, rel=1e-14)
    # What the sheet prints in changes no result.
    assert case_from(values | {"units": "SI"}).column == case_from(values).column
    in_mpa = values | {"concrete_strength": f"{4000.0 * psi / 1e6!r} MPa"}
    for system in ("SI", "US"):
        modulus = case_from(in_mpa | {"units": system}).column.elastic_modulus
        assert modulus == pytest.approx(4700e6 * math.sqrt(4000.0 * psi / 1e6), rel=1e-14)


def test_concrete_modulus_is_near_the_form_of_the_formula_in_psi():
    # 57,000 √f_c' in psi, the other form of the same rule of thumb, rounds differently by 1 %.
    psi = 6894.757293168
    assert concrete_modulus(4000 * psi) == pytest.approx(57000 * math.sqrt(4000) * psi, rel=0.01)


SECTIONS = {
    "circular": {"column_diameter": "1.2 m"},
    "rectangular": {"column_width": "1.5 m", "column_depth": "1.2 m"},
    "hollow circular": {"column_diameter": "1.2 m", "column_wall_thickness": "200 mm"},
    "hollow rectangular": {
        "column_width": "1.5 m",
        "column_depth": "1.2 m",
        "column_wall_thickness": "200 mm",
    },
    "oblong": {"column_width": "0.8 m", "column_depth": "1.2 m"},
    "polygonal": {"column_sides": 8, "column_across_flats": "1.2 m"},
    "filled circular": {
        "column_diameter": "1.2 m",
        "column_wall_thickness": "16 mm",
        "modular_ratio": 7.0,
        "density_ratio": 3.2,
    },
    "filled rectangular": {
        "column_width": "1.5 m",
        "column_depth": "1.2 m",
        "column_wall_thickness": "16 mm",
        "modular_ratio": 7.0,
        "density_ratio": 3.2,
    },
    "free": {
        "column_area": "1.5 m^2",
        "column_second_moment": "0.18 m^4",
        "column_shear_area": "1.2 m^2",
    },
}
OTHER = CASE | {"column_diameter": None}


def test_every_shape_has_a_section_of_its_own():
    shapes = get_args(Inputs.model_fields["column_shape"].annotation)
    assert shapes == tuple(SHAPES) == tuple(SECTIONS)
    assert len({SHAPES[shape] for shape in shapes}) == len(shapes)


@pytest.mark.parametrize("shape", SECTIONS)
def test_a_shape_wants_its_keys_and_no_others(shape):
    given = SECTIONS[shape]
    case = case_from(OTHER | {"column_shape": shape} | given)
    assert type(case.column.section) is SHAPES[shape]
    assert case.column.section.extent == pytest.approx(1.2)
    for key in given:
        with pytest.raises(InputError, match=f"^{key} is missing: it belongs to column_shape"):
            case_from(OTHER | {"column_shape": shape} | given | {key: None})
    for key in {key for keys in SECTIONS.values() for key in keys} - set(given):
        other = next(keys[key] for keys in SECTIONS.values() if key in keys)
        with pytest.raises(InputError, match=f"^{key} does not belong to column_shape {shape}$"):
            case_from(OTHER | {"column_shape": shape} | given | {key: other})


def test_the_stiffness_of_a_cracked_section():
    gross = case_from(CASE).column
    cracked = case_from(CASE | {"stiffness_factor": 0.4}).column
    assert cracked.flexural_rigidity == pytest.approx(0.4 * gross.flexural_rigidity)
    given = case_from(CASE | {"effective_stiffness": "250 MN*m^2"}).column
    assert given.flexural_rigidity == pytest.approx(250e6)
    assert given.shear_rigidity == cracked.shear_rigidity == gross.shear_rigidity


def test_what_the_summary_says_of_a_section():
    for shape, words in (
        ("hollow circular", "hollow circular 1.2 × 0.2 m, 5 m high, base fixed, top pinned"),
        ("free", "free, 5 m high, base fixed, top pinned"),
    ):
        results = Results.of(
            calculate(case_from(OTHER | SECTIONS[shape] | {"column_shape": shape}))
        )
        assert column_in_words(results, "SI") == words


def test_what_the_summary_says_of_steps_springs_and_a_cap():
    asked = {"base": "free", "base_stiffness": "800 MN/m", "base_rotation_stiffness": "9 GN*m/rad"}
    asked |= {"top": "free", "top_mass": "150 t", "embedment": "1.5 m"}
    step = {"height": "3 m", "column_shape": "circular", "column_diameter": "0.6 m"}
    results = Results.of(calculate(case_from(CASE | asked | {"steps": [step]})))
    assert column_in_words(results, "SI") == (
        "circular 0.9144 m, stepped at 3 m, 5 m high, embedded 1.5 m, base on springs, top free, "
        "150 000 kg on it"
    ).replace("150 000", "150\u202f000")


def test_the_table_of_inputs_says_that_an_end_is_on_springs():
    springs = {"base_rotation_stiffness": "9000 MN*m/rad"}
    rows = {row[0]: row[2:] for row in Sheet(case_from(CASE | springs)).inputs.case_table().rows}
    base, top = rows["Base of the column"], rows["Top of the column"]
    assert base == ["on springs", "", "given", "case file; given as fixed"]
    assert top == ["pinned", "", "given", "case file"]


def test_the_table_of_inputs_says_how_what_it_prints_in_other_units_was_given():
    tube = {
        "column_shape": "hollow circular",
        "column_diameter": "508mm",
        "column_wall_thickness": "1.6e1 mm",
        "column_height": "7.8 m",
        "speed": "80 km/h",
    }
    section = {key: CASE[key] for key in CASE if key not in ("steps", "embedment")}
    rows = {row[0]: row[-1] for row in Sheet(case_from(section | tube)).inputs.case_table().rows}
    assert rows["Column diameter"] == "case file; given as 508mm"
    assert rows["Wall thickness"] == "case file; given as 1.6e1 mm"
    assert rows["Column height"] == rows["Speed at first touch"] == "case file"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"colunm_height": "5 m"},
            "'colunm_height' is not a key of a case file; did you mean col",
        ),
        ({"Speed": "5 m"}, "'Speed' is not a key of a case file; did you mean speed?"),
        ({"sped": None}, "'sped' is not a key of a case file; did you mean speed?"),
        ({5: "5 m"}, "5 is not a key of a case file"),
        ({"speed": None}, "speed is missing"),
        ({"density": None, "speed": None}, "density is missing"),
        ({"speed": 80}, "speed must have a unit (km/h, m/s, mph), got 80"),
        ({"speed": "80"}, "speed must have a unit (km/h, m/s, mph), got '80'"),
        ({"speed": "80 km"}, "speed must be a speed (km/h, m/s, mph), got '80 km', which is a len"),
        (
            {"speed": "80 nan"},
            "speed must be a speed (km/h, m/s, mph), got unknown unit in '80 nan'",
        ),
        ({"speed": "80 kmh"}, "got unknown unit in '80 kmh'; did you mean km/h?"),
        (
            {"speed": "0 km/h"},
            "speed must be from 0.36 to 540 km/h (0.22 to 340 mph), got '0 km/h'",
        ),
        (
            {"speed": "-80 km/h"},
            "speed must be from 0.36 to 540 km/h (0.22 to 340 mph), got '-80 km/h'",
        ),
        ({"speed": "inf km/h"}, "speed must be finite, got 'inf km/h'"),
        ({"speed": ["80 km/h"]}, "speed must be a speed, a number with a unit"),
        (
            {"truck_mass": "80 kip"},
            "truck_mass must be a mass (kg, t, lb), got '80 kip', which",
        ),
        (
            {"truck_mass": "600 kg"},
            "truck_mass must exceed the engine's 700 kg by 1 kg at least, got 600 kg",
        ),
        ({"truck": "single"}, "truck must be a name of the catalogue (single-unit-8t, tractor"),
        ({"truck": "mine.toml"}, "truck file mine.toml cannot be read"),
        (
            {"column_shape": "round"},
            "column_shape must be 'circular', 'rectangular', 'hollow circular', ",
        ),
        (
            {"column_diameter": None},
            "column_diameter is missing: it belongs to column_shape",
        ),
        ({"column_width": "1 m"}, "column_width does not belong to column_shape circular"),
        (
            {"column_shape": "hollow circular", "column_wall_thickness": "20 in"},
            "column_wall_thickness must be below half the diameter of 0.9144 m, got 0.508 m",
        ),
        (
            OTHER
            | {"column_shape": "polygonal", "column_sides": 2.5, "column_across_flats": "1 m"},
            "column_sides must be a whole number from 3 to 100, got 2.5",
        ),
        (
            OTHER
            | {"column_shape": "polygonal", "column_sides": "8", "column_across_flats": "1 m"},
            "column_sides must be a plain number without unit, got '8'",
        ),
        (
            OTHER | SECTIONS["free"] | {"column_shape": "free", "column_shear_area": "2 m^2"},
            "column_shear_area must be at most the area of 1.5 m², got 2 m²",
        ),
        (
            OTHER | SECTIONS["free"] | {"column_shape": "free", "column_area": "2 m"},
            "column_area must be an area (m^2, mm^2, in^2), got '2 m', which is a length",
        ),
        (
            OTHER
            | SECTIONS["filled circular"]
            | {"modular_ratio": 0, "column_shape": "filled circular"},
            "modular_ratio must be positive, got 0",
        ),
        ({"stiffness_factor": 35}, "stiffness_factor must be from 0.010 to 1.0, got 35"),
        ({"stiffness_factor": "35 %"}, "stiffness_factor must be a plain number without unit"),
        (
            {"effective_stiffness": "250 MN"},
            "effective_stiffness must be a flexural rigidity (MN*m^2",
        ),
        (
            {"stiffness_factor": 1.0, "effective_stiffness": "250 MN*m^2"},
            "give only one of stiffness_factor and effective_stiffness",
        ),
        ({"elastic_modulus": None}, "give one of elastic_modulus and concrete_strength"),
        ({"concrete_strength": "28 MPa"}, "give one of elastic_modulus and concrete_strength"),
        ({"elastic_modulus": "25 mPa"}, "unknown unit in '25 mPa'; did you mean MPa?"),
        (
            {"base": "free"},
            "base and top leave the column a mechanism, free to rotate about its top",
        ),
        ({"base": "fix"}, "base must be 'fixed', 'pinned' or 'free', got 'fix'"),
        ({"impact_height": "6 m"}, "impact_height must be above 0 m and below the height 5 m"),
        ({"impact_height": "0 m"}, "impact_height must be above 0 m"),
        ({"impact_height": "automatic"}, "impact_height must be a length, a number with a unit"),
        ({"impact_height": "auto", "column_height": "1.2 m"}, "below the height 1.2 m"),
        (
            {"impact_height": "25 ft", "column_height": "18 ft 7 in"},
            "got 7.62 m; typed: impact_height '25 ft', column_height '18 ft 7 in'",
        ),
        ({"damping_ratio": "5 %"}, "damping_ratio must be a plain number without unit, got '5 %'"),
        ({"damping_ratio": 1.0}, "damping_ratio must be below 1, got 1"),
        ({"damping_ratio": -0.05}, "damping_ratio must not be negative, got -0.05"),
        ({"damping_ratio": math.nan}, "damping_ratio must be finite, got nan"),
        ({"damping_ratio": True}, "damping_ratio must be a plain number without unit, got True"),
        ({"poisson_ratio": 0.6}, "poisson_ratio must be at most 0.5, got 0.6"),
        ({"units": "metric"}, "units must be 'SI' or 'US', got 'metric'"),
        ({"job_number": 7}, "job_number must be text (in quotes if it is a number), got 7"),
        ({"project": "a\nb"}, "project must be one line without control characters, got 'a\\nb'"),
        ({"project": "a\ufeffb"}, "project must be one line without control characters, got"),
        ({"project": "a\u202eb"}, "project must be one line without control characters, got"),
        ({"date": "31.1.2026"}, "date must be a date such as 2026-01-31, got '31.1.2026'"),
        ({"notes": "one"}, "notes must be a list of texts, got 'one'"),
        ({"notes": [1]}, "notes must be text (in quotes if it is a number), got 1"),
        ({"assumed": ["base"]}, "assumed must give a text for each key it lists, got ['base']"),
        ({"assumed": {"bse": "x"}}, "'bse' is not a key that assumed can list; did you mean base?"),
        ({"assumed": {"base": 1}}, "assumed.base must be text"),
        (
            {"sources": {"column_width": "x"}},
            "column_width is listed under assumed or sources",
        ),
    ],
)
def test_a_bad_case_is_one_line(change, message):
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        case_from(CASE | change)
    assert "\n" not in str(caught.value)


VALUES = st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.lists(st.text())


@given(st.sampled_from(KEYS), VALUES)
def test_any_value_makes_a_case_or_a_line(key, value):
    message = ""
    try:
        assert isinstance(case_from(CASE | {key: value}), Case)
    except InputError as error:
        message = str(error)
    assert len(message.splitlines()) <= 1


def as_yaml(values):
    return "".join(f"{key}: {value}\n" for key, value in values.items())


def test_a_case_file(tmp_path):
    path = tmp_path / "case.yaml"
    path.write_text(as_yaml(CASE) + "date: 2026-01-31\ndamping_ratio: 0.03\n", encoding="utf-8")
    case_file = read_case_file(path)
    assert case_file.case.inputs.date == datetime.date(2026, 1, 31)
    assert case_file.case.inputs.damping_ratio == 0.03
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())  # as some editors begin UTF-8
    assert read_case_file(path).case == case_file.case


def test_the_parameters_of_a_case_file_give_its_case(tmp_path, monkeypatch):
    path = tmp_path / "case.yaml"
    path.write_text(as_yaml(CASE) + "date: 2026-01-31\nnotes: [one]\n", encoding="utf-8")
    case_file = read_case_file(path)
    parameters = case_file.parameters
    assert parameters["date"] == "2026-01-31"
    assert parameters["case_file"] == "case.yaml"
    assert parameters["case_sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()
    monkeypatch.chdir(tmp_path)
    case = case_from_notebook(parameters)
    assert (case.inputs, case.truck_file) == (case_file.case.inputs, case_file.case.truck_file)


def test_a_case_file_is_read_once(tmp_path, monkeypatch):
    path, reads = tmp_path / "case.yaml", []
    path.write_text(as_yaml(CASE), encoding="utf-8")
    opened = os.open

    def noted(file, *arguments):
        reads.append(file)
        return opened(file, *arguments)

    monkeypatch.setattr(os, "open", noted)
    _ = read_case_file(path).parameters
    assert reads.count(path) == 1


def test_a_truck_file_is_looked_for_beside_the_case_file(tmp_path):
    source = Path(pierimpact.__file__).parent / "trucks" / "single-unit-8t.toml"
    (tmp_path / "trucks").mkdir()
    shutil.copy(source, tmp_path / "trucks" / "mine.toml")
    path = tmp_path / "case.yaml"
    path.write_text(as_yaml(CASE | {"truck": "trucks/mine.toml"}), encoding="utf-8")
    assert read_case_file(path).case.truck_file.sha256 == case_from(CASE).truck_file.sha256


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "must be keys and values (key: value), got nothing"),
        (b"- a\n- b\n", "must be keys and values (key: value), got ['a', 'b']"),
        (b"just words", "must be keys and values (key: value), got 'just words'"),
        (b"project: \xff", "is not UTF-8 text"),
        (b"project: [a\nspeed: 3", "line 2: not valid YAML"),
        (
            b"project: Bridge: north",
            "mapping values are not allowed here: put text that has a colon",
        ),
        (b"project: a\n\tspeed: 3", "line 2: not valid YAML"),
        (b"project:\n\ta: 3", "any token: use spaces in place of tabs"),
        (
            b"base: a\nspeed:80\ntop: b\n",
            "line 2: not valid YAML: could not find expected ':': a key",
        ),
        (
            b"project: 'a\nspeed: 3\ntop: b\n",
            "line 1: not valid YAML: found unexpected end of stream",
        ),
        (b'project: "a\nspeed: 3\n', "end of stream: a quotation mark is not closed"),
        (b"speed: 80 km/h\nspeed: 90 km/h", "line 2: 'speed' is given twice"),
        (b"project: !!python/object:os.system x", "line 1: not valid YAML"),
        (b"project: \x00", "not valid YAML"),
        (b"a: &a [x]\nb: *c\n", "line 2: not valid YAML"),
        (b"date: 2026-13-45", "line 1: '2026-13-45' cannot be read as a timestamp"),
        (b"{[a]: b}", "not valid YAML"),
        (b"[" * 5000, "line 1: nested more than 12 deep"),
    ],
)
def test_a_bad_file_is_one_line(tmp_path, content, message):
    path = tmp_path / "case.yaml"
    path.write_bytes(content)
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        read_case_file(path)
    assert str(caught.value).startswith("case.yaml: ")
    assert "\n" not in str(caught.value)


def test_no_file_or_a_folder(tmp_path):
    with pytest.raises(InputError, match=r"^nowhere\.yaml: cannot be read: No such file"):
        read_case_file(tmp_path / "nowhere.yaml")
    with pytest.raises(InputError, match="cannot be read: Is a directory"):
        read_case_file(tmp_path)


def test_the_parameters_of_a_notebook_are_a_case():
    namespace = dict.fromkeys((*KEYS, *NOTEBOOK_PARAMETERS)) | CASE
    namespace |= {"re": re, "_": 3, "__name__": "__main__", "In": ["", "x"], "Out": {1: 2}}
    assert case_from_notebook(namespace) == case_from(CASE)
    with pytest.raises(InputError, match="'sped' is not a key of a case file; did you mean speed"):
        case_from_notebook(namespace | {"sped": "80 km/h"})


def by_papermill(parameters):
    """Return the variables of a notebook that papermill was given these parameters for."""
    cell = PythonTranslator.codify(parameters)
    namespace = dict.fromkeys((*KEYS, *NOTEBOOK_PARAMETERS))
    exec(cell, namespace)
    return namespace | {"In": ["", "speed = None", cell, "case_from_notebook(globals())"]}


ODD = ['"""; x = 1', "'" * 3, "{x}", "\\", "\\n", "# no comment", "Мост 𝛼"]


def test_papermill_gives_a_case():
    values = CASE | {"notes": ODD, "damping_ratio": 0.03, "sources": {"speed": ODD[0]}}
    assert case_from_notebook(by_papermill(values)) == case_from(values)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"_speed": "80 km/h"}, "'_speed' is not a key of a case file; did you mean speed?"),
        ({"calculate": 3}, "'calculate' is not a key"),
        ({"Sheet": 3}, "'Sheet' is not a key"),
        ({"globals": 3}, "'globals' is not a key"),
        ({"case_from_notebook": None}, "'case_from_notebook' is not a key"),
        ({"x=len('');y": 3}, "parameters must be keys and plain values, got \"x = len('')\""),
        ({"speed=len;element": 3}, "got 'speed = len'"),
        ({"import re;element": "x"}, "got 'import re'"),
        ({"speed=element": "1"}, "got \"speed = element = '1'\""),
        ({"damping_ratio": math.nan}, "got \"damping_ratio = float('nan')\""),
        ({"case_file": "case.yaml"}, "case_file case.yaml has other values than the notebook"),
        ({"case_sha256": "0" * 64}, "case_file must be the name of a file in this folder"),
        ({"shared_sha256": "0" * 64}, "case_file must be the name of a file in this folder"),
        ({"case_file": "none.yaml"}, "case_file none.yaml: cannot be read"),
        ({"case_file": "../case.yaml"}, "case_file must be the name of a file in this folder"),
        ({"case_file": 3}, "case_file must be the name of a file in this folder"),
    ],
)
def test_papermill_cannot_shadow_or_forge(parameters, message, tmp_path, monkeypatch):
    (tmp_path / "case.yaml").write_text(as_yaml(CASE), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        case_from_notebook(by_papermill(CASE | parameters))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("key", "forged"),
    [("speed", "30 km/h"), ("case_sha256", "0" * 64), ("shared_sha256", "0" * 64), ("notes", [])],
)
def test_a_case_file_stands_for_its_own_values_only(key, forged, tmp_path, monkeypatch):
    (tmp_path / "case.yaml").write_text(
        as_yaml(CASE) + "date: 2026-01-31\nnotes: [one]\n", encoding="utf-8"
    )
    monkeypatch.chdir(tmp_path)
    parameters = read_case_file("case.yaml").parameters
    assert case_from_notebook(by_papermill(parameters)).inputs.notes == ("one",)
    with pytest.raises(InputError, match=r"case_file case\.yaml has other values"):
        case_from_notebook(by_papermill(parameters | {key: forged}))


def test_the_notebook_lists_every_key():
    parameters = json.loads(report_notebook().read_text("utf-8"))["cells"][0]["source"]
    listed = re.findall(r"^(\w+) = None$", "".join(parameters), re.MULTILINE)
    assert sorted(listed) == sorted((*KEYS, *NOTEBOOK_PARAMETERS))


def test_every_physical_key_can_have_a_source():
    assert {"speed", "damping_ratio", "moment_resistance"} <= set(PHYSICAL_KEYS) <= set(KEYS)
