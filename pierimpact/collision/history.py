"""What a collision looks like in time: peaks, histories and balances."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.collision.coasting import (
    Creep,
    FreeVibration,
    coasting_position,
    creep,
    free_vibration,
)
from pierimpact.collision.parameters import Collision
from pierimpact.collision.regimes import FREE, LinearMotion, Position, State
from pierimpact.collision.series import ARRAYS, FLOATS, TERMS, weights_of_all
from pierimpact.collision.stepping import (
    BODY,
    ENGINE,
    PIER,
    evaluate,
    expand,
    longest_step,
    rates,
)
from pierimpact.collision.yielding import Yielding
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.pier.member_forces import MemberForceHistory
from pierimpact.vehicle.truck import Truck

RecordedStep: TypeAlias = tuple[State, LinearMotion, float]  # start, equations, length [s]
Array: TypeAlias = NDArray[np.float64]

# No mode advances by more than three radians in a piece: the chord between two of these samples
# misses a maximum by less than 0.2 % of the amplitude.
FRACTIONS = np.linspace(0.0, 1.0, 25)
BETWEEN = 1001  # numerical: places between two samples where the smallest value is looked for
MOST_PIECES = 100_000  # numerical: with their samples they fill a gigabyte


class Peak(NamedTuple):
    """A peak of the reaction.

    Examples
    --------
    >>> from pierimpact import EquivalentPier, load_truck, simulate
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    >>> history = simulate(load_truck("single-unit-8t"), pier, speed=22.2)
    >>> peak = history.engine_peak
    >>> round(peak.reaction / 1e6, 2), round(peak.time, 4)  # MN, s
    (2.7, 0.0367)
    """

    reaction: float  #: its value [N]
    time: float  #: when it occurs after first touch [s]


class EnergyShares(NamedTuple):
    """Where the truck's energy is, each an array of shape (n,) at the history's times [J]."""

    kinetic: Array  #: of engine, body and pier
    pier_elastic: Array  #: stored in the pier's spring
    truck_elastic: Array  #: stored in the crush springs, given back on unloading
    crush: Array  #: dissipated by plastic crush
    friction: Array  #: dissipated by the friction on the body
    damping: Array  #: dissipated by the pier's damper
    pier_plastic: Array  #: dissipated by the yielding pier

    @property
    def total(self) -> Array:
        """Sum of all shares, which stays at ½ (m1 + m2) V² [J]."""
        return np.asarray(np.sum(self, axis=0))


@dataclass(frozen=True, kw_only=True)
class CollisionHistory:
    """The motion of one collision, evaluated from its exact pieces.

    The peaks are located on the pieces themselves; the arrays are samples, dense enough to draw.

    Examples
    --------
    >>> from pierimpact import EquivalentPier, load_truck, simulate
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    >>> history = simulate(load_truck("single-unit-8t"), pier, speed=22.2)
    >>> round(history.cargo_contact_time, 3)  # s
    0.103
    >>> bool(history.reaction.max() > 4.8e6)
    True
    >>> round(float(history.energy.crush[-1]) / history.collision.energy, 2)
    0.88
    """

    collision: Collision
    steps: list[RecordedStep] = field(repr=False)
    end: State = field(repr=False)  #: the last state

    @property
    def truck(self) -> Truck:
        """The truck."""
        return self.collision.truck

    @property
    def pier(self) -> EquivalentPier:
        """The pier as one degree of freedom."""
        return self.collision.equivalent_pier

    @property
    def engine_peak(self) -> Peak:
        """Largest reaction before cargo contact; of all time where there is none."""
        return self._peak(self.end.engine_peak, self.end.engine_peak_time)

    @property
    def cargo_peak(self) -> Peak | None:
        """Largest reaction from cargo contact on; None without cargo contact."""
        if self.cargo_contact_time is None:
            return None
        return self._peak(self.end.cargo_peak, self.end.cargo_peak_time)

    def _peak(self, elastic_displacement: float, time: float) -> Peak:
        pier = self.pier
        return Peak(min(pier.stiffness * elastic_displacement, pier.yield_reaction), time)

    @property
    def before_cargo(self) -> str:
        """What makes the engine peak: "engine", or "sheet metal" where the engine comes later.

        It does so too where the engine does not arrive at all.
        """
        contact = self.engine_contact_time
        return "sheet metal" if contact is None or contact > self.engine_peak.time else "engine"

    @property
    def peaks(self) -> dict[str, Peak | None]:
        """The "engine" and the "cargo" peak."""
        return {"engine": self.engine_peak, "cargo": self.cargo_peak}

    @property
    def governing_peak(self) -> Peak:
        """The larger of the two peaks."""
        cargo = self.cargo_peak
        return cargo if cargo and cargo.reaction > self.engine_peak.reaction else self.engine_peak

    @cached_property
    def lowest(self) -> Peak:
        """The smallest reaction: the pier swings back, and past its rest it is negative."""
        sample = int(self.reaction.argmin())
        before, after = self.time[max(sample - 1, 0)], self.time[sample : sample + 2][-1]
        time = np.append(np.linspace(before, after, BETWEEN), self.time[sample])
        reaction = self.reaction_at(time)
        lowest = int(reaction.argmin())
        return Peak(float(reaction[lowest]), float(time[lowest]))

    @property
    def has_swung_back(self) -> bool:
        """Whether no later reaction can be below the `lowest`.

        That is so a period of the pier after the truck has left it, or come to rest against it.
        """
        end, pier = self.end, self.pier
        since = end.last_change
        if end.engine.regime == end.body.regime == FREE:
            pressing = np.flatnonzero(self.contact_force)
            since = self.time[pressing[-1]] if len(pressing) else 0.0
        elif end.engine.regime != FREE or not end.stuck:
            return False
        period = 1.0 / (pier.frequency * math.sqrt(1.0 - pier.damping_ratio**2))
        return bool(end.time - since >= period)

    @property
    def governs(self) -> str:
        """Which of the two peaks is the larger: "engine" or "cargo"."""
        return "engine" if self.governing_peak == self.engine_peak else "cargo"

    @property
    def engine_contact_time(self) -> float | None:
        """When the engine meets the pier: δ1 first reaches d1 [s]; None if it never does."""
        return _known(self.end.engine_contact)

    @property
    def cargo_contact_time(self) -> float | None:
        """When the cargo meets the pier: δ2 first reaches d2 [s]; None if it never does."""
        return _known(self.end.cargo_contact)

    @property
    def ductility(self) -> float:
        """Ductility demand: the largest `|x_p|` over R_y/k_p; zero where R_y is infinite [-].

        The displacement is measured from where the pier stood at first touch, in either direction.
        Up to 1 the pier stays elastic.
        """
        yielding, pier = self.end.yielding, self.pier
        if yielding is None:
            return 0.0
        return float(pier.stiffness * yielding.largest / pier.yield_reaction)

    @property
    def residual_displacement(self) -> float:
        """Plastic displacement in the end, when no more of it can come [m]."""
        yielding, xp = self.end.yielding, self.end.position.xp
        return 0.0 if yielding is None else yielding.displacement + yielding.beyond(xp, FLOATS)

    @property
    def pier_plastic_energy(self) -> float:
        """Energy that the yielding pier dissipates in all, R_y times its plastic path [J]."""
        return float(self.energy.pier_plastic[-1])

    @cached_property
    def time(self) -> Array:
        """Time after first touch, shape (n,) [s]."""
        starts = self._column(lambda state: state.time)
        return self._flat(starts + self._lengths * self._fractions)

    @cached_property
    def pier_displacement(self) -> Array:
        """Displacement x_p of the pier at the nominal impact height, shape (n,) [m]."""
        plastic = self._plastic(lambda yielding: yielding.displacement)
        return self._flat(plastic + self._series(PIER))

    @cached_property
    def pier_velocity(self) -> Array:
        """Velocity x_p' of the pier at the nominal impact height, shape (n,) [m/s]."""
        return self._flat(self._series(PIER, order=1))

    @cached_property
    def engine_crush(self) -> Array:
        """Crush δ1 = x1 − x_p of spring 1, shape (n,) [m]."""
        return self._flat(self._series(ENGINE))

    @cached_property
    def body_crush(self) -> Array:
        """Crush δ2 = x2 − x_p of spring 2, shape (n,) [m]."""
        return self._flat(self._series(BODY))

    @cached_property
    def engine_velocity(self) -> Array:
        """Velocity x1' of the engine, shape (n,) [m/s]."""
        return self._flat(self._series(ENGINE, order=1)) + self.pier_velocity

    @cached_property
    def body_velocity(self) -> Array:
        """Velocity x2' of the body, shape (n,) [m/s]."""
        return self._flat(self._series(BODY, order=1)) + self.pier_velocity

    @cached_property
    def reaction(self) -> Array:
        """Reaction R = k_p x_p, x_p without its plastic part, shape (n,) [N]."""
        force, resistance = self.pier.stiffness * self._series(PIER), self.pier.yield_reaction
        return self._flat(np.clip(force, -resistance, resistance))

    @property
    def member_forces(self) -> MemberForceHistory | None:
        """Shear and moment over the height of a beam; None for one degree of freedom."""
        return None

    @cached_property
    def engine_force(self) -> Array:
        """Force F1 of spring 1, shape (n,) [N]."""
        return self._flat(self._spring(ENGINE))

    @cached_property
    def body_force(self) -> Array:
        """Force F2 of spring 2, shape (n,) [N]."""
        return self._flat(self._spring(BODY))

    @cached_property
    def friction_force(self) -> Array:
        """Friction F_f against the body's motion, shape (n,); where it jumps, the new value [N]."""
        return self._flat(self._friction())

    @cached_property
    def contact_force(self) -> Array:
        """Force of the truck on the pier, F1 + F2 (+ F_f if friction acts on the pier) [N].

        Where it jumps, as friction does, the larger of both values.
        """
        return np.maximum(*self.contact_force_beside)

    @cached_property
    def contact_force_beside(self) -> tuple[Array, Array]:
        """Contact force just before and just after each time, two of shape (n,) [N]."""
        rows = self._spring(ENGINE) + self._spring(BODY)
        if self._friction_on_pier:
            rows = rows + self._friction()
        after = self._flat(rows)
        before = after.copy()
        before[rows.shape[1] - 1 : -1 : rows.shape[1] - 1] = rows[:-1, -1]
        return before, after

    def contact_force_at(self, time: ArrayLike) -> Array:
        """Return the contact force at times after first touch, from the pieces themselves [N].

        Parameters
        ----------
        time : array_like, shape (n,)
            The times [s]. Before first touch there is no force; after the end of the history it
            stays as it was there.
        """
        motion, line, stuck = self._at(time)
        engine = line.intercept1 + line.slope1 * motion(ENGINE)
        body = line.intercept2 + line.slope2 * motion(BODY)
        force = engine + body
        if self._friction_on_pier:
            held = -body - self.truck.body_mass * motion(PIER, 2)
            force = force + line.friction + stuck * held
        return np.where(np.asarray(time) >= 0.0, force, 0.0)

    def reaction_at(self, time: ArrayLike) -> Array:
        """Return the reaction at times, as `contact_force_at`."""
        motion, *_ = self._at(time)
        limit = self.pier.yield_reaction
        reaction = np.clip(self.pier.stiffness * motion(PIER), -limit, limit)
        return np.where(np.asarray(time) >= 0.0, reaction, 0.0)

    def _at(self, time: ArrayLike) -> tuple[Callable[..., Array], LinearMotion, Array]:
        """Return motions by which and order, their equations, and whether the body sticks."""
        starts, lengths = self._column(lambda state: state.time)[:, 0], self._lengths[:, 0]
        piece = np.clip(np.searchsorted(starts, time, side="right") - 1, 0, None)
        fraction = np.clip((np.asarray(time) - starts[piece]) / lengths[piece], 0.0, 1.0)
        weights = weights_of_all(fraction)

        def motion(which: int, order: int = 0) -> Array:
            terms = self._terms[which][piece, order:]
            rate = np.einsum("nk,kn->n", terms, weights[: terms.shape[1]])
            return np.asarray(rate / lengths[piece] ** order)

        line = LinearMotion(*(column[piece, 0] for column in self._motion))
        return motion, line, self._column(lambda state: state.stuck)[piece, 0]

    @cached_property
    def impulse(self) -> Array:
        """Impulse of the truck on the pier since first touch, ∫ F dt, shape (n,) [N s].

        From the pier's motion: m_p x_p' + c_p x_p + ∫ R dt.
        """
        pier, direction = self.pier, self._plastic(lambda yielding: yielding.direction)
        elastic = self._series(PIER, order=-1)
        if pier.yields:
            limit = direction * pier.yield_reaction / pier.stiffness
            elastic = np.where(direction, limit * self._lengths * self._fractions, elastic)
        return (
            pier.mass * self.pier_velocity
            + pier.damping * self.pier_displacement
            + pier.stiffness * self._accumulate(elastic)
        )

    @cached_property
    def road_impulse(self) -> Array:
        """Impulse of the road's friction on the body since first touch, shape (n,) [N s]."""
        if self._friction_on_pier:
            return np.zeros_like(self.time)
        # The friction on a body that sticks to the road balances its spring.
        motion, stuck = self._motion, self._column(lambda state: state.stuck)
        return self._accumulate(
            (motion.friction - stuck * motion.intercept2) * self._lengths * self._fractions
            - stuck * motion.slope2 * self._series(BODY, order=-1)
        )

    @cached_property
    def energy(self) -> EnergyShares:
        """Where the truck's energy is at each time."""
        truck = self.truck
        pier_kinetic, pier_elastic = self._pier_energy()
        return EnergyShares(
            kinetic=0.5
            * (
                truck.engine_mass * self.engine_velocity**2
                + truck.body_mass * self.body_velocity**2
            )
            + pier_kinetic,
            pier_elastic=pier_elastic,
            truck_elastic=0.5
            * (
                self.engine_force**2 / truck.engine_spring.unloading_stiffness
                + self.body_force**2 / truck.body_spring.unloading_stiffness
            ),
            crush=truck.engine_spring.dissipated(self._largest_crush(ENGINE))
            + truck.body_spring.dissipated(self._largest_crush(BODY)),
            friction=self._friction_work(),
            damping=self._damping_work(),
            pier_plastic=self._plastic_work(),
        )

    @cached_property
    def energy_error(self) -> float:
        """Largest departure of the energy's sum from ½ (m1 + m2) V², relative [-]."""
        initial = self.collision.energy
        return float(np.max(np.abs(self.energy.total - initial)) / initial)

    @cached_property
    def momentum_error(self) -> float:
        """Largest departure from the momentum balance, relative to (m1 + m2) V [-].

        Momentum of truck and pier + ∫ (k_p x_p + c_p x_p' + road friction) dt = (m1 + m2) V.
        """
        truck = self.truck
        initial = truck.mass * self.collision.speed
        momentum = truck.engine_mass * self.engine_velocity + truck.body_mass * self.body_velocity
        return float(
            np.max(np.abs(momentum + self.impulse + self.road_impulse - initial)) / initial
        )

    @property
    def _friction_on_pier(self) -> bool:
        return self.truck.friction_on == "pier"

    # The arrays below have one row per piece and one column per fraction of it.

    @property
    def _fractions(self) -> Array:
        return FRACTIONS

    @cached_property
    def _pieces(self) -> list[RecordedStep]:
        """The steps, cut where the pier vibrates for longer than a series converges."""
        pieces: list[RecordedStep] = []
        for state, motion, length in self.steps:
            count = max(1, math.ceil(length / longest_step(motion, FLOATS) - 1e-9))
            if len(pieces) + count > MOST_PIECES:
                raise RuntimeError(
                    f"the pier vibrates too often for a history: more than {MOST_PIECES:,} pieces; "
                    "peaks and contact times are known all the same"
                )
            positions = _positions(state, motion, length / count, count)
            for number, position in enumerate(positions):
                later = state._replace(time=state.time + number * length / count, position=position)
                pieces.append((later, motion, length / count))
        return pieces

    @cached_property
    def _terms(self) -> tuple[Array, ...]:
        """Terms of the motions' series, each of shape (pieces, terms)."""
        start = Position(*np.array([state.position for state, _, _ in self._pieces]).T)
        motion = LinearMotion(*(column[:, 0] for column in self._motion))
        series = expand(motion, rates(motion, start), self._lengths[:, 0], TERMS, ARRAYS)
        return tuple(terms.T for terms in series)

    @cached_property
    def _motion(self) -> LinearMotion:
        """The equations of motion, each of their numbers of shape (pieces, 1)."""
        rows = np.array([motion for _, motion, _ in self._pieces], dtype=float)
        return LinearMotion(*rows.T[:, :, None])

    def _column(self, value: Callable[[State], float]) -> Array:
        """Return one value per piece, shape (pieces, 1)."""
        return np.array([[float(value(state))] for state, _, _ in self._pieces])

    @cached_property
    def _lengths(self) -> Array:
        return np.array([[length] for _, _, length in self._pieces])

    def _series(self, which: int, order: int = 0, fractions: Array | None = None) -> Array:
        """Return a motion's derivative of an order, or for −1 its integral from a piece's start.

        Shape (pieces, fractions).
        """
        fractions = self._fractions if fractions is None else fractions
        terms = self._terms[which][:, max(order, 0) :]
        powers = np.arange(terms.shape[1])[:, None] - min(order, 0)
        factorials = np.array([[math.factorial(n)] for n in powers[:, 0]], dtype=float)
        rows: Array = terms @ (fractions**powers / factorials) / self._lengths**order
        return rows

    def _flat(self, rows: Array) -> Array:
        """Join the pieces' rows, each of which begins where the one before it ends."""
        return np.append(rows[:, :-1].ravel(), rows[-1, -1])

    def _accumulate(self, rows: Array) -> Array:
        """Join rows that each count from the start of their piece."""
        before = np.concatenate(([0.0], np.cumsum(rows[:-1, -1])))
        return self._flat(before[:, None] + rows)

    def _spring(self, which: int) -> Array:
        """Return the force of a spring, shape (pieces, fractions)."""
        motion = self._motion
        intercept, slope = {
            ENGINE: (motion.intercept1, motion.slope1),
            BODY: (motion.intercept2, motion.slope2),
        }[which]
        return np.asarray(intercept + slope * self._series(which))

    def _friction(self) -> Array:
        """Return the friction on the body, shape (pieces, fractions)."""
        # Where the body sticks the friction is what holds it.
        held_mass = self.truck.body_mass if self._friction_on_pier else 0.0
        held = -self._spring(BODY) - held_mass * self._series(PIER, order=2)
        return np.asarray(self._motion.friction + self._column(lambda state: state.stuck) * held)

    def _largest_crush(self, which: int) -> Array:
        springs = (self.truck.engine_spring, self.truck.body_spring)
        earlier = self._column(lambda state: (state.engine, state.body)[which].largest)
        largest = np.maximum(self._series(which), earlier)
        # Below the elastic limit nothing is dissipated, and no largest crush is recorded yet.
        return self._flat(np.maximum(largest, springs[which].elastic_limit))

    def _plastic(self, value: Callable[[Yielding], float]) -> Array:
        """Return one value of the pier's yielding per piece, shape (pieces, 1); else zeros."""
        return self._column(lambda state: 0.0 if state.yielding is None else value(state.yielding))

    @cached_property
    def _elastic(self) -> Array:
        """Elastic part R/k_p of the pier's displacement, shape (pieces, fractions)."""
        limit = self.pier.yield_reaction / self.pier.stiffness
        return np.clip(self._series(PIER), -limit, limit)

    def _plastic_work(self) -> Array:
        if not self.pier.yields:
            return np.zeros_like(self.time)
        before = self._plastic(lambda yielding: yielding.path)
        yields = self._plastic(lambda yielding: yielding.direction)
        going_on = np.abs(self._series(PIER) - self._elastic)
        return self.pier.yield_reaction * self._flat(before + np.where(yields, going_on, 0.0))

    def _friction_work(self) -> Array:
        path = self._series(BODY) + (0.0 if self._friction_on_pier else self._series(PIER))
        return self._accumulate(self._motion.friction * (path - path[:, :1]))

    def _pier_energy(self) -> tuple[Array, Array]:
        """Return kinetic and elastic energy of the pier."""
        pier = self.pier
        return (
            0.5 * pier.mass * self.pier_velocity**2,
            0.5 * pier.stiffness * self._flat(self._elastic) ** 2,
        )

    def _damping_work(self) -> Array:
        def square(fractions: Array) -> Array:
            return np.asarray(self._series(PIER, 1, fractions) ** 2)

        return self.pier.damping * self._integrate(square)

    def _integrate(self, rate: Callable[[Array], Array]) -> Array:
        """Integrate a rate, given at fractions of the pieces, by Gauss quadrature."""
        nodes, weights = np.polynomial.legendre.leggauss(6)
        width = self._fractions[1]
        places = (self._fractions[:-1, None] + 0.5 * width * (1.0 + nodes)).ravel()
        values = rate(places)
        pieces = values.reshape(len(values), -1, len(nodes)) @ (0.5 * width * weights)
        sums = np.cumsum(pieces, axis=1) * self._lengths
        return self._accumulate(np.pad(sums, ((0, 0), (1, 0))))


def _positions(state: State, motion: LinearMotion, step: float, count: int) -> list[Position]:
    """Return the positions in which steps of one motion begin."""
    position = state.position
    if count == 1:
        return [position]
    if coasting := _coasting(state, motion):
        times = (number * step for number in range(1, count))
        later = [coasting_position(motion, position, coasting, t, FLOATS) for t in times]
        return [position, *later]
    # Over one step, from no motion but under the forces, and from a unit of each coordinate.
    forced, h = np.eye(1, 7, k=6)[0], np.full(7, step)
    constants = ("intercept1", "intercept2", "friction", "pier_force")
    each = motion._replace(**{name: getattr(motion, name) * forced for name in constants})
    series = expand(each, rates(each, Position(*np.eye(6, 7))), h, TERMS, ARRAYS)
    over_step = np.array(evaluate(series, h, np.ones(7), ARRAYS))
    positions, z = [position], np.array(position)
    for _ in range(1, count):
        z = over_step[:, :6] @ z + over_step[:, 6]
        positions.append(Position(*z.tolist()))
    return positions


def _coasting(state: State, motion: LinearMotion) -> FreeVibration | Creep | None:
    """Return the pier's motion in closed form, where it has one."""
    if state.yielding is None or state.yielding.direction == 0.0:
        coupled = motion.slope1 or motion.gamma * motion.slope2
        return None if coupled else free_vibration(motion, state.position, FLOATS)
    if motion.slope1 or motion.on_pier or not state.stuck:
        return None
    creeping = creep(motion, state.position, FLOATS)
    return creeping if creeping.beta > 0.0 else None


def _known(time: float) -> float | None:
    return None if math.isnan(time) else time
