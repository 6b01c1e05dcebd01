"""Member forces by the beam and under the static reaction, their diagrams, and utilisations."""

import numpy as np

from pierimpact.plots.figures import draw_member_forces
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Inline, Tex
from pierimpact.report.document.numbered import Figure, Table, columns, decimal, wide
from pierimpact.report.sheet.section import Section
from pierimpact.report.sheet.summary import DEMANDS, METHODS, verdict
from pierimpact.symbols import SYMBOLS
from pierimpact.units import rounded


class MemberForces(Section):
    """The forces in the column by two methods: the column as a beam, and the static reaction."""

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the member forces, by name."""
        yields = {"Ry": "tab-yielding"} if self.yielding() else {}
        return {"V_max": "tab-members", "M_max": "tab-members"} | yields

    def table(self) -> Block:
        """Return shear and moment at base, impact and top, and the largest, by both methods."""
        result = self.calculation
        static, beam = result.member_forces, result.beam_forces
        rows: list[list[Inline]] = []
        for name, symbol, corner, quantity in (
            ("Shear at the base", r"R_\mathrm{d} \, R_\mathrm{b}", 0, "force"),
            ("Shear at the top", r"-R_\mathrm{d} \, R_\mathrm{t}", 3, "force"),
            ("Moment at the base", r"R_\mathrm{d} \, M_\mathrm{b}", 0, "moment"),
            ("Moment at the impact", r"R_\mathrm{d} \, M_\mathrm{n}", 1, "moment"),
            ("Moment at the top", r"R_\mathrm{d} \, M_\mathrm{t}", 3, "moment"),
        ):
            of_static = static.shear if quantity == "force" else static.moment
            rows.append([name, Tex(symbol), self.number(float(of_static[corner]), quantity)])
            if beam is not None:
                place = int(np.argmin(np.abs(beam.z - static.z[corner])))
                ends = (
                    (beam.largest_shear, beam.smallest_shear)
                    if quantity == "force"
                    else (beam.largest_moment, beam.smallest_moment)
                )
                # Of a free or pinned end nothing but round-off is left.
                least = 1e-9 * (result.demands["shear" if quantity == "force" else "moment"].value)
                # Beyond an end that is struck there is no beam whose shear could be given.
                struck = corner != 1 and static.z[corner] == static.impact_height
                rows[-1] += [
                    ""
                    if struck and quantity == "force"
                    else self.number(value if abs(value) > least else 0.0, quantity)
                    for value in (float(envelope[place]) for envelope in ends)
                ]
            rows[-1].append(self.unit(quantity))
        for name, quantity in DEMANDS.items():
            demand = result.demands[name]
            sign = SYMBOLS["V_max" if name == "shear" else "M_max"].latex
            rows.append([f"Largest {name}", Tex(sign), self.number(demand.static, quantity)])
            if demand.beam is not None:
                rows[-1] += [self.number(demand.beam, quantity), ""]
            rows[-1].append(self.unit(quantity))
        by_beam = () if beam is None else (decimal("Beam, largest"), decimal("Beam, smallest"))
        return Table(
            label="tab-members",
            caption="Shear and moment: under the design reaction as a static force at the impact"
            + ("." if beam is None else ", and during the collision with the column as a beam."),
            columns=columns("Quantity", "Static symbol", decimal("Static"), *by_beam, "Unit"),
            rows=rows,
            strong=[5, 6],
        )

    def comparison(self) -> Block:
        """Return where and when the largest forces of the beam are, and which method governs."""
        result = self.calculation
        beam, demands = result.beam_forces, result.demands
        if beam is None:
            return Paragraph(
                "The case asks for static member forces: the column was not calculated as a beam."
            )
        sentences = []
        for name, extremes in (("shear", beam.shear_extremes), ("moment", beam.moment_extremes)):
            extreme, ratio = extremes.governing, demands[name].ratio
            height = self.shown(abs(extreme.z), "length", given=True)
            place = f"{height} {'above' if extreme.z >= 0.0 else 'below'} the ground"
            place = "at the base" if extreme.z == beam.z[0] else place
            time = self.shown(extreme.time, "time")
            sentences.append(
                f"The largest {name} of the beam is {place}, {time} after first touch; the static "
                f"one is {rounded(ratio or 0.0, 3)} times it."
            )
        choice = {
            "larger": "The larger of the two governs each check.",
            "beam": "The case asks for the checks to be by the beam.",
        }[self.case.inputs.member_forces]
        return Paragraph(" ".join([*sentences, choice]))

    def diagrams(self) -> Block:
        """Return the diagrams of shear and moment."""
        result, inputs = self.calculation, self.case.inputs
        forces = result.member_forces
        height = self.shown(forces.impact_height, "length", given=True)
        largest = {
            name: self.shown(result.demands[name].value, quantity)
            for name, quantity in DEMANDS.items()
        }
        envelope = (
            ""
            if result.beam_forces is None
            else ("; shaded, the envelope of both signs with the column as a beam")
        )
        given = inputs.shear_resistance is not None or inputs.moment_resistance is not None
        return Figure(
            label="fig-members",
            caption="Shear and moment under the design reaction (lines)"
            + envelope
            + ("; dashed, the resistances" if given else "")
            + ". Moment positive where the far face is in tension.",
            alt=f"The column with the design reaction at {height}, and its diagrams. The largest "
            f"shear is {largest['shear']}, the largest moment {largest['moment']}.",
            svg=draw_member_forces(
                forces,
                result.beam_forces,
                (inputs.shear_resistance, inputs.moment_resistance),
                self.system,
            ),
        )

    def yielding(self) -> Block | None:
        """Return what the collision does to the pier if it yields in bending; None if it does not.

        None also where the case gives no moment resistance.
        """
        history, inputs = self.calculation.yielding, self.case.inputs
        if history is None or inputs.moment_resistance is None:
            return None
        moment = inputs.moment_resistance / history.pier.yield_reaction
        largest = history.ductility * history.pier.yield_reaction / history.pier.stiffness
        energy = history.pier_plastic_energy
        share = rounded(100.0 * energy / history.collision.energy, 3)
        most = r"\left| M \right|_\mathrm{max}"
        ductility = r"\left| x_\mathrm{p} \right|_\mathrm{max} \, k_\mathrm{p} / R_\mathrm{y}"
        taken = f"Energy taken by yielding, {share} % of the truck’s"
        rows = [
            ("Yield reaction", rf"R_\mathrm{{y}} = M_\mathrm{{R}} / {most}",
             self.shown(history.pier.yield_reaction, "force")),
            ("Largest moment under a unit force", most, self.shown(moment, "length")),
            ("Largest displacement at the impact", r"x_\mathrm{p}",
             self.shown(largest, "section length")),
            ("Ductility demand", ductility, (rounded(history.ductility, 3), "")),
            ("Residual displacement at the impact", "",
             self.shown(history.residual_displacement, "section length")),
            (taken, "", self.shown(energy, "energy")),
        ]  # fmt: skip
        return Table(
            label="tab-yielding",
            caption="If the column yields in bending: the full model with a pier that is elastic "
            "up to the reaction at which its moment resistance is first reached, and perfectly "
            "plastic from there. A redundant column carries more until its hinges make it a "
            "mechanism. The case does not say how much ductility the section has; shear is not "
            "ductile, and its utilisation stays as it is.",
            columns=columns("Quantity", "Symbol", decimal("Value"), "Unit"),
            rows=[[name, Tex(symbol) if symbol else "", *shown] for name, symbol, shown in rows],
            strong=[3],
        )

    def utilisation(self) -> Block:
        """Return demand, resistance, utilisation and verdict of shear and moment."""
        inputs, result = self.case.inputs, self.calculation
        if not result.utilisations:
            return Paragraph("The case gives no resistance: utilisations are not calculated.")
        rows: list[list[Inline]] = []
        resistances = (inputs.shear_resistance, inputs.moment_resistance)
        for (name, quantity), resistance in zip(DEMANDS.items(), resistances, strict=True):
            demand = result.demands[name]
            shown, unit = self.shown(demand.value, quantity)
            cells: list[Inline] = [name.capitalize(), METHODS[demand.method], shown]
            ratio = result.utilisations.get(name)
            if ratio is None or resistance is None:
                rows.append([*cells, "not given", unit, "", "not checked"])
                continue
            limit = self.number(resistance, quantity, given=True)
            rows.append([*cells, limit, unit, rounded(ratio, 3), verdict(ratio)])
        symbols = {name: Tex(SYMBOLS[name].latex) for name in ("V_max", "M_max", "V_R", "M_R")}
        return Table(
            label="tab-utilisation",
            caption=(
                "Utilisation: the largest member force by the method that governs, ",
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
                "By",
                decimal("Largest force"),
                decimal("Resistance"),
                "Unit",
                decimal("Utilisation"),
                wide("Verdict"),
            ),
            rows=rows,
            strong=[
                number
                for number, name in enumerate(DEMANDS)
                if result.utilisations.get(name, 0.0) > 1.0
            ],
        )
