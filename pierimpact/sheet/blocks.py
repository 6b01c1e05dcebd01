"""The building blocks of a calculation sheet, each written as HTML and as Typst.

Figures, tables and equations are numbered by the exporters, in the order they come.
"""

import base64
import html
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from pierimpact.sheet.markup import Inline, Tex, tex_length, to_html, to_typst, typst_string
from pierimpact.units import Printed

#: MIME type of what running headers, document properties and paper size need to know.
SHEET_MIME = "application/vnd.pierimpact.sheet+json"
TYPST_MIME = "text/x-typst"
#: What a line of a formula begins with that goes on with the line before it.
CONTINUED = r"\qquad"


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
            f"({typst_string(label)}, {typst_string(text)}),"
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
    """Symbols and what they stand for.

    Parameters
    ----------
    entries : sequence of (Tex, str or Tex or tuple)
        Symbol and meaning.
    """

    entries: Sequence[tuple[Tex, Inline]]

    def to_html(self) -> str:
        """Return the block as HTML."""
        entries = "".join(
            f"<div><dt>{to_html(symbol)}</dt><dd>{to_html(meaning)}</dd></div>"
            for symbol, meaning in self.entries
        )
        return f'<dl class="nomenclature">{entries}</dl>'

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        entries = "".join(
            f"([{to_typst(symbol)}], [{to_typst(meaning)}])," for symbol, meaning in self.entries
        )
        return f"#nomenclature(({entries}))"


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


@dataclass(frozen=True, kw_only=True)
class Column:
    """A column of a table.

    Parameters
    ----------
    heading : str or Tex or tuple
        What it holds.
    align : {"left", "decimal"}, optional
        Numbers are aligned at their decimal points.
    wide : bool, optional
        Whether it takes the width that the others leave.
    """

    heading: Inline
    align: str = "left"
    wide: bool = False


@dataclass(frozen=True, kw_only=True)
class Table(Block):
    """A table with a caption above it.

    Parameters
    ----------
    label : str
        Anchor that text can refer to, such as "tab-inputs".
    caption : str or Tex or tuple
        What it shows.
    columns : sequence of Column
        Its columns.
    rows : sequence of sequences of str or Tex or tuple
        Its rows; the first cell of a row is its heading.
    strong : sequence of int, optional
        Rows that matter most.
    """

    label: str
    caption: Inline
    columns: Sequence[Column]
    rows: Sequence[Sequence[Inline]]
    strong: Sequence[int] = ()

    def _aligned(self) -> list[list[Inline]]:
        """Return the rows, with the numbers of decimal columns padded to equal decimals."""
        columns = [
            align_decimals([row[index] for row in self.rows])
            if column.align == "decimal"
            else [row[index] for row in self.rows]
            for index, column in enumerate(self.columns)
        ]
        return [list(row) for row in zip(*columns, strict=True)]

    def to_html(self) -> str:
        """Return the block as HTML."""
        classes = [f' class="{column.align}"' for column in self.columns]
        head = "".join(
            f'<th scope="col"{kind}>{to_html(column.heading)}</th>'
            for kind, column in zip(classes, self.columns, strict=True)
        )
        body = ""
        for index, row in enumerate(self._aligned()):
            first, *others = map(to_html, row)
            cells = "".join(
                f"<td{kind}>{cell}</td>" for kind, cell in zip(classes[1:], others, strict=True)
            )
            strong = ' class="strong"' if index in self.strong else ""
            body += f'<tr{strong}><th scope="row"{classes[0]}>{first}</th>{cells}</tr>'
        width = "" if any(column.wide for column in self.columns) else ' class="narrow"'
        return (
            f'<div class="table"><table{width} id="{self.label}"><caption>{_numbered("Table")}'
            f"{to_html(self.caption)}</caption><thead><tr>{head}</tr></thead>"
            f"<tbody>{body}</tbody></table></div>"
        )

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        widths = ", ".join("1fr" if column.wide else "auto" for column in self.columns)
        aligns = ", ".join(
            "right" if column.align == "decimal" else "left" for column in self.columns
        )
        head = "".join(f"[{to_typst(column.heading)}]," for column in self.columns)
        cells = "".join(
            f"strong[{to_typst(cell)}]," if index in self.strong else f"[{to_typst(cell)}],"
            for index, row in enumerate(self._aligned())
            for cell in row
        )
        return (
            f"#figure(kind: table, caption: [{to_typst(self.caption)}], "
            f"table(columns: ({widths},), align: ({aligns},), table.header({head}), {cells}"
            f")) <{self.label}>"
        )


@dataclass(frozen=True, kw_only=True)
class Equation:
    """A numbered step: symbol = formula = substitution = result.

    Parameters
    ----------
    label : str
        Anchor that text can refer to, such as "eq-stiffness".
    name : str or Tex or tuple
        What is calculated.
    symbol : str
        Left-hand side, in LaTeX.
    lines : sequence of str
        Right-hand sides in LaTeX, one below the other.
    source : str, optional
        Where the formula is from.
    """

    label: str
    name: Inline
    symbol: str
    lines: Sequence[str]
    source: str = ""

    @property
    def long(self) -> bool:
        """Whether it wants the width of the page."""
        return max(map(tex_length, self.lines)) > 48

    @property
    def tex(self) -> str:
        """The step in LaTeX; lines that are continued have no equals sign."""
        lines = r" \\ ".join(
            f"& {line}" if line.startswith(CONTINUED) else f"&= {line}" for line in self.lines
        )
        return rf"\begin{{aligned}} {self.symbol} {lines} \end{{aligned}}"


@dataclass(frozen=True)
class Steps(Block):
    """Numbered equations, one below the other.

    Parameters
    ----------
    equations : sequence of Equation
        The steps, in the order they are taken.
    """

    equations: Sequence[Equation]

    def to_html(self) -> str:
        """Return the block as HTML."""
        rows = ""
        for step in self.equations:
            source = f"<small>{html.escape(step.source)}</small>" if step.source else ""
            long = " long" if step.long else ""
            rows += (
                f'<div class="step{long}" id="{step.label}"><div>{to_html(step.name)}{source}</div>'
                f'<div class="math display">\\[{html.escape(step.tex)}\\]</div>'
                f'<span class="number" data-count="Equation"></span></div>'
            )
        return f'<div class="steps">{rows}</div>'

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        return "\n".join(
            f"#step([{to_typst(step.name)}], {typst_string(step.source)}, "
            f"[#texblock({typst_string(step.tex)}) <{step.label}>])"
            for step in self.equations
        )


@dataclass(frozen=True, kw_only=True)
class Figure(Block):
    """A drawing with a caption below it.

    Parameters
    ----------
    label : str
        Anchor that text can refer to, such as "fig-history".
    caption : str or Tex or tuple
        What it shows.
    alt : str
        What it shows, for those who cannot see it.
    svg : str
        The drawing.
    """

    label: str
    caption: Inline
    alt: str
    svg: str

    def to_html(self) -> str:
        """Return the block as HTML."""
        data = base64.b64encode(self.svg.encode()).decode()
        return (
            f'<figure id="{self.label}"><img alt="{html.escape(self.alt)}" '
            f'src="data:image/svg+xml;base64,{data}"><figcaption>{_numbered("Figure")}'
            f"{to_html(self.caption)}</figcaption></figure>"
        )

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        image = f'image(bytes({typst_string(self.svg)}), format: "svg", width: 100%, '
        return (
            f"#figure(kind: image, caption: [{to_typst(self.caption)}], "
            f"{image}alt: {typst_string(self.alt)})) <{self.label}>"
        )


def align_decimals(cells: Sequence[Inline]) -> list[Inline]:
    """Pad numbers on the right so that, set flush right, their decimal points stand in line.

    Figure and punctuation spaces are as wide as a figure and a point.
    """
    decimals = [len(cell.partition(".")[2]) if isinstance(cell, str) else 0 for cell in cells]
    longest = max(decimals, default=0)
    padded: list[Inline] = []
    for cell, count in zip(cells, decimals, strict=True):
        if isinstance(cell, str) and cell[-1:].isdigit() and "×" not in cell:
            point = "\u2008" if longest and not count else ""
            padded.append(cell + point + "\u2007" * (longest - count))
        else:
            padded.append(cell)
    return padded


def _numbered(kind: str) -> str:
    return f'<span class="number" data-count="{kind}">{kind}</span> '
