"""The blocks of a calculation sheet, as data that the templates lay out.

Those that are numbered, tables, equations and figures, are in `numbered`.
"""

import base64
from collections.abc import Sequence
from dataclasses import dataclass
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
    """The head of the sheet; its entries also run in the header and footer of every page.

    Parameters
    ----------
    title, subtitle : str
        Title, and the line below it.
    entries : mapping of str to str
        Project, element and the like, by their labels.
    date : str
        Date of the sheet, as 2026-01-31.
    paper : {"a4", "us-letter"}
        Paper of the PDF.
    landscape : bool, optional
        Whether the sheet is wider than it is high.
    """

    title: str
    subtitle: str
    entries: dict[str, str]
    date: str
    paper: str
    landscape: bool = False


@dataclass(frozen=True, kw_only=True)
class Headline(Block):
    """The results in large type.

    Parameters
    ----------
    results : sequence of (str, Printed, str)
        Label, value and remark of each.
    """

    results: Sequence[tuple[str, Printed, str]]


@dataclass(frozen=True)
class Paragraph(Block):
    """A paragraph of text."""

    body: Inline


@dataclass(frozen=True)
class Contents(Block):
    """The list of the sheet's headings, which the exporter fills in."""


@dataclass(frozen=True)
class Notes(Block):
    """Remarks in small type, a list.

    Parameters
    ----------
    notes : sequence of str or Tex or tuple
        The remarks.
    """

    notes: Sequence[Inline]


@dataclass(frozen=True)
class Nomenclature(Block):
    """Symbols, what they stand for and where they are introduced.

    Parameters
    ----------
    entries : sequence of (Tex, str or Tex or tuple, Ref)
        Symbol, meaning, and the equation or table that introduces it.
    """

    entries: Sequence[tuple[Tex, Inline, Ref]]


@dataclass(frozen=True, kw_only=True)
class Notice(Block):
    """A remark that must not be overlooked.

    Parameters
    ----------
    heading : str
        One or two words.
    body : sequence of str or Tex or tuple
        Its paragraphs.
    """

    heading: str
    body: Sequence[Inline]
