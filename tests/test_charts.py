"""The charts that Python calculates for explorers are of the values that they were given."""

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pierimpact.plots.style import BODIES, round_out, round_up
from pierimpact.teaching import charts, explorer_data
from pierimpact.teaching.scenario import EXAMPLE, Scenario

USUAL = Scenario()
NAMES = [parameter.meaning for parameter in explorer_data.PARAMETERS]


def at_speed(speed):
    return Scenario(speed=speed / 3.6)


def drawn(curve):
    return np.array(curve["x"], dtype=float), np.array(curve["y"], dtype=float)


def inside(values, axis):
    return axis["low"] <= min(values) and max(values) <= axis["high"]


@pytest.mark.parametrize("top", ["fixed", "pinned", "free"])
def test_the_shape_passes_through_one_at_the_impact(top):
    scenario = Scenario(top=top, column_height=5.3)
    shape, stiffness, mass = charts.pier(scenario)
    square, _, line = shape["curves"]
    phi, z = drawn(line)
    assert np.interp(1.2, z, phi) == pytest.approx(1.0, abs=1e-4)
    np.testing.assert_allclose(drawn(square)[0], phi**2, rtol=1e-3, atol=1e-4)
    assert inside(phi, shape["x"])
    assert inside(phi**2, shape["x"])
    assert shape["y"]["high"] == 6.0
    assert shape["level"]["y"] == 1.2
    assert stiffness["here"]["y"] == pytest.approx(scenario.pier.stiffness / 1e6)
    assert mass["here"]["y"] == pytest.approx(scenario.pier.mass / 1e3)
    for chart in (stiffness, mass):
        x, y = drawn(chart["curves"][0])
        here = chart["here"]
        assert np.interp(here["x"], x, y) == pytest.approx(here["y"], rel=0.05)


def test_stiffness_and_mass_along_a_column_are_those_of_the_impact():
    along = explorer_data.by_height(USUAL.column)
    for place in (3, 20, 44):
        struck = USUAL.column.struck_at(float(along.height[place]))
        assert along.stiffness[place] == struck.stiffness
        assert along.mass[place] == struck.mass


def test_the_limits_of_the_amplification_are_met():
    for curves in explorer_data.amplifications((0.09, 0.9), (0.4, 0.5), 0.02).values():
        soft, stiff = curves.ratio < 0.05, curves.ratio > 40.0
        assert curves.exact[soft] == pytest.approx(curves.impulse[soft], rel=0.05)
        assert curves.exact[stiff] == pytest.approx(curves.static[stiff], rel=0.05)


@pytest.mark.parametrize("frequency", [0.5, 30.0, 900.0])
def test_a_pier_stands_on_the_exact_amplification(frequency):
    scenario = Scenario(pier_mass=8e3, pier_frequency=frequency)
    values = explorer_data.short_procedure(scenario)
    for chart, i in zip(charts.amplification(scenario, values), (1, 2), strict=True):
        x, y = drawn(chart["curves"][-1])
        here = chart["here"]
        assert here["x"] == values[f"beta{i}"]
        assert inside([here["x"]], chart["x"])
        assert inside([here["y"]], chart["y"])
        if x[0] < here["x"] < x[-1]:
            line = np.interp(math.log(here["x"]), np.log(x), y)
            assert line == pytest.approx(here["y"], rel=0.015)


def test_a_body_that_does_not_arrive_has_no_place():
    scenario = Scenario(pier_mass=8e3, pier_frequency=30.0, speed=45.0 / 3.6)
    found = charts.amplification(scenario, explorer_data.short_procedure(scenario))
    assert json.loads(json.dumps(found, allow_nan=False)) == found


def test_bars_are_as_long_as_their_forces():
    scenario = at_speed(45.0)  # where the cargo makes no peak
    (chart,) = charts.reactions(scenario)
    for row, bar in zip(chart["rows"], explorer_data.bars(scenario), strict=True):
        assert row["name"] == bar.name
        assert row["words"].endswith(bar.remark)
        ((value,),) = [[each["value"] for each in row["bars"]]]
        if bar.value is None:
            assert value is None
            assert row["words"].startswith("none")
        else:
            assert value == pytest.approx(bar.value / 1e6)
            assert row["words"].startswith(f"{value:.2f} MN")
            assert value <= chart["x"]["high"]


@pytest.mark.parametrize("speed", [45.0, 62.0, 80.0])
def test_influences_to_either_side(speed):
    changes = explorer_data.influences(at_speed(speed))
    for chart, body in zip(charts.influences(changes), BODIES, strict=True):
        change = changes[body]
        assert bool(chart["empty"]) == (change is None)
        for number, row in enumerate(chart["rows"]):
            for side, each in enumerate(row["bars"]):
                if change is None or np.isnan(change[number, side]):
                    assert each["value"] is None
                else:
                    assert each["value"] == pytest.approx(100.0 * change[number, side])
                    assert inside([each["value"]], chart["x"])
    json.dumps(charts.influences(changes), allow_nan=False)


def test_influences_are_those_of_another_simulation():
    changes = explorer_data.influences(USUAL)
    # The explorer's truck keeps its total mass, the influence its body's.
    heavier = Scenario(
        engine_mass=1.3 * USUAL.engine_mass, truck_mass=USUAL.truck_mass + 0.3 * USUAL.engine_mass
    )
    row = NAMES.index("engine mass")
    ratio = heavier.history.engine_peak.reaction / USUAL.history.engine_peak.reaction
    assert changes["engine"][row, 1] == pytest.approx(ratio - 1.0, rel=1e-6)


def test_every_chart_has_the_example_in_sight():
    values = explorer_data.short_procedure(EXAMPLE)
    assert all(chart["here"] for chart in charts.amplification(EXAMPLE, values))


@given(value=st.floats(1e-6, 1e9))
def test_an_axis_ends_at_a_round_number_not_far_above(value):
    end = round_up(value)
    assert 0.999 * value <= end <= 1.34 * value
    assert round_up(end) == pytest.approx(end)


@given(value=st.floats(1e-3, 1e5))
def test_a_logarithmic_axis_holds_what_lies_beyond(value):
    low, high = round_out(2.0, 200.0, value)
    assert low < value < high
    assert low <= 2.0
    assert high >= 200.0
    if 2.2 < value < 180.0:
        assert (low, high) == (2.0, 200.0)
