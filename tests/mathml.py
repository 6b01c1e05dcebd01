"""Reads formulas off a page: MathML to tokens, and tokens to numbers."""

import math
import re
import subprocess
from xml.etree import ElementTree

from pypandoc import get_pandoc_path

from pierimpact.units import _unit

NAMESPACE = "{http://www.w3.org/1998/Math/MathML}"
WORDS = {
    "sin": "math.sin",
    "cos": "math.cos",
    "tan": "math.tan",
    "arctan": "math.atan",
    "atan2": "math.atan2",
    "max": "max",
    "min": "min",
    "mod": "%",
    "π": "math.pi",
}
SIGNS = {"−": "-", "×": "*", "[": "(", "]": ")", "⌊": "math.floor(", "⌋": ")", "\u2061": ""}
OPERATORS = {"+", "-", "*", "/", "%", "(", ")", ",", "=", "**", ""}
NUMBER = re.compile(r"\d+(\.\d+)?")


def converted(formulas):
    """Return LaTeX formulas as MathML, by one call of pandoc."""
    done = subprocess.run(
        [get_pandoc_path(), "--from=markdown", "--to=html5", "--mathml", "--fail-if-warnings"],
        input="\n\n".join(f"$${formula}$$" for formula in formulas),
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    page = re.sub(r"<annotation.*?</annotation>", "", done.stdout, flags=re.DOTALL)
    return re.findall(r"<math.*?</math>", page, re.DOTALL)


def tokens(element):
    """Return what an element of MathML says, token by token; a symbol is one token."""
    tag, children = element.tag.removeprefix(NAMESPACE), list(element)
    if tag in ("math", "semantics", "mrow", "mtd", "mstyle"):
        return [token for child in children for token in tokens(child)]
    if tag == "mfrac":
        above, below = map(tokens, children)
        return ["(", "(", *above, ")", "/", "(", *below, ")", ")"]
    if tag == "msqrt":
        return ["math.sqrt", "(", *(token for child in children for token in tokens(child)), ")"]
    if tag == "msup":
        base, power = map(tokens, children)
        of = children[0].tag.removeprefix(NAMESPACE)
        assert of not in ("mfrac", "msup") or power == ["′"], "a power wants brackets"
        if power == ["′"]:
            return ["".join(base) + "′"]
        if base == ["e"]:
            return ["math.exp", "(", *power, ")"]
        return [*base, "**", "(", *power, ")"]
    if tag in ("msub", "munder", "mover"):
        return ["_".join("".join(tokens(child)) for child in children)]
    if tag == "msubsup":
        base, below, power = ("".join(tokens(child)) for child in children)
        if power == "′":
            return [f"{base}_{below}′"]
        if base == "∫":
            return [f"∫_{below}^{power}"]
        return [f"{base}_{below}", "**", "(", power, ")"]
    text = (element.text or "").strip()
    if tag == "mtext":
        return [f"unit:{text}"]
    if tag == "mspace":
        return [" "] if element.get("width") == "0.167em" else []
    text = SIGNS.get(text, WORDS.get(text, text))
    return ["math.floor", "("] if text == "math.floor(" else [text] if text else []


def joined(words):
    """Return tokens with the thousands of numbers joined, and without spaces."""
    done = []
    for index, word in enumerate(words):
        if word == " ":
            continue
        after_space = index >= 2 and words[index - 1] == " "
        if after_space and re.fullmatch(r"\d{3}", word) and done and re.fullmatch(r"\d+", done[-1]):
            done[-1] += word
        else:
            done.append(word)
    return done


def rows(xml):
    """Return left-hand side and the right-hand sides between equals signs of a formula."""
    root = ElementTree.fromstring(xml)
    table = root.find(f".//{NAMESPACE}mtr")
    if table is None:
        found = joined(tokens(root))
    else:
        found = [word for row in root.iter(f"{NAMESPACE}mtr") for word in _row(row)]
    sides, depth = [[]], 0
    for word in found:
        depth += (word == "(") - (word == ")")
        if word == "=" and depth == 0:
            sides.append([])
        else:
            sides[-1].append(word)
    return sides


def _row(row):
    return [word for cell in row.iter(f"{NAMESPACE}mtd") for word in joined(tokens(cell))]


def with_symbols(words, symbols):
    """Return tokens with every run that is a known symbol made one token, the longest first."""
    by_length = sorted(symbols, key=len, reverse=True)
    done, index = [], 0
    while index < len(words):
        for symbol in by_length:
            if tuple(words[index : index + len(symbol)]) == symbol:
                done.append(symbol)
                index += len(symbol)
                break
        else:
            done.append(words[index])
            index += 1
    return done


def half_unit(text):
    """Return half a unit in the last place of a printed number; short numbers are exact."""
    figures = text.replace(".", "").lstrip("0")
    if len(figures) < 4:
        return 0.0
    decimals = len(text.partition(".")[2])
    return 0.5 * 10.0 ** (-decimals if decimals else max(len(figures) - 5, 0))


def evaluate(words, symbols):
    """Return the value of an expression, and how far the rounding of its numbers can move it.

    Parameters
    ----------
    words : list of str
        Tokens.
    symbols : dict of tuple to (float, float)
        Value and half a unit in the last place by symbol, which is a run of tokens.
    """
    words = with_symbols(words, symbols)
    pieces, operands = [], []
    for index, word in enumerate(words):
        previous = words[index - 1] if index else "("
        if isinstance(word, tuple):
            number, half, operand = *symbols[word], True
        elif NUMBER.fullmatch(word):
            number, half, operand = float(word), half_unit(word), True
        elif word.startswith("unit:"):
            pieces.append(f"*{size(word[5:])!r}")
            continue
        else:
            operand = word.startswith("math.") or word in ("max", "min", "(")
            if not operand and word not in OPERATORS:
                raise LookupError(f"{word} in {words}")
        if operand and _ends_operand(previous):
            pieces.append("*")
        if operand and (isinstance(word, tuple) or NUMBER.fullmatch(str(word))):
            power = re.fullmatch(r"\d+", str(word)) and len(pieces) > 1 and pieces[-2] == "*10**"
            pieces.append(f"(v[{len(operands)}])")
            operands.append((number, 0.0 if power else half))
        else:
            pieces.append(word)
    code = compile("".join(pieces), "formula", "eval")

    def value(numbers):
        return eval(code, {"math": math, "max": max, "min": min, "v": numbers})

    numbers = [number for number, _ in operands]
    result = value(numbers)
    moved = 0.0
    for index, (number, half) in enumerate(operands):
        if half:
            changed = [*numbers[:index], number + half, *numbers[index + 1 :]]
            moved += abs(value(changed) - result)
    return result, moved


def _ends_operand(word):
    if isinstance(word, tuple):
        return True
    return bool(NUMBER.fullmatch(word)) or word in (")", "math.pi") or word.startswith("unit:")


def size(unit):
    """Return the size of a printed unit in SI units."""
    if unit in ("", "rad", "rad/s", "1/s"):
        return 1.0
    found = _unit(unit)
    assert found is not None, unit
    return float(found[0])
