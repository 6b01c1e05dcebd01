"""Lines of a CSV file with comments, and the cells of a line."""

import csv

from pierimpact.checks import InputError


def csv_lines(text: str, example: str) -> tuple[list[tuple[int, str]], str]:
    """Return the lines that are neither empty nor comments (#), numbered, and their separator.

    The first of them is the heading, and it decides: a semicolon or a tab in it parts the columns,
    and else a comma.

    Raises
    ------
    InputError
        When there is no line; `example` is of a heading.
    """
    lines = [
        (row, line)
        for row, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise InputError(f"must have a heading, {example}; got nothing")
    return lines, next((mark for mark in ";\t" if mark in lines[0][1]), ",")


def csv_cells(row: int, line: str, separator: str) -> list[str]:
    """Return the cells of a line; `row` is its number."""
    if '"' not in line:
        return [cell.lstrip() for cell in line.split(separator)]
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True))
    except csv.Error as error:
        raise InputError(f"row {row}: is not CSV: {error}") from None
