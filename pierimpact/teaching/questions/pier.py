"""The lesson on the pier as one degree of freedom."""

import math

from pierimpact.pier.sections import CircularSection
from pierimpact.teaching.checker import Mistake, Question
from pierimpact.teaching.lesson import Lesson, Misconception, Prediction
from pierimpact.teaching.numbers import Numbers
from pierimpact.teaching.questions.common import NO_ROOT, OMEGA
from pierimpact.teaching.scenario import Scenario

_CHOICES = {
    "less than the column’s mass, for only a part of the column moves": "That holds where the "
    "column is held at its top and not struck close to its base. A free top moves more than the "
    "point that is struck.",
    "as much as the column’s mass": "Each part counts by the square of how far it moves compared "
    "with the point that is struck, not by its mass alone.",
    "more than the column’s mass": "The free top moves more than the point that is struck, and "
    "the square of its motion counts.",
}


def _mass_of_cantilever() -> str:
    struck = Scenario(top="free").column.struck_at(1.2)
    share = struck.mass / (struck.column.mass_per_length * struck.column.height)
    less, equal, more = _CHOICES
    return equal if abs(share - 1.0) < 0.05 else more if share > 1.0 else less


def _cantilever(numbers: Numbers) -> Question:
    bending, shear = numbers.between(400, 700, 20), numbers.between(3600, 5400, 200)
    height = numbers.between(10, 14) / 10

    def flexure(power: int = 3) -> float:
        return 3e6 * bending / height**power

    shear_alone = 1e6 * shear / height
    answer = 1.0 / (1.0 / flexure() + 1.0 / shear_alone)
    share = answer / shear_alone
    return Question(
        words="A cantilever is fixed at its base and free at its top. It is struck at z_n = "
        f"{height:g} m; EI = {bending} MN·m² and κGA = {shear} MN. What is its stiffness k_p "
        "there?",
        dimension="stiffness",
        answer=answer,
        mistakes=(
            Mistake(flexure(), "That leaves out the shear deflection."),
            Mistake(shear_alone, "That leaves out the flexural deflection."),
            Mistake(
                flexure() + shear_alone,
                "The deflections of flexure and shear add up, not their stiffnesses.",
            ),
            Mistake(
                1.0 / (1.0 / (flexure() / 3.0) + 1.0 / shear_alone),
                "A cantilever deflects by z³/(3EI): where is the 3?",
            ),
        ),
        start="Add the deflections of flexure and shear under a unit force; k_p is the inverse.",
        solution=f"x(z_n) = z_n³/(3EI) + z_n/(κGA) = {height:g}³/(3 × {bending}) + "
        f"{height:g}/{shear} = {1e6 / answer:.4g} m/MN; k_p = 1/x(z_n) = {answer / 1e6:.4g} MN/m",
        reason=f"Shear accounts for {share:.0%} of the deflection; nearer the base for more.",
    )


def _leaning(numbers: Numbers) -> Question:
    diameter, height = numbers.between(8, 12) / 10, numbers.between(40, 60) / 10
    struck = numbers.between(10, 16) / 10
    mass = 2400.0 * math.pi * diameter**2 / 4.0
    answer = mass * height**3 / (3.0 * struck**2)
    return Question(
        words=f"A stiff round column, {diameter:g} m thick, of concrete with 2400 kg/m³, stands on "
        f"a hinge; a soft spring at its top, {height:g} m up, keeps it upright. It stays straight "
        f"when it is struck, so that φ = z/z_n, with z_n = {struck:g} m. What is m_p?",
        dimension="mass",
        answer=answer,
        mistakes=(
            Mistake(mass * height, "That is the whole column; each part of it counts with its φ²."),
            Mistake(mass * height**2 / (2.0 * struck), "That integrates φ; Eq. 1 has φ²."),
            Mistake(
                mass * struck / 3.0, "The column above the impact moves too: integrate to the top."
            ),
            Mistake(mass * height / 3.0, "φ is 1 at the impact, at z_n, not at the top."),
            Mistake(4.0 * answer, "A diameter taken for a radius: the area is π D²/4."),
        ),
        start="Put φ = z/z_n into Eq. 1 and integrate from the hinge to the top.",
        solution=f"m̄ = 2400 × π × {diameter:g}²/4 = {mass:.1f} kg/m; m_p = m̄ ∫ (z/z_n)² dz = "
        f"m̄ H³/(3 z_n²) = {mass:.1f} kg/m × ({height:g} m)³ / (3 × ({struck:g} m)²) = "
        f"{answer:.0f} kg",
        reason="More than the mass of the column: m_p measures inertia at the impact.",
    )


def _frequency(numbers: Numbers) -> Question:
    meganewtons, tonnes = numbers.between(260, 560, 20), numbers.between(4, 12)
    stiffness, mass = 1e6 * meganewtons, 1e3 * tonnes

    def frequency(ratio: float = stiffness / mass) -> float:
        return math.sqrt(ratio) / (2.0 * math.pi)

    return Question(
        words=f"A pier has k_p = {meganewtons} MN/m and m_p = {tonnes} t. What is its frequency "
        "f_p?",
        dimension="frequency",
        answer=frequency(),
        mistakes=(
            Mistake(math.sqrt(stiffness / mass), OMEGA),
            Mistake(stiffness / mass / (2.0 * math.pi), NO_ROOT),
            Mistake(frequency(mass / stiffness), "Stiffness over mass, not mass over stiffness."),
            Mistake(
                frequency(meganewtons / tonnes),
                "Put in N/m and kg: the prefixes of MN/m and t do not cancel.",
            ),
            Mistake(frequency(stiffness / tonnes), "Was the mass that you put in in kg?"),
            Mistake(frequency(meganewtons / mass), "Was the stiffness that you put in in N/m?"),
        ),
        start="f_p = √(k_p/m_p) / 2π, with k_p in N/m and m_p in kg.",
        solution=f"f_p = √(k_p/m_p) / 2π = √({meganewtons}×10⁶ N/m / {1000 * tonnes} kg) / 2π = "
        f"{frequency():.4g} Hz",
        reason="This one number decides which part of the truck the pier responds to.",
    )


def _twice_the_diameter(numbers: Numbers) -> Question:
    diameter = numbers.between(5, 9) / 10
    thin, thick = (CircularSection(diameter=factor * diameter) for factor in (1.0, 2.0))
    stiffness, mass = (
        getattr(thick, name) / getattr(thin, name) for name in ("second_moment", "area")
    )
    factor = math.sqrt(stiffness / mass)
    return Question(
        words=f"A slender solid round column, {diameter:g} m thick, is replaced by one of twice "
        "the diameter. It is struck at the same height, and shear plays no part. Its frequency "
        "f_p becomes …",
        answer=f"{factor:.0f} times as high",
        choices={
            "as high as before": "The column is heavier, but it gains more in stiffness.",
            "2 times as high": "",
            "4 times as high": "That would hold if only the stiffness grew: the column is heavier, "
            "too.",
            "16 times as high": "That is the stiffness. The frequency has a square root, and the "
            "mass in it.",
        },
        solution=f"EI grows with D⁴, {stiffness:.0f} times; the mass with D², {mass:.0f} times; "
        f"f_p grows by √({stiffness:.0f}/{mass:.0f}) = {factor:.0f} times as high",
        reason="With shear it gains less: κGA grows with D² only.",
    )


LESSON = Lesson(
    title="2 · The pier as one mass on one spring",
    minutes=40,
    prediction=Prediction(
        words="A column is fixed at its base and free at its top. A truck strikes it near its "
        "base, and the point that is struck begins to move. How much mass does the truck meet "
        "there, if the whole column moves along in its bent shape?",
        choices=_CHOICES,
        answer=_mass_of_cantilever,
        look="Set Top to “free” and compare m_p with the whole column.",
    ),
    misconceptions=(
        Misconception(
            "The equivalent mass is a part of the column’s mass.",
            "It measures inertia at the impact, and exceeds the column’s mass where the rest "
            "moves more than the impact.",
        ),
        Misconception(
            "Stiffness belongs to the column.",
            "It belongs to the column and the height at which it is struck.",
        ),
        Misconception(
            "Columns deflect in bending, and shear may be neglected.",
            "The nearer to the base it is struck, the more shear counts: at 0.6 m the explorer’s "
            "column deflects more in shear than in bending.",
        ),
    ),
    questions=(_cantilever, _leaning, _frequency, _twice_the_diameter),
)
