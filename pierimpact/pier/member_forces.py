"""Shear and moment of a pier: under a static force at the impact height, and during a collision."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Extreme(NamedTuple):
    """A largest value and the stretch of column, from `start` to `end`, on which it holds.

    A shear holds along the whole column below or above the impact; a moment at one height, where
    `start` and `end` are the same.
    """

    value: float
    start: float
    end: float


@dataclass(frozen=True, kw_only=True)
class MemberForces:
    """Internal forces of a column under a static force R in the direction of travel at z_n.

    Sign convention. The moment M is positive where the face away from the truck is in tension.
    The shear is V = dM/dz with z upward from the base, so that V is positive where the column
    below pushes back against the direction of travel. Support forces are positive against the
    direction of travel: they share R. An end moment is the moment M in the column at that end.

    Parameters
    ----------
    reaction : float
        Force R, positive in the direction of travel [N].
    height, bottom : float
        Heights of the ends: column height H, and 0 or, of an embedded column, below it [m].
    impact_height : float
        Height z_n at which R acts [m].
    base_force, top_force : float
        Support forces R_b and R_t [N].
    base_moment, top_moment : float
        End moments M_b and M_t [N m].
    """

    reaction: float
    height: float
    bottom: float = 0.0
    impact_height: float
    base_force: float
    top_force: float
    base_moment: float
    top_moment: float

    @property
    def impact_moment(self) -> float:
        """Moment M_n = M_b + R_b z_n = M_t + R_t (H − z_n) at the impact height [N m]."""
        # The end with the smaller moment loses no figures to the difference of the two terms,
        # and gives an exact zero beside a free end.
        if abs(self.base_moment) < abs(self.top_moment):
            return self.base_moment + self.base_force * (self.impact_height - self.bottom)
        return self.top_moment + self.top_force * (self.height - self.impact_height)

    @property
    def z(self) -> NDArray[np.float64]:
        """Heights of base, z_n, z_n and top, the diagrams' corners, shape (4,) [m].

        The impact height stands twice: first for the column below it, then for that above.
        """
        return np.array([self.bottom, self.impact_height, self.impact_height, self.height])

    @property
    def shear(self) -> NDArray[np.float64]:
        """Shear V at `z`, shape (4,) [N]: R_b below the impact, −R_t = R_b − R above it."""
        above = 0.0 - self.top_force  # a plain sign change would print an unloaded end as -0
        return np.array([self.base_force, self.base_force, above, above])

    @property
    def moment(self) -> NDArray[np.float64]:
        """Moment M at `z`, shape (4,) [N m]; straight lines join M_b, M_n and M_t."""
        impact_moment = self.impact_moment
        return np.array([self.base_moment, impact_moment, impact_moment, self.top_moment])

    @property
    def largest_shear(self) -> Extreme:
        """Shear of the largest magnitude [N] and where [m]; below the impact if both are equal."""
        corner = _first_largest(self.shear)
        start, end = (
            (self.bottom, self.impact_height) if corner < 2 else (self.impact_height, self.height)
        )
        return Extreme(float(self.shear[corner]), start, end)

    @property
    def largest_moment(self) -> Extreme:
        """Moment of the largest magnitude [N m] and where [m]; the lowest of several equal ones."""
        corner = _first_largest(self.moment)
        height = float(self.z[corner])
        return Extreme(float(self.moment[corner]), height, height)


@dataclass(frozen=True, kw_only=True, eq=False)
class MemberForceHistory:
    """Shear and moment of a beam in time and over its height, and their envelopes.

    The sign convention is that of `MemberForces`.

    Parameters
    ----------
    z : ndarray, shape (m,)
        Heights from base to top; the impact height is there twice, first for the beam below it,
        then for that above [m].
    shear, moment : ndarray, shape (n, m)
        Shear V [N] and moment M [N m] at the n times of the history.
    """

    z: NDArray[np.float64]
    shear: NDArray[np.float64] = field(repr=False)
    moment: NDArray[np.float64] = field(repr=False)

    @cached_property
    def largest_shear(self) -> NDArray[np.float64]:
        """Largest shear at each height, shape (m,) [N]."""
        return np.asarray(self.shear.max(axis=0))

    @cached_property
    def smallest_shear(self) -> NDArray[np.float64]:
        """Smallest (most negative) shear at each height, shape (m,) [N]."""
        return np.asarray(self.shear.min(axis=0))

    @cached_property
    def largest_moment(self) -> NDArray[np.float64]:
        """Largest moment at each height, shape (m,) [N m]."""
        return np.asarray(self.moment.max(axis=0))

    @cached_property
    def smallest_moment(self) -> NDArray[np.float64]:
        """Smallest (most negative) moment at each height, shape (m,) [N m]."""
        return np.asarray(self.moment.min(axis=0))


def _first_largest(values: NDArray[np.float64]) -> int:
    """Index of the first value whose magnitude is, but for round-off, the largest."""
    size = np.abs(values)
    return int(np.argmax(size >= (1.0 - 1e-12) * size.max()))
