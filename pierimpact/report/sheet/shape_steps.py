"""Shape function, equivalent mass and frequency of the pier, step by step."""

import numpy as np

from pierimpact.report.calculation import Calculation
from pierimpact.report.document.markup import Ref, Tex, in_tex, number_in_tex
from pierimpact.report.document.numbered import Column, Equation, Steps, Table
from pierimpact.report.document.step_writer import StepWriter
from pierimpact.report.sheet.pier_values import pier_writer
from pierimpact.units import printed, unit_of


def shape_steps(calculation: Calculation) -> Steps:
    """Return the shape function below and above the impact, as polynomials with their terms."""
    writer, column = pier_writer(calculation), calculation.case.column
    parts = (("below", "b", column.base), ("above", "t", column.top))
    terms = [
        writer.step(
            f"Shape {where} the impact, {words}",
            f"{end}{index}",
            _COEFFICIENTS[kind][index].replace("END", end).replace("OTHER", "bt".replace(end, "")),
            units=False,
            source=source,
        )
        # A free end follows the other part, and comes after it.
        for where, end, kind in sorted(parts, key=lambda part: part[2] == "free")
        for index, words, source in _TERMS[kind]
    ]
    shares = [
        writer.step("Place of the impact, from the base", "sb", r"\frac{<z>}{<H>}", units=False),
        writer.step("Place of the impact, from the top", "st", r"\frac{<y>}{<H>}", units=False),
    ]
    shapes = [
        Equation(
            label=f"eq-shape-{where}",
            name=f"Shape {where} the impact",
            symbol=r"\varphi",
            lines=[
                _polynomial(writer, end, [index for index, _, _ in _TERMS[kind]], False),
                _polynomial(writer, end, [index for index, _, _ in _TERMS[kind]], True)
                + rf" \quad \text{{with }} s = {place}",
            ],
            source="Eq. 2 of the source paper",
        )
        for (where, end, kind), place in zip(parts, ("z / H", "(H - z) / H"), strict=True)
    ]
    return Steps([*shares, *terms, *shapes])


# Coefficients of φ by the condition of the end that s starts from, and by power of s. END is b at
# the base and t at the top, OTHER the other of the two.
_BENT = {
    2: r"-\frac{<MEND> <x> <H>^2}{2 <x> <EI> <x> <xn>}",
    3: r"-\frac{<REND> <x> <H>^3}{6 <x> <EI> <x> <xn>}",
}
_COEFFICIENTS = {
    "fixed": {1: r"\frac{<REND> <x> <H>}{<GA> <x> <xn>}", **_BENT},
    "pinned": {1: r"\frac{1 - <END3> <x> <sEND>^3}{<sEND>}", **_BENT},
    "free": {
        1: "-2 <x> <OTHER2> <x> <sOTHER> - 3 <x> <OTHER3> <x> <sOTHER>^2",
        0: "1 - <END1> <x> <sEND>",
    },
}
# What terms there are, in the order in which they follow, and where they are from.
_TERMS = {
    "fixed": (
        (2, "coefficient of $s^2$", "moment at the end"),
        (3, "coefficient of $s^3$", "force at the end"),
        (1, "coefficient of $s$", "shear at the end, which does not turn"),
    ),
    "pinned": (
        (3, "coefficient of $s^3$", "force at the end"),
        (1, "coefficient of $s$", "1 at the impact"),
    ),
    "free": (
        (1, "coefficient of $s$", "straight on from the other part"),
        (0, "constant", "1 at the impact"),
    ),
}


def _polynomial(writer: StepWriter, end: str, powers: list[int], values: bool) -> str:
    """Return φ in LaTeX, with the symbols of its coefficients or with their values."""
    text = ""
    for power in sorted(powers):
        symbol, value, quantity, _ = writer.values[f"{end}{power}"]
        shown = number_in_tex(printed(abs(value), quantity, "SI")) if values else symbol
        sign = "-" if values and value < 0.0 else "+" if text else ""
        text += f"{sign} {shown}" + (rf" \, s^{power} " if power > 1 else r" \, s " * power)
    return text


def shape_table(calculation: Calculation) -> Table:
    """Return ordinates of the shape function, four equal intervals below and above the impact."""
    struck, system = calculation.struck, calculation.case.inputs.units
    height, impact = calculation.case.column.height, struck.impact_height
    below, above = np.linspace(0.0, impact, 5), np.linspace(impact, height, 5)
    simpson = np.array([1.0, 4.0, 2.0, 4.0, 1.0]) / 12.0
    check = sum(
        float((part[-1] - part[0]) * (simpson @ struck.shape(part) ** 2)) for part in (below, above)
    )
    rows = [
        [
            printed(z, "length", system).number,
            printed(float(phi), "ordinate", system).number,
            printed(float(phi) ** 2, "ordinate", system).number,
        ]
        for z, phi in ((z, struck.shape(z)) for z in (*below.tolist(), *above[1:].tolist()))
    ]
    return Table(
        label="tab-shape",
        caption=(
            "Shape function. As a check, Simpson’s rule over these ordinates, part by part, makes ",
            Tex(r"\int \varphi^2 \, \mathrm{d}z = " + in_tex(printed(check, "length", system))),
            ", to be set against ",
            Ref("Eq.", "eq-phi2"),
            ".",
        ),
        columns=[
            Column(
                heading=("Height ", Tex("z"), f" [{unit_of('length', system)}]"), align="decimal"
            ),
            Column(heading=Tex(r"\varphi"), align="decimal"),
            Column(heading=Tex(r"\varphi^2"), align="decimal"),
        ],
        rows=rows,
    )


def mass_steps(calculation: Calculation) -> Steps:
    """Return equivalent mass, frequency and damping."""
    step = pier_writer(calculation).step
    return Steps(
        [
            *(
                step(
                    f"Integral {where} the impact",
                    f"phi2_{where}",
                    (_STRAIGHT if kind == "free" else _CUBIC[kind]).replace("END", end),
                    units=False,
                    source="of the squared polynomial, exactly",
                )
                for where, end, kind in (
                    ("below", "b", calculation.case.column.base),
                    ("above", "t", calculation.case.column.top),
                )
            ),
            step("Integral over the column", "phi2", "<phi2_below> + <phi2_above>"),
            step("Equivalent mass", "mp", "<m> <x> <phi2>", source="Eq. 1 of the source paper"),
            step("Frequency", "fp", r"\frac{1}{2 \pi} \sqrt{\frac{<kp_mass>}{<mp>}}"),
            step("Damping coefficient", "cp", r"2 <x> <zeta> \sqrt{<kp_mass> <x> <mp>}"),
        ]
    )


# The integral of φ² over one part, by the condition of its end; END as above.
_STRAIGHT = (
    r"<H> <x> \left[<END0>^2 <x> <sEND> + <END0> <x> <END1> <x> <sEND>^2"
    r" + \frac{<END1>^2 <x> <sEND>^3}{3}\right]"
)
_CUBIC = {
    "fixed": r"<H> <x> \left[\frac{<END1>^2 <x> <sEND>^3}{3}"
    r" + \frac{<END1> <x> <END2> <x> <sEND>^4}{2}"
    r" + \frac{(<END2>^2 + 2 <x> <END1> <x> <END3>) <x> <sEND>^5}{5}"
    r" + \frac{<END2> <x> <END3> <x> <sEND>^6}{3} + \frac{<END3>^2 <x> <sEND>^7}{7}\right]",
    "pinned": r"<H> <x> \left[\frac{<END1>^2 <x> <sEND>^3}{3}"
    r" + \frac{2 <x> <END1> <x> <END3> <x> <sEND>^5}{5} + \frac{<END3>^2 <x> <sEND>^7}{7}\right]",
}
