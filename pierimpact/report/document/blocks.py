"""The building blocks of a calculation sheet, each written as HTML and as Typst.

Those that are numbered, tables, equations and figures, are in `numbered`.
"""

import html
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from pierimpact.report.document.markup import (
    Inline,
    Piece,
    Ref,
    Tex,
    breakable,
    to_html,
    to_typst,
    typst_string,
)
from pierimpact.units import Printed

#: MIME type of what running headers, document properties and paper size need to know.
SHEET_MIME = "application/vnd.pierimpact.report.sheet+json"
TYPST_MIME = "text/x-typst"


class Block(ABC):
    """A piece of the sheet: what a notebook cell returns."""

    @abstractmethod
    def to_html(self) -> str:
        """Return the block as HTML."""

    @abstractmethod
    def to_typst(self) -> str:
        """Return the block as Typst markup."""

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Any]:
        return {
            "text/html": self.to_html(),
            TYPST_MIME: self.to_typst(),
            "text/plain": type(self).__name__,
        }


@dataclass(frozen=True, kw_only=True)
class TitleBlock(Block):
    """The head of the sheet; its entries also run in the header and footer of every page.

    Parameters
    ----------
    title, subtitle : str
        What the sheet is.
    entries : mapping of str to str
        The identification, label to text.
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

    def to_html(self) -> str:
        """Return the block as HTML."""
        entries = "".join(
            f"<div><dt>{html.escape(label)}</dt><dd>{html.escape(text)}</dd></div>"
            for label, text in self.entries.items()
        )
        return (
            f'<header class="title-block"><h1>{html.escape(self.title)}</h1>'
            f"<p>{html.escape(self.subtitle)}</p><dl>{entries}</dl></header>"
        )

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        entries = "".join(
            f"({typst_string(label)}, {typst_string(breakable(text))}),"
            for label, text in self.entries.items()
        )
        title, subtitle = typst_string(self.title), typst_string(self.subtitle)
        return f"#title-block({title}, {subtitle}, ({entries}))"

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Any]:
        sheet = {
            "title": self.title,
            "date": self.date,
            "paper": self.paper,
            "landscape": self.landscape,
            "entries": self.entries,
        }
        return super()._repr_mimebundle_() | {SHEET_MIME: sheet}


@dataclass(frozen=True, kw_only=True)
class Headline(Block):
    """The results in large type.

    Parameters
    ----------
    results : sequence of (str, Printed, str)
        What it is, its value, and a remark.
    """

    results: Sequence[tuple[str, Printed, str]]

    def to_html(self) -> str:
        """Return the block as HTML."""
        results = "".join(
            f'<div><dt>{html.escape(label)}</dt><dd><span class="value">'
            f"{html.escape(value.number)}<small> {html.escape(value.unit)}</small></span>"
            f'<span class="remark">{html.escape(remark)}</span></dd></div>'
            for label, value, remark in self.results
        )
        return f'<dl class="headline">{results}</dl>'

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        results = "".join(
            "(" + ", ".join(map(typst_string, (label, *value, remark))) + "),"
            for label, value, remark in self.results
        )
        return f"#headline(({results}))"


@dataclass(frozen=True)
class Paragraph(Block):
    """A paragraph of text."""

    body: Inline

    def to_html(self) -> str:
        """Return the block as HTML."""
        return f"<p>{to_html(self.body)}</p>"

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        return to_typst(self.body)


@dataclass(frozen=True)
class Contents(Block):
    """The list of the sheet's parts; the exporters fill it in."""

    def to_html(self) -> str:
        """Return the block as HTML."""
        return '<nav class="contents" aria-label="Contents"></nav>'

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        return "#contents"


@dataclass(frozen=True)
class Notes(Block):
    """Remarks in small type, a list.

    Parameters
    ----------
    notes : sequence of str or Tex or tuple
        The remarks.
    """

    notes: Sequence[Inline]

    def to_html(self) -> str:
        """Return the block as HTML."""
        notes = "".join(f"<li>{to_html(note)}</li>" for note in self.notes)
        return f'<ul class="notes">{notes}</ul>'

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        return "#notes((" + "".join(f"[{to_typst(note)}]," for note in self.notes) + "))"


@dataclass(frozen=True)
class Nomenclature(Block):
    """Symbols, what they stand for and where they come from.

    Parameters
    ----------
    entries : sequence of (Tex, str or Tex or tuple, Ref)
        Symbol, meaning and place.
    """

    entries: Sequence[tuple[Tex, Inline, Ref]]

    def to_html(self) -> str:
        """Return the block as HTML."""
        entries = "".join(
            f"<div><dt>{to_html(symbol)}</dt><dd>{to_html((*meaning, ', ', place))}</dd></div>"
            for symbol, meaning, place in self._flat()
        )
        return f'<dl class="nomenclature">{entries}</dl>'

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        entries = "".join(
            f"([{to_typst(symbol)}], [{to_typst((*meaning, ', ', place))}]),"
            for symbol, meaning, place in self._flat()
        )
        return f"#nomenclature(({entries}))"

    def _flat(self) -> list[tuple[Tex, tuple[Piece, ...], Ref]]:
        """Return the entries, every meaning a run of pieces."""
        return [
            (symbol, meaning if isinstance(meaning, tuple) else (meaning,), place)
            for symbol, meaning, place in self.entries
        ]


@dataclass(frozen=True, kw_only=True)
class Notice(Block):
    """A remark that must not be overlooked.

    Parameters
    ----------
    heading : str
        One or two words.
    body : sequence of str or Tex or tuple
        A paragraph each.
    """

    heading: str
    body: Sequence[Inline]

    def to_html(self) -> str:
        """Return the block as HTML."""
        body = "".join(f"<p>{to_html(paragraph)}</p>" for paragraph in self.body)
        heading = html.escape(self.heading)
        return (
            f'<aside class="notice" aria-label="{heading}">'
            f"<p><strong>{heading}</strong></p>{body}</aside>"
        )

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        body = "".join(f"[{to_typst(paragraph)}]," for paragraph in self.body)
        return f"#notice({typst_string(self.heading)}, ({body}))"
