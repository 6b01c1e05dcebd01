"""The reactions with one parameter at a time at either end of its spread."""

import numpy as np

from pierimpact.collision.groups import repeat
from pierimpact.collision.reactions import Reactions, full_model
from pierimpact.design.band import with_factors


def one_at_a_time(collision, spreads):
    """Return the reactions by parameter, arrays of shape (n, 2), the lower end first."""
    factors = np.ones((len(spreads), len(spreads), 2))
    for row, law in enumerate(spreads.values()):
        factors[row, row] = law.ends
    same = repeat(collision.parameters, 2 * len(spreads))
    reactions = full_model(with_factors(same, spreads, factors.reshape(len(spreads), -1)))
    return Reactions(*(values.reshape(-1, 2) for values in reactions))
