"""The design reaction: from truck, pier and speed to engine, cargo and governing reaction."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.collision.parameters import Collision, Parameters, parameter_chunks
from pierimpact.collision.reactions import Reactions
from pierimpact.design import domain
from pierimpact.design.procedure import ALIASES, LEVELS, calculation_of, design_values
from pierimpact.handcalc import Calculation, Step
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.vehicle.truck import Truck

#: Nominal impact heights of the source paper without and with a cargo spike that counts [m].
LOW_IMPACT_HEIGHT, HIGH_IMPACT_HEIGHT = 1.05, 1.35


@dataclass(frozen=True, kw_only=True)
class DesignReaction:
    """The design reaction of one pier and how it came about.

    Parameters
    ----------
    level : {"short", "long"}
        Level of the procedure.
    collision : Collision
        Truck, pier and speed.
    values : dict
        Every value of the procedure by the name of its symbol, also those that mean nothing in
        this case.

    Examples
    --------
    >>> from pierimpact import EquivalentPier, design_reaction, load_truck
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    >>> design = design_reaction(load_truck("single-unit-8t"), pier, speed=22.2)
    >>> round(design.engine / 1e6, 2), round(design.cargo / 1e6, 2)  # MN
    (2.95, 5.09)
    >>> design.warnings  # none within the domain that was studied
    ()
    >>> round(design.values["v2"], 1)  # speed of the cargo as it meets the pier [m/s]
    14.9
    """

    level: str
    collision: Collision
    values: dict[str, float] = field(repr=False)

    @property
    def engine(self) -> float:
        """Engine reaction; without engine contact, the plateau peak [N]."""
        return self.values["R1"]

    @property
    def cargo(self) -> float | None:
        """Cargo reaction [N]; None where the cargo does not meet the pier."""
        reaction = self.values["R2"]
        return None if math.isnan(reaction) else reaction

    @property
    def engine_contact(self) -> bool:
        """Whether the engine meets the pier."""
        return self.values["v1"] > 0.0

    @property
    def reaction(self) -> float:
        """Governing reaction: the larger of engine and cargo [N]."""
        return self.engine if self.cargo is None else max(self.engine, self.cargo)

    @property
    def governs(self) -> str:
        """Which of the two governs: "engine" or "cargo"."""
        return "engine" if self.reaction == self.engine else "cargo"

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the formulas were not checked for, a sentence each; empty within the domain."""
        found = domain.warnings(self.collision.parameters)
        if self.overlapping:
            found += (
                "the cargo meets the pier before the engine has separated: the design formulas "
                "take one after the other",
            )
        return found

    @property
    def outside(self) -> tuple[domain.Outside, ...]:
        """The values that are outside the domain in which the formulas were studied."""
        return domain.outside(self.collision.parameters)

    @property
    def overlapping(self) -> bool:
        """Whether the cargo meets the pier before the engine has separated from it."""
        engine_end = self.values.get("tJ", self.values["t1"])
        return self.cargo is not None and self.values["t2"] <= engine_end

    @property
    def calculation(self) -> Calculation:
        """The procedure at this level."""
        return LEVELS[self.level]

    @cached_property
    def steps(self) -> list[Step]:
        """The steps that the two reactions rest on, in order; without cargo contact, those to v2.

        Their values are in `values`, what their symbols stand for in `pierimpact.symbols`.
        """
        results = ["R1", "v2" if self.cargo is None else "R2"]
        return self.calculation.steps(self.values, results)


@dataclass(frozen=True, kw_only=True)
class DesignReactions:
    """Design reactions of many piers, arrays of the shape the inputs broadcast to.

    Parameters
    ----------
    engine, cargo : ndarray
        Engine and cargo reactions; `cargo` is nan where the cargo does not meet the pier [N].

    Examples
    --------
    >>> from pierimpact import design_reactions, load_truck
    >>> design = design_reactions(load_truck("single-unit-8t"), 8e3, 300e6, 0.05, [10.0, 22.2])
    >>> (design.cargo / 1e6).round(2)  # MN
    array([ nan, 5.07])
    """

    engine: NDArray[np.float64]
    cargo: NDArray[np.float64]

    @property
    def reaction(self) -> NDArray[np.float64]:
        """Governing reaction: the larger of the two [N]."""
        return np.fmax(self.engine, self.cargo)


def design_reaction(
    truck: Truck, pier: EquivalentPier, speed: float, level: str = "short"
) -> DesignReaction:
    """Return the design reaction of one pier.

    Parameters
    ----------
    truck, pier, speed
        As in `Collision`; a pier that yields counts as elastic, with a warning.
    level : {"short", "long"}, optional
        Level of the procedure: the method to follow by hand, or the one to see why. "hand" and
        "refined" are other names of the two.

    Raises
    ------
    InputError
        As in `Collision`, and when the level is unknown.

    Examples
    --------
    >>> from pierimpact import EquivalentPier, design_reaction, load_truck
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    >>> design = design_reaction(load_truck("single-unit-8t"), pier, speed=22.2)
    >>> design.governs
    'cargo'
    >>> round(design.reaction / 1e6, 2)  # MN
    5.09
    """
    collision = Collision(truck, pier, speed)
    found = design_values(collision.parameters, level)
    values = {name: float(value) for name, value in found.items()}
    return DesignReaction(level=ALIASES.get(level, level), collision=collision, values=values)


def design_reactions(
    truck: Truck | Sequence[Truck],
    pier_mass: ArrayLike,
    pier_stiffness: ArrayLike,
    damping_ratio: ArrayLike,
    speed: ArrayLike,
    level: str = "short",
) -> DesignReactions:
    """Return the design reactions of many piers; arguments as in `peak_reactions`.

    Beside them `level`, as in `design_reaction`.

    Examples
    --------
    >>> from pierimpact import design_reactions, load_truck
    >>> design = design_reactions(load_truck("single-unit-8t"), 8e3, [100e6, 300e6], 0.05, 22.2)
    >>> (design.reaction / 1e6).round(2)  # MN
    array([5.56, 5.07])
    """
    calculation_of(level)  # an error here, before anything is calculated
    shape, chunks = parameter_chunks(truck, pier_mass, pier_stiffness, damping_ratio, speed)
    size = math.prod(shape)
    found = np.empty((2, size))
    for part, parameters in chunks:
        values = design_values(parameters, level)
        found[:, part] = values["R1"], values["R2"]
    engine, cargo = found.reshape(2, *shape)
    return DesignReactions(engine=engine, cargo=cargo)


def predictions(parameters: Parameters, level: str) -> Reactions:
    """Return the reactions of `full_model` by the design procedure; `level` as there."""
    values = design_values(parameters, level)
    engine, cargo = values["R1"], values["R2"]
    return Reactions(engine, cargo, np.fmax(engine, cargo))
