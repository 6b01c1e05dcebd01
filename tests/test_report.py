"""The report from end to end, on a case in SI units and one in US units full of nasty text."""

import base64
import html
import io
import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path

import nbformat
import papermill
import pypdf
import pytest
import typst
import yaml
from browser_requests import OPTIONS, needs_browser, shown_by_browser
from pdf_faults import LENGTH, faults
from sheet_page import US_CASE
from word_file import WordFile

from pierimpact.checks import InputError
from pierimpact.files.case import read_case_file
from pierimpact.files.unchanged import RECORD
from pierimpact.report import write as report_module
from pierimpact.report.calculation import calculate
from pierimpact.report.document.blocks import TitleBlock
from pierimpact.report.exporters import SheetPDFExporter, compile_typst, notebook_of, typst_string
from pierimpact.report.results import Results
from pierimpact.report.write import ReportError, exporter_for, report_notebook, write_report
from pierimpact.units import printed

EXAMPLE = Path(__file__).parent.parent / "notebooks" / "tti-column.yaml"
NASTY = (
    r"""<b>&amp; #let x = $y$ @ref \ "q" 's' `code` *b* _i_ //x [l](u) ~ = {{x}} ((* x *)) """
    r"""((= x =)) \(z\) <script>alert(1)</script> <!-- Мост через реку Ελλάδα γέφυρα, """
    r"""</style> } @page { content: "x" } { and on and on, to two hundred characters"""
)
NASTY_CASE = US_CASE | {
    "project": NASTY,
    "job_number": "0042",
    "element": r"P<3> & $x_1$ \frac{1}{2}",
    "prepared_by": "Ł & ø",
    "checked_by": "#pagebreak()",
    "revision": "<B>",
    "date": "2026-03-01",
    "sources": {"column_width": NASTY},
    "assumed": {"density": NASTY},
    "notes": [NASTY],
    "annexes": "all",
}


class Text(HTMLParser):
    """What a page shows, what it refers to, and the tags it is made of."""

    def __init__(self, page):
        super().__init__()
        self.shown, self.references, self.tags, self._open = [], [], [], []
        self.feed(page)
        self.text = re.sub(r"\s+", " ", "".join(self.shown))

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        self.references += [
            value for name, value in attributes if name in ("src", "href", "srcset", "action")
        ]
        self._open = [*self._open, tag] if tag in ("style", "script", "title") else self._open

    def handle_endtag(self, tag):
        self._open = [other for other in self._open if other != tag]

    def handle_data(self, data):
        if not self._open:
            self.shown.append(data)


def pdf_text(path):
    return [page.extract_text() for page in pypdf.PdfReader(path).pages]


def squeezed(text):
    """Return text without the spaces that a PDF adds or drops at the ends of lines."""
    return re.sub(r"\s+", "", text)


@pytest.fixture(scope="module")
def si(tmp_path_factory):
    folder = tmp_path_factory.mktemp("si")
    case = folder / "tti-column.yaml"
    case.write_text(EXAMPLE.read_text("utf-8") + "date: 2026-02-03\n", encoding="utf-8")
    return case, write_report(case, folder / "out")


@pytest.fixture(scope="module")
def us(tmp_path_factory):
    folder = tmp_path_factory.mktemp("us")
    case = folder / "us.yaml"
    case.write_text(yaml.safe_dump(NASTY_CASE, allow_unicode=True), encoding="utf-8")
    return case, write_report(case, folder / "out", docx=True)


@pytest.fixture(params=["si", "us"])
def made(request):
    return request.getfixturevalue(request.param)


def test_the_files_of_a_report_and_nothing_else(made):
    case, files = made
    names = {f"{case.stem}.{ending}" for ending in ("ipynb", "html", "pdf")}
    if case.stem == "us":
        names.add("us.docx")
    assert {path.name for path in files.pdf.parent.iterdir()} == names | {RECORD}
    assert {path.name for path in files.files} == names
    assert files.warnings == []


def test_the_peaks_of_the_calculation_are_printed(made):
    case, files = made
    result = calculate(read_case_file(case).case)
    history, system = result.history, result.case.inputs.units
    page, sheet = Text(files.html.read_text("utf-8")).text, " ".join(pdf_text(files.pdf))
    for peak in (history.engine_peak, history.cargo_peak):
        for value, quantity in ((peak.reaction, "force"), (peak.time, "time")):
            number = printed(value, quantity, system).number
            assert number in page
            assert number in sheet
    for value, quantity in (
        (result.pier.stiffness, "stiffness"),
        (result.pier.mass, "mass"),
        (result.pier.frequency, "frequency"),
    ):
        assert squeezed(printed(value, quantity, system).number) in squeezed(page)


def test_the_same_bytes_twice(si, tmp_path):
    case, files = si
    again = write_report(case, tmp_path)
    assert again.html.read_bytes() == files.html.read_bytes()
    assert again.pdf.read_bytes() == files.pdf.read_bytes()


def test_papermill_alone_gives_the_same_sheet(us, tmp_path):
    case, files = us
    output = tmp_path / "out.ipynb"
    papermill.execute_notebook(
        report_notebook(), output, yaml.safe_load(case.read_text("utf-8")), progress_bar=False
    )

    def sheet(path):
        return {
            cell.id: [
                out.data.get("text/html", out.data)
                for out in cell.get("outputs", [])
                if "data" in out
            ]
            for cell in nbformat.read(path, 4).cells
            if "injected-parameters" not in cell.metadata.get("tags", [])
        }

    alone, whole = map(sheet, (output, files.notebook))
    assert set(whole) < set(alone)  # the command leaves out annexes that the case does not ask for
    others = [
        (mine, its)
        for cell in whole
        for mine, its in zip(alone[cell], whole[cell], strict=True)
        if mine != its
    ]
    assert len(others) == 2  # only the command knows the case file, which stands in two places
    for mine, its in others:
        assert "set in the notebook" in mine
        assert case.name in its


def test_the_notebook_carries_the_results_to_the_last_digit(made):
    case, files = made
    assert files.results == Results.of(calculate(read_case_file(case).case))
    assert files.results == Results.in_notebook(nbformat.read(files.notebook, 4))


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"sped": "55 mph"}, "'sped' is not a key of a case file; did you mean speed?"),
        ({"speed": "55"}, "speed must have a unit"),
    ],
)
def test_papermill_alone_finds_bad_parameters(tmp_path, parameters, message):
    with pytest.raises(papermill.PapermillExecutionError, match=re.escape(message)):
        papermill.execute_notebook(
            report_notebook(), tmp_path / "o.ipynb", NASTY_CASE | parameters, progress_bar=False
        )


def test_the_page_asks_for_nothing(made):
    page = Text(made[1].html.read_text("utf-8"))
    assert page.references
    for reference in page.references:
        assert reference.startswith(("#", "data:"))
    assert "url(" not in made[1].html.read_text("utf-8")
    assert not [tag for tag, _ in page.tags if tag in ("script", "link", "iframe")]


@needs_browser
def test_a_browser_makes_no_request(us, tmp_path):
    shown, requests = shown_by_browser(us[1].html, tmp_path)
    assert "Before you rely on this" in shown
    assert requests == set()


CUT = """
<iframe style="width: 400px; height: 900px; border: 0" src="PAGE"></iframe>
<pre id="cut"></pre>
<script>
onload = () => {
  const page = document.querySelector("iframe").contentDocument;
  const cut = [...page.querySelectorAll("main *")].filter(each => {
    for (let box = each; box; box = box.parentElement)
      if (getComputedStyle(box).overflowX === "auto") return false;
    return each.getBoundingClientRect().right > 400.5;
  });
  document.querySelector("#cut").textContent =
    `${page.querySelectorAll("main *").length} ${page.documentElement.scrollWidth} ${cut.length}`;
};
</script>
"""


@needs_browser
def test_a_narrow_screen_cuts_nothing(made, tmp_path):
    (tmp_path / "view.html").write_text(CUT.replace("PAGE", made[1].html.as_uri()), "utf-8")
    done = subprocess.run(
        [
            *OPTIONS.split(), f"--user-data-dir={tmp_path / 'profile'}",
            "--allow-file-access-from-files", (tmp_path / "view.html").as_uri(),
        ],
        capture_output=True, encoding="utf-8", check=True, timeout=600,
    )  # fmt: skip
    elements, width, cut = re.search(r'id="cut">(\d+) (\d+) (\d+)<', done.stdout).groups()
    assert int(elements) > 1000
    assert int(width) <= 400
    assert int(cut) == 0


def test_mathematics_is_mathml_and_nothing_is_left_raw(si):
    text = si[1].html.read_text("utf-8")
    page = Text(text)
    assert sum(tag == "math" for tag, _ in page.tags) > 60
    for left in ("$", "\\", "{", "}", "text(", "frac"):
        assert left not in page.text
    sheet = " ".join(pdf_text(si[1].pdf))
    for left in ("$", "\\", "{", "}", "#", "frac", "tex("):
        assert left not in sheet


def test_no_code_is_shown(made):
    for text in (
        Text(made[1].html.read_text("utf-8")).text,
        " ".join(pdf_text(made[1].pdf)),
    ):
        assert "import " not in text
        assert "calculation)" not in text


def test_text_from_users_prints_as_typed(us):
    _, files = us
    assert len(NASTY) >= 200
    page = Text(files.html.read_text("utf-8"))
    # In the title block, in both tables of sources and among the notes.
    assert squeezed(page.text).count(squeezed(NASTY)) == 4
    assert squeezed(WordFile(files.docx.read_bytes()).text).count(squeezed(NASTY)) == 4
    assert not [tag for tag, _ in page.tags if tag in ("b", "script")]
    sheet = squeezed("".join(pdf_text(files.pdf)))
    for text in (NASTY_CASE["element"], NASTY_CASE["prepared_by"], NASTY_CASE["checked_by"], "<B>"):
        assert squeezed(text) in squeezed(page.text)
        assert squeezed(text) in sheet
    assert squeezed(NASTY) in sheet


NOWHERE = "\U0010fffd"  # for private use: no font has it


def test_what_no_font_has_prints_as_its_number():
    source = f'#set document(title: "x")\n#set text(fallback: true)\n#"גשר {NOWHERE} & {NOWHERE}"'
    pdf, missing = compile_typst(source, "2026-01-31")
    assert missing == NOWHERE
    reader = pypdf.PdfReader(io.BytesIO(pdf))
    assert reader.pages[0].extract_text().count("[U+10FFFD]") == 2
    assert re.search(r"pdfuaid:part>1<", reader.xmp_metadata.stream.get_data().decode())
    assert compile_typst('#set document(title: "x")\n#"Łø Мост"', "2026-01-31")[1] == ""


@pytest.mark.parametrize(
    "text", ["Pier 1️⃣ #2", "Ke᷵ [x]", "שָׁלוֹם עוֹלָם " * 12, "ܫܠܡܐ ܥܠܡܐ " * 15], ids=ascii
)
def test_no_mark_and_no_script_breaks_a_document(text):
    source = f'#set document(title: "x")\n#set text(fallback: true)\n#{typst_string(text)}'
    pdf, missing = compile_typst(source, "2026-01-31")
    printed = squeezed(pypdf.PdfReader(io.BytesIO(pdf)).pages[0].extract_text())
    assert not any(c.isascii() for c in missing)
    assert set(filter(str.isascii, squeezed(text))) <= set(printed)


def test_no_word_runs_over_what_stands_beside_it():
    word = "R" * 200
    entries = {"Project": "x", "Element": word, "Job number": "7"}
    title = TitleBlock(title="x", subtitle="y", entries=entries, date="2026-03-01", paper="a4")
    pdf, _ = SheetPDFExporter().from_notebook_node(notebook_of([title]))
    text = pypdf.PdfReader(io.BytesIO(pdf)).pages[0].extract_text().replace("\u200b", "")
    # In the title block and, as it is never cut, in the header of the page.
    assert squeezed(text).count(word) == 2
    lines = [len(line) for line in re.findall("R+", text)]
    assert max(lines) < 60  # of about 100 letters across the page


def test_what_no_font_has_is_told(us):
    text = us[1].notebook.read_text("utf-8").replace("Ł & ø", NOWHERE)
    _, resources = SheetPDFExporter().from_notebook_node(nbformat.reads(text, 4))
    (warning,) = resources["warnings"]
    assert warning.startswith("no font here has U+10FFFD: it prints as its number in the PDF")


def test_every_page_says_whose_it_is_and_which(made):
    case, files = made
    inputs = read_case_file(case).case.inputs
    pages = pdf_text(files.pdf)
    assert len(pages) > 3
    for number, text in enumerate(pages, 1):
        for entry in (inputs.project[:30], inputs.job_number, inputs.element, inputs.revision):
            assert squeezed(entry) in squeezed(text)
        assert str(inputs.date) in text
        assert f"Page {number} of {len(pages)}" in text


def test_numbers_of_equations_tables_and_figures(made):
    text = made[1].html.read_text("utf-8")
    sheet = "".join(pdf_text(made[1].pdf))
    for kind in ("Table", "Figure"):
        numbers = re.findall(rf"{kind}&nbsp;(\d+)\.</span>", text)
        assert numbers == [str(n) for n in range(1, len(numbers) + 1)]
        assert re.findall(rf"{kind} (\d+)\. ", sheet) == numbers
    equations = re.findall(r'class="number">\((\d+)\)<', text)
    assert equations == [str(n) for n in range(1, len(equations) + 1)]
    assert len(equations) > (60 if "Annex A" in text else 8)
    found = [n for n in re.findall(r"\((\d+)\)\s*$", sheet, re.MULTILINE) if n in equations]
    assert found[-1] == equations[-1] or f"({equations[-1]})" in sheet
    assert f"({len(equations) + 1})" not in sheet


def test_no_drawing_stands_among_what_comes_after_its_part(made):
    page = made[1].html.read_text("utf-8")
    _, *parts = page.split("<h2 data-number")
    tables = [re.findall(r"(Table)&nbsp;(\d+\.)</span>", part) for part in parts]
    drawings = [re.findall(r"(Figure)&nbsp;(\d+\.)</span>", part) for part in parts]
    assert sum(map(len, drawings)) == (9 if "Annex A" in page else 7)
    for text in pdf_text(made[1].pdf):
        for index, part in enumerate(drawings):
            after = [" ".join(name) for names in tables[index + 1 :] for name in names]
            for drawing in map(" ".join, part):
                before, found, _ = text.partition(f"{drawing} ")
                assert not (found and any(f"{name} " in before for name in after))


def test_every_place_that_is_named_has_its_number(made):
    text = made[1].html.read_text("utf-8")
    anchors = set(re.findall(r' id="([^"]+)"', text))
    links = re.findall(r'<a\s+href="#([^"]+)">(.*?)</a>', text)
    assert {anchor for anchor, _ in links} <= anchors
    named = [words for anchor, words in links if anchor.startswith(("tab-", "fig-", "eq-"))]
    assert len(named) > (80 if "Annex A" in text else 0)
    for words in named:
        assert re.fullmatch(r"(Table|Figure)&nbsp;\d+|Eq\.&nbsp;\(\d+\)", words)
    sheet = " ".join(pdf_text(made[1].pdf))
    assert not re.search(r"(those of|values of|and) Table[^\s\d]", sheet)


def test_us_reports_print_no_metric_unit(us):
    text = Text(us[1].html.read_text("utf-8")).text
    own = text.replace("Generic 8 t single-unit truck", "")  # as the truck's file describes it
    own = own[: own.index("The case as it was read")]  # the files are as they are
    own = re.sub(r"\([\d.]+ \S+\)|given as [\d\u202f., A-Za-z]+|cited as [\d.]+ m", "", own)
    metric = r"(?<![\w.])\d[\d.\u202f]*\s(kN|MN|GPa|m|mm|kg|km/h|t|kN·m|MN/m|kg/m³)(?![\w/·-])"
    # What was given in metric units says so, behind its value in the sheet's own.
    given = r"\d[\d.\s]*\s[kMG]?[\w·/³]+"
    own = re.sub(rf"(given as|cited as) {given}(, {given})*|\({given}\)", "", own)
    assert [match[0] for match in re.finditer(metric, own)] == []


def test_figures_are_vectors_with_words_for_them(made):
    page = Text(made[1].html.read_text("utf-8"))
    images = [attributes for tag, attributes in page.tags if tag == "img"]
    assert images
    for image in images:
        assert len(image["alt"]) > 40
        kind, _, data = image["src"].partition(";base64,")
        assert kind == "data:image/svg+xml"
        assert b"<image" not in base64.b64decode(data)
    assert [image for page in pypdf.PdfReader(made[1].pdf).pages for image in page.images] == []


def test_the_page_has_landmarks_and_table_heads(made):
    tags = Text(made[1].html.read_text("utf-8")).tags
    assert [tag for tag, _ in tags].count("main") == 1
    assert [tag for tag, _ in tags].count("h1") == 1
    heads = [attributes for tag, attributes in tags if tag == "th"]
    assert heads
    assert {attributes["scope"] for attributes in heads} == {"col", "row"}
    assert dict(tags)["html"] == {"lang": "en"}


@pytest.mark.parametrize("profile", ["2a", "ua1"])
def test_a_validator_of_others_finds_no_fault(made, profile):
    assert faults(made[1].pdf.read_bytes(), profile) == []


def test_a_stream_of_another_length_than_it_says_is_a_fault(made):
    pdf = made[1].pdf.read_bytes()
    length = re.search(rb"(?<=/Length )\d{4}", pdf)
    wrong = str(int(length[0]) - 1).encode().zfill(4)
    assert LENGTH in faults(pdf[: length.start()] + wrong + pdf[length.end() :], "2a")


def test_that_validator_finds_faults():
    plain = typst.compile(b"A line")
    for profile in ("2a", "ua1"):
        assert faults(plain, profile)


def test_each_file_is_called_by_its_element(si, us):
    titles = [pypdf.PdfReader(files.pdf).metadata.title for _, files in (si, us)]
    assert titles[0] == (
        "Round column, 36 in — Full-scale tests of TTI 9-4973-2, the column as a bridge column — "
        "Truck collision with a bridge pier"
    )
    assert titles[1].startswith(f"{NASTY_CASE['element']} — {NASTY[:40]}")
    for (_, files), title in zip((si, us), titles, strict=True):
        (shown,) = re.findall("<title>(.*?)</title>", files.html.read_text("utf-8"), re.DOTALL)
        assert html.unescape(shown) == title


def test_every_heading_is_a_bookmark(made):
    outline = [each["/Title"] for each in flat(pypdf.PdfReader(made[1].pdf).outline)]
    headings = re.findall(r"<h([23])\s[^>]*>(.*?)</h[23]>", made[1].html.read_text("utf-8"), re.S)
    found = [squeezed(title) for title in outline]
    assert found == [squeezed(Text(heading).text) for _, heading in headings]


def flat(outline):
    """Return the entries of an outline, those below others after them."""
    return [e for each in outline for e in (flat(each) if isinstance(each, list) else [each])]


def test_the_pdf_says_what_it_conforms_to(made):
    reader = pypdf.PdfReader(made[1].pdf)
    metadata = reader.xmp_metadata.stream.get_data().decode()
    assert re.search(r"pdfaid:part>2<", metadata)
    assert re.search(r"pdfuaid:part>1<", metadata)
    fonts = {
        font["/BaseFont"]
        for page in reader.pages
        for font in (entry.get_object() for entry in page["/Resources"]["/Font"].values())
    }
    # All of them embedded in Typst or shipped with matplotlib, none of the system.
    assert {re.sub(r"^/[A-Z]{6}\+|-.*", "", font) for font in fonts} <= {
        "LibertinusSerif",
        "NewCMMath",
        "DejaVuSans",
        "DejaVuSansMono",
    }


def test_assumptions_and_the_status_of_the_truck_are_in_sight(si):
    text = html.unescape(Text(si[1].html.read_text("utf-8")).text)
    summary = text[: text.index("Equivalent pier")]
    assert "single-unit-8t is illustrative" in summary
    assert "not Table 1 of the source paper" in summary
    assert "not a prediction of the tests" in summary
    assert "Assumed, not given by any source" in summary
    assert "column height" in summary


def test_a_bad_case_writes_nothing(tmp_path):
    case = tmp_path / "case.yaml"
    case.write_text("speed: 80\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"^case\.yaml: "):
        write_report(case, tmp_path / "out")
    assert [path.name for path in tmp_path.iterdir()] == ["case.yaml"]


def test_a_folder_that_cannot_be(si, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="must be a folder, and there is a file"):
        write_report(si[0], tmp_path / "file")


def test_a_failing_notebook_is_kept_and_named(si, tmp_path, monkeypatch):
    notebook = nbformat.read(report_notebook(), 4)
    notebook.cells[-1].source = "raise ValueError('the last cell')"
    broken = tmp_path / "broken.ipynb"
    nbformat.write(notebook, broken)
    monkeypatch.setattr(report_module, "report_notebook", lambda: broken)
    before = tmp_path / "out" / "tti-column.pdf"
    before.parent.mkdir()
    before.write_bytes(b"of the last time")
    with pytest.raises(ReportError, match="ValueError: the last cell") as caught:
        write_report(si[0], tmp_path / "out", force=True)
    kept = tmp_path / "out" / "tti-column.failed.ipynb"
    assert str(kept) in str(caught.value)
    assert "\n" not in str(caught.value)
    assert sorted(before.parent.iterdir()) == [before.with_name(RECORD), kept, before]
    assert before.read_bytes() == b"of the last time"
    assert nbformat.read(kept, 4).cells[-1].outputs[0].ename == "ValueError"


@pytest.mark.parametrize("deaths", [1, 2])
def test_a_kernel_that_does_not_start_is_started_once_more(si, tmp_path, monkeypatch, deaths):
    execute, calls = papermill.execute_notebook, []

    def dies(*arguments, **options):
        calls.append(arguments)
        if len(calls) <= deaths:
            raise RuntimeError("Kernel died before replying to kernel_info")
        return execute(*arguments, **options)

    monkeypatch.setattr(papermill, "execute_notebook", dies)
    if deaths == 1:
        write_report(si[0], tmp_path)
    else:
        with pytest.raises(ReportError, match=r"^tti-column\.yaml: RuntimeError: Kernel died"):
            write_report(si[0], tmp_path)
    assert len(calls) == 2
    assert (tmp_path / "tti-column.pdf").exists() == (deaths == 1)


def test_a_kernel_that_dies_at_work_is_not_started_again(si, tmp_path, monkeypatch):
    notebook = nbformat.read(report_notebook(), 4)
    notebook.cells[1].source = "import os; os._exit(1)"
    deadly = tmp_path / "deadly.ipynb"
    nbformat.write(notebook, deadly)
    monkeypatch.setattr(report_module, "report_notebook", lambda: deadly)
    with pytest.raises(ReportError, match="Kernel died"):
        write_report(si[0], tmp_path / "out")
    assert not (tmp_path / "out" / "tti-column.pdf").exists()


def test_a_failing_conversion_leaves_no_half_report(si, tmp_path, monkeypatch):
    templates = tmp_path / "templates"
    shutil.copytree(Path(__file__).parent.parent / "templates", templates)
    (templates / "pierimpact-pdf" / "index.typ.j2").write_text("#nonsense")
    monkeypatch.setattr("pierimpact.report.exporters.shipped", lambda _: templates)
    exporter_for.cache_clear()
    with pytest.raises(ReportError, match="unknown variable: nonsense"):
        write_report(si[0], tmp_path / "out")
    exporter_for.cache_clear()
    left = {path.name for path in (tmp_path / "out").iterdir()}
    assert left == {"tti-column.failed.ipynb", RECORD}


def test_the_stored_notebook_has_no_outputs():
    for path in EXAMPLE.parent.glob("*.ipynb"):
        for cell in nbformat.read(path, 4).cells:
            if cell.cell_type == "code":
                assert (cell.outputs, cell.execution_count) == ([], None)
