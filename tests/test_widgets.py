"""The explorers: their values, what Python calculates for them, their stills."""

import html
import json
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pierimpact import design_reaction, widgets
from pierimpact.files.case import read_case_file
from pierimpact.files.trucks import read_truck_file
from pierimpact.teaching.browser import variable_data
from pierimpact.teaching.readouts import outcome
from pierimpact.teaching.scenario import REFERENCE, Scenario
from pierimpact.teaching.scenario_files import case_text, truck_text
from pierimpact.teaching.variables import CRUSH, VARIABLES
from pierimpact.units import parse

EXPLORERS = ("collision", "pier", "reduction", "spectra", "design", "sensitivity", "full")
CALCULATED = ("pier", "reduction", "design", "sensitivity")


@pytest.mark.parametrize("name", CALCULATED)
def test_what_python_calculates_follows_the_values_and_goes_back(name):
    explorer = getattr(widgets, name)()
    before = explorer.widget.contents
    assert before["charts"]
    assert before["refusal"] == ""
    first = explorer.controls[0]
    explorer.set(**{first: 0.9 * getattr(explorer.defaults, first)})
    after = explorer.widget.contents
    assert after["charts"] != before["charts"]
    assert after["words"] != before["words"]
    explorer.reset()
    assert explorer.widget.contents == before


@pytest.mark.parametrize("name", CALCULATED)
def test_what_the_browser_sends_is_answered_once(name):
    explorer = getattr(widgets, name)()
    answers = []
    explorer.widget.observe(lambda change: answers.append(change["new"]), "contents")
    controls = explorer.controls[:2]
    values = {name: 0.93 * getattr(explorer.defaults, name) for name in controls}
    explorer.widget.set_state({"values": {**explorer.widget.values, **values}})
    assert [explorer.widget.contents] == answers
    assert getattr(explorer.scenario(), controls[1]) == values[controls[1]]


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
            assert size == pytest.approx(
                parse(name, f"1 {unit}", "length") if unit == "m" else variable.parsed(f"1 {unit}")
            )
    assert data["units"][data["unit"]] == data["size"]
    assert data["spoken"] or not data["unit"]


def numbers_of(explorer):
    """Return the named numbers of an explorer and what it says of them."""
    text = explorer.widget.contents["readout"]
    cells = re.findall(r'title="([^"]*)".*?font-weight:600[^>]*>([^<]*)<', text)
    return dict(cells), html.unescape(re.sub("<[^>]+>", " ", text))


def test_the_readout_of_the_pier():
    explorer = widgets.pier()
    scenario = explorer.scenario()
    cells, words = numbers_of(explorer)
    mass = 2400.0 * 0.25 * np.pi * 0.914**2 * 5.0
    assert cells["mass per length times height"] == f"{mass / 1e3:.4g} t"
    pier = scenario.pier
    shares = [int(text) for text in re.findall(r"(\d+)%", words)]
    rigidity = 25e9 / 2.4 * 0.9 * 0.25 * np.pi * 0.914**2  # κGA
    forces = scenario.column.member_forces(1.0, 1.2)
    shear = (1.2 * forces.base_force**2 + 3.8 * forces.top_force**2) / rigidity
    assert shares == [round(100.0 * pier.mass / mass), round(100.0 * shear * pier.stiffness)]


def test_the_design_over_the_full_model_in_words():
    explorer = widgets.design()
    strike = explorer.scenario()
    design = design_reaction(strike.truck, strike.pier, strike.speed, "long")
    ratio = design.reaction / strike.history.governing_peak.reaction
    _, words = numbers_of(explorer)
    assert f"{ratio:.2f} times the full model" in words
    assert f"The {design.governs} governs." in words
    assert f"{design.reaction / 1e6:.2f} MN" in words


def test_no_contact_is_said_in_a_sentence():
    assert outcome(Scenario(speed=20.0 / 3.6)).startswith("Neither engine nor cargo")


def test_a_mechanism_is_refused_in_a_sentence_and_taken_back():
    explorer = widgets.pier()
    explorer.set(base="pinned", top="free")
    assert "mechanism" in explorer.widget.contents["refusal"]
    explorer.reset()
    assert explorer.widget.contents["refusal"] == ""


def anywhere_on_its_slider(name):
    variable = VARIABLES[name]
    if variable.choices:
        return st.sampled_from(variable.choices)
    return st.floats(variable.low * variable.size, variable.high * variable.size)


@pytest.mark.parametrize("name", ["pier", "reduction", "design"])
def test_no_values_of_the_sliders_raise(name):
    explorer = getattr(widgets, name)()
    strategy = st.fixed_dictionaries({n: anywhere_on_its_slider(n) for n in explorer.controls})

    @settings(max_examples=5, deadline=None)
    @given(values=strategy)
    def anywhere(values):
        explorer.set(**values)
        contents = explorer.widget.contents
        json.dumps(contents, allow_nan=False)
        assert contents["refusal"] or contents["charts"]
        assert "no result" not in contents["refusal"]

    anywhere()


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
