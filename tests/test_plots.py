"""What the drawing functions put on the axes is what they were given."""

import dataclasses

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
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
    load_truck,
    reaction_band,
    simulate,
)
from pierimpact.design.sensitivity import sensitivity
from pierimpact.plots import (
    amplification,
    band,
    collision,
    comparison,
    figures,
    influence,
    schematic,
    section,
    shape,
    spectrum,
)
from pierimpact.plots.style import BODIES, ORANGE, SKY
from pierimpact.teaching import explorer_data
from pierimpact.teaching.animation import Animation
from pierimpact.teaching.scenario import Scenario
from pierimpact.units import printed, unit_size

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
NAMES = [parameter.meaning for parameter in explorer_data.PARAMETERS]
SPEEDS = [20.0, 45.0, 80.0, 130.0]  # km/h: no contact, engine alone, both, both


def at_speed(speed):
    return Scenario(speed=speed / 3.6)


def words(axes):
    return [text.get_text() for text in axes.texts]


@pytest.mark.parametrize("speed", SPEEDS)
def test_regimes_follow_the_contacts(speed):
    history = at_speed(speed).history
    found = {regime.name: regime for regime in collision.regimes(history)}
    assert found["crumpling"].start == 0.0
    for name, start in (
        ("engine", history.engine_contact_time),
        ("cargo", history.cargo_contact_time),
    ):
        assert (name in found) == (start is not None)
        if start is not None:
            assert found[name].start == start
            assert start < found[name].end <= history.time[-1]
    starts = [regime.start for regime in found.values()]
    assert starts == sorted(starts)


@pytest.mark.parametrize("speed", SPEEDS)
def test_forces_and_their_peaks(speed):
    history = at_speed(speed).history
    axes = collision.forces_panel(Figure(figsize=(4, 3)))
    collision.draw_forces(axes, history)
    engine, body, reaction = (line.get_ydata() for line in axes.lines[:3])
    assert np.array_equal(engine, 1e-6 * history.engine_force)
    assert np.array_equal(body, 1e-6 * history.body_force)
    assert np.array_equal(reaction, 1e-6 * history.reaction)
    low, high = axes.get_ylim()
    assert low <= min(0.0, reaction.min())
    assert high > max(engine.max(), body.max(), reaction.max())
    marks = axes.lines[3:]
    peaks = [peak for peak in (history.engine_peak, history.cargo_peak) if peak is not None]
    assert [(m.get_xdata()[0], m.get_ydata()[0]) for m in marks] == [
        (pytest.approx(1e3 * peak.time), pytest.approx(1e-6 * peak.reaction)) for peak in peaks
    ]
    for peak in peaks:
        assert any(str(printed(peak.reaction, "force", "SI")) in text for text in words(axes))


@pytest.mark.parametrize("speed", SPEEDS)
def test_the_shares_of_energy_fill_the_picture(speed):
    history = at_speed(speed).history
    axes = collision.energy_panel(Figure(figsize=(4, 3)))
    collision.draw_energy(axes, history)
    tops = [area.get_paths()[0].vertices[:, 1].max() for area in axes.collections]
    assert tops == sorted(tops)
    assert tops[-1] == pytest.approx(100.0, abs=1e-6)
    assert axes.get_xlim() == (0.0, pytest.approx(1e3 * history.time[-1]))


def test_the_energy_of_a_pier_that_yields_is_one_more_share():
    pier = dataclasses.replace(Scenario().pier, yield_reaction=1e6)
    history = simulate(Scenario().truck, pier, Scenario().speed)
    axes = collision.energy_panel(Figure(figsize=(4, 3)))
    collision.draw_energy(axes, history)
    tops = [area.get_paths()[0].vertices[:, 1].max() for area in axes.collections]
    assert len(tops) == 7
    assert tops[-1] == pytest.approx(100.0, abs=1e-6)
    assert [text.get_text() for text in axes.get_legend().get_texts()][-1] == "yielding"


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("speed", SPEEDS)
def test_a_spectrum_and_the_piers_place_on_it(body, speed):
    scenario = at_speed(speed)
    curves = scenario.curves
    axes = spectrum.spectrum_panel(Figure(figsize=(4, 3)), body)
    given = curves.frequency, curves.full[body], curves.reduced[body]
    spectrum.draw_spectrum(axes, *given, body=body)
    if body == "cargo" and scenario.history.cargo_peak is None:
        assert "does not reach" in words(axes)[0]
        reaction = None
    else:
        peaks = {"engine": scenario.history.engine_peak, "cargo": scenario.history.cargo_peak}
        reaction = peaks[body].reaction
        assert np.array_equal(axes.lines[0].get_ydata(), 1e-6 * given[1], equal_nan=True)
        assert np.array_equal(axes.lines[1].get_ydata(), 1e-6 * given[2], equal_nan=True)
    spectrum.draw_place(axes, *given, scenario.pier.frequency, reaction, body=body)
    ring = axes.lines[-1]
    assert ring.get_xdata()[0] == scenario.pier.frequency
    if reaction is not None:
        assert ring.get_ydata()[0] == pytest.approx(1e-6 * reaction)
        assert axes.get_ylim()[1] > 1e-6 * max(reaction, np.nanmax(given[1]))
        assert words(axes) == [str(printed(reaction, "force", "SI"))]


def test_amplification_with_one_pier():
    curves = explorer_data.amplifications((0.09, 0.9), (0.4, 0.5), 0.05)["cargo"]
    axes = amplification.amplification_panel(Figure(figsize=(4, 3)), "cargo")
    amplification.draw_amplification(axes, curves, body="cargo")
    drawn = [line.get_ydata() for line in axes.lines]
    given = (curves.impulse, curves.static, curves.closed, curves.exact)
    assert all(np.array_equal(a, b) for a, b in zip(drawn, given, strict=True))
    amplification.draw_here(axes, curves, 300.0, 0.987, body="cargo")
    assert axes.lines[-1].get_xydata().tolist() == [[300.0, 0.987]]
    assert axes.get_xlim()[1] > 300.0
    assert words(axes) == ["S = 0.987"]


def test_the_limits_of_the_amplification_are_met():
    for curves in explorer_data.amplifications((0.09, 0.9), (0.4, 0.5), 0.02).values():
        soft, stiff = curves.ratio < 0.05, curves.ratio > 40.0
        assert curves.exact[soft] == pytest.approx(curves.impulse[soft], rel=0.05)
        assert curves.exact[stiff] == pytest.approx(curves.static[stiff], rel=0.05)


@pytest.mark.parametrize("top", ["fixed", "pinned", "free"])
def test_the_shape_passes_through_one_at_the_impact(top):
    struck = Scenario(top=top, column_height=5.3).column.struck_at(1.2)
    axes = shape.shape_panel(Figure(figsize=(4, 3)))
    shape.draw_shape(axes, struck)
    phi, z = axes.lines[1].get_data()
    assert np.interp(1.2, z, phi) == pytest.approx(1.0, abs=2e-3)
    assert axes.get_ylim() == (0.0, 6.0)
    assert axes.get_xlim()[0] <= phi.min()
    assert axes.get_xlim()[1] >= max(phi.max(), (phi**2).max())


def test_stiffness_and_mass_along_a_column_are_those_of_the_impact():
    column = USUAL.column
    along = explorer_data.by_height(column)
    for place in (3, 20, 44):
        struck = column.struck_at(float(along.height[place]))
        assert along.stiffness[place] == struck.stiffness
        assert along.mass[place] == struck.mass
    axes = shape.along_panel(Figure(figsize=(4, 3)), "mass")
    shape.draw_along(axes, along.height, along.mass, 1.2, 6.4e3, quantity="mass")
    assert axes.lines[-1].get_xydata().tolist() == [[1.2, 6.4]]
    assert words(axes) == ["6.4 t"]


def test_bars_are_as_long_as_their_forces():
    bars = explorer_data.bars(at_speed(45.0))  # where the cargo makes no peak
    axes = comparison.bars_panel(Figure(figsize=(6, 3)), [bar.name for bar in bars])
    comparison.draw_bars(axes, bars)
    assert [patch.get_width() for patch in axes.patches] == [
        pytest.approx(1e-3 * (bar.value or 0.0)) for bar in bars
    ]
    for text, bar in zip(words(axes), bars, strict=True):
        shown = "none" if bar.value is None else str(printed(bar.value, "force", "SI"))
        assert text.startswith(shown)
        assert text.endswith(bar.remark)
    assert "none" in words(axes)


@pytest.mark.parametrize("body", BODIES)
def test_influences_to_either_side(body):
    changes = explorer_data.influences(USUAL)[body]
    axes = influence.influence_panel(Figure(figsize=(4, 3)), body, NAMES, 0.3)
    influence.draw_influence(axes, changes, body=body)
    widths = np.array([patch.get_width() for patch in axes.patches]).reshape(2, -1).T
    assert widths == pytest.approx(changes)
    assert np.all(np.abs(changes) <= axes.get_xlim()[1])


def test_a_peak_that_is_not_there_has_no_influences():
    changes = explorer_data.influences(at_speed(45.0))
    assert changes["cargo"] is None
    axes = influence.influence_panel(Figure(figsize=(4, 3)), "cargo", NAMES, 0.3)
    influence.draw_influence(axes, None, body="cargo")
    assert words(axes) == ["The cargo does not reach the pier."]


def test_influences_are_those_of_another_simulation():
    changes = explorer_data.influences(USUAL)
    heavier = Scenario(engine_mass=1.3 * USUAL.engine_mass)
    # The explorer's truck keeps its total mass, the influence its body's.
    heavier = Scenario(
        engine_mass=heavier.engine_mass, truck_mass=USUAL.truck_mass + 0.3 * USUAL.engine_mass
    )
    row = NAMES.index("engine mass")
    ratio = heavier.history.engine_peak.reaction / USUAL.history.engine_peak.reaction
    assert changes["engine"][row, 1] == pytest.approx(ratio - 1.0, rel=1e-6)


@pytest.mark.parametrize(
    "scenario",
    [USUAL, Scenario(pier_mass=8e3, pier_frequency=30.0), Scenario(column_height=12.0, top="free")],
    ids=["column", "oscillator", "tall"],
)
def test_the_picture_moves_with_the_pier(scenario):
    animation = Animation(scenario)
    axes = schematic.picture(Figure(figsize=(7.2, 2.9)))
    schematic.draw_scene(axes, animation.scene)
    before = len(axes.get_children())
    peak = scenario.history.engine_peak
    frame = animation.frame(animation.index(peak.time))
    schematic.draw_frame(axes, animation.scene, frame)
    assert len(axes.get_children()) > before
    assert f"R = {printed(peak.reaction, 'force', 'SI')}" in words(axes)
    fronts = [
        line.get_xdata()[-1] for line in axes.lines if to_hex(line.get_color()) == BODIES["cargo"]
    ]
    assert max(fronts) <= frame.pier * animation.scene.exaggeration + 1e-9
    assert abs(frame.pier) * animation.scene.exaggeration <= schematic.SWING * 1.001


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
    shown = {
        str(printed(drawn.values[name], "section length", system, given=True)) for name in named
    }
    assert {own.words.partition(" = ")[2] for own in labels if " = " in own.words} == shown


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


def test_a_band_without_width_or_cargo(monkeypatch):
    monkeypatch.setattr(band, "to_svg", lambda figure: figure)
    pier = EquivalentPier(mass=8e3, stiffness=284e6)
    found = reaction_band(load_truck("single-unit-8t"), pier, 20.0 / 3.6, spread=0.0, size=4)
    strips, tornado = band.draw_band(found, "SI").axes
    assert words(strips) == ["no contact"]
    assert words(tornado) == ["All parameters are known exactly."]
