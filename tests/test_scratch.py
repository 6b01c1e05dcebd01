"""Scratch folders go with their process, or with the next one of this user that makes one."""

import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from pierimpact.files.scratch import ScratchFolder, remove_abandoned

MAKES_ONE = """
from pierimpact.files.scratch import ScratchFolder
folder = ScratchFolder()
(folder.path / "deep").mkdir()
(folder.path / "deep" / "file").touch()
print(folder.name, flush=True)
input()
"""


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", None)
    return tmp_path


def maker():
    """Start a process that has a scratch folder; return it and the folder."""
    process = subprocess.Popen(
        [sys.executable, "-c", MAKES_ONE],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        encoding="utf-8",
    )
    return process, Path(process.stdout.readline().rstrip())


def test_a_scratch_folder_is_gone_after_its_block(temporary):
    with ScratchFolder() as name:
        path = Path(name)
        assert path.parent == temporary
        (path / "file").touch()
    assert list(temporary.iterdir()) == []


@pytest.mark.skipif(os.name == "nt", reason="needs a signal that no process can catch")
def test_a_folder_of_a_killed_process_goes_with_the_next_and_no_other_does(temporary):
    (living, folder), (killed, left) = maker(), maker()
    assert folder.parent == left.parent == temporary
    killed.send_signal(signal.SIGKILL)
    killed.communicate()
    assert (left / "deep" / "file").exists()
    users_own = temporary / "pierimpact-notes"
    users_own.mkdir()
    with ScratchFolder() as own:
        assert set(temporary.iterdir()) == {folder, users_own, Path(own)}
        remove_abandoned(temporary)
        assert Path(own).is_dir()
        assert (folder / "deep" / "file").exists()
    living.communicate("\n")
    assert list(temporary.iterdir()) == [users_own]


@pytest.mark.skipif(os.name == "nt", reason="needs links")
def test_a_link_in_place_of_a_scratch_folder_is_not_followed(temporary):
    with ScratchFolder() as own:
        (mark,) = (path.name for path in Path(own).iterdir())
    elsewhere, link = temporary / "elsewhere", temporary / "pierimpact-x"
    elsewhere.mkdir()
    (elsewhere / mark).touch()
    link.symlink_to(elsewhere)
    remove_abandoned(temporary)
    assert link.is_symlink()
    assert (elsewhere / mark).exists()
