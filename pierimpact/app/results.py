"""What a case comes to, as the page shows it: words, a drawing and tables, all of them plain."""

from typing import Any

from pierimpact.plots.situation import draw_situation
from pierimpact.report.calculation import Calculation
from pierimpact.report.outcome import first_results, statement, verdict
from pierimpact.report.warnings import warnings_of
from pierimpact.units import compared, printed, stated


def shown(calculation: Calculation) -> dict[str, Any]:
    """Return what the page shows of a calculation.

    "statement" is the verdict and "kind" what it is: "holds", "exceeds" or "unchecked"; "svg" is
    the drawing and "alt" what it shows; "results" are labels, values and remarks, "utilisations"
    names, ratios, words for them and shares of the resistance [-], "warnings" sentences.
    """
    case, struck = calculation.case, calculation.struck
    system, reaction = case.inputs.units, calculation.design_force
    ratios, upper = calculation.utilisations, calculation.upper_utilisations
    height = stated(struck.impact_height, "length", system)
    exceeds = any(ratio > 1.0 for ratio in ratios.values())
    return {
        "statement": statement(calculation),
        "kind": "exceeds" if exceeds else "holds" if ratios else "unchecked",
        "svg": draw_situation(case.column, struck.impact_height, case.truck, reaction, system),
        "alt": f"The column, {printed(case.column.height, 'length', system, given=True)} high, its "
        f"section and the truck, to scale. The reaction of {printed(reaction, 'force', system)} "
        f"acts at {height}.",
        "results": [
            [label, str(value), remark] for label, value, remark in first_results(calculation)
        ],
        "utilisations": [
            [
                name,
                compared(ratio),
                verdict(ratio, upper.get(name))
                + (f"; {compared(upper[name])} at the upper end of the band" if upper else ""),
                ratio,
            ]
            for name, ratio in ratios.items()
        ],
        "warnings": warnings_of(calculation),
    }
