import asyncio
import html
import io
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from pierimpact import design_reaction, simulate, widgets
from pierimpact.files.case import read_case_file
from pierimpact.files.trucks import read_truck_file
from pierimpact.teaching.explorer import PAUSE
from pierimpact.teaching.live import LiveWords
from pierimpact.teaching.readouts import outcome
from pierimpact.teaching.scenario import REFERENCE, Scenario
from pierimpact.teaching.scenario_files import case_text, truck_text
from pierimpact.teaching.variables import CRUSH, VARIABLES
from pierimpact.units import printed

EXPLORERS = ("collision", "pier", "reduction", "spectra", "design", "sensitivity", "full")


ON_SHOW = tuple(widgets.collision().controls)


@pytest.fixture(scope="module")
def full():
    return widgets.full()


@pytest.fixture(scope="module")
def collision():
    return widgets.collision()


def pixels(view):
    return np.asarray(Image.open(io.BytesIO(view.widget.value)).convert("RGB")).astype(int)


@pytest.mark.parametrize("name", EXPLORERS)
def test_every_explorer_redraws_and_resets(name):
    explorer = getattr(widgets, name)()
    before = {view: shown.widget.value for view, shown in explorer.views.items()}
    first = next(iter(explorer.controls))
    pictures = {
        view: pixels(shown)
        for view, shown in explorer.views.items()
        if not isinstance(shown, LiveWords)
    }
    assert pictures
    explorer.set(**{first: 0.9 * getattr(explorer.defaults, first)})
    changed = [view for view, shown in explorer.views.items() if shown.widget.value != before[view]]
    assert changed == list(before)
    explorer.reset()
    for view, shown in explorer.views.items():
        if view in pictures:  # alike, but for the choice of 256 colours
            assert np.abs(pixels(shown) - pictures[view]).max() < 40
        else:
            assert shown.widget.value == before[view]


@pytest.mark.parametrize("name", EXPLORERS)
def test_a_still_needs_nothing_and_says_how_to_get_the_live_one(name):
    explorer = getattr(widgets, name)()
    assert "pierimpact teach" in explorer.still
    assert "<script" not in explorer.still
    images = re.findall(r"<img [^>]*>", explorer.still)
    assert len(images) >= sum(not isinstance(v, LiveWords) for v in explorer.views.values())
    for image in images:
        assert 'src="data:image/png;base64,' in image
        assert len(re.search('alt="(.*?)"', image)[1]) > 40
    assert not re.search(r"(src=\"(?!data:)|href|url\()", explorer.still)


def test_the_printed_peaks_are_those_of_the_model(full):
    speeds = np.random.default_rng(6).uniform(8.0, 30.0, 5)
    for speed in speeds:
        full.set(speed=float(speed))
        scenario = full.scenario()
        history = simulate(scenario.truck, scenario.pier, float(speed))
        shown = full.views["readout"].widget.value
        assert str(printed(history.engine_peak.reaction, "force", "SI")) in shown
        if history.cargo_peak is None:
            assert "The cargo stops short" in shown or "Neither" in shown
        else:
            assert str(printed(history.cargo_peak.reaction, "force", "SI")) in shown


def numbers_of(explorer):
    """Return the named numbers of an explorer and what it says of them."""
    text = explorer.views["readout"].widget.value
    cells = re.findall(r'title="([^"]*)".*?font-weight:600[^>]*>([^<]*)<', text)
    return dict(cells), html.unescape(re.sub("<[^>]+>", " ", text))


def test_the_readout_of_a_collision(full):
    full.reset()
    full.set(speed=20.0, truck_mass=10e3)
    strike = full.scenario()
    cells, words = numbers_of(full)
    assert cells["½ (m₁ + m₂) V²"] == "2.000 MJ"
    assert cells["natural frequency of the pier"] == str(
        printed(strike.pier.frequency, "frequency", "SI")
    )
    assert cells["stiffness of the pier"] == str(printed(strike.pier.stiffness, "stiffness", "SI"))
    assert cells["equivalent mass of the pier"] == str(printed(strike.pier.mass, "mass", "SI"))
    history = simulate(strike.truck, strike.pier, 20.0)
    cargo = history.cargo_peak
    governs = "cargo" if cargo and cargo.reaction > history.engine_peak.reaction else "engine"
    assert f"The {governs} governs." in words
    full.reset()


def test_the_readout_of_the_pier():
    explorer = widgets.pier()
    scenario = explorer.scenario()
    cells, words = numbers_of(explorer)
    mass = 2400.0 * 0.25 * np.pi * 0.914**2 * 5.0
    assert cells["mass per length times height"] == str(printed(mass, "mass", "SI"))
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
    assert str(printed(design.reaction, "force", "SI")) in words


def test_no_contact_is_said_in_a_sentence():
    assert outcome(Scenario(speed=20.0 / 3.6)).startswith("Neither engine nor cargo")


def test_a_mechanism_is_refused_in_a_sentence_and_taken_back(full):
    full.reset()
    full.set(base="pinned", top="free")
    assert "mechanism" in full.message.value
    assert full._body.layout.display == "none"
    full.reset()
    assert full.message.value == ""
    assert full._body.layout.display is None


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("fast", "Speed at first touch must be a speed"),
        ("80 kN", "which is a force"),
        ("-3 km/h", "must be positive"),
        ("nan", "must be finite"),
        ("", "Speed at first touch must be a speed"),
        ("1e999 km/h", "must be finite"),
    ],
)
def test_nonsense_in_a_box_is_refused_in_a_sentence(full, typed, said):
    full.reset()
    full.controls["speed"].box.value = typed
    assert said in full.message.value
    assert "Traceback" not in full.message.value
    full.reset()


def test_markup_in_a_box_is_shown_as_text(full):
    full.reset()
    full.controls["speed"].box.value = "<img src=x>"
    assert "<img" not in full.message.value
    full.reset()


def anywhere_on_its_slider(name):
    variable = VARIABLES[name]
    if variable.choices:
        return st.sampled_from(variable.choices)
    return st.floats(variable.low * variable.size, variable.high * variable.size)


@settings(max_examples=40)
@given(values=st.fixed_dictionaries({n: anywhere_on_its_slider(n) for n in ON_SHOW}))
def test_no_values_of_the_sliders_raise(collision, values):
    collision.set(**values)
    refused = collision.message.value
    shown = collision.views["readout"].widget.value
    assert refused or "Engine peak" in shown or "Largest reaction" in shown
    assert "no result" not in refused


def test_units_of_another_system_are_understood(full):
    full.reset()
    full.controls["speed"].box.value = "50 mph"
    assert full.scenario().speed == pytest.approx(50 * 1609.344 / 3600)
    full.controls["column_diameter"].box.value = "36 in"
    assert full.scenario().column_diameter == pytest.approx(0.9144)
    full.reset()


def test_what_is_typed_counts_beyond_the_slider(full):
    full.reset()
    full.controls["truck_mass"].box.value = "60 t"
    assert full.scenario().truck_mass == pytest.approx(60e3)
    assert full.controls["truck_mass"].slider.value == VARIABLES["truck_mass"].high
    full.reset()


def test_a_slider_that_snaps_to_its_step_does_not_change_the_value(full):
    full.reset()
    control = full.controls["column_diameter"]
    control.slider.value = 0.92  # where the browser puts 0.914 with a step of 0.02
    assert full.scenario().column_diameter == full.defaults.column_diameter
    control.slider.value = 1.0
    assert full.scenario().column_diameter == pytest.approx(1.0)
    full.reset()


def test_dragging_redraws_once_and_with_the_newest_value():
    explorer = widgets.collision()

    async def drag():
        before = explorer.redraws
        for speed in range(30, 90):
            explorer.controls["speed"].slider.value = speed
        assert explorer.redraws == before
        await asyncio.sleep(5 * PAUSE)
        assert explorer.redraws == before + 1

    asyncio.run(drag())
    history = Scenario(speed=89 / 3.6).history
    shown = explorer.views["readout"].widget.value
    assert str(printed(history.engine_peak.reaction, "force", "SI")) in shown


def test_the_picture_shows_the_instant_asked_for():
    explorer = widgets.collision()
    history = explorer.animation.scenario.history
    for moment, reaction in (
        (0.0, 0.0),
        (history.engine_peak.time, history.engine_peak.reaction),
        (history.cargo_peak.time, history.cargo_peak.reaction),
    ):
        explorer.show(moment)
        assert explorer.time == moment
        words = explorer.views["instant"].widget.value
        assert f"{1e3 * moment:.1f} ms" in words
        assert f"R = {printed(reaction, 'force', 'SI')}" in words


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
