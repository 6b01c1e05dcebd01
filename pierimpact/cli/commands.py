"""All commands, and what becomes of what they raise."""

import argparse
import errno
import logging
import sys
from collections.abc import Sequence

import pierimpact
from pierimpact.checks import InputError
from pierimpact.cli import app, cases, files, fit, network, risk, teach
from pierimpact.cli.ending import (
    drop_output,
    open_streams,
    print_anything,
    signals_as_interrupts,
)
from pierimpact.cli.terminal import complain, defect
from pierimpact.files.write import written

_log = logging.getLogger("pierimpact")


def run(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code, as `pierimpact.cli.main`."""
    open_streams()
    print_anything()
    before = len(written)
    with signals_as_interrupts() as ending:
        try:
            return _run(arguments)
        except InputError as error:
            _log.debug("bad input:", exc_info=True)
            complain(error)
            return 2
        except KeyboardInterrupt as interrupt:
            left = ", ".join(f"{path} written" for path in written[before:])
            complain(f"interrupted, {str(interrupt) or left or 'nothing written'}")
            return 128 + ending.signal
        except BrokenPipeError:  # whoever reads the output, such as head, has enough
            drop_output()
            return 1
        except OSError as error:
            _log.debug("the system:", exc_info=True)
            drop_output()
            complain(f"{error.filename or 'the output'}: {error.strerror or error}")
            return 2 if error.errno == errno.ENAMETOOLONG else 1
        except Exception as error:
            _log.debug("unforeseen:", exc_info=True)
            complain(defect(error))
            return 1


def _run(arguments: Sequence[str] | None) -> int:
    try:
        options = parser().parse_args(arguments)
        if options.debug:
            logging.basicConfig(format="%(message)s")
            _log.setLevel(logging.DEBUG)
        code: int = options.run(options)
    finally:
        sys.stdout.flush()
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
    app.add_app(commands)
    cases.add_check(commands)
    cases.add_report(commands)
    cases.add_compare(commands)
    network.add_portfolio(commands)
    network.add_inventory(commands)
    risk.add_risk(commands)
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
