"""What a sheet says first: whether the column holds, how surely, and what stands against it."""

import csv
import datetime
import io
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_arranged_sheet import number

from pierimpact import EquivalentPier, InputError, load_truck, reaction_band, simulate
from pierimpact.files.case import case_from
from pierimpact.report.check import check_text
from pierimpact.report.outcome import first_results, statement
from pierimpact.report.results import Results
from pierimpact.report.sheet import Sheet
from pierimpact.report.summary import Row, summary_csv
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
    assert ", of one resistance for parts that differ" in statement(sheet.calculation)
    first, *_ = warnings_beside_verdict(sheet.calculation)
    assert "held against the same shear and moment resistance" in first
    half = Sheet(case_from(with_step(moment_resistance="14 MN*m")))
    assert ", in shear of one resistance for parts that differ" in statement(half.calculation)
    same = Sheet(case_from(STEPPED | {"steps": [STEPPED["steps"][0] | {"column_diameter": "2 m"}]}))
    assert "parts that differ" not in statement(same.calculation)
    assert "the same shear" not in " ".join(warnings_beside_verdict(same.calculation))


@pytest.mark.parametrize("top", ["pinned", "free"])
def test_at_a_step_that_is_struck_each_part_has_its_own_side_of_the_impact(top):
    """As where the step is a little above or below it."""

    def forces(height):
        case = STEPPED | {"top": top, "steps": [STEPPED["steps"][0] | {"height": height}]}
        result = Sheet(case_from(case)).calculation
        return [result.demands_of(part)["shear"] for part in result.case.parts]

    below, above = forces("1.2 m")
    (_, just_above), (just_below, _) = forces("1.205 m"), forces("1.195 m")
    assert above.beam == pytest.approx(just_above.beam, rel=0.05)
    assert below.beam == pytest.approx(just_below.beam, rel=0.05)
    assert above.beam < 0.7 * below.beam
    assert above.static == pytest.approx(just_above.static, rel=0.05, abs=1.0)


@settings(max_examples=10)
@given(st.floats(1.3, 5.5), st.floats(0.6, 1.6), st.sampled_from(["1.2 m", "auto"]))
def test_parts_have_their_own_largest_forces(height, diameter, impact_height):
    step = {"height": f"{height} m", "column_shape": "circular", "column_diameter": f"{diameter} m"}
    sheet = Sheet(case_from(STEPPED | {"steps": [step], "impact_height": impact_height}))
    result = sheet.calculation
    for name, demand in result.demands.items():
        of_parts = [result.demands_of(part)[name] for part in result.case.parts]
        assert max(own.static for own in of_parts) == pytest.approx(demand.static, rel=1e-12)
        assert max(own.beam for own in of_parts) == pytest.approx(demand.beam, rel=1e-12)
        for part, own in zip(result.case.parts, of_parts, strict=True):
            places = np.linspace(part.low + 1e-9, part.high - 1e-9, 4001)
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
    assert len(rows) == 2 + (2 if impact_height == "auto" else 0)


def test_yielding_is_of_the_height_that_is_named():
    sheet = sheet_of(impact_height="auto", moment_resistance="3.1 MN*m")
    table = sheet.member_forces.yielding()
    values = {row[0]: number(row[2]) for row in table.rows}
    struck, _, history, _ = sheet.calculation.yielding
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
    struck, _, history, _ = sheet.calculation.yielding
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


def with_step(**resistances):
    return STEPPED | {"steps": [STEPPED["steps"][0] | resistances]}


@pytest.mark.parametrize("impact_height", ["1.2 m", "auto"])
def test_a_step_has_resistances_of_its_own(impact_height):
    case = with_step(shear_resistance="1.5 MN", moment_resistance="0.9 MN*m")
    sheet = Sheet(case_from(case | {"impact_height": impact_height}))
    result = sheet.calculation
    limits = {"shear": (12e6, 1.5e6), "moment": (16e6, 0.9e6)}
    for name, (below, above) in limits.items():
        ratios = [
            result.demands_of(part)[name].value / limit
            for part, limit in zip(result.case.parts, (below, above), strict=True)
        ]
        assert result.utilisations[name] == pytest.approx(max(ratios), rel=1e-12)
        assert result.uses[name].part == result.case.parts[int(np.argmax(ratios))]
    assert "parts that differ" not in statement(result)
    assert "held against the same" not in " ".join(warnings_beside_verdict(result))
    rows = {row[0]: row for row in sheet.first_page.utilisations().rows}
    for name, unit in (("Shear", "kN"), ("Moment", "kN·m")):
        check = result.uses[name.lower()]
        row = rows[f"{name} [{unit}]"]
        assert row[3].endswith(f", {check.part.low:g} to {check.part.high:g} m")
        assert number(row[4]) == pytest.approx(1e-3 * check.resistance)
        demand = max(number(row[1]), number(row[2]))
        assert number(row[5]) == pytest.approx(demand / number(row[4]), rel=5e-3)
    of_parts = sheet.member_forces.places().rows[-2:]
    assert [number(row[3]) for row in of_parts] == [12_000.0, 1500.0]
    assert [number(row[6]) for row in of_parts] == [16_000.0, 900.0]


def test_a_step_that_resists_the_same_changes_nothing():
    one = Sheet(case_from(STEPPED)).calculation
    same = with_step(shear_resistance="12 MN", moment_resistance="16 MN*m")
    two = Sheet(case_from(same)).calculation
    assert two.utilisations == one.utilisations
    assert two.upper_utilisations == one.upper_utilisations
    assert "held against" not in " ".join(warnings_beside_verdict(two))


def test_what_95_percent_stay_below_is_of_the_part_that_each_truck_uses_most():
    strong = {"shear_resistance": "90 MN", "moment_resistance": "90 MN*m"}
    weak = with_step(shear_resistance="1.1 MN", moment_resistance="0.8 MN*m") | strong
    result = Sheet(case_from(weak)).calculation
    whole = Sheet(case_from(STEPPED)).calculation
    for method in ("static", "beam", "larger"):
        for name, largest in result.sampled_demands.items():
            # The whole column's are the larger of its parts'.
            assert largest[method] == pytest.approx(whole.sampled_demands[name][method], rel=1e-9)
    upper = result.upper_utilisations
    assert upper["moment"] > result.utilisations["moment"]
    stronger = with_step(shear_resistance="2.2 MN", moment_resistance="1.6 MN*m") | strong
    half = Sheet(case_from(stronger)).calculation
    assert half.uses["moment"].part == half.case.parts[1]
    assert half.upper_utilisations["moment"] == pytest.approx(0.5 * upper["moment"], rel=1e-9)


def test_the_part_that_yields_is_named():
    case = with_step(moment_resistance="0.3 MN*m") | {"shear_resistance": "40 MN"}
    sheet = Sheet(case_from(case))
    table, found = sheet.member_forces.yielding(), sheet.calculation.yielding
    values = {row[0]: number(row[2]) for row in table.rows}
    assert "yields in bending from 2.5 to 6.2 m" in table.caption
    moment = values["Yield reaction"] * values["Largest moment under a unit force"]
    assert moment == pytest.approx(300.0, rel=1e-3)
    forces = found.struck.member_forces(found.history.pier.yield_reaction)
    assert forces.moment_within(2.5, 6.2) == pytest.approx(0.3e6, rel=1e-9)


@pytest.mark.parametrize(
    ("case", "message"),
    [
        (
            {
                k: v
                for k, v in with_step(shear_resistance="1 MN").items()
                if k != "shear_resistance"
            },
            "steps[1].shear_resistance is given, and shear_resistance of the column below is",
        ),
        (with_step(moment_resistance="3 MN"), "steps[1].moment_resistance"),
        (with_step(shear_resistance="-3 MN"), "steps[1].shear_resistance"),
    ],
)
def test_a_bad_resistance_of_a_step_is_one_line(case, message):
    with pytest.raises(InputError) as error:
        case_from(case)
    assert message in str(error.value)
    assert "\n" not in str(error.value)


def test_inputs_and_results_have_what_each_part_resists():
    sheet = Sheet(case_from(with_step(shear_resistance="1500 kN", moment_resistance="0.9 MN*m")))
    rows = {row[0]: row for row in sheet.inputs.case_table().rows}
    assert [
        number(rows[f"{name} resistance, from 2.5 m upward"][2]) for name in ("Shear", "Moment")
    ] == [
        1500.0,
        900.0,
    ]
    results = Results.of(sheet.calculation)
    for name, used in results.uses.items():
        assert used.demand / used.resistance == pytest.approx(results.utilisations[name], rel=1e-12)
        assert used.demand <= getattr(results, f"largest_{name}") * (1.0 + 1e-12)
        assert f"{used.low:g} to {used.high:g} m" in check_text("case", sheet.calculation)


def test_the_smaller_member_forces_are_told_by_what_parts_use():
    case = with_step(shear_resistance="0.02 MN", moment_resistance="16 MN*m")
    case |= {"base": "pinned", "top": "fixed", "member_forces": "beam"}
    result = Sheet(case_from(case)).calculation
    static = max(
        result.demands_of(part)["shear"].static / part.resistances["shear"]
        for part in result.case.parts
    )
    words = next((own for own in warnings_beside_verdict(result) if "smaller" in own), "")
    assert (static > result.utilisations["shear"]) == (f"{static:.3g} in shear" in words)


def test_a_column_that_fails_in_shear_by_the_beam_has_no_ductility():
    demands = sheet_of(column_height="9 m").calculation.demands
    shear, moment = demands["shear"], demands["moment"]
    assert shear.static < 0.9 * shear.beam
    limits = {"moment_resistance": f"{0.95e-6 * moment.static} MN*m"}
    limits["shear_resistance"] = (
        f"{0.9e-6 * shear.beam} MN"  # which the static shear does not reach
    )
    words = words_of(sheet_of(column_height="9 m", **limits).member_forces.yielding())
    assert "fails in shear before it yields in bending: it uses 1.11 times" in words


def test_a_sheet_lists_no_traffic_that_it_does_not_rest_on():
    traffic = {
        "traffic_volume": "20000 vehicles/day",
        "truck_share": 0.15,
        "distance_from_road": "6 m",
        "exposed_width": "3 m",
        "assumed": {"truck_share": "of the district"},
    }
    assert "Assumed" not in " ".join(warnings_beside_verdict(sheet_of(**traffic).calculation))
    names = [row[0] for row in sheet_of(**traffic).inputs.case_table().rows]
    assert names == [row[0] for row in sheet_of().inputs.case_table().rows]
    assert "Speed at first touch" in names


def test_a_row_of_the_summary_is_of_the_part_that_uses_most():
    case = with_step(shear_resistance="0.9 MN", moment_resistance="0.7 MN*m")
    results = Results.of(Sheet(case_from(case)).calculation)
    rows = csv.DictReader(io.StringIO(summary_csv([Row("a", results, [])]), newline=""))
    (row,) = rows
    for name, unit in (("shear", "kN"), ("moment", "kN·m")):
        largest, use = float(row[f"largest {name} [{unit}]"]), results.uses[name]
        assert largest == pytest.approx(1e-3 * use.demand, rel=1e-3)
        assert row[f"{name} method"] == use.method
        limit = 1e-3 * use.resistance
        assert float(row[f"utilisation in {name}"]) == pytest.approx(largest / limit, rel=1e-3)
        upper = float(row[f"{name}, 95 % of trucks below [{unit}]"])
        at_upper = float(row[f"utilisation in {name} at 95 %"])
        assert at_upper == pytest.approx(upper / limit, rel=1e-3)
