"""Text and mathematics, written as HTML and as Typst.

Mathematics is LaTeX in both, between marks that the exporters replace (JupyterLab typesets those
of the HTML by itself). Text is never markup: it is escaped in HTML, and is a string literal in
Typst.
"""

import html
import re
from dataclasses import dataclass
from urllib.parse import quote

from pierimpact.units import Printed


@dataclass(frozen=True)
class Tex:
    """Inline mathematics in LaTeX."""

    source: str


@dataclass(frozen=True)
class Code:
    """Text to be typed or compared letter by letter."""

    text: str


@dataclass(frozen=True)
class Link:
    """Text that leads to a file beside the page; on paper, the text alone."""

    text: str
    file_name: str


@dataclass(frozen=True)
class Ref:
    """The name and number of an equation, table or figure, and the way to it."""

    kind: str
    label: str


Piece = str | Tex | Code | Link | Ref
Inline = Piece | tuple[Piece, ...]  #: one piece of text, or a run of them


def to_html(inline: Inline) -> str:
    """Return text and mathematics as HTML."""
    if isinstance(inline, tuple):
        return "".join(map(to_html, inline))
    if isinstance(inline, Tex):
        return rf'<span class="math">\({html.escape(inline.source)}\)</span>'
    if isinstance(inline, Code):
        return f"<code>{html.escape(inline.text)}</code>"
    if isinstance(inline, Ref):
        return f'<a href="#{inline.label}">{inline.kind}</a>'
    if isinstance(inline, Link):
        # The dot keeps what stands before a colon in a file's name from being a protocol.
        return f'<a href="./{quote(inline.file_name)}">{html.escape(inline.text)}</a>'
    return html.escape(inline)


def to_typst(inline: Inline) -> str:
    """Return text and mathematics as Typst markup."""
    if isinstance(inline, tuple):
        return "".join(map(to_typst, inline))
    if isinstance(inline, Tex):
        return f"#tex({typst_string(inline.source)});"
    if isinstance(inline, Code):
        return f"#raw({typst_string(inline.text)});"
    if isinstance(inline, Ref):
        return f"#link(<{inline.label}>)[{inline.kind}];"
    text = inline.text if isinstance(inline, Link) else inline
    return f"#{typst_string(breakable(text))};"


def breakable(text: str) -> str:
    """Return `text` with spaces of no width in words that would not fit a line of a column.

    Only between ASCII characters, as others may join or stand on one another.
    """
    return re.sub(r"[!-~]{20,}", lambda word: "\u200b".join(word[0]), text)


def typst_string(text: str) -> str:
    """Return `text` as a Typst string literal: nothing in it can act as markup."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + escaped.replace("\n", "\\n").replace("\r", "\\r").replace("\t", "\\t") + '"'


def inline(text: str) -> Inline:
    """Return text with mathematics between dollar signs."""
    pieces = text.split("$")
    run = [Tex(piece) if index % 2 else piece for index, piece in enumerate(pieces) if piece]
    return tuple(run) if len(run) > 1 else text


def in_a_sentence(words: Inline) -> Inline:
    """Return words that begin with a capital as they read within a sentence."""
    first, *others = words if isinstance(words, tuple) else (words,)
    if isinstance(first, str) and not first.startswith("Poisson"):
        first = first[:1].lower() + first[1:]
    return (first, *others) if others else first


def tex_length(source: str) -> int:
    """Return about how many characters wide a formula is."""
    plain = re.sub(r"\\(text|mathrm|operatorname)\{([^}]*)\}", r"\2", source)
    wider = re.compile(r"\\frac\{([^{}]*)\}\{([^{}]*)\}")
    while wider.search(plain):  # of a fraction, its longer side
        plain = wider.sub(lambda sides: max(sides[1], sides[2], key=len), plain)
    return len(re.sub(r"\\[a-z]+|[\s{}^_\\]", "", plain.replace(r"\times", "·")))


def in_tex(value: Printed) -> str:
    """Return a printed value with its unit as LaTeX."""
    return number_in_tex(value) + (rf"\ \text{{{value.unit}}}" if value.unit else "")


def number_in_tex(value: Printed) -> str:
    """Return a printed value without its unit as LaTeX."""
    mantissa, times, power = value.number.partition("×10")
    number = mantissa.replace("−", "-").replace("\u202f", r"\,")
    return rf"{number} \times 10^{{{power.translate(_PLAIN_DIGITS)}}}" if times else number


_PLAIN_DIGITS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
