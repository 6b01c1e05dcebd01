"""Member forces by the beam and under the static reaction, their diagrams, and utilisations."""

import math
from collections.abc import Mapping

import numpy as np

from pierimpact.plots.envelopes import draw_envelopes
from pierimpact.report.calculation import Demand
from pierimpact.report.document.blocks import Block, Group, Paragraph
from pierimpact.report.document.markup import Inline, Tex
from pierimpact.report.document.numbered import Figure, Table, columns, decimal
from pierimpact.report.outcome import DEMANDS
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import SYMBOLS
from pierimpact.units import compared, rounded

_MODES = 8  # that are listed: this project's choice
# Of a column whose moment is exceeded as a beam, and not under the static reaction.
_UNKNOWN = (
    "As a beam the column exceeds its moment resistance; under the reaction as a static force it "
    "does not. How much ductility that takes is not known: the pier of one degree of freedom, "
    "whose yielding this sheet follows, stays elastic."
)


class MemberForces(Section):
    """The forces in the column by two methods: the column as a beam, and the static reaction.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(file.case)
    >>> largest_moment = sheet.member_forces.table().rows[-1]
    >>> largest_moment[2], largest_moment[4], largest_moment[6]  # static, beam, unit
    ('5650', '4142', 'kN·m')
    """

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the member forces, by name."""
        yields = {"Ry": "tab-yielding"} if isinstance(self.yielding(), Table) else {}
        return {"V_max": "tab-members", "M_max": "tab-members"} | yields

    def methods(self) -> Block:
        """Return by which methods they are calculated, and where they belong."""
        beam = self.calculation.governing.beam
        in_modes = ""
        if beam is not None:
            highest = self.shown(float(beam.frequencies[-1]), "frequency")
            in_modes = (
                "; and the same collision with the column as a beam, with flexure, shear and "
                f"rotary inertia in its {len(beam.frequencies)} natural modes up to {highest}, "
                "each with the damping ratio of the pier"
            )
        return Paragraph(
            (
                f"By {'two methods' if beam else 'one method, which the case asks for'}: the "
                "reaction as a static force at ",
                Tex(r"z_\mathrm{n}"),
                f", with the mass of the column at rest{in_modes}. They are those "
                "of the collision alone and belong in the accidental "
                "combination of the code that governs (Extreme Event II of AASHTO LRFD, the "
                "accidental situation of EN 1990; both from memory).",
            )
        )

    def modes(self) -> Block | None:
        """Return the natural modes of the column as a beam; None where it was not calculated."""
        beam = self.calculation.governing.beam
        if beam is None:
            return None
        shares = (
            100.0
            * beam.equivalent.stiffness
            * (beam.impact_deflection / beam.circular_frequencies) ** 2
        )
        shown = beam.frequencies[:_MODES]
        rows: list[list[Inline]] = [
            [str(number), self.number(float(frequency), "frequency"), rounded(float(share), 3)]
            for number, (frequency, share) in enumerate(zip(shown, shares, strict=False), 1)
        ]
        rows.append(["all others", "", rounded(float(shares[len(shown) :].sum()), 3)])
        words = Paragraph(
            (
                "Each natural mode, normalised to unit mass, is an oscillator under the contact "
                "force: ",
                Tex(
                    r"\ddot{q} + 2 \zeta \omega \dot{q} + \omega^2 q = "
                    r"\varphi(z_\mathrm{n}) \, F"
                ),
                ". Deflection, shear and moment of the column are the sums of those of the modes, "
                "each times its ",
                Tex("q"),
                "; what the modes left out add to the deflection under a static force follows the "
                "contact force at once. The frequencies, and how much of the deflection under a "
                "static force at the impact is each mode’s, ",
                Tex(r"k_\mathrm{p} \, \varphi(z_\mathrm{n})^2 / \omega^2"),
                ", are to be compared with those of any beam program.",
            )
        )
        table = Table(
            label="tab-modes",
            caption="Natural modes of the column as a beam.",
            columns=columns(
                "Mode",
                decimal(f"Frequency [{self.unit('frequency')}]"),
                decimal("Share of the deflection [%]"),
            ),
            rows=rows,
        )
        return Group([words, table])

    def table(self) -> Block:
        """Return shear and moment at base, impact and top, and the largest, by both methods."""
        result = self.calculation
        static, back = result.member_forces, result.governing.reversed_forces
        rows: list[list[Inline]] = []
        for name, symbol, corner, quantity in (
            ("Shear at the base", r"R \, R_\mathrm{b}", 0, "force"),
            ("Shear at the top", r"-R \, R_\mathrm{t}", 3, "force"),
            ("Moment at the base", r"R \, M_\mathrm{b}", 0, "moment"),
            ("Moment at the impact", r"R \, M_\mathrm{n}", 1, "moment"),
            ("Moment at the top", r"R \, M_\mathrm{t}", 3, "moment"),
        ):
            values = [
                float((forces.shear if quantity == "force" else forces.moment)[corner])
                for forces in (static, back)
            ]
            rows.append(
                [
                    name,
                    Tex(symbol),
                    *(self.number(value, quantity) for value in values),
                    *self._beam_at(corner, quantity),
                    self.unit(quantity),
                ]
            )
        several = len(result.impacts) > 1
        of_both = " of both" if several else ""
        rows += [self._largest(name, result.demands[name], of_both) for name in DEMANDS]
        by_beam = (
            ()
            if result.governing.beam_forces is None
            else (decimal("Beam, largest"), decimal("smallest"))
        )
        return Table(
            label="tab-members",
            caption="Shear and moment: under the design reaction and under the lowest reaction as "
            "static forces at the impact"
            + ("" if not by_beam else ", and during the collision with the column as a beam")
            + (". Values at one place are for the height that governs." if several else "."),
            columns=columns(
                "Quantity", "Static", decimal("Peak"), decimal("Reversed"), *by_beam, "Unit"
            ),
            rows=rows,
            strong=[len(rows) - 2, len(rows) - 1],
        )

    def places(self) -> Block | None:
        """Return the largest shear and moment by impact height and by part of the column.

        None where there is one of either.
        """
        result, parts = self.calculation, self.case.parts
        several, resisting = len(result.impacts) > 1, len(parts) > 1
        found: list[tuple[str, dict[str, Demand], Mapping[str, float]]] = [
            (f"Struck at {self.stated(own.struck.impact_height, 'length')}", own.demands, {})
            for own in (result.impacts if several else ())
        ]
        found += [
            (f"From {self.stretch(*part[:2])}", result.demands_of(part), part.resistances)
            for part in (parts if resisting else ())
        ]
        if not found:
            return None
        methods = ("static", "beam") if result.governing.beam is not None else ("static",)
        differing = self.case.differing
        heads = []
        for name, quantity in DEMANDS.items():
            unit = self.unit(quantity)
            heads += [decimal(f"{name.capitalize()}, {method} [{unit}]") for method in methods]
            if name in differing:
                heads.append(decimal("Resistance"))
        rows: list[list[Inline]] = []
        for words, demands, resistances in found:
            row: list[Inline] = [words]
            for name, quantity in DEMANDS.items():
                demand = demands[name]
                row += [self.number(getattr(demand, method), quantity) for method in methods]
                if name in differing:
                    limit = resistances.get(name)
                    row.append("" if limit is None else self.number(limit, quantity, given=True))
            rows.append(row)
        each = [*(["impact height"] if several else []), *(["part"] if resisting else [])]
        return Table(
            label="tab-places",
            caption=f"Largest shear and moment of each {' and of each '.join(each)}"
            f"{', struck at either height' if several and resisting else ''}.",
            columns=columns("Column", *heads),
            rows=rows,
        )

    def _beam_at(self, corner: int, quantity: str) -> list[Inline]:
        """Return largest and smallest value of the beam at a corner of the static diagrams."""
        result = self.calculation
        static, beam = result.member_forces, result.governing.beam_forces
        if beam is None:
            return []
        # Beyond an end that is struck there is no beam whose shear could be given.
        if quantity == "force" and corner != 1 and static.z[corner] == static.impact_height:
            return ["", ""]
        place = int(np.argmin(np.abs(beam.z - static.z[corner])))
        ends = (
            (beam.largest_shear, beam.smallest_shear)
            if quantity == "force"
            else (beam.largest_moment, beam.smallest_moment)
        )
        # Of a free or pinned end nothing but round-off is left; the share is numerical.
        least = 1e-9 * result.demands["shear" if quantity == "force" else "moment"].value
        values = (float(envelope[place]) for envelope in ends)
        return [self.number(value if abs(value) > least else 0.0, quantity) for value in values]

    def _largest(self, name: str, demand: Demand, where: str) -> list[Inline]:
        """Return the row of a largest shear or moment."""
        quantity = DEMANDS[name]
        sign = SYMBOLS["V_max" if name == "shear" else "M_max"].latex
        beam = [] if demand.beam is None else [self.number(demand.beam, quantity), ""]
        static = self.number(demand.static, quantity)
        return [f"Largest {name}{where}", Tex(sign), static, "", *beam, self.unit(quantity)]

    def comparison(self) -> Block:
        """Return where and when the largest forces of the beam are, and which method governs."""
        result = self.calculation
        sentences = []
        for name, demand in result.demands.items():
            largest = result.largest_of_beam(name)
            if largest is None:
                return Paragraph(
                    "The case asks for static member forces: the column was not calculated as a "
                    "beam."
                )
            extreme, impact = largest
            struck = self.stated(impact.struck.impact_height, "length")
            several = len(result.impacts) > 1
            of_both = f", struck at {struck}," if several else ""
            static = "largest static one" if several else "static one"
            height = self.placed(abs(extreme.z))
            place = f"{height} {'above' if extreme.z >= 0.0 else 'below'} the ground"
            place = "at the base" if extreme.z == 0.0 - result.case.column.embedment else place
            time = self.shown(extreme.time, "time")
            sentences.append(
                f"The largest {name} of the beam{of_both} is {place}, {time} after first touch; "
                f"the {static} is {rounded(demand.ratio or 0.0, 3)} times it."
            )
        choice = {
            "larger": "The larger of the two governs each check.",
            "beam": "The case asks for the checks to be by the beam.",
        }[self.case.inputs.member_forces]
        return Paragraph(" ".join([*sentences, choice]))

    def diagrams(self) -> Block:
        """Return the envelopes of shear and moment, with the resistances."""
        result, inputs = self.calculation, self.case.inputs
        largest = {
            name: self.shown(result.demands[name].value, quantity)
            for name, quantity in DEMANDS.items()
        }
        bands = self._signed_bands()
        return Figure(
            label="fig-members",
            caption="Shear and moment over the height: dashed, under the design reaction and, "
            "reversed, under the lowest one as static forces"
            + (
                ""
                if inputs.member_forces == "static"
                else "; filled, the beam’s envelopes of both signs"
            )
            + ("; vertical, the resistances" if result.resistances else "")
            + ("; at the foot, the band of the largest ones, 5 to 95 %" if bands else "")
            + ". Moment positive where the far face is in tension.",
            alt=f"Envelopes of shear and moment. The largest shear is {largest['shear']}, the "
            f"largest moment {largest['moment']}.",
            svg=draw_envelopes(
                [
                    (impact.member_forces, impact.reversed_forces, impact.beam_forces)
                    for impact in result.impacts
                ],
                self.case.parts,
                bands,
                self.system,
                self.case.column,
            ),
        )

    def yielding(self) -> Block | None:
        """Return what the collision does to the pier if it yields in bending; None if it does not.

        None also where the case gives no moment resistance.
        """
        result, found = self.calculation, self.calculation.yielding
        use = result.uses.get("moment")
        if use is None:
            return None
        by_beam = use.demand.method == "beam" and use.utilisation > 1.0
        if found is None:
            return Paragraph(_UNKNOWN) if by_beam else None
        struck, part, history, shear = found
        yields = history.pier.yield_reaction
        moment = part.resistances["moment"] / yields
        if shear > 1.0:
            return Paragraph(
                f"The column does not yield in bending before it fails in shear: under "
                f"{self.shown(yields, 'force')}, at which the moment resistance is reached, the "
                f"shear is {rounded(shear, 3)} times its resistance. There is no ductility to "
                "count on."
            )
        if (first := result.utilisations.get("shear", 0.0)) > max(1.0, use.utilisation):
            return Paragraph(
                f"The column fails in shear before it yields in bending: it uses {compared(first)} "
                f"times its shear resistance and {compared(use.utilisation)} times its moment "
                "resistance. There is no ductility to count on."
            )
        largest = history.ductility * yields / history.pier.stiffness
        energy = history.pier_plastic_energy
        share = rounded(100.0 * energy / history.collision.energy, 3)
        most = r"\left| M \right|_\mathrm{max}"
        ductility = r"\left| x_\mathrm{p} \right|_\mathrm{max} \, k_\mathrm{p} / R_\mathrm{y}"
        taken = f"Energy taken by yielding, {share} % of the truck’s"
        rows = [
            ("Largest moment under a unit force", most, self.shown(moment, "length")),
            ("Yield reaction", rf"R_\mathrm{{y}} = M_\mathrm{{R}} / {most}",
             self.shown(yields, "force")),
            ("Stiffness of the pier", r"k_\mathrm{p}",
             self.shown(history.pier.stiffness, "stiffness")),
            ("Largest displacement at the impact", r"x_\mathrm{p}",
             self.shown(largest, "section length")),
            ("Ductility demand", ductility, (rounded(history.ductility, 3), "")),
            ("Residual displacement at the impact", "",
             self.shown(history.residual_displacement, "section length")),
            (taken, "", self.shown(energy, "energy")),
        ]  # fmt: skip
        height = self.stated(struck.impact_height, "length")
        at_height = f", struck at {height}," if len(result.impacts) > 1 else ""
        in_part = "" if part == self.case.whole else f" from {self.stretch(*part[:2])}"
        return Table(
            label="tab-yielding",
            caption=f"If the column{at_height} yields in bending{in_part}: the full model, elastic "
            "up to the reaction at which the moment resistance is first reached and perfectly "
            "plastic from there. A redundant column carries more until it is a mechanism. How much "
            "ductility the section has is not checked; shear is not ductile."
            + (
                " The moment of the beam, which governs, is larger, and the demand may be."
                if by_beam
                else ""
            ),
            columns=columns("Quantity", "Symbol", decimal("Value"), "Unit"),
            rows=[[name, Tex(symbol) if symbol else "", *shown] for name, symbol, shown in rows],
            strong=[4],
        )

    def _signed_bands(self) -> dict[str, tuple[float, float]]:
        """Return the bands of the largest shear and moment, on the side of what governs."""
        result, bands = self.calculation, {}
        for name, (low, high) in result.demand_bands.items():
            beam = result.largest_of_beam(name)
            if result.demands[name].method == "beam" and beam is not None:
                governing = beam[0].value
            else:
                governing = getattr(result.member_forces, f"largest_{name}").value
            sign = math.copysign(1.0, governing)
            bands[name] = (sign * low, sign * high)
        return bands
