"""The commands that calculate cases: `report`, `check` and `compare`."""

import argparse
import logging
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pierimpact.checks import InputError
from pierimpact.cli.terminal import complain, defect, needs

if TYPE_CHECKING:
    from pierimpact.report.calculation import Calculation

_log = logging.getLogger("pierimpact")
_REPORT = """\
Calculate cases and write NAME.pdf, NAME.html and NAME.ipynb for each, where NAME is the name of
the case file. Where there are more cases than one, summary.html, summary.pdf and summary.csv have
a row for each. If a case fails, the others are still calculated; it is reported at the end. With
--docx, each sheet and the summary are Word documents too; with --binder, binder.pdf has contents,
summary and all sheets. A case that another of them supersedes has its sheet, and stands in
summary.csv; it is left out of the others, which say so.

A report that is there already is replaced, all of its files or none. If somebody has changed one
of them since, or written a file of that name, nothing is written, unless --force is given. Which
files are as they were written is known from their SHA-256 in the hidden file .pierimpact.json of
the folder. A Word document of an earlier run goes where none is wanted now, unless somebody changed
it; what else earlier runs wrote under these names and this one did not is named.

Nothing that lies beside a case file is run, and no settings of Jupyter, IPython or matplotlib are
read.
"""
_EXIT_CODES = """\
Exit code: 0 if every case has its report; 2 if all failures are bad input; 1 if anything else
failed; 130 if interrupted, which leaves complete files only.
"""
_CHECK = """\
Calculate cases and print for each whether the column holds, the design reaction with its band, the
largest shear and moment, the check by hand, the force of the code and the warnings, in the units
of the case. Nothing is written.
"""
_CHECK_EXIT_CODES = """\
Exit code: 0 if every case was calculated, whether or not its column holds; 2 if all failures are
bad input; 1 if anything else failed.
"""
_COMPARE = """\
Calculate two case files and print which inputs, results and warnings changed from the one to the
other, in the units of the new one. Nothing is written.
"""
_COMPARE_EXIT_CODES = "Exit code: 0 whether or not anything changed; 2 if the input is bad."
_CASES: dict[str, Any] = {
    "metavar": "CASE.yaml",
    "nargs": "+",
    "help": "case file, or a folder, which stands for all *.yaml and *.yml in it, sorted by name; "
    "subfolders are not searched",
}


def add_report(commands: Any) -> None:
    """Add the command `report` to the parser's."""
    report = commands.add_parser(
        "report",
        help="calculate cases and write their reports",
        description=_REPORT,
        epilog=_EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    report.add_argument("cases", **_CASES)
    report.add_argument(
        "--output", metavar="DIR", default="reports", help="folder to write to (default: reports)"
    )
    report.add_argument("--docx", action="store_true", help="write Word documents too")
    report.add_argument(
        "--binder", action="store_true", help="write binder.pdf too: all sheets in one, bookmarked"
    )
    report.add_argument(
        "--force", action="store_true", help="replace files that somebody changed, too"
    )
    report.set_defaults(run=_report)


def add_check(commands: Any) -> None:
    """Add the command `check` to the parser's."""
    check = commands.add_parser(
        "check",
        help="calculate cases and print what they come to",
        description=_CHECK,
        epilog=_CHECK_EXIT_CODES,
    )
    check.add_argument("cases", **_CASES)
    check.add_argument(
        "--json",
        action="store_true",
        help="print a JSON object for each case, one a line, in SI units",
    )
    check.set_defaults(run=_check)


def add_compare(commands: Any) -> None:
    """Add the command `compare` to the parser's."""
    compare = commands.add_parser(
        "compare",
        help="say what changed between two case files",
        description=_COMPARE,
        epilog=_COMPARE_EXIT_CODES,
    )
    compare.add_argument("old", metavar="OLD.yaml", help="case file of the revision before")
    compare.add_argument("new", metavar="NEW.yaml", help="case file of the new revision")
    compare.set_defaults(run=_compare)


def _report(options: argparse.Namespace) -> int:
    try:
        from pierimpact.report.batch import find_cases, write_reports
    except ModuleNotFoundError as error:
        return needs("reports", error)
    cases = find_cases(options.cases, binder=options.binder)
    batch = write_reports(
        cases, options.output, docx=options.docx, binder=options.binder, force=options.force
    )
    for report in batch.reports:
        print(*report.files, sep="\n")
    if batch.summary:
        print(*filter(None, batch.summary), sep="\n")
    if batch.binder:
        print(batch.binder)
    sys.stdout.flush()  # so that warnings and failures come last
    for report in batch.reports:
        for warning in report.warnings:
            complain(f"warning: {report.pdf.name}: {warning}")
    for failure in batch.failures:
        complain(failure.reason)
    if len(cases) > 1 and batch.failures:
        complain(f"{len(batch.failures)} of {len(cases)} cases have no report")
    if batch.left:
        names = ", ".join(file.name for file in batch.left)
        complain(f"warning: of an earlier run, not of this one: {names}")
    for whole in filter(None, (batch.summary_failure, batch.binder_failure)):
        complain(whole)
    if batch.summary_failure or batch.binder_failure:
        return 1
    if not batch.failures:
        return 0
    return 2 if all(failure.bad_input for failure in batch.failures) else 1


def _check(options: argparse.Namespace) -> int:
    try:
        from pierimpact.files.find import find_case_files
        from pierimpact.report.check import check_json, check_text, fault_json
    except ModuleNotFoundError as error:
        return needs("checks", error)
    codes, between = {0}, ""
    for path in find_case_files(options.cases):
        try:
            text = (check_json if options.json else check_text)(str(path), _calculated(path))
        except InputError as error:
            _log.debug("bad input:", exc_info=True)
            fault, code = str(error), 2
        except Exception as error:  # the other cases are still calculated
            _log.debug("unforeseen:", exc_info=True)
            fault, code = f"{path}: {defect(error)}", 1
        else:
            print(between + text, flush=True)
            between = "" if options.json else "\n"
            continue
        complain(fault)
        codes.add(code)
        if options.json:
            print(fault_json(str(path), fault), flush=True)
    return 1 if 1 in codes else max(codes)


def _compare(options: argparse.Namespace) -> int:
    try:
        from pierimpact.report.comparison import compare
    except ModuleNotFoundError as error:
        return needs("comparisons", error)
    paths = options.old, options.new
    changes = compare(*(_calculated(path) for path in paths))
    print(" → ".join(paths), changes.text(), sep="\n\n")
    return 0


def _calculated(path: str | Path) -> "Calculation":
    from pierimpact.files.case import read_case_file
    from pierimpact.report.calculation import calculate

    try:
        return calculate(read_case_file(path).case)
    except InputError as error:  # which names the file, and others may have the same name
        raise InputError(str(error).replace(Path(path).name, str(path), 1)) from None
