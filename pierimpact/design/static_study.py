"""The study behind the rules for static member forces: columns, each struck in two ways.

`python -m pierimpact.design.static_study` lets random trucks strike random columns, as piers of
one degree of freedom and as beams, and writes to `static_study.json` beside this file how the
largest static shear and moment under the reaction compare with those of the beam. The figures in
`pierimpact.pier.static_forces` and `pierimpact.design.static_forces` are those of the file.
"""

import json
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.history import CollisionHistory
from pierimpact.collision.simulate import simulate
from pierimpact.design import domain
from pierimpact.design.domain import Range
from pierimpact.design.static_forces import ABOVE, BELOW, StaticForcesInCollision
from pierimpact.pier.column import PierColumn
from pierimpact.pier.sections import CircularSection, RectangularSection
from pierimpact.pier.static_forces import QUICK, TOO_LOW, TOP, StaticForces
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.truck import Truck

Array: TypeAlias = NDArray[np.float64]
Which: TypeAlias = NDArray[np.bool_]
Columns: TypeAlias = Mapping[str, Array]

SIZE, SEED = 2400, 7
OUTCOME_FILE = Path(__file__).with_name("static_study.json")
#: Conditions of base and top, taken in turn.
ENDS = (
    ("fixed", "pinned"),
    ("fixed", "fixed"),
    ("pinned", "pinned"),
    ("fixed", "free"),
    ("pinned", "fixed"),
    ("free", "fixed"),
)
#: The forces that are compared, and the quantiles of the ratios: this project's choice.
FORCES = ("shear", "moment")
QUANTILES = (0.05, 0.5, 0.95)
#: Headings in the file; after the first, of columns not held at the top alone.
RULES = "by the column", "by the collision"
WARNINGS = "warnings"
TELLING = "how well one quantity tells which of two columns is too low"
BELOW_BY_RATIO = "reaction below the contact force, times the one over the other"
UNDER_THE_LARGER = "under the larger of reaction and contact force"


#: What is varied of column, place and collision, this project's choice; half of the sections are
#: round. The truck's other parameters are those of `DOMAIN`, with the friction on road or pier with
#: equal chance.
VARIED = {
    "diameter, or depth along the travel": Range(0.6, 2.5, "m", 1.0),
    "height over diameter or depth": Range(2.0, 15.0, "", 1.0),
    "nominal impact height": Range(0.6, 2.0, "m", 1.0),
    "elastic modulus": Range(15.0, 40.0, "GPa", 1e9),
    "damping ratio": Range(2.0, 7.0, "%", 1e-2),
    "speed at first touch": Range(30.0, 130.0, "km/h", 1.0 / 3.6),
    "total mass of the truck": Range(3.0, 36.0, "t", 1e3),
    "width over depth of a rectangle": Range(0.5, 2.0, "", 1.0),
}
#: Those that are uniform in their logarithms; all else is uniform.
LOGARITHMIC = tuple(VARIED)[1], *tuple(VARIED)[6:]
TRUCK = ("m1", "P1", "d1", "k1", "ku1", "P2", "d2", "k2", "ku2", "cs")

# This project's choice.
DENSITY = 2450.0  # of all columns [kg/m³]
HIGHEST = 0.8  # impact height over column height; those with a higher one are left out


class Struck(NamedTuple):
    """A collision with a column."""

    truck: Truck
    column: PierColumn
    impact_height: float  #: [m]
    damping_ratio: float
    speed: float  #: [m/s]


def sample(size: int, seed: int) -> Iterator[Struck]:
    """Yield random collisions with columns, by a generator's seed."""
    random = np.random.default_rng(seed)
    drawn = 2 * size  # of which enough are kept

    def draw(name: str) -> Array:
        low, high, _, unit = VARIED[name]
        if name in LOGARITHMIC:
            return np.asarray(unit * np.exp(random.uniform(np.log(low), np.log(high), drawn)))
        return unit * random.uniform(low, high, drawn)

    depth, slenderness, impact, modulus, ratio, speed, mass, breadth = map(draw, VARIED)
    is_round, on_pier = random.uniform(size=(2, drawn)) < 0.5
    own = {name: random.uniform(*domain.bounds(name), drawn) for name in TRUCK}
    kept = np.flatnonzero(impact <= HIGHEST * slenderness * depth)[:size].tolist()
    for number, i in enumerate(kept):
        base, top = ENDS[number % len(ENDS)]
        column = PierColumn(
            height=slenderness[i] * depth[i],
            section=CircularSection(diameter=depth[i])
            if is_round[i]
            else RectangularSection(width=breadth[i] * depth[i], depth=depth[i]),
            elastic_modulus=modulus[i],
            density=DENSITY,
            base=base,
            top=top,
        )
        engine_spring, body_spring = (
            CrushSpring(
                plateau_force=own[f"P{body}"][i],
                plateau_length=own[f"d{body}"][i],
                stiffness=own[f"k{body}"][i],
                unloading_stiffness=own[f"ku{body}"][i],
            )
            for body in (1, 2)
        )
        truck = Truck(
            name="sampled",
            engine_mass=own["m1"][i],
            body_mass=mass[i] - own["m1"][i],
            engine_spring=engine_spring,
            body_spring=body_spring,
            friction_force=own["cs"][i],
            friction_on="pier" if on_pier[i] else "road",
        )
        yield Struck(truck, column, float(impact[i]), float(ratio[i]), float(speed[i]))


class Found(NamedTuple):
    """What is found of one collision."""

    ends: int  #: number of the column's ends in ENDS
    shear: float  #: largest static shear over that of the beam, anywhere and of either sign
    moment: float  #: largest static moment over that of the beam, likewise
    mass: float  #: equivalent mass m_p over the mass of the column
    shape: float  #: largest magnitude of the shape function φ
    frequency: float  #: f_p [Hz]
    height: float  #: impact height over column height
    blow: float  #: time of the beam's contact force above half its peak, over its first period
    reaction: float  #: R over the largest contact force, both of one degree of freedom
    cargo: int  #: 1 where the cargo governs R, 0 where the engine does


#: Figures of each in the file.
_FORMATS = dict(zip(Found._fields, ("d", ".3f", ".3f", *(".3g",) * 5, ".3f", "d"), strict=True))


def compare(struck: Struck) -> Found:
    """Return how static member forces compare with those of the beam in one collision."""
    truck, column, height, ratio, speed = struck
    under_force = column.struck_at(height)
    pier, beam = under_force.equivalent(ratio), column.beam(height, ratio)
    one_degree, history = simulate(truck, pier, speed), simulate(truck, beam, speed)
    reaction = one_degree.governing_peak.reaction
    static, forces = under_force.member_forces(reaction), history.member_forces
    assert forces is not None
    return Found(
        ends=ENDS.index((column.base, column.top)),
        shear=abs(static.largest_shear.value) / float(np.abs(forces.shear).max()),
        moment=abs(static.largest_moment.value) / float(np.abs(forces.moment).max()),
        mass=under_force.mass / column.mass,
        shape=float(np.abs(under_force.shape(np.linspace(0.0, column.height, 401))).max()),
        frequency=pier.frequency,
        height=height / column.height,
        blow=_longest_blow(history) * float(beam.frequencies[0]),
        reaction=reaction / float(one_degree.contact_force.max()),
        cargo=int(one_degree.governs == "cargo"),
    )


def _longest_blow(history: CollisionHistory) -> float:
    """Return the time for which the contact force stays above half its peak, about the peak [s]."""
    force, time = history.contact_force, history.time
    peak = int(force.argmax())
    low = force < 0.5 * force[peak]
    before, after = np.flatnonzero(low[:peak]), np.flatnonzero(low[peak:])
    start = time[before[-1]] if len(before) else time[0]
    end = time[peak + after[0]] if len(after) else time[-1]
    return float(end - start)


def column_kinds(columns: Columns) -> list[str]:
    """Return the kind of each column by the rule of `pierimpact.pier.static_forces`."""
    return [column.kind for column in _under_rule(columns)]


def collision_kinds(columns: Columns) -> list[str]:
    """Return the kind of each collision by the rule of `pierimpact.design.static_forces`."""
    return [
        StaticForcesInCollision(column, reaction, 1.0).kind
        for column, reaction in zip(_under_rule(columns), columns["reaction"], strict=True)
    ]


def _under_rule(columns: Columns) -> Iterator[StaticForces]:
    for number, frequency in zip(columns["ends"], columns["frequency"], strict=True):
        yield StaticForces(*ENDS[int(number)], frequency)


def summary(columns: Columns, cases: Which, factor: float | Array = 1.0) -> dict[str, Any]:
    """Return how many cases there are, and of either force quantiles and the share too low.

    Parameters
    ----------
    columns : mapping of str to ndarray, shape (n,)
        The fields of `Found`.
    cases : ndarray of bool, shape (n,)
        Which of them count.
    factor : float or ndarray, shape (n,), optional
        By which the reactions are multiplied [-].
    """
    found: dict[str, Any] = {"cases": int(np.count_nonzero(cases))}
    for force in FORCES:
        ratios = (factor * columns[force])[cases]
        quantiles = {f"{100.0 * q:g} %": _rounded(np.quantile(ratios, q)) for q in QUANTILES}
        found[force] = quantiles | {"too low": _rounded(np.mean(ratios < TOO_LOW))}
    return found


def alarms(columns: Columns, warned: Which, cases: Which) -> dict[str, Any]:
    """Return how good a warning is among the cases: the share of all that it is given to.

    Of either force "caught", the share of those too low that were warned of, and "false", the
    share of the warned that were not too low.
    """
    found: dict[str, Any] = {"warned": _rounded(np.mean(warned[cases]))}
    for force in FORCES:
        low = columns[force] < TOO_LOW
        found[force] = {
            "caught": _rounded(np.mean(warned[cases & low])),
            "false": _rounded(np.mean(~low[cases & warned])),
        }
    return found


def telling(values: Array, low: Which) -> float:
    """Return the chance that of two cases the smaller value is the one too low, or the larger.

    The more telling of both: 0.5 tells nothing, and 1 all (the area under the receiver operating
    characteristic).
    """
    ordered = np.sort(values[~low])
    sides = (np.searchsorted(ordered, values[low], side=side) for side in ("left", "right"))
    above = float(np.mean(np.mean(list(sides), axis=0))) / len(ordered)
    return _rounded(max(above, 1.0 - above))


def conclusions(columns: Columns) -> dict[str, Any]:
    """Return what the rules make of the columns, by kind and by ends."""
    by_column, by_collision = np.array(column_kinds(columns)), np.array(collision_kinds(columns))
    other = by_column != TOP
    kinds = dict(zip(RULES, ((by_column, QUICK), (by_collision, ABOVE)), strict=True))
    found: dict[str, Any] = {
        name: {str(kind): summary(columns, of == kind) for kind in np.unique(of)}
        for name, (of, _) in kinds.items()
    }
    found["by the collision and the ends"] = {
        f"{base}–{top}": {
            str(kind): summary(columns, of_ends & (by_collision == kind))
            for kind in np.unique(by_collision[of_ends])
        }
        for number, (base, top) in enumerate(ENDS)
        for of_ends in [columns["ends"] == number]
    }
    found[WARNINGS] = {
        name: alarms(columns, of != safe, other) for name, (of, safe) in kinds.items()
    }
    found[TELLING] = {
        name: {
            force: telling(columns[name][other], (columns[force] < TOO_LOW)[other])
            for force in FORCES
        }
        for name in Found._fields[3:9]
    }
    by_reaction = 1.0 / columns["reaction"]
    found[BELOW_BY_RATIO] = summary(columns, by_collision == BELOW, by_reaction)
    found[UNDER_THE_LARGER] = summary(columns, other, np.maximum(1.0, by_reaction))
    return found


def study(size: int = SIZE, seed: int = SEED) -> dict[str, Any]:
    """Run the study and return what goes into the file."""
    rows = [compare(struck) for struck in sample(size, seed)]
    found = {
        name: [json.loads(format(value, _FORMATS[name])) for value in values]
        for name, values in zip(Found._fields, zip(*rows, strict=True), strict=True)
    }
    return {
        "seed": seed,
        "size": size,
        "varied": {
            name: f"{low:g} to {high:g} {unit}".strip()
            for name, (low, high, unit, _) in VARIED.items()
        },
        "found": found,
        "conclusions": conclusions(as_columns(found)),
    }


def as_columns(found: Mapping[str, Any]) -> Columns:
    """Return what is found in the file as arrays."""
    return {name: np.asarray(values, dtype=float) for name, values in found.items()}


def main(report: Callable[[str], None] = print) -> None:
    """Run the study and write its file."""
    outcome = study()
    text = json.dumps(outcome, ensure_ascii=False, separators=(",", ":"))
    OUTCOME_FILE.write_text(text + "\n", encoding="utf-8")
    for name, found in outcome["conclusions"].items():
        report(f"{name}: {found}")


def _rounded(value: Any) -> float:
    return round(float(value), 3)


if __name__ == "__main__":
    main()
