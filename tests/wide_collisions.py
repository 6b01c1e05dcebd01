"""Collisions far beyond any real one: what numbers can do, not what trucks do."""

import math

import numpy as np
from generated_collisions import Case

from pierimpact import CrushSpring, EquivalentPier, Truck, load_truck

REFERENCE = load_truck("single-unit-8t")
# Of the pier, bounds of mass [kg], frequency [Hz] and speed [m/s]; factors about the reference
# truck's masses and springs; of all the share with what sits on a corner.
PIER_MASS, FREQUENCY, SPEED = (100.0, 1e9), (0.1, 3e3), (0.1, 200.0)
FACTOR, FRICTION, YIELD = 10.0, (1.0, 1e8), (10.0**-2.5, 10.0**2.5)
CORNER = 0.2


def wide_collisions(size, seed):
    """Collisions over that space, and their yield reactions among the piers."""
    random = np.random.default_rng(seed)
    return [_collision(random) for _ in range(size)]


def _evenly(random, low, high):
    return math.exp(random.uniform(math.log(low), math.log(high)))


def _damping_ratio(random):
    kind = random.random()
    if kind < 0.15:
        return 0.0
    if kind < 0.4:
        return random.uniform(0.0, 1.0)
    if kind < 0.7:
        return 1.0 - 10.0 ** random.uniform(-6.0, 0.0)
    if kind < 0.95:
        return 10.0 ** random.uniform(-6.0, -0.001)
    return min(1.0 - 10.0 ** random.uniform(-16.0, -6.0), math.nextafter(1.0, 0.0))


def _spring(random, like):
    stiffness = like.stiffness * _evenly(random, 1.0 / FACTOR, FACTOR)
    force = like.plateau_force * _evenly(random, 1.0 / FACTOR, FACTOR)
    elastic = random.random() < CORNER
    unloading = stiffness * (1.0 if elastic else _evenly(random, 1.0, 30.0))
    limit = force / unloading
    length = limit if random.random() < CORNER else max(limit, _evenly(random, 1e-9, 10.0))
    return CrushSpring(
        plateau_force=force,
        plateau_length=length,
        stiffness=stiffness,
        unloading_stiffness=unloading,
    )


def _collision(random):
    engine_spring = _spring(random, REFERENCE.engine_spring)
    body_spring = _spring(random, REFERENCE.body_spring)
    engine_mass, body_mass = (
        mass * _evenly(random, 1.0 / FACTOR, FACTOR)
        for mass in (REFERENCE.engine_mass, REFERENCE.body_mass)
    )
    if random.random() < 0.5 * CORNER:
        body_spring = engine_spring
        body_mass = random.choice([engine_mass, body_mass])
    truck = Truck(
        name="wide",
        engine_mass=engine_mass,
        body_mass=body_mass,
        engine_spring=engine_spring,
        body_spring=body_spring,
        friction_force=0.0 if random.random() < CORNER else _evenly(random, *FRICTION),
        friction_on=random.choice(["road", "pier"]),
    )
    mass = _evenly(random, *PIER_MASS)
    forces = engine_spring.plateau_force + body_spring.plateau_force
    pier = EquivalentPier(
        mass=mass,
        stiffness=mass * (2.0 * math.pi * _evenly(random, *FREQUENCY)) ** 2,
        damping_ratio=_damping_ratio(random),
        yield_reaction=forces * _evenly(random, *YIELD) if random.random() < 0.4 else math.inf,
    )
    return Case(truck, pier, _evenly(random, *SPEED))
