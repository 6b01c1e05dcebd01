"""The peak reactions of many collisions that are there as parameters, by the full model."""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.parameters import Parameters, in_chunks
from pierimpact.collision.propagation import propagate_all

Array: TypeAlias = NDArray[np.float64]


class Reactions(NamedTuple):
    """Engine, cargo and governing reactions, each of shape (n,); cargo is nan without it [N]."""

    engine: Array
    cargo: Array
    governing: Array


def full_model(parameters: Parameters) -> Reactions:
    """Return the peak reactions of collisions; parameters of shape (n,)."""
    peaks = propagate_all(in_chunks(parameters), parameters.speed.shape)
    engine = parameters.pier_stiffness * peaks.engine_peak
    cargo = parameters.pier_stiffness * peaks.cargo_peak
    return Reactions(engine, cargo, np.fmax(engine, cargo))
