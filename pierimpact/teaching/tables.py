"""Tables of the teaching notebooks: where numbers come from, and how good the formulas are."""

import html
import json
from collections.abc import Sequence

from IPython.display import HTML

from pierimpact.design.codes import code_forces
from pierimpact.design.study import OUTCOME_FILE
from pierimpact.files.trucks import read_truck_file
from pierimpact.teaching.scenario import REFERENCE
from pierimpact.units import printed


def truck_parameters(name: str = REFERENCE.name) -> HTML:
    """Return a truck's parameters, each with its status and source."""
    file = read_truck_file(name)
    rows = [
        (entry.name.replace("_", " ").replace(".", ": "), entry.given, entry.status, entry.source)
        for entry in file.parameters
    ]
    return _table(("Parameter", "Value", "Status", "Source"), rows, right=(1,))


def code_values(speed: float = 80.0 / 3.6, mass: float = REFERENCE.mass) -> HTML:
    """Return what codes say, each value with how sure it is.

    Parameters
    ----------
    speed, mass : float, optional
        Of the vehicle, where the code asks for it [m/s], [kg].
    """
    rows = []
    for code in code_forces(speed, mass):
        height = "—"
        if code.height is not None:
            height = f"{printed(code.height.value, 'length', 'SI', given=True)}"
            if not code.height.verified:
                height += f" ({code.height.remark})"
        force = printed(code.along.value, "force", "SI")
        rows.append((code.code, code.clause, str(force), code.along.remark, height, code.note))
    heads = ("Code", "Clause", "Force along", "How sure", "Height", "Note")
    return _table(heads, rows, right=(2,))


def accuracy() -> HTML:
    """Return how the design procedure compares with the full model in the parametric study."""
    outcome = json.loads(OUTCOME_FILE.read_text(encoding="utf-8"))
    rows = []
    for level, reactions in outcome["predicted over CMSD"].items():
        for reaction, bands in reactions.items():
            found = bands["all"]
            rows.append(
                (
                    level,
                    reaction,
                    f"{found['cases']}",
                    f"{found['mean']:.2f}",
                    f"{found['coefficient of variation']:.1%}",
                    f"{found['1st percentile']:.2f}",
                    f"{found['99th percentile']:.2f}",
                )
            )
    heads = ("Level", "Reaction", "Collisions", "Mean", "c.o.v.", "1st percentile",
             "99th percentile")  # fmt: skip
    return _table(heads, rows, right=(2, 3, 4, 5, 6))


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]], right: Sequence[int] = ()) -> HTML:
    def cells(kind: str, values: Sequence[str]) -> str:
        styles = (
            "text-align:right;white-space:nowrap" if n in right else "text-align:left"
            for n in range(len(values))
        )
        return "".join(
            f'<{kind} style="{style};padding:3px 12px 3px 0;vertical-align:top">'
            f"{html.escape(value)}</{kind}>"
            for style, value in zip(styles, values, strict=True)
        )

    body = "".join(f"<tr>{cells('td', row)}</tr>" for row in rows)
    content = f"<table><thead><tr>{cells('th', heads)}</tr></thead><tbody>{body}</tbody></table>"
    return HTML(content)  # type: ignore[no-untyped-call]
