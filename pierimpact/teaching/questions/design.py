"""Exercises of the lesson on design by spectrum."""

from pierimpact.design.codes import aashto_lrfd, en_1991_1_7_hard_impact
from pierimpact.design.reaction import DesignReaction
from pierimpact.teaching.checker import Question, Trap
from pierimpact.teaching.questions.common import KMH, SLOW, engine_peak
from pierimpact.teaching.scenario import Scenario

_HEAVY_MASS, _HEAVY_SPEED = 30e3, 90.0 * KMH


def _design() -> DesignReaction:
    return Scenario(speed=SLOW).design("long")


QUESTIONS = (
    Question(
        words="Set the speed to 60 km/h and leave the rest at the defaults. What is the design "
        "reaction?",
        dimension="force",
        tolerance=0.01,
        answer=lambda: _design().reaction,
        traps=(
            Trap(
                lambda: _design().cargo or 0.0,
                "That is the cargo’s; the larger of the two governs.",
            ),
            Trap(
                lambda: engine_peak(Scenario(speed=SLOW)), "That is the full model’s engine peak."
            ),
        ),
        reason="The procedure takes the larger of engine and cargo.",
    ),
    Question(
        words="EN 1991-1-7, Annex C, gives F = v √(k m) for a hard impact. With k = 300 kN/m "
        "(second-hand: check against the standard), what is F for 30 t at 90 km/h?",
        dimension="force",
        answer=lambda: en_1991_1_7_hard_impact(_HEAVY_SPEED, _HEAVY_MASS).along.value,
        reason="This is the force of a spring on a rigid pier: S = 1.",
    ),
    Question(
        words="How many times the AASHTO force of 600 kip is the design reaction of the first "
        "exercise?",
        tolerance=0.03,
        answer=lambda: _design().reaction / aashto_lrfd().along.value,
        traps=(
            Trap(
                lambda: aashto_lrfd().along.value / _design().reaction,
                "Inverted: divide the design reaction by the code’s force.",
            ),
        ),
        reason="A peak reaction and an equivalent static force are not the same thing: see below.",
    ),
)
