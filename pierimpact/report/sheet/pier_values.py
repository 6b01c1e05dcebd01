"""The pier's values as its steps print them, with symbol and kind of quantity."""

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from pierimpact.pier.sections import CircularSection
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.step_writer import StepWriter, Value


def pier_writer(calculation: Calculation) -> StepWriter:
    """Return the writer of steps between values of the pier."""
    return StepWriter(_values(calculation), calculation.case.inputs.units)


def _values(calculation: Calculation) -> dict[str, Value]:
    column, struck, pier = calculation.case.column, calculation.struck, calculation.pier
    section, forces = column.section, struck.unit_forces
    concrete_strength = calculation.case.inputs.concrete_strength or 0.0
    below = _integral(struck.shape_coefficients[0], struck.impact_height / column.height)
    below *= column.height
    moments = forces.base_moment, forces.impact_moment
    squares = moments[0] ** 2 + moments[0] * moments[1] + moments[1] ** 2
    flexure_below = struck.impact_height * squares / (3.0 * column.flexural_rigidity)
    freed, own = _freed_deflections(calculation)
    shares = struck.impact_height / column.height, 1.0 - struck.impact_height / column.height
    shape = {
        f"{end}{power}": Value(rf"c_\mathrm{{{end}{power}}}", coefficient, "share")
        for end, coefficients in zip("bt", struck.shape_coefficients.tolist(), strict=True)
        for power, coefficient in enumerate(coefficients)
    }
    sizes = (
        {"D": Value("D", section.diameter, "section length", True)}
        if isinstance(section, CircularSection)
        else {
            "b": Value("b", section.width, "section length", True),
            "h": Value("h", section.depth, "section length", True),
        }
    )
    return {
        **sizes,
        **shape,
        "sb": Value(r"s_\mathrm{b}", shares[0], "share"),
        "st": Value(r"s_\mathrm{t}", shares[1], "share"),
        "A": Value("A", section.area, "area"),
        "I": Value("I", section.second_moment, "second moment"),
        "kappa": Value(r"\kappa", section.shear_coefficient, "share", True),
        "fc": Value(r"f_\mathrm{c}'", concrete_strength, "strength", True),
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


def _integral(coefficients: NDArray[np.float64], end: float) -> float:
    """Return the integral of the square of a polynomial from zero to `end`."""
    square = polynomial.polymul(coefficients, coefficients)
    return float(polynomial.polyval(end, polynomial.polyint(square)))


def _freed_deflections(calculation: Calculation) -> tuple[float, float]:
    """Return the deflections of a freed end as in `_TOP`; their ratio is its force [m/N]."""
    column, forces = calculation.case.column, calculation.struck.unit_forces
    bending = 12.0 if column.base == column.top == "fixed" else 3.0
    own = column.height**3 / (bending * column.flexural_rigidity)
    own += column.height / column.shear_rigidity
    return own * (forces.base_force if column.base == "pinned" else forces.top_force), own
