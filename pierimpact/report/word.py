"""From an executed notebook to a Word document: native equations and tables, drawings as pictures.

An nbconvert exporter, as those of HTML and PDF are: `jupyter nbconvert --to pierimpact_docx
NOTEBOOK` works too. The template writes HTML with the LaTeX of the mathematics in it, and pandoc
turns that into a document in the styles of a reference document that is made here.
"""

import base64
import html
import io
import os
import re
import tempfile
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import typst
from nbformat import NotebookNode

from pierimpact.report.document.line_breaks import broken, formula_width, unpaired_as_text
from pierimpact.report.document.numbered import CONTINUED
from pierimpact.report.document.table_size import column_widths
from pierimpact.report.exporters import (
    SheetHTMLExporter,
    font_folder,
    pandoc,
    parts_of,
    typst_bytes,
    typst_string,
)

_TYPE = "application/vnd.openxmlformats-officedocument.wordprocessingml"
_CONTENT_TYPE = f'<Override PartName="/word/{{0}}.xml" ContentType="{_TYPE}.{{0}}+xml"/>'
_RELATION = (
    '<Relationship Id="{0}" Target="{0}.xml" '
    'Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/{0}"/>'
)
_COMPATIBLE = (  # with Word of 2013 and after; or else Word lays it out as that of 2007 did
    '<w:compat><w:compatSetting w:name="compatibilityMode" w:val="15" '
    'w:uri="http://schemas.microsoft.com/office/word"/></w:compat>'
)
# Of what pandoc writes: equations start at the left, drawings at the margin, and no row of a table
# is parted by the end of a page, which LibreOffice takes from no style.
_INSTEAD = {
    '<m:jc m:val="center" />': '<m:jc m:val="left" />',
    "<w:tr><w:tc>": "<w:tr><w:trPr><w:cantSplit /></w:trPr><w:tc>",
    "<w:trPr><w:tblHeader": "<w:trPr><w:cantSplit /><w:tblHeader",
    "<wp:inline>": '<wp:inline distT="0" distB="0" distL="0" distR="0">',
}
_PAPER = {"a4": (11906, 16838), "us-letter": (12240, 15840)}  # twentieths of a point
_SIDES = 1247 + 1134  # margins, as in the template of the page
_INCH = 2.54  # exactly [cm]
_DOTS = 200  # of a drawing, an inch; this project's choice
_NO_OPERAND = "\\text{\u2003}"  # before a sign: LibreOffice wants something there
# Figures of a formula on a line of the page, and beside the name of a step: by eye, as LibreOffice
# sets them, at 12 pt whatever the style says; this project's choice.
_ROOM, _ROOM_BESIDE = 54, 38


class SheetWordExporter(SheetHTMLExporter):
    """A Word document: equations, tables and headings are Word's own."""

    export_from_notebook = "pierimpact: calculation sheet, Word"
    output_mimetype = f"{_TYPE}.document"
    template_name = "pierimpact-docx"
    pandoc_options = ("--to=html5", "--mathjax", "--number-sections", "--shift-heading-level-by=1")

    def _create_environment(self) -> Any:
        environment = super()._create_environment()
        environment.filters["column_widths"] = column_widths
        return environment

    def _blocks(self, nb: NotebookNode) -> Iterator[dict[str, Any]]:
        # Each line of a step is an equation of its own: a reader of Word files that knows no
        # alignment marks then shows none.
        for block in super()._blocks(nb):
            for part in parts_of(block):
                if part["type"] == "Equation":
                    lines = equation_lines(part["symbol"], part["lines"])
                    part["long"] = max(map(formula_width, lines)) > _ROOM_BESIDE
                    part["tex"] = "$$\n\n$$".join(lines)
                elif part["type"] == "Tex":
                    part["source"] = raised_brackets(part["source"])
            yield block

    def _sheet(self, nb: NotebookNode) -> dict[str, Any]:
        sheet = super()._sheet(nb)
        sheet["size"] = _PAPER[sheet["paper"]][:: -1 if sheet["landscape"] else 1]
        drawn = [part for part in parts_of(sheet["blocks"]) if part.get("svg") or part.get("logo")]
        pictures = _pictures(drawn)
        for part, picture in zip(drawn, pictures, strict=True):
            dots = int.from_bytes(picture[16:20])  # the width, in the head of a PNG
            part |= {
                "png": base64.b64encode(picture).decode(),
                "width": round(_INCH * dots / _DOTS, 3),
                "most": round(_INCH / 1440 * (sheet["size"][0] - _SIDES), 3),
            }
        return sheet

    def _pandoc(self, reader: str, pieces: list[str]) -> list[str]:
        # Pandoc's reader takes LaTeX in a script element for mathematics, and elsewhere not.
        def script(math: re.Match[str]) -> str:
            kind = "math/tex" + ("; mode=display" if math[1] == "display" else "")
            return f'<script type="{kind}">{html.unescape(math[2])}</script>'

        marked = re.compile(r'<span\s+class="math (\w+)">\\[(\[](.*?)\\[)\]]</span>', re.DOTALL)
        return [marked.sub(script, piece) for piece in super()._pandoc(reader, pieces)]

    def from_notebook_node(
        self, nb: NotebookNode, resources: Any = None, **kw: Any
    ) -> tuple[Any, dict[str, Any]]:
        """Return the notebook as a Word document, and nbconvert's resources."""
        source, resources = super().from_notebook_node(nb, resources, **kw)
        resources["output_extension"] = ".docx"
        sheet = resources["sheet"]
        folder = Path(self.extra_template_basedirs[0]) / self.template_name
        entries = dict(sheet["running"]) | dict(sheet["entries"])
        day = datetime.fromisoformat(f"{sheet['date']}T00:00:00").replace(tzinfo=UTC)
        with tempfile.TemporaryDirectory(dir=resources.get("temporary_folder")) as place:
            here = Path(place)
            (here / "reference.docx").write_bytes(self._reference(sheet))
            pandoc(
                *("--from=html", "--to=docx", "--output=sheet.docx"),
                *("--shift-heading-level-by=-1", "--reference-doc=reference.docx"),
                *(f"--template={folder / 'template.xml'}", "--metadata=lang:en-GB"),
                f"--metadata=title:{sheet['document_title']}",
                f"--metadata=author:{entries.get('Prepared by', '')}",
                text=source,
                cwd=here,
                env=os.environ | {"SOURCE_DATE_EPOCH": f"{day.timestamp():.0f}"},
            )
            document = (here / "sheet.docx").read_bytes()
        body = _parts_in(document)["word/document.xml"].decode()
        for pandocs, own in _INSTEAD.items():
            body = body.replace(pandocs, own)
        return _rewritten(document, {"word/document.xml": body}), resources

    def _reference(self, sheet: dict[str, Any]) -> bytes:
        """Return pandoc's reference document with the styles, page and running text of a sheet."""
        reference = pandoc("--print-default-data-file=reference.docx")
        width, height = sheet["size"]
        entries = dict(sheet["running"]) | dict(sheet["entries"])
        parts = {
            f"word/{name}.xml": str(
                self.environment.get_template(f"{name}.xml.j2").render(
                    width=width, height=height, full=width - _SIDES, entries=entries
                )
            )
            for name in ("styles", "document", "header", "footer")
        }
        default = _parts_in(reference)
        running = ("header", "footer")
        for name, before, added in (
            ("[Content_Types].xml", "</Types>", map(_CONTENT_TYPE.format, running)),
            ("word/_rels/document.xml.rels", "</Relationships>", map(_RELATION.format, running)),
            ("word/settings.xml", "<w:rsids>", [_COMPATIBLE]),
        ):
            parts[name] = default[name].decode().replace(before, "".join(added) + before)
        return _rewritten(reference, parts)


def _pictures(drawn: Sequence[dict[str, Any]]) -> list[bytes]:
    """Return the drawings of parts as PNG, and their logos."""
    if not drawn:
        return []
    compiled: Any = typst.compile
    pages = (
        f'image(bytes({typst_string(part["svg"])}), format: "svg")'
        if part.get("svg")
        else f"image(bytes(({typst_bytes(part['logo'][1])})), height: 11mm)"
        for part in drawn
    )
    pictures = compiled(
        "".join(
            f"#page(width: auto, height: auto, margin: 0pt, {page})" for page in pages
        ).encode(),
        format="png",
        ppi=_DOTS,
        font_paths=[font_folder()],
        ignore_system_fonts=True,
        root=font_folder(),
    )
    return pictures if isinstance(pictures, list) else [pictures]


def equation_lines(symbol: str, right_hand_sides: Sequence[str]) -> list[str]:
    """Return an equation in lines for Word, in LaTeX, from its lines for a page that is wider."""
    first, *others = right_hand_sides
    lines = broken(f"{symbol} = {first}", _ROOM)
    for side in others:
        line = side.removeprefix(CONTINUED).strip()
        lines += broken(line if side.startswith(CONTINUED) else f"= {line}", _ROOM)
    return [
        raised_brackets(unpaired_as_text(f"{_NO_OPERAND} {line}" if number else line))
        for number, line in enumerate(lines)
    ]


def raised_brackets(formula: str) -> str:
    """Return a formula in LaTeX with brackets that are raised to a power as one pair.

    The power is else that of the closing bracket alone, which some readers of Word files refuse.
    """
    opened: list[int] = []
    pairs = []
    for bracket in re.finditer(r"(?:\\(?:left|right))?[()]", formula):
        if bracket[0] == "(":
            opened.append(bracket.start())
        elif bracket[0] == ")" and opened:
            start = opened.pop()
            if formula[bracket.end() : bracket.end() + 1] == "^":
                pairs += [(start, r"\left("), (bracket.start(), r"\right)")]
    for place, pair in sorted(pairs, reverse=True):
        formula = formula[:place] + pair + formula[place + 1 :]
    return formula


def _parts_in(document: bytes) -> dict[str, bytes]:
    """Return the parts of a document by their names."""
    with zipfile.ZipFile(io.BytesIO(document)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def _rewritten(document: bytes, parts: Mapping[str, str]) -> bytes:
    """Return a document with some of its parts replaced, or added: always the same bytes."""
    contents = _parts_in(document) | {name: text.encode() for name, text in parts.items()}
    written = io.BytesIO()
    with zipfile.ZipFile(written, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in contents.items():
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
    return written.getvalue()
