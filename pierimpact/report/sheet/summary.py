"""The first page: head, results, warnings and contents."""

import datetime

from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import (
    Block,
    Contents,
    Headline,
    Notice,
    Paragraph,
    TitleBlock,
)
from pierimpact.report.sheet.cautions import cautions
from pierimpact.units import Printed, printed, rounded


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
    system = calculation.case.inputs.units
    design, peak = calculation.design, calculation.governing_peak
    height = printed(calculation.struck.impact_height, "length", system, given=True)
    parts = f"engine {printed(design.engine, 'force', system)}"
    if design.cargo is not None:
        parts += f", cargo {printed(design.cargo, 'force', system)}"
    results = [
        (
            "Design reaction",
            printed(calculation.design_force, "force", system),
            f"static, at {height} above the base; by the {calculation.decisive}",
        ),
        ("Design procedure", printed(design.reaction, "force", system), parts),
        (
            "Full model",
            printed(peak.reaction, "force", system),
            f"{'engine' if peak == calculation.history.engine_peak else 'cargo'} peak; procedure "
            f"over model {rounded(calculation.ratio, 3)}",
        ),
        _demand(calculation, "shear"),
        _demand(calculation, "moment"),
        (
            "Pier frequency",
            printed(calculation.pier.frequency, "frequency", system),
            f"{printed(calculation.pier.stiffness, 'stiffness', system)}, "
            f"{printed(calculation.pier.mass, 'mass', system)}",
        ),
    ]
    return Headline(results=results)


def _demand(calculation: Calculation, name: str) -> tuple[str, Printed, str]:
    """Return the utilisation where there is a resistance, else the demand."""
    forces, quantity = calculation.member_forces, "force" if name == "shear" else "moment"
    largest = forces.largest_shear if name == "shear" else forces.largest_moment
    demand = printed(abs(largest.value), quantity, calculation.case.inputs.units)
    ratio = calculation.utilisations.get(name)
    if ratio is None:
        return f"Largest {name}", demand, "no resistance given"
    return f"Utilisation in {name}", Printed(rounded(ratio, 3), ""), f"{demand}: {verdict(ratio)}"


def verdict(ratio: float) -> str:
    """Say what a utilisation means."""
    return "within the resistance" if ratio <= 1.0 else "exceeds the resistance"


def governing_statement(calculation: Calculation) -> Block:
    """Say which contacts are made, which peak governs, and where the result is from."""
    history = calculation.history
    contacts = ""
    if history.cargo_contact_time is None:
        contacts = "The cargo does not reach the pier: there is no cargo peak. "
    if history.engine_contact_time is None:
        contacts += (
            "The engine does not reach the pier either: its"
            if contacts
            else "The engine does not reach the pier before the cargo does: its"
        )
        contacts += " peak is the pier’s response to the crumpling of the truck alone. "
    return Paragraph(
        f"{contacts}The {calculation.governs} peak governs. The design reaction is that of the "
        "design procedure, which can be followed by hand, or the peak of the full model if that "
        f"is larger; here it is that of the {calculation.decisive}. Member forces, utilisations "
        "and the comparison with codes are under this reaction as a static force."
    )


def warnings(calculation: Calculation) -> Block:
    """Return what a reader must know before relying on the results."""
    return Notice(heading="Before you rely on this", body=cautions(calculation))


def contents() -> Block:
    """Return the list of contents."""
    return Contents()
