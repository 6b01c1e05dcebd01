"""The equivalent pier: section, unit force, stiffness, shape function, mass and frequency.

What the unit force does to any column is a table, from `pier.static`. A checker follows it:
equilibrium, the deflection as the work of all parts and springs, and the equivalent mass as the
sum over the parts. The closed formulas of uniform columns are an annex, in `derivation`.
"""

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from pierimpact.files.case import CONCRETE_FACTORS
from pierimpact.pier.arrangement import Part
from pierimpact.pier.equivalent import vibration
from pierimpact.pier.static import Piece
from pierimpact.plots.shape import draw_shape_function
from pierimpact.report.document.blocks import Beside, Block, Paragraph
from pierimpact.report.document.markup import Inline, Ref, Tex, in_tex
from pierimpact.report.document.numbered import Equation, Figure, Steps, Table, columns, decimal
from pierimpact.report.document.step_writer import StepWriter
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import SYMBOLS
from pierimpact.units import Printed, printed, rounded, unit_of, unit_size

_GIVEN = (
    *("D", "b", "h", "t", "Df", "ns", "Av", "alpha_E", "alpha_rho"),
    *("fc", "E", "nu", "rho", "psi", "EIe", "H", "z", "y", "zeta"),
)
_UNIT_FORCE = {
    "Rb": "Force at the base",
    "Rt": "Force at the top",
    "Mb": "Moment at the base",
    "Mn": "Moment at the impact",
    "Mt": "Moment at the top",
}


class PierSection(Section):
    """What the headings on the equivalent pier have in common."""

    @cached_property
    def _values(self) -> dict[str, float]:
        """The values of the column and the pier, by symbol."""
        strength = {"fc": self.case.inputs.concrete_strength or 0.0}
        return self.calculation.struck.values | self.calculation.pier.values | strength

    def _writer(
        self, *, units: bool = True, quantities: Mapping[str, str] | None = None
    ) -> StepWriter:
        return StepWriter(self._values, self.system, _GIVEN, units=units, quantities=quantities)

    @property
    def section_names(self) -> set[str]:
        """The properties of the section that print as equations with the pier itself."""
        return set(self.case.column.section.calculation.names) & {"A", "I", "Am"}


class EquivalentPierSteps(PierSection):
    """The column as one degree of freedom.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(file.case)
    >>> sheet.pier.mass_of_column().body
    'The equivalent mass is 0.811 times that of the column, 7880.3 kg.'
    """

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the pier, by name."""
        blocks = (self.section(), self.mass())
        steps = [equation.label for block in blocks for equation in block.equations]
        return (
            {label.removeprefix("eq-"): label for label in steps}
            | dict.fromkeys(_UNIT_FORCE, "tab-unit-force")
            | {"xn": "tab-work", "height": "tab-shape", "phi": "tab-shape"}
            | ({} if self.case.column.uniform else {"kappa": "tab-parts"})
        )

    def impact_height(self) -> Block:
        """Return which nominal impact height is used, and why."""
        impacts, symbol = self.calculation.impacts, Tex(SYMBOLS["z"].latex)
        used = self.stated(self.calculation.struck.impact_height, "length", 5)  # all rests on it
        if len(impacts) == 1:
            return Paragraph(
                ("The nominal impact height ", symbol, f" = {used} is given by the case.")
            )
        found = " and ".join(
            f"{self.shown(impact.reaction, 'force')} at "
            f"{self.stated(impact.struck.impact_height, 'length')}"
            for impact in impacts
        )
        return Paragraph(
            (
                "The case leaves the nominal impact height to the source paper, which has one for "
                "trucks whose engine governs and one for trucks whose cargo does. Both are "
                f"calculated: the reaction is {found}. The larger governs, and the sheet follows ",
                symbol,
                f" = {used}; shear and moment are the largest of both.",
            )
        )

    def units(self) -> Block:
        """Return which units values without units are in, and how masses and forces compare."""
        size = unit_size("stiffness", self.system) / unit_size("mass stiffness", self.system)
        return Paragraph(
            f"Where values are inserted without units, lengths are in {self.unit('length')} "
            f"and forces in {self.unit('shear rigidity')}. Masses are in {self.unit('mass')}: "
            f"where they stand beside a stiffness, 1 {self.unit('stiffness')} is "
            f"{printed(size, 'share', 'SI', given=True)} {self.unit('mass stiffness')}. "
            "Every printed value is rounded, so that a check by hand may differ in the last figure."
        )

    def section(self) -> Steps:
        """Return area, second moment, rigidities and mass per length at the base of the column."""
        writer, column = self._writer(), self.case.column
        section = column.section.calculation
        steps = section.steps(self._values, self.section_names)
        for calculation in column.calculations(column.section)[1:]:
            steps += calculation.steps(self._values, calculation.names)
        equations: list[Equation] = []
        for step in steps:
            for name in step.names & {"psi", "EIe"}:
                source = self._source_of(SYMBOLS[name].key)
                step = step._replace(remark=f"${SYMBOLS[name].latex}$: {source}")
            equations.append(writer.equation(step))
        if self.case.inputs.concrete_strength is not None:
            equations.insert(0, self._concrete_modulus())
        return Steps(equations)

    def _source_of(self, key: str) -> str:
        """Return where the case has a value from."""
        inputs = self.case.inputs
        return inputs.sources.get(key) or inputs.assumed.get(key) or "given in the case file"

    def _concrete_modulus(self) -> Equation:
        """Return the modulus by ACI 318, in its form for the unit that the strength is given in."""
        system = self.case.inputs.concrete_system
        unit = unit_of("root strength", system)
        factor = in_tex(Printed(rounded(CONCRETE_FACTORS[system], 5), unit))
        strength = printed(self._values["fc"], "root strength", system, given=True)

        def formula(value: str, times: str) -> str:
            return rf"{factor} {times} \sqrt{{{value} / (1\ \text{{{unit}}})}}"

        values = formula(in_tex(strength), r"\times")
        return Equation(
            label="eq-E",
            name="Elastic modulus of the concrete",
            symbol="E",
            lines=[
                formula(SYMBOLS["fc"].latex, r"\,"),
                f"{values} = {in_tex(self._writer().shown('E'))}",
            ],
            source="formula of ACI 318, from memory; unverified: check against the standard",
        )

    @cached_property
    def _pieces(self) -> tuple[Piece, ...]:
        return self.calculation.struck.unit_force.pieces

    def under_unit_force(self) -> Block:
        """Return the shape function as a figure, beside what the unit force does."""
        tables = [self.unit_forces(), self.stiffness(), self.shape_table()]
        # The share is a width by eye, this project's choice.
        return Beside(left=[self.shape_figure()], right=tables, share=0.36)

    def shape_figure(self) -> Block:
        """Return the shape function over the height of the column."""
        struck = self.calculation.struck
        largest = float(np.abs(struck.shape(np.linspace(*self._ends, 201))).max())
        return Figure(
            label="fig-shape",
            caption=("Shape function ", Tex(SYMBOLS["phi"].latex), ", 1 at the impact."),
            alt=f"Shape function over the height of the column: 1 at the impact, at most "
            f"{rounded(largest, 3)}.",
            svg=draw_shape_function(struck, self.system),
        )

    @property
    def _ends(self) -> tuple[float, float]:
        return self._pieces[0].part.bottom, self._pieces[-1].part.top

    def mass_of_column(self) -> Block:
        """Return how the equivalent mass compares with that of the column, in words."""
        column, mass = self.case.column, self.calculation.pier.mass
        share = mass / column.mass
        words = f"The equivalent mass is {rounded(share, 3)} times that of the column, "
        words += str(self.shown(column.mass, "mass"))
        if column.top_mass:
            words += f", without the {self.shown(column.top_mass, 'mass', given=True)} at its top"
        if share > 1.0:
            words += (
                ": most of what moves is above the impact and moves farther than it, so that the "
                "truck meets more than the whole column"
            )
        return Paragraph(f"{words}.")

    def parts(self) -> Block | None:
        """Return section properties, rigidities and mass per length of each part.

        None where the column is of one.
        """
        if self.case.column.uniform:
            return None
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
                    self.stretch(piece.part.bottom, piece.part.top),
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
                "Support forces and moments under a unit force at the impact (derived here). As a "
                "check, ",
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
                    words,
                    Tex(SYMBOLS[name].latex),
                    *self.shown(self._values[name], SYMBOLS[name].quantity),
                ]
                for name, words in _UNIT_FORCE.items()
            ],
        )

    def stiffness(self) -> Block:
        """Return the deflection at the impact as the work of parts and springs."""
        rows: list[list[Inline]] = [
            [
                self.stretch(piece.part.bottom, piece.part.top),
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
                    self.stretch(part.bottom, part.top),
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
                        rf"\frac{{1}}{{{SYMBOLS['xn'].latex}}} = \frac{{1}}{{{flexibility}}}"
                        f" = {stiffness}"
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
