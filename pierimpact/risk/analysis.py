"""The risk of a pier: the trucks that come to it, and what they do to it by the full model."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError, brief, whole
from pierimpact.collision.groups import select
from pierimpact.collision.parameters import Parameters
from pierimpact.collision.reactions import full_model
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
    #: governing reaction of each pier by the full model, shape (n, piers); zero without a collision
    #: [N]
    reactions: Array
    by_engine: NDArray[np.bool_]  #: whether the largest is the engine peak
    hard_impact: Array  #: v √(k m) of JCSS [N]

    @property
    def reaction(self) -> Array:
        """The largest of all piers [N]."""
        largest: Array = self.reactions.max(axis=1)
        return largest


class Task(NamedTuple):
    """What the strikes of a block are of."""

    traffic: Traffic
    trucks: tuple[Truck, ...]
    piers: tuple[EquivalentPier, ...]
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
    reactions, by_engine = np.zeros((2, size, len(task.piers)))
    if there.any():
        for number, pier in enumerate(task.piers):
            found = full_model(collisions(task.trucks, pier, own))
            # A collision that does not end, of which there is a warning, counts as a large one.
            reactions[there, number] = np.where(np.isnan(found.governing), np.inf, found.governing)
            by_engine[there, number] = ~(found.cargo > found.engine)
    governs = reactions.argmax(axis=1)
    return Strikes(
        weight=arrivals.weight,
        mass=arrivals.mass,
        road_speed=arrivals.road_speed,
        speed=arrivals.speed,
        truck=arrivals.truck,
        reactions=reactions,
        by_engine=by_engine[np.arange(size), governs] > 0.0,
        hard_impact=arrivals.hard_impact,
    )


class Feared(NamedTuple):
    """The trucks that bring about reactions above a value, with the 5 and 95 % ones around them."""

    mass: tuple[float, float, float]  #: 5, 50 and 95 % of them are lighter [kg]
    speed: tuple[float, float, float]  #: are slower at the pier [m/s]
    by_engine: float  #: share of them whose engine peak governs [-]
    beyond: float  #: share of them whose mass their truck's springs do not stand for [-]


@dataclass(frozen=True, kw_only=True, eq=False)
class Risk:
    """How often the reaction of a pier exceeds values.

    Frequencies are of trucks and per second.
    """

    traffic: Traffic
    trucks: tuple[Truck, ...]
    piers: tuple[EquivalentPier, ...]
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
        return self.exceedance(self.strikes.reaction)

    @cached_property
    def hard_impact(self) -> Exceedance:
        """Frequencies of the force v √(k m) of JCSS from the same trucks."""
        return self.exceedance(self.strikes.hard_impact)

    def exceedance(self, values: Array, better: Array | None = None) -> Exceedance:
        """Return the frequencies of values of all draws, as in `Exceedance`."""
        return Exceedance(values, self.strikes.weight, self.traffic.departures, better)

    def followed_again(self, count: int) -> tuple[NDArray[np.intp], Parameters]:
        """Return which of the first draws arrive, and their collisions with the first pier.

        Of as many draws as there are, of a block at most.
        """
        count = min(count, self.size, BLOCK)
        arrivals = draw(self.traffic, self.trucks, 0, self.seed, count, self.tilted)
        there = np.flatnonzero(arrivals.weight > 0.0)
        own = select(arrivals, there)
        return there, collisions(self.trucks, self.piers[0], own)

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
    pier: EquivalentPier | Sequence[EquivalentPier],
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
    pier : EquivalentPier or sequence of EquivalentPier
        The pier; or it as each of several impact heights has it, of which the largest reaction of
        each truck counts.
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
    piers = (pier,) if isinstance(pier, EquivalentPier) else tuple(pier)
    task = Task(traffic, fleet, piers, size, seed, tilted)
    parts = []
    for part in run(partial(strikes_of, task), range(-(-size // BLOCK))):
        parts.append(part)
        progress(len(part.weight))
    strikes = Strikes(*map(np.concatenate, zip(*parts, strict=True)))
    return Risk(
        traffic=traffic, trucks=fleet, piers=piers, seed=seed, tilted=tilted, strikes=strikes
    )
