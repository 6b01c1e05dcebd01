"""Answers as students type them: decimal commas, thousands in groups, units in any spelling."""

import math
import re
from typing import NamedTuple

from pierimpact.checks import InputError, brief, did_you_mean
from pierimpact.units import DIMENSIONS, parse


class Reading(NamedTuple):
    """One thing that an answer can mean, in SI units, and a word on how it was read."""

    value: float
    note: str = ""


_SPACES = dict.fromkeys(map(ord, "\u00a0\u2007\u2009\u202f"), " ")
_SIGNS = str.maketrans({"−": "-", "–": "-", "⋅": "·", "∙": "·", "•": "·"})
_POWERS = str.maketrans("⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹", "-+0123456789")
_NUMBER = re.compile(
    r"([-+]?)\s*(\d{1,3}(?:[ '’]\d{3})+(?!\d)(?:[.,]\d+)?|\d[\d.,]*|[.,]\d+)"
    r"(?:e([-+]?\d{1,3})|\s*[×x*·]\s*10\^?([-+]?\d{1,3}))?\s*(.*)",
    re.ASCII | re.IGNORECASE,
)
# A force beside a length without a sign between them, as in kNm.
_MOMENT = re.compile(r"\b([kMG]?N|kip|lbf)(mm|cm|m|ft|in)(?![A-Za-z])")


def readings(text: str, dimension: str) -> list[Reading]:
    """Return what an answer can mean, the likeliest first.

    Parameters
    ----------
    text : str
        What was typed, such as "1,11 MJ", "27 150 kN m" or "0.407".
    dimension : str
        Dimension of the answer, as in `pierimpact.units`; empty for a plain number.

    Raises
    ------
    InputError
        When it is no such quantity; the message is a sentence to the student.
    """
    clean = text.translate(_SPACES).translate(_SIGNS).strip()
    clean = re.sub("10([⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda power: f"10^{power[1].translate(_POWERS)}", clean)
    match = _NUMBER.fullmatch(clean)
    if match is None:
        kind = f"a number and a unit, such as {_example(dimension)}" if dimension else "a number"
        raise InputError(f"Type {kind}: {brief(text)} is not one")
    sign, digits, exponent, power, unit = match.groups()
    size = _size(unit, dimension)
    factor = math.copysign(size, -1.0 if sign == "-" else 1.0)
    scale = float(f"1e{exponent or power or 0}")
    found = [Reading(factor * value * scale, note) for value, note in _numbers(digits)]
    if not all(math.isfinite(reading.value) for reading in found):
        raise InputError(f"{brief(text)} is too large for a number")
    return found


def _example(dimension: str) -> str:
    return DIMENSIONS[dimension].units.split(",")[0]


def _size(unit: str, dimension: str) -> float:
    """Return the unit typed, in SI units, or say what is wrong with it."""
    if not dimension:
        if unit not in ("", "%"):
            raise InputError("The answer is a plain number, without a unit")
        return 0.01 if unit else 1.0
    if not unit:
        raise InputError(f"Add the unit, such as {_example(dimension)}")
    spelt = re.sub(r"(?<=[A-Za-z])[.-](?=[A-Za-z])", "*", _MOMENT.sub(r"\1*\2", unit))
    try:
        return parse("Your answer", f"1 {spelt}", dimension)
    except InputError as error:
        kinds = [kind for kind in DIMENSIONS if _is(spelt, kind)]
        if not kinds:
            known = DIMENSIONS[dimension].units
            meant = did_you_mean(unit, known.split(", "))
            raise InputError(
                f"{brief(unit)} is not a unit that is known here; try {known}{meant}"
            ) from error
        # Joules and newton metres have the same dimension, but not the same meaning.
        kind = "energy" if "energy" in kinds and "J" in unit else kinds[0]
        raise InputError(
            f"This is {DIMENSIONS[kind].words}; the answer is {DIMENSIONS[dimension].words}"
        ) from error


def _is(unit: str, dimension: str) -> bool:
    try:
        parse("", f"1 {unit}", dimension)
    except InputError:
        return False
    return True


def _numbers(digits: str) -> list[tuple[float, str]]:
    """Return what digits with commas and points can mean, the likeliest first."""
    digits = re.sub("[ '’]", "", digits)
    marks = re.sub(r"\d", "", digits)
    if not marks:
        return [(float(digits), "")]
    last = marks[-1]
    whole, _, decimals = digits.rpartition(last)
    if len(marks) > 1:  # one of them parts the thousands, in groups of three
        parts, decimals = (digits, "") if len(set(marks)) == 1 else (whole, decimals)
        if not re.fullmatch(rf"\d{{1,3}}(?:{re.escape(marks[0])}\d{{3}})+", parts):
            raise InputError(f"{digits!r} is not clear: leave out all commas and points but one")
        return [(float(f"{re.sub('[.,]', '', parts)}.{decimals}"), "")]
    value = float(f"{whole or 0}.{decimals or 0}")
    if last == "," and len(decimals) == 3 and re.fullmatch(r"[1-9]\d{0,2}", whole):
        doubt = f"“{digits}” was read as {{}}: write {whole}.{decimals} or {whole}{decimals}."
        either = (f"{whole}.{decimals}", f"{whole}{decimals}")
        return [(float(number), doubt.format(number)) for number in either]
    return [(value, "")]
