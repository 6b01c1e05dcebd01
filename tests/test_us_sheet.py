"""A sheet in US units: what the package chooses is round in them, what is converted says so."""

import math
import re

import pytest
from sheet_page import US_CASE

from pierimpact.certainty import Certainty
from pierimpact.design.codes import aashto_lrfd, aashto_lrfd_former, code_forces
from pierimpact.files.case import case_from
from pierimpact.report.outcome import first_results
from pierimpact.report.sheet import Sheet
from pierimpact.report.sheet.sensitivity import Sensitivities
from pierimpact.report.warnings import limits_of_the_study
from pierimpact.units import rounded, stated

PSI = 0.45359237 * 9.80665 / 0.0254**2


@pytest.fixture(scope="module")
def sheet():
    return Sheet(case_from(US_CASE | {"member_forces": "static"}))


def test_speeds_are_5_mph_apart(sheet):
    rows = Sensitivities(sheet.calculation).table().rows
    assert [row[:2] for row in rows[1:3]] == [
        ["Speed less 5 mph", "50 mph"],
        ["Speed more 5 mph", "60 mph"],
    ]


def test_the_codes_forces_are_those_of_the_code(sheet):
    rows = {row[0]: row[3:] for row in sheet.codes.forces().rows}
    assert rows["AASHTO LRFD"][:3] == ["600", "—", "5"]
    assert rows["AASHTO LRFD, former value"][:3] == ["400", "—", "4"]
    assert rows["JTG D60"][3].endswith("; given as 1000 kN, 500 kN, 1.2 m")
    assert "given as" not in rows["AASHTO LRFD"][3]


def test_the_height_in_feet_is_from_memory_and_that_in_metres_cited():
    for code, metres, feet in ((aashto_lrfd, 1.5, 5), (aashto_lrfd_former, 1.2, 4)):
        assert code("SI").height == (metres, Certainty.CITED)
        assert code("US").height.value == pytest.approx(feet * 12 * 0.0254, rel=1e-15)
        assert code("US").height.status is Certainty.RECALLED
        assert code("US").along == code("SI").along
        assert not code("US").verified
    assert code_forces(20.0, 8e3) == code_forces(20.0, 8e3, "SI")
    assert code_forces(20.0, 8e3)[2:] == code_forces(20.0, 8e3, "US")[2:]


def test_the_forces_of_a_code_in_kip_are_given_so_on_a_sheet_in_si_units():
    sheet = Sheet(case_from(US_CASE | {"units": "SI", "member_forces": "static"}))
    rows = {row[0]: row[3:] for row in sheet.codes.forces().rows}
    assert rows["AASHTO LRFD"] == [
        "2668.9",
        "—",
        "1.5",
        "cited in the source paper; given as 600 kip",
    ]
    assert rows["JTG D60"][:3] == ["1000", "500", "1.2"]


def test_heights_of_the_rule_are_in_metres_as_well(sheet):
    words = str(sheet.pier.impact_height())
    assert "at 3.44 ft (1.05 m) and" in words
    assert "at 4.43 ft (1.35 m)" in words


def test_the_modulus_of_concrete_is_by_the_formula_in_psi(sheet):
    equation = next(step for step in sheet.pier.section().equations if step.label == "eq-E")
    assert equation.lines[0].startswith(
        r"57\,000\ \text{psi} \, \sqrt{f_\mathrm{c}' / (1\ \text{ps"
    )
    printed = float(re.search(r"= ([\d.]+)\\ \\text\{ksi\}$", equation.lines[1])[1])
    assert printed == pytest.approx(57.0 * math.sqrt(4000.0), rel=1e-5)
    assert sheet.calculation.case.column.elastic_modulus == pytest.approx(
        1e3 * printed * PSI, rel=1e-5
    )


def test_limits_of_the_study_are_no_figures_to_build_on(sheet):
    for clause in limits_of_the_study(sheet.calculation.short.outside, False, "US"):
        low, high = re.search(
            r"outside the studied ([\d.\u202f]+) to ([\d.\u202f]+)", clause
        ).groups()
        assert all(len(re.sub(r"\D", "", end).strip("0")) <= 3 for end in (low, high))


def test_a_converted_parameter_of_the_truck_says_what_it_was(sheet):
    rows = {row[0]: row[-1] for row in sheet.inputs.truck_table().rows}
    assert rows["Engine mass"].endswith("; given as 700 kg")
    assert "given as" not in rows["Mass of body and cargo"]  # from the case


def test_the_sentences_on_the_beam_are_of_the_largest_over_both_heights():
    # A cantilever with a cap, whose moment is the largest at the height with less reaction.
    case = US_CASE | {"column_height": "24.5 ft", "top": "free", "top_mass": "420000 lb"}
    sheet = Sheet(case_from(case | {"speed": "60 mph", "truck_mass": "24000 lb"}))
    result = sheet.calculation
    words = sheet.member_forces.comparison().body
    first = {label: remark for label, _, remark in first_results(result)}
    for name, demand in result.demands.items():
        (impact,) = (own for own in result.impacts if own.demands[name].beam == demand.beam)
        height = stated(impact.struck.impact_height, "length", "US")
        ratio = rounded(demand.static / demand.beam, 3)
        assert f"The largest {name} of the beam, struck at {height}, is" in words
        assert f"the largest static one is {ratio} times it" in words.partition(f" {name} of")[2]
        assert first[f"Largest {name}"].endswith(f"static over beam {ratio}")
    most = max(result.impacts, key=lambda impact: impact.demands["moment"].beam)
    assert most is not result.governing
