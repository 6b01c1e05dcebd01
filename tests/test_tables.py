"""The tables of the teaching notebooks against the files they show."""

import json
import tomllib
from xml.etree import ElementTree

import pytest

from pierimpact.design.codes import code_forces
from pierimpact.design.study import OUTCOME_FILE
from pierimpact.resources import shipped
from pierimpact.teaching.tables import accuracy, code_values, truck_parameters


def rows(table):
    """Return the texts of a table's cells, the headings first."""
    root = ElementTree.fromstring(table.data)
    return [["".join(cell.itertext()) for cell in row] for row in root.iter("tr")]


def test_the_truck_parameters_are_those_of_the_file():
    file = tomllib.loads((shipped("trucks") / "single-unit-8t.toml").read_text("utf-8"))
    names = {
        "engine_mass": "Engine mass",
        "body_mass": "Mass of body and cargo",
        "friction_force": "Friction force on the body",
        "friction_on": "Friction acts against the",
    }
    expected = {label: file[name] for name, label in names.items()}
    laws = {
        "plateau_force": "Plateau force",
        "plateau_length": "Plateau length",
        "stiffness": "Steep stiffness",
        "unloading_stiffness": "Unloading stiffness",
    }
    for body in ("engine", "body"):
        for name, label in laws.items():
            expected[f"{label} of the {body} spring"] = file[f"{body}_spring"][name]
    heads, *found = rows(truck_parameters())
    assert heads == ["Parameter", "Value", "Status", "Source"]
    assert {row[0] for row in found} == set(expected)
    assert len(found) == len(expected) == 12
    for name, value, status, source in found:
        entry = expected[name]
        number, _, unit = value.partition(" ")
        assert unit == entry.get("unit", "")
        if unit:
            assert float(number) == entry["value"]
        else:
            assert number == entry["value"]
        assert (status, source) == (entry["status"], entry["source"])


def test_the_codes_have_force_height_and_how_sure_they_are():
    _, *found = rows(code_values(20.0, 8e3))
    codes = code_forces(20.0, 8e3)
    for row, code in zip(found, codes, strict=True):
        name, clause, force, status, height, note = row
        assert (name, clause, note) == (code.code, code.clause, code.note)
        number = float(force.removesuffix(" kN").replace("\u202f", ""))
        assert number == pytest.approx(code.along.value / 1e3, rel=5e-4)
        assert status == code.along.remark
        if code.height is None:
            assert height == "—"
        else:
            assert height.startswith(f"{code.height.value:g} m")
            assert ("unverified" in height) == (not code.height.verified)


def test_the_accuracy_is_that_of_the_study():
    outcome = json.loads(OUTCOME_FILE.read_text("utf-8"))["predicted over CMSD"]
    _, *found = rows(accuracy())
    assert len(found) == 6
    for level, reaction, cases, mean, variation, low, high in found:
        study = outcome[level][reaction]["all"]
        assert int(cases) == study["cases"]
        assert float(mean) == pytest.approx(study["mean"], abs=0.0051)
        share = float(variation.removesuffix("%")) / 100.0
        assert share == pytest.approx(study["coefficient of variation"], abs=5.1e-4)
        assert float(low) == pytest.approx(study["1st percentile"], abs=0.0051)
        assert float(high) == pytest.approx(study["99th percentile"], abs=0.0051)
