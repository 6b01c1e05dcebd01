"""The spectrum method: the design procedure at its short level, the check by hand."""

from itertools import chain

import numpy as np

from pierimpact.design.procedure import short
from pierimpact.design.reaction import DesignReaction
from pierimpact.plots.spectra import draw_spectra
from pierimpact.report.document.blocks import Block
from pierimpact.report.document.markup import Inline, Tex, inline
from pierimpact.report.document.numbered import Column, Figure, Table, columns, decimal, wide
from pierimpact.report.document.step_writer import StepWriter, in_symbols
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import SYMBOLS
from pierimpact.units import printed, rounded, unit_of, unit_size

_STARTING = tuple(name for name in short.given if name != "on_pier")
_ABREAST = 3  # starting values on a line


class SpectrumMethod(Section):
    """The short level of the design procedure, and its ratio to the full model.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(file.case)
    >>> sheet.spectrum_method.check().rows[-1]  # full model [kN], spectrum method [kN], ratio
    ['Governing', '7157', '7470', '1.04']
    """

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the short level, by name."""
        return {step.name: "tab-short" for step in self.calculation.short.steps}

    def spectra(self) -> Block:
        """Return the engine's and the cargo's reaction against pier frequency."""
        result, frequency = self.calculation, self.calculation.pier.frequency
        history, spectrum = result.history, result.sensitivity.frequency
        pier, first, cargo = (
            self.shown(frequency, "frequency"),
            history.before_cargo,
            history.cargo_peak,
        )
        article = "an" if first == "engine" else "a"
        words = (
            f"{article} {first} peak of {self.shown(history.engine_peak.reaction, 'force')} and "
        )
        words += (
            "no cargo peak"
            if cargo is None
            else f"a cargo peak of {self.shown(cargo.reaction, 'force')}"
        )
        bodies = f"{first} and cargo" if np.isfinite(spectrum.cargo).any() else first
        return Figure(
            label="fig-spectra",
            caption=f"Reaction against pier frequency at this pier’s mass and damping: {bodies} by "
            f"the full model, and dashed by the spectrum method. This pier, {pier}, is marked; "
            "dotted, where what governs changes.",
            alt=f"Spectra of {first} and cargo reaction. At this pier’s {pier} the full model "
            f"gives {words}.",
            svg=draw_spectra(spectrum, frequency, self.system),
        )

    def starting_values(self) -> Block:
        """Return what the method starts from, in the units that values are put in with."""
        writer = self._writer()
        mass = "dynamic mass"
        size = unit_size(mass, self.system) / unit_size("mass", self.system)
        cells: list[list[Inline]] = [
            [Tex(SYMBOLS[name].latex), *writer.shown(name)] for name in _STARTING
        ]
        cells += [["", "", ""]] * (-len(cells) % _ABREAST)
        lines = len(cells) // _ABREAST
        heads: list[Inline | Column] = ["Symbol", decimal("Value"), "Unit"]
        return Table(
            label="tab-given",
            caption="Starting values, in consistent units: forces are masses times accelerations, "
            f"and 1 {unit_of(mass, self.system)} is {printed(size, 'share', 'SI', given=True)} "
            f"{self.unit('mass')}.",
            columns=columns(*heads * _ABREAST),
            rows=[list(chain(*cells[line::lines])) for line in range(lines)],
        )

    def steps(self) -> Block:
        """Return the method step by step."""
        writer = self._writer()
        rows: list[list[Inline]] = [
            [
                inline(SYMBOLS[step.name].heading),
                Tex(rf"\displaystyle {SYMBOLS[step.name].latex} = {in_symbols(step)}"),
                *writer.shown(step.name),
            ]
            for step in self.calculation.short.steps
        ]
        return Table(
            label="tab-short",
            caption="The spectrum method, from the starting values. The numbers in the resonance "
            "terms and in η are fitted to the full model.",
            columns=columns(wide("Step"), "Equation", decimal("Value"), "Unit"),
            rows=rows,
            centred=True,
        )

    def check(self) -> Block:
        """Return the method beside the full model, with the ratio."""
        return beside_model(
            self, self.calculation.short, "tab-check", "spectrum method", ", which decides"
        )

    def _writer(self) -> StepWriter:
        values = self.calculation.short.values
        return StepWriter(values, self.system, _STARTING, units=False, consistent=True)


def beside_model(
    section: Section, level: DesignReaction, label: str, name: str, remark: str = ""
) -> Table:
    """Return the reactions by a level of the procedure beside those of the full model."""
    history = section.calculation.history
    cargo, force = history.cargo_peak, section.unit("force")
    return Table(
        label=label,
        caption=f"Reactions by the full model{remark}, and by the {name}.",
        columns=columns(
            "Reaction",
            decimal(f"Full model [{force}]"),
            decimal(f"{name.capitalize()} [{force}]"),
            decimal("Ratio"),
        ),
        rows=[
            [
                reaction,
                section.number(exact, "force"),
                section.number(closed, "force"),
                "" if closed is None or exact is None else rounded(closed / exact, 3),
            ]
            for reaction, exact, closed in (
                (history.before_cargo.capitalize(), history.engine_peak.reaction, level.engine),
                ("Cargo", cargo.reaction if cargo else None, level.cargo),
                ("Governing", history.governing_peak.reaction, level.reaction),
            )
        ],
        strong=[2],
    )
