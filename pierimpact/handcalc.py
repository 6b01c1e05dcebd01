"""A calculation written once: a function that computes, and whose steps print as a checker reads.

A calculation is a function whose body is a list of `symbol = expression`, in ordinary Python on
floats or arrays. Called, it computes. Asked for its steps, it reads them off its own source: the
equation in symbols, to be printed once more with the values put in.

- `where(condition, a, b)` prints as the side that the values take, with the condition beside it.
- Only the steps that the results rest on in this case are printed.
- A function of one `return` that a step calls, a formula, prints in full.
- `a, b = part(…)` prints the lines of `part`, itself a list of `symbol = expression`, under the
  names on the left.
- A comment behind a line prints beside its step.
"""

import ast
import inspect
import io
import textwrap
import tokenize
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import deepcopy
from functools import cache, cached_property
from typing import Any, NamedTuple, TypeAlias

from pierimpact.latex import CALLS, CalculationError, Printer, unprintable

Real: TypeAlias = Any  # what a symbol stands for: a float, or an array

_COMPARISONS: dict[type[ast.cmpop], tuple[str, str]] = {  # that holds, and that does not
    ast.Gt: (">", r"\le"),
    ast.GtE: (r"\ge", "<"),
    ast.Lt: ("<", r"\ge"),
    ast.LtE: (r"\le", ">"),
}


class Condition(NamedTuple):
    """A condition that decided a `where`, and whether it holds."""

    expression: ast.expr
    holds: bool

    def latex(self, symbols: Mapping[str, str]) -> str:
        """Return what holds in LaTeX: the condition, or its contrary; a flag as its name."""
        match self.expression:
            case ast.Compare(left=left, ops=[comparison], comparators=[right]) if (
                type(comparison) in _COMPARISONS
            ):
                sign = _COMPARISONS[type(comparison)][0 if self.holds else 1]
                printer = Printer(symbols, r"\,")
                return f"{printer.text(left)} {sign} {printer.text(right)}"
            case ast.Name(id=name):
                return symbols[name] if self.holds else rf"\text{{no }}{symbols[name]}"
        raise unprintable("the condition", self.expression)


class Step(NamedTuple):
    """A step of a calculation, as it applies to the values of one case."""

    name: str  #: of the symbol that it gives
    expression: ast.expr
    conditions: tuple[Condition, ...]  #: why this expression
    remark: str  #: what stands behind the line, such as its source

    def latex(self, shown: Mapping[str, str], times: str = r"\,") -> str:
        r"""Return the expression in LaTeX.

        Parameters
        ----------
        shown : mapping of str to str
            What to print for each name: its symbol, or its value.
        times : str, optional
            What stands between factors: a space between symbols, `\times` between values.
        """
        return Printer(shown, times).text(self.expression)

    @property
    def names(self) -> set[str]:
        """The names that the expression is made of."""
        return _names(self.expression)


class _Line(NamedTuple):
    """A line of a calculation as written, with the names of parts already those of the caller."""

    name: str
    expression: ast.expr
    remark: str


class Calculation:
    """A calculation; use as a decorator of the function that is one.

    The function takes numbers or arrays by name, and returns `locals()`.

    Parameters
    ----------
    function : callable
        The function. A part or formula may be among its arguments, by default the one to print.
    """

    def __init__(self, function: Callable[..., dict[str, Any]]) -> None:
        self.function = function
        self.__doc__ = function.__doc__

    def __call__(self, **given: Any) -> dict[str, Any]:
        """Return every value by name, those given included."""
        found = self.function(**given)
        return {name: value for name, value in found.items() if not callable(value)}

    @cached_property
    def given(self) -> tuple[str, ...]:
        """The names of the values that it starts from."""
        parameters = inspect.signature(self.function).parameters.values()
        return tuple(p.name for p in parameters if not callable(p.default) or p.default is p.empty)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the values that it gives, in order."""
        return tuple(line.name for line in self._lines)

    @cached_property
    def _lines(self) -> list[_Line]:
        lines, names = _lines(self.function), set(self.given)
        for name, *_ in lines:
            if name in names:  # the values before would be lost, but used
                raise CalculationError(f"{self.function.__name__} gives {name} twice")
            names.add(name)
        return lines

    def steps(self, values: Mapping[str, Any], results: Iterable[str]) -> list[Step]:
        """Return the steps that results rest on in one case, in order.

        Parameters
        ----------
        values : mapping of str to float
            What the calculation returned.
        results : iterable of str
            Names of the results.

        Raises
        ------
        CalculationError
            When the calculation has something in it that does not print.
        """
        needed, found = set(results), list[Step]()
        for name, expression, remark in reversed(self._lines):
            if name not in needed:
                continue
            case = _Case(_scope(self.function), values)
            applies = case.visit(deepcopy(expression))
            step = Step(name, applies, tuple(case.conditions.values()), remark)
            needed |= step.names | {n for c in step.conditions for n in _names(c.expression)}
            found.append(step)
        return found[::-1]

    def split(self, steps: Iterable[Step], *starts: str) -> list[list[Step]]:
        """Return steps in parts, each of which starts where a name stands in the calculation."""
        order = {name: place for place, name in enumerate(self.names)}
        ends = [order[name] for name in starts]
        parts: list[list[Step]] = [[] for _ in range(len(ends) + 1)]
        for step in steps:
            parts[sum(order[step.name] >= end for end in ends)].append(step)
        return parts


def _lines(function: Callable[..., Any]) -> list[_Line]:
    """Return the lines of a calculation or part, those of its own parts in their place."""
    scope, body, remarks = _scope(function), *_source(function)
    lines: list[_Line] = []
    for statement in body[:-1]:
        remark = " ".join(
            remarks[line]
            for line in range(statement.lineno, (statement.end_lineno or 0) + 1)
            if line in remarks
        )
        match statement:
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                lines.append(_Line(name, value, remark))
            case ast.Assign(
                targets=[ast.Tuple(elts=names)],
                value=ast.Call(func=ast.Name(id=part), args=arguments, keywords=[]),
            ) if part in scope:
                lines += _lines_of_part(scope[part], [ast.unparse(n) for n in names], arguments)
            case _:
                raise unprintable(function.__name__, statement)
    return lines


def _lines_of_part(
    part: Callable[..., Any], names: Sequence[str], arguments: Sequence[ast.expr]
) -> list[_Line]:
    """Return the lines of a part, under the names on the left of its call."""
    match _source(part)[0][-1]:
        case ast.Return(value=ast.Tuple(elts=returned)):
            inside = [ast.unparse(node) for node in returned]
        case other:
            raise unprintable(part.__name__, other)
    lines = _lines(part)
    if sorted(line.name for line in lines) != sorted(inside) or len(inside) != len(names):
        raise CalculationError(f"{part.__name__} must return every symbol that it gives")
    outside = dict(zip(inside, names, strict=True))
    put = _bound(part, arguments) | {
        own: ast.Name(name, ast.Load()) for own, name in outside.items()
    }
    return [
        _Line(outside[line.name], _Put(put).visit(deepcopy(line.expression)), line.remark)
        for line in lines
    ]


class _Case(ast.NodeTransformer):
    """Decides each `where` by the values, and puts formulas and constants in."""

    def __init__(self, scope: Mapping[str, Any], values: Mapping[str, Any]) -> None:
        self.scope, self.values, self.constants = scope, values, _constants(scope)
        self.conditions: dict[str, Condition] = {}  # each once, by its text

    def visit_Call(self, node: ast.Call) -> ast.expr:
        match node:
            case ast.Call(keywords=[_, *_]):  # would be passed over
                pass
            case ast.Call(func=ast.Name(id="where"), args=[condition, yes, no]):
                holds = self._decide(condition)
                return self.visit(yes if holds else no)  # type: ignore[no-any-return]
            case ast.Call(func=ast.Name(id=name)) if name in CALLS:
                return self.generic_visit(node)  # type: ignore[return-value]
            case ast.Call(func=ast.Name(id=name), args=arguments) if inspect.isfunction(
                self.scope.get(name)
            ):
                formula = self.scope[name]
                *others, last = _source(formula)[0]
                if not isinstance(last, ast.Return) or last.value is None or others:
                    raise unprintable(f"the formula {name}", (*others, last)[0])
                put = _bound(formula, [self.visit(argument) for argument in arguments])
                inner = _Case(_scope(formula), self.values)
                expression = inner.visit(_Put(put).visit(deepcopy(last.value)))
                self.conditions |= inner.conditions
                return expression  # type: ignore[no-any-return]
        raise unprintable("the call", node)

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return node if node.id in self.values else self.constants.get(node.id, node)

    def _decide(self, condition: ast.expr) -> bool:
        """Decide a condition, and note as little of it as decides."""
        parts = _conjuncts(self.visit(deepcopy(condition)))
        decided = [Condition(part, bool(self._value(part))) for part in parts]
        holds = all(part.holds for part in decided)
        noted = decided if holds else [part for part in decided if not part.holds][:1]
        self.conditions |= {ast.unparse(part.expression): part for part in noted}
        return holds

    def _value(self, node: ast.expr) -> Any:
        code = compile(ast.fix_missing_locations(ast.Expression(deepcopy(node))), "where", "eval")
        return eval(code, dict(self.scope), dict(self.values))


def _conjuncts(condition: ast.expr) -> list[ast.expr]:
    if isinstance(condition, ast.BinOp) and isinstance(condition.op, ast.BitAnd):
        return [*_conjuncts(condition.left), *_conjuncts(condition.right)]
    return [condition]


class _Put(ast.NodeTransformer):
    """Puts expressions in for names."""

    def __init__(self, expressions: Mapping[str, ast.expr]) -> None:
        self.expressions = expressions

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return self.expressions.get(node.id, node)


def _bound(function: Callable[..., Any], arguments: Sequence[ast.expr]) -> dict[str, ast.expr]:
    """Return what the names in a function stand for: arguments, defaults, and constants."""
    bound = inspect.signature(function).bind(*arguments)
    given = dict(bound.arguments)
    bound.apply_defaults()
    return _constants(function.__globals__) | {
        name: value if name in given else ast.Constant(value)
        for name, value in bound.arguments.items()
    }


def _constants(scope: Mapping[str, Any]) -> dict[str, ast.expr]:
    """Return the numbers in a scope; π stays a symbol."""
    return {
        name: ast.Constant(value)
        for name, value in scope.items()
        if isinstance(value, int | float) and name != "pi"
    }


@cache
def _source(function: Callable[..., Any]) -> tuple[list[ast.stmt], dict[int, str]]:
    """Return what a function does, and the comments behind its lines by number."""
    source = textwrap.dedent(inspect.getsource(function))
    definition = ast.parse(source).body[0]
    assert isinstance(definition, ast.FunctionDef)
    remarks = {
        token.start[0]: token.string.lstrip("# ")
        for token in tokenize.generate_tokens(io.StringIO(source).readline)
        if token.type == tokenize.COMMENT and token.line.lstrip()[0] != "#"
    }
    remarks = {
        line: text for line, text in remarks.items() if not text.startswith(("fmt:", "noqa"))
    }
    body = definition.body[ast.get_docstring(definition) is not None :]
    return body, remarks


def _scope(function: Callable[..., Any]) -> dict[str, Any]:
    """Return what the names in a function stand for: its module's, and defaults that are parts."""
    parameters = inspect.signature(function).parameters.values()
    return function.__globals__ | {p.name: p.default for p in parameters if callable(p.default)}


def _names(node: ast.AST) -> set[str]:
    """Return the names of values in a tree: neither functions nor π."""
    called = {part.func.id for part in ast.walk(node) if isinstance(part, ast.Call)}  # type: ignore[attr-defined]
    names = {part.id for part in ast.walk(node) if isinstance(part, ast.Name)}
    return names - called - {"pi"}
