"""The explorer as one HTML file that needs neither Python nor a network.

Its explorer is that of the notebooks (`browser`); the modules `questions` and `predictions`
have what is asked, and `page` the page itself.
"""

import base64
import hashlib
import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

import pierimpact
from pierimpact.checks import InputError, brief
from pierimpact.files.trucks import MassRange, TruckFile, read_truck_file
from pierimpact.files.unchanged import write_unchanged
from pierimpact.pier.equivalent import DAMPING_RATIO
from pierimpact.resources import shipped
from pierimpact.symbols import BY_KEY
from pierimpact.teaching.browser import EXPLORER, script, stylesheet, truck_data, variable_data
from pierimpact.vehicle.truck import QUANTITIES

PIER_MASS = 8e3  # of all piers on the page, as in the lessons on spectra [kg]
# Frequencies on the page, with the one at first in their middle [Hz], and speeds [km/h].
_FREQUENCIES, _FREQUENCY = (5.0, 180.0), 30.0
_NOTCHES = 180  # of the slider of frequencies
_SPEEDS, _SPEED = (30.0, 120.0), 80.0
_MASS_STEP = 500.0  # [kg]
_MASSES = (0.75, 1.5)  # of a truck of which nothing more is known, as shares of its own mass


def write_page(
    path: str | Path,
    trucks: Sequence[str | Path] = ("single-unit-8t",),
    *,
    force: bool = False,
) -> Path:
    """Write the page and return its path.

    Parameters
    ----------
    path : str or Path
        File to write; it must end in .html.
    trucks : sequence of str or Path, optional
        Trucks to choose from: names of the catalogue or paths of truck files. The first is on show
        at first, and the predictions are about it.
    force : bool, optional
        Whether to replace a file that somebody changed since it was written.

    Raises
    ------
    InputError
        When the path does not end in .html or cannot be written to, when somebody changed the
        file, when a truck cannot be read, or when two have the same name; nothing is written.
    """
    path = Path(path)
    if path.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"page must be the name of an .html file, got {brief(str(path))}")
    if not path.parent.is_dir():
        raise InputError(f"{path} cannot be written to: there is no folder {path.parent}")
    content = page([read_truck_file(truck) for truck in trucks]).encode()
    write_unchanged({path.name: content}, path.parent, force=force)
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
    sheet = stylesheet("explorer", "page")
    program = script(*EXPLORER, "questions", "predictions", "page")
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


def _data(trucks: Sequence[TruckFile]) -> dict[str, Any]:
    low, high = _FREQUENCIES
    masses = _masses(trucks[0])
    step = math.log10(high / low) / _NOTCHES
    mass = {end: 1e-3 * masses[end] for end in ("low", "high", "step")}
    variables = {
        "pier_frequency": variable_data("pier_frequency", low=low, high=high, step=step),
        "speed": variable_data("speed", low=_SPEEDS[0], high=_SPEEDS[1]),
        "truck_mass": variable_data("truck_mass", **mass),
    }
    for variable in variables.values():
        del variable["units"], variable["symbol"]  # nothing to type in, and no symbols
    values = {
        "pier_frequency": _FREQUENCY,
        "pier_mass": PIER_MASS,
        "damping_ratio": DAMPING_RATIO,
        "speed": _SPEED / 3.6,
        "truck_mass": masses["first"],
    }
    return {
        "trucks": [truck_data(file.truck) | {"masses": _masses(file)} for file in trucks],
        "pier": {"mass": PIER_MASS, "dampingRatio": DAMPING_RATIO},
        "setup": {
            "id": "",
            "variables": variables,
            "values": values,
            "above": ["pier_frequency"],
            "side": ["speed", "truck_mass"],
            "drawers": {},
            "spectra": True,
            "range": {"low": low, "high": high},
        },
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
        spread = "none given" if parameter.name in QUANTITIES else "–"
        if parameter.spread:
            source = f", {parameter.spread_source}" if parameter.spread_source else ""
            spread = f"{parameter.spread.words}{source}"
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
    spreads = {(file[name].spread, file[name].spread_source) for name in QUANTITIES}
    if not any(spread for spread, _ in spreads):
        return "Its file does not say how far its parameters may be off."
    if len(spreads) > 1:
        return "Its parameters have spreads of their own: trust the trend, not the numbers."
    ((spread, source),) = spreads
    off = f"{spread.words if spread else ''}{f' ({source})' if source else ''}"
    return f"Any of its parameters may be off by {off}: trust the trend, not the numbers."


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
