from pathlib import Path

import pytest

from pierimpact import cli
from pierimpact.checks import InputError
from pierimpact.teaching import launch as teach


@pytest.fixture
def started(monkeypatch):
    calls = []

    def execve(program, arguments, environment):
        calls.append((arguments[1:], Path.cwd()))
        raise SystemExit(3)

    monkeypatch.chdir(Path.cwd())  # which is undone at the end
    monkeypatch.setattr(teach.os, "execve", execve)
    monkeypatch.setattr(teach, "_need", lambda *_: None)
    return calls


def test_the_readers_own_copies_are_opened(tmp_path, started):
    folder = tmp_path / "course"
    with pytest.raises(SystemExit, match="3"):
        teach.open_notebooks(folder, browser=False)
    assert started == [(["-m", "jupyterlab", "--no-browser", "01_collision.ipynb"], folder)]
    names = {file.name for file in folder.iterdir()}
    assert {"01_collision.ipynb", "06_limits.ipynb", "tti-column.yaml"} <= names


def test_the_app_shows_the_explorer(tmp_path, started):
    with pytest.raises(SystemExit, match="3"):
        teach.open_notebooks(tmp_path, app=True)
    assert started == [(["-m", "voila", "explorer.ipynb"], tmp_path)]


def test_what_a_reader_changed_is_kept(tmp_path):
    (tmp_path / "01_collision.ipynb").write_text("mine")
    teach.copy_notebooks(tmp_path)
    assert (tmp_path / "01_collision.ipynb").read_text() == "mine"


def test_a_folder_that_cannot_be_made(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written to"):
        teach.copy_notebooks(tmp_path / "file")


def test_a_missing_package_is_named(monkeypatch):
    monkeypatch.setattr(teach, "find_spec", lambda name: None)
    with pytest.raises(teach.TeachError, match=r"pip install 'pierimpact\[teach\]'"):
        teach.open_notebooks()


@pytest.mark.parametrize(
    ("options", "program"), [([], "jupyterlab"), (["--app"], "voila")], ids=["lab", "app"]
)
def test_the_command_opens_the_readers_copies(options, program, tmp_path, started):
    folder = tmp_path / "mine"
    with pytest.raises(SystemExit, match="3"):
        cli.main(["teach", *options, "--folder", str(folder), "--no-browser"])
    [(arguments, where)] = started
    assert program in arguments
    assert "--no-browser" in arguments
    assert where == folder


def test_the_command_says_what_is_missing(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(teach, "find_spec", lambda module: None)
    assert cli.main(["teach", "--folder", str(tmp_path)]) == 1
    assert capsys.readouterr().err.startswith("pierimpact: the notebooks need jupyterlab: ")
