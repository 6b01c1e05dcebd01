"""The fields of the form, from the keys of case files: groups, labels, help and examples."""

from typing import Any, get_args

from pierimpact.files.case import SHAPES, section_keys
from pierimpact.files.edit_case import LINES
from pierimpact.files.inputs import Inputs
from pierimpact.files.keys import explanation
from pierimpact.files.new_case import examples
from pierimpact.files.trucks import truck_names
from pierimpact.units import SYSTEMS

# The keys that belong to some shapes only.
_SECTION = tuple(dict.fromkeys(key for shape in SHAPES.values() for key in section_keys(shape)))
#: The keys on show and those behind "More", by group.
GROUPS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "Project": (
        ("units", "project", "element", "job_number", "revision"),
        ("date", "prepared_by", "checked_by", "approved_by"),
    ),
    "Column": (
        (
            "column_shape",
            *_SECTION,
            *("column_height", "concrete_strength", "elastic_modulus", "density"),
        ),
        ("poisson_ratio", "stiffness_factor", "effective_stiffness", "steps"),
    ),
    "Ends of the column": (
        ("base", "top"),
        (
            *("base_stiffness", "base_rotation_stiffness", "top_stiffness"),
            *("top_rotation_stiffness", "top_mass", "embedment"),
        ),
    ),
    "Truck and collision": (
        ("truck", "truck_mass", "speed", "impact_height"),
        ("damping_ratio",),
    ),
    "Resistances": (("shear_resistance", "moment_resistance"), ("member_forces",)),
    "Traffic, for pierimpact risk": (
        (),
        (
            *("traffic_volume", "truck_share", "distance_from_road", "exposed_width"),
            *("encroachment_rate", "traffic_mass", "traffic_speed", "traffic_deceleration"),
            *("traffic_angle", "weigh_in_motion", "traffic_trucks"),
        ),
    ),
    "Sources and printing": (
        (),
        ("assumed", "sources", "notes", "annexes", "office", "logo", "revisions", "supersedes"),
    ),
}
# How what takes a line an item is typed, after what it means.
_LINES = {
    "steps": "a line for each step, such as",
    "revisions": "a line for each revision, such as",
    "assumed": "a line for each key, such as",
    "sources": "a line for each key, such as",
    "notes": "a line for each note",
}
_EXAMPLES = {
    "steps": (
        "height: 2 m, column_shape: circular, column_diameter: 1 m",
        "height: 7 ft, column_shape: circular, column_diameter: 3 ft",
    ),
    "revisions": ("revision: A, date: 2026-01-31, description: First issue",) * 2,
    "assumed": ("density: usual for normal-weight concrete",) * 2,
    "sources": ("speed: posted limit",) * 2,
    "notes": ("A note of your own",) * 2,
    "annexes": ("procedure, codes",) * 2,
    "traffic_trucks": ("single-unit-8t, tractor-trailer-36t",) * 2,
    "element": ("Pier 2, column 1",) * 2,
    "job_number": ("2026-014",) * 2,
}


def fields() -> dict[str, Any]:
    """Return the fields as the browser takes them: "groups", "shapes" and "fields" by key."""
    return {
        "groups": [
            {"title": title, "keys": list(shown), "more": list(more)}
            for title, (shown, more) in GROUPS.items()
        ],
        "shapes": {name: list(section_keys(shape)) for name, shape in SHAPES.items()},
        "fields": {key: _field(key) for key in Inputs.model_fields},
    }


def _field(key: str) -> dict[str, Any]:
    field = Inputs.model_fields[key]
    choices = [choice for choice in get_args(field.annotation) if isinstance(choice, str)]
    label, words = key.replace("_", " ").capitalize(), _help(key, ", ".join(choices))
    return {
        "label": label,
        "help": "" if words == label.lower() else f"{words[:1].upper()}{words[1:]}.",
        "required": field.is_required(),
        "lines": key in LINES,
        "choices": choices if key != "impact_height" else [],
        "suggestions": truck_names() if key == "truck" else [],
        "examples": {system: _example(key, system) for system in SYSTEMS},
    }


def _help(key: str, choices: str) -> str:
    """Return what a key means, without what only those need who write a file themselves."""
    words = explanation(key).replace(", in quotes if it is a number", "")
    words = words.replace(f" ({choices})", "").replace(f"({choices}; ", "(")
    if key not in _LINES:
        return words
    example = f" “{_EXAMPLES[key][0]}”" if _LINES[key].endswith("such as") else ""
    return f"{words}; {_LINES[key]}{example}"


def _example(key: str, system: str) -> Any:
    """Return an example of a key's value; for a key of the section, by shape."""
    if key in _EXAMPLES:
        return _EXAMPLES[key][SYSTEMS.index(system)]
    if key in _SECTION:
        return {shape: examples(shape, system).get(key, "") for shape in SHAPES}
    return examples("circular", system).get(key, "")
