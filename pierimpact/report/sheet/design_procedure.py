"""The design procedure step by step: equation, symbols, values put in, and result of each."""

from collections.abc import Iterator, Sequence

from pierimpact.design.equations import DesignStep
from pierimpact.design.reaction import DesignReaction
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Inline, Ref, Tex, inline
from pierimpact.report.document.numbered import Column, Steps, Table
from pierimpact.report.document.step_writer import StepWriter, Value
from pierimpact.units import printed, unit_of, unit_size

# Kinds of quantity by SI unit. Forces, masses, lengths and times are in consistent units, so that
# values can be put in without a factor.
_QUANTITIES = {
    "N": "dynamic force",
    "kg": "dynamic mass",
    "N/m": "dynamic stiffness",
    "m/s": "dynamic speed",
    "m/s^2": "acceleration",
    "m": "length",
    "s": "dynamic time",
    "rad/s": "circular frequency",
    "1/s": "decay rate",
    "rad": "angle",
    "N s": "impulse",
    "-": "share",
}

# Where the starting values are from, unless from the table of the truck.
_ORIGINS = {
    "V": Ref("Table", "tab-inputs"),
    "mp": Ref("Eq.", "eq-mp"),
    "kp": Ref("Eq.", "eq-kp"),
    "zeta": Ref("Table", "tab-inputs"),
}

# What is to be said of a step beside what it is.
_SOURCES = {
    "engine_hump": "figures fitted to the full model",
    "cargo_hump": "figures fitted to the full model",
    "overshoot": "a suddenly applied force",
    "engine_swing": "of displacement and velocity",
    "pulse_centroid": "a quarter of a sine up, and down in e times its time",
    "pulse_spread": "of the same blow",
}

# The time of a contact that does not come about, and the speed that is zero then.
_STOPPED = "of a body that would just reach the pier: this one stops before"
_SPEED_AT = {"engine_time": "engine_speed", "cargo_time": "cargo_speed"}

# Parts of the procedure, and the first step of the next.
_ENDS = {
    "plateau": ("engine_first_time",),
    "engine": ("ringing_time", "pulse_mass"),
    "ringing": ("cargo_first_time",),
    "contact": ("cargo_beta",),
    "cargo": (),
}


def given_table(calculation: Calculation) -> Block:
    """Return what the procedure starts from, in the units that values are put in with."""
    system = calculation.case.inputs.units
    rows: list[list[Inline]] = []
    for step in calculation.design.given:
        shown = printed(step.value, _QUANTITIES[step.unit], system, given=True)
        rows.append(
            [
                _capital(step.meaning),
                Tex(step.symbol),
                shown.number,
                shown.unit,
                _ORIGINS.get(step.name, Ref("Table", "tab-truck")),
            ]
        )
    mass, unit = unit_of("dynamic mass", system), unit_of("mass", system)
    in_units = unit_size("dynamic mass", system) / unit_size("mass", system)
    return Table(
        label="tab-given",
        caption="What the procedure starts from, in consistent units: forces are masses times "
        f"accelerations, and 1 {mass} is {printed(in_units, 'share', 'SI', given=True)} {unit}.",
        columns=[
            Column(heading="Item"),
            Column(heading="Symbol"),
            Column(heading="Value", align="decimal"),
            Column(heading="Unit"),
            Column(heading="From"),
        ],
        rows=rows,
    )


def procedure_steps(calculation: Calculation, part: str) -> Block:
    """Return a part of the procedure.

    Parameters
    ----------
    calculation : Calculation
        The calculation.
    part : {"plateau", "engine", "ringing", "contact", "cargo"}
        Which part.
    """
    design = calculation.design
    steps = _parts(design.steps)[part]
    if not steps:  # only the last part can have none
        return Paragraph(
            ("The cargo stops before it meets the pier, ", Tex("v_2 = 0"), ": it has no reaction.")
        )
    values = _values(design)
    stopped = {
        time: _STOPPED
        for time, speed in _SPEED_AT.items()
        if speed in values and values[speed].value == 0.0
    }
    write = StepWriter(values, calculation.case.inputs.units)
    return Steps(
        [
            write.step(
                _capital(step.meaning),
                step.name,
                step.formula,
                units=False,
                source=(_SOURCES | stopped).get(step.name, ""),
            )
            for step in steps
        ]
    )


def hand_table(calculation: Calculation) -> Block:
    """Return the procedure on its hand level: equations and results."""
    system = calculation.case.inputs.units
    rows: list[list[Inline]] = []
    for step in calculation.hand.steps:
        value = Value(step.symbol, step.value, _QUANTITIES[step.unit])
        shown = printed(value.value, value.quantity, system)
        rows.append(
            [
                inline(_capital(step.meaning)),
                Tex(rf"\displaystyle {step.symbol} = {step.equation}"),
                shown.number,
                shown.unit,
            ]
        )
    return Table(
        label="tab-hand",
        caption="The hand level: a short check from the same starting values. The plain numbers in "
        "the humps and in η are fitted to the full model.",
        columns=[
            Column(heading="Step", wide=True),
            Column(heading="Equation"),
            Column(heading="Value", align="decimal"),
            Column(heading="Unit"),
        ],
        rows=rows,
        centred=True,
    )


def _parts(steps: Sequence[DesignStep]) -> dict[str, list[DesignStep]]:
    parts: dict[str, list[DesignStep]] = {part: [] for part in _ENDS}
    names = iter(_ENDS)
    part = next(names)
    for step in steps:
        if step.name in _ENDS[part]:
            part = next(names)
        parts[part].append(step)
    return parts


def _values(design: DesignReaction) -> dict[str, Value]:
    given = {
        step.name: Value(step.symbol, step.value, _QUANTITIES[step.unit], True)
        for step in design.given
    }
    return given | {
        step.name: Value(step.symbol, step.value, _QUANTITIES[step.unit], step.name == "fast_turns")
        for step in design.steps
    }


def symbols_of_procedure(calculation: Calculation) -> Iterator[tuple[str, Inline, str]]:
    """Yield symbol, meaning and anchor of every value of the procedure, hand level last."""
    for step in calculation.design.steps:
        yield step.symbol, inline(step.meaning), f"eq-{step.name}"
    for step in calculation.hand.steps:
        yield step.symbol, inline(step.meaning), "tab-hand"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
