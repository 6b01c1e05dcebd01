"""Exercises that check themselves, with a student's own numbers, and the score of a notebook."""

import html

import ipywidgets as ipw

from pierimpact.checks import InputError
from pierimpact.plots.style import GREEN, VERMILION
from pierimpact.teaching.checker import TRIES, Question, Verdict
from pierimpact.teaching.markup import (
    FRAME,
    Shown,
    choice_list,
    indexed,
    muted,
    paragraph,
    refusal,
    still,
)
from pierimpact.teaching.questions import questions
from pierimpact.teaching.work import work_on
from pierimpact.units import DIMENSIONS

_LIVE_ONLY = muted("To be answered in the live notebook.")


class Student:
    """A box for the student's name or number, which decides the numbers of the exercises.

    Parameters
    ----------
    lesson : str
        Name of the lesson.
    """

    def __init__(self, lesson: str) -> None:
        self.kept = work_on(lesson)
        self.box = ipw.Text(
            value=self.kept.work.name,
            description="Your name or number",
            continuous_update=False,
            layout=ipw.Layout(width="400px"),
            style={"description_width": "initial"},
        )
        self.message = ipw.HTML()
        self.widget = ipw.VBox([self.box, self.message])
        self._shown = Shown(self.widget)
        self._follow()
        self.box.observe(self._given, "value")
        self.kept.watchers.append(self._follow)

    def _given(self, *_: object) -> None:
        try:
            self.kept.rename(self.box.value)
        except InputError as error:
            self._follow(f"The name was not taken: {error}.")
        else:
            self._follow()

    def _follow(self, refused: str = "") -> None:
        kept = self.kept
        self.box.disabled = kept.fixed
        whose = f"of {kept.work.name}" if kept.work.name else "that everybody has"
        when = "They are fixed with your first answer."
        if kept.fixed:
            when = "To begin anew, move the file away and run the notebook in a new kernel."
        words = (
            f"The exercises below have the numbers {whose}. Your work is kept in "
            f"{kept.path.name}, beside this notebook. {when}"
        )
        trouble = refused or kept.trouble
        self.message.value = (refusal(trouble) if trouble else "") + muted(html.escape(words))
        name = html.escape(kept.work.name)
        self._shown.instead(still(paragraph(f"<b>{name}</b>") if name else ""))

    def _ipython_display_(self) -> None:
        self._shown.display()


def begin(lesson: str) -> Student:
    """Ask for the student's name or number, which decides the numbers of the exercises.

    Parameters
    ----------
    lesson : str
        Name of the notebook's subject, such as "collision".

    Returns
    -------
    Student
        The box for the name, as a notebook shows it.

    Raises
    ------
    InputError
        When there is no such lesson.

    Examples
    --------
    >>> from pierimpact import exercises
    >>> student = exercises.begin("collision")
    >>> student.kept.path.name  # where the work is kept, beside the notebook
    '01_collision.answers.json'
    """
    return Student(lesson)


def ask(lesson: str, number: int) -> "Exercise":
    """Return the exercise of a lesson and number, ready to be answered.

    Parameters
    ----------
    lesson : str
        Name of the notebook's subject, such as "collision".
    number : int
        Number of the question, from 1.

    Returns
    -------
    Exercise
        The question with a box for the answer, as a notebook shows them.

    Raises
    ------
    InputError
        When there is no such exercise.

    Examples
    --------
    >>> from pierimpact import exercises
    >>> from pierimpact.teaching.checker import check
    >>> exercise = exercises.ask("collision", 1)
    >>> exercise.question.words.rpartition(". ")[2]
    'Over what length?'
    >>> check(exercise.question, "10.48 m").words  # a hint, which does not count as an answer
    'Look at the kinetic energy again: there is a factor ½ in it.'
    """
    last = len(questions(lesson))
    if not 1 <= number <= last:
        raise InputError(f"number must be 1 to {last}, got {number}")
    return Exercise(lesson, number)


class Exercise:
    """A question with a box for the answer.

    Parameters
    ----------
    lesson : str
        Lesson that it belongs to.
    number : int
        Its number there.
    """

    def __init__(self, lesson: str, number: int) -> None:
        self.kept, self.number = work_on(lesson), number
        self.words, self.feedback = ipw.HTML(), ipw.HTML()
        question = self.question
        named = {
            "description": f"Answer to exercise {number}",
            "style": {"description_width": "initial"},
        }
        if question.choices:
            layout = ipw.Layout(width="auto")
            options = tuple(question.choices)
            self.box = ipw.RadioButtons(options=options, value=None, layout=layout, **named)
        else:
            hint, layout = "a number", ipw.Layout(width="400px")
            if question.dimension:
                unit = DIMENSIONS[question.dimension].units.split(",")[0]
                hint = f"number and unit, e.g. in {unit}"
            self.box = ipw.Text(placeholder=hint, continuous_update=False, layout=layout, **named)
        self._restore()
        if not question.choices:
            self.box.observe(self.answer, "value")  # on Enter, and on leaving the box
        self.button = ipw.Button(
            description=f"Check exercise {number}", layout=ipw.Layout(width="160px")
        )
        self.button.on_click(self.answer)
        self.widget = ipw.VBox(
            [self.words, ipw.HBox([self.box, self.button]), self.feedback],
            layout=ipw.Layout(border_left=FRAME, padding="2px 0 4px 12px"),
        )
        self._shown = Shown(self.widget)
        self._follow()
        self.kept.watchers.append(self._follow)

    @property
    def question(self) -> Question:
        """The question, with the student's own numbers."""
        return self.kept.work.questions[self.number - 1]

    def _restore(self) -> None:
        """Put the last answer that was kept in the box."""
        given = self.kept.work.answers.get(self.number)
        if given and (not self.question.choices or given[-1] in self.question.choices):
            self.box.value = given[-1]

    def answer(self, *_: object) -> Verdict:
        """Check the answer in the box, show the reply and keep the score."""
        verdict = self.kept.answer(self.number, self.box.value or "")
        self._reply(verdict)
        return verdict

    def _follow(self) -> None:
        """Show the question with the student's numbers, and the reply to what was kept."""
        if self.words.value != self._asked():  # a reply to other numbers means nothing
            self.words.value, self.feedback.value = self._asked(), ""
        progress = self.kept.work.progress(self.number)
        if progress.tries:
            self._reply(Verdict(progress.right, progress.reply))
        else:
            self._show_still()

    def _reply(self, verdict: Verdict) -> None:
        progress = self.kept.work.progress(self.number)
        colour = GREEN if verdict.right else VERMILION
        sign = {True: "✓", False: "✗", None: "…"}[verdict.right]
        words = f'<b style="color:{colour}">{sign}</b> {indexed(verdict.words)}'
        if progress.closed:
            words += f"<br><b>Worked solution.</b> {indexed(self.question.solution)}"
        elif verdict.right is False and not self.question.choices:
            left = TRIES - progress.tries
            words += muted(f"{left} more {'try' if left == 1 else 'tries'} before the solution.")
        self.feedback.value = paragraph(words, "max-width:780px", role="status")
        self._show_still()

    def _show_still(self) -> None:
        given = self.kept.work.answers.get(self.number)
        told = f"{paragraph(html.escape(given[-1]))}{self.feedback.value}" if given else _LIVE_ONLY
        self._shown.instead(still(f"{self._asked()}{choice_list(self.question.choices)}{told}"))

    def _asked(self) -> str:
        words = f"<b>Exercise {self.number}.</b> {indexed(self.question.words)}"
        return paragraph(words, "max-width:780px")

    def _ipython_display_(self) -> None:
        self._shown.display()


class Score:
    """How many exercises of a lesson are solved; it follows what is answered above.

    Parameters
    ----------
    lesson : str
        Name of the lesson.
    """

    def __init__(self, lesson: str) -> None:
        self.kept, self.board = work_on(lesson), ipw.HTML()
        self._shown = Shown(self.board)
        self._follow()
        self.kept.watchers.append(self._follow)

    def _follow(self) -> None:
        scores, rows = self.kept.work.scores, ""
        for number, progress in enumerate(scores, 1):
            count = "1 try" if progress.tries == 1 else f"{progress.tries} tries"
            mark, words = "○", f"not solved yet, {count}" if progress.tries else "not tried yet"
            if progress.right:
                mark, words = "●", f"solved after {count}"
            elif progress.closed:
                mark, words = "×", f"worked solution shown after {count}"
            sign = f'<span style="color:{GREEN}">{mark}</span>'
            rows += f"<div>{sign} Exercise {number}: {words}</div>"
        solved = f"<b>{self.kept.work.solved} of {len(scores)} solved</b>"
        self.board.value = paragraph(f"{solved}{rows}")
        self._shown.instead(still(self.board.value if any(score.tries for score in scores) else ""))

    def _ipython_display_(self) -> None:
        self._shown.display()


def score(lesson: str) -> Score:
    """Return how many exercises of a lesson are solved; it follows what is answered above.

    Parameters
    ----------
    lesson : str
        Name of the notebook's subject, such as "collision".

    Returns
    -------
    Score
        The score with a line for each exercise, as a notebook shows it.

    Raises
    ------
    InputError
        When there is no such lesson.

    Examples
    --------
    >>> from pierimpact import exercises
    >>> score = exercises.score("collision")
    >>> "0 of 4 solved" in score.board.value
    True
    """
    return Score(lesson)
