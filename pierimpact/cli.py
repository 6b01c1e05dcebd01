"""The command line."""

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pierimpact
from pierimpact.checks import InputError, one_of
from pierimpact.pier.equivalent import DAMPING_RATIO, EquivalentPier
from pierimpact.teaching.launch import DEFAULT_FOLDER, TeachError, open_notebooks
from pierimpact.units import parse

_REPORT = """\
Calculate cases and write NAME.pdf, NAME.html and NAME.ipynb for each, where NAME is the name of
the case file. Where there are more cases than one, summary.html, summary.pdf and summary.csv have
a row for each. If a case fails, the others are still calculated; it is reported at the end.
"""
_EXIT_CODES = """\
Exit code: 0 if every case has its report; 2 if all failures are bad input; 1 if anything else
failed; 130 if interrupted, which leaves complete files only.
"""


_PAGE = """\
Write one HTML file that shows what the pier's frequency does to the peaks of engine and cargo. It
solves the collisions itself and needs neither Python nor a network.
"""

_FIT = """\
Fit the crush-law parameters of a truck to force records, measured or from finite elements. A
record is a CSV file with a heading such as: time [ms], contact force [kN]; the force may also be
the reaction. Total mass, speed and pier count as known; without a pier it is rigid. The table has
every parameter with its start, its fitted value with the standard error, and what the records do
not show, which stays at its start.
"""
_FIT_EXIT_CODES = "Exit code: 0 if a truck was fitted; 2 if the input is bad; 1 if anything failed."


_COLLECT = """\
Read the answer files (*.answers.json) that the teaching notebooks write, from a folder and all
folders below it, check the answers again, and write a table with a row a student: name or number,
right answers in total, and for each question whether it is right and after how many tries.
"""
_COLLECT_EXIT_CODES = "Exit code: 0 if any file was read; 2 if none was; 1 if anything failed."


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 2 for bad input, 1 for any other failure."""
    options = _parser().parse_args(arguments)
    try:
        if options.command == "teach":
            return _teach(options)
        if options.command == "collect":
            return _collect(options.folder, options.csv)
        if options.command == "fit":
            return _fit(options)
        if options.command == "page":
            return _page(options.page, options.trucks)
        return _report(options.cases, options.output)
    except InputError as error:
        _complain(error)
        return 2
    except KeyboardInterrupt as interrupt:
        _complain(f"interrupted, {interrupt or 'nothing written'}")
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="pierimpact", description="Truck collisions with bridge piers.", allow_abbrev=False
    )
    version = f"pierimpact {pierimpact.__version__}"
    parser.add_argument("--version", action="version", version=version)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    report = commands.add_parser(
        "report",
        help="calculate cases and write their reports",
        description=_REPORT,
        epilog=_EXIT_CODES,
    )
    report.add_argument(
        "cases",
        metavar="CASE.yaml",
        nargs="+",
        help="case file, or a folder, which stands for all *.yaml and *.yml in it, sorted by name; "
        "subfolders are not searched",
    )
    report.add_argument(
        "--output", metavar="DIR", default="reports", help="folder to write to (default: reports)"
    )
    teach = commands.add_parser(
        "teach",
        help="open the teaching notebooks",
        description="Copy the teaching notebooks to your own folder and open them in JupyterLab.",
    )
    teach.add_argument(
        "--app", action="store_true", help="serve the explorer alone, as a page without code"
    )
    teach.add_argument(
        "--folder",
        metavar="DIR",
        default=DEFAULT_FOLDER,
        help="folder for your copies; files already in it are kept (default: %(default)s)",
    )
    teach.add_argument(
        "--no-browser", dest="browser", action="store_false", help="do not open a browser"
    )
    teach.add_argument(
        "--answers",
        metavar="NAME",
        help="print the teacher's sheet instead: times, misconceptions, and worked answers with "
        'the numbers of the student of this name or number; "" for those who gave none',
    )
    collect = commands.add_parser(
        "collect",
        help="collect the marks of a class in one table",
        description=_COLLECT,
        epilog=_COLLECT_EXIT_CODES,
        allow_abbrev=False,
    )
    collect.add_argument("folder", metavar="FOLDER", help="folder with the students' answer files")
    collect.add_argument(
        "--csv",
        metavar="FILE",
        default="marks.csv",
        help="table to write (default: %(default)s)",
    )
    page = commands.add_parser(
        "page", help="write the explorer as one HTML file", description=_PAGE
    )
    page.add_argument("page", metavar="PAGE.html", help="file to write")
    page.add_argument(
        "--truck",
        dest="trucks",
        metavar="TRUCK",
        nargs="+",
        default=["single-unit-8t"],
        help="trucks to choose from: names of the catalogue or truck files (default: %(default)s)",
    )
    _add_fit(commands)
    return parser


def _add_fit(commands: Any) -> None:
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
            "metavar": "RATIO", "type": float,
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
            "metavar": "SHARE", "type": float, "default": 0.05,
            "help": "a parameter counts as identified if three standard errors are at most this "
            "share of its value (default: %(default)s)",
        },
        "output": {"metavar": "TRUCK.toml", "help": "truck file to write"},
        "figure": {"metavar": "FILE", "help": "figure to write: .pdf, .png or .svg"},
    }  # fmt: skip
    for name, option in options.items():
        fit.add_argument(f"--{name}", **option)


def _fit(options: argparse.Namespace) -> int:
    from pierimpact.files.write import write_files
    from pierimpact.report.fit import Treatment, fit_files, fit_table

    treatment = Treatment(
        filter=_given(options, "filter", "frequency"),
        cutoff=_given(options, "filtered", "frequency"),
        window=_given(options, "average", "time"),
        first_touch=_given(options, "first_touch", "time") or 0.0,
    )
    output, figure = (Path(path) if path else None for path in (options.output, options.figure))
    if figure:
        drawing = one_of("the ending of --figure", figure.suffix[1:].lower(), ("pdf", "png", "svg"))
        try:
            from pierimpact.plots.fit import draw_fit
        except ModuleNotFoundError as error:
            return _needs("figures", error)
    for path in (output, figure):
        if path and not path.parent.is_dir():
            raise InputError(f"{path} cannot be written to: there is no folder {path.parent}")
    with _progress("collisions") as progress:
        fitted = fit_files(
            options.records,
            [parse("--speed", text, "speed") for text in options.speed],
            _piers(options),
            start=options.start,
            mass=_given(options, "mass", "mass"),
            treatment=treatment,
            accuracy=options.accuracy,
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
    return None if text is None else parse(f"--{name.replace('_', '-')}", text, dimension)


def _piers(options: argparse.Namespace) -> list[EquivalentPier | None]:
    """Return the piers of the records, or the one of all; None is rigid."""
    mass = _given(options, "pier_mass", "mass")
    stiffness = _given(options, "pier_stiffness", "stiffness")
    damping = options.damping_ratio
    if options.case:
        if (mass, stiffness, damping) != (None, None, None):
            raise InputError(
                "--case has the pier: leave out --pier-mass, --pier-stiffness and --damping-ratio"
            )
        return [_pier_of(path) for path in options.case]
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


def _pier_of(path: str) -> EquivalentPier:
    from pierimpact.files.case import read_case_file

    case = read_case_file(path).case
    height, *more = case.impact_heights
    if more:
        raise InputError(f"{path}: impact_height must be a length for a fit, got 'auto'")
    return case.column.struck_at(height).equivalent(case.inputs.damping_ratio)


@contextmanager
def _progress(unit: str) -> Iterator[Callable[[int], object]]:
    """Give the update of a progress bar on a terminal, where tqdm is installed."""
    try:
        from tqdm import tqdm
    except ModuleNotFoundError:
        yield lambda count: None
        return
    with tqdm(unit=f" {unit}", disable=None, leave=False) as bar:
        yield bar.update


def _needs(what: str, error: ModuleNotFoundError) -> int:
    _complain(f"{what} need {error.name}: pip install 'pierimpact[report]'")
    return 1


def _teach(options: argparse.Namespace) -> int:
    if options.answers is not None:
        from pierimpact.teaching.teacher import teachers_sheet

        print(teachers_sheet(options.answers), end="")
        return 0
    try:
        return open_notebooks(options.folder, app=options.app, browser=options.browser)
    except TeachError as error:
        _complain(error)
        return 1


def _collect(folder: str, table: str) -> int:
    from pierimpact.teaching.marks import collect

    marks = collect(folder)
    try:
        Path(table).write_text(marks.table, encoding="utf-8", newline="")
    except OSError as error:
        raise InputError(f"{table} cannot be written to: {error.strerror}") from None
    print(f"{table}: students {marks.students}, files read {marks.files}", flush=True)
    for remark in marks.remarks:
        _complain(remark)
    return 0


def _page(path: str, trucks: Sequence[str]) -> int:
    try:
        from pierimpact.teaching.page import write_page
    except ModuleNotFoundError as error:
        return _needs("pages", error)
    print(write_page(path, trucks))
    return 0


def _report(paths: Sequence[str], output: str) -> int:
    try:
        from pierimpact.report.batch import find_cases, write_reports
    except ModuleNotFoundError as error:
        return _needs("reports", error)
    cases = find_cases(paths)
    batch = write_reports(cases, output)
    for report in batch.reports:
        print(report.notebook, report.html, report.pdf, sep="\n")
    if batch.summary:
        print(*batch.summary, sep="\n")
    sys.stdout.flush()  # so that warnings and failures come last
    for report in batch.reports:
        for warning in report.warnings:
            _complain(f"warning: {report.pdf.name}: {warning}")
    for failure in batch.failures:
        _complain(failure.reason)
    if len(cases) > 1 and batch.failures:
        _complain(f"{len(batch.failures)} of {len(cases)} cases have no report")
    if batch.summary_failure:
        _complain(batch.summary_failure)
        return 1
    if not batch.failures:
        return 0
    return 2 if all(failure.bad_input for failure in batch.failures) else 1


def _complain(message: object) -> None:
    print(f"pierimpact: {message}", file=sys.stderr)
