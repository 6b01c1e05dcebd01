"""What ends a run from outside leaves the old files or the new whole ones, and nothing else.

`pytest -m attack` kills 200 reports; the ordinary run a few.
"""

import ctypes
import os
import random
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from pierimpact.files.scratch import remove_abandoned
from pierimpact.files.unchanged import RECORD, refuse_changed

pytestmark = pytest.mark.skipif(
    not Path("/proc/self/environ").is_file(), reason="needs Linux, to find every process"
)

ROOT = Path(__file__).parent.parent
EXAMPLE = (ROOT / "notebooks" / "tti-column.yaml").read_text("utf-8") + "date: 2026-02-03\n"
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL)
PATIENCE = 30.0  # for a kernel to notice that its starter is gone [s]
TWO_CASES = {f"{name}.{end}" for name in "ab" for end in ("ipynb", "html", "pdf", "docx")}
SUMMARY = {f"summary.{end}" for end in ("html", "pdf", "csv", "docx")}
BINDER = {"binder.pdf"}


@pytest.fixture(autouse=True)
def orphans_come_here():
    """Let orphans have a parent that is not the first process, as in a user's session."""
    reaper = 36  # PR_SET_CHILD_SUBREAPER
    ctypes.CDLL(None).prctl(reaper, 1)
    # Tests that run behind a shell ignore Ctrl-C, and what they start would too.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
    ctypes.CDLL(None).prctl(reaper, 0)


def processes_with(mark):
    """Return the processes in whose environment there is a mark."""
    found = []
    for environment in Path("/proc").glob("[0-9]*/environ"):
        try:
            if mark.encode() in environment.read_bytes():
                found.append(int(environment.parent.name))
        except OSError:
            pass
    return found


class Folder:
    """Two cases and where their reports go, by runs that are killed."""

    def __init__(self, folder):
        self.folder, self.output, self.temporary = folder, folder / "out", folder / "tmp"
        self.temporary.mkdir()
        self.runs = 0

    def start(self, arguments):
        """Start a run on cases that are not as those of the run before, with a mark of its own."""
        self.runs += 1
        for name in "ab":
            text = re.sub("revision: .*", f"revision: R{self.runs}", EXAMPLE)
            (self.folder / f"{name}.yaml").write_text(text, encoding="utf-8")
        self.mark = f"PIERIMPACT_RUN={self.folder}-{self.runs}-"
        key, _, value = self.mark.partition("=")
        return subprocess.Popen(
            [sys.executable, "-m", "pierimpact", "report", "--output", "out", *arguments],
            cwd=self.folder,
            env=os.environ | {"PYTHONPATH": str(ROOT), "TMPDIR": str(self.temporary), key: value},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            encoding="utf-8",
        )

    def files(self):
        """Return the bytes of every file of the output folder."""
        if not self.output.is_dir():
            return {}
        return {path.name: path.read_bytes() for path in self.output.iterdir() if path.is_file()}

    def check(self, arguments, number, code, errors, before):
        """Check what a run left that was ended by a signal, or had come to its end."""
        end = time.monotonic() + PATIENCE
        while processes_with(self.mark) and time.monotonic() < end:
            time.sleep(0.05)
        assert processes_with(self.mark) == []
        left = [path for path in self.output.glob(".*") if path.name != RECORD]
        if number != signal.SIGKILL:
            # Python ends itself so where an interrupt met code that it runs from a string, the
            # line printed or not even that.
            by_python = code == -signal.SIGINT
            assert code in (0, 128 + number, -number) or by_python
            assert left == []
            assert list(self.temporary.iterdir()) == []
            lines = len(errors.splitlines())
            assert lines == (code > 0) or (by_python and lines == 1)
            if "nothing written" in errors:
                assert self.files() == before
        remove_abandoned(self.temporary)
        assert not list(self.temporary.glob("pierimpact-*"))
        if self.output.is_dir():
            refuse_changed(self.output, TWO_CASES | SUMMARY | BINDER)  # ends what was begun
            assert [path for path in self.output.glob(".*") if path.name != RECORD] == []
        after = self.files()
        assert set(after) <= TWO_CASES | SUMMARY | BINDER | {RECORD}
        sets = [{name for name in TWO_CASES if name.startswith(case)} for case in "ab"] + [
            SUMMARY,
            BINDER,
        ]
        for names in sets:
            if "--docx" not in arguments:
                names = {name for name in names if not name.endswith(".docx")}
            # Every file has the revision in it, but for the table of the summary.
            new = {name for name in names if after.get(name) != before.get(name)}
            assert not new or new >= {name for name in names if not name.endswith(".csv")}
            assert not new or names <= set(after)
        return code


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return Folder(tmp_path_factory.mktemp("killed"))


ONE, ALL = ["a.yaml"], ["a.yaml", "b.yaml", "--docx", "--binder"]


def kill(folder, arguments, number, after):
    """Kill a run by a signal after a time [s], and check what it leaves."""
    before = folder.files()
    run = folder.start(arguments)
    try:
        run.wait(after)
    except subprocess.TimeoutExpired:
        run.send_signal(number)
    _, errors = run.communicate(timeout=600)  # only a hang takes that long
    return folder.check(arguments, number, run.returncode, errors, before)


@pytest.mark.parametrize("number", SIGNALS, ids=lambda number: number.name)
def test_a_killed_run_leaves_whole_files_only(folder, number):
    kill(folder, ALL, number, random.Random(number).uniform(1.0, 8.0))


@pytest.mark.attack
def test_two_hundred_killed_runs_leave_whole_files_only(folder):
    draw, ended, longest = random.Random(1), [], {}
    for arguments in (ONE, ALL):
        begin = time.monotonic()
        assert kill(folder, arguments, signal.SIGTERM, 3600.0) == 0
        longest[len(arguments)] = time.monotonic() - begin
    for _ in range(200):
        arguments = draw.choice([ONE, ONE, ONE, ALL])
        begin, after = time.monotonic(), draw.uniform(0.0, longest[len(arguments)])
        ended.append(kill(folder, arguments, draw.choice(SIGNALS), after))
        if ended[-1] == 0:  # the machine is less busy than at first
            longest[len(arguments)] = min(longest[len(arguments)], time.monotonic() - begin)
        print(len(ended), ended[-1], flush=True)  # for those who wait, by -s
    assert sum(code != 0 for code in ended) > 100
