"""The parts of a document as data, and the pieces of its text.

The templates lay them out, and escape all text; mathematics is LaTeX, which the exporters convert.
"""

import re
from dataclasses import dataclass, fields
from typing import Any

from pierimpact.units import Printed


@dataclass(frozen=True)
class Part:
    """A part of a document: data that the templates lay out."""

    def data(self) -> dict[str, Any]:
        """Return the part as JSON can hold it: its type and its fields."""
        return {"type": type(self).__name__} | {
            field.name: _plain(getattr(self, field.name)) for field in fields(self)
        }


def _plain(value: Any) -> Any:
    if isinstance(value, Part):
        return value.data()
    if isinstance(value, dict):  # as pairs: a stored notebook has its keys sorted
        return [list(pair) for pair in value.items()]
    return [_plain(each) for each in value] if isinstance(value, (list, tuple)) else value


@dataclass(frozen=True)
class Tex(Part):
    """Inline mathematics in LaTeX."""

    source: str


@dataclass(frozen=True)
class Code(Part):
    """Text in a typeface of fixed width, such as a file name or a checksum."""

    text: str


@dataclass(frozen=True)
class Link(Part):
    """A link to a file in the folder of the page; in the PDF, its text alone."""

    text: str
    file_name: str


@dataclass(frozen=True)
class PageLink(Part):
    """A link to a page of the binder that this document is bound into; elsewhere, its text."""

    text: str
    page: int


@dataclass(frozen=True)
class Ref(Part):
    """A reference to an equation, table or figure, which prints as its name and number."""

    kind: str
    label: str


Piece = str | Tex | Code | Link | PageLink | Ref
Inline = Piece | tuple[Piece, ...]  #: one piece of text, or a run of them


def inline(text: str) -> Inline:
    """Return text with mathematics between dollar signs."""
    pieces = text.split("$")
    run = [Tex(piece) if index % 2 else piece for index, piece in enumerate(pieces) if piece]
    return tuple(run) if len(run) != 1 else run[0]


def tex_length(source: str) -> int:
    """Return about how many characters wide a formula is."""
    plain = re.sub(r"\\(text|mathrm|operatorname)\{([^}]*)\}", r"\2", source)
    wider = re.compile(r"\\frac\{([^{}]*)\}\{([^{}]*)\}")
    while wider.search(plain):  # of a fraction, its longer side
        plain = wider.sub(lambda sides: max(sides[1], sides[2], key=len), plain)
    return len(re.sub(r"\\[a-z]+|[\s{}^_\\]", "", plain.replace(r"\times", "·")))


def plain(words: Any) -> str:
    """Return about what data of text print, a piece or a run of pieces, for their length."""
    if isinstance(words, str):
        return words
    if isinstance(words, list):
        return "".join(map(plain, words))
    if words["type"] == "Tex":
        return "x" * tex_length(words["source"])
    return str(words.get("text") or f"{words['kind']} (99)")


def in_tex(value: Printed) -> str:
    """Return a printed value with its unit as LaTeX."""
    return number_in_tex(value) + (rf"\ \text{{{value.unit}}}" if value.unit else "")


def number_in_tex(value: Printed) -> str:
    """Return a printed value without its unit as LaTeX."""
    mantissa, times, power = value.number.partition("×10")
    number = mantissa.replace("−", "-").replace("\u202f", r"\,")
    return rf"{number} \times 10^{{{power.translate(_PLAIN_DIGITS)}}}" if times else number


_PLAIN_DIGITS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
