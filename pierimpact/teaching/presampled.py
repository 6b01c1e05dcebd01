"""Collisions of many trucks with three piers, solved once, which other traffic only weighs anew.

`python -m pierimpact.teaching.presampled` solves them and writes `presampled.json` beside this
file. Mass and speed at the pier are drawn evenly, the parameters of the truck from their spread.
In some traffic each then counts with the density of its mass times that of its speed, over the
density that it was drawn with: a ratio of likelihoods. `templates/page/risk.mjs` has the same in
JavaScript.
"""

import json
import math
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.reactions import full_model
from pierimpact.design.codes import JCSS_STIFFNESS
from pierimpact.design.sobol import BITS, sobol_points
from pierimpact.files.trucks import load_truck, truck_names
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.risk.sampling import Arrivals, collisions, nearest
from pierimpact.risk.traffic import ENCROACHMENT_RATE, LEAST_TRUCK, LEAST_WIDTH, YEAR
from pierimpact.teaching.scenario import Scenario
from pierimpact.vehicle.truck import QUANTITIES

Array: TypeAlias = NDArray[np.float64]

FILE = Path(__file__).with_name("presampled.json")
#: The piers by their names, each with its frequency [Hz], and the mass of all [kg].
PIERS = {"10 Hz": 10.0, "30 Hz": 30.0, "100 Hz": 100.0}
PIER_MASS = 8e3
#: Ends of mass [kg] and of speed at the pier [m/s], and the power of two of the number drawn. No
#: truck of the fastest traffic that can be set is faster.
MASSES, SPEEDS, POWER = (LEAST_TRUCK, 60e3), (3.0 / 3.6, 160.0 / 3.6), 12
#: Of JCSS: standard deviation of masses [kg] and of speeds on the road [m/s], mean angle, and mean
#: and standard deviation of the deceleration [m/s²].
LAWS = {
    "massDeviation": 12e3,
    "speedDeviation": 10.0 / 3.6,
    "angle": math.radians(10.0),
    "deceleration": 4.0,
    "decelerationDeviation": 1.3,
}
#: Points of the quadrature over speed on the road and deceleration, in standard deviations of
#: their logarithm to either side, and cells of the speed at the pier: numerical.
_ROAD, _BRAKING, _CELLS = (4.0, 201), (3.0, 9), 64


class Presampled(NamedTuple):
    """The collisions, arrays of shape (n,)."""

    mass: Array  #: [kg]
    speed: Array  #: at the pier [m/s]
    reaction: dict[str, Array]  #: by pier [N]
    engine: dict[str, NDArray[np.bool_]]  #: by pier, whether the engine's peak governs


def solve(power: int = POWER) -> Presampled:
    """Solve the collisions of 2**power trucks with each of the piers."""
    trucks = [load_truck(name) for name in truck_names()]
    points = sobol_points(2 + len(QUANTITIES), power, seed=1) + 0.5 ** (BITS + 1)
    mass, speed = (
        low + (high - low) * row for (low, high), row in zip((MASSES, SPEEDS), points, strict=False)
    )
    which = nearest(mass, trucks)
    factors = np.ones_like(points[2:])
    for number, truck in enumerate(trucks):
        for row, name in enumerate(QUANTITIES):
            own = which == number
            factors[row, own] = truck.spread[name].factor(points[2 + row, own])
    arrivals = Arrivals(mass, mass, speed, speed, mass, which, factors.T)
    found = {
        name: full_model(
            collisions(trucks, EquivalentPier.from_frequency(PIER_MASS, frequency), arrivals)
        )
        for name, frequency in PIERS.items()
    }
    return Presampled(
        mass=mass,
        speed=speed,
        reaction={name: own.governing for name, own in found.items()},
        engine={name: ~(own.cargo > own.engine) for name, own in found.items()},
    )


@cache
def data() -> dict[str, Any]:
    """Return what the browser needs to weigh the collisions, in SI units."""
    found: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    return found | {
        "laws": LAWS,
        "masses": MASSES,
        "speeds": SPEEDS,
        "departures": YEAR * ENCROACHMENT_RATE * LEAST_WIDTH / math.sin(LAWS["angle"]),
        "stiffness": JCSS_STIFFNESS,
    }


@cache
def presampled() -> Presampled:
    """Return the collisions of the file."""
    found = data()
    return Presampled(
        mass=np.array(found["mass"]),
        speed=np.array(found["speed"]),
        reaction={name: np.array(found["reaction"][name]) for name in PIERS},
        engine={name: np.array(found["engine"][name]) == 1 for name in PIERS},
    )


def weights(scenario: Scenario) -> Array:
    """Return how many times a year each of the collisions happens in some traffic, shape (n,)."""
    own = presampled()
    edges, beyond = arrival_speeds(scenario)
    cell = ((own.speed - edges[0]) / (edges[1] - edges[0])).astype(int).clip(0, len(edges) - 2)
    of_speed = (beyond[:-1] - beyond[1:])[cell] / (edges[1] - edges[0])
    of_mass = np.exp(-0.5 * ((own.mass - scenario.mean_mass) / LAWS["massDeviation"]) ** 2)
    evenly = np.linspace(*MASSES, 2001)
    bell = np.exp(-0.5 * ((evenly - scenario.mean_mass) / LAWS["massDeviation"]) ** 2)
    area = (bell.sum() - 0.5 * (bell[0] + bell[-1])) * (evenly[1] - evenly[0])
    drawn = 1.0 / ((MASSES[1] - MASSES[0]) * (SPEEDS[1] - SPEEDS[0]))
    trucks = scenario.traffic_volume * scenario.truck_share * data()["departures"]
    return np.asarray(trucks * of_mass / area * of_speed / drawn / len(own.mass))


def arrival_speeds(scenario: Scenario) -> tuple[Array, Array]:
    """Return speeds [m/s] and the chance of arriving at the pier faster than each of them [-].

    A truck of speed v_0 that brakes at a arrives faster than x at angles above α with
    sin α = 2 a d / (v_0² − x²), of which Rayleigh's law leaves exp(−α²/2σ²).
    """
    x = np.linspace(*SPEEDS, _CELLS + 1)
    road, of_road = _lognormal(scenario.mean_speed, LAWS["speedDeviation"], *_ROAD)
    braking, of_braking = _lognormal(LAWS["deceleration"], LAWS["decelerationDeviation"], *_BRAKING)
    left = road[:, None] ** 2 - x**2
    sine = 2.0 * braking[:, None, None] * scenario.distance_from_road / np.maximum(left, 1e-9)
    least = np.arcsin(np.minimum(sine, 1.0))
    chance = np.exp(-0.25 * math.pi * (least / LAWS["angle"]) ** 2)
    arrives = np.where((left > 0.0) & (sine < 1.0), chance, 0.0)
    return x, np.einsum("i,j,ijk->k", of_braking, of_road, arrives)


def _lognormal(mean: float, deviation: float, reach: float, count: int) -> tuple[Array, Array]:
    """Return values of a lognormal law with their weights, evenly in its logarithm."""
    variance = math.log1p((deviation / mean) ** 2)
    z = np.linspace(-reach, reach, count)
    weight = np.exp(-0.5 * z**2)
    return mean * np.exp(math.sqrt(variance) * z - 0.5 * variance), weight / weight.sum()


def main() -> None:
    """Solve the collisions and write the file."""
    own = solve()
    content = {
        "mass": [round(value) for value in own.mass.tolist()],
        "speed": [round(value, 3) for value in own.speed.tolist()],
        "reaction": {
            name: [100 * round(value / 100.0) for value in own.reaction[name].tolist()]
            for name in PIERS
        },
        "engine": {name: own.engine[name].astype(int).tolist() for name in PIERS},
    }
    FILE.write_text(json.dumps(content, separators=(",", ":")) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
