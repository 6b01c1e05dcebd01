"""Shear and moment of the column as a beam under the trucks of a risk, by small equal steps."""

import math
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.beams import LargestMemberForces, largest_member_forces
from pierimpact.collision.groups import select
from pierimpact.collision.parameters import Parameters
from pierimpact.pier.beam import BeamPier
from pierimpact.risk.analysis import Risk

Array: TypeAlias = NDArray[np.float64]

#: So many of the draws are followed with the column as a beam: this project's choice.
SIZE = 1024
# Numerical: collisions at a time, of about the same length; time that they are given over that of
# their springs; and the longest time [s], after which only trucks at a walking pace still arrive.
_AT_ONCE, _LONGER, _LONGEST = 256, 1.5, 2.0


def beam_strikes(risk: Risk, beams: Sequence[BeamPier], size: int = SIZE) -> LargestMemberForces:
    """Return the largest shear and moment of a beam in the first draws of a risk.

    Parameters
    ----------
    risk : Risk
        The risk.
    beams : sequence of BeamPier
        Its pier, as each of its impact heights has it: the largest of all counts.
    size : int, optional
        How many draws; fewer where the risk has fewer.

    Returns
    -------
    LargestMemberForces
        Arrays of shape (size,); zero where the truck does not arrive.
    """
    there, trucks = risk.followed_again(size)
    found = np.zeros((2, min(size, risk.size)))
    time = _times(trucks)
    parts = np.array_split(np.argsort(time), max(1, len(there) // _AT_ONCE))
    for part in parts if len(there) else ():
        for beam in beams:
            own = largest_member_forces(select(trucks, part), beam, float(time[part].max()))
            found[:, there[part]] = np.maximum(found[:, there[part]], own)
    return LargestMemberForces(*found)


def _times(trucks: Parameters) -> Array:
    """Return times in which the trucks have left the pier, or rest on it [s].

    A plateau that stops its mass takes twice its length over the speed, and a stiff spring a
    quarter of a period to stop it and no more to throw it back.
    """
    times = [
        2.0 * spring.plateau_length / trucks.speed
        + math.pi * np.sqrt(spring.mass / spring.stiffness)
        for spring in (trucks.engine, trucks.body)
    ]
    return np.asarray(np.minimum(_LONGER * np.maximum(*times), _LONGEST))
