"""The design procedure step by step: equation, values put in, and result of each."""

from functools import cached_property

from pierimpact.design.procedure import long
from pierimpact.design.reaction import DesignReaction
from pierimpact.handcalc import Step
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.markup import Inline, Ref, Tex, inline
from pierimpact.report.document.numbered import Steps, Table, columns, decimal, wide
from pierimpact.report.document.step_writer import StepWriter, in_symbols
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import SYMBOLS
from pierimpact.units import printed, unit_of, unit_size

# Where the starting values are from, unless from the table of the truck.
_ORIGINS = {
    "V": Ref("Table", "tab-inputs"),
    "mp": Ref("Eq.", "eq-mp"),
    "kp": Ref("Eq.", "eq-kp"),
    "zeta": Ref("Table", "tab-inputs"),
}
#: The parts of the procedure, and the value that each of them but the first starts with.
PARTS = ("plateau", "engine", "vibration", "arrival", "cargo")
_STARTS = ("t1_0", "mr", "t2_0", "beta2")
# The time of a contact that does not come about, and the speed that is zero then.
_STOPPED = "of a body that would just reach the pier: this one stops before"
_SPEED_AT = {"t1": "v1", "t2": "v2"}
_STARTING = tuple(name for name in long.given if name != "on_pier")


class DesignProcedure(Section):
    """The design procedure, at its long level step by step, at its short level in a table."""

    def starting_values(self) -> Block:
        """Return what the procedure starts from, in the units that values are put in with."""
        writer = self._writer(self.calculation.design)
        mass = "dynamic mass"
        size = unit_size(mass, self.system) / unit_size("mass", self.system)
        return Table(
            label="tab-given",
            caption="Starting values of the procedure, in consistent units: forces are masses "
            f"times accelerations, and 1 {unit_of(mass, self.system)} is "
            f"{printed(size, 'share', 'SI', given=True)} {self.unit('mass')}.",
            columns=columns("Item", "Symbol", decimal("Value"), "Unit", "From"),
            rows=[
                [
                    SYMBOLS[name].heading,
                    Tex(SYMBOLS[name].latex),
                    *writer.shown(name),
                    _ORIGINS.get(name, Ref("Table", "tab-truck")),
                ]
                for name in _STARTING
            ],
        )

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
        return Steps([self._writer(self.calculation.design).equation(step) for step in steps])

    @cached_property
    def _parts(self) -> list[list[Step]]:
        design = self.calculation.design
        steps = [
            step._replace(remark=_STOPPED)
            if step.name in _SPEED_AT and not design.values[_SPEED_AT[step.name]] > 0.0
            else step
            for step in design.steps
        ]
        return design.calculation.split(steps, *_STARTS)

    def _writer(self, design: DesignReaction) -> StepWriter:
        # The number of periods prints as a whole number.
        given = (*_STARTING, "n")
        return StepWriter(design.values, self.system, given, units=False, consistent=True)

    def short_level(self) -> Block:
        """Return the short level as a table."""
        short = self.calculation.short
        writer = self._writer(short)
        rows: list[list[Inline]] = [
            [
                inline(SYMBOLS[step.name].heading),
                Tex(rf"\displaystyle {SYMBOLS[step.name].latex} = {in_symbols(step)}"),
                *writer.shown(step.name),
            ]
            for step in short.steps
        ]
        return Table(
            label="tab-short",
            caption="The short level, from the same starting values; it shares the amplification "
            "factors with the long level. The numbers in the resonance terms and in η are fitted "
            "to the full model.",
            columns=columns(wide("Step"), "Equation", decimal("Value"), "Unit"),
            rows=rows,
            centred=True,
        )

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the procedure, by name."""
        long, short = self.calculation.design.steps, self.calculation.short.steps
        anchors = {step.name: "tab-short" for step in short}
        return anchors | {step.name: f"eq-{step.name}" for step in long}
