"""What a lesson consists of, beside its explorer: a prediction, beliefs to correct, questions."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from pierimpact.teaching.checker import Question
from pierimpact.teaching.numbers import Numbers


class Misconception(NamedTuple):
    """What many believe, and what holds instead; the notebook says both in these words."""

    belief: str
    truth: str


class Prediction(NamedTuple):
    """A choice that is made before the explorer shows the answer."""

    words: str
    choices: Mapping[str, str]  #: each with what is said to it once the answer is in sight
    answer: Callable[[], str]  #: computes the right one
    look: str  #: where the explorer shows it


class Lesson(NamedTuple):
    """A lesson of the course."""

    title: str
    minutes: int  #: time planned for it in class, an estimate
    prediction: Prediction
    misconceptions: tuple[Misconception, ...]
    questions: tuple[Callable[[Numbers], Question], ...]
