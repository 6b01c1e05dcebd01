"""Sheets bound into one PDF, with bookmarks, contents and tags, PDF/A-2a and PDF/UA-1 as they are.

Typst sets each document; here their pages, tags and bookmarks are put one behind the other.
"""

import hashlib
import io
import itertools
import os
import re
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any, NamedTuple

import nbformat
from nbformat import NotebookNode
from pypdf import PdfReader, PdfWriter
from pypdf.generic import (
    ArrayObject,
    ByteStringObject,
    DictionaryObject,
    IndirectObject,
    NameObject,
    NullObject,
    NumberObject,
    StreamObject,
    TextStringObject,
)

from pierimpact.files.inputs import NOT_GIVEN
from pierimpact.report.document.blocks import Block, Notice, TitleBlock
from pierimpact.report.document.markup import Inline, PageLink
from pierimpact.report.document.numbered import Table, columns, decimal, wide
from pierimpact.report.exporters import notebook_of
from pierimpact.report.write import Report, exporter_for


class BoundSheet(NamedTuple):
    """A document of a binder."""

    title: str  #: what it is of
    case: str  #: name of its files
    notebook: NotebookNode
    pages: int  #: of the document
    revision: str = ""

    @property
    def bookmark(self) -> str:
        """The words of the document's bookmark."""
        return self.title if self.title == self.case else f"{self.title} ({self.case})"


def bound_reports(
    reports: Sequence[Report], summary: Sequence[Block], *, with_summary: bool
) -> bytes:
    """Return the sheets of reports as one PDF.

    Parameters
    ----------
    reports : sequence of Report
        The reports, in their order.
    summary : sequence of Block
        The blocks of their summary; the binder takes its title block and its notices from them.
    with_summary : bool
        Whether the summary stands before the sheets.
    """
    stored: Any = nbformat
    sheets = [
        BoundSheet(
            report.results.element if report.results.element != NOT_GIVEN else report.pdf.stem,
            report.pdf.stem,
            stored.read(report.notebook, 4),
            pages_of(report.pdf.read_bytes()),
            report.results.revision,
        )
        for report in reports
    ]
    if with_summary:
        notebook = notebook_of(summary)
        pages = pages_of(_pdf(notebook, (0, 1)))
        sheets.insert(0, BoundSheet("Summary", "all", notebook, pages))
    (head,) = (block for block in summary if isinstance(block, TitleBlock))
    title = replace(
        head,
        title="Calculation sheets",
        subtitle="Truck collisions with bridge piers: all sheets in one",
        landscape=False,
    )
    return bind(title, sheets, [block for block in summary if isinstance(block, Notice)])


def bind(title: TitleBlock, sheets: Sequence[BoundSheet], more: Sequence[Block] = ()) -> bytes:
    """Return documents as one PDF, a page with their contents first.

    Parameters
    ----------
    title : TitleBlock
        Head of the contents.
    sheets : sequence of BoundSheet
        The documents, in their order.
    more : sequence of Block, optional
        What the first page says beside the contents.
    """

    def contents(starts: Sequence[int]) -> NotebookNode:
        rows: list[list[Inline]] = [
            [PageLink(sheet.title, start), sheet.case, sheet.revision, str(start)]
            for sheet, start in zip(sheets, starts, strict=True)
        ]
        heads = columns(wide("Sheet"), "Case", "Revision", decimal("Page"))
        table = Table(label="tab-contents", caption="Contents.", columns=heads, rows=rows)
        return notebook_of([title, table, *more])

    first = pages_of(_pdf(contents([1] * len(sheets)), (0, 1)))
    before = list(itertools.accumulate((sheet.pages for sheet in sheets), initial=first))
    pages = before.pop()
    front = _pdf(contents([start + 1 for start in before]), (0, pages))
    with ThreadPoolExecutor(os.cpu_count()) as executor:
        notebooks, places = [sheet.notebook for sheet in sheets], [(n, pages) for n in before]
        bound = list(executor.map(_pdf, notebooks, places))
    return _joined(front, [(own.bookmark, pdf) for own, pdf in zip(sheets, bound, strict=True)])


def _pdf(notebook: NotebookNode, place: tuple[int, int]) -> bytes:
    """Return a document with so many pages before it, in a binder of so many in all."""
    pdf: bytes = exporter_for(".pdf").from_notebook_node(notebook, {"binder": place})[0]
    return pdf


def pages_of(pdf: bytes) -> int:
    """Return the number of a document's pages."""
    return len(PdfReader(io.BytesIO(pdf)).pages)


def _joined(front: bytes, others: Sequence[tuple[str, bytes]]) -> bytes:
    """Return PDFs by Typst one behind the other, tags and bookmarks included.

    Title and metadata are those of the first. The bytes are the same for the same documents.
    """
    writer = PdfWriter(clone_from=io.BytesIO(front))
    writer.pdf_header = "%PDF-1.7"
    root: Any = writer.root_object
    tags, pages = root["/StructTreeRoot"], root["/Pages"]
    for name in ("/Outlines", "/Names"):
        root.pop(name, None)
    outline = _added(writer, {"/Type": NameObject("/Outlines")})
    root[NameObject("/Outlines")] = outline.indirect_reference
    bookmarks = [_bookmark(writer, "Contents", pages["/Kids"][0])]
    for number, (title, pdf) in enumerate(others, 1):
        reader = PdfReader(io.BytesIO(pdf))
        own: Any = reader.root_object
        tree = own["/StructTreeRoot"]
        first_key = int(tags["/ParentTreeNextKey"])
        bookmark = _bookmark(writer, title, None)
        copied = _Copied(reader, writer, first_key, f"{number}-")
        for name, place in (("/Pages", pages), ("/StructTreeRoot", tags), ("/Outlines", bookmark)):
            if name in own:
                copied.known[own.raw_get(name).idnum] = place.indirect_reference
        added = [copied.of(page.indirect_reference) for page in reader.pages]
        pages["/Kids"].extend(added)
        pages[NameObject("/Count")] = NumberObject(len(pages["/Kids"]))
        tags["/K"].extend(copied.of(tree["/K"]))
        tags["/RoleMap"].update(copied.of(tree["/RoleMap"]))
        owners = tree["/ParentTree"]["/Nums"]
        for key, owner in zip(owners[::2], owners[1::2], strict=True):
            tags["/ParentTree"]["/Nums"].extend([NumberObject(key + first_key), copied.of(owner)])
        tags[NameObject("/ParentTreeNextKey")] = NumberObject(
            first_key + tree["/ParentTreeNextKey"]
        )
        bookmark[NameObject("/Dest")] = _top_of(added[0])
        if reader.outline:
            for name in ("/First", "/Last"):
                bookmark[NameObject(name)] = copied.of(own["/Outlines"].raw_get(name))
            bookmark[NameObject("/Count")] = NumberObject(-len(reader.outline))  # closed
        bookmarks.append(bookmark)
        copied.finish()
    _chain(outline, bookmarks)
    _finish(writer, front + b"".join(pdf for _, pdf in others))
    written = io.BytesIO()
    writer.write(written)
    return written.getvalue()


class _Copied:
    """Objects of a document as those of another, each once, with their tags named anew."""

    def __init__(self, reader: PdfReader, writer: PdfWriter, first_key: int, prefix: str) -> None:
        self.reader, self.writer, self.first_key, self.prefix = reader, writer, first_key, prefix
        self.known: dict[int, IndirectObject] = {}  #: by their numbers in the other document
        self._waiting: list[tuple[Any, Any]] = []
        names: Any = reader.root_object.get("/Names", {}).get("/Dests", {}).get("/Names", [])
        self._places = dict(zip(map(str, names[::2]), names[1::2], strict=True))

    def of(self, thing: Any) -> Any:
        """Return the copy of an object; of a reference, one to a copy that `finish` makes."""
        if isinstance(thing, IndirectObject):
            if thing.idnum not in self.known:
                original: Any = thing.get_object()
                copy = type(original)() if isinstance(original, DictionaryObject) else None
                place = NullObject() if copy is None else copy
                self.known[thing.idnum] = self.writer._add_object(place)
                self._waiting.append((thing.idnum, original))
            return self.known[thing.idnum]
        if isinstance(thing, ArrayObject):
            return ArrayObject(map(self.of, thing))
        if isinstance(thing, DictionaryObject):
            return self._filled(DictionaryObject(), thing)
        return thing

    def _filled(self, copy: Any, original: Any) -> Any:
        """Return a copy of a dictionary or stream with its contents."""
        for name, value in original.items():
            copy[NameObject(name)] = self._renamed(name, self.of(value), original)
        if isinstance(original, StreamObject):
            copy._data = original._data
        return copy

    def _renamed(self, name: str, value: Any, holder: Any) -> Any:
        """Return a value of a dictionary; names and numbers that other documents use become others.

        Those are the keys of tags, their names, and places that a link leads to.
        """
        if name in ("/StructParents", "/StructParent"):
            return NumberObject(value + self.first_key)
        if name == "/ID" and holder.get("/Type") == "/StructElem":
            return TextStringObject(self.prefix + value)
        if name == "/Headers":
            return ArrayObject(TextStringObject(self.prefix + header) for header in value)
        if name == "/Dest" and isinstance(value, str):
            return self.of(self._places[value])
        return value

    def finish(self) -> None:
        """Copy all that is referred to."""
        while self._waiting:
            number, original = self._waiting.pop()
            place = self.known[number]
            if isinstance(original, DictionaryObject):
                self._filled(place.get_object(), original)
            else:
                self.writer._objects[place.idnum - 1] = self.of(original)


def _added(writer: PdfWriter, entries: dict[str, Any]) -> Any:
    """Return a new dictionary of a document."""
    new = DictionaryObject({NameObject(name): value for name, value in entries.items()})
    return writer._add_object(new).get_object()


def _top_of(page: Any) -> ArrayObject:
    return ArrayObject([page, NameObject("/Fit")])


def _bookmark(writer: PdfWriter, title: str, page: Any) -> Any:
    bookmark = _added(writer, {"/Title": TextStringObject(title)})
    if page is not None:
        bookmark[NameObject("/Dest")] = _top_of(page)
    return bookmark


def _chain(outline: Any, bookmarks: Sequence[Any]) -> None:
    """Make bookmarks the entries of an outline."""
    references = [bookmark.indirect_reference for bookmark in bookmarks]
    for bookmark in bookmarks:
        bookmark[NameObject("/Parent")] = outline.indirect_reference
    for before, after in itertools.pairwise(bookmarks):
        before[NameObject("/Next")] = after.indirect_reference
        after[NameObject("/Prev")] = before.indirect_reference
    outline[NameObject("/First")], outline[NameObject("/Last")] = references[0], references[-1]
    outline[NameObject("/Count")] = NumberObject(len(bookmarks))


def _finish(writer: PdfWriter, documents: bytes) -> None:
    """Lead the links of the contents to their pages, and complete what is said of the whole."""
    root: Any = writer.root_object
    kids = root["/Pages"]["/Kids"]
    ids = []
    for each in list(writer._objects):
        if not isinstance(each, DictionaryObject):
            continue
        if isinstance(each, StreamObject) and each._data.endswith(b"\r"):
            each._data += b"\n"  # or else this end and that of the line count as one
        address = str(each.get("/A", {}).get("/URI", "")) if each.get("/Subtype") == "/Link" else ""
        if address.startswith("page:"):
            del each["/A"]
            page = int(address.removeprefix("page:"))
            each[NameObject("/Dest")] = _top_of(kids[page - 1])
        if each.get("/Type") == "/StructElem" and "/ID" in each:
            ids.append((each["/ID"], each.indirect_reference))
    ids.sort(key=lambda pair: str(pair[0]))
    root["/StructTreeRoot"][NameObject("/IDTree")] = DictionaryObject(
        {NameObject("/Names"): ArrayObject(itertools.chain.from_iterable(ids))}
    )
    decimal_numbers = DictionaryObject({NameObject("/S"): NameObject("/D")})
    root[NameObject("/PageLabels")] = DictionaryObject(
        {NameObject("/Nums"): ArrayObject([NumberObject(0), decimal_numbers])}
    )
    identity = hashlib.sha256(documents).digest()[:16]
    writer._ID = ArrayObject([ByteStringObject(identity)] * 2)
    metadata = root["/Metadata"]
    xmp = metadata.get_data().decode()
    for name, value in (
        ("xmpTPg:NPages", str(len(kids))),
        ("xmpMM:InstanceID", identity.hex()),
        ("xmpMM:DocumentID", identity.hex()),
    ):
        xmp = re.sub(rf"(<{name}>).*?(</{name}>)", rf"\g<1>{value}\g<2>", xmp)
    metadata.set_data(xmp.encode())
