"""Reactions of sampled trucks for the bands of many collisions at a time.

A band by the full model takes a thousand collisions. Here each pier meets fewer trucks, all piers
the same, so that bands of alike piers are alike; and their reactions are by the closed spectra, the
long level of the design procedure. The nominal truck and some about the ends of the band are
compared with the full model: where these show that the procedure does not hold, all trucks collide
by that, and elsewhere the reactions are divided by what the procedure has of it there.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.groups import select
from pierimpact.collision.parameters import Parameters
from pierimpact.collision.reactions import Reactions, full_model
from pierimpact.design.band import LEVELS, sampled_factors, with_factors
from pierimpact.design.reaction import predictions
from pierimpact.vehicle.spread import Spread

Array = NDArray[np.float64]
Numbers = NDArray[np.intp]

#: Trucks that each pier meets, and the seed by which they are drawn: this project's choice.
SIZE, SEED = 128, 0
#: Ranks of the trucks that are tried about an end, from its own: this project's choice.
TRIED = (-3, 0, 3)
#: So far may the procedure's reactions be from the full model's, of the nominal truck and in the
#: mean of those about an end, and of each of these from that mean: this project's choice.
NOMINAL, ENDS, APART = 0.1, 0.15, 0.1
# Numerical: piers at a time, so that the arrays stay in the processor's cache.
_AT_ONCE = 128


def quick_reactions(
    parameters: Parameters, reactions: Array, spreads: Mapping[str, Spread]
) -> Reactions:
    """Return the reactions of SIZE trucks of the spread of each collision, shape (n, SIZE).

    In 400 random collisions of an 8 t truck, some at 5 to 12 t, and a 36 t one, some at 20 to 40 t,
    at 50 to 110 km/h, with every parameter of the truck ±30 % and piers of 8 to 150 Hz, 90 of
    100 lower ends of bands were 0.98 to 1.03 times, and all 0.94 to 1.09 times, those of the same
    trucks by the full model; upper ends 0.97 to 1.03, and 0.92 to 1.10 times. That there are 128
    trucks leaves each end a standard error of some 3 %.

    A nominal reaction may lie below the lower end, as it may by the full model alone: in 9 of 3,863
    random piers it did, whose cargo does little or does not arrive while that of others does more.

    Parameters
    ----------
    parameters : Parameters
        The nominal collisions, arrays of shape (n,).
    reactions : ndarray, shape (n,)
        Their governing reactions by the full model [N].
    spreads : mapping of str to Spread
        By parameter, of all of them, from `pierimpact.design.band.spreads_of`.
    """
    low, _, high = LEVELS
    ends = [round(low * SIZE), round(high * SIZE) - 1]
    ranks = np.add.outer(ends, TRIED)
    engine, cargo, governing = found = np.empty((3, len(reactions), SIZE))
    for first in range(0, len(reactions), _AT_ONCE):
        part = slice(first, first + _AT_ONCE)
        trucks = sampled_trucks(select(parameters, part), spreads)
        found[:, part] = np.reshape(predictions(trucks, "long"), (3, -1, SIZE))
    piers = np.arange(len(reactions))[:, None]
    order = np.argsort(governing, axis=1)
    tried = order[:, ranks.ravel()]
    reached = full_model(_sampled(parameters, spreads, piers, tried)).governing.reshape(tried.shape)
    ratios = (np.take_along_axis(governing, tried, axis=1) / reached).reshape(-1, *ranks.shape)
    means = ratios.mean(axis=2)
    nominal = predictions(parameters, "long").governing / reactions
    holds = (
        (np.abs(nominal - 1.0) <= NOMINAL)
        & np.all(np.abs(means - 1.0) <= ENDS, axis=1)
        & np.all(np.abs(ratios / means[:, :, None] - 1.0) <= APART, axis=(1, 2))
    )
    # By rank, from one end to the other.
    share = np.interp(np.argsort(order, axis=1), ends, (0.0, 1.0))
    found /= means[:, :1] + share * (means[:, 1:] - means[:, :1])
    others = np.flatnonzero(~holds)
    trucks = _sampled(parameters, spreads, others[:, None], np.arange(SIZE))
    found[:, others] = np.reshape(full_model(trucks), (3, -1, SIZE))
    return Reactions(engine, cargo, governing)


def sampled_trucks(parameters: Parameters, spreads: Mapping[str, Spread]) -> Parameters:
    """Return SIZE collisions for each of n, one after the other, arrays of shape (n SIZE,)."""
    piers = np.arange(len(parameters.speed))[:, None]
    return _sampled(parameters, spreads, piers, np.arange(SIZE))


def _sampled(
    parameters: Parameters, spreads: Mapping[str, Spread], piers: Numbers, trucks: Numbers
) -> Parameters:
    """Return the collisions of some piers with some of their trucks, which broadcast, flat."""
    factors = sampled_factors(spreads, SIZE, SEED)[0][:, :SIZE]
    pier, truck = (own.ravel() for own in np.broadcast_arrays(piers, trucks))
    return with_factors(select(parameters, pier), spreads, factors[:, truck])
