"""A truck against a column of finite elements, in small steps of time: what the beam is checked by.

Nothing is shared with the package but its input objects. The elements interpolate deflection and
rotation by straight lines, with the shear strain of their middle; each step is Newmark's with
constant average acceleration; the crush law is a function of the crush and the largest so far.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from pierimpact import CrushSpring, PierColumn, Truck

Array = NDArray[np.float64]

HELD = {"fixed": [True, True], "pinned": [True, False], "free": [False, False]}


@dataclass(frozen=True)
class Solution:
    """Histories: displacement at the impact and contact force, shape (n,); at the heights 0, z_n
    from below, z_n from above and H, shear and moment, shape (n, 4)."""

    time: Array
    displacement: Array
    force: Array
    shear: Array
    moment: Array


class Mesh:
    """Mass and stiffness of the column, the impact at a joint."""

    def __init__(self, column: PierColumn, impact_height: float, elements: int) -> None:
        below = max(2, round(elements * impact_height / column.height))
        above = max(2, elements - below) if impact_height < column.height else 0
        lower = np.linspace(0.0, impact_height, below + 1)
        upper = np.linspace(impact_height, column.height, above + 1)[1:]
        self.lengths = np.diff(np.concatenate((lower, upper)))
        self.struck, count = below, below + above + 1
        self.stiffness, self.mass = np.zeros((2, 2 * count, 2 * count))
        inertia = column.density * column.section.second_moment
        line = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6.0
        for first, length in enumerate(self.lengths):
            w = np.array([2 * first, 2 * first + 2])
            places = np.array([2 * first, 2 * first + 1, 2 * first + 2, 2 * first + 3])
            strain = np.array([-1.0 / length, -0.5, 1.0 / length, -0.5])
            curvature = np.array([0.0, -1.0, 0.0, 1.0]) / length
            self.stiffness[np.ix_(places, places)] += length * (
                column.shear_rigidity * np.outer(strain, strain)
                + column.flexural_rigidity * np.outer(curvature, curvature)
            )
            self.mass[np.ix_(w, w)] += column.mass_per_length * length * line
            self.mass[np.ix_(w + 1, w + 1)] += inertia * length * line
        self.moving = ~np.array(
            HELD[column.base] + [False] * (2 * count - 4) + HELD[column.top], dtype=bool
        )
        self.impact = int(np.count_nonzero(self.moving[: 2 * below]))
        self.column = column
        keep = np.ix_(self.moving, self.moving)
        self.stiffness, self.mass = self.stiffness[keep], self.mass[keep]

    def damping(self, ratio: float) -> Array:
        """Matrix that damps every mode by the same ratio."""
        squares, shapes = eigh(self.stiffness, self.mass)
        weighted = self.mass @ shapes
        matrix: Array = (weighted * (2.0 * ratio * np.sqrt(squares))) @ weighted.T
        return matrix

    def forces(self, moved: Array) -> tuple[Array, Array]:
        """Shear and moment beside the supports and the impact, shape (n, 4)."""
        displaced = np.zeros((len(moved), len(self.moving)))
        displaced[:, self.moving] = moved
        w, t = displaced[:, 0::2], displaced[:, 1::2]
        strain = np.diff(w) / self.lengths - 0.5 * (t[:, 1:] + t[:, :-1])
        shear = self.column.shear_rigidity * strain
        moment = -self.column.flexural_rigidity * np.diff(t) / self.lengths
        last, k = len(self.lengths) - 1, self.struck
        # From the middles of two elements to the end of the nearer one.
        pairs = [(0, 1), (k - 1, k - 2), (min(k, last), min(k + 1, last)), (last, last - 1)]
        shear, moment = (
            np.stack([1.5 * f[:, near] - 0.5 * f[:, far] for near, far in pairs], axis=1)
            for f in (shear, moment)
        )
        return shear, moment


class Spring:
    """The crush law as a function of the crush and the largest so far."""

    def __init__(self, law: CrushSpring) -> None:
        self.law, self.largest = law, law.plateau_force / law.unloading_stiffness

    def envelope(self, crush: float) -> float:
        """Force of virgin loading beyond the elastic limit [N]."""
        return self.law.plateau_force + self.law.stiffness * max(
            crush - self.law.plateau_length, 0.0
        )

    def force(self, crush: float) -> float:
        """Force at a crush [N]."""
        if crush >= self.largest:
            return self.envelope(crush)
        line = self.envelope(self.largest) - self.law.unloading_stiffness * (self.largest - crush)
        return max(line, 0.0)


def solve(
    truck: Truck,
    column: PierColumn,
    impact_height: float,
    damping_ratio: float,
    speed: float,
    duration: float,
    elements: int = 100,
    step: float = 1e-5,
) -> Solution:
    """Solve one collision up to a time."""
    mesh = Mesh(column, impact_height, elements)
    damping = mesh.damping(damping_ratio)
    half, quarter = 0.5 * step, 0.25 * step**2
    inverse = np.linalg.inv(mesh.mass + half * damping + quarter * mesh.stiffness)
    resist = np.hstack((inverse @ mesh.stiffness, inverse @ damping))
    k, give = mesh.impact, inverse[:, mesh.impact]
    springs = (Spring(truck.engine_spring), Spring(truck.body_spring))
    masses = np.array([truck.engine_mass, truck.body_mass])
    on_pier, limit = truck.friction_on == "pier", truck.friction_force

    u, v, a = np.zeros((3, len(mesh.mass)))
    x, s, b = np.zeros(2), np.full(2, speed), np.array([0.0, 0.0])
    force = np.zeros(2)
    rows: list[Any] = [(0.0, 0.0, u)]
    steps = round(duration / step)
    for _ in range(steps):
        u_free, v_free = u + step * v + quarter * a, v + half * a
        a_free = -resist @ np.concatenate((u_free, v_free))
        x_free, s_free = x + step * s + quarter * b, s + half * b
        for _ in range(50):
            rate = s[1] - on_pier * v[k]
            friction = limit * np.clip(rate / (1e-4 * speed), -1.0, 1.0)
            if on_pier and force[1] == 0.0:
                friction = 0.0
            total = force.sum() + on_pier * friction
            b = -(force + np.array([0.0, friction])) / masses
            x = x_free + quarter * b
            pier = u_free[k] + quarter * (a_free[k] + total * give[k])
            new = np.array([spring.force(d) for spring, d in zip(springs, x - pier, strict=True)])
            change, force = np.abs(new - force).max(), new
            if change < 1e-3:
                break
        a = a_free + total * give
        u, v, s = u_free + quarter * a, v_free + half * a, s_free + half * b
        for spring, crush in zip(springs, x - u[k], strict=True):
            spring.largest = max(spring.largest, crush)
        rows.append((u[k], total, u))
    displacement, contact, moved = (np.array(column) for column in zip(*rows, strict=True))
    shear, moment = mesh.forces(moved)
    return Solution(step * np.arange(steps + 1), displacement, contact, shear, moment)
