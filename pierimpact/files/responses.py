"""Cases with their responses, measured or calculated by others, from a CSV file."""

import io
from collections.abc import Mapping
from itertools import islice
from pathlib import Path
from typing import Any

from pierimpact.certainty import Certainty
from pierimpact.checks import InputError, brief, known, one_line, one_of
from pierimpact.collision.parameters import Collision
from pierimpact.design.comparison import RESPONSES, Measured, check_response
from pierimpact.files.case import case_from, loaded
from pierimpact.files.csv_lines import (
    Comma,
    Row,
    csv_rows,
    decimal,
    in_row,
    name_and_unit,
    with_commas,
    with_unit,
)
from pierimpact.files.inputs import PHYSICAL_KEYS
from pierimpact.files.limits import PIER_MASS, PIER_STIFFNESS, possible, within
from pierimpact.files.reading import read_text
from pierimpact.files.trucks import read_truck_file
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.symbols import BY_KEY, dimension
from pierimpact.units import DIMENSIONS, parse

_MOST, _ROWS = 256_000, 300  # bytes, and rows: this project's choice
_TEXTS = ("case", "source", "status", "remark")
_PIER = {"pier_mass": "mass", "pier_stiffness": "stiffness"}
_WITH_PIER = ("truck", "truck_mass", "speed", "damping_ratio")
_CASE = ("truck", *(key for key in PHYSICAL_KEYS if not key.endswith("_resistance")))


def read_responses(path: str | Path) -> list[Measured]:
    """Return the cases of a CSV file, one a row.

    The first row names the columns, in any order. A value's unit stands beside its name, as in
    "speed [mph]"; an empty cell is a value that is not given. Columns are parted by commas,
    semicolons or tabs; decimals have a point, or a comma where that can part neither columns nor
    thousands. The columns:

    - case: what the case is called;
    - source, status: where its responses come from, and how certain they are, in the words of
      truck files (read, secondary, recalled, calibrated, assumed, illustrative);
    - remark: what else to know of them;
    - truck, truck_mass, speed, damping_ratio: as in a case file. A truck of one's own is the path
      of its file, from the folder of the CSV file;
    - pier_mass, pier_stiffness: the pier as one degree of freedom. Or, in their place, the keys
      that describe a column in a case file, such as column_shape, column_diameter, column_height,
      elastic_modulus, density, base and top, with impact_height;
    - responses, at least one a row: peak_reaction, engine_peak and cargo_peak, static forces that
      give the same deflection; peak_contact_force; average_10_ms or any other largest moving
      average of the contact force.

    Raises
    ------
    InputError
        When the file cannot be read, or a row breaks a rule; the message is one line, with the
        number of the row, the first of which has the names.
    """
    path = Path(path)
    try:
        _, text = read_text(path, _MOST)
    except InputError as error:
        raise InputError(f"{path.name} {error}") from None
    units: dict[str, str] = {}
    found: list[Measured] = []
    try:
        rows = csv_rows(io.StringIO(text, newline=""))
        for heading in islice(rows, 1):
            with in_row(heading.number):
                units = _units(heading.cells)
        of_numbers = [place for place, own in enumerate(units.items()) if _is_number(*own)]
        for row in with_commas(list(rows), of_numbers):
            with in_row(row.number):
                if len(found) == _ROWS:
                    raise InputError(f"there must be at most {_ROWS} cases")
                found.append(_measured(_given(units, row), path.parent))
    except InputError as error:
        raise InputError(f"{path.name}, {error}") from None
    if not found:
        raise InputError(f"{path.name} must have a row for each case, got none")
    return found


def _units(headings: list[str]) -> dict[str, str]:
    """Return the columns' units by name, in order; empty for what has none."""
    units: dict[str, str] = {}
    for heading in headings:
        name, unit = name_and_unit(heading)
        if name in units:
            raise InputError(f"{name} is given twice")
        kind = _kind(name)
        if kind and not unit:
            raise InputError(
                f"{name} must have its unit in brackets ({DIMENSIONS[kind].units}), "
                f"got {brief(heading)}"
            )
        if unit and not kind:
            raise InputError(f"{name} has no unit, got {brief(heading)}")
        units[name] = unit
    return units


def _kind(name: str) -> str:
    """Return what a column's values must be, one of `DIMENSIONS`; empty where they have no unit."""
    if name in _PIER:
        return _PIER[name]
    if name.startswith("average"):
        check_response(name)
        return "force"
    known(name, (*_TEXTS, *_PIER, *_CASE, *RESPONSES), "a column")
    if name in RESPONSES:
        return "force"
    return dimension(BY_KEY[name]) if name in BY_KEY else ""


def _given(units: Mapping[str, str], row: Row) -> dict[str, Any]:
    """Return what is in the cells of a row that are not empty, by their columns."""
    if len(row.cells) > len(units):
        raise InputError(f"there must be {len(units)} cells, got {len(row.cells)}")
    pairs = zip(units, row.cells, strict=False)  # empty cells at the end may be left out
    return {
        name: _value(name, one_line(name, cell.strip()), units[name], comma=row.comma)
        for name, cell in pairs
        if cell.strip()
    }


def _is_number(name: str, unit: str) -> bool:
    return unit != "" or (name in BY_KEY and BY_KEY[name].quantity != "")


def _value(name: str, cell: str, unit: str, *, comma: Comma) -> str | float:
    """Return a quantity with its unit, a ratio as a number, and a word as it is."""
    if unit:
        return with_unit(name, cell, unit, comma=comma)
    if _is_number(name, unit):
        return float(decimal(name, cell, comma=comma))
    return cell


def _measured(values: dict[str, Any], folder: Path) -> Measured:
    for name in ("case", "source", "status"):
        if name not in values:
            raise InputError(f"{name} is missing")
    texts = {name: values.pop(name, "") for name in _TEXTS}
    responses = {
        name: parse(name, values.pop(name), "force")
        for name in [*values]
        if name not in _PIER and name not in _CASE
    }
    return Measured(
        name=texts["case"],
        collision=_collision(values, folder),
        responses=responses,
        source=texts["source"],
        status=Certainty(one_of("status", texts["status"], tuple(Certainty))),
        remark=texts["remark"],
    )


def _collision(values: Mapping[str, Any], folder: Path) -> Collision:
    """Return the collision of the keys of a case, or of one with the pier's mass and stiffness."""
    if not any(name in values for name in _PIER):
        case = case_from(values, folder)
        height, damping_ratio = case.impact_heights[0], case.inputs.damping_ratio
        pier = case.column.struck_at(height).equivalent(damping_ratio)
        return Collision(case.truck, pier, case.inputs.speed)
    for name in values:
        if name not in (*_PIER, *_WITH_PIER):
            raise InputError(f"{name} must not be given beside pier_mass and pier_stiffness")
    for name in (*_PIER, "truck", "speed"):
        if name not in values:
            raise InputError(f"{name} is missing")
    mass, stiffness = (
        within(name, parse(name, values[name], kind), ends, kind, values[name])
        for (name, kind), ends in zip(_PIER.items(), (PIER_MASS, PIER_STIFFNESS), strict=True)
    )
    truck = read_truck_file(values["truck"], folder).truck
    if "truck_mass" in values:
        truck = loaded(truck, _possible("truck_mass", values))
    damping = {name: values[name] for name in values if name == "damping_ratio"}
    pier = EquivalentPier(mass=mass, stiffness=stiffness, **damping)
    return Collision(truck, pier, _possible("speed", values))


def _possible(name: str, values: Mapping[str, Any]) -> float:
    return possible(name, parse(name, values[name], dimension(BY_KEY[name])), values[name])
