"""Every number of the mechanics and of the sheet says where it comes from.

Asked are the quantities, which are floats; whole numbers are counts, indices and exponents. A
quantity with a name, or the default of one, always answers; one within a function unless it is
arithmetic. It answers with one of ORIGINS: in its statement, in a comment behind it or in the
nearest one above it, no blank line between, or in the docstring of its function.
"""

import ast
import math
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "pierimpact"
FOLDERS = ("vehicle", "pier", "collision", "design", "files", "network", "report", "risk")
MODULES = sorted(path for folder in FOLDERS for path in (PACKAGE / folder).rglob("*.py"))

# What says where a number comes from, and how sure it is for that.
ORIGINS = {
    "Certainty.": "has its status with it",
    "source paper": "cited there",
    "as read in": "read in the source named",
    "second-hand": "not read in its source",
    "from memory": "not read in its source",
    "fitted by": "found by the study named",
    "from the study": "found by the study of the module",
    "this project's": "a choice or judgement that others may see differently",
    "illustrative": "a plausible round number",
    "derived here": "exact, by mathematics",
    "exactly": "exact, by definition",
    "numerical": "changes how accurate or fast a result is, not what it is",
}


def arithmetic(value: float) -> bool:
    """Whether it is a small whole number or quarter, a power of ten, per cent, or km/h in m/s."""
    small = value in range(13) or 4.0 * value in range(9) or value in (100.0, 3.6)
    decades = math.log10(value or 1.0)
    return small or (abs(decades) >= 3.0 and decades.is_integer())


def unanswered(source: str) -> Iterator[str]:
    """Yield the lines with a number that does not say where it comes from."""
    tree, lines = ast.parse(source), source.splitlines()
    parent = {child: node for node in ast.walk(tree) for child in ast.iter_child_nodes(node)}
    for number in ast.walk(tree):
        if not isinstance(number, ast.Constant) or not isinstance(number.value, float):
            continue
        places: list[ast.AST] = [number]
        while places[-1] in parent:
            places.append(parent[places[-1]])
        statement, *around = (place for place in places if isinstance(place, ast.stmt))
        functions = [place for place in (statement, *around) if isinstance(place, ast.FunctionDef)]
        named = statement in functions or not functions
        if number.value in (0.0, 1.0) or (arithmetic(number.value) and not named):
            continue
        body = getattr(statement, "body", None)  # the numbers in it answer for themselves
        end = body[0].lineno - 1 if body else statement.end_lineno
        said = " ".join(
            [
                *lines[statement.lineno - 1 : end],
                *comment_above(lines[: statement.lineno - 1]),
                *(ast.get_docstring(function) or "" for function in functions),
            ]
        )
        if not any(origin.lower() in said.lower() for origin in ORIGINS):
            yield lines[number.lineno - 1]


def comment_above(lines: list[str]) -> list[str]:
    """Return the last comment on lines of its own, after the last blank line."""
    found: list[str] = []
    for line in map(str.strip, reversed(lines)):
        if not line or (found and not line.startswith("#")):
            break
        if line.startswith("#"):
            found.insert(0, line.lstrip("#: "))
    return found


@pytest.mark.parametrize("module", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_every_number_says_where_it_comes_from(module):
    assert list(unanswered(module.read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize(
    "source",
    [
        "LIMIT = 0.3",
        "LIMIT = 2.0  # of the speed",
        "LIMITS = {'speed': (1.0, 30.0)}",
        "# This project's choice.\n\nLIMIT = 0.3",
        "FIRST = 0.2  # this project's choice\nSECOND = 0.3",
        "# This project's choice.\nFIRST = 0.2\n# Of the speed.\nSECOND = 0.3",
        "def force(x, ratio=0.5):\n    return ratio * x",
        "def force(x):\n    return 300e3 * x",
        "def force(x):\n    if x > 0.3:\n        return 0.0  # this project's choice",
        "class Pier:\n    ratio: float = 0.5",
    ],
)
def test_a_number_that_does_not_say_so_is_found(source):
    assert len(list(unanswered(source))) == 1


@pytest.mark.parametrize(
    "source",
    [
        "LIMIT = 0.3  # this project's choice",
        "# Numerical settings.\nFIRST = 0.2\nSECOND = 0.3  # of a step",
        "COUNT = 30",
        "LOWEST = 0.0",
        "def force(x):\n    '''Return the force, derived here.'''\n    return 0.9 * x",
        "def force(x):\n    return 0.5 * 1e6 * x / 3.6 - 100.0 * x",
        "def force():\n    return Sourced(300e3, Certainty.READ)",
    ],
)
def test_a_number_that_says_so_or_is_arithmetic_is_left_alone(source):
    assert list(unanswered(source)) == []
