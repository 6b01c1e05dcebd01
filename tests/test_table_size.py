"""Tables that are kept whole fit on their page, and others are broken over pages: none is cut."""

import io

import pypdf
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pierimpact.report.document.blocks import Paragraph, TitleBlock
from pierimpact.report.document.markup import Tex
from pierimpact.report.document.numbered import Column, Table
from pierimpact.report.document.table_size import WHOLE, column_widths, is_whole, lines_of
from pierimpact.report.exporters import SheetPDFExporter, notebook_of

FOOT = 21.0 / 25.4 * 72.0  # lower margin of the page [pt]

WORDS = st.lists(st.sampled_from(["pier", "truck", "stiffness", "0.05"]), max_size=30).map(" ".join)
CELLS = WORDS | st.sampled_from([Tex(r"\frac{a}{b}"), Tex("z_n"), "1.5"])


def table_of(rows, wide=()):
    columns = [Column(heading=f"Head {i}", wide=i in wide) for i in range(len(rows[0]))]
    return Table(label="tab-x", caption="The table.", columns=columns, rows=rows)


@st.composite
def tables(draw):
    count = draw(st.integers(1, 6))
    rows = draw(st.lists(st.lists(CELLS, min_size=count, max_size=count), min_size=1, max_size=26))
    wide = draw(st.sets(st.integers(0, count - 1), max_size=1))
    return table_of([[f"row{i}", *row] for i, row in enumerate(rows)], {i + 1 for i in wide})


def pages_of(table, paper):
    """Return words with their heights [pt], of each page that the table has a row on."""
    title = TitleBlock(title="T", subtitle="", entries={}, date="2026-01-31", paper=paper)
    before = [Paragraph("Words of a page. " * 20)] * 8
    pdf, _ = SheetPDFExporter().from_notebook_node(notebook_of([title, *before, table]))
    pages = []
    for page in pypdf.PdfReader(io.BytesIO(pdf)).pages:
        rows = []

        def note(text, page_at, at, *_, rows=rows):
            if "row" in text:
                rows.append((text, at[4] * page_at[1] + at[5] * page_at[3] + page_at[5]))

        page.extract_text(visitor_text=note)
        pages.append(rows)
    return [page for page in pages if page]


@settings(max_examples=25, deadline=None)
@given(tables(), st.sampled_from(["a4", "us-letter"]))
def test_no_row_is_below_the_page_and_a_low_table_is_on_one(table, paper):
    pages = pages_of(table, paper)
    found = " ".join(text for page in pages for text, _ in page).split()
    assert set(found) >= {f"row{i}" for i in range(len(table.rows))}
    assert min(height for page in pages for _, height in page) > FOOT
    if is_whole(table.data()):
        assert len(pages) == 1


@pytest.mark.parametrize("rows", [WHOLE, 60])
def test_a_table_of_many_rows_is_broken_and_one_of_fewer_is_not(rows):
    table = table_of([[f"row{i}", "short"] for i in range(rows)])
    assert lines_of(table.data()) == rows
    assert (len(pages_of(table, "a4")) > 1) == (rows > WHOLE)


@given(tables())
def test_rows_take_a_line_at_least_and_more_words_take_no_fewer(table):
    lines = lines_of(table.data())
    assert lines >= len(table.rows)
    first, *others = table.rows
    longer = table_of([[*first[:-1], "stiffness " * 60], *others])
    assert lines_of(longer.data()) >= lines_of(table_of(table.rows).data())
    assert all(width > 0.0 for width in column_widths(table.data()))
