"""The design reaction beside the equivalent static forces of codes."""

from itertools import chain

from pierimpact.design.codes import CodeForce, Sourced
from pierimpact.pier.member_forces import MemberForces
from pierimpact.plots.code_bars import draw_code_bars
from pierimpact.report.document.blocks import Block, Notes
from pierimpact.report.document.markup import Inline
from pierimpact.report.document.numbered import Figure, Table, columns, decimal, wide
from pierimpact.report.outcome import DEMANDS
from pierimpact.report.sheet.section import Section
from pierimpact.units import compared, converted, rounded

_UNKNOWN = "—"


class Codes(Section):
    """The comparison with codes.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(file.case)
    >>> code, force, height, *_ = sheet.codes.effects().rows[1]
    >>> code, force, height  # kN, m
    ('AASHTO LRFD', '2668.9', '1.5')
    """

    def bars(self) -> Block:
        """Return the forces of codes beside the averages of the contact force and the reaction."""
        result = self.calculation
        averages = {window: own.force for window, own in result.average_forces.items()}
        words = ", ".join(
            f"{self.shown(force, 'force')} over {self.shown(window, 'time', given=True)}"
            for window, force in averages.items()
        )
        band = result.reaction_band
        return Figure(
            label="fig-codes",
            lead="The forces of codes beside averages of the contact force, as tests report it; "
            "then what moves the reaction most.",
            caption="Forces of codes along the travel, the largest averages of the contact force, "
            "and the design reaction. That of AASHTO LRFD was taken from a 25 ms average. Hatched: "
            "neither read in the code nor cited by the source paper.",
            alt=f"Largest averages of the contact force: {words}. The reaction is "
            f"{self.shown(result.design_force, 'force')}.",
            svg=draw_code_bars(
                [effect.code for effect in result.code_effects],
                averages,
                result.design_force,
                None if band is None else (band[0], band[2]),
                self.system,
            ),
        )

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
                    _status(code) + self._as_given(code),
                ]
                for code, *_ in self.calculation.code_effects
            ],
        )

    def _sourced(self, value: Sourced | None, quantity: str) -> str:
        return _UNKNOWN if value is None else self.number(value.value, quantity, given=True)

    def _as_given(self, code: CodeForce) -> str:
        """Return what the code gives in other units than those of the sheet."""
        given = ((code.along, "force"), (code.across, "force"), (code.height, "length"))
        values = [converted(v.value, kind, self.system) for v, kind in given if v is not None]
        words = ", ".join(str(value) for value in values if value is not None)
        return f"; given as {words}" if words else ""

    def effects(self) -> Block:
        """Return base shear and largest moment under each force, and the design's over them."""
        result = self.calculation
        force, length, moment = (self.unit(kind) for kind in ("force", "length", "moment"))
        own = [
            self.number(result.design_force, "force"),
            self.number(result.struck.impact_height, "length", given=True),
        ]
        rows = [["This calculation, static", *own, *self._effects(result.member_forces)]]
        for code, height, forces in result.code_effects:
            mark = "" if code.height else "*"
            cells = [
                self.number(code.along.value, "force", given=True),
                self.number(height, "length", given=True) + mark,
            ]
            if forces is None:
                ratio = rounded(result.design_force / code.along.value, 3)
                rows.append([code.code, *cells, "at or above the top", "", ratio, "", ""])
            else:
                rows.append([code.code, *cells, *self._effects(forces)])
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

    def _effects(self, forces: MemberForces) -> list[str]:
        """Return base shear and largest moment, and this calculation over force, shear, moment."""
        own = self.calculation.member_forces
        shear, moment = abs(forces.base_force), abs(forces.largest_moment.value)
        return [
            self.number(shear, "force"),
            self.number(moment, "moment"),
            rounded(own.reaction / forces.reaction, 3),
            rounded(abs(own.base_force) / shear, 3) if shear else _UNKNOWN,
            rounded(abs(own.largest_moment.value) / moment, 3) if moment else _UNKNOWN,
        ]

    def utilisations(self) -> Block | None:
        """Return what each force alone comes to; None where the case gives no resistance."""
        result = self.calculation
        if not result.resistances:
            return None
        rows: list[list[Inline]] = []
        for code, _, forces in result.code_effects:
            used = {} if forces is None else result.utilisations_under(forces)
            cells = [
                (
                    self.number(abs(getattr(forces, f"largest_{name}").value), DEMANDS[name]),
                    compared(ratio),
                )
                for name, ratio in used.items()
            ]
            empty = [_UNKNOWN] * (2 * len(result.resistances))
            rows.append([code.code, *(chain(*cells) if cells else empty)])
        heads = [
            decimal(words)
            for name in result.resistances
            for words in (f"Largest {name} [{self.unit(DEMANDS[name])}]", "Utilisation")
        ]
        return Table(
            label="tab-code-utilisation",
            caption="What each of these forces alone comes to on this column, as a static force: "
            "the largest anywhere, and over the resistance"
            + (", of all parts the largest." if len(self.case.parts) > 1 else "."),
            columns=columns("Code", *heads),
            rows=rows,
        )

    def notes(self) -> Block:
        """Return what else is known of the clauses."""
        codes_by_note: dict[str, list[str]] = {}
        for code, *_ in self.calculation.code_effects:
            note = code.note
            if code.stiffness is not None:
                stiffness = self.stated(code.stiffness.value, "stiffness")
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
