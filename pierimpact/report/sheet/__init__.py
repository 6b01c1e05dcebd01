"""The calculation sheet of a case: a file for each of its headings, and a method for each block."""

from collections.abc import Callable
from typing import Any

from pierimpact.files.case import Case
from pierimpact.files.inputs import ANNEXES
from pierimpact.report.calculation import calculate
from pierimpact.report.document.blocks import Annex
from pierimpact.report.results import Results
from pierimpact.report.sheet.closing import Closing
from pierimpact.report.sheet.codes import Codes
from pierimpact.report.sheet.derivation import Derivation
from pierimpact.report.sheet.design_procedure import DesignProcedure
from pierimpact.report.sheet.equivalent_pier import EquivalentPierSteps
from pierimpact.report.sheet.first_page import FirstPage
from pierimpact.report.sheet.full_model import FullModel
from pierimpact.report.sheet.inputs import Inputs
from pierimpact.report.sheet.member_forces import MemberForces
from pierimpact.report.sheet.section import Section
from pierimpact.report.sheet.sensitivity import Sensitivities, Variations
from pierimpact.report.sheet.spectrum_method import SpectrumMethod


class _NotAsked:
    """An annex that is not asked for: each of its blocks is None."""

    def __getattr__(self, name: str) -> Callable[..., None]:
        if name.startswith("_"):  # asked for by Python itself
            raise AttributeError(name)
        return lambda *_: None


class Sheet:
    """The sheet of a case, which is calculated once: a section for each heading.

    Parameters
    ----------
    case : Case
        The case.
    case_file, case_sha256 : str or None, optional
        Name and SHA-256 of the case file, where it is known, for the provenance.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(file.case, file.name, file.sha256)
    >>> sheet.model.peaks().rows[0]  # a notebook shows the table; contact, peak [kN], its time [ms]
    ['Engine', '25.70', '7157', '31.01', 'governs']
    >>> sheet.first_page.utilisations() is None  # the case gives no resistance
    True
    """

    def __init__(
        self, case: Case, case_file: str | None = None, case_sha256: str | None = None
    ) -> None:
        self.case, self.calculation = case, calculate(case)
        self.first_page = FirstPage(self.calculation)
        self.inputs = Inputs(self.calculation)
        self.pier = EquivalentPierSteps(self.calculation)
        self.model = FullModel(self.calculation)
        self.spectrum_method = SpectrumMethod(self.calculation)
        self.member_forces = MemberForces(self.calculation)
        self.codes = Codes(self.calculation)
        self.sensitivity = Variations(self.calculation)
        self.derivation = self._annex("pier", Derivation)
        self.procedure = self._annex("procedure", DesignProcedure)
        self.sensitivities = self._annex("sensitivity", Sensitivities)
        sections = (
            *(self.inputs, self.pier, self.model, self.spectrum_method, self.member_forces),
            *(part for part in (self.derivation, self.procedure) if isinstance(part, Section)),
        )
        self.closing = Closing(self.calculation, sections, case_file, case_sha256)

    def _annex(self, name: str, section: type[Section]) -> Any:
        """Return the section of an annex; one that is not asked for makes no block."""
        return section(self.calculation) if name in self.case.annexes else _NotAsked()

    def annex(self, name: str, title: str) -> Annex:
        """Return the beginning of an annex, one of `ANNEXES`, which the case asks for or not."""
        assert name in ANNEXES
        return Annex(title=title, printed=name in self.case.annexes)

    def results(self) -> Results:
        """Return the results that a summary of several cases is made from."""
        return Results.of(self.calculation)
