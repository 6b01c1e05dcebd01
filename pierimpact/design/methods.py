"""The methods that a collision is calculated with elsewhere, beside the full model and the codes.

Hard impact on a spring and its plastic bound, as in the JCSS Probabilistic Model Code; Hertz's
elastic contact, in which nothing is crushed; and an energy check of the pier. Each says what it
takes for granted, on which side it errs, and where it is from.
"""

import math
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.certainty import Certainty
from pierimpact.checks import (
    InputError,
    broadcast,
    not_negative,
    positive,
    positive_array,
    told_from,
)
from pierimpact.collision.contact_forces import contact_forces
from pierimpact.collision.parameters import Collision
from pierimpact.design.codes import (
    JCSS_STIFFNESS,
    CodeForce,
    aashto_lrfd,
    en_1991_1_7_table,
    hard_impact,
    jtg_d60,
)
from pierimpact.design.procedure import by_symbol, contact_speed
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.vehicle.truck import Truck

Array: TypeAlias = NDArray[np.float64]

WINDOW = 0.025  # over which the contact force is averaged, as read in NCHRP Report 892 [s]
_JCSS = "JCSS Probabilistic Model Code, Part 2, 2.18"


class Method(NamedTuple):
    """What stands behind a force."""

    name: str
    source: str
    certainty: Certainty | None  #: of the source; None for what is derived here
    assumptions: str  #: in one sentence
    errs: str  #: on which side of the full model with the reference truck, and why

    @property
    def status(self) -> str:
        """What is printed beside the method."""
        return "derived here" if self.certainty is None else self.certainty.standard_words


HARD_IMPACT = Method(
    "Hard impact",
    _JCSS,
    Certainty.READ,
    "The vehicle is one mass on one linear spring, and the pier does not move.",
    "Low: 300 kN/m stops the truck within metres, as if it crumpled all along; engine and cargo "
    "are stopped over some 3 and 35 cm once the crumple length in front of them is used up.",
)
PLASTIC_IMPACT = Method(
    "Plastic bound",
    _JCSS,
    Certainty.READ,
    "The weaker of vehicle and pier yields at a constant force until the vehicle has stopped.",
    "Low once engine or cargo meet the pier. Before that it is the contact force; the reaction to "
    "a force that sets in at once is up to twice as large.",
)
HERTZ_IMPACT = Method(
    "Hertz contact",
    "Hertz’s theory of elastic contact",
    None,
    "A rigid cylinder across the travel, with the whole mass of the truck, strikes an elastic "
    "column that does not move, and nothing crushes or yields.",
    "High by far: with no crush the truck stops within centimetres, at pressures that neither "
    "truck nor concrete can carry.",
)
ENERGY_CHECK = Method(
    "Energy check",
    "in the spirit of Tsang and Lam, but not theirs",
    None,
    "Engine and cargo strike once each, at one instant, before the pier has been displaced, and "
    "what kinetic energy the pier then has goes into its own work.",
    "High for a stiff pier, which moves and pushes back while the blow lasts; low where the "
    "plateaus do the work, or a truck heavier than the pier follows it and pushes on.",
)


#: The methods of this file.
METHODS = (HARD_IMPACT, PLASTIC_IMPACT, HERTZ_IMPACT, ENERGY_CHECK)


def hertz_stiffness(
    striker_radius: float,
    column_diameter: float,
    elastic_modulus: float,
    poisson_ratio: float = 0.2,
) -> float:
    """Return k_H of Hertz's contact F = k_H δ^(3/2) of two cylinders at right angles [N/m^(3/2)].

    A rigid striker, a cylinder that lies across the travel, meets an upright elastic column.
    Derived here from Hertz's pressure over an ellipse of half-axes a ≥ b: with E* = E/(1 − ν²), the
    elliptic integrals K and E of the parameter 1 − b²/a², and A and B half the curvatures,
    b² = δ E/((A + B) K) and F = (2π/3) E* (A + B) a b²/E.

    Parameters
    ----------
    striker_radius, column_diameter : float
        Of the two cylinders [m].
    elastic_modulus : float
        Of the column [Pa].
    poisson_ratio : float, optional
        Of the column, from 0 to 0.5 [-].

    Raises
    ------
    InputError
        When a value is out of range.
    """
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipk, elliprd

    radii = (
        positive("striker_radius", striker_radius),
        0.5 * positive("column_diameter", column_diameter),
    )
    modulus = positive("elastic_modulus", elastic_modulus)
    nu = not_negative("poisson_ratio", poisson_ratio)
    if nu > 0.5:
        raise InputError(f"poisson_ratio must be at most 0.5, got {told_from(nu, 0.5)}")
    ratio = max(radii) / min(radii)

    def excess(n: float) -> float:
        # B/A, the ratio of the curvatures that flatten to an ellipse of b²/a² = n.
        return float(elliprd(0.0, 1.0, n) / elliprd(0.0, n, 1.0) - ratio)

    n = brentq(excess, 1.0 / ratio**2, 1.0, xtol=1e-15) if ratio > 1.0 else 1.0
    curvatures = 0.5 / radii[0] + 0.5 / radii[1]
    first, second = ellipk(1.0 - n), ellipe(1.0 - n)
    effective = modulus / (1.0 - nu**2)
    factor = 2.0 * math.pi / 3.0 * math.sqrt(second / (n * curvatures * first**3))
    return float(effective * factor)


def hertz_impact(speed: ArrayLike, mass: ArrayLike, stiffness: float) -> Array:
    """Return the largest force of an impact on Hertz's contact [N]; derived here.

    Nothing is lost: ½ m v² = (2/5) k_H δ^(5/2) and F = k_H δ^(3/2).

    Parameters
    ----------
    speed, mass : array_like
        Of the striker [m/s], [kg].
    stiffness : float
        k_H, as from `hertz_stiffness` [N/m^(3/2)].

    Raises
    ------
    InputError
        When a value is not positive.
    """
    v, m = _speeds_and_masses(speed, mass)
    stiffness = positive("stiffness", stiffness)
    indentation = (1.25 * m * v**2 / stiffness) ** 0.4
    return np.asarray(stiffness * indentation**1.5)


def _energy_after_blows(collision: Collision) -> float:
    """Return the kinetic energy that the blows leave in the pier [J]; derived here.

    Engine and cargo arrive with what speed their plateaus leave them, v_i² = V² − 2 a_i d_i. Each
    strikes the free mass m_p once, with the restitution e_i of its spring, and makes it faster by
    (1 + e_i) m_i/(m_i + m_p) times the relative speed. The energy is ½ m_p x_p'².
    """
    v, truck = by_symbol(collision.parameters), collision.truck
    pier_speed, mp = 0.0, v["mp"]
    for i, force, spring in (
        (1, v["P1"], truck.engine_spring),
        (2, v["P2"] + v["cs"], truck.body_spring),
    ):
        m = v[f"m{i}"]
        arrival = contact_speed(v["V"], force / m, v[f"d{i}"])
        gain = (1.0 + spring.restitution) * m / (m + mp)
        pier_speed += gain * max(arrival - pier_speed, 0.0)
    return float(0.5 * mp * pier_speed**2)


def _reaction_at(energy: float, pier: EquivalentPier) -> float:
    """Return the reaction at which the pier has taken up an energy, at most its yield reaction."""
    return min(math.sqrt(2.0 * pier.stiffness * energy), pier.yield_reaction)


def _speeds_and_masses(speed: ArrayLike, mass: ArrayLike) -> tuple[Array, ...]:
    """Return both as arrays of one shape, each above zero."""
    return broadcast(
        {"speed": positive_array("speed", speed), "mass": positive_array("mass", mass)}
    )


class Comparison(NamedTuple):
    """The forces of one truck, its speed or mass changed, by every method; arrays of one shape."""

    speed: Array  #: [m/s]
    mass: Array  #: of the truck [kg]
    peak_reaction: Array  #: of the full model [N]
    average_force: Array  #: largest average of its contact force over WINDOW [N]
    hard: Array  #: largest of the hard impact on the mean stiffness of JCSS [N]
    plastic: Array  #: the lower of the forces at which truck and pier yield [N]
    hertz: Array  #: largest of Hertz's contact [N]
    energy_reaction: Array  #: reaction of the energy check [N]
    codes: tuple[CodeForce, ...]  #: whose forces do not depend on speed or mass


def compare_methods(
    truck: Truck,
    pier: EquivalentPier,
    speed: ArrayLike,
    mass: ArrayLike,
    contact_stiffness: float,
) -> Comparison:
    """Return the forces by every method, over speed and mass.

    Parameters
    ----------
    truck : Truck
        The truck; its total mass is set by cargo. Its yield force is that of both plateaus.
    pier : EquivalentPier
        The pier.
    speed, mass : array_like
        Speeds [m/s] and total masses of the truck [kg], which broadcast against each other.
    contact_stiffness : float
        Of the Hertz contact [N/m^(3/2)].

    Raises
    ------
    InputError
        As in `Collision`, `Truck.with_mass` and `hertz_impact`.
    """
    speed, mass = _speeds_and_masses(speed, mass)
    collisions = [
        Collision(truck.loaded_to(m), pier, v) for v, m in zip(speed.flat, mass.flat, strict=True)
    ]
    peaks, forces = contact_forces(collisions, [WINDOW])
    energies = [_energy_after_blows(each) for each in collisions]
    plateaus = truck.engine_spring.plateau_force + truck.body_spring.plateau_force
    shaped = partial(np.reshape, shape=speed.shape)
    return Comparison(
        speed=speed,
        mass=mass,
        peak_reaction=shaped(peaks.governing),
        average_force=shaped(forces.averages[0]),
        hard=hard_impact(speed, mass, JCSS_STIFFNESS),
        plastic=np.full(speed.shape, min(plateaus, pier.yield_reaction)),
        hertz=hertz_impact(speed, mass, contact_stiffness),
        energy_reaction=shaped([_reaction_at(energy, pier) for energy in energies]),
        codes=(aashto_lrfd(), jtg_d60(), en_1991_1_7_table("motorway")),
    )
