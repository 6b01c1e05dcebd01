"""Calculations of the package as JavaScript, so that their equations are written once.

A calculation, or a part or formula that one calls, is a list of `symbol = expression` in ordinary
Python; `handcalc` prints it, and here it is written in the browser's language.
"""

import ast
import inspect
import textwrap
from collections.abc import Callable, Iterable
from typing import Any

from pierimpact.handcalc import Calculation

_MATH = {
    "abs": "abs", "arctan": "atan", "arctan2": "atan2", "cos": "cos", "exp": "exp",
    "floor": "floor", "hypot": "hypot", "maximum": "max", "minimum": "min", "sin": "sin",
    "sqrt": "sqrt",
}  # fmt: skip
_OPERATORS: dict[type[ast.AST], str] = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**", ast.USub: "-",
    ast.BitAnd: "&&", ast.Gt: ">", ast.GtE: ">=", ast.Lt: "<", ast.LtE: "<=",
}  # fmt: skip
_HELPERS = "const modulo = (a, b) => ((a % b) + b) % b;\n"


def module(functions: Iterable[Calculation | Callable[..., Any]]) -> str:
    """Return a module that exports functions, with all that they call before them.

    A `Calculation` takes an object of its values there, and returns one; any other function takes
    its arguments one by one.
    """
    written: dict[str, str] = {}
    for function in functions:
        _write(function, written)
    return _HELPERS + "".join(written.values())


def _write(function: Any, written: dict[str, str]) -> None:
    """Add a function of Python, and before it what it calls, to what has been written by name."""
    plain = function.function if isinstance(function, Calculation) else function
    name = plain.__name__
    if name in written:
        return
    (definition,) = ast.parse(textwrap.dedent(inspect.getsource(plain))).body
    assert isinstance(definition, ast.FunctionDef)
    printer = _Printer(plain.__globals__)
    text = printer.function(definition, takes_object=isinstance(function, Calculation))
    for other in printer.called:
        _write(plain.__globals__[other], written)
    written[name] = f"export {text}"


class _Printer:
    """Prints expressions and statements in JavaScript, and notes which functions they call."""

    def __init__(self, names: dict[str, Any]) -> None:
        self.names = names
        self.own, self.called = list[str](), list[str]()

    def function(self, definition: ast.FunctionDef, *, takes_object: bool) -> str:
        arguments = definition.args.args
        self.own += [argument.arg for argument in arguments]
        defaults = [None] * (len(arguments) - len(definition.args.defaults))
        given = ", ".join(
            argument.arg if default is None else f"{argument.arg} = {self.text(default)}"
            for argument, default in zip(
                arguments, [*defaults, *definition.args.defaults], strict=True
            )
        )
        body = [line for line in definition.body if not _is_docstring(line)]
        lines = "".join(f"  {self.statement(line)}\n" for line in body)
        taken = f"{{ {given} }}" if takes_object else given
        return f"function {definition.name}({taken}) {{\n{lines}}}\n"

    def statement(self, line: ast.stmt) -> str:
        match line:
            case ast.Assign(targets=[target], value=value):
                text = f"const {self.text(target)} = {self.text(value)};"
                targets = target.elts if isinstance(target, ast.Tuple) else [target]
                self.own += [each.id for each in targets if isinstance(each, ast.Name)]
                return text
            case ast.Return(value=ast.Call(func=ast.Name(id="locals"))):
                return f"return {{ {', '.join(self.own)} }};"
            case ast.Return(value=ast.expr() as value):
                return f"return {self.text(value)};"
        raise NotImplementedError(ast.unparse(line))

    def text(self, node: ast.expr) -> str:
        match node:
            case ast.Constant(value=bool() | int() | float() as value):
                return repr(value)
            case ast.Name(id=name):
                return self.name(name)
            case ast.Tuple(elts=parts):
                return f"[{', '.join(map(self.text, parts))}]"
            case ast.Subscript(value=value, slice=place):
                return f"{self.text(value)}[{self.text(place)}]"
            case ast.UnaryOp(op=operator, operand=value):
                return f"({_OPERATORS[type(operator)]}{self.text(value)})"
            case ast.BinOp(left=a, op=operator, right=b):
                return f"({self.text(a)} {_OPERATORS[type(operator)]} {self.text(b)})"
            case ast.Compare(left=a, ops=[operator], comparators=[b]):
                return f"({self.text(a)} {_OPERATORS[type(operator)]} {self.text(b)})"
            case ast.Call(func=ast.Name(id="where"), args=[condition, a, b]):
                return f"({self.text(condition)} ? {self.text(a)} : {self.text(b)})"
            case ast.Call(func=ast.Name(id=name), args=arguments):
                return f"{self.callee(name)}({', '.join(map(self.text, arguments))})"
        raise NotImplementedError(ast.unparse(node))

    def name(self, name: str) -> str:
        """Return a symbol, a constant of the module as its number, or a function handed on."""
        if name in self.own:
            return name
        value = self.names.get(name)
        if isinstance(value, float):
            return "NaN" if value != value else repr(value)
        if callable(value):
            self.called.append(name)
        return name

    def callee(self, name: str) -> str:
        if name in _MATH:
            return f"Math.{_MATH[name]}"
        if name == "mod":
            return "modulo"
        return self.name(name)


def _is_docstring(line: ast.stmt) -> bool:
    return isinstance(line, ast.Expr) and isinstance(line.value, ast.Constant)
