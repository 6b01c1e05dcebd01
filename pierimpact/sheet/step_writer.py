r"""Calculation steps from formulas: symbol = formula = formula with values = result.

A formula is LaTeX with names in angle brackets: `\frac{1}{<X>}` prints once with their symbols
and once with their values. A product of them is written with `<x>`, a cross between values only.
"""

import re
from collections.abc import Mapping
from typing import NamedTuple

from pierimpact.sheet.blocks import Equation
from pierimpact.sheet.markup import in_tex, number_in_tex
from pierimpact.units import printed

_LONG = 90  # LaTeX with values of more characters than this leaves no room for the result


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
    """

    def __init__(self, values: Mapping[str, Value], system: str) -> None:
        self.values, self.system = values, system

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
        values, shown = self._with_values(formula, units), self._in_tex(result, units=True)
        lines = [values, shown] if len(values) > _LONG else [f"{values} = {shown}"]
        if formula_in_symbols == formula:  # nothing to put in
            lines = [formula]
        elif re.sub(r"\\,| ", "", formula_in_symbols) != symbol.replace(" ", ""):
            lines.insert(0, formula_in_symbols)
        return Equation(label=f"eq-{result}", name=name, symbol=symbol, lines=lines, source=source)

    def _with_symbols(self, formula: str) -> str:
        formula = formula.replace("<x>", r"\,")
        return re.sub(r"<(\w+)>", lambda name: self.values[name[1]].symbol, formula)

    def _with_values(self, formula: str, units: bool) -> str:
        def value(match: re.Match[str]) -> str:
            text, power = self._in_tex(match[1], units=units), match[2]
            grouped = power and (units or "times" in text)
            return f"({text}){power}" if grouped else text + power

        return re.sub(r"<(\w+)>(\^?)", value, formula.replace("<x>", r"\times"))

    def _in_tex(self, name: str, *, units: bool) -> str:
        _, value, quantity, given = self.values[name]
        shown = printed(value, quantity, self.system, given=given)
        if units:
            return in_tex(shown)
        text = number_in_tex(shown)
        return f"({text})" if text.startswith("-") else text
