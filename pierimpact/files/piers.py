"""Tables of piers: CSV or Parquet, a row each, with the keys of case files as columns.

A heading names a key, with its unit in brackets unless the cells have units: `speed [km/h]`.
Columns are parted by commas, semicolons or tabs; decimals have a point, or a comma where that can
part neither columns nor thousands. The table is read in pieces, so that it may be larger than
memory.
"""

import hashlib
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any, Literal, NamedTuple, get_origin

from pierimpact.checks import InputError, brief, did_you_mean, one_line
from pierimpact.files.csv_lines import (
    NUMBER,
    Comma,
    Row,
    csv_rows,
    decimal,
    heading_and_rows,
    name_and_unit,
    with_point,
    with_unit,
)
from pierimpact.files.inputs import Inputs, Text, is_auto
from pierimpact.files.keys import quantity_of
from pierimpact.files.reading import require_regular
from pierimpact.symbols import BY_KEY
from pierimpact.units import DIMENSIONS, parse

#: Where a pier is, in degrees, with the largest that each may be.
PLACE = {"latitude": 90.0, "longitude": 180.0}  # exactly
#: Keys of a case file that are no cell: lists, and what belongs to one sheet.
_NOT_IN_TABLES = (
    *("office", "logo", "units", "steps", "assumed", "sources", "notes", "revisions"),
    *("supersedes", "annexes", "traffic_trucks"),
)
KEYS = tuple(key for key in Inputs.model_fields if key not in _NOT_IN_TABLES)
#: The columns that a table may have, and those that it must have.
COLUMNS = ("id", *PLACE, *KEYS)
REQUIRED = ("id", *(key for key in KEYS if Inputs.model_fields[key].is_required()))
#: Those whose cells are plain numbers.
PLAIN = (
    *PLACE,
    *(
        key
        for key in KEYS
        if key in BY_KEY
        and not quantity_of(key)
        and get_origin(Inputs.model_fields[key].annotation) is not Literal
        and Inputs.model_fields[key].annotation != Text | None
    ),
)


class Column(NamedTuple):
    """A column of a table."""

    key: str
    unit: str = ""  #: of its cells; "" where they have their own or need none

    @property
    def is_number(self) -> bool:
        """Whether its cells are numbers, with or without a unit."""
        return self.key in PLAIN or self.dimension != ""

    @property
    def dimension(self) -> str:
        """What its values are, of `units.DIMENSIONS`; "" where they have no unit."""
        return quantity_of(self.key) if self.key in KEYS else ""


class Pier(NamedTuple):
    """A pier of a table, checked cell by cell."""

    name: str  #: its id
    place: tuple[float, float]  #: latitude and longitude [°]; nan where not given
    values: dict[str, object]  #: by key, as a case file has them


@dataclass(frozen=True, kw_only=True)
class PierTable:
    """A table of piers whose heading and ids have passed every check."""

    path: Path
    sha256: str  #: of the file's bytes, in hexadecimal
    columns: tuple[Column, ...]
    size: int  #: number of rows, the heading not among them
    trucks: tuple[str, ...]  #: that the rows name, sorted
    has_commas: bool  #: whether some decimal has a comma

    def pieces(self, rows: int) -> Iterator[list[Row]]:
        """Yield the rows in order, so many at a time."""
        _, body = _open(self.path)
        if self.has_commas:
            body = (row._replace(comma=Comma.SOME) for row in body)
        while piece := list(islice(body, rows)):
            yield piece

    def pier(self, row: Row) -> Pier:
        """Return the pier of a row.

        Raises
        ------
        InputError
            When a cell breaks a rule; the message begins with its column.
        """
        return pier_of(self.columns, row)


def read_pier_table(path: str | Path) -> PierTable:
    """Return a table of piers, once its heading and all ids are checked.

    Raises
    ------
    InputError
        When it cannot be read; when a column is unknown, missing, there twice or without unit; when
        an id is there twice. The message is one line.
    """
    path = Path(path)
    try:
        require_regular(path)
        with path.open("rb") as file:
            sha256 = hashlib.file_digest(file, "sha256").hexdigest()
        heading, body = _open(path)
        columns = _columns(heading)
        size, trucks, commas = _survey(columns, body)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: is not UTF-8 text") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    return PierTable(
        path=path, sha256=sha256, columns=columns, size=size, trucks=trucks, has_commas=commas
    )


def pier_of(columns: Iterable[Column], row: Row) -> Pier:
    """Return the pier of a row; errors as in `PierTable.pier`."""
    columns = tuple(columns)
    if len(row.cells) != len(columns):
        hint = ""
        if len(row.cells) > len(columns) and not row.comma:
            hint = "; a cell with a comma in it must be in quotes"
        raise InputError(f"the row must have {len(columns)} cells, got {len(row.cells)}{hint}")
    values: dict[str, object] = {}
    for column, text in zip(columns, row.cells, strict=True):
        if cell := text.strip():
            values[column.key] = _value(column, cell, comma=row.comma)
    if "id" not in values:
        raise InputError("id is missing")
    name = one_line("id", str(values.pop("id")))
    latitude, longitude = (values.pop(key, math.nan) for key in PLACE)
    place = float(str(latitude)), float(str(longitude))
    for (key, most), other, degrees in zip(PLACE.items(), place[::-1], place, strict=True):
        if math.isnan(degrees) and not math.isnan(other):
            raise InputError(f"{key} is missing: a place needs both")
        if abs(degrees) > most:
            raise InputError(f"{key} must be from −{most:g} to {most:g}°, got {degrees:g}")
    return Pier(name, place, values)


def _value(column: Column, cell: str, *, comma: Comma) -> object:
    if column.key in PLAIN:
        return float(decimal(column.key, cell, comma=comma, kind="a plain number"))
    if column.unit and not (column.key == "impact_height" and is_auto(cell)):
        return with_unit(column.key, cell, column.unit, comma=comma)
    return with_point(column.key, cell, comma=comma) if column.dimension else cell


def _open(path: Path) -> tuple[list[str], Iterator[Row]]:
    """Return the heading of a file and its rows."""
    rows = _parquet(path) if path.suffix.lower() == ".parquet" else _csv(path)
    heading, body = heading_and_rows(rows, "such as: id, speed [km/h], …")
    return heading.cells, body


def _csv(path: Path) -> Iterator[Row]:
    """Yield the rows of a CSV file, the heading first."""
    with path.open(encoding="utf-8-sig", newline="") as file:
        yield from csv_rows(file)


def _parquet(path: Path) -> Iterator[Row]:
    """Yield the names of a Parquet file's columns and its rows, as text."""
    try:
        import pyarrow
        import pyarrow.parquet
    except ModuleNotFoundError:
        raise InputError("Parquet needs pyarrow: pip install 'pierimpact[network]'") from None
    try:
        file: Any = pyarrow.parquet.ParquetFile(path)
    except pyarrow.ArrowException as error:
        raise InputError(f"not a Parquet file: {str(error).partition(chr(10))[0]}") from None
    with file:
        yield Row(1, list(file.schema_arrow.names))
        number = 1
        for batch in file.iter_batches(batch_size=10_000):
            for cells in zip(*(column.to_pylist() for column in batch.columns), strict=True):
                number += 1
                yield Row(number, ["" if cell is None else str(cell) for cell in cells])


def _columns(heading: Iterable[str]) -> tuple[Column, ...]:
    columns: list[Column] = []
    for cell in heading:
        key, unit = name_and_unit(cell)
        if key not in COLUMNS:
            raise InputError(f"{brief(cell)} is no column of piers{did_you_mean(key, COLUMNS)}")
        column = Column(key)
        if column.dimension and unit:
            parse(key, f"1 {unit}", column.dimension)
            column = Column(key, unit)
        elif unit and not (unit == "-" and key in PLAIN) and not (key in PLACE and unit == "°"):
            raise InputError(f"{key} has no unit, got {brief(cell)}")
        if key in (other.key for other in columns):
            raise InputError(f"the column {key} is there twice")
        columns.append(column)
    keys = [column.key for column in columns]
    missing = [key for key in REQUIRED if key not in keys]
    if missing:
        several = len(missing) > 1
        raise InputError(
            f"the column{'s' * several} {', '.join(missing)} {'are' if several else 'is'} missing"
        )
    if ("latitude" in keys) != ("longitude" in keys):
        raise InputError("latitude and longitude belong together, one of them is missing")
    return tuple(columns)


def _survey(columns: tuple[Column, ...], body: Iterable[Row]) -> tuple[int, tuple[str, ...], bool]:
    """Return the number of rows, the trucks named, and whether some decimal has a comma.

    Ids that are there twice and numbers without unit are refused.
    """
    keys = [column.key for column in columns]
    name, truck = keys.index("id"), keys.index("truck")
    # Columns whose cells must have units: the first cell tells whether the unit was forgotten.
    waiting = {
        i: column for i, column in enumerate(columns) if column.dimension and not column.unit
    }
    seen: dict[str, int] = {}
    trucks, size, commas = set(), 0, False
    of_numbers = [place for place, column in enumerate(columns) if column.is_number]
    for row in body:
        size += 1
        if len(row.cells) != len(columns):
            continue
        commas = commas or row.has_comma(of_numbers)
        if own := row.cells[name].strip():
            if own in seen:
                raise InputError(
                    f"id {brief(own)} is given twice, in rows {seen[own]} and {row.number}"
                )
            seen[own] = row.number
        trucks.add(row.cells[truck].strip())
        for i, column in list(waiting.items()):
            if cell := row.cells[i].strip():
                del waiting[i]
                if NUMBER.fullmatch(cell.replace(",", ".") if row.comma else cell):
                    unit = DIMENSIONS[column.dimension].units.partition(",")[0]
                    raise InputError(
                        f"{column.key} has no unit in row {row.number}: write it in the heading, "
                        f"as {column.key} [{unit}], or in each cell"
                    )
    if not size:
        raise InputError("must have a row for each pier, got none")
    return size, tuple(sorted(trucks - {""})), commas
