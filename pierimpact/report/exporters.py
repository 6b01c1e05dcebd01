"""From an executed notebook to one HTML file or a PDF, without its code.

Both are nbconvert exporters: `jupyter nbconvert --to pierimpact_pdf NOTEBOOK` works too. One call
of pandoc turns the notebook's prose and all mathematics into HTML with MathML, or into Typst.
"""

import datetime
import html
import importlib.util
import re
import subprocess
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import typst
from jinja2 import Environment
from nbconvert.exporters.templateexporter import TemplateExporter
from nbformat import NotebookNode, v4
from pypandoc import get_pandoc_path
from traitlets import default

from pierimpact.report.document.blocks import SHEET_MIME, TYPST_MIME, Block
from pierimpact.report.document.markup import typst_string
from pierimpact.resources import shipped

_MARKDOWN = "markdown-citations-yaml_metadata_block"
_CUT = "pierimpactcutshere"  # a paragraph between two pieces in what pandoc is given


def notebook_of(blocks: Iterable[Block]) -> NotebookNode:
    """Return a notebook as if its cells had returned these blocks."""
    new: Any = v4
    outputs = [new.new_output("display_data", block._repr_mimebundle_()) for block in blocks]
    notebook: NotebookNode = new.new_notebook(
        cells=[new.new_code_cell(outputs=[output]) for output in outputs]
    )
    return notebook


class _SheetExporter(TemplateExporter):
    """What the two exporters share: the outputs and prose of a notebook as pieces of a sheet."""

    piece_mime: str
    pandoc_options: tuple[str, ...]
    math: re.Pattern[str]

    @default("extra_template_basedirs")
    def _default_extra_template_basedirs(self) -> list[str]:
        return [str(shipped("templates"))]

    def _preprocess(self, nb: NotebookNode, resources: Any) -> tuple[NotebookNode, Any]:
        # `jupyter nbconvert --execute` executes here: before it there are no outputs.
        nb, resources = super()._preprocess(nb, resources)  # type: ignore[no-untyped-call]
        resources["sheet"] = self._sheet(nb)
        return nb, resources

    def _sheet(self, nb: NotebookNode) -> dict[str, Any]:
        """Return what the template needs: the pieces, and what the title block says."""
        sheet: dict[str, Any] = {
            "title": _title(nb),
            "date": "2000-01-01",
            "paper": "a4",
            "landscape": False,
            "entries": {},
        }
        pieces = []
        for cell in nb.cells:
            if cell.cell_type == "markdown":
                pieces.append(("markdown", cell.source))
            for output in cell.get("outputs", []):
                data = output.get("data", {})
                sheet |= data.get(SHEET_MIME, {})
                if self.piece_mime in data:
                    pieces.append(("ready", data[self.piece_mime]))
                elif "text/markdown" in data:
                    pieces.append(("markdown", data["text/markdown"]))
        return sheet | {"pieces": self._converted(pieces)}

    def _converted(self, pieces: list[tuple[str, str]]) -> list[str]:
        """Return the pieces with prose and mathematics converted, by one call of pandoc."""
        prose = [text for kind, text in pieces if kind == "markdown"]
        ready = [text for kind, text in pieces if kind == "ready"]
        formulas = [formula for text in ready for formula in self._formulas(text)]
        converted = self._pandoc([*prose, *formulas])
        prose_out, formulas_out = iter(converted[: len(prose)]), iter(converted[len(prose) :])
        return [
            next(prose_out)
            if kind == "markdown"
            else self.math.sub(lambda match: self._formula(match, next(formulas_out)), text)
            for kind, text in pieces
        ]

    def _formulas(self, text: str) -> list[str]:
        """Return the formulas of a ready piece as pandoc's Markdown."""
        raise NotImplementedError

    def _formula(self, match: re.Match[str], converted: str) -> str:
        """Return what a formula is replaced by."""
        raise NotImplementedError

    def _pandoc(self, pieces: list[str]) -> list[str]:
        done = subprocess.run(
            [get_pandoc_path(), f"--from={_MARKDOWN}", "--fail-if-warnings", *self.pandoc_options],
            input=f"\n\n{_CUT}\n\n".join(pieces),
            capture_output=True,
            encoding="utf-8",
            start_new_session=True,  # where Ctrl-C does not reach it: that is for us to handle
        )
        if done.returncode != 0:
            raise RuntimeError(f"pandoc: {done.stderr.strip()}")
        return [piece.strip() for piece in re.split(rf"(?:<p>)?{_CUT}(?:</p>)?", done.stdout)]


class SheetHTMLExporter(_SheetExporter):
    """One self-contained HTML file: figures inside, mathematics as MathML, no script."""

    export_from_notebook = "pierimpact: calculation sheet, HTML"
    file_extension = ".html"
    output_mimetype = "text/html"
    template_name = "pierimpact-html"
    piece_mime = "text/html"
    pandoc_options = ("--to=html5", "--mathml", "--number-sections", "--shift-heading-level-by=1")
    math = re.compile(r'<(span|div) class="math( display)?">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)

    def _create_environment(self) -> Environment:
        environment: Environment = super()._create_environment()  # type: ignore[no-untyped-call]
        environment.filters["css_string"] = _css_string
        return environment

    def _sheet(self, nb: NotebookNode) -> dict[str, Any]:
        sheet = super()._sheet(nb)
        # The LaTeX that pandoc leaves as an annotation would be found by a search of the page.
        page = re.sub(r"<annotation .*?</annotation>", "", "\n".join(sheet["pieces"]), flags=re.S)
        if not sheet["entries"]:  # no calculation sheet: its first heading is a title
            page = re.sub(r'<span\s+class="header-section-number">[^<]*</span>\s*', "", page)
        return sheet | {"pieces": _with_contents(_numbered(page))}

    def _formulas(self, text: str) -> list[str]:
        marks = {"": "$", " display": "$$"}
        return [
            f"{mark}{html.unescape(formula)}{mark}"
            for mark, formula in (
                (marks[match[2] or ""], match[3]) for match in self.math.finditer(text)
            )
        ]

    def _formula(self, match: re.Match[str], converted: str) -> str:
        formula = converted.removeprefix("<p>").removesuffix("</p>")
        return f'<div class="math">{formula}</div>' if match[2] else formula


def _title(nb: NotebookNode) -> str:
    """Return the first heading of a notebook's prose."""
    prose = "\n".join(cell.source for cell in nb.cells if cell.cell_type == "markdown")
    heading = re.search(r"^#+ +(.+)$", prose, re.MULTILINE)
    return heading[1].strip() if heading else "Notebook"


def _numbered(page: str) -> str:
    """Return the page with equations, figures and tables numbered in the order they come."""
    counts: Counter[str] = Counter()
    numbers: dict[str, str] = {}
    anchor = ""

    def count(match: re.Match[str]) -> str:
        nonlocal anchor
        if match[1]:
            anchor = match[1]
            return match[0]
        kind = match[2]
        counts[kind] += 1
        number = f"({counts[kind]})" if kind == "Equation" else str(counts[kind])
        numbers[anchor] = number
        words = number if kind == "Equation" else f"{kind}&nbsp;{number}."
        return f'<span class="number">{words}</span>'

    page = re.sub(
        r'<(?:table|figure|div)\b[^>]* id="([^"]+)"[^>]*>|'
        r'<span class="number" data-count="(\w+)">.*?</span>',
        count,
        page,
    )
    return re.sub(
        r'(<a\s+href="#([^"]+)">)(.*?)</a>',
        lambda link: (
            f"{link[1]}{link[3]}&nbsp;{numbers[link[2]]}</a>" if link[2] in numbers else link[0]
        ),
        page,
    )


def _css_string(text: str) -> str:
    """Return text for a string of a style sheet, short enough for the head of a page."""
    short = text if len(text) <= 80 else text[:79] + "…"
    return "".join(c if c.isascii() and c.isalnum() else f"\\{ord(c):x} " for c in short)


def _with_contents(page: str) -> str:
    """Return the page with its parts listed where the list of contents belongs."""
    entries = "".join(
        f'<li><a href="#{anchor}">{html.escape(number)} {heading}</a></li>'
        for anchor, number, heading in re.findall(
            r'<h2 [^>]*id="([^"]+)">\s*<span\s+class="header-section-number">([^<]*)</span>'
            r"\s*(.*?)</h2>",
            page,
            re.DOTALL,
        )
    )
    listed = f"<h2>Contents</h2><ol>{entries}</ol></nav>"
    return re.sub(r'(<nav class="contents"[^>]*>)</nav>', lambda nav: nav[1] + listed, page)


class SheetPDFExporter(_SheetExporter):
    """A PDF by Typst, with vector figures, tagged, PDF/A-2a and PDF/UA-1."""

    export_from_notebook = "pierimpact: calculation sheet, PDF"
    file_extension = ".typ"  # of the template; what comes out is a PDF
    output_mimetype = "application/pdf"
    template_name = "pierimpact-pdf"
    piece_mime = TYPST_MIME
    pandoc_options = ("--to=typst",)
    math = re.compile(r'#tex(block)?\(("(?:[^"\\]|\\.)*")\)')

    def _create_environment(self) -> Environment:
        # Typst uses braces and hashes itself.
        environment: Environment = super()._create_environment()  # type: ignore[no-untyped-call]
        environment.block_start_string, environment.block_end_string = "((*", "*))"
        environment.variable_start_string, environment.variable_end_string = "((=", "=))"
        environment.comment_start_string, environment.comment_end_string = "((--", "--))"
        environment.filters["typst_string"] = typst_string
        return environment

    def from_notebook_node(
        self, nb: NotebookNode, resources: Any = None, **kw: Any
    ) -> tuple[Any, dict[str, Any]]:
        """Return the notebook as a PDF, and nbconvert's resources."""
        source, resources = super().from_notebook_node(nb, resources, **kw)
        resources["output_extension"] = ".pdf"
        pdf, missing = compile_typst(source, resources["sheet"]["date"])
        resources["warnings"] = []
        if missing:
            shown = ", ".join(
                f"{c} (U+{ord(c):04X})" if c.isprintable() else f"U+{ord(c):04X}" for c in missing
            )
            resources["warnings"].append(
                f"no font here has {shown}: it prints as its number in the PDF; install a font for "
                "that script, such as one of the Noto fonts"
            )
        return pdf, resources

    def _formulas(self, text: str) -> list[str]:
        return [
            f"$${formula}$$" if block else f"${formula}$"
            for block, formula in (
                (match[1], _typst_text(match[2])) for match in self.math.finditer(text)
            )
        ]

    def _formula(self, match: re.Match[str], converted: str) -> str:
        kind = 'block: true, numbering: "(1)", ' if match[1] else ""
        body = f"{converted}.body"
        if match[2].startswith('"\\\\displaystyle'):  # which pandoc drops
            body = f"math.display({body})"
        return f"#math.equation({kind}alt: {match[2]}, {body})"


def _typst_text(literal: str) -> str:
    """Return the text of a Typst string literal."""
    return re.sub(r"\\(.)", r"\1", literal[1:-1])


def compile_typst(source: str, date: str) -> tuple[bytes, str]:
    """Return the PDF of a Typst document, the same bytes for the same source and date.

    Where the text is in a script that the fonts at hand lack, such as Chinese, the fonts of the
    system are searched: whoever writes in it has one. A character that no font has prints as its
    number, such as [U+6865]: never as an empty box, and the PDF still keeps its standards.

    Parameters
    ----------
    source : str
        The document.
    date : str
        Its date, as 2026-01-31.

    Returns
    -------
    pdf : bytes
        The PDF.
    missing : str
        The characters that no font has, each once.
    """
    compiled: Callable[..., bytes] = typst.compile
    options = {
        "timestamp": datetime.datetime.fromisoformat(f"{date}T00:00:00+00:00"),
        "pdf_standards": ["a-2a", "ua-1"],
        "font_paths": [_font_folder()],
    }
    try:
        return compiled(source.encode(), ignore_system_fonts=True, **options), ""
    except typst.TypstError as error:
        if not _undisplayed(error):
            raise
    options["sys_inputs"] = {"fallback": "yes"}
    missing = ""
    while True:
        try:
            return compiled(source.encode(), **options), missing
        except typst.TypstError as error:
            found = _undisplayed(error)
            if not set(found) - set(missing):
                raise
            missing += "".join(sorted(set(found) - set(missing)))
            source = "".join(f"[U+{ord(c):04X}]" if c in found else c for c in source)


def _undisplayed(error: typst.TypstError) -> str:
    """Return the characters that an error says no font can display, or no PDF/A may contain."""
    texts = re.findall(
        r'the text `"(.*?)"` could not be displayed|contains the codepoint `"(.*?)"`',
        error.diagnostic,
    )
    return re.sub(
        r"\\u\{(\w+)\}",
        lambda number: chr(int(number[1], 16)),
        "".join(displayed or contained for displayed, contained in texts),
    )


def _font_folder() -> Path:
    """Return the folder of matplotlib's fonts, for the scripts that Typst's own do not have."""
    matplotlib = importlib.util.find_spec("matplotlib")
    assert matplotlib is not None
    assert matplotlib.origin is not None
    return Path(matplotlib.origin).parent / "mpl-data" / "fonts" / "ttf"
