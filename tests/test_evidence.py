"""The model beside responses of others: comparison, file of responses, page and figures."""

import dataclasses
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import nbformat
import numpy as np
import papermill
import pytest

from pierimpact import (
    EquivalentPier,
    InputError,
    PierColumn,
    load_truck,
    peak_reactions,
    reaction_band,
    simulate,
)
from pierimpact.certainty import Certainty
from pierimpact.collision.averages import largest_average_force
from pierimpact.collision.parameters import Collision
from pierimpact.design.codes import KIP
from pierimpact.design.comparison import (
    RIGID,
    Measured,
    average_bands,
    compare,
    response_words,
)
from pierimpact.files.responses import read_responses
from pierimpact.pier.sections import CircularSection
from pierimpact.plots import evidence as figures
from pierimpact.report import evidence
from pierimpact.report.evidence import PUBLISHED, Comparison

NOTEBOOK = Path(__file__).parents[1] / "notebooks" / "evidence.ipynb"
SINGLE_UNIT, TRACTOR_TRAILER = load_truck("single-unit-8t"), load_truck("tractor-trailer-36t")
PIER = EquivalentPier(mass=8e3, stiffness=284e6, damping_ratio=0.05)


def measured(responses, truck=SINGLE_UNIT, speed=22.0):
    return Measured(
        name="A",
        collision=Collision(truck, PIER, speed),
        responses=responses,
        source="invented",
        status=Certainty.ILLUSTRATIVE,
    )


# Comparison


def test_what_the_model_gave_compares_as_one():
    random = np.random.default_rng(4)
    for speed in random.uniform(15.0, 30.0, 4):
        history = simulate(SINGLE_UNIT, PIER, speed, 0.05)
        given = {
            "engine_peak": history.engine_peak.reaction,
            "peak_reaction": history.governing_peak.reaction,
            "peak_contact_force": history.contact_force.max(),
            "average_30_ms": largest_average_force(history, 0.03).force,
        }
        if history.cargo_peak:
            given["cargo_peak"] = history.cargo_peak.reaction
        found = compare(measured(given, speed=speed), size=16, histories=2)
        assert [own.response for own in found] == list(given)
        assert [own.ratio for own in found] == pytest.approx([1.0] * len(given), rel=1e-6)


def test_a_truck_that_is_known_has_a_band_without_width():
    known = dataclasses.replace(SINGLE_UNIT, spread={})
    given = {"peak_reaction": 2e6, "average_25_ms": 1e6, "peak_contact_force": 4e6}
    for own in compare(measured(given, truck=known), size=8, histories=2):
        assert own.ratios == pytest.approx([own.nominal / given[own.response]] * 3, rel=1e-9)


def test_bands_are_those_of_the_sampled_trucks():
    size = 24
    band = reaction_band(SINGLE_UNIT, PIER, 22.0, size=size, seed=3)
    given = {"cargo_peak": 2e6, "average_25_ms": 1e6}
    cargo, average = compare(measured(given), size=size, histories=size, seed=3)
    assert cargo.band == pytest.approx(band.quantiles(of="cargo"))
    averages = band.average_forces([0.025], size)[0]
    assert average.band == pytest.approx(np.quantile(averages, (0.05, 0.5, 0.95)))
    nominal, ends = average_bands(Collision(SINGLE_UNIT, PIER, 22.0), [0.025], size, seed=3)
    assert nominal == pytest.approx([average.nominal])
    assert ends[:, 0] == pytest.approx(average.band)


def test_no_contact_is_no_number():
    (own,) = compare(measured({"cargo_peak": 1e6}, speed=5.0), size=8)
    assert np.isnan(own.ratio)
    assert np.isnan(own.ratios).all()
    comparison = Comparison([own.measured])
    assert comparison.table().rows[0][2:7] == ["1000", "–", "–", "–", "–"]
    assert "nowhere" in comparison.figure().alt


@pytest.mark.parametrize(
    ("responses", "message"),
    [
        ({}, "responses must have at least one, got none"),
        ({"peak_reacton": 1e6}, "'peak_reacton' is not a response; did you mean peak_reaction"),
        ({"average_0_ms": 1e6}, "'average_0_ms' is not a response"),
        ({"average_ms": 1e6}, "'average_ms' is not a response"),
        ({"engine_peak": 0.0}, "engine_peak must be positive, got 0"),
    ],
)
def test_bad_responses_are_named(responses, message):
    with pytest.raises(InputError, match=f"^{message}"):
        measured(responses)


def test_responses_in_words():
    assert response_words("average_35_ms") == "35 ms average of the contact force"
    assert response_words("engine_peak") == "engine reaction"


# Files


HEADINGS = (
    "case,truck,truck_mass [t],speed [km/h],damping_ratio,pier_mass [t],pier_stiffness [MN/m]"
)
WHOLE = f"{HEADINGS},engine_peak [kN],average_10_ms [kip],source,status,remark"
ROW = "A,single-unit-8t,7,80,0.03,8,284,3100,700,a paper,read,by hand"


def read(folder, *lines):
    path = folder / "cases.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    return read_responses(path)


def test_a_case_with_the_pier_as_one_degree_of_freedom(tmp_path):
    blank = "B,single-unit-8t,,50,,8,284,,600,a paper,recalled"
    one, other = read(tmp_path, WHOLE, ROW, "", blank)
    assert one.collision.truck == SINGLE_UNIT.loaded_to(7e3)
    assert one.collision.speed == pytest.approx(80 / 3.6)
    assert one.collision.pier == EquivalentPier(mass=8e3, stiffness=284e6, damping_ratio=0.03)
    assert one.responses == pytest.approx({"engine_peak": 3.1e6, "average_10_ms": 700 * KIP})
    assert (one.name, one.source, one.status, one.remark) == (
        "A",
        "a paper",
        Certainty.READ,
        "by hand",
    )
    assert other.collision.truck == SINGLE_UNIT
    assert other.collision.pier.damping_ratio == 0.05
    assert other.responses == pytest.approx({"average_10_ms": 600 * KIP})


def test_a_case_with_a_column_as_the_page_has_it(tmp_path):
    prose = "".join(cell.source for cell in nbformat.read(NOTEBOOK, 4).cells)
    example = re.search(r"```text\n(.*?)```", prose, re.DOTALL)[1]
    (own,) = read(tmp_path, example)
    column = PierColumn(
        height=8.0, section=CircularSection(diameter=1.2), elastic_modulus=28e9, density=2450.0
    )
    assert own.collision.pier == column.struck_at(1.2).equivalent()
    assert own.collision.speed == pytest.approx(25.0)
    assert own.responses == {"peak_contact_force": 7e6}


def test_a_truck_of_ones_own_beside_the_file(tmp_path):
    text = (Path(evidence.__file__).parents[1] / "trucks/single-unit-8t.toml").read_text("utf-8")
    (tmp_path / "mine.toml").write_text(text.replace("value = 700", "value = 800"), "utf-8")
    (own,) = read(tmp_path, WHOLE, ROW.replace("single-unit-8t", "mine.toml"))
    assert own.collision.truck.engine_mass == 800.0


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("speed [km/h]", "sped [km/h]", "row 1: 'sped' is not a column; did you mean speed?"),
        ("speed [km/h]", "speed", "row 1: speed must have its unit in brackets (km/h, m/s, mph)"),
        ("speed [km/h]", "speed [kip]", "row 2: speed must be a speed (km/h, m/s, mph), got '80 k"),
        ("case,", "case [t],", "row 1: case has no unit, got 'case [t]'"),
        ("average_10_ms", "average_1x_ms", "row 1: 'average_1x_ms' is not a response; did you"),
        (",source,", ",case,", "row 1: case is given twice"),
        ("truck_mass [t]", "density [kg/m^3]", "row 2: density must not be given beside pier_mass"),
        ("A,single", ",single", "row 2: case is missing"),
        (",80,", ",,", "row 2: speed is missing"),
        (",8,284,", ",8,,", "row 2: pier_stiffness is missing"),
        (",80,", ",fast,", "row 2: speed must be a number, for its unit km/h is in the heading"),
        (",80,", ",-80,", "row 2: speed must be from 0.36 to 540 km/h"),
        (",0.03,", ",low,", "row 2: damping_ratio must be a number, got 'low'"),
        (",0.03,", ",1.5,", "row 2: damping_ratio must be below 1, got 1.5"),
        ("single-unit-8t", "single", "row 2: truck must be a name of the catalogue"),
        (",3100,700,", ",,,", "row 2: responses must have at least one, got none"),
        (",3100,", ",0,", "row 2: engine_peak must be positive, got 0"),
        ("read", "sure", "row 2: status must be one of cited, read, secondary"),
        ("by hand", "by hand,more", "row 2: there must be 12 cells, got 13"),
        (",8,284,", ",,,", "row 2: column_shape is missing"),
    ],
)
def test_a_bad_file_is_one_line_with_its_row(tmp_path, old, new, message):
    text = f"{WHOLE}\n{ROW}"
    assert old in text
    with pytest.raises(InputError, match=f"^cases.csv, {re.escape(message)}") as caught:
        read(tmp_path, text.replace(old, new, 1))
    assert "\n" not in str(caught.value)


def test_files_that_are_none(tmp_path):
    with pytest.raises(InputError, match=r"^cases.csv must have a row for each case, got none$"):
        read(tmp_path, WHOLE)
    with pytest.raises(InputError, match=r"^cases.csv must have a row for each case, got none$"):
        read(tmp_path)
    with pytest.raises(InputError, match=r"^none.csv cannot be read: No such file"):
        read_responses(tmp_path / "none.csv")
    (tmp_path / "cases.csv").write_bytes(b"case\xff")
    with pytest.raises(InputError, match=r"^cases.csv is not UTF-8 text: line 1 cannot "):
        read_responses(tmp_path / "cases.csv")


# Page


def test_published_forces_are_read_and_named_with_their_limits():
    found = read_responses(PUBLISHED)
    assert {own.status for own in found} == {Certainty.READ}
    assert all(own.remark and own.source for own in found)
    fitted = found[0]
    assert fitted.responses == pytest.approx(
        {"average_10_ms": 900 * KIP, "average_25_ms": 600 * KIP}
    )
    for own in compare(fitted, size=4, histories=2):
        assert own.ratio == pytest.approx(1.0, abs=0.01)
    assert "agreement proves nothing" in fitted.remark
    assert all(own.collision.pier.frequency == pytest.approx(RIGID.frequency, rel=1e-3)
               for own in found)  # fmt: skip


def test_tables_and_figure_of_a_comparison():
    first = dataclasses.replace(read_responses(PUBLISHED)[0], status=Certainty.RECALLED)
    comparison = Comparison([first, measured({"peak_reaction": 3e6})], histories=2)
    table = comparison.table()
    assert [row[1] for row in table.rows] == [
        "10 ms average",
        "25 ms average",
        "largest reaction",
    ]
    assert table.rows[0][6] == "1.00"
    assert table.rows[0][-1].endswith("unverified: from memory")
    assert table.rows[1][-1] == ""
    ratio = peak_reactions(SINGLE_UNIT, PIER.mass, PIER.stiffness, 0.05, 22.0).governing / 3e6
    assert table.rows[2][6] == f"{ratio:.2f}"
    assert len(comparison.remarks().notes) == 1
    assert "3 forces" in comparison.figure().alt


def test_twice_the_mass_behind_the_engine_leaves_its_peak():
    figure = evidence.double_cargo(SINGLE_UNIT, 6e3)
    engine, impulse = map(float, re.findall(r"([\d.]+) times", figure.caption))
    assert engine == 1.0
    assert 1.8 < impulse < 2.2


def test_findings_say_what_the_model_gives():
    rows = evidence.statements(SINGLE_UNIT, TRACTOR_TRAILER).rows
    assert all("read" in row[1] for row in rows)
    history = simulate(TRACTOR_TRAILER, RIGID, 50 * 1609.344 / 3600)
    times = (history.engine_contact_time, history.cargo_contact_time)
    assert any(" and ".join(f"{1e3 * time:.0f} ms" for time in times) in row[2] for row in rows)
    averages = [
        largest_average_force(simulate(SINGLE_UNIT, RIGID, speed / 3.6, 0.025), 0.025).force
        for speed in (55.0, 135.0)
    ]
    words = " and ".join(f"{force / (600 * KIP):.2g}" for force in averages)
    assert "0.30 and 3.2 for the 8 t truck" in rows[-1][2]
    assert words == "0.3 and 3.2"
    assert len(evidence.not_compared().rows) >= 8


def test_the_curve_passes_the_published_average():
    figure = evidence.averages(TRACTOR_TRAILER, count=2)
    assert "passes 600 kip at 80 km/h" in figure.alt


def test_the_first_peak_does_not_depend_on_the_mass():
    figure = evidence.first_peak(SINGLE_UNIT, [5e3, 8e3, 12e3])
    assert float(re.search(r"within ([\d.]+) %", figure.alt)[1]) < 1.0


def test_figures_are_whole_in_themselves():
    ratios = np.array([[1.0, 0.8, 1.0, 1.3], [np.nan] * 4])
    drawn = [
        figures.draw_agreement(["one", "two"], ratios),
        evidence.double_cargo(SINGLE_UNIT, 6e3).svg,
        evidence.first_peak(SINGLE_UNIT, [6e3]).svg,
    ]
    assert drawn[0] == figures.draw_agreement(["one", "two"], ratios)
    for svg in drawn:
        assert ElementTree.fromstring(svg).tag.endswith("svg")
        assert all(link.startswith(("#", "data:")) for link in re.findall(r'href="([^"]*)"', svg))


def test_the_notebook_runs_on_a_copy(tmp_path):
    output = tmp_path / "evidence.ipynb"
    quick = nbformat.read(NOTEBOOK, 4)
    for cell in quick.cells:  # fewer collisions than the page has
        cell.source = cell.source.replace("(PUBLISHED))", "(PUBLISHED), histories=2)")
        cell.source = cell.source.replace(
            "averages(tractor_trailer)", "averages(tractor_trailer, 2)"
        )
    nbformat.write(quick, tmp_path / "quick.ipynb")
    papermill.execute_notebook(
        tmp_path / "quick.ipynb", output, kernel_name="python3", progress_bar=False,
        log_output=False,
    )  # fmt: skip
    code = [cell for cell in nbformat.read(output, 4).cells if cell.cell_type == "code"]
    assert all("text/html" in cell.outputs[0].data for cell in code[1:])
