"""The command line."""

import argparse
import sys
from collections.abc import Sequence

import pierimpact
from pierimpact.checks import InputError


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 2 for bad input, 1 for what else fails."""
    options = _parser().parse_args(arguments)
    try:
        return _report(options.case, options.output)
    except InputError as error:
        print(f"pierimpact: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("pierimpact: interrupted, nothing written", file=sys.stderr)
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="pierimpact", description="Truck collisions with bridge piers.", allow_abbrev=False
    )
    parser.add_argument(
        "--version", action="version", version=f"pierimpact {pierimpact.__version__}"
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    report = commands.add_parser(
        "report",
        help="calculate a case and write its report",
        description="Calculate a case and write NAME.pdf, NAME.html and NAME.ipynb, where NAME is "
        "the name of the case file.",
    )
    report.add_argument("case", metavar="CASE.yaml", help="case file")
    report.add_argument(
        "--output", metavar="DIR", default="reports", help="folder to write to (default: reports)"
    )
    return parser


def _report(case: str, output: str) -> int:
    try:
        from pierimpact.report import ReportError, write_report
    except ModuleNotFoundError as error:
        print(
            f"pierimpact: reports need {error.name}: pip install 'pierimpact[report]'",
            file=sys.stderr,
        )
        return 1
    try:
        files = write_report(case, output)
    except ReportError as error:
        print(f"pierimpact: {error}", file=sys.stderr)
        return 1
    for warning in files.warnings:
        print(f"pierimpact: warning: {warning}", file=sys.stderr)
    for file in (files.notebook, files.html, files.pdf):
        print(file)
    return 0
