"""The commands for many piers: `portfolio` and `inventory`."""

import argparse
from pathlib import Path
from typing import Any

from pierimpact.checks import InputError
from pierimpact.cli.terminal import complain, needs, progress_bars, system_of
from pierimpact.units import SYSTEMS

_PORTFOLIO = """\
Calculate every pier of a table, CSV or Parquet, by the full model: reactions with their band, the
largest shear and moment, the 25 ms average beside the force of the code, utilisations and rank.
The columns are id and the keys of a case file, with the unit in the heading, such as
speed [km/h], or in each cell; latitude and longitude in degrees may be among them. Writes
results.csv, results.parquet, rejects.csv (rows with errors, which do not stop the others) and
summary.html with distributions, a map and a table. A bad heading, an id given twice and a column
whose first value has no unit stop it before it begins. Interrupted and run again, it goes on where
it was; what it needs for that is in DIR/pieces, which may be deleted. Results that are there are
replaced, and sheets by earlier runs removed, unless somebody changed them.
"""
_EPILOG = """\
A row costs one to some milliseconds of one core; as a beam, 150 to 300 ms more. Exit code: 0 if the
results are written, whether or not rows were rejected; 2 if the table is bad or the scheduler does
not answer; 1 if anything else failed; 130 if interrupted.
"""


def add_portfolio(commands: Any) -> None:
    """Add the command `portfolio` to the parser's."""
    portfolio = commands.add_parser(
        "portfolio",
        help="calculate every pier of a table",
        description=_PORTFOLIO,
        epilog=_EPILOG,
        allow_abbrev=False,
    )
    portfolio.add_argument("table", metavar="PIERS.csv", help="table of piers: .csv or .parquet")
    portfolio.add_argument(
        "--output", metavar="DIR", default="portfolio",
        help="folder to write to (default: %(default)s)",
    )  # fmt: skip
    portfolio.add_argument(
        "--sheets", metavar="N", type=int, default=0,
        help="write the full sheets of the worst N piers too, some seconds each (default: none)",
    )  # fmt: skip
    portfolio.add_argument(
        "--beams", metavar="WHICH", choices=("rule", "asked"), default="rule",
        help="which piers are calculated as a beam too: asked, those whose cell member_forces is "
        "larger or beam; rule, also those with an empty cell whose static member forces may be too "
        "low (default: %(default)s)",
    )  # fmt: skip
    portfolio.add_argument(
        "--units", metavar="SYSTEM", type=system_of, choices=SYSTEMS, default="SI",
        help="units of the results: SI or US (default: %(default)s)",
    )  # fmt: skip
    add_workers(portfolio)
    portfolio.add_argument(
        "--force", action="store_true", help="replace files that somebody changed, too"
    )
    portfolio.set_defaults(run=_portfolio)


def add_workers(command: argparse.ArgumentParser) -> None:
    """Add the options that say who does the work."""
    command.add_argument(
        "--workers", metavar="N", type=int, help="processes on this machine (default: all cores)"
    )
    command.add_argument(
        "--scheduler", metavar="ADDRESS",
        help="Dask scheduler whose workers do the work, such as tcp://10.0.0.1:8786",
    )  # fmt: skip


def _portfolio(options: argparse.Namespace) -> int:
    try:
        from pierimpact.files.piers import read_pier_table
        from pierimpact.network.files import refuse_portfolio, write_portfolio
        from pierimpact.network.portfolio import calculate_portfolio
        from pierimpact.network.workers import LostWorkersError
    except ModuleNotFoundError as error:
        return needs("portfolios", error)
    if options.sheets < 0:
        raise InputError(f"--sheets must not be negative, got {options.sheets}")
    table, folder = read_pier_table(options.table), Path(options.output)
    refuse_portfolio(table, folder, force=options.force)
    try:
        with progress_bars() as progress:
            portfolio = calculate_portfolio(
                table,
                folder,
                beams=options.beams,
                workers=options.workers,
                scheduler=options.scheduler,
                say=complain,
                progress=progress,
            )
    except LostWorkersError as error:
        complain(f"{error}; run again to go on from here")
        return 1
    except KeyboardInterrupt:
        raise KeyboardInterrupt("run again to go on from here") from None
    files = write_portfolio(
        portfolio,
        table,
        folder,
        system=options.units,
        sheets=options.sheets,
        force=options.force,
        say=complain,
    )
    print(*files, sep="\n")
    if portfolio.rejects:
        first = portfolio.rejects[0]
        complain(
            f"{len(portfolio.rejects):,} of {portfolio.size:,} rows were rejected, the first: "
            f"row {first.row}: {first.reason}"
        )
    return 0


_INVENTORY = """\
Make a table of piers for the command portfolio from a delimited file of the US National Bridge
Inventory: a row for each bridge with lanes under it. The inventory does not hold piers, nor the
speed below: a rules file (TOML) gives the keys of a case file for all bridges, and by kind of
structure, such as

  [every]
  truck = "single-unit-8t"
  speed = "80 km/h"
  [[rules]]
  when = { kind = ["1", "2"], built = [1950, 1989] }
  column_shape = "circular"
  column_diameter = "36 in"

Beside PIERS.csv, PIERS-inventory.csv has what the inventory holds of the same bridges: coordinates,
year, lanes under, traffic and trucks a day, and clearances. Of a bridge with a record for each of
its routes these are of one under it, whose trucks can strike the pier; its column route says over
where there is no such record. Tables that are there already are replaced, unless somebody changed
them.
"""


def add_inventory(commands: Any) -> None:
    """Add the command `inventory` to the parser's."""
    inventory = commands.add_parser(
        "inventory",
        help="make a table of piers from a bridge inventory",
        description=_INVENTORY,
        epilog="Exit code: 0 if the tables are written; 2 if the input is bad.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    inventory.add_argument("inventory", metavar="NBI.txt", help="delimited file of the inventory")
    inventory.add_argument(
        "--rules", metavar="RULES.toml", required=True, help="what the inventory does not hold"
    )
    inventory.add_argument(
        "--output", metavar="PIERS.csv", default="piers.csv",
        help="table to write (default: %(default)s)",
    )  # fmt: skip
    inventory.add_argument(
        "--force", action="store_true", help="replace tables that somebody changed, too"
    )
    inventory.set_defaults(run=_inventory)


def _inventory(options: argparse.Namespace) -> int:
    try:
        from pierimpact.files.inventory import piers_of, read_rules
        from pierimpact.files.unchanged import write_unchanged
    except ModuleNotFoundError as error:
        return needs("inventories", error)
    rules = read_rules(Path(options.rules))
    piers = piers_of(Path(options.inventory), rules)
    for reason, count in piers.left_out.most_common():
        complain(f"left out, {count:,}: {reason}")
    for reason, count in piers.blank.most_common():
        complain(f"left blank, {count:,}: {reason}")
    if not piers.count:
        raise InputError(f"{options.inventory} has no bridge that gives a pier: nothing written")
    output = Path(options.output)
    held = output.with_name(f"{output.stem}-inventory.csv")
    tables = {output.name: piers.piers, held.name: piers.held}
    write_unchanged(tables, output.parent, force=options.force)
    complain(f"by the rules, for the inventory does not hold it: {', '.join(rules.keys)}")
    print(output, held, sep="\n")
    return 0
