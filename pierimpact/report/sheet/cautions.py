"""What a reader must know before relying on the results, for the sheet and for the summary."""

from collections.abc import Sequence

from pierimpact.design.domain import Outside
from pierimpact.report.calculation import Calculation
from pierimpact.report.sheet.inputs import name_of
from pierimpact.units import printed, rounded

# Kinds of quantity of what bounds the studied domain; a spring's are told by their last words.
_QUANTITIES = {
    "frequency": "frequency",
    "ratio": "ratio",
    "mass": "mass",
    "speed": "speed",
    "force": "force",
    "length": "length",
    "stiffness": "stiffness",
}


def limits_of_the_study(outside: Sequence[Outside], overlapping: bool, system: str) -> list[str]:
    """Return a clause for each thing that the design formulas were not checked for.

    Parameters
    ----------
    outside : sequence of Outside
        The values outside the studied domain.
    overlapping : bool
        Whether the cargo meets the pier before the engine lets go.
    system : {"SI", "US"}
        Units to print in.
    """
    clauses = []
    for name, value, low, high in outside:
        quantity = _QUANTITIES[name.rpartition(" ")[2]]
        shown = printed(value, quantity, system, given=True)
        least, most = (printed(bound, quantity, system, given=True) for bound in (low, high))
        clauses.append(f"{name} {shown} outside the studied {least.number} to {most}")
    if overlapping:
        clauses.append("the cargo meets the pier before the engine lets go")
    return clauses


def cautions(calculation: Calculation) -> list[str]:
    """Return all there is to know before relying on the results, a sentence each."""
    case, design = calculation.case, calculation.design
    sentences = [
        f"The {name} is {rounded(ratio, 3)} times the resistance."
        for name, ratio in calculation.utilisations.items()
        if ratio > 1.0
    ]
    limits = limits_of_the_study(design.outside, design.overlapping, case.inputs.units)
    if limits:
        sentences.append(
            "The design procedure was not checked for this case; compare it with the full model. "
            f"{_capital('; '.join(limits))}."
        )
    status = case.truck_file.status
    if not status.verified:
        sentences.append(
            f"The truck {case.truck.name} is {status.words} ({case.truck_file.source}). "
            "The results are no better than its parameters."
        )
    if case.inputs.assumed:
        names = ", ".join(name_of(key) for key in case.inputs.assumed)
        sentences.append(f"Assumed, not given by any source: {names}.")
    return [*sentences, *case.inputs.notes]


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
