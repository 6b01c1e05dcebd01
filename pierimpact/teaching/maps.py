"""Maps of the teaching notebooks: where the static member forces hold."""

import base64
import html
import io
import json
from collections.abc import Mapping

from IPython.display import HTML

from pierimpact.design.static_study import OUTCOME_FILE, Struck, as_columns, compare
from pierimpact.pier.column import PierColumn
from pierimpact.pier.sections import CircularSection
from pierimpact.plots.static_forces import map_figure
from pierimpact.teaching.scenario import REFERENCE


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
    """
    outcome = json.loads(OUTCOME_FILE.read_text(encoding="utf-8"))
    marked = {name: compare(struck) for name, struck in columns.items()}
    file = io.BytesIO()
    map_figure(as_columns(outcome["found"]), marked).savefig(file, format="png")
    data = base64.b64encode(file.getvalue()).decode()
    words = "; ".join(
        f"{name}: shear {found.shear:.2f}, moment {found.moment:.2f}"
        for name, found in marked.items()
    )
    alt = f"Static over beam's largest shear and moment of {len(outcome['found']['ends'])} columns"
    return HTML(  # type: ignore[no-untyped-call]
        f'<img src="data:image/png;base64,{data}" alt="{html.escape(f"{alt}. {words}")}" '
        'style="width:100%;'
        'max-width:960px">'
    )
