"""The values of a case file as they are typed in a form, and its text with some of them changed.

What else the text says stays: comments, the order of its keys, values that are not changed.
"""

import datetime
import json
import re
from typing import Any

import yaml

from pierimpact.checks import InputError
from pierimpact.files.inputs import KEYS, NOT_GIVEN, PHYSICAL_KEYS
from pierimpact.files.new_case import examples
from pierimpact.files.yaml_keys import yaml_keys
from pierimpact.units import SYSTEMS

#: Keys with a value a line: texts, keys and values of a mapping, and keys with a text each.
TEXTS, MAPPINGS, TEXTS_BY_KEY = ("notes",), ("steps", "revisions"), ("assumed", "sources")
LINES = (*TEXTS, *MAPPINGS, *TEXTS_BY_KEY)
_LISTS = ("annexes", "traffic_trucks")  # with commas between their texts


def typed_in(text: str) -> dict[str, str]:
    """Return the values of a case file by key, as they would be typed in a form.

    Lists and mappings have a line for each item; what is not given is not there.

    Raises
    ------
    InputError
        When the text is not keys and values in YAML.
    """
    entries = _entries(text)
    found = {}
    for key, value in yaml_keys(text).items():
        node = entries[key][1] if key in entries else None
        typed = node.value if isinstance(node, yaml.ScalarNode) else _typed(str(key), value)
        if value is not None and typed != NOT_GIVEN:
            found[str(key)] = typed.strip()
    return found


def edited(text: str, typed: dict[str, str]) -> str:
    """Return the text of a case file with the values of a form, all the rest as it is.

    Parameters
    ----------
    text : str
        Text of a case file.
    typed : dict of str to str
        What is typed, by key; "" for what is not to be given.
    """
    before = typed_in(text)
    for key, value in typed.items():
        if value.strip() != before.get(key, ""):
            text = _with(text, key, value.strip()) if value.strip() else _without(text, key)
    return text


def written_anew(typed: dict[str, str]) -> str:
    """Return the text of a case file with the values of a form, and nothing else."""
    given = {key: value.strip() for key, value in typed.items() if value.strip()}
    ordered = sorted(given, key=lambda key: KEYS.index(key) if key in KEYS else len(KEYS))
    return "".join(f"{_scalar(key)}: {_yaml(key, given[key])}\n" for key in ordered)


def _typed(key: str, value: Any) -> str:
    """Return a value that is no scalar as it would be typed."""
    if isinstance(value, dict) and key in TEXTS_BY_KEY:
        return "\n".join(f"{name}: {item}" for name, item in value.items())
    if isinstance(value, list) and key in MAPPINGS and all(isinstance(i, dict) for i in value):
        return "\n".join(_flow(item)[1:-1] for item in value)
    if isinstance(value, list) and all(isinstance(item, str) for item in value):
        return ("\n" if key in TEXTS else ", ").join(value)
    return value if isinstance(value, str) else _flow(value)


def _flow(value: Any) -> str:
    return (
        yaml.safe_dump(
            value, default_flow_style=True, allow_unicode=True, sort_keys=False, width=float("inf")
        )
        .removesuffix("\n")
        .removesuffix("\n...")
    )


def _entries(text: str) -> dict[Any, tuple[yaml.Node, yaml.Node]]:
    """Return the nodes of keys and values, by key."""
    yaml_keys(text)  # whose limits hold here too
    root: Any = yaml.compose(text, yaml.SafeLoader)
    return {key.value: (key, value) for key, value in root.value}


def _end(node: yaml.Node) -> int:
    """Return where a node's own text ends: that of a block reaches to what comes after it."""
    if isinstance(node, yaml.CollectionNode) and not node.flow_style and node.value:
        last = node.value[-1]
        return _end(last[1] if isinstance(last, tuple) else last)
    return node.end_mark.index


def _items(key: str, value: str) -> list[str]:
    """Return what is typed, a line an item, as items of YAML without their marks."""
    lines = [line.strip() for line in value.splitlines() if line.strip()]
    if key in TEXTS:
        return [_scalar(line) for line in lines]
    if key in MAPPINGS:
        return [f"{{{line}}}" if _is_mapping(line) else _scalar(line) for line in lines]
    pairs = (line.partition(":") for line in lines)
    return [f"{_scalar(name.strip())}: {_scalar(words.strip())}" for name, _, words in pairs]


def _is_mapping(line: str) -> bool:
    try:
        return bool(yaml_keys(f"{{{line}}}"))
    except InputError:
        return False


def _yaml(key: str, value: str) -> str:
    """Return what is typed as YAML of one line."""
    if key in LINES:
        items = ", ".join(_items(key, value))
        return f"{{{items}}}" if key in TEXTS_BY_KEY else f"[{items}]"
    if key in _LISTS and value != "all":
        return f"[{', '.join(_scalar(name.strip()) for name in value.split(','))}]"
    others = (int, float) if key in PHYSICAL_KEYS else (datetime.date,) if key == "date" else ()
    return _scalar(value, others)


def _scalar(text: str, others: tuple[type, ...] = ()) -> str:
    """Return a text in quotes, unless YAML takes it for that text, or for one of other types."""
    try:
        (read,) = yaml_keys(f"key: [{text}]")["key"]
    except (InputError, TypeError, ValueError):
        read = None
    plain = read == text or (type(read) in others)
    return text if plain and "\n" not in text else json.dumps(text, ensure_ascii=False)


def _with(text: str, key: str, value: str) -> str:
    """Return a text with a value given to a key."""
    entries = _entries(text)
    if key in entries:
        _, node = entries[key]
        start, end = node.start_mark.index, _end(node)
        if isinstance(node, yaml.CollectionNode) and key in LINES and not node.flow_style:
            mark = "" if key in TEXTS_BY_KEY else "- "
            between = f"\n{' ' * node.start_mark.column}"
            return text[:start] + between.join(mark + i for i in _items(key, value)) + text[end:]
        if start == end:  # nothing is given yet
            return _aligned(text, start, end, f" {_yaml(key, value)}")
        return _aligned(text, start, end, _yaml(key, value))
    for system in SYSTEMS:  # the line of a new case file, to be taken up
        example = re.escape(f"# {key}: {examples('circular', system).get(key, '')}")
        if found := re.search(rf"^{example}(?=\s*$|\s+#)", text, re.MULTILINE):
            return _aligned(text, *found.span(), f"{key}: {_yaml(key, value)}")
    line = f"{_scalar(key)}: {_yaml(key, value)}\n"
    before = [own for own in (KEYS[: KEYS.index(key)] if key in KEYS else ()) if own in entries]
    if not before:
        text += "" if text.endswith("\n") or not text else "\n"
        return text + line
    place = text.find("\n", _end(entries[before[-1]][1])) + 1
    if not place:
        return f"{text}\n{line}"
    while after := re.match(r"[ \t]+#.*\n", text[place:]):  # the comment goes on
        place += after.end()
    return text[:place] + line + text[place:]


def _without(text: str, key: str) -> str:
    """Return a text in which a key is not given: its line is a comment, if it is one line."""
    name, node = _entries(text)[key]
    start, end = name.start_mark.index, _end(node)
    if "\n" not in text[start:end] and key in KEYS:
        return _aligned(text, start, end, f"# {text[start:end]}")
    last = text.find("\n", end) + 1 or len(text)
    if key in KEYS and isinstance(node, yaml.CollectionNode) and not node.flow_style:
        return text[: node.start_mark.index - node.start_mark.column] + text[last:]
    return text[:start] + text[last:]


def _aligned(text: str, start: int, end: int, new: str) -> str:
    """Return a text with a part replaced, and the comment after it in its column if it can be."""
    rest = text[end:]
    if found := re.match(r"( +)#", rest):
        gap = max(2, len(found[1]) + (end - start) - len(new))
        rest = " " * gap + rest[len(found[1]) :]
    return text[:start] + new + rest
