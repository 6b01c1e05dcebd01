"""Section, unit forces and stiffness of the pier, step by step."""

from pierimpact.files.case import concrete_modulus
from pierimpact.pier.sections import CircularSection
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Paragraph
from pierimpact.report.document.numbered import Equation, Steps
from pierimpact.report.sheet.pier_values import pier_writer
from pierimpact.units import printed, unit_of, unit_size


def units_note(calculation: Calculation) -> Paragraph:
    """Say which units values without units are in, and how masses and forces go together."""
    system = calculation.case.inputs.units
    length, force = unit_of("length", system), unit_of("shear rigidity", system)
    stiffness, in_masses = unit_of("stiffness", system), unit_of("mass stiffness", system)
    size = unit_size("stiffness", system) / unit_size("mass stiffness", system)
    return Paragraph(
        f"Where values are put in without their units, lengths are in {length} and forces in "
        f"{force}. Masses are in {unit_of('mass', system)}: where they stand beside a stiffness, "
        f"1 {stiffness} is {printed(size, 'share', 'SI', given=True)} {in_masses}. "
        "Every printed value is rounded, so that a check by hand may differ in the last figure."
    )


def section_steps(calculation: Calculation) -> Steps:
    """Return area, rigidities and mass per length of the column."""
    step = pier_writer(calculation).step
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
        steps.insert(0, _concrete_modulus(calculation))
    return Steps(steps)


def _concrete_modulus(calculation: Calculation) -> Equation:
    """Return the modulus by the formula of ACI 318, its factor in the units of the sheet."""
    system = calculation.case.inputs.units
    modulus, strength = (unit_size(kind, system) for kind in ("modulus", "strength"))
    factor = f"{concrete_modulus(strength) / modulus:.6g}"
    one = rf"1\ \text{{{unit_of('strength', system)}}}"
    in_mpa = "" if system == "SI" else ", there 4700 with both in MPa"
    return pier_writer(calculation).step(
        "Elastic modulus of the concrete",
        "E",
        rf"{factor}\ \text{{{unit_of('modulus', system)}}} <x> \sqrt{{<fc> / ({one})}}",
        source=f"as in ACI 318{in_mpa}, from memory; unverified: check against the standard",
    )


def unit_force_steps(calculation: Calculation) -> Steps:
    """Return support forces and moments under a unit force at the impact height.

    Force and moment at the top follow from what the top is, or from what cannot move; the
    others from equilibrium. Derived here by integrating M/EI and V/κGA over the column.
    """
    write, column = pier_writer(calculation), calculation.case.column
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
_FREED = "freed, under the unit force at the impact"
_FREED_OWN = "freed, under a unit force of its own"
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
            f"Deflection of the top, {_FREED}",
            "freed",
            r"\frac{<z>^2 \, (3 <x> <H> - <z>)}{6 <x> <EI>} + \frac{<z>}{<GA>}",
            "bending and shear",
        ),
        (f"Deflection of the top, {_FREED_OWN}", "own", _OWN, "bending and shear"),
        ("Force at the top", "Rt", r"\frac{<freed>}{<own>}", "the top stays in place"),
        ("Moment at the top", "Mt", "0", "pinned top"),
    ],
    ("pinned", "fixed"): [
        (
            f"Deflection of the base, {_FREED}",
            "freed",
            r"\frac{<y>^2 \, (2 <x> <H> + <z>)}{6 <x> <EI>} + \frac{<y>}{<GA>}",
            "bending and shear",
        ),
        (f"Deflection of the base, {_FREED_OWN}", "own", _OWN, "bending and shear"),
        ("Force at the top", "Rt", r"1 - \frac{<freed>}{<own>}", "the base stays in place"),
        ("Moment at the top", "Mt", "<z> - <Rt> <x> <H>", "no moment at the base"),
    ],
    ("fixed", "fixed"): [
        (
            f"Deflection of the top, {_FREED}",
            "freed",
            r"\frac{<z>^2 \, (3 <x> <H> - 2 <x> <z>)}{12 <x> <EI>} + \frac{<z>}{<GA>}",
            "bending and shear; it cannot turn",
        ),
        (
            f"Deflection of the top, {_FREED_OWN}",
            "own",
            r"\frac{<H>^3}{12 <x> <EI>} + \frac{<H>}{<GA>}",
            "bending and shear; it cannot turn",
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
    step = pier_writer(calculation).step
    return Steps(
        [
            step(
                "Deflection by flexure below the impact",
                "xf_below",
                r"\frac{<z> \left( <Mb>^2 + <Mb> <x> <Mn> + <Mn>^2 \right)}{3 <x> <EI>}",
                units=False,
                source="integral of M² over EI",
            ),
            step(
                "Deflection by flexure above the impact",
                "xf_above",
                r"\frac{<y> \left( <Mn>^2 + <Mn> <x> <Mt> + <Mt>^2 \right)}{3 <x> <EI>}",
                units=False,
                source="integral of M² over EI",
            ),
            step(
                "Deflection by shear",
                "xs",
                r"\frac{<z> <x> <Rb>^2 + <y> <x> <Rt>^2}{<GA>}",
                units=False,
                source="integral of the squared shear over κGA",
            ),
            step("Deflection at the impact", "xn", "<xf_below> + <xf_above> + <xs>", units=False),
            step("Stiffness", "kp", r"\frac{1}{<xn>}", source="Eq. 3 of the source paper"),
        ]
    )
