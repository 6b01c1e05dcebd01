"""Expressions of Python in LaTeX, with brackets only where they are needed."""

import ast
import re
from collections.abc import Mapping, Sequence

#: Functions that print; those with two holes take two arguments, the others a list of them.
CALLS = {
    "abs": r"\left|%s\right|",
    "arctan": r"\arctan(%s)",
    "arctan2": r"\operatorname{atan2}(%s)",
    "cos": r"\cos(%s)",
    "exp": r"\mathrm{e}^{%s}",
    "floor": r"\left\lfloor %s \right\rfloor",
    "hypot": r"\sqrt{%s^2 + %s^2}",
    "maximum": r"\max(%s)",
    "minimum": r"\min(%s)",
    "mod": r"%s \bmod %s",
    "sin": r"\sin(%s)",
    "sqrt": r"\sqrt{%s}",
    "tan": r"\tan(%s)",
}  # fmt: skip
_NESTED = ("maximum", "minimum")
_ALONE, _SUM, _PRODUCT, _POWER, _BASE = range(5)  # how tightly the surroundings bind


class CalculationError(TypeError):
    """A calculation has something in it that does not print."""


class Printer:
    """Writes expressions in LaTeX, with brackets only where they are needed."""

    def __init__(self, shown: Mapping[str, str], times: str) -> None:
        self.shown, self.times = shown, times

    def text(self, node: ast.expr, outer: int = _ALONE, flat: bool = False) -> str:
        """Return an expression; `flat` is without fractions, as in an exponent."""

        def within(inner: str, own: int) -> str:
            if own >= outer:
                return inner
            if flat:
                return f"({inner})"
            return rf"\left[{inner}\right]" if "(" in inner else rf"\left({inner}\right)"

        match node:
            case ast.Name(id="pi"):
                return r"\pi"
            case ast.Name(id=name):
                return self._operand(self.shown[name], outer)
            case ast.Constant(value=int() | float() as value):
                return self._operand(_number(value), outer)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return within(f"-{self.text(operand, _PRODUCT, flat)}", _ALONE)
            case ast.BinOp(op=ast.Mult() | ast.Div()) if positive := _without_sign(node):
                return self.text(ast.UnaryOp(ast.USub(), positive), outer, flat)
            case ast.BinOp(left=a, op=ast.Add() | ast.Sub() as sign, right=b):
                plus = isinstance(sign, ast.Add)
                right = self.text(b, _SUM if plus else _PRODUCT, flat)
                left = self.text(a, _ALONE, flat)
                return within(f"{left} {'+' if plus else '-'} {right}", _SUM)
            case ast.BinOp(left=ast.Constant(), op=ast.Mult(), right=ast.Name(id="pi")):
                return within(rf"{self.text(node.left, _PRODUCT)} \pi", _PRODUCT)
            case ast.BinOp(left=a, op=ast.Mult(), right=b):
                split = flat and isinstance(a, ast.BinOp) and isinstance(a.op, ast.Div)
                pair = (
                    self.text(a, _POWER if split else _PRODUCT, flat),
                    self.text(b, _PRODUCT, flat),
                )
                return within(f" {self.times} ".join(pair), _PRODUCT)
            case ast.BinOp(left=a, op=ast.Div(), right=b) if flat or (
                self._short(a) and self._short(b) and outer != _PRODUCT
            ):
                below = self.text(b, _POWER, flat)
                return within(f"{self.text(a, _PRODUCT, flat)} / {below}", _PRODUCT)
            case ast.BinOp(
                left=ast.Constant(value=1), op=ast.Div(), right=ast.Call(args=[a]) as call
            ) if ast.unparse(call.func) == "sqrt" and r"\frac" in self.text(a):
                return within(f"{self.text(a, _BASE)}^{{-1/2}}", _POWER)
            case ast.BinOp(left=a, op=ast.Div(), right=b):
                return within(rf"\frac{{{self.text(a)}}}{{{self.text(b)}}}", _POWER)
            case ast.BinOp(left=a, op=ast.Pow(), right=b):
                power = self.text(b, _ALONE, flat=True)
                return within(f"{self.text(a, _BASE, flat)}^{{{power}}}", _POWER)
            case ast.Call(func=ast.Name(id=name), args=arguments) if name in CALLS:
                arguments = _flattened(name, arguments)
                holes = CALLS[name].count("%s")
                tight = _BASE if holes > 1 else _ALONE
                inner = tuple(self.text(a, tight, flat or name == "exp") for a in arguments)
                found = CALLS[name] % (inner if holes > 1 else ", ".join(inner))
                return within(found, {"mod": _SUM, "exp": _POWER}.get(name, _BASE))
        raise unprintable("the expression", node)

    def _operand(self, text: str, outer: int) -> str:
        """Return a symbol or a value; a sign, a unit or a power of ten may want brackets."""
        own = _ALONE if text.startswith("-") else _PRODUCT if _compound(text) else _BASE
        return f"({text})" if own < outer else text

    def _short(self, node: ast.expr) -> bool:
        """Return whether what prints for a tree is so short that it needs no fraction."""
        match node:
            case ast.BinOp(left=left, op=ast.Pow()):
                return self._short(left)
            case ast.BinOp(left=left, op=ast.Mult(), right=right):
                return self._short(left) and self._short(right)
            case ast.Name(id=name):
                return not _compound(self.shown.get(name, ""))
        return isinstance(node, ast.Constant)


def _without_sign(node: ast.expr) -> ast.expr | None:
    """Return a product without the minus that it begins with; None where there is none."""
    match node:
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return operand
        case ast.BinOp(left=left, op=ast.Mult() | ast.Div() as op, right=right):
            positive = _without_sign(left)
            return ast.BinOp(positive, op, right) if positive else None
    return None


def _number(value: float) -> str:
    """Return a constant to all its figures, as Python writes it but for powers of ten."""
    text = f"{value:g}"
    mantissa, _, power = (text if float(text) == value else repr(value)).partition("e")
    return rf"{mantissa} \times 10^{{{int(power)}}}" if power else mantissa


def _compound(text: str) -> bool:
    """Return whether a value has a unit or a power of ten, or a symbol is a product, such as EI."""
    return r"\text" in text or r"\times" in text or re.search("(^| )[A-Z]{2}", text) is not None


def _flattened(name: str, arguments: Sequence[ast.expr]) -> list[ast.expr]:
    """Return the arguments of a maximum or minimum, with those of the same within them."""
    flat: list[ast.expr] = []
    for argument in arguments:
        match argument:
            case ast.Call(func=ast.Name(id=inner), args=own) if inner == name and name in _NESTED:
                flat += _flattened(name, own)
            case _:
                flat.append(argument)
    return flat


def unprintable(where: str, node: ast.AST) -> CalculationError:
    """Return the error of what cannot be printed."""
    return CalculationError(f"{where} has what a calculation cannot print: {ast.unparse(node)}")
