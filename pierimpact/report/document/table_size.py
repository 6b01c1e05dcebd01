"""About how wide a table's columns come out, and how many lines its rows take, from their cells."""

import math
import re
from collections.abc import Mapping
from typing import Any

from pierimpact.report.document.markup import plain

_LETTERS = 105  # of a table's type on a line across the page; a width by eye, this project's choice
_APART = 3  # of them, between two columns; this project's choice
#: Lines of a table that is not broken over pages, this project's choice: 75 mm where cells take
#: several, and 135 mm at most.
WHOLE = 23


def column_widths(table: Mapping[str, Any]) -> list[float]:
    """Return the widths of a table's columns, in per cent of the page's."""
    wanted = []
    for index, column in enumerate(table["columns"]):
        longest = max((len(plain(row[index])) for row in table["rows"]), default=0)
        words = max(map(len, re.split(r"\s", plain(column["heading"]))), default=0)
        wanted.append(min(max(longest, words), 40) + 4)
    wide = [column["wide"] for column in table["columns"]]
    rest = _LETTERS - sum(w for w, takes_rest in zip(wanted, wide, strict=True) if not takes_rest)
    if any(wide):
        wanted = [
            max(rest / sum(wide), 20) if takes_rest else width
            for width, takes_rest in zip(wanted, wide, strict=True)
        ]
    page = max(sum(wanted), _LETTERS)
    return [round(100.0 * width / page, 1) for width in wanted]


def is_whole(table: Mapping[str, Any]) -> bool:
    """Whether a table is so low that it is not broken over pages."""
    return lines_of(table) <= WHOLE


def lines_of(table: Mapping[str, Any]) -> int:
    """Return how many lines a table's rows take, without its head."""
    letters = [max(width / 100.0 * _LETTERS - _APART, 1.0) for width in column_widths(table)]
    return sum(
        max(math.ceil(len(plain(cell)) / width) for cell, width in zip(row, letters, strict=True))
        for row in table["rows"]
    )
