"""Case files: flat YAML, parsed with units and checked before anything runs."""

import ast
import datetime
import hashlib
import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError, brief, shortened
from pierimpact.design.reaction import HIGH_IMPACT_HEIGHT, LOW_IMPACT_HEIGHT
from pierimpact.files.inputs import Inputs, SectionInputs, StepInputs, read_inputs
from pierimpact.files.limits import LEAST_PART, POSSIBLE
from pierimpact.files.office import Logo, read_logo, read_shared_file
from pierimpact.files.reading import read_text
from pierimpact.files.traffic import CaseTraffic, traffic_of
from pierimpact.files.trucks import TruckFile, read_truck_file
from pierimpact.files.yaml_keys import yaml_keys
from pierimpact.pier.column import PierColumn, Step
from pierimpact.pier.member_forces import within
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
from pierimpact.units import in_us_units, unit_size
from pierimpact.vehicle.truck import Truck

#: Bytes of a case file; a longer file is none of ours: this project's choice.
MOST_BYTES = 64_000
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


class Part(NamedTuple):
    """A part of the column between its steps."""

    low: float  #: height from which it goes [m]
    high: float  #: to which [m]
    section: Section
    resistances: Mapping[str, float]  #: to "shear" [N] and "moment" [N m], where they are given


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
    def annexes(self) -> tuple[str, ...]:
        """The annexes to be printed: those asked for, and the changes where there are any."""
        asked = tuple(name for name in self.inputs.annexes if name != "changes")
        return asked if self.superseded_file is None else (*asked, "changes")

    @property
    def impact_heights(self) -> tuple[float, ...]:
        """Nominal impact heights the case may come to use [m]."""
        return impact_heights(self.inputs)

    @property
    def parts(self) -> tuple[Part, ...]:
        """The parts of the column between its steps, upward; one resists what that below does."""
        resistances: dict[str, float] = {}
        parts = []
        stretches = self.column.stretches
        levels: tuple[Inputs | StepInputs, ...] = (self.inputs, *self.inputs.steps)
        for own, (section, low, high) in zip(levels, stretches, strict=True):
            given = {"shear": own.shear_resistance, "moment": own.moment_resistance}
            resistances |= {name: value for name, value in given.items() if value is not None}
            parts.append(Part(low, high, section, dict(resistances)))
        return tuple(parts)

    @property
    def differing(self) -> list[str]:
        """Of "shear" and "moment" those that parts of the column resist differently."""
        first, *others = (part.resistances for part in self.parts)
        return [name for name in first if any(own[name] != first[name] for own in others)]

    def weakness(self, name: str, z: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the base's resistance over that of the column at heights, as a beam has them.

        To "shear" or "moment", one where the case gives none; where two parts meet, of the part
        that the height belongs to [-].
        """
        found = np.ones_like(z)
        for part in self.parts:
            if name in part.resistances:
                ratio = self.parts[0].resistances[name] / part.resistances[name]
                found[within(z, part.low, part.high)] = ratio
        return found

    @property
    def whole(self) -> Part:
        """The column from its base to its top, with what its lowest part resists."""
        return self.parts[0]._replace(high=self.parts[-1].high)


def impact_heights(inputs: Inputs) -> tuple[float, ...]:
    """Return the nominal impact heights that inputs may come to use [m]."""
    height = inputs.impact_height
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

    Parameters
    ----------
    path : str or Path
        The file, such as "pier.yaml"; paths in it start from its folder.

    Returns
    -------
    CaseFile
        Its name, its SHA-256, its values as they are written there, and the `case` in SI units.

    Raises
    ------
    InputError
        When a file cannot be read or breaks a rule; the message is one line.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> file.values["column_diameter"]
    '36 in'
    >>> file.case.column.section.diameter  # m
    0.9144
    """
    return _read(Path(path), follow=True)


def _read(path: Path, *, follow: bool) -> CaseFile:
    """Return a case file; with the one that it supersedes, if any, where `follow` is true."""
    try:
        content, text = read_text(path, MOST_BYTES)
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
    case = Case(
        inputs=inputs,
        given={key: value for key, value in values.items() if value is not None},
        column=column_of(inputs),
        truck=loaded(truck_file.truck, inputs.truck_mass),
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
                error = InputError(f"impact_height may not be auto here: by the rule, {error}")
            raise InputError(f"{error}{_as_typed(values)}") from None
    _refuse_slivers(case)
    return case


def _as_typed(values: Mapping[str, object]) -> str:
    """Return heights as they were typed, to end an error in metres, where they are in others."""
    typed = {key: values.get(key) for key in ("impact_height", "column_height")}
    if not any(map(in_us_units, typed.values())):
        return ""
    return "; typed: " + ", ".join(f"{key} {brief(value)}" for key, value in typed.items())


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

    Every plain value among the notebook's variables is taken for a key, and so is every name that
    papermill was given, so that a misspelt one is found even though papermill passes it on.

    Parameters
    ----------
    namespace : mapping of str to object
        The notebook's variables, `globals()`.

    Raises
    ------
    InputError
        As in `case_from`; or when papermill's cell does more than give values to keys, or when
        `case_file` is given and these are not the values of that file.
    """
    values = {
        name: value
        for name, value in namespace.items()
        if not name.startswith("_")
        and name not in (*NOTEBOOK_PARAMETERS, "In", "Out")
        and isinstance(value, str | int | float | list | dict | datetime.date | None)
    }
    for name in _names_by_papermill(namespace.get("In")):
        if name not in NOTEBOOK_PARAMETERS:
            values.setdefault(name, "")  # no key, or it would be there
    files = {key: namespace.get(key) for key in NOTEBOOK_PARAMETERS}
    file_name, _, shared_sha256 = (
        name if isinstance(name, str) else None for name in files.values()
    )
    case = _case(values, Path(), shared_sha256, file_name)
    if any(each is not None for each in files.values()):
        _check_file({**case.given, **files})
    return case


def _names_by_papermill(executed: object) -> Iterator[str]:
    """Yield the names that papermill's cell gives values to, of the cells executed so far."""
    for cell in executed if isinstance(executed, list) else []:
        for line in ast.parse(cell).body if cell.startswith("# Parameters") else []:
            match line:
                case ast.Assign(targets=[ast.Name(id=name)], value=value) if _is_plain(value):
                    yield name
                case _:
                    raise InputError(
                        f"parameters must be keys and plain values, got {brief(ast.unparse(line))}"
                    )


def _is_plain(value: ast.expr) -> bool:
    try:
        ast.literal_eval(value)
    except ValueError:
        return False
    return True


def _check_file(given: Mapping[str, object]) -> None:
    """Refuse name and hashes of files that do not give these values."""
    name = given["case_file"]
    remedy = "set case_file, case_sha256 and shared_sha256 to None, or write the report anew"
    if not isinstance(name, str) or Path(name).name != name:
        raise InputError(f"case_file must be the name of a file in this folder: {remedy}")
    try:
        parameters = read_case_file(name).parameters
    except InputError as error:
        raise InputError(f"case_file {error}: {remedy}") from None
    if _without_none(parameters) != _without_none(_with_plain_dates(given)):
        raise InputError(f"case_file {name} has other values than the notebook: {remedy}")


def _without_none(values: Mapping[str, object]) -> dict[str, object]:
    return {key: value for key, value in values.items() if value is not None}


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


def column_of(inputs: Inputs) -> PierColumn:
    """Return the column of inputs; errors as in `case_from`."""
    if (inputs.elastic_modulus is None) == (inputs.concrete_strength is None):
        raise InputError("give one of elastic_modulus and concrete_strength")
    if None not in (inputs.stiffness_factor, inputs.effective_stiffness):
        raise InputError("give only one of stiffness_factor and effective_stiffness")
    elastic_modulus = inputs.elastic_modulus or concrete_modulus(
        inputs.concrete_strength or 0.0, inputs.concrete_system
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
        for key in ("shear_resistance", "moment_resistance"):
            if getattr(step, key) is not None and getattr(inputs, key) is None:
                raise InputError(
                    f"steps[{number}].{key} is given, and {key} of the column below is missing"
                )
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


def loaded(truck: Truck, mass: float | None) -> Truck:
    """Return a truck with the total mass of a case [kg], or as it is where the case gives none.

    Raises
    ------
    InputError
        When too little is left for the body.
    """
    if mass is None:
        return truck
    least = truck.engine_mass + POSSIBLE["body_mass"][0]
    if mass < least:
        raise InputError(
            f"truck_mass must exceed the engine's {truck.engine_mass:g} kg by "
            f"{POSSIBLE['body_mass'][0]:g} kg at least, got {mass:g} kg"
        )
    return truck.loaded_to(mass)
