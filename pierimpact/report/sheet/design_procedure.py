"""Annex: the design procedure at its long level, step by step."""

from functools import cached_property

from pierimpact.handcalc import Step
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Tex
from pierimpact.report.document.numbered import Equation, Steps
from pierimpact.report.document.step_writer import StepWriter
from pierimpact.report.sheet.section import Section
from pierimpact.report.sheet.spectrum_method import beside_model

#: The parts of the procedure, and the value that each of them but the first starts with.
PARTS = ("plateau", "engine", "vibration", "arrival", "cargo")
_STARTS = ("t1_0", "mr", "t2_0", "beta2")
# The time of a contact that does not come about, and the speed that is zero then.
_STOPPED = "of a body that would just reach the pier: this one stops before"
_SPEED_AT = {"t1": "v1", "t2": "v2"}


class DesignProcedure(Section):
    """The design procedure at its long level.

    Examples
    --------
    >>> from pierimpact.files.case import case_from, read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(case_from(file.values | {"annexes": ["procedure"]}))
    >>> sheet.procedure.check().rows[-1]  # full model [kN], long level [kN], ratio
    ['Governing', '7157', '7469', '1.04']
    """

    def steps(self, part: str) -> Block:
        """Return a part of the procedure, one of PARTS."""
        steps = self._parts[PARTS.index(part)]
        if not steps:  # only the last part can have none
            return Paragraph(
                (
                    "The cargo stops before it meets the pier, ",
                    Tex("v_2 = 0"),
                    ": it has no reaction.",
                )
            )
        return Steps([self._equation(step) for step in steps])

    @cached_property
    def _parts(self) -> list[list[Step]]:
        design = self.calculation.long
        steps = [
            step._replace(remark=_STOPPED)
            if step.name in _SPEED_AT and not design.values[_SPEED_AT[step.name]] > 0.0
            else step
            for step in design.steps
        ]
        return design.calculation.split(steps, *_STARTS)

    def _equation(self, step: Step) -> Equation:
        # The number of periods prints as a whole number.
        given = (*self.calculation.long.calculation.given, "n")
        values = self.calculation.long.values
        writer = StepWriter(values, self.system, given, units=False, consistent=True)
        return writer.equation(step)

    def check(self) -> Block:
        """Return the long level beside the full model, with the ratio."""
        return beside_model(self, self.calculation.long, "tab-check-long", "long level")

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the procedure, by name."""
        return {step.name: f"eq-{step.name}" for step in self.calculation.long.steps}
