"""The pier's values step by step: symbol, formula, substitution and result of each."""

from collections.abc import Iterator

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from pierimpact.calculation import Calculation
from pierimpact.sections import CircularSection
from pierimpact.sheet.markup import Inline, Tex, in_tex, number_in_tex
from pierimpact.sheet.numbered import Column, Equation, Steps, Table
from pierimpact.sheet.step_writer import StepWriter, Value
from pierimpact.units import printed, unit_of


def _writer(calculation: Calculation) -> StepWriter:
    return StepWriter(_values(calculation), calculation.case.inputs.units)


def _values(calculation: Calculation) -> dict[str, Value]:
    column, struck, pier = calculation.case.column, calculation.struck, calculation.pier
    section, forces = column.section, struck.unit_forces
    concrete_strength = calculation.case.inputs.concrete_strength or 0.0
    coefficients = struck.shape_coefficients[0]
    square = polynomial.polyint(polynomial.polymul(coefficients, coefficients))
    below = column.height * float(polynomial.polyval(struck.impact_height / column.height, square))
    moments = forces.base_moment, forces.impact_moment
    squares = moments[0] ** 2 + moments[0] * moments[1] + moments[1] ** 2
    flexure_below = struck.impact_height * squares / (3.0 * column.flexural_rigidity)
    freed, own = _freed_deflections(calculation)
    sizes = (
        {"D": Value("D", section.diameter, "section length", True)}
        if isinstance(section, CircularSection)
        else {
            "b": Value("b", section.width, "section length", True),
            "h": Value("h", section.depth, "section length", True),
        }
    )
    return sizes | {
        "A": Value("A", section.area, "area"),
        "I": Value("I", section.second_moment, "second moment"),
        "kappa": Value(r"\kappa", section.shear_coefficient, "share", True),
        "fc": Value(r"f_\mathrm{c}'", concrete_strength / 1e6, "ratio", True),
        "E": Value("E", column.elastic_modulus, "modulus", True),
        "nu": Value(r"\nu", column.poisson_ratio, "ratio", True),
        "G": Value("G", column.shear_modulus, "modulus"),
        "EI": Value("EI", column.flexural_rigidity, "flexural rigidity"),
        "GA": Value(r"\kappa GA", column.shear_rigidity, "shear rigidity"),
        "rho": Value(r"\rho", column.density, "density", True),
        "m": Value(r"\bar m", column.mass_per_length, "mass per length"),
        "H": Value("H", column.height, "length", True),
        "z": Value(r"z_\mathrm{n}", struck.impact_height, "length", True),
        "y": Value(r"(H - z_\mathrm{n})", column.height - struck.impact_height, "length", True),
        "Rb": Value(r"R_\mathrm{b}", forces.base_force, "share"),
        "Rt": Value(r"R_\mathrm{t}", forces.top_force, "share"),
        "Mb": Value(r"M_\mathrm{b}", forces.base_moment, "length"),
        "Mn": Value(r"M_\mathrm{n}", forces.impact_moment, "length"),
        "Mt": Value(r"M_\mathrm{t}", forces.top_moment, "length"),
        "freed": Value(r"\delta_\mathrm{n}", freed, "flexibility"),
        "own": Value(r"\delta_\mathrm{e}", own, "flexibility"),
        "xf_below": Value(r"x_\mathrm{f,b}", flexure_below, "flexibility"),
        "xf_above": Value(
            r"x_\mathrm{f,t}", struck.flexural_deflection - flexure_below, "flexibility"
        ),
        "xs": Value(r"x_\mathrm{s}", struck.shear_deflection, "flexibility"),
        "xn": Value(r"x(z_\mathrm{n})", struck.impact_deflection, "flexibility"),
        "kp": Value(r"k_\mathrm{p}", pier.stiffness, "stiffness"),
        "kp_mass": Value(r"k_\mathrm{p}", pier.stiffness, "mass stiffness"),
        "phi2_below": Value(r"\int_0^{z_\mathrm{n}} \varphi^2 \, \mathrm{d}z", below, "length"),
        "phi2_above": Value(
            r"\int_{z_\mathrm{n}}^H \varphi^2 \, \mathrm{d}z",
            struck.shape_integral - below,
            "length",
        ),
        "phi2": Value(r"\int_0^H \varphi^2 \, \mathrm{d}z", struck.shape_integral, "length"),
        "mp": Value(r"m_\mathrm{p}", pier.mass, "mass"),
        "fp": Value(r"f_\mathrm{p}", pier.frequency, "frequency"),
        "zeta": Value(r"\zeta", pier.damping_ratio, "ratio", True),
        "cp": Value(r"c_\mathrm{p}", pier.damping, "damping"),
    }


def _freed_deflections(calculation: Calculation) -> tuple[float, float]:
    """Return the deflections of a freed end as in `_TOP`; their ratio is its force [m/N]."""
    column, forces = calculation.case.column, calculation.struck.unit_forces
    bending = 12.0 if column.base == column.top == "fixed" else 3.0
    own = column.height**3 / (bending * column.flexural_rigidity)
    own += column.height / column.shear_rigidity
    return own * (forces.base_force if column.base == "pinned" else forces.top_force), own


def section_steps(calculation: Calculation) -> Steps:
    """Return area, rigidities and mass per length of the column."""
    step = _writer(calculation).step
    circular = isinstance(calculation.case.column.section, CircularSection)
    steps = [
        step("Area", "A", r"\frac{\pi <D>^2}{4}" if circular else "<b> <x> <h>"),
        step(
            "Second moment of area",
            "I",
            r"\frac{\pi <D>^4}{64}" if circular else r"\frac{<b> <x> <h>^3}{12}",
        ),
        step("Flexural rigidity", "EI", "<E> <x> <I>"),
        step("Shear modulus", "G", r"\frac{<E>}{2 \, (1 + <nu>)}"),
        step(
            "Shear rigidity",
            "GA",
            "<kappa> <x> <G> <x> <A>",
            source="κ = 0.9 of a circle" if circular else "κ = 5/6 of a rectangle",
        ),
        step("Mass per length", "m", "<rho> <x> <A>"),
    ]
    if calculation.case.inputs.concrete_strength is not None:
        modulus = step(
            "Elastic modulus of the concrete, both in MPa",
            "E",
            r"4700 \sqrt{<fc>}\ \text{MPa}",
            source="as in ACI 318, from memory; unverified: check against the standard",
        )
        steps.insert(0, modulus)
    return Steps(steps)


def unit_force_steps(calculation: Calculation) -> Steps:
    """Return support forces and moments under a unit force at the impact height.

    Force and moment at the top follow from what the top is, or from what cannot move; the
    others from equilibrium. Derived here by integrating M/EI and V/κGA over the column.
    """
    write, column = _writer(calculation), calculation.case.column
    top = [
        write.step(name, result, formula, units=False, source=source)
        for name, result, formula, source in _TOP[column.base, column.top]
    ]
    rest = [
        ("Force at the base", "Rb", "1 - <Rt>"),
        ("Moment at the base", "Mb", "<Mt> + <Rt> <x> <H> - <z>"),
        ("Moment at the impact", "Mn", "<Mt> + <Rt> <x> <y>"),
    ]
    return Steps(
        [
            *top,
            *(write.step(*step, units=False, source="equilibrium") for step in rest),
        ]
    )


# Deflection of the freed end under the unit force, and under a unit force of its own.
_FREED = "with the end freed, under the unit force at the impact"
_FREED_OWN = "with the end freed, under a unit force there"
_OWN = r"\frac{<H>^3}{3 <x> <EI>} + \frac{<H>}{<GA>}"
# By base and top: the steps to force and moment at the top.
_TOP = {
    ("fixed", "free"): [
        ("Force at the top", "Rt", "0", "free top"),
        ("Moment at the top", "Mt", "0", "free top"),
    ],
    ("free", "fixed"): [
        ("Force at the top", "Rt", "1", "nothing holds the base"),
        ("Moment at the top", "Mt", "<z> - <Rt> <x> <H>", "no moment at the base"),
    ],
    ("pinned", "pinned"): [
        ("Force at the top", "Rt", r"\frac{<z>}{<H>}", "equilibrium"),
        ("Moment at the top", "Mt", "0", "pinned top"),
    ],
    ("fixed", "pinned"): [
        (
            "Deflection of the top",
            "freed",
            r"\frac{<z>^2 \, (3 <x> <H> - <z>)}{6 <x> <EI>} + \frac{<z>}{<GA>}",
            _FREED,
        ),
        ("Deflection of the top", "own", _OWN, _FREED_OWN),
        ("Force at the top", "Rt", r"\frac{<freed>}{<own>}", "the top stays in place"),
        ("Moment at the top", "Mt", "0", "pinned top"),
    ],
    ("pinned", "fixed"): [
        (
            "Deflection of the base",
            "freed",
            r"\frac{<y>^2 \, (2 <x> <H> + <z>)}{6 <x> <EI>} + \frac{<y>}{<GA>}",
            _FREED,
        ),
        ("Deflection of the base", "own", _OWN, _FREED_OWN),
        ("Force at the top", "Rt", r"1 - \frac{<freed>}{<own>}", "the base stays in place"),
        ("Moment at the top", "Mt", "<z> - <Rt> <x> <H>", "no moment at the base"),
    ],
    ("fixed", "fixed"): [
        (
            "Deflection of the top",
            "freed",
            r"\frac{<z>^2 \, (3 <x> <H> - 2 <x> <z>)}{12 <x> <EI>} + \frac{<z>}{<GA>}",
            _FREED + ", but not to turn",
        ),
        (
            "Deflection of the top",
            "own",
            r"\frac{<H>^3}{12 <x> <EI>} + \frac{<H>}{<GA>}",
            _FREED_OWN + ", but not to turn",
        ),
        ("Force at the top", "Rt", r"\frac{<freed>}{<own>}", "the top stays in place"),
        (
            "Moment at the top",
            "Mt",
            r"\frac{<z>^2}{2 <x> <H>} - \frac{<Rt> <x> <H>}{2}",
            "the top does not turn",
        ),
    ],
}


def stiffness_steps(calculation: Calculation) -> Steps:
    """Return the deflection under the unit force, of flexure and shear, and the stiffness."""
    step = _writer(calculation).step
    return Steps(
        [
            step(
                "Deflection by flexure below the impact",
                "xf_below",
                r"\frac{<z> \left( <Mb>^2 + <Mb> <x> <Mn> + <Mn>^2 \right)}{3 <x> <EI>}",
                units=False,
                source="integral of M²/EI",
            ),
            step(
                "Deflection by flexure above the impact",
                "xf_above",
                r"\frac{<y> \left( <Mn>^2 + <Mn> <x> <Mt> + <Mt>^2 \right)}{3 <x> <EI>}",
                units=False,
                source="integral of M²/EI",
            ),
            step(
                "Deflection by shear",
                "xs",
                r"\frac{<z> <x> <Rb>^2 + <y> <x> <Rt>^2}{<GA>}",
                units=False,
                source="integral of V²/κGA",
            ),
            step("Deflection at the impact", "xn", "<xf_below> + <xf_above> + <xs>", units=False),
            step("Stiffness", "kp", r"\frac{1}{<xn>}", source="Eq. 3 of the source paper"),
        ]
    )


def shape_steps(calculation: Calculation) -> Steps:
    """Return the shape function below and above the impact, as polynomials."""
    below, above = calculation.struck.shape_coefficients
    return Steps(
        [
            Equation(
                label="eq-shape-below",
                name="Shape below the impact",
                symbol=r"\varphi",
                lines=[rf"{_polynomial(below)} \quad \text{{with }} s = z / H"],
                source="Eq. 2 of the source paper",
            ),
            Equation(
                label="eq-shape-above",
                name="Shape above the impact",
                symbol=r"\varphi",
                lines=[rf"{_polynomial(above)} \quad \text{{with }} s = (H - z) / H"],
                source="Eq. 2 of the source paper",
            ),
        ]
    )


def _polynomial(coefficients: NDArray[np.float64]) -> str:
    """Return a polynomial in s as LaTeX, without the terms that are zero."""
    text = ""
    for power, coefficient in enumerate(coefficients.tolist()):
        if abs(coefficient) > 1e-9 * np.max(np.abs(coefficients)):
            sign = "-" if coefficient < 0.0 else "+" if text else ""
            text += f"{sign} {number_in_tex(printed(abs(coefficient), 'share', 'SI'))}"
            text += f" \\, s^{power} " if power > 1 else " \\, s " if power else " "
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
    step = _writer(calculation).step
    return Steps(
        [
            step(
                "Integral, of the polynomials exactly",
                "phi2",
                "<phi2_below> + <phi2_above>",
            ),
            step("Equivalent mass", "mp", "<m> <x> <phi2>", source="Eq. 1 of the source paper"),
            step("Frequency", "fp", r"\frac{1}{2 \pi} \sqrt{\frac{<kp_mass>}{<mp>}}"),
            step("Damping coefficient", "cp", r"2 <x> <zeta> \sqrt{<kp_mass> <x> <mp>}"),
        ]
    )


def symbols_of_pier(calculation: Calculation) -> Iterator[tuple[Tex, Inline]]:
    """Yield symbol and meaning of the values of the pier."""
    for steps in (section_steps, unit_force_steps, stiffness_steps, mass_steps):
        for equation in steps(calculation).equations:
            name = str(equation.name)
            yield Tex(equation.symbol), name[0].lower() + name[1:]
