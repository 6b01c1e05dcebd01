"""Maps of the teaching notebooks: where static member forces hold, and how far methods err."""

import base64
import html
import io
import json
from collections.abc import Mapping

import numpy as np
from IPython.display import HTML
from matplotlib.figure import Figure

from pierimpact.design.methods import METHODS, compare_methods, hertz_stiffness
from pierimpact.design.static_study import OUTCOME_FILE, Struck, as_columns, compare
from pierimpact.pier.column import PierColumn
from pierimpact.pier.sections import CircularSection
from pierimpact.plots.methods import methods_figure
from pierimpact.plots.static_forces import map_figure
from pierimpact.teaching.markup import table
from pierimpact.teaching.scenario import REFERENCE, Scenario

STRIKER_RADIUS = 0.5  # of the Hertz contact, a round number [m]


def _example(height: float, diameter: float, top: str, speed: float) -> Struck:
    column = PierColumn(
        height=height,
        section=CircularSection(diameter=diameter),
        elastic_modulus=28e9,
        density=2450.0,
        top=top,
    )
    return Struck(REFERENCE, column, impact_height=1.2, damping_ratio=0.05, speed=speed / 3.6)


#: Columns struck by the reference truck, by name.
EXAMPLES = {
    "A": _example(5.0, 0.914, "pinned", 80.0),
    "B": _example(8.0, 1.2, "pinned", 80.0),
    "C": _example(6.0, 1.2, "fixed", 80.0),
    "D": _example(8.0, 1.2, "free", 80.0),
    "E": _example(9.0, 1.5, "free", 62.0),
}


def static_forces(columns: Mapping[str, Struck] = EXAMPLES) -> HTML:
    """Return the map of static member forces over those of the column as a beam.

    Parameters
    ----------
    columns : mapping of str to Struck, optional
        Collisions to mark, by name, each as `Struck(truck, column, impact_height, damping_ratio,
        speed)` in SI units; it is calculated in both ways.

    Returns
    -------
    HTML
        The map, from the study in `pierimpact.design.static_study`, as a notebook shows it.

    Raises
    ------
    InputError
        When a truck misses its column, or a value is out of range.

    Examples
    --------
    >>> from pierimpact import maps
    >>> page = maps.static_forces({"A": maps.EXAMPLES["A"]})
    >>> "A: shear 1.23, moment 1.36" in page.data  # static over beam
    True
    """
    outcome = json.loads(OUTCOME_FILE.read_text(encoding="utf-8"))
    marked = {name: compare(struck) for name, struck in columns.items()}
    words = "; ".join(
        f"{name}: shear {found.shear:.2f}, moment {found.moment:.2f}"
        for name, found in marked.items()
    )
    alt = f"Static over beam's largest shear and moment of {len(outcome['found']['ends'])} columns"
    figure = map_figure(as_columns(outcome["found"]), marked)
    return HTML(_image(figure, f"{alt}. {words}"))  # type: ignore[no-untyped-call]


def methods() -> HTML:
    """Return the forces by other methods beside the full model, and what each takes for granted.

    The reference truck strikes the column of the explorers, over speed and over mass. Sources of
    the methods, and whether they were read there, stand in the table.

    Returns
    -------
    HTML
        The forces as a figure, and the table, as a notebook shows them.

    Examples
    --------
    >>> from pierimpact import maps
    >>> page = maps.methods()
    >>> "JCSS Probabilistic Model Code" in page.data
    True
    """
    scenario = Scenario()
    truck, pier, speed = scenario.truck, scenario.pier, scenario.speed
    stiffness = hertz_stiffness(STRIKER_RADIUS, scenario.column_diameter, scenario.elastic_modulus)
    over_speed = compare_methods(
        truck, pier, np.arange(20.0, 131.0, 2.0) / 3.6, truck.mass, stiffness
    )
    over_mass = compare_methods(truck, pier, speed, 1e3 * np.arange(3.0, 40.5, 0.5), stiffness)
    alt = "Forces by every method over speed and over mass; the table below says how each errs"
    rows = [(m.name, m.source, m.status, m.assumptions, m.errs) for m in METHODS]
    heads = ("Method", "Source", "Status", "Takes for granted", "Errs, for this truck")
    page = _image(methods_figure(over_speed, over_mass), alt) + table(heads, rows)
    return HTML(page)  # type: ignore[no-untyped-call]


def _image(figure: Figure, alt: str) -> str:
    """Return a figure as HTML that needs no other file."""
    file = io.BytesIO()
    figure.savefig(file, format="png")
    data = base64.b64encode(file.getvalue()).decode()
    return (
        f'<img src="data:image/png;base64,{data}" alt="{html.escape(alt)}" '
        'style="width:100%;max-width:960px">'
    )
