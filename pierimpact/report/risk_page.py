"""The risk of a case as a page that needs no network, and its curve as CSV."""

import csv
import io
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

import pierimpact
from pierimpact.files.unchanged import put_unchanged
from pierimpact.plots.risk import draw_exceedance, draw_feared, reactions
from pierimpact.report.document.blocks import Block, Headline, Notice, Paragraph, TitleBlock
from pierimpact.report.document.markup import Code, Inline, Tex
from pierimpact.report.document.numbered import Figure, Table, columns, decimal, wide
from pierimpact.report.risk import (
    RATES,
    TXDOT,
    CaseRisk,
    drawn,
    heights_text,
    large_mass,
    laws,
    lines,
    share_text,
    statement,
    value_text,
    yearly,
)
from pierimpact.report.write import folder_for, write_blocks
from pierimpact.risk.exceedance import Estimate
from pierimpact.risk.traffic import YEAR
from pierimpact.symbols import BY_KEY
from pierimpact.units import Printed, printed, rounded, unit_of, unit_size

Array: TypeAlias = NDArray[np.float64]

#: Frequencies of the table [1/year], and rows of the curve as CSV: this project's choice.
_FREQUENCIES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
_ROWS = 200


def risk_files(name: str) -> list[str]:
    """Return the names of the files of a risk: that of the page, and that of the curve."""
    return [f"{name}-risk.{ending}" for ending in ("html", "csv")]


def write_risk(
    name: str, result: CaseRisk, output_dir: str | Path, *, force: bool = False
) -> list[Path]:
    """Write NAME-risk.html and NAME-risk.csv, both or none, and return where they are.

    Parameters
    ----------
    name : str
        Name of the case.
    result : CaseRisk
        Its risk.
    output_dir : str or Path
        Folder to write to; created if it does not exist.
    force : bool, optional
        Whether to replace files that somebody changed since they were written.

    Raises
    ------
    InputError
        When somebody changed a file that would be replaced, or the folder cannot be written to,
        which is an OutputError.
    """
    output_dir = Path(output_dir).absolute()
    with folder_for(output_dir) as folder:
        page, curve = (folder / file for file in risk_files(name))
        write_blocks(risk_blocks(name, result), (page,))
        curve.write_bytes(risk_csv(result).encode())
        return put_unchanged((page, curve), output_dir, force=force)


def risk_csv(result: CaseRisk) -> str:
    """Return the curve as comma-separated values, units in the header.

    The share of hits is that which exceeds the reaction; shear and moment are those, the largest
    anywhere, that are exceeded as often.
    """
    system, found = result.case.inputs.units, result.risk
    x = reactions(found, _ROWS)
    rate, hard = yearly(found.reaction.rate(x)), yearly(found.hard_impact.rate(x))
    total = float(result.hits.value) or 1.0
    force, moment = (unit_of(quantity, system) for quantity in ("force", "moment"))
    of_shear, of_moment = (
        _as_often(result, name, found.reaction.rate(x)) / unit_size(quantity, system)
        for name, quantity in (("shear", "force"), ("moment", "moment"))
    )
    heads = (
        *(f"reaction [{force}]", "frequency [1/year]", "frequency, low", "frequency, high"),
        *("share of hits", "frequency of v √(k m) [1/year]"),
        *(f"shear [{force}]", f"moment [{moment}]"),
    )
    values = (
        *(x / unit_size("force", system), *rate, rate.value / total, hard.value),
        *(of_shear, of_moment),
    )
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(heads)
    writer.writerows(
        ["" if np.isnan(cell) else f"{cell:.5g}" for cell in row] for row in np.transpose(values)
    )
    return text.getvalue()


def _as_often(result: CaseRisk, name: str, rates: Estimate) -> Array:
    """Return the "shear" or "moment" that is exceeded at these rates, nan where nothing is."""
    effect = result.effects[name]
    return np.array(
        [effect.value(rate).value if rate > 0.0 else np.nan for rate in rates.value.tolist()]
    )


def risk_blocks(name: str, result: CaseRisk) -> list[Block]:
    """Return the page of the risk of a case, as blocks of a sheet."""
    inputs = result.case.inputs
    first = list(lines(result))
    return [
        TitleBlock(
            title="Risk from truck collisions",
            subtitle=f"{name}: how often the pier is struck, and how hard",
            entries={
                "Project": inputs.project,
                "Element": inputs.element,
                "Job number": inputs.job_number,
                "Revision": inputs.revision,
                "Date": inputs.date.isoformat(),
            },
            date=inputs.date.isoformat(),
            paper="a4" if inputs.units == "SI" else "us-letter",
        ),
        Headline(results=[_headline(line.label, line.value, line.remark) for line in first]),
        Paragraph(_unbroken(statement(result))),
        Notice(heading="Before you rely on this", body=result.warnings),
        _exceedance(result),
        _frequencies(result),
        _feared(result),
        Paragraph(_METHOD),
        Paragraph(heights_text(result)),
        _inputs(result),
        _laws(result),
        _trucks(result),
        Paragraph(
            (
                f"{drawn(result)}; the same seed gives the same trucks for any pier and any "
                "number of workers. The curve is in ",
                Code(f"{name}-risk.csv"),
                f". Made by pierimpact {pierimpact.__version__}.",
            )
        ),
    ]


def _headline(label: str, value: str, remark: str) -> tuple[str, Printed, str]:
    """Return a result in large type, its band with the remark."""
    number, bracket, rest = value.partition(" (")
    figure, _, unit = number.rpartition(" ") if number[:1].isdigit() else (number, "", "")
    if number.endswith(" a year"):
        figure, unit = number.removesuffix(" a year"), "a year"
    band = f"{bracket}{rest}".strip()
    shown = Printed(_unbroken(figure), unit)
    return label, shown, _unbroken(f"{band} {remark}".strip())


def _unbroken(text: str) -> str:
    """Return a text whose powers of ten no line ends in."""
    return re.sub("×10(?=[⁻⁰¹²³⁴⁵⁶⁷⁸⁹])", "×\u206010\u2060", text)


def _exceedance(result: CaseRisk) -> Block:
    marks = {f"{check.name} resistance": check.reaction for check in result.checks}
    marks["design reaction"] = result.calculation.design_force
    levels = {"TxDOT 0.001": TXDOT, "1 in 10 000 years": RATES[1]}
    shares = "; ".join(
        f"{words} exceeded in {share_text(result, result.risk.reaction.rate(value))} of all hits"
        for words, value in marks.items()
    )
    return Figure(
        label="fig-exceedance",
        caption="How often a reaction is exceeded, with the 95 % band of the number of trucks "
        "drawn; and fragility, the share of hits in which a resistance of that reaction is "
        "exceeded. A resistance to shear or moment stands at the reaction that is exceeded as "
        f"often. From the same trucks the formula of JCSS. {shares[:1].upper()}{shares[1:]}.",
        alt=f"Frequency of exceedance against reaction on a logarithmic axis. {statement(result)}",
        svg=draw_exceedance(result.risk, marks, levels, result.case.inputs.units),
    )


def _frequencies(result: CaseRisk) -> Block:
    system, found = result.case.inputs.units, result.risk
    rows: list[list[Inline]] = []
    for rate in _FREQUENCIES:
        value, simple = (of.value(rate / YEAR) for of in (found.reaction, found.hard_impact))
        effects = [
            printed(most, quantity, system).number if most else "—"
            for name, quantity in (("shear", "force"), ("moment", "moment"))
            for most in [float(result.effects[name].value(rate / YEAR).value)]
        ]
        rows.append(
            [
                _unbroken(rounded(rate, 1)),
                f"{1.0 / rate:,.0f}".replace(",", "\u202f"),
                value_text(value, "force", system),
                *effects,
                value_text(simple, "force", system),
            ]
        )
    force, moment = unit_of("force", system), unit_of("moment", system)
    return Table(
        label="tab-frequencies",
        caption="Reactions by how often they are exceeded, with the band; the shear and moment, "
        "the largest anywhere, that are exceeded as often; and the force of JCSS.",
        columns=columns(
            "Times a year",
            decimal("Once in [years]"),
            wide("Reaction"),
            decimal(f"Shear [{force}]"),
            decimal(f"Moment [{moment}]"),
            wide(Tex(r"v \sqrt{k m}")),
        ),
        rows=rows,
    )


def _feared(result: CaseRisk) -> Block:
    level = result.force(result.level)
    words = next((line for line in lines(result) if line.label.startswith("Truck that")), None)
    which = f"{words.value}: {words.remark}" if words else "none of the trucks drawn"
    return Figure(
        label="fig-feared",
        caption=f"Which trucks the pier fears: those that bring about more than {level}, by mass "
        f"and speed at the pier. {which[:1].upper()}{which[1:]}.",
        alt=f"Map of mass and speed of the trucks above {level}, beside all that strike. {which}.",
        svg=draw_feared(result.risk, result.level, result.case.inputs.units),
    )


_METHOD: Inline = (
    *("The model of JCSS, Part 2, 2.18, read in a public copy: a reaction above ", Tex("X")),
    *(" is expected ", Tex(r"n \lambda \Delta x\, P[R(v_\mathrm{r}, m, \ldots) > X]")),
    *(" times in a time, with ", Tex("n"), " trucks in it, "),
    *(Tex(r"\Delta x = b_\mathrm{e} / \sin \mu(\alpha)"), " and "),
    *(Tex(r"v_\mathrm{r}^2 = v_0^2 - 2 a d / \sin \alpha"), " on arrival. The reaction "),
    *(Tex("R"), " is the governing peak of the full model in place of "),
    *(Tex(r"v_\mathrm{r} \sqrt{k m}"), "; springs and engine of each truck are drawn from their "),
    "spread, and body and cargo have what the mass leaves. Each mass goes with the truck whose ",
    "range of masses it is in or next to; that is this project’s choice.",
)


def _inputs(result: CaseRisk) -> Block:
    traffic, inputs, system = result.traffic.traffic, result.case.inputs, result.case.inputs.units
    defaults = {"exposed_width": traffic.width, "encroachment_rate": traffic.encroachment_rate}
    keys = ("traffic_volume", "truck_share", "distance_from_road", *defaults)
    rows: list[list[Inline]] = []
    for key in keys:
        value, symbol = getattr(inputs, key), BY_KEY[key]
        origin = inputs.sources.get(key, "case file")
        if key in inputs.assumed:
            origin = f"assumed: {inputs.assumed[key]}"
        if value is None:
            value, origin = defaults[key], "default; JCSS, read in a public copy"
        shown = str(printed(value, symbol.quantity, system, given=True))
        rows.append([symbol.heading, Tex(symbol.latex), shown, origin])
    rows.append(
        [
            "Trucks that leave the road toward the pier",
            Tex(r"n \lambda \Delta x"),
            f"{rounded(YEAR * traffic.departures, 4)} a year",
            "from these",
        ]
    )
    return Table(
        label="tab-traffic",
        caption="The traffic.",
        columns=columns(wide("Value"), "", "", wide("From")),
        rows=rows,
    )


def _laws(result: CaseRisk) -> Block:
    return Table(
        label="tab-laws",
        caption="What differs from truck to truck.",
        columns=columns("Value", wide("Law"), wide("Status")),
        rows=[list(line) for line in laws(result.traffic.traffic)],
    )


def _trucks(result: CaseRisk) -> Block:
    return Table(
        label="tab-trucks",
        caption="The trucks, and the masses of the traffic that go with each.",
        columns=columns("Truck", wide("Masses drawn"), wide("Springs stand for"), "Status"),
        rows=list(_truck_rows(result)),
    )


def _truck_rows(result: CaseRisk) -> Iterator[list[Inline]]:
    strikes = result.risk.strikes
    size, unit = large_mass(result.case.inputs.units)
    for number, file in enumerate(result.traffic.truck_files):
        mass = strikes.mass[strikes.truck == number]
        if len(mass):
            ends = file.truck.mass_range or (file.truck.mass, file.truck.mass)
            drawn, stand = (
                f"{rounded(low / size, 3)} to {rounded(high / size, 3)} {unit}"
                for low, high in ((mass.min(), mass.max()), ends)
            )
            yield [file.truck.name, drawn, stand, file.status.words]
