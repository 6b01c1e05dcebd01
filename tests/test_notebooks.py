"""The teaching notebooks run on a copy, and their pages stand without a kernel."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient
from nbconvert import HTMLExporter
from traitlets.config import Config

from pierimpact.report.exporters import SheetHTMLExporter

HOUSE = Path(__file__).parents[1]
NOTEBOOKS = [*sorted((HOUSE / "notebooks").glob("0*.ipynb")), HOUSE / "notebooks/explorer.ipynb"]


@pytest.fixture(scope="module", params=NOTEBOOKS, ids=lambda path: path.stem)
def executed(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("notebook")
    notebook = nbformat.read(request.param, as_version=4)
    config = Config()
    config.KernelManager.transport_encryption = "auto"
    config.KernelManager.kernel_name = "python3"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", str(HOUSE))
        client = NotebookClient(
            notebook, timeout=600, resources={"metadata": {"path": folder}}, config=config
        )
        return client.execute()


def test_it_runs_without_a_word_of_complaint(executed):
    outputs = [out for cell in executed.cells for out in cell.get("outputs", ())]
    assert outputs
    assert not [out for out in outputs if out["output_type"] in ("error", "stream")]


def test_its_page_shows_stills_instead_of_widgets(executed):
    page, _ = HTMLExporter(template_name="lab").from_notebook_node(executed)
    assert page.count('class="pierimpact-still"') >= 1
    assert "pierimpact teach" in page
    assert "body.jp-Notebook:not([data-voila]) .pierimpact-live {display:none}" in page
    assert re.search(r"pierimpact-still[^>]*>(?:(?!pierimpact-live).)*<iframe ", page, re.S)


def test_its_own_page_needs_no_network(executed):
    page, _ = SheetHTMLExporter().from_notebook_node(executed)
    assert "<script" not in page
    sources = re.findall(r'(?:src|srcset)="([^"]*)"', page)
    assert all(source.startswith("data:image/") for source in sources)
    assert not re.search(r"<link\b|@import|url\(|(?:src|href)=&quot;(?!#)", page)
    assert "widget-view" not in page
    page = re.sub(r'srcdoc="[^"]*"', "", page)  # explorers, which are programs
    prose = "\n".join(cell.source for cell in executed.cells if cell.cell_type == "markdown")
    formulas = len(re.findall(r"\$\$.+?\$\$|\$[^$\n]+\$", prose, re.DOTALL))
    assert page.count("<math") == formulas
    assert not re.search(
        r"\$\S", re.sub(r"<annotation .*?</annotation>", "", page, flags=re.DOTALL)
    )
    title = re.search("^# (.+)$", prose, re.MULTILINE)[1]
    assert f"<title>{title}</title>" in page
    assert "header-section-number" not in page.partition("</style>")[2]


def test_nbconvert_alone_executes_and_writes_the_page(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "nbconvert", "--to", "pierimpact_html", "--execute",
         f"--output-dir={tmp_path}", HOUSE / "notebooks/02_pier.ipynb"],
        cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(HOUSE)}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "02_pier.html").read_text(encoding="utf-8")
    assert page.count("<iframe ") == 1
    assert "<math" in page


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_holds_prose_and_one_call_per_idea(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    for cell in cells:
        assert not cell.get("outputs")
        assert cell.get("execution_count") is None
        if cell["cell_type"] == "code":
            lines = [line for line in "".join(cell["source"]).splitlines() if line]
            assert len([line for line in lines if not line.startswith("from ")]) <= 1


@pytest.mark.parametrize("path", NOTEBOOKS[:-1], ids=lambda path: path.stem)
def test_it_has_the_parts_of_a_lesson(path):
    text = path.read_text(encoding="utf-8")
    parts = ("**Purpose.**", "**You need**", "exercises.begin(", "## Predict, then see",
             "predictions.ask(", "predictions.reveal(", "What to notice", "## What many believe",
             "exercises.score(", "## In short", "## Sources")  # fmt: skip
    assert [part for part in parts if part not in text] == []
    assert text.index("predictions.ask(") < text.index("predictions.reveal(")
    assert "widgets." not in text[: text.index("predictions.reveal(")]
