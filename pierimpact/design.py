"""The design procedure: from truck, pier and speed to engine, cargo and governing reaction.

In the order of a collision: the plateau forces push the pier aside; the engine strikes it and
leaves it ringing; the cargo strikes it while it rings. Two levels, both in closed form: "hand"
fits on a page and needs a calculator; "refined" keeps the phase of the ringing and lets the
pier's own motion correct the times and speeds of contact. All is derived here.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact import domain
from pierimpact.cases import collision, collisions
from pierimpact.checks import one_of, positive
from pierimpact.equations import DesignStep, steps
from pierimpact.formulas import (
    LATE_SHARE,
    RINGING_BETA,
    RINGING_SHARE,
    Motion,
    amplification,
    closing_time,
    contact_modes,
    crests,
    engine_pulse,
    swing,
)
from pierimpact.motion import Collision
from pierimpact.pier import EquivalentPier
from pierimpact.reduction import approach_speed
from pierimpact.truck import Truck

Real: TypeAlias = Any  # a float, or an array
Values: TypeAlias = dict[str, Real]
Spectrum: TypeAlias = Callable[[Real, Real, Real, Real], Real]

LEVELS = ("refined", "hand")
#: A cargo peak below this share of the engine's counts as much smaller. The source paper gives
#: no figure; this one is this project's.
MUCH_SMALLER = 0.5
LOW_IMPACT_HEIGHT, HIGH_IMPACT_HEIGHT = 1.05, 1.35


@dataclass(frozen=True, kw_only=True)
class DesignReaction:
    """The design reaction of one pier and how it came about.

    Parameters
    ----------
    engine : float
        Engine reaction [N].
    cargo : float or None
        Cargo reaction [N]; None where the cargo does not meet the pier.
    level : {"refined", "hand"}
        Level of the formulas.
    values : dict
        Every intermediate value by name, in order of calculation [SI].
    warnings : tuple of str
        What the formulas were not checked for, a sentence each.
    """

    engine: float
    cargo: float | None
    level: str
    values: dict[str, float]
    warnings: tuple[str, ...]

    @property
    def reaction(self) -> float:
        """Governing reaction: the larger of engine and cargo [N]."""
        return self.engine if self.cargo is None else max(self.engine, self.cargo)

    @property
    def governs(self) -> str:
        """Which of the two governs: "engine" or "cargo"."""
        return "engine" if self.reaction == self.engine else "cargo"

    @property
    def engine_contact(self) -> bool:
        """Whether the engine meets the pier."""
        return self.values["engine_speed"] > 0.0

    @property
    def nominal_height(self) -> float:
        """Nominal impact height for these reactions [m]; see `nominal_impact_height`."""
        return nominal_impact_height(self.engine, self.cargo)

    @property
    def steps(self) -> tuple[DesignStep, ...]:
        """Every intermediate value with its symbol, equation and unit."""
        return steps(self.values)


@dataclass(frozen=True, kw_only=True)
class DesignReactions:
    """Design reactions of many piers, arrays of the shape the inputs broadcast to.

    Parameters
    ----------
    engine, cargo : ndarray
        Engine and cargo reactions; `cargo` is nan where the cargo does not meet the pier [N].
    """

    engine: NDArray[np.float64]
    cargo: NDArray[np.float64]

    @property
    def reaction(self) -> NDArray[np.float64]:
        """Governing reaction: the larger of the two [N]."""
        return np.fmax(self.engine, self.cargo)


def nominal_impact_height(engine: float, cargo: float | None) -> float:
    """Nominal impact height of the source paper's rule [m].

    1.05 m where there is no cargo peak or a much smaller one, else 1.35 m. For simplicity the
    paper itself uses 1.20 m throughout.
    """
    if cargo is None or cargo < MUCH_SMALLER * engine:
        return LOW_IMPACT_HEIGHT
    return HIGH_IMPACT_HEIGHT


def design_reaction(
    truck: Truck, pier: EquivalentPier, speed: float, level: str = "refined"
) -> DesignReaction:
    """Return the design reaction of one pier.

    Parameters
    ----------
    truck : Truck
        The truck.
    pier : EquivalentPier
        The pier.
    speed : float
        Speed of the truck at first touch [m/s].
    level : {"refined", "hand"}, optional
        Level of the formulas.

    Raises
    ------
    InputError
        When the speed is not positive or the level unknown.
    """
    one_of("level", level, LEVELS)
    case = collision(truck, pier, positive("speed", speed))
    values = {name: float(value) for name, value in design_values(case, level).items()}
    cargo = values["cargo"]
    return DesignReaction(
        engine=values["engine"],
        cargo=None if math.isnan(cargo) else cargo,
        level=level,
        values=values,
        warnings=domain.warnings(case),
    )


def design_reactions(
    truck: Truck | Sequence[Truck],
    pier_mass: ArrayLike,
    pier_stiffness: ArrayLike,
    damping_ratio: ArrayLike,
    speed: ArrayLike,
    level: str = "refined",
) -> DesignReactions:
    """Return the design reactions of many piers; arguments as in `peak_reactions`.

    Parameters
    ----------
    truck : Truck or sequence of Truck
        One truck for all, or one for each.
    pier_mass, pier_stiffness, damping_ratio, speed : array_like
        As in `peak_reactions` [kg], [N/m], [-], [m/s].
    level : {"refined", "hand"}, optional
        Level of the formulas.

    Raises
    ------
    InputError
        When a value is out of range, the shapes do not broadcast or the level is unknown.
    """
    one_of("level", level, LEVELS)
    shape, parts = collisions(truck, pier_mass, pier_stiffness, damping_ratio, speed)
    size = math.prod(shape)
    found = np.empty((2, size))
    for part, case in parts:
        values = design_values(case, level)
        found[:, part] = values["engine"], values["cargo"]
    engine, cargo = found.reshape(2, *shape)
    return DesignReactions(engine=engine, cargo=cargo)


def design_values(case: Collision, level: str, spectrum: Spectrum = amplification) -> Values:
    """Return every value of the procedure by name, in order.

    The names are those of `pierimpact.equations`.

    Parameters
    ----------
    case : Collision
        Floats, or arrays of one shape.
    level : {"refined", "hand"}
        Level of the formulas.
    spectrum : callable, optional
        S of β, μ, e and ζ: the closed form, or the exact one to see what the fit costs.
    """
    values = _pier_and_push(case)
    if level == "hand":
        _meet_engine(case, values, spectrum, pier_moves=False)
        _strike_by_hand(case, values, spectrum)
    else:
        _meet_engine(case, values, spectrum, pier_moves=True)
        ringing = _ring(case, values)
        _strike_ringing_pier(case, values, ringing)
    return values


def _pier_and_push(case: Collision) -> Values:
    """Return the pier's frequency and damping, and the forces of the plateau."""
    omega = np.sqrt(case.pier_stiffness / case.pier_mass)
    zeta = case.pier_damping / (2.0 * np.sqrt(case.pier_stiffness * case.pier_mass))
    push = case.body.plateau_force + np.where(case.on_pier, case.friction_force, 0.0)
    step = case.engine.plateau_force + push
    return {
        "pier_omega": omega,
        "damping_ratio": zeta,
        "body_push": push,
        "plateau_push": step,
        "overshoot": step * (1.0 + np.exp(-math.pi * zeta / np.sqrt(1.0 - zeta**2))),
        "engine_deceleration": case.engine.plateau_force / case.engine.mass,
        "cargo_deceleration": (case.body.plateau_force + case.friction_force) / case.body.mass,
    }


def _pushed(case: Collision, values: Values, t: Real) -> Motion:
    """Return the pier's response to the plateau forces, applied at t = 0."""
    rest = values["plateau_push"] / case.pier_stiffness
    x, v = swing(Motion(-rest, 0.0), values["pier_omega"], values["damping_ratio"], t)
    return Motion(x + rest, v)


def _meet_engine(case: Collision, values: Values, spectrum: Spectrum, pier_moves: bool) -> None:
    """Add the engine's contact and reaction."""
    mass, force, length, stiffness, unloading = case.engine
    omega, zeta = values["pier_omega"], values["damping_ratio"]
    time = closing_time(case.speed, values["engine_deceleration"], length)
    way = length
    if pier_moves:
        way = length + _pushed(case, values, time).x
        time = closing_time(case.speed, values["engine_deceleration"], way)
        way = length + _pushed(case, values, time).x
    x, v = _pushed(case, values, time)
    approach = approach_speed(case.speed, mass, force, way)
    values |= {
        "engine_speed": approach,
        "engine_time": time,
        "engine_pier_x": x,
        "engine_pier_v": v,
        "engine_beta": omega / np.sqrt(stiffness / mass),
        "engine_mu": mass / case.pier_mass,
        "engine_e": np.sqrt(stiffness / unloading),
    }
    values["engine_S"] = spectrum(
        values["engine_beta"], values["engine_mu"], values["engine_e"], zeta
    )
    values["engine_closing"] = np.maximum(approach - v, 0.0)
    # Displacement and velocity of the pier's swing about its rest under the body's push, both
    # as forces.
    values["engine_blow"] = np.hypot(
        case.pier_stiffness * x - values["body_push"],
        case.pier_stiffness * v / omega
        + values["engine_S"] * values["engine_closing"] * np.sqrt(stiffness * mass),
    )
    swung = omega * np.sqrt(1.0 - zeta**2) * time >= math.pi
    struck = values["body_push"] + values["engine_blow"]
    values["engine"] = np.where(
        (approach > 0.0) & (~swung | (struck > values["overshoot"])), struck, values["overshoot"]
    )


def _strike_by_hand(case: Collision, values: Values, spectrum: Spectrum) -> None:
    """Add the cargo's reaction by its spectrum, plus a share of the ringing that is left."""
    mass, force, length, stiffness, unloading = case.body
    omega, zeta = values["pier_omega"], values["damping_ratio"]
    held = force + case.friction_force
    approach = approach_speed(case.speed, mass, held, length)
    time = closing_time(case.speed, values["cargo_deceleration"], length)
    beta, mu = omega / np.sqrt(stiffness / mass), mass / case.pier_mass
    e = np.sqrt(stiffness / unloading)
    meets = values["engine_speed"] > 0.0
    since = time - np.where(meets, values["engine_time"], 0.0)
    values |= {
        "cargo_speed": approach,
        "cargo_time": time,
        "cargo_beta": beta,
        "cargo_mu": mu,
        "cargo_e": e,
        "cargo_S": spectrum(beta, mu, e, zeta),
        "cargo_rise": np.hypot(held, approach * np.sqrt(stiffness * mass)) - held,
        "ringing": np.where(meets, values["engine_blow"], values["plateau_push"])
        * np.exp(-zeta * omega * since),
    }
    # The slower the pier, the less its ringing adds up with the cargo's own peak.
    share = RINGING_SHARE / (1.0 + (RINGING_BETA / beta) ** 2)
    struck = values["cargo_S"] * values["cargo_rise"] + share * values["ringing"]
    values["cargo"] = np.where(approach > 0.0, values["body_push"] + struck, np.nan)


def _ring(case: Collision, values: Values) -> Callable[[Real], Motion]:
    """Add the engine's blow, or its halt, and return the motion of the pier around it."""
    omega, zeta = values["pier_omega"], values["damping_ratio"]
    meets = values["engine_speed"] > 0.0
    pulse = engine_pulse(
        case.engine.mass,
        case.engine.stiffness,
        values["engine_e"],
        case.pier_mass,
        values["engine_closing"],
    )
    values["impulse"] = np.where(
        meets, pulse.impulse * np.exp(-0.5 * (omega * pulse.spread) ** 2), 0.0
    )
    end = np.where(
        meets,
        values["engine_time"] + pulse.centroid,
        case.speed / values["engine_deceleration"],
    )
    at_end = _pushed(case, values, end)
    rest = values["body_push"] / case.pier_stiffness
    after = Motion(at_end.x - rest, at_end.v + values["impulse"] / case.pier_mass)
    values |= {"blow_time": end, "blow_x": after.x, "blow_v": after.v}

    def pier(t: Real) -> Motion:
        rings = swing(after, omega, zeta, np.maximum(t - end, 0.0))
        pushed = _pushed(case, values, t)
        return Motion(
            np.where(t > end, rings.x + rest, pushed.x), np.where(t > end, rings.v, pushed.v)
        )

    return pier


def _strike_ringing_pier(
    case: Collision, values: Values, ringing: Callable[[Real], Motion]
) -> None:
    """Add the cargo's reaction by the modes of body and pier, with the ringing's phase."""
    mass, force, length, stiffness, _ = case.body
    held = force + case.friction_force
    time = closing_time(case.speed, values["cargo_deceleration"], length)
    for _ in range(2):
        way = length + ringing(time).x
        time = closing_time(case.speed, values["cargo_deceleration"], way)
    x, v = ringing(time)
    approach = approach_speed(case.speed, mass, held, length + x)
    rest = (values["body_push"] - held) / case.pier_stiffness
    slow, fast = contact_modes(
        mass,
        stiffness,
        case.pier_mass,
        case.pier_stiffness,
        case.pier_damping,
        pier=Motion(x - rest, v),
        body=Motion(x - rest + held / stiffness, approach),
    )
    # The spring turns at the crest of its crush, which is the body's motion less the pier's.
    crush = slow.times(slow.body - 1.0), fast.times(fast.body - 1.0)
    early, late = crests(*crush)
    crushed = [crush[0].at(t) + crush[1].at(t) for t in (early, late)]
    turn = np.where(crushed[0] > crushed[1], early, late)
    at_turn = rest + slow.at(turn) + fast.at(turn)
    values |= {
        "cargo_speed": approach,
        "cargo_time": time,
        "cargo_pier_x": x,
        "cargo_pier_v": v,
        "rest": rest,
        "slow_omega": slow.omega,
        "slow_sigma": slow.sigma,
        "slow_body": slow.body,
        "slow_cosine": slow.cosine,
        "slow_sine": slow.sine,
        "fast_omega": fast.omega,
        "fast_sigma": fast.sigma,
        "fast_body": fast.body,
        "fast_cosine": fast.cosine,
        "fast_sine": fast.sine,
        "turn_time": turn,
        "turn_x": at_turn,
    }
    highest = x
    for name, t in zip(("early", "late"), crests(slow, fast), strict=True):
        crest = rest + slow.at(t) + fast.at(t)
        # After the turn the spring unloads faster than the modes have it.
        crest = np.where(t > turn, at_turn + LATE_SHARE * (crest - at_turn), crest)
        highest = np.maximum(highest, crest)
        values |= {f"{name}_crest_time": t, f"{name}_crest_x": crest}
    values["cargo"] = np.where(approach > 0.0, case.pier_stiffness * highest, np.nan)
