"""Truck files: every parameter with its value, unit, source and status."""

import hashlib
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from pierimpact.certainty import Certainty
from pierimpact.checks import InputError, brief, did_you_mean, known, number, one_line, one_of
from pierimpact.resources import shipped
from pierimpact.symbols import BY_KEY, dimension
from pierimpact.units import parse
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.truck import Truck

_CATALOGUE = shipped("trucks")
# Words for the status of a parameter; a parameter cited in the source paper was read there.
_STATUSES = tuple(certainty for certainty in Certainty if certainty is not Certainty.CITED)
_SPRINGS = ("engine_spring", "body_spring")
_SPRING_PARAMETERS = tuple(CrushSpring.__dataclass_fields__)
_PARAMETERS = (
    *("engine_mass", "body_mass", "friction_force", "friction_on"),
    *(f"{spring}.{name}" for spring in _SPRINGS for name in _SPRING_PARAMETERS),
)


class Parameter(NamedTuple):
    """One parameter of a truck file."""

    name: str  #: its key, such as "engine_spring.stiffness"
    value: float | str  #: in SI units, or a word
    given: str  #: as the file has it, with its unit
    source: str
    status: Certainty


@dataclass(frozen=True, kw_only=True)
class TruckFile:
    """A truck, with all that its file says about it."""

    truck: Truck
    description: str
    source: str
    status: Certainty  #: of the truck as a whole
    parameters: tuple[Parameter, ...]  #: in the order of `Truck` and `CrushSpring`
    file_name: str  #: without its folder
    sha256: str  #: of the file's bytes, in hexadecimal

    def __getitem__(self, name: str) -> Parameter:
        """Return the parameter called `name`."""
        return next(parameter for parameter in self.parameters if parameter.name == name)


def truck_names() -> list[str]:
    """Return the names of the trucks in the catalogue."""
    return sorted(path.stem for path in _CATALOGUE.glob("*.toml"))


def load_truck(name_or_path: str | Path) -> Truck:
    """Return a truck of the catalogue by name, or a truck of one's own by the path of its file.

    Parameters
    ----------
    name_or_path : str or Path
        Name in the catalogue, or path of a truck file (ending in .toml).

    Raises
    ------
    InputError
        When there is no such truck, or its file breaks a rule.
    """
    return read_truck_file(name_or_path).truck


def read_truck_file(name_or_path: str | Path, folder: str | Path = ".") -> TruckFile:
    """Return a truck with the source and status of each of its parameters.

    Argument and errors as in `load_truck`; a relative path starts from `folder`.
    """
    text = str(name_or_path)
    if text in truck_names():
        return _read(_CATALOGUE / f"{text}.toml")
    if not text.endswith(".toml"):
        raise InputError(
            f"truck must be a name of the catalogue ({', '.join(truck_names())}) or the path of "
            f"a .toml file, got {brief(text)}{did_you_mean(text, truck_names())}"
        )
    return _read(Path(folder) / text)


def _read(path: Path) -> TruckFile:
    try:
        content = path.read_bytes()
        table = tomllib.loads(content.decode())
    except OSError as error:
        raise InputError(f"truck file {path} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"truck file {path} is not UTF-8 text") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"truck file {path} is not valid TOML: {error}") from None
    try:
        return _truck_file(table, path.name, hashlib.sha256(content).hexdigest())
    except InputError as error:
        raise InputError(f"truck file {path.name}: {error}") from None


def _truck_file(table: dict[str, Any], file_name: str, sha256: str) -> TruckFile:
    name, description, source, status = (
        _text(heading, table.pop(heading, None))
        for heading in ("name", "description", "source", "status")
    )
    certainty = _certainty("status", status)
    entries = _with_dotted_names(table)
    for key in entries:
        known(key, _PARAMETERS, "a truck parameter")
    parameters = tuple(_parameter(key, entries.get(key)) for key in _PARAMETERS)
    values: dict[str, Any] = {parameter.name: parameter.value for parameter in parameters}
    values |= {spring: _take_spring(spring, values) for spring in _SPRINGS}
    return TruckFile(
        truck=Truck(name=name, source=source, **values),
        description=description,
        source=source,
        status=certainty,
        parameters=parameters,
        file_name=file_name,
        sha256=sha256,
    )


def _with_dotted_names(table: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameters by their names, a spring's as "engine_spring.stiffness"."""
    entries = {key: entry for key, entry in table.items() if key not in _SPRINGS}
    for spring in _SPRINGS:
        parameters = table.get(spring)
        if not isinstance(parameters, dict):
            raise InputError(f"{spring} must be a table of its parameters, got {brief(parameters)}")
        entries |= {f"{spring}.{name}": entry for name, entry in parameters.items()}
    return entries


def _parameter(name: str, entry: object) -> Parameter:
    if not isinstance(entry, dict):
        raise InputError(
            f"{name} must be a table with value, unit, source and status, got {brief(entry)}"
        )
    kind = dimension(BY_KEY[name])  # none for a word
    keys = ("value", "unit", "source", "status") if kind else ("value", "source", "status")
    for key in entry:
        known(f"{name}.{key}", [f"{name}.{key}" for key in keys], "a key")
    for key in keys:
        if key not in entry:
            raise InputError(f"{name}.{key} is missing")
    value, texts = entry["value"], {key: _text(f"{name}.{key}", entry[key]) for key in keys[1:]}
    if not kind:
        value = given = str(value)
    elif isinstance(value, bool | str):
        raise InputError(f"{name}.value must be a number, got {brief(value)}")
    else:
        given = f"{number(f'{name}.value', value):.15g} {texts['unit']}"
        value = parse(name, given, kind)
    status = _certainty(f"{name}.status", texts["status"])
    return Parameter(name, value, given, texts["source"], status)


def _take_spring(spring: str, values: dict[str, Any]) -> CrushSpring:
    """Return a spring of its values, which are removed from `values`."""
    own = {name: values.pop(f"{spring}.{name}") for name in _SPRING_PARAMETERS}
    try:
        return CrushSpring(**own)
    except InputError as error:
        raise InputError(f"{spring}.{error}") from None


def _text(name: str, value: object) -> str:
    if not (isinstance(value, str) and value.strip()):
        raise InputError(f"{name} must be text, got {brief(value)}")
    return one_line(name, value)


def _certainty(name: str, word: str) -> Certainty:
    return Certainty(one_of(name, word, _STATUSES))
