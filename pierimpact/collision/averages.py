"""Moving averages of the contact force, as crash tests report it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError, positive, told_from
from pierimpact.collision.history import CollisionHistory

Array = NDArray[np.float64]

#: Numerical: how far beside the end of a stretch forces are taken, which may jump, over its length.
BESIDE = 1e-6


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
    time, end = history.time, float(history.time[-1])
    if window > end:
        raise InputError(
            f"window must be at most the history's {end:g} s, got {told_from(window, end)} s"
        )
    before, after = history.contact_force_beside

    def at(t: Array) -> tuple[Array, Array]:
        """Return the impulse, a cubic between samples, and the force; both zero before contact."""
        place = np.clip(np.searchsorted(time, t, side="right") - 1, 0, len(time) - 2)
        length = time[place + 1] - time[place]
        s = (np.maximum(t, 0.0) - time[place]) / length
        first, last = after[place], before[place + 1]
        gained = history.impulse[place + 1] - history.impulse[place]
        turn = (1.0 - s) * first - s * last
        impulse = history.impulse[place] + s * (3.0 - 2.0 * s) * s * gained
        impulse = impulse + length * s * (1.0 - s) * turn
        return impulse, np.where(t > 0.0, first + s * (last - first), 0.0)

    def average(start: Array) -> tuple[Array, Array]:
        """Return the average and its rate."""
        (impulse, force), (later_impulse, later_force) = at(start), at(start + window)
        return (later_impulse - impulse) / window, (later_force - force) / window

    # Between neighbouring starts neither end of the window passes a sample, or a jump of the force.
    starts = np.concatenate((time, time - window))
    starts = np.unique(starts[(starts >= -window) & (starts <= end - window)])
    inside = BESIDE * np.diff(starts)
    rises, falls = average(starts[:-1] + inside)[1], average(starts[1:] - inside)[1]
    turns = np.flatnonzero((rises > 0.0) & (falls < 0.0))
    share = rises[turns] / (rises[turns] - falls[turns])
    starts = np.append(starts, starts[turns] + share * np.diff(starts)[turns])
    averages = average(starts)[0]
    best = int(np.argmax(averages))
    return AverageForce(float(averages[best]), float(starts[best]))
