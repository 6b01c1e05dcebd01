"""The summary of many cases, a row each: as a sheet, and as CSV for a spreadsheet."""

import csv
import io
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import pierimpact
from pierimpact.checks import no_formula
from pierimpact.report.document.blocks import Block, Headline, Notice, Paragraph, TitleBlock
from pierimpact.report.document.markup import Code, Inline, Link, Piece, Tex
from pierimpact.report.document.numbered import Column, Table, columns
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


class _Column(NamedTuple):
    """A value of each case: a column of the CSV and, if it has a heading, of a table."""

    name: str  #: of the value
    heading: Piece = ""
    quantity: str = ""  #: of a number
    given: bool = False
    wide: bool = False
    missing: str = ""  #: what a table shows in place of no value

    def unit(self, system: str) -> str:
        """Return the unit in brackets after a space, or nothing where there is none."""
        unit = unit_of(self.quantity, system) if self.quantity else ""
        return f" [{unit}]" if unit else ""

    def of_table(self, system: str) -> Column:
        """Return the column of a table."""
        heading = (self.heading, self.unit(system)) if self.unit(system) else self.heading
        align = "decimal" if self.quantity else "left"
        return Column(heading=heading, align=align, wide=self.wide)

    def cell(self, value: Any, system: str) -> str:
        """Return a value as a table shows it."""
        if not value and not isinstance(value, float):
            return self.missing
        if self.quantity == "ratio":
            return rounded(value, 3)
        if not self.quantity:
            return str(value)
        return printed(value, self.quantity, system, given=self.given).number

    def field(self, value: Any, system: str) -> Any:
        """Return a value as the CSV has it: unrounded, and None, an empty field, if missing."""
        if isinstance(value, str):
            return no_formula(value)
        return value / unit_size(self.quantity, system) if value is not None else None


_CHECKS = ("shear", "moment")
_CASE = (
    _Column("project", "Project", wide=True),
    _Column("job number"),
    _Column("element", "Element", wide=True),
    _Column("column", "Column", wide=True),
    _Column("truck", "Truck"),
    *(
        _Column(key.replace("_", " "), Tex(BY_KEY[key].latex), BY_KEY[key].quantity, given=True)
        for key in ("truck_mass", "speed", "impact_height")
    ),
)
_RESULTS = (
    _Column("pier frequency", Tex(r"f_\mathrm{p}"), "frequency"),
    _Column("engine peak", "Engine peak", "force"),
    _Column("cargo peak", "Cargo peak", "force", missing=NONE),
    _Column("design reaction", "Design reaction", "force"),
    _Column("governs", "Governs"),
    *(
        _Column(f"utilisation in {check}", f"Utilisation, {check}", "ratio", missing="—")
        for check in _CHECKS
    ),
    _Column("status"),
    _Column("remarks", "Remarks", wide=True, missing="—"),
)


def summary_blocks(rows: Sequence[Row]) -> list[Block]:
    """Return the summary sheet of cases, at least one of which is calculated."""
    results = _calculated(rows)
    system = _system(results.values())
    blocks = [_title_block(list(results.values()), system), _headline(rows, system)]
    failures = [row.remarks for row in rows if row.results is None]
    if failures:
        blocks.append(Notice(heading="Not calculated", body=["; ".join(why) for why in failures]))
    checked = {check for result in results.values() for check in result.utilisations}
    left_out = {f"utilisation in {check}" for check in _CHECKS if check not in checked}
    if len({result.project for result in results.values()}) == 1:
        left_out.add("project")  # it stands in the title block
    results_caption = (
        "Results. Engine and cargo peak are those of the full model; the design reaction is the "
        "larger of its and of the design procedure’s, and ",
        Tex(r"f_\mathrm{p}"),
        " the frequency of the pier.",
    )
    cases_caption = (
        *("Cases: total mass of the truck ", Tex("m_1 + m_2"), ", speed at first touch "),
        *(Tex("V"), " and nominal impact height ", Tex(r"z_\mathrm{n}"), "."),
    )
    for label, caption, of in (
        ("tab-results", results_caption, _RESULTS),
        ("tab-cases", cases_caption, _CASE),
    ):
        shown = [column for column in of if column.heading and column.name not in left_out]
        blocks.append(_table(label, caption, rows, system, shown))
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
    shown = (_Column("case"), *_CASE, *_RESULTS)
    text = io.StringIO()
    writer = csv.writer(text, quoting=csv.QUOTE_NONNUMERIC)
    writer.writerow([column.name + column.unit(system) for column in shown])
    for row in rows:
        values = _values(row, system)
        writer.writerow([column.field(values.get(column.name), system) for column in shown])
    return text.getvalue()


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


def _table(
    label: str, caption: Inline, rows: Sequence[Row], system: str, shown: Sequence[_Column]
) -> Table:
    """Return a table of the calculated cases, a row each."""
    cases = [_values(row, system) for row in rows if row.results is not None]
    return Table(
        label=label,
        caption=caption,
        columns=columns("Case", *(column.of_table(system) for column in shown)),
        rows=[
            [
                Link(values["case"], f"{values['case']}.html"),
                *(column.cell(values[column.name], system) for column in shown),
            ]
            for values in cases
        ],
    )


def _values(row: Row, system: str) -> dict[str, Any]:
    """Return the values of a case by their names, in SI; of a failure those there are."""
    result = row.results
    values = {
        "case": row.name,
        "status": "not calculated" if result is None else "calculated",
        "remarks": "; ".join((*_remarks(result, system), *row.remarks)),
    }
    if result is None:
        return values
    values |= {name.replace("_", " "): value for name, value in result.model_dump().items()}
    checks = {f"utilisation in {check}": result.utilisations.get(check) for check in _CHECKS}
    return values | checks | {"column": column_in_words(result, system)}


def column_in_words(result: Results, system: str) -> str:
    """Return the column in a few words."""
    sizes = [printed(size, "section length", system, given=True) for size in result.column_sizes]
    section = result.column_shape
    if sizes:
        section += f" {' × '.join(size.number for size in sizes)} {sizes[0].unit}"
    height = printed(result.column_height, "length", system, given=True)
    return f"{section}, {height} high, base {result.base}, top {result.top}"


def _remarks(result: Results | None, system: str) -> list[str]:
    """Return what to know before relying on a row."""
    if result is None:
        return []
    remarks = [] if result.truck_status.verified else [f"truck {result.truck_status.words}"]
    if result.assumed:
        remarks.append(f"{result.assumed} input{'s' * (result.assumed > 1)} assumed")
    remarks += [f"unusual {BY_KEY[key].meaning}" for key, *_ in result.unusual]
    if not result.engine_contact:
        remarks.append("no engine contact")
    remarks += limits_of_the_study(result.outside, result.overlapping, system)
    exceeded = [check for check, ratio in result.utilisations.items() if ratio > 1.0]
    return remarks + [f"exceeds the resistance to {check}" for check in exceeded]
