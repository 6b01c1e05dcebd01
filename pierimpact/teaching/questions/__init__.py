"""The lessons of the teaching notebooks, a module for each; answers are computed."""

from functools import lru_cache

from pierimpact.checks import one_of
from pierimpact.teaching.checker import Question
from pierimpact.teaching.lesson import Lesson
from pierimpact.teaching.numbers import Numbers, same_name
from pierimpact.teaching.questions import collision, design, limits, pier, reduction, risk, spectra

#: The lessons by name, in the order of their notebooks.
LESSONS: dict[str, Lesson] = {
    "collision": collision.LESSON,
    "pier": pier.LESSON,
    "reduction": reduction.LESSON,
    "spectra": spectra.LESSON,
    "design": design.LESSON,
    "limits": limits.LESSON,
    "risk": risk.LESSON,
}


def lesson(name: str) -> Lesson:
    """Return a lesson by its name.

    Raises
    ------
    InputError
        When there is no such lesson.
    """
    return LESSONS[one_of("lesson", name, tuple(LESSONS))]


def questions(name: str, student: str = "") -> tuple[Question, ...]:
    """Return the questions of a lesson with a student's own numbers.

    Parameters
    ----------
    name : str
        Name of the lesson.
    student : str, optional
        Name or number of the student; those who give none all have the same numbers.
    """
    lesson(name)
    return _questions(name, same_name(student))


@lru_cache(maxsize=64)
def _questions(name: str, student: str) -> tuple[Question, ...]:
    asked = enumerate(LESSONS[name].questions, 1)
    return tuple(ask(Numbers(student, f"{name} {number}")) for number, ask in asked)
