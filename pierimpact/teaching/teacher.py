"""The teacher's sheet: times, beliefs to correct, and worked answers with one student's numbers."""

from collections.abc import Iterator

from pierimpact.teaching.checker import Question
from pierimpact.teaching.lesson import Lesson
from pierimpact.teaching.questions import LESSONS, questions
from pierimpact.teaching.work import student_name
from pierimpact.units import DIMENSIONS, rounded


def teachers_sheet(student: str = "") -> str:
    """Return the sheet as Markdown.

    Parameters
    ----------
    student : str, optional
        Name or number of the student whose numbers the questions have; those that everybody has
        who gives none.

    Raises
    ------
    InputError
        When it is not one line.
    """
    name = student_name(student)
    minutes = sum(lesson.minutes for lesson in LESSONS.values())
    lines = [
        f"# Teacher’s sheet: answers for {name or 'those who give no name'}",
        "",
        f"{len(LESSONS)} lessons, {minutes} minutes in all. The times are an estimate.",
    ]
    for key, lesson in LESSONS.items():
        lines += ["", *_of_lesson(lesson), ""]
        for number, question in enumerate(questions(key, name), 1):
            lines += _of_question(number, question)
    return "\n".join(lines) + "\n"


def _of_lesson(lesson: Lesson) -> Iterator[str]:
    right = lesson.prediction.answer()
    yield from (f"## {lesson.title}", "", f"Time: {lesson.minutes} minutes", "", "Misconceptions:")
    yield ""
    for belief, truth in lesson.misconceptions:
        yield f"- “{belief}” {truth}"
    yield from ("", f"Prediction: {lesson.prediction.words}", "")
    for choice, reply in lesson.prediction.choices.items():
        yield f"- {'**right:** ' if choice == right else ''}{choice} — {reply}"


def _of_question(number: int, question: Question) -> Iterator[str]:
    yield from (f"### Exercise {number}", "", question.words, "")
    for choice, wrong in question.choices.items():
        yield f"- {'**right:** ' if choice == question.answer else ''}{choice}"
        if wrong:
            yield f"  - {wrong}"
    if question.choices:
        yield ""
    yield from (f"Answer: {question.solution}", "")
    unit = DIMENSIONS[question.dimension].si if question.dimension else ""
    for mistake in question.mistakes:
        yield f"- {f'{rounded(mistake.value, 4)} {unit}'.strip()}: {mistake.hint}"
    if question.mistakes:
        yield ""
