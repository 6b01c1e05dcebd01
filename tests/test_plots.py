"""What the drawing functions put on the axes is what they were given."""

import numpy as np
import pytest
from figure_collisions import collisions
from matplotlib import get_data_path
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.font_manager import fontManager
from matplotlib.patches import Polygon

from pierimpact import (
    CircularSection,
    EquivalentPier,
    FilledCircularSection,
    FilledRectangularSection,
    HollowCircularSection,
    HollowRectangularSection,
    OblongSection,
    PierColumn,
    RectangularSection,
    RegularPolygonSection,
    Uniform,
    load_truck,
    reaction_band,
)
from pierimpact.design.sensitivity import sensitivity
from pierimpact.plots import (
    band,
    figures,
    section,
)
from pierimpact.plots.style import ORANGE, SKY, complete_fonts
from pierimpact.plots.words import shown
from pierimpact.teaching.scenario import Scenario
from pierimpact.units import converted, printed, rounded, unit_size

USUAL = Scenario()
SECTIONS = [
    CircularSection(diameter=0.9),
    RectangularSection(width=1.3, depth=0.8),
    HollowCircularSection(diameter=2.1, wall_thickness=0.35),
    HollowRectangularSection(width=3.2, depth=1.6, wall_thickness=0.25),
    OblongSection(width=0.9, depth=2.2),
    OblongSection(width=2.4, depth=0.9),
    RegularPolygonSection(sides=7, across_flats=1.1),
    RegularPolygonSection(sides=8, across_flats=1.1),
    FilledCircularSection(diameter=0.8, wall_thickness=0.1, modular_ratio=7.0, density_ratio=3.0),
    FilledRectangularSection(
        width=0.9, depth=0.7, wall_thickness=0.02, modular_ratio=7.0, density_ratio=3.0
    ),
]


def words(axes):
    return [text.get_text() for text in axes.texts]


@pytest.mark.parametrize("system", ["SI", "US"])
def test_sensitivities_fill_their_axes(monkeypatch, system):
    monkeypatch.setattr(figures, "to_svg", lambda figure: figure)
    truck, speed, height = load_truck("single-unit-8t"), 80.0 / 3.6, 1.2
    column = PierColumn(
        height=5.0, section=CircularSection(diameter=0.9), elastic_modulus=25e9, density=2400.0
    )
    pier = column.equivalent(impact_height=height)
    found = sensitivity(truck, column, pier, height, speed)
    here = {"speed": speed, "mass": truck.mass, "impact_height": height}
    here["frequency"] = pier.frequency
    figure = figures.draw_sensitivity(found, here, (1e6, 1e6), system)
    for axes in figure.axes:
        lines = [line.get_xdata() for line in axes.lines if len(line.get_xdata()) > 2]
        assert axes.get_xlim() == pytest.approx((lines[0][0], lines[0][-1]))
    (legend,) = (axes.get_legend() for axes in figure.axes if axes.get_legend())
    FigureCanvasAgg(figure).draw()
    below = legend.get_window_extent().y0
    assert all(axes.bbox.y1 <= below for axes in figure.axes)


@pytest.mark.parametrize("system", ["SI", "US"])
@pytest.mark.parametrize("drawn", SECTIONS, ids=lambda drawn: type(drawn).__name__)
def test_a_section_is_drawn_as_large_as_it_is(drawn, system):
    axes = Figure(figsize=(4, 3)).add_subplot()
    labels = section.draw_section(axes, drawn, 0.1, system)
    outlines = [patch.get_xy() for patch in axes.patches if isinstance(patch, Polygon)]
    assert np.ptp(outlines[0][:, 0]) == pytest.approx(drawn.extent, rel=1e-9)
    areas = [0.5 * abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) for x, y in (o.T for o in outlines)]
    whole = drawn.values.get("As", drawn.area)
    assert areas[0] - sum(areas[1:]) == pytest.approx(whole, rel=3e-3)
    named = {name for name in ("D", "b", "h", "t", "Df") if name in drawn.values}
    given = {
        str(printed(drawn.values[name], "section length", system, given=True))
        if converted(drawn.values[name], "section length", system) is None
        else f"{rounded(drawn.values[name] / unit_size('section length', system), 3)} in"
        for name in named
    }
    assert {own.words.partition(" = ")[2] for own in labels if " = " in own.words} == given


def test_what_was_given_in_other_units_has_three_figures_in_a_drawing():
    assert shown(1.35, "length", "US", given=True) == "4.43 ft"
    assert shown(1.35, "length", "SI", given=True) == "1.35 m"
    assert shown(1.35, "length", "US") == "4.4291 ft"


@pytest.mark.parametrize("system", ["SI", "US"])
def test_a_band_and_what_moves_it(monkeypatch, system):
    monkeypatch.setattr(band, "to_svg", lambda figure: figure)
    pier = EquivalentPier(mass=8e3, stiffness=284e6, damping_ratio=0.05)
    found = reaction_band(load_truck("single-unit-8t"), pier, 22.0, size=64)
    figure = band.draw_band(found, system)
    strips, tornado = figure.axes
    size = unit_size("force", system)
    for patch, name in zip(strips.patches, ("governing", "engine", "cargo"), strict=True):
        low, high = found.quantiles((0.05, 0.95), of=name) / size
        assert (patch.get_x(), patch.get_x() + patch.get_width()) == pytest.approx((low, high))
    drawn = {SKY: {}, ORANGE: {}}
    for patch in tornado.patches:
        end = patch.get_x() + patch.get_width()
        drawn[to_hex(patch.get_facecolor())][round(patch.get_y() + 0.35)] = end
    for row, ends in enumerate(found.tornado.values()):
        assert (drawn[SKY][row], drawn[ORANGE][row]) == pytest.approx(np.divide(ends, size))
    assert words(tornado).count("±30 %") == len(found.spread)
    assert f"{100.0 * next(iter(found.influence.values())):.0f} %" in words(tornado)
    names = [label.get_text() for label in tornado.get_yticklabels()]
    assert len(names) == len(set(names)) == len(found.spread)
    low, high = tornado.get_xlim()
    assert low == 0.0
    assert high > max(found.quantiles((0.95,)) / size)


def test_wide_spreads_stand_beside_the_band(monkeypatch):
    monkeypatch.setattr(band, "to_svg", lambda figure: figure)
    truck = load_truck("single-unit-8t")
    spread = {"engine_mass": Uniform(0.5, 2.0), "body_mass": Uniform(0.9278, 1.124)}
    pier = EquivalentPier(mass=8e3, stiffness=284e6, damping_ratio=0.05)
    figure = band.draw_band(reaction_band(truck, pier, 22.0, spread=spread, size=64), "SI")
    assert {"−50 % to +100 %", "−7.22 % to +12.4 %"} <= set(words(figure.axes[1]))
    assert collisions(figure) == []


def test_a_band_without_width_or_cargo(monkeypatch):
    monkeypatch.setattr(band, "to_svg", lambda figure: figure)
    pier = EquivalentPier(mass=8e3, stiffness=284e6)
    found = reaction_band(load_truck("single-unit-8t"), pier, 20.0 / 3.6, spread=0.0, size=4)
    strips, tornado = band.draw_band(found, "SI").axes
    assert words(strips) == ["no contact"]
    assert words(tornado) == ["All parameters are known exactly."]


def test_fonts_that_a_cache_lacks_are_those_of_matplotlib(monkeypatch):
    names = {font.name for font in fontManager.ttflist}
    others = [font for font in fontManager.ttflist if get_data_path() not in font.fname]
    monkeypatch.setattr(fontManager, "ttflist", others)
    complete_fonts()
    assert {font.name for font in fontManager.ttflist} == names
    count = len(fontManager.ttflist)
    complete_fonts()
    assert len(fontManager.ttflist) == count
