"""What the figures of the sheet's pages draw is what they were given."""

import io
from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
from generated_columns import resisting, round_column
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from pierimpact import Step, load_truck, reaction_band, simulate
from pierimpact.design.codes import code_forces
from pierimpact.design.sensitivity import sensitivity
from pierimpact.plots import code_bars, envelopes, history, shape, spectra, tornado, words
from pierimpact.plots.style import INK, VERMILION
from pierimpact.units import QUANTITIES, unit_size

TRUCK, COLUMN, HEIGHT, SPEED = load_truck("single-unit-8t"), round_column(6.0, 1.0), 1.3, 21.0
STRUCK = COLUMN.struck_at(HEIGHT)
PIER = STRUCK.equivalent(0.05)
SYSTEMS = pytest.mark.parametrize("system", ["SI", "US"])


@pytest.fixture(scope="module")
def collision():
    return simulate(TRUCK, PIER, SPEED)


@pytest.fixture(scope="module")
def changes():
    return sensitivity(TRUCK, COLUMN, PIER, HEIGHT, SPEED)


def axes_of(draw, *arguments):
    """Return the axes of the figure that a function draws."""
    with patch.dict(draw.__globals__, to_svg=lambda figure: figure):
        return draw(*arguments).axes


def drawn(axes, x, y):
    """Whether a line through these points is among those drawn."""
    return any(
        line.get_xydata().shape == (len(x), 2)
        and np.allclose(line.get_xydata(), np.transpose((x, y)), equal_nan=True)
        for line in axes.lines
    )


@SYSTEMS
def test_the_history_is_the_collisions(collision, system):
    axes, strip = axes_of(history.draw_history, collision, system)
    time, force = 1e3 * collision.time, unit_size("force", system)
    assert drawn(axes, time, collision.reaction / force)
    assert drawn(axes, time, collision.contact_force / force)
    peaks = [collision.engine_peak, collision.cargo_peak]
    for peak in peaks:
        assert drawn(axes, [1e3 * peak.time], [peak.reaction / force])
    starts = {bar.get_x() for bar in strip.patches}
    for start in (0.0, collision.engine_contact_time, collision.cargo_contact_time):
        assert any(abs(1e3 * start - there) < 0.5 for there in starts)


@SYSTEMS
def test_the_shape_and_its_largest_value(system):
    (axes,) = axes_of(shape.draw_shape_function, STRUCK, system)
    z = np.union1d(np.linspace(0.0, 6.0, 301), HEIGHT)
    assert drawn(axes, STRUCK.shape(z), z / unit_size("length", system))
    assert drawn(axes, [1.0], [HEIGHT / unit_size("length", system)])


@SYSTEMS
def test_the_envelopes_hold_those_of_every_impact(system):
    beams, impacts = [], []
    for height in (1.05, HEIGHT):
        beam = simulate(TRUCK, COLUMN.beam(height), SPEED).member_forces
        static, back = (COLUMN.member_forces(force, height) for force in (5e6, -3e6))
        impacts.append((static, back, beam))
        beams.append(beam)
    bands = {"shear": (2e6, 7e6), "moment": (-1e6, -9e6)}
    panels = axes_of(
        envelopes.draw_envelopes, impacts, resisting(COLUMN, (4e6, 1e6)), bands, system, COLUMN
    )
    length = unit_size("length", system)
    for axes, name, kind in zip(panels, ("shear", "moment"), ("force", "moment"), strict=True):
        unit = unit_size(kind, system)
        for static, back, _ in impacts:
            for forces in (static, back):
                assert drawn(axes, getattr(forces, name) / unit, forces.z / length)
        foot = -envelopes._ROOM * COLUMN.height / length
        assert drawn(axes, np.array(bands[name]) / unit, [foot, foot])
        (area,) = axes.collections
        (low, high) = area.get_paths()[0].get_extents().intervalx
        extremes = [getattr(beam, f"{name}_extremes") for beam in beams]
        assert high * unit == pytest.approx(max(own.largest.value for own in extremes), rel=0.01)
        assert low * unit == pytest.approx(min(own.smallest.value for own in extremes), rel=0.01)


@SYSTEMS
def test_the_spectra_are_shaded_where_the_cargo_governs(changes, system):
    found, size = changes.frequency, unit_size("force", system)
    (axes,) = axes_of(spectra.draw_spectra, found, PIER.frequency, system)
    for values in found[1:5]:
        assert drawn(axes, found.values, values / size)
    inside = np.zeros(len(found.values), dtype=bool)
    for span in axes.patches:
        low, high = span.get_extents().transformed(axes.transData.inverted()).intervalx
        inside |= (found.values > low) & (found.values < high)
    cargo = np.nan_to_num(found.cargo, nan=0.0) > found.engine
    assert np.mean(inside == cargo) > 0.98


@SYSTEMS
def test_bars_are_as_long_as_the_forces_of_codes(system):
    codes, averages = code_forces(SPEED, TRUCK.mass), {0.010: 4e6, 0.050: 2.5e6}
    given = codes, averages, 7e6, (4e6, 9e6), system
    (axes,) = axes_of(code_bars.draw_code_bars, *given)
    size = unit_size("force", system)
    forces = [7e6, *averages.values(), *(code.along.value for code in codes)]
    assert [bar.get_width() * size for bar in axes.patches] == pytest.approx(forces)
    hatched = [bool(bar.get_hatch()) for bar in axes.patches[-len(codes) :]]
    assert hatched == [not code.along.verified for code in codes]
    assert drawn(axes, np.array([4e6, 9e6]) / size, [0.0, 0.0])


@SYSTEMS
def test_the_widest_bar_is_on_top(changes, collision, system):
    band, nominal = reaction_band(TRUCK, PIER, SPEED, size=64), collision.governing_peak.reaction
    (axes,) = axes_of(tornado.draw_tornado, changes, band, nominal, system)
    size = unit_size("force", system)
    ends = {}
    for bar in axes.patches:
        row = round(bar.get_y() + 0.5 * bar.get_height())
        ends.setdefault(row, [nominal]).append(size * (bar.get_x() + bar.get_width()))
    widths = [max(ends[row]) - min(ends[row]) for row in sorted(ends)]
    assert widths == pytest.approx(sorted(widths, reverse=True))
    names = [label.get_text() for label in axes.get_yticklabels()]
    row = names.index("Speed $V$")
    speeds = [float(own.model[0]) for own in (changes.slower, changes.faster)]
    assert sorted(ends[row]) == pytest.approx(sorted([nominal, *speeds]))
    engine_mass = next(i for i, name in enumerate(names) if name.startswith("Engine mass"))
    expected = sorted([nominal, *band.tornado["engine_mass"]])
    assert sorted(ends[engine_mass]) == pytest.approx(expected)


def test_a_resistance_far_away_is_said_in_words():
    impact = COLUMN.member_forces(5e6, HEIGHT), COLUMN.member_forces(-2e6, HEIGHT), None
    given = [impact], resisting(COLUMN, (9e9, 3e6)), {}, "SI", COLUMN
    shear, moment = axes_of(envelopes.draw_envelopes, *given)
    assert "beyond this figure" in shear.get_xlabel()
    assert "beyond this figure" not in moment.get_xlabel()
    dashed = [line for line in moment.lines if to_hex(line.get_color()) != VERMILION]
    places = {abs(float(line.get_xdata()[0])) for line in dashed if len(line.get_xdata()) == 2}
    assert any(place == pytest.approx(3000.0) for place in places)


@SYSTEMS
def test_every_part_has_its_own_resistances_beside_it(system):
    column = replace(
        COLUMN,
        steps=[Step(height=2.0, section=COLUMN.section), Step(height=4.5, section=COLUMN.section)],
    )
    impact = column.member_forces(5e6, HEIGHT), column.member_forces(-2e6, HEIGHT), None
    parts = resisting(column, (5e6, 3e6), (3e6, None), (9e9, 2e6))
    shear, moment = axes_of(envelopes.draw_envelopes, [impact], parts, {}, system, column)
    metre = unit_size("length", system)
    for axes, name, expected in ((shear, "force", [5e6, 3e6]), (moment, "moment", [3e6, 2e6])):
        lines = {
            tuple(line.get_xdata()): line.get_ydata()
            for line in axes.lines
            if to_hex(line.get_color()) == INK.lower() and line.get_linewidth() == 1.2
        }
        assert sorted(x for x, _ in lines) == pytest.approx(
            sorted(side * own / unit_size(name, system) for own in expected for side in (-1, 1))
        )
        assert all(low == high for low, high in lines)
    between = [
        y for x, y in lines.items() if x[0] == pytest.approx(2e6 / unit_size("moment", system))
    ]
    assert between[0][0] == pytest.approx(4.5 / metre)
    assert "beyond this figure" in shear.get_xlabel()


def test_a_column_that_nothing_bends_has_an_axis_all_the_same():
    column = replace(COLUMN, top="free", base_stiffness=2e9)
    impact = column.member_forces(5e6, 0.0), column.member_forces(-2e6, 0.0), None
    assert float(np.max(np.abs(impact[0].moment))) == 0.0
    for axes in axes_of(
        envelopes.draw_envelopes, [impact], resisting(column, (None, None)), {}, "SI", column
    ):
        low, high = axes.get_xlim()
        assert low < 0.0 < high


@pytest.mark.parametrize("quantity", QUANTITIES)
@SYSTEMS
def test_the_font_has_every_character_of_a_value(quantity, system, caplog):
    figure = Figure()
    for line, value in enumerate((1.234, 5.6e-9, 1.7e12)):
        figure.text(0.1, 0.2 * line, words.shown(value, quantity, system))
        figure.text(0.6, 0.2 * line, f"$x$ = {words.shown(value, quantity, system)}")
    figure.savefig(io.BytesIO(), format="svg")
    assert caplog.messages == []
