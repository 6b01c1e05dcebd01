"""What the sampled trucks do to a case: of each truck the larger of heights and methods."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pierimpact.files.case import case_from, read_case_file
from pierimpact.report.calculation import calculate
from pierimpact.report.outcome import statement
from pierimpact.report.sheet import Sheet
from pierimpact.report.warnings import warnings_of
from pierimpact.resources import shipped

EXAMPLE = read_case_file(shipped("notebooks") / "tti-column.yaml").values
# Trucks whose cargo arrives at one height and not at the other, and in a part of the sample only.
CANTILEVER = EXAMPLE | {
    "column_diameter": "1 m",
    "column_height": "8 m",
    "top": "free",
    "speed": "65 km/h",
    "moment_resistance": "6.6 MN*m",
}


def calculated(values, **changes):
    return calculate(case_from(values | changes))


@given(
    st.floats(0.7, 1.5), st.floats(5.0, 9.0), st.sampled_from(["pinned", "free", "fixed"]),
    st.floats(30.0, 100.0), st.sampled_from(["static", "beam", "larger"]),
)  # fmt: skip
@settings(max_examples=8)
def test_of_both_heights_each_truck_counts_with_the_larger(diameter, height, top, speed, asked):
    changes = {
        "column_diameter": f"{diameter} m",
        "column_height": f"{height} m",
        "top": top,
        "speed": f"{speed} km/h",
        "member_forces": asked,
    }
    both = calculated(EXAMPLE, impact_height="auto", **changes)
    alone = [
        calculated(EXAMPLE, impact_height=f"{impact.struck.impact_height} m", **changes)
        for impact in both.impacts
    ]
    reactions = np.max([own.band.governing for own in alone], axis=0)
    levels = (0.05, 0.5, 0.95)
    assert both.reaction_band == pytest.approx(np.quantile(reactions, levels), rel=1e-9)
    for name, ends in both.demand_bands.items():
        expected = np.max([own.sampled_demands[name][asked] for own in alone], axis=0)
        assert ends == pytest.approx(np.quantile(expected, (0.05, 0.95)), rel=1e-9)
        # An envelope is never less safe than either of its heights.
        assert ends[1] >= max(own.demand_bands[name][1] for own in alone) * (1.0 - 1e-9)


@pytest.mark.parametrize("asked", ["static", "larger"])
def test_a_second_height_makes_no_sheet_less_safe(asked):
    both = calculated(CANTILEVER, impact_height="auto", member_forces=asked)
    higher = calculated(CANTILEVER, impact_height="1.35 m", member_forces=asked)
    assert both.upper_utilisations["moment"] >= higher.upper_utilisations["moment"] > 1.0
    assert "but not every truck" in statement(both)


def test_of_both_methods_each_truck_counts_with_the_larger():
    result = calculated(CANTILEVER, impact_height="1.2 m", speed="50 km/h")
    for by_method in result.sampled_demands.values():
        larger = np.fmax(by_method["static"], by_method["beam"])
        assert np.array_equal(by_method["larger"], larger)
        # The nominal truck's ratio of the methods is not every truck's.
        assert np.ptp(by_method["static"] / by_method["beam"]) > 0.1


@pytest.mark.parametrize("asked", ["static", "beam", "larger"])
def test_bands_are_drawn_on_the_side_of_what_governs(asked, monkeypatch):
    drawn = []
    monkeypatch.setattr(
        "pierimpact.report.sheet.member_forces.draw_envelopes",
        lambda impacts, parts, bands, *_: drawn.append(bands) or "",
    )
    sheet = Sheet(case_from(EXAMPLE | {"member_forces": asked}))
    sheet.member_forces.diagrams()
    (bands,), result = drawn, sheet.calculation
    for name, (low, high) in result.demand_bands.items():
        beam = result.largest_of_beam(name)
        values = {
            "static": getattr(result.member_forces, f"largest_{name}").value,
            "beam": 0.0 if beam is None else beam[0].value,
        }
        governing = values.get(asked) or max(values.values(), key=abs)
        assert bands[name] == tuple(np.sign(governing) * np.array([low, high]))


def test_a_truck_whose_collision_is_unfinished_is_left_out():
    result = calculated(EXAMPLE)
    before, demands = result.reaction_band, result.demand_bands
    reactions = result.band.reactions
    lost = reactions._replace(governing=np.where(np.arange(1000) == 7, np.nan, reactions.governing))
    again = calculated(EXAMPLE)
    again.__dict__["band"] = dataclasses.replace(again.band, reactions=lost)
    assert again.reaction_band == pytest.approx(before, rel=5e-3)
    for name, ends in again.demand_bands.items():
        assert ends == pytest.approx(demands[name], rel=5e-3)


def test_static_forces_are_not_vouched_for_where_the_cargo_arrives_in_part_of_the_spread():
    case = CANTILEVER | {"impact_height": "1.2 m", "speed": "50 km/h"}
    result = calculated(case, column_diameter="0.9 m", column_height="9 m", member_forces="static")
    assert result.history.cargo_contact_time is None
    said = " ".join(warnings_of(result))
    share = f"{100.0 * result.band.cargo_contact:.0f} % of the sampled trucks reaches the pier"
    assert 0.05 < result.band.cargo_contact < 1.0
    assert share in said
    assert "sampled trucks" not in " ".join(warnings_of(calculated(case, speed="100 km/h")))


def test_static_forces_go_with_the_reaction():
    result = calculated(CANTILEVER, impact_height="1.2 m", member_forces="static")
    for name, (low, high) in result.demand_bands.items():
        per_reaction = result.demands[name].value / result.design_force
        ends = np.array(result.reaction_band)[[0, 2]] * per_reaction
        assert (low, high) == pytest.approx(ends, rel=1e-12)
        assert list(result.sampled_demands[name]) == ["static"]
