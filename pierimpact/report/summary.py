"""The summary of many cases, a row each: as a sheet, and as CSV for a spreadsheet."""

import csv
import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import pierimpact
from pierimpact.checks import no_formula
from pierimpact.report.document.blocks import Block, Headline, Notice, Paragraph, TitleBlock
from pierimpact.report.document.markup import Code, Inline, Link, Piece, Tex
from pierimpact.report.document.numbered import Column, Table, columns, wide
from pierimpact.report.results import AT_UPPER, EXCEEDED, KEPT, Results
from pierimpact.symbols import BY_KEY
from pierimpact.units import (
    Printed,
    compared,
    printed,
    rounded,
    telling_figures,
    unit_of,
    unit_size,
)

UNKNOWN = "—"  # instead of what a case does not give
#: What comes of the resistances of a case, the worst last; the first where it gives none.
STANDINGS = (None, KEPT, AT_UPPER, EXCEEDED)


_MOST_BESIDE = 3  # names of cases in a column that does not break: this project's choice


class Row(NamedTuple):
    """A case of the summary."""

    name: str  #: of its report's files, without ending
    results: Results | None  #: None where it has no report
    remarks: Sequence[str]  #: about its report's files, or why there is none
    superseded_by: str = ""  #: name of the case, among these, that supersedes it


class _Column(NamedTuple):
    """A value of each case: a column of a table, of the CSV, or of both."""

    name: str  #: of the value, and in the CSV
    heading: Piece = ""  #: in a table
    quantity: str = ""  #: of a number
    given: bool = False
    wide: bool = False
    missing: str = UNKNOWN  #: what a table shows in place of no value

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
        if isinstance(value, tuple):  # the ends of a range
            return "–".join(rounded(end / unit_size(self.quantity, system), 4) for end in value)
        if self.quantity == "ratio":
            return compared(value)
        if not self.quantity:
            return str(value)
        if self.given:  # in another unit it has no more than five figures
            size = unit_size(self.quantity, system)
            value = float(f"{value / size:.5g}") * size
        return printed(value, self.quantity, system, given=self.given).number

    def field(self, value: Any, system: str) -> Any:
        """Return a value as the CSV has it: four figures, inputs five, an empty field if none.

        A ratio has as many as show on which side of one it is.
        """
        if isinstance(value, str):
            return no_formula(value)
        if value is None:
            return None
        digits = telling_figures(value, 4) if self.quantity == "ratio" else 4 + self.given
        number = float(f"{value / unit_size(self.quantity, system):.{digits}g}")
        return int(number) if number.is_integer() else number


CHECKS = ("shear", "moment")
_ELEMENT = _Column("element", "Element", wide=True)
_CHECKED = (
    _Column("utilisation in shear", Tex(r"V/V_\mathrm{R}"), "ratio"),
    _Column("utilisation in moment", Tex(r"M/M_\mathrm{R}"), "ratio"),
    _Column("resistance", "Resistance"),
)
_REACTION = _Column("design reaction", "Reaction", "force")
_FORCES = (
    _Column("largest shear", "Shear", "force"),
    _Column("shear method", "by"),
    _Column("largest moment", "Moment", "moment"),
    _Column("moment method", "by"),
)
_CODE_RATIO = _Column("code ratio", "Code ratio", "ratio")
_OF_THE_TABLE = (
    *(_ELEMENT, *_CHECKED, _REACTION),
    _Column("band", "5 to 95 %", "force"),
    *(*_FORCES, _CODE_RATIO),
    _Column("number of warnings", "Warnings", missing="none"),
)
_OF_THE_CASES = (
    _Column("project", "Project", wide=True),
    _Column("revision", "Revision"),
    _Column("column", "Column", wide=True),
    _Column("truck", "Truck"),
    *(
        _Column(key.replace("_", " "), Tex(BY_KEY[key].latex), BY_KEY[key].quantity, given=True)
        for key in ("truck_mass", "speed", "impact_height")
    ),
    _Column("pier frequency", Tex(r"f_\mathrm{p}"), "frequency"),
    _Column("engine peak", "Engine peak", "force"),
    _Column("cargo peak", "Cargo peak", "force", missing="none"),
    _Column("governs", "Governs"),
)
_OF_THE_CSV = (
    _Column("case"),
    _Column("status"),
    _Column("job number"),
    _ELEMENT,
    *_OF_THE_CASES,
    _REACTION,
    _Column("reaction, 5 % of trucks below", quantity="force"),
    _Column("reaction, 95 % of trucks below", quantity="force"),
    *(*_FORCES, *_CHECKED, _CODE_RATIO),
    _Column("shear, 95 % of trucks below", quantity="force"),
    _Column("moment, 95 % of trucks below", quantity="moment"),
    *(_Column(f"utilisation in {check} at 95 %", quantity="ratio") for check in CHECKS),
    _Column("warnings"),
    _Column("reason"),
)


def summary_blocks(rows: Sequence[Row]) -> list[Block]:
    """Return the summary sheet of cases, at least one of which is calculated, the worst first.

    Those that another supersedes are named, and counted nowhere.
    """
    superseded = [row for row in rows if row.superseded_by]
    rows = current(rows)
    results = _calculated(rows)
    system = _system(results.values())
    ranked = sorted(
        (row for row in rows if row.results is not None),
        key=lambda row: _weight(results[row.name]),
        reverse=True,
    )
    blocks = [
        _title_block(list(results.values()), system),
        _headline(rows, system, len(superseded)),
    ]
    failures = [row.remarks for row in rows if row.results is None]
    if failures:
        blocks.append(Notice(heading="No report", body=["; ".join(why) for why in failures]))
    blocks += [
        _table("tab-results", _RESULTS_CAPTION, ranked, system, _shown(results.values())),
        *_warnings_table(ranked),
    ]
    in_title_block = {
        key
        for key in ("project", "revision")
        if len({getattr(result, key) for result in results.values()}) == 1
    }
    shown = [column for column in _OF_THE_CASES if column.name not in in_title_block]
    blocks.append(_table("tab-cases", _CASES_CAPTION, ranked, system, shown))
    if superseded:
        names = ", ".join(f"{row.name} (by {row.superseded_by})" for row in superseded)
        blocks.append(Paragraph(f"Left out, for another of these cases supersedes it: {names}."))
    if len({result.sheet_units for result in results.values()}) > 1:
        blocks.append(
            Paragraph("The reports are not all in the same units; this summary is in SI.")
        )
    blocks.append(
        Paragraph(
            (
                "The report of each case says what its values rest on, and its assumptions and "
                "limits. The same values, a row for each case that was given, are in ",
                Code("summary.csv"),
                f". Made by pierimpact {pierimpact.__version__}.",
            )
        )
    )
    return blocks


_RESULTS_CAPTION = (
    "Results, the worst case first: those that exceed a resistance, then those that do so at the "
    "upper end of the band of shear or moment; by the larger utilisation and, of cases without a "
    "resistance, by the code ratio. Design reaction, with the reactions that 5 and 95 % of trucks "
    "of the given spread stay below; largest shear ",
    *(Tex("V"), " and moment ", Tex("M"), " anywhere on the column, by the column as a beam or "),
    *("under the static reaction, and over their resistances ", Tex(r"V_\mathrm{R}"), " and "),
    *(Tex(r"M_\mathrm{R}"), " (where its parts resist differently, of the part that uses most of "),
    "its own); code ratio: largest 25 ms average of the contact force over the force of AASHTO "
    "LRFD, which is such an average.",
)
_CASES_CAPTION = (
    *("Cases: total mass of the truck ", Tex("m_1 + m_2"), ", speed at first touch ", Tex("V")),
    *(", nominal impact height ", Tex(r"z_\mathrm{n}"), " and frequency of the pier "),
    *(Tex(r"f_\mathrm{p}"), "; engine and cargo peak of the full model. Where the engine has not "),
    "arrived by the first, it is the sheet metal’s.",
)


def _weight(result: Results) -> tuple[float, float, float, float]:
    """Return what a case is ranked by, the worst largest."""
    utilisation = max(result.utilisations.values(), default=0.0)
    standing = STANDINGS.index(result.resistance)
    return standing, utilisation, result.code_ratio, result.design_reaction


def _shown(results: Iterable[Results]) -> list[_Column]:
    """Return the columns of the results that have a value in any case."""
    checked = {check for result in results for check in result.utilisations}
    left_out = {f"utilisation in {check}" for check in CHECKS if check not in checked}
    if not checked:
        left_out.add("resistance")
    return [column for column in _OF_THE_TABLE if column.name not in left_out]


def _warnings_table(ranked: Sequence[Row]) -> Iterator[Block]:
    """Yield the warnings as a table, each once with its cases; of the worst case first."""
    names: dict[str, list[str]] = {}
    for row in ranked:
        for text in _warnings(row):
            names.setdefault(text, []).append(row.name)
    if names:
        long = _MOST_BESIDE < max(map(len, names.values())) < len(ranked)
        yield Table(
            label="tab-warnings",
            caption="Warnings, those of the worst case first, and of each case what is least safe.",
            columns=columns(wide("Warning"), wide("Cases") if long else "Cases"),
            rows=[
                [text, _links(own) if len(own) < max(len(ranked), 2) else "all"]
                for text, own in names.items()
            ],
        )


def summary_csv(rows: Sequence[Row]) -> str:
    """Return the summary as comma-separated values, units in the header, a row for each case.

    Text is in quotes; none of it can be taken for a formula.
    """
    system = _system(_calculated(rows).values())
    text = io.StringIO()
    writer = csv.writer(text, quoting=csv.QUOTE_NONNUMERIC)
    writer.writerow([column.name + column.unit(system) for column in _OF_THE_CSV])
    for row in rows:
        values = _values(row, system)
        writer.writerow([column.field(values.get(column.name), system) for column in _OF_THE_CSV])
    return text.getvalue()


def current(rows: Iterable[Row]) -> list[Row]:
    """Return the rows of cases that no other supersedes."""
    return [row for row in rows if not row.superseded_by]


def _calculated(rows: Iterable[Row]) -> dict[str, Results]:
    return {row.name: row.results for row in rows if row.results is not None}


def _system(results: Iterable[Results]) -> str:
    """Return the units that all cases print in; SI where they differ."""
    systems = {result.sheet_units for result in results}
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


def _headline(rows: Sequence[Row], system: str, superseded: int) -> Block:
    """Return how many cases there are, how many are not as they should be, and the worst."""
    without = f", {superseded} superseded left out" if superseded else ""
    results = _calculated(rows)
    standings = [result.resistance for result in results.values()]
    at_upper = {
        name: result.upper_utilisations
        for name, result in results.items()
        if result.resistance == AT_UPPER
    }
    worst = _worst({name: result.utilisations for name, result in results.items()})
    warned = sum(bool(_warnings(row)) for row in rows if row.results is not None)
    strongest = max(results, key=lambda name: results[name].design_reaction)
    failed = len(rows) - len(results)
    counts = (
        ("Cases", len(rows), f"{len(results)} calculated{without}"),
        (
            "Exceed a resistance",
            standings.count(EXCEEDED),
            f"largest utilisation {worst}" if worst else "no case gives a resistance",
        ),
        *(
            [("Exceed one at 95 % only", len(at_upper), _worst(at_upper) or "of those that hold")]
            if any(result.upper_utilisations for result in results.values())
            else []
        ),
        ("Without a report", failed, "reasons below" if failed else "every case has its report"),
        ("With warnings", warned, f"of {len(results)} calculated"),
    )
    entries = [(label, Printed(str(count), ""), remark) for label, count, remark in counts]
    reaction = printed(results[strongest].design_reaction, "force", system)
    entries.append(("Largest design reaction", reaction, strongest))
    code, name = max((result.code_ratio, name) for name, result in results.items())
    remark = f"{name}; 25 ms average over AASHTO LRFD"
    entries.append(("Largest code ratio", Printed(rounded(code, 3), ""), remark))
    return Headline(results=entries)


def _worst(utilisations: Mapping[str, Mapping[str, float]]) -> str:
    """Return the largest utilisation, by the names of cases, with its case; "" of none."""
    ratios = [
        (ratio, name, check)
        for name, of_case in utilisations.items()
        for check, ratio in of_case.items()
    ]
    if not ratios:
        return ""
    ratio, name, check = max(ratios)
    return f"{compared(ratio)}: {name}, in {check}"


def _table(
    label: str, caption: Inline, rows: Sequence[Row], system: str, shown: Sequence[_Column]
) -> Table:
    """Return a table of the calculated cases, a row each, those that exceed a resistance strong."""
    cases = [_values(row, system) for row in rows]
    return Table(
        label=label,
        caption=caption,
        columns=columns("Case", *(column.of_table(system) for column in shown)),
        rows=[
            [_link(row.name), *(column.cell(values[column.name], system) for column in shown)]
            for row, values in zip(rows, cases, strict=True)
        ],
        strong=[n for n, values in enumerate(cases) if values["resistance"] == EXCEEDED],
    )


def _link(name: str) -> Link:
    return Link(name, f"{name}.html")


def _links(names: Sequence[str]) -> Inline:
    """Return the names of cases with commas between them."""
    return tuple(piece for name in names for piece in (", ", _link(name)))[1:]


def _values(row: Row, system: str) -> dict[str, Any]:
    """Return the values of a case by their names, in SI; of a failure those there are."""
    result = row.results
    if result is None:
        return {"case": row.name, "status": "not calculated", "reason": "; ".join(row.remarks)}
    values = {name.replace("_", " "): value for name, value in result.model_dump().items()}
    for check in CHECKS:
        upper = result.upper_utilisations.get(check)
        _, high = result.member_bands.get(check, (None, None))
        if check in result.uses:  # on the part that the utilisation is of
            use = result.uses[check]
            values[f"largest {check}"], values[f"{check} method"] = use.demand, use.method
            high = None if upper is None else upper * use.resistance
        values[f"utilisation in {check}"] = result.utilisations.get(check)
        values[f"utilisation in {check} at 95 %"] = upper
        values[f"{check}, 95 % of trucks below"] = high
    low, high = result.band or (None, None)
    warnings = _warnings(row)
    return values | {
        "case": row.name,
        "status": f"superseded by {row.superseded_by}" if row.superseded_by else "calculated",
        "column": column_in_words(result, system),
        "reaction, 5 % of trucks below": low,
        "reaction, 95 % of trucks below": high,
        "number of warnings": len(warnings),
        "warnings": "; ".join(warnings),
    }


def column_in_words(result: Results, system: str) -> str:
    """Return the column in a few words."""
    sizes = [printed(size, "section length", system, given=True) for size in result.column_sizes]
    section = result.column_shape
    if sizes:
        section += f" {' × '.join(size.number for size in sizes)} {sizes[0].unit}"

    def shown(value: float, quantity: str) -> str:
        return str(printed(value, quantity, system, given=True))

    steps = " and ".join(shown(height, "length") for height in result.step_heights)
    return ", ".join(
        [
            section,
            *([f"stepped at {steps}"] if steps else []),
            f"{shown(result.column_height, 'length')} high",
            *([f"embedded {shown(result.embedment, 'length')}"] if result.embedment else []),
            f"base {result.base}",
            f"top {result.top}",
            *([f"{shown(result.top_mass, 'mass')} on it"] if result.top_mass else []),
        ]
    )


def _warnings(row: Row) -> list[str]:
    """Return what to know before relying on a case, what is least safe first."""
    assert row.results is not None
    return [*row.results.warnings, *row.remarks]
