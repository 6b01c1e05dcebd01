"""What a reader must know before relying on a result, what is least safe first."""

import math
from collections.abc import Iterator, Sequence

from pierimpact.design.band import LEVELS
from pierimpact.design.domain import Outside
from pierimpact.files.inputs import NOT_GIVEN
from pierimpact.files.plausible import unusual
from pierimpact.files.traffic import OF_TRAFFIC
from pierimpact.pier.static_forces import TOO_LOW
from pierimpact.report.calculation import Calculation
from pierimpact.report.outcome import listed, shared
from pierimpact.symbols import BY_KEY, SYMBOLS
from pierimpact.units import Printed, compared, printed, rounded, stated, unit_of, unit_size
from pierimpact.vehicle.truck import another_truck

#: Width of a truck, which spreads at 45° to either side from the impact down to the ground; a
#: column wider than that is a wall: this project's choice [m].
TRUCK_WIDTH = 2.5
# Share of the sampled trucks beyond which a reaction is low among theirs: this project's choice.
_LOW_IN_BAND = 0.67


def warnings_of(calculation: Calculation) -> list[str]:
    """Return all that limits the results of a case, a sentence or two each.

    They are in the order of what they do to safety: what fails; where the method gives too little;
    where an input is likely wrong or is no evidence; where only a check says less than it could;
    where revisions do not go together.
    """
    return [*_exceeded(calculation), *warnings_beside_verdict(calculation)]


def warnings_beside_verdict(calculation: Calculation) -> list[str]:
    """Return the same but for what the verdict says: what fails."""
    return [
        *_under_code(calculation),
        *_one_resistance(calculation),
        *_smaller_asked(calculation),
        *_too_low(calculation),
        *_low_in_band(calculation),
        *_wall(calculation),
        *_another_truck(calculation),
        *_unusual(calculation),
        *_unknown(calculation),
        *_unchecked(calculation),
        *_revisions(calculation),
    ]


def _exceeded(calculation: Calculation) -> Iterator[str]:
    for name, ratio in calculation.utilisations.items():
        if ratio > 1.0:
            yield f"The {name} is {compared(ratio)} times the resistance."


def _under_code(calculation: Calculation) -> Iterator[str]:
    """Yield what holds this truck, and not the force of AASHTO LRFD."""
    code, height, forces = calculation.aashto_effect
    if forces is None:
        return
    kept = calculation.utilisations
    beyond = {
        name: ratio
        for name, ratio in calculation.utilisations_under(forces).items()
        if ratio > 1.0 >= kept[name]
    }
    if beyond:
        system = calculation.case.inputs.units
        force = printed(code.along.value, "force", system, given=True)
        place = printed(height, "length", system, given=True)
        yield (
            f"The force of {code.code} alone, {force} at {place}, exceeds the resistance: "
            f"utilisation {listed(beyond)}."
        )


def _one_resistance(calculation: Calculation) -> Iterator[str]:
    """Yield where parts of different sections are held against the same resistance."""
    names = shared(calculation)
    if names:
        yield (
            "Parts of the column whose sections differ are held against the same "
            f"{' and '.join(names)} resistance. The table by parts has the forces of each; a step "
            "takes resistances of its own."
        )


def _low_in_band(calculation: Calculation) -> Iterator[str]:
    """Yield where most of the sampled trucks give more than the truck of the case."""
    if calculation.band.spread and calculation.share_above > _LOW_IN_BAND:
        yield (
            f"{rounded(100.0 * calculation.share_above, 2)} % of the sampled trucks give a larger "
            "reaction than the truck of the case: the design reaction lies low in its band."
        )


def _smaller_asked(calculation: Calculation) -> Iterator[str]:
    """Yield where the case asks for the column as a beam, and the static reaction gives more."""
    if calculation.case.inputs.member_forces != "beam":
        return
    ratios = {name: demand.ratio or 0.0 for name, demand in calculation.demands.items()}
    of_each = [calculation.utilisations_under(own.member_forces) for own in calculation.impacts]
    static = {name: max(own[name] for own in of_each) for name in calculation.resistances}
    ratios |= {name: _over(used, calculation.utilisations[name]) for name, used in static.items()}
    more = {name: ratio for name, ratio in ratios.items() if ratio > 1.0}
    if not more:
        return
    times = " and ".join(f"{compared(ratio)} times the {name}" for name, ratio in more.items())
    checked = {name: used for name, used in static.items() if name in more}
    utilisation = f", a utilisation of {listed(checked)}" if checked else ""
    yield (
        "The case chose the smaller member forces, those of the column as a beam: the static "
        f"reaction gives {times}{utilisation}."
    )


def _too_low(calculation: Calculation) -> Iterator[str]:
    """Yield where the reaction as a static force gives too little."""
    over_static = {
        name: _over(demand.beam, demand.static)
        for name, demand in calculation.demands.items()
        if demand.beam is not None
    }
    if times := _times_too_low(over_static):
        yield (
            f"The column as a beam takes {times} that the static reaction gives: one degree of "
            "freedom does not represent this column."
        )
    elif over_static and calculation.band.spread:
        beam, static = (calculation.demand_bands_by(method) for method in ("beam", "static"))
        if times := _times_too_low(
            {name: _over(high, static[name][1]) for name, (_, high) in beam.items()}
        ):
            yield (
                f"At the upper end of the band the column as a beam takes {times} that the static "
                "reaction gives."
            )
    if calculation.governing.beam_forces is None:
        band, cargo = calculation.band, calculation.history.cargo_contact_time
        if not calculation.static_forces.hold:
            yield calculation.static_forces.sentence
        elif cargo is None and band.spread and band.cargo_contact > 1.0 - LEVELS[-1]:
            yield (
                f"The cargo of {rounded(100.0 * band.cargo_contact, 2)} % of the sampled trucks "
                "reaches the pier, that of this one does not: whether static shear and moment are "
                "enough for those is not known; the column as a beam gives it."
            )


def _over(one: float, other: float) -> float:
    """Return how many times another force one is; of a base that is struck some are none."""
    return one / other if other > 0.0 else math.inf if one > 0.0 else 0.0


def _times_too_low(over_static: dict[str, float]) -> str:
    """Return by how much a beam's forces are over static ones that are too low; "" if none is."""
    return " and ".join(
        f"{rounded(ratio, 3) if math.isfinite(ratio) else '∞'} times the {name}"
        for name, ratio in over_static.items()
        if ratio * TOO_LOW > 1.0
    )


def _wall(calculation: Calculation) -> Iterator[str]:
    """Yield where the column is wider than what a truck engages of it."""
    case = calculation.case
    # Counted from where the lower height is: there the least of it is engaged.
    height = min(case.impact_heights)
    section = next(own for own, low, high in case.column.stretches if low <= height <= high)
    width, engaged = getattr(section, "width", 0.0), TRUCK_WIDTH + 2.0 * height
    if width > engaged:
        wide = printed(width, "length", case.inputs.units, given=True)
        part, truck = (_about(value, case.inputs.units) for value in (engaged, TRUCK_WIDTH))
        yield (
            f"The column is {wide} wide across the travel, and the sheet takes all of it as one "
            f"beam. A truck about {truck} wide engages some {part} at its foot, spread at 45° (a "
            "rule of this project): stiffness and resistances of the full width may be too large."
        )


def _about(length: float, system: str) -> str:
    """Return a length to no more figures than a rule of thumb has."""
    size = unit_size("length", system)
    return str(Printed(f"{float(f'{length / size:.2g}'):g}", unit_of("length", system)))


def _another_truck(calculation: Calculation) -> Iterator[str]:
    """Yield where the truck's mass is beyond what its springs stand for."""
    case = calculation.case
    mass_range = case.truck_file.mass_range
    if mass_range is not None and not case.truck.in_mass_range:
        masses = (
            stated(value, "mass", case.inputs.units)
            for value in (case.truck.mass, mass_range.low, mass_range.high)
        )
        yield (
            f"{another_truck(case.truck.name, *masses)} The range is {mass_range.status.words}: "
            f"{mass_range.source}."
        )


def _unusual(calculation: Calculation) -> Iterator[str]:
    inputs = calculation.case.inputs
    yield from (found.sentence(inputs.units) for found in unusual(inputs))


def _revisions(calculation: Calculation) -> Iterator[str]:
    """Yield where the revisions of a case do not go together."""
    case = calculation.case
    inputs, earlier = case.inputs, case.superseded_file
    listed = [line.revision for line in inputs.revisions]
    if listed and inputs.revision == NOT_GIVEN:
        yield "The case has a table of revisions, and does not say of which revision it is."
    elif listed and inputs.revision not in listed:
        yield f"The table of revisions has no line for revision {inputs.revision}, of which it is."
    elif listed and inputs.date != inputs.revision_date:
        yield (
            f"The sheet is of {inputs.date}, its revision {inputs.revision} of "
            f"{inputs.revision_date}."
        )
    if earlier is None:
        return
    before = earlier.case.inputs
    this = f"{earlier.name}, which this case supersedes, is"
    if before.revision == inputs.revision != NOT_GIVEN:
        yield f"{this} of revision {before.revision}, too."
    if NOT_GIVEN != before.element != inputs.element != NOT_GIVEN:
        yield f"{this} of another element: {before.element}."


def _unknown(calculation: Calculation) -> Iterator[str]:
    """Yield which inputs nobody has measured."""
    case, status = calculation.case, calculation.case.truck_file.status
    if not status.verified:
        yield (
            f"The truck {case.truck.name} is {status.words} ({case.truck_file.source}). "
            "The results are no better than its parameters."
        )
    if not calculation.band.spread:
        yield "The truck’s parameters carry no spread, as if they were known exactly."
    assumed = [key for key in case.inputs.assumed if key not in OF_TRAFFIC]
    if assumed:
        names = ", ".join(BY_KEY[key].meaning for key in assumed)
        yield f"Assumed, not given by any source: {names}."
    if case.column.top_mass and math.isinf(case.column.supports[1].stiffness):
        yield "The mass at the top has no effect: the top of this column does not move sideways."


def _unchecked(calculation: Calculation) -> Iterator[str]:
    """Yield where the formulas of the check by hand were not tried."""
    short, system = calculation.short, calculation.case.inputs.units
    limits = "; ".join(limits_of_the_study(short.outside, short.overlapping, system))
    if limits:
        yield (
            "The spectrum method was not tried on cases like this one, and is no check of the full "
            f"model here. {limits[:1].upper()}{limits[1:]}."
        )


def limits_of_the_study(outside: Sequence[Outside], overlapping: bool, system: str) -> list[str]:
    """Return a clause for each limit of the study behind the procedure that the case exceeds.

    Parameters
    ----------
    outside : sequence of Outside
        The values outside the studied domain.
    overlapping : bool
        Whether the cargo meets the pier before the engine has separated.
    system : {"SI", "US"}
        Units to print in.
    """
    clauses = []
    for name, *values in outside:
        _, quantity, meaning, _ = SYMBOLS[name]
        shown = printed(values[0], quantity, system, given=True)
        least, most = (rounded(end / unit_size(quantity, system), 3) for end in values[1:])
        studied = Printed(f"{least} to {most}", shown.unit)
        clauses.append(f"{meaning} {shown} outside the studied {studied}")
    if overlapping:
        clauses.append("the cargo meets the pier before the engine has separated")
    return clauses
