"""The checker of exercises: right within a tolerance, or a hint that does not give it away."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from pierimpact.checks import InputError
from pierimpact.teaching.reading import readings

#: After so many wrong answers the worked solution is shown, and no answer counts any more.
TRIES = 3
# A number rounded to two figures on the way is off by so much at most, in most cases [-].
_ROUNDED = 0.02


class Mistake(NamedTuple):
    """A likely wrong answer in SI units, computed, and the hint for it."""

    value: float
    hint: str


@dataclass(frozen=True, kw_only=True)
class Question:
    """A question with a student's own numbers in it.

    Parameters
    ----------
    words : str
        The question, in plain text.
    answer : float or str
        The answer in SI units, or the right one of `choices`.
    dimension : str, optional
        Dimension of the answer, as in `pierimpact.units`; empty for a plain number.
    tolerance : float, optional
        Largest relative error that counts as right [-].
    mistakes : tuple of Mistake, optional
        Likely wrong answers.
    choices : mapping of str to str, optional
        The answers to choose from, each with what is said to it where it is wrong.
    start : str, optional
        How to begin, for those whose mistake is not known.
    solution : str
        The worked solution: formula, values put in, result.
    reason : str, optional
        What there is to learn from it, shown once it is solved.
    """

    words: str
    answer: float | str
    dimension: str = ""
    tolerance: float = 0.01
    mistakes: tuple[Mistake, ...] = ()
    choices: Mapping[str, str] = field(default_factory=dict)
    start: str = ""
    solution: str
    reason: str = ""


class Verdict(NamedTuple):
    """The result of a check; `right` is None where there was nothing to check."""

    right: bool | None
    words: str


class Progress(NamedTuple):
    """How far someone is with a question: wrong and right answers, and the reply to the last."""

    tries: int = 0
    right: bool = False
    reply: str = ""

    @property
    def closed(self) -> bool:
        """Whether no answer counts any more: it is solved, or its solution has been shown."""
        return self.right or self.tries >= TRIES


_UNIT_PAIRS = {
    "force": "N or kN, kN or MN",
    "mass": "kg or t",
    "stiffness": "kN/m or MN/m",
    "energy": "J or kJ, kJ or MJ",
    "moment": "kN m or MN m",
    "length": "mm or m",
    "time": "ms or s",
    "pressure": "MPa or GPa",
}

_PUT_IN = "look at the units of what you put in."


def check(question: Question, given: str) -> Verdict:
    """Return whether an answer is right, with a reply.

    Parameters
    ----------
    question : Question
        The question.
    given : str
        The text typed or the choice made.
    """
    if not given.strip():
        return Verdict(None, "Give your answer first.")
    if isinstance(question.answer, str):
        if given == question.answer:
            return _right(question)
        if given in question.choices:
            return Verdict(False, question.choices[given])
        return Verdict(None, "That is not one of the choices.")
    try:
        found = readings(given, question.dimension)
    except InputError as error:
        return Verdict(None, f"{error}{'' if str(error).endswith('?') else '.'}")
    # Where a number can be read in two ways, the one that makes more sense was meant.
    ranked = [(*_judge(question, question.answer, reading.value), reading) for reading in found]
    _, verdict, reading = min(ranked, key=lambda judged: judged[0])
    return verdict._replace(words=f"{verdict.words} {reading.note}".strip())


def progress(question: Question, given: Sequence[str]) -> Progress:
    """Return how far someone is who gave these answers, in this order."""
    tries, right, reply = 0, False, ""
    for text in given:
        verdict = check(question, text)
        if verdict.right is None or Progress(tries, right).closed:
            continue
        tries, right, reply = tries + 1, verdict.right, verdict.words
    return Progress(tries, right, reply)


def _judge(question: Question, answer: float, value: float) -> tuple[int, Verdict]:
    """Return how well a value is understood, 0 where it is right, with the reply."""
    tolerance = question.tolerance
    if _close(value, answer, tolerance):
        return 0, _right(question)
    known = [mistake for mistake in question.mistakes if _close(value, mistake.value, tolerance)]
    if known:
        return 1, Verdict(False, min(known, key=lambda mistake: abs(mistake.value - value)).hint)
    if _close(-value, answer, tolerance):
        return 1, Verdict(False, "The size is right, the sign is not.")
    if _close(value, answer, _ROUNDED):
        return 1, Verdict(None, "Nearly: keep four figures on the way, and give three.")
    units = f"{pair}?" if (pair := _UNIT_PAIRS.get(question.dimension)) else _PUT_IN
    factors = {
        1e3: f"You are out by 1000: {units}",
        1e6: f"You are out by a million: {units}",
        10.0: "You are out by 10: look for a decimal point that slipped.",
    }
    for factor, words in factors.items():
        if _close(value, answer * factor, tolerance) or _close(value, answer / factor, tolerance):
            return 2, Verdict(False, words)
    return 3, Verdict(False, f"Not yet. {question.start}".strip())


def _right(question: Question) -> Verdict:
    return Verdict(True, f"Right. {question.reason}".strip())


def _close(value: float, right: float, tolerance: float) -> bool:
    return math.isclose(value, right, rel_tol=0.0, abs_tol=tolerance * abs(right))
