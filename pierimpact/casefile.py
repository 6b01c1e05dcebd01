"""Case files: flat YAML, parsed with units and checked before anything runs."""

import datetime
import hashlib
import math
import unicodedata
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

import yaml
from pydantic import BaseModel, BeforeValidator, ConfigDict, ValidationError, ValidationInfo

from pierimpact.catalogue import TruckFile, read_truck_file
from pierimpact.checks import InputError, not_negative
from pierimpact.column import PierColumn
from pierimpact.sections import CircularSection, RectangularSection, Section
from pierimpact.truck import Truck
from pierimpact.units import brief, nearest, parse

#: Nominal impact heights of the source paper: without, and with, a cargo peak that counts [m].
LOW_IMPACT_HEIGHT, HIGH_IMPACT_HEIGHT = 1.05, 1.35


def _named(convert: Callable[[str, Any], Any]) -> BeforeValidator:
    """Return a validator that knows the key of its value, so that errors can name it."""
    return BeforeValidator(lambda value, info: convert(_key(info), value))


def _key(info: ValidationInfo) -> str:
    return str(info.field_name)


def _positive(dimension: str) -> BeforeValidator:
    def convert(name: str, value: Any) -> float:
        result = parse(name, value, dimension)
        if result <= 0.0:
            raise InputError(f"{name} must be positive, got {brief(value)}")
        return result

    return _named(convert)


def _plain_number(name: str, value: Any) -> float:
    if isinstance(value, bool | str):
        raise InputError(f"{name} must be a plain number without unit, got {brief(value)}")
    return not_negative(name, value)


def _damping_ratio(name: str, value: Any) -> float:
    if (result := _plain_number(name, value)) >= 1.0:
        raise InputError(f"{name} must be below 1, got {result:g}")
    return result


def _poisson_ratio(name: str, value: Any) -> float:
    if (result := _plain_number(name, value)) > 0.5:
        raise InputError(f"{name} must be at most 0.5, got {result:g}")
    return result


def _impact_height(name: str, value: Any) -> Any:
    return value if value == "auto" else parse(name, value, "length")


def _text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise InputError(f"{name} must be text (in quotes if it is a number), got {brief(value)}")
    if any(unicodedata.category(character) in ("Cc", "Cs", "Zl", "Zp") for character in value):
        raise InputError(f"{name} must be one line without control characters, got {brief(value)}")
    return value


def _texts(name: str, value: Any) -> tuple[str, ...]:
    if not isinstance(value, list | tuple):
        raise InputError(f"{name} must be a list of texts, got {brief(value)}")
    return tuple(_text(name, text) for text in value)


def _texts_by_key(name: str, value: Any) -> dict[str, str]:
    if not isinstance(value, dict):
        raise InputError(f"{name} must give a text for each key it lists, got {brief(value)}")
    for key in value:
        _only_known(name, key, PHYSICAL_KEYS)
    return {key: _text(f"{name}.{key}", text) for key, text in value.items()}


def _date(name: str, value: Any) -> datetime.date:
    try:
        return value if type(value) is datetime.date else datetime.date.fromisoformat(value)
    except (TypeError, ValueError):
        raise InputError(f"{name} must be a date such as 2026-01-31, got {brief(value)}") from None


Text = Annotated[str, _named(_text)]
Length = Annotated[float, _positive("length")]
Mass = Annotated[float, _positive("mass")]
Force = Annotated[float, _positive("force")]
Moment = Annotated[float, _positive("moment")]
Pressure = Annotated[float, _positive("pressure")]
Density = Annotated[float, _positive("density")]
Speed = Annotated[float, _positive("speed")]
EndCondition = Literal["fixed", "pinned", "free"]


class Inputs(BaseModel):
    """The keys of a case file, in SI units; None where a key is not given and has no default."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    project: Text = "—"
    job_number: Text = "—"
    element: Text = "—"
    prepared_by: Text = "—"
    checked_by: Text = "—"
    revision: Text = "—"
    date: Annotated[datetime.date | None, _named(_date)] = None
    column_shape: Literal["circular", "rectangular"]
    column_diameter: Length | None = None
    column_width: Length | None = None
    column_depth: Length | None = None
    column_height: Length
    elastic_modulus: Pressure | None = None
    concrete_strength: Pressure | None = None
    poisson_ratio: Annotated[float, _named(_poisson_ratio)] = 0.2
    density: Density
    base: EndCondition
    top: EndCondition
    truck: Text
    truck_mass: Mass | None = None
    speed: Speed
    impact_height: Annotated[float | Literal["auto"], _named(_impact_height)]
    damping_ratio: Annotated[float, _named(_damping_ratio)] = 0.05
    units: Literal["SI", "US"] = "SI"
    shear_resistance: Force | None = None
    moment_resistance: Moment | None = None
    assumed: Annotated[dict[str, str], _named(_texts_by_key)] = {}
    sources: Annotated[dict[str, str], _named(_texts_by_key)] = {}
    notes: Annotated[tuple[str, ...], _named(_texts)] = ()


KEYS = tuple(Inputs.model_fields)
#: Parameters of the report notebook that are no keys of a case file.
NOTEBOOK_PARAMETERS = ("case_file", "case_sha256")
#: Keys whose source a case file can give, or that it can mark as assumed.
PHYSICAL_KEYS = tuple(
    key
    for key in KEYS[KEYS.index("column_shape") : KEYS.index("assumed")]
    if key not in ("truck", "units")
)


@dataclass(frozen=True, kw_only=True)
class Case:
    """A case that has passed every check, as objects of the core.

    Parameters
    ----------
    inputs : Inputs
        Values by key, in SI units.
    given : mapping of str to object
        What was typed, by key, for the keys that were given.
    column : PierColumn
        The pier.
    truck : Truck
        The truck, with the mass of the case.
    truck_file : TruckFile
        The file of the truck, with the source and status of each parameter.
    """

    inputs: Inputs
    given: Mapping[str, object]
    column: PierColumn
    truck: Truck
    truck_file: TruckFile

    @property
    def impact_heights(self) -> tuple[float, ...]:
        """Nominal impact heights the case may come to use [m]."""
        height = self.inputs.impact_height
        return (LOW_IMPACT_HEIGHT, HIGH_IMPACT_HEIGHT) if height == "auto" else (height,)


def read_case(path: str | Path) -> Case:
    """Return the case of a case file.

    Raises
    ------
    InputError
        When the file cannot be read or breaks a rule; the message is one line.
    """
    path = Path(path)
    try:
        return case_from(case_values(path), folder=path.parent)
    except InputError as error:
        raise InputError(f"{path.name}: {error}") from None


def case_values(path: Path) -> dict[str, object]:
    """Return the keys and values of a case file as YAML has them, unchecked."""
    try:
        values = yaml.load(path.read_bytes().decode("utf-8-sig"), _Loader)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError("is not UTF-8 text") from None
    except yaml.MarkedYAMLError as error:
        line = f"line {error.problem_mark.line + 1}: " if error.problem_mark else ""
        raise InputError(f"{line}not valid YAML: {error.problem}") from None
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        reason = str(error).partition("\n")[0]
        raise InputError(f"not valid YAML: {reason}") from None
    if not isinstance(values, dict):
        raise InputError(f"must be keys and values (key: value), got {brief(values)}")
    return values


def file_hash(path: Path) -> str:
    """Return the SHA-256 of a file's bytes, in hexadecimal."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def case_from(values: Mapping[str, object], folder: str | Path = ".") -> Case:
    """Return the case of keys and values as a case file has them; None counts as not given.

    Parameters
    ----------
    values : mapping of str to object
        Values as typed, by key.
    folder : str or Path, optional
        Folder that a relative path of a truck file starts from.

    Raises
    ------
    InputError
        When a key is unknown or missing, or a value breaks a rule.
    """
    for key in values:
        _only_known("", key, KEYS)
    given = {key: value for key, value in values.items() if value is not None}
    try:
        inputs = Inputs(**given)  # type: ignore[arg-type]
    except ValidationError as error:
        raise InputError(_one_line(error)) from None
    for key in (*inputs.assumed, *inputs.sources):
        if key not in given:
            raise InputError(f"{key} is listed under assumed or sources, but is not given")
    truck_file = read_truck_file(inputs.truck, folder)
    case = Case(
        inputs=inputs,
        given=given,
        column=_column(inputs),
        truck=_with_mass(truck_file.truck, inputs.truck_mass),
        truck_file=truck_file,
    )
    for impact_height in case.impact_heights:
        case.column.struck_at(impact_height)  # an error here is better than one halfway
    return case


def case_from_notebook(namespace: Mapping[str, object]) -> Case:
    """Return the case that a notebook's parameters describe.

    Every plain value among the notebook's variables is taken for a key, so that a misspelt one
    is found even though papermill passes it on.

    Parameters
    ----------
    namespace : mapping of str to object
        The notebook's variables, `globals()`.

    Raises
    ------
    InputError
        When a key is unknown or missing, or a value breaks a rule.
    """
    values = {
        name: value
        for name, value in namespace.items()
        if not name.startswith("_")
        and name not in (*NOTEBOOK_PARAMETERS, "In", "Out")
        and isinstance(value, str | int | float | list | dict | datetime.date | None)
    }
    return case_from(values)


def concrete_modulus(strength: float) -> float:
    """Elastic modulus E = 4700 √f_c' of normal-weight concrete, both in MPa, as in ACI 318.

    From memory, not read in the standard: unverified.

    Parameters
    ----------
    strength : float
        Compressive strength f_c' [Pa].

    Returns
    -------
    float
        Elastic modulus [Pa].
    """
    return 4700e6 * math.sqrt(strength / 1e6)


def _column(inputs: Inputs) -> PierColumn:
    if (inputs.elastic_modulus is None) == (inputs.concrete_strength is None):
        raise InputError("give one of elastic_modulus and concrete_strength")
    elastic_modulus = inputs.elastic_modulus or concrete_modulus(inputs.concrete_strength or 0.0)
    return PierColumn(
        height=inputs.column_height,
        section=_section(inputs),
        elastic_modulus=elastic_modulus,
        poisson_ratio=inputs.poisson_ratio,
        density=inputs.density,
        base=inputs.base,
        top=inputs.top,
    )


def _section(inputs: Inputs) -> Section:
    sizes = ("column_diameter", "column_width", "column_depth")
    wanted = sizes[:1] if inputs.column_shape == "circular" else sizes[1:]
    for key in sizes:
        if (getattr(inputs, key) is None) == (key in wanted):
            must = "is missing: it belongs" if key in wanted else "does not belong"
            raise InputError(f"{key} {must} to column_shape {inputs.column_shape}")
    if inputs.column_diameter is not None:
        return CircularSection(diameter=inputs.column_diameter)
    assert inputs.column_width is not None
    assert inputs.column_depth is not None
    return RectangularSection(width=inputs.column_width, depth=inputs.column_depth)


def _with_mass(truck: Truck, mass: float | None) -> Truck:
    if mass is None:
        return truck
    try:
        return truck.with_mass(mass)
    except InputError as error:  # the truck calls it mass
        raise InputError(f"truck_{error}") from None


def _only_known(where: str, key: object, known: tuple[str, ...]) -> None:
    if key not in known:
        near = nearest(str(key), known)
        hint = f"; did you mean {near}?" if near else ""
        kind = f"a key that {where} can list" if where else "a key of a case file"
        raise InputError(f"{brief(key)} is not {kind}{hint}")


def _one_line(error: ValidationError) -> str:
    """Return the first of pydantic's errors in the words of this project."""
    first = error.errors()[0]
    key = first["loc"][0]
    if first["type"] == "value_error":
        return str(first["ctx"]["error"])
    if first["type"] == "missing":
        return f"{key} is missing"
    if first["type"] == "literal_error":
        return f"{key} must be {first['ctx']['expected']}, got {brief(first['input'])}"
    return f"{key}: {first['msg']}, got {brief(first['input'])}"


class _Loader(yaml.SafeLoader):
    """YAML's safe loader, for which a key given twice is an error."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        keys = [self.construct_object(key, deep=True) for key, _ in node.value]
        for index, key in enumerate(keys):
            if key in keys[:index]:
                raise InputError(f"{key} is given twice")
        return super().construct_mapping(node, deep)
