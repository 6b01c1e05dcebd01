"""The lesson on one collision."""

import math
from dataclasses import replace
from functools import cache

from pierimpact.teaching.checker import Mistake, Question
from pierimpact.teaching.lesson import Lesson, Misconception, Prediction
from pierimpact.teaching.numbers import Numbers
from pierimpact.teaching.questions.common import IN_KMH, KMH, KMH_AS_MS, MS_AS_KMH, NO_HALF, history
from pierimpact.teaching.scenario import REFERENCE, Scenario

_CHOICES = {
    "one spike, when the bumper touches the column": "Bumper and sheet metal crush at a small "
    "force. The large forces come later, when something hard arrives.",
    "two spikes: first the engine’s, later the cargo’s": "The engine is close behind the bumper; "
    "the cargo arrives later, with more mass behind a softer spring.",
    "a constant force until the truck stands still": "The plateau forces are nearly constant, but "
    "they do not stop the truck: engine and cargo arrive at the column with speed to spare.",
}


def _spikes() -> str:
    found = history(Scenario())
    one, two, steady = _CHOICES
    if found.engine_contact_time is None:
        return steady
    return one if found.cargo_contact_time is None else two


def _stopping_length(numbers: Numbers) -> Question:
    tonnes, kmh = numbers.between(9, 19), numbers.between(50, 75, 5)
    kilonewtons = numbers.between(400, 640, 20)

    def length(
        mass: float = 1e3 * tonnes,
        speed: float = kmh * KMH,
        force: float = 1e3 * kilonewtons,
        half: float = 0.5,
    ) -> float:
        return half * mass * speed**2 / force

    return Question(
        words=f"A truck of {tonnes} t at {kmh} km/h is stopped by crushing metal alone, at a "
        f"constant force of {kilonewtons} kN. Over what length?",
        dimension="length",
        answer=length(),
        mistakes=(
            Mistake(length(half=1.0), NO_HALF),
            Mistake(length(speed=kmh), IN_KMH),
            Mistake(length(speed=math.sqrt(kmh * KMH)), "The speed is squared in the energy."),
            Mistake(
                length() * 9.81,
                "Forces here are in newtons and masses in kilograms: no g is needed.",
            ),
        ),
        start="The work of the force, force times length, takes up all of the kinetic energy.",
        solution=f"P d = ½ m V², so d = m V² / (2 P) = {1000 * tonnes} kg × "
        f"({kmh * KMH:.4g} m/s)² / (2 × {1000 * kilonewtons} N) = {length():.4g} m",
        reason="Metres, where the explorer’s truck has half a metre in front of its engine and "
        "two in front of its cargo: hence the spikes.",
    )


def _contact_speed(numbers: Numbers) -> Question:
    mass, kmh = numbers.between(620, 860, 20), numbers.between(64, 76, 2)
    kilonewtons, decimetres = numbers.between(100, 140, 10), numbers.between(4, 5)
    work, speed, truck = 100.0 * kilonewtons * decimetres, kmh * KMH, numbers.between(7, 12)

    def left(mass: float = mass, speed: float = speed, half: float = 0.5) -> float:
        return math.sqrt(speed**2 - work / (half * mass))

    return Question(
        words=f"On its way to a rigid pier the engine ({mass} kg) of a truck of {truck} t is "
        f"slowed by a plateau force of {kilonewtons} kN over {decimetres / 10:g} m. The truck’s "
        f"speed is {kmh} km/h. How fast is the engine when it strikes?",
        dimension="speed",
        answer=left(),
        mistakes=(
            Mistake(
                left(mass=1e3 * truck),
                "That slows the whole truck; the force acts on the engine alone.",
            ),
            Mistake(
                speed - math.sqrt(2.0 * work / mass),
                "Energies subtract, speeds do not: the plateau reduces v².",
            ),
            Mistake(left(half=1.0), NO_HALF),
            Mistake(left(speed=kmh), IN_KMH),
            Mistake(left() * KMH, MS_AS_KMH),
            Mistake(left() / KMH, KMH_AS_MS),
            Mistake(
                math.sqrt(speed**2 + 2.0 * work / mass), "The plateau slows the engine: minus."
            ),
        ),
        start="What does the work of the plateau force leave of the engine’s kinetic energy?",
        solution=f"v₁ = √(V² − 2 P₁ d₁ / m₁) = √(({speed:.4g} m/s)² − 2 × {1000 * kilonewtons} N × "
        f"{decimetres / 10:g} m / {mass} kg) = {left():.4g} m/s",
        reason="The engine is light, so its plateau takes up much of its energy.",
    )


def _threshold(numbers: Numbers) -> Question:
    mass, metres = 100.0 * numbers.between(60, 68), numbers.between(14, 18) / 10
    plateau, friction = numbers.between(420, 480, 10), numbers.between(40, 60, 5)

    def speed(force: float = plateau + friction, half: float = 0.5) -> float:
        return math.sqrt(1e3 * force * metres / (half * mass))

    return Question(
        words=f"The body of a truck ({mass:g} kg) is slowed by its plateau force of {plateau} kN "
        f"and by friction of {friction} kN, over {metres:g} m. Above which speed of the truck "
        "does its cargo reach a rigid pier?",
        dimension="speed",
        answer=speed(),
        mistakes=(
            Mistake(speed(force=plateau), "That leaves out the friction."),
            Mistake(speed(force=plateau - friction), "Friction slows the body as well: it adds."),
            Mistake(speed(half=1.0), NO_HALF),
            Mistake(speed() * KMH, MS_AS_KMH),
            Mistake(speed() / KMH, KMH_AS_MS),
        ),
        start="At that speed the work of both forces takes up all of the body’s kinetic energy.",
        solution=f"½ m₂ V² = (P₂ + c_s) d₂, so V = √(2 × {1000 * (plateau + friction)} N × "
        f"{metres:g} m / {mass:g} kg) = {speed():.4g} m/s",
        reason="Below this speed there is no second spike.",
    )


_CHANGES = {
    "the truck is slower": {"speed": 0.7},
    "the crush length in front of its cargo is greater": {"body_plateau_length": 1.5},
    "the plateau force in front of its cargo is larger": {"body_plateau_force": 1.5},
    "its engine is heavier": {"engine_mass": 1.5},
}


@cache
def _arrives(change: str) -> bool:
    """Return whether the cargo still arrives after a change that is large on purpose."""
    before = Scenario(speed=65.0 * KMH)
    values = {name: factor * getattr(before, name) for name, factor in _CHANGES[change].items()}
    body = values.get("engine_mass", REFERENCE.engine_mass) + REFERENCE.body_mass
    after = replace(before, **values, truck_mass=body)
    return history(after).cargo_contact_time is not None


def _no_second_spike(numbers: Numbers) -> Question:
    (innocent,) = filter(_arrives, _CHANGES)
    length = numbers.between(65, 75)
    return Question(
        words=f"One truck causes two spikes at {length} km/h, another only the engine’s. They "
        "differ in one thing. Which of these can it not be?",
        answer=innocent,
        choices={
            "the truck is slower": "A slower body can be stopped by its plateau before the cargo "
            "arrives.",
            "the crush length in front of its cargo is greater": "A longer plateau takes up more "
            "energy before the cargo arrives.",
            "the plateau force in front of its cargo is larger": "A larger plateau force takes up "
            "more energy before the cargo arrives.",
            innocent: "",
        },
        solution=f"The cargo arrives if ½ m₂ V² > (P₂ + c_s) d₂. The engine’s mass does not stand "
        f"in it, so it cannot be that {innocent}.",
        reason="In this model engine and cargo are not joined: each has its own energy balance.",
    )


LESSON = Lesson(
    title="1 · One collision",
    minutes=40,
    prediction=Prediction(
        words="A truck of 8 t drives head-on into a bridge column at 80 km/h. How does the force "
        "on the column develop until the truck stands still?",
        choices=_CHOICES,
        answer=_spikes,
        look="Press Play and watch the forces: the orange and the blue line are the two springs.",
    ),
    misconceptions=(
        Misconception(
            "The truck strikes as one block.",
            "Engine and cargo arrive one after the other, each with a spike of its own.",
        ),
        Misconception(
            "The column feels the force at the bumper.",
            "The column has to move before it carries anything: its reaction comes later, and can "
            "be larger or smaller than the force.",
        ),
        Misconception(
            "Most of the energy goes into the pier.",
            "Almost all of it goes into crushed metal.",
        ),
    ),
    questions=(_stopping_length, _contact_speed, _threshold, _no_second_spike),
)
