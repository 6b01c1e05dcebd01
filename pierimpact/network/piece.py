"""The calculation of a piece of a portfolio: some rows at a time, in one process.

Collisions of a piece advance side by side; columns, and their static member forces, are calculated
one by one by the same objects as in a report. What a row comes to does not depend on the others.
"""

import math
import warnings
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError
from pierimpact.collision.contact_forces import contact_forces
from pierimpact.collision.groups import repeat
from pierimpact.collision.parameters import Collision, collision_chunks
from pierimpact.collision.propagation import UnfinishedWarning
from pierimpact.collision.reactions import full_model
from pierimpact.collision.simulate import simulate
from pierimpact.design.band import LEVELS, quantiles, spreads_of
from pierimpact.design.beam_band import beam_band
from pierimpact.design.codes import aashto_lrfd
from pierimpact.design.quick_band import SIZE, quick_reactions, sampled_trucks
from pierimpact.design.static_forces import StaticForcesInCollision
from pierimpact.files.case import column_of, impact_heights, loaded
from pierimpact.files.csv_lines import Row
from pierimpact.files.inputs import Inputs, read_inputs
from pierimpact.files.piers import COLUMNS, Column, Pier, pier_of
from pierimpact.files.plausible import unusual
from pierimpact.pier.column import StruckColumn
from pierimpact.report.calculation import AVERAGE
from pierimpact.vehicle.truck import Truck

Array: TypeAlias = NDArray[np.float64]

#: What is kept of a row: words, and numbers in SI units; nan where there is none.
WORDS = ("id", "truck", "governs", "asked", "unusual")
NUMBERS = (
    *("row", "latitude", "longitude", "truck_mass", "speed"),
    *("impact_height", "pier_frequency", "pier_mass", "pier_stiffness"),
    *("engine_peak", "cargo_peak", "design_reaction", "band_low", "band_high"),
    *("contact_force", "average_25ms", "code_ratio"),
    *("static_shear", "static_moment"),
    # Under the larger of reaction and contact force, and whether the reaction alone will do.
    *("safe_shear", "safe_moment", "static_holds"),
    *("high_shear", "high_moment"),  # static ones that 95 % of the trucks stay below
    *("shear_resistance", "moment_resistance"),
    "in_mass_range",  # whether the truck's springs stand for its mass
)


class Reject(NamedTuple):
    """A row without results."""

    row: int  #: as a spreadsheet counts it
    name: str  #: its id; "" where that is missing
    column: str  #: that is to blame; "" where it is not one alone
    reason: str


class Task(NamedTuple):
    """Rows to calculate, with all that a process elsewhere needs."""

    columns: tuple[Column, ...]
    rows: list[Row]
    trucks: Mapping[str, Truck | str]  #: by name; what is wrong with one that cannot be read


class Found(NamedTuple):
    """Results of the rows that have any, by name and of shape (n,), and the other rows."""

    words: dict[str, list[str]]
    numbers: dict[str, list[float]]
    rejects: list[Reject]


class BeamForces(NamedTuple):
    """Largest member forces of a column as a beam [N, N m].

    What 95 % of the trucks stay below is by the larger of beam and static reaction, unless the row
    asks for the beam; nan where the truck has no spread.
    """

    row: int
    shear: float
    moment: float
    shear_high: float
    moment_high: float


class BeamFound(NamedTuple):
    """Member forces of columns as beams, and the rows without."""

    forces: list[BeamForces]
    rejects: list[Reject]


class _Read(NamedTuple):
    """A row, checked."""

    row: int
    pier: Pier
    inputs: Inputs
    truck: Truck
    struck: list[StruckColumn]  #: at each height the case may come to use


class _Impacts(NamedTuple):
    """All impacts of a piece, side by side: arrays of shape (m,)."""

    engine: Array
    cargo: Array
    reaction: Array
    contact: Array
    average: Array
    sampled: Array  # reactions of sampled trucks, shape (m, trucks); nan without a spread
    arriving: Array  # share of these whose cargo meets the pier


def calculate_piece(task: Task) -> Found:
    """Return the results of some rows, all but what only beams have."""
    read, rejects = _read_rows(task)
    impacts = _collide(read)
    numbers: dict[str, list[float]] = {name: [] for name in NUMBERS}
    words: dict[str, list[str]] = {name: [] for name in WORDS}
    first = 0
    for own in read:
        mine = range(first, first + len(own.struck))
        first = mine.stop
        if not all(math.isfinite(impacts.reaction[i]) for i in mine):
            reason = "the collision did not come to an end"
            rejects.append(Reject(own.row, own.pier.name, "", reason))
            continue
        for name, number in _numbers(own, impacts, mine).items():
            numbers[name].append(float(number))
        best = max(mine, key=lambda i: impacts.reaction[i])
        cargo_governs = impacts.cargo[best] > impacts.engine[best]
        words["id"].append(own.pier.name)
        words["truck"].append(own.truck.name)
        words["governs"].append("cargo" if cargo_governs else "engine")
        words["asked"].append(str(own.pier.values.get("member_forces", "")))
        words["unusual"].append(", ".join(found.key for found in unusual(own.inputs)))
    return Found(words, numbers, rejects)


def calculate_beams(task: Task) -> BeamFound:
    """Return the largest member forces of some rows with the column as a beam."""
    read, rejects = _read_rows(task)
    forces = []
    for own in read:
        try:
            nominal, *sampled = np.fmax.reduce([_by_beam(own, struck) for struck in own.struck])
        except (InputError, RuntimeError) as error:
            rejects.append(Reject(own.row, own.pier.name, "", f"as a beam: {error}"))
        else:
            high = [quantiles(values)[-1] for values in np.reshape(sampled, (-1, 2)).T]
            forces.append(BeamForces(own.row, *map(float, (*nominal, *high))))
    return BeamFound(forces, rejects)


def _by_beam(own: _Read, struck: StruckColumn) -> Array:
    """Return largest shear and moment of the nominal truck, then of sampled ones, shape (n, 2)."""
    beam = struck.column.beam(struck.impact_height, own.inputs.damping_ratio)
    history = simulate(own.truck, beam, own.inputs.speed)
    members = history.member_forces
    assert members is not None
    extremes = members.shear_extremes, members.moment_extremes
    nominal = np.array([abs(own.governing.value) for own in extremes])
    spreads, parameters = spreads_of(own.truck), history.collision.parameters
    if not spreads:
        return nominal[None]
    trucks = sampled_trucks(repeat(parameters, 1), spreads)
    band = beam_band(parameters, trucks, beam, float(members.time[-1]))
    sampled = nominal * np.column_stack([band.ratios(name) for name in ("shear", "moment")])
    if own.inputs.member_forces != "beam":
        unit = struck.member_forces(1.0)
        per_reaction = np.abs([unit.largest_shear.value, unit.largest_moment.value])
        sampled = np.fmax(sampled, np.outer(full_model(trucks).governing, per_reaction))
    return np.vstack((nominal, sampled))


def _read_rows(task: Task) -> tuple[list[_Read], list[Reject]]:
    """Return the rows that pass every check, and the others with the reason."""
    read, rejects = [], []
    names = [column.key for column in task.columns]
    for row in task.rows:
        try:
            read.append(_read(row, task))
        except InputError as error:
            reason = " ".join(str(error).split())
            cells = dict(zip(names, row.cells, strict=False))
            blamed = reason.partition(" ")[0].partition("[")[0]
            column = blamed if blamed in COLUMNS else ""
            rejects.append(Reject(row.number, cells.get("id", "").strip(), column, reason))
    return read, rejects


def _read(row: Row, task: Task) -> _Read:
    pier = pier_of(task.columns, row)
    inputs = read_inputs(pier.values)
    truck = task.trucks[inputs.truck]
    if isinstance(truck, str):
        raise InputError(truck)
    column = column_of(inputs)
    struck = [column.struck_at(height) for height in impact_heights(inputs)]
    return _Read(row.number, pier, inputs, loaded(truck, inputs.truck_mass), struck)


def _collide(read: Sequence[_Read]) -> _Impacts:
    """Let the trucks strike all columns, at all heights."""
    if not read:
        none = np.empty(0)
        return _Impacts(none, none, none, none, none, np.empty((0, SIZE)), none)
    collisions = [
        Collision(own.truck, struck.equivalent(own.inputs.damping_ratio), own.inputs.speed)
        for own in read
        for struck in own.struck
    ]
    size = len(collisions)
    sampled, arriving = np.full((size, SIZE), math.nan), np.zeros(size)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnfinishedWarning)  # their reactions are nan
        peaks, forces = contact_forces(collisions, [AVERAGE])
        reaction = peaks.governing
        for alike in _alike([own.truck.spread for own in collisions]):
            spreads = spreads_of(collisions[alike[0]].truck)
            if spreads:
                for part, parameters in collision_chunks([collisions[i] for i in alike]):
                    here = alike[part]
                    found = quick_reactions(parameters, reaction[here], spreads)
                    sampled[here] = found.governing
                    arriving[here] = np.mean(np.isfinite(found.cargo), axis=1)
    return _Impacts(
        peaks.engine, peaks.cargo, reaction, forces.largest, forces.averages[0], sampled, arriving
    )


def _alike(spreads: Sequence[Mapping[str, Any]]) -> list[NDArray[np.int_]]:
    """Return the places of equal mappings, together."""
    places: dict[Any, list[int]] = {}
    for place, own in enumerate(spreads):
        places.setdefault(tuple(own.items()), []).append(place)
    return [np.array(own) for own in places.values()]


def _numbers(own: _Read, impacts: _Impacts, mine: range) -> dict[str, float]:
    """Return the numbers of a row, whose impacts have these places."""
    best = max(mine, key=lambda i: impacts.reaction[i])
    struck = own.struck[best - mine.start]
    inputs, equivalent = own.inputs, struck.equivalent(own.inputs.damping_ratio)
    # The average is over the impact that governs, bands and member forces are over all of them.
    low, _, high = quantiles(np.fmax.reduce(impacts.sampled[mine])).tolist()
    static, safe, holds = np.zeros(2), np.zeros(2), True
    sampled = np.full((2, SIZE), math.nan)  # of each truck the larger of all impacts
    for place, impact in zip(mine, own.struck, strict=True):
        reaction, contact = impacts.reaction[place], impacts.contact[place]
        unit = impact.member_forces(1.0)
        largest = np.abs([unit.largest_shear.value, unit.largest_moment.value])
        static = np.maximum(static, reaction * largest)
        sampled = np.fmax(sampled, np.outer(largest, impacts.sampled[place]))
        safe = np.maximum(safe, max(reaction, contact) * largest)
        holds &= StaticForcesInCollision(impact.static_forces, reaction, contact).hold
        # Nobody knows for the trucks at the upper end, if it is they whose cargo arrives.
        holds &= not math.isnan(impacts.cargo[place]) or impacts.arriving[place] <= 1.0 - LEVELS[-1]
    average = impacts.average[best]
    latitude, longitude = own.pier.place
    return {
        "row": own.row,
        "latitude": latitude,
        "longitude": longitude,
        "truck_mass": own.truck.mass,
        "speed": inputs.speed,
        "impact_height": struck.impact_height,
        "pier_frequency": equivalent.frequency,
        "pier_mass": equivalent.mass,
        "pier_stiffness": equivalent.stiffness,
        "engine_peak": impacts.engine[best],
        "cargo_peak": impacts.cargo[best],
        "design_reaction": impacts.reaction[best],
        "band_low": low,
        "band_high": high,
        "contact_force": impacts.contact[best],
        "average_25ms": average,
        "code_ratio": average / aashto_lrfd().along.value,
        "static_shear": static[0],
        "static_moment": static[1],
        "safe_shear": safe[0],
        "safe_moment": safe[1],
        "static_holds": holds,
        "high_shear": float(quantiles(sampled[0])[-1]),
        "high_moment": float(quantiles(sampled[1])[-1]),
        "shear_resistance": inputs.shear_resistance or math.nan,
        "moment_resistance": inputs.moment_resistance or math.nan,
        "in_mass_range": own.truck.in_mass_range,
    }
