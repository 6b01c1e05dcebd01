"""The command line."""

import argparse
import sys
from collections.abc import Sequence

import pierimpact
from pierimpact.checks import InputError
from pierimpact.teaching.launch import DEFAULT_FOLDER, TeachError, open_notebooks

_REPORT = """\
Calculate cases and write NAME.pdf, NAME.html and NAME.ipynb for each, where NAME is the name of
the case file. Where there are more cases than one, summary.html, summary.pdf and summary.csv have
a row for each. If a case fails, the others are still calculated; it is reported at the end.
"""
_EXIT_CODES = """\
Exit code: 0 if every case has its report; 2 if all failures are bad input; 1 if anything else
failed; 130 if interrupted, which leaves complete files only.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 2 for bad input, 1 for any other failure."""
    options = _parser().parse_args(arguments)
    try:
        if options.command == "teach":
            return _teach(options.app, options.folder, options.browser)
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
    return parser


def _teach(app: bool, folder: str, browser: bool) -> int:
    try:
        return open_notebooks(folder, app=app, browser=browser)
    except TeachError as error:
        _complain(error)
        return 1


def _report(paths: Sequence[str], output: str) -> int:
    try:
        from pierimpact.report.batch import find_cases, write_reports
    except ModuleNotFoundError as error:
        _complain(f"reports need {error.name}: pip install 'pierimpact[report]'")
        return 1
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
