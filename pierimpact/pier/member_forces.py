"""Shear and moment of a pier: under a static force at the impact height, and during a collision."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

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

    Examples
    --------
    >>> from pierimpact import CircularSection, PierColumn
    >>> column = PierColumn(
    ...     height=5.0, section=CircularSection(diameter=0.9), elastic_modulus=25e9, density=2400.0
    ... )
    >>> forces = column.member_forces(1e6, impact_height=1.2)
    >>> round(forces.base_force / 1e6, 2), round(forces.top_force / 1e6, 2)  # MN
    (0.92, 0.08)
    >>> largest = forces.largest_moment
    >>> round(largest.value / 1e6, 2), largest.start  # MN m, m
    (-0.79, 0.0)
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

    def shear_within(self, low: float, high: float) -> float:
        """Return the largest magnitude of the shear from one height to another, above it [N]."""
        z, bottom, top = self.impact_height, self.bottom, self.height
        # Where an end is struck, the force of its support counts, as it does in `largest_shear`.
        below, above = low < z or z == low == bottom, high > z or z == high == top
        return float(np.max(np.abs(self.shear[[0, 2]]), where=[below, above], initial=0.0))

    def moment_within(self, low: float, high: float) -> float:
        """Return the largest magnitude of the moment from one height to another [N m]."""
        places = np.clip([low, self.impact_height, high], low, high)
        return float(np.max(np.abs(np.interp(places, self.z, self.moment))))


class BeamExtreme(NamedTuple):
    """A largest or smallest value of shear [N] or moment [N m], and where and when it occurs."""

    value: float
    z: float  #: height [m]
    time: float  #: after first touch [s]


class BeamExtremes(NamedTuple):
    """The largest and the smallest (most negative) value of shear or moment."""

    largest: BeamExtreme
    smallest: BeamExtreme

    @property
    def governing(self) -> BeamExtreme:
        """The one of the larger magnitude."""
        return max(self, key=lambda extreme: abs(extreme.value))


class _Peaks(NamedTuple):
    """The largest or the smallest value in time at each height, and its time, shape (m,)."""

    value: NDArray[np.float64]
    time: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class MemberForceHistory:
    """Shear and moment of a beam in time and over its height, their envelopes and extremes.

    The sign convention is that of `MemberForces`. Between samples in time and between heights
    envelopes and extremes follow parabolas, so that they may slightly exceed the arrays.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Times after first touch, in ascending order [s].
    z : ndarray, shape (m,)
        Heights from base to top; the impact height is there twice, first for the beam below it,
        then for that above [m].
    shear, moment : ndarray, shape (n, m)
        Shear V [N] and moment M [N m] at these times and heights.

    Examples
    --------
    >>> from pierimpact import CircularSection, PierColumn, load_truck, simulate
    >>> column = PierColumn(
    ...     height=5.0, section=CircularSection(diameter=0.9), elastic_modulus=25e9, density=2400.0
    ... )
    >>> history = simulate(load_truck("single-unit-8t"), column.beam(impact_height=1.2), speed=22.2)
    >>> largest = history.member_forces.moment_extremes.governing
    >>> round(largest.value / 1e6, 2), largest.z, round(largest.time, 4)  # MN m, m, s
    (-4.13, 0.0, 0.0299)
    """

    time: NDArray[np.float64] = field(repr=False)
    z: NDArray[np.float64]
    shear: NDArray[np.float64] = field(repr=False)
    moment: NDArray[np.float64] = field(repr=False)

    @property
    def largest_shear(self) -> NDArray[np.float64]:
        """Largest shear at each height, shape (m,) [N]."""
        return self._shear_peaks[0].value

    @property
    def smallest_shear(self) -> NDArray[np.float64]:
        """Smallest (most negative) shear at each height, shape (m,) [N]."""
        return self._shear_peaks[1].value

    @property
    def largest_moment(self) -> NDArray[np.float64]:
        """Largest moment at each height, shape (m,) [N m]."""
        return self._moment_peaks[0].value

    @property
    def smallest_moment(self) -> NDArray[np.float64]:
        """Smallest (most negative) moment at each height, shape (m,) [N m]."""
        return self._moment_peaks[1].value

    @property
    def shear_extremes(self) -> BeamExtremes:
        """Extremes of the shear."""
        return self._extremes(*self._shear_peaks)

    @property
    def moment_extremes(self) -> BeamExtremes:
        """Extremes of the moment."""
        return self._extremes(*self._moment_peaks)

    @cached_property
    def _shear_peaks(self) -> tuple[_Peaks, _Peaks]:
        return self._peaks(self.shear)

    @cached_property
    def _moment_peaks(self) -> tuple[_Peaks, _Peaks]:
        return self._peaks(self.moment)

    def _peaks(self, values: NDArray[np.float64]) -> tuple[_Peaks, _Peaks]:
        heights = np.arange(len(self.z))

        def beside(sample: NDArray[np.intp]) -> _Peaks:
            samples = _with_neighbours(sample, len(self.time))
            time, value = _vertex(self.time[samples], values[samples, heights])
            return _Peaks(value, time)

        return beside(values.argmax(axis=0)), beside(values.argmin(axis=0))

    def between(self, low: float, high: float) -> "MemberForceHistory":
        """Return the same at those of its heights that are from one to another [m]."""
        own = within(self.z, low, high)
        if own == slice(0, len(self.z)):
            return self  # which knows its peaks
        return MemberForceHistory(
            time=self.time, z=self.z[own], shear=self.shear[:, own], moment=self.moment[:, own]
        )

    def _extremes(self, largest: _Peaks, smallest: _Peaks) -> BeamExtremes:
        def beside(peaks: _Peaks, place: np.intp) -> BeamExtreme:
            places = _with_neighbours(place, len(self.z))
            z, value = _vertex(self.z[places], peaks.value[places])
            return BeamExtreme(float(value), float(z), float(peaks.time[place]))

        return BeamExtremes(
            beside(largest, largest.value.argmax()), beside(smallest, smallest.value.argmin())
        )


def within(z: NDArray[np.float64], low: float, high: float) -> slice:
    """Return which of ascending heights are from one to another [m].

    Of a height that is there twice, for what is below it and above it, those within count; at the
    ends of all heights both do.
    """
    first, last = np.searchsorted(z, low, "left"), np.searchsorted(z, high, "right")
    if low > z[0]:
        first = max(first, np.searchsorted(z, low, "right") - 1)
    if high < z[-1]:
        last = min(last, np.searchsorted(z, high, "left") + 1)
    return slice(int(first), int(last))


def _with_neighbours(index: Any, count: int) -> NDArray[np.intp]:
    """Return the index before, the index and the one after it, as far as there are any."""
    return np.array([np.maximum(index - 1, 0), index, np.minimum(index + 1, count - 1)])


def _vertex(
    x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return where the parabola through three points turns, and its value there.

    Where the middle point is neither the highest nor the lowest, or has no neighbours, that point.
    """
    before, after = x[1] - x[0], x[2] - x[1]
    up, down = y[1] - y[0], y[1] - y[2]
    slope, bend = up * after**2 - down * before**2, up * after + down * before
    turns = (before > 0.0) & (after > 0.0) & (up * down >= 0.0) & (bend != 0.0)
    shift = np.where(turns, slope, 0.0) / np.where(turns, 2.0 * bend, 1.0)
    width = np.where(turns, before * after * (before + after), 1.0)
    return x[1] + shift, y[1] + 0.5 * shift * slope / width


def _first_largest(values: NDArray[np.float64]) -> int:
    """Index of the first value whose magnitude is, but for round-off, the largest."""
    size = np.abs(values)
    return int(np.argmax(size >= (1.0 - 1e-12) * size.max()))
