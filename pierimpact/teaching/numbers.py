"""A student's own numbers: the same for the same name on every machine."""

import unicodedata
from random import Random
from typing import TypeVar

Value = TypeVar("Value")


def same_name(name: str) -> str:
    """Return a name or number as it is compared: without capitals and needless spaces."""
    return " ".join(unicodedata.normalize("NFKC", name).casefold().split())


class Numbers:
    """The numbers of one question, drawn for one student.

    Parameters
    ----------
    name : str
        Name or number of the student.
    question : str
        Which question they are for.
    """

    def __init__(self, name: str, question: str) -> None:
        # Seeded by a text, and drawn by `random` alone: both keep their promise in every version.
        self._random = Random(f"{same_name(name)}/{question}")

    def one_of(self, *values: Value) -> Value:
        """Return one of some values."""
        return values[int(self._random.random() * len(values))]

    def between(self, low: int, high: int, step: int = 1) -> int:
        """Return a whole number from `low` to `high` in steps."""
        found: int = self.one_of(*range(low, high + 1, step))
        return found
