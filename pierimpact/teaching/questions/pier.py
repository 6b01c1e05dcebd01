"""Exercises of the lesson on the pier as one degree of freedom."""

import math

from pierimpact.teaching.checker import Question, Trap
from pierimpact.teaching.scenario import Scenario
from pierimpact.units import printed

_PILLAR = Scenario(column_diameter=0.8, column_height=4.0, top="free", impact_height=1.2)
# Its stiffness in flexure alone and in shear alone.
_FLEXURE = 3.0 * _PILLAR.column.flexural_rigidity / _PILLAR.impact_height**3
_SHEAR = _PILLAR.column.shear_rigidity / _PILLAR.impact_height
_COLUMN = Scenario().column


def _softer_when_higher() -> str:
    low, high = (_COLUMN.struck_at(height).stiffness for height in (1.05, 1.35))
    return "stiffer" if high > low else "softer"


QUESTIONS = (
    Question(
        words="A cantilever is fixed at its base and free at its top. It is struck at z_n = "
        f"{_PILLAR.impact_height:g} m; EI = "
        f"{printed(_PILLAR.column.flexural_rigidity, 'flexural rigidity', 'SI')} and κGA = "
        f"{printed(_PILLAR.column.shear_rigidity, 'shear rigidity', 'SI')}. What is its stiffness "
        "k_p there?",
        dimension="stiffness",
        answer=lambda: _PILLAR.pier.stiffness,
        traps=(
            Trap(lambda: _FLEXURE, "That leaves out the shear deflection."),
            Trap(lambda: _SHEAR, "That leaves out the flexural deflection."),
            Trap(
                lambda: _FLEXURE + _SHEAR,
                "The deflections of flexure and shear add up, not their stiffnesses.",
            ),
        ),
        reason="That low on a stocky column, shear matters as much as flexure.",
    ),
    Question(
        words=f"The explorer’s default column has a mass of "
        f"{printed(_COLUMN.mass_per_length, 'mass per length', 'SI')} and is "
        f"{_COLUMN.height:g} m high; the integral of φ² over its height is "
        f"{_COLUMN.struck_at(1.2).values['phi2']:.4g} m. What is m_p?",
        dimension="mass",
        answer=lambda: Scenario().pier.mass,
        traps=(
            Trap(
                lambda: _COLUMN.mass_per_length * _COLUMN.height,
                "That is the whole column; each part of it counts with its φ².",
            ),
        ),
        reason="φ exceeds 1 above the impact, yet m_p is less than the mass of the column.",
    ),
    Question(
        words=f"A pier has k_p = {printed(500e6, 'stiffness', 'SI', given=True)} and m_p = "
        f"{printed(5e3, 'mass', 'SI', given=True)}. What is its frequency f_p?",
        dimension="frequency",
        answer=lambda: math.sqrt(500e6 / 5e3) / (2.0 * math.pi),
        traps=(
            Trap(
                lambda: math.sqrt(500e6 / 5e3), "That is ω_p in rad/s; the question is about f_p."
            ),
            Trap(lambda: 500e6 / 5e3 / (2.0 * math.pi), "The square root is missing."),
        ),
        reason="Most bridge piers struck near the base are this stiff or stiffer.",
    ),
    Question(
        words="The explorer’s column is fixed at its base. When the impact moves up from "
        "1.05 m to 1.35 m, the pier becomes …",
        choices=("stiffer", "softer"),
        answer=_softer_when_higher,
        reason="Farther from its fixed base the column is more flexible.",
    ),
)
