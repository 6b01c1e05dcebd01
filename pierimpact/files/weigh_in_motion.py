"""Weigh-in-motion samples: a CSV file with the mass of each truck, and perhaps its speed."""

import hashlib
import math
import re
from pathlib import Path

import numpy as np

from pierimpact.checks import InputError, brief, did_you_mean
from pierimpact.files.csv_lines import csv_cells, csv_lines
from pierimpact.files.limits import POSSIBLE
from pierimpact.files.reading import read_text
from pierimpact.risk.traffic import WeighedTrucks
from pierimpact.units import parse

_HEADING = re.compile(r"\s*(\w+)\s*\[\s*(.*?)\s*\]\s*")
_EXAMPLE = "such as: mass [t], speed [km/h]"
_COLUMNS = {"mass": "mass", "speed": "speed"}
_LIMITS = {"mass": "truck_mass", "speed": "speed"}
_MOST = 64_000_000  # bytes; this project's choice


def read_weigh_in_motion(path: Path) -> WeighedTrucks:
    """Return the trucks of a CSV file, one a row.

    The first line that is neither empty nor a comment (#) names the columns with their units, mass
    and if there is one speed, in any order. Numbers have decimal points; columns are parted by
    commas, semicolons or tabs.

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
    ((first, heading), *rest), separator = csv_lines(text, _EXAMPLE)
    sizes = _sizes(first, csv_cells(first, heading, separator))
    found: dict[str, list[float]] = {name: [] for name in sizes}
    for row, line in rest:
        cells = csv_cells(row, line, separator)
        if len(cells) != len(sizes):
            raise InputError(f"row {row}: must have {len(sizes)} columns, got {len(cells)}")
        for (name, size), cell in zip(sizes.items(), cells, strict=True):
            value = _positive(row, name, cell) * size
            if value > POSSIBLE[_LIMITS[name]][1]:
                raise InputError(f"row {row}: {name} is beyond any truck’s, got {brief(cell)}")
            found[name].append(value)
    if not rest:
        raise InputError("must have a row for each truck, got none")
    return found


def _sizes(row: int, cells: list[str]) -> dict[str, float]:
    """Return the sizes of the columns' units in SI by name, in order."""
    sizes: dict[str, float] = {}
    for cell in cells:
        match = _HEADING.fullmatch(cell)
        name = match[1].lower() if match else ""
        if match is None or name not in _COLUMNS:
            hint = did_you_mean(name, _COLUMNS) if name else ""
            raise InputError(
                f"row {row}: the heading must name mass, and speed if it is known, with their "
                f"units, {_EXAMPLE}; got {brief(cell)}{hint}"
            )
        if name in sizes:
            raise InputError(f"row {row}: {name} is given twice")
        try:
            sizes[name] = parse(name, f"1 {match[2]}", _COLUMNS[name])
        except InputError as error:
            raise InputError(f"row {row}: {error}") from None
    if "mass" not in sizes:
        raise InputError(f"row {row}: there must be a column of masses, {_EXAMPLE}")
    return sizes


def _positive(row: int, name: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        raise InputError(f"row {row}: {name} must be a number, got {brief(cell)}") from None
    if not (math.isfinite(value) and value > 0.0):
        raise InputError(f"row {row}: {name} must be positive, got {brief(cell)}")
    return value
