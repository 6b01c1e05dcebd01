"""Truck files: every parameter with its value, unit, source and status."""

import hashlib
import tomllib
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pierimpact.checks import InputError, number, one_line, one_of
from pierimpact.resources import shipped
from pierimpact.units import brief, nearest, parse
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.truck import Truck

#: How sure a value is; everything but "read" is to be checked by whoever relies on it.
STATUSES = ("read", "secondary", "recalled", "calibrated", "assumed", "illustrative")

_CATALOGUE = shipped("trucks")
_HEADINGS = ("name", "description", "source", "status")
_DIMENSIONS = {
    "engine_mass": "mass",
    "body_mass": "mass",
    "friction_force": "force",
    "friction_on": None,
    **{
        f"{spring}.{name}": dimension
        for spring in ("engine_spring", "body_spring")
        for name, dimension in (
            ("plateau_force", "force"),
            ("plateau_length", "length"),
            ("stiffness", "stiffness"),
            ("unloading_stiffness", "stiffness"),
        )
    },
}


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """One parameter of a truck file.

    Parameters
    ----------
    name : str
        Its key, such as "engine_spring.stiffness".
    value : float or str
        In SI units, or a word.
    given : str
        As the file has it, with its unit.
    source, status : str
        Where it comes from, and how sure it is.
    """

    name: str
    value: float | str
    given: str
    source: str
    status: str


@dataclass(frozen=True, kw_only=True)
class TruckFile:
    """A truck, with all that its file says about it.

    Parameters
    ----------
    truck : Truck
        The truck.
    description, source, status : str
        What the file says of the truck as a whole.
    parameters : tuple of Parameter
        Its parameters, in the order of `Truck` and `CrushSpring`.
    file_name : str
        Name of the file, without its folder.
    sha256 : str
        SHA-256 of the file's bytes, in hexadecimal.
    """

    truck: Truck
    description: str
    source: str
    status: str
    parameters: tuple[Parameter, ...]
    file_name: str
    sha256: str

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

    Parameters
    ----------
    name_or_path : str or Path
        Name in the catalogue, or path of a truck file (ending in .toml).
    folder : str or Path, optional
        Folder that a relative path starts from.

    Raises
    ------
    InputError
        When there is no such truck, or its file breaks a rule.
    """
    text = str(name_or_path)
    if text in truck_names():
        return _read(_CATALOGUE / f"{text}.toml")
    if not text.endswith(".toml"):
        near = nearest(text, truck_names())
        hint = f"; did you mean {near}?" if near else ""
        raise InputError(
            f"truck must be a name of the catalogue ({', '.join(truck_names())}) or the path of "
            f"a .toml file, got {brief(text)}{hint}"
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
        return _validated(table, path.name, hashlib.sha256(content).hexdigest())
    except InputError as error:
        raise InputError(f"truck file {path.name}: {error}") from None


def _validated(table: dict[str, Any], file_name: str, sha256: str) -> TruckFile:
    entries = {name: table.pop(name, None) for name in _HEADINGS}
    for name, value in entries.items():
        if not (isinstance(value, str) and value.strip()):
            raise InputError(f"{name} must be text, got {brief(value)}")
        one_line(name, value)
    one_of("status", entries["status"], STATUSES)
    for spring in ("engine_spring", "body_spring"):
        parameters = table.pop(spring, None)
        if not isinstance(parameters, dict):
            raise InputError(f"{spring} must be a table of its parameters, got {brief(parameters)}")
        table |= {f"{spring}.{name}": value for name, value in parameters.items()}
    _only_known(table, _DIMENSIONS, "a truck parameter")
    parameters = {name: _parameter(name, table.get(name)) for name in _DIMENSIONS}
    values = {name: parameter.value for name, parameter in parameters.items()}
    springs = {}
    for spring in ("engine_spring", "body_spring"):
        try:
            springs[spring] = CrushSpring(
                **{n: values.pop(f"{spring}.{n}") for n in CrushSpring.__dataclass_fields__}
            )
        except InputError as error:
            raise InputError(f"{spring}.{error}") from None
    truck = Truck(name=entries["name"], source=entries["source"], **springs, **values)  # type: ignore[arg-type]
    return TruckFile(
        truck=truck,
        description=entries["description"],
        source=entries["source"],
        status=entries["status"],
        parameters=tuple(parameters.values()),
        file_name=file_name,
        sha256=sha256,
    )


def _parameter(name: str, entry: object) -> Parameter:
    if not isinstance(entry, dict):
        raise InputError(
            f"{name} must be a table with value, unit, source and status, got {brief(entry)}"
        )
    dimension = _DIMENSIONS[name]
    keys = ("value", "unit", "source", "status") if dimension else ("value", "source", "status")
    _only_known(
        {f"{name}.{key}": None for key in entry}, [f"{name}.{key}" for key in keys], "a key"
    )
    for key in keys:
        if key not in entry:
            raise InputError(f"{name}.{key} is missing")
        if key != "value":
            if not (isinstance(entry[key], str) and entry[key].strip()):
                raise InputError(f"{name}.{key} must be text, got {brief(entry[key])}")
            one_line(f"{name}.{key}", entry[key])
    one_of(f"{name}.status", entry["status"], STATUSES)
    value: float | str
    if dimension is None:
        value = given = str(entry["value"])
    else:
        if isinstance(entry["value"], bool | str):
            raise InputError(f"{name}.value must be a number, got {brief(entry['value'])}")
        given = f"{number(f'{name}.value', entry['value']):.15g} {entry['unit']}"
        value = parse(name, given, dimension)
    return Parameter(
        name=name, value=value, given=given, source=entry["source"], status=entry["status"]
    )


def _only_known(names: Iterable[str], known: Collection[str], kind: str) -> None:
    for name in names:
        if name not in known:
            near = nearest(name, known)
            raise InputError(f"{name} is not {kind}" + (f"; did you mean {near}?" if near else ""))
