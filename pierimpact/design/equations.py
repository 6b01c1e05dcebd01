r"""The design procedure as a checker reads it: symbol, equation and unit of every value.

A formula is LaTeX with names in angle brackets, those of `procedure` and of GIVEN:
`\frac{<plateau_push>}{<kp>}`. Put in their symbols and it is the equation, put in the values
printed before it and it is the calculation. A product of them is written with `<x>`.
"""

import re
from typing import NamedTuple

from pierimpact.collision.parameters import Parameters
from pierimpact.design import cargo_equations, engine_equations
from pierimpact.design.terms import Equation


class DesignStep(NamedTuple):
    """One value of the procedure.

    What it is, its symbol and equation in LaTeX, its unit and value in SI, and the formula that
    the equation was made from, with names in angle brackets. What is given has no equation.
    """

    name: str
    meaning: str
    symbol: str
    equation: str
    unit: str
    value: float
    formula: str


#: What the procedure starts from.
GIVEN = {
    "V": ("speed of the truck at first touch", "V", "m/s"),
    "m1": ("mass of the engine", "m_1", "kg"),
    "P1": ("plateau force of the engine’s spring", "P_1", "N"),
    "d1": ("plateau length of the engine’s spring", "d_1", "m"),
    "k1": ("stiffness of the engine’s spring", "k_1", "N/m"),
    "ku1": ("unloading stiffness of the engine’s spring", r"k_{\mathrm{u}1}", "N/m"),
    "m2": ("mass of the body", "m_2", "kg"),
    "P2": ("plateau force of the body’s spring", "P_2", "N"),
    "d2": ("plateau length of the body’s spring", "d_2", "m"),
    "k2": ("stiffness of the body’s spring", "k_2", "N/m"),
    "ku2": ("unloading stiffness of the body’s spring", r"k_{\mathrm{u}2}", "N/m"),
    "cs": ("friction force on the body", r"c_\mathrm{s}", "N"),
    "mp": ("equivalent mass of the pier", r"m_\mathrm{p}", "kg"),
    "kp": ("stiffness of the pier", r"k_\mathrm{p}", "N/m"),
    "zeta": ("damping ratio of the pier", r"\zeta", "-"),
}


def equations(values: dict[str, float], level: str, on_pier: bool) -> dict[str, Equation]:
    """Return the equations that apply to one collision, by name and in order."""
    hand = level == "hand"
    table = engine_equations.plateau(on_pier) | engine_equations.engine_contact(hand)
    table |= engine_equations.engine_blow(values, hand)
    if hand:
        return table | cargo_equations.cargo_by_hand(values)
    table |= engine_equations.ringing(values) | cargo_equations.cargo_contact(values)
    table |= engine_equations.engine_cut_short(values)
    return table | cargo_equations.cargo_modes() if values["cargo_speed"] > 0.0 else table


def given(case: Parameters, damping_ratio: float) -> tuple[DesignStep, ...]:
    """Return what the procedure starts from: truck, pier and speed."""
    numbers = (
        case.speed,
        *case.engine,
        *case.body,
        case.friction_force,
        case.pier_mass,
        case.pier_stiffness,
        damping_ratio,
    )
    return tuple(
        DesignStep(name, meaning, symbol, "", unit, value, "")
        for (name, (meaning, symbol, unit)), value in zip(GIVEN.items(), numbers, strict=True)
    )


def steps(values: dict[str, float], level: str, on_pier: bool) -> tuple[DesignStep, ...]:
    """Return the values of the procedure that apply, in order, each with its equation."""
    table = equations(values, level, on_pier)
    symbols = {name: symbol for name, (_, symbol, _) in GIVEN.items()}
    symbols |= {name: equation.symbol for name, equation in table.items()}

    def in_symbols(formula: str) -> str:
        return re.sub(r"<(\w+)>", lambda name: symbols[name[1]], formula.replace("<x>", r"\,"))

    return tuple(
        DesignStep(name, meaning, symbol, in_symbols(formula), unit, values[name], formula)
        for name, (meaning, symbol, formula, unit) in table.items()
    )
