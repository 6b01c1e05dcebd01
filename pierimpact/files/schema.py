"""The JSON Schema of case files, with which an editor completes and checks them.

It takes all that the reader of case files takes, and leaves to the reader what only a calculation
shows, such as that a column is a mechanism, or that units make another dimension when multiplied.
"""

from typing import Any

from pydantic import BaseModel

from pierimpact.files.case import SHAPES, section_keys
from pierimpact.files.inputs import (
    ANNEXES,
    KEYS,
    PHYSICAL_KEYS,
    Inputs,
    RevisionInputs,
    SectionInputs,
    StepInputs,
)
from pierimpact.files.keys import explanation, quantity_of, usual_for
from pierimpact.files.limits import POSSIBLE, possible_in
from pierimpact.files.trucks import truck_names
from pierimpact.units import DIMENSIONS, SYSTEMS, pattern

Schema = dict[str, Any]

_NULL: Schema = {"type": "null"}
# What the types of keys leave unsaid.
_OF_PHYSICAL_KEYS: Schema = {"propertyNames": {"enum": list(PHYSICAL_KEYS)}}
_OWN: dict[str, Schema] = {
    "annexes": {
        "type": ["array", "string"],
        "items": {"enum": list(ANNEXES)},
        "pattern": "^all$",
    },
    "assumed": _OF_PHYSICAL_KEYS,
    "impact_height": {
        "anyOf": [
            {"type": "string", "pattern": r"^\s*[Aa][Uu][Tt][Oo]\s*$"},
            {"$ref": "#/$defs/length"},
        ]
    },
    "sources": _OF_PHYSICAL_KEYS,
    "truck": {"anyOf": [{"enum": truck_names()}, {"pattern": r"\.toml$"}]},
}


def case_schema() -> Schema:
    """Return the JSON Schema, draft 2020-12, of a case file."""
    found = Inputs.model_json_schema()
    models: dict[str, type[BaseModel]] = {
        "StepInputs": StepInputs,
        "RevisionInputs": RevisionInputs,
    }
    whole = _object(Inputs, found)
    whole["allOf"] += [
        {"oneOf": [_given("elastic_modulus"), _given("concrete_strength")]},
        {"not": {"allOf": [_given("stiffness_factor"), _given("effective_stiffness")]}},
    ]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Case file of pierimpact",
        **whole,
        "$defs": {
            "section": {"allOf": [_section(shape) for shape in SHAPES]},
            **{name: _object(model, found["$defs"][name]) for name, model in models.items()},
            **{
                _name(kind): _quantity(kind)
                for kind in dict.fromkeys(map(quantity_of, KEYS))
                if kind
            },
        },
    }


def _object(model: type[BaseModel], found: Schema) -> Schema:
    """Return the schema of a model of keys, given pydantic's."""
    schema: Schema = {
        "type": "object",
        "additionalProperties": False,
        "required": found["required"],
        "properties": {
            key: _value(key, model, found["properties"][key]) for key in model.model_fields
        },
    }
    if issubclass(model, SectionInputs):
        schema["allOf"] = [{"$ref": "#/$defs/section"}]
    return schema


def _value(key: str, model: type[BaseModel], found: Schema) -> Schema:
    """Return the schema of a key's value, given pydantic's."""
    first = found.get("anyOf", [found])[0]  # the other is null
    schema = {name: part for name, part in first.items() if name not in ("title", "default")}
    kind = quantity_of(key)
    schema |= _OWN.get(key, {"$ref": f"#/$defs/{_name(kind)}"} if kind else {})
    if not model.model_fields[key].is_required():  # null counts as not given
        types = schema["type"]
        schema["type"] = [*([types] if isinstance(types, str) else types), "null"]
        if "enum" in schema:
            schema["enum"] = [*schema["enum"], None]
    usual, *other = dict.fromkeys(usual_for(key, system) for system in SYSTEMS)
    words = explanation(key, model)
    if usual:
        words += f". Usual: {usual}" + "".join(f" ({ends})" for ends in other)
    if kind and (possible := possible_in(key, "SI")):
        words += f". Possible: {possible}"
    elif key in POSSIBLE:
        schema["minimum"], schema["maximum"] = POSSIBLE[key]
    return {"description": f"{words[:1].upper()}{words[1:]}."} | schema


def _quantity(kind: str) -> Schema:
    """Return the schema of a number with a unit, with the message that VS Code has for it."""
    _, words, units = DIMENSIONS[kind]
    message = f"Must be {words}, a number with a unit ({units})."
    return {"pattern": pattern(kind), "patternErrorMessage": message}


def _name(kind: str) -> str:
    return kind.replace(" ", "_")


def _section(shape: str) -> Schema:
    """Return the rule that a shape has its dimensions and none of those of other shapes."""
    own = section_keys(SHAPES[shape])
    others = {key for each in SHAPES.values() for key in section_keys(each)} - set(own)
    given = [_given(key) for key in own]
    return {
        "if": {"required": ["column_shape"], "properties": {"column_shape": {"const": shape}}},
        "then": {"allOf": given, "properties": dict.fromkeys(sorted(others), _NULL)},
    }


def _given(key: str) -> Schema:
    """Return the rule that a key is given."""
    return {"required": [key], "properties": {key: {"not": _NULL}}}
