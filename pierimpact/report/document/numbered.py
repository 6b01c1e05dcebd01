"""The numbered blocks of a calculation sheet: tables, equations and figures.

The exporters number them in the order of the document.
"""

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

from pierimpact.report.document.blocks import Block
from pierimpact.report.document.markup import Inline, Part, tex_length

#: Beginning of a line that continues the line of a formula before it.
CONTINUED = r"\qquad"


@dataclass(frozen=True, kw_only=True)
class Column(Part):
    """A column of a table."""

    heading: Inline
    align: str = "left"  #: or "decimal", with decimal points in line
    wide: bool = False  #: whether it takes the width that the other columns leave


def decimal(heading: Inline) -> Column:
    """Return a column of numbers with their decimal points in line."""
    return Column(heading=heading, align="decimal")


def wide(heading: Inline) -> Column:
    """Return a column that takes the width that the other columns leave."""
    return Column(heading=heading, wide=True)


def columns(*headings: Inline | Column) -> list[Column]:
    """Return the columns of a table; those not given as `decimal` or `wide` are plain."""
    return [part if isinstance(part, Column) else Column(heading=part) for part in headings]


@dataclass(frozen=True, kw_only=True)
class Table(Block):
    """A table with a caption above it."""

    label: str  #: anchor that text can refer to, such as "tab-inputs"
    caption: Inline
    columns: Sequence[Column]
    rows: Sequence[Sequence[Inline]]  #: its rows; the first cell of a row is its heading
    strong: Sequence[int] = ()  #: indices of the rows in bold
    centred: bool = False  #: whether cells are centred vertically, for tall formulas

    def data(self) -> dict[str, Any]:
        """Return the data, with the numbers of decimal columns padded to equal decimals."""
        data = super().data()
        for index, column in enumerate(self.columns):
            if column.align == "decimal":
                cells = align_decimals([row[index] for row in data["rows"]])
                for row, cell in zip(data["rows"], cells, strict=True):
                    row[index] = cell
        return data


@dataclass(frozen=True, kw_only=True)
class Equation(Part):
    """A numbered step: symbol = formula = substitution = result."""

    label: str  #: anchor that text can refer to, such as "eq-stiffness"
    name: Inline  #: name of the calculated quantity
    symbol: str  #: left-hand side, in LaTeX
    lines: Sequence[str]  #: right-hand sides in LaTeX, one below the other
    source: Inline = ""  #: where the formula is from

    def data(self) -> dict[str, Any]:
        """Return the data, with the step as one formula, and whether it needs the page's width.

        Lines that are continued have no equals sign.
        """
        lines = r" \\ ".join(
            f"& {line}" if line.startswith(CONTINUED) else f"&= {line}" for line in self.lines
        )
        return super().data() | {
            "tex": rf"\begin{{aligned}} {self.symbol} {lines} \end{{aligned}}",
            "long": max(map(tex_length, self.lines)) > 48,
        }


@dataclass(frozen=True)
class Steps(Block):
    """Numbered equations, one below the other."""

    equations: Sequence[Equation]  #: the steps, in the order of the calculation


@dataclass(frozen=True, kw_only=True)
class Figure(Block):
    """A drawing with a caption below it."""

    label: str  #: anchor that text can refer to, such as "fig-history"
    caption: Inline
    alt: str  #: description for readers who cannot see it
    svg: str
    lead: Inline = ""  #: words above it, on the same page


def align_decimals(cells: Sequence[Inline]) -> list[Inline]:
    """Pad numbers on the right so that, set flush right, their decimal points stand in line.

    Large numbers with a power of ten are written out below or above others without one; other
    powers, and ranges, stand as they are.

    Figure and punctuation spaces are as wide as a figure and a point.
    """
    if any(isinstance(cell, str) and _PLAIN.fullmatch(cell) for cell in cells):
        cells = [
            _LARGE.sub(_written_out, cell) if isinstance(cell, str) else cell for cell in cells
        ]
    decimals = [
        len(cell.partition(".")[2]) if isinstance(cell, str) and "–" not in cell else 0
        for cell in cells
    ]
    longest = max(decimals, default=0)
    padded: list[Inline] = []
    for cell, count in zip(cells, decimals, strict=True):
        if isinstance(cell, str) and cell[-1:].isdigit() and not {"×", "–"} & set(cell):
            point = "\u2008" if longest and not count else ""
            padded.append(cell + point + "\u2007" * (longest - count))
        else:
            padded.append(cell)
    return padded


# A number other than zero without a power of ten, and one with a power that is written out.
_PLAIN = re.compile("−?(?=.*[1-9])[0-9.\u202f]+")
_LARGE = re.compile("([0-9.]+)×10([⁴-⁹])")


def _written_out(number: re.Match[str]) -> str:
    """Return a number with a power of ten as its figures, such as "11 389 000"."""
    size = Decimal(number[1]).scaleb(unicodedata.digit(number[2]))
    return f"{size:,f}".replace(",", "\u202f")
