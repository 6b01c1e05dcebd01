"""Keys and values of a YAML text: limited in depth and size, and without YAML's surprises.

An alias costs three letters and may stand for all that is before it, so that what counts is the
size with all of them written out. Numbers are decimal: 010, 0x10 and 1:30, which YAML 1.1 takes for
8, 16 and 90, are refused, and 5e-2 is a number.
"""

import re
from collections.abc import Hashable
from typing import Any

import yaml

from pierimpact.checks import InputError, brief, shortened

_DEEPEST = 12  # nodes within each other; case files have four: this project's choice
_MOST = 64_000  # characters and nodes with all aliases written out: this project's choice
# What to do, by what YAML says of it: of what it was at, and then of what it met.
_REMEDIES = {
    "while scanning a simple key": "a key ends in a colon and a space",
    "while scanning a quoted scalar": "a quotation mark is not closed",
    "mapping values are not allowed here": "put text that has a colon in it in quotes",
    "found character '\\t' that cannot start any token": "use spaces in place of tabs",
}
_WHOLE = re.compile(r"[-+]?(?:0|[1-9][0-9]*)")
_FLOAT = re.compile(
    r"[-+]?(?:[0-9]+\.[0-9]*|\.[0-9]+|[0-9]+(?=[eE]))(?:[eE][-+]?[0-9]+)?$|[-+]?\.inf$|\.nan$"
)


def yaml_keys(text: str) -> dict[Any, Any]:
    """Return the keys and values of a YAML text, unchecked but that no key is given twice.

    Raises
    ------
    InputError
        When it is not YAML, too deep or too large, or not keys and values; the message is one line.
    """
    try:
        values = yaml.load(text, _Loader)
    except yaml.MarkedYAMLError as error:
        begun = error.context in _REMEDIES  # there is the mistake, not where YAML gave up
        mark = error.context_mark if begun else error.problem_mark
        where = f"{_line(mark)}: " if mark else ""
        remedy = _REMEDIES.get(str(error.context if begun else error.problem), "")
        problem = shortened(str(error.problem), 120)
        raise InputError(f"{where}not valid YAML: {problem}{remedy and ': '}{remedy}") from None
    except (yaml.YAMLError, RecursionError) as error:
        reason = str(error).partition("\n")[0]
        raise InputError(f"not valid YAML: {shortened(reason, 120)}") from None
    if not isinstance(values, dict):
        found = "nothing" if values is None else brief(values)
        raise InputError(f"must be keys and values (key: value), got {found}")
    return values


def _line(mark: Any) -> str:
    return f"line {mark.line + 1}"


class _Loader(yaml.SafeLoader):
    """YAML's safe loader with those limits."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.depth = 0
        self.sizes: dict[int, int] = {}  # of the nodes composed so far

    def compose_node(self, parent: yaml.Node | None, index: int) -> Any:
        event: Any = self.peek_event()  # type: ignore[no-untyped-call]
        start = _line(event.start_mark)
        self.depth += 1
        if self.depth > _DEEPEST:
            raise InputError(f"{start}: nested more than {_DEEPEST} deep")
        node: Any = super().compose_node(parent, index)
        self.depth -= 1
        if isinstance(event, yaml.AliasEvent):
            if id(node) not in self.sizes:
                raise InputError(f"{start}: the alias *{event.anchor} is within what it stands for")
            return node
        if isinstance(node, yaml.ScalarNode):
            size = len(node.value)
        elif isinstance(node, yaml.SequenceNode):
            size = sum(self.sizes[id(item)] for item in node.value)
        else:
            size = sum(self.sizes[id(item)] for pair in node.value for item in pair)
        self.sizes[id(node)] = 1 + size
        if size > _MOST:
            raise InputError(f"{start}: with its aliases (*) written out it is too long")
        return node

    def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:
        try:
            return super().construct_object(node, deep)
        except InputError:
            raise
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
            kind = node.tag.rpartition(":")[2]
            message = f"{_line(node.start_mark)}: {brief(node.value)} cannot be read as a {kind}"
            raise InputError(message) from None

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        seen = set()
        for key_node, _ in node.value if isinstance(node, yaml.MappingNode) else ():
            key = self.construct_object(key_node, deep=True)
            if isinstance(key, Hashable):  # the safe loader refuses others
                if key in seen:
                    raise InputError(f"{_line(key_node.start_mark)}: {brief(key)} is given twice")
                seen.add(key)
        return super().construct_mapping(node, deep)

    def construct_number(self, node: yaml.ScalarNode) -> int | float:
        """Return a decimal number."""
        text = self.construct_scalar(node)
        if _WHOLE.fullmatch(text):
            return int(text)
        if _FLOAT.fullmatch(text):
            return float(text.replace(".i", "i").replace(".n", "n"))
        raise InputError(
            f"{_line(node.start_mark)}: {brief(text)} is not a decimal number; put it in quotes if "
            "it is text"
        )


for _kind in ("int", "float"):
    _Loader.add_constructor(f"tag:yaml.org,2002:{_kind}", _Loader.construct_number)
# YAML 1.1 wants a point in a mantissa and a sign in an exponent.
_Loader.add_implicit_resolver("tag:yaml.org,2002:float", _FLOAT, list("-+.0123456789"))
