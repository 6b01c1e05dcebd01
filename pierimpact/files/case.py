"""Case files: flat YAML, parsed with units and checked before anything runs."""

import datetime
import hashlib
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from pierimpact.checks import InputError, shortened
from pierimpact.design.reaction import HIGH_IMPACT_HEIGHT, LOW_IMPACT_HEIGHT
from pierimpact.files.inputs import Inputs, SectionInputs, read_inputs
from pierimpact.files.limits import LEAST_PART, POSSIBLE
from pierimpact.files.office import Logo, read_logo, read_shared_file
from pierimpact.files.reading import read_text
from pierimpact.files.traffic import CaseTraffic, traffic_of
from pierimpact.files.trucks import TruckFile, read_truck_file
from pierimpact.files.yaml_keys import yaml_keys
from pierimpact.pier.column import PierColumn, Step
from pierimpact.pier.sections import (
    CircularSection,
    FilledCircularSection,
    FilledRectangularSection,
    FreeSection,
    HollowCircularSection,
    HollowRectangularSection,
    OblongSection,
    RectangularSection,
    RegularPolygonSection,
    Section,
)
from pierimpact.symbols import SYMBOLS
from pierimpact.units import unit_size
from pierimpact.vehicle.truck import Truck

_MOST = 64_000  # bytes; a longer file is none of ours: this project's choice
#: Parameters of the report notebook that are no keys of a case file.
NOTEBOOK_PARAMETERS = ("case_file", "case_sha256", "shared_sha256")
#: Sections by column_shape.
SHAPES: dict[str, type[Section]] = {
    "circular": CircularSection,
    "rectangular": RectangularSection,
    "hollow circular": HollowCircularSection,
    "hollow rectangular": HollowRectangularSection,
    "oblong": OblongSection,
    "polygonal": RegularPolygonSection,
    "filled circular": FilledCircularSection,
    "filled rectangular": FilledRectangularSection,
    "free": FreeSection,
}


@dataclass(frozen=True, kw_only=True)
class Case:
    """A case that has passed every check, as objects of the core."""

    inputs: Inputs  #: values by key, in SI units
    given: Mapping[str, object]  #: what was typed, by key, for the keys that were given
    column: PierColumn
    truck: Truck  #: with the mass of the case
    truck_file: TruckFile  #: with the source and status of each parameter
    traffic: CaseTraffic | None = None
    logo: Logo | None = None
    #: SHA-256 of the `pierimpact.toml` that gave some of the values; None where there is none.
    shared_sha256: str | None = None
    #: The case file that this case supersedes; its own is not read.
    superseded_file: "CaseFile | None" = None

    @property
    def superseded(self) -> "Case | None":
        """The case that this case supersedes."""
        return None if self.superseded_file is None else self.superseded_file.case

    @property
    def annexes(self) -> tuple[str, ...]:
        """The annexes to be printed: those asked for, and the changes where there are any."""
        asked = tuple(name for name in self.inputs.annexes if name != "changes")
        return asked if self.superseded_file is None else (*asked, "changes")

    @property
    def impact_heights(self) -> tuple[float, ...]:
        """Nominal impact heights the case may come to use [m]."""
        height = self.inputs.impact_height
        return (LOW_IMPACT_HEIGHT, HIGH_IMPACT_HEIGHT) if height == "auto" else (height,)


@dataclass(frozen=True, kw_only=True)
class CaseFile:
    """A case file, read once: what it says, and the case that it gives."""

    name: str  #: without its folder
    sha256: str  #: of the file's bytes, in hexadecimal
    values: Mapping[str, object]  #: by key, as YAML and `pierimpact.toml` have them
    case: Case

    @property
    def parameters(self) -> dict[str, Any]:
        """The parameters of the report's notebook, as plain values."""
        values: dict[str, Any] = _with_plain_dates(self.values)
        return values | {
            "case_file": self.name,
            "case_sha256": self.sha256,
            "shared_sha256": self.case.shared_sha256,
        }


def _with_plain_dates(value: Any) -> Any:
    """Return a value with its dates as text, which JSON has no other way for."""
    if isinstance(value, Mapping):
        return {key: _with_plain_dates(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_with_plain_dates(item) for item in value]
    return value.isoformat() if isinstance(value, datetime.date) else value


def read_case_file(path: str | Path) -> CaseFile:
    """Return a case file with its case.

    What it does not give, a `pierimpact.toml` in its folder may.

    Raises
    ------
    InputError
        When a file cannot be read or breaks a rule; the message is one line.
    """
    return _read(Path(path), follow=True)


def _read(path: Path, *, follow: bool) -> CaseFile:
    """Return a case file; with the one that it supersedes, if any, where `follow` is true."""
    try:
        content, text = read_text(path, _MOST)
        values = yaml_keys(text)
        shared = read_shared_file(path.parent)
        if shared is not None:
            own = {key: value for key, value in values.items() if value is not None}
            values = values | shared.values | own
        shared_sha256 = None if shared is None else shared.sha256
        case = _case(values, path.parent, shared_sha256, path.name, follow=follow)
    except InputError as error:
        raise InputError(f"{shortened(path.name, 100)}: {error}") from None
    sha256 = hashlib.sha256(content).hexdigest()
    return CaseFile(name=path.name, sha256=sha256, values=values, case=case)


def case_from(values: Mapping[str, object], folder: str | Path = ".") -> Case:
    """Return the case of keys and values as a case file has them; None counts as not given.

    Relative paths, of a truck file, a logo or the case superseded, start from `folder`.

    Raises
    ------
    InputError
        When a key is unknown or missing, or a value breaks a rule.
    """
    return _case(values, Path(folder))


def _case(
    values: Mapping[str, object],
    folder: Path,
    shared_sha256: str | None = None,
    file_name: str | None = None,
    *,
    follow: bool = True,
) -> Case:
    inputs = read_inputs(values)
    truck_file = read_truck_file(inputs.truck, folder)
    truck = truck_file.truck
    case = Case(
        inputs=inputs,
        given={key: value for key, value in values.items() if value is not None},
        column=_column(inputs),
        truck=truck if inputs.truck_mass is None else with_mass(truck, inputs.truck_mass),
        truck_file=truck_file,
        traffic=traffic_of(inputs, truck_file, folder),
        logo=None if inputs.logo is None else read_logo(inputs.logo, folder),
        shared_sha256=shared_sha256,
        superseded_file=_superseded(inputs.supersedes, folder, file_name) if follow else None,
    )
    for impact_height in case.impact_heights:  # an error here is better than one halfway
        try:
            case.column.struck_at(impact_height)
        except InputError as error:
            if inputs.impact_height == "auto":
                raise InputError(
                    f"impact_height may not be auto here: by the rule, {error}"
                ) from None
            raise
    _refuse_slivers(case)
    return case


def _refuse_slivers(case: Case) -> None:
    """Refuse parts of a column that are too short to be meant, and to be calculated."""
    column = case.column
    places = [0.0, *(step.height for step in column.steps), column.height]
    for number, (below, above) in enumerate(pairwise(places), 1):
        if above - below < LEAST_PART:
            raise InputError(
                f"steps[{min(number, len(column.steps))}].height must be {LEAST_PART:g} m at least "
                f"from the steps beside it and from the ends, got {above - below:g} m"
            )
    for height in case.impact_heights:
        for name, distance in (("base", height), ("top", column.height - height)):
            if 0.0 < distance < LEAST_PART:
                raise InputError(
                    f"impact_height must be {LEAST_PART:g} m at least from the {name}, got "
                    f"{distance:g} m"
                )


def _superseded(name: str | None, folder: Path, file_name: str | None) -> CaseFile | None:
    if name is None:
        return None
    path = folder / name
    own = None if file_name is None else os.path.realpath(folder / file_name)
    if os.path.realpath(path) == own:
        raise InputError(f"supersedes must be an earlier case file, got {name}, which is this one")
    try:
        return _read(path, follow=False)
    except InputError as error:
        raise InputError(f"supersedes {error}") from None


def case_from_notebook(namespace: Mapping[str, object]) -> Case:
    """Return the case that a notebook's parameters describe.

    Every plain value among the notebook's variables is taken for a key, so that a misspelt one
    is found even though papermill passes it on. Errors as in `case_from`.

    Parameters
    ----------
    namespace : mapping of str to object
        The notebook's variables, `globals()`.
    """
    values = {
        name: value
        for name, value in namespace.items()
        if not name.startswith("_")
        and name not in (*NOTEBOOK_PARAMETERS, "In", "Out")
        and isinstance(value, str | int | float | list | dict | datetime.date | None)
    }
    file_name, shared_sha256 = (namespace.get(key) for key in ("case_file", "shared_sha256"))
    return _case(
        values,
        Path(),
        shared_sha256 if isinstance(shared_sha256, str) else None,
        file_name if isinstance(file_name, str) else None,
    )


#: Factors of the formula of ACI 318 for the elastic modulus of normal-weight concrete, E over the
#: root of the strength, both in MPa or both in psi: from memory, not read in the standard.
CONCRETE_FACTORS = {"SI": 4700.0, "US": 57000.0}


def concrete_modulus(strength: float, system: str = "SI") -> float:
    """Return the elastic modulus [Pa] of normal-weight concrete of a compressive strength [Pa].

    E = 4700 √f_c' in MPa, or E = 57 000 √f_c' in psi, which is 0.7 % more: as in ACI 318, from
    memory, not read in the standard, unverified.

    Parameters
    ----------
    strength : float
        Compressive strength f_c' [Pa].
    system : {"SI", "US"}, optional
        Which of the two.
    """
    unit = unit_size("root strength", system)
    return CONCRETE_FACTORS[system] * math.sqrt(strength / unit) * unit


def _column(inputs: Inputs) -> PierColumn:
    if (inputs.elastic_modulus is None) == (inputs.concrete_strength is None):
        raise InputError("give one of elastic_modulus and concrete_strength")
    if None not in (inputs.stiffness_factor, inputs.effective_stiffness):
        raise InputError("give only one of stiffness_factor and effective_stiffness")
    elastic_modulus = inputs.elastic_modulus or concrete_modulus(
        inputs.concrete_strength or 0.0, inputs.units
    )
    return PierColumn(
        height=inputs.column_height,
        section=_section(inputs),
        elastic_modulus=elastic_modulus,
        poisson_ratio=inputs.poisson_ratio,
        density=inputs.density,
        base=inputs.base,
        top=inputs.top,
        base_stiffness=inputs.base_stiffness,
        base_rotation_stiffness=inputs.base_rotation_stiffness,
        top_stiffness=inputs.top_stiffness,
        top_rotation_stiffness=inputs.top_rotation_stiffness,
        top_mass=inputs.top_mass or 0.0,
        embedment=inputs.embedment or 0.0,
        steps=_steps(inputs),
        stiffness_factor=1.0 if inputs.stiffness_factor is None else inputs.stiffness_factor,
        effective_stiffness=inputs.effective_stiffness,
    )


def _steps(inputs: Inputs) -> list[Step]:
    steps = []
    for number, step in enumerate(inputs.steps, 1):
        try:
            steps.append(Step(height=step.height, section=_section(step)))
        except InputError as error:
            raise InputError(f"steps[{number}].{error}") from None
    return steps


def _section(inputs: SectionInputs) -> Section:
    shape = SHAPES[inputs.column_shape]
    wanted = section_keys(shape)
    for key in dict.fromkeys(key for each in SHAPES.values() for key in section_keys(each)):
        if (getattr(inputs, key) is None) == (key in wanted):
            must = "is missing: it belongs" if key in wanted else "does not belong"
            raise InputError(f"{key} {must} to column_shape {inputs.column_shape}")
    try:
        return shape(**{name: getattr(inputs, key) for key, name in wanted.items()})
    except InputError as error:  # the section does not know that it is a column's
        raise InputError(f"column_{error}") from None


def section_keys(shape: type[Section]) -> dict[str, str]:
    """Return the dimensions of a section by their keys in a case file."""
    return {SYMBOLS[symbol].key: name for name, symbol in shape.dimensions.items()}


def with_mass(truck: Truck, mass: float) -> Truck:
    """Return a truck with the total mass of a case [kg].

    Raises
    ------
    InputError
        When too little is left for the body.
    """
    least = truck.engine_mass + POSSIBLE["body_mass"][0]
    if mass < least:
        raise InputError(
            f"truck_mass must exceed the engine's {truck.engine_mass:g} kg by "
            f"{POSSIBLE['body_mass'][0]:g} kg at least, got {mass:g} kg"
        )
    return truck.loaded_to(mass)
