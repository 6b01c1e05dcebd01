import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import pierimpact
from pierimpact import cli
from pierimpact.files.case import read_case_file
from pierimpact.files.schema import case_schema
from pierimpact.report.calculation import calculate
from pierimpact.report.results import Results
from pierimpact.report.write import Report, ReportError

EXAMPLE = Path(__file__).parent.parent / "notebooks" / "tti-column.yaml"

COMMANDS = (
    "new",
    "check",
    "report",
    "compare",
    "portfolio",
    "inventory",
    "trucks",
    "schema",
    "fit",
    "teach",
    "collect",
    "page",
)


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

    def made(case, output, docx, force, kernels, on_stage):
        return Report(*files, ["a letter is missing"], results)

    monkeypatch.setattr("pierimpact.report.batch.write_report", made)
    assert cli.main(["report", "a.yaml"]) == 0
    printed = capsys.readouterr()
    assert printed.out.split() == ["a.ipynb", "a.html", "a.pdf"]
    assert printed.err == "pierimpact: warning: a.pdf: a letter is missing\n"


def test_a_failure_is_one_line_and_code_1(monkeypatch, capsys):
    def fail(case, output, docx, force, kernels, on_stage):
        raise ReportError("a.yaml: the notebook failed: ValueError: why; it is kept as x")

    monkeypatch.setattr("pierimpact.report.batch.write_report", fail)
    assert cli.main(["report", "a.yaml"]) == 1
    assert capsys.readouterr().err == (
        "pierimpact: a.yaml: the notebook failed: ValueError: why; it is kept as x\n"
    )


def test_interrupted(monkeypatch, capsys):
    def interrupt(case, output, docx, force, kernels, on_stage):
        raise KeyboardInterrupt

    monkeypatch.setattr("pierimpact.report.batch.write_report", interrupt)
    assert cli.main(["report", "a.yaml"]) == 130
    assert capsys.readouterr().err == "pierimpact: interrupted, nothing written\n"


def fails(options):
    raise ZeroDivisionError("a\nb")


def test_what_nobody_foresaw_is_one_line_without_debug(monkeypatch, capsys):
    monkeypatch.setattr("pierimpact.cli.files._trucks", fails)
    assert cli.main(["trucks"]) == 1
    assert capsys.readouterr().err == (
        "pierimpact: ZeroDivisionError: a b; this is a defect of the program: run it again with "
        "--debug\n"
    )


def command(*arguments, **options):
    """Run the command line in a process of its own."""
    environment = os.environ | {"PYTHONPATH": str(Path(pierimpact.__file__).parent.parent)}
    return subprocess.run(
        [sys.executable, "-m", "pierimpact", *arguments],
        env=environment | options.pop("environment", {}),
        stderr=subprocess.PIPE,
        encoding="utf-8",
        **options,
    )


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_debug(name, capsys):
    with pytest.raises(SystemExit):
        cli.main([name, "--help"])
    assert "--debug" in capsys.readouterr().out


def test_debug_shows_where_bad_input_is_found():
    done = command("trucks", "nowhere", "--debug")
    assert done.returncode == 2
    assert "Traceback (most recent call last)" in done.stderr
    assert done.stderr.splitlines()[-1].startswith("pierimpact: truck must be a name of the cat")


def test_output_in_ascii_and_to_a_full_disk():
    done = command("trucks", "single-unit-8t", environment={"PYTHONIOENCODING": "ascii"})
    assert (done.returncode, done.stderr) == (0, "")
    with Path("/dev/full").open("w") as full:
        done = command("trucks", stdout=full)
    assert done.returncode == 1
    assert done.stderr == "pierimpact: the output: No space left on device\n"


def test_an_interrupt_that_a_callback_drops_comes_again():
    program = """
import signal, time, weakref
from pierimpact.cli.ending import signals_as_interrupts

class Thing:
    pass

try:
    with signals_as_interrupts() as ending:
        thing = Thing()
        reference = weakref.ref(thing, lambda _: signal.raise_signal(signal.SIGTERM))
        del thing
        time.sleep(60.0)
except KeyboardInterrupt:
    print("ended by", int(ending.signal))
"""
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=30, check=True
    )
    assert done.stdout == f"ended by {int(signal.SIGTERM)}\n"
    assert done.stderr == ""


@pytest.mark.parametrize("delay", [0.03, 0.06, 0.1, 0.2])
def test_an_interrupt_at_the_start_is_one_line(delay):
    environment = os.environ | {"PYTHONPATH": str(Path(pierimpact.__file__).parent.parent)}
    code = "import sys; from pierimpact.cli import main; print(flush=True); sys.exit(main())"
    process = subprocess.Popen(
        [sys.executable, "-c", code, "check", str(EXAMPLE)],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )
    process.stdout.readline()  # Python has started
    time.sleep(delay)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate()
    assert (process.returncode, err) == (130, "pierimpact: interrupted, nothing written\n")


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


@pytest.mark.skipif(os.name == "nt", reason="needs a shell of POSIX")
def test_a_closed_output_is_no_defect(tmp_path):
    case = tmp_path / "tti.yaml"
    case.write_bytes(EXAMPLE.read_bytes())
    environment = os.environ | {"PYTHONPATH": str(Path(pierimpact.__file__).parent.parent)}
    for close in (">&-", "<&- >&-"):
        done = subprocess.run(
            f'"{sys.executable}" -m pierimpact report tti.yaml {close}',
            shell=True,
            cwd=tmp_path,
            env=environment,
            stderr=subprocess.PIPE,
            encoding="utf-8",
        )
        assert done.stderr.splitlines() == [
            line for line in done.stderr.splitlines() if line.startswith("pierimpact: warning: ")
        ]
        assert done.returncode == 0
    assert (tmp_path / "reports" / "tti.pdf").exists()


@pytest.mark.parametrize(
    "arguments",
    [
        ["new", f"{'a' * 300}.yaml"],
        ["page", f"{'a' * 300}.html"],
        ["report", str(EXAMPLE), "--output", "d" * 300],
    ],
    ids=lambda arguments: arguments[0],
)
def test_a_name_that_is_too_long_is_bad_input(tmp_path, arguments):
    done = command(*arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert re.fullmatch(r"pierimpact: .*: File name too long\n", done.stderr)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
@pytest.mark.parametrize("arguments", [["trucks", "single-unit-8t"], ["schema"]], ids=" ".join)
def test_output_that_cannot_be_written_or_encoded(arguments):
    command = [sys.executable, "-m", "pierimpact", *arguments]
    environment = os.environ | {"PYTHONPATH": str(Path(pierimpact.__file__).parent.parent)}
    with open("/dev/full", "w") as full:  # noqa: PTH123
        done = subprocess.run(
            command, env=environment, stdout=full, stderr=subprocess.PIPE, encoding="utf-8"
        )
    assert done.returncode == 1
    assert done.stderr == "pierimpact: the output: No space left on device\n"
    done = subprocess.run(
        command, env=environment | {"PYTHONIOENCODING": "ascii"}, capture_output=True, check=True
    )
    assert done.stdout.isascii()
    assert done.stderr == b""
    if arguments == ["schema"]:
        assert json.loads(done.stdout) == case_schema()


@pytest.fixture
def heard(number):
    """See to it that a signal is not ignored, as one is in what `nohup` starts."""
    before = signal.getsignal(number)
    if before == signal.SIG_IGN:
        signal.signal(number, signal.SIG_DFL)
    yield number
    signal.signal(number, before)


@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="needs the signals of POSIX")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signals_end_a_command_as_ctrl_c_does(monkeypatch, capsys, heard):
    number = heard

    def interrupted():
        try:
            os.kill(os.getpid(), number)
        finally:
            os.kill(os.getpid(), number)  # which is ignored, as the first is being followed

    before = [signal.getsignal(each) for each in (number, signal.SIGTERM)]
    monkeypatch.setattr("pierimpact.files.catalogue.catalogue_text", interrupted)
    assert cli.main(["trucks"]) == 128 + number
    assert capsys.readouterr().err == "pierimpact: interrupted, nothing written\n"
    assert [signal.getsignal(each) for each in (number, signal.SIGTERM)] == before
