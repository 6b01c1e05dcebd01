"""The nominal impact height, and the collision by the full model."""

from pierimpact.checks import InputError
from pierimpact.collision.averages import largest_average_force
from pierimpact.design.reaction import HIGH_IMPACT_HEIGHT, LOW_IMPACT_HEIGHT, MUCH_SMALLER
from pierimpact.plots.figures import draw_history
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Inline, Tex, in_tex
from pierimpact.report.document.numbered import Column, Equation, Figure, Steps, Table
from pierimpact.units import printed, rounded, unit_of

#: Windows of the moving averages that crash tests report [s].
WINDOWS = (0.010, 0.025)


def impact_height(calculation: Calculation) -> Block:
    """Say which nominal impact height is used, and why."""
    system = calculation.case.inputs.units
    low, high, used = (
        str(printed(height, "length", system, given=True))
        for height in (LOW_IMPACT_HEIGHT, HIGH_IMPACT_HEIGHT, calculation.struck.impact_height)
    )
    symbol = Tex(r"z_\mathrm{n}")
    if calculation.trial is None:
        return Paragraph(("The nominal impact height ", symbol, f" = {used} is given by the case."))
    trial = calculation.trial
    engine = printed(trial.engine_peak.reaction, "force", system)
    found = f"A trial at {low} gives an engine peak of {engine} and no cargo peak"
    if trial.cargo_peak is not None:
        cargo = printed(trial.cargo_peak.reaction, "force", system)
        ratio = rounded(trial.cargo_peak.reaction / trial.engine_peak.reaction, 3)
        found = (
            f"A trial at {low} gives an engine peak of {engine} and a cargo peak of {cargo}, "
            f"{ratio} of it"
        )
    return Paragraph(
        (
            f"The case leaves the nominal impact height to the rule of the source paper: {low} "
            f"without cargo peak or with a much smaller one, else {high}. Much smaller is taken as "
            f"below {MUCH_SMALLER:g} of the engine peak, which is this project’s figure. {found}: ",
            symbol,
            f" = {used}.",
        )
    )


def history_figure(calculation: Calculation) -> Block:
    """Return reaction and contact force against time."""
    history, system = calculation.history, calculation.case.inputs.units
    cargo = history.cargo_peak
    engine_words = f"{printed(history.engine_peak.reaction, 'force', system)} after "
    engine_words += str(printed(history.engine_peak.time, "time", system))
    cargo_words = "; there is no cargo peak"
    if cargo is not None:
        cargo_words = f", the cargo peak {printed(cargo.reaction, 'force', system)} after "
        cargo_words += str(printed(cargo.time, "time", system))
    return Figure(
        label="fig-history",
        caption=(
            "Reaction ",
            Tex(r"R = k_\mathrm{p} x_\mathrm{p}"),
            " (thick) and contact force between truck and pier (thin) against time.",
        ),
        alt=f"Reaction against time. The engine peak is {engine_words}{cargo_words}.",
        svg=draw_history(history, system),
    )


def peaks_table(calculation: Calculation) -> Block:
    """Return contact times and peaks of engine and cargo, and which governs."""
    history, system = calculation.history, calculation.case.inputs.units
    peaks = (
        ("Engine", history.engine_contact_time, history.engine_peak),
        ("Cargo", history.cargo_contact_time, history.cargo_peak),
    )
    rows: list[list[Inline]] = []
    for name, contact, peak in peaks:
        governs = peak is not None and peak == history.governing_peak
        rows.append(
            [
                name,
                "none" if contact is None else printed(contact, "time", system).number,
                "none" if peak is None else printed(peak.reaction, "force", system).number,
                "" if peak is None else printed(peak.time, "time", system).number,
                "governs" if governs else "",
            ]
        )
    time, force = unit_of("time", system), unit_of("force", system)
    return Table(
        label="tab-peaks",
        caption="Contacts and peak reactions.",
        columns=[
            Column(heading=""),
            Column(heading=f"Contact after [{time}]", align="decimal"),
            Column(heading=f"Peak reaction [{force}]", align="decimal"),
            Column(heading=f"Peak after [{time}]", align="decimal"),
            Column(heading=""),
        ],
        rows=rows,
        strong=[1 if history.governing_peak == history.cargo_peak else 0],
    )


def averages_table(calculation: Calculation) -> Block:
    """Return the largest contact force and its largest moving averages."""
    history, system = calculation.history, calculation.case.inputs.units
    largest = float(history.contact_force.max())
    at = float(history.time[history.contact_force.argmax()])
    rows: list[list[Inline]] = [
        [
            "At one instant",
            printed(largest, "force", system).number,
            printed(at, "time", system).number,
        ]
    ]
    for window in WINDOWS:
        name = f"Over {printed(window, 'time', system, given=True)}"
        try:
            average = largest_average_force(history, window)
        except InputError:  # the collision is over sooner
            rows.append([name, "none", ""])
            continue
        shown, start = (
            printed(average.force, "force", system),
            printed(average.start, "time", system),
        )
        rows.append([name, shown.number, start.number])
    return Table(
        label="tab-averages",
        caption="Largest contact force between truck and pier by the full model, and its largest "
        "moving averages. The value of AASHTO LRFD was taken from the 25 ms average of a test.",
        columns=[
            Column(heading="Average"),
            Column(heading=f"Contact force [{unit_of('force', system)}]", align="decimal"),
            Column(heading=f"From [{unit_of('time', system)}]", align="decimal"),
        ],
        rows=rows,
    )


def check_table(calculation: Calculation) -> Block:
    """Return the design procedure beside the full model, with the ratio."""
    history, design, hand = calculation.history, calculation.design, calculation.hand
    system = calculation.case.inputs.units
    cargo = history.cargo_peak
    models = {
        "Engine": (history.engine_peak.reaction, design.engine, hand.engine),
        "Cargo": (cargo.reaction if cargo else None, design.cargo, hand.cargo),
        "Governing": (history.governing_peak.reaction, design.reaction, hand.reaction),
    }
    rows: list[list[Inline]] = []
    for name, (exact, *closed) in models.items():
        row: list[Inline] = [name, _force_or_none(exact, system)]
        for value in closed:
            row.append(_force_or_none(value, system))
            row.append("" if value is None or exact is None else rounded(value / exact, 3))
        rows.append(row)
    force = unit_of("force", system)
    return Table(
        label="tab-check",
        caption="Reactions by the full model and by the two levels of the design procedure, each "
        "with its ratio to the full model.",
        columns=[
            Column(heading="Reaction"),
            Column(heading=f"Full model [{force}]", align="decimal"),
            Column(heading=f"Design procedure [{force}]", align="decimal"),
            Column(heading="Ratio", align="decimal"),
            Column(heading=f"Hand level [{force}]", align="decimal"),
            Column(heading="Ratio", align="decimal"),
        ],
        rows=rows,
        strong=[2],
    )


def _force_or_none(value: float | None, system: str) -> str:
    return "none" if value is None else printed(value, "force", system).number


def design_reaction_step(calculation: Calculation) -> Block:
    """Return the design reaction: the larger of procedure and full model."""
    system = calculation.case.inputs.units
    procedure = printed(calculation.design.reaction, "dynamic force", system)
    model = printed(calculation.governing_peak.reaction, "dynamic force", system)
    larger = printed(calculation.design_force, "dynamic force", system)
    return Steps(
        [
            Equation(
                label="eq-design-reaction",
                name="Design reaction: procedure or full model",
                symbol="R",
                lines=[
                    r"\max(R_\mathrm{D}, R_\mathrm{M})",
                    rf"\max({in_tex(procedure)}, {in_tex(model)}) = {in_tex(larger)}",
                ],
            )
        ]
    )
