"""What a case comes to in words: the verdict, and the results that stand first."""

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import NamedTuple

from pierimpact.design.codes import aashto_lrfd
from pierimpact.report.calculation import AVERAGE, Calculation
from pierimpact.symbols import BY_KEY
from pierimpact.units import Printed, compared, printed, rounded, stated, stretch, unit_of

#: The member forces that are checked, and what kind of quantity they are.
DEMANDS = {"shear": "force", "moment": "moment"}
#: The methods by which they are found, in words.
METHODS = {"beam": "column as a beam", "static": "static reaction"}


class FirstResult(NamedTuple):
    """A result as it stands beside the verdict."""

    label: str
    value: Printed
    remark: str


def statement(calculation: Calculation) -> str:
    """Return in a sentence whether the column holds, and how surely."""
    ratios, at_upper = calculation.utilisations, calculation.upper_utilisations
    if not ratios:
        shear, moment = _largest(calculation)
        return (
            f"The column must resist a shear of {shear} and a moment of {moment}. The case "
            "gives no resistance: nothing is checked against it."
        )
    missing = "".join(f" The {name} is not checked." for name in DEMANDS if name not in ratios)
    failing = {name: ratio for name, ratio in ratios.items() if ratio > 1.0}
    beyond = {
        name: ratio for name, ratio in at_upper.items() if ratio > 1.0 and name not in failing
    }
    if failing:
        more = f"; at the upper end of the band {listed(beyond)}, too" if beyond else ""
        of_what = _of_what(failing, calculation)
        return f"The column does not hold: utilisation {listed(failing)}{more}{of_what}.{missing}"
    checked = " as far as it is checked" if missing else ""
    holds = f"The column holds this truck{checked}: utilisation {listed(ratios)}"
    holds += _of_what(ratios, calculation)
    if not at_upper:
        return f"{holds}, if the truck is known exactly.{missing}"
    if beyond:
        return (
            f"{holds}; but not every truck of its spread: {listed(beyond)} at the upper end "
            f"of the band.{missing}"
        )
    return f"{holds}; {listed(at_upper)} at the upper end of the band.{missing}"


def _of_what(ratios: Mapping[str, float], calculation: Calculation) -> str:
    """Return which of these utilisations are of a resistance that different parts share."""
    names = [name for name in shared(calculation) if name in ratios]
    if not names:
        return ""
    where = "" if len(names) == len(ratios) else f"in {names[0]} "
    return f", {where}of one resistance for parts that differ"


def shared(calculation: Calculation) -> list[str]:
    """Return of "shear" and "moment" those whose resistance parts of different sections share."""
    case = calculation.case
    steps = list(zip(case.inputs.steps, pairwise(case.parts), strict=True))
    return [
        name
        for name in calculation.resistances
        if any(
            getattr(step, f"{name}_resistance") is None and below.section != above.section
            for step, (below, above) in steps
        )
    ]


def mark(calculation: Calculation) -> str:
    """Return what stands before that sentence: "STOP", "CAUTION" or nothing."""
    if any(ratio > 1.0 for ratio in calculation.utilisations.values()):
        return "STOP"
    beyond = any(ratio > 1.0 for ratio in calculation.upper_utilisations.values())
    return "CAUTION" if beyond else ""


def most_used(calculation: Calculation, name: str) -> str:
    """Return from where to where the part goes that a utilisation is of.

    Empty where all of the column resists the same.
    """
    part = calculation.uses[name].part
    if part == calculation.case.whole:
        return ""
    return stretch(part.low, part.high, calculation.case.inputs.units)


def verdict(ratio: float, at_upper: float | None) -> str:
    """Return what a utilisation means, and that at the upper end of the band."""
    if ratio > 1.0:
        return "EXCEEDS the resistance"
    if at_upper is not None and at_upper > 1.0:
        return "within, but EXCEEDS at 95 %"
    return "within the resistance"


def first_results(calculation: Calculation) -> Iterator[FirstResult]:
    """Yield the results that stand beside the verdict."""
    result, pier, system = calculation, calculation.pier, calculation.case.inputs.units

    def shown(value: float, quantity: str, *, given: bool = False) -> Printed:
        return printed(value, quantity, system, given=given)

    height = stated(result.struck.impact_height, "length", system)
    of_both = " (the larger of both heights)" if len(result.impacts) > 1 else ""
    yield FirstResult(
        "Design reaction",
        shown(result.design_force, "force"),
        f"{result.governs} peak of the full model, at {height} above the ground{of_both}; by "
        f"hand {shown(result.short.reaction, 'force')}, {rounded(result.ratio, 3)} times"
        f"{'' if result.checked_by_hand else ', which is no check here'}",
    )
    if result.reaction_band is not None:
        low, middle, high = (shown(value, "force").number for value in result.reaction_band)
        larger = ", of each truck the larger of both heights" if len(result.impacts) > 1 else ""
        yield FirstResult(
            "Band, 5 to 95 %",
            Printed(f"{low}–{high}", unit_of("force", system)),
            f"as the truck’s parameters{_but_for(result)} vary within their spread{larger}: half "
            f"above {middle}, {rounded(100.0 * result.share_above, 2)} % above the design "
            f"reaction; {_moved_most(result)}",
        )
    for (name, demand), value in zip(result.demands.items(), _largest(result), strict=True):
        of_static = (
            "" if demand.beam is None else f"; static over beam {rounded(demand.ratio or 0.0, 3)}"
        )
        ends = [shown(end, DEMANDS[name]) for end in result.demand_bands.get(name, ())]
        larger = ", of each truck the larger" if demand.asked == "larger" else ""
        in_band = f"; 5 to 95 %: {ends[0].number}–{ends[1]}{larger}" if ends else ""
        yield FirstResult(f"Largest {name}", value, f"{METHODS[demand.method]}{in_band}{of_static}")
    code = aashto_lrfd(system)
    yield FirstResult(
        f"Largest {shown(AVERAGE, 'time', given=True)} average",
        shown(result.average_forces[AVERAGE].force, "force"),
        f"of the contact force: {rounded(result.code_ratio, 3)} times the "
        f"{shown(code.along.value, 'force', given=True)} of {code.code}, which is such an "
        f"average{_under_code(result)}",
    )
    yield FirstResult(
        "Pier frequency",
        shown(pier.frequency, "frequency"),
        f"{shown(pier.stiffness, 'stiffness')}, {shown(pier.mass, 'mass')}",
    )


def _under_code(calculation: Calculation) -> str:
    """Return what the force of AASHTO LRFD alone comes to, where something is checked."""
    _, height, forces = calculation.aashto_effect
    if forces is None or not calculation.resistances:
        return ""
    ratios = calculation.utilisations_under(forces)
    place = printed(height, "length", calculation.case.inputs.units, given=True)
    return f"; that force alone, at {place}: utilisation {listed(ratios)}"


def _moved_most(calculation: Calculation) -> str:
    """Return which parameter moves the reaction most, if any does."""
    band, several = calculation.band, len(calculation.impacts) > 1
    name, share = next(iter(band.influence.items()))
    if share == 0.0:
        return "the spread that the truck file gives does not move it"
    return (
        f"moved most by the {BY_KEY[name].meaning}, {band.spread[name].words}: "
        f"{rounded(100.0 * share, 2)} % of the variance, alone and with others"
        f"{', at the height that governs' if several else ''}"
    )


def _but_for(calculation: Calculation) -> str:
    """Return which mass of the truck has no spread as the case gives it, if any."""
    case = calculation.case
    spread = case.truck_file.truck.spread
    given = "body_mass" in spread and "body_mass" not in case.truck.spread
    return ", but for its body’s mass, which the case gives," if given else ""


def _largest(calculation: Calculation) -> list[Printed]:
    """Return the largest shear and moment."""
    system = calculation.case.inputs.units
    return [
        printed(calculation.demands[name].value, quantity, system)
        for name, quantity in DEMANDS.items()
    ]


def listed(ratios: dict[str, float]) -> str:
    """Return utilisations as "0.71 in shear and 0.86 in moment"."""
    return " and ".join(f"{compared(ratio)} in {name}" for name, ratio in ratios.items())
