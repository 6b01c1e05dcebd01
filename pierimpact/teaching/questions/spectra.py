"""The lesson on the spectra."""

import math

from pierimpact.teaching.checker import Mistake, Question
from pierimpact.teaching.lesson import Lesson, Misconception, Prediction
from pierimpact.teaching.numbers import Numbers
from pierimpact.teaching.questions.common import IN_KMH, IN_TONNES, KMH, OMEGA, growth
from pierimpact.teaching.scenario import Scenario

_CHOICES = {
    "mainly the engine’s": "A stiff pier follows the short blow of the engine; the cargo’s long "
    "push it follows either way.",
    "mainly the cargo’s": "The cargo’s push is so long that even a soft pier follows it: there is "
    "little to gain from more stiffness.",
    "both, by about the same factor": "The two blows differ tenfold in length, so a pier can be "
    "slow for one and quick for the other.",
    "neither: a stiffer pier only deflects less": "It deflects less, and is stiffer: the reaction "
    "is the product of the two.",
}


def _grows_with_frequency() -> str:
    soft, stiff = (Scenario(pier_mass=8e3, pier_frequency=hertz) for hertz in (10.0, 100.0))
    factors = growth(soft, stiff)
    engine, cargo, both, neither = _CHOICES
    if max(factors.values()) < 1.1:
        return neither
    if abs(factors["engine"] / factors["cargo"] - 1.0) < 0.1:
        return both
    return engine if factors["engine"] > factors["cargo"] else cargo


def _by_impulse(numbers: Numbers) -> Question:
    mass, pier = numbers.between(550, 850, 50), numbers.between(5, 9)
    kmh, hertz = numbers.between(48, 66, 2), numbers.between(6, 12)
    e = numbers.between(3, 5) / 10
    ratio = mass / (1e3 * pier)

    def reaction(speed: float = kmh * KMH, e: float = e, ratio: float = ratio) -> float:
        return mass * speed * (1.0 + e) * 2.0 * math.pi * hertz / (1.0 + ratio)

    return Question(
        words=f"An engine of {mass} kg strikes at {kmh} km/h and rebounds with e = {e:g}. The pier "
        f"is soft: f_p = {hertz} Hz, m_p = {pier} t. How large is the reaction in the limit of an "
        "impulse? (The engine’s stiffness is not needed. Why?)",
        dimension="force",
        answer=reaction(),
        mistakes=(
            Mistake(reaction(speed=kmh), IN_KMH),
            Mistake(reaction(e=0.0), "That leaves out the rebound."),
            Mistake(reaction(ratio=0.0), "The engine’s mass counts beside the pier’s: 1 + μ."),
            Mistake(reaction() / (2.0 * math.pi), OMEGA),
            Mistake(reaction(ratio=mass / pier), IN_TONNES),
        ),
        start="R = v √(k m) S with S = (1 + e) β/(1 + μ): put in β and see what cancels.",
        solution="R = v √(k m) (1 + e) β/(1 + μ) = m v (1 + e) 2π f_p/(1 + μ) = "
        f"{mass} kg × {kmh * KMH:.4g} m/s × {1.0 + e:g} × 2π × {hertz} Hz / {1.0 + ratio:.4g} = "
        f"{reaction() / 1e3:.4g} kN",
        reason="An impulse has no stiffness in it: mass, speed and rebound are all that counts.",
    )


def _crossing(numbers: Numbers) -> Question:
    hertz, first = numbers.between(8, 12, 2), numbers.between(9, 13) / 10
    level = numbers.between(38, 52, 2) / 10
    answer = hertz * level / first
    return Question(
        words=f"On the spectra of some truck the engine peak is {first:g} MN at {hertz} Hz and, by "
        f"the limit of an impulse, grows in proportion to frequency. The cargo peak is level at "
        f"{level:g} MN. From which frequency does the engine govern?",
        dimension="frequency",
        answer=answer,
        mistakes=(
            Mistake(hertz * first / level, "There the engine’s would be even smaller: invert."),
            Mistake(
                hertz * math.sqrt(level / first),
                "By the limit of an impulse S is proportional to β, not to its square.",
            ),
            Mistake(
                hertz * (level / first) ** 2,
                "By the limit of an impulse S is proportional to β, not to its root.",
            ),
            Mistake(
                hertz + hertz * level / first, "From 0 Hz, not from the first point: do not add."
            ),
        ),
        start="At the crossing both are equal; the engine’s is a straight line through zero.",
        solution=f"{first:g} MN × f / {hertz} Hz = {level:g} MN, so f = {hertz} × {level:g} / "
        f"{first:g} = {answer:.4g} Hz",
        reason="Below the crossing the pier is slow for the engine, and the cargo governs.",
    )


def _slower(numbers: Numbers) -> Question:
    least, before, after = (
        numbers.between(56, 61),
        numbers.between(84, 92, 2),
        numbers.between(68, 74, 2),
    )
    answer = math.sqrt((after**2 - least**2) / (before**2 - least**2))
    return Question(
        words=f"The cargo of some truck reaches the pier only above {least} km/h. The truck drives "
        f"{after} km/h instead of {before}. By what factor does that change the cargo’s contact "
        "speed, and with it its peak on a stiff pier?",
        answer=answer,
        mistakes=(
            Mistake(after / before, "That is the truck’s speed. What does the plateau leave?"),
            Mistake(
                (after - least) / (before - least),
                "Speeds do not subtract, their squares do: the plateau takes up energy.",
            ),
            Mistake(answer**2, "That is the ratio of the energies; take the root."),
            Mistake(1.0 / answer, "The slower truck over the faster one, not the inverse."),
        ),
        start="v₂² = V² − V₀², where V₀ is the speed at which nothing is left.",
        solution=f"√(({after}² − {least}²) / ({before}² − {least}²)) = {answer:.4g}",
        reason="Near the threshold a little less speed makes the cargo peak much smaller.",
    )


_LOADED = {
    "the engine peak, for the load is not joined to the engine": "",
    "the cargo peak, for friction holds the load": "Friction is small. The load adds to the mass "
    "that the body’s spring has to stop.",
    "both, for the speed is the same": "The speed is the same, but not the mass behind the body’s "
    "spring.",
    "neither, for the truck is heavier": "In this model only the body is heavier. What has the "
    "engine to do with it?",
}


def _unchanged(numbers: Numbers) -> Question:
    tonnes = numbers.between(13, 18)
    pair = (Scenario(pier_mass=8e3, pier_frequency=60.0, truck_mass=1e3 * m) for m in (8, tonnes))
    changed = {body: abs(factor - 1.0) > 0.02 for body, factor in growth(*pair).items()}
    engine, cargo, both, neither = _LOADED
    right = {
        (False, True): engine,
        (True, False): cargo,
        (False, False): both,
        (True, True): neither,
    }
    return Question(
        words=f"A truck of 8 t is loaded to {tonnes} t and strikes the same stiff pier at the same "
        "speed. Which peak hardly changes, and why?",
        answer=right[changed["engine"], changed["cargo"]],
        choices=_LOADED,
        solution="The engine’s mass, spring and contact speed are the same; the body’s mass is "
        f"not. So it is {engine}",
        reason="The first peak hardly depends on the total mass: so do finite-element studies say.",
    )


LESSON = Lesson(
    title="4 · The spectra",
    minutes=50,
    prediction=Prediction(
        words="A pier is made stiffer and stiffer, from 10 to 100 Hz, at the same mass. The same "
        "truck strikes it at 80 km/h each time. Which peak of the reaction grows?",
        choices=_CHOICES,
        answer=_grows_with_frequency,
        look="Move the pier’s natural frequency from left to right and follow both marks.",
    ),
    misconceptions=(
        Misconception(
            "A stiffer pier is a safer pier.",
            "It deflects less, but it carries more of the engine’s blow.",
        ),
        Misconception(
            "A spectrum shows how the force develops in time.",
            "Every point of it is a collision of its own, with another pier.",
        ),
        Misconception(
            "The heavier truck makes both peaks larger.",
            "Load makes the cargo peak larger; the engine peak stays.",
        ),
    ),
    questions=(_by_impulse, _crossing, _slower, _unchanged),
)
