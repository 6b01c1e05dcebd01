"""Exercises of the lesson on the reduction to two degrees of freedom."""

import math

from pierimpact.pier.equivalent import natural_frequency
from pierimpact.teaching.checker import Question, Trap
from pierimpact.teaching.questions.common import BODY, ENGINE, ENGINE_NOT_CARGO, KMH, M1, M2
from pierimpact.teaching.scenario import EXAMPLE
from pierimpact.vehicle.crush import CrushSpring


def _beta(mass: float, spring: CrushSpring) -> float:
    """Return the frequency ratio of a body on its steep spring, on the pier of the example."""
    return EXAMPLE.pier.frequency / float(natural_frequency(mass, spring.stiffness))


QUESTIONS = (
    Question(
        words=f"The engine has m₁ = {M1:g} kg and k₁ = "
        f"{ENGINE.stiffness / 1e6:g} MN/m, the pier has f_p = 30 Hz. What is the engine’s "
        "frequency ratio β?",
        answer=lambda: _beta(M1, ENGINE),
        traps=(
            Trap(lambda: _beta(M2, BODY), ENGINE_NOT_CARGO),
            Trap(
                lambda: 1.0 / _beta(M1, ENGINE),
                "β is the pier’s frequency over the engine’s, not the inverse.",
            ),
        ),
        reason="Below 1 the pier responds slowly: the engine’s impact acts on it as an impulse.",
    ),
    Question(
        words=f"The engine strikes the pier at 50 km/h. What is v₁ √(k₁ m₁), the largest force of "
        f"its spring on a rigid pier? (m₁ = {M1:g} kg, k₁ = "
        f"{ENGINE.stiffness / 1e6:g} MN/m)",
        dimension="force",
        answer=lambda: 50.0 * KMH * math.sqrt(ENGINE.stiffness * M1),
        traps=(Trap(lambda: 50.0 * KMH * math.sqrt(BODY.stiffness * M2), ENGINE_NOT_CARGO),),
        reason="Speed, stiffness and mass: nothing else enters a hard impact.",
    ),
    Question(
        words=f"A soft, heavy pier has β = 0.1 for the engine. The engine’s spring unloads with "
        f"k_u1 = {ENGINE.unloading_stiffness / 1e6:g} MN/m after loading with "
        f"{ENGINE.stiffness / 1e6:g} MN/m. What is S by the impulse limit?",
        answer=lambda: (1.0 + ENGINE.restitution) * 0.1,
        traps=(
            Trap(lambda: 0.1, "That leaves out the rebound: the engine does not just stop."),
            Trap(
                lambda: (1.0 + ENGINE.restitution**2) * 0.1,
                "The restitution is the square root of k over k_u.",
            ),
        ),
        reason="The pier carries a fraction of the force, but takes all of the impulse.",
    ),
)
