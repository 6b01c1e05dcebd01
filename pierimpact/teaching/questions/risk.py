"""The lesson on the risk from traffic."""

import math

from pierimpact.teaching import presampled
from pierimpact.teaching.checker import Mistake, Question
from pierimpact.teaching.lesson import Lesson, Misconception, Prediction
from pierimpact.teaching.numbers import Numbers
from pierimpact.teaching.questions.common import KMH, KMH_AS_MS, MS_AS_KMH
from pierimpact.teaching.scenario import Scenario

_CHOICES = {
    "the heaviest, above 40 t, however slow": "They are few, and more load behind the same "
    "front does not make the first blow larger.",
    "the fastest, above 70 km/h, of any mass": "The blow grows with the speed, and few arrive so "
    "fast: most have braked on their way.",
    "the usual ones, of 50 to 70 km/h, because they are the most": "They are the most that "
    "strike, but most of them stay below the resistance.",
    "the light ones, below 10 t, for they stop last": "All brake alike in this model; and their "
    "cargo has little behind it.",
}


def shares(scenario: Scenario) -> dict[str, float]:
    """Return the shares of the exceedances that each choice of the prediction accounts for."""
    own, weights = presampled.presampled(), presampled.weights(scenario)
    above = weights * (own.reaction[scenario.risk_pier] > scenario.resistance)
    kmh = 3.6 * own.speed
    found = (own.mass > 40e3, kmh > 70.0, (kmh > 50.0) & (kmh <= 70.0), own.mass < 10e3)
    return {
        choice: float(above[which].sum() / above.sum())
        for choice, which in zip(_CHOICES, found, strict=True)
    }


def _most_feared() -> str:
    found = shares(Scenario())
    return max(found, key=lambda choice: found[choice])


_YEARS = 1000.0
_STRETCH = 14.4  # of road, 2.5 m / sin 10° [m]


def _departures(numbers: Numbers) -> Question:
    trucks = numbers.between(1200, 5200, 400)
    answer = trucks * 365.0 * 1e-10 * _STRETCH * _YEARS
    return Question(
        words=f"{trucks} trucks pass a pier on one day. A truck leaves the road with a chance of "
        "10⁻¹⁰ on a metre of it, and 14.4 m of road lead to the pier. How many leave the road "
        "toward the pier in 1000 years?",
        answer=answer,
        mistakes=(
            Mistake(answer / 365.0, "A year has more days than one."),
            Mistake(answer / _YEARS, "That is in one year."),
            Mistake(answer / _STRETCH, "The chance is that of one metre of the road."),
        ),
        start="Trucks in that time, times the chance on a metre, times the metres.",
        solution=f"{trucks} × 365 × 1000 × 10⁻¹⁰ 1/m × 14.4 m = {answer:.4g}",
        reason="How often is in proportion to the traffic. How hard is not.",
    )


def _arrival(numbers: Numbers) -> Question:
    kmh, braking = numbers.between(90, 110, 5), numbers.between(3, 4)
    way = numbers.between(55, 70, 5)  # so long that v − a s/v is not nearly right

    def left(speed: float = kmh * KMH, energy: float = 2.0) -> float:
        return math.sqrt(speed**2 - energy * braking * way)

    return Question(
        words=f"A truck leaves the road at {kmh} km/h and brakes at {braking} m/s² over the {way} "
        "m to the pier. How fast does it arrive?",
        dimension="speed",
        answer=left(),
        mistakes=(
            Mistake(left() * KMH, MS_AS_KMH),
            Mistake(left() / KMH, KMH_AS_MS),
            Mistake(left(energy=1.0), "Look at the energy again: ½ m v² and m a s."),
            Mistake(kmh * KMH - braking * way / (kmh * KMH), "It slows down on the way: it takes "
                    "longer than at its first speed."),
            Mistake(left(speed=kmh), "Put the speed in in m/s."),
        ),
        start="The work of braking is what the kinetic energy loses.",
        solution=f"v_r = √(v² − 2 a s) = √(({kmh * KMH:.4g} m/s)² − 2 × {braking} m/s² × {way} m) "
        f"= {left():.4g} m/s",
        reason="Distance protects twice: fewer arrive, and those that do are slower.",
    )  # fmt: skip


def _lifetime(numbers: Numbers) -> Question:
    life, between = numbers.between(80, 120, 10), numbers.between(250, 450, 50)
    answer = 1.0 - math.exp(-life / between)
    return Question(
        words=f"The resistance of a pier is exceeded once in {between} years on average. With what "
        f"chance is it exceeded within the {life} years that the bridge stands?",
        answer=answer,
        mistakes=(
            Mistake(life / between, "That counts events, of which there may be more than one; it "
                    "would pass one in the end."),
            Mistake(1.0 - answer, "That is the chance that nothing happens."),
            Mistake(100.0 * answer, "That is in per cent: give the chance itself."),
        ),
        start="The chance that nothing happens is exp(−time / mean time between events).",
        solution=f"1 − exp(−{life}/{between}) = {answer:.4g}",
        reason="Once in so many years is a mean. Nothing makes a pier safe until then.",
    )  # fmt: skip


LESSON = Lesson(
    title="7 · The risk from traffic",
    minutes=50,
    prediction=Prediction(
        words="A motorway passes 6 m from a pier of 30 Hz that resists a reaction of 5 MN. Trucks "
        "of every mass leave the road, brake, and some of them arrive. Which trucks account for "
        "most of the cases in which the resistance is exceeded?",
        choices=_CHOICES,
        answer=_most_feared,
        look="The bars are the trucks that exceed the resistance, the words beside them what is "
        "their share of all that strike.",
    ),
    misconceptions=(
        Misconception(
            "The heaviest truck is the worst.",
            "It is only as bad as it is fast: more load behind the same front does not make the "
            "first blow larger.",
        ),
        Misconception(
            "Twice the traffic is twice the force.",
            "It is twice as many hits; the reaction that is exceeded once in 10 000 years grows "
            "by far less.",
        ),
        Misconception(
            "Once in 1000 years is not in my time.",
            "It is one chance in a thousand in every year, the first included.",
        ),
    ),
    questions=(_departures, _arrival, _lifetime),
)
