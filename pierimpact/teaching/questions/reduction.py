"""The lesson on the reduction to two degrees of freedom."""

import math

from pierimpact.design.reduction import exact_amplification
from pierimpact.teaching.checker import Mistake, Question
from pierimpact.teaching.lesson import Lesson, Misconception, Prediction
from pierimpact.teaching.numbers import Numbers
from pierimpact.teaching.questions.common import IN_KMH, IN_TONNES, KMH, NO_ROOT, OMEGA
from pierimpact.teaching.scenario import REFERENCE

_CHOICES = {
    "a larger reaction, for a soft pier swings farther": "It does swing farther, but softly: the "
    "reaction is stiffness times deflection.",
    "the same reaction, for the blow is the same": "The spring force is nearly the same. It is "
    "over before the soft pier has moved, and most of it goes into accelerating the pier’s mass.",
    "a smaller reaction": "The blow is over before the soft pier has moved. The pier takes up the "
    "impulse, and carries it slowly, with a smaller force.",
}


def _on_a_soft_pier() -> str:
    ratios = [0.2, 1.5]  # of the pier's frequency to the engine's
    mass = REFERENCE.engine_mass / 8e3
    soft, stiff = exact_amplification(ratios, mass, REFERENCE.engine_spring.restitution, 0.05)
    larger, same, smaller = _CHOICES
    if abs(soft / stiff - 1.0) < 0.1:
        return same
    return larger if soft > stiff else smaller


def _frequency_ratio(numbers: Numbers) -> Question:
    hertz, mass = numbers.between(14, 20, 2), numbers.between(550, 850, 50)
    meganewtons = numbers.between(110, 190, 10)
    body = math.sqrt(1e6 * meganewtons / mass) / (2.0 * math.pi)
    beta = hertz / body
    return Question(
        words=f"An engine of {mass} kg meets the pier through a steep spring of {meganewtons} MN/m;"
        f" the pier has f_p = {hertz} Hz. What is β?",
        answer=beta,
        mistakes=(
            Mistake(1.0 / beta, "β is the pier’s frequency over the engine’s, not the inverse."),
            Mistake(beta / (2.0 * math.pi), OMEGA),
            Mistake(beta * 2.0 * math.pi, OMEGA),
            Mistake(beta / body / (2.0 * math.pi), NO_ROOT),
            Mistake(beta / math.sqrt(1e3), IN_TONNES),
            Mistake(beta * 1e3, "Was the stiffness that you put in in N/m?"),
        ),
        start="Find f = √(k/m) / 2π of the engine first.",
        solution=f"f₁ = √({meganewtons}×10⁶ N/m / {mass} kg) / 2π = {body:.4g} Hz; "
        f"β = f_p / f₁ = {hertz} / {body:.4g} = {beta:.4g}",
        reason="Below 1 the pier is slow: to it the engine’s blow is nearly an impulse.",
    )


def _rigid(numbers: Numbers) -> Question:
    kmh, mass = numbers.between(42, 66, 2), numbers.between(550, 850, 50)
    meganewtons = numbers.between(110, 190, 10)

    def force(speed: float = kmh * KMH, mass: float = mass) -> float:
        return speed * math.sqrt(1e6 * meganewtons * mass)

    return Question(
        words=f"An engine of {mass} kg strikes a rigid wall at {kmh} km/h, with a steep spring of "
        f"{meganewtons} MN/m and nothing in front. How large does the force become?",
        dimension="force",
        answer=force(),
        mistakes=(
            Mistake(force(speed=kmh), IN_KMH),
            Mistake(force(mass=mass / 1e3), IN_TONNES),
            Mistake(force() / math.sqrt(2.0), "Both energies, ½ m v² and ½ F²/k, have a factor ½."),
            Mistake(force() * math.sqrt(2.0), "Both energies, ½ m v² and ½ F²/k, have a factor ½."),
        ),
        start="At the largest force all of ½ m v² is in the spring, as ½ F²/k.",
        solution=f"½ m v² = ½ F²/k, so F = v √(k m) = {kmh * KMH:.4g} m/s × √({meganewtons}×10⁶ "
        f"N/m × {mass} kg) = {force() / 1e6:.4g} MN",
        reason="Speed, stiffness and mass: nothing else enters a hard impact.",
    )


def _impulse_limit(numbers: Numbers) -> Question:
    beta, mass = numbers.between(6, 12) / 100, numbers.between(6, 9) / 10
    loading, unloading = numbers.between(120, 150, 10), numbers.between(750, 1000, 50)
    e = math.sqrt(loading / unloading)

    def amplification(e: float = e, mass: float = mass) -> float:
        return (1.0 + e) * beta / (1.0 + mass)

    return Question(
        words=f"A body strikes a soft pier with β = {beta:g}; it has {mass:g} times the pier’s "
        f"mass. Its spring loads with {loading} MN/m and unloads with {unloading} MN/m. What is S "
        "in the limit of an impulse?",
        answer=amplification(),
        mistakes=(
            Mistake(
                amplification(e=0.0), "That leaves out the rebound: the body does not just stop."
            ),
            Mistake(
                amplification(mass=0.0),
                "That is for a body much lighter than the pier: where is 1 + μ?",
            ),
            Mistake(amplification(e=0.0, mass=0.0), "Neither rebound nor mass ratio is in that."),
            Mistake(amplification(e=e**2), "The restitution is the square root of k over k_u."),
            Mistake(amplification(e=1.0 / e), "k over k_u, not k_u over k: e is below 1."),
        ),
        start="Find e = √(k/k_u) and μ first.",
        solution=f"e = √({loading}/{unloading}) = {e:.4g}; S = (1 + e) β / (1 + μ) = "
        f"(1 + {e:.4g}) × {beta:g} / (1 + {mass:g}) = {amplification():.4g}",
        reason="The pier carries a fraction of the force, but takes all of the impulse.",
    )


LESSON = Lesson(
    title="3 · Two masses at a time",
    minutes=50,
    prediction=Prediction(
        words="The engine strikes two piers of the same mass at the same speed. One is stiff, the "
        "other so soft that it swings much more slowly than the engine’s blow lasts. The soft pier "
        "has …",
        choices=_CHOICES,
        answer=_on_a_soft_pier,
        look="Move the pier’s frequency down to 10 Hz and watch S of the engine.",
    ),
    misconceptions=(
        Misconception(
            "A pier carries the force that strikes it.",
            "It carries S times as much: far less where it is soft, up to half as much again in "
            "between, and just that force where it is stiff.",
        ),
        Misconception(
            "Where S exceeds 1 there is resonance.",
            "Resonance needs a force that repeats. One pulse makes a pier overshoot, and no more.",
        ),
        Misconception(
            "A pier is soft or stiff.",
            "It is soft for one body and stiff for another: only the ratio β tells.",
        ),
    ),
    questions=(_rigid, _frequency_ratio, _impulse_limit),
)
