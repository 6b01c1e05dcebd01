"""Tables and lists in plain text, as a terminal shows them."""

import textwrap
from collections.abc import Collection, Sequence
from itertools import zip_longest

#: What a line has room for [characters].
WIDTH = 100


def text_table(
    rows: Sequence[Sequence[str]], right: Collection[int] = (), widest: Sequence[int] = ()
) -> str:
    """Return a table in plain text.

    Parameters
    ----------
    rows : sequence of sequences of str, all of one length
        Cells.
    right : collection of int, optional
        Columns set to the right.
    widest : sequence of int, optional
        Most characters of a line in each column; a longer cell takes several lines.
    """
    wrapped = [
        [textwrap.wrap(cell, width) for cell, width in zip(row, widest, strict=True)]
        if widest
        else [[cell] for cell in row]
        for row in rows
    ]
    widths = [
        max(len(line) for cell in column for line in cell or [""])
        for column in zip(*wrapped, strict=True)
    ]
    return "\n".join(
        "  ".join(
            line.rjust(width) if number in right else line.ljust(width)
            for number, (line, width) in enumerate(zip(lines, widths, strict=True))
        ).rstrip()
        for row in wrapped
        for lines in zip_longest(*row, fillvalue="")
    )


def text_item(text: str) -> str:
    """Return a text as an item of a list in plain text."""
    return textwrap.fill(text, WIDTH, initial_indent="- ", subsequent_indent="  ")
