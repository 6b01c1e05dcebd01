"""The files of a portfolio: tables, page, and the full sheets of the worst piers."""

import os
import re
from collections.abc import Callable, Mapping
from pathlib import Path

import yaml

from pierimpact.checks import InputError, whole
from pierimpact.files.piers import PierTable
from pierimpact.files.unchanged import (
    refuse_changed,
    remove_unchanged,
    write_unchanged,
    written_before,
)
from pierimpact.network.page import summary_page
from pierimpact.network.portfolio import ROWS, Portfolio
from pierimpact.network.tables import rejects_csv, results_csv, results_parquet
from pierimpact.report.batch import Batch, write_reports
from pierimpact.report.write import files_of

RESULTS_CSV, RESULTS_PARQUET = "results.csv", "results.parquet"
REJECTS, PAGE, SHEETS = "rejects.csv", "summary.html", "sheets"


def refuse_portfolio(table: PierTable, folder: Path, *, force: bool = False) -> None:
    """Refuse a folder where the table or what somebody changed would be replaced.

    Raises
    ------
    InputError
        When it would be.
    """
    names = (PAGE, RESULTS_CSV, RESULTS_PARQUET, REJECTS)
    for place in (folder / name for name in names):
        if place.exists() and place.samefile(table.path):
            raise InputError(f"{place} is the table itself: give another folder as --output")
    refuse_changed(folder, names, force=force)


def write_portfolio(
    portfolio: Portfolio,
    table: PierTable,
    folder: Path,
    *,
    system: str = "SI",
    sheets: int = 0,
    force: bool = False,
    say: Callable[[str], object] = lambda line: None,
) -> list[Path]:
    """Write the results of a table of piers and return the files, those that a reader opens first.

    Parameters
    ----------
    portfolio : Portfolio
        The results.
    table : PierTable
        The table that they are of.
    folder : Path
        Folder to write to; it exists.
    system : {"SI", "US"}, optional
        Units of the tables and the page.
    sheets : int, optional
        Number of piers that get a full sheet, the worst ones; sheets of other piers, by earlier
        runs, are removed if nobody changed them.
    force : bool, optional
        Whether to replace files that somebody changed since they were written.
    say : callable, optional
        Called with what could not be written, a line each.

    Raises
    ------
    InputError
        When a file cannot be written, or must not be replaced.
    """
    whole("sheets", sheets, 0)
    refuse_portfolio(table, folder, force=force)
    cases = _cases(portfolio, table, folder / SHEETS, system, sheets)
    own = {f"{name}.yaml" for name in cases}.union(*(files_of(name, False) for name in cases))
    refuse_changed(folder / SHEETS, own, force=force)
    contents = {
        PAGE: summary_page(portfolio, system, {}),
        RESULTS_CSV: results_csv(portfolio, system),
        REJECTS: rejects_csv(portfolio.rejects),
    }
    parquet = results_parquet(portfolio, system)
    if parquet is None:
        say(f"{RESULTS_PARQUET} needs pyarrow: pip install 'pierimpact[network]'")
    else:
        contents[RESULTS_PARQUET] = parquet
    files = write_unchanged(contents, folder, force=force)
    for file in written_before(folder / SHEETS):
        if file.name not in own:
            remove_unchanged(file)
            if file.exists():
                say(f"{file} is of an earlier run, and stays because somebody changed it")
    if not cases:
        return files
    addresses = _write_sheets(cases, folder / SHEETS, force, say)
    write_unchanged({PAGE: summary_page(portfolio, system, addresses)}, folder, force=force)
    return [*files, *(folder / address for address in addresses.values())]


def _cases(
    portfolio: Portfolio, table: PierTable, into: Path, system: str, count: int
) -> dict[str, bytes]:
    """Return the case files of the worst piers by the names of their sheets, the worst first."""
    rows = {int(row): place for place, row in enumerate(portfolio.numbers["row"][:count])}
    cases: dict[int, tuple[str, bytes]] = {}
    for piece in table.pieces(ROWS) if rows else ():
        for row in piece:
            if row.number in rows:
                pier, place = table.pier(row), rows[row.number]
                values = {"element": pier.name, "units": system} | pier.values
                truck = str(values["truck"])
                if truck.endswith(".toml"):  # from the folder of the table
                    values["truck"] = os.path.relpath(table.path.parent / truck, into)
                name = re.sub(r"[^\w.-]+", "-", pier.name)[:60]
                text = yaml.safe_dump(values, allow_unicode=True, sort_keys=False)
                cases[place] = f"{place + 1:0{len(str(count))}}-{name}", text.encode()
    return dict(cases[place] for place in sorted(cases))


def _write_sheets(
    cases: Mapping[str, bytes], into: Path, force: bool, say: Callable[[str], object]
) -> dict[int, str]:
    """Write the sheets of the worst piers, and return where they are by place."""
    into.mkdir(exist_ok=True)
    texts = {f"{name}.yaml": text for name, text in cases.items()}
    batch: Batch = write_reports(write_unchanged(texts, into, force=force), into, force=force)
    for failure in batch.failures:
        say(failure.reason)
    places = {name: place for place, name in enumerate(cases)}
    return {places[report.html.stem]: f"{SHEETS}/{report.html.name}" for report in batch.reports}
