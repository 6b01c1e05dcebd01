"""The motion of engine, body and pier, propagated exactly from one change of regime to the next.

`regimes` says what holds between two changes and what a change brings; `coasting` passes the
time in which nothing is coupled in closed form; `stepping` sums the coupled motion as its Taylor
series and ends each step at the first change; `series` finds where that is; `groups` holds many
collisions side by side.
"""

from pierimpact.motion.coasting import coasted, ringing
from pierimpact.motion.groups import CHUNK, chunks, take
from pierimpact.motion.regimes import (
    FREE,
    STEEP,
    Collision,
    Law,
    Position,
    Spring,
    State,
    branch,
    start,
)
from pierimpact.motion.series import ARRAYS, FLOATS, Ops
from pierimpact.motion.stepping import (
    OUTCOMES,
    expand,
    follow,
    follow_all,
    longest_step,
    motions,
)

__all__ = [
    "ARRAYS",
    "CHUNK",
    "FLOATS",
    "FREE",
    "OUTCOMES",
    "STEEP",
    "Collision",
    "Law",
    "Ops",
    "Position",
    "Spring",
    "State",
    "branch",
    "chunks",
    "coasted",
    "expand",
    "follow",
    "follow_all",
    "longest_step",
    "motions",
    "ringing",
    "start",
    "take",
]
