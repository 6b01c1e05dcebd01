"""Steps of a calculation as numbered equations: symbol = equation = values put in = result."""

import re
from collections.abc import Mapping, Sequence

from pierimpact.handcalc import Step
from pierimpact.report.document.markup import in_tex, inline, number_in_tex, tex_length
from pierimpact.report.document.numbered import CONTINUED, Equation
from pierimpact.symbols import SYMBOLS
from pierimpact.units import CONSISTENT, Printed, printed

_LONG = 75  # characters on a line
_LINE = 58  # characters of formula, values and result where they stand on one line
_IN_SYMBOLS = {name: symbol.latex for name, symbol in SYMBOLS.items()}


class StepWriter:
    """Writes the steps of a calculation with the values of one case.

    Parameters
    ----------
    values : mapping of str to float
        Values by the names of their symbols [SI].
    system : {"SI", "US"}
        Units to print in.
    given : sequence of str
        Names of inputs, which print without zeros that nobody typed.
    units : bool, optional
        Whether the values put in carry their units; if not, they are in units that go together.
    consistent : bool, optional
        Whether forces, masses, lengths and times are in units in which a force is a mass times an
        acceleration.
    quantities : mapping of str to str, optional
        Kinds of quantity to print in, for names where it is not that of the table of symbols.
    """

    def __init__(
        self,
        values: Mapping[str, float],
        system: str,
        given: Sequence[str] = (),
        *,
        units: bool = True,
        consistent: bool = False,
        quantities: Mapping[str, str] | None = None,
    ) -> None:
        self.values, self.system, self.given = values, system, given
        self.units, self.consistent, self.quantities = units, consistent, quantities or {}

    def shown(self, name: str) -> Printed:
        """Return a value as it prints."""
        quantity = self.quantities.get(name, SYMBOLS[name].quantity)
        quantity = CONSISTENT.get(quantity, quantity) if self.consistent else quantity
        return printed(self.values[name], quantity, self.system, given=name in self.given)

    def equation(self, step: Step) -> Equation:
        """Return a step as a numbered equation, its remark and conditions beside it."""
        symbol, formula = SYMBOLS[step.name], in_symbols(step)
        put_in = {
            name: in_tex(self.shown(name)) if self.units else number_in_tex(self.shown(name))
            for name in step.names
        }
        result = in_tex(self.shown(step.name))
        if not put_in:
            lines = [formula]
        elif formula in _IN_SYMBOLS.values():  # the value put in is the result
            lines = [f"{formula} = {result}"]
        else:
            *values, last = _broken(step.latex(put_in, r"\times"))
            fits = tex_length(last) + tex_length(result) < _LONG
            lines = [*values, f"{last} = {result}"] if fits else [*values, last, result]
            if re.sub(r"\\,| ", "", formula) != symbol.latex.replace(" ", ""):
                lines = [*_broken(formula), *lines]
            whole = " = ".join(lines)
            if not any(line.startswith(CONTINUED) for line in lines) and tex_length(whole) < _LINE:
                lines = [whole]
        because = " and ".join(_in_words(c.latex(_IN_SYMBOLS)) for c in step.conditions)
        remarks = [step.remark, because and f"as {because}"]
        return Equation(
            label=f"eq-{step.name}",
            name=inline(symbol.heading),
            symbol=symbol.latex,
            lines=lines,
            source=inline("; ".join(filter(None, remarks))),
        )


def in_symbols(step: Step) -> str:
    """Return the equation of a step in symbols."""
    return step.latex(_IN_SYMBOLS)


def _in_words(condition: str) -> str:
    """Return a condition as a formula of a line of text or, where it is all words, as those."""
    words = re.sub(r"\\text\{([^{}]*)\}", r"\1", condition)
    return f"${condition}$" if re.search(r"[\\=<>]", words) else words


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
