"""Member forces under the design reaction, their diagrams, and utilisations."""

from pierimpact.plots.figures import draw_member_forces
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Inline, Tex
from pierimpact.report.document.numbered import Figure, Table, columns, decimal, wide
from pierimpact.report.sheet.section import Section
from pierimpact.report.sheet.summary import verdict
from pierimpact.symbols import SYMBOLS
from pierimpact.units import rounded


class MemberForcesUnderReaction(Section):
    """The design reaction as a static force."""

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the member forces, by name."""
        return {"V_max": "tab-members", "M_max": "tab-members"}

    def table(self) -> Block:
        """Return support forces and extreme member forces under the design reaction."""
        forces = self.calculation.member_forces
        values = [
            (
                "Support force at the base",
                r"R_\mathrm{d} \, R_\mathrm{b}",
                forces.base_force,
                "force",
            ),
            (
                "Support force at the top",
                r"R_\mathrm{d} \, R_\mathrm{t}",
                forces.top_force,
                "force",
            ),
            ("Moment at the base", r"R_\mathrm{d} \, M_\mathrm{b}", forces.base_moment, "moment"),
            (
                "Moment at the impact",
                r"R_\mathrm{d} \, M_\mathrm{n}",
                forces.impact_moment,
                "moment",
            ),
            ("Moment at the top", r"R_\mathrm{d} \, M_\mathrm{t}", forces.top_moment, "moment"),
            ("Largest shear", SYMBOLS["V_max"].latex, abs(forces.largest_shear.value), "force"),
            ("Largest moment", SYMBOLS["M_max"].latex, abs(forces.largest_moment.value), "moment"),
        ]
        return Table(
            label="tab-members",
            caption="Member forces under the design reaction as a static force at the impact.",
            columns=columns("Quantity", "Symbol", decimal("Value"), "Unit"),
            rows=[
                [name, Tex(symbol), *self.shown(value, quantity)]
                for name, symbol, value, quantity in values
            ],
            strong=[5, 6],
        )

    def diagrams(self) -> Block:
        """Return the diagrams of shear and moment."""
        forces = self.calculation.member_forces
        height = self.shown(forces.impact_height, "length", given=True)
        shear = self.shown(forces.largest_shear.value, "force")
        moment = self.shown(forces.largest_moment.value, "moment")
        return Figure(
            label="fig-members",
            caption="Shear and moment under the design reaction; moment positive where the far "
            "face is in tension.",
            alt=f"The column with the design reaction at {height}, and its diagrams. The largest "
            f"shear is {shear}, the largest moment {moment}.",
            svg=draw_member_forces(forces, self.system),
        )

    def utilisation(self) -> Block:
        """Return demand, resistance, utilisation and verdict of shear and moment."""
        inputs, forces = self.case.inputs, self.calculation.member_forces
        if not self.calculation.utilisations:
            return Paragraph("The case gives no resistance: utilisations are not calculated.")
        rows: list[list[Inline]] = []
        for name, demand, resistance, quantity in (
            ("Shear", forces.largest_shear.value, inputs.shear_resistance, "force"),
            ("Moment", forces.largest_moment.value, inputs.moment_resistance, "moment"),
        ):
            shown, unit = self.shown(abs(demand), quantity)
            ratio = self.calculation.utilisations.get(name.lower())
            if ratio is None or resistance is None:
                rows.append([name, shown, "not given", unit, "", "not checked"])
                continue
            limit = self.number(resistance, quantity, given=True)
            rows.append([name, shown, limit, unit, rounded(ratio, 3), verdict(ratio)])
        symbols = {name: Tex(SYMBOLS[name].latex) for name in ("V_max", "M_max", "V_R", "M_R")}
        return Table(
            label="tab-utilisation",
            caption=(
                "Utilisation: the largest member force, ",
                symbols["V_max"],
                " or ",
                symbols["M_max"],
                ", over its resistance, ",
                symbols["V_R"],
                " or ",
                symbols["M_R"],
                ".",
            ),
            columns=columns(
                "Check",
                decimal("Largest force"),
                decimal("Resistance"),
                "Unit",
                decimal("Utilisation"),
                wide("Verdict"),
            ),
            rows=rows,
        )
