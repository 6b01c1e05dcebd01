"""The CMSD model once more, integrated in small steps: what the package is checked against.

The pier may yield.

Nothing is shared with the package but its input objects. Every regime is handed to SciPy's
`solve_ivp` and left at an event; peaks are the events at which the pier comes to a stand.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from pierimpact import CrushSpring, EquivalentPier, Truck

Row = NDArray[np.float64]

# The state. Its last three entries are a constant one, so that every force and every event is a
# row times the state, the work done on the pier's damper, and the impulse of what holds the pier
# and the truck back.
X1, V1, X2, V2, XP, VP, ONE, WORK, IMPULSE = np.eye(9)


@dataclass(frozen=True)
class Solution:
    """Peak reactions [N], peak and contact times [s]; NaN for what does not happen.

    The largest displacement is of either sign, from where the pier stood at first; the plastic
    displacement and the plastic work are those at the end.

    The errors are the largest of the energy and the momentum balance, over the truck's initial
    energy and momentum.
    """

    engine: float
    engine_time: float
    cargo: float
    cargo_time: float
    engine_contact_time: float
    cargo_contact_time: float
    largest_displacement: float
    plastic_displacement: float
    plastic_work: float
    energy_error: float
    momentum_error: float
    changes: list[tuple[float, str]]


class Contact:
    """A crush spring with its history: on its envelope, on its unloading line, or apart.

    Virgin loading up to P/k_u is the unloading line of a spring crushed by P/k_u before.
    """

    def __init__(self, law: CrushSpring, crush: Row, rate: Row) -> None:
        self.P, self.d = law.plateau_force, law.plateau_length
        self.k, self.k_u = law.stiffness, law.unloading_stiffness
        self.crush, self.rate = crush, rate
        self.largest, self.branch, self.hit = self.P / self.k_u, "line", math.nan

    def envelope(self) -> float:
        """Force on the envelope at the largest crush so far [N]."""
        return self.P + self.k * max(self.largest - self.d, 0.0)

    def empty(self) -> Row:
        """Crush beyond that at which the unloading line meets zero force [m]."""
        return self.crush - (self.largest - self.envelope() / self.k_u) * ONE

    def full(self) -> Row:
        """Crush beyond that at which the unloading line meets the envelope [m]."""
        return self.crush - self.largest * ONE

    def force(self) -> Row:
        """Force on the present branch [N]."""
        if self.branch == "line":
            return self.k_u * self.empty()
        if self.branch == "steep":
            return self.P * ONE + self.k * (self.crush - self.d * ONE)
        return (self.P if self.branch == "plateau" else 0.0) * ONE

    def exits(self) -> list[tuple[Row, int, str]]:
        """Ways out of the branch: what meets zero, in which direction, and the branch after."""
        if self.branch == "apart":
            return [(self.empty(), 1, "line")]
        if self.branch == "line":
            return [(self.full(), 1, self.virgin()), (self.empty(), -1, "apart")]
        rise = [(self.crush - self.d * ONE, 1, "steep")] if self.branch == "plateau" else []
        return [*rise, (self.rate, -1, "line")]

    def virgin(self) -> str:
        """Branch of the envelope beyond the largest crush so far."""
        return "plateau" if self.largest < self.d else "steep"

    def enter(self, branch: str, time: float) -> None:
        """Change branch."""
        self.branch = branch
        if branch == "steep" and math.isnan(self.hit):
            self.hit = time

    def energies(self, y: Row) -> tuple[float, float]:
        """Energy that unloading gives back, and energy lost for good [J].

        Their sum at the largest crush is the area under the envelope.
        """
        area = self.P * (self.largest - 0.5 * self.P / self.k_u)
        area += 0.5 * self.k * max(self.largest - self.d, 0.0) ** 2
        elastic = 0.5 * float(self.force() @ y) ** 2 / self.k_u
        return elastic, area - 0.5 * self.envelope() ** 2 / self.k_u


class Collision:
    """One collision, from first touch until no higher peak can come."""

    def __init__(self, truck: Truck, pier: EquivalentPier, speed: float) -> None:
        self.truck, self.pier, self.c_s = truck, pier, truck.friction_force
        self.engine = Contact(truck.engine_spring, X1 - XP, V1 - VP)
        self.body = Contact(truck.body_spring, X2 - XP, V2 - VP)
        self.on_pier = truck.friction_on == "pier"
        self.slip, self.slip_rate = (X2 - XP, V2 - VP) if self.on_pier else (X2, V2)
        self.friction = "forward" if self.c_s else "none"  # or "backward", "stuck"
        self.pier_advances = True
        self.yields, self.plastic, self.plastic_work, self.largest = "not", 0.0, 0.0, 0.0
        self.momentum, self.energy = truck.mass * speed, 0.5 * truck.mass * speed**2
        moving = pier.mass + self.on_pier * truck.body_mass
        self.period = 2 * math.pi * math.sqrt(moving / pier.stiffness)
        sway = math.sqrt(2 * self.energy / pier.stiffness)
        self.size = np.array([sway, speed] * 3 + [1, self.energy, self.momentum])
        self.time, self.y, self.rubbed, self.quiet_since = 0.0, speed * (V1 + V2) + ONE, 0.0, 0.0
        self.peaks = [(0.0, 0.0), (-math.inf, math.nan)]  # reaction and its time: engine, cargo
        self.errors = np.zeros(2)
        self.changes: list[tuple[float, str]] = []

    def pier_spring(self) -> Row:
        """Force of the pier's spring [N]."""
        if self.yields == "not":
            return self.pier.stiffness * (XP - self.plastic * ONE)
        return self.pier.yield_reaction * (1 if self.yields == "forward" else -1) * ONE

    @property
    def resistance(self) -> Row:
        """Force of the pier's spring and damper [N]."""
        return self.pier_spring() + self.pier.damping * VP

    def hold(self) -> Row:
        """Friction that keeps m2 at the velocity of the road, or of the pier [N]."""
        if not self.on_pier:
            return -self.body.force()
        share = self.truck.body_mass / (self.truck.body_mass + self.pier.mass)
        return share * (self.resistance - self.engine.force()) - self.body.force()

    def friction_force(self) -> Row:
        """Friction on m2, against its motion [N]."""
        if self.friction == "stuck":
            return self.hold()
        return {"forward": 1, "backward": -1, "none": 0}[self.friction] * self.c_s * ONE

    def system(self) -> NDArray[np.float64]:
        """Matrix of the regime's motion, but for the work on the pier's damper."""
        f1, f2, f_s = self.engine.force(), self.body.force(), self.friction_force()
        a1, a2 = -f1 / self.truck.engine_mass, -(f2 + f_s) / self.truck.body_mass
        a_p = (f1 + f2 + self.on_pier * f_s - self.resistance) / self.pier.mass
        held = self.resistance + (not self.on_pier) * f_s
        return np.array([V1, a1, V2, a2, VP, a_p, 0 * ONE, 0 * ONE, held])

    def exits(self) -> list[tuple[Row, int, str, str]]:
        """Ways out of the regime: what meets zero, in which direction, whose change, to what."""
        body, slips = self.body.exits(), []
        if self.friction == "stuck":
            limit = self.c_s * ONE
            slips = [(self.hold() - limit, 1, "forward"), (self.hold() + limit, -1, "backward")]
            body = [] if self.on_pier else body  # its crush stands still
        elif self.friction != "none":
            slips = [(self.slip_rate, -1 if self.friction == "forward" else 1, "stop")]
            if self.on_pier:  # crushing and sliding end together: one event, not two
                body = [way for way in body if way[0] is not self.body.rate]
        limit, yields = self.pier.yield_reaction, []
        if self.yields == "not" and math.isfinite(limit):
            for sign, way in ((1, "forward"), (-1, "backward")):
                yields.append((self.pier_spring() - sign * limit * ONE, sign, way, "yielding"))
        return [
            (VP, -1 if self.pier_advances else 1, "turn", "pier"),
            *yields,
            *((*way, "engine") for way in self.engine.exits()),
            *((*way, "body") for way in body),
            *((*way, "friction") for way in slips),
        ]

    def advance(self, rtol: float) -> None:
        """Integrate to the end of the regime, or for one period of the pier."""
        system, exits, start, begin = self.system(), self.exits(), self.y, self.time

        def motion(_time: float, y: Row) -> Row:
            rate: Row = system @ y
            rate[7] = self.pier.damping * y[5] ** 2
            return rate

        events = [crossing(row, way, begin) for row, way, *_ in exits]
        # Two crossings within a step would go unseen, but not the turning point in between.
        turns = [crossing(row @ system, -way) for row, way, *_ in exits]

        def integrate(end: float) -> Any:
            span, atol = (begin, end), 1e-3 * rtol * self.size
            return solve_ivp(
                motion, span, start, "DOP853", events=events + turns, rtol=rtol, atol=atol
            )

        run = integrate(begin + self.period)
        overlooked = []
        for i, event in enumerate(events):
            if len(run.t_events[i]) == 0:
                times = [*run.t_events[i + len(events)], run.t[-1]]
                states = [*run.y_events[i + len(events)], run.y[:, -1]]
                overlooked += [
                    t
                    for t, y in zip(times, states, strict=True)
                    if event.direction * event(t, y) > 0
                ]
        if overlooked:
            run = integrate(min(overlooked))
        self.time, self.y = float(run.t[-1]), run.y[:, -1]
        for spring in (self.engine, self.body):
            spring.largest = max(spring.largest, float(spring.crush @ self.y))
        if self.friction in ("forward", "backward"):
            self.rubbed += self.c_s * abs(self.slip @ (self.y - start))

        phase, top = 0 if math.isnan(self.body.hit) else 1, np.argmax(run.y[4])
        # While the pier yields the reaction is the same throughout.
        top = 0 if self.yields != "not" else top
        reaction, peak = float(self.pier_spring() @ run.y[:, top]), self.peaks[phase][0]
        self.largest = max(self.largest, np.abs(run.y[4]).max())
        if reaction > peak:  # an undamped pier swings as far again, but for rounding
            first = reaction > peak * (1 + 1e-11)
            self.peaks[phase] = (reaction, float(run.t[top]) if first else self.peaks[phase][1])
        if run.status == 1:
            self.change(*next(exits[i][2:] for i, t in enumerate(run.t_events) if len(t)))
        self.balance()

    def change(self, after: str, whose: str) -> None:
        """Enter the next regime."""
        if whose == "pier":
            self.pier_advances = not self.pier_advances
            if self.yields != "not":
                self.end_yielding()
            return
        self.changes.append((self.time, f"{whose} {after}"))
        if whose == "yielding":
            self.yields = after
        elif whose == "engine":
            self.engine.enter(after, self.time)
        elif whose == "body":
            if self.on_pier and self.c_s and "apart" in (self.body.branch, after):
                self.friction = "none" if after == "apart" else "forward"
            self.body.enter(after, self.time)
        elif after == "stop":
            if self.on_pier:
                self.body.enter("line", self.time)
            needed = float(self.hold() @ self.y)
            self.friction = "forward" if needed > 0 else "backward"
            if abs(needed) <= self.c_s:
                self.friction = "stuck"
                self.y = self.y - (self.slip_rate @ self.y) * V2  # at rest to the last digit
        else:
            self.friction = after
            # While m2 stuck to the pier, spring 2 rested on the envelope but for rounding.
            at_envelope = self.body.full() @ self.y > -1e-12 * self.body.largest
            if after == "forward" and self.on_pier and at_envelope:
                self.body.enter(self.body.virgin(), self.time)
        if whose != "body" or after not in ("line", "apart"):
            self.quiet_since = self.time

    def newly_plastic(self) -> float:
        """What has become plastic since the pier began to yield [m]."""
        if self.yields == "not":
            return 0.0
        elastic = float(self.pier_spring() @ self.y) / self.pier.stiffness
        return float(XP @ self.y) - self.plastic - elastic

    def end_yielding(self) -> None:
        """Keep what has become plastic."""
        more = self.newly_plastic()
        self.plastic_work += abs(more) * self.pier.yield_reaction
        self.plastic, self.yields, self.quiet_since = self.plastic + more, "not", self.time

    def pier_strain_energy(self) -> float:
        """Energy in the pier's spring [J]."""
        return float(0.5 * (self.pier_spring() @ self.y) ** 2 / self.pier.stiffness)

    def available(self) -> float:
        """Energy that can still reach the pier, or an upper bound of it [J]."""
        _, v1, _, v2, _, v_p = self.y[:6]
        energy = self.pier_strain_energy() + 0.5 * self.pier.mass * v_p**2
        energy += self.engine.energies(self.y)[0] + self.body.energies(self.y)[0]
        # Contact pushes only backward: a mass that moves so keeps what it has.
        energy += 0.5 * self.truck.engine_mass * max(v1, 0.0) ** 2
        pulled = self.on_pier and self.c_s > 0.0
        return float(energy + 0.5 * self.truck.body_mass * (v2 if pulled else max(v2, 0.0)) ** 2)

    def over(self) -> bool:
        """Whether no contact and no higher peak can come any more."""
        if self.yields != "not":
            return False
        available, limit = self.available(), self.pier.yield_reaction
        decided = all(
            not math.isnan(s.hit) or available < s.P * (s.d - s.largest)
            for s in (self.engine, self.body)
        )
        peak = self.peaks[0 if math.isnan(self.body.hit) else 1][0]
        reach = math.sqrt(2 * available * self.pier.stiffness)
        if decided and reach <= (peak if peak < limit * (1 - 1e-11) else limit):
            return True
        # Else: the pier rings alone, or with m2 held in place, and each swing repeats the last.
        reach = abs(self.plastic) + math.sqrt(2 * available / self.pier.stiffness)
        engine, body = (
            s.branch == "apart" and v @ self.y <= 0 and (s.empty() + XP) @ self.y + reach < 0
            for s, v in ((self.engine, V1), (self.body, V2))
        )
        if not (engine and (body or self.friction == "stuck")):
            self.quiet_since = self.time
        return self.time > self.quiet_since + 2 * self.period

    def balance(self) -> None:
        """Keep the largest errors of energy and momentum."""
        m1, m2, m_p = self.truck.engine_mass, self.truck.body_mass, self.pier.mass
        _, v1, _, v2, _, v_p, _, work, impulse = self.y
        energy = 0.5 * (m1 * v1**2 + m2 * v2**2 + m_p * v_p**2) + self.pier_strain_energy()
        energy += self.plastic_work
        if self.yields != "not":
            energy += self.pier.yield_reaction * abs(self.newly_plastic())
        energy += work + self.rubbed + sum(self.engine.energies(self.y))
        energy += sum(self.body.energies(self.y))
        momentum = m1 * v1 + m2 * v2 + m_p * v_p + impulse
        errors = abs(energy / self.energy - 1), abs(momentum / self.momentum - 1)
        self.errors = np.maximum(self.errors, errors)


def crossing(row: Row, direction: int, begin: float | None = None) -> Any:
    """Event of `solve_ivp`: the row times the state passes zero, by more than rounding.

    With the time at which its regime begins the event ends the regime, and counts as not yet
    passed at that time: there the state often sits on the boundary, but for rounding.
    """
    rounding = direction * 1e-15 * np.abs(row)

    def value(time: float, y: Row) -> float:
        return -direction if time == begin else float(row @ y - rounding @ np.abs(y))

    value.direction, value.terminal = direction, begin is not None  # type: ignore[attr-defined]
    return value


def solve(truck: Truck, pier: EquivalentPier, speed: float, rtol: float = 1e-12) -> Solution:
    """Solve one collision."""
    collision = Collision(truck, pier, speed)
    while not collision.over():
        collision.advance(rtol)
        if len(collision.changes) > 2000 or collision.time > 1000:
            raise RuntimeError(f"no end: {truck}, {pier}, {speed}, {collision.changes[-20:]}")
    (engine, engine_time), (cargo, cargo_time) = collision.peaks
    return Solution(
        engine=engine,
        engine_time=engine_time,
        cargo=cargo if math.isfinite(cargo) else math.nan,
        cargo_time=cargo_time,
        engine_contact_time=collision.engine.hit,
        cargo_contact_time=collision.body.hit,
        largest_displacement=collision.largest,
        plastic_displacement=collision.plastic,
        plastic_work=collision.plastic_work,
        energy_error=float(collision.errors[0]),
        momentum_error=float(collision.errors[1]),
        changes=collision.changes,
    )
