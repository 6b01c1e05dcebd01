"""Exercises that check themselves, and the score of a notebook."""

import html
from dataclasses import dataclass, field

import ipywidgets as ipw

from pierimpact.checks import InputError, one_of
from pierimpact.plots.style import GREEN, MUTED, ORANGE
from pierimpact.teaching.checker import Question, Verdict, check
from pierimpact.teaching.markup import indexed, paragraph, show, still
from pierimpact.teaching.questions import QUESTIONS
from pierimpact.units import DIMENSIONS


@dataclass
class _Score:
    """Progress with the questions of a notebook: tries and solved ones, by number."""

    tries: dict[int, int] = field(default_factory=dict)
    solved: set[int] = field(default_factory=set)
    boards: list[ipw.HTML] = field(default_factory=list)


_SCORES: dict[str, _Score] = {}


def ask(topic: str, number: int) -> "Exercise":
    """Return the exercise of a topic and number, ready to be answered.

    Parameters
    ----------
    topic : str
        Name of the notebook's subject, such as "collision".
    number : int
        Number of the question, from 1.

    Raises
    ------
    InputError
        When there is no such exercise.
    """
    one_of("topic", topic, tuple(QUESTIONS))
    if not 1 <= number <= len(QUESTIONS[topic]):
        raise InputError(f"number must be 1 to {len(QUESTIONS[topic])}, got {number}")
    return Exercise(topic, number, QUESTIONS[topic][number - 1])


class Exercise:
    """A question with a box for the answer.

    Parameters
    ----------
    topic : str
        Topic whose score it counts for.
    number : int
        Its number there.
    question : Question
        The question.
    """

    def __init__(self, topic: str, number: int, question: Question) -> None:
        self.topic, self.number, self.question = topic, number, question
        self.feedback = ipw.HTML()
        self._checked = ""
        if question.choices:
            layout = ipw.Layout(width="auto")
            self.box = ipw.RadioButtons(options=question.choices, value=None, layout=layout)
        else:
            hint, layout = "a number", ipw.Layout(width="230px")
            if question.dimension:
                unit = DIMENSIONS[question.dimension].units.split(",")[0]
                hint = f"number and unit, e.g. in {unit}"
            self.box = ipw.Text(placeholder=hint, continuous_update=False, layout=layout)
            self.box.observe(self.answer, "value")  # on Enter, and on leaving the box
        button = ipw.Button(description="Check", icon="check", layout=ipw.Layout(width="90px"))
        button.on_click(self.answer)
        self.widget = ipw.VBox(
            [ipw.HTML(self._asked()), ipw.HBox([self.box, button]), self.feedback],
            layout=ipw.Layout(border_left=f"3px solid {MUTED}", padding="2px 0 4px 12px"),
        )

    def answer(self, *_: object) -> Verdict:
        """Check the answer in the box, show the reply and keep the score."""
        given = self.box.value or ""
        verdict = check(self.question, given)
        score = _SCORES.setdefault(self.topic, _Score())
        again, self._checked = given == self._checked, given
        if verdict.right is not None and self.number not in score.solved and not again:
            score.tries[self.number] = score.tries.get(self.number, 0) + 1
            if verdict.right:
                score.solved.add(self.number)
        colour = GREEN if verdict.right else ORANGE
        sign = {True: "✓", False: "✗", None: "…"}[verdict.right]
        words = f'<b style="color:{colour}">{sign}</b> {html.escape(verdict.words)}'
        self.feedback.value = paragraph(words, role="status")
        for board in score.boards:
            board.value = _summary(self.topic)
        return verdict

    def _asked(self) -> str:
        words = f"<b>Exercise {self.number}.</b> {indexed(self.question.words)}"
        return paragraph(words, "max-width:780px")

    def _ipython_display_(self) -> None:
        choices = "".join(f"<li>{html.escape(words)}</li>" for words in self.question.choices)
        note = f'<div style="color:{MUTED}">To be answered in the live notebook.</div>'
        show(self.widget, still(f"{self._asked()}{choices and f'<ul>{choices}</ul>'}{note}"))


def score(topic: str) -> None:
    """Show how many exercises of a topic are solved; it follows what is answered above."""
    board = ipw.HTML(_summary(topic))
    _SCORES.setdefault(topic, _Score()).boards.append(board)
    show(board, still(""))


def _summary(topic: str) -> str:
    one_of("topic", topic, tuple(QUESTIONS))
    state = _SCORES.get(topic, _Score())
    rows = ""
    for number in range(1, len(QUESTIONS[topic]) + 1):
        tries = state.tries.get(number, 0)
        count = "1 try" if tries == 1 else f"{tries} tries"
        mark, words = "○", f"not solved yet, {count}" if tries else "not tried yet"
        if number in state.solved:
            mark, words = "●", f"solved after {count}"
        rows += f'<div><span style="color:{GREEN}">{mark}</span> Exercise {number}: {words}</div>'
    return paragraph(f"<b>{len(state.solved)} of {len(QUESTIONS[topic])} solved</b>{rows}")
