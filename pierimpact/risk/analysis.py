"""The risk of a pier: the trucks that come to it, and what they do to it by the full model."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError, brief, whole
from pierimpact.collision.groups import select, single
from pierimpact.collision.reactions import full_model
from pierimpact.design.band import truck_of
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.risk.exceedance import Exceedance
from pierimpact.risk.sampling import BLOCK, TILTED, collisions, draw
from pierimpact.risk.traffic import Traffic
from pierimpact.vehicle.truck import Truck

Array: TypeAlias = NDArray[np.float64]

#: Trucks drawn unless another number is asked for: this project's choice.
SIZE = 4 * BLOCK


class Strikes(NamedTuple):
    """Trucks at a pier and what they do to it, arrays of shape (n,)."""

    weight: Array  #: trucks on the way to the pier that one stands for, over their number [-]
    mass: Array  #: [kg]
    road_speed: Array  #: before the truck leaves the road [m/s]
    speed: Array  #: at the pier; zero where it does not arrive [m/s]
    truck: NDArray[np.int_]  #: which of the trucks
    reaction: Array  #: governing reaction by the full model; zero without a collision [N]
    by_engine: NDArray[np.bool_]  #: whether that is the engine peak
    hard_impact: Array  #: v √(k m) of JCSS [N]


class Task(NamedTuple):
    """What the strikes of a block are of."""

    traffic: Traffic
    trucks: tuple[Truck, ...]
    pier: EquivalentPier
    size: int  #: of all blocks
    seed: int
    tilted: float


#: From a function of a block's number and the numbers of the blocks to its results in their order.
Run: TypeAlias = Callable[[Callable[[int], Strikes], Iterable[int]], Iterable[Strikes]]


def strikes_of(task: Task, block: int) -> Strikes:
    """Return the strikes of one block, the same whoever calculates them."""
    size = min(BLOCK, task.size - block * BLOCK)
    arrivals = draw(task.traffic, task.trucks, block, task.seed, size, task.tilted)
    there = arrivals.weight > 0.0
    own = select(arrivals, there)
    reaction, by_engine = np.zeros(size), np.zeros(size, dtype=bool)
    if there.any():
        found = full_model(collisions(task.trucks, task.pier, own))
        reaction[there] = found.governing
        by_engine[there] = ~(found.cargo > found.engine)
    return Strikes(
        weight=arrivals.weight,
        mass=arrivals.mass,
        road_speed=arrivals.road_speed,
        speed=arrivals.speed,
        truck=arrivals.truck,
        # A collision that does not end, of which there is a warning, counts as a large one.
        reaction=np.where(np.isnan(reaction), np.inf, reaction),
        by_engine=by_engine,
        hard_impact=arrivals.hard_impact,
    )


class Feared(NamedTuple):
    """The trucks that bring about reactions above a value, with the 5 and 95 % ones around them."""

    mass: tuple[float, float, float]  #: 5, 50 and 95 % of them are lighter [kg]
    speed: tuple[float, float, float]  #: are slower at the pier [m/s]
    by_engine: float  #: share of them whose engine peak governs [-]
    beyond: float  #: share of them whose mass their truck's springs do not stand for [-]


class Strike(NamedTuple):
    """One of the collisions."""

    truck: Truck
    speed: float  #: at the pier [m/s]
    reaction: float  #: [N]


@dataclass(frozen=True, kw_only=True, eq=False)
class Risk:
    """How often the reaction of a pier exceeds values.

    Frequencies are of trucks and per second.
    """

    traffic: Traffic
    trucks: tuple[Truck, ...]
    pier: EquivalentPier
    seed: int
    tilted: float
    strikes: Strikes  #: of all draws

    @property
    def size(self) -> int:
        """How many trucks were drawn."""
        return len(self.strikes.weight)

    @cached_property
    def reaction(self) -> Exceedance:
        """Frequencies of reactions by the full model."""
        return Exceedance(self.strikes.reaction, self.strikes.weight, self.traffic.departures)

    @cached_property
    def hard_impact(self) -> Exceedance:
        """Frequencies of the force v √(k m) of JCSS from the same trucks."""
        return Exceedance(self.strikes.hard_impact, self.strikes.weight, self.traffic.departures)

    def nearest(self, reaction: float, count: int) -> list[Strike]:
        """Return the collisions whose reactions are nearest to one [N], or as many as there are."""
        apart = np.where(self.strikes.weight > 0.0, abs(self.strikes.reaction - reaction), np.inf)
        places = np.sort(np.argsort(apart, kind="stable")[:count]).tolist()
        return [self._strike(place) for place in places if apart[place] < np.inf]

    def _strike(self, place: int) -> Strike:
        """Return one of the collisions, drawn once more."""
        block, row = divmod(place, BLOCK)
        drawn = draw(self.traffic, self.trucks, block, self.seed, row + 1, self.tilted)
        one = select(drawn, slice(row, row + 1))
        own = single(collisions(self.trucks, self.pier, one), 0)
        truck = truck_of(own, self.trucks[int(one.truck[0])])
        return Strike(truck, own.speed, float(self.strikes.reaction[place]))

    def feared(self, reaction: float) -> Feared | None:
        """Return the trucks that bring about reactions above a value [N]; None without any."""
        above = select(self.strikes, self.strikes.reaction > reaction)
        weights = above.weight
        if not weights.sum() > 0.0:
            return None
        beyond = np.zeros(len(weights), dtype=bool)
        for number, truck in enumerate(self.trucks):
            if truck.mass_range is not None:
                low, high = truck.mass_range
                beyond |= (above.truck == number) & ~((low <= above.mass) & (above.mass <= high))
        return Feared(
            mass=weighted_quantiles(above.mass, weights),
            speed=weighted_quantiles(above.speed, weights),
            by_engine=float(np.average(above.by_engine, weights=weights)),
            beyond=float(np.average(beyond, weights=weights)),
        )


def weighted_quantiles(values: Array, weights: Array) -> tuple[float, float, float]:
    """Return what 5, 50 and 95 % of the weights are at or below, this project's choice."""
    order = np.argsort(values, kind="stable")
    sums = np.cumsum(weights[order])
    # Numerical: equal weights do not add up to exactly half of all.
    ends = np.array([0.05, 0.5, 0.95]) * sums[-1] * (1.0 - 1e-12)
    places = np.searchsorted(sums, ends)
    low, middle, high = values[order][np.minimum(places, len(values) - 1)].tolist()
    return low, middle, high


def in_turn(task: Callable[[int], Strikes], blocks: Iterable[int]) -> Iterator[Strikes]:
    """Calculate the blocks one after the other."""
    return map(task, blocks)


def risk(
    traffic: Traffic,
    trucks: Sequence[Truck],
    pier: EquivalentPier,
    size: int = SIZE,
    seed: int = 0,
    *,
    tilted: float = TILTED,
    run: Run = in_turn,
    progress: Callable[[int], object] = lambda count: None,
) -> Risk:
    """Return the risk of a pier beside a road.

    The same seed gives the same trucks whatever the pier and whoever calculates the blocks.

    Parameters
    ----------
    traffic : Traffic
        Traffic beside the pier.
    trucks : sequence of Truck
        What trucks there are, as in `sampling.draw`.
    pier : EquivalentPier
        The pier.
    size : int, optional
        Number of trucks drawn.
    seed : int, optional
        Seed of the random numbers.
    tilted : float, optional
        As in `sampling.draw`.
    run : callable, optional
        What calculates the blocks, in several processes perhaps, and gives them in their order.
    progress : callable, optional
        Called with the number of trucks done since the last call.

    Raises
    ------
    InputError
        When size or seed is out of range, or there is no truck.
    """
    size, seed = whole("size", size, 1), whole("seed", seed, 0)
    fleet = tuple(trucks) if isinstance(trucks, Sequence) else ()
    if not (fleet and all(isinstance(truck, Truck) for truck in fleet)):
        raise InputError(f"trucks must be one or more Trucks, got {brief(trucks)}")
    task = Task(traffic, fleet, pier, size, seed, tilted)
    parts = []
    for part in run(partial(strikes_of, task), range(-(-size // BLOCK))):
        parts.append(part)
        progress(len(part.weight))
    strikes = Strikes(*map(np.concatenate, zip(*parts, strict=True)))
    return Risk(
        traffic=traffic, trucks=task.trucks, pier=pier, seed=seed, tilted=tilted, strikes=strikes
    )
