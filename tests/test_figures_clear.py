"""No words of a figure of the sheet lie on other words, on lines or beyond its edge."""

from unittest.mock import patch

import pytest
from figure_collisions import collisions
from generated_collisions import collisions as generated
from generated_columns import arranged_columns, resisting, round_column
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure
from matplotlib.text import Text

from pierimpact import (
    CircularSection,
    FreeSection,
    PierColumn,
    RectangularSection,
    Step,
    load_truck,
    reaction_band,
    simulate,
)
from pierimpact.design.codes import code_forces
from pierimpact.design.sensitivity import sensitivity
from pierimpact.files.limits import POSSIBLE
from pierimpact.plots import (
    code_bars,
    crush,
    envelopes,
    history,
    shape,
    situation,
    spectra,
    tornado,
)

SYSTEMS = st.sampled_from(["SI", "US"])
# Without shrinking, which would take minutes.
SOME = settings(max_examples=6, phases=[Phase.generate])
TRUCKS = [load_truck(name) for name in ("single-unit-8t", "tractor-trailer-36t")]

STEPPED = round_column(
    9.0, 1.8, top="free", top_mass=60e3, embedment=0.8, base_rotation_stiffness=20e9,
    steps=[Step(height=3.0, section=CircularSection(diameter=1.5))],
)  # fmt: skip
# Truck, column, impact height [m], speed [m/s], resistances of its parts [N, N m] and units.
CASES = {
    "usual": (TRUCKS[0], round_column(5.0, 0.9), 1.2, 22.0, [(3e6, 4e6)], "SI"),
    "stepped": (TRUCKS[0], STEPPED, 1.2, 17.0, [(3e6, 2.5e6), (2.5e6, 1.5e6)], "SI"),
    "tall": (TRUCKS[1], round_column(30.0, 2.0), 1.35, 28.0, [(40e6, None)], "US"),
    "slow": (TRUCKS[0], round_column(3.0, 0.9, top="fixed"), 1.2, 2.8, [(None, None)], "US"),
    "heavy": (TRUCKS[0].loaded_to(30e3), round_column(6.0, 1.1), 1.35, 25.0, [(9e6, 9e6)], "SI"),
}


def figure_of(draw, *arguments):
    """Return the figure that a function draws, instead of its SVG."""
    with patch.dict(draw.__globals__, to_svg=lambda figure: figure):
        return draw(*arguments)


def test_collisions_are_found():
    figure = Figure(figsize=(6.0, 4.0))
    axes = figure.add_subplot()
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    axes.text(0.5, 0.5, "in the clear")
    assert collisions(figure) == []
    axes.plot([0.1, 0.9], [0.2, 0.2])
    axes.text(0.3, 0.18, "on a line")
    axes.text(0.55, 0.52, "over it")
    axes.text(0.99, 0.8, "beyond the edge")
    axes.text(0.1, 0.8, "tiny", fontsize=5.0)
    found = "; ".join(collisions(figure))
    for words in (
        "'on a line' on Line2D",
        "'over it' on 'in",
        "edge' is cut off",
        "tiny' is small",
    ):
        assert words in found


@SOME
@given(arranged_columns(), st.sampled_from(TRUCKS), st.floats(1e4, 9e7), SYSTEMS)
def test_the_situation_is_clear(case, truck, reaction, system):
    column, height = case
    drawn = figure_of(situation.draw_situation, column, height, truck, reaction, system)
    assert collisions(drawn) == []


@pytest.mark.parametrize("height", POSSIBLE["column_height"])
@pytest.mark.parametrize(
    "section",
    [
        *(CircularSection(diameter=end) for end in POSSIBLE["column_diameter"]),
        RectangularSection(**dict.fromkeys(("width", "depth"), POSSIBLE["column_depth"][1])),
        # Of the largest and of the smallest radius of gyration.
        *(
            FreeSection(
                area=POSSIBLE["column_area"][i],
                second_moment=POSSIBLE["column_second_moment"][1 - i],
                shear_area=POSSIBLE["column_shear_area"][0],
            )
            for i in (0, 1)
        ),
    ],
)
def test_what_a_case_may_give_finds_a_scale(section, height):
    column = PierColumn(height=height, section=section, elastic_modulus=25e9, density=2400.0)
    svg = situation.draw_situation(column, 0.5 * height, TRUCKS[0], 1e6, "SI")
    assert "Elevation" in svg


@SOME
@given(arranged_columns(), SYSTEMS)
def test_the_shape_is_clear(case, system):
    column, height = case
    drawn = figure_of(shape.draw_shape_function, column.struck_at(height), system)
    assert collisions(drawn) == []


@pytest.mark.parametrize("system", ["SI", "US"])
def test_the_crush_curves_are_clear(system):
    for truck in (*TRUCKS, *(case.truck for case in generated(1, seed=1))):
        assert collisions(figure_of(crush.draw_crush_curves, truck, system)) == []


@pytest.mark.parametrize("number", range(4))
def test_the_history_is_clear(number):
    case = generated(4, seed=2)[number]
    found = simulate(case.truck, case.pier, case.speed)
    assert collisions(figure_of(history.draw_history, found, "SI")) == []


@pytest.mark.parametrize("name", CASES)
def test_what_rests_on_a_whole_calculation_is_clear(name):
    truck, column, height, speed, resistances, system = CASES[name]
    parts = resisting(column, *resistances)
    struck = column.struck_at(height)
    pier = struck.equivalent(0.05)
    found, beam = (simulate(truck, own, speed) for own in (pier, column.beam(height)))
    reaction, lowest = found.governing_peak.reaction, float(found.reaction.min())
    impacts = [(struck.member_forces(reaction), struck.member_forces(lowest), beam.member_forces)]
    changes = sensitivity(truck, column, pier, height, speed)
    band = reaction_band(truck, pier, speed, size=64)
    averages = dict.fromkeys((0.01, 0.025, 0.05), 0.7 * reaction)
    codes = code_forces(speed, truck.mass)
    low, _, high = band.quantiles()
    force, moment = (
        abs(getattr(impacts[0][0], f"largest_{name}").value) / reaction
        for name in ("shear", "moment")
    )
    bands = {"shear": (force * low, force * high), "moment": (-moment * low, -moment * high)}
    for drawn in (
        figure_of(envelopes.draw_envelopes, impacts, parts, bands, system, column),
        figure_of(spectra.draw_spectra, changes.frequency, pier.frequency, system),
        figure_of(code_bars.draw_code_bars, codes, averages, reaction, (low, high), system),
        figure_of(tornado.draw_tornado, changes, band, reaction, system),
    ):
        assert collisions(drawn) == []


def test_two_impact_heights_have_one_label():
    column = CASES["usual"][1]
    forces = {z: column.member_forces(1e6, z) for z in (1.05, 1.35)}
    impacts = [(forces[z], forces[z], None) for z in (1.35, 1.05)]
    drawn = figure_of(envelopes.draw_envelopes, impacts, resisting(column, (None, None)), {}, "SI")
    words = [text.get_text() for text in drawn.axes[0].texts]
    assert [each for each in words if " m" in each] == ["$z_\\mathrm{n}$ = 1.05 m\nand 1.35 m"]
    assert collisions(drawn) == []


def test_the_mass_of_a_truck_that_is_cut_off_is_on_it():
    column = round_column(5.0, 1.2)
    truck = TRUCKS[0].loaded_to(30e3)
    drawn = figure_of(situation.draw_situation, column, 1.5, truck, 11.57e6, "SI")
    (mass,) = (text for text in drawn.findobj(Text) if text.get_text() == "30 000 kg")
    drawn.set_dpi(25.4)
    assert mass.get_window_extent().x0 > 2.0  # [mm], where it is cut off


def test_a_spring_at_the_top_is_beside_the_mass_there():
    column = round_column(5.2, 0.6, top="free", top_mass=42e3, top_stiffness=8e6)
    axes = figure_of(situation.draw_situation, column, 1.05, TRUCKS[0], 1.3e6, "SI").axes[0]
    (cap,) = (own for own in axes.patches if own.get_linestyle() == "--")
    spring = max(
        (line for line in axes.lines if len(line.get_xdata()) == 15),
        key=lambda line: max(line.get_ydata()),
    )
    assert max(spring.get_xdata()) == pytest.approx(cap.get_x())
