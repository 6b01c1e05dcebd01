"""Where and how a report is made changes nothing in it: two at once, one in odd surroundings."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
FOLDER = "pier {A} 橋脚 опора {0} $HOME %d 'x'"
FILES = ("case.ipynb", "case.html", "case.pdf")


def start(*arguments, cwd, env):
    """Start the command line of this checkout, and return the process."""
    return subprocess.Popen(
        [str(argument) for argument in arguments],
        cwd=cwd,
        env=env | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )


def printed(process):
    out, errors = process.communicate()
    assert (process.returncode, errors) == (0, "")
    return out


@pytest.fixture
def odd(tmp_path):
    """A folder of odd name, and what starts Python there as an ordinary user with little else."""
    folder = tmp_path / FOLDER
    folder.mkdir()
    home = tmp_path / "home"
    home.mkdir()
    home.chmod(0o500)
    ordinary = ["unshare", "--user"]  # without this, root may write anywhere
    if os.geteuid() or subprocess.run([*ordinary, "true"], check=False).returncode:
        ordinary = []
    environment = {
        "HOME": str(home),
        "LANG": "C",
        "LC_ALL": "C",
        "OMP_NUM_THREADS": "1",
        "PATH": os.defpath,
        "PYTHONOPTIMIZE": "2",  # as python -OO, here and in the kernel
    }
    return folder, [*ordinary, sys.executable], environment


def test_a_report_in_odd_surroundings_is_the_same(odd, tmp_path):
    folder, python, environment = odd
    plain = tmp_path / "plain"
    plain.mkdir()
    case = (ROOT / "notebooks" / "tti-column.yaml").read_text("utf-8") + "date: 2026-02-03\n"
    for place in (plain, folder):
        (place / "case.yaml").write_text(case, encoding="utf-8")
    command = ("-m", "pierimpact", "report")
    at_once = (
        start(sys.executable, *command, "case.yaml", cwd=plain, env=dict(os.environ)),
        start(
            *python, *command, folder / "case.yaml", "--output", folder / "{out}",
            cwd="/", env=environment,
        ),
    )  # fmt: skip
    said = [(*process.communicate(), process.returncode) for process in at_once]
    assert [answer[1:] for answer in said] == [("", 0), ("", 0)]
    names = [[Path(line) for line in out.splitlines()] for out, *_ in said]
    assert [file.name for file in names[0]] == list(FILES)
    assert names[1] == [folder / "{out}" / file for file in FILES]
    for name in FILES[1:]:
        one, other = (plain / "reports" / name), (folder / "{out}" / name)
        assert one.read_bytes() == other.read_bytes(), name
    if os.geteuid() or python[0] != sys.executable:  # in a chroot, root cannot become ordinary
        assert not list((tmp_path / "home").iterdir())


def test_a_check_without_a_home(odd):
    folder, python, environment = odd
    shutil.copy(ROOT / "notebooks" / "tti-column.yaml", folder / "case.yaml")
    command = ("-m", "pierimpact", "check", "--json", "case.yaml")
    away = environment | {"HOME": "/nowhere/at/all"}
    found = printed(start(*python, *command, cwd=folder, env=away))
    usual = printed(start(sys.executable, *command, cwd=folder, env=dict(os.environ)))
    assert found == usual
