"""The sheet as a Word document, read back: what is native in it, and what it says."""

import html
import io
import re
from xml.etree import ElementTree

import pytest
from nbformat import v4
from PIL import Image
from sheet_page import US_CASE, executed
from test_report import Text, squeezed
from word_file import WordFile, name, text_of

from pierimpact.report.document.blocks import BLOCK_MIME, Verdict
from pierimpact.report.document.line_breaks import formula_width
from pierimpact.report.exporters import SheetHTMLExporter, notebook_of, parts_of
from pierimpact.report.word import SheetWordExporter, equation_lines, raised_brackets
from pierimpact.report.write import convert


class Made:
    """A case's notebook, its page, and its Word document."""

    def __init__(self, values):
        self.notebook = executed(values)
        self.page, _ = SheetHTMLExporter().from_notebook_node(self.notebook)
        self.content, _ = SheetWordExporter().from_notebook_node(self.notebook)
        self.word = WordFile(self.content)
        outputs = [output for cell in self.notebook.cells for output in cell.get("outputs", [])]
        blocks = [out.data[BLOCK_MIME] for out in outputs if BLOCK_MIME in out.data]
        self.parts = list(parts_of(blocks))

    def of(self, kind):
        return [part for part in self.parts if part["type"] == kind]


@pytest.fixture(scope="module")
def made():
    """A case in US units; of pages in SI units, the lesson below is one."""
    entries = {"project": "Bridge over a road", "element": "P<3> & more", "job_number": "0042"}
    return Made(US_CASE | entries | {"annexes": "all"})


def test_equations_are_native_and_numbered_with_their_names(made):
    equations = made.of("Equation")
    assert len(equations) > 20
    lines = [equation_lines(e["symbol"], e["lines"]) for e in equations]
    assert len(made.word.all("body", "m:oMathPara")) == sum(map(len, lines))
    in_prose = len(re.findall("<math", made.page)) - len(made.of("Tex")) - len(equations)
    inline = len(made.word.all("body", "m:oMath")) - len(made.word.all("body", "m:oMathPara"))
    assert inline == len(made.of("Tex")) + in_prose
    rows = [text_of(row) for row in made.word.all("body", "w:tr")]
    numbered = [row for row in rows if re.search(r"^\(\d+\)$", row, re.MULTILINE)]
    numbers = [int(re.findall(r"^\((\d+)\)$", row, re.MULTILINE)[-1]) for row in numbered]
    assert numbers == list(range(1, len(equations) + 1))
    for equation in equations:
        if isinstance(equation["name"], str):
            assert equation["name"] in made.word.text
    positions = {WordFile.get(e, "m:val") for e in made.word.all("body", "m:jc")}
    assert positions == {"left"}


def test_equations_are_on_the_page_and_have_no_bracket_without_its_other(made):
    """As LibreOffice has them at 12 pt, on 154 mm of A4; it refuses brackets that are alone."""
    for equation in made.of("Equation"):
        lines = equation_lines(equation["symbol"], equation["lines"])
        assert max(map(formula_width, lines)) < 57.0
        for line in lines:
            plain = re.sub(r"\\text\{[^{}]*\}", "", line)
            for opening, closing in ("()", "[]"):
                assert plain.count(opening) == plain.count(closing)


@pytest.mark.parametrize(("mark", "colour"), [("STOP", "B3261E"), ("CAUTION", "A05A00")])
def test_a_verdict_with_a_mark_has_a_frame_and_the_mark_in_colour(mark, colour):
    svg = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>'
    found = {}
    for own in (mark, ""):
        verdict = Verdict(statement="It does not.", mark=own, svg=svg, alt="x", results=[])
        content, _ = SheetWordExporter().from_notebook_node(notebook_of([verdict]))
        word = WordFile(content)
        paragraph = next(p for p in word.all("body", "w:p") if "It does not." in text_of(p))
        styles = {WordFile.get(e, "w:styleId"): e for e in word.all("styles", "w:style")}
        used = [e for kind in ("w:pStyle", "w:rStyle") for e in paragraph.iter(name(kind))]
        found[own] = [styles[WordFile.get(each, "w:val")] for each in used]
    framed, marked = found[mark]
    assert len(list(framed.find(f"{name('w:pPr')}/{name('w:pBdr')}"))) == 4
    assert WordFile.get(next(marked.iter(name("w:color"))), "w:val") == colour
    assert marked.find(f"{name('w:rPr')}/{name('w:b')}") is not None
    (other,) = found[""]
    assert len(list(other.find(f"{name('w:pPr')}/{name('w:pBdr')}"))) == 1


def test_no_row_is_parted_by_the_end_of_a_page(made):
    for row in made.word.all("body", "w:tr"):
        assert row.find(f"{name('w:trPr')}/{name('w:cantSplit')}") is not None


def test_tables_are_tables(made):
    tables = made.of("Table")
    found = [
        table
        for table in made.word.all("body", "w:tbl")
        if WordFile.get(next(table.iter(name("w:tblStyle"))), "w:val") == "Data"
    ]
    assert len(found) == len(tables) > 4
    for table, expected in zip(found, tables, strict=True):
        head, *rows = table.iter(name("w:tr"))
        assert head.find(f"{name('w:trPr')}/{name('w:tblHeader')}") is not None
        assert len(rows) == len(expected["rows"])
        for row, cells in zip(rows, expected["rows"], strict=True):
            for cell, words, column in zip(
                row.iter(name("w:tc")), cells, expected["columns"], strict=True
            ):
                if isinstance(words, str):
                    assert squeezed(text_of(cell)) == squeezed(words)
                if text_of(cell).strip():
                    sides = [WordFile.get(jc, "w:val") for jc in cell.iter(name("w:jc"))]
                    assert ("right" in sides) == (column["align"] == "decimal")


def test_every_cell_of_the_page_is_in_the_document(made):
    text = squeezed(made.word.text)
    cells = re.findall(
        r"<(?:td|th|dd|dt|h2|h3)\b[^>]*>(.*?)</(?:td|th|dd|dt|h2|h3)>", made.page, re.S
    )
    plain = [squeezed(html.unescape(re.sub("<[^>]+>", "", c))) for c in cells if "<math" not in c]
    assert len(plain) > 150
    assert [cell for cell in plain if cell not in text] == []


def test_drawings_are_pictures_of_two_hundred_dots_an_inch_with_words_for_them(made):
    drawings = [part for part in made.parts if "svg" in part]
    assert drawings
    found = made.word.all("body", "wp:docPr")
    assert [each.get("descr") for each in found] == [part["alt"] for part in drawings]
    sizes = made.word.all("body", "wp:extent")
    places = re.findall('embed="(.*?)"', made.word.files["word/document.xml"].decode())
    relations = ElementTree.fromstring(made.word.files["word/_rels/document.xml.rels"])
    targets = {relation.get("Id"): relation.get("Target") for relation in relations}
    pictures = [made.word.files[f"word/{targets[place]}"] for place in places]
    assert len(sizes) == len(pictures) == len(drawings)
    for picture, size in zip(pictures, sizes, strict=True):
        width, height = Image.open(io.BytesIO(picture)).size
        on_page = int(size.get("cx")) / 914400
        assert on_page <= 8.5 - 42.0 / 25.4 + 0.01
        assert width / on_page > 199.0
        assert height / width == pytest.approx(int(size.get("cy")) / int(size.get("cx")), rel=0.01)


def test_nothing_is_left_raw(made):
    for left in ("$", "\\", "{", "}", "frac", "mathrm", "text("):
        assert left not in made.word.text


def test_places_are_named_and_there(made):
    anchors = {WordFile.get(each, "w:name") for each in made.word.all("body", "w:bookmarkStart")}
    links = [
        (WordFile.get(link, "w:anchor"), text_of(link))
        for link in made.word.all("body", "w:hyperlink")
    ]
    named = [(anchor, text) for anchor, text in links if anchor.startswith(("tab-", "fig-", "eq-"))]
    assert len(named) > 20
    for anchor, text in links:
        assert anchor in anchors
        if (anchor, text) in named:
            assert re.fullmatch(r"(Table|Figure)\u00a0\d+|Eq\.\u00a0\(\d+\)", text)


def test_headings_are_headings_with_the_numbers_of_the_page(made):
    found = []
    for paragraph in made.word.all("body", "w:p"):
        style = paragraph.find(f"{name('w:pPr')}/{name('w:pStyle')}")
        if style is not None and WordFile.get(style, "w:val").startswith("heading"):
            found.append((WordFile.get(style, "w:val")[-1], squeezed(text_of(paragraph))))
    expected = [
        (str(int(level) - 1), squeezed(Text(heading).text))
        for level, heading in re.findall(r"<h([23])\s[^>]*>(.*?)</h[23]>", made.page, re.S)
    ]
    assert found == expected


def test_every_page_says_whose_it_is_and_which(made):
    title = made.of("TitleBlock")[0]
    entries = dict(title["entries"]) | dict(title["running"])
    head, foot = (text_of(made.word.parts[part]) for part in ("header", "footer"))
    for label in ("Project", "Element", "Job number"):
        assert entries[label] in head
    for label in ("Revision", "Prepared by", "Checked by", "Date"):
        assert entries[label] in foot
    fields = [WordFile.get(field, "w:instr") for field in made.word.all("footer", "w:fldSimple")]
    assert fields == [" PAGE ", " NUMPAGES "]
    (size,) = made.word.all("body", "w:pgSz")
    assert [WordFile.get(size, f"w:{side}") for side in "wh"] == ["12240", "15840"]
    name_of_file = made.word.all("core", "dc:title")[0].text
    assert name_of_file == f"P<3> & more — Bridge over a road — {title['title']}"


def test_the_same_bytes_twice(made, monkeypatch):
    monkeypatch.setenv("TZ", "Asia/Tokyo")
    again, _ = SheetWordExporter().from_notebook_node(made.notebook)
    assert again == made.content


def test_nothing_of_it_is_elsewhere_while_it_is_written(made, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "nowhere"))
    convert(made.notebook, [tmp_path / "sheet.docx"])
    (file,) = tmp_path.iterdir()
    assert file.read_bytes() == made.content


def test_a_notebook_without_a_title_block_has_a_document_too():
    notebook = v4.new_notebook(cells=[v4.new_markdown_cell("# A lesson\n\nOn $x$ and\n\n$$y^2$$")])
    content, resources = SheetWordExporter().from_notebook_node(notebook)
    word = WordFile(content)
    assert resources["output_extension"] == ".docx"
    assert "A lesson" in word.text
    assert len(word.all("body", "m:oMath")) == 2
    (size,) = word.all("body", "w:pgSz")
    assert [WordFile.get(size, f"w:{side}") for side in "wh"] == ["11906", "16838"]
    assert "Page 1 of 1" in text_of(word.parts["footer"])


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        ("(a + b)^2", r"\left(a + b\right)^2"),
        ("((a) b)^{2} c (d)", r"\left((a) b\right)^{2} c (d)"),
        (r"\left(a\right)^2 (b)", r"\left(a\right)^2 (b)"),
        ("a)^2 (b", "a)^2 (b"),
        ("(a)^2 (b)^3", r"\left(a\right)^2 \left(b\right)^3"),
    ],
)
def test_brackets_raised_to_a_power_are_pairs(formula, expected):
    assert raised_brackets(formula) == expected
