"""The traffic beside a pier and its way from the road to it, by the JCSS Probabilistic Model Code.

A truck leaves the road anywhere along it with the same chance, at an angle α to it, and brakes at a
constant rate a. Struck is what stands in its way over a width b across its course: a stretch
Δx = b / sin μ(α) of the road leads there. It arrives with v_r² = v_0² − 2 a d / sin α, or not at
all. JCSS, Part 2, 2.18.
"""

import math
from dataclasses import dataclass
from functools import cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.certainty import Certainty
from pierimpact.checks import InputError, brief, not_negative, one_of, positive
from pierimpact.design.codes import JCSS_STIFFNESS
from pierimpact.risk.distributions import Distribution
from pierimpact.risk.laws import Lognormal, Normal, Rayleigh

Array: TypeAlias = NDArray[np.float64]

#: A year as traffic counts have it [s]: the daily traffic is a 365th of the year's, exactly.
YEAR = 365.0 * 24.0 * 3600.0
#: Chance of leaving the road, as read in the JCSS model code [1/(vehicle m)].
ENCROACHMENT_RATE = 1e-10
#: Least width that a structure offers, as read in the JCSS model code [m].
LEAST_WIDTH = 2.5
#: Speeds on the road by its class, mean and standard deviation of a lognormal law, as read in the
#: JCSS model code [km/h].
ROAD_SPEEDS = {"motorway": (80.0, 10.0), "urban": (40.0, 7.0), "courtyard": (15.0, 6.0)}
#: Least mass of a truck: this project's choice, where the normal law of JCSS is truncated [kg].
LEAST_TRUCK = 3500.0
#: Angles that a truck leaves the road at [rad], exactly.
ANGLES = (0.0, 0.5 * math.pi)


def jcss_speed(road: str = "motorway") -> Distribution:
    """Return the speeds on a road of a class of JCSS, one of ROAD_SPEEDS."""
    mean, deviation = ROAD_SPEEDS[one_of("traffic_speed", road, tuple(ROAD_SPEEDS))]
    return Distribution(
        law=Lognormal.of(mean / 3.6, deviation / 3.6),
        words=f"JCSS, {road}: lognormal, {mean:g} ± {deviation:g} km/h",
        status=Certainty.READ,
    )


@cache
def jcss_mass() -> Distribution:
    """Return the masses of trucks of JCSS, as read there: normal, 20 ± 12 t; here from 3.5 t on."""
    return Distribution(
        law=Normal(20e3, 12e3),
        words="JCSS, trucks: normal, 20 ± 12 t, here truncated to 3.5 t and more",
        status=Certainty.READ,
        low=LEAST_TRUCK,
    )


@cache
def jcss_deceleration() -> Distribution:
    """Return the decelerations off the road of JCSS, as read there: lognormal, 4 ± 1.3 m/s²."""
    words = "JCSS: lognormal, 4 ± 1.3 m/s²"
    return Distribution(law=Lognormal.of(4.0, 1.3), words=words, status=Certainty.READ)


@cache
def jcss_angle() -> Distribution:
    """Return the angles between course and road of JCSS, as read there: Rayleigh, mean 10°."""
    law, words = Rayleigh.of(math.radians(10.0)), "JCSS: Rayleigh, mean 10°"
    return Distribution(law=law, words=words, status=Certainty.READ, bounds=ANGLES)


@cache
def jcss_stiffness() -> Distribution:
    """Return the stiffnesses of vehicles of JCSS, as read there: lognormal, 300 ± 60 kN/m."""
    words = "JCSS: lognormal, 300 ± 60 kN/m"
    return Distribution(law=Lognormal.of(JCSS_STIFFNESS, 60e3), words=words, status=Certainty.READ)


@dataclass(frozen=True, kw_only=True, eq=False)
class WeighedTrucks:
    """Trucks of a weigh-in-motion sample, each as likely as the other.

    Parameters
    ----------
    mass : ndarray, shape (n,)
        Their masses, all above zero [kg].
    speed : ndarray, shape (n,), or None
        Their speeds, all above zero; None where they were not measured [m/s].
    words : str
        How the sample prints.

    Raises
    ------
    InputError
        When there is no truck.
    """

    mass: Array
    speed: Array | None = None
    words: str = "a sample"

    def __post_init__(self) -> None:
        if not len(self.mass):
            raise InputError("a weigh-in-motion sample must have a truck, got none")
        order = np.argsort(-self.mass, kind="stable")
        object.__setattr__(self, "mass", self.mass[order])
        if self.speed is not None:
            object.__setattr__(self, "speed", self.speed[order])

    def place(self, share: Array) -> NDArray[np.int_]:
        """Return which trucks these shares of all are heavier than, same shape."""
        places = (share * len(self.mass)).astype(int)
        return np.asarray(np.minimum(places, len(self.mass) - 1))


@dataclass(frozen=True, kw_only=True, eq=False)
class Traffic:
    """The trucks that pass a pier.

    Parameters
    ----------
    trucks : float
        How many pass in a second, on the lanes from which they may come to the pier [1/s].
    distance : float
        Distance d of the pier from the edge of the road, zero or more [m].
    width : float, optional
        Width b that the pier offers across the course of a truck, the truck's included [m].
    encroachment_rate : float, optional
        Chance λ of leaving the road toward the pier [1/(vehicle m)].
    mass : Distribution or WeighedTrucks, optional
        Masses of the trucks [kg].
    speed, deceleration, angle : Distribution, optional
        Speeds on the road [m/s], decelerations off it [m/s²], and angles between course and road
        [rad]. The speeds of weighed trucks are their own where they were measured.

    Raises
    ------
    InputError
        When a number is out of range or a law of another type.
    """

    trucks: float
    distance: float
    width: float = LEAST_WIDTH
    encroachment_rate: float = ENCROACHMENT_RATE
    mass: Distribution | WeighedTrucks
    speed: Distribution
    deceleration: Distribution
    angle: Distribution

    def __post_init__(self) -> None:
        rules = dict.fromkeys(("trucks", "width", "encroachment_rate"), positive)
        for name, rule in {**rules, "distance": not_negative}.items():
            object.__setattr__(self, name, rule(name, getattr(self, name)))
        for name in ("mass", "speed", "deceleration", "angle"):
            law = getattr(self, name)
            if isinstance(law, WeighedTrucks) and name == "mass":
                continue
            if not isinstance(law, Distribution):
                raise InputError(f"{name} must be a Distribution, got {brief(law)}")

    @property
    def stretch(self) -> float:
        """Length of road that leads to the pier, Δx = b / sin μ(α) [m]."""
        return self.width / math.sin(self.angle.mean)

    @property
    def departures(self) -> float:
        """Trucks that leave the road toward the pier, n λ Δx [1/s]."""
        return self.trucks * self.encroachment_rate * self.stretch

    def masses_and_speeds(self, mass: Array, speed: Array) -> tuple[Array, Array]:
        """Return masses [kg] and speeds on the road [m/s] exceeded by these shares of trucks."""
        if isinstance(self.mass, Distribution):
            return self.mass.exceeded_by(mass), self.speed.exceeded_by(speed)
        place = self.mass.place(mass)
        if self.mass.speed is None:
            return self.mass.mass[place], self.speed.exceeded_by(speed)
        return self.mass.mass[place], self.mass.speed[place]

    def arrivals(self, speed: Array, deceleration: Array, share: Array) -> tuple[Array, Array]:
        """Return the chance of arriving at the pier [-] and the speed there [m/s].

        Of the angles only those count at which a truck arrives: v_0² > 2 a d / sin α.

        Parameters
        ----------
        speed, deceleration : ndarray
            On the road [m/s], and off it [m/s²].
        share : ndarray
            Share of the angles that count which are larger than the truck's, above 0 to 1 [-].
        """
        least = np.arcsin(np.minimum(2.0 * deceleration * self.distance / speed**2, 1.0))
        chance = self.angle.share_above(least)
        angle = self.angle.exceeded_by(np.maximum(share * chance, np.finfo(float).tiny))
        lost = 2.0 * deceleration * self.distance / np.sin(np.maximum(angle, least))
        # The sine of the smallest angle may be zero, where the pier stands beside the road.
        lost = lost if self.distance else np.zeros_like(speed)
        return chance, np.sqrt(np.maximum(speed**2 - lost, 0.0))
