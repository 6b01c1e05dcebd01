"""The explorer as one HTML file that needs neither Python nor a network.

Its program is the JavaScript modules in `templates/page`: `model` has the mechanics, `spectrum` and
`history` what is calculated with them, `chart` and `picture` what is drawn, `questions` the
predictions, and `page` the page itself. All but the last are pure functions that other pages may
import; here they are joined into one script.
"""

import base64
import hashlib
import json
import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

import pierimpact
from pierimpact.checks import InputError, brief
from pierimpact.files.trucks import MassRange, TruckFile, read_truck_file
from pierimpact.files.write import write_files
from pierimpact.pier.equivalent import DAMPING_RATIO
from pierimpact.plots import style
from pierimpact.resources import shipped
from pierimpact.symbols import BY_KEY
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.truck import Truck

#: The modules, each after those that it imports.
MODULES = ("model", "spectrum", "history", "chart", "picture", "questions", "page")
PIER_MASS = 8e3  # of all piers on the page, as in the lessons on spectra [kg]
# Frequencies on the page, with the one at first in their middle [Hz], and speeds [km/h].
_FREQUENCIES, _FREQUENCY = (5.0, 180.0), 30.0
_SPEEDS, _SPEED = (30.0, 120.0), 80.0
_MASS_STEP = 500.0  # [kg]
_MASSES = (0.75, 1.5)  # of a truck of which nothing more is known, as shares of its own mass


def write_page(path: str | Path, trucks: Sequence[str | Path] = ("single-unit-8t",)) -> Path:
    """Write the page and return its path.

    Parameters
    ----------
    path : str or Path
        File to write; it must end in .html.
    trucks : sequence of str or Path, optional
        Trucks to choose from: names of the catalogue or paths of truck files. The first is on show
        at first, and the predictions are about it.

    Raises
    ------
    InputError
        When the path does not end in .html or cannot be written to, when a truck cannot be read,
        or when two have the same name; nothing is written.
    """
    path = Path(path)
    if path.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"page must be the name of an .html file, got {brief(str(path))}")
    if not path.parent.is_dir():
        raise InputError(f"{path} cannot be written to: there is no folder {path.parent}")
    write_files({path: page([read_truck_file(truck) for truck in trucks]).encode()})
    return path


def page(trucks: Sequence[TruckFile]) -> str:
    """Return the page with these trucks to choose from.

    Raises
    ------
    InputError
        When there is none, or two have the same name.
    """
    names = [file.truck.name for file in trucks]
    if not names or len(set(names)) < len(names):
        raise InputError(f"trucks must have names of their own, got {', '.join(names) or 'none'}")
    templates = Environment(
        loader=FileSystemLoader(shipped("templates") / "page"),
        autoescape=True,
        undefined=StrictUndefined,
    )
    sheet = templates.get_template("page.css.j2").render(
        ink=style.INK,
        muted=style.MUTED,
        pale=style.PALE,
        engine=style.BODIES["engine"],
        cargo=style.BODIES["cargo"],
        cargo_dark=style.SKY,
    )
    program = script()
    return templates.get_template("page.html.j2").render(
        policy=f"default-src 'none'; script-src {_hash(program)}; style-src {_hash(sheet)}; "
        "base-uri 'none'; form-action 'none'",
        style=Markup(sheet),
        script=Markup(program),
        data=Markup(json.dumps(_data(trucks)).replace("<", "\\u003c")),
        trucks=[_words(file) for file in trucks],
        pier_mass=_tonnes(PIER_MASS),
        damping_ratio=f"{DAMPING_RATIO:g}",
        version=pierimpact.__version__,
    )


def script() -> str:
    """Return the modules joined into one script, each in a scope of its own."""
    folder = shipped("templates") / "page"
    return "".join(
        _scoped(name, (folder / f"{name}.mjs").read_text(encoding="utf-8")) for name in MODULES
    )


def _scoped(name: str, module: str) -> str:
    """Return a module as a function's body that returns what it exports."""
    exported = re.findall(r"^export (?:class|const|function\*?) (\w+)", module, re.MULTILINE)
    body = re.sub(r"^export ", "", module, flags=re.MULTILINE)
    imported = r'^import (\{.*\}) from "\./(\w+)\.mjs";$'
    body = re.sub(imported, r"const \1 = \2Module;", body, flags=re.MULTILINE)
    returned = ", ".join(exported)
    return f"const {name}Module = (() => {{\n{body}return {{ {returned} }};\n}})();\n"


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
    return {
        "mass": mass,
        "plateauForce": spring.plateau_force,
        "plateauLength": spring.plateau_length,
        "stiffness": spring.stiffness,
        "unloadingStiffness": spring.unloading_stiffness,
    }


def _data(trucks: Sequence[TruckFile]) -> dict[str, Any]:
    low, high = _FREQUENCIES
    return {
        "trucks": [truck_data(file.truck) | {"masses": _masses(file)} for file in trucks],
        "pier": {"mass": PIER_MASS, "dampingRatio": DAMPING_RATIO},
        "range": {"low": low, "high": high},
        "speeds": dict(zip(("low", "high"), _SPEEDS, strict=True)),
        "first": {"frequency": _FREQUENCY, "speed": _SPEED},
    }


def _masses(file: TruckFile) -> dict[str, float]:
    """Return from where to where the truck's mass goes, in steps about its own mass [kg]."""
    own = file.truck.mass
    low, high = file.mass_range[:2] if file.mass_range else [share * own for share in _MASSES]
    low = max(low, file.truck.engine_mass + _MASS_STEP)
    down, up = (math.floor(abs(end - own) / _MASS_STEP) for end in (min(low, own), high))
    return {
        "first": own,
        "low": own - down * _MASS_STEP,
        "high": own + up * _MASS_STEP,
        "step": _MASS_STEP,
    }


def _words(file: TruckFile) -> dict[str, Any]:
    """Return what the page says of a truck."""
    rows = []
    for parameter in file.parameters:
        spread = parameter.spread.words if parameter.spread else "none given"
        if isinstance(parameter.value, str):
            spread = "–"
        status = parameter.status.words
        heading = BY_KEY[parameter.name].heading
        rows.append((heading, parameter.given, spread, status, parameter.source))
    return {
        "name": file.truck.name,
        "status": file.status.words.capitalize(),
        "description": file.description,
        "source": file.source,
        "caution": _caution(file),
        "masses": _mass_words(file.mass_range),
        "rows": rows,
    }


def _caution(file: TruckFile) -> str:
    """Return how far the numbers of a truck may be off, in a sentence."""
    spreads = {parameter.spread.words for parameter in file.parameters if parameter.spread}
    if not spreads:
        return "Its file does not say how far its parameters may be off."
    if len(spreads) > 1:
        return "Its parameters have spreads of their own: trust the trend, not the numbers."
    return f"Any of its parameters may be off by {spreads.pop()}: trust the trend, not the numbers."


def _mass_words(masses: MassRange | None) -> str:
    if masses is None:
        return "Its file does not say for which masses its springs stand."
    low, high = (_tonnes(mass) for mass in masses[:2])
    return f"Its springs stand for a total mass from {low} to {high} ({masses.source})."


def _tonnes(mass: float) -> str:
    """Return a mass as the page prints it; one unit for a quantity."""
    return f"{1e-3 * mass:g} t"


def _hash(content: str) -> str:
    """Return the source expression by which a content security policy allows this content."""
    digest = hashlib.sha256(content.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"
