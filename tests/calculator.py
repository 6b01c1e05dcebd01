"""The design procedure typed once more for one collision, as someone with a calculator would.

Nothing is shared with the package but its input objects. The long level finds the modes of
body and pier as an eigenvalue problem, and the moments of the engine's pulse by quadrature.
"""

import math
from dataclasses import dataclass
from math import atan, atan2, cos, exp, hypot, pi, sin, sqrt

import numpy as np


def closed_spectrum(beta, mu, e, zeta):
    """Return the amplification S of the unified spectrum."""
    h = 1.45 * exp(-5.3 * zeta) / ((1 + (beta / 3.1) ** 3.1) * (1 + 1.4 * mu / beta))
    return 1 / sqrt(1 / ((1 + e) * beta) ** 2 + (1 + mu / beta**2) / (1 + h) ** 2)


class Procedure:
    """Engine and cargo reaction [N] by either level; the cargo's is nan without contact."""

    def __init__(self, truck, pier, speed, level, spectrum=closed_spectrum):
        self.engine_spring, self.body_spring = truck.engine_spring, truck.body_spring
        self.m1, self.m2, self.V = truck.engine_mass, truck.body_mass, speed
        self.mp, self.kp, self.zeta = pier.mass, pier.stiffness, pier.damping_ratio
        self.spectrum = spectrum
        self.omega = sqrt(self.kp / self.mp)
        self.omega_d = self.omega * sqrt(1 - self.zeta**2)
        P1, P2 = self.engine_spring.plateau_force, self.body_spring.plateau_force
        cs = truck.friction_force
        self.Q = P2 + (cs if truck.friction_on == "pier" else 0)  # on the pier from the body
        self.Fs, self.H = P1 + self.Q, P2 + cs  # on the pier, and against the body
        self.Rs = self.Fs * (1 + exp(-pi * self.zeta * self.omega / self.omega_d))
        self.a1, self.a2 = P1 / self.m1, self.H / self.m2
        self.d1, self.d2 = truck.engine_spring.plateau_length, truck.body_spring.plateau_length
        self.engine_alone(moves=level == "long")
        if level == "long":
            self.ringing()
            self.cargo_by_modes()
        else:
            self.engine = self.alone
            self.cargo_by_spectrum()

    def left(self, a, way):
        """Return the speed left after a way slowed by a."""
        return sqrt(max(self.V**2 - 2 * a * way, 0))

    def time(self, a, way):
        """Return the time that the way takes."""
        return 2 * way / (self.V + self.left(a, way))

    def free(self, x, v, t):
        """Return displacement and velocity of the free pier, t after it had x and v."""
        decay, c, s = exp(-self.zeta * self.omega * t), cos(self.omega_d * t), sin(self.omega_d * t)
        slope = (v + self.zeta * self.omega * x) / self.omega_d
        return (
            decay * (x * c + slope * s),
            decay * ((self.omega_d * slope - self.zeta * self.omega * x) * c)
            - decay * (self.omega_d * x + self.zeta * self.omega * slope) * s,
        )

    def pushed(self, t):
        """Return the pier's response to the plateau forces from the first touch on."""
        rest = self.Fs / self.kp
        x, v = self.free(-rest, 0.0, t)
        return rest + x, v

    def amplification(self, spring, m):
        k, e = spring.stiffness, sqrt(spring.stiffness / spring.unloading_stiffness)
        return self.spectrum(self.omega / sqrt(k / m), m / self.mp, e, self.zeta)

    def engine_alone(self, moves):
        self.t1 = self.time(self.a1, self.d1)
        if moves:
            self.t1 = self.time(self.a1, self.d1 + self.pushed(self.t1)[0])
        x, v = self.pushed(self.t1)
        self.v1 = self.left(self.a1, self.d1 + (x if moves else 0))
        self.u1 = max(self.v1 - v, 0)
        blow = self.amplification(self.engine_spring, self.m1) * self.u1
        blow *= sqrt(self.engine_spring.stiffness * self.m1)
        self.A1 = hypot(self.kp * x - self.Q, self.kp * v / self.omega + blow)
        self.crested = self.omega_d * self.t1 >= pi
        self.alone = self.Rs
        if self.v1 > 0:
            struck = self.Q + self.A1
            self.alone = max(struck, self.Rs) if self.crested else struck

    def cargo_by_spectrum(self):
        spring, self.cargo = self.body_spring, math.nan
        v2 = self.left(self.a2, self.d2)
        if v2 == 0:
            return
        t2 = self.time(self.a2, self.d2)
        rise = sqrt(self.H**2 + spring.stiffness * self.m2 * v2**2) - self.H
        A2 = self.A1 if self.v1 > 0 else self.Fs
        A2 *= exp(-self.zeta * self.omega * (t2 - (self.t1 if self.v1 > 0 else 0)))
        beta = self.omega / sqrt(spring.stiffness / self.m2)
        self.cargo = (
            self.Q + self.amplification(spring, self.m2) * rise + 0.6 / (1 + (2 / beta) ** 2) * A2
        )

    def ringing(self):
        """Find when the engine lets go, and the pier's motion about its rest without it."""
        impulse, self.released = 0.0, self.V / self.a1
        if self.v1 > 0:
            k = self.engine_spring.stiffness
            e = sqrt(k / self.engine_spring.unloading_stiffness)
            m = self.m1 * self.mp / (self.m1 + self.mp)
            omega = sqrt(k / m)
            node, weight = np.polynomial.legendre.leggauss(30)
            rise, fall = (0.25 * pi * (node + 1) * part for part in (1.0, e))
            t = np.concatenate([rise, 0.5 * pi + fall]) / omega
            force = np.concatenate([np.sin(rise) * weight, np.cos(fall / e) * weight * e])
            mean = np.average(t, weights=force)
            variance = np.average((t - mean) ** 2, weights=force)
            impulse = (1 + e) * m * self.u1 * exp(-0.5 * self.omega**2 * variance)
            self.released = self.t1 + mean
        x, v = self.pushed(self.released)
        self.ringing_x, self.ringing_v = x - self.Q / self.kp, v + impulse / self.mp

    def before_cargo(self, t):
        if t <= self.released:
            return self.pushed(t)
        x, v = self.free(self.ringing_x, self.ringing_v, t - self.released)
        return x + self.Q / self.kp, v

    def cargo_by_modes(self):
        t2 = self.time(self.a2, self.d2)
        t2 = self.time(self.a2, self.d2 + self.before_cargo(t2)[0])
        x, v = self.before_cargo(t2)
        v2 = self.left(self.a2, self.d2 + x)
        self.engine, self.cargo = self.alone, math.nan
        if v2 == 0:
            return
        up = self.omega**2 * self.ringing_x + self.zeta * self.omega * self.ringing_v
        crest = self.released + atan2(self.ringing_v * self.omega_d, up) / self.omega_d
        if self.v1 > 0 and t2 < crest:
            reached = max(self.kp * x, self.Rs if self.crested else 0)
            self.engine = min(reached, self.alone)
        k = self.body_spring.stiffness
        e = sqrt(k / self.body_spring.unloading_stiffness)
        masses, rest = np.array([self.m2, self.mp]), (self.Q - self.H) / self.kp
        scale = 1 / np.sqrt(masses)
        squares, shapes = np.linalg.eigh(
            np.array([[k, -k], [-k, k + self.kp]]) * np.outer(scale, scale)
        )
        start = [x - rest + self.H / k, x - rest], [v2, v]
        (slow, slow_crest), (fast, fast_crest) = (
            self.mode(sqrt(square), shape * scale, masses, *start)
            for square, shape in zip(squares, shapes.T, strict=True)
        )
        turn, period = slow_crest, 2 * pi / fast.omega
        before = fast_crest + period * math.floor((turn - fast_crest) / period)
        slow_weight = slow.amplitude * slow.omega**2 * exp(-slow.sigma * turn)
        fast_weight = fast.amplitude * fast.omega**2 * exp(-fast.sigma * turn)
        share = fast_weight / (slow_weight + fast_weight)
        at_turn, early, late = (
            rest + slow(t) + fast(t)
            for t in (
                turn,
                max(turn + share * (before - turn), 0),
                turn + share * (before + period - turn),
            )
        )
        self.cargo = self.kp * max(x, early, at_turn + 0.5 * (1 + e) * (late - at_turn))

    def mode(self, omega, shape, masses, positions, velocities):
        """Return a mode of the pier's displacement, and when it first crests."""
        shape = shape / shape[1]  # the pier moves by one
        modal = masses @ shape**2
        sigma = self.zeta * self.omega * self.mp / modal
        a = masses * shape @ positions / modal
        b = (masses * shape @ velocities / modal + sigma * a) / omega
        mode = Mode(omega, sigma, hypot(a, b), atan2(b, a))
        return mode, (mode.phase - atan(sigma / omega)) % (2 * pi) / omega


@dataclass
class Mode:
    """A e^(−σt) cos(ωt − φ)."""

    omega: float
    sigma: float
    amplitude: float
    phase: float

    def __call__(self, t):
        return self.amplitude * exp(-self.sigma * t) * cos(self.omega * t - self.phase)
