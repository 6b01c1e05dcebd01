"""The sheet of a column with steps, springs, embedment and a mass at its top."""

import re
from html import unescape

import pytest
import stiffness_method
from generated_columns import joints
from sheet_page import page_of

from pierimpact import InputError
from pierimpact.files.case import case_from
from pierimpact.report.check import check_text
from pierimpact.report.outcome import first_results
from pierimpact.report.sheet import Sheet
from pierimpact.report.warnings import warnings_of
from pierimpact.units import compared

CASE = {
    "column_shape": "hollow circular",
    "column_diameter": "1.8 m",
    "column_wall_thickness": "0.3 m",
    "column_height": "9.0 m",
    "elastic_modulus": "28 GPa",
    "density": "2450 kg/m^3",
    "stiffness_factor": 0.6,
    "base": "fixed",
    "top": "free",
    "base_stiffness": "2500 MN/m",
    "base_rotation_stiffness": "20 GN*m/rad",
    "top_stiffness": "3 MN/m",
    "top_mass": "60 t",
    "embedment": "0.8 m",
    "steps": [{"height": "3 m", "column_shape": "circular", "column_diameter": "1.5 m"}],
    "truck": "single-unit-8t",
    "speed": "62 km/h",
    "impact_height": "1.2 m",
    "shear_resistance": "3 MN",
    "moment_resistance": "4 MN*m",
}


@pytest.fixture(scope="module")
def sheet():
    return Sheet(case_from(CASE))


def number(cell):
    """A printed number."""
    digits = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
    mantissa, _, power = re.sub(r"\s", "", cell).partition("×10")
    return float(mantissa.translate(digits)) * 10.0 ** int(power.translate(digits) or 0)


def cells(table, column):
    return [row[column] for row in table.data()["rows"]]


def test_what_the_unit_force_does_is_printed_and_in_equilibrium(sheet):
    column = sheet.calculation.case.column
    Rb, Rt, Mb, Mn, Mt = map(number, cells(sheet.pier.unit_forces(), 2))
    assert Rb + Rt == pytest.approx(1.0, abs=2e-5)
    assert Mb + Rb * (1.2 + 0.8) == pytest.approx(Mn, abs=1e-3)
    assert Mt + Rt * (9.0 - 1.2) == pytest.approx(Mn, abs=1e-3)
    heights = joints(column, 1.2)
    _, _, forces, moments = stiffness_method.solve(column, heights, 1.2)
    assert (Rb, Rt) == pytest.approx([-float(force) for force in forces], rel=1e-4)
    assert Mb == pytest.approx(float(moments[0]), rel=1e-4)


def test_works_add_up_to_the_deflection(sheet):
    works = list(map(number, cells(sheet.pier.stiffness(), 3)))
    assert sum(works[:-1]) == pytest.approx(works[-1], rel=2e-4)
    column = sheet.calculation.case.column
    heights = joints(column, 1.2)
    deflections, _, _, _ = stiffness_method.solve(column, heights, 1.2)
    exact = 1e6 * float(deflections[heights.index(1.2)])
    assert works[-1] == pytest.approx(exact, rel=1e-4)


def test_masses_add_up_to_the_equivalent_mass(sheet):
    table = sheet.pier.shape_table()
    masses = list(map(number, cells(table, 5)))
    assert sum(masses[:-1]) == pytest.approx(masses[-1], rel=2e-4)
    assert masses[-1] == pytest.approx(sheet.calculation.pier.mass, rel=1e-4)
    per_length = list(map(number, cells(sheet.pier.parts(), 6)))
    for part, mass, per in zip(cells(table, 4), masses, per_length, strict=False):
        assert number(part) * per == pytest.approx(mass, rel=2e-4)
    top = number(cells(table, 3)[-2])
    assert masses[-2] == pytest.approx(60e3 * top**2, rel=1e-3)


def test_of_an_energy_below_round_off_nothing_is_printed():
    case = {key: CASE[key] for key in CASE if key not in ("top_mass", "embedment", "steps")}
    rows = Sheet(case_from(case | {"damping_ratio": 0.2})).model.energy().data()["rows"]
    for column in (1, 2):
        *values, whole = (number(row[column]) for row in rows)
        assert all(value == 0.0 or abs(value) > 1e-9 * whole for value in values)
    assert rows[1][2].strip() == "0"  # in the deflection, at the end


def test_every_part_has_its_own_section(sheet):
    table, column = sheet.pier.parts(), sheet.calculation.case.column
    sections = [column.section, column.section, column.steps[0].section]
    for place, name in ((1, "area"), (2, "second_moment"), (3, "shear_coefficient")):
        expected = [getattr(section, name) for section in sections]
        assert list(map(number, cells(table, place))) == pytest.approx(expected, rel=1e-4)
    A, Iy, kappa, EI, GA, mbar = (list(map(number, cells(table, i))) for i in range(1, 7))
    for part in range(3):
        assert EI[part] == pytest.approx(0.6 * 28e3 * Iy[part], rel=2e-4)
        assert GA[part] == pytest.approx(kappa[part] * A[part] * 28e3 / 2.4, rel=2e-4)
        assert mbar[part] == pytest.approx(2450.0 * A[part], rel=2e-4)


def test_the_inputs_give_every_section(sheet):
    rows = sheet.inputs.case_table().data()["rows"]
    above = {row[0]: (row[2].strip(), row[3]) for row in rows if "from 3 m upward" in row[0]}
    assert above == {
        "Shape of the section, from 3 m upward": ("circular", ""),
        "Column diameter, from 3 m upward": ("1.5", "m"),
    }
    step = {"height": "3 m", "column_shape": "oblong", "column_width": "2 m", "column_depth": "1 m"}
    symbols = Sheet(case_from(CASE | {"steps": [step]})).inputs.symbols()
    assert (symbols["b"], symbols["h"]) == ("tab-inputs", "tab-inputs")


def test_a_struck_end_has_no_shear_beyond_it_and_yielding_has_its_symbol():
    case = CASE | {"impact_height": "3.0 m", "column_height": "3.0 m", "steps": []}
    del case["top_stiffness"]
    sheet = Sheet(case_from(case | {"speed": "80 km/h"}))
    _, top, *_ = sheet.member_forces.table().data()["rows"]
    assert (top[2], top[4:6]) == ("0", ["", ""])
    assert sheet.calculation.yielding is not None
    assert sheet.member_forces.symbols()["Ry"] == "tab-yielding"


def test_a_mass_at_a_top_that_does_not_move_is_named():
    words = "The mass at the top has no effect"
    case = CASE | {"member_forces": "static"}
    pinned = {key: value for key, value in case.items() if key != "top_stiffness"}
    for values, named in ((case, False), (pinned | {"top": "pinned"}, True)):
        calculation = Sheet(case_from(values)).calculation
        assert any(words in sentence for sentence in warnings_of(calculation)) == named


def test_the_larger_of_both_methods_governs_unless_one_is_asked_for():
    found = {
        asked: Sheet(case_from(CASE | {"member_forces": asked} if asked else CASE)).calculation
        for asked in ("", "beam", "static")
    }
    shear = {asked: calculation.demands["shear"] for asked, calculation in found.items()}
    assert shear["beam"].beam == shear[""].beam
    assert shear["static"].beam is None
    assert shear[""].value == max(shear[""].beam, shear[""].static)
    assert (shear["beam"].value, shear["static"].value) == (shear[""].beam, shear[""].static)
    for calculation in found.values():
        for name, resistance in (("shear", 3e6), ("moment", 4e6)):
            ratio = calculation.demands[name].value / resistance
            assert calculation.utilisations[name] == ratio


def test_a_step_that_is_struck_is_so_in_whatever_words():
    case = CASE | {"steps": [CASE["steps"][0] | {"height": "36 in"}]}
    inches, feet = (Sheet(case_from(case | {"impact_height": z})) for z in ("36 in", "3 ft"))
    assert inches.calculation.demands == feet.calculation.demands


def test_the_page_says_which_method_governs(sheet):
    page = page_of(CASE)
    demands = sheet.calculation.demands
    assert demands["shear"].method == "beam"
    assert "The column as a beam takes" in page
    assert "column as a beam" in page
    assert "The column as a beam takes" not in page_of(CASE | {"member_forces": "static"})


def test_a_case_that_chose_the_smaller_member_forces_is_told_so():
    case = {
        **{"column_shape": "circular", "column_diameter": "1.2 m", "column_height": "6 m"},
        **{"concrete_strength": "30 MPa", "density": "2400 kg/m^3", "base": "fixed"},
        **{"top": "fixed", "truck": "single-unit-8t", "speed": "80 km/h"},
        **{"impact_height": "1.2 m", "moment_resistance": "7 MN*m"},
    }

    def calculated(**values):
        return Sheet(case_from(case | values)).calculation

    larger = calculated()
    beam, static = (larger.demands["shear"].beam, larger.demands["shear"].static)
    assert static > beam
    resistance = {"shear_resistance": f"{0.5 * (static + beam) / 1e3} kN"}
    asked = Sheet(case_from(case | resistance | {"member_forces": "beam"}))
    assert asked.calculation.utilisations["shear"] < 1.0
    first = asked.first_page.warnings().body[0]
    of_static = static / asked.calculation.resistances["shear"]
    assert first.startswith(
        "The case chose the smaller member forces, those of the column as a bea"
    )
    assert f"{compared(static / beam)} times the shear" in first
    assert f"a utilisation of {compared(of_static)} in shear" in first
    assert of_static > 1.0
    bare = calculated(member_forces="beam", shear_resistance=None, moment_resistance=None)
    assert "utilisation" not in warnings_of(bare)[0]
    for other in ("larger", "static"):
        found = warnings_of(calculated(**resistance, member_forces=other))
        assert not any(line.startswith("The case chose") for line in found)


@pytest.mark.parametrize(
    ("asked", "head"), [("larger", "Governs"), ("beam", "Checked by"), ("static", "Checked by")]
)
def test_the_method_is_said_to_govern_only_where_it_does(asked, head):
    table = Sheet(case_from(CASE | {"member_forces": asked})).first_page.utilisations()
    assert table.columns[3].heading == head
    assert ("that governs" in table.caption) == (asked == "larger")


def test_the_band_says_what_its_shares_are_and_which_mass_has_no_spread():
    case = CASE | {"annexes": ["sensitivity"], "member_forces": "static"}
    given, own = (Sheet(case_from(case | {"truck_mass": mass})) for mass in ("9 t", None))
    for sheet, but_for in ((given, True), (own, False)):
        found = {label: remark for label, _, remark in first_results(sheet.calculation)}
        remark = found["Band, 5 to 95 %"]
        assert remark.endswith("% of the variance, alone and with others")
        assert ("but for its body’s mass, which the case gives" in remark) == but_for
        assert "may add up to more than 100 %" in sheet.sensitivities.band().caption
    assert sum(own.calculation.band.influence.values()) > 1.0


def test_the_figures_of_sensitivity_say_what_changes_and_by_which_method():
    sheet = Sheet(case_from(CASE | {"annexes": ["sensitivity"], "member_forces": "static"}))
    assert "impact height and pier frequency by about 10 %" in sheet.sensitivity.tornado().caption
    drawn = unescape(sheet.sensitivities.figure().svg)
    assert "spectrum method" in drawn
    assert "design procedure" not in drawn


@pytest.mark.parametrize(
    ("speed", "before_cargo"), [("5 km/h", "sheet metal"), ("80 km/h", "engine")]
)
def test_where_the_engine_does_not_arrive_sheet_metal_makes_the_peak_everywhere(
    speed, before_cargo
):
    case = case_from(CASE | {"speed": speed, "member_forces": "static"})
    sheet = Sheet(case)
    history, name = sheet.calculation.history, before_cargo.capitalize()
    assert history.before_cargo == before_cargo
    met = history.engine_contact_time
    assert (met is not None and met <= history.engine_peak.time) == (before_cargo == "engine")
    assert sheet.model.peaks().rows[0][0] == name
    assert sheet.spectrum_method.check().rows[0][0] == name
    drawn = unescape(sheet.model.history().svg + sheet.spectrum_method.spectra().svg)
    assert f"{name} peak" in drawn
    assert ("Engine peak" in drawn, "engine governs" in drawn) == (before_cargo == "engine",) * 2
    if before_cargo == "sheet metal":
        assert sheet.calculation.governs == sheet.results().governs == "sheet metal"
        assert "sheet metal peak of the full model" in check_text("P", sheet.calculation)
        assert "crumpling sheet metal alone" in str(sheet.first_page.contacts())
        assert "engine peak" not in page_of(CASE | {"speed": speed}).replace(
            "are the engine peak, or the sheet metal’s", ""
        )


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"steps": "3 m"}, "steps must be a list of heights with the keys of their sections, got"),
        ({"steps": [{"height": "3 m"}]}, "steps[1].column_shape is missing"),
        (
            {"steps": [{"height": "3", "column_shape": "circular", "column_diameter": "1 m"}]},
            "steps[1].height must have a unit (m, mm, ft, in), got '3'",
        ),
        (
            {"steps": [{"height": "3 m", "column_shape": "circular", "diameter": "1 m"}]},
            "'diameter' is not a key of a step; did you mean column_diameter?",
        ),
        (
            {"steps": [{"height": "3 m", "column_shape": "circular", "column_width": "1 m"}]},
            "steps[1].column_diameter is missing: it belongs to column_shape circular",
        ),
        (
            {"steps": [{"height": "9 m", "column_shape": "circular", "column_diameter": "1 m"}]},
            "steps[1].height must be above 0 m and below the height 9 m, got 9 m",
        ),
        ({"base_stiffness": "-1 MN/m"}, "base_stiffness must be from 0.0010 to 1.0×10⁷ MN/m"),
        (
            {"base_rotation_stiffness": "20 GN*m"},
            "base_rotation_stiffness must be a rotational stiffness (kN*m/rad, MN*m/rad, "
            "kip*ft/rad), got '20 GN*m', which is a moment",
        ),
        ({"top_mass": "60 kN"}, "top_mass must be a mass (kg, t, lb), got '60 kN'"),
        ({"member_forces": "both"}, "member_forces must be 'larger', 'beam' or 'static'"),
        ({"effective_stiffness": "6 GN*m^2"}, "give only one of stiffness_factor and"),
        (
            {"impact_height": "auto", "column_height": "1.2 m", "steps": []},
            "impact_height may not be auto here: by the rule, impact_height must be at least 0 m "
            "and at most the height 1.2 m of a column with fixed base and free top, got 1.35 m",
        ),
        ({"impact_height": "9.1 m"}, "impact_height must be at least 0 m and at most the height"),
    ],
)
def test_bad_input_is_one_line(change, message):
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        case_from(CASE | change)
    assert "\n" not in str(caught.value)
