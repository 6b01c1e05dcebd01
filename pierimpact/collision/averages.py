"""Moving averages of the contact force, as crash tests report it."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError, positive, told_from
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
        raise InputError(
            f"window must be at most the history's {end:g} s, got {told_from(window, end)} s"
        )

    def impulse_at(t: Array | float) -> Array:
        # It is zero before first touch, and its slope is the force.
        return hermite(time, impulse, force, np.maximum(t, 0.0))

    def average(start: Array | float) -> Array:
        return (impulse_at(start + window) - impulse_at(start)) / window

    # Between neighbouring starts neither end of the window passes a sample.
    starts = np.concatenate((time, time - window))
    starts = np.unique(starts[(starts >= -window) & (starts <= end - window)])
    averages = average(starts)
    rate = np.interp(starts + window, time, force) - np.interp(starts, time, force, left=0.0)
    best = int(np.argmax(averages))
    found = AverageForce(float(averages[best]), float(starts[best]))
    # The maximum lies where the rate passes zero, on one of the two sides of the best start.
    for left, right in pairwise(range(max(best - 1, 0), min(best + 2, len(starts)))):
        if rate[left] > 0.0 > rate[right]:
            share = rate[left] / (rate[left] - rate[right])
            start = float(starts[left] + share * (starts[right] - starts[left]))
            found = max(found, AverageForce(float(average(start)), start))
    return found
