"""A case file to start from: it runs as it stands, and says in comments what each key means."""

import textwrap
from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path

from pierimpact.checks import one_line, one_of
from pierimpact.files.case import SHAPES, section_keys
from pierimpact.files.inputs import PHYSICAL_KEYS
from pierimpact.files.keys import explanation
from pierimpact.units import SYSTEMS

#: What is beside a new case file where editors are to check it.
SCHEMA_FILE = "case.schema.json"

# Key | value in SI units | value in US units, where it is another: all of them round and
# illustrative. A key without a mark is in use; one with # is left out until its user takes it up.
# SECTION stands for the keys of the section.
_TABLE = """
What the sheet is about
element | —
revision | A
# date | 2026-01-31
# revisions | [{revision: A, date: 2026-01-31, description: First issue, by: —}]
# supersedes | case-0.yaml
# annexes | [procedure, codes]
units | SI | US

Of the office and the project, unless a pierimpact.toml in this folder gives it for all its cases
# office | Name of the office
# logo | logo.png
# project | Name of the project
# job_number | "0001"
# prepared_by | Name
# checked_by | Name
# approved_by | Name

Column
SECTION
column_height | 5 m | 18 ft
concrete_strength | 30 MPa | 4 ksi
# elastic_modulus | 28 GPa | 4000 ksi
# poisson_ratio | 0.2
density | 2400 kg/m^3 | 150 lb/ft^3
# stiffness_factor | 0.7
# effective_stiffness | 800 MN*m^2 | 2e6 kip*ft^2
# steps | [{height: 2 m, column_shape: circular, column_diameter: 1 m}] | [{height: 7 ft, \
column_shape: circular, column_diameter: 3 ft}]
base | fixed
top | pinned
# base_stiffness | 2000 MN/m | 12000 kip/in
# base_rotation_stiffness | 10000 MN*m/rad | 7e6 kip*ft/rad
# top_stiffness | 20 MN/m | 120 kip/in
# top_rotation_stiffness | 1000 MN*m/rad | 700000 kip*ft/rad
# top_mass | 50 t | 100000 lb
# embedment | 1 m | 3 ft

Collision
truck | single-unit-8t
# truck_mass | 9 t | 20000 lb
speed | 80 km/h | 50 mph
impact_height | 1.2 m | 4 ft
damping_ratio | 0.05

Check
# shear_resistance | 8 MN | 1800 kip
# moment_resistance | 7 MN*m | 5000 kip*ft
# member_forces | larger

Traffic, from which `pierimpact risk` says how often the pier is struck, and how hard
# traffic_volume | 20000 vehicles/day
# truck_share | 0.15
# distance_from_road | 6 m | 20 ft
# exposed_width | 3.5 m | 12 ft
# encroachment_rate | 1e-10 1/vehicle/m | 1.6e-7 1/vehicle/mile
# traffic_mass | lognormal(mean=18 t, sd=10 t) from 3.5 t | lognormal(mean=40000 lb, sd=22000 lb) \
from 8000 lb
# traffic_speed | motorway
# traffic_deceleration | lognormal(mean=4 m/s^2, sd=1.3 m/s^2) | lognormal(mean=13 ft/s^2, \
sd=4 ft/s^2)
# traffic_angle | rayleigh(scale=8 deg)
# weigh_in_motion | trucks.csv
# traffic_trucks | [single-unit-8t, tractor-trailer-36t]

Where the values are from
# notes | [A note of your own]
# sources | {speed: posted limit}
assumed |
"""
# Dimensions of sections by key and, where it is another for a shape, by shape and key.
_DIMENSIONS = {
    "column_diameter": ("1.2 m", "4 ft"),
    "column_width": ("1.5 m", "5 ft"),
    "column_depth": ("1.2 m", "4 ft"),
    "oblong column_width": ("1.2 m", "4 ft"),
    "oblong column_depth": ("1.8 m", "6 ft"),
    "column_wall_thickness": ("250 mm", "10 in"),
    "filled circular column_wall_thickness": ("16 mm", "5/8 in"),
    "filled rectangular column_wall_thickness": ("16 mm", "5/8 in"),
    "column_sides": ("8", "8"),
    "column_across_flats": ("1.2 m", "4 ft"),
    "column_area": ("1.5 m^2", "2400 in^2"),
    "column_second_moment": ("0.18 m^4", "450000 in^4"),
    "column_shear_area": ("1.2 m^2", "2000 in^2"),
    "modular_ratio": ("7", "7"),
    "density_ratio": ("3.2", "3.2"),
}
_HEADER = """\
# A case for pierimpact. Every value is an example, and is marked as assumed at the end.
#
#   pierimpact check {name}     prints what it comes to
#   pierimpact report {name}    writes the calculation sheet
#
# A line that begins "# key:" is optional: take the # away to use it. Values may be given in any of
# the units named, whatever the sheet prints in.
"""
#: The reason that a new case gives for its values.
EXAMPLE = "an example, to be replaced"
# Column in which comments begin, and most of a line [characters].
_COMMENT, _WIDTH = 34, 100


def new_case(
    name: str = "case.yaml", shape: str = "circular", system: str = "SI", *, schema: bool = False
) -> str:
    """Return the text of a case file to start from.

    Parameters
    ----------
    name : str, optional
        Name of the file.
    shape : str, optional
        Shape of the column's section, as column_shape.
    system : {"SI", "US"}, optional
        Units of its values.
    schema : bool, optional
        Whether to name the schema beside it in its first line, for editors.

    Raises
    ------
    InputError
        When there is no such shape or system, or the name is not one line.
    """
    one_line("name", name)
    one_of("shape", shape, tuple(SHAPES))
    which = SYSTEMS.index(one_of("units", system, SYSTEMS))
    section = {"column_shape": shape}
    section |= {key: _dimension(shape, key)[which] for key in section_keys(SHAPES[shape])}
    used: list[str] = []

    def lines() -> Iterator[str]:
        if schema:
            yield f"# yaml-language-server: $schema={SCHEMA_FILE}"
        yield _HEADER.format(name=name).rstrip()
        for row in _TABLE.splitlines():
            if row == "SECTION":
                used.extend(section)
                yield from (_line(key, value) for key, value in section.items())
            elif "|" in row:
                key, *values = (cell.strip() for cell in row.split("|"))
                yield _line(key, values[min(which, len(values) - 1)])
                used.append(key)  # with its mark, if it has one
            else:
                yield f"# {row}" if row else ""
        yield from (f"  {key}: {EXAMPLE}" for key in used if key in PHYSICAL_KEYS)

    return "\n".join(lines()).lstrip() + "\n"


def new_case_for(path: Path, shape: str, system: str) -> str:
    """Return the text of a case file at a path, for editors too where the schema is beside it.

    Parameters as in `new_case`.
    """
    return new_case(path.name, shape, system, schema=(path.parent / SCHEMA_FILE).exists())


def examples(shape: str, system: str) -> dict[str, str]:
    """Return a value for each key that a case of a shape may give, as in a new case file.

    Parameters as in `new_case`.
    """
    which = SYSTEMS.index(system)
    rows = ([cell.strip() for cell in row.split("|")] for row in _TABLE.splitlines() if "|" in row)
    values = {key.removeprefix("# "): own[min(which, len(own) - 1)] for key, *own in rows}
    return values | {key: _dimension(shape, key)[which] for key in section_keys(SHAPES[shape])}


def _dimension(shape: str, key: str) -> tuple[str, str]:
    return _DIMENSIONS.get(f"{shape} {key}", _DIMENSIONS.get(key, ("", "")))


def _line(key: str, value: str) -> str:
    """Return a line of a key with a value, and with a comment on what the key means."""
    text = f"{key}: {value}".rstrip()
    comment = textwrap.wrap(explanation(key.removeprefix("# ")), _WIDTH - _COMMENT - 4)
    if len(text) > _COMMENT:
        comment.insert(0, "")
    lines = zip_longest([text], comment, fillvalue="")
    return "\n".join(
        f"{part.ljust(_COMMENT)}  # {words}" if words else part for part, words in lines
    )
