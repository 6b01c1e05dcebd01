"""The design reaction beside the equivalent static forces of codes."""

from pierimpact.calculation import Calculation
from pierimpact.codes import CodeForce, code_forces
from pierimpact.sheet.blocks import Block, Notes
from pierimpact.sheet.markup import Inline
from pierimpact.sheet.numbered import Column, Table
from pierimpact.units import printed, unit_of


def codes_table(calculation: Calculation) -> Block:
    """Return force, height, base shear and largest moment of each clause, and how sure it is."""
    inputs = calculation.case.inputs
    system = inputs.units
    used = calculation.struck.impact_height
    force, length, moment = (unit_of(kind, system) for kind in ("force", "length", "moment"))
    rows: list[list[Inline]] = [
        [
            "This calculation",
            printed(calculation.design_force, "force", system).number,
            printed(used, "length", system, given=True).number,
            *_effects(calculation, calculation.design_force, used),
            "",
        ],
        *(_code_row(calculation, code) for code in _codes(calculation)),
    ]
    return Table(
        label="tab-codes",
        caption="Forces of codes along the direction of travel, each at its own height or, marked "
        "*, at that of this calculation where the code’s is not known here.",
        columns=[
            Column(heading="Code", wide=True),
            Column(heading=f"Force [{force}]", align="decimal"),
            Column(heading=f"Height [{length}]", align="decimal"),
            Column(heading=f"Base shear [{force}]", align="decimal"),
            Column(heading=f"Largest moment [{moment}]", align="decimal"),
            Column(heading="Status", wide=True),
        ],
        rows=rows,
        strong=[0],
    )


def _codes(calculation: Calculation) -> tuple[CodeForce, ...]:
    return code_forces(calculation.case.inputs.speed, calculation.case.truck.mass)


def _code_row(calculation: Calculation, code: CodeForce) -> list[Inline]:
    system, used = calculation.case.inputs.units, calculation.struck.impact_height
    height = code.height.value if code.height else used
    shown = printed(height, "length", system, given=True).number
    status = f"force {code.along.remark}"
    if code.height is not None and code.height.remark != code.along.remark:
        status += f"; height {code.height.remark}"
    elif code.height is not None:
        status = code.along.remark
    return [
        f"{code.code}, {code.clause}",
        printed(code.along.value, "force", system).number,
        shown if code.height else f"{shown}*",
        *_effects(calculation, code.along.value, height),
        status,
    ]


def _effects(calculation: Calculation, force: float, height: float) -> list[str]:
    """Return base shear and largest moment of a force at a height, for print."""
    if height >= calculation.case.column.height:
        return ["above the column", ""]
    system = calculation.case.inputs.units
    forces = calculation.case.column.struck_at(height).member_forces(force)
    return [
        printed(abs(forces.base_force), "force", system).number,
        printed(abs(forces.largest_moment.value), "moment", system).number,
    ]


def codes_notes(calculation: Calculation) -> Block:
    """Return what else is known of the clauses."""
    system = calculation.case.inputs.units
    notes: list[Inline] = []
    for code in _codes(calculation):
        text = f"{code.code}, {code.clause}: {code.note}".rstrip(": ")
        if code.across is not None:
            across = printed(code.across.value, "force", system)
            text += f" Across the travel {across} ({code.across.remark})."
        if code.note or code.across is not None:
            notes.append(text)
    return Notes(notes)
