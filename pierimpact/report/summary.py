"""The summary of many cases, a row each: as a sheet, and as CSV for a spreadsheet."""

import csv
import io
import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import pierimpact
from pierimpact.report.document.blocks import Block, Headline, Notice, Paragraph, TitleBlock
from pierimpact.report.document.markup import Code, Inline, Link, Piece, Tex
from pierimpact.report.document.numbered import Column, Table
from pierimpact.report.results import Results
from pierimpact.report.sheet.summary import limits_of_the_study
from pierimpact.symbols import BY_KEY
from pierimpact.units import Printed, printed, rounded, unit_of, unit_size

NONE = "none"  # instead of a peak that is not there


class Row(NamedTuple):
    """A case of the summary."""

    name: str  #: of its report's files, without ending
    results: Results | None  #: None where it has no report
    remarks: Sequence[str]  #: warnings of its report, or why there is none


class _Quantity(NamedTuple):
    """A value of each case: a column of a table and one of the CSV."""

    attribute: str  #: of Results
    heading: Piece
    quantity: str
    given: bool = False


_GIVEN = tuple(
    _Quantity(key, Tex(BY_KEY[key].latex), BY_KEY[key].quantity, given=True)
    for key in ("truck_mass", "speed", "impact_height")
)
_RESULTS = (
    _Quantity("pier_frequency", Tex(r"f_\mathrm{p}"), "frequency"),
    _Quantity("engine_peak", "Engine peak", "force"),
    _Quantity("cargo_peak", "Cargo peak", "force"),
    _Quantity("design_reaction", "Design reaction", "force"),
)
_UTILISATIONS = ("shear", "moment")


def summary_blocks(rows: Sequence[Row]) -> list[Block]:
    """Return the summary sheet of cases, at least one of which is calculated."""
    results = _calculated(rows)
    system = _system(results.values())
    blocks = [_title_block(list(results.values()), system), _headline(rows, system)]
    failures = [row.remarks for row in rows if row.results is None]
    if failures:
        blocks.append(Notice(heading="Not calculated", body=["; ".join(why) for why in failures]))
    blocks += [_results_table(rows, system), _cases_table(rows, system)]
    if len({result.units for result in results.values()}) > 1:
        blocks.append(Paragraph("The reports are not all in the same units; this table is in SI."))
    blocks.append(
        Paragraph(
            (
                "The report of each case says what its values rest on, and its assumptions and "
                "limits. The same values with all their digits are in ",
                Code("summary.csv"),
                f". Made by pierimpact {pierimpact.__version__}.",
            )
        )
    )
    return blocks


def summary_csv(rows: Sequence[Row]) -> str:
    """Return the summary as comma-separated values, numbers unrounded and units in the header.

    Text is in quotes; none of it can be taken for a formula.
    """
    system = _system(_calculated(rows).values())
    columns = (*_GIVEN, *_RESULTS)
    quantities = [
        f"{column.attribute.replace('_', ' ')} [{unit_of(column.quantity, system)}]"
        for column in columns
    ]
    utilisations = [f"utilisation in {name}" for name in _UTILISATIONS]
    words = ["case", "project", "job number", "element", "column", "truck"]
    header = [*words, *quantities, "governs", *utilisations, "status", "remarks"]
    text = io.StringIO()
    # In the order of the header; a value that is not there is an empty field.
    writer = csv.writer(text, quoting=csv.QUOTE_NONNUMERIC)
    writer.writerow(header)
    for name, result, remarks in rows:
        values: list[str | float | None] = [None] * (len(header) - 3)
        if result is not None:
            values = [
                *(result.project, result.job_number, result.element, _column(result, system)),
                result.truck,
                *(_in_unit(column, result, system) for column in columns),
                result.governs,
                *(result.utilisations.get(check) for check in _UTILISATIONS),
            ]
        status = "not calculated" if result is None else "calculated"
        all_remarks = "; ".join((*_remarks(result, system), *remarks))
        cells = [name, *values, status, all_remarks]
        writer.writerow([no_formula(cell) if isinstance(cell, str) else cell for cell in cells])
    return text.getvalue()


def no_formula(text: str) -> str:
    """Return text with an apostrophe before what a spreadsheet would take for a formula.

    That is at the start, and after a semicolon, where many a spreadsheet starts a field.
    """
    return re.sub(r"(^|;)(\s*[=+\-@＝＋－＠])", r"\1'\2", text)


def _calculated(rows: Iterable[Row]) -> dict[str, Results]:
    return {row.name: row.results for row in rows if row.results is not None}


def _system(results: Iterable[Results]) -> str:
    """Return the units that all cases print in; SI where they differ."""
    systems = {result.units for result in results}
    return systems.pop() if len(systems) == 1 else "SI"


def _title_block(results: Sequence[Results], system: str) -> Block:
    date = max(result.date for result in results).isoformat()

    def common(key: str) -> str:
        texts = {getattr(result, key) for result in results}
        return texts.pop() if len(texts) == 1 else "several"

    return TitleBlock(
        title="Truck collisions with bridge piers",
        subtitle="Summary of calculation sheets. Coupled mass-spring-damper (CMSD) model of the "
        "collision",
        entries={
            "Project": common("project"),
            "Element": f"{len(results)} cases" if len(results) > 1 else common("element"),
            "Job number": common("job_number"),
            "Revision": common("revision"),
            "Prepared by": common("prepared_by"),
            "Checked by": common("checked_by"),
            "Date": date,
        },
        date=date,
        paper="a4" if system == "SI" else "us-letter",
        landscape=True,
    )


def _headline(rows: Sequence[Row], system: str) -> Block:
    """Return how many cases there are, and the worst of them."""
    results = _calculated(rows)
    worst = max(results, key=lambda name: results[name].design_reaction)
    reaction = printed(results[worst].design_reaction, "force", system)
    entries = [
        ("Cases calculated", Printed(str(len(results)), ""), f"of {len(rows)}"),
        ("Largest design reaction", reaction, worst),
    ]
    ratios = [
        (ratio, check, name)
        for name, result in results.items()
        for check, ratio in result.utilisations.items()
    ]
    if ratios:
        ratio, check, name = max(ratios)
        entries.append(
            ("Largest utilisation", Printed(rounded(ratio, 3), ""), f"{name}, in {check}")
        )
    return Headline(results=entries)


def _results_table(rows: Sequence[Row], system: str) -> Block:
    """Return the results of the calculated cases, a row each."""
    results = _calculated(rows)
    remarks = {row.name: row.remarks for row in rows}
    checks = [
        check
        for check in _UTILISATIONS
        if any(check in result.utilisations for result in results.values())
    ]
    cells: list[list[Inline]] = [
        [
            _link(name),
            *(_shown(column, result, system) for column in _RESULTS),
            result.governs,
            *(
                rounded(result.utilisations[check], 3) if check in result.utilisations else "—"
                for check in checks
            ),
            "; ".join((*_remarks(result, system), *remarks[name])) or "—",
        ]
        for name, result in results.items()
    ]
    return Table(
        label="tab-results",
        caption=(
            "Results. Engine and cargo peak are those of the full model; the design reaction is "
            "the larger of its and of the design procedure’s, and ",
            Tex(r"f_\mathrm{p}"),
            " the frequency of the pier.",
        ),
        columns=[
            Column(heading="Case"),
            *(_heading(column, system) for column in _RESULTS),
            Column(heading="Governs"),
            *(Column(heading=f"Utilisation, {check}", align="decimal") for check in checks),
            Column(heading="Remarks", wide=True),
        ],
        rows=cells,
    )


def _cases_table(rows: Sequence[Row], system: str) -> Block:
    """Return column, truck and collision of the calculated cases, a row each."""
    results = _calculated(rows)
    # A project that all share stands in the title block.
    projects = len({result.project for result in results.values()}) > 1
    cells: list[list[Inline]] = [
        [
            _link(name),
            *([result.project] if projects else []),
            result.element,
            _column(result, system),
            result.truck,
            *(_shown(column, result, system) for column in _GIVEN),
        ]
        for name, result in results.items()
    ]
    return Table(
        label="tab-cases",
        caption=(
            "Cases: total mass of the truck ",
            Tex("m_1 + m_2"),
            ", speed at first touch ",
            Tex("V"),
            " and nominal impact height ",
            Tex(r"z_\mathrm{n}"),
            ".",
        ),
        columns=[
            Column(heading="Case"),
            *([Column(heading="Project", wide=True)] if projects else []),
            Column(heading="Element", wide=True),
            Column(heading="Column", wide=True),
            Column(heading="Truck"),
            *(_heading(column, system) for column in _GIVEN),
        ],
        rows=cells,
    )


def _link(name: str) -> Link:
    return Link(name, f"{name}.html")


def _heading(column: _Quantity, system: str) -> Column:
    return Column(
        heading=(column.heading, f" [{unit_of(column.quantity, system)}]"), align="decimal"
    )


def _in_unit(column: _Quantity, result: Results, system: str) -> float | None:
    value = getattr(result, column.attribute)
    return None if value is None else value / unit_size(column.quantity, system)


def _shown(column: _Quantity, result: Results, system: str) -> str:
    value = getattr(result, column.attribute)
    if value is None:
        return NONE
    return printed(value, column.quantity, system, given=column.given).number


def _column(result: Results, system: str) -> str:
    """Return the column in a few words."""
    sizes = [printed(size, "section length", system, given=True) for size in result.column_sizes]
    section = " × ".join(size.number for size in sizes)
    height = printed(result.column_height, "length", system, given=True)
    return (
        f"{result.column_shape} {section} {sizes[0].unit}, {height} high, "
        f"base {result.base}, top {result.top}"
    )


def _remarks(result: Results | None, system: str) -> list[str]:
    """Return what to know before relying on a row."""
    if result is None:
        return []
    remarks = [] if result.truck_status.verified else [f"truck {result.truck_status.words}"]
    if result.assumed:
        remarks.append(f"{result.assumed} input{'s' * (result.assumed > 1)} assumed")
    if not result.engine_contact:
        remarks.append("no engine contact")
    remarks += limits_of_the_study(result.outside, result.overlapping, system)
    exceeded = [check for check, ratio in result.utilisations.items() if ratio > 1.0]
    return remarks + [f"exceeds the resistance to {check}" for check in exceeded]
