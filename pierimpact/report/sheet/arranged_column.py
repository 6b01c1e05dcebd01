"""The equivalent pier of a column with steps, springs, embedment or a mass at its top."""

from functools import cached_property

import numpy as np

from pierimpact.pier.arrangement import Part
from pierimpact.pier.equivalent import vibration
from pierimpact.pier.static import Piece
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Inline, Ref, Tex, in_tex
from pierimpact.report.document.numbered import Equation, Steps, Table, columns, decimal
from pierimpact.report.sheet.equivalent_pier import EquivalentPierSteps
from pierimpact.symbols import SYMBOLS

_UNIT_FORCE = ("Rb", "Rt", "Mb", "Mn", "Mt")


class ArrangedColumnSteps(EquivalentPierSteps):
    """The column as one degree of freedom, part by part.

    What the unit force does to the column comes from a set of equations too large to print. A
    checker follows its results: equilibrium, the deflection as the work of all parts and springs,
    and the equivalent mass as the sum over the parts.
    """

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the pier, by name."""
        blocks = (self.section(), self.mass())
        steps = [equation.label for block in blocks for equation in block.equations]
        return (
            {label.removeprefix("eq-"): label for label in steps}
            | dict.fromkeys(_UNIT_FORCE, "tab-unit-force")
            | {"xn": "tab-work", "height": "tab-shape", "phi": "tab-shape"}
        )

    @cached_property
    def _pieces(self) -> tuple[Piece, ...]:
        return self.calculation.struck.unit_force.pieces

    def _stretch(self, part: Part) -> str:
        """Return from where to where a part goes."""
        bottom, top = (self.shown(z, "length", given=True) for z in (part.bottom, part.top))
        return f"{bottom.number} to {top}"

    def parts(self) -> Block:
        """Return section properties, rigidities and mass per length of each part."""
        column, names = self.case.column, ("A", "I", "kappa", "EI", "GA", "mbar")

        def values(part: Part) -> dict[str, float]:
            here = (own for own, low, high in column.stretches if low <= part.bottom < high)
            return column.section_values(next(here))

        return Table(
            label="tab-parts",
            caption="Parts of the column, from the base upward, with a joint at the impact.",
            columns=columns(
                "Part",
                *(
                    decimal((Tex(SYMBOLS[name].latex), f" [{unit}]" if unit else ""))
                    for name in names
                    for unit in [self.unit(SYMBOLS[name].quantity)]
                ),
            ),
            rows=[
                [
                    self._stretch(piece.part),
                    *(
                        self.number(values(piece.part)[name], SYMBOLS[name].quantity)
                        for name in names
                    ),
                ]
                for piece in self._pieces
            ],
        )

    def unit_forces(self) -> Block:
        """Return support forces and moments under a unit force at the impact height."""
        arm = r"(z_\mathrm{n} + H_\mathrm{e})" if self.case.column.embedment else r"z_\mathrm{n}"
        return Table(
            label="tab-unit-force",
            caption=(
                "Support forces and moments under a unit force at the impact: exact for uniform "
                "parts, from the conditions at the supports and at the joints of the parts "
                "(derived here). As a check, ",
                Tex(r"R_\mathrm{b} + R_\mathrm{t} = 1"),
                " and ",
                Tex(
                    r"M_\mathrm{b} + R_\mathrm{b} \, " + arm + r" = "
                    r"M_\mathrm{t} + R_\mathrm{t} \, (H - z_\mathrm{n}) = M_\mathrm{n}"
                ),
                ".",
            ),
            columns=columns("Quantity", "Symbol", decimal("Value"), "Unit"),
            rows=[
                [
                    SYMBOLS[name].heading,
                    Tex(SYMBOLS[name].latex),
                    *self.shown(self._values[name], SYMBOLS[name].quantity),
                ]
                for name in _UNIT_FORCE
            ],
        )

    def stiffness(self) -> Block:
        """Return the deflection at the impact as the work of parts and springs."""
        rows: list[list[Inline]] = [
            [
                self._stretch(piece.part),
                *(self.number(work, "flexibility") for work in (piece.flexure, piece.shearing)),
                self.number(piece.work, "flexibility"),
            ]
            for piece in self._pieces
        ]
        column, found = self.case.column, self.calculation.struck.unit_force
        for name, support, force, moment in (
            ("base", column.supports[0], found.base_force, found.base_moment),
            ("top", column.supports[1], found.top_force, found.top_moment),
        ):
            if work := support.work(force, moment):
                rows.append([f"Springs, {name}", "", "", self.number(work, "flexibility")])
        rows.append(["Sum", "", "", self.number(found.deflection, "flexibility")])
        unit = self.unit("flexibility")
        return Table(
            label="tab-work",
            caption=(
                "Deflection at the impact under the unit force, as its work: the integrals of ",
                Tex("M^2 / EI"),
                " and ",
                Tex(r"V^2 / \kappa GA"),
                " over each part, and ",
                Tex(r"R^2 / k + M^2 / k_\theta"),
                " of the springs. The sum is ",
                Tex(SYMBOLS["xn"].latex),
                ".",
            ),
            columns=columns(
                "Part",
                decimal(f"Flexure [{unit}]"),
                decimal(f"Shear [{unit}]"),
                decimal(f"Total [{unit}]"),
            ),
            rows=rows,
            strong=[len(rows) - 1],
        )

    def shape(self) -> Block:
        """Return what the shape function is between the heights of the table."""
        return Paragraph(
            (
                "Under the unit force the moment is linear and the shear constant in every part, "
                "so that the shape function ",
                Tex(SYMBOLS["phi"].latex),
                " is a cubic there. ",
                Ref("Table", "tab-shape"),
                " gives it at the ends and in the middle of each part.",
            )
        )

    def shape_table(self) -> Block:
        """Return the shape function part by part, its integrals, and the sum of the masses."""
        struck, column = self.calculation.struck, self.case.column
        squares = 1.0 / struck.unit_force.deflection**2
        rows: list[list[Inline]] = []
        for piece in self._pieces:
            part, square = piece.part, piece.square * squares
            z = np.linspace(part.bottom, part.top, 3)
            rows.append(
                [
                    self._stretch(part),
                    *(self.number(float(phi), "ordinate") for phi in struck.shape(z)),
                    self.number(square, "length"),
                    self.number(part.mass_per_length * square, "mass"),
                ]
            )
        if column.top_mass:
            phi = float(struck.shape(column.height))
            mass = self.number(column.top_mass * phi**2, "mass")
            rows.append(["Mass at the top", "", "", self.number(phi, "ordinate"), "", mass])
        rows.append(["Sum", "", "", "", "", self.number(struck.mass, "mass")])
        return Table(
            label="tab-shape",
            caption=(
                "Shape function and equivalent mass, part by part: ",
                Tex(
                    r"m_\mathrm{p} = \sum \bar m \int \varphi^2 \, \mathrm{d}z"
                    + (r" + m_\mathrm{t} \, \varphi(H)^2" if column.top_mass else "")
                ),
                " (Eq. 1 of the source paper).",
            ),
            columns=columns(
                "Part",
                decimal((Tex(r"\varphi"), " bottom")),
                decimal("middle"),
                decimal("top"),
                decimal((Tex(r"\int \varphi^2 \, \mathrm{d}z"), f" [{self.unit('length')}]")),
                decimal(f"Mass [{self.unit('mass')}]"),
            ),
            rows=rows,
            strong=[len(rows) - 1],
        )

    def mass(self) -> Steps:
        """Return stiffness, equivalent mass, frequency and damping."""
        writer = self._writer(quantities={"kp": "mass stiffness"})
        stiffness = in_tex(self.shown(self._values["kp"], "stiffness"))
        flexibility = in_tex(self.shown(self._values["xn"], "flexibility"))
        mass = in_tex(self.shown(self._values["mp"], "mass"))
        return Steps(
            [
                Equation(
                    label="eq-kp",
                    name=SYMBOLS["kp"].heading,
                    symbol=SYMBOLS["kp"].latex,
                    lines=[
                        rf"\frac{{1}}{{{SYMBOLS['xn'].latex}}}",
                        rf"\frac{{1}}{{{flexibility}}} = {stiffness}",
                    ],
                    source="Eq. 3 of the source paper",
                ),
                Equation(
                    label="eq-mp",
                    name=SYMBOLS["mp"].heading,
                    symbol=SYMBOLS["mp"].latex,
                    lines=[mass],
                    source=("Eq. 1 of the source paper, ", Ref("Table", "tab-shape")),
                ),
                *map(writer.equation, vibration.steps(self._values, vibration.names)),
            ]
        )
