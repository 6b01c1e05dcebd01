"""Exercises of the lesson on where the model ends."""

from pierimpact.teaching.checker import Question, Trap
from pierimpact.teaching.questions.common import BODY, engine_peak
from pierimpact.teaching.scenario import REFERENCE, Scenario

_CHANGED = {
    "the engine’s mass": Scenario(engine_mass=1.3 * REFERENCE.engine_mass),
    "the body’s plateau length": Scenario(body_plateau_length=1.3 * BODY.plateau_length),
    "the friction": Scenario(friction_force=1.3 * REFERENCE.friction_force),
}


def _most_for_engine_peak() -> str:
    before = engine_peak(Scenario())
    return max(_CHANGED, key=lambda name: abs(engine_peak(_CHANGED[name]) - before))


QUESTIONS = (
    Question(
        words="Each of these is increased by 30 %. Which changes the engine peak most?",
        choices=tuple(_CHANGED),
        answer=_most_for_engine_peak,
        reason="It enters through the square root of the mass, and through the contact speed.",
    ),
    Question(
        words=f"The body’s spring has k = {BODY.stiffness / 1e6:g} MN/m and k_u = "
        f"{BODY.unloading_stiffness / 1e6:g} MN/m. With what fraction of its contact speed "
        "would the cargo rebound from a rigid pier, by its steep spring alone?",
        answer=lambda: BODY.restitution,
        traps=(
            Trap(
                lambda: BODY.restitution**2,
                "That is the fraction of the energy; for the speed take the square root.",
            ),
            Trap(
                lambda: 1.0 / BODY.restitution, "The cargo cannot rebound faster than it arrived."
            ),
        ),
        reason="The unloading law is this project’s own.",
    ),
    Question(
        words="Where do the truck’s parameters in these notebooks come from?",
        choices=(
            "Table 1 of the source paper",
            "illustrative values of this project",
            "a crash test",
        ),
        answer=lambda: "illustrative values of this project",
        reason="Enter those of your own truck, with their source, before you rely on a result.",
    ),
)
