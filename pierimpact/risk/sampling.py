"""Trucks that come to a pier, drawn at random, with heavy and fast ones more often than they come.

They are drawn in blocks, each with random numbers of its own, so that a block is the same whoever
draws it; and they do not depend on the pier, so that all piers beside a road meet the same trucks.

Of the angle only the part is drawn at which the truck arrives, and the truck counts with the
chance of that. In part of the draws, the shares of all trucks that are heavier, that are faster,
that brake less and that come more directly are raised to powers, so that what is rare is met more
often. A truck counts with the ratio of the densities, which the other part of the draws bounds.
This is importance sampling from a mixture; the powers are this project's choice, numerical.
"""

from collections.abc import Sequence
from functools import reduce
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.groups import join, repeat, select
from pierimpact.collision.parameters import Collision, Parameters
from pierimpact.design.band import with_factors
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.risk.traffic import Traffic, jcss_stiffness
from pierimpact.vehicle.truck import QUANTITIES, Truck

Array: TypeAlias = NDArray[np.float64]

#: Trucks of a block.
BLOCK = 8192
#: Share of the draws from the tails, numerical.
TILTED = 0.6
#: Powers of the shares of trucks that are heavier, faster, brake less and come more directly.
POWERS = np.array([[2.0], [3.0], [2.0], [2.0]])  # numerical
#: Most of a truck's mass that its engine may be: this project's choice.
HEAVIEST_ENGINE = 0.5
# Random numbers of a truck beside those of its parameters: mass, speed, deceleration, angle, which
# part of the draws, stiffness of JCSS.
_OF_TRAFFIC = 6


class Arrivals(NamedTuple):
    """Trucks at the pier, arrays of shape (n,)."""

    weight: Array  #: trucks on the way to the pier that one stands for, over their number [-]
    mass: Array  #: [kg]
    road_speed: Array  #: before the truck leaves the road [m/s]
    speed: Array  #: at the pier; zero where it does not arrive [m/s]
    hard_impact: Array  #: v √(k m) of JCSS [N]
    truck: NDArray[np.int_]  #: which of the trucks
    factors: Array  #: on the parameters of QUANTITIES, shape (n, parameters) [-]


def draw(
    traffic: Traffic,
    trucks: Sequence[Truck],
    block: int,
    seed: int = 0,
    size: int = BLOCK,
    tilted: float = TILTED,
) -> Arrivals:
    """Return the trucks of one block.

    Parameters
    ----------
    traffic : Traffic
        Traffic beside the pier.
    trucks : sequence of Truck
        What trucks there are: each mass goes with the one whose range of masses is next to it.
    block : int
        Number of the block.
    seed : int, optional
        Seed of the random numbers.
    size : int, optional
        How many of the block's trucks, the first ones, at most BLOCK.
    tilted : float, optional
        Share of the draws from the tails; none is plain Monte Carlo [-].
    """
    random = np.random.default_rng([seed, block])
    # Neither 0, which is numerical, nor 1, which it never is.
    share = np.maximum(random.random((_OF_TRAFFIC + len(QUANTITIES), BLOCK))[:, :size], 0.5**54)
    own, of_truck = share[:_OF_TRAFFIC], share[_OF_TRAFFIC:]
    heavier, faster, slower, more_direct = rare = np.where(
        own[4] <= tilted, own[:4] ** POWERS, own[:4]
    )
    density = 1.0 - tilted + tilted * np.prod(rare ** (1.0 / POWERS - 1.0) / POWERS, axis=0)
    mass, road_speed = traffic.masses_and_speeds(heavier, faster)
    braking = traffic.deceleration.exceeded_by(np.maximum(1.0 - slower, 0.5**54))
    chance, speed = traffic.arrivals(road_speed, braking, more_direct)
    stiffness = jcss_stiffness().exceeded_by(own[5])
    which = nearest(mass, trucks)
    return Arrivals(
        weight=np.where(speed > 0.0, chance, 0.0) / density,
        mass=mass,
        road_speed=road_speed,
        speed=speed,
        hard_impact=speed * np.sqrt(stiffness * mass),
        truck=which,
        factors=_factors(trucks, which, of_truck).T,
    )


def nearest(mass: Array, trucks: Sequence[Truck]) -> NDArray[np.int_]:
    """Return for each mass [kg] the truck whose range of masses it is in, or else nearest to."""
    gaps = [
        np.maximum(np.maximum(low / mass, mass / high), 1.0)
        for truck in trucks
        for low, high in [truck.mass_range or (truck.mass, truck.mass)]
    ]
    return np.asarray(np.argmin(gaps, axis=0))


def _factors(trucks: Sequence[Truck], which: NDArray[np.int_], fraction: Array) -> Array:
    """Return the factors on the parameters of each truck by its spread."""
    factors = np.ones_like(fraction)
    for number, truck in enumerate(trucks):
        own = which == number
        for row, name in enumerate(QUANTITIES):
            if name in truck.spread:
                factors[row, own] = truck.spread[name].factor(fraction[row, own])
    return factors


def collisions(trucks: Sequence[Truck], pier: EquivalentPier, arrivals: Arrivals) -> Parameters:
    """Return the collisions of trucks with a pier, with the mass of each in body and cargo.

    The engine has at most half of the mass. All must arrive.
    """
    each = [repeat(Collision(truck, pier, 1.0).parameters, 1) for truck in trucks]
    found = with_factors(select(reduce(join, each), arrivals.truck), QUANTITIES, arrivals.factors.T)
    engine = np.minimum(found.engine.mass, HEAVIEST_ENGINE * arrivals.mass)
    return found._replace(
        engine=found.engine._replace(mass=engine),
        body=found.body._replace(mass=arrivals.mass - engine),
        speed=arrivals.speed,
    )
