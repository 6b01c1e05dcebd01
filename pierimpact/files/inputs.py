"""The keys of a case file: what each may be, and the one-line errors where it is not."""

import datetime
from collections.abc import Callable, Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, ValidationError, ValidationInfo

from pierimpact.checks import InputError, brief, known, not_negative, one_line
from pierimpact.units import parse


def _named(convert: Callable[[str, Any], Any]) -> BeforeValidator:
    """Return a validator that knows the key of its value, so that errors can name it."""

    def validate(value: Any, info: ValidationInfo) -> Any:
        return convert(str(info.field_name), value)

    return BeforeValidator(validate)


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
    return one_line(name, value)


def _texts(name: str, value: Any) -> tuple[str, ...]:
    if not isinstance(value, list | tuple):
        raise InputError(f"{name} must be a list of texts, got {brief(value)}")
    return tuple(_text(name, text) for text in value)


def _texts_by_key(name: str, value: Any) -> dict[str, str]:
    if not isinstance(value, dict):
        raise InputError(f"{name} must give a text for each key it lists, got {brief(value)}")
    for key in value:
        known(key, PHYSICAL_KEYS, f"a key that {name} can list")
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
#: Keys whose source a case file can give, or that it can mark as assumed.
PHYSICAL_KEYS = tuple(
    key
    for key in KEYS[KEYS.index("column_shape") : KEYS.index("assumed")]
    if key not in ("truck", "units")
)


def read_inputs(values: Mapping[str, object]) -> Inputs:
    """Return the inputs of keys and values as typed; None counts as not given.

    Raises
    ------
    InputError
        When a key is unknown or missing, or a value breaks a rule.
    """
    for key in values:
        known(key, KEYS, "a key of a case file")
    given = {key: value for key, value in values.items() if value is not None}
    try:
        inputs = Inputs(**given)  # type: ignore[arg-type]
    except ValidationError as error:
        raise InputError(_one_line(error)) from None
    for key in (*inputs.assumed, *inputs.sources):
        if key not in given:
            raise InputError(f"{key} is listed under assumed or sources, but is not given")
    return inputs


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
