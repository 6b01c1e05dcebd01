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
    """Return a truck's parameters, each with its status and source.

    Parameters
    ----------
    name : str, optional
        A truck of the catalogue, or the path of a truck file.

    Returns
    -------
    HTML
        A table, as a notebook shows it.

    Raises
    ------
    InputError
        When there is no such truck, or its file breaks a rule.

    Examples
    --------
    >>> import re
    >>> from pierimpact import tables
    >>> table = tables.truck_parameters("single-unit-8t")
    >>> re.findall(">([^<]+)<", table.data)[4:7]
    ['Engine mass', '700 kg', 'illustrative']
    """
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

    Returns
    -------
    HTML
        A table, as a notebook shows it.

    Raises
    ------
    InputError
        When speed or mass is not positive.

    Examples
    --------
    >>> from pierimpact import tables
    >>> table = tables.code_values(speed=25.0, mass=20e3)
    >>> "1936 kN" in table.data  # hard impact by JCSS: v √(k m) with k = 0.3 MN/m
    True
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
    """Return how the design procedure compares with the full model in the parametric study.

    Of the reactions by the procedure over those by the full model: mean, coefficient of variation
    and percentiles [-], by the study in `pierimpact.design.study`.

    Returns
    -------
    HTML
        A table, as a notebook shows it.

    Examples
    --------
    >>> import re
    >>> from pierimpact import tables
    >>> table = tables.accuracy()
    >>> re.findall(">([^<]+)<", table.data)[7:11]  # level, reaction, collisions, mean
    ['short', 'engine', '6000', '1.07']
    """
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
    """Return what the rules for static member forces tell, by the study behind them.

    Of the static shear and moment over those of the column as a beam: quantiles, and the share of
    columns where they are too low [-], by the study in `pierimpact.design.static_study`.

    Returns
    -------
    HTML
        A table, as a notebook shows it.

    Examples
    --------
    >>> import re
    >>> from pierimpact import tables
    >>> table = tables.static_forces()
    >>> re.findall(">([^<]+)<", table.data)[9:12]  # kind, columns, 5 % quantile of the shear
    ['Pier frequency from 55 Hz', '748', '0.91']
    """
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
