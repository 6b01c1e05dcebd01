"""The equations that the full model solves, as the sheet prints them."""

from collections.abc import Iterator

from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Block
from pierimpact.report.document.markup import Inline, Tex
from pierimpact.report.document.numbered import Equation, Steps


def model_steps(calculation: Calculation) -> Block:
    """Return the equations of motion and the crush law that the full model solves."""
    on_pier = calculation.case.truck.friction_on == "pier"
    against = r"\dot x_2 - \dot x_\mathrm{p}" if on_pier else r"\dot x_2"
    on_the_pier = r" + F_\mathrm{f}" if on_pier else ""
    friction = r"c_\mathrm{s} \operatorname{sgn}(" + against + ")"
    return Steps(
        [
            Equation(
                label="eq-model-crush",
                name="Crush of the springs of engine and body",
                symbol=r"\delta_i",
                lines=[r"x_i - x_\mathrm{p} \quad (i = 1, 2)"],
            ),
            Equation(
                label="eq-model-envelope",
                name="Envelope, up to the plateau’s end and beyond",
                symbol="E_i(\\delta)",
                lines=[
                    r"\min(k_{\mathrm{u}i} \, \delta, P_i)"
                    r" \ \text{ where } \delta \le d_i, \quad P_i + k_i \, (\delta - d_i)"
                    r" \ \text{ beyond}"
                ],
                source="derived here",
            ),
            Equation(
                label="eq-model-force",
                name="Force of a spring, with its largest crush so far",
                symbol="F_i",
                lines=[
                    r"\max(E_i(\delta_{i,\max})"
                    r" - k_{\mathrm{u}i} \, (\delta_{i,\max} - \delta_i), 0)"
                ],
                source="derived here",
            ),
            Equation(
                label="eq-model-friction",
                name="Friction on the body, "
                + ("while its spring touches the pier" if on_pier else "against the road"),
                symbol=r"F_\mathrm{f}",
                lines=[friction + r", \quad \text{sticking as long as less holds it}"],
                source="derived here",
            ),
            Equation(
                label="eq-model-engine",
                name="Motion of the engine",
                symbol=r"m_1 \, \ddot x_1",
                lines=["-F_1"],
                source="Fig. 2 of the source paper",
            ),
            Equation(
                label="eq-model-body",
                name="Motion of body and cargo",
                symbol=r"m_2 \, \ddot x_2",
                lines=[r"-F_2 - F_\mathrm{f}"],
                source="Fig. 2 of the source paper",
            ),
            Equation(
                label="eq-model-pier",
                name="Motion of the pier",
                symbol=r"m_\mathrm{p} \, \ddot x_\mathrm{p} + c_\mathrm{p} \, \dot x_\mathrm{p}"
                r" + k_\mathrm{p} \, x_\mathrm{p}",
                lines=["F_1 + F_2" + on_the_pier],
                source="Fig. 2 of the source paper",
            ),
        ]
    )


def symbols_of_model() -> Iterator[tuple[str, Inline, str]]:
    """Yield symbol, meaning and anchor of what only the equations of motion use."""
    yield from (
        (r"x_\mathrm{p}", "displacement of the pier at the impact height", "eq-model-pier"),
        ("x_i", ("displacement of engine (", Tex("i = 1"), ") or body"), "eq-model-crush"),
        (r"\delta_i", "crush of a spring", "eq-model-crush"),
        ("E_i", "envelope of a spring’s force", "eq-model-envelope"),
        ("F_i", "force of a spring", "eq-model-force"),
        (r"F_\mathrm{f}", "friction on the body", "eq-model-friction"),
    )
