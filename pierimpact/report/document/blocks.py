"""The blocks of a calculation sheet, as data that the templates lay out.

Those that are numbered, tables, equations and figures, are in `numbered`.
"""

import base64
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from jinja2 import Environment, FileSystemLoader

from pierimpact.report.document.markup import Inline, Part, Ref, Tex
from pierimpact.resources import shipped
from pierimpact.units import Printed

#: MIME type of a block's data, which the exporters lay out.
BLOCK_MIME = "application/vnd.pierimpact.report.block+json"


@dataclass(frozen=True)
class Block(Part):
    """A part of the sheet that a notebook cell returns."""

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Any]:
        return {BLOCK_MIME: self.data(), "text/plain": type(self).__name__}

    def _repr_html_(self) -> str:
        """Return the block as a notebook shows it: without numbers, its mathematics as LaTeX."""
        return str(getattr(_html_layout(), type(self).__name__)(self.data()))


@cache
def _html_layout() -> Any:
    folder = shipped("templates") / "pierimpact-html"
    environment = for_html(Environment(loader=FileSystemLoader(folder)))
    return environment.get_template("blocks.html.j2").module


def for_html(environment: Environment) -> Environment:
    """Return the environment, made to lay out HTML: all text is escaped."""
    environment.autoescape = True
    environment.filters["base64"] = lambda text: base64.b64encode(text.encode()).decode()
    return environment


@dataclass(frozen=True, kw_only=True)
class TitleBlock(Block):
    """The head of the sheet; its entries also run in the header and footer of every page."""

    title: str
    subtitle: str  #: line below the title
    entries: dict[str, str]  #: project, element and the like, by their labels
    running: dict[str, str] = field(default_factory=dict)  #: more, for header and footer alone
    office: str = ""  #: whose sheet it is
    logo: tuple[str, str] | None = None  #: MIME type and, in base64, the file of its logo
    date: str  #: date of the sheet, as 2026-01-31
    paper: str  #: of the PDF, "a4" or "us-letter"
    landscape: bool = False  #: whether the sheet is wider than it is high


@dataclass(frozen=True, kw_only=True)
class Headline(Block):
    """The results in large type."""

    results: Sequence[tuple[str, Printed, str]]  #: label, value and remark of each


@dataclass(frozen=True, kw_only=True)
class Verdict(Block):
    """What the sheet comes to: a sentence, and a drawing beside the results in large type."""

    statement: Inline
    mark: str  #: "STOP" where it says no, "CAUTION" where it says but, or ""
    svg: str
    alt: str  #: description of the drawing for readers who cannot see it
    results: Sequence[tuple[str, Printed, Inline]]  #: label, value and remark of each


@dataclass(frozen=True, kw_only=True)
class Signatures(Block):
    """Boxes to sign, and the revisions."""

    signers: Sequence[tuple[str, str]]  #: what each has done, and the name
    revisions: Sequence[Sequence[str]]  #: revision, date, description and name of each


@dataclass(frozen=True, kw_only=True)
class Annex(Block):
    """The beginning of an annex, which goes on to the next; one not printed is left out."""

    title: str
    printed: bool


@dataclass(frozen=True, kw_only=True)
class Beside(Block):
    """Blocks in two columns, where the page is wide enough."""

    left: Sequence[Block]
    right: Sequence[Block]
    share: float  #: of the width that the left ones take [-]


@dataclass(frozen=True)
class Group(Block):
    """Blocks one below the other, from one cell of a notebook."""

    blocks: Sequence[Block]


@dataclass(frozen=True)
class Paragraph(Block):
    """A paragraph of text."""

    body: Inline


@dataclass(frozen=True)
class Contents(Block):
    """The list of the sheet's headings, which the exporter fills in."""


@dataclass(frozen=True)
class Notes(Block):
    """Remarks in small type, a list."""

    notes: Sequence[Inline]  #: the remarks


@dataclass(frozen=True)
class Listing(Block):
    """A text in a typeface of fixed width, under a heading."""

    heading: str
    text: str


@dataclass(frozen=True)
class Nomenclature(Block):
    """Symbols, what they stand for and where they are introduced."""

    #: Symbol, meaning, and the equation or table that introduces it.
    entries: Sequence[tuple[Tex, Inline, Ref]]


@dataclass(frozen=True, kw_only=True)
class Notice(Block):
    """A remark that must not be overlooked."""

    heading: str  #: one or two words
    body: Sequence[Inline]  #: its paragraphs
