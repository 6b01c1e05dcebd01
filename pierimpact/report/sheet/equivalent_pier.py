"""The equivalent pier: section, unit forces, stiffness, shape function, mass and frequency."""

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from pierimpact.design.reaction import HIGH_IMPACT_HEIGHT, LOW_IMPACT_HEIGHT, MUCH_SMALLER
from pierimpact.files.case import CONCRETE_FACTORS
from pierimpact.pier.arrangement import SUPPORTS
from pierimpact.pier.equivalent import equivalent_mass, vibration
from pierimpact.pier.sections import FreeSection
from pierimpact.pier.unit_force import BY_ENDS
from pierimpact.plots.elevation import draw_elevation
from pierimpact.plots.section import draw_section
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Ref, Tex, in_tex, inline, number_in_tex
from pierimpact.report.document.numbered import Equation, Figure, Steps, Table, columns, decimal
from pierimpact.report.document.step_writer import StepWriter
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import SYMBOLS
from pierimpact.units import Printed, printed, rounded, unit_size

_GIVEN = (
    *("D", "b", "h", "t", "Df", "ns", "Av", "alpha_E", "alpha_rho"),
    *("fc", "E", "nu", "rho", "psi", "EIe", "H", "z", "y", "zeta"),
)


class EquivalentPierSteps(Section):
    """The column as one degree of freedom, step by step."""

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the pier, by name."""
        blocks = (self.section(), *self._unit_force, self.mass())
        steps = [equation.label for block in blocks for equation in block.equations]
        others = dict.fromkeys(("height", "s", "phi"), "tab-shape")
        return {label.removeprefix("eq-"): label for label in steps} | others

    def impact_height(self) -> Block:
        """Return which nominal impact height is used, and why."""
        low, high = (self.stated(z, "length") for z in (LOW_IMPACT_HEIGHT, HIGH_IMPACT_HEIGHT))
        used = self.stated(self.calculation.struck.impact_height, "length", 5)  # all rests on it
        symbol, trial = Tex(SYMBOLS["z"].latex), self.calculation.trial
        if trial is None:
            return Paragraph(
                ("The nominal impact height ", symbol, f" = {used} is given by the case.")
            )
        engine = trial.engine_peak.reaction
        found = f"A trial at {low} gives an engine peak of {self.shown(engine, 'force')}"
        if trial.cargo_peak is None:
            found += " and no cargo peak"
        else:
            cargo = trial.cargo_peak.reaction
            ratio = rounded(cargo / engine, 3)
            found += f" and a cargo peak of {self.shown(cargo, 'force')}, {ratio} of it"
        return Paragraph(
            (
                "The case leaves the nominal impact height to the rule of the source paper: "
                f"{low} without cargo peak or with a much smaller one, else {high}. Much smaller "
                f"is taken as below {MUCH_SMALLER:g} of the engine peak, which is this project’s "
                f"figure. {found}: ",
                symbol,
                f" = {used}.",
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

    def elevation(self) -> Block:
        """Return the column in elevation, drawn to scale."""
        column = self.case.column
        base, top = (
            next((name for name, own in SUPPORTS.items() if own == support), "on springs")
            for support in column.supports
        )
        height = self.shown(column.height, "length", given=True)
        impact = self.stated(self.calculation.struck.impact_height, "length")
        return Figure(
            label="fig-elevation",
            caption="The column in elevation, to scale, and where it is struck.",
            alt=f"The column, {height} high, base {base}, top {top}; the truck comes from the left "
            f"and strikes at {impact}.",
            svg=draw_elevation(self.calculation.struck, self.system),
        )

    def parts(self) -> Block | None:
        """Return the parts of the column; None where it is of one."""
        return None

    def section_drawing(self) -> Block:
        """Return the section drawn to scale, with its dimensions."""
        section, shape = self.case.column.section, self.case.inputs.column_shape
        if isinstance(section, FreeSection):
            return Paragraph("The case gives the properties of the section, and not its shape.")
        place = " at its base" if self.case.column.steps else ""
        sizes = [
            f"{SYMBOLS[symbol].meaning} {self.shown(value, 'section length', given=True)}"
            for symbol, value in section.values.items()
            if symbol in section.dimensions.values()
            and SYMBOLS[symbol].quantity == "section length"
        ]
        return Figure(
            label="fig-section",
            caption=f"Section of the column{place}, {shape}, to scale.",
            alt=f"The section, {shape}: {', '.join(sizes)}. The truck comes from the left.",
            svg=draw_section(section, self.system),
        )

    def section(self) -> Steps:
        """Return area, rigidities and mass per length of the column."""
        writer, column = self._writer(), self.case.column
        section = column.section.calculation
        steps = section.steps(self._values, set(section.names) & {"A", "I", "kappa", "Am"})
        for calculation in column.calculations(column.section)[1:]:
            steps += calculation.steps(self._values, calculation.names)
        equations: list[Equation] = []
        for step in steps:
            if "U" in step.names:
                equations.append(self._shear_integral())
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

    def _shear_integral(self) -> Equation:
        """Return the integral of the shear stress where it has no closed form."""
        return Equation(
            label="eq-U",
            name=inline(SYMBOLS["U"].heading),
            symbol=SYMBOLS["U"].latex,
            lines=[in_tex(self._writer().shown("U"))],
            source="by numerical integration",
        )

    def _concrete_modulus(self) -> Equation:
        """Return the modulus by the formula of ACI 318, in the form for the units of the sheet."""
        unit = self.unit("root strength")
        factor = in_tex(Printed(rounded(CONCRETE_FACTORS[self.system], 5), unit))
        strength = self.shown(self._values["fc"], "root strength", given=True)

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

    def unit_forces(self) -> Block:
        """Return support forces and moments under a unit force at the impact height."""
        return self._unit_force[0]

    def stiffness(self) -> Block:
        """Return the deflection under the unit force, of flexure and shear, and the stiffness."""
        return self._unit_force[1]

    def shape(self) -> Block:
        """Return the shape function below and above the impact, as polynomials with their terms."""
        places = (("below", "b", "z / H"), ("above", "t", "(H - z) / H"))
        shapes = [
            Equation(
                label=f"eq-shape-{where}",
                name=f"Shape {where} the impact",
                symbol=SYMBOLS["phi"].latex,
                lines=[
                    self._polynomial(end, in_values=False),
                    self._polynomial(end, in_values=True)
                    + rf" \quad \text{{with }} s = {place}",
                ],
                source="Eq. 2 of the source paper",
            )
            for where, end, place in places
        ]  # fmt: skip
        return Steps([*self._unit_force[2].equations, *shapes])

    def _polynomial(self, end: str, *, in_values: bool) -> str:
        """Return φ in LaTeX, with the symbols of its coefficients or with their values."""
        text, values = "", self.calculation.struck.values
        for power in range(4):
            name = f"c{end}{power}"
            if name not in values:
                continue
            value = values[name]
            shown = SYMBOLS[name].latex
            if in_values:
                shown = number_in_tex(printed(abs(value), SYMBOLS[name].quantity, "SI"))
            sign = "-" if in_values and value < 0.0 else "+" if text else ""
            text += f"{sign} {shown}" + ("", r" \, s ")[power > 0] + f"^{power} " * (power > 1)
        return text

    def shape_table(self) -> Block:
        """Return ordinates of the shape function, four equal intervals on either side."""
        struck, height = self.calculation.struck, self.case.column.height
        below = np.linspace(0.0, struck.impact_height, 5)
        above = np.linspace(struck.impact_height, height, 5)
        simpson = np.array([1.0, 4.0, 2.0, 4.0, 1.0]) / 12.0
        check = sum(
            float((part[-1] - part[0]) * (simpson @ struck.shape(part) ** 2))
            for part in (below, above)
        )
        rows = [
            [self.number(z, "length"), *(self.number(phi**n, "ordinate") for n in (1, 2))]
            for z, phi in ((z, float(struck.shape(z))) for z in (*below, *above[1:]))
        ]
        integral = in_tex(self.shown(check, "length"))
        return Table(
            label="tab-shape",
            caption=(
                "Shape function. As a check, Simpson’s rule over these ordinates, part by part, "
                "gives ",
                Tex(r"\int \varphi^2 \, \mathrm{d}z = " + integral),
                ", to be compared with ",
                Ref("Eq.", "eq-phi2"),
                ".",
            ),
            columns=columns(
                decimal(("Height ", Tex("z"), f" [{self.unit('length')}]")),
                decimal(Tex(r"\varphi")),
                decimal(Tex(r"\varphi^2")),
            ),
            rows=rows,
        )

    def mass(self) -> Steps:
        """Return equivalent mass, frequency and damping."""
        writer = self._writer(quantities={"kp": "mass stiffness"})
        steps = equivalent_mass.steps(self._values, equivalent_mass.names)
        steps += vibration.steps(self._values, vibration.names)
        return Steps([*self._unit_force[3].equations, *map(writer.equation, steps)])

    @cached_property
    def _values(self) -> dict[str, float]:
        """The values of the column and the pier, by symbol."""
        strength = {"fc": self.case.inputs.concrete_strength or 0.0}
        return self.calculation.struck.values | self.calculation.pier.values | strength

    def _writer(
        self, *, units: bool = True, quantities: Mapping[str, str] | None = None
    ) -> StepWriter:
        return StepWriter(self._values, self.system, _GIVEN, units=units, quantities=quantities)

    @cached_property
    def _unit_force(self) -> list[Steps]:
        """The steps under the unit force: forces, stiffness, shape, and integrals of its square."""
        column, writer = self.case.column, self._writer(units=False)
        calculation = BY_ENDS[column.base, column.top]
        steps = calculation.steps(self._values, calculation.names)
        return [
            Steps([writer.equation(step) for step in part])
            for part in calculation.split(steps, "xfb", "sb", "phi2b")
        ]
