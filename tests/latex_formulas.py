"""Evaluates the LaTeX formulas of the design procedure, knowing nothing of what they mean."""

import math
import re

FUNCTIONS = {
    "atan2": math.atan2,
    "arctan": math.atan,
    "cos": math.cos,
    "sin": math.sin,
    "exp": math.exp,
    "floor": math.floor,
    "max": max,
    "min": min,
    "sqrt": math.sqrt,
    "pi": math.pi,
}


def evaluate(formula, values):
    """Return the value of a formula with names in angle brackets."""
    text = formula.replace("<x>", "*")
    text = re.sub(r"<(\w+)>", lambda name: f"({values[name[1]]!r})", text)
    return eval(as_python(text), {"__builtins__": {}}, FUNCTIONS)


def as_python(text):
    """Return LaTeX as a Python expression."""
    text = re.sub(r"\\(left|right)(?![a-z])", "", text)
    text = text.replace("[", "(").replace("]", ")")
    text = text.replace(r"\lfloor", "floor(").replace(r"\rfloor", ")")
    text = text.replace(r"\operatorname{atan2}", "atan2").replace(r"\bmod", "%")
    text = re.sub(r"(\d) \\pi", r"\1*\\pi", text)
    text = re.sub(r"\\(max|min|cos|sin|arctan|pi)(?![a-z])", r"\1", text)
    done = ""
    while (match := re.search(r"\\frac|\\sqrt|e\^(?=\{)|\^", text)) is not None:
        done += text[: match.start()]
        rest = text[match.end() :]
        if match[0] == r"\frac":
            above, rest = group(rest)
            below, text = group(rest)
            text = f"(({above})/({below})){text}"
        elif match[0] == "^":
            power, text = group(rest) if rest.startswith("{") else (rest[0], rest[1:])
            text = f"**({power}){text}"
        else:
            inner, text = group(rest)
            text = f"{'exp' if match[0].startswith('e') else 'sqrt'}({inner}){text}"
    return done + text


def group(text):
    """Return what is in the braces that a text begins with, and what comes after them."""
    assert text.startswith("{"), text
    depth = 0
    for place, character in enumerate(text):
        depth += (character == "{") - (character == "}")
        if depth == 0:
            return text[1:place], text[place + 1 :]
    raise ValueError(f"braces do not close in {text}")
