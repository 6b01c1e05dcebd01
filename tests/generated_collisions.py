"""Collisions for tests: spread over the whole domain, and those that are hard to follow."""

import dataclasses
import math
from typing import NamedTuple

import numpy as np
from scipy.stats.qmc import LatinHypercube

from pierimpact import CrushSpring, EquivalentPier, Truck, load_truck

REFERENCE = load_truck("single-unit-8t")
# About the reference truck by 30 %; bounds of truck mass [kg], speed [m/s], pier frequency [Hz]
# and mass [kg], damping ratio, k_u/k and friction force [N].
SPREAD = (0.7, 1.3)
TRUCK_MASS = (6e3, 40e3)
SPEED = (10.0 / 3.6, 130.0 / 3.6)
FREQUENCY = (2.0, 200.0)
PIER_MASS = (2e3, 200e3)
DAMPING_RATIO = (0.0, 0.2)
UNLOADING = (1.0, 10.0)
FRICTION = (0.0, 40e3)

# The shares of all collisions that sit on the lower bound of damping and of k_u/k.
UNDAMPED, ELASTIC = 0.06, 0.06


class Case(NamedTuple):
    """What `simulate` and the reference take."""

    truck: Truck
    pier: EquivalentPier
    speed: float


def collisions(size, seed):
    """Collisions spread over the domain as a Latin hypercube."""
    return [_collision(row) for row in LatinHypercube(16, rng=seed).random(size).tolist()]


def side_by_side(cases):
    """Many collisions as the arguments of `peak_reactions`."""
    trucks, piers, speeds = zip(*cases, strict=True)
    return {
        "truck": trucks,
        "pier_mass": [pier.mass for pier in piers],
        "pier_stiffness": [pier.stiffness for pier in piers],
        "damping_ratio": [pier.damping_ratio for pier in piers],
        "speed": speeds,
    }


def _between(bounds, fraction):
    return bounds[0] + fraction * (bounds[1] - bounds[0])


def _evenly_in_logarithm(bounds, fraction):
    return math.exp(_between(np.log(bounds), fraction))


def _with_share_at_bound(bounds, share, fraction):
    return _between(bounds, max(fraction - share, 0.0) / (1.0 - share))


def _collision(row):
    fractions = iter(row)

    def about(value):
        return value * _between(SPREAD, next(fractions))

    def spring_like(spring):
        stiffness = about(spring.stiffness)
        ratio = _with_share_at_bound(UNLOADING, ELASTIC, next(fractions))
        return CrushSpring(
            plateau_force=about(spring.plateau_force),
            plateau_length=about(spring.plateau_length),
            stiffness=stiffness,
            unloading_stiffness=ratio * stiffness,
        )

    friction_on = ("road", "pier", "nothing")[int(3.0 * next(fractions))]
    friction_force = _between(FRICTION, next(fractions))
    truck = dataclasses.replace(
        REFERENCE,
        engine_mass=about(REFERENCE.engine_mass),
        engine_spring=spring_like(REFERENCE.engine_spring),
        body_spring=spring_like(REFERENCE.body_spring),
        friction_force=0.0 if friction_on == "nothing" else friction_force,
        friction_on="road" if friction_on == "nothing" else friction_on,
    ).loaded_to(_between(TRUCK_MASS, next(fractions)))
    mass = _evenly_in_logarithm(PIER_MASS, next(fractions))
    frequency = _evenly_in_logarithm(FREQUENCY, next(fractions))
    pier = EquivalentPier(
        mass=mass,
        stiffness=mass * (2.0 * math.pi * frequency) ** 2,
        damping_ratio=_with_share_at_bound(DAMPING_RATIO, UNDAMPED, next(fractions)),
    )
    return Case(truck, pier, _between(SPEED, next(fractions)))


# Speed [m/s], friction force [N] and what it acts on, pier mass [kg], stiffness [N/m] and damping
# ratio; then mass [kg], P [N], d [m], k and k_u [N/m] of the engine, and of the body.
# fmt: off
_HARD = {
    # The engine opens, meets the pier again and opens, each within a fraction of a period.
    "engine bounces before the cargo arrives": (
        13.7663, 0.0, "road", 5278.20, 16975.4e3, 0.00369915,
        (824.047, 180325.0, 0.578723, 107361e3, 771396e3),
        (31905.7, 618890.0, 1.80752, 10097.7e3, 28959.5e3)),
    "engine bounces on a soft pier": (
        12.5774, 0.0, "road", 2414.39, 4040.59e3, 0.0389281,
        (744.108, 143292.0, 0.626099, 159809e3, 1413040e3),
        (32006.2, 353814.0, 1.95652, 8293.24e3, 21431.4e3)),
    "engine arrives after the cargo": (
        18.7160, 0.0, "road", 6177.45, 3257.19e3, 0.110244,
        (578.119, 166945.0, 0.530240, 165902e3, 433370e3),
        (13397.6, 599785.0, 1.52722, 11797.8e3, 22455.3e3)),
    "engine bounces and the cargo arrives late": (
        6.88343, 0.0, "road", 2393.95, 3117.36e3, 0.0652138,
        (501.733, 181562.0, 0.538148, 185552e3, 1769010e3),
        (33784.7, 388066.0, 1.90705, 7284.69e3, 15873.1e3)),
    # The cargo arrives although the pier has swung through a whole period without a change.
    "cargo arrives on the next swing": (
        7.41182, 0.0, "road", 66271.9, 13919.2e3, 0.134286,
        (865.744, 126573.0, 0.504744, 178202e3, 720925e3),
        (30386.8, 510529.0, 1.58080, 11025.4e3, 55800.0e3)),
    "cargo arrives on the next swing, with friction": (
        20.7996, 5306.57, "road", 3529.70, 20320.2e3, 0.128642,
        (900.599, 149084.0, 0.538772, 190339e3, 1141780e3),
        (5608.10, 632783.0, 1.87560, 8431.85e3, 76330.6e3)),
    "cargo arrives after the engine's third contact": (
        19.2785, 0.0, "road", 2274.05, 2030.70e3, 0.155654,
        (868.175, 106772.0, 0.536689, 166630e3, 739334e3),
        (5700.54, 586508.0, 1.61270, 10010.4e3, 20947.6e3)),
    # The body sticks to the pier and slips off backwards where its acceleration is still zero.
    "body sticks to the pier and slips": (
        13.1611, 33524.4, "pier", 2023.31, 520.020e3, 0.0131524,
        (665.413, 124341.0, 0.440150, 177214e3, 1343030e3),
        (6021.65, 372681.0, 1.38459, 9477.12e3, 92949.0e3)),
    # The engine turns 0.2 mm after its contact.
    "engine hardly arrives": (
        18.1026, 4889.30, "road", 50476.6, 26964.5e3, 0.0772216,
        (679.420, 165446.0, 0.643783, 129770e3, 996681e3),
        (37637.9, 596514.0, 1.93195, 8678.50e3, 29557.2e3)),
}
# fmt: on
_SPRING = ("plateau_force", "plateau_length", "stiffness", "unloading_stiffness")


def _written_out(speed, friction_force, friction_on, mass, stiffness, damping_ratio, engine, body):
    truck = Truck(
        name="hard to follow",
        engine_mass=engine[0],
        body_mass=body[0],
        engine_spring=CrushSpring(**dict(zip(_SPRING, engine[1:], strict=True))),
        body_spring=CrushSpring(**dict(zip(_SPRING, body[1:], strict=True))),
        friction_force=friction_force,
        friction_on=friction_on,
    )
    pier = EquivalentPier(mass=mass, stiffness=stiffness, damping_ratio=damping_ratio)
    return Case(truck, pier, speed)


HARD = {name: _written_out(*row) for name, row in _HARD.items()}
