"""What a case comes to, on a terminal or for a program: nothing is written."""

import json
import textwrap
from collections.abc import Iterator

from pierimpact.plain_text import WIDTH, text_item, text_table
from pierimpact.report.calculation import Calculation
from pierimpact.report.outcome import DEMANDS, first_results, most_used, statement, verdict
from pierimpact.report.results import Results
from pierimpact.report.warnings import warnings_of
from pierimpact.units import compared, printed

_LABEL, _VALUE = 22, 18  # columns of the table [characters]


def check_text(name: str, calculation: Calculation) -> str:
    """Return verdict, results, utilisations and warnings of a case in plain text.

    Parameters
    ----------
    name : str
        What the case is called.
    calculation : Calculation
        Its calculation.
    """
    rows = [
        *((label, str(value), remark) for label, value, remark in first_results(calculation)),
        *_utilisations(calculation),
    ]
    return "\n".join(
        [
            name,
            *textwrap.wrap(statement(calculation), WIDTH),
            "",
            text_table(rows, widest=(_LABEL, _VALUE, WIDTH - _LABEL - _VALUE - 4)),
            "",
            "Before you rely on this",
            *map(text_item, warnings_of(calculation)),
        ]
    )


def _utilisations(calculation: Calculation) -> Iterator[tuple[str, str, str]]:
    upper = calculation.upper_utilisations
    for name, ratio in calculation.utilisations.items():
        at_upper = upper.get(name)
        remark = verdict(ratio, at_upper)
        if at_upper is not None:
            remark += f"; {compared(at_upper)} at the upper end of the band"
        part, use = most_used(calculation, name), calculation.uses[name]
        if part:
            system, quantity = calculation.case.inputs.units, DEMANDS[name]
            demand = printed(use.demand.value, quantity, system)
            resistance = printed(use.resistance, quantity, system, given=True)
            remark = f"{demand} of {resistance}, {part}: {remark}"
        yield f"Utilisation in {name}", compared(ratio), remark


def check_json(name: str, calculation: Calculation) -> str:
    """Return the results of a case as a JSON object in one line, numbers in SI units.

    Its keys are the fields of `Results`, computed ones too, and "case", which is `name`.
    Parameters as in `check_text`.
    """
    return json.dumps({"case": name} | Results.of(calculation).model_dump(mode="json"))


def fault_json(name: str, fault: str) -> str:
    """Return why a case has no results as a JSON object in one line: "case" and "error"."""
    return json.dumps({"case": name, "error": fault})
