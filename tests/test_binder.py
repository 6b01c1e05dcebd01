"""Many sheets in one PDF: pages, bookmarks, links and tags of each as they were alone."""

import io
import re

import pypdf
import pytest
from nbformat import v4
from pdf_faults import faults
from test_document import BLOCKS, SVG
from test_report import flat, squeezed

from pierimpact.checks import InputError
from pierimpact.report.batch import find_cases
from pierimpact.report.binder import BoundSheet, bind, pages_of
from pierimpact.report.document.blocks import Notice, Paragraph, TitleBlock
from pierimpact.report.document.markup import Ref
from pierimpact.report.document.numbered import Column, Figure, Table
from pierimpact.report.exporters import SheetPDFExporter, notebook_of

HEAD = TitleBlock(
    title="Sheets",
    subtitle="in one",
    entries={"Project": "Viaduct", "Element": "3 sheets", "Job number": "7", "Revision": "B"},
    date="2026-03-01",
    paper="a4",
)


def notebook(element, lines, headings=("One", "Two")):
    """Return a sheet with headings, a table, a drawing, links to them, and lines of text."""
    blocks = [
        TitleBlock(
            title="Sheet", subtitle="x", entries={"Element": element}, date="2026-03-01",
            paper="us-letter",
        ),
        Table(
            label="tab-x", caption="Values.", columns=[Column(heading="a"), Column(heading="b")],
            rows=[[element, "1"]],
        ),
        Paragraph(("As in ", Ref("Table", "tab-x"), " and ", Ref("Figure", "fig-x"))),
        Figure(label="fig-x", caption="Drawing.", alt="A line", svg=SVG),
        *(Paragraph(f"Line {number} of {element}.") for number in range(lines)),
    ]  # fmt: skip
    made = notebook_of(blocks)
    for heading in headings:
        made.cells.insert(len(made.cells) // 2, v4.new_markdown_cell(f"# {heading}"))
    made.cells.append(v4.new_markdown_cell("To [Table](#tab-x) and the heading [One](#one)."))
    return made


@pytest.fixture(scope="module")
def made():
    """Three sheets of different lengths, each alone and all in one."""
    notebooks = {name: notebook(name, lines) for name, lines in (("P1", 90), ("P2", 3), ("P3", 50))}
    alone = {name: SheetPDFExporter().from_notebook_node(n)[0] for name, n in notebooks.items()}
    sheets = [
        BoundSheet(f"Pier {name}", name, each, pages_of(alone[name]))
        for name, each in notebooks.items()
    ]
    notice = Notice(heading="Not calculated", body=["P4.yaml: no speed"])
    return alone, sheets, bind(HEAD, sheets, [notice])


def reader(pdf):
    return pypdf.PdfReader(io.BytesIO(pdf))


def text(page):
    return squeezed(page.extract_text().replace("\u200b", ""))


def starts_of(sheets):
    return [1 + sum(sheet.pages for sheet in sheets[:index]) for index in range(len(sheets))]


def test_every_page_is_there_in_order_with_both_its_numbers(made):
    alone, sheets, binder = made
    pages = list(reader(binder).pages)
    expected = [page for sheet in sheets for page in reader(alone[sheet.case]).pages]
    assert len(pages) == 1 + len(expected)
    assert len({sheet.pages for sheet in sheets}) > 1
    for number, (page, original) in enumerate(zip(pages[1:], expected, strict=True), 2):
        before, _, after = text(page).partition(f",binderpage{number}of{len(pages)}")
        assert before + after == text(original)
        assert page.mediabox == original.mediabox


def test_the_contents_lead_to_the_sheets(made):
    _, sheets, binder = made
    first = reader(binder).pages[0]
    links = [link.get_object() for link in first["/Annots"]]
    pages = [page.indirect_reference.idnum for page in reader(binder).pages]
    assert [pages.index(link["/Dest"][0].indirect_reference.idnum) for link in links] == starts_of(
        sheets
    )
    lines = first.extract_text()
    for sheet, start in zip(sheets, starts_of(sheets), strict=True):
        assert re.search(rf"{sheet.title}\s+{sheet.case}\s+{start + 1}\b", lines)
    assert "P4.yaml: no speed" in lines


def test_bookmarks_of_sheets_and_of_their_headings(made):
    alone, sheets, binder = made
    whole = reader(binder)
    outline = whole.outline
    titles = [each["/Title"] for each in outline if not isinstance(each, list)]
    assert titles == ["Contents", *(f"{sheet.title} ({sheet.case})" for sheet in sheets)]
    own = [each for each in outline if isinstance(each, list)]
    for headings, sheet, start in zip(own, sheets, starts_of(sheets), strict=True):
        original = reader(alone[sheet.case])
        expected = [
            (each["/Title"], original.get_destination_page_number(each) + start, each["/Top"])
            for each in flat(original.outline)
        ]
        assert len(expected) == 2
        assert expected == [
            (each["/Title"], whole.get_destination_page_number(each), each["/Top"])
            for each in flat(headings)
        ]


def test_links_within_a_sheet_stay_in_it(made):
    alone, sheets, binder = made
    whole = reader(binder)

    def targets(document, first, count):
        numbers = [page.indirect_reference.idnum for page in document.pages]
        named = document.named_destinations
        for page in list(document.pages)[first : first + count]:
            for each in page.get("/Annots", []):
                place = each.get_object()["/Dest"]
                if isinstance(place, str):
                    place = named[place].dest_array
                yield (
                    numbers.index(place[0].indirect_reference.idnum) - first,
                    [float(x) for x in place[2:4]],
                )

    for sheet, start in zip(sheets, starts_of(sheets), strict=True):
        expected = list(targets(reader(alone[sheet.case]), 0, sheet.pages))
        assert len(expected) == 4
        assert list(targets(whole, start, sheet.pages)) == expected


@pytest.mark.parametrize("profile", ["2a", "ua1"])
def test_it_conforms_as_its_sheets_do(made, profile):
    assert faults(made[2], profile) == []


def test_tags_are_those_of_the_sheets_each_named_once(made):
    alone, sheets, binder = made

    def kinds(pdf):
        found, ids = [], []

        def visit(element):
            element = element.get_object()
            for each in element if isinstance(element, list) else [element]:
                each = each.get_object()
                if isinstance(each, dict) and "/S" in each:
                    found.append(each["/S"])
                    ids.extend([each["/ID"]] if "/ID" in each else [])
                    visit(each.get("/K", []))

        visit(reader(pdf).root_object["/StructTreeRoot"]["/K"])
        return found, ids

    found, ids = kinds(binder)
    expected = [kind for sheet in sheets for kind in kinds(alone[sheet.case])[0]]
    assert found[-len(expected) :] == expected
    assert len(ids) == len(set(ids)) > 6


def test_labels_and_title_and_the_same_bytes_twice(made):
    _, sheets, binder = made
    whole = reader(binder)
    assert whole.page_labels == [str(n) for n in range(1, len(whole.pages) + 1)]
    assert whole.metadata.title == "3 sheets — Viaduct — Sheets"
    assert bind(HEAD, sheets, [Notice(heading="Not calculated", body=["P4.yaml: no speed"])]) == (
        binder
    )


def test_every_kind_of_block_can_be_bound():
    each = notebook_of([block for block, _ in BLOCKS])
    pages = pages_of(SheetPDFExporter().from_notebook_node(each)[0])
    bound = bind(HEAD, [BoundSheet("all", "all", each, pages)])
    assert pages_of(bound) == 1 + pages
    assert faults(bound, "ua1") == []


def test_a_case_called_as_the_binder_is_refused(tmp_path):
    path = tmp_path / "Binder.yaml"
    assert find_cases([path]) == [path]
    with pytest.raises(InputError, match="would overwrite the binder"):
        find_cases([path], binder=True)
