"""The commands about files: `new`, `trucks` and `schema`."""

import argparse
import json
from pathlib import Path
from typing import Any

from pierimpact.cli.terminal import needs, system_of
from pierimpact.units import SYSTEMS

_NEW = """\
Write a case file to start from. It runs as it stands; each key has a comment on what it means, and
those that may be left out are commented out. A file that is there is kept, unless --force is given.
Where case.schema.json is in the same folder, the first line names it for editors.
"""
_TRUCKS = "List the trucks of the catalogue, or the parameters of one truck with their sources."
_SCHEMA = """\
Print the JSON Schema of case files, with which an editor completes and checks
them as they are typed:

  pierimpact schema > case.schema.json

and, as the first line of a case file beside it, which `pierimpact new` writes
by itself:

  # yaml-language-server: $schema=case.schema.json
"""
_EXIT_CODES = "Exit code: 0; 2 if the input is bad."


def add_new(commands: Any) -> None:
    """Add the command `new` to the parser's."""
    new = commands.add_parser(
        "new", help="write a case file to start from", description=_NEW, epilog=_EXIT_CODES
    )
    new.add_argument("case", metavar="CASE.yaml", help="file to write")
    new.add_argument(
        "--shape",
        type=str.lower,
        default="circular",
        help='shape of the section, such as "hollow circular" (default: %(default)s)',
    )
    new.add_argument(
        "--units",
        metavar="SYSTEM",
        type=system_of,
        choices=SYSTEMS,
        default="SI",
        help="units of values and sheet: SI or US (default: %(default)s)",
    )
    new.add_argument("--force", action="store_true", help="replace a file that is there")
    new.set_defaults(run=_new)


def add_trucks(commands: Any) -> None:
    """Add the command `trucks` to the parser's."""
    trucks = commands.add_parser(
        "trucks", help="list the trucks of the catalogue", description=_TRUCKS, epilog=_EXIT_CODES
    )
    trucks.add_argument(
        "name", metavar="NAME", nargs="?", help="a truck of the catalogue, or a truck file (.toml)"
    )
    trucks.set_defaults(run=_trucks)


def add_schema(commands: Any) -> None:
    """Add the command `schema` to the parser's."""
    schema = commands.add_parser(
        "schema",
        help="print the JSON Schema of case files",
        description=_SCHEMA,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    schema.set_defaults(run=_schema)


def _new(options: argparse.Namespace) -> int:
    try:
        from pierimpact.files.new_case import new_case_for
        from pierimpact.files.write import refuse_to_replace, write_files
    except ModuleNotFoundError as error:
        return needs("case files", error)
    path = Path(options.case)
    text = new_case_for(path, options.shape, options.units)
    refuse_to_replace(path, force=options.force)
    write_files({path: text.encode()})
    print(path)
    return 0


def _trucks(options: argparse.Namespace) -> int:
    from pierimpact.files.catalogue import catalogue_text, truck_text

    print(truck_text(options.name) if options.name else catalogue_text())
    return 0


def _schema(options: argparse.Namespace) -> int:
    try:
        from pierimpact.files.schema import case_schema
    except ModuleNotFoundError as error:
        return needs("schemas", error)
    print(json.dumps(case_schema(), indent=2))  # in ASCII, which a shell redirects as it is
    return 0
