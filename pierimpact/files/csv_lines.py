"""What all CSV files have in common: rows, headings with units, and the numbers of their cells."""

import csv
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from enum import IntEnum
from itertools import chain
from typing import NamedTuple

from pierimpact.checks import InputError, brief, shortened
from pierimpact.units import DECIMALS, DIGITS

#: A decimal number, or a word for one that is not finite.
NUMBER = re.compile(rf"[-+]?(?:{DIGITS}|nan|inf(?:inity)?)", re.ASCII | re.IGNORECASE)
# At the start of a cell; three digits after a mark may be thousands, which is not for us to tell.
_TYPED = re.compile(r"[-+]?[\d.,]+", re.ASCII)
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}(?:,\d{3})+", re.ASCII)
_POINTS = re.compile(r"[-+]?[1-9]\d{0,2}(?:\.\d{3})+", re.ASCII)
_COMMA = re.compile(r"^(?![-+]?[1-9]\d{0,2},\d{3}(?!\d))([-+]?\d*),(\d+)(?![\d.,])", re.ASCII)
_HEADING = re.compile(r"([^\[\]]*)(?:\[([^\[\]]*)\])?")
_MOST_CHARACTERS = 10_000  # of a cell; a stray quotation mark would swallow the file


class Comma(IntEnum):
    """Whether the decimals of a table have a comma."""

    NONE = 0  #: none may, for a comma parts columns
    MAY = 1
    SOME = 2  #: some do, so that a point may part thousands


class Row(NamedTuple):
    """A row of a table, unchecked."""

    number: int  #: as a spreadsheet counts it: the first line is row 1
    cells: list[str]
    comma: Comma = Comma.NONE

    def has_comma(self, places: Iterable[int]) -> bool:
        """Return whether a decimal in these columns has a comma for certain."""
        own = (self.cells[place] for place in places if place < len(self.cells))
        return self.comma > 0 and any("," in cell and _COMMA.match(cell.strip()) for cell in own)


def csv_rows(lines: Iterable[str], *, comments: bool = False) -> Iterator[Row]:
    """Yield the rows of lines that are not empty, nor comments (#) where there may be any.

    The first is the heading, and it decides: a semicolon or a tab in it parts the columns, and else
    a comma. Errors begin with the number of the row.
    """
    kept = ("" if comments and line.lstrip().startswith("#") else line for line in lines)
    empty, heading = next(((n, line) for n, line in enumerate(kept) if line.strip()), (0, ""))
    mark = next((mark for mark in ";\t" if mark in heading), ",")
    reader = csv.reader(chain([heading], kept), delimiter=mark, skipinitialspace=True, strict=True)
    try:
        for number, cells in enumerate(reader, empty + 1):
            if max(map(len, cells), default=0) > _MOST_CHARACTERS:
                raise InputError(f"row {number}: a quotation mark is not closed")
            if "".join(cells).strip():
                yield Row(number, cells, Comma.NONE if mark == "," else Comma.MAY)
    except csv.Error as error:
        raise InputError(f"row {empty + reader.line_num}: not valid CSV: {error}") from None


def heading_and_rows(rows: Iterator[Row], example: str) -> tuple[Row, Iterator[Row]]:
    """Return the heading, of which `example` is one, and the rows after it."""
    heading = next(rows, None)
    if heading is None:
        raise InputError(f"must have a heading, {example}; got nothing")
    return heading, rows


@contextmanager
def in_row(number: int) -> Iterator[None]:
    """Let what is wrong begin with the number of the row."""
    try:
        yield
    except InputError as error:
        raise InputError(f"row {number}: {error}") from None


def name_and_unit(heading: str) -> tuple[str, str]:
    """Return the name of a column, in small letters, and its unit, "" where it has none."""
    match = _HEADING.fullmatch(heading.strip())
    name, unit = (match[1], match[2] or "") if match else (heading, "")
    return " ".join(name.lower().split()), unit.strip()


def with_commas(rows: Sequence[Row], places: Sequence[int]) -> Iterator[Row]:
    """Yield rows that know whether any decimal in the columns of numbers has a comma."""
    some = any(row.has_comma(places) for row in rows)
    return (row._replace(comma=Comma.SOME) if some else row for row in rows)


def numbers(rows: Iterable[Row], names: Sequence[str]) -> Iterator[tuple[Row, list[float]]]:
    """Yield rows that have a number in each column, with their numbers; errors name the row."""
    for row in with_commas(list(rows), range(len(names))):
        with in_row(row.number):
            if len(row.cells) != len(names):
                hint = ""
                if not row.comma and len(row.cells) == 2 * len(names):
                    hint = "; write decimals with a point, or part the columns by semicolons"
                raise InputError(f"must have {len(names)} columns, got {len(row.cells)}{hint}")
            pairs = zip(names, row.cells, strict=True)
            found = [float(decimal(name, cell, comma=row.comma)) for name, cell in pairs]
        yield row, found


def decimal(name: str, text: str, *, comma: Comma = Comma.NONE, kind: str = "a number") -> str:
    """Return a finite decimal number as a text that Python reads, with a point.

    `text` is a cell or what was typed elsewhere, `comma` whether its decimals may have a comma;
    errors name `name` and `kind`.
    """
    number, text = with_point(name, text, comma=comma), text.strip()
    if not text:
        raise InputError(f"{name} is blank")
    if not NUMBER.fullmatch(number):
        hint = f": {DECIMALS}" if re.search(r"\d,\d", text) else ""
        raise InputError(f"{name} must be {kind}, got {brief(text)}{hint}")
    if not math.isfinite(float(number)):
        raise InputError(f"{name} must be finite, got {shortened(text, 40)}")
    return number


def _either(number: str, mark: str) -> str:
    """Return how to write a number if its mark parts thousands, and how if it parts decimals."""
    plain = number.replace(mark, "")
    return f"{number}0 or {plain}" if number.count(mark) == 1 else plain


def with_unit(name: str, text: str, unit: str, *, comma: Comma = Comma.NONE) -> str:
    """Return the number of a cell with the unit of its heading; errors as in `decimal`."""
    kind = f"a number, for its unit {unit} is in the heading"
    return f"{decimal(name, text, comma=comma, kind=kind)} {unit}"


def with_point(name: str, text: str, *, comma: Comma) -> str:
    """Return a cell with a point for the comma of the number at its start, where it may have one.

    Three digits after a comma may be thousands, as in 1,250, and so may three after a point where
    other decimals have a comma: errors that name `name`.
    """
    text = text.strip()
    if not comma or not ("," in text or "." in text):
        return text
    typed = _TYPED.match(text)
    number = typed[0] if typed else ""
    marks = "," if _THOUSANDS.fullmatch(number) else ""
    if comma == Comma.SOME and _POINTS.fullmatch(number):
        marks = "."
    if marks:
        why = "its comma may" if marks == "," else "other decimals have a comma, so its point may"
        raise InputError(
            f"{name} must be a number, got {brief(text)}: {why} part thousands; write "
            f"{_either(number, marks)}"
        )
    if "," in number and "." in number:
        raise InputError(
            f"{name} must be a number, got {brief(text)}: thousands have no mark, decimals a point "
            "or a comma"
        )
    return _COMMA.sub(r"\1.\2", text)
