"""The domain in which the design formulas were studied."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pierimpact.motion import Collision, Spring

Array = NDArray[np.float64]

# Smallest and largest value, and unit, of everything that was varied. The truck's parameters
# are 30 % about the reference truck `single-unit-8t`.
DOMAIN: dict[str, tuple[float, float, str]] = {
    "truck mass": (6e3, 20e3, "kg"),
    "speed": (50.0 / 3.6, 110.0 / 3.6, "m/s"),
    "pier frequency": (5.0, 150.0, "Hz"),
    "pier mass": (3e3, 100e3, "kg"),
    "pier stiffness": (0.05e9, 6e9, "N/m"),
    "damping ratio": (0.02, 0.07, "-"),
    "engine mass": (490.0, 910.0, "kg"),
    "engine plateau force": (105e3, 195e3, "N"),
    "engine plateau length": (0.35, 0.65, "m"),
    "engine stiffness": (105e6, 195e6, "N/m"),
    "engine unloading stiffness": (630e6, 1170e6, "N/m"),
    "body plateau force": (350e3, 650e3, "N"),
    "body plateau length": (1.33, 2.47, "m"),
    "body stiffness": (7e6, 13e6, "N/m"),
    "body unloading stiffness": (42e6, 78e6, "N/m"),
    "friction force": (15.05e3, 27.95e3, "N"),
}
SPRING = ("plateau force", "plateau length", "stiffness", "unloading stiffness")


def values(case: Collision) -> dict[str, Any]:
    """Return what DOMAIN bounds, of a collision or of many."""
    found = {
        "truck mass": case.engine.mass + case.body.mass,
        "speed": case.speed,
        "pier frequency": np.sqrt(case.pier_stiffness / case.pier_mass) / (2.0 * math.pi),
        "pier mass": case.pier_mass,
        "pier stiffness": case.pier_stiffness,
        "damping ratio": case.pier_damping / (2.0 * np.sqrt(case.pier_stiffness * case.pier_mass)),
        "engine mass": case.engine.mass,
        "friction force": case.friction_force,
    }
    for body, spring in (("engine", case.engine), ("body", case.body)):
        for name, value in zip(SPRING, spring[1:], strict=True):
            found[f"{body} {name}"] = value
    return found


def warnings(case: Collision) -> tuple[str, ...]:
    """Return a sentence for each value of one collision that is outside the studied domain."""
    found = values(case)
    # A bound met but for round-off is met.
    return tuple(
        f"{name} {found[name]:.4g} {unit} is outside the studied {low:.4g} to {high:.4g} {unit}: "
        f"the design formulas were not checked there"
        for name, (low, high, unit) in DOMAIN.items()
        if not low * (1.0 - 1e-9) <= found[name] <= high * (1.0 + 1e-9)
    )


def sample(size: int, seed: int) -> Collision:
    """Return random collisions of the domain, as arrays of shape (size,).

    Pier frequency and mass are uniform in their logarithms, where the stiffness allows; all else
    is uniform.

    Parameters
    ----------
    size : int
        Number of collisions.
    seed : int
        Seed of the random numbers.
    """
    random = np.random.default_rng(seed)

    def uniform(name: str) -> Array:
        low, high, _ = DOMAIN[name]
        return random.uniform(low, high, size)

    mass, stiffness = np.empty(0), np.empty(0)
    while len(mass) < size:
        low, high = np.log([DOMAIN[name][:2] for name in ("pier frequency", "pier mass")]).T
        frequency, trial = np.exp(random.uniform(low, high, (size, 2))).T
        stiff = trial * (2.0 * math.pi * frequency) ** 2
        softest, stiffest, _ = DOMAIN["pier stiffness"]
        keep = (stiff >= softest) & (stiff <= stiffest)
        mass, stiffness = np.append(mass, trial[keep]), np.append(stiffness, stiff[keep])
    mass, stiffness = mass[:size], stiffness[:size]
    engine_mass = uniform("engine mass")
    return Collision(
        engine=Spring(engine_mass, *(uniform(f"engine {name}") for name in SPRING)),
        body=Spring(
            uniform("truck mass") - engine_mass, *(uniform(f"body {name}") for name in SPRING)
        ),
        friction_force=uniform("friction force"),
        on_pier=np.zeros(size, dtype=bool),
        pier_mass=mass,
        pier_stiffness=stiffness,
        pier_damping=2.0 * uniform("damping ratio") * np.sqrt(stiffness * mass),
        speed=uniform("speed"),
    )
