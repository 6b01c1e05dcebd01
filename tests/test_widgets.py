"""The explorers: their values, their stills, and the files that they write."""

import html
import json
import re

import pytest

from pierimpact import widgets
from pierimpact.files.case import read_case_file
from pierimpact.files.trucks import read_truck_file
from pierimpact.symbols import dimension
from pierimpact.teaching.browser import variable_data
from pierimpact.teaching.scenario import REFERENCE, Scenario
from pierimpact.teaching.scenario_files import case_text, truck_text
from pierimpact.teaching.variables import CRUSH, VARIABLES
from pierimpact.units import parse

EXPLORERS = ("collision", "pier", "reduction", "spectra", "design", "sensitivity", "full", "risk")


@pytest.mark.parametrize("name", EXPLORERS)
def test_the_values_that_the_browser_sends_are_the_scenarios(name):
    explorer = getattr(widgets, name)()
    before = explorer.scenario()
    controls = [each for each in explorer.controls if not VARIABLES[each].choices][:2]
    values = {each: 0.93 * (getattr(before, each) or 30.0) for each in controls}
    explorer.widget.set_state({"values": {**explorer.widget.values, **values}})
    for each in controls:
        assert getattr(explorer.scenario(), each) == values[each]
    explorer.set(**{each: getattr(before, each) for each in controls})
    assert explorer.scenario() == before


@pytest.mark.parametrize("name", EXPLORERS)
def test_a_still_needs_nothing_and_says_how_to_get_the_live_one(name):
    explorer = getattr(widgets, name)()
    assert "pierimpact teach" in explorer.still
    assert "<script" not in explorer.still
    (frame,) = re.findall(r"<iframe [^>]*>", explorer.still)
    assert 'sandbox="allow-scripts"' in frame
    page = html.unescape(re.search('srcdoc="([^"]*)"', frame)[1])
    assert page.count("<script") == page.count("</script") == 1
    assert not re.search(r"\b(?:src|href)=|url\(|https?://(?!www\.w3\.org/2000/svg)", page)
    assert json.dumps(explorer.title)[1:-1] in page


@pytest.mark.parametrize("name", [n for n, v in VARIABLES.items() if not v.choices])
def test_a_unit_that_may_be_typed_is_the_packages(name):
    variable, data = VARIABLES[name], variable_data(name)
    for unit, size in data["units"].items():
        if unit:
            quantity = "length" if unit == "m" else dimension(variable.symbol)
            assert size == pytest.approx(parse(name, f"1 {unit}", quantity))
    assert data["units"][data["unit"]] == data["size"]
    assert data["spoken"] or not data["unit"]


def test_a_case_file_needs_a_column():
    explorer = widgets.full()
    explorer.copy()
    assert explorer.widget.copied == [["my-case.yaml", case_text(Scenario(), "my-truck.toml")]]
    explorer.set(speed=20.0)
    assert explorer.widget.copied == []
    explorer.set(engine_stiffness=210e6)
    explorer.copy()
    assert [name for name, _ in explorer.widget.copied] == ["my-case.yaml", "my-truck.toml"]
    explorer.set(pier_frequency=30.0, pier_mass=8e3)
    explorer.copy()
    assert "needs a column" in explorer.widget.copied[0][1]


def test_the_case_file_gives_the_same_collision(tmp_path):
    scenario = Scenario(speed=23.4, truck_mass=12e3, column_diameter=1.1, top="free",
                        engine_stiffness=210e6, friction_force=5e3)  # fmt: skip
    (tmp_path / "case.yaml").write_text(case_text(scenario, "truck.toml"), encoding="utf-8")
    (tmp_path / "truck.toml").write_text(truck_text(scenario), encoding="utf-8")
    case = read_case_file(tmp_path / "case.yaml").case
    assert case.inputs.speed == pytest.approx(scenario.speed)
    assert case.column == scenario.column
    for name in ("engine_mass", "body_mass", "friction_force", "friction_on"):
        assert getattr(case.truck, name) == getattr(scenario.truck, name)
    assert case.truck.engine_spring == scenario.truck.engine_spring
    assert case.truck.body_spring == scenario.truck.body_spring


def test_the_case_file_of_the_reference_truck_names_it():
    assert f"truck: {REFERENCE.name}\n" in case_text(Scenario(), "truck.toml")
    assert truck_text(Scenario()) == ""


def test_every_crush_parameter_is_in_the_truck_file():
    names = {
        entry.name.replace("_spring.", "_") for entry in read_truck_file(REFERENCE.name).parameters
    }
    assert names - {"body_mass", "friction_on"} == set(CRUSH)
