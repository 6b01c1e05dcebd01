"""What the calculation sheet of a case says: one function a piece."""

import datetime

import pierimpact
from pierimpact.calculation import MUCH_SMALLER, Calculation
from pierimpact.casefile import HIGH_IMPACT_HEIGHT, LOW_IMPACT_HEIGHT
from pierimpact.figures import draw_history
from pierimpact.sheet.blocks import (
    Block,
    Column,
    Figure,
    Headline,
    Notice,
    Paragraph,
    Table,
    TitleBlock,
)
from pierimpact.sheet.input_tables import STATUS_WORDS, name_of
from pierimpact.sheet.markup import Code, Inline, Tex
from pierimpact.units import Printed, printed, rounded, unit_of


def title_block(calculation: Calculation) -> Block:
    """Return the head of the sheet; where the case gives no date, it is today's."""
    inputs = calculation.case.inputs
    date = (inputs.date or datetime.date.today()).isoformat()
    return TitleBlock(
        title="Truck collision with a bridge pier",
        subtitle="Calculation sheet. Coupled mass-spring-damper (CMSD) model of the collision",
        entries={
            "Project": inputs.project,
            "Element": inputs.element,
            "Job number": inputs.job_number,
            "Revision": inputs.revision,
            "Prepared by": inputs.prepared_by,
            "Checked by": inputs.checked_by,
            "Date": date,
        },
        date=date,
        paper="a4" if inputs.units == "SI" else "us-letter",
    )


def summary(calculation: Calculation) -> Block:
    """Return the results in large type."""
    history = calculation.history
    engine, cargo = history.engine_peak, history.cargo_peak
    system = calculation.case.inputs.units
    height = printed(calculation.struck.impact_height, "length", system, given=True)
    results = [
        (
            "Governing reaction",
            printed(history.governing_peak.reaction, "force", system),
            f"static, at {height} above the base",
        ),
        (
            "Engine peak",
            printed(engine.reaction, "force", system),
            f"after {printed(engine.time, 'time', system)}",
        ),
        (
            "Cargo peak",
            printed(cargo.reaction, "force", system) if cargo else Printed("none", ""),
            f"after {printed(cargo.time, 'time', system)}" if cargo else "no cargo contact",
        ),
    ]
    results += [
        (f"Utilisation in {name}", Printed(rounded(ratio, 3), ""), _verdict(ratio))
        for name, ratio in calculation.utilisations.items()
    ]
    return Headline(results=results)


def governing_statement(calculation: Calculation) -> Block:
    """Say which peak governs, and which contacts were made."""
    history = calculation.history
    if history.cargo_contact_time is None:
        cargo = "The cargo does not reach the pier: there is no cargo peak. "
    else:
        cargo = ""
    if history.engine_contact_time is None:
        engine = (
            "The engine does not reach the pier either: the"
            if cargo
            else "The engine does not reach the pier before the cargo does: the engine"
        )
        engine += " peak is the pier’s response to the crumpling of the truck alone. "
    else:
        engine = ""
    governs = "cargo" if history.governing_peak == history.cargo_peak else "engine"
    return Paragraph(f"{cargo}{engine}The {governs} peak governs.")


def warnings(calculation: Calculation) -> Block:
    """Return what a reader must know before relying on the results."""
    case = calculation.case
    body: list[Inline] = []
    status = case.truck_file.status
    if status != "read":
        body.append(
            f"The truck {case.truck.name} is {STATUS_WORDS[status]} ({case.truck_file.source}). "
            "The results are no better than its parameters."
        )
    if case.inputs.assumed:
        names = ", ".join(name_of(key) for key in case.inputs.assumed)
        body.append(f"Assumed, not given by any source: {names}.")
    body += case.inputs.notes
    return Notice(heading="Before you rely on this", body=body)


def impact_height(calculation: Calculation) -> Block:
    """Say which nominal impact height is used, and why."""
    system = calculation.case.inputs.units
    low, high, used = (
        str(printed(height, "length", system, given=True))
        for height in (LOW_IMPACT_HEIGHT, HIGH_IMPACT_HEIGHT, calculation.struck.impact_height)
    )
    symbol = Tex(r"z_\mathrm{n}")
    if calculation.trial is None:
        return Paragraph(("The nominal impact height ", symbol, f" = {used} is given by the case."))
    trial = calculation.trial
    engine = printed(trial.engine_peak.reaction, "force", system)
    found = f"A trial at {low} gives an engine peak of {engine} and no cargo peak"
    if trial.cargo_peak is not None:
        cargo = printed(trial.cargo_peak.reaction, "force", system)
        ratio = rounded(trial.cargo_peak.reaction / trial.engine_peak.reaction, 3)
        found = (
            f"A trial at {low} gives an engine peak of {engine} and a cargo peak of {cargo}, "
            f"{ratio} of it"
        )
    return Paragraph(
        (
            f"The case leaves the nominal impact height to the rule of the source paper: {low} "
            f"without cargo peak or with a much smaller one, else {high}. Much smaller is taken as "
            f"below {MUCH_SMALLER:g} of the engine peak, which is this project’s figure. {found}: ",
            symbol,
            f" = {used}.",
        )
    )


def history_figure(calculation: Calculation) -> Block:
    """Return reaction and contact force against time."""
    history, system = calculation.history, calculation.case.inputs.units
    cargo = history.cargo_peak
    engine_words = f"{printed(history.engine_peak.reaction, 'force', system)} after "
    engine_words += str(printed(history.engine_peak.time, "time", system))
    cargo_words = "; there is no cargo peak"
    if cargo is not None:
        cargo_words = f", the cargo peak {printed(cargo.reaction, 'force', system)} after "
        cargo_words += str(printed(cargo.time, "time", system))
    return Figure(
        label="fig-history",
        caption=(
            "Reaction ",
            Tex(r"R = k_\mathrm{p} x_\mathrm{p}"),
            " (thick) and contact force between truck and pier (thin) against time.",
        ),
        alt=f"Reaction against time. The engine peak is {engine_words}{cargo_words}.",
        svg=draw_history(history, system),
    )


def peaks_table(calculation: Calculation) -> Block:
    """Return contact times and peaks of engine and cargo, and which governs."""
    history, system = calculation.history, calculation.case.inputs.units
    peaks = (
        ("Engine", history.engine_contact_time, history.engine_peak),
        ("Cargo", history.cargo_contact_time, history.cargo_peak),
    )
    rows: list[list[Inline]] = []
    for name, contact, peak in peaks:
        governs = peak is not None and peak == history.governing_peak
        rows.append(
            [
                name,
                "none" if contact is None else printed(contact, "time", system).number,
                "none" if peak is None else printed(peak.reaction, "force", system).number,
                "" if peak is None else printed(peak.time, "time", system).number,
                "governs" if governs else "",
            ]
        )
    time, force = unit_of("time", system), unit_of("force", system)
    return Table(
        label="tab-peaks",
        caption="Contacts and peak reactions.",
        columns=[
            Column(heading=""),
            Column(heading=f"Contact after [{time}]", align="decimal"),
            Column(heading=f"Peak reaction [{force}]", align="decimal"),
            Column(heading=f"Peak after [{time}]", align="decimal"),
            Column(heading=""),
        ],
        rows=rows,
        strong=[1 if history.governing_peak == history.cargo_peak else 0],
    )


def member_forces_table(calculation: Calculation) -> Block:
    """Return support forces and extreme member forces under the governing reaction."""
    system, forces = calculation.case.inputs.units, calculation.member_forces
    resistances = calculation.utilisations
    shear, moment = forces.largest_shear, forces.largest_moment
    values = [
        ("Force on the base", r"R \cdot R_\mathrm{b}", forces.base_force, "force", ""),
        ("Force on the top", r"R \cdot R_\mathrm{t}", forces.top_force, "force", ""),
        ("Moment at the base", r"R \cdot M_\mathrm{b}", forces.base_moment, "moment", ""),
        ("Moment at the impact", r"R \cdot M_\mathrm{n}", forces.impact_moment, "moment", ""),
        ("Moment at the top", r"R \cdot M_\mathrm{t}", forces.top_moment, "moment", ""),
        ("Largest shear", r"V_\mathrm{max}", abs(shear.value), "force", "shear"),
        ("Largest moment", r"M_\mathrm{max}", abs(moment.value), "moment", "moment"),
    ]
    rows: list[list[Inline]] = []
    for name, symbol, value, quantity, check in values:
        shown = printed(value, quantity, system)
        verdict = "no resistance given" if check else ""
        if check in resistances:
            ratio = resistances[check]
            verdict = f"{rounded(ratio, 3)} of the resistance: {_verdict(ratio)}"
        rows.append([name, Tex(symbol), shown.number, shown.unit, verdict])
    return Table(
        label="tab-members",
        caption="Member forces under the governing reaction as a static force at the impact.",
        columns=[
            Column(heading="Force"),
            Column(heading="Symbol"),
            Column(heading="Value", align="decimal"),
            Column(heading="Unit"),
            Column(heading="Utilisation", wide=True),
        ],
        rows=rows,
        strong=[5, 6],
    )


def _verdict(ratio: float) -> str:
    return "within the resistance" if ratio <= 1.0 else "exceeds the resistance"


def provenance_table(
    calculation: Calculation, case_file: str | None, case_sha256: str | None
) -> Block:
    """Return what this sheet was made from and how to make it again.

    Parameters
    ----------
    calculation : Calculation
        The calculation.
    case_file, case_sha256 : str or None
        Name and SHA-256 of the case file, where it is known.
    """
    truck_file, history = calculation.case.truck_file, calculation.history
    rows: list[list[Inline]] = [["Software", f"pierimpact {pierimpact.__version__}"]]
    if case_file and case_sha256:
        rows += [
            ["Case file", Code(case_file)],
            ["its SHA-256", Code(case_sha256)],
            ["To repeat", Code(f"pierimpact report {case_file}")],
        ]
    else:
        rows.append(["Case file", "not recorded: the parameters were set in the notebook"])
    rows += [
        ["Truck file", (Code(truck_file.file_name), f", {STATUS_WORDS[truck_file.status]}")],
        ["its SHA-256", Code(truck_file.sha256)],
        ["Energy balance", _error_words(history.energy_error, "the truck’s initial energy")],
        ["Momentum balance", _error_words(history.momentum_error, "the truck’s initial momentum")],
    ]
    return Table(
        label="tab-provenance",
        caption="What this sheet was made from.",
        columns=[Column(heading="Item"), Column(heading="Value", wide=True)],
        rows=rows,
    )


def _error_words(error: float, whole: str) -> str:
    return f"closes to {rounded(error, 1)} of {whole}, at all times"
