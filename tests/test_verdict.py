"""What a sheet says first: whether the column holds, how surely, and what stands against it."""

import datetime
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_arranged_sheet import number

from pierimpact import EquivalentPier, load_truck, reaction_band, simulate
from pierimpact.files.case import case_from
from pierimpact.report.outcome import first_results, statement
from pierimpact.report.sheet import Sheet
from pierimpact.report.warnings import warnings_beside_verdict
from pierimpact.resources import shipped

ROUND = {
    "column_shape": "circular",
    "column_diameter": "1.0 m",
    "column_height": "6.2 m",
    "concrete_strength": "35 MPa",
    "density": "2500 kg/m^3",
    "base": "fixed",
    "top": "pinned",
    "truck": "single-unit-8t",
    "speed": "80 km/h",
    "impact_height": "1.2 m",
}
STEPPED = ROUND | {
    "column_diameter": "2 m",
    "steps": [{"height": "2.5 m", "column_shape": "circular", "column_diameter": "0.9 m"}],
    "shear_resistance": "12 MN",
    "moment_resistance": "16 MN*m",
}


def sheet_of(**values):
    return Sheet(case_from(ROUND | values))


def words_of(block):
    """The text of a paragraph."""
    return "" if block is None else block.body if isinstance(block.body, str) else str(block.body)


@pytest.mark.parametrize(
    ("resistance", "mark"), [("20 MN", ""), ("7.5 MN", "CAUTION"), ("5 MN", "STOP")]
)
def test_what_holds_but_at_the_end_of_the_band_is_marked(resistance, mark):
    sheet = sheet_of(shear_resistance=resistance)
    assert sheet.first_page.verdict().mark == mark
    assert sheet.first_page.utilisations().strong == ([0] if mark else [])
    result = sheet.calculation
    holds, at_upper = result.utilisations["shear"], result.upper_utilisations["shear"]
    assert (holds > 1.0, at_upper > 1.0) == (mark == "STOP", mark != "")


@pytest.mark.parametrize("spread", [True, False])
def test_without_a_spread_no_column_is_for_its_end(tmp_path, monkeypatch, spread):
    monkeypatch.chdir(tmp_path)
    lines = (shipped("trucks") / "single-unit-8t.toml").read_text(encoding="utf-8").splitlines()
    kept = [line for line in lines if spread or not line.startswith("spread")]
    Path("own.toml").write_text("\n".join(kept), encoding="utf-8")
    table = sheet_of(truck="own.toml", shear_resistance="20 MN").first_page.utilisations()
    heads = [column.heading for column in table.columns]
    assert ("at 95 %" in heads) == spread
    assert {len(row) for row in table.rows} == {len(heads)}


@settings(max_examples=12)
@given(st.floats(20.0, 200.0), st.floats(3.0, 25.0))
def test_the_share_of_engines_that_arrive_is_that_of_the_collisions(frequency, speed):
    pier = EquivalentPier.from_frequency(9e3, frequency, 0.05)
    band = reaction_band(load_truck("single-unit-8t"), pier, speed, size=64)
    collisions = [band.sampled(index) for index in range(64)]
    histories = [simulate(own.truck, own.pier, own.speed) for own in collisions]
    for body, share in (("engine", band.engine_contact), ("cargo", band.cargo_contact)):
        times = [getattr(history, f"{body}_contact_time") for history in histories]
        assert share == np.mean([time is not None for time in times])


def test_of_both_bodies_the_share_is_said_that_arrives():
    slow = sheet_of(column_height="2 m", speed="50 km/h", column_diameter="0.9 m")
    band = slow.calculation.band
    words = words_of(slow.first_page.contacts())
    engine, cargo = 100.0 * band.engine_contact, 100.0 * band.cargo_contact
    assert 0.0 < cargo < engine < 100.0
    assert f"the engine of {engine:.2g} % and the cargo of {cargo:.2g} % do." in words


def test_the_band_says_where_in_it_the_design_reaction_is():
    sheet = sheet_of(impact_height="auto")
    result = sheet.calculation
    largest = np.max([band.governing for band in bands_of(result)], axis=0)
    remark = next(own.remark for own in first_results(result) if own.label.startswith("Band"))
    above = float(np.mean(largest > result.design_force))
    assert result.share_above == above
    middle = number(remark.partition("half above ")[2].partition(",")[0])
    assert middle == pytest.approx(1e-3 * float(np.quantile(largest, 0.5)), rel=1e-3)
    assert f"{100.0 * above:.2g} % above the design reaction" in remark


def bands_of(result):
    return [
        reaction_band(result.case.truck, impact.history.pier, result.case.inputs.speed)
        for impact in result.impacts
    ]


@pytest.mark.parametrize(("resistance", "warned"), [("1.2 MN*m", True), ("9 MN*m", False)])
def test_what_holds_the_truck_and_not_the_force_of_the_code_is_warned_of(resistance, warned):
    sheet = sheet_of(
        column_height="4.2 m", base="pinned", top="fixed", speed="25 km/h", impact_height="0.5 m",
        moment_resistance=resistance,
    )  # fmt: skip
    result = sheet.calculation
    assert result.utilisations["moment"] < 1.0
    force = abs(result.case.column.member_forces(2668.9e3, 1.5).largest_moment.value)
    assert (force > result.resistances["moment"]) == warned
    first, *_ = warnings_beside_verdict(result)
    assert ("force of AASHTO LRFD alone" in first) == warned


def test_one_resistance_for_parts_that_differ_is_said_to_be_so():
    sheet = Sheet(case_from(STEPPED))
    assert "of one resistance for all parts" in statement(sheet.calculation)
    first, *_ = warnings_beside_verdict(sheet.calculation)
    assert "One resistance is held against all parts" in first
    assert "the largest shear and moment between 0 and 2.5 m" in first
    same = Sheet(case_from(STEPPED | {"steps": [STEPPED["steps"][0] | {"column_diameter": "2 m"}]}))
    assert "for all parts" not in statement(same.calculation)
    assert same.member_forces.places() is None


@settings(max_examples=10)
@given(st.floats(1.3, 5.5), st.floats(0.6, 1.6), st.sampled_from(["1.2 m", "auto"]))
def test_parts_have_their_own_largest_forces(height, diameter, impact_height):
    step = {"height": f"{height} m", "column_shape": "circular", "column_diameter": f"{diameter} m"}
    sheet = Sheet(case_from(STEPPED | {"steps": [step], "impact_height": impact_height}))
    result = sheet.calculation
    for name, demand in result.demands.items():
        of_parts = [result.largest_within(name, *ends) for ends in result.parts]
        assert max(own.static for own in of_parts) == pytest.approx(demand.static, rel=1e-12)
        assert max(own.beam for own in of_parts) == pytest.approx(demand.beam, rel=1e-12)
        for (low, high), own in zip(result.parts, of_parts, strict=True):
            places = np.linspace(low + 1e-9, high - 1e-9, 4001)
            most = 0.0
            for impact in result.impacts:
                forces, below = impact.member_forces, places < impact.struck.impact_height
                moments = np.where(
                    below,
                    forces.base_moment + forces.base_force * places,
                    forces.top_moment + forces.top_force * (forces.height - places),
                )
                shears = np.where(below, forces.base_force, -forces.top_force)
                most = max(most, np.abs(moments if name == "moment" else shears).max())
            assert own.static == pytest.approx(most, rel=1e-3, abs=1.0)
    rows = sheet.member_forces.places().rows
    assert len(rows) == len(result.parts) + (2 if impact_height == "auto" else 0)


def test_yielding_is_of_the_height_that_is_named():
    sheet = sheet_of(impact_height="auto", moment_resistance="3.1 MN*m")
    table = sheet.member_forces.yielding()
    values = {row[0]: number(row[2]) for row in table.rows}
    struck, history = sheet.calculation.yielding
    assert f"struck at {struck.impact_height:g} m" in table.caption
    ductility = values["Largest displacement at the impact"] * values["Stiffness of the pier"]
    assert values["Ductility demand"] == pytest.approx(
        1e3 * ductility / values["Yield reaction"], rel=2e-3
    )
    assert values["Stiffness of the pier"] == pytest.approx(1e-6 * struck.stiffness, rel=1e-4)
    assert history.pier.stiffness == struck.stiffness


def test_what_fails_in_shear_first_has_no_ductility():
    sheet = sheet_of(moment_resistance="3.1 MN*m", shear_resistance="2.4 MN")
    words = words_of(sheet.member_forces.yielding())
    struck, history = sheet.calculation.yielding
    shear = abs(struck.member_forces(history.pier.yield_reaction).largest_shear.value)
    assert f"the shear is {shear / 2.4e6:.2f} times its resistance" in words
    assert "Ry" not in sheet.member_forces.symbols()


def test_what_only_the_beam_exceeds_has_a_ductility_that_is_not_known():
    stiff = {
        "column_height": "12 m",
        "top": "free",
        "top_mass": "400 t",
        "column_diameter": "1.2 m",
    }
    moments = sheet_of(**stiff).calculation.demands["moment"]
    assert moments.beam > 1.02 * moments.static
    between = 0.5e-6 * (moments.beam + moments.static)
    sheet = sheet_of(**stiff, moment_resistance=f"{between} MN*m")
    assert "is not known" in words_of(sheet.member_forces.yielding())


def test_the_modes_share_the_deflection_among_them():
    sheet = sheet_of()
    _, table = sheet.member_forces.modes().blocks
    *modes, others = table.rows
    assert sum(number(row[2]) for row in table.rows) == pytest.approx(100.0, abs=0.2)
    assert others[0] == "all others"
    frequencies = [number(row[1]) for row in modes]
    assert frequencies == sorted(frequencies)
    beam = sheet.case.column.beam(1.2, 0.05)
    assert frequencies == pytest.approx(beam.frequencies[: len(modes)], rel=1e-3)
    assert sheet_of(member_forces="static").member_forces.modes() is None


def test_a_sheet_is_of_the_date_of_its_revision():
    lines = [{"revision": name, "date": f"2026-0{month}-02"} for month, name in enumerate("ABC", 1)]
    of_b = case_from(ROUND | {"revision": "B", "revisions": lines})
    assert of_b.inputs.date == datetime.date(2026, 2, 2)
    given_another = case_from(
        ROUND
        | {"revision": "B", "revisions": lines, "date": "2026-05-01", "truck": "single-unit-8t"}
    )
    assert given_another.inputs.date == datetime.date(2026, 5, 1)
    said = warnings_beside_verdict(Sheet(given_another).calculation)
    assert "The sheet is of 2026-05-01, its revision B of 2026-02-02." in said
    assert case_from(ROUND | {"revisions": lines}).inputs.date == datetime.date.today()
