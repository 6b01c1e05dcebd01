"""Tables of the teaching notebooks: sources of the numbers, accuracy of the formulas."""

import json

from IPython.display import HTML

from pierimpact.design import static_study
from pierimpact.design.codes import code_forces
from pierimpact.design.static_forces import ABOVE, BELOW
from pierimpact.design.study import OUTCOME_FILE
from pierimpact.files.trucks import read_truck_file
from pierimpact.pier.static_forces import LOWEST_FREQUENCY, QUICK, SLOW, TOP
from pierimpact.symbols import BY_KEY
from pierimpact.teaching.markup import table
from pierimpact.teaching.scenario import REFERENCE
from pierimpact.units import printed


def truck_parameters(name: str = REFERENCE.name) -> HTML:
    """Return a truck's parameters, each with its status and source."""
    file = read_truck_file(name)
    rows = [
        (BY_KEY[entry.name].heading, entry.given, entry.status, entry.source)
        for entry in file.parameters
    ]
    return HTML(table(("Parameter", "Value", "Status", "Source"), rows, right=(1,)))  # type: ignore[no-untyped-call]


def code_values(speed: float = 80.0 / 3.6, mass: float = REFERENCE.mass) -> HTML:
    """Return the impact forces of design codes, each with its status.

    Parameters
    ----------
    speed, mass : float, optional
        Of the vehicle, where the code asks for it [m/s], [kg].
    """
    rows = []
    for code in code_forces(speed, mass):
        height = "—"
        if code.height is not None:
            remark = "" if code.height.verified else f" ({code.height.remark})"
            height = f"{printed(code.height.value, 'length', 'SI', given=True)}{remark}"
        force = printed(code.along.value, "force", "SI")
        rows.append((code.code, code.clause, str(force), code.along.remark, height, code.note))
    heads = ("Code", "Clause", "Force along", "Status", "Height", "Note")
    return HTML(table(heads, rows, right=(2,)))  # type: ignore[no-untyped-call]


def accuracy() -> HTML:
    """Return how the design procedure compares with the full model in the parametric study."""
    outcome = json.loads(OUTCOME_FILE.read_text(encoding="utf-8"))
    columns = (
        ("Collisions", "cases", "d"),
        ("Mean", "mean", ".2f"),
        ("c.o.v.", "coefficient of variation", ".1%"),
        ("1st percentile", "1st percentile", ".2f"),
        ("99th percentile", "99th percentile", ".2f"),
    )
    rows = [
        (level, reaction, *(format(bands["all"][name], form) for _, name, form in columns))
        for level, reactions in outcome["predicted over CMSD"].items()
        for reaction, bands in reactions.items()
    ]
    heads = ("Level", "Reaction", *(head for head, _, _ in columns))
    return HTML(table(heads, rows, right=range(2, len(heads))))  # type: ignore[no-untyped-call]


def static_forces() -> HTML:
    """Return what the rules for static member forces tell, by the study behind them."""
    found = json.loads(static_study.OUTCOME_FILE.read_text(encoding="utf-8"))["conclusions"]
    by_column, by_collision = (found[name] for name in static_study.RULES)
    groups = {
        f"Pier frequency from {LOWEST_FREQUENCY:g} Hz": by_column[QUICK],
        f"Pier frequency below {LOWEST_FREQUENCY:g} Hz": by_column[SLOW],
        ABOVE.capitalize(): by_collision[ABOVE],
        BELOW.capitalize(): by_collision[BELOW],
        static_study.UNDER_THE_LARGER.capitalize(): found[static_study.UNDER_THE_LARGER],
        f"Column {TOP} alone": by_column[TOP],
    }
    figures = {"5 %": ".2f", "50 %": ".2f", "95 %": ".2f", "too low": ".0%"}
    rows = [
        [
            name,
            str(group["cases"]),
            *(
                format(group[force][figure], form)
                for force in static_study.FORCES
                for figure, form in figures.items()
            ),
        ]
        for name, group in groups.items()
    ]
    heads = [f"{force.capitalize()}, {name}" for force in static_study.FORCES for name in figures]
    return HTML(table(("", "Columns", *heads), rows, right=range(1, 10)))  # type: ignore[no-untyped-call]
