"""The tables of what a calculation starts from, with source and status of each value."""

import re
from collections.abc import Iterator

from pierimpact.files.inputs import PHYSICAL_KEYS
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Block
from pierimpact.report.document.markup import Inline, Tex, in_a_sentence
from pierimpact.report.document.numbered import Column, Table
from pierimpact.units import printed

# Name, symbol and kind of quantity of the keys of a case file; no kind where the value is a word.
_INPUTS = {
    "column_shape": ("Shape of the section", "", ""),
    "base": ("Base of the column", "", ""),
    "top": ("Top of the column", "", ""),
    "column_diameter": ("Column diameter", "D", "section length"),
    "column_width": ("Column width, across the travel", "b", "section length"),
    "column_depth": ("Column depth, along the travel", "h", "section length"),
    "column_height": ("Column height", "H", "length"),
    "elastic_modulus": ("Elastic modulus", "E", "modulus"),
    "concrete_strength": ("Concrete strength", r"f_\mathrm{c}'", "strength"),
    "poisson_ratio": ("Poisson’s ratio", r"\nu", "ratio"),
    "density": ("Density", r"\rho", "density"),
    "truck_mass": ("Total mass of the truck", "m_1 + m_2", "mass"),
    "speed": ("Speed at first touch", "V", "speed"),
    "impact_height": ("Nominal impact height", r"z_\mathrm{n}", "length"),
    "damping_ratio": ("Damping ratio of the pier", r"\zeta", "ratio"),
    "shear_resistance": ("Resistance to shear", r"V_\mathrm{R}", "force"),
    "moment_resistance": ("Resistance to moment", r"M_\mathrm{R}", "moment"),
}

_TRUCK_PARAMETERS = {
    "engine_mass": ("Engine mass", "m_1", "mass"),
    "body_mass": ("Mass of body and cargo", "m_2", "mass"),
    "friction_force": ("Friction on the body", r"c_\mathrm{s}", "force"),
    "friction_on": ("Friction acts against the", "", ""),
    "engine_spring.plateau_force": ("Engine spring: plateau force", "P_1", "force"),
    "engine_spring.plateau_length": ("Engine spring: plateau length", "d_1", "length"),
    "engine_spring.stiffness": ("Engine spring: steep stiffness", "k_1", "stiffness"),
    "engine_spring.unloading_stiffness": (
        "Engine spring: unloading stiffness",
        r"k_{\mathrm{u}1}",
        "stiffness",
    ),
    "body_spring.plateau_force": ("Body spring: plateau force", "P_2", "force"),
    "body_spring.plateau_length": ("Body spring: plateau length", "d_2", "length"),
    "body_spring.stiffness": ("Body spring: steep stiffness", "k_2", "stiffness"),
    "body_spring.unloading_stiffness": (
        "Body spring: unloading stiffness",
        r"k_{\mathrm{u}2}",
        "stiffness",
    ),
}


def inputs_table(calculation: Calculation) -> Block:
    """Return what the case gives, with source and status."""
    rows = [_input_row(calculation, key) for key in _INPUTS if key in _shown_keys(calculation)]
    return Table(
        label="tab-inputs",
        caption="Inputs of the case.",
        columns=[
            Column(heading="Input"),
            Column(heading="Symbol"),
            Column(heading="Value", align="decimal"),
            Column(heading="Unit"),
            Column(heading="Status"),
            Column(heading="Source", wide=True),
        ],
        rows=rows,
    )


def _shown_keys(calculation: Calculation) -> Iterator[str]:
    inputs = calculation.case.inputs
    for key in PHYSICAL_KEYS:
        if getattr(inputs, key) is not None or key == "truck_mass":
            yield key


def _input_row(calculation: Calculation, key: str) -> list[Inline]:
    case = calculation.case
    name, symbol, quantity = _INPUTS[key]
    value = getattr(case.inputs, key)
    status, source = "given", case.inputs.sources.get(key, "case file")
    if key in case.inputs.assumed:
        status, source = "assumed", case.inputs.assumed[key]
    elif key not in case.given:
        status, source = "default", "pierimpact"
    if value is None:  # the mass is the truck's own
        value, status, source = case.truck.mass, "given", f"truck file {case.truck_file.file_name}"
    if isinstance(value, str):
        word = "by the rule" if value == "auto" else value
        return [name, Tex(symbol) if symbol else "", word, "", status, source]
    shown = printed(value, quantity, case.inputs.units, given=True)
    typed = case.given.get(key)
    if isinstance(typed, str) and not _plain(typed).endswith(_plain(shown.unit)):
        source += f"; given as {typed}"
    return [name, Tex(symbol), shown.number, shown.unit, status, source]


def _plain(unit: str) -> str:
    """Return a unit as typed or printed in one spelling, to tell whether it was converted."""
    return re.sub(r"[\s^*·]", "", unit.translate(str.maketrans("²³⁴", "234")))


def truck_table(calculation: Calculation) -> Block:
    """Return the parameters of the truck, with source and status."""
    case = calculation.case
    system = case.inputs.units
    rows: list[list[Inline]] = []
    for key, (name, symbol, quantity) in _TRUCK_PARAMETERS.items():
        parameter = case.truck_file[key]
        status, source = parameter.status.words, parameter.source
        value = parameter.value
        if key == "body_mass" and case.inputs.truck_mass is not None:
            value = case.truck.body_mass
            status, source = "from the case", "total mass of the case less the engine’s"
        if isinstance(value, str):
            rows.append([name, "", value, "", status, source])
        else:
            shown = printed(value, quantity, system, given=True)
            rows.append([name, Tex(symbol), shown.number, shown.unit, status, source])
    return Table(
        label="tab-truck",
        caption=f"Parameters of the truck {case.truck.name}: {case.truck_file.description}.",
        columns=[
            Column(heading="Parameter"),
            Column(heading="Symbol"),
            Column(heading="Value", align="decimal"),
            Column(heading="Unit"),
            Column(heading="Status"),
            Column(heading="Source", wide=True),
        ],
        rows=rows,
    )


def symbols_of_inputs(calculation: Calculation) -> Iterator[tuple[str, Inline, str]]:
    """Yield symbol, meaning and anchor of what the case and the truck give."""
    for key in _shown_keys(calculation):
        if _INPUTS[key][1]:
            yield _INPUTS[key][1], name_of(key), "tab-inputs"
    for name, symbol, _ in _TRUCK_PARAMETERS.values():
        if symbol:
            yield symbol, in_a_sentence(name), "tab-truck"


def name_of(key: str) -> str:
    """Return the name of an input as it reads within a sentence."""
    return str(in_a_sentence(_INPUTS[key][0]))
