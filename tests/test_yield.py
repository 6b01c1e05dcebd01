"""Piers that yield."""

import dataclasses
import math

import numpy as np
import pytest
from generated_collisions import Case, collisions, side_by_side
from generated_columns import columns
from reference import solve

from pierimpact import EquivalentPier, InputError, load_truck, peak_reactions, simulate

TRUCK = load_truck("single-unit-8t")


def known(value):
    return math.nan if value is None else value


def yielding(size, seed):
    """Generated collisions whose piers yield, by shares of the elastic reaction.

    A few are undamped, a few all but critically damped. In every fourth the friction on the pier
    can pull it back as far as it yields.
    """
    random = np.random.default_rng(seed)
    cases = []
    for number, (truck, pier, speed) in enumerate(collisions(size, seed)):
        resistance = random.uniform(0.1, 1.0) * simulate(truck, pier, speed).governing_peak.reaction
        if number % 4 == 1:
            friction = random.uniform(50e3, 300e3)
            truck = dataclasses.replace(truck, friction_on="pier", friction_force=friction)
            resistance = random.uniform(0.3, 0.9) * friction
        ratio = {2: 0.0, 5: 0.9}.get(number % 6, pier.damping_ratio)
        pier = dataclasses.replace(pier, damping_ratio=ratio, yield_reaction=resistance)
        cases.append(Case(truck, pier, speed))
    return cases


YIELDING = yielding(40, seed=60)
EVERY = pytest.mark.parametrize("case", YIELDING, ids=[str(n) for n in range(len(YIELDING))])


def directions(history):
    """The direction of each step in which the pier yields, without repetitions."""
    each = [state.yielding.direction for state, _, _ in history.steps]
    starts = [b for a, b in zip([0.0, *each], each, strict=False) if b not in (0.0, a)]
    return starts


def test_generated_piers_yield_forward_backward_and_again():
    seen = [directions(simulate(*case)) for case in YIELDING]
    assert sum(len(each) > 0 for each in seen) >= 35
    assert sum(len(each) > 1 for each in seen) >= 10
    assert sum(-1.0 in each for each in seen) >= 3
