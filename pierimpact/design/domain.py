"""The domain in which the design formulas were studied."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.parameters import Parameters, Spring
from pierimpact.design.procedure import by_symbol
from pierimpact.pier.equivalent import (
    damping_coefficient,
    natural_frequency,
    stiffness_at_frequency,
)
from pierimpact.symbols import SYMBOLS

Array = NDArray[np.float64]


class Range(NamedTuple):
    """From where to where a value was varied, in a unit of the given size in SI."""

    low: float
    high: float
    unit: str
    size: float


# This project's choice. The truck's parameters are 30 % about the reference truck
# `single-unit-8t`; its friction goes down to none, and acts on the road or on the pier.
DOMAIN = {
    "m": Range(6.0, 20.0, "t", 1e3),
    "V": Range(50.0, 110.0, "km/h", 1.0 / 3.6),
    "fp": Range(5.0, 150.0, "Hz", 1.0),
    "mp": Range(3.0, 100.0, "t", 1e3),
    "kp": Range(50.0, 6000.0, "MN/m", 1e6),
    "zeta": Range(2.0, 7.0, "%", 1e-2),
    "m1": Range(490.0, 910.0, "kg", 1.0),
    "P1": Range(105.0, 195.0, "kN", 1e3),
    "d1": Range(0.35, 0.65, "m", 1.0),
    "k1": Range(105.0, 195.0, "MN/m", 1e6),
    "ku1": Range(630.0, 1170.0, "MN/m", 1e6),
    "P2": Range(350.0, 650.0, "kN", 1e3),
    "d2": Range(1.33, 2.47, "m", 1.0),
    "k2": Range(7.0, 13.0, "MN/m", 1e6),
    "ku2": Range(42.0, 78.0, "MN/m", 1e6),
    "cs": Range(0.0, 27.95, "kN", 1e3),
}


def bounds(name: str) -> tuple[float, float]:
    """Return from where to where a value was varied, in SI."""
    low, high, _, size = DOMAIN[name]
    return low * size, high * size


def values(parameters: Parameters) -> dict[str, Any]:
    """Return what DOMAIN bounds, of a collision or of many."""
    found = by_symbol(parameters)
    found |= {"m": found["m1"] + found["m2"], "fp": natural_frequency(found["mp"], found["kp"])}
    return {name: found[name] for name in DOMAIN}


class Outside(NamedTuple):
    """A value outside the studied domain, and the bounds that it does not keep, in SI."""

    name: str
    value: float
    low: float
    high: float


def outside(parameters: Parameters) -> tuple[Outside, ...]:
    """Return the values of one collision that are outside the studied domain."""
    found = values(parameters)
    # A bound met but for round-off is met.
    return tuple(
        Outside(name, float(found[name]), low, high)
        for name, (low, high) in ((name, bounds(name)) for name in DOMAIN)
        if not low * (1.0 - 1e-9) <= found[name] <= high * (1.0 + 1e-9)
    )


def warnings(parameters: Parameters) -> tuple[str, ...]:
    """Return a sentence for each value of one collision that is outside the studied domain.

    And one for a pier that yields, for the piers of the domain are elastic.
    """
    sentences = tuple(
        f"{SYMBOLS[name].meaning} {value / size:.4g} {unit} is outside the studied {low:g} to "
        f"{high:g} {unit}: the design formulas were not checked there"
        for name, value, _, _ in outside(parameters)
        for low, high, unit, size in [DOMAIN[name]]
    )
    if parameters.yield_reaction is not None and np.isfinite(parameters.yield_reaction):
        sentences += (
            f"{SYMBOLS['Ry'].meaning} {parameters.yield_reaction / 1e6:.4g} MN is of a pier that "
            "yields: the design formulas are for elastic piers, the full model takes the yielding",
        )
    return sentences


def sample(size: int, seed: int) -> Parameters:
    """Return random collisions of the domain, as arrays of shape (size,), by a generator's seed.

    Pier frequency and mass are uniform in their logarithms, where the stiffness allows; all else
    is uniform, the friction on road or pier with equal chance.
    """
    random = np.random.default_rng(seed)

    def uniform(name: str) -> Array:
        low, high = bounds(name)
        return random.uniform(low, high, size)

    mass, stiffness = np.empty(0), np.empty(0)
    while len(mass) < size:
        low, high = np.log([bounds("fp"), bounds("mp")]).T
        frequency, trial = np.exp(random.uniform(low, high, (size, 2))).T
        stiff = stiffness_at_frequency(trial, frequency)
        softest, stiffest = bounds("kp")
        keep = (stiff >= softest) & (stiff <= stiffest)
        mass, stiffness = np.append(mass, trial[keep]), np.append(stiffness, stiff[keep])
    mass, stiffness = mass[:size], stiffness[:size]
    engine_mass = uniform("m1")
    return Parameters(
        engine=Spring(engine_mass, *(uniform(name) for name in ("P1", "d1", "k1", "ku1"))),
        body=Spring(
            uniform("m") - engine_mass, *(uniform(name) for name in ("P2", "d2", "k2", "ku2"))
        ),
        friction_force=uniform("cs"),
        on_pier=random.uniform(size=size) < 0.5,
        pier_mass=mass,
        pier_stiffness=stiffness,
        pier_damping=damping_coefficient(mass, stiffness, uniform("zeta")),
        speed=uniform("V"),
    )
