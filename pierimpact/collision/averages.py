"""Moving averages of the contact force, as crash tests report it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError, positive
from pierimpact.collision.history import CollisionHistory, hermite

Array = NDArray[np.float64]


class AverageForce(NamedTuple):
    """The largest moving average of the contact force."""

    force: float  #: its value [N]
    start: float  #: when its window begins after first touch; negative where before it [s]


def largest_average_force(history: CollisionHistory, window: float) -> AverageForce:
    """Return the largest average of the contact force over any stretch of time that long.

    The impulse on the pier follows from its motion,
    I(t) = ∫ F dt = m_p x_p' + c_p x_p + k_p ∫ x_p dt, and the average is
    [I(t + w) − I(t)]/w; derived here.

    Parameters
    ----------
    history : CollisionHistory
        The collision. There is no force before first touch, and none is looked for after the
        end of the history.
    window : float
        Length w of the moving window [s].

    Raises
    ------
    InputError
        When the window is not positive, or longer than the history.
    """
    window = positive("window", window)
    time, force, impulse = history.time, history.contact_force, history.impulse
    end = float(time[-1])
    if window > end:
        raise InputError(f"window must be at most the history's {end:g} s, got {window:g}")
    # Between neighbouring starts neither end of the window passes a sample.
    starts = np.concatenate((time, time - window))
    starts = np.unique(starts[(starts >= -window) & (starts <= end - window)])
    average = _at(starts + window, time, impulse, force) - _at(starts, time, impulse, force)
    average /= window
    rate = (np.interp(starts + window, time, force) - _before(starts, time, force)) / window
    best = int(np.argmax(average))
    found = AverageForce(float(average[best]), float(starts[best]))
    # The maximum lies where the rate passes zero, on one of the two sides of the best start.
    for left in (best - 1, best):
        right = left + 1
        if left < 0 or right == len(starts) or not rate[left] > 0.0 > rate[right]:
            continue
        start = starts[left] + rate[left] / (rate[left] - rate[right]) * (
            starts[right] - starts[left]
        )
        gained = _at(start + window, time, impulse, force) - _at(start, time, impulse, force)
        found = max(found, AverageForce(float(gained) / window, float(start)))
    return found


def _at(t: Array | float, time: Array, impulse: Array, force: Array) -> Array:
    """Return the impulse at any times; it is zero before first touch, and force is its slope."""
    return hermite(time, impulse, force, np.maximum(t, 0.0))


def _before(t: Array, time: Array, force: Array) -> Array:
    return np.where(t < 0.0, 0.0, np.interp(t, time, force))
