from pathlib import Path
from types import SimpleNamespace

import pytest

from pierimpact import cli
from pierimpact.checks import InputError
from pierimpact.teaching import launch as teach


@pytest.fixture
def served(monkeypatch):
    calls = []

    def serve(*what, browser):
        calls.append((*what, browser))

    server = SimpleNamespace(serve_course=serve, serve_page=serve)
    monkeypatch.setattr(teach, "import_module", lambda _: server)
    monkeypatch.setattr(teach, "_need", lambda *_: None)
    return calls


def test_the_readers_own_copies_are_served(tmp_path, served):
    folder = tmp_path / "course"
    teach.open_notebooks(folder, browser=False)
    assert served == [(folder, "01_collision.ipynb", False)]
    names = {file.name for file in folder.iterdir()}
    assert {"01_collision.ipynb", "06_limits.ipynb", "tti-column.yaml"} <= names


def test_the_app_shows_the_explorer(tmp_path, served):
    teach.open_notebooks(tmp_path, app=True)
    assert served == [(tmp_path / "explorer.ipynb", True)]


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


@pytest.mark.parametrize("app", [[], ["--app"]], ids=["lab", "app"])
def test_the_command_opens_the_readers_copies(app, tmp_path, served):
    assert cli.main(["teach", *app, "--folder", str(tmp_path), "--no-browser"]) == 0
    [(*what, browser)] = served
    assert what == ([tmp_path / "explorer.ipynb"] if app else [tmp_path, "01_collision.ipynb"])
    assert not browser


def test_the_command_says_what_is_missing(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(teach, "find_spec", lambda module: None)
    assert cli.main(["teach", "--folder", str(tmp_path)]) == 1
    assert capsys.readouterr().err.startswith("pierimpact: the notebooks need jupyterlab: ")


def test_the_guide_counts_the_lessons_that_are_copied(tmp_path):
    teach.copy_notebooks(tmp_path)
    assert len(list(tmp_path.glob("0*.ipynb"))) == 7
    guide = (Path(__file__).parents[1] / "docs" / "how-to" / "teach.md").read_text(encoding="utf-8")
    assert "Seven lessons go from one collision to the risk from traffic" in guide
