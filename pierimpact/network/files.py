"""The files of a portfolio: tables, page, and the full sheets of the worst piers."""

import os
import re
from collections.abc import Callable
from pathlib import Path

import yaml

from pierimpact.checks import whole
from pierimpact.files.piers import PierTable
from pierimpact.files.write import write_files
from pierimpact.network.page import summary_page
from pierimpact.network.portfolio import ROWS, Portfolio
from pierimpact.network.tables import rejects_csv, results_csv, results_parquet
from pierimpact.report.batch import Batch, write_reports

RESULTS_CSV, RESULTS_PARQUET = "results.csv", "results.parquet"
REJECTS, PAGE, SHEETS = "rejects.csv", "summary.html", "sheets"


def write_portfolio(
    portfolio: Portfolio,
    table: PierTable,
    folder: Path,
    *,
    system: str = "SI",
    sheets: int = 0,
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
        Number of piers that get a full sheet, the worst ones.
    say : callable, optional
        Called with what could not be written, a line each.

    Raises
    ------
    InputError
        When a file cannot be written.
    """
    whole("sheets", sheets, 0)
    contents = {
        folder / PAGE: summary_page(portfolio, system, {}),
        folder / RESULTS_CSV: results_csv(portfolio, system),
        folder / REJECTS: rejects_csv(portfolio.rejects),
    }
    parquet = results_parquet(portfolio, system)
    if parquet is None:
        say(f"{RESULTS_PARQUET} needs pyarrow: pip install 'pierimpact[network]'")
    else:
        contents[folder / RESULTS_PARQUET] = parquet
    write_files(contents)
    if not sheets:
        return list(contents)
    addresses = _write_sheets(portfolio, table, folder, system, sheets, say)
    write_files({folder / PAGE: summary_page(portfolio, system, addresses)})
    return [*contents, *(folder / address for address in addresses.values())]


def _write_sheets(
    portfolio: Portfolio,
    table: PierTable,
    folder: Path,
    system: str,
    count: int,
    say: Callable[[str], object],
) -> dict[int, str]:
    """Write the sheets of the worst piers, and return where they are by place."""
    rows = {int(row): place for place, row in enumerate(portfolio.numbers["row"][:count])}
    into = folder / SHEETS
    into.mkdir(exist_ok=True)
    cases: dict[Path, int] = {}
    texts: dict[Path, bytes] = {}
    for piece in table.pieces(ROWS):
        for row in piece:
            if row.number in rows:
                pier, place = table.pier(row), rows[row.number]
                values = {"element": pier.name, "units": system} | pier.values
                truck = str(values["truck"])
                if truck.endswith(".toml"):  # from the folder of the table
                    values["truck"] = os.path.relpath(table.path.parent / truck, into)
                name = re.sub(r"[^\w.-]+", "-", pier.name)[:60]
                case = into / f"{place + 1:0{len(str(count))}}-{name}.yaml"
                cases[case] = place
                texts[case] = yaml.safe_dump(values, allow_unicode=True, sort_keys=False).encode()
    ordered = sorted(cases, key=lambda case: cases[case])
    write_files(texts)
    batch: Batch = write_reports(ordered, into)
    for failure in batch.failures:
        say(failure.reason)
    by_name = {case.stem: place for case, place in cases.items()}
    return {by_name[report.html.stem]: f"{SHEETS}/{report.html.name}" for report in batch.reports}
