"""The first page: what the sheet comes to, how sure it is, and who answers for it."""

from pierimpact.plots.situation import draw_situation
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
from pierimpact.report.outcome import (
    DEMANDS,
    METHODS,
    first_results,
    listed,
    mark,
    most_used,
    statement,
    verdict,
)
from pierimpact.report.sheet.section import Section
from pierimpact.report.warnings import warnings_beside_verdict
from pierimpact.units import compared, rounded

# As many as a reader takes in; the others stand with the limits: this project's choice.
_FIRST_WARNINGS = 4


class FirstPage(Section):
    """The first page.

    Examples
    --------
    >>> from pierimpact.files.case import case_from, read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(case_from(file.values | {"shear_resistance": "8 MN"}))
    >>> sheet.first_page.utilisations().rows[0][-3:]  # utilisation, at 95 %, verdict
    ['0.821', '1.07', 'within, but EXCEEDS at 95 %']
    """

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
            statement=statement(result),
            mark=mark(result),
            svg=draw_situation(
                self.case.column,
                struck.impact_height,
                self.case.truck,
                result.design_force,
                self.system,
            ),
            alt=f"The column, {self.shown(self.case.column.height, 'length', given=True)} high, "
            f"its section and the truck, to scale. The reaction of {reaction} acts at {height}.",
            results=list(first_results(result)),
        )

    def _at_upper_end(self) -> str:
        """Return what utilisations at the upper end of the band are of, if there is one."""
        result = self.calculation
        if not result.upper_utilisations:
            return ""
        by_method = next(iter(result.sampled_demands.values()))
        asked = self.case.inputs.member_forces
        words = f" At 95 %: what 95 % of {len(by_method[asked])} sampled trucks stay below"
        if asked == "larger":
            static, beam = (
                listed(result.upper_utilisations_by(method)) for method in ("static", "beam")
            )
            words += (
                ", of each truck the larger of both methods; by the static reaction alone "
                f"{static}, by the column as a beam alone {beam}"
            )
        return f"{words}."

    def utilisations(self) -> Block | None:
        """Return demand, resistance and utilisation by either method; None without resistance."""
        inputs, result = self.case.inputs, self.calculation
        upper = result.upper_utilisations
        if not result.utilisations:
            return None
        larger = inputs.member_forces == "larger"
        rows: list[list[Inline]] = []
        for name, quantity in DEMANDS.items():
            check = result.uses.get(name)
            demand = check.demand if check else result.demands[name]
            part = most_used(result, name) if check else ""
            cells: list[Inline] = [
                f"{name.capitalize()} [{self.unit(quantity)}]",
                self.number(demand.static, quantity),
                self.number(demand.beam, quantity),
                METHODS[demand.method] + (f", {part}" if part else ""),
            ]
            if check is None:
                rows.append([*cells, "not given", "", *([""] if upper else []), "not checked"])
                continue
            cells += [self.number(check.resistance, quantity, given=True)]
            cells.append(compared(check.utilisation))
            if upper:
                cells.append(compared(upper[name]))
            rows.append([*cells, verdict(check.utilisation, upper.get(name))])
        return Table(
            label="tab-utilisation",
            caption="Largest member force over its resistance, by the method that "
            f"{'governs' if larger else 'the case asks for'}.{self._at_upper_end()}",
            columns=columns(
                "Check",
                decimal("Static"),
                decimal("Beam"),
                "Governs" if larger else "Checked by",
                decimal("Resistance"),
                decimal("Utilisation"),
                *([decimal("at 95 %")] if upper else []),
                wide("Verdict"),
            ),
            rows=rows,
            strong=[
                number
                for number, name in enumerate(DEMANDS)
                if max(result.utilisations.get(name, 0.0), upper.get(name, 0.0)) > 1.0
            ],
        )

    def contacts(self) -> Block | None:
        """Return which contacts are not made; None where both are."""
        history, band = self.calculation.history, self.calculation.band
        engine, cargo = (
            time is not None for time in (history.engine_contact_time, history.cargo_contact_time)
        )
        if engine and cargo:
            return None
        words = {
            (False, False): "Neither engine nor cargo reaches the pier: the reaction is the pier’s "
            "response to crumpling sheet metal alone, and there is no cargo peak.",
            (True, False): "The cargo does not reach the pier: there is no cargo peak.",
            (False, True): "The engine does not reach the pier before the cargo does: the peak "
            "before is the pier’s response to crumpling sheet metal alone.",
        }[engine, cargo]
        shares = {}
        if band.spread and not engine:
            shares["engine"] = band.engine_contact
        if band.spread and not cargo:
            shares["cargo"] = band.cargo_contact
        others = [
            f"the {body} of {rounded(100.0 * share, 2)} %"
            for body, share in shares.items()
            if share
        ]
        if others:
            do = "do" if len(others) > 1 else "does"
            words += f" Of the sampled trucks {' and '.join(others)} {do}."
        return Paragraph(words)

    def warnings(self) -> Block:
        """Return what a reader must know first before relying on the results."""
        first = warnings_beside_verdict(self.calculation)
        more = len(first) - _FIRST_WARNINGS
        if more > 0:
            first = [
                *first[:_FIRST_WARNINGS],
                f"{more} more {'stands' if more == 1 else 'stand'} with the limits, at the end.",
            ]
        return Notice(heading="Before you rely on this", body=first)

    def other_warnings(self) -> Block | None:
        """Return the warnings that the first page has no room for; None where there are none."""
        others = warnings_beside_verdict(self.calculation)[_FIRST_WARNINGS:]
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
