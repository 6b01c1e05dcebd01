"""Truck files: every parameter with its value, unit, source and status."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from pierimpact.certainty import Certainty
from pierimpact.checks import (
    InputError,
    brief,
    did_you_mean,
    known,
    number,
    one_line,
    one_of,
    shortened,
)
from pierimpact.files.limits import possible
from pierimpact.files.toml_table import TomlFile, read_toml
from pierimpact.resources import shipped
from pierimpact.symbols import BY_KEY, dimension
from pierimpact.units import parse
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.spread import Lognormal, Spread, Uniform
from pierimpact.vehicle.truck import PARAMETERS, SPRINGS, Truck

_CATALOGUE = shipped("trucks")
# Words for the status of a parameter; a parameter cited in the source paper was read there.
_STATUSES = tuple(certainty for certainty in Certainty if certainty is not Certainty.CITED)
_SPREADS = ("spread", "coefficient_of_variation", "low", "high")
_OF_SPREADS = ("spread_source", "spread_status")


class Parameter(NamedTuple):
    """One parameter of a truck file."""

    name: str  #: its key, such as "engine_spring.stiffness"
    value: float | str  #: in SI units, or a word
    given: str  #: as the file has it, with its unit
    source: str
    status: Certainty
    spread: Spread | None = None  #: None where the value counts as known
    spread_source: str = ""  #: empty where none is given
    spread_status: Certainty | None = None


class MassRange(NamedTuple):
    """The total masses that a truck's other parameters stand for."""

    low: float  #: [kg]
    high: float  #: [kg]
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
    text: str  #: of the file
    mass_range: MassRange | None = None

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

    Examples
    --------
    >>> from pierimpact import load_truck
    >>> load_truck("single-unit-8t").mass
    8000.0
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
        file = read_toml(path)
    except InputError as error:
        raise InputError(f"truck file {shortened(str(path), 200)} {error}") from None
    try:
        return _truck_file(file, path.name)
    except InputError as error:
        raise InputError(f"truck file {path.name}: {error}") from None


def _truck_file(file: TomlFile, file_name: str) -> TruckFile:
    table = file.table
    name, description, source, status = (
        _text(heading, table.pop(heading, None))
        for heading in ("name", "description", "source", "status")
    )
    certainty = _certainty("status", status)
    mass_range = _mass_range(table.pop("mass_range")) if "mass_range" in table else None
    entries = _with_dotted_names(table)
    for key in entries:
        known(key, PARAMETERS, "a truck parameter")
    parameters = tuple(_parameter(key, entries.get(key)) for key in PARAMETERS)
    values: dict[str, Any] = {parameter.name: parameter.value for parameter in parameters}
    values |= {spring: _take_spring(spring, values) for spring in SPRINGS}
    spread = {parameter.name: parameter.spread for parameter in parameters if parameter.spread}
    truck = Truck(
        name=name,
        source=source,
        spread=spread,
        mass_range=mass_range and mass_range[:2],
        **values,
    )
    if not truck.in_mass_range:
        raise InputError(f"mass_range must have the truck's own mass in it, {truck.mass:g} kg")
    return TruckFile(
        truck=truck,
        description=description,
        source=source,
        status=certainty,
        parameters=parameters,
        file_name=file_name,
        sha256=file.sha256,
        text=file.text,
        mass_range=mass_range,
    )


def _mass_range(entry: object) -> MassRange:
    keys = ("low", "high", "unit", "source", "status")
    if not isinstance(entry, dict) or entry.keys() != set(keys):
        raise InputError(f"mass_range must be a table with {', '.join(keys)}, got {brief(entry)}")
    unit, source, status = (_text(f"mass_range.{key}", entry[key]) for key in keys[2:])
    low, high = (
        parse(f"mass_range.{key}", f"{_number('mass_range', key, entry):.15g} {unit}", "mass")
        for key in keys[:2]
    )
    return MassRange(low, high, source, _certainty("mass_range.status", status))


def _with_dotted_names(table: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameters by their names, a spring's as "engine_spring.stiffness"."""
    entries = {key: entry for key, entry in table.items() if key not in SPRINGS}
    for key in entries:
        known(key, [name for name in PARAMETERS if "." not in name], "a truck parameter")
    for spring in SPRINGS:
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
    optional = (*_SPREADS, *_OF_SPREADS) if kind else ()
    for key in entry:
        known(f"{name}.{key}", [f"{name}.{key}" for key in (*keys, *optional)], "a key")
    for key in keys:
        if key not in entry:
            raise InputError(f"{name}.{key} is missing")
    value, texts = entry["value"], {key: _text(f"{name}.{key}", entry[key]) for key in keys[1:]}
    if not kind:
        value = given = str(value)
    else:
        given = f"{_number(name, 'value', entry):.15g} {texts['unit']}"
        value = possible(name, parse(name, given, kind), given)
    status = _certainty(f"{name}.status", texts["status"])
    return Parameter(name, value, given, texts["source"], status, *_spread(name, entry))


def _spread(name: str, entry: Mapping[str, Any]) -> tuple[Spread | None, str, Certainty | None]:
    """Return a parameter's spread with its source and status, as far as its table gives them."""
    given = {key: _number(name, key, entry) for key in _SPREADS if key in entry}
    source, status = (
        _text(f"{name}.{key}", entry[key]) if key in entry else "" for key in _OF_SPREADS
    )
    if not given:
        if source or status:
            raise InputError(f"{name} has a spread_source or spread_status but no spread")
        return None, "", None
    certainty = _certainty(f"{name}.spread_status", status) if status else None
    return _distribution(name, float(entry["value"]), given), source, certainty


def _distribution(name: str, value: float, given: Mapping[str, float]) -> Spread:
    """Return the one spread that is given, of the value in its own unit."""
    if given.keys() not in ({"spread"}, {"coefficient_of_variation"}, {"low", "high"}):
        raise InputError(
            f"{name} must have one of spread, coefficient_of_variation, or low and high, "
            f"got {' and '.join(given)}"
        )
    if "low" in given:
        low, high = given["low"], given["high"]
        if not 0.0 <= low <= value <= high or value == 0.0:
            raise InputError(
                f"{name} must have 0 ≤ low ≤ value ≤ high and a value above 0, "
                f"got low {low:g}, value {value:g} and high {high:g}"
            )
        return Uniform(low / value, high / value)
    try:
        return Uniform.about(given["spread"]) if "spread" in given else Lognormal(**given)
    except InputError as error:
        raise InputError(f"{name}.{error}") from None


def _number(name: str, key: str, entry: Mapping[str, Any]) -> float:
    if isinstance(entry[key], bool | str):
        raise InputError(f"{name}.{key} must be a number, got {brief(entry[key])}")
    return number(f"{name}.{key}", entry[key])


def _take_spring(spring: str, values: dict[str, Any]) -> CrushSpring:
    """Return a spring of its values, which are removed from `values`."""
    own = {name: values.pop(f"{spring}.{name}") for name in CrushSpring.__dataclass_fields__}
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
