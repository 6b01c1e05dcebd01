"""The first page: head, results, warnings and contents."""

import math
from collections.abc import Iterator, Sequence

from pierimpact.design.codes import aashto_lrfd
from pierimpact.design.domain import Outside
from pierimpact.files.plausible import unusual
from pierimpact.pier.static_forces import TOO_LOW
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import (
    Block,
    Contents,
    Headline,
    Notice,
    Paragraph,
    TitleBlock,
)
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import BY_KEY, SYMBOLS
from pierimpact.units import Printed, printed, rounded, stated, unit_size
from pierimpact.vehicle.truck import another_truck

#: Window of the average that the force of AASHTO LRFD was taken from, as read in NCHRP Report 892
#: [s].
AVERAGE = 0.025
#: The member forces that are checked, and what kind of quantity they are.
DEMANDS = {"shear": "force", "moment": "moment"}
#: The methods by which they are found, in words.
METHODS = {"beam": "column as a beam", "static": "static reaction"}


class Summary(Section):
    """The first page."""

    def title_block(self) -> Block:
        """Return the head of the sheet."""
        inputs = self.case.inputs
        date = inputs.date.isoformat()
        return TitleBlock(
            title="Truck collision with a bridge pier",
            subtitle="Calculation sheet. Coupled mass-spring-damper (CMSD) model of the collision",
            entries={
                "Project": inputs.project,
                "Element": inputs.element,
                "Job number": inputs.job_number,
                "Revision": inputs.revision,
                "Prepared by": inputs.prepared_by,
                "Checked by": inputs.checked_by,
                "Date": date,
            },
            date=date,
            paper="a4" if self.system == "SI" else "us-letter",
        )

    def results(self) -> Block:
        """Return the results in large type."""
        result = self.calculation
        design, peak, pier = result.design, result.governing_peak, result.pier
        height = self.stated(result.struck.impact_height, "length")
        parts = f"engine {self.shown(design.engine, 'force')}"
        if design.cargo is not None:
            parts += f", cargo {self.shown(design.cargo, 'force')}"
        results = [
            (
                "Design reaction",
                self.shown(result.design_force, "force"),
                f"static, at {height} above the ground; by the {result.governing_method}",
            ),
            ("Design procedure", self.shown(design.reaction, "force"), parts),
            (
                "Full model",
                self.shown(peak.reaction, "force"),
                f"{result.history.governs} peak; procedure over model {rounded(result.ratio, 3)}",
            ),
            self._demand("shear"),
            self._demand("moment"),
            (
                "Pier frequency",
                self.shown(pier.frequency, "frequency"),
                f"{self.shown(pier.stiffness, 'stiffness')}, {self.shown(pier.mass, 'mass')}",
            ),
            *self._how_sure(),
        ]
        return Headline(results=results)

    def _how_sure(self) -> list[tuple[str, Printed, str]]:
        """Return the band of the reaction, what moves it most, and an average to compare."""
        band, average = self.calculation.band, self.calculation.average_forces[AVERAGE]
        results = []
        if band.spread:
            low, middle, high = band.quantiles()
            ends = f"{self.number(low, 'force')}–{self.number(high, 'force')}"
            middle_words = (
                f"5 to 95 % of trucks of this spread; median {self.number(middle, 'force')}"
            )
            results.append(("Band", Printed(ends, self.unit("force")), middle_words))
            name, share = next(iter(band.influence.items()))
            words = f"of its variance: {BY_KEY[name].meaning}, {band.spread[name].words}"
            results.append(("Moved most by", Printed(rounded(100.0 * share, 2), "%"), words))
        if average is not None:
            code = aashto_lrfd()
            ratio = rounded(average.force / code.along.value, 3)
            words = f"contact force; {ratio} times that of {code.code}, which is such an average"
            name = f"Largest {self.shown(AVERAGE, 'time', given=True)} average"
            results.append((name, self.shown(average.force, "force"), words))
        return results

    def _demand(self, name: str) -> tuple[str, Printed, str]:
        """Return the utilisation where there is a resistance, else the demand."""
        demand = self.calculation.demands[name]
        shown, method = self.shown(demand.value, DEMANDS[name]), METHODS[demand.method]
        ratio = self.calculation.utilisations.get(name)
        if ratio is None:
            return f"Largest {name}", shown, f"{method}; no resistance given"
        words = f"{shown}, {method}: {verdict(ratio)}"
        return f"Utilisation in {name}", Printed(rounded(ratio, 3), ""), words

    def governing_statement(self) -> Block:
        """Return which contacts are made, which peak governs, and which method the result is of."""
        history = self.calculation.history
        contacts = ""
        if history.cargo_contact_time is None:
            contacts = "The cargo does not reach the pier: there is no cargo peak. "
        if history.engine_contact_time is None:
            contacts += (
                "The engine does not reach the pier either: its"
                if contacts
                else "The engine does not reach the pier before the cargo does: its"
            )
            contacts += " peak is the pier’s response to the crumpling of the truck alone. "
        known = (
            "The truck’s parameters carry no spread, as if they were known exactly. "
            if not self.calculation.band.spread
            else ""
        )
        return Paragraph(
            f"{contacts}{known}The {self.calculation.governs} peak governs. The design reaction is "
            "that of the design procedure, which can be followed by hand, or the peak of the full "
            f"model if that is larger; here it is that of the {self.calculation.governing_method}. "
            f"The comparison with codes is under this reaction as a static force. {self._members()}"
        )

    def _members(self) -> str:
        asked = self.case.inputs.member_forces
        if asked == "static":
            return "So are member forces and utilisations, as the case asks."
        larger = (
            ""
            if asked == "beam"
            else (", or those under the static reaction where they are larger")
        )
        return (
            "Member forces and utilisations are those of the same collision with the column as a "
            f"beam{larger}."
        )

    def warnings(self) -> Block:
        """Return what a reader must know before relying on the results."""
        return Notice(heading="Before you rely on this", body=list(limitations(self.calculation)))

    def contents(self) -> Block:
        """Return the list of contents."""
        return Contents()


def verdict(ratio: float) -> str:
    """Return what a utilisation means."""
    return "within the resistance" if ratio <= 1.0 else "exceeds the resistance"


def limitations(calculation: Calculation) -> Iterator[str]:
    """Yield all that limits the results, a sentence each, the user's own notes last."""
    case, design = calculation.case, calculation.design
    for name, ratio in calculation.utilisations.items():
        if ratio > 1.0:
            yield f"The {name} is {rounded(ratio, 3)} times the resistance."
    for name, demand in calculation.demands.items():
        if demand.ratio is not None and demand.ratio < TOO_LOW:
            yield (
                f"The column as a beam takes {rounded(1.0 / demand.ratio, 3)} times the {name} "
                "that the static reaction gives: one degree of freedom does not represent this "
                "column."
            )
    if case.column.top_mass and math.isinf(case.column.supports[1].stiffness):
        yield "The mass at the top has no effect: the top of this column does not move sideways."
    yield from (found.sentence(case.inputs.units) for found in unusual(case.inputs))
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
    if calculation.beam_forces is None and not calculation.static_forces.hold:
        yield calculation.static_forces.sentence
    limits = "; ".join(limits_of_the_study(design.outside, design.overlapping, case.inputs.units))
    if limits:
        yield (
            "The design procedure was not checked for this case; compare it with the full model. "
            f"{limits[:1].upper()}{limits[1:]}."
        )
    status = case.truck_file.status
    if not status.verified:
        yield (
            f"The truck {case.truck.name} is {status.words} ({case.truck_file.source}). "
            "The results are no better than its parameters."
        )
    if case.inputs.assumed:
        names = ", ".join(BY_KEY[key].meaning for key in case.inputs.assumed)
        yield f"Assumed, not given by any source: {names}."
    yield from case.inputs.notes


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
