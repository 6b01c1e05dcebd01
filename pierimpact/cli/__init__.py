"""The command line: a file for each group of commands."""

import argparse
import os
import sys
from collections.abc import Sequence

import pierimpact
from pierimpact.checks import InputError
from pierimpact.cli import cases, files, fit, risk, teach
from pierimpact.cli.terminal import complain


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 2 for bad input, 1 for any other failure."""
    options = parser().parse_args(arguments)
    try:
        code: int = options.run(options)
        sys.stdout.flush()
    except InputError as error:
        complain(error)
        return 2
    except KeyboardInterrupt as interrupt:
        complain(f"interrupted, {interrupt or 'nothing written'}")
        return 130
    except BrokenPipeError:  # whoever reads the output, such as head, has enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    return code


def parser() -> argparse.ArgumentParser:
    """Return the parser of all commands; what it parses has in `run` what runs the command."""
    parser = argparse.ArgumentParser(
        prog="pierimpact", description="Truck collisions with bridge piers.", allow_abbrev=False
    )
    version = f"pierimpact {pierimpact.__version__}"
    parser.add_argument("--version", action="version", version=version)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    files.add_new(commands)
    cases.add_check(commands)
    cases.add_report(commands)
    cases.add_compare(commands)
    risk.add_risk(commands)
    files.add_trucks(commands)
    files.add_schema(commands)
    fit.add_fit(commands)
    teach.add_teach(commands)
    teach.add_collect(commands)
    teach.add_page(commands)
    return parser
