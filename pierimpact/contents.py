"""What the calculation sheet of a case says: one function a piece."""

import datetime
import re
from collections.abc import Iterator

import pierimpact
from pierimpact.calculation import MUCH_SMALLER, Calculation
from pierimpact.casefile import HIGH_IMPACT_HEIGHT, LOW_IMPACT_HEIGHT, PHYSICAL_KEYS
from pierimpact.figures import draw_history
from pierimpact.sheet import (
    Block,
    Code,
    Column,
    Figure,
    Headline,
    Inline,
    Notice,
    Paragraph,
    Table,
    Tex,
    TitleBlock,
)
from pierimpact.units import Printed, printed, rounded, unit_of

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
        r"k_\mathrm{u1}",
        "stiffness",
    ),
    "body_spring.plateau_force": ("Body spring: plateau force", "P_2", "force"),
    "body_spring.plateau_length": ("Body spring: plateau length", "d_2", "length"),
    "body_spring.stiffness": ("Body spring: steep stiffness", "k_2", "stiffness"),
    "body_spring.unloading_stiffness": (
        "Body spring: unloading stiffness",
        r"k_\mathrm{u2}",
        "stiffness",
    ),
}

# How the statuses of a truck file read in print.
_STATUSES = {
    "read": "read in the source",
    "secondary": "unverified: second-hand",
    "recalled": "unverified: from memory",
    "calibrated": "calibrated",
    "assumed": "assumed",
    "illustrative": "illustrative",
}


def title_block(calculation: Calculation) -> Block:
    """Return the head of the sheet; where the case gives no date, it is today's."""
    inputs = calculation.case.inputs
    date = (inputs.date or datetime.date.today()).isoformat()
    return TitleBlock(
        title="Truck collision with a bridge pier",
        subtitle="Calculation sheet. Coupled mass-spring-damper (CMSD) model of the collision",
        entries={
            "Project": inputs.project,
            "Element": inputs.element,
            "Job number": inputs.job_number,
            "Revision": inputs.revision,
            "Prepared by": inputs.prepared_by,
            "Checked by": inputs.checked_by,
            "Date": date,
        },
        date=date,
        paper="a4" if inputs.units == "SI" else "us-letter",
    )


def summary(calculation: Calculation) -> Block:
    """Return the results in large type."""
    history = calculation.history
    engine, cargo = history.engine_peak, history.cargo_peak
    system = calculation.case.inputs.units
    height = printed(calculation.struck.impact_height, "length", system, given=True)
    results = [
        (
            "Governing reaction",
            printed(history.governing_peak.reaction, "force", system),
            f"static, at {height} above the base",
        ),
        (
            "Engine peak",
            printed(engine.reaction, "force", system),
            f"after {printed(engine.time, 'time', system)}",
        ),
        (
            "Cargo peak",
            printed(cargo.reaction, "force", system) if cargo else Printed("none", ""),
            f"after {printed(cargo.time, 'time', system)}" if cargo else "no cargo contact",
        ),
    ]
    results += [
        (f"Utilisation in {name}", Printed(rounded(ratio, 3), ""), _verdict(ratio))
        for name, ratio in _utilisations(calculation)
    ]
    return Headline(results=results)


def governing_statement(calculation: Calculation) -> Block:
    """Say which peak governs, and which contacts were made."""
    history = calculation.history
    if history.cargo_contact_time is None:
        cargo = "The cargo does not reach the pier: there is no cargo peak. "
    else:
        cargo = ""
    if history.engine_contact_time is None:
        engine = (
            "The engine does not reach the pier either: the"
            if cargo
            else "The engine does not reach the pier before the cargo does: the engine"
        )
        engine += " peak is the pier’s response to the crumpling of the truck alone. "
    else:
        engine = ""
    governs = "cargo" if history.governing_peak == history.cargo_peak else "engine"
    return Paragraph(f"{cargo}{engine}The {governs} peak governs.")


def warnings(calculation: Calculation) -> Block:
    """Return what a reader must know before relying on the results."""
    case = calculation.case
    body: list[Inline] = []
    status = case.truck_file.status
    if status != "read":
        body.append(
            f"The truck {case.truck.name} is {_STATUSES[status]} ({case.truck_file.source}). "
            "The results are no better than its parameters."
        )
    if case.inputs.assumed:
        names = ", ".join(_name(key) for key in _INPUTS if key in case.inputs.assumed)
        body.append(f"Assumed, not given by any source: {names}.")
    body += case.inputs.notes
    return Notice(heading="Before you rely on this", body=body)


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
        status, source = _STATUSES[parameter.status], parameter.source
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
            Column(heading=f"after [{time}]", align="decimal"),
            Column(heading=""),
        ],
        rows=rows,
        strong=[1 if history.governing_peak == history.cargo_peak else 0],
    )


def member_forces_table(calculation: Calculation) -> Block:
    """Return support forces and extreme member forces under the governing reaction."""
    system, forces = calculation.case.inputs.units, calculation.member_forces
    resistances = dict(_utilisations(calculation))
    shear, moment = forces.largest_shear, forces.largest_moment
    values = [
        ("Force on the base", r"R \cdot R_\mathrm{b}", forces.base_force, "force", ""),
        ("Force on the top", r"R \cdot R_\mathrm{t}", forces.top_force, "force", ""),
        ("Moment at the base", r"R \cdot M_\mathrm{b}", forces.base_moment, "moment", ""),
        ("Moment at the impact", r"R \cdot M_\mathrm{n}", forces.impact_moment, "moment", ""),
        ("Moment at the top", r"R \cdot M_\mathrm{t}", forces.top_moment, "moment", ""),
        ("Largest shear", r"V_\mathrm{max}", abs(shear.value), "force", "shear"),
        ("Largest moment", r"M_\mathrm{max}", abs(moment.value), "moment", "moment"),
    ]
    rows: list[list[Inline]] = []
    for name, symbol, value, quantity, check in values:
        shown = printed(value, quantity, system)
        verdict = "no resistance given" if check else ""
        if check in resistances:
            ratio = resistances[check]
            verdict = f"{rounded(ratio, 3)} of the resistance: {_verdict(ratio)}"
        rows.append([name, Tex(symbol), shown.number, shown.unit, verdict])
    return Table(
        label="tab-members",
        caption="Member forces under the governing reaction as a static force at the impact.",
        columns=[
            Column(heading="Force"),
            Column(heading="Symbol"),
            Column(heading="Value", align="decimal"),
            Column(heading="Unit"),
            Column(heading="Utilisation", wide=True),
        ],
        rows=rows,
        strong=[5, 6],
    )


def _utilisations(calculation: Calculation) -> list[tuple[str, float]]:
    inputs, forces = calculation.case.inputs, calculation.member_forces
    demands = (
        ("shear", forces.largest_shear.value, inputs.shear_resistance),
        ("moment", forces.largest_moment.value, inputs.moment_resistance),
    )
    return [(name, abs(value) / limit) for name, value, limit in demands if limit is not None]


def _verdict(ratio: float) -> str:
    return "within the resistance" if ratio <= 1.0 else "exceeds the resistance"


def provenance_table(
    calculation: Calculation, case_file: str | None, case_sha256: str | None
) -> Block:
    """Return what this sheet was made from and how to make it again.

    Parameters
    ----------
    calculation : Calculation
        The calculation.
    case_file, case_sha256 : str or None
        Name and SHA-256 of the case file, where it is known.
    """
    truck_file, history = calculation.case.truck_file, calculation.history
    rows: list[list[Inline]] = [["Software", f"pierimpact {pierimpact.__version__}"]]
    if case_file and case_sha256:
        rows += [
            ["Case file", Code(case_file)],
            ["its SHA-256", Code(case_sha256)],
            ["To repeat", Code(f"pierimpact report {case_file}")],
        ]
    else:
        rows.append(["Case file", "not recorded: the parameters were set in the notebook"])
    rows += [
        ["Truck file", (Code(truck_file.file_name), f", {_STATUSES[truck_file.status]}")],
        ["its SHA-256", Code(truck_file.sha256)],
        ["Energy balance", _error_words(history.energy_error, "the truck’s initial energy")],
        ["Momentum balance", _error_words(history.momentum_error, "the truck’s initial momentum")],
    ]
    return Table(
        label="tab-provenance",
        caption="What this sheet was made from.",
        columns=[Column(heading="Item"), Column(heading="Value", wide=True)],
        rows=rows,
    )


def _error_words(error: float, whole: str) -> str:
    return f"closes to {rounded(error, 1)} of {whole}, at all times"


def _name(key: str) -> str:
    """Return the name of an input as it reads within a sentence."""
    name = _INPUTS[key][0]
    return name if name.startswith("Poisson") else name[0].lower() + name[1:]
