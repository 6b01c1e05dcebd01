"""How sure a reaction is: collisions of trucks sampled from the spread of their parameters.

Parameters are independent. A sampled unloading stiffness that falls below the steep stiffness is
raised to it, and a plateau shorter than its elastic limit P/k_u is lengthened to that, so that
every sampled truck keeps the rules of `CrushSpring`.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import (
    InputError,
    brief,
    finite_array,
    one_of,
    one_row,
    whole,
)
from pierimpact.collision.contact_forces import contact_forces
from pierimpact.collision.groups import repeat, select, single
from pierimpact.collision.parameters import Collision, Parameters, Spring, in_chunks
from pierimpact.collision.propagation import propagate_all
from pierimpact.collision.reactions import Reactions, full_model
from pierimpact.design.sobol import BITS, sobol_points
from pierimpact.pier.beam import BeamPier
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.spread import Spread, Uniform, checked_spreads
from pierimpact.vehicle.truck import QUANTITIES, Truck

Array: TypeAlias = NDArray[np.float64]
T = TypeVar("T")

#: Shares of all collisions whose reaction lies below the ends and the middle of a band: this
#: project's choice.
LEVELS = (0.05, 0.5, 0.95)
#: What may carry a spread: the numbers of a truck, and the speed.
UNCERTAIN = (*QUANTITIES, "speed")
REACTIONS = ("governing", "engine", "cargo")


@dataclass(frozen=True, kw_only=True, eq=False)
class ReactionBand:
    """The reactions of many collisions, and which parameter makes them differ.

    Mappings by parameter run from the most influential on.

    Examples
    --------
    >>> from pierimpact import EquivalentPier, load_truck, reaction_band
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=100.0)
    >>> band = reaction_band(load_truck("single-unit-8t"), pier, speed=22.2, size=64)
    >>> next(iter(band.influence))  # what makes the reactions differ most
    'engine_mass'
    >>> low, high = band.tornado["engine_mass"]
    >>> round(low / 1e6, 1), round(high / 1e6, 1)  # MN, with 30 % less and 30 % more
    (4.9, 9.8)
    """

    collision: Collision  #: with every parameter at its value
    nominal: float  #: its governing reaction [N]
    spread: Mapping[str, Spread]  #: by parameter; empty where all are known exactly
    parameters: Parameters  #: of the sampled collisions
    reactions: Reactions  #: of the sampled collisions, arrays of shape (size,)
    #: Share of the variance of the governing reaction that a parameter has a part in, alone or
    #: with others (total-order Sobol index); the sum may exceed one [-].
    influence: Mapping[str, float]
    #: Share of that variance which the parameter makes alone (first-order Sobol index) [-].
    first_order: Mapping[str, float]
    #: Governing reaction with this parameter alone at either end of its spread [N].
    tornado: Mapping[str, tuple[float, float]]

    @property
    def engine(self) -> Array:
        """Engine reactions, shape (size,) [N]."""
        return self.reactions.engine

    @property
    def cargo(self) -> Array:
        """Cargo reactions, shape (size,); nan without cargo contact [N]."""
        return self.reactions.cargo

    @property
    def governing(self) -> Array:
        """The larger of the two, shape (size,) [N]."""
        return self.reactions.governing

    @property
    def cargo_contact(self) -> float:
        """Share of the collisions in which the cargo meets the pier [-]."""
        return float(np.mean(np.isfinite(self.cargo)))

    @property
    def engine_contact(self) -> float:
        """Share of the collisions in which the engine meets the pier [-]."""
        # The reactions do not say so: sheet metal alone makes an engine's peak, too.
        outcomes = propagate_all(in_chunks(self.parameters), self.parameters.speed.shape)
        return float(np.mean(np.isfinite(outcomes.engine_contact)))

    def quantiles(self, levels: Sequence[float] = LEVELS, of: str = "governing") -> Array:
        """Return the reactions below which these shares of all collisions stay.

        Parameters
        ----------
        levels : sequence of float, length n, optional
            Shares, from 0 to 1 [-].
        of : {"governing", "engine", "cargo"}, optional
            Which reaction. Of the cargo's, only collisions with cargo contact count.

        Returns
        -------
        ndarray, shape (n,)
            Reactions; nan where no cargo meets the pier [N].

        Raises
        ------
        InputError
            When a share is out of range, or `of` is none of them.
        """
        shares = one_row("levels", finite_array("levels", levels))
        for share in shares[(shares < 0.0) | (shares > 1.0)]:
            raise InputError(f"levels must lie from 0 to 1, got {share:g}")
        return quantiles(getattr(self, one_of("of", of, REACTIONS)), shares)

    def sampled(self, index: int) -> Collision:
        """Return one of the sampled collisions, by its number from 0 on."""
        index = whole("index", index, 0, len(self.engine) - 1)
        own = single(self.parameters, index)
        truck = truck_of(own, self.collision.truck)
        return replace(self.collision, truck=truck, speed=own.speed)

    def on(self, pier: EquivalentPier) -> Reactions:
        """Return the reactions of the same sampled trucks on another pier."""
        if pier == self.collision.equivalent_pier:
            return self.reactions
        same = np.ones_like(self.parameters.speed)
        return full_model(
            self.parameters._replace(
                pier_mass=pier.mass * same,
                pier_stiffness=pier.stiffness * same,
                pier_damping=pier.damping * same,
                yield_reaction=pier.yield_reaction * same if pier.yields else None,
            )
        )

    def average_forces(self, windows: Sequence[float], count: int = 128) -> Array:
        """Return the largest moving averages of the contact force in the first `count` collisions.

        For notebooks/tti-column.yaml, with all parameters ±30 %, 128 collisions give median and
        95 % value of the averages over 10, 25 and 50 ms with a standard error of 1 to 2 %, their
        5 % value with one of 3, 10 and 13 %: there the cargo hardly arrives.

        Parameters
        ----------
        windows : sequence of float, length n
            Lengths of the moving window [s].
        count : int, optional
            Number of collisions, at most those of the band.

        Returns
        -------
        ndarray, shape (n, count)
            Averages, as in `contact_forces` [N].

        Raises
        ------
        InputError
            When a window is not positive, or `count` is not a whole number above zero.
        """
        count = min(whole("count", count, 1), len(self.engine))
        collisions = [self.sampled(index) for index in range(count)]
        return contact_forces(collisions, windows)[1].averages


def reaction_band(
    truck: Truck,
    pier: EquivalentPier | BeamPier,
    speed: float,
    spread: float | Mapping[str, float | Spread] | None = None,
    size: int = 1000,
    seed: int = 0,
) -> ReactionBand:
    """Return the band of reactions that the spread of the parameters makes.

    The parameters are sampled at scrambled Sobol points and the collisions are those of
    `peak_reactions`. Shares of variance are Sobol indices, from about a quarter of `size` points
    and as many more for each parameter. With 1,000 collisions, all parameters ±30 %, the ends of
    a band have standard errors of 1 to 2 %, its median one of 0.5 %, and shares of the variance
    one of 0.01 to 0.04, as measured on piers of 8 to 150 Hz.

    Parameters
    ----------
    truck, pier, speed
        As in `Collision`; a beam counts as its one degree of freedom.
    spread : float or mapping of str to float or Spread, optional
        One share to either side of every parameter of the truck, uniform; or the spread by
        parameter, with names as "engine_spring.stiffness" or "speed", the others being known. The
        truck's own unless given; a truck without is known exactly, and its band has no width.
    size : int, optional
        Number of collisions, best a power of two.
    seed : int, optional
        Seed of the random numbers.

    Raises
    ------
    InputError
        As in `Collision`, and when the size is not from 1 to 2³⁰ or a spread breaks a rule.

    Examples
    --------
    >>> from pierimpact import EquivalentPier, load_truck, reaction_band
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    >>> band = reaction_band(load_truck("single-unit-8t"), pier, speed=22.2, size=64)
    >>> band.governing.shape
    (64,)
    >>> low, high = band.quantiles((0.05, 0.95))
    >>> bool(low < band.nominal < high)
    True
    """
    collision = Collision(truck, pier, speed)
    size, seed = whole("size", size, 1, 2**BITS), whole("seed", seed, 0)
    spreads = spreads_of(truck, spread)
    count, base = len(spreads), 2 ** max(round(math.log2(size / 4)), 0)
    a, b = sampled_factors(spreads, max(size, base), seed)
    other, own = b[:, :base], a[:, :base]
    parts = (np.ones((count, 1)), _ends(spreads), a[:, :size], other, _each_alone(other, own))
    factors = np.concatenate(parts, axis=1)
    same = repeat(collision.parameters, factors.shape[1])
    collisions = with_factors(same, spreads, factors)
    reactions = full_model(collisions)
    starts = np.cumsum([part.shape[1] for part in parts])
    nominal, ends, drawn, others, mixed = np.split(reactions.governing, starts[:-1])
    total, first = sobol_indices(drawn[:base], others, mixed.reshape(count, base))
    # Where nothing is uncertain all collisions are one.
    sample = np.arange(starts[1], starts[2]) if spreads else np.zeros(size, dtype=int)
    order = np.argsort(-total.round(6), kind="stable").tolist()
    names = list(spreads)

    def ranked(values: Sequence[T]) -> dict[str, T]:
        return {names[i]: values[i] for i in order}

    return ReactionBand(
        collision=collision,
        nominal=float(nominal[0]),
        spread=ranked(list(spreads.values())),
        parameters=select(collisions, sample),
        reactions=select(reactions, sample),
        influence=ranked(total.tolist()),
        first_order=ranked(first.tolist()),
        tornado=ranked([(low, high) for low, high in ends.reshape(count, 2).tolist()]),
    )


def quantiles(values: Array, levels: Sequence[float] | Array = LEVELS) -> Array:
    """Return what these shares of the finite values stay below; nan where there are none."""
    finite = values[np.isfinite(values)]
    return np.asarray(np.quantile(finite, levels)) if len(finite) else np.full(len(levels), np.nan)


def sobol_indices(a: Array, b: Array, mixed: Array) -> tuple[Array, Array]:
    """Return total and first-order Sobol indices, each of shape (n,), from 0 to 1 [-].

    Estimators (f) and (b) in Table 2 of Saltelli et al., Computer Physics Communications 181
    (2010), 259-270, about the mean. SciPy's function of this name has the same, but does not take
    a single parameter.

    Parameters
    ----------
    a, b : ndarray, shape (m,)
        Results at two independent samples.
    mixed : ndarray, shape (n, m)
        Results at the first sample with one parameter after the other from the second.
    """
    both = np.concatenate((a, b))
    mean, variance = np.mean(both), np.var(both)
    if variance <= (1e-9 * mean) ** 2:  # round-off
        return np.zeros(len(mixed)), np.zeros(len(mixed))
    total = 0.5 * np.mean((mixed - a) ** 2, axis=1) / variance
    first = np.mean((b - mean) * (mixed - a), axis=1) / variance
    return np.clip(total, 0.0, 1.0), np.clip(first, 0.0, 1.0)


def spreads_of(
    truck: Truck, spread: float | Mapping[str, float | Spread] | None = None
) -> dict[str, Spread]:
    """Return the spreads by parameter, without those that have no width."""
    asked = truck.spread if spread is None else spread
    if not isinstance(asked, Mapping):
        asked = dict.fromkeys(QUANTITIES, Uniform.about(asked))
    spreads = {}
    for name, value in asked.items():
        try:
            spreads[name] = value if isinstance(value, Spread) else Uniform.about(value)
        except InputError as error:
            raise InputError(f"{error}, for {brief(name)}") from None
    checked = checked_spreads(spreads, UNCERTAIN)
    return {name: value for name, value in checked.items() if value.ends != (1.0, 1.0)}


def sampled_factors(spreads: Mapping[str, Spread], size: int, seed: int) -> Array:
    """Return two independent samples of the factors, shape (2, parameters, size or more)."""
    if not spreads:
        return np.empty((2, 0, size))
    laws, power = list(spreads.values()), math.ceil(math.log2(size))
    # The middles of the points' cells are neither 0 nor 1.
    points = sobol_points(2 * len(laws), power, seed) + 0.5 ** (BITS + 1)
    factors = [law.factor(row) for law, row in zip(laws + laws, points, strict=True)]
    return np.array(factors).reshape(2, len(laws), -1)


def _ends(spreads: Mapping[str, Spread]) -> Array:
    """Return the factors of collisions with one parameter at a time at an end of its spread."""
    ends = np.array([own.ends for own in spreads.values()]).reshape(-1, 2)
    return _each_alone(ends, np.ones_like(ends))


def _each_alone(changed: Array, usual: Array) -> Array:
    """Return the columns of `usual` n times over, in turn with one of their n rows changed."""
    count, size = usual.shape
    alone = np.eye(count, dtype=bool)[:, :, None]
    return np.where(alone, changed[:, None], usual[:, None]).reshape(count, count * size)


def truck_of(own: Parameters, truck: Truck) -> Truck:
    """Return a truck with the numbers of one collision, which are known exactly."""
    engine_spring, body_spring = (
        CrushSpring(**dict(zip(CrushSpring.__dataclass_fields__, spring[1:], strict=True)))
        for spring in (own.engine, own.body)
    )
    return replace(
        truck,
        engine_mass=own.engine.mass,
        body_mass=own.body.mass,
        engine_spring=engine_spring,
        body_spring=body_spring,
        friction_force=own.friction_force,
        spread={},
    )


def with_factors(same: Parameters, names: Iterable[str], factors: Array) -> Parameters:
    """Return collisions with each of the named parameters times its factor.

    Parameters
    ----------
    same : Parameters
        The n collisions.
    names : iterable of str
        Parameters of the truck, or "speed".
    factors : ndarray, shape (parameters, n)
        Their factors [-].
    """
    by_name = dict(zip(names, factors, strict=True))

    def spring(mass: str, law: str, own: Spring) -> Spring:
        names = (mass, *(f"{law}.{name}" for name in CrushSpring.__dataclass_fields__))
        values = (x * by_name.get(name, 1.0) for name, x in zip(names, own, strict=True))
        m, P, d, k, ku = values
        ku = np.maximum(ku, k)
        return Spring(m, P, np.maximum(d, P / ku), k, ku)

    return same._replace(
        engine=spring("engine_mass", "engine_spring", same.engine),
        body=spring("body_mass", "body_spring", same.body),
        friction_force=same.friction_force * by_name.get("friction_force", 1.0),
        speed=same.speed * by_name.get("speed", 1.0),
    )
