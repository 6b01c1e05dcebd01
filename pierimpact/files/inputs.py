"""The keys of a case file: what each may be, and the one-line errors where it is not."""

import datetime
from collections.abc import Callable, Mapping
from typing import Annotated, Any, Literal, TypeVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    PrivateAttr,
    ValidationError,
    ValidationInfo,
)

from pierimpact.checks import InputError, brief, known, not_negative, one_line, positive, told_from
from pierimpact.files.limits import possible
from pierimpact.pier.column import POISSON_RATIO
from pierimpact.pier.equivalent import DAMPING_RATIO
from pierimpact.symbols import BY_KEY, dimension
from pierimpact.units import in_us_units, parse

#: What is printed where no text is given.
NOT_GIVEN = "—"


def _named(convert: Callable[[str, Any], Any], typed: Any) -> BeforeValidator:
    """Return a validator that knows the key of its value, so that errors can name it.

    What a file has in its place is of the type `typed`.
    """

    def validate(value: Any, info: ValidationInfo) -> Any:
        return convert(str(info.field_name), value)

    return BeforeValidator(validate, json_schema_input_type=typed)


def _length(name: str, value: Any) -> float:
    return parse(name, value, "length")


def _quantity(name: str, value: Any) -> float:
    return possible(name, parse(name, value, dimension(BY_KEY[name])), value)


def _share(name: str, value: Any) -> float:
    if not 0.0 < (result := _plain_number(name, value)) <= 1.0:
        raise InputError(f"{name} must lie above 0 to 1, got {told_from(result, 1.0)}")
    return result


def _plain_number(name: str, value: Any) -> float:
    if isinstance(value, bool | str):
        raise InputError(f"{name} must be a plain number without unit, got {brief(value)}")
    return not_negative(name, value)


def _factor(name: str, value: Any) -> float:
    return possible(name, positive(name, _plain_number(name, value)), value)


def _damping_ratio(name: str, value: Any) -> float:
    if (result := _plain_number(name, value)) >= 1.0:
        raise InputError(f"{name} must be below 1, got {told_from(result, 1.0)}")
    return result


def _poisson_ratio(name: str, value: Any) -> float:
    if (result := _plain_number(name, value)) > 0.5:
        raise InputError(f"{name} must be at most 0.5, got {told_from(result, 0.5)}")
    return result


def is_auto(value: Any) -> bool:
    """Say whether an impact height is to be both nominal ones."""
    return isinstance(value, str) and value.strip().lower() == "auto"


def _impact_height(name: str, value: Any) -> Any:
    return "auto" if is_auto(value) else _quantity(name, value)


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


def _annexes(name: str, value: Any) -> tuple[str, ...]:
    if value == "all":
        return ANNEXES
    if not isinstance(value, list | tuple):
        raise InputError(f"{name} must be all or a list ({', '.join(ANNEXES)}), got {brief(value)}")
    for annex in value:
        known(annex, ANNEXES, f"an annex ({', '.join(ANNEXES)})")
    return tuple(annex for annex in ANNEXES if annex in value)


def _date(name: str, value: Any) -> datetime.date:
    try:
        return value if type(value) is datetime.date else datetime.date.fromisoformat(value)
    except (TypeError, ValueError):
        raise InputError(f"{name} must be a date such as 2026-01-31, got {brief(value)}") from None


Text = Annotated[str, _named(_text, str)]
Date = Annotated[datetime.date, _named(_date, datetime.date)]
Quantity = Annotated[float, _named(_quantity, str)]
Factor = Annotated[float, _named(_factor, Annotated[float, Field(gt=0.0)])]
#: The annexes of the sheet, in its order.
ANNEXES = (
    *("pier", "procedure", "truck", "codes", "sensitivity"),
    *("nomenclature", "provenance", "changes"),
)
_MOST_REVISIONS = 8  # what the first page has room for
EndCondition = Literal["fixed", "pinned", "free"]


class SectionInputs(BaseModel):
    """The keys of a cross-section, in SI units; None where a key is not given."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    column_shape: Literal[
        "circular",
        "rectangular",
        "hollow circular",
        "hollow rectangular",
        "oblong",
        "polygonal",
        "filled circular",
        "filled rectangular",
        "free",
    ]
    column_diameter: Quantity | None = None
    column_width: Quantity | None = None
    column_depth: Quantity | None = None
    column_wall_thickness: Quantity | None = None
    column_sides: Factor | None = None
    column_across_flats: Quantity | None = None
    column_area: Quantity | None = None
    column_second_moment: Quantity | None = None
    column_shear_area: Quantity | None = None
    modular_ratio: Factor | None = None
    density_ratio: Factor | None = None


class StepInputs(SectionInputs):
    """The keys of a change of the cross-section, or of its resistances."""

    height: Annotated[float, _named(_length, str)]
    shear_resistance: Quantity | None = None
    moment_resistance: Quantity | None = None


class RevisionInputs(BaseModel):
    """The keys of a line of the table of revisions."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    revision: Text
    date: Date
    description: Text = NOT_GIVEN
    by: Text = NOT_GIVEN


_Item = TypeVar("_Item", StepInputs, RevisionInputs)


def _items(name: str, value: Any, model: type[_Item], of: str, kind: str) -> tuple[_Item, ...]:
    """Return a list of mappings as a model each; `of` and `kind` say what they are, in errors."""
    if not isinstance(value, list | tuple) or not all(isinstance(item, dict) for item in value):
        raise InputError(f"{name} must be a list of {of}, got {brief(value)}")
    items = []
    for number, item in enumerate(value, 1):
        for key in item:
            known(key, model.model_fields, f"a key of a {kind}")
        try:
            items.append(model(**item))
        except ValidationError as error:
            raise InputError(f"{name}[{number}].{_one_line(error)}") from None
    return tuple(items)


def _steps(name: str, value: Any) -> tuple[StepInputs, ...]:
    return _items(name, value, StepInputs, "heights with the keys of their sections", "step")


def _revisions(name: str, value: Any) -> tuple[RevisionInputs, ...]:
    keys = ", ".join(RevisionInputs.model_fields)
    revisions = _items(name, value, RevisionInputs, f"revisions with {keys}", "revision")
    if len(revisions) > _MOST_REVISIONS:
        raise InputError(f"{name} must be at most {_MOST_REVISIONS}, got {len(revisions)}")
    return revisions


_REVISIONS = Annotated[list[RevisionInputs], Field(max_length=_MOST_REVISIONS)]


class SharedInputs(BaseModel):
    """The keys that the cases of an office may share."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    office: Text = NOT_GIVEN
    logo: Text | None = None
    project: Text = NOT_GIVEN
    job_number: Text = NOT_GIVEN
    prepared_by: Text = NOT_GIVEN
    checked_by: Text = NOT_GIVEN
    approved_by: Text = NOT_GIVEN
    units: Literal["SI", "US"] = "SI"


class Inputs(SharedInputs, SectionInputs):
    """The keys of a case file, in SI units; None where a key is not given and has no default."""

    element: Text = NOT_GIVEN
    revision: Text = NOT_GIVEN
    date: Date = Field(default_factory=datetime.date.today)
    column_height: Quantity
    elastic_modulus: Quantity | None = None
    concrete_strength: Quantity | None = None
    poisson_ratio: Annotated[
        float, _named(_poisson_ratio, Annotated[float, Field(ge=0.0, le=0.5)])  # exactly
    ] = POISSON_RATIO
    density: Quantity
    stiffness_factor: Factor | None = None
    effective_stiffness: Quantity | None = None
    base: EndCondition
    top: EndCondition
    base_stiffness: Quantity | None = None
    base_rotation_stiffness: Quantity | None = None
    top_stiffness: Quantity | None = None
    top_rotation_stiffness: Quantity | None = None
    top_mass: Quantity | None = None
    embedment: Quantity | None = None
    steps: Annotated[tuple[StepInputs, ...], _named(_steps, list[StepInputs])] = ()
    truck: Text
    truck_mass: Quantity | None = None
    speed: Quantity
    impact_height: Annotated[float | Literal["auto"], _named(_impact_height, str)]
    damping_ratio: Annotated[
        float, _named(_damping_ratio, Annotated[float, Field(ge=0.0, lt=1.0)])
    ] = DAMPING_RATIO
    shear_resistance: Quantity | None = None
    moment_resistance: Quantity | None = None
    member_forces: Literal["larger", "beam", "static"] = "larger"
    traffic_volume: Quantity | None = None
    truck_share: Annotated[
        float | None, _named(_share, Annotated[float, Field(gt=0.0, le=1.0)])
    ] = None
    distance_from_road: Quantity | None = None
    exposed_width: Quantity | None = None
    encroachment_rate: Quantity | None = None
    traffic_mass: Text | None = None
    traffic_speed: Text | None = None
    traffic_deceleration: Text | None = None
    traffic_angle: Text | None = None
    weigh_in_motion: Text | None = None
    traffic_trucks: Annotated[tuple[str, ...], _named(_texts, list[str])] = ()
    assumed: Annotated[dict[str, str], _named(_texts_by_key, dict[str, str])] = {}
    sources: Annotated[dict[str, str], _named(_texts_by_key, dict[str, str])] = {}
    notes: Annotated[tuple[str, ...], _named(_texts, list[str])] = ()
    revisions: Annotated[tuple[RevisionInputs, ...], _named(_revisions, _REVISIONS)] = ()
    supersedes: Text | None = None
    annexes: Annotated[tuple[str, ...], _named(_annexes, list[str])] = ()

    # Which is no key, and lost where inputs are not from `read_inputs`.
    _strength_in_psi: bool = PrivateAttr(default=False)

    @property
    def concrete_system(self) -> str:
        """System of the unit that the concrete's strength is given in: "SI" or "US"."""
        return "US" if self._strength_in_psi else "SI"

    @property
    def revision_date(self) -> datetime.date | None:
        """Date of this revision in the table of revisions; None if it has no line there."""
        dates = {line.revision: line.date for line in self.revisions}
        return dates.get(self.revision)


KEYS = tuple(Inputs.model_fields)
#: Keys whose source a case file can give, or that it can mark as assumed.
PHYSICAL_KEYS = tuple(key for key in KEYS if key in BY_KEY)


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
    if "date" not in given and inputs.revision_date:
        inputs = inputs.model_copy(update={"date": inputs.revision_date})
    inputs._strength_in_psi = in_us_units(given.get("concrete_strength"))
    return inputs


def read_shared(values: Mapping[str, object], file: str) -> SharedInputs:
    """Return the inputs that a file gives to the cases beside it; errors as in `read_inputs`."""
    for key in values:
        known(
            key,
            SharedInputs.model_fields,
            f"a key of {file} ({', '.join(SharedInputs.model_fields)})",
        )
    try:
        return SharedInputs(**values)  # type: ignore[arg-type]
    except ValidationError as error:
        raise InputError(_one_line(error)) from None


def faults(values: Mapping[str, object]) -> dict[str, str]:
    """Return what is wrong with keys and values, a line for each key at fault.

    The lines are those of `read_inputs`, which ends with the first. What two keys say against each
    other is left to the reader of the case.
    """
    found: dict[str, str] = {}
    given: dict[str, Any] = {}
    for key, value in values.items():
        try:
            known(key, KEYS, "a key of a case file")
        except InputError as error:
            found[key] = str(error)
        else:
            given |= {} if value is None else {key: value}
    try:
        Inputs(**given)
    except ValidationError as error:
        found |= {str(each["loc"][0]): _in_words(each) for each in reversed(error.errors())}
    return found


def _one_line(error: ValidationError) -> str:
    """Return the first of pydantic's errors in the words of this project."""
    return _in_words(error.errors()[0])


def _in_words(first: Any) -> str:
    """Return an error of pydantic's in the words of this project."""
    key = first["loc"][0]
    if first["type"] == "value_error":
        return str(first["ctx"]["error"])
    if first["type"] == "missing":
        return f"{key} is missing"
    if first["type"] == "literal_error":
        return f"{key} must be {first['ctx']['expected']}, got {brief(first['input'])}"
    return f"{key}: {first['msg']}, got {brief(first['input'])}"
