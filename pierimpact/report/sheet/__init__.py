"""The calculation sheet of a case: a file for each of its headings, and a method for each block."""

from pierimpact.files.case import Case
from pierimpact.report.calculation import calculate
from pierimpact.report.results import Results
from pierimpact.report.sheet.arranged_column import ArrangedColumnSteps
from pierimpact.report.sheet.codes import Codes
from pierimpact.report.sheet.design_procedure import DesignProcedure
from pierimpact.report.sheet.equivalent_pier import EquivalentPierSteps
from pierimpact.report.sheet.full_model import FullModel
from pierimpact.report.sheet.inputs import Inputs
from pierimpact.report.sheet.member_forces import MemberForces
from pierimpact.report.sheet.nomenclature import Closing
from pierimpact.report.sheet.sensitivity import Variations
from pierimpact.report.sheet.summary import Summary


class Sheet:
    """The sheet of a case, which is calculated once: a section for each heading.

    Parameters
    ----------
    case : Case
        The case.
    case_file, case_sha256 : str or None, optional
        Name and SHA-256 of the case file, where it is known, for the provenance.
    """

    def __init__(
        self, case: Case, case_file: str | None = None, case_sha256: str | None = None
    ) -> None:
        self.calculation = calculate(case)
        self.summary = Summary(self.calculation)
        self.inputs = Inputs(self.calculation)
        uniform = case.column.uniform
        self.pier = (EquivalentPierSteps if uniform else ArrangedColumnSteps)(self.calculation)
        self.procedure = DesignProcedure(self.calculation)
        self.model = FullModel(self.calculation)
        self.member_forces = MemberForces(self.calculation)
        self.codes = Codes(self.calculation)
        self.sensitivity = Variations(self.calculation)
        sections = (self.inputs, self.pier, self.procedure, self.model, self.member_forces)
        self.closing = Closing(self.calculation, sections, case_file, case_sha256)

    def results(self) -> Results:
        """Return the results that a summary of several cases is made from."""
        return Results.of(self.calculation)
