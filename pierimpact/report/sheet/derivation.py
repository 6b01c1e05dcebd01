"""Annex: the section, and the closed formulas of a uniform column under the unit force."""

from functools import cached_property

import numpy as np

from pierimpact.pier.equivalent import equivalent_mass
from pierimpact.pier.unit_force import BY_ENDS
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Ref, Tex, in_tex, inline, number_in_tex
from pierimpact.report.document.numbered import Equation, Steps, Table, columns, decimal
from pierimpact.report.sheet.equivalent_pier import PierSection
from pierimpact.symbols import SYMBOLS
from pierimpact.units import printed


class Derivation(PierSection):
    """How the values of a uniform column come about; any other has its relations here.

    Examples
    --------
    >>> from pierimpact.files.case import case_from, read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(case_from(file.values | {"annexes": ["pier"]}))
    >>> sheet.derivation.ordinates().rows[4]  # height [m], shape function and its square there
    ['1.2000', '1.000', '1.000']
    """

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the derivation, by name."""
        blocks = [block for block in (self.section(), *self._unit_force) if block]
        steps = [equation.label for block in blocks for equation in block.equations]
        # A coefficient that is given stands first where it is used.
        return {"kappa": "eq-GA"} | {label.removeprefix("eq-"): label for label in steps}

    def section(self) -> Steps | None:
        """Return what the shear coefficient of the section rests on; None where it is given."""
        section = self.case.column.section.calculation
        printed_before = {step.name for step in section.steps(self._values, self.section_names)}
        steps = section.steps(self._values, set(section.names) & {"kappa"})
        writer, equations = self._writer(), []
        for step in steps:
            if step.name in printed_before:
                continue
            if "U" in step.names:
                equations.append(self._shear_integral())
            equations.append(writer.equation(step))
        return Steps(equations) if equations else None

    def _shear_integral(self) -> Equation:
        """Return the integral of the shear stress where it has no closed form."""
        return Equation(
            label="eq-U",
            name=inline(SYMBOLS["U"].heading),
            symbol=SYMBOLS["U"].latex,
            lines=[in_tex(self._writer().shown("U"))],
            source="by numerical integration",
        )

    def unit_forces(self) -> Block:
        """Return support forces and moments under a unit force at the impact height.

        Where the column is not uniform, the relations that lead from its base to its top.
        """
        return self._part(0) or Paragraph(
            (
                "Closed formulas stand for a column of one section between rigid ends. This one is "
                "followed part by part, with the values of ",
                Ref("Table", "tab-parts"),
                " and of its springs: with ",
                Tex("s"),
                " upward from the lower end of a part, where the values have the index 0, the "
                "shear is constant and ",
                Tex(r"M = M_0 + V s"),
                ", ",
                Tex(r"\theta = \theta_0 - (M_0 s + V s^2/2) / EI"),
                ", ",
                Tex(
                    r"x = x_0 + \theta_0 s - (M_0 s^2/2 + V s^3/6) / EI + V s / \kappa GA",
                ),
                ". A support leaves two of deflection ",
                Tex("x"),
                ", rotation ",
                Tex(r"\theta"),
                ", shear ",
                Tex("V"),
                " and moment ",
                Tex("M"),
                " unknown; at the impact the shear drops by the force, and the others pass on. "
                "These are four equations for four unknowns, solved as they stand. To check them, "
                "begin at the base with what ",
                Ref("Table", "tab-unit-force"),
                " and its support give, and walk up: what arrives at the top must be what its "
                "support allows. An end that turns or moves freely leaves ",
                Tex(r"\theta_0"),
                " or ",
                Tex("x_0"),
                " to be what makes it so.",
            )
        )

    def stiffness(self) -> Steps | None:
        """Return the deflection under the unit force, of flexure and shear."""
        return self._part(1)

    def shape(self) -> Steps | None:
        """Return the shape function below and above the impact, as polynomials with their terms."""
        found = self._part(2)
        if found is None:
            return None
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
        return Steps([*found.equations, *shapes])

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

    def ordinates(self) -> Block | None:
        """Return ordinates of the shape function; None where the column is not uniform."""
        if not self.case.column.uniform:
            return None
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
            label="tab-ordinates",
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

    def mass(self) -> Steps | None:
        """Return the integral of the squared shape function."""
        found = self._part(3)
        if found is None:
            return None
        steps = equivalent_mass.steps(self._values, {"phi2"})
        return Steps([*found.equations, *map(self._writer().equation, steps)])

    def _part(self, part: int) -> Steps | None:
        return self._unit_force[part] if self._unit_force else None

    @cached_property
    def _unit_force(self) -> list[Steps]:
        """The steps under the unit force: forces, stiffness, shape, and integrals of its square.

        None where the column is not uniform.
        """
        column, writer = self.case.column, self._writer(units=False)
        if not column.uniform:
            return []
        calculation = BY_ENDS[column.base, column.top]
        steps = [
            step
            for step in calculation.steps(self._values, calculation.names)
            if step.name != "kp"  # printed with the pier itself
        ]
        return [
            Steps([writer.equation(step) for step in part])
            for part in calculation.split(steps, "xfb", "sb", "phi2b")
        ]
