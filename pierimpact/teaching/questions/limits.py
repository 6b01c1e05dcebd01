"""The lesson on where the model ends."""

import math
from dataclasses import replace

from pierimpact.teaching.checker import Mistake, Question
from pierimpact.teaching.lesson import Lesson, Misconception, Prediction
from pierimpact.teaching.numbers import Numbers
from pierimpact.teaching.questions.common import history
from pierimpact.teaching.scenario import Scenario

_CHOICES = {
    "the engine’s mass": "It stands in the contact speed and in the force of the steep spring.",
    "the plateau length in front of the cargo": "It delays the cargo and takes up its energy. "
    "The engine has struck before.",
    "the friction on the body": "It is small beside the plateau forces, and does not act on the "
    "engine.",
    "the stiffness of the steep spring of the body": "That is the cargo’s spring. The engine has "
    "struck before.",
}
_PARAMETERS = ("engine_mass", "body_plateau_length", "friction_force", "body_stiffness")


def _most_for_engine_peak() -> str:
    before = Scenario()
    peak = history(before).engine_peak.reaction

    def change(name: str) -> float:
        after = replace(before, **{name: 1.3 * getattr(before, name)})
        return abs(history(after).engine_peak.reaction - peak)

    return max(zip(_CHOICES, _PARAMETERS, strict=True), key=lambda named: change(named[1]))[0]


def _uncertain(numbers: Numbers) -> Question:
    percent = numbers.between(30, 80, 5)
    share = 1.0 + percent / 100.0
    answer = math.sqrt(share)
    return Question(
        words=f"The stiffness of a steep spring turns out to be {percent} % larger than assumed. "
        "By what factor is the force v √(k m) on a rigid pier larger?",
        answer=answer,
        mistakes=(
            Mistake(share, "The stiffness stands under a root."),
            Mistake(share**2, "A root, not a square."),
            Mistake(1.0 / answer, "A stiffer spring gives a larger force."),
            Mistake(answer - 1.0, "That is the increase. The factor has a 1 in front."),
        ),
        start="Only k changes, and it stands under a root.",
        solution=f"√(1 + {percent / 100:g}) = {answer:.4g}",
        reason="The root halves small errors of the stiffness; on a soft pier k counts only "
        "through the rebound, e = √(k/k_u), and moves the peak by less.",
    )


def _returned(numbers: Numbers) -> Question:
    loading, unloading = numbers.between(8, 12), numbers.between(40, 68, 4)
    answer = loading / unloading
    return Question(
        words=f"A spring loads with {loading} MN/m and unloads with {unloading} MN/m. What share "
        "of the energy that its steep part took up does it return?",
        answer=answer,
        mistakes=(
            Mistake(math.sqrt(answer), "That is the share of the speed, e; energy goes with e²."),
            Mistake(1.0 - answer, "That is the share that is lost."),
            Mistake(1.0 / answer, "It cannot return more than it took up."),
        ),
        start="At the same largest force F, compare ½ F²/k_u with ½ F²/k.",
        solution=f"(F²/2k_u) / (F²/2k) = k/k_u = {loading}/{unloading} = {answer:.4g}",
        reason="How a spring unloads is this project’s own assumption; no test was available.",
    )


_NEEDED = {
    "nothing: the formulas scatter by a few per cent only": "That is how well they follow the "
    "model, not how well the model follows a real truck.",
    "more figures in the result": "More figures do not make the truck’s parameters better known.",
    "the parameters of the truck you design for, with their source": "",
    "a lower damping ratio, to be on the safe side": "That changes the result, and makes "
    "nothing of the truck better known.",
}


def _needed(numbers: Numbers) -> Question:
    kilonewtons = numbers.between(4100, 5900, 100)
    right = next(choice for choice, wrong in _NEEDED.items() if not wrong)
    return Question(
        words=f"With the truck of these notebooks you get a reaction of {kilonewtons} kN for a "
        "real bridge. What do you need first, before you rely on it?",
        answer=right,
        choices=_NEEDED,
        solution="The truck here is illustrative. A result is as good as its inputs: you need "
        f"{right}",
        reason="And then a band instead of one value: how far the result moves with each of them.",
    )


LESSON = Lesson(
    title="6 · Where the model ends",
    minutes=50,
    prediction=Prediction(
        words="None of the truck’s parameters is known within less than 30 %. Which of these "
        "matters most for the engine peak of the reaction?",
        choices=_CHOICES,
        answer=_most_for_engine_peak,
        look="The longest bar on the left is the one that matters most.",
    ),
    misconceptions=(
        Misconception(
            "A result with four figures is accurate to four figures.",
            "It is as accurate as the parameters of the truck.",
        ),
        Misconception(
            "A formula that agrees with the model is right.",
            "It was fitted to the model; what the model leaves out, it leaves out too.",
        ),
        Misconception(
            "A static force of the right size gives the right shear.",
            "A slow column passes the blow to its nearest support before its far parts move.",
        ),
    ),
    questions=(_uncertain, _returned, _needed),
)
