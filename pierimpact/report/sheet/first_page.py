"""The first page: what the sheet comes to, how sure it is, and who answers for it."""

from collections.abc import Iterator

from pierimpact.design.codes import aashto_lrfd
from pierimpact.plots.situation import draw_situation
from pierimpact.report.calculation import AVERAGE
from pierimpact.report.document.blocks import (
    Block,
    Contents,
    Notice,
    Paragraph,
    Signatures,
    TitleBlock,
    Verdict,
)
from pierimpact.report.document.markup import Inline
from pierimpact.report.document.numbered import Table, columns, decimal, wide
from pierimpact.report.sheet.section import Section
from pierimpact.report.warnings import warnings_of
from pierimpact.symbols import BY_KEY
from pierimpact.units import Printed, rounded

#: The member forces that are checked, and what kind of quantity they are.
DEMANDS = {"shear": "force", "moment": "moment"}
#: The methods by which they are found, in words.
METHODS = {"beam": "column as a beam", "static": "static reaction"}

# As many as a reader takes in; the others stand with the limits: this project's choice.
_FIRST_WARNINGS = 4


class FirstPage(Section):
    """The first page."""

    def title_block(self) -> Block:
        """Return the head of the sheet."""
        inputs, logo = self.case.inputs, self.case.logo
        date = inputs.date.isoformat()
        return TitleBlock(
            title="Truck collision with a bridge pier",
            subtitle="Calculation sheet. Coupled mass-spring-damper (CMSD) model of the collision",
            entries={
                "Project": inputs.project,
                "Element": inputs.element,
                "Job number": inputs.job_number,
                "Revision": inputs.revision,
                "Date": date,
            },
            running={"Prepared by": inputs.prepared_by, "Checked by": inputs.checked_by},
            office="" if inputs.office == "—" else inputs.office,
            logo=logo and (logo.mime, logo.base64),
            date=date,
            paper="a4" if self.system == "SI" else "us-letter",
        )

    def verdict(self) -> Block:
        """Return what the sheet comes to, a drawing of the case, and its results."""
        result, struck = self.calculation, self.calculation.struck
        height = self.stated(struck.impact_height, "length")
        reaction = self.shown(result.design_force, "force")
        return Verdict(
            statement=self._statement(),
            stops=any(ratio > 1.0 for ratio in result.utilisations.values()),
            svg=draw_situation(
                self.case.column,
                struck.impact_height,
                self.case.truck,
                result.design_force,
                self.system,
            ),
            alt=f"The column, {self.shown(self.case.column.height, 'length', given=True)} high, "
            f"its section and the truck, to scale. The reaction of {reaction} acts at {height}.",
            results=list(self._results()),
        )

    def _statement(self) -> str:
        """Return in a sentence whether the column holds, and how surely."""
        result = self.calculation
        ratios = result.utilisations
        if not ratios:
            shear, moment = self._largest()
            return (
                f"The column must resist a shear of {shear} and a moment of {moment}. The case "
                "gives no resistance: nothing is checked against it."
            )
        missing = "".join(f" The {name} is not checked." for name in DEMANDS if name not in ratios)
        failing = {name: ratio for name, ratio in ratios.items() if ratio > 1.0}
        if failing:
            return f"The column does not hold: utilisation {_listed(failing)}.{missing}"
        holds = f"The column holds this truck: utilisation {_listed(ratios)}"
        if self._upper is None:
            return f"{holds}, if the truck is known exactly.{missing}"
        at_upper = {name: ratio * self._upper for name, ratio in ratios.items()}
        beyond = {name: ratio for name, ratio in at_upper.items() if ratio > 1.0}
        if beyond:
            return (
                f"{holds}; but not every truck of its spread: {_listed(beyond)} at the upper end "
                f"of the band.{missing}"
            )
        return f"{holds}; {_listed(at_upper)} at the upper end of the band.{missing}"

    @property
    def _upper(self) -> float | None:
        """Upper end of the band over the design reaction; None where there is no band."""
        band = self.calculation.band
        return band.quantiles()[2] / self.calculation.design_force if band.spread else None

    def _largest(self) -> list[Printed]:
        return [
            self.shown(self.calculation.demands[name].value, quantity)
            for name, quantity in DEMANDS.items()
        ]

    def _results(self) -> Iterator[tuple[str, Printed, Inline]]:
        """Yield the results beside the drawing: label, value and remark."""
        result, pier = self.calculation, self.calculation.pier
        height = self.stated(result.struck.impact_height, "length")
        of_both = " (the larger of both heights)" if len(result.impacts) > 1 else ""
        yield (
            "Design reaction",
            self.shown(result.design_force, "force"),
            f"{result.governs} peak of the full model, at {height} above the ground{of_both}; by "
            f"hand {self.shown(result.short.reaction, 'force')}, {rounded(result.ratio, 3)} times",
        )
        band = result.band
        if band.spread:
            low, _, high = (self.number(value, "force") for value in band.quantiles())
            name, share = next(iter(band.influence.items()))
            yield (
                "Band, 5 to 95 %",
                Printed(f"{low}–{high}", self.unit("force")),
                "as the truck’s parameters vary within their spread; moved most by the "
                f"{BY_KEY[name].meaning}, {band.spread[name].words}: "
                f"{rounded(100.0 * share, 2)} % of the variance",
            )
        for (name, demand), shown in zip(result.demands.items(), self._largest(), strict=True):
            of_static = (
                ""
                if demand.beam is None
                else f"; static over beam {rounded(demand.ratio or 0.0, 3)}"
            )
            yield f"Largest {name}", shown, f"{METHODS[demand.method]}{of_static}"
        average = result.average_forces[AVERAGE]
        if average is not None:
            code = aashto_lrfd(self.system)
            yield (
                f"Largest {self.shown(AVERAGE, 'time', given=True)} average",
                self.shown(average.force, "force"),
                f"of the contact force: {rounded(result.code_ratio or 0.0, 3)} times the "
                f"{self.shown(code.along.value, 'force', given=True)} of {code.code}, which is "
                "such an average",
            )
        yield (
            "Pier frequency",
            self.shown(pier.frequency, "frequency"),
            f"{self.shown(pier.stiffness, 'stiffness')}, {self.shown(pier.mass, 'mass')}",
        )

    def utilisations(self) -> Block | None:
        """Return demand, resistance and utilisation by either method; None without resistance."""
        inputs, result = self.case.inputs, self.calculation
        if not result.utilisations:
            return None
        rows: list[list[Inline]] = []
        resistances = (inputs.shear_resistance, inputs.moment_resistance)
        for (name, quantity), resistance in zip(DEMANDS.items(), resistances, strict=True):
            demand = result.demands[name]
            cells: list[Inline] = [
                f"{name.capitalize()} [{self.unit(quantity)}]",
                self.number(demand.static, quantity),
                self.number(demand.beam, quantity),
                METHODS[demand.method],
            ]
            if resistance is None:
                rows.append([*cells, "not given", "", "", "not checked"])
                continue
            ratio = demand.value / resistance
            at_upper = None if self._upper is None else ratio * self._upper
            rows.append(
                [
                    *cells,
                    self.number(resistance, quantity, given=True),
                    rounded(ratio, 3),
                    "" if at_upper is None else rounded(at_upper, 3),
                    verdict(ratio, at_upper),
                ]
            )
        return Table(
            label="tab-utilisation",
            caption="Largest member force over its resistance, by the method that governs; and at "
            "the upper end of the band, in proportion to the reaction.",
            columns=columns(
                "Check",
                decimal("Static"),
                decimal("Beam"),
                "Governs",
                decimal("Resistance"),
                decimal("Utilisation"),
                decimal("at 95 %"),
                wide("Verdict"),
            ),
            rows=rows,
            strong=[
                number
                for number, name in enumerate(DEMANDS)
                if result.utilisations.get(name, 0.0) > 1.0
            ],
        )

    def contacts(self) -> Block | None:
        """Return which contacts are not made; None where both are."""
        history = self.calculation.history
        if history.cargo_contact_time is None and history.engine_contact_time is None:
            return Paragraph(
                "Neither engine nor cargo reaches the pier: the reaction is the pier’s response to "
                "the crumpling of the truck alone, and there is no cargo peak."
            )
        if history.cargo_contact_time is None:
            return Paragraph("The cargo does not reach the pier: there is no cargo peak.")
        if history.engine_contact_time is None:
            return Paragraph(
                "The engine does not reach the pier before the cargo does: its peak is the pier’s "
                "response to the crumpling of the truck alone."
            )
        return None

    def warnings(self) -> Block:
        """Return what a reader must know first before relying on the results."""
        first = warnings_of(self.calculation)
        more = len(first) - _FIRST_WARNINGS
        if more > 0:
            first = [
                *first[:_FIRST_WARNINGS],
                f"{more} more {'stands' if more == 1 else 'stand'} with the limits, at the end.",
            ]
        return Notice(heading="Before you rely on this", body=first)

    def other_warnings(self) -> Block | None:
        """Return the warnings that the first page has no room for; None where there are none."""
        others = warnings_of(self.calculation)[_FIRST_WARNINGS:]
        return Notice(heading="Further warnings", body=others) if others else None

    def signatures(self) -> Block:
        """Return the boxes to sign, and the revisions."""
        inputs = self.case.inputs
        return Signatures(
            signers=[
                ("Prepared", inputs.prepared_by),
                ("Checked", inputs.checked_by),
                ("Approved", inputs.approved_by),
            ],
            revisions=[
                [revision.revision, revision.date.isoformat(), revision.description, revision.by]
                for revision in inputs.revisions
            ],
        )

    def contents(self) -> Block | None:
        """Return the list of contents; None where there are no annexes to look for."""
        return Contents() if self.case.inputs.annexes else None


def verdict(ratio: float, at_upper: float | None) -> str:
    """Return what a utilisation means, and that at the upper end of the band."""
    if ratio > 1.0:
        return "EXCEEDS the resistance"
    if at_upper is not None and at_upper > 1.0:
        return "within, but EXCEEDS at 95 %"
    return "within the resistance"


def _listed(ratios: dict[str, float]) -> str:
    """Return utilisations as "0.71 in shear and 0.86 in moment"."""
    return " and ".join(f"{rounded(ratio, 3)} in {name}" for name, ratio in ratios.items())
