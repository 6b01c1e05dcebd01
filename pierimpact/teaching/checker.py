"""The checker of exercises: right within a tolerance, or a hint that does not give it away."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from pierimpact.checks import InputError, brief
from pierimpact.units import parse


class Trap(NamedTuple):
    """A likely wrong answer, computed, and the hint for it."""

    value: Callable[[], float]
    hint: str


@dataclass(frozen=True, kw_only=True)
class Question:
    """A question whose answer is computed when it is checked.

    Parameters
    ----------
    words : str
        The question, in plain text.
    answer : callable
        Returns the answer in SI units, or the right one of `choices`.
    dimension : str, optional
        Dimension of the answer, as in `pierimpact.units`; empty for a plain number.
    tolerance : float, optional
        Largest relative error that counts as right [-].
    traps : tuple of Trap, optional
        Likely wrong answers.
    choices : tuple of str, optional
        The answers to choose from.
    reason : str, optional
        An explanation, shown once it is solved.
    """

    words: str
    answer: Callable[[], float | str]
    dimension: str = ""
    tolerance: float = 0.02
    traps: tuple[Trap, ...] = ()
    choices: tuple[str, ...] = ()
    reason: str = ""


class Verdict(NamedTuple):
    """The result of a check; `right` is None where there was nothing to check."""

    right: bool | None
    words: str


#: Factors by which answers are often wrong, with a hint for each.
_FACTORS = (
    (1e3, "You are out by 1000: {unit}?"),
    (1e6, "You are out by a million: {unit}?"),
    (3.6, "You are out by 3.6: km/h or m/s?"),
    (3.6**2, "You are out by 3.6²: was the speed that you squared in m/s?"),
    (9.9, "You are out by about 10: a slipped decimal point, or a mass for a weight?"),
    (2.0 * math.pi, "You are out by 2π: circular frequency ω or frequency f?"),
    (2.0, "You are out by 2: look for a missing or an extra factor ½."),
    (4.0, "You are out by 4: is something squared, or not, that should be?"),
)
_UNIT_PAIRS = {
    "force": "N or kN",
    "mass": "kg or t",
    "stiffness": "kN/m or MN/m",
    "energy": "J or kJ",
    "length": "mm or m",
    "time": "ms or s",
    "pressure": "MPa or GPa",
}


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
        return Verdict(None, "Type your answer first.")
    answer = question.answer()
    if isinstance(answer, str):
        if given == answer:
            return Verdict(True, f"Right. {question.reason}".strip())
        return Verdict(False, "Not that one. Try it in the explorer above.")
    try:
        value = _value(question, given)
    except InputError as error:
        return Verdict(None, f"{error}.")
    if _close(value, answer, question.tolerance):
        return Verdict(True, f"Right. {question.reason}".strip())
    return Verdict(False, _hint(question, value, answer))


def _value(question: Question, given: str) -> float:
    if question.dimension:
        return parse("Your answer", given.strip(), question.dimension)
    try:
        value = float(given)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"Your answer must be a number without a unit, got {brief(given)}")
    return value


def _hint(question: Question, value: float, answer: float) -> str:
    for trap in question.traps:
        if _close(value, trap.value(), question.tolerance):
            return trap.hint
    if _close(-value, answer, question.tolerance):
        return "The size is right, the sign is not."
    units = _UNIT_PAIRS.get(question.dimension, "which unit")
    for factor, words in _FACTORS:
        for wrong in (answer * factor, answer / factor):
            if _close(value, wrong, question.tolerance):
                return words.format(unit=units)
    if value > 0.0 and abs(math.log(value / answer)) < 0.1:
        return "Close, but not close enough: did you round on the way?"
    return f"Not yet: your answer is too {'small' if value < answer else 'large'}."


def _close(value: float, right: float, tolerance: float) -> bool:
    return abs(value - right) <= tolerance * abs(right)
