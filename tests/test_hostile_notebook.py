"""A notebook of others: its documents run nothing of it, and neither read files nor ask for any."""

import base64
import io
import re
from xml.etree import ElementTree

import nbformat.v4
import pypdf
import pytest
import typst
from browser_requests import needs_browser, shown_by_browser
from word_file import WordFile

from pierimpact.report.document.blocks import TitleBlock
from pierimpact.report.exporters import SheetHTMLExporter, SheetPDFExporter, notebook_of
from pierimpact.report.word import SheetWordExporter

ADDRESS = "http://127.0.0.1:9"
RUN = "document.body.append('it' + ' ran')"
HOSTILE_SVG = f"""
<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9" onload="{RUN}">
<style>@import "{ADDRESS}/a.css";</style><image href="{ADDRESS}/b.png" width="9" height="9"/>
<script>{RUN}</script></svg>
"""
HOSTILE_HTML = f"""
<p>Harmless text</p>
<script>{RUN}</script> <script src="{ADDRESS}/c.js"></script>
<img src="{ADDRESS}/d.png" onerror="{RUN}"> <img src="/e.png" onerror="{RUN}">
<svg onload="{RUN}"></svg>
<iframe src="{ADDRESS}/f"></iframe> <iframe srcdoc="<script>parent.{RUN}</script>"></iframe>
<link rel="stylesheet" href="{ADDRESS}/g.css">
<style>p {{ background: url({ADDRESS}/h.png) }}</style>
<style>@font-face {{ font-family: x; src: url({ADDRESS}/i.ttf) }} p {{ font-family: x }}</style>
<object data="{ADDRESS}/j"></object> <embed src="{ADDRESS}/k">
<video src="{ADDRESS}/l" autoplay></video>
<base href="{ADDRESS}/"> <form action="{ADDRESS}/m"></form>
<a href="javascript:{RUN}" id="link">x</a>
"""
LOGO = "image/svg+xml", base64.b64encode(HOSTILE_SVG.encode()).decode()
ENTRIES = {"Project": '#read("/etc/hostname")', "Job number": "1", "Element": r"\ #eval(1)"}
PACKAGE = '#import "@preview/cetz:0.3.0"'


def notebook(prose, output="", logo=None):
    """Return a notebook with a title, prose, and the HTML that a cell has put out."""
    head = TitleBlock(
        title="Sheet", subtitle=PACKAGE, entries=ENTRIES, logo=logo, date="2026-01-31", paper="a4"
    )
    made = notebook_of([head])
    made.cells.append(nbformat.v4.new_markdown_cell(prose))
    shown = nbformat.v4.new_output("display_data", {"text/html": output})
    made.cells.append(nbformat.v4.new_code_cell(outputs=[shown]))
    return made


@needs_browser
def test_a_page_runs_nothing_and_asks_for_nothing(tmp_path):
    page, _ = SheetHTMLExporter().from_notebook_node(notebook(HOSTILE_HTML, HOSTILE_HTML, LOGO))
    assert page.count(f"{ADDRESS}/c.js") == 2
    (tmp_path / "page.html").write_text(page, "utf-8")
    shown, requests = shown_by_browser(tmp_path / "page.html", tmp_path)
    assert shown.count("Harmless text") == 2
    assert "it ran" not in shown
    assert requests == set()
    free = page.replace("Content-Security-Policy", "no-policy")
    (tmp_path / "page.html").write_text(free, "utf-8")
    shown, requests = shown_by_browser(tmp_path / "page.html", tmp_path)
    assert "it ran" in shown
    assert len(requests) > 5


EXPLORER = """
<p>Explorer: <b id="said"></b></p>
<script>onmessage = ({ data }) => document.querySelector("#said").append(data)</script>
<iframe sandbox="allow-scripts"
srcdoc="<script>parent.postMessage('it ran', '*')</script>"></iframe>
"""


@needs_browser
def test_an_explorer_acts_in_the_page_of_a_lesson_and_asks_for_nothing(tmp_path):
    lesson = notebook(HOSTILE_HTML, EXPLORER)
    del lesson.cells[0]  # or else it is a sheet
    (tmp_path / "page.html").write_text(SheetHTMLExporter().from_notebook_node(lesson)[0], "utf-8")
    shown, requests = shown_by_browser(tmp_path / "page.html", tmp_path)
    assert re.search('<b id="said">(it ran)+</b>', shown)
    assert requests == set()


def test_a_pdf_reads_no_file_and_no_package():
    raw = f'```{{=typst}}\n{PACKAGE}\n```\n\n`#read("/etc/hostname")`{{=typst}}'
    pdf, _ = SheetPDFExporter().from_notebook_node(notebook(raw))
    reader = pypdf.PdfReader(io.BytesIO(pdf))
    text = "".join(page.extract_text() for page in reader.pages).replace("\u200b", "")
    assert text.count(PACKAGE) == 2
    assert text.count('#read("/etc/hostname")') >= 3
    assert "/JavaScript" not in pdf.decode("latin-1")
    with pytest.raises(typst.TypstError, match="URLs are not allowed"):
        SheetPDFExporter().from_notebook_node(notebook("", logo=LOGO))


@pytest.mark.parametrize("address", ["secret.svg", "../secret.svg", f"{ADDRESS}/x.svg"])
def test_a_pdf_has_no_picture_from_elsewhere(address, tmp_path, monkeypatch):
    (tmp_path / "secret.svg").write_text("<svg xmlns='http://www.w3.org/2000/svg'/>")
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here" if address.startswith("..") else tmp_path)
    with pytest.raises(typst.TypstError, match=r"file not found|escape"):
        SheetPDFExporter().from_notebook_node(notebook(f"![picture]({address})"))


@pytest.mark.parametrize("address", ["/etc/hostname", "file:///etc/hostname", f"{ADDRESS}/x.png"])
def test_a_word_file_has_no_picture_from_elsewhere(address):
    for prose, output in (
        (f"![picture]({address})", ""),
        ("", f"<img src='{address}'>"),
        ("", f"<iframe src='{address}'></iframe>"),
    ):
        with pytest.raises(RuntimeError, match="Could not fetch resource"):
            SheetWordExporter().from_notebook_node(notebook(prose, output))


def test_a_word_file_leads_out_by_links_only():
    prose = f"A [link]({ADDRESS}/page)\n\n<script>{RUN}</script><form action='{ADDRESS}/f'></form>"
    word, _ = SheetWordExporter().from_notebook_node(notebook(prose))
    relations = [
        relation
        for name, content in WordFile(word).files.items()
        if name.endswith(".rels")
        for relation in ElementTree.fromstring(content)
        if relation.get("TargetMode") == "External"
    ]
    assert {relation.get("Type").rpartition("/")[2] for relation in relations} == {"hyperlink"}
    assert {relation.get("Target") for relation in relations} == {f"{ADDRESS}/page"}
    assert not [name for name in WordFile(word).files if "vba" in name or "embed" in name.lower()]
