r"""Calculation steps from formulas: symbol = formula = formula with values = result.

A formula is LaTeX with names in angle brackets: `\frac{1}{<X>}` prints once with their symbols
and once with their values. A product of them is written with `<x>`, a cross between values only.
"""

import re
from collections.abc import Mapping
from typing import NamedTuple

from pierimpact.report.document.markup import in_tex, inline, number_in_tex, tex_length
from pierimpact.report.document.numbered import CONTINUED, Equation
from pierimpact.units import printed

_LONG = 75  # characters on a line


class Value(NamedTuple):
    """A value as steps print it."""

    symbol: str  #: in LaTeX
    value: float  #: in SI units
    quantity: str  #: its kind
    given: bool = False  #: whether it is an input, and prints without zeros that nobody typed


class StepWriter:
    """Writes steps from formulas and values.

    Parameters
    ----------
    values : mapping of str to Value
        Values by the names that formulas call them.
    system : {"SI", "US"}
        Units to print in.
    prefix : str, optional
        What the anchors of the steps begin with.
    """

    def __init__(self, values: Mapping[str, Value], system: str, prefix: str = "eq-") -> None:
        self.values, self.system, self.prefix = values, system, prefix

    def step(
        self, name: str, result: str, formula: str, *, units: bool = True, source: str = ""
    ) -> Equation:
        """Return the step that gives the value called `result`.

        Parameters
        ----------
        name : str
            What is calculated.
        result : str
            Name of the value.
        formula : str
            Formula with names in angle brackets.
        units : bool, optional
            Whether the values put in carry their units; if not, they are in the units of length
            and force of the results.
        source : str, optional
            Where the formula is from.
        """
        symbol, formula_in_symbols = self.values[result].symbol, self._with_symbols(formula)
        *values, last = _broken(self._with_values(formula, units))
        shown = self._in_tex(result, units=True)
        fits = tex_length(last) + tex_length(shown) < _LONG
        lines = [*values, f"{last} = {shown}"] if fits else [*values, last, shown]
        if formula_in_symbols == formula:  # nothing to put in
            lines = [formula]
        elif re.fullmatch(r"<\w+>", formula):  # the value put in is the result
            lines = [f"{formula_in_symbols} = {shown}"]
        elif re.sub(r"\\,| ", "", formula_in_symbols) != symbol.replace(" ", ""):
            lines = [*_broken(formula_in_symbols), *lines]
        label = f"{self.prefix}{result}"
        return Equation(label=label, name=inline(name), symbol=symbol, lines=lines, source=source)

    def _with_symbols(self, formula: str) -> str:
        formula = formula.replace("<x>", r"\,")
        return re.sub(r"<(\w+)>", lambda name: self.values[name[1]].symbol, formula)

    def _with_values(self, formula: str, units: bool) -> str:
        def value(match: re.Match[str]) -> str:
            text, power = self._in_tex(match[2], units=units), match[3]
            grouped = (power and (units or "times" in text)) or (match[1] and "times" in text)
            grouped = grouped and not text.startswith("(")
            before = match[1] or ""
            return f"{before}({text}){power}" if grouped else before + text + power

        return re.sub(r"(/ )?<(\w+)>(\^?)", value, formula.replace("<x>", r"\times"))

    def _in_tex(self, name: str, *, units: bool) -> str:
        _, value, quantity, given = self.values[name]
        shown = printed(value, quantity, self.system, given=given)
        if units:
            return in_tex(shown)
        text = number_in_tex(shown)
        return f"({text})" if text.startswith("-") else text


def _broken(formula: str) -> list[str]:
    """Return a formula in lines that fit, broken before signs between large terms."""
    if tex_length(formula) <= _LONG:
        return [formula]
    terms, depth = [""], 0
    for piece in re.split(r"( [+-] |\\left[(\[]|\\right[)\]]|[{}()])", formula):
        depth += (piece in ("{", "(")) - (piece in ("}", ")"))
        if depth == 0 and piece in (" + ", " - "):
            terms.append(piece.strip() + " ")
        else:  # a bracket that is closed on another line cannot be as tall as what is in it
            terms[-1] += re.sub(r"\\(left|right)", "", piece)
    lines = terms[:1]
    for term in terms[1:]:
        if tex_length(lines[-1]) + tex_length(term) <= _LONG:
            lines[-1] += f" {term}"
        else:
            lines.append(rf"{CONTINUED} {term}")
    return lines
