import os
import subprocess
import sys
from pathlib import Path

import pytest

import pierimpact
from pierimpact import cli
from pierimpact.files.case import read_case_file
from pierimpact.report.calculation import calculate
from pierimpact.report.results import Results
from pierimpact.report.write import Report, ReportError

EXAMPLE = Path(__file__).parent.parent / "notebooks" / "tti-column.yaml"


def test_help_and_version(capsys):
    for arguments, words in (
        (["--help"], "report"),
        (["report", "--help"], "CASE.yaml"),
        (["--version"], f"pierimpact {pierimpact.__version__}"),
    ):
        with pytest.raises(SystemExit) as end:
            cli.main(arguments)
        assert end.value.code == 0
        assert words in capsys.readouterr().out


@pytest.mark.parametrize("arguments", [[], ["report"], ["nonsense"], ["report", "--nonsense", "x"]])
def test_wrong_arguments(arguments, capsys):
    with pytest.raises(SystemExit) as end:
        cli.main(arguments)
    assert end.value.code == 2
    assert "usage: pierimpact" in capsys.readouterr().err


def test_a_bad_case_is_one_line_and_code_2(tmp_path, capsys):
    case = tmp_path / "case.yaml"
    case.write_text(EXAMPLE.read_text("utf-8").replace("speed: 80 km/h", "sped: 80 km/h"), "utf-8")
    assert cli.main(["report", str(case), "--output", str(tmp_path / "out")]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err == (
        "pierimpact: case.yaml: 'sped' is not a key of a case file; did you mean speed?\n"
    )
    assert not (tmp_path / "out").exists()


def test_no_such_file_in_a_process_of_its_own(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "pierimpact", "report", "nowhere.yaml"],
        cwd=tmp_path,
        env={"PYTHONPATH": str(Path(pierimpact.__file__).parent.parent)},
        capture_output=True,
        encoding="utf-8",
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.splitlines() == [
        "pierimpact: nowhere.yaml: cannot be read: No such file or directory"
    ]
    assert list(tmp_path.iterdir()) == []


def test_what_is_printed(monkeypatch, capsys):
    files = Path("a.ipynb"), Path("a.html"), Path("a.pdf")
    results = Results.of(calculate(read_case_file(EXAMPLE).case))

    def made(case, output, docx, kernels, on_stage):
        return Report(*files, ["a letter is missing"], results)

    monkeypatch.setattr("pierimpact.report.batch.write_report", made)
    assert cli.main(["report", "a.yaml"]) == 0
    printed = capsys.readouterr()
    assert printed.out.split() == ["a.ipynb", "a.html", "a.pdf"]
    assert printed.err == "pierimpact: warning: a.pdf: a letter is missing\n"


def test_a_failure_is_one_line_and_code_1(monkeypatch, capsys):
    def fail(case, output, docx, kernels, on_stage):
        raise ReportError("a.yaml: the notebook failed: ValueError: why; it is kept as x")

    monkeypatch.setattr("pierimpact.report.batch.write_report", fail)
    assert cli.main(["report", "a.yaml"]) == 1
    assert capsys.readouterr().err == (
        "pierimpact: a.yaml: the notebook failed: ValueError: why; it is kept as x\n"
    )


def test_interrupted(monkeypatch, capsys):
    def interrupt(case, output, docx, kernels, on_stage):
        raise KeyboardInterrupt

    monkeypatch.setattr("pierimpact.report.batch.write_report", interrupt)
    assert cli.main(["report", "a.yaml"]) == 130
    assert capsys.readouterr().err == "pierimpact: interrupted, 0 of 1 reports written\n"


def test_output_that_nobody_reads_is_no_failure_to_tell():
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(
        [sys.executable, "-m", "pierimpact", "trucks"],
        cwd=Path(pierimpact.__file__).parent.parent,
        stdout=write,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )
    os.close(write)
    assert (done.returncode, done.stderr) == (1, "")
