"""From record files to truck file, table and figure, by the command line; and the notebook."""

import ast
import io
import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from pypdf import PdfReader

from pierimpact import EquivalentPier, cli, load_truck
from pierimpact.cli.commands import parser
from pierimpact.cli.fit import pier_of, piers_of
from pierimpact.collision.records import Record
from pierimpact.design.fit import fit_records, parameter, with_parameters
from pierimpact.files.trucks import read_truck_file
from pierimpact.plots.fit import draw_fit
from pierimpact.report.document.blocks import Block

NOTEBOOKS = Path(__file__).parents[1] / "notebooks"
START = load_truck("single-unit-8t")
PIER = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
HEAVY = with_parameters(START.with_mass(12e3), {"engine_mass": 800.0})
ON_PIER = ["--pier-mass", f"{PIER.mass} kg", "--pier-stiffness", f"{PIER.stiffness} N/m"]


def record_of(truck, speed, pier=None, quantity="contact force", duration=0.16):
    time = np.arange(0.0, duration, 5e-4)
    clean = Record(time=time, force=np.ones_like(time), speed=speed, pier=pier, quantity=quantity)
    force = clean.modelled(clean.collision(truck))
    noise = np.random.default_rng(3).standard_normal(len(force))
    return time, force + 0.01 * force.max() * noise


def write(path, time, force, heading="time [ms], contact force [kN]"):
    rows = [f"{1e3 * t:.6g}, {1e-3 * f:.6g}" for t, f in zip(time, force, strict=True)]
    path.write_text("\n".join(["# made by the model", heading, *rows]), encoding="utf-8")
    return str(path)


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    """What the command line leaves of the record of a heavy truck."""
    folder = tmp_path_factory.mktemp("fit")
    record = write(folder / "heavy.csv", *record_of(HEAVY, 20.0))
    truck, figure = folder / "heavy.toml", folder / "heavy.pdf"
    with pytest.MonkeyPatch.context() as patch:
        printed = io.StringIO()
        patch.setattr("sys.stdout", printed)
        code = cli.main(
            ["fit", record, "--speed", "72 km/h", "--mass", "12 t", "--output", str(truck),
             "--figure", str(figure)]
        )  # fmt: skip
    assert code == 0
    assert sorted(path.name for path in folder.iterdir()) == [
        "heavy.csv", "heavy.pdf", "heavy.toml"
    ]  # fmt: skip
    return folder, printed.getvalue()


def test_the_truck_file_says_what_is_fitted_and_what_is_not(fitted):
    folder, table = fitted
    file, start = read_truck_file("heavy.toml", folder), read_truck_file("single-unit-8t")
    assert file.truck.name == "heavy"
    assert file.truck.mass == pytest.approx(12e3, rel=1e-5)
    assert file.status == "calibrated"
    assert re.search(r"heavy\.csv \(SHA-256 [0-9a-f]{64}\)", file.source)
    digest = re.search(r"SHA-256 ([0-9a-f]{12})", file.source)[1]
    calibrated = {entry.name for entry in file.parameters if entry.status == "calibrated"}
    assert {"body_mass", "body_spring.plateau_length", "body_spring.stiffness"} <= calibrated
    for entry in file.parameters:
        if entry.name in calibrated:
            assert f"heavy.csv ({digest}…)" in entry.source
        else:
            assert entry.value == start[entry.name].value
            assert entry.status == start[entry.name].status
            assert entry.name == "friction_on" or "left at its start: " in entry.source
    assert file["body_spring.plateau_length"].value == pytest.approx(1.9, rel=0.02)
    assert file["friction_force"].value == 21.5e3
    row = next(line for line in table.splitlines() if line.startswith("Friction"))
    assert "left at its start: the record hardly shows it" in row


def test_the_printed_table(fitted):
    folder, table = fitted
    lines = table.splitlines()
    assert lines[0].split() == ["parameter", "start", "fitted", "standard", "error"]
    assert len([line for line in lines if line.endswith("identified")]) >= 4
    assert re.search(r"Residual: .* kN root mean square, 1\.\d % of the largest force\.", table)
    assert lines[-2:] == [str(folder / "heavy.toml"), str(folder / "heavy.pdf")]


def test_the_figure_is_a_page(fitted):
    folder, _ = fitted
    assert len(PdfReader(folder / "heavy.pdf").pages) == 1


def test_two_records_and_a_pier_without_output(tmp_path, capsys):
    records = [
        write(tmp_path / f"{speed}.csv", *record_of(START, speed, PIER, "reaction", duration=0.05),
              heading="time [ms], reaction [kN]")
        for speed in (10.0, 12.0)
    ]  # fmt: skip
    speeds = ["--speed", "10 m/s", "--speed", "12 m/s"]
    assert cli.main(["fit", *records, *speeds, *ON_PIER, "--filter", "150 Hz"]) == 0
    assert "the cargo does not reach the pier in the record" in capsys.readouterr().out
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--speed", "80000 km/h"], "--speed must be from 0.36 to 540 km/h"),
        (["--speed", "80 km/h", "--mass", "8 g"], "--mass must be from 100 to 1.0×10⁶ kg"),
        (
            ["--speed", "80 km/h", "--pier-mass", "8 t", "--pier-stiffness", "1 N/m"],
            "--pier-stiffness must be from",
        ),
        (["--speed", "80"], "--speed must have a unit (km/h, m/s, mph), got '80'"),
        (["--speed", "1 m/s", "--speed", "2 m/s", "--speed", "3 m/s"],
         "speed must be given once, or once for each of 1 records, got 3"),
        (["--speed", "80 km/h", "--mass", "500 kg"], "mass must exceed the engine's 700 kg"),
        (["--speed", "80 km/h", "--start", "single-unit-9t"], "did you mean single-unit-8t?"),
        (["--speed", "80 km/h", "--pier-mass", "8 t"],
         "--pier-mass and --pier-stiffness go together"),
        (["--speed", "80 km/h", "--damping-ratio", "0.1"], "--damping-ratio belongs to a pier"),
        (["--speed", "80 km/h", "--case", "nowhere.yaml"], "nowhere.yaml: cannot be read"),
        (["--speed", "80 km/h", "--filter", "2 kHz"], "--filter must be a frequency"),
        (["--speed", "80 km/h", "--filter", "900 Hz"], "record.csv: cutoff must be at most 0.4"),
        (["--speed", "80 km/h", "--filter", "1e-6 Hz"], "record.csv: cutoff must be at least"),
        (["--speed", "80 km/h", "--filtered", "1e-6 Hz"], "record.csv: cutoff must be at least"),
        (["--speed", "80 km/h", "--average", "10 kN"], "--average must be a time"),
        (["--speed", "80 km/h", "--average", "1e9 s"], "record.csv: window must be at most"),
        (["--speed", "80 km/h", "--first-touch=-1e6 s"], "record.csv: first_touch must lie at"),
        (["--speed", "80 km/h", "--accuracy", "0"], "accuracy must be positive"),
        (["--speed", "80 km/h", "--figure", "fit.doc"],
         "the ending of --figure must be one of pdf, png, svg, got 'doc'"),
        (["--speed", "80 km/h", "--output", "no/folder/truck.toml"],
         "cannot be written to: there is no folder"),
        (["--speed", "80 km/h", "--output", "record.csv"],
         "--output must be the name of a .toml file, got 'record.csv'"),
        (["--speed", "80 km/h", "--output", "."], "--output must be the name of a .toml file"),
    ],
)  # fmt: skip
def test_bad_options_are_one_line_and_code_2(tmp_path, monkeypatch, capsys, options, words):
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "record.csv", *record_of(START, 22.2))
    assert cli.main(["fit", "record.csv", *options]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert words in printed.err
    assert len(printed.err.splitlines()) == 1
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize("option", ["--output", "--figure"])
def test_a_file_that_is_there_is_replaced_by_force_alone(tmp_path, monkeypatch, capsys, option):
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "record.csv", *record_of(START, 22.2))
    there = Path("there.toml" if option == "--output" else "there.svg")
    there.write_text("by hand", encoding="utf-8")
    command = ["fit", "record.csv", "--speed", "80 km/h", option, str(there)]
    assert cli.main(command) == 2
    assert capsys.readouterr().err == (
        f"pierimpact: {there} is there already: give --force to replace it\n"
    )
    assert there.read_text(encoding="utf-8") == "by hand"
    assert cli.main([*command, "--force"]) == 0
    assert there.read_text(encoding="utf-8") != "by hand"


@pytest.mark.parametrize(
    "command",
    [
        ["record.svg", "--figure", "record.svg"],
        ["record.svg", "--case", "case.svg", "--figure", "case.svg"],
        ["record.svg", "--start", "own.toml", "--output", "own.toml"],
        ["record.svg", "--start", "own.toml", "--output", "link.toml"],
    ],
)
def test_what_is_read_is_never_replaced(tmp_path, monkeypatch, capsys, command):
    monkeypatch.chdir(tmp_path)
    for name in ("record.svg", "case.svg", "own.toml"):
        Path(name).write_text("by hand", encoding="utf-8")
    Path("link.toml").symlink_to("own.toml")
    assert cli.main(["fit", *command, "--speed", "80 km/h", "--force"]) == 2
    assert f"{command[-1]} is read, and cannot be written to" in capsys.readouterr().err
    assert {path.read_text(encoding="utf-8") for path in tmp_path.iterdir()} == {"by hand"}


def test_a_bad_record_is_one_line_and_code_2(tmp_path, capsys):
    time, force = record_of(START, 22.2)
    time[100] = time[98]
    path = write(tmp_path / "record.csv", time, force)
    assert cli.main(["fit", path, "--speed", "80 km/h", "--output", str(tmp_path / "t.toml")]) == 2
    assert capsys.readouterr().err == (
        "pierimpact: record.csv: row 103: time must ascend, 49 ms follows 49.5 ms\n"
    )
    assert len(list(tmp_path.iterdir())) == 1


def test_a_case_file_gives_the_pier():
    case = NOTEBOOKS / "tti-column.yaml"
    (pier,) = piers_of(
        parser().parse_args(["fit", "r.csv", "--speed", "1 m/s", "--case", str(case)])
    )
    from pierimpact.files.case import read_case_file

    read = read_case_file(case).case
    expected = read.column.equivalent(read.impact_heights[0], read.inputs.damping_ratio)
    assert pier == expected


def test_a_slow_pier_of_a_case_is_fitted_without_a_warning_of_member_forces(tmp_path):
    case = tmp_path / "slow.yaml"
    text = (NOTEBOOKS / "tti-column.yaml").read_text("utf-8")
    case.write_text(text.replace("column_height: 5.0 m", "column_height: 15.0 m"), "utf-8")
    assert pier_of(case).frequency < 55.0


# The figure and the notebook.


@pytest.fixture(scope="module")
def small_fit():
    time, force = record_of(START, 22.2)
    record = Record(time=time, force=force, speed=22.2)
    return fit_records([record, record], START, parameters=["engine_mass"])


def test_the_figure_has_a_panel_and_a_strip_for_each_record(small_fit):
    svg = draw_fit(small_fit, "SI").decode()
    assert svg.count('id="axes_') == 4
    assert draw_fit(small_fit, "US") != draw_fit(small_fit, "SI")
    assert draw_fit(small_fit, "SI").decode() == svg
    width, height = Image.open(io.BytesIO(draw_fit(small_fit, "SI", "png"))).size
    assert (width, height) == (1300, 1320)


def test_the_notebook_runs():
    cells = json.loads((NOTEBOOKS / "fit.ipynb").read_text(encoding="utf-8"))["cells"]
    names, shown = {}, []
    for cell in cells:
        if cell["cell_type"] == "code":
            *statements, last = ast.parse("".join(cell["source"])).body
            exec(compile(ast.Module(statements, []), "fit.ipynb", "exec"), names)
            if isinstance(last, ast.Expr):
                shown.append(eval(compile(ast.Expression(last.value), "fit.ipynb", "eval"), names))
            else:
                exec(compile(ast.Module([last], []), "fit.ipynb", "exec"), names)
    assert len(shown) == 6
    assert all(isinstance(block, Block) and block._repr_html_() for block in shown)
    # What its prose says of them.
    first, low, slow, reaction, both = (
        {row[0]: row for row in block.rows} for block in shown if hasattr(block, "rows")
    )
    engine, cargo = "Steep stiffness of the engine spring", "Steep stiffness of the body spring"
    assert "left at its start" in first["Friction force on the body"][4]
    assert "8.33 ms" in low[engine][4]
    assert "the cargo does not reach the pier" in slow[cargo][4]
    assert "left at its start" in reaction[engine][4]
    assert "left at its start" not in both[engine][4]
    truth, fit = names["truth"], names["fit"]
    for name in ("engine_spring.plateau_length", "body_spring.plateau_length"):
        assert parameter(fit.truck, name) == pytest.approx(parameter(truth, name), rel=0.05)
