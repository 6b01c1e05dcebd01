"""What runs in the browser: JavaScript modules, and what Python tells them.

The modules are in `templates/page`. `model` has the mechanics, `column` the pier, `scenario` the
collision of some values, `spectrum` and `history` what is calculated with them; `procedure` is the
design procedure, translated from Python. `chart`, `picture` and `figures` draw, `sentences` says it
in words, `controls` are the sliders. `explorer` joins them to the explorer of a collision, and
`charts` to one of charts, each of which has a module of its own: `shape`, `reduction`,
`reactions`, `influences` and `risk`. `widget` puts either into a notebook. They are joined into one
script.
"""

import re
from collections.abc import Iterable
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from pierimpact.design import procedure
from pierimpact.design.codes import code_forces
from pierimpact.design.domain import DOMAIN
from pierimpact.plots import style
from pierimpact.resources import shipped
from pierimpact.symbols import BY_KEY, SYMBOLS, Symbol, dimension
from pierimpact.teaching import javascript
from pierimpact.teaching.markup import symbol
from pierimpact.teaching.variables import VARIABLES
from pierimpact.units import DIMENSIONS, parse
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.truck import Truck

#: The modules of the explorer of a collision, each after those that it imports.
EXPLORER = (
    "model", "spectrum", "history", "chart", "sentences", "picture", "column", "scenario",
    "controls", "explorer",
)  # fmt: skip
#: Those of all explorers in a notebook.
WIDGET = (
    *EXPLORER, "figures", "procedure", "shape", "reduction", "reactions", "influences",
    "risk",
    "charts", "widget",
)  # fmt: skip

_SPOKEN = {
    "km/h": "kilometres per hour",
    "Hz": "hertz",
    "t": "tonnes",
    "kg": "kilograms",
    "m": "metres",
    "kN": "kilonewtons",
    "MN/m": "meganewtons per metre",
    "MN": "meganewtons",
    "veh/day": "vehicles per day",
    "": "",
}


def script(*modules: str) -> str:
    """Return modules joined into one script, each in a scope of its own."""
    return "".join(_scoped(name, _module(name)) for name in modules)


def _module(name: str) -> str:
    """Return a module: a file, or the design procedure as JavaScript."""
    if name == "procedure":
        return javascript.module([procedure.amplification, *procedure.LEVELS.values()])
    return (shipped("templates") / "page" / f"{name}.mjs").read_text(encoding="utf-8")


def _scoped(name: str, module: str) -> str:
    """Return a module as a function's body that returns what it exports."""
    exported = re.findall(r"^export (?:class|const|function\*?) (\w+)", module, re.MULTILINE)
    body = re.sub(r"^export ", "", module, flags=re.MULTILINE)
    imported = r'^import (\{.*\}) from "\./(\w+)\.mjs";$'
    body = re.sub(imported, r"const \1 = \2Module;", body, flags=re.MULTILINE)
    returned = ", ".join(exported)
    return f"const {name}Module = (() => {{\n{body}return {{ {returned} }};\n}})();\n"


def stylesheet(*names: str) -> str:
    """Return style sheets, with the colours of all figures."""
    templates = Environment(
        loader=FileSystemLoader(shipped("templates") / "page"), undefined=StrictUndefined
    )
    colours = {name: getattr(style, name.upper()) for name in ("ink", "muted", "pale")}
    colours |= {name: getattr(style, name.upper()) for name in ("sky", "green", "orange", "purple")}
    return "".join(
        templates.get_template(f"{name}.css.j2").render(**colours, **style.BODIES) for name in names
    )


def truck_data(truck: Truck) -> dict[str, Any]:
    """Return a truck as the functions of the modules take it, in SI units."""
    return {
        "name": truck.name,
        "engine": _body(truck.engine_mass, truck.engine_spring),
        "body": _body(truck.body_mass, truck.body_spring),
        "friction": truck.friction_force,
        "frictionOnPier": truck.friction_on == "pier",
    }


def _body(mass: float, spring: CrushSpring) -> dict[str, float]:
    return {"mass": mass} | {_camel(name): value for name, value in vars(spring).items()}


def symbols_data(*names: str) -> dict[str, str]:
    """Return symbols as HTML, by their names in `pierimpact.symbols`."""
    return {name: symbol(SYMBOLS[name].latex) for name in names}


def codes_data() -> list[dict[str, Any]]:
    """Return the forces of codes: each a value [N], or the stiffness k of F = v √(k m) [N/m]."""
    return [
        {"name": code.code, "remark": code.along.remark}
        | ({"stiffness": code.stiffness.value} if code.stiffness else {"value": code.along.value})
        for code in code_forces(1.0, 1.0)
    ]


def domain_data() -> list[dict[str, Any]]:
    """Return what bounds the domain in which the design formulas were studied."""
    return [
        {"name": name, "meaning": SYMBOLS[name].meaning.capitalize()} | bound._asdict()
        for name, bound in DOMAIN.items()
    ]


def parameters_data() -> list[dict[str, Any]]:
    """Return the parameters of a truck: where a truck of `truck_data` has them, and their names."""
    paths = {"engine_mass": ["engine", "mass"], "body_mass": ["body", "mass"]}
    paths["friction_force"] = ["friction"]
    springs = {
        f"{body}_spring.{name}": [body, _camel(name)]
        for body in ("engine", "body")
        for name in CrushSpring.__dataclass_fields__
    }
    return [
        {"path": path, "meaning": BY_KEY[key].meaning, "short": _short_name(BY_KEY[key])}
        for key, path in (springs | paths).items()
    ]


def _short_name(parameter: Symbol) -> str:
    """Return the name of a truck parameter as a chart has room for it."""
    words, of, spring = parameter.meaning.partition(" of the ")
    return f"{spring.removesuffix(' spring')}: {words}" if of else parameter.meaning


def _camel(name: str) -> str:
    first, *others = name.split("_")
    return "".join([first, *(word.capitalize() for word in others)])


def variable_data(name: str, **own: float) -> dict[str, Any]:
    """Return one of VARIABLES as a control of the modules takes it.

    Parameters
    ----------
    name : str
        Its name.
    **own : float
        Values that take the place of its own: `low`, `high` or `step`.
    """
    variable = VARIABLES[name]
    data: dict[str, Any] = {
        "name": name,
        "label": variable.symbol.heading,
        "symbol": symbol(variable.symbol.latex),
    }
    if variable.choices:
        return data | {"choices": variable.choices}
    numbers = {key: getattr(variable, key) for key in ("low", "high", "step", "log", "size")}
    return (
        data
        | numbers
        | own
        | {
            "unit": variable.unit,
            "spoken": _SPOKEN[variable.unit],
            "units": _units(name),
        }
    )


def variables_data(names: Iterable[str]) -> dict[str, Any]:
    """Return some of VARIABLES as `variable_data`, by name."""
    return {name: variable_data(name) for name in names}


def _units(name: str) -> dict[str, float]:
    """Return the units in which a variable may be typed, with their sizes."""
    variable = VARIABLES[name]
    if not variable.unit:
        return {"": 1.0}
    kind = dimension(variable.symbol)
    known = [variable.unit, *DIMENSIONS[kind].units.split(", ")]
    return {unit: parse(name, f"1 {unit}", kind) for unit in dict.fromkeys(known)}
