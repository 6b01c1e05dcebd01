"""Force records, measured or from finite elements, and the same forces by the model."""

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import (
    InputError,
    ascending_array,
    finite_array,
    number,
    one_of,
    positive,
    told_from,
)
from pierimpact.collision.history import CollisionHistory
from pierimpact.collision.simulate import simulate
from pierimpact.pier.beam import BeamPier
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.vehicle.truck import Truck

Array = NDArray[np.float64]

QUANTITIES = ("contact force", "reaction")
FEWEST = 50  # samples of a record
#: Time from first touch to the end of a record [s]: this project's choice, beyond any collision.
LONGEST = 10.0
#: A rigid pier, numerical: in a collision it moves by less than the thickness of an atom.
RIGID = EquivalentPier.from_frequency(mass=1e14, frequency=10.0)

_PAD = 3.0  # periods of the cut-off frequency by which a force goes on beyond its ends; numerical
_FINE = 50  # samples of the model in a window or a period of the cut-off frequency


@dataclass(frozen=True, kw_only=True, eq=False)
class Record:
    """A force over time, how it came about, and what was done to it.

    Parameters
    ----------
    time : array_like, shape (n,)
        Times in ascending order [s].
    force : array_like, shape (n,)
        Force at these times, compression positive [N].
    speed : float
        Speed of the truck at first touch [m/s].
    pier : EquivalentPier, BeamPier or None, optional
        The pier; None is rigid.
    quantity : {"contact force", "reaction"}, optional
        What was recorded: the force of the truck on the pier, or the static force k_p x_p that
        gives the pier's displacement; on a rigid pier they are the same.
    cutoff : float or None, optional
        Cut-off frequency of the low-pass filter that the force has passed [Hz]; see `low_pass`. The
        record is at least one of its periods long.
    window : float or None, optional
        Length of the moving average that the force is, centred on its times: at most that of the
        record [s].
    first_touch : float, optional
        Time of first touch on the record's own clock, at most 10 s before its end [s].

    Raises
    ------
    InputError
        When an array is too short or not finite, times do not ascend, the force never rises above
        zero after first touch, or another value is out of range.
    """

    time: Array = field(repr=False)
    force: Array = field(repr=False)
    speed: float
    pier: EquivalentPier | BeamPier | None = None
    quantity: str = "contact force"
    cutoff: float | None = None
    window: float | None = None
    first_touch: float = 0.0

    def __post_init__(self) -> None:
        time, force = ascending_array("time", self.time), finite_array("force", self.force)
        if force.shape != time.shape or len(time) < FEWEST:
            raise InputError(
                f"time and force must be two arrays of one length, at least {FEWEST}, "
                f"got shapes {time.shape} and {force.shape}"
            )
        first_touch = number("first_touch", self.first_touch)
        if first_touch >= time[-1]:
            raise InputError(
                f"first_touch must lie before the end of the record at {time[-1]:g} s, "
                f"got {first_touch:g} s"
            )
        if time[-1] - first_touch > LONGEST:
            raise InputError(
                f"first_touch must lie at most {LONGEST:g} s before the end of the record at "
                f"{time[-1]:g} s, got {first_touch:g} s"
            )
        largest = float(np.max(force[time >= first_touch]))
        if largest <= 0.0:
            raise InputError(
                f"force must rise above zero (compression is positive), its largest is {largest:g}"
            )
        # Copies, so that a record stays as it was checked whatever becomes of the caller's arrays.
        values: dict[str, object] = {"time": time.copy(), "force": force.copy()}
        values["first_touch"] = first_touch
        values["speed"] = positive("speed", self.speed)
        one_of("quantity", self.quantity, QUANTITIES)
        for name in ("cutoff", "window"):
            if (value := getattr(self, name)) is not None:
                values[name] = positive(name, value)
        for name, value in values.items():
            object.__setattr__(self, name, value)
        length = float(time[-1] - time[0])
        if self.cutoff is not None and self.cutoff * length < 1.0:
            raise InputError(
                f"cutoff must be at least {1.0 / length:g} Hz, one period in the record, "
                f"got {told_from(self.cutoff, 1.0 / length)} Hz"
            )
        if self.window is not None and self.window > length:
            raise InputError(
                f"window must be at most the record's {length:g} s, "
                f"got {told_from(self.window, length)} s"
            )
        # Of the samples a second; this project's choice.
        if self.cutoff is not None and self.cutoff > 0.4 / self.step:
            raise InputError(
                f"cutoff must be at most 0.4 of the record's {1.0 / self.step:.4g} samples a "
                f"second, got {self.cutoff:g} Hz"
            )

    @property
    def step(self) -> float:
        """Median time between two samples [s]."""
        return float(np.median(np.diff(self.time)))

    @property
    def peak(self) -> float:
        """Largest force [N]."""
        return float(np.max(self.force))

    @property
    def resolution(self) -> float:
        """Time within which nothing can be told apart [s].

        The longest of the moving average, half a period of the cut-off frequency, and two samples.
        """
        half_period = 0.5 / self.cutoff if self.cutoff else 0.0
        return max(self.window or 0.0, half_period, 2.0 * self.step)

    def low_passed(self, cutoff: float) -> "Record":
        """Return the record behind a low-pass filter of a cut-off frequency [Hz]; see `low_pass`.

        Raises
        ------
        InputError
            When the record has passed a filter already, or the frequency is out of range.
        """
        if self.cutoff is not None:
            raise InputError(f"the record has passed a filter of {self.cutoff:g} Hz already")
        filtered = replace(self, cutoff=cutoff)
        grid = _grid(self.time, self.step)
        force = low_pass(np.interp(grid, self.time, self.force), self.step, cutoff)
        object.__setattr__(filtered, "force", np.interp(self.time, grid, force))
        return filtered

    def collision(self, truck: Truck) -> CollisionHistory:
        """Return the collision of a truck with the record's pier at its speed, to its end."""
        pier = RIGID if self.pier is None else self.pier
        return simulate(truck, pier, self.speed, max(float(self.time[-1]) - self.first_touch, 0.0))

    def modelled(self, history: CollisionHistory, stride: int = 1) -> Array:
        """Return what the record would be if the collision were that of the model [N].

        It has passed the same filter and is the same average.

        Parameters
        ----------
        history : CollisionHistory
            The collision, as `collision` returns it.
        stride : int, optional
            Every so many of the record's times.
        """
        reaction = self.quantity == "reaction" and self.pier is not None
        force_at = history.reaction_at if reaction else history.contact_force_at
        time = self.time[::stride]
        if self.cutoff is None and self.window is None:
            return force_at(time - self.first_touch)
        scale = min(1.0 / self.cutoff if self.cutoff else math.inf, self.window or math.inf)
        scale = max(scale, self.step)  # or a short average would take any number of samples
        step = self.step / max(1, math.ceil(_FINE * self.step / scale))
        grid = _grid(self.time, step)
        force = force_at(grid - self.first_touch)
        if self.window is not None:
            force = moving_average(force, step, self.window)
        if self.cutoff is not None:
            force = low_pass(force, step, self.cutoff)
        return np.interp(time, grid, force)


def low_pass(force: Array, step: float, cutoff: float) -> Array:
    """Return a force behind a Butterworth filter of two poles that is run forward and backward.

    The two runs leave no shift in time and have four poles in all; at the cut-off frequency they
    let 1/√2 of an amplitude through. Before its first sample the force counts as zero, after its
    last as its mirror image.

    Parameters
    ----------
    force : ndarray, shape (n,)
        Samples [N].
    step : float
        Time between them [s].
    cutoff : float
        Cut-off frequency [Hz].
    """
    from scipy.signal import butter, sosfiltfilt

    pad = math.ceil(_PAD / (cutoff * step))
    padded = _padded(force, pad)
    # Each run lets 2^(−1/4) through at the cut-off, where |H|² = 1/(1 + Ω⁴) and Ω is, by the
    # bilinear transform, tan(π f step) over that of the filter's own frequency.
    tangent = math.tan(math.pi * cutoff * step) / (math.sqrt(2.0) - 1.0) ** 0.25
    sections = butter(2, 2.0 * math.atan(tangent) / math.pi, output="sos")
    return np.asarray(sosfiltfilt(sections, padded, padlen=0)[pad:-pad])


def moving_average(force: Array, step: float, window: float) -> Array:
    """Return the average of a force over a window [s] centred on each of its samples.

    Arguments and what counts as the force beyond its ends as in `low_pass`.
    """
    pad = math.ceil(window / step)
    padded = _padded(force, pad)
    impulse = np.concatenate(([0.0], np.cumsum(0.5 * step * (padded[1:] + padded[:-1]))))
    time = step * np.arange(len(padded))
    middle, half = time[pad:-pad], 0.5 * window
    after, before = (np.interp(middle + shift, time, impulse) for shift in (half, -half))
    return np.asarray((after - before) / window)


def _padded(force: Array, pad: int) -> Array:
    return np.concatenate((np.zeros(pad), np.pad(force, (0, pad), mode="symmetric")))


def _grid(time: Array, step: float) -> Array:
    """Return times a step apart over those of a record."""
    return np.asarray(time[0] + step * np.arange(math.ceil((time[-1] - time[0]) / step) + 1))
