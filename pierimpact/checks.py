"""The rules that inputs must meet, and the one-line errors when they do not."""

import math
from typing import SupportsFloat


class InputError(ValueError):
    """A value breaks a rule; the message names the argument, the value and the rule."""


def number(name: str, value: SupportsFloat) -> float:
    """Return `value` as a finite float."""
    try:
        result = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{name} must be a number, got {value!r}") from None
    if not math.isfinite(result):
        raise InputError(f"{name} must be finite, got {result}")
    return result


def positive(name: str, value: SupportsFloat) -> float:
    """Return `value` as a finite float above zero."""
    result = number(name, value)
    if result <= 0.0:
        raise InputError(f"{name} must be positive, got {result:g}")
    return result


def not_negative(name: str, value: SupportsFloat) -> float:
    """Return `value` as a finite float, zero or above."""
    result = number(name, value)
    if result < 0.0:
        raise InputError(f"{name} must not be negative, got {result:g}")
    return result


def one_of(name: str, value: str, choices: tuple[str, ...]) -> str:
    """Return `value` if it is among `choices`."""
    if value not in choices:
        raise InputError(f"{name} must be one of {', '.join(choices)}, got {value!r}")
    return value
