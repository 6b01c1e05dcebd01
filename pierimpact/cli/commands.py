"""All commands, and what becomes of what they raise."""

import argparse
import contextlib
import io
import logging
import os
import sys
from collections.abc import Sequence

import pierimpact
from pierimpact.checks import InputError
from pierimpact.cli import cases, files, fit, teach
from pierimpact.cli.terminal import complain, defect

_log = logging.getLogger("pierimpact")


def run(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code, as `pierimpact.cli.main`."""
    if isinstance(sys.stdout, io.TextIOWrapper):  # whatever its encoding, print what it can
        sys.stdout.reconfigure(errors="backslashreplace")
    options = parser().parse_args(arguments)
    if options.debug:
        logging.basicConfig(format="%(message)s")
        _log.setLevel(logging.DEBUG)
    try:
        code: int = options.run(options)
        if sys.stdout:  # which may be closed
            sys.stdout.flush()
    except InputError as error:
        _log.debug("bad input:", exc_info=True)
        complain(error)
        return 2
    except BrokenPipeError:  # whoever reads the output, such as head, has enough
        _nobody_reads()
        return 1
    except OSError as error:
        _log.debug("the system:", exc_info=True)
        complain(f"{error.filename or 'the output'}: {error.strerror or error}")
        _nobody_reads()
        return 1
    except Exception as error:
        _log.debug("unforeseen:", exc_info=True)
        complain(defect(error))
        return 1
    return code


def _nobody_reads() -> None:
    """Let what is still to be printed go nowhere, or Python would complain at its end."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


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
    files.add_trucks(commands)
    files.add_schema(commands)
    fit.add_fit(commands)
    teach.add_teach(commands)
    teach.add_collect(commands)
    teach.add_page(commands)
    for command in commands.choices.values():
        command.add_argument(
            "--debug", action="store_true", help="show where in the program an error comes from"
        )
    return parser
