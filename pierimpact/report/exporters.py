"""From an executed notebook to one HTML file or a PDF, without its code.

Both are nbconvert exporters: `jupyter nbconvert --to pierimpact_pdf NOTEBOOK` works too. Pandoc
turns the notebook's prose and all mathematics into HTML with MathML, or into Typst.
"""

import base64
import datetime
import html
import importlib.util
import re
import shutil
import signal
import string
import subprocess
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import pypandoc
import typst
from jinja2 import Environment
from markupsafe import Markup
from nbconvert.exporters.templateexporter import TemplateExporter
from nbformat import NotebookNode, v4
from traitlets import default

from pierimpact.report.document.blocks import BLOCK_MIME, Block, for_html
from pierimpact.report.document.table_size import is_whole
from pierimpact.resources import shipped

# How pandoc reads prose, of which none is Typst, and formulas alone, which takes half as long.
_PROSE = "markdown-citations-yaml_metadata_block-raw_attribute"
_FORMULAS = "commonmark+tex_math_dollars"
_CUT = "pierimpactcutshere"  # a paragraph between two pieces of pandoc's input


def notebook_of(blocks: Iterable[Block]) -> NotebookNode:
    """Return a notebook as if its cells had returned these blocks."""
    new: Any = v4
    outputs = [new.new_output("display_data", block._repr_mimebundle_()) for block in blocks]
    notebook: NotebookNode = new.new_notebook(
        cells=[new.new_code_cell(outputs=[output]) for output in outputs]
    )
    return notebook


class _SheetExporter(TemplateExporter):
    """The common part of the exporters: a notebook's outputs and prose as blocks of a sheet."""

    own_mime = ""  #: MIME type of outputs that go into the document unchanged
    pandoc_options: tuple[str, ...]
    # Of the document before: the markup of its formulas, by LaTeX, and its prose with the markup.
    _formulas: Mapping[str, str] = MappingProxyType({})
    _prose: tuple[Sequence[str], Sequence[str]] = ((), ())

    @default("optimistic_validation")
    def _default_optimistic_validation(self) -> bool:
        return True  # once, rather than around each of nbconvert's preprocessors

    @default("extra_template_basedirs")
    def _default_extra_template_basedirs(self) -> list[str]:
        return [str(shipped("templates"))]

    def get_prefix_root_dirs(self) -> list[str]:
        """Return no folders of Jupyter's: what is in them could change or replace a template."""
        return []

    def _preprocess(self, nb: NotebookNode, resources: Any) -> tuple[NotebookNode, Any]:
        # `jupyter nbconvert --execute` executes here: before it there are no outputs.
        nb, resources = super()._preprocess(nb, resources)  # type: ignore[no-untyped-call]
        resources["sheet"] = self._sheet(nb)
        return nb, resources

    def _sheet(self, nb: NotebookNode) -> dict[str, Any]:
        """Return the data of the template: the blocks, and the fields of the title block."""
        sheet: dict[str, Any] = {
            "title": _title(nb),
            "date": "2000-01-01",
            "paper": "a4",
            "landscape": False,
            "entries": [],
            "running": [],
        }
        blocks = list(_with_content(_printed(self._blocks(nb))))
        for block in blocks:
            if block["type"] == "TitleBlock":
                sheet |= block
        self._convert(blocks)
        return sheet | {"blocks": blocks, "document_title": document_title(sheet)}

    def _blocks(self, nb: NotebookNode) -> Iterator[dict[str, Any]]:
        """Yield the data of a notebook's blocks, with its prose as blocks among them."""
        for cell in nb.cells:
            if cell.cell_type == "markdown":
                yield {"type": "Prose", "markdown": cell.source}
            for output in cell.get("outputs", []):
                data = output.get("data", {})
                if BLOCK_MIME in data:
                    block = data[BLOCK_MIME]
                    yield from block["blocks"] if block["type"] == "Group" else [block]
                elif self.own_mime in data:
                    yield {"type": "Prose", "converted": data[self.own_mime]}
                elif "text/markdown" in data:
                    yield {"type": "Prose", "markdown": data["text/markdown"]}

    def _convert(self, blocks: list[dict[str, Any]]) -> None:
        """Add the `converted` markup to prose and mathematics.

        The prose of a sheet and most of its formulas are those of the sheet before, and are kept
        from there.
        """
        parts = [(part, text) for part in parts_of(blocks) if (text := _markdown(part)) is not None]
        prose = [(part, text) for part, text in parts if part["type"] == "Prose"]
        formulas = [(part, text) for part, text in parts if part["type"] != "Prose"]
        before = self._formulas  # another thread may put others there meanwhile
        kept = {text: before[text] for _, text in formulas if text in before}
        new = list(dict.fromkeys(text for _, text in formulas if text not in kept))
        for text, markup in zip(new, self._pandoc(_FORMULAS, new), strict=True):
            kept[text] = markup.removeprefix("<p>").removesuffix("</p>")
        for part, text in formulas:
            part["converted"] = kept[text]
        texts = [text for _, text in prose]
        own = self._prose
        if own[0] != texts:
            own = texts, self._pandoc(_PROSE, texts)
        for (part, _), markup in zip(prose, own[1], strict=True):
            part["converted"] = markup
        self._formulas, self._prose = kept, own

    def _pandoc(self, reader: str, pieces: list[str]) -> list[str]:
        """Return what pandoc makes of each piece, in one call."""
        if not pieces:
            return []
        text = f"\n\n{_CUT}\n\n".join(pieces)
        converted = pandoc(f"--from={reader}", *self.pandoc_options, text=text).decode()
        return [piece.strip() for piece in re.split(rf"(?:<p>)?{_CUT}(?:</p>)?", converted)]


def pandoc(*options: str, text: str = "", **process: Any) -> bytes:
    """Return what pandoc makes of a text.

    It reads no file but those that the options name: none of the user's, and none of the text's.
    """
    command = [_pandoc_path(), "--sandbox", f"--data-dir={shipped('templates')}"]
    while True:
        done: subprocess.CompletedProcess[bytes] = subprocess.run(
            [*command, "--fail-if-warnings", *options],
            input=text.encode(),
            capture_output=True,
            start_new_session=True,  # out of reach of Ctrl-C, which the caller handles
            **process,
        )
        if done.returncode != -signal.SIGINT:  # which came before it was out of reach
            break
    if done.returncode != 0:
        raise RuntimeError(f"pandoc: {done.stderr.decode().strip()}")
    return done.stdout


@cache
def _pandoc_path() -> str:
    """Return where the pandoc is that comes with pypandoc; without one, any that it finds."""
    own = str(Path(pypandoc.__file__).parent / "files")
    return shutil.which("pandoc", path=own) or pypandoc.get_pandoc_path()


def _printed(blocks: Iterable[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """Yield the blocks without annexes that are not to be printed, each with its letter."""
    letters, printed = iter(string.ascii_uppercase), True
    for block in blocks:
        if block["type"] == "Annex":
            printed = block["printed"]
            if printed:
                block = block | {"letter": next(letters)}
        if printed:
            yield block


def _with_content(blocks: Iterable[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """Yield the blocks without subheadings of annexes that nothing stands below."""
    waiting: dict[str, Any] | None = None
    annex = False
    for block in blocks:
        annex = annex or block["type"] == "Annex"
        heading = annex and block.get("markdown", "").startswith("## ")
        if waiting and not heading and block["type"] != "Annex":
            yield waiting
        waiting = block if heading else None
        if not heading:
            yield block


def parts_of(data: Any) -> Iterator[dict[str, Any]]:
    """Yield the parts in the data of blocks, each before what is in it."""
    if isinstance(data, dict):
        yield data
        data = list(data.values())
    if isinstance(data, list):
        for each in data:
            yield from parts_of(each)


def _markdown(part: dict[str, Any]) -> str | None:
    """Return a part in pandoc's Markdown, if it is for pandoc to convert."""
    match part:
        case {"type": "Prose", "markdown": str(prose)}:
            return prose
        case {"type": "Tex", "source": formula}:
            return f"${formula}$"
        case {"type": "Equation", "tex": formula}:
            return f"$${formula}$$"
    return None


class SheetHTMLExporter(_SheetExporter):
    """One self-contained HTML file: figures inside, mathematics as MathML, no script."""

    export_from_notebook = "pierimpact: calculation sheet, HTML"
    file_extension = ".html"
    output_mimetype = "text/html"
    template_name = "pierimpact-html"
    own_mime = "text/html"
    pandoc_options = ("--to=html5", "--mathml", "--number-sections", "--shift-heading-level-by=1")

    def _create_environment(self) -> Environment:
        environment = for_html(super()._create_environment())  # type: ignore[no-untyped-call]
        environment.filters["css_string"] = _css_string
        return environment

    def _sheet(self, nb: NotebookNode) -> dict[str, Any]:
        sheet = super()._sheet(nb)
        _number(sheet["blocks"])
        prose = [block for block in sheet["blocks"] if block["type"] == "Prose"]
        if not sheet["entries"]:  # no calculation sheet: its first heading is a title
            for block in prose:
                block["converted"] = re.sub(
                    r'<span\s+class="header-section-number">[^<]*</span>\s*', "", block["converted"]
                )
        _letter(sheet["blocks"])
        headings = [heading for block in sheet["blocks"] for heading in _headings(block)]
        for block in sheet["blocks"]:
            if block["type"] == "Contents":
                block["headings"] = headings
        return sheet

    def _pandoc(self, reader: str, pieces: list[str]) -> list[str]:
        # The LaTeX that pandoc leaves as an annotation would be found by a search of the page.
        annotation = re.compile(r"<annotation .*?</annotation>", re.DOTALL)
        return [
            _ACCENT.sub(lambda mark: mark[1] + _SPACING[mark[2]], annotation.sub("", piece))
            for piece in super()._pandoc(reader, pieces)
        ]


# A combining accent stands beside its letter in Chromium; the same as a character of its own, over.
_SPACING = {"\u0302": "ˆ", "\u0303": "˜", "\u0304": "¯", "\u0307": "˙", "\u0308": "¨"}
_ACCENT = re.compile(f'(<mo accent="true"[^>]*>)([{"".join(_SPACING)}])')


def _letter(blocks: list[dict[str, Any]]) -> None:
    """Give the subheadings of annexes the letters of these."""
    letter, count = "", 0

    def numbered(number: re.Match[str]) -> str:
        nonlocal count
        count += 1
        return f"{number[1]}{letter}.{count}<"

    for block in blocks:
        if block["type"] == "Annex":
            letter, count = block["letter"], 0
        elif block["type"] == "Prose" and letter:
            block["converted"] = re.sub(
                r'(<span\s+class="header-section-number">)[^<]*<', numbered, block["converted"]
            )


def _headings(block: dict[str, Any]) -> list[tuple[str, str, str]]:
    """Return anchor, number and HTML of the headings of a block that the contents list."""
    if block["type"] == "Annex":
        number = f"Annex {block['letter']}"
        return [(f"annex-{block['letter']}", number, html.escape(block["title"]))]
    return re.findall(
        r'<h2 [^>]*id="([^"]+)">\s*<span\s+class="header-section-number">([^<]*)</span>'
        r"\s*(.*?)</h2>",
        block["converted"] if block["type"] == "Prose" else "",
        re.DOTALL,
    )


def document_title(sheet: dict[str, Any]) -> str:
    """Return the title of a sheet's file: the element, the project and what the sheet is."""
    entries = dict(sheet["entries"])
    named = (entries.get("Element"), entries.get("Project"), sheet["title"])
    return " — ".join(text for text in named if text and text != "—")


def _title(nb: NotebookNode) -> str:
    """Return the first heading of a notebook's prose."""
    prose = "\n".join(cell.source for cell in nb.cells if cell.cell_type == "markdown")
    heading = re.search(r"^#+ +(.+)$", prose, re.MULTILINE)
    return heading[1].strip() if heading else "Notebook"


def _number(blocks: list[dict[str, Any]]) -> None:
    """Add numbers to equations, figures and tables in their order, and to references to them."""
    parts = list(parts_of(blocks))
    counts: Counter[str] = Counter()
    numbers: dict[str, str] = {}
    for part in parts:
        kind = part["type"]
        if kind in ("Equation", "Figure", "Table"):
            counts[kind] += 1
            part["number"] = f"({counts[kind]})" if kind == "Equation" else str(counts[kind])
            numbers[part["label"]] = part["number"]
    for part in parts:
        if part["type"] == "Ref":
            part["number"] = numbers.get(part["label"])
        elif part["type"] == "Prose":
            part["converted"] = re.sub(
                r'(<a\s+href="#([^"]+)">.*?)</a>',
                lambda link: (
                    f"{link[1]}&nbsp;{numbers[link[2]]}</a>" if link[2] in numbers else link[0]
                ),
                part["converted"],
            )


def _css_string(text: str) -> str:
    """Return text for a string of a style sheet, short enough for the head of a page."""
    short = text if len(text) <= 80 else text[:79] + "…"
    return "".join(c if c.isascii() and c.isalnum() else f"\\{ord(c):x} " for c in short)


class SheetPDFExporter(_SheetExporter):
    """A PDF by Typst, with vector figures, tagged, PDF/A-2a and PDF/UA-1."""

    export_from_notebook = "pierimpact: calculation sheet, PDF"
    file_extension = ".typ"  # of the template; what comes out is a PDF
    output_mimetype = "application/pdf"
    template_name = "pierimpact-pdf"
    pandoc_options = ("--to=typst",)

    def _sheet(self, nb: NotebookNode) -> dict[str, Any]:
        sheet = super()._sheet(nb)
        _close_gaps(sheet["blocks"])
        return sheet

    def _create_environment(self) -> Environment:
        # Typst has its own use of braces and hashes. All text becomes a string literal.
        environment: Environment = super()._create_environment()  # type: ignore[no-untyped-call]
        environment.block_start_string, environment.block_end_string = "((*", "*))"
        environment.variable_start_string, environment.variable_end_string = "((=", "=))"
        environment.comment_start_string, environment.comment_end_string = "((--", "--))"
        environment.autoescape, environment.finalize = True, typst_string
        environment.tests["whole"] = is_whole
        environment.filters["breakable"] = _breakable
        environment.filters["bytes"] = typst_bytes
        return environment

    def from_notebook_node(
        self, nb: NotebookNode, resources: Any = None, **kw: Any
    ) -> tuple[Any, dict[str, Any]]:
        """Return the notebook as a PDF, and nbconvert's resources.

        Those given may have under "binder" the pages before this document in one, and all of its.
        """
        source, resources = super().from_notebook_node(nb, resources, **kw)
        resources["output_extension"] = ".pdf"
        place = resources.get("binder")
        inputs = {"binder": f"{place[0]}/{place[1]}"} if place else {}
        pdf, missing = compile_typst(source, resources["sheet"]["date"], inputs)
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


def _close_gaps(blocks: list[dict[str, Any]]) -> None:
    """Raise headings that leave out a level, which PDF/UA does not allow, to the next there is."""
    above: list[int] = []  # levels of the headings that a heading stands below, as they were

    def raised(heading: re.Match[str]) -> str:
        if heading["code"]:
            return heading[0]
        level = len(heading["marks"]) if heading["marks"] else int(heading["level"])
        while above and above[-1] >= level:
            above.pop()
        above.append(level)
        if heading["marks"]:
            return heading["indent"] + "=" * len(above)
        return f"#heading(level: {len(above)}"

    for block in blocks:
        if block["type"] == "Annex":
            above[:] = [1]
        elif block["type"] == "Prose":
            block["converted"] = _HEADING.sub(raised, block["converted"])


_HEADING = re.compile(
    r"^ *(?P<code>`{3,}).*?^ *(?P=code)"
    r"|^(?P<indent> *)(?P<marks>=+)(?= )"
    r"|#heading\(level: (?P<level>\d+)",
    re.DOTALL | re.MULTILINE,
)


def typst_string(value: Any) -> Any:
    """Return text as a Typst string literal: nothing in it can act as markup."""
    if isinstance(value, Markup):
        return value
    for character, escaped in _ESCAPED.items():  # on long texts much quicker than a translation
        value = value.replace(character, escaped)
    return Markup(f'"{value}"')


# The first escapes those that the others bring.
_ESCAPED = {"\\": r"\\", '"': r"\"", "\n": r"\n", "\r": r"\r", "\t": r"\t"}


def _breakable(text: str) -> str:
    """Return `text` with spaces of no width in words that would not fit a line of a column.

    They stand after hyphens, and anywhere in what is still too long. Only between ASCII characters,
    as others may join or stand on one another.
    """
    return re.sub(
        r"[!-~]{20,}",
        lambda word: "\u200b".join(
            part if len(part) < 20 else "\u200b".join(part)
            for part in re.findall("[^-]*-|[^-]+", word[0])
        ),
        text,
    )


def typst_bytes(base64_text: str) -> Any:
    """Return a file in base64 as the numbers that Typst makes bytes of."""
    return Markup(", ".join(map(str, base64.b64decode(base64_text))) + ",")


_CLOSER = "set closer"  # what the sheet's template stops with, to be compiled again


def compile_typst(
    source: str, date: str, inputs: Mapping[str, str] = MappingProxyType({})
) -> tuple[bytes, str]:
    """Return the PDF of a Typst document, and the characters that no font has, each once.

    The bytes are the same for the same source, date, written as 2026-01-31, and inputs. Where the
    text is in a script that the fonts at hand lack, such as Chinese, the fonts of the system are
    searched too. A sheet that stops to be set closer is. Where the places of the drawings do not
    settle, one moving the next, all stand where they are spoken of. A character that no font has
    prints as its number, such as [U+6865], rather than as an empty box, which the PDF's standards
    do not allow.
    """
    compiled: Callable[..., tuple[bytes, Sequence[Any]]] = typst.compile_with_warnings
    inputs = dict(inputs)
    options: dict[str, Any] = {
        "timestamp": datetime.datetime.fromisoformat(f"{date}T00:00:00+00:00"),
        "pdf_standards": ["a-2a", "ua-1"],
        "font_paths": [font_folder()],
        "ignore_system_fonts": True,
        "root": font_folder(),  # all that the document could read files from
    }
    missing = ""
    while True:
        try:
            pdf, warnings = compiled(source.encode(), sys_inputs=inputs, **options)
            if "settled" in inputs or not any("converge" in w.message for w in warnings):
                return pdf, missing
            inputs["settled"] = "yes"
            continue
        except BaseException as error:
            if not isinstance(error, Exception) and type(error).__name__ == "PanicException":
                raise RuntimeError(f"Typst stopped: {error}") from None
            if not isinstance(error, typst.TypstError):
                raise
            if _CLOSER in str(error) and "close" not in inputs:
                inputs["close"] = "yes"
                continue
            found = _to_number(set(_undisplayed(error)) - set(missing))
            if not found:
                raise
        if options["ignore_system_fonts"]:
            options["ignore_system_fonts"], inputs["fallback"] = False, "yes"
        else:
            missing += "".join(found)
            source = "".join(f"[U+{ord(c):04X}]" if c in found else c for c in source)


def _to_number(characters: set[str]) -> list[str]:
    """Return which characters of clusters that no font displays print as their numbers.

    Marks that stand on others go first, as it may be for them alone. What is ASCII never does:
    every font has it, and Typst's own words are made of it.
    """
    others = sorted(c for c in characters if not c.isascii())
    marks = [c for c in others if unicodedata.category(c) in ("Mn", "Mc", "Me", "Cf")]
    return marks or others


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


def font_folder() -> Path:
    """Return the folder of matplotlib's fonts, for the scripts that Typst's own do not have."""
    matplotlib = importlib.util.find_spec("matplotlib")
    assert matplotlib is not None
    assert matplotlib.origin is not None
    return Path(matplotlib.origin).parent / "mpl-data" / "fonts" / "ttf"
