"""The rules that inputs must meet, and the one-line errors when they do not."""

import datetime
import math
import re
import unicodedata
from collections.abc import Collection, Iterable, Mapping
from difflib import get_close_matches
from operator import index
from typing import Any, SupportsFloat, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Categories of controls, halves of characters, and ends of lines and paragraphs.
_CONTROLS = ("Cc", "Cs", "Zl", "Zp")
# Byte order marks, which PDF/A forbids, and what turns the direction of the text after it.
_MARKS = "\ufeff\ufffe\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"


class InputError(ValueError):
    """A value breaks a rule; the message names the argument, the value and the rule.

    Examples
    --------
    >>> from pierimpact import EquivalentPier
    >>> EquivalentPier(mass=-1.0, stiffness=284e6)
    Traceback (most recent call last):
        ...
    pierimpact.checks.InputError: mass must be positive, got -1
    """


def _floats(values: object) -> NDArray[np.float64]:
    """Return values as floats; a TypeError where they are text, booleans or complex numbers."""
    array = np.asarray(values)
    if array.dtype.kind == "O":  # fractions, say, and whole numbers of many digits
        if any(isinstance(item, str | bytes | bool | np.bool_) for item in array.flat):
            raise TypeError
        array = np.array([float(item) for item in array.flat]).reshape(array.shape)
    if array.dtype.kind not in "iuf":
        raise TypeError
    return np.asarray(array, dtype=float)


def _float(name: str, value: SupportsFloat) -> float:
    if type(value) is float:  # nearly all are
        return value
    try:
        return float(_floats(value))
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} must be a number, got {brief(value)}") from None


def number(name: str, value: SupportsFloat) -> float:
    """Return `value` as a finite float."""
    result = _float(name, value)
    if not math.isfinite(result):
        raise InputError(f"{name} must be finite, got {result}")
    return result


def positive(name: str, value: SupportsFloat) -> float:
    """Return `value` as a finite float above zero."""
    result = number(name, value)
    if result <= 0.0:
        raise InputError(f"{name} must be positive, got {result:g}")
    return result


def positive_or_infinite(name: str, value: SupportsFloat) -> float:
    """Return `value` as a float above zero, which may be infinite."""
    result = _float(name, value)
    if not result > 0.0:
        raise InputError(f"{name} must be positive or infinite, got {result:g}")
    return result


def not_negative(name: str, value: SupportsFloat) -> float:
    """Return `value` as a finite float, zero or above."""
    result = number(name, value)
    if result < 0.0:
        raise InputError(f"{name} must not be negative, got {result:g}")
    return result


def told_from(value: float, limit: float) -> str:
    """Return a value with six figures, or all where six are those of a limit that it is not."""
    few = f"{value:g}"
    return repr(float(value)) if few == f"{limit:g}" and value != limit else few


def ratio(name: str, value: SupportsFloat) -> float:
    """Return `value` as a float from zero to below one."""
    result = number(name, value)
    if not 0.0 <= result < 1.0:
        raise InputError(f"{name} must lie from 0 to below 1, got {told_from(result, 1.0)}")
    return result


def whole(name: str, value: SupportsIndex, least: int, most: float = math.inf) -> int:
    """Return `value` as a whole number from `least` on, to `most`."""
    try:
        if isinstance(value, bool):
            raise TypeError
        result = index(value)
    except TypeError:
        raise InputError(f"{name} must be a whole number, got {brief(value)}") from None
    if result < least:
        raise InputError(f"{name} must be at least {least}, got {brief(result)}")
    if result > most:
        raise InputError(f"{name} must be at most {most}, got {brief(result)}")
    return result


def one_of(name: str, value: str, choices: tuple[str, ...]) -> str:
    """Return `value` if it is among `choices`."""
    if not (isinstance(value, str) and value in choices):
        raise InputError(f"{name} must be one of {', '.join(choices)}, got {brief(value)}")
    return value


def known(name: object, names: Collection[str], kind: str) -> None:
    """Refuse a name that is not among `names`; `kind` says what they are, as "a key of a file"."""
    if not isinstance(name, str) or name not in names:
        hint = did_you_mean(name, names) if isinstance(name, str) else ""
        raise InputError(f"{brief(name)} is not {kind}{hint}")


def did_you_mean(word: str, words: Iterable[str]) -> str:
    """Return a question that ends an error: whether the nearest of `words` was meant, if any is."""
    by_lower_case = {name.lower(): name for name in words}
    near = get_close_matches(word.lower(), by_lower_case, n=1)
    near = near or [name for name in by_lower_case if name.endswith(f"_{word.lower()}")]
    return f"; did you mean {by_lower_case[near[0]]}?" if near else ""


def brief(value: object, width: int = 60) -> str:
    """Return `value` as it would be typed, on one line and cut to `width` characters."""
    try:
        text = str(value) if isinstance(value, datetime.date) else repr(value)
    except ValueError:  # Python prints no whole number of more digits than a few thousand
        text = "a number of thousands of digits"
    return shortened(text, width)


def shortened(text: str, width: int) -> str:
    """Return a text on one line, cut to `width` characters."""
    text = " ".join(text[: 2 * width].split())
    return text if len(text) <= width else text[: width - 1] + "…"


def one_line(name: str, value: str) -> str:
    """Return `value` if it is one line of text that prints, whatever stands beside it."""
    if any(unicodedata.category(letter) in _CONTROLS or letter in _MARKS for letter in value):
        raise InputError(f"{name} must be one line without control characters, got {brief(value)}")
    return value


def no_formula(text: str) -> str:
    """Return text with an apostrophe before what a spreadsheet would take for a formula.

    That is at the start, and after a semicolon, where many a spreadsheet starts a field.
    """
    return re.sub(r"(^|;)(\s*[=+\-@＝＋－＠])", r"\1'\2", text)


def positive_array(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return `values` as an array of finite numbers above zero, of any shape."""
    array = finite_array(name, values)
    _refuse(name, array, array <= 0.0, "be positive")
    return array


def positive_or_infinite_array(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return `values` as an array of numbers above zero or infinite, of any shape."""
    array = _array(name, values)
    _refuse(name, array, ~(array > 0.0), "be positive or infinite")
    return array


def ratio_array(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return `values` as an array of numbers from zero to below one, of any shape."""
    array = finite_array(name, values)
    _refuse(name, array, (array < 0.0) | (array >= 1.0), "lie from 0 to below 1")
    return array


def ascending_array(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return `values` as an array of finite numbers in one row, each above the one before it."""
    array = one_row(name, finite_array(name, values))
    _refuse(name, array, np.diff(array, prepend=-np.inf) <= 0.0, "ascend")
    return array


def one_row(name: str, array: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return `array` if it has one dimension."""
    if array.ndim != 1:
        raise InputError(f"{name} must be in one row, got shape {array.shape}")
    return array


def broadcast(arrays: Mapping[str, NDArray[Any]]) -> tuple[NDArray[Any], ...]:
    """Return the arrays, by name, in the one shape to which they broadcast."""
    try:
        return np.broadcast_arrays(*arrays.values())
    except ValueError:
        listed = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise InputError(f"shapes must broadcast against each other, got {listed}") from None


def _array(name: str, values: ArrayLike) -> NDArray[np.float64]:
    try:
        return _floats(values)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} must be an array of numbers, got {brief(values)}") from None


def finite_array(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return `values` as an array of finite numbers, of any shape."""
    array = _array(name, values)
    _refuse(name, array, ~np.isfinite(array), "be finite")
    return array


def _refuse(name: str, array: NDArray[np.float64], bad: NDArray[np.bool_], rule: str) -> None:
    if np.any(bad):
        place = tuple(int(i) for i in np.argwhere(bad)[0])
        where = f" at index {place[0] if len(place) == 1 else place}" if place else ""
        raise InputError(f"{name} must {rule}, got {array[place]:g}{where}")
