"""Force records: a CSV file of times and forces, whose heading names quantities and units."""

import hashlib
import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError, brief, did_you_mean
from pierimpact.collision.records import FEWEST, QUANTITIES
from pierimpact.files.csv_lines import csv_rows, heading_and_rows, in_row, name_and_unit, numbers
from pierimpact.files.reading import read_text
from pierimpact.units import parse

Array = NDArray[np.float64]

_EXAMPLE = "such as: time [ms], contact force [kN]"
_DIMENSIONS = {"time": "time"} | dict.fromkeys(QUANTITIES, "force")
_MOST = 4_000_000  # bytes, some 200,000 rows: this project's choice
_LARGEST = {"time": 1e3, "force": 1e10}  # [s], [N]: this project's choice, beyond any record
_GAP = 10.0  # times the usual step, from which one is a gap; this project's choice


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordFile:
    """What a file of a force record says."""

    name: str  #: without its folder
    sha256: str  #: of the file's bytes, in hexadecimal
    quantity: str  #: "contact force" or "reaction"
    time: Array  #: shape (n,) [s]
    force: Array  #: shape (n,), compression positive [N]


def read_record_file(path: str | Path) -> RecordFile:
    """Return the record of a CSV file.

    The first line that is neither empty nor a comment (#) is the heading; it names the time and one
    of "contact force" and "reaction", each with its unit in brackets. Columns are parted by commas,
    semicolons or tabs; decimals have a point, or a comma where that can part neither columns nor
    thousands.

    Raises
    ------
    InputError
        When the file cannot be read or breaks a rule; the message is one line and names the row.
    """
    path = Path(path)
    try:
        content, text = read_text(path, _MOST)
        quantity, time, force = _columns(text)
    except InputError as error:
        raise InputError(f"{path.name}: {error}") from None
    sha256 = hashlib.sha256(content).hexdigest()
    return RecordFile(name=path.name, sha256=sha256, quantity=quantity, time=time, force=force)


def _columns(text: str) -> tuple[str, Array, Array]:
    """Return the quantity, times [s] and forces [N] of a file's text."""
    lines = io.StringIO(text, newline="")
    heading, body = heading_and_rows(csv_rows(lines, comments=True), _EXAMPLE)
    with in_row(heading.number):
        names, sizes = _heading(heading.cells)
    rows = [(row.number, found) for row, found in numbers(body, names)]
    if len(rows) < FEWEST:
        raise InputError(f"must have at least {FEWEST} rows of numbers, got {len(rows)}")
    places = [number for number, _ in rows]
    values = np.array([row for _, row in rows])
    most = np.array([_LARGEST[_DIMENSIONS[name]] for name in names])
    for row, column in np.argwhere(np.abs(values) > most / sizes):
        raise InputError(
            f"row {places[row]}: {names[column]} is beyond any record, got {values[row, column]:g}"
        )
    values *= sizes
    column = names.index("time")
    time, force = values[:, column], values[:, 1 - column]
    _check_times(time, places)
    if not np.max(force) > max(force[0], 0.0):
        largest = values[:, 1 - column].max() / sizes[1 - column]
        raise InputError(
            f"there is no impact in it: {names[1 - column]} (compression is positive) never rises, "
            f"its largest value is {largest:g}"
        )
    return names[1 - column], time, force


def _heading(cells: list[str]) -> tuple[list[str], Array]:
    """Return the names of the two columns and the sizes of their units in SI."""
    names, sizes = [], []
    for cell in cells:
        name, unit = name_and_unit(cell)
        if not unit:
            raise InputError(
                f"the heading must name each quantity with its unit, {_EXAMPLE}; got {brief(cell)}"
            )
        if name not in _DIMENSIONS:
            raise InputError(
                f"{brief(name)} is not one of {', '.join(_DIMENSIONS)}"
                f"{did_you_mean(name, _DIMENSIONS)}"
            )
        sizes.append(parse(name, f"1 {unit}", _DIMENSIONS[name]))
        names.append(name)
    if len(names) != 2 or names.count("time") != 1:
        raise InputError(
            f"the heading must name time and one force, {_EXAMPLE}; got {', '.join(names)}"
        )
    return names, np.array(sizes)


def _check_times(time: Array, places: list[int]) -> None:
    """Refuse times that do not ascend or leave a gap; `places` are the rows they are from."""
    steps = np.diff(time)
    if np.any(steps <= 0.0):
        here = int(np.argmax(steps <= 0.0))
        raise InputError(
            f"row {places[here + 1]}: time must ascend, "
            f"{1e3 * time[here + 1]:g} ms follows {1e3 * time[here]:g} ms"
        )
    usual = float(np.median(steps))
    if np.max(steps) > _GAP * usual:
        here = int(np.argmax(steps > _GAP * usual))
        raise InputError(
            f"row {places[here + 1]}: there is a gap of {1e3 * steps[here]:.4g} ms before it, "
            f"where the usual step is {1e3 * usual:.4g} ms"
        )
