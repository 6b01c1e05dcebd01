"""The command `fit`."""

import argparse
from pathlib import Path
from typing import Any

from pierimpact.checks import InputError, brief, one_of
from pierimpact.cli.terminal import needs, progress_bar
from pierimpact.files.csv_lines import decimal
from pierimpact.files.limits import PIER_MASS, PIER_STIFFNESS, POSSIBLE, within
from pierimpact.pier.equivalent import DAMPING_RATIO, EquivalentPier
from pierimpact.units import parse

_FIT = """\
Fit the crush-law parameters of a truck to force records, measured or from finite elements. A
record is a CSV file with a heading such as: time [ms], contact force [kN]; the force may also be
the reaction. Total mass, speed and pier count as known; without a pier it is rigid. The table has
every parameter with its start, its fitted value with the standard error, and what the records do
not show, which stays at its start. Files that are there are kept, unless --force is given.
"""
_RANGES = {
    "speed": POSSIBLE["speed"],
    "mass": POSSIBLE["truck_mass"],
    "pier_mass": PIER_MASS,
    "pier_stiffness": PIER_STIFFNESS,
}
_FIT_EXIT_CODES = "Exit code: 0 if a truck was fitted; 2 if the input is bad; 1 if anything failed."


def add_fit(commands: Any) -> None:
    """Add the command to the parser's."""
    fit = commands.add_parser(
        "fit",
        help="fit a truck to force records",
        description=_FIT,
        epilog=_FIT_EXIT_CODES,
        allow_abbrev=False,
    )
    fit.add_argument("records", metavar="RECORD.csv", nargs="+", help="force records")
    once = "; once for all records, or once for each"
    options: dict[str, dict[str, Any]] = {
        "speed": {
            "metavar": "SPEED", "action": "append", "required": True,
            "help": f'speed at first touch, such as "80 km/h"{once}',
        },
        "start": {
            "metavar": "TRUCK", "default": "single-unit-8t",
            "help": "truck to start from: a name of the catalogue or a truck file "
            "(default: %(default)s)",
        },
        "mass": {"metavar": "MASS", "help": "total mass of the truck (default: that of the start)"},
        "case": {
            "metavar": "CASE.yaml", "action": "append", "help": f"case file of the pier{once}",
        },
        "pier-mass": {"metavar": "MASS", "help": "equivalent mass of the pier"},
        "pier-stiffness": {"metavar": "STIFFNESS", "help": "its stiffness at the impact height"},
        "damping-ratio": {
            "metavar": "RATIO",
            "help": f"its damping ratio (default: {DAMPING_RATIO:g})",
        },
        "filter": {
            "metavar": "FREQUENCY",
            "help": 'low-pass filter for records and model alike: cut-off, such as "180 Hz"',
        },
        "filtered": {
            "metavar": "FREQUENCY",
            "help": "cut-off of a low-pass filter that the records have passed already",
        },
        "average": {
            "metavar": "TIME", "help": 'moving average that the records are, such as "10 ms"',
        },
        "first-touch": {
            "metavar": "TIME", "help": "time of first touch in the records (default: 0 ms)",
        },
        "accuracy": {
            "metavar": "SHARE", "default": "0.05",
            "help": "a parameter counts as identified if three standard errors are at most this "
            "share of its value (default: %(default)s)",
        },
        "output": {"metavar": "TRUCK.toml", "help": "truck file to write"},
        "figure": {"metavar": "FILE", "help": "figure to write: .pdf, .png or .svg"},
    }  # fmt: skip
    for name, option in options.items():
        fit.add_argument(f"--{name}", **option)
    fit.add_argument("--force", action="store_true", help="replace files that are there")
    fit.set_defaults(run=_fit)


def _fit(options: argparse.Namespace) -> int:
    from pierimpact.files.write import refuse_to_replace, write_files
    from pierimpact.report.fit import Treatment, fit_files, fit_table

    treatment = Treatment(
        filter=_given(options, "filter", "frequency"),
        cutoff=_given(options, "filtered", "frequency"),
        window=_given(options, "average", "time"),
        first_touch=_given(options, "first_touch", "time") or 0.0,
    )
    output, figure = (Path(path) if path else None for path in (options.output, options.figure))
    if figure:
        try:
            from pierimpact.plots.fit import FORMATS, draw_fit
        except ModuleNotFoundError as error:
            return needs("figures", error)
        drawing = one_of("the ending of --figure", figure.suffix[1:].lower(), FORMATS)
    if output and output.suffix != ".toml":
        raise InputError(f"--output must be the name of a .toml file, got {brief(str(output))}")
    for path in filter(None, (output, figure)):
        for given in (*options.records, *(options.case or ()), options.start):
            if path.exists() and Path(given).exists() and path.samefile(given):
                raise InputError(f"{path} is read, and cannot be written to")
        refuse_to_replace(path, force=options.force)
    with progress_bar("collisions") as progress:
        fitted = fit_files(
            options.records,
            [_possible("speed", text, "speed") for text in options.speed],
            piers_of(options),
            start=options.start,
            mass=_given(options, "mass", "mass"),
            treatment=treatment,
            accuracy=_possible("accuracy", options.accuracy, ""),
            name=output.stem if output else "fitted",
            progress=progress,
        )
    contents: dict[Path, bytes] = {}
    if output:
        contents[output] = fitted.truck_file.encode()
    if figure:
        contents[figure] = draw_fit(fitted.fit, "SI", drawing)
    write_files(contents)
    print(fit_table(fitted.fit))
    if contents:
        print(*contents, sep="\n")
    return 0


def _given(options: argparse.Namespace, name: str, dimension: str) -> float | None:
    """Return an option in SI units, or None where it is not given."""
    text = getattr(options, name)
    return None if text is None else _possible(name, text, dimension)


def _possible(name: str, text: str, dimension: str) -> float:
    """Return an option in SI units, or without dimension, that is within what is possible."""
    option = f"--{name.replace('_', '-')}"
    value = parse(option, text, dimension) if dimension else float(decimal(option, text))
    return within(option, value, _RANGES[name], dimension, text) if name in _RANGES else value


def piers_of(options: argparse.Namespace) -> list[EquivalentPier | None]:
    """Return the piers of the records, or the one of all; None is rigid."""
    mass = _given(options, "pier_mass", "mass")
    stiffness = _given(options, "pier_stiffness", "stiffness")
    damping = _given(options, "damping_ratio", "")
    if options.case:
        if (mass, stiffness, damping) != (None, None, None):
            raise InputError(
                "--case has the pier: leave out --pier-mass, --pier-stiffness and --damping-ratio"
            )
        return [pier_of(path) for path in options.case]
    if (mass is None) != (stiffness is None):
        raise InputError("--pier-mass and --pier-stiffness go together")
    if mass is None or stiffness is None:
        if damping is not None:
            raise InputError(
                "--damping-ratio belongs to a pier: give --pier-mass and --pier-stiffness as well"
            )
        return [None]
    damping = DAMPING_RATIO if damping is None else damping
    return [EquivalentPier(mass=mass, stiffness=stiffness, damping_ratio=damping)]


def pier_of(path: str | Path) -> EquivalentPier:
    """Return the pier of a case file at its nominal impact height."""
    from pierimpact.files.case import read_case_file

    case = read_case_file(path).case
    height, *more = case.impact_heights
    if more:
        raise InputError(f"{path}: impact_height must be a length for a fit, got 'auto'")
    return case.column.struck_at(height).equivalent(case.inputs.damping_ratio)
