"""Weigh-in-motion samples: a CSV file with the mass of each truck, and perhaps its speed."""

import hashlib
import io
from pathlib import Path

import numpy as np

from pierimpact.checks import InputError, brief, did_you_mean
from pierimpact.files.csv_lines import csv_rows, heading_and_rows, in_row, name_and_unit, numbers
from pierimpact.files.limits import POSSIBLE
from pierimpact.files.reading import read_text
from pierimpact.risk.traffic import WeighedTrucks
from pierimpact.units import parse

_EXAMPLE = "such as: mass [t], speed [km/h]"
_COLUMNS = {"mass": "mass", "speed": "speed"}
_LIMITS = {"mass": "truck_mass", "speed": "speed"}
_MOST = 64_000_000  # bytes; this project's choice


def read_weigh_in_motion(path: Path) -> WeighedTrucks:
    """Return the trucks of a CSV file, one a row.

    The first line that is neither empty nor a comment (#) names the columns with their units, mass
    and if there is one speed, in any order. Columns are parted by commas, semicolons or tabs;
    decimals have a point, or a comma where that can part neither columns nor thousands.

    Raises
    ------
    InputError
        When the file cannot be read or breaks a rule; the message is one line and names the row.
    """
    try:
        content, text = read_text(path, _MOST)
        columns = _columns(text)
    except InputError as error:
        raise InputError(f"{path.name}: {error}") from None
    mass, speed = (np.array(columns[name]) if name in columns else None for name in _COLUMNS)
    assert mass is not None
    sha256 = hashlib.sha256(content).hexdigest()
    words = f"{len(mass)} trucks of {path.name}, SHA-256 {sha256[:12]}…"
    return WeighedTrucks(mass=mass, speed=speed, words=words)


def _columns(text: str) -> dict[str, list[float]]:
    """Return the values of the columns by their names, in SI units."""
    lines = io.StringIO(text, newline="")
    heading, body = heading_and_rows(csv_rows(lines, comments=True), _EXAMPLE)
    with in_row(heading.number):
        sizes = _sizes(heading.cells)
    found: dict[str, list[float]] = {name: [] for name in sizes}
    for row, values in numbers(body, list(sizes)):
        for name, cell, value in zip(sizes, row.cells, values, strict=True):
            if not value > 0.0:
                raise InputError(f"row {row.number}: {name} must be positive, got {brief(cell)}")
            if value * sizes[name] > POSSIBLE[_LIMITS[name]][1]:
                raise InputError(
                    f"row {row.number}: {name} is beyond any truck’s, got {brief(cell)}"
                )
            found[name].append(value * sizes[name])
    if not found["mass"]:
        raise InputError("must have a row for each truck, got none")
    return found


def _sizes(cells: list[str]) -> dict[str, float]:
    """Return the sizes of the columns' units in SI by name, in order."""
    sizes: dict[str, float] = {}
    for cell in cells:
        name, unit = name_and_unit(cell)
        if not unit or name not in _COLUMNS:
            raise InputError(
                f"the heading must name mass, and speed if it is known, with their units, "
                f"{_EXAMPLE}; got {brief(cell)}{did_you_mean(name, _COLUMNS) if unit else ''}"
            )
        if name in sizes:
            raise InputError(f"{name} is given twice")
        sizes[name] = parse(name, f"1 {unit}", _COLUMNS[name])
    if "mass" not in sizes:
        raise InputError(f"there must be a column of masses, {_EXAMPLE}")
    return sizes
