"""Formulas in LaTeX in lines of a width, for readers of Word files, of which some break none.

A line is broken before the signs between its terms, at first outside of all brackets. Of a root or
a fraction that is too long a power or a quotient of brackets is made, which can be broken.
"""

import re

_OPENING = {"(", "[", r"\lfloor"}
_CLOSING = {")": "(", "]": "[", r"\rfloor": r"\lfloor"}
_MARK = re.compile(r"(?:\\left|\\right)?(?:[()\[\]]|\\[lr]floor)|[{}]| (?:[=+-]|\\times(?! 10\^)) ")
# Signs before which a line is broken, and in how many brackets at most: the first that occur.
_WAYS = ((("=",), 0), *((s, most) for most in range(4) for s in (("+", "-"), (r"\times",))))
# What is multiplied with what stands before it.
_FACTOR = re.compile(r"\s*(?!\\(?:right|times|text|q?quad)\b)[^\s=+\-)\]},]")
_ATOM = re.compile(r"\\[a-zA-Z]+|\\.|.", re.DOTALL)
_NO_WIDTH = {r"\left", r"\right", r"\dot", r"\ddot", r"\bar", r"\hat", "{", "}", " "}
_WORDS = {r"\sin", r"\cos", r"\tan", r"\arctan", r"\max", r"\min", r"\bmod"}
# Widths by eye, this project's choice: of what is raised or lowered, and of a small space.
_RAISED, _SPACE = 0.7, 0.3


def formula_width(formula: str) -> float:
    """Return about how many figures wide a formula is."""
    width, place = 0.0, 0
    while atom := _ATOM.match(formula, place):
        name, place = atom[0], atom.end()
        if name == r"\frac":
            end = _group_end(formula, place)
            sides = formula[place:end], formula[end : _group_end(formula, end)]
            width += max(map(formula_width, sides))
            place = end + len(sides[1])
        elif name in ("^", "_"):
            end = _group_end(formula, place)
            width += _RAISED * formula_width(formula[place:end])
            place = end
        elif name in (r"\text", r"\mathrm", r"\operatorname"):
            end = _group_end(formula, place)
            width += end - place - 2
            place = end
        elif name not in _NO_WIDTH:
            width += len(name) - 1 if name in _WORDS else _SPACE if name in (r"\,", r"\ ") else 1.0
    return width


def broken(formula: str, room: int) -> list[str]:
    """Return a formula in lines of at most so many figures, where it can be broken so often."""
    if formula_width(formula) <= room:
        return [formula]
    for signs, most in _WAYS:
        parts = _parted(formula, signs, most)
        if len(parts) > 1:
            lines = [piece for line in _joined(parts, room) for piece in broken(line, room)]
            return _joined(lines, room, apart="=")
    unfolded = _unfolded(formula)
    return [formula] if unfolded == formula else broken(unfolded, room)


def _joined(parts: list[str], room: int, apart: str = " ") -> list[str]:
    """Return parts joined as far as there is room; but after the first, none that begins so."""
    lines = parts[:1]
    for number, part in enumerate(parts[1:]):
        fits = formula_width(f"{lines[-1]} {part}") <= room
        if fits and not (number and part.startswith(apart)):
            lines[-1] += f" {part}"
        else:
            lines.append(part)
    return lines


def _parted(formula: str, signs: tuple[str, ...], most: int) -> list[str]:
    """Return a formula in parts that begin with one of the signs, but for the first."""
    parts, place, braces, brackets = [""], 0, 0, 0
    for mark in _MARK.finditer(formula):
        parts[-1] += formula[place : mark.start()]
        place, sign = mark.end(), mark[0].strip()
        shape = re.sub(r"\\left|\\right", "", sign)
        braces += (sign == "{") - (sign == "}")
        brackets += (shape in _OPENING) - (shape in _CLOSING)
        if sign in signs and braces == 0 and brackets <= most and parts[-1].strip():
            parts.append(f"{sign} ")
        else:
            parts[-1] += mark[0]
    parts[-1] += formula[place:]
    return parts


def _unfolded(formula: str) -> str:
    """Return a formula with the widest of its roots and fractions as brackets on one line."""
    found: list[tuple[float, int, int, str]] = []  # width, start, end and what stands in its place
    depth = 0
    for mark in re.finditer(r"\\(sqrt|frac)(?=\{)|[{}]", formula):
        if mark[1] and depth == 0:
            end = _group_end(formula, mark.end())
            inner = formula[mark.end() + 1 : end - 1]
            if mark[1] == "sqrt":
                instead = rf"\left[{inner}\right]^{{1/2}}"
            else:
                start, end = end, _group_end(formula, end)
                instead = f"{_bracketed(inner)} / {_bracketed(formula[start + 1 : end - 1])}"
                if _FACTOR.match(formula, end):
                    instead = rf"\left({instead}\right)"
            width = formula_width(formula[mark.start() : end])
            found.append((width, mark.start(), end, instead))
        depth += (mark[0] == "{") - (mark[0] == "}")
    if not found:
        return formula
    _, start, end, instead = max(found)
    return formula[:start] + instead + formula[end:]


def _group_end(formula: str, start: int) -> int:
    """Return where the group ends that begins at `start`: in braces, or one sign."""
    if not formula.startswith("{", start):
        name = _ATOM.match(formula, start)
        end = name.end() if name else start
        takes_group = name and name[0] in (r"\mathrm", r"\text", r"\dot", r"\bar")
        return _group_end(formula, end) if takes_group else end
    depth = 0
    for brace in re.compile("[{}]").finditer(formula, start):
        depth += 1 if brace[0] == "{" else -1
        if depth == 0:
            return brace.end()
    return len(formula)


def _bracketed(formula: str) -> str:
    return rf"\left({formula}\right)" if " " in formula else formula


def unpaired_as_text(formula: str) -> str:
    """Return a line of a formula with the brackets as text whose other is on another line.

    As brackets, some readers of Word files refuse them, and leave out what is beside them.
    """
    opened: list[re.Match[str]] = []
    alone: list[re.Match[str]] = []
    for bracket in re.finditer(r"(?:\\left|\\right)?(?:[()\[\]]|\\[lr]floor)", formula):
        shape = re.sub(r"\\left|\\right", "", bracket[0])
        if shape in _OPENING:
            opened.append(bracket)
        elif opened and opened[-1][0].endswith(_CLOSING[shape]):
            opened.pop()
        else:
            alone.append(bracket)
    for bracket in sorted(opened + alone, key=lambda each: each.start(), reverse=True):
        shape = re.sub(r"\\left|\\right", "", bracket[0])
        text = {r"\lfloor": "⌊", r"\rfloor": "⌋"}.get(shape, shape)
        formula = rf"{formula[: bracket.start()]}\text{{{text}}}{formula[bracket.end() :]}"
    return formula
