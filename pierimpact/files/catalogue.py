"""Trucks in plain text: the catalogue as a table, and one truck with all its parameters."""

import textwrap
from collections.abc import Iterator

from pierimpact.files.trucks import TruckFile, read_truck_file, truck_names
from pierimpact.plain_text import WIDTH, text_table
from pierimpact.symbols import BY_KEY
from pierimpact.units import printed


def catalogue_text() -> str:
    """Return the trucks of the catalogue: mass, range of masses, status, spread and description."""
    files = {name: read_truck_file(name) for name in truck_names()}
    rows = [
        ("Truck", "Mass", "Springs stand for", "Status", "Spread", "Description"),
        *((name, *_cells(file), file.description) for name, file in files.items()),
    ]
    return text_table(rows, widest=(22, 10, 17, 12, 11, 24))


def _cells(file: TruckFile) -> Iterator[str]:
    yield _mass(file.truck.mass)
    yield _range(file)
    yield file.status.words
    ends = [end for spread in file.truck.spread.values() for end in spread.ends]
    yield f"up to {100.0 * max(abs(end - 1.0) for end in ends):.0f} %" if ends else "none"


def truck_text(name: str) -> str:
    """Return a truck with value, spread, status and source of each of its parameters.

    Parameters
    ----------
    name : str
        A name of the catalogue, or the path of a truck file.

    Raises
    ------
    InputError
        When there is no such truck, or its file breaks a rule.
    """
    file = read_truck_file(name)
    mass_range = file.mass_range
    total = f"Total mass {_mass(file.truck.mass)}; the springs stand for {_range(file)}"
    if mass_range is not None:
        total += f" ({mass_range.status.words}: {mass_range.source})"
    sentences = (
        f"{file.truck.name}: {file.description}.",
        f"Status: {file.status.words}. Source: {file.source}.",
        f"{total}.",
    )
    rows = [
        ("Parameter", "Value", "Spread", "Status", "Source"),
        *(
            (
                BY_KEY[own.name].heading,
                own.given,
                own.spread.words if own.spread else "none",
                own.status.words,
                own.source,
            )
            for own in file.parameters
        ),
    ]
    return "\n".join(
        [
            *(textwrap.fill(sentence, WIDTH) for sentence in sentences),
            "",
            text_table(rows, widest=(28, 12, 14, 14, 34)),
        ]
    )


def _mass(value: float) -> str:
    return str(printed(value, "mass", "SI", given=True))


def _range(file: TruckFile) -> str:
    """Return the total masses that a truck's springs stand for, in words."""
    if file.mass_range is None:
        return "any mass"
    low, high = file.mass_range[:2]
    return f"{printed(low, 'mass', 'SI', given=True).number}–{_mass(high)}"
