import math
import re
from pathlib import Path

import pytest
from calculator import Procedure
from reference import solve
from scipy.optimize import brentq

from pierimpact import CircularSection, EquivalentPier, PierColumn, exercises, load_truck
from pierimpact.checks import InputError
from pierimpact.teaching.checker import Question, check
from pierimpact.teaching.questions import QUESTIONS
from pierimpact.units import DIMENSIONS

ALL = [
    pytest.param(question, id=f"{topic} {number}")
    for topic, questions in QUESTIONS.items()
    for number, question in enumerate(questions, 1)
]
NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("0*.ipynb"))


def typed(question, value):
    """Return a value in SI units as a student types it."""
    if isinstance(value, str):
        return value
    return (
        f"{value:.4g} {DIMENSIONS[question.dimension].si}" if question.dimension else f"{value:.4g}"
    )


KMH = 1.0 / 3.6
TRUCK = load_truck("single-unit-8t")
COLUMN = PierColumn(
    height=5.0, section=CircularSection(diameter=0.914), elastic_modulus=25e9, density=2400.0
)
PIER = COLUMN.equivalent(1.2)


def solved(frequency):
    """The full model of the truck and a pier of 8 t, by the tests' own integration."""
    stiffness = 8e3 * (2.0 * math.pi * frequency) ** 2
    return solve(TRUCK, EquivalentPier(mass=8e3, stiffness=stiffness), 80.0 * KMH)


def crossing():
    """Frequency from which on the engine governs [Hz]."""

    def excess(frequency):
        found = solved(frequency)
        return found.engine - found.cargo

    return brentq(excess, 40.0, 60.0, xtol=0.05)


def designed():
    found = Procedure(TRUCK, PIER, 60.0 * KMH, "long")
    return max(found.engine, found.cargo)


# Worked out from the numbers in the words.
ANSWERS = {
    "collision": (
        lambda: 0.5 * 8e3 * (60.0 * KMH) ** 2,
        lambda: math.sqrt((60.0 * KMH) ** 2 - 2.0 * 150e3 * 0.5 / 700.0),
        lambda: math.sqrt(2.0 * 521.5e3 * 1.9 / 7300.0),
        lambda: "the cargo peak",
    ),
    "pier": (
        lambda: 1.0 / (1.2**3 / (3.0 * 502.65e6) + 1.2 / 4712.4e6),
        lambda: 1574.7 * 4.054,
        lambda: math.sqrt(1e5) / (2.0 * math.pi),
        lambda: "softer",
    ),
    "reduction": (
        lambda: 30.0 * 2.0 * math.pi / math.sqrt(150e6 / 700.0),
        lambda: 50.0 * KMH * math.sqrt(150e6 * 700.0),
        lambda: 0.1 * (1.0 + math.sqrt(150.0 / 900.0)),
    ),
    "spectra": (
        lambda: solved(10.0).engine,
        lambda: solved(10.0).cargo,
        crossing,
        lambda: "the engine peak",
    ),
    "design": (
        designed,
        lambda: 25.0 * math.sqrt(300e3 * 30e3),
        lambda: designed() / 2668.933e3,
    ),
    "limits": (
        lambda: "the engine’s mass",
        lambda: math.sqrt(1.0 / 6.0),
        lambda: "illustrative values of this project",
    ),
}


@pytest.mark.parametrize(
    ("question", "worked_out"),
    [
        pytest.param(question, worked_out, id=f"{topic} {number}")
        for topic, questions in QUESTIONS.items()
        for number, (question, worked_out) in enumerate(
            zip(questions, ANSWERS[topic], strict=True), 1
        )
    ],
)
def test_the_answer_is_what_its_words_ask_for(question, worked_out):
    answer, expected = question.answer(), worked_out()
    if isinstance(expected, str):
        assert answer == expected
    else:  # the words have four figures, and a spectrum its steps
        assert answer == pytest.approx(expected, rel=0.02 if worked_out is crossing else 5e-4)
    verdict = check(question, typed(question, expected))
    assert verdict.right, verdict.words


@pytest.mark.parametrize("question", ALL)
def test_every_trap_is_met_with_its_hint(question):
    for trap in question.traps:
        verdict = check(question, typed(question, trap.value()))
        assert verdict.right is False
        assert verdict.words == trap.hint


@pytest.mark.parametrize("question", ALL)
def test_no_hint_gives_the_answer_away(question):
    answer = question.answer()
    if isinstance(answer, str):
        return
    for factor in (0.3, 0.97, 1.04, 5.0, 1e3, -1.0):
        words = check(question, typed(question, factor * answer)).words
        hints = [float(n) for n in re.findall(r"\d+\.?\d*(?!\d|²)", words)]
        assert not any(abs(n - answer) < 0.02 * abs(answer) for n in hints), words


@pytest.mark.parametrize("question", ALL)
def test_one_choice_is_right(question):
    if question.choices:
        assert [check(question, choice).right for choice in question.choices].count(True) == 1


FORCE = Question(words="?", dimension="force", answer=lambda: 2.5e6)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("2500 N", "N or kN"),
        ("2500 MN", "N or kN"),
        ("5 MN", "out by 2"),
        ("2.5 N", "out by a million"),
        ("9 MN", "out by 3.6:"),
        ("32.4 MN", "out by 3.6²"),
        ("25 MN", "out by about 10"),
        ("15.7 MN", "out by 2π"),
        ("625 kN", "out by 4"),
        ("-2.5 MN", "sign"),
        ("2.6 MN", "Close"),
        ("3 MN", "too large"),
        ("70 kN", "too small"),
        ("80 MN", "too large"),
    ],
)
def test_hints(given, said):
    verdict = check(FORCE, given)
    assert verdict.right is False
    assert said in verdict.words


@pytest.mark.parametrize("given", ["2.5", "2.5 kg", "much", "nan kN", "  "])
def test_what_is_no_answer_does_not_count_as_one(given):
    assert check(FORCE, given).right is None


@pytest.mark.parametrize("given", ["2.5 MN", "2500 kN", "562 kip", "2.49 MN", " 2.52 MN "])
def test_any_unit_and_the_tolerance_count_as_right(given):
    assert check(FORCE, given).right is True


def test_the_score_follows_the_answers(monkeypatch):
    monkeypatch.setattr(exercises, "_SCORES", {})
    shown = []
    monkeypatch.setattr(exercises, "show", lambda widget, still: shown.append(widget))
    exercises.score("collision")
    board = shown[0]
    assert board.value.count("not tried yet") == len(QUESTIONS["collision"])
    exercise = exercises.ask("collision", 1)
    for given in ("3 kN", "3 kJ", typed(exercise.question, exercise.question.answer()), "3 kJ"):
        exercise.box.value = given
        exercise.answer()
    assert f"1 of {len(QUESTIONS['collision'])} solved" in board.value
    assert "Exercise 1: solved after 2 tries" in board.value


def test_markup_in_an_answer_is_shown_as_text():
    exercise = exercises.ask("pier", 1)
    exercise.box.value = "<b>1</b>"
    exercise.answer()
    assert "<b>1" not in exercise.feedback.value


@pytest.mark.parametrize(("topic", "number"), [("colision", 1), ("pier", 0), ("pier", 9)])
def test_an_unknown_exercise(topic, number):
    with pytest.raises(InputError, match="must be"):
        exercises.ask(topic, number)


def test_every_exercise_is_asked_once_and_in_order():
    asked = []
    for notebook in NOTEBOOKS:
        text = notebook.read_text(encoding="utf-8")
        asked += re.findall(r'exercises\.ask\(\\"(\w+)\\", (\d+)\)', text)
    assert asked == [
        (topic, str(number))
        for topic, questions in QUESTIONS.items()
        for number in range(1, len(questions) + 1)
    ]
