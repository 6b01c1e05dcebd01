"""Member forces under the design reaction, their diagrams, and utilisations."""

from pierimpact.plots.figures import draw_member_forces
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Inline, Tex
from pierimpact.report.document.numbered import Column, Figure, Table
from pierimpact.report.sheet.summary import verdict
from pierimpact.units import printed, rounded


def member_forces_table(calculation: Calculation) -> Block:
    """Return support forces and extreme member forces under the design reaction."""
    system, forces = calculation.case.inputs.units, calculation.member_forces
    shear, moment = forces.largest_shear, forces.largest_moment
    values = [
        ("Force on the base", r"R \, R_\mathrm{b}", forces.base_force, "force"),
        ("Force on the top", r"R \, R_\mathrm{t}", forces.top_force, "force"),
        ("Moment at the base", r"R \, M_\mathrm{b}", forces.base_moment, "moment"),
        ("Moment at the impact", r"R \, M_\mathrm{n}", forces.impact_moment, "moment"),
        ("Moment at the top", r"R \, M_\mathrm{t}", forces.top_moment, "moment"),
        ("Largest shear", r"V_\mathrm{max}", abs(shear.value), "force"),
        ("Largest moment", r"M_\mathrm{max}", abs(moment.value), "moment"),
    ]
    rows: list[list[Inline]] = []
    for name, symbol, value, quantity in values:
        shown = printed(value, quantity, system)
        rows.append([name, Tex(symbol), shown.number, shown.unit])
    return Table(
        label="tab-members",
        caption="Member forces under the design reaction as a static force at the impact.",
        columns=[
            Column(heading="Force"),
            Column(heading="Symbol"),
            Column(heading="Value", align="decimal"),
            Column(heading="Unit"),
        ],
        rows=rows,
        strong=[5, 6],
    )


def member_forces_figure(calculation: Calculation) -> Block:
    """Return the diagrams of shear and moment."""
    system, forces = calculation.case.inputs.units, calculation.member_forces
    height = printed(forces.impact_height, "length", system, given=True)
    shear = printed(forces.largest_shear.value, "force", system)
    moment = printed(forces.largest_moment.value, "moment", system)
    return Figure(
        label="fig-members",
        caption="Shear and moment under the design reaction; moment positive where the far face "
        "is in tension.",
        alt=f"The column with the design reaction at {height}, and its diagrams. The largest "
        f"shear is {shear}, the largest moment {moment}.",
        svg=draw_member_forces(forces, system),
    )


def utilisation_table(calculation: Calculation) -> Block:
    """Return demand, resistance, utilisation and verdict of shear and moment."""
    inputs, forces = calculation.case.inputs, calculation.member_forces
    if not calculation.utilisations:
        return Paragraph("The case gives no resistance: utilisations are not calculated.")
    rows: list[list[Inline]] = []
    for name, demand, resistance, quantity in (
        ("Shear", forces.largest_shear.value, inputs.shear_resistance, "force"),
        ("Moment", forces.largest_moment.value, inputs.moment_resistance, "moment"),
    ):
        ratio = calculation.utilisations.get(name.lower())
        shown = printed(abs(demand), quantity, inputs.units)
        if ratio is None or resistance is None:
            rows.append([name, shown.number, "not given", shown.unit, "", "not checked"])
            continue
        limit = printed(resistance, quantity, inputs.units, given=True).number
        rows.append([name, shown.number, limit, shown.unit, rounded(ratio, 3), verdict(ratio)])
    return Table(
        label="tab-utilisation",
        caption=(
            "Utilisation: the largest member force, ",
            Tex(r"V_\mathrm{max}"),
            " or ",
            Tex(r"M_\mathrm{max}"),
            ", over its resistance, ",
            Tex(r"V_\mathrm{R}"),
            " or ",
            Tex(r"M_\mathrm{R}"),
            ".",
        ),
        columns=[
            Column(heading="Check"),
            Column(heading="Largest force", align="decimal"),
            Column(heading="Resistance", align="decimal"),
            Column(heading="Unit"),
            Column(heading="Utilisation", align="decimal"),
            Column(heading="Verdict", wide=True),
        ],
        rows=rows,
    )
