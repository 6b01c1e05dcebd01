"""The design reaction beside the equivalent static forces of codes."""

from functools import cached_property

from pierimpact.design.codes import CodeForce, Sourced, code_forces
from pierimpact.report.document.blocks import Block, Notes
from pierimpact.report.document.markup import Inline
from pierimpact.report.document.numbered import Table, columns, decimal, wide
from pierimpact.report.sheet.section import Section
from pierimpact.units import rounded

_UNKNOWN = "—"


class Codes(Section):
    """The comparison with codes."""

    @cached_property
    def _codes(self) -> tuple[CodeForce, ...]:
        return code_forces(self.case.inputs.speed, self.case.truck.mass)

    def forces(self) -> Block:
        """Return edition, clause, forces and height of each clause, and how sure they are."""
        force, length = self.unit("force"), self.unit("length")
        return Table(
            label="tab-codes",
            caption="Forces of codes along and across the travel, and the height at which they act "
            f"({_UNKNOWN}: not known here).",
            columns=columns(
                "Code",
                "Edition",
                "Clause",
                decimal(f"Along [{force}]"),
                decimal(f"Across [{force}]"),
                decimal(f"Height [{length}]"),
                wide("Status"),
            ),
            rows=[
                [
                    code.code,
                    code.edition or _UNKNOWN,
                    code.clause or _UNKNOWN,
                    self._sourced(code.along, "force"),
                    self._sourced(code.across, "force"),
                    self._sourced(code.height, "length"),
                    _status(code),
                ]
                for code in self._codes
            ],
        )

    def _sourced(self, value: Sourced | None, quantity: str) -> str:
        return _UNKNOWN if value is None else self.number(value.value, quantity, given=True)

    def effects(self) -> Block:
        """Return base shear and largest moment under each force, and the design's over them."""
        used, own = self.calculation.struck.impact_height, self.calculation.design_force
        force, length, moment = (self.unit(kind) for kind in ("force", "length", "moment"))
        this, _, *effects = self._effects("This calculation", own, used, "")
        rows = [[this, self.number(own, "force"), *effects]]
        for code in self._codes:
            height, mark = (code.height.value, "") if code.height else (used, "*")
            rows.append(self._effects(code.code, code.along.value, height, mark))
        return Table(
            label="tab-effects",
            caption="The forces along the travel on this column, each at its own height or, marked "
            "*, at that of this calculation: base shear, largest moment, and this calculation over "
            "each.",
            columns=columns(
                wide("Code"),
                decimal(f"Force [{force}]"),
                decimal(f"Height [{length}]"),
                decimal(f"Shear [{force}]"),
                decimal(f"Moment [{moment}]"),
                decimal("Ratio of force"),
                decimal("of shear"),
                decimal("of moment"),
            ),
            rows=rows,
            strong=[0],
        )

    def _effects(self, name: str, force: float, height: float, mark: str) -> list[Inline]:
        """Return the row of a force."""
        own, column = self.calculation.member_forces, self.case.column
        cells: list[Inline] = [
            name,
            self.number(force, "force", given=True),
            self.number(height, "length", given=True) + mark,
        ]
        ratio = rounded(self.calculation.design_force / force, 3)
        if height >= column.height:
            return [*cells, "above the column", "", ratio, "", ""]
        forces = column.struck_at(height).member_forces(force)
        shear, moment = abs(forces.base_force), abs(forces.largest_moment.value)
        return [
            *cells,
            self.number(shear, "force"),
            self.number(moment, "moment"),
            ratio,
            rounded(abs(own.base_force) / shear, 3) if shear else _UNKNOWN,
            rounded(abs(own.largest_moment.value) / moment, 3),
        ]

    def notes(self) -> Block:
        """Return what else is known of the clauses."""
        codes_by_note: dict[str, list[str]] = {}
        for code in self._codes:
            note = code.note
            if code.stiffness is not None:
                stiffness = self.shown(code.stiffness.value, "stiffness", given=True)
                note += (
                    f" k = {stiffness} ({code.stiffness.remark}), speed and mass are the case’s."
                )
            if note:
                codes_by_note.setdefault(note, []).append(code.code)
        return Notes([f"{'; '.join(codes)}: {note}" for note, codes in codes_by_note.items()])


def _status(code: CodeForce) -> str:
    """Return how sure the forces of a clause and their height are."""
    if code.height is None or code.height.remark == code.along.remark:
        return code.along.remark
    return f"force {code.along.remark}; height {code.height.remark}"
