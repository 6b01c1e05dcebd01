"""What moves the reaction most, and, in an annex, how it changes with all that it depends on."""

from pierimpact.design.sensitivity import MASS_CHANGE, NEAR
from pierimpact.plots.band import draw_band
from pierimpact.plots.figures import draw_sensitivity
from pierimpact.plots.tornado import draw_tornado
from pierimpact.report.document.blocks import Block
from pierimpact.report.document.markup import Inline
from pierimpact.report.document.numbered import Figure, Table, columns, decimal
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import BY_KEY
from pierimpact.units import rounded


class Variations(Section):
    """What the reaction depends on.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.plots.figures import figure_of
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(file.case)
    >>> figure = figure_of(sheet.sensitivity.tornado)
    >>> figure.axes[0].get_yticklabels()[0].get_text()  # what moves the reaction most
    'Engine mass $m_1$'
    """

    def tornado(self) -> Block:
        """Return what moves the governing reaction most."""
        result = self.calculation
        step = self.shown(result.sensitivity.speed_change, "speed", given=True)
        spread = ", the truck’s parameters within their spread" if result.band.spread else ""
        return Figure(
            label="fig-tornado",
            caption="Governing reaction by the full model as one thing changes, those that move it "
            f"most: of speed by {step}, mass by {100.0 * MASS_CHANGE:g} % with other cargo, impact "
            f"height and pier frequency by about {100.0 * NEAR:g} %{spread}.",
            alt="What moves the governing reaction, the largest change first.",
            svg=draw_tornado(
                result.sensitivity,
                result.band,
                result.design_force,
                self.system,
            ),
        )


class Sensitivities(Section):
    """Annex: the reaction over speed, mass, height and frequency, and the band of the truck.

    Examples
    --------
    >>> from pierimpact.files.case import case_from, read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(case_from(file.values | {"annexes": ["sensitivity"]}))
    >>> change, value, by_hand, full_model, *_ = sheet.sensitivities.table().rows[1]
    >>> change, value, by_hand, full_model  # kN
    ('Speed less 10 km/h', '70 km/h', '5412', '5285')
    """

    def figure(self) -> Block:
        """Return the governing reaction against speed, mass, impact height and pier frequency."""
        result = self.calculation
        here = {
            "speed": self.case.inputs.speed,
            "mass": self.case.truck.mass,
            "impact_height": result.struck.impact_height,
            "frequency": result.pier.frequency,
        }
        forces = result.governing_peak.reaction, result.short.reaction
        speeds = result.sensitivity.speed
        ends = " and ".join(
            f"{self.shown(float(speeds.model[i]), 'force')} at "
            f"{self.shown(float(speeds.values[i]), 'speed')}"
            for i in (0, -1)
        )
        return Figure(
            label="fig-sensitivity",
            caption="Governing reaction against speed, truck mass, impact height and pier "
            "frequency, one changed at a time; this case is marked. With the mass only the cargo "
            "changes, with the impact height mass and stiffness of the pier.",
            alt=f"Governing reaction against four quantities. By the full model it is {ends}.",
            svg=draw_sensitivity(result.sensitivity, here, forces, self.system),
        )

    def band(self) -> Block | None:
        """Return the band of reactions and what moves it; None where the truck has no spread."""
        band = self.calculation.band
        if not band.spread:
            return None
        low, _, high = (self.shown(value, "force") for value in band.quantiles())
        name = BY_KEY[next(iter(band.influence))].meaning
        sources = dict.fromkeys(
            (own.spread_source or "none given") + (f" ({status.words})" if status else "")
            for own in self.case.truck_file.parameters
            for status in [own.spread_status]
            if own.name in band.spread
        )
        height = self.stated(self.calculation.struck.impact_height, "length")
        at_one = (
            f" at {height}, the height that governs" if len(self.calculation.impacts) > 1 else ""
        )
        return Figure(
            label="fig-band",
            caption=f"Reactions by the full model{at_one} as the truck’s parameters vary within "
            f"their spread: 5 to 95 % of {len(band.governing)} sampled trucks, and the governing "
            "reaction with one parameter at a time at either end; with its share of the variance, "
            "alone and with others, so that the shares may add up to more than 100 %. Source of "
            f"the spreads: {'; '.join(sources)}.",
            alt=f"Nine of ten governing reactions are from {low} to {high}. The {name} moves it "
            "most.",
            svg=draw_band(band, self.system),
        )

    def table(self) -> Block:
        """Return the reactions at other speeds and masses."""
        result, found = self.calculation, self.calculation.sensitivity
        speed, mass = self.case.inputs.speed, self.case.truck.mass
        step = self.shown(found.speed_change, "speed", given=True)
        share = f"{100.0 * MASS_CHANGE:g} %"
        here = result.short.reaction, result.governing_peak.reaction
        rows = [self._row("This case", "", *here)]
        for name, variation, quantity, value in (
            (f"Speed less {step}", found.slower, "speed", speed - found.speed_change),
            (f"Speed more {step}", found.faster, "speed", speed + found.speed_change),
            (f"Mass less {share}", found.lighter, "mass", mass * (1.0 - MASS_CHANGE)),
            (f"Mass more {share}", found.heavier, "mass", mass * (1.0 + MASS_CHANGE)),
        ):
            if variation is None:
                rows.append([name, "not possible", "", "", "", ""])
                continue
            there = float(variation.design[0]), float(variation.model[0])
            rows.append(self._row(name, str(self.shown(value, quantity, given=True)), *there))
        force = self.unit("force")
        return Table(
            label="tab-sensitivity",
            caption="Reactions at other speeds and masses; the last column is the full "
            "model’s over that of this case.",
            columns=columns(
                "Change",
                "Value",
                decimal(f"Spectrum method [{force}]"),
                decimal(f"Full model [{force}]"),
                decimal("Ratio"),
                decimal("Over this case"),
            ),
            rows=rows,
            strong=[0],
        )

    def _row(self, name: str, value: str, design: float, model: float) -> list[Inline]:
        over = model / self.calculation.design_force
        forces = self.number(design, "force"), self.number(model, "force")
        return [name, value, *forces, rounded(design / model, 3), rounded(over, 3)]
