"""The blocks of a document as data, laid out in a notebook's cell, on the page and in the PDF."""

import io
import json
import os
import re
import shutil
import subprocess
import sys

import nbformat
import numpy as np
import pypdf
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from nbformat import v4
from PIL import Image
from scipy.ndimage import find_objects, label
from test_report import NASTY, Text, squeezed
from word_file import WordFile

from pierimpact.report.document.blocks import (
    Annex,
    Beside,
    Contents,
    Group,
    Headline,
    Listing,
    Nomenclature,
    Notes,
    Notice,
    Paragraph,
    Signatures,
    TitleBlock,
    Verdict,
)
from pierimpact.report.document.markup import Code, Link, Ref, Tex
from pierimpact.report.document.numbered import Column, Equation, Figure, Steps, Table
from pierimpact.report.exporters import SheetHTMLExporter, SheetPDFExporter, notebook_of
from pierimpact.report.word import SheetWordExporter
from pierimpact.units import Printed

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><path d="M0 0h9"/></svg>'
RUN = (NASTY, Code(NASTY), Link(NASTY, NASTY), Tex("x < y"), Ref("Table", "tab-x"))
EQUATION = Equation(label="eq-x", name=RUN, symbol="x", lines=["a < b"], source=NASTY)

#: Every kind of block, and how often each prints the nasty text.
BLOCKS = [
    (
        TitleBlock(
            title=NASTY, subtitle=NASTY, entries={NASTY: NASTY}, date="2026-01-31", paper="a4"
        ),
        4,
    ),
    (Contents(), 0),
    (Headline(results=[(NASTY, Printed(NASTY, NASTY), NASTY)]), 4),
    (Paragraph(RUN), 3),
    (Notes([RUN, NASTY]), 4),
    (Nomenclature([(Tex("x"), RUN, Ref("Eq.", "eq-x"))]), 3),
    (Notice(heading=NASTY, body=[RUN, NASTY]), 5),
    (
        Table(
            label="tab-x",
            caption=RUN,
            columns=[Column(heading=RUN), Column(heading=NASTY, align="decimal")],
            rows=[[RUN, NASTY], [NASTY, "1.5"]],
            strong=[1],
        ),
        3 + 3 + 1 + 3 + 1 + 1,
    ),
    (Steps([EQUATION]), 4),
    (Figure(label="fig-x", caption=RUN, alt=NASTY, svg=SVG), 3),
    (
        Verdict(
            statement=RUN,
            mark="STOP",
            svg=SVG,
            alt=NASTY,
            results=[(NASTY, Printed(NASTY, NASTY), RUN)],
        ),
        3 + 1 + 2 + 3,
    ),
    (Signatures(signers=[(NASTY, NASTY)], revisions=[[NASTY] * 4]), 6),
    (Beside(left=[Paragraph(RUN)], right=[Paragraph(NASTY)], share=0.5), 4),
    (Group([Paragraph(RUN)]), 3),
    (Listing(NASTY, NASTY), 2),
    (Annex(title=NASTY, printed=True), 1),
]


def shown(page):
    return squeezed(Text(page).text).count(squeezed(NASTY))


@pytest.mark.parametrize(("block", "count"), BLOCKS)
def test_text_is_never_markup_in_a_cell(block, count):
    cell = Text(block._repr_html_())
    assert shown(block._repr_html_()) == count
    assert not {"b", "script", "style"} & {tag for tag, _ in cell.tags}
    names = {name for _, attributes in cell.tags for name in attributes}
    assert names <= {"class", "id", "href", "scope", "alt", "src", "aria-label", "style"}


def test_text_is_never_markup_in_a_page_or_pdf():
    notebook = notebook_of([block for block, _ in BLOCKS])
    page, _ = SheetHTMLExporter().from_notebook_node(notebook)
    assert shown(page) == sum(count for _, count in BLOCKS) + 1  # the contents list the annex
    assert not {"b", "script"} & {tag for tag, _ in Text(page).tags}
    pdf, _ = SheetPDFExporter().from_notebook_node(notebook)
    text = "".join(page.extract_text() for page in pypdf.PdfReader(io.BytesIO(pdf)).pages)
    assert (
        squeezed(text.replace("\u200b", "")).count(squeezed(NASTY)) > 10
    )  # side by side, lines mix


def test_a_long_name_makes_its_row_to_sign_in_higher_and_is_broken_at_hyphens():
    signers = [
        ("Prepared", "Dr.-Ing. Alexandra Bergengruen-Hohenstein"),
        ("Checked", "C. de la Fuente y Villanueva"),
        ("Approved", "E. F."),
    ]
    revisions = [[revision, "2026-01-05", "First issue for comment", "AB"] for revision in "ABC"]
    notebook = notebook_of([Signatures(signers=signers, revisions=revisions)])
    pdf, _ = SheetPDFExporter().from_notebook_node(notebook)
    heights = {}

    def place(words, outer, inner, *_):
        line = words.replace("\u200b", "").strip()
        heights[line] = outer[1] * inner[4] + outer[3] * inner[5] + outer[5]

    pypdf.PdfReader(io.BytesIO(pdf)).pages[0].extract_text(visitor_text=place)
    lines = ["Name", "Dr.-Ing.", "Alexandra", "Bergengruen", "Hohenstein", "C. de la Fuente y"]
    assert np.all(np.diff([heights[line] for line in lines]) < -7.0)
    assert heights["Checked"] - heights["Approved"] > 22.0  # 8 mm


def drawing(name, height):
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" width="300" height="{height}"/>'
    return Figure(label=f"fig-{name}", caption=f"Drawing {name}.", alt="x", svg=svg)


@pytest.mark.parametrize("lines", range(24, 44, 4))
def test_a_drawing_of_an_annex_is_in_it_and_no_annex_begins_with_its_heading_alone(lines):
    table = Table(
        label="tab-y", caption="Y.", columns=[Column(heading="Y")], rows=[["y"]] * 12, strong=[]
    )
    blocks = [
        *(Paragraph(f"Line {i}") for i in range(lines)),
        *(Annex(title="One", printed=True), drawing("one", 150), drawing("two", 250)),
        *(Annex(title="Two", printed=True), Paragraph("Before the table."), table),
        *(Annex(title="Three", printed=True), drawing("three", 400)),
    ]
    pdf, _ = SheetPDFExporter().from_notebook_node(notebook_of(blocks))
    pages = [page.extract_text() for page in pypdf.PdfReader(io.BytesIO(pdf)).pages]
    order = ["Annex A", "Drawing one", "Drawing two", "Annex B", "Annex C", "Drawing three"]
    places = ["".join(pages).index(words) for words in order]
    assert places == sorted(places)
    for heading, next_to_it in (("A", "Drawing one"), ("B", "Table"), ("C", "Drawing three")):
        (page,) = (page for page in pages if f"Annex {heading}" in page)
        assert next_to_it in page


def test_text_is_never_markup_in_a_word_document():
    notebook = notebook_of([block for block, _ in BLOCKS])
    document, _ = SheetWordExporter().from_notebook_node(notebook)
    words = WordFile(document)
    assert squeezed(words.text).count(squeezed(NASTY)) == sum(count for _, count in BLOCKS) + 1
    drawings = words.all("body", "wp:docPr")
    assert [squeezed(each.get("descr")) for each in drawings] == [squeezed(NASTY)] * 2


@pytest.mark.parametrize(("block", "count"), BLOCKS)
def test_a_block_is_json(block, count):
    assert json.loads(json.dumps(block.data())) == block.data()


def test_a_stored_notebook_gives_the_same_page():
    entries = {"Project": "x", "Element": "y", "Checked by": "z"}
    title = TitleBlock(title="x", subtitle="y", entries=entries, date="2026-03-01", paper="a4")
    notebook = notebook_of([title, *(block for block, _ in BLOCKS[1:])])
    stored = nbformat.reads(nbformat.writes(notebook), 4)
    pages = [SheetHTMLExporter().from_notebook_node(each)[0] for each in (notebook, stored)]
    assert pages[0] == pages[1]
    assert re.findall("<dt>(.*?)</dt>", pages[0])[:3] == list(entries)


def test_numbers_go_on_from_block_to_block():
    second = Equation(label="eq-y", name="y", symbol="y", lines=["b"])
    words = Paragraph((Ref("Eq.", "eq-y"), Ref("Table", "tab-x"), Ref("Table", "tab-absent")))
    notebook = notebook_of([words, Steps([EQUATION, second]), BLOCKS[7][0]])
    page, _ = SheetHTMLExporter().from_notebook_node(notebook)
    assert re.findall(r'class="number">(.*?)<', page) == ["(1)", "(2)", "Table&nbsp;1."]
    links = re.findall('<a href="#(.*?)">(.*?)</a>', page)
    assert links[:3] == [
        ("eq-y", "Eq.&nbsp;(2)"),
        ("tab-x", "Table&nbsp;1"),
        ("tab-absent", "Table"),
    ]


@pytest.mark.parametrize("exporter", [SheetHTMLExporter, SheetPDFExporter, SheetWordExporter])
def test_a_document_is_the_same_whatever_was_written_before_it(exporter):
    def notebook(*formulas, prose):
        steps = [
            Equation(label=f"eq-{i}", name=Tex(formula), symbol="x", lines=[formula])
            for i, formula in enumerate(formulas)
        ]
        blocks = notebook_of([Steps(steps), Paragraph(Tex(formulas[0]))])
        blocks.cells.append(v4.new_markdown_cell(prose))
        return blocks

    first = notebook("a", r"\frac{a}{b}", "c^2", prose="# One\n\n$a$")
    second = notebook("c^2", "d", "d", prose="$a$")
    third = notebook("a", "d", prose="# Two\n\nwords[^1]\n\n[^1]: a note")
    fourth = notebook("e", prose="# Two\n\nwords[^1]\n\n[^1]: a note")
    used = exporter()
    for each in (first, second, third, fourth, first):
        assert used.from_notebook_node(each)[0] == exporter().from_notebook_node(each)[0]


@pytest.mark.skipif(
    shutil.which("chromium") is None, reason="needs a browser: apt-get install chromium"
)
def test_dots_stand_over_their_letters(tmp_path):
    """In Chromium, whose fonts are DejaVu's where no others are: a mark for each dot, above."""
    formulas = ("x", r"\dot x", r"\ddot x", r"\ddot m", r"\hat F")
    cells = [v4.new_markdown_cell(f"${formula}$") for formula in formulas]
    page, _ = SheetHTMLExporter().from_notebook_node(v4.new_notebook(cells=cells))
    style = (
        "<style>main p { margin: 0; height: 100px; font-size: 50px; line-height: 100px }</style>"
    )
    (tmp_path / "page.html").write_text(page.replace("</head>", f"{style}</head>"), "utf-8")
    subprocess.run(
        [
            "chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic",
            "--no-first-run", "--disable-background-networking", "--disable-component-update",
            "--disable-sync", f"--user-data-dir={tmp_path / 'profile'}", "--window-size=600,800",
            f"--screenshot={tmp_path / 'page.png'}", (tmp_path / "page.html").as_uri(),
        ],
        capture_output=True, check=True, timeout=600,
    )  # fmt: skip
    ink = np.asarray(Image.open(tmp_path / "page.png").convert("L")) < 128
    marks, _ = label(ink, np.ones((3, 3)))
    boxes = sorted(find_objects(marks), key=lambda box: box[0].start)
    rows = [[], [], [], [], []]
    top = min(box[0].start for box in boxes) // 100 * 100
    for box in boxes:
        rows[(box[0].start - top) // 100].append(box)
    assert [len(row) for row in rows] == [1, 2, 3, 3, 2]
    for row in rows:
        letter = max(row, key=lambda box: box[1].stop - box[1].start)
        for mark in row:
            if mark is not letter:
                assert mark[0].stop <= letter[0].start
                middle = (mark[1].start + mark[1].stop) / 2
                assert letter[1].start - 2 <= middle <= letter[1].stop + 2


def test_a_notebook_without_a_title_block_has_a_pdf_too():
    notebook = v4.new_notebook(cells=[v4.new_markdown_cell("# A lesson\n\nOn $x$.")])
    pdf, _ = SheetPDFExporter().from_notebook_node(notebook)
    assert "A lesson" in pypdf.PdfReader(io.BytesIO(pdf)).pages[0].extract_text()


@given(st.lists(st.tuples(st.integers(1, 6), st.booleans()), min_size=1, max_size=8))
@settings(max_examples=20, deadline=None)
def test_headings_that_leave_out_levels_are_raised_in_the_pdf(headings):
    cells = [
        v4.new_markdown_cell(
            f"{'#' * level} Heading {i}{' {.unnumbered}' * plain}\n\n```\n== code {i}\n```"
        )
        for i, (level, plain) in enumerate(headings)
    ]
    pdf, _ = SheetPDFExporter().from_notebook_node(v4.new_notebook(cells=cells))
    reader = pypdf.PdfReader(io.BytesIO(pdf))
    text = "".join(page.extract_text() for page in reader.pages)
    assert all(f"== code {i}" in text for i in range(len(headings)))

    def levels(outline, level=1):
        for entry in outline:
            if isinstance(entry, list):
                yield from levels(entry, level + 1)
            else:
                yield level

    found = list(levels(reader.outline))
    assert len(found) == len(headings)
    for i, (level, _) in enumerate(headings):
        parent = max((j for j in range(i) if headings[j][0] < level), default=None)
        assert found[i] == (1 if parent is None else found[parent] + 1)


@pytest.mark.parametrize(
    "opened", ["```\nnever closed", "<!-- never closed", "<pre>", "$x", "[a]("]
)
@pytest.mark.parametrize("exporter", [SheetHTMLExporter, SheetPDFExporter, SheetWordExporter])
def test_what_one_cell_leaves_open_does_not_reach_the_next(exporter, opened):
    cells = [v4.new_markdown_cell(text) for text in ("# Before", opened, "# After\n\n$y^2$ words")]
    notebook = v4.new_notebook(cells=cells)
    _, resources = exporter().from_notebook_node(notebook)
    *_, last = resources["sheet"]["blocks"]
    assert "words" in last["converted"]
    assert "After" in last["converted"]


RAIN = """
import os, signal, threading, time
from pierimpact.report.exporters import pandoc
signal.signal(signal.SIGINT, lambda *_: None)

def rain():
    while True:
        time.sleep(0.002)
        os.killpg(os.getpgrp(), signal.SIGINT)

threading.Thread(target=rain, daemon=True).start()
assert {pandoc("--from=markdown", "--to=plain", text="words") for _ in range(100)} == {b"words\\n"}
"""


@pytest.mark.skipif(os.name == "nt", reason="needs the signals of POSIX")
def test_ctrl_c_does_not_reach_pandoc():
    command = [sys.executable, "-c", RAIN]
    done = subprocess.run(command, start_new_session=True, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
