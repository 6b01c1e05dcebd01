import re
from pathlib import Path

import pytest

from pierimpact import exercises
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


@pytest.mark.parametrize("question", ALL)
def test_the_answer_is_right(question):
    verdict = check(question, typed(question, question.answer()))
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
        ("-2.5 MN", "sign"),
        ("2.6 MN", "Close"),
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
