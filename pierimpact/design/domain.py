"""The domain in which the design formulas were studied."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.parameters import Parameters, Spring
from pierimpact.pier.equivalent import (
    damping_coefficient,
    natural_frequency,
    stiffness_at_frequency,
)

Array = NDArray[np.float64]


class Range(NamedTuple):
    """From where to where a value was varied, in a unit of the given size in SI."""

    low: float
    high: float
    unit: str
    size: float


# The truck's parameters are 30 % about the reference truck `single-unit-8t`; its friction goes
# down to none, and acts on the road or on the pier.
DOMAIN = {
    "truck mass": Range(6.0, 20.0, "t", 1e3),
    "speed": Range(50.0, 110.0, "km/h", 1.0 / 3.6),
    "pier frequency": Range(5.0, 150.0, "Hz", 1.0),
    "pier mass": Range(3.0, 100.0, "t", 1e3),
    "pier stiffness": Range(50.0, 6000.0, "MN/m", 1e6),
    "damping ratio": Range(2.0, 7.0, "%", 1e-2),
    "engine mass": Range(490.0, 910.0, "kg", 1.0),
    "engine plateau force": Range(105.0, 195.0, "kN", 1e3),
    "engine plateau length": Range(0.35, 0.65, "m", 1.0),
    "engine stiffness": Range(105.0, 195.0, "MN/m", 1e6),
    "engine unloading stiffness": Range(630.0, 1170.0, "MN/m", 1e6),
    "body plateau force": Range(350.0, 650.0, "kN", 1e3),
    "body plateau length": Range(1.33, 2.47, "m", 1.0),
    "body stiffness": Range(7.0, 13.0, "MN/m", 1e6),
    "body unloading stiffness": Range(42.0, 78.0, "MN/m", 1e6),
    "friction force": Range(0.0, 27.95, "kN", 1e3),
}
SPRING = ("plateau force", "plateau length", "stiffness", "unloading stiffness")


def bounds(name: str) -> tuple[float, float]:
    """Return from where to where a value was varied, in SI."""
    low, high, _, size = DOMAIN[name]
    return low * size, high * size


def values(parameters: Parameters) -> dict[str, Any]:
    """Return what DOMAIN bounds, of a collision or of many."""
    found = {
        "truck mass": parameters.engine.mass + parameters.body.mass,
        "speed": parameters.speed,
        "pier frequency": natural_frequency(parameters.pier_mass, parameters.pier_stiffness),
        "pier mass": parameters.pier_mass,
        "pier stiffness": parameters.pier_stiffness,
        "damping ratio": parameters.pier_damping
        / (2.0 * np.sqrt(parameters.pier_stiffness * parameters.pier_mass)),
        "engine mass": parameters.engine.mass,
        "friction force": parameters.friction_force,
    }
    for body, spring in (("engine", parameters.engine), ("body", parameters.body)):
        for name, value in zip(SPRING, spring[1:], strict=True):
            found[f"{body} {name}"] = value
    return found


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
    """Return a sentence for each value of one collision that is outside the studied domain."""
    return tuple(
        f"{name} {value / DOMAIN[name].size:.4g} {DOMAIN[name].unit} is outside the studied "
        f"{DOMAIN[name].low:g} to {DOMAIN[name].high:g} {DOMAIN[name].unit}: the design formulas "
        "were not checked there"
        for name, value, _, _ in outside(parameters)
    )


def sample(size: int, seed: int) -> Parameters:
    """Return random collisions of the domain, as arrays of shape (size,).

    Pier frequency and mass are uniform in their logarithms, where the stiffness allows; all else
    is uniform, the friction on road or pier with equal chance.

    Parameters
    ----------
    size : int
        Number of collisions.
    seed : int
        Seed of the random numbers.
    """
    random = np.random.default_rng(seed)

    def uniform(name: str) -> Array:
        low, high = bounds(name)
        return random.uniform(low, high, size)

    mass, stiffness = np.empty(0), np.empty(0)
    while len(mass) < size:
        low, high = np.log([bounds("pier frequency"), bounds("pier mass")]).T
        frequency, trial = np.exp(random.uniform(low, high, (size, 2))).T
        stiff = stiffness_at_frequency(trial, frequency)
        softest, stiffest = bounds("pier stiffness")
        keep = (stiff >= softest) & (stiff <= stiffest)
        mass, stiffness = np.append(mass, trial[keep]), np.append(stiffness, stiff[keep])
    mass, stiffness = mass[:size], stiffness[:size]
    engine_mass = uniform("engine mass")
    return Parameters(
        engine=Spring(engine_mass, *(uniform(f"engine {name}") for name in SPRING)),
        body=Spring(
            uniform("truck mass") - engine_mass, *(uniform(f"body {name}") for name in SPRING)
        ),
        friction_force=uniform("friction force"),
        on_pier=random.uniform(size=size) < 0.5,
        pier_mass=mass,
        pier_stiffness=stiffness,
        pier_damping=damping_coefficient(mass, stiffness, uniform("damping ratio")),
        speed=uniform("speed"),
    )
