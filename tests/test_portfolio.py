"""Portfolios: rows as in a report, errors, interruptions, and the same bytes by any worker."""

import base64
import csv
import hashlib
import html
import json
import math
import re
from contextlib import contextmanager
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest
from dask_cluster import dask_cluster
from figure_collisions import collisions
from hypothesis import given
from hypothesis import strategies as st

from pierimpact.cli import main
from pierimpact.design.static_forces import StaticForcesInCollision
from pierimpact.files.case import case_from, read_case_file
from pierimpact.files.piers import read_pier_table
from pierimpact.files.trucks import load_truck
from pierimpact.files.unchanged import write_unchanged
from pierimpact.network import files, workers
from pierimpact.network import portfolio as portfolio_module
from pierimpact.network.piece import Task, calculate_beams, calculate_piece
from pierimpact.network.portfolio import calculate_portfolio
from pierimpact.network.tables import RESULTS, figures
from pierimpact.plots.portfolio import draw_map
from pierimpact.report.calculation import AVERAGE, calculate
from pierimpact.resources import shipped

HEADING = (
    "id,latitude,longitude,column_shape,column_diameter [in],column_width [ft],column_depth [ft],"
    "column_height [m],elastic_modulus [GPa],density [kg/m^3],base,top,base_rotation_stiffness,"
    "truck,truck_mass [t],speed [km/h],impact_height,shear_resistance [MN],moment_resistance,"
    "member_forces"
)
ROWS = """\
P1,42.1,-83.2,circular,36,,,5,25,2400,fixed,pinned,,single-unit-8t,8,80,1.2 m,2.5,4 MN*m,
"P,2",42.3,-83.4,circular,48,,,6,25,2400,fixed,fixed,,single-unit-8t,12,90,auto,9,,
P3,,,rectangular,,4,3,7,28,2450,pinned,pinned,900 MN*m/rad,tractor-trailer-36t,,50,4 ft,,,
P4,40.0,-80.0,circular,60,,,9,25,2400,fixed,free,,single-unit-8t,,62,1.2 m,3,,
P5,41.0,-81.0,circular,36,,,8,25,2400,fixed,pinned,,single-unit-8t,8,70,1.2 m,3,,static
"""
BAD = """\
P6,41,-81,circular,36,,,8,25,2400,fixed,pinnd,,single-unit-8t,8,70,1.2 m,3,,
P7,41,-81,circular,x,,,8,25,2400,fixed,pinned,,single-unit-8t,8,70,1.2 m,3,,
P8,41,-81,circular,36,,,8,25,2400,fixed,pinned,,nobody,8,70,1.2 m,3,,
P9,91,-81,circular,36,,,8,25,2400,fixed,pinned,,single-unit-8t,8,70,1.2 m,3,,
P10,41,-81,circular
P11,41,-81,circular,36,,,1,25,2400,fixed,pinned,,single-unit-8t,8,70,1.2 m,3,,
,41,-81,circular,36,,,1,25,2400,fixed,pinned,,single-unit-8t,8,70,1.2 m,3,,
"""


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "piers.csv"
    path.write_text(f"{HEADING}\n{ROWS}")
    return read_pier_table(path)


@pytest.fixture
def here(monkeypatch):
    """Let this process do the work, and say how many pieces it did."""
    done = []

    def run(function, tasks):
        for task in tasks:
            done.append(len(task.rows))
            yield json.loads(json.dumps(function(task)))  # as if from afar

    @contextmanager
    def pool(**options):
        yield run

    monkeypatch.setattr(portfolio_module, "worker_pool", pool)
    return done


def task_of(table):
    (rows,) = table.pieces(1000)
    return Task(table.columns, rows, {name: load_truck(name) for name in table.trucks})


def test_a_row_comes_to_what_a_report_of_it_does(table):
    task = task_of(table)
    found, beams = calculate_piece(task), calculate_beams(task)
    assert not found.rejects
    assert not beams.rejects
    for i, row in enumerate(task.rows):
        calculation = calculate(case_from({**table.pier(row).values, "member_forces": "larger"}))
        own = {name: values[i] for name, values in found.numbers.items()}
        assert own["design_reaction"] == pytest.approx(calculation.design_force, rel=1e-9)
        assert found.words["governs"][i] == calculation.history.governs
        assert own["pier_frequency"] == pytest.approx(calculation.pier.frequency, rel=1e-12)
        assert own["impact_height"] == calculation.struck.impact_height
        average = calculation.average_forces[AVERAGE]
        assert own["average_25ms"] == pytest.approx(average.force, rel=1e-5)
        assert own["code_ratio"] == pytest.approx(calculation.code_ratio, rel=1e-5)
        for which, demand in calculation.demands.items():
            assert own[f"static_{which}"] == pytest.approx(demand.static, rel=1e-9)
            forces = beams.forces[i]
            assert getattr(forces, which) == demand.beam
            _, high = calculation.demand_bands.get(which, (None, math.nan))
            at_upper = getattr(forces, f"{which}_high")
            assert at_upper == pytest.approx(high, rel=0.06, nan_ok=True)
        holds = [
            StaticForcesInCollision(
                impact.struck.static_forces,
                impact.reaction,
                float(impact.history.contact_force.max()),
            ).hold
            for impact in calculation.impacts
        ]
        assert own["static_holds"] == all(holds)
        if calculation.reaction_band:
            low, _, high = calculation.reaction_band
            assert [own["band_low"], own["band_high"]] == pytest.approx([low, high], rel=0.1)
            for which, (_, high) in calculation.demand_bands_by("static").items():
                assert own[f"high_{which}"] == pytest.approx(high, rel=0.1)
        else:
            assert math.isnan(own["band_high"])


@pytest.mark.parametrize("height", ["1.2 m", "auto"])
def test_static_forces_are_not_vouched_for_where_the_cargo_arrives_in_part(height, tmp_path, here):
    # Of the nominal truck it does not, and for that truck static forces hold.
    row = f"A,,,circular,40,,,7,25,2400,fixed,free,,single-unit-8t,8,50,{height},5,6 MN*m,"
    path = tmp_path / "piers.csv"
    path.write_text(f"{HEADING}\n{row}\n")
    table = read_pier_table(path)
    case = table.pier(task_of(table).rows[0]).values
    report = calculate(case_from({**case, "member_forces": "larger"}))
    assert report.history.cargo_contact_time is None
    assert report.static_forces.hold
    found = calculate_portfolio(table, tmp_path)
    assert found.words["static_forces"].tolist() == ["may be too low"]
    upper = max(report.upper_utilisations.values())
    assert found.numbers["utilisation_high"] == pytest.approx([upper], rel=0.06)


def test_demands_utilisations_and_ranks(table, tmp_path, here):
    found = calculate_portfolio(table, tmp_path)
    words, numbers = found.words, found.numbers
    at = {name: i for i, name in enumerate(words["id"])}
    # Those with a resistance first, the largest utilisation first; then by reaction.
    rated = np.isfinite(numbers["utilisation"])
    assert rated.tolist() == [True] * 4 + [False]
    assert np.all(np.diff(numbers["utilisation"][rated]) <= 0.0)
    assert numbers["rank"].tolist() == [1.0, 2.0, 3.0, 4.0, 5.0]
    asked = calculate_portfolio(table, tmp_path / "asked", beams="asked")
    again = {name: i for i, name in enumerate(asked.words["id"])}
    for name, i in at.items():
        j = again[name]
        static, hold = numbers["static_shear"][i], words["static_forces"][i] == "hold"
        if hold or name == "P5":  # which asks for the static reaction
            assert words["shear_method"][i] == asked.words["shear_method"][j] == "static reaction"
            assert numbers["largest_shear"][i] == static
            assert math.isnan(numbers["beam_shear"][i])
        else:
            assert numbers["largest_shear"][i] == max(static, numbers["beam_shear"][i])
            assert asked.words["shear_method"][j] == "static contact force"
            assert asked.numbers["largest_shear"][j] >= static
        if name != "P3":
            resistance = {"P1": 2.5e6, "P,2": 9e6, "P4": 3e6, "P5": 3e6}[name]
            shear = numbers["largest_shear"][i] / resistance
            assert numbers["utilisation_shear"][i] == pytest.approx(shear)
    moment = numbers["largest_moment"][at["P1"]] / 4e6
    assert numbers["utilisation_moment"][at["P1"]] == pytest.approx(moment)
    assert "hold" in words["static_forces"]
    assert "may be too low" in words["static_forces"]


def written(found, table, folder):
    files.write_portfolio(found, table, folder)
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def test_bad_rows_stop_nothing_and_say_why(tmp_path, here):
    path = tmp_path / "piers.csv"
    path.write_text(f"{HEADING}\n{ROWS}{BAD}")
    table = read_pier_table(path)
    found = calculate_portfolio(table, tmp_path, beams="asked")
    output = written(found, table, tmp_path)
    rejects = list(csv.reader(output["rejects.csv"].decode().splitlines()))
    assert rejects[0] == ["row", "id", "column", "reason"]
    assert [row[:3] for row in rejects[1:]] == [
        ["7", "P6", "top"],
        ["8", "P7", "column_diameter"],
        ["9", "P8", "truck"],
        ["10", "P9", "latitude"],
        ["11", "P10", ""],
        ["12", "P11", "impact_height"],
        ["13", "", "id"],
    ]
    assert all(row[3] for row in rejects[1:])
    results = list(csv.DictReader(output["results.csv"].decode().splitlines()))
    assert {row["id"] for row in results} == {"P1", "P,2", "P3", "P4", "P5"}
    assert list(results[0]) == [column.heading("SI") for column in RESULTS]
    # The page asks nothing of any network, and runs no script but its own.
    page = html.unescape(output["summary.html"].decode())
    assert not re.search(r"(?:src|href)=[\"']?(?:https?:)?//", page)
    ((script,), (style,)) = (
        re.findall(rf"<{tag}>(.*?)</{tag}>", page, re.DOTALL) for tag in ("script", "style")
    )
    for content in (script, style):
        digest = base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()
        assert f"'sha256-{digest}'" in page
    data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1])
    assert {len(column) for column in data["columns"]} == {5}
    assert "7 of 12 rows have no results" in page


def test_what_check_warns_of_has_a_column_and_is_counted_on_the_page(tmp_path, here):
    path = tmp_path / "piers.csv"
    rows = (
        "A,,,circular,36,,,5,25,2400,fixed,pinned,,single-unit-8t,8,500,1.2 m,2.5,4 MN*m,static\n"
        "B,,,circular,36,,,5,25,2400,fixed,pinned,,single-unit-8t,30,80,1.2 m,,40 MN*m,static\n"
        "C,,,circular,36,,,5,25,2400,fixed,pinned,,own.toml,8,80,1.2 m,99,99 MN*m,static\n"
    )
    truck = (shipped("trucks") / "single-unit-8t.toml").read_text("utf-8")
    own = truck.replace('status = "illustrative"', 'status = "measured"')
    (tmp_path / "own.toml").write_text(own.replace("single-unit-8t", "own"), "utf-8")
    path.write_text(f"{HEADING}\n{rows}")
    table = read_pier_table(path)
    found = calculate_portfolio(table, tmp_path)
    said = dict(zip(found.words["id"], found.words["warnings"], strict=True))
    illustrative = "truck illustrative"
    assert said["A"] == f"unusual speed; {illustrative}"
    assert said["B"] == f"truck_mass beyond what the truck’s springs stand for; {illustrative}"
    page = html.unescape(written(found, table, tmp_path)["summary.html"].decode())
    assert "1 rows have unusual values" not in page
    assert "1 row has unusual values" in page
    assert "The trucks of 2 rows are illustrative: single-unit-8t." in page
    assert "The truck of 1 row is heavier or lighter than the springs of its truck" in page
    assert "1 of the others gives one resistance" in page


@pytest.mark.parametrize("wide", [0.01, 1.0, 30.0])
def test_nothing_of_the_map_is_cut_off(wide):
    random = np.random.default_rng(1)
    latitude, longitude = 40.0 + random.random(50), -100.0 + wide * random.random(50)
    with patch.dict(draw_map.__globals__, to_svg=lambda figure: figure):
        figure = draw_map(latitude, longitude, 1e4 * random.random(50), "Design reaction [kN]")
    assert not [line for line in collisions(figure) if "cut off" in line]


def test_a_portfolio_of_rejected_rows_says_so(tmp_path, here):
    path = tmp_path / "piers.csv"
    path.write_text(f"{HEADING}\n{BAD.splitlines()[0]}\n")
    table = read_pier_table(path)
    page = written(calculate_portfolio(table, tmp_path), table, tmp_path)["summary.html"].decode()
    assert "No pier has results" in page
    assert "no row gives a resistance" not in page


def test_keys_of_the_traffic_are_read_as_in_a_case_file(tmp_path, here):
    path = tmp_path / "piers.csv"
    laws = {
        "traffic_mass": "lognorm(s=0.5, scale=18 t)",
        "traffic_speed": "urban",
        "traffic_deceleration": "lognormal(mean=4 m/s^2, sd=1.3 m/s^2)",
        "traffic_angle": "rayleigh(scale=8 deg)",
    }
    cells = ",".join(f'"{law}"' for law in laws.values())
    row = f"{ROWS.splitlines()[0]},{cells}"
    path.write_text(f"{HEADING},{','.join(laws)}\n{row}\n")
    table = read_pier_table(path)
    assert not calculate_portfolio(table, tmp_path, beams="asked").rejects


@pytest.mark.parametrize("content", ["{}", "[]", "[1, 2, 3]", "null", '["", {}]', ""])
def test_a_kept_piece_that_is_none_is_calculated_again(table, tmp_path, here, content):
    expected = written(calculate_portfolio(table, tmp_path, beams="asked"), table, tmp_path)
    here.clear()
    for piece in (tmp_path / "pieces").glob("*.json"):
        piece.write_text(content)
    assert written(calculate_portfolio(table, tmp_path, beams="asked"), table, tmp_path) == expected
    assert here == [5]


def test_after_a_change_of_one_row_the_other_pieces_stand(table, tmp_path, here, monkeypatch):
    monkeypatch.setattr(portfolio_module, "ROWS", 2)
    calculate_portfolio(table, tmp_path)
    kept = {path.name for path in (tmp_path / "pieces").iterdir()}
    here.clear()
    table.path.write_text(
        table.path.read_text().replace("tractor-trailer-36t,,50", "tractor-trailer-36t,,51")
    )
    changed = read_pier_table(table.path)
    found = calculate_portfolio(changed, tmp_path)
    assert here[0] == 2
    assert sum(here) <= 4
    again = calculate_portfolio(changed, tmp_path / "again")
    for name, values in again.numbers.items():
        np.testing.assert_array_equal(found.numbers[name], values)
    # Those of what is no more are gone.
    now = {path.name for path in (tmp_path / "pieces").iterdir()}
    assert len(now) == len({path.name for path in (tmp_path / "again" / "pieces").iterdir()})
    assert now & kept


def test_interrupted_it_goes_on_and_comes_to_the_same_bytes(table, tmp_path, here, monkeypatch):
    pyarrow = pytest.importorskip("pyarrow.parquet")
    monkeypatch.setattr(portfolio_module, "ROWS", 2)
    whole = tmp_path / "whole"
    expected = written(calculate_portfolio(table, whole, beams="asked"), table, whole)
    assert here == [2, 2, 1]

    def interrupt(unit, total):
        def update(count):
            raise KeyboardInterrupt

        return update

    folder = tmp_path / "interrupted"
    with pytest.raises(KeyboardInterrupt):
        calculate_portfolio(table, folder, beams="asked", progress=interrupt)
    assert not (folder / "results.csv").exists()
    here.clear()
    assert written(calculate_portfolio(table, folder, beams="asked"), table, folder) == expected
    assert here == [2, 1]
    # Of another table in the same folder what differs is calculated.
    table.path.write_text(table.path.read_text().replace(",80,", ",81,"))
    here.clear()
    changed = calculate_portfolio(read_pier_table(table.path), folder, beams="asked")
    assert here == [2]
    assert written(changed, table, folder)["results.csv"] != expected["results.csv"]
    # The other format has the same rows, and comes to the same.
    import pyarrow as pa

    lines = list(csv.reader(table.path.read_text().splitlines()))
    columns = dict(zip(lines[0], zip(*lines[1:], strict=True), strict=True))
    other = tmp_path / "piers.parquet"
    pyarrow.write_table(pa.table({name: list(cells) for name, cells in columns.items()}), other)
    parquet = read_pier_table(other)
    same = calculate_portfolio(parquet, tmp_path / "other", beams="asked")
    assert np.array_equal(same.numbers["design_reaction"], changed.numbers["design_reaction"])
    read_back = pyarrow.read_table(folder / "results.parquet")
    assert read_back.column("design_reaction [kN]").to_pylist() == pytest.approx(
        1e-3 * changed.numbers["design_reaction"]
    )


def test_on_a_cluster_of_which_a_worker_is_killed_it_comes_to_the_same_bytes(
    table, tmp_path, here, monkeypatch
):
    monkeypatch.setattr(portfolio_module, "ROWS", 1)
    alone = tmp_path / "alone"
    expected = written(calculate_portfolio(table, alone, beams="asked"), table, alone)
    monkeypatch.setattr(portfolio_module, "worker_pool", workers.worker_pool)
    logs, folder = tmp_path / "logs", tmp_path / "cluster"
    logs.mkdir()
    with dask_cluster(logs, 2) as (address, processes):

        def kill(unit, total):
            return lambda count: processes[0].kill()

        found = calculate_portfolio(table, folder, beams="asked", scheduler=address, progress=kill)
    assert written(found, table, folder) == expected


@pytest.mark.parametrize(
    ("old", "new", "error"),
    [
        ("speed [km/h]", "speed", r"speed has no unit in row 2: write it in the heading, as speed"),
        ("speed [km/h]", "spede [km/h]", r"'spede \[km/h\]' is no column of piers; did you mean s"),
        (
            "column_height [m]",
            "column_height [nan]",
            "column_height must be a length .*unknown unit",
        ),
        ("speed [km/h]", "speed [kg]", r"speed must be a speed .*which is a mass"),
        ("speed [km/h]", "top", "the column top is there twice"),
        ("truck,", "element,", "the column truck is missing"),
        ("base,top,", "", "the columns base, top are missing"),
        ("member_forces", "traffic_trucks", "'traffic_trucks' is no column of piers"),
        ("latitude,", "element,", "latitude and longitude belong together"),
        ("P4", "P1", "id 'P1' is given twice, in rows 2 and 5"),
        ("P1", '"P1', "not valid CSV|quotation mark"),
        (HEADING, "", "is no column of piers|must have a heading"),
        (ROWS, "", "must have a row for each pier, got none"),
        ("base,", "base [m],", "base has no unit"),
    ],
)
def test_a_bad_table_is_one_line_and_writes_nothing(tmp_path, capsys, old, new, error):
    path, output = tmp_path / "piers.csv", tmp_path / "out"
    path.write_text(f"{HEADING}\n{ROWS}".replace(old, new, 1))
    assert main(["portfolio", str(path), "--output", str(output)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert re.search(error, line)
    assert str(path) in line
    assert not output.exists()


def test_a_scheduler_that_does_not_answer_leaves_nothing(table, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(workers, "PATIENCE", 0.3)
    output = tmp_path / "out"
    options = ["--output", str(output), "--scheduler", "tcp://127.0.0.1:1"]
    assert main(["portfolio", str(table.path), *options]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "scheduler tcp://127.0.0.1:1 does not answer" in line
    assert not output.exists()


@given(st.floats(1e-12, 1e15), st.sampled_from([-1.0, 1.0]))
def test_figures_are_those_that_python_prints(size, sign):
    assert figures(np.array([sign * size]))[0] == pytest.approx(
        float(f"{sign * size:.3e}"), rel=1e-15
    )


def test_figures_of_nothing_are_nothing():
    assert np.isnan(figures(np.array([math.nan]))[0])
    assert figures(np.array([0.0]))[0] == 0.0


def test_units_may_stand_in_the_cells(table, tmp_path):
    sizes = {"column_diameter [in]": "in", "speed [km/h]": "km/h", "truck_mass [t]": "t"}
    rows = list(csv.DictReader(table.path.read_text().splitlines()))
    other = tmp_path / "cells.csv"
    with other.open("w", newline="") as file:
        names = [name.partition(" ")[0] if name in sizes else name for name in rows[0]]
        writer = csv.writer(file, delimiter=";")
        writer.writerow(names)
        for row in rows:
            writer.writerow(
                f"{cell} {sizes[name]}" if name in sizes and cell else cell
                for name, cell in row.items()
            )
    in_cells = read_pier_table(other)
    for one, another in zip(next(table.pieces(9)), next(in_cells.pieces(9)), strict=True):
        assert table.pier(one) == in_cells.pier(another) or math.isnan(table.pier(one).place[0])
        assert table.pier(one).values == in_cells.pier(another).values


def test_the_worst_piers_get_sheets_of_their_own(tmp_path, here, monkeypatch):
    # A truck file counts from the folder of the table, wherever the sheets are.
    catalogue = shipped("trucks") / "single-unit-8t.toml"
    (tmp_path / "mine.toml").write_bytes(catalogue.read_bytes())
    path, folder = tmp_path / "piers.csv", tmp_path / "out"
    path.write_text(f"{HEADING}\n{ROWS}".replace("single-unit-8t", "mine.toml"))
    table = read_pier_table(path)
    found = calculate_portfolio(table, folder, beams="asked")
    cases = []

    def reports(paths, into, **_):
        cases.extend(read_case_file(path).case for path in paths)
        made = [SimpleNamespace(html=into / f"{path.stem}.html") for path in paths]
        return SimpleNamespace(reports=made, failures=[])

    monkeypatch.setattr(files, "write_reports", reports)
    written = files.write_portfolio(found, table, folder, system="US", sheets=2)
    worst = found.words["id"][:2].tolist()
    assert [case.inputs.element for case in cases] == worst
    assert {case.inputs.units for case in cases} == {"US"}
    names = [f"{n}-{re.sub('[^A-Z0-9]', '-', own)}.html" for n, own in enumerate(worst, 1)]
    assert written[-2:] == [folder / "sheets" / name for name in names]
    page = (folder / "summary.html").read_text()
    assert all(f'"sheets/{name}"' in page for name in names)


def test_decimals_with_commas_are_told_from_points(tmp_path, here):
    path = tmp_path / "piers.csv"
    rows = ROWS.replace("P1,42.1,", 'P1,"42,1",').replace(",9,25,", ',"9,5",25,')
    path.write_text(f"{HEADING}\n{rows}")
    found = calculate_portfolio(read_pier_table(path), tmp_path, beams="asked")
    assert [reject.reason for reject in found.rejects] == [
        "latitude must be a plain number, got '42,1': decimals have a point, thousands no comma",
        "column_height must be a number, for its unit m is in the heading, got '9,5': decimals "
        "have a point, thousands no comma",
    ]


def command(path, folder, *options):
    return ["portfolio", str(path), "--output", str(folder), "--beams", "asked", *options]


def test_the_table_itself_is_never_replaced(tmp_path, here, capsys):
    path = tmp_path / "results.csv"
    path.write_text(f"{HEADING}\n{ROWS}")
    assert main(command(path, tmp_path, "--force")) == 2
    assert capsys.readouterr().err == (
        f"pierimpact: {path} is the table itself: give another folder as --output\n"
    )
    assert path.read_text() == f"{HEADING}\n{ROWS}"
    assert list(tmp_path.iterdir()) == [path]


def test_results_that_somebody_changed_are_replaced_by_force_alone(tmp_path, here, capsys):
    path, folder = tmp_path / "piers.csv", tmp_path / "out"
    path.write_text(f"{HEADING}\n{ROWS}")
    assert main(command(path, folder)) == main(command(path, folder)) == 0
    results = folder / "results.csv"
    before = results.read_bytes()
    results.write_text("mine")
    assert main(command(path, folder)) == 2
    assert "results.csv was not written by pierimpact, or changed" in capsys.readouterr().err
    assert results.read_text() == "mine"
    assert main(command(path, folder, "--force")) == 0
    assert results.read_bytes() == before


def test_sheets_of_earlier_runs_go_unless_somebody_changed_them(
    tmp_path, here, monkeypatch, capsys
):
    def reports(paths, into, **_):
        texts = {f"{path.stem}.html": path.read_bytes() for path in paths}
        made = [SimpleNamespace(html=file) for file in write_unchanged(texts, into)]
        return SimpleNamespace(reports=made, failures=[])

    monkeypatch.setattr(files, "write_reports", reports)
    path, folder = tmp_path / "piers.csv", tmp_path / "out"
    path.write_text(f"{HEADING}\n{ROWS}")
    assert main(command(path, folder, "--sheets", "2")) == 0
    before = sorted(file.name for file in (folder / "sheets").iterdir())
    changed = next((folder / "sheets").glob("2-*.html"))
    changed.write_text("mine")
    path.write_text(f"{HEADING}\n{ROWS}".replace("\nP", "\nQ").replace('"P,2', '"Q,2'))
    assert main(command(path, folder, "--sheets", "2")) == 0
    assert capsys.readouterr().err == (
        f"pierimpact: {changed} is of an earlier run, and stays because somebody changed it\n"
    )
    assert changed.read_text() == "mine"
    assert sorted(file.name for file in (folder / "sheets").iterdir()) == sorted(
        [changed.name, *(name.replace("-P", "-Q") for name in before)]
    )
    assert main(command(path, folder)) == 0
    assert {file.name for file in (folder / "sheets").iterdir()} == {
        changed.name, ".pierimpact.json"
    }  # fmt: skip
