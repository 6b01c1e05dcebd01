"""The lesson on design by spectrum."""

import math

from pierimpact.design.codes import aashto_lrfd
from pierimpact.teaching.checker import Mistake, Question
from pierimpact.teaching.lesson import Lesson, Misconception, Prediction
from pierimpact.teaching.numbers import Numbers
from pierimpact.teaching.questions.common import IN_KMH, IN_TONNES, KMH, history
from pierimpact.teaching.scenario import Scenario

_CHOICES = {
    "smaller than the code’s force": "A code’s force is not the largest that can occur. It is an "
    "equivalent static force, chosen to design with.",
    "about the same, within 20 %": "A code’s force does not know this truck, this pier and this "
    "speed: it would be a coincidence.",
    "more than twice the code’s force": "A peak that lasts for milliseconds is not the same demand "
    "as a static force of that size, so this is no verdict on the code.",
}
_STIFFNESS = 300e3  # of the vehicle, as EN 1991-1-7 has it second-hand [N/m]


def _beside_the_code() -> str:
    ratio = history(Scenario()).governing_peak.reaction / aashto_lrfd().along.value
    smaller, same, larger = _CHOICES
    return larger if ratio > 2.0 else same if abs(ratio - 1.0) < 0.2 else smaller


def _hard_impact(numbers: Numbers) -> Question:
    tonnes, kmh = numbers.between(14, 34, 2), numbers.between(55, 75, 5)

    def force(mass: float = 1e3 * tonnes, speed: float = kmh * KMH) -> float:
        return speed * math.sqrt(_STIFFNESS * mass)

    return Question(
        words="EN 1991-1-7, Annex C, gives F = v √(k m) for a hard impact, with k = 300 kN/m "
        f"(second-hand: check against the standard). What is F for {tonnes} t at {kmh} km/h?",
        dimension="force",
        answer=force(),
        mistakes=(
            Mistake(force(speed=kmh), IN_KMH),
            Mistake(force(mass=tonnes), "Put in kg and N/m: one of the two was not."),
            Mistake(force() ** 2 / force(speed=1.0), "The speed stands in it once, not squared."),
        ),
        start="Put in m/s, N/m and kg.",
        solution=f"F = v √(k m) = {kmh * KMH:.4g} m/s × √(300 000 N/m × {1000 * tonnes} kg) = "
        f"{force() / 1e3:.4g} kN",
        reason="This is the force of one soft spring on a rigid pier: S = 1.",
    )


def _spring_length(numbers: Numbers) -> Question:
    tonnes, kmh = numbers.between(12, 28, 2), numbers.between(45, 70, 5)

    def length(mass: float = 1e3 * tonnes, speed: float = kmh * KMH) -> float:
        return speed * math.sqrt(mass / _STIFFNESS)

    return Question(
        words=f"How much would a truck of {tonnes} t at {kmh} km/h have to crush for such a spring "
        "of 300 kN/m to stop it?",
        dimension="length",
        answer=length(),
        mistakes=(
            Mistake(length(speed=kmh), IN_KMH),
            Mistake(length(mass=tonnes), IN_TONNES),
            Mistake(
                length() / math.sqrt(2.0), "Both energies, ½ m v² and ½ k u², have a factor ½."
            ),
            Mistake(length() / 2.0, "The force grows with the crush: its work is ½ k u²."),
            Mistake(kmh * KMH * math.sqrt(_STIFFNESS / (1e3 * tonnes)), "Mass over stiffness."),
        ),
        start="All of ½ m v² becomes ½ k u².",
        solution=f"½ m v² = ½ k u², so u = v √(m/k) = {kmh * KMH:.4g} m/s × √({1000 * tonnes} kg / "
        f"300 000 N/m) = {length():.4g} m",
        reason="No truck has that much to crush in front of its engine: hence the low force.",
    )


def _average(numbers: Numbers) -> Question:
    base, impulse = numbers.between(1300, 1900, 100), numbers.between(14, 24, 2)
    long, short = numbers.between(20, 30, 5), 10

    def mean(window: float = long, base: float = base) -> float:
        return 1e3 * (base + impulse / (1e-3 * window))

    return Question(
        words=f"A contact force consists of a plateau of {base} kN and one spike on top of it. The "
        f"spike holds an impulse of {impulse} kN·s and lasts 7 ms. How large is the largest "
        f"{long} ms average of the force?",
        dimension="force",
        answer=mean(),
        mistakes=(
            Mistake(mean(window=7.0), f"Average over {long} ms, not over the spike."),
            Mistake(mean(base=0.0), "The plateau acts all the time: it adds."),
            Mistake(mean(window=1e3 * long), "Was the time that you put in in seconds?"),
            Mistake(mean(window=short), f"That is the {short} ms average."),
        ),
        start="An impulse is force times time: what constant force has it over the whole window?",
        solution=f"F = {base} kN + {impulse} kN·s / {long / 1e3:g} s = {mean() / 1e3:.4g} kN",
        reason="Where a force is an average, ask over what time: the longer, the lower.",
    )


_VERDICTS = {
    "The code is unsafe.": "The code’s force is an equivalent static force, chosen for an accepted "
    "probability. A peak reaction is another quantity.",
    "The design procedure is wrong.": "The procedure follows the model’s peak reaction, which is "
    "what it is for.",
    "The two are different quantities: look at how long the peak lasts, and at what the column "
    "resists.": "",
    "Design for the average of the two.": "The average of two different quantities is neither.",
}


def _verdict(numbers: Numbers) -> Question:
    factor = numbers.between(21, 29) / 10
    right = next(choice for choice, wrong in _VERDICTS.items() if not wrong)
    return Question(
        words=f"A column’s peak reaction by the design procedure is {factor:g} times a code’s "
        "force. What follows?",
        answer=right,
        choices=_VERDICTS,
        solution="One is the peak of an elastic pier for milliseconds, the other a static force "
        f"that allows for some damage. {right}",
        reason="Compare like with like: averages over the same time, for example.",
    )


LESSON = Lesson(
    title="5 · Design by spectrum, and the forces of design codes",
    minutes=50,
    prediction=Prediction(
        words="AASHTO LRFD asks for a static force of 600 kip (2669 kN), whatever the pier. How "
        "large is the peak reaction of the explorer’s column when the truck of 8 t strikes it at "
        "80 km/h?",
        choices=_CHOICES,
        answer=_beside_the_code,
        look="Compare the bar of the full model’s larger peak with the code’s.",
    ),
    misconceptions=(
        Misconception(
            "A code’s force is the largest that can occur.",
            "It is a static force to design with; that of AASHTO comes from averages over 25 ms.",
        ),
        Misconception(
            "A peak above the code’s force means failure.",
            "A peak of milliseconds is not the same demand as a static force of that size.",
        ),
        Misconception(
            "A method that considers energy is on the safe side.",
            "Every method takes something for granted; some err high, some low.",
        ),
    ),
    questions=(_hard_impact, _spring_length, _average, _verdict),
)
