"""A student's work on a lesson, kept in a plain file beside the notebook."""

import json
import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import pierimpact
from pierimpact.checks import InputError, brief, one_line
from pierimpact.files.reading import read_text
from pierimpact.teaching.checker import Progress, Question, Verdict, check, progress
from pierimpact.teaching.questions import LESSONS, lesson, questions

#: How the names of the files end.
ENDING = ".answers.json"
_LONGEST_NAME = 80  # letters
_MOST = 1_000_000  # length of a file [bytes]


@dataclass
class Work:
    """What someone has predicted and answered in one lesson.

    Scores are not part of it: they follow from the answers, by the checker.

    Parameters
    ----------
    lesson : str
        Name of the lesson.
    name : str, optional
        Name or number of the student; it decides the numbers of the questions.
    prediction : str, optional
        The choice, once it is locked.
    answers : dict of int to list of str, optional
        What was answered to each question, by its number, in order.
    version : str, optional
        Version of the package that the answers were given to.
    """

    lesson: str
    name: str = ""
    prediction: str = ""
    answers: dict[int, list[str]] = field(default_factory=dict)
    version: str = pierimpact.__version__

    @property
    def questions(self) -> tuple[Question, ...]:
        """The questions, with the student's own numbers."""
        return questions(self.lesson, self.name)

    def progress(self, number: int) -> Progress:
        """Return how far the student is with a question."""
        return progress(self.questions[number - 1], self.answers.get(number, []))

    @property
    def scores(self) -> list[Progress]:
        """How far the student is with each question."""
        return [self.progress(number) for number in range(1, len(self.questions) + 1)]

    @property
    def solved(self) -> int:
        """How many questions are solved."""
        return sum(score.right for score in self.scores)

    @property
    def predicted_right(self) -> bool:
        """Whether the prediction came true."""
        return self.prediction == lesson(self.lesson).prediction.answer()

    def written(self) -> str:
        """Return the work as the text of its file."""
        scores = {
            number: {"right": score.right, "tries": score.tries}
            for number, score in enumerate(self.scores, 1)
        }
        content = {
            "pierimpact": self.version,
            "lesson": self.lesson,
            "name": self.name,
            "prediction": self.prediction,
            "answers": self.answers,
            "scores": scores,
            "solved": f"{self.solved} of {len(scores)}",
        }
        return json.dumps(content, ensure_ascii=False, indent=2) + "\n"


def student_name(text: str) -> str:
    """Return a student's name or number, checked."""
    name = one_line("the name", " ".join(text.split()))
    if len(name) > _LONGEST_NAME:
        raise InputError(f"the name must have at most {_LONGEST_NAME} letters, got {brief(name)}")
    return name


def file_name(name: str) -> str:
    """Return the name of the file for a lesson, such as "01_collision.answers.json"."""
    lesson(name)
    return f"{list(LESSONS).index(name) + 1:02d}_{name}{ENDING}"


def read_work(path: Path) -> Work:
    """Return the work that a file holds.

    Raises
    ------
    InputError
        When it cannot be read, or is not such a file; the message says why in one line.
    """
    try:
        content = json.loads(read_text(path, _MOST)[1])
    except InputError as error:
        raise InputError(f"it {error}") from None
    except (ValueError, RecursionError):
        raise InputError("it is damaged: not the text of a JSON file") from None
    try:
        return _checked(content)
    except InputError:
        raise
    except (KeyError, TypeError, AttributeError, ValueError):
        raise InputError(
            "it is no answer file: it is not of the form that notebooks write"
        ) from None


def _checked(content: Mapping[str, Any]) -> Work:
    name, version = student_name(content["name"]), one_line("the version", content["pierimpact"])
    known, prediction = lesson(content["lesson"]), content["prediction"]
    if prediction and prediction not in known.prediction.choices:
        raise InputError(f"its prediction is none of the lesson’s choices: {brief(prediction)}")
    answers = {int(number): _texts(given) for number, given in content["answers"].items()}
    if not set(answers) <= set(range(1, len(known.questions) + 1)):
        raise InputError(f"it answers a question that the lesson {content['lesson']} does not have")
    return Work(content["lesson"], name, prediction, answers, version)


def _texts(given: object) -> list[str]:
    if not isinstance(given, list) or not all(isinstance(text, str) for text in given):
        raise InputError(f"its answers to a question must be a list of texts, got {brief(given)}")
    return given


class KeptWork:
    """The work on a lesson, as it is done in a notebook and kept in a file beside it.

    Parameters
    ----------
    lesson : str
        Name of the lesson.
    folder : Path
        Folder of the notebook.
    """

    def __init__(self, lesson: str, folder: Path) -> None:
        self.path = folder / file_name(lesson)
        self.trouble = ""  #: what is wrong with the file, as a sentence
        self.watchers: list[Callable[[], None]] = []  #: called after every change
        self.work = self._restored(lesson)

    def _restored(self, lesson: str) -> Work:
        if not self.path.exists():
            return Work(lesson, self._name_elsewhere())
        try:
            work = read_work(self.path)
            if work.lesson != lesson:
                raise InputError(f"it belongs to the lesson {work.lesson}")
        except InputError as error:
            self.trouble = f"{self.path.name} was not restored, for {error}. {self._set_aside()}"
            return Work(lesson, self._name_elsewhere())
        work.version = pierimpact.__version__
        return work

    def _name_elsewhere(self) -> str:
        """Return the name that was given in another lesson, the latest."""
        for name in reversed(LESSONS):
            path = self.path.with_name(file_name(name))
            with suppress(InputError):
                if path != self.path and path.exists():
                    return read_work(path).name
        return ""

    def _set_aside(self) -> str:
        """Rename the file, so that nothing is written over it; return what was done."""
        number = 1
        while (aside := self.path.with_name(f"{self.path.name}.damaged-{number}")).exists():
            number += 1
        try:
            self.path.rename(aside)
        except OSError as error:
            return f"It cannot be set aside either: {error.strerror}."
        return f"It is set aside as {aside.name}, and the lesson begins anew."

    @property
    def fixed(self) -> bool:
        """Whether the name is fixed, for an answer rests on its numbers."""
        return any(self.work.answers.values())

    def rename(self, text: str) -> None:
        """Take a student's name or number, while no answer rests on another.

        Raises
        ------
        InputError
            When it is not one line, or an answer has been given.
        """
        name = student_name(text)
        if name == self.work.name:
            return
        if self.fixed:
            raise InputError("your numbers are fixed with your first answer, and your name with it")
        self.work.name = name
        self._changed()

    def predict(self, choice: str) -> None:
        """Lock a prediction; the first one counts."""
        if not self.work.prediction:
            self.work.prediction = choice
            self._changed()

    def answer(self, number: int, given: str) -> Verdict:
        """Return the verdict on an answer, and keep it where it counts.

        Parameters
        ----------
        number : int
            Number of the question, from 1.
        given : str
            The text typed or the choice made.
        """
        verdict = check(self.work.questions[number - 1], given)
        before = self.work.answers.get(number, [])
        again = bool(before) and before[-1] == given
        if verdict.right is not None and not again and not self.work.progress(number).closed:
            self.work.answers[number] = [*before, given]
            self._changed()
        return verdict

    def _changed(self) -> None:
        try:
            _write(self.path, self.work.written())
            self.trouble = ""
        except OSError as error:
            self.trouble = f"Your work cannot be kept in {self.path.name}: {error.strerror}."
        for watcher in self.watchers:
            watcher()


def _write(path: Path, text: str) -> None:
    """Write a file whole or not at all, whatever happens meanwhile."""
    new = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with new.open("w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        new.replace(path)
    finally:
        new.unlink(missing_ok=True)


#: The work on a lesson in a folder, made once.
kept_work = cache(KeptWork)


def work_on(name: str) -> KeptWork:
    """Return the work on a lesson in this notebook: one for all of its cells."""
    return kept_work(name, Path.cwd())
