"""The design reaction beside the equivalent static forces of codes."""

from pierimpact.design.codes import CodeForce, Sourced, code_forces
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Block, Notes
from pierimpact.report.document.markup import Inline
from pierimpact.report.document.numbered import Column, Table
from pierimpact.units import printed, rounded, unit_of

_UNKNOWN = "—"


def codes_table(calculation: Calculation) -> Block:
    """Return edition, clause, forces and height of each clause, and how sure they are."""
    system = calculation.case.inputs.units
    force, length = unit_of("force", system), unit_of("length", system)

    def shown(value: Sourced | None, quantity: str) -> str:
        if value is None:
            return _UNKNOWN
        return printed(value.value, quantity, system, given=True).number

    return Table(
        label="tab-codes",
        caption=f"Forces of codes along and across the travel, and the height at which they act "
        f"({_UNKNOWN}: not known here).",
        columns=[
            Column(heading="Code"),
            Column(heading="Edition"),
            Column(heading="Clause"),
            Column(heading=f"Along [{force}]", align="decimal"),
            Column(heading=f"Across [{force}]", align="decimal"),
            Column(heading=f"Height [{length}]", align="decimal"),
            Column(heading="Status", wide=True),
        ],
        rows=[
            [
                code.code,
                code.edition or _UNKNOWN,
                code.clause or _UNKNOWN,
                shown(code.along, "force"),
                shown(code.across, "force"),
                shown(code.height, "length"),
                _status(code),
            ]
            for code in _codes(calculation)
        ],
    )


def _codes(calculation: Calculation) -> tuple[CodeForce, ...]:
    return code_forces(calculation.case.inputs.speed, calculation.case.truck.mass)


def _status(code: CodeForce) -> str:
    """Return how sure the forces of a clause and their height are."""
    if code.height is None or code.height.remark == code.along.remark:
        return code.along.remark
    return f"force {code.along.remark}; height {code.height.remark}"


def effects_table(calculation: Calculation) -> Block:
    """Return base shear and largest moment under each force, and this calculation's over them."""
    system, used = calculation.case.inputs.units, calculation.struck.impact_height
    force, length, moment = (unit_of(kind, system) for kind in ("force", "length", "moment"))
    rows: list[list[Inline]] = [_effects(calculation, calculation.design_force, used, "")]
    rows[0][:2] = ["This calculation", printed(calculation.design_force, "force", system).number]
    for code in _codes(calculation):
        height, mark = (code.height.value, "") if code.height else (used, "*")
        row = _effects(calculation, code.along.value, height, mark)
        rows.append([code.code, *row[1:]])
    return Table(
        label="tab-effects",
        caption="The forces along the travel on this column, each at its own height or, marked *, "
        "at that of this calculation: base shear, largest moment, and this calculation over each.",
        columns=[
            Column(heading="Code", wide=True),
            Column(heading=f"Force [{force}]", align="decimal"),
            Column(heading=f"Height [{length}]", align="decimal"),
            Column(heading=f"Shear [{force}]", align="decimal"),
            Column(heading=f"Moment [{moment}]", align="decimal"),
            Column(heading="Ratio of force", align="decimal"),
            Column(heading="of shear", align="decimal"),
            Column(heading="of moment", align="decimal"),
        ],
        rows=rows,
        strong=[0],
    )


def _effects(calculation: Calculation, force: float, height: float, mark: str) -> list[Inline]:
    """Return the row of a force, its first cell empty."""
    system, own = calculation.case.inputs.units, calculation.member_forces
    shown = printed(height, "length", system, given=True).number + mark
    cells: list[Inline] = ["", printed(force, "force", system, given=True).number, shown]
    ratio = rounded(calculation.design_force / force, 3)
    if height >= calculation.case.column.height:
        return [*cells, "above the column", "", ratio, "", ""]
    forces = calculation.case.column.struck_at(height).member_forces(force)
    shear, moment = abs(forces.base_force), abs(forces.largest_moment.value)
    return [
        *cells,
        printed(shear, "force", system).number,
        printed(moment, "moment", system).number,
        ratio,
        rounded(abs(own.base_force) / shear, 3) if shear else _UNKNOWN,
        rounded(abs(own.largest_moment.value) / moment, 3),
    ]


def codes_notes(calculation: Calculation) -> Block:
    """Return what else is known of the clauses."""
    system = calculation.case.inputs.units
    codes_by_note: dict[str, list[str]] = {}
    for code in _codes(calculation):
        note = code.note
        if code.stiffness is not None:
            stiffness = printed(code.stiffness.value, "stiffness", system, given=True)
            note += f" k = {stiffness} ({code.stiffness.remark}), speed and mass are the case’s."
        if note:
            codes_by_note.setdefault(note, []).append(code.code)
    return Notes([f"{'; '.join(codes)}: {note}" for note, codes in codes_by_note.items()])
