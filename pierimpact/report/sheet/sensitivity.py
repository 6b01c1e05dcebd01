"""The spectra with this pier, and how the reaction changes with what it depends on."""

from pierimpact.design.sensitivity import MASS_CHANGE, SPEED_CHANGE
from pierimpact.plots.figures import draw_sensitivity, draw_spectra
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Block
from pierimpact.report.document.markup import Inline
from pierimpact.report.document.numbered import Column, Figure, Table
from pierimpact.units import printed, rounded, unit_of


def spectra_figure(calculation: Calculation) -> Block:
    """Return the engine's and the cargo's reaction against pier frequency."""
    system, frequency = calculation.case.inputs.units, calculation.pier.frequency
    pier = printed(frequency, "frequency", system)
    engine = printed(calculation.history.engine_peak.reaction, "force", system)
    words = f"an engine peak of {engine} and no cargo peak"
    if calculation.history.cargo_peak is not None:
        cargo = printed(calculation.history.cargo_peak.reaction, "force", system)
        words = f"an engine peak of {engine} and a cargo peak of {cargo}"
    return Figure(
        label="fig-spectra",
        caption=f"Reaction against pier frequency at this pier’s mass and damping; this pier, "
        f"{pier}, is marked.",
        alt=f"Spectra of engine and cargo reaction. At this pier’s {pier} the full model gives "
        f"{words}.",
        svg=draw_spectra(calculation.sensitivity.frequency, frequency, system),
    )


def sensitivity_figure(calculation: Calculation) -> Block:
    """Return the governing reaction against speed, mass, impact height and pier frequency."""
    case, system = calculation.case, calculation.case.inputs.units
    here = {
        "speed": case.inputs.speed,
        "mass": case.truck.mass,
        "impact_height": calculation.struck.impact_height,
        "frequency": calculation.pier.frequency,
    }
    forces = calculation.governing_peak.reaction, calculation.design.reaction
    speeds = calculation.sensitivity.speed
    ends = [
        f"{printed(float(speeds.model[i]), 'force', system)} at "
        f"{printed(float(speeds.values[i]), 'speed', system)}"
        for i in (0, -1)
    ]
    return Figure(
        label="fig-sensitivity",
        caption="Governing reaction against speed, truck mass, impact height and pier frequency, "
        "one changed at a time; this case is marked. With the mass only the cargo changes, with "
        "the impact height mass and stiffness of the pier.",
        alt=f"Governing reaction against four quantities. By the full model it is {ends[0]} and "
        f"{ends[1]}.",
        svg=draw_sensitivity(calculation.sensitivity, here, forces, system),
    )


def sensitivity_table(calculation: Calculation) -> Block:
    """Return the reactions at other speeds and masses."""
    case, system, found = calculation.case, calculation.case.inputs.units, calculation.sensitivity
    speed, mass = case.inputs.speed, case.truck.mass
    step = printed(SPEED_CHANGE, "speed", system, given=True)
    share = f"{100.0 * MASS_CHANGE:g} %"
    changes = [
        ("This case", None, "", 0.0),
        (f"Speed less {step}", found.slower, "speed", speed - SPEED_CHANGE),
        (f"Speed more {step}", found.faster, "speed", speed + SPEED_CHANGE),
        (f"Mass less {share}", found.lighter, "mass", mass * (1.0 - MASS_CHANGE)),
        (f"Mass more {share}", found.heavier, "mass", mass * (1.0 + MASS_CHANGE)),
    ]
    rows: list[list[Inline]] = []
    for name, variation, quantity, value in changes:
        model, design = calculation.governing_peak.reaction, calculation.design.reaction
        if variation is not None:
            model, design = float(variation.model[0]), float(variation.design[0])
        elif quantity:
            rows.append([name, "not possible", "", "", "", ""])
            continue
        rows.append(
            [
                name,
                str(printed(value, quantity, system, given=True)) if quantity else "",
                printed(design, "force", system).number,
                printed(model, "force", system).number,
                rounded(design / model, 3),
                rounded(max(design, model) / calculation.design_force, 3),
            ]
        )
    force = unit_of("force", system)
    return Table(
        label="tab-sensitivity",
        caption="Reactions at other speeds and masses; the last column is the larger of procedure "
        "and full model, over that of this case.",
        columns=[
            Column(heading="Change"),
            Column(heading="Value"),
            Column(heading=f"Design procedure [{force}]", align="decimal"),
            Column(heading=f"Full model [{force}]", align="decimal"),
            Column(heading="Ratio", align="decimal"),
            Column(heading="Over this case", align="decimal"),
        ],
        rows=rows,
        strong=[0],
    )
