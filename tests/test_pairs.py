"""Cycles passed over in closed form, against the matrix exponential and the way step by step."""

import numpy as np
import pytest
from generated_collisions import collisions, side_by_side
from scipy.linalg import expm
from wide_collisions import wide_collisions

from pierimpact import peak_reactions
from pierimpact.collision import propagation
from pierimpact.collision.groups import select
from pierimpact.collision.pairs import are_pairs, pair_motion, pass_cycles
from pierimpact.collision.regimes import Position, accelerations
from pierimpact.collision.series import ARRAYS
from pierimpact.collision.stepping import event_functions, longest_step

CASES = {"studied": collisions(1500, seed=70), "wide": wide_collisions(1500, seed=71)}


def peaks(cases):
    resistances = [case.pier.yield_reaction for case in cases]
    return peak_reactions(**side_by_side(cases), yield_reaction=resistances)


class Watched:
    """Results of cases, and the steps and what was looked at on the way."""

    def __init__(self, cases):
        self.cases, self.looks, self.steps = cases, [], 0
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(propagation, "pass_cycles", self.pass_cycles)
            patch.setattr(propagation, "advance", self.advance)
            self.peaks = peaks(cases)

    def pass_cycles(self, parameters, state, motion):
        new = pass_cycles(parameters, state, motion)
        self.looks.append((parameters, state, motion, new))
        return new

    def advance(self, parameters, state, motion, ops):
        self.steps += np.size(parameters.speed)
        return advance(parameters, state, motion, ops)

    def passed(self):
        """Return groups with what was passed over, not to be empty."""
        groups = []
        for group in self.looks:
            moved = np.flatnonzero(group[3].time > group[1].time)
            if len(moved):
                groups.append([select(each, moved) for each in group])
        assert sum(len(parameters.speed) for parameters, *_ in groups) > 200
        return groups


advance = propagation.advance


@pytest.fixture(scope="module", params=CASES)
def watched(request):
    return Watched(CASES[request.param])


@pytest.fixture(scope="module")
def both_ways(watched):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(propagation, "are_pairs", lambda state, motion: motion.b < 0.0)
        return watched, Watched(watched.cases)


def matrix_of(motion, index):
    """Return A of z' = A z, z = (δ1, δ1', δ2, δ2', x_p, x_p', 1), from the accelerations."""
    alone = select(motion, slice(index, index + 1))

    def at(z):
        return np.array(accelerations(alone, Position(*(np.array([x]) for x in z))))[:, 0]

    constant, matrix = at(np.zeros(6)), np.zeros((7, 7))
    matrix[0:6:2, 1:6:2] = np.eye(3)
    matrix[1:6:2, 6] = constant
    for column in range(6):
        matrix[1:6:2, column] = at(np.eye(6)[column]) - constant
    return matrix


def test_the_closed_form_is_the_matrix_exponential(watched):
    random, checked = np.random.default_rng(72), 0
    for _, state, motion, _ in watched.looks:
        pair, ordinary = pair_motion(motion, state.position), longest_step(motion, ARRAYS)
        t = ordinary * random.uniform(0.0, 30.0, len(ordinary))
        end, start = np.array(pair.after(t)), np.array(state.position)
        for i in random.permutation(len(t))[:20]:
            z = expm(matrix_of(motion, i) * t[i]) @ [*start[:, i], 1.0]
            rate = 1.0 / ordinary[i]
            x, v = np.abs(z[0:6:2]).max(), np.abs(z[1:6:2]).max()
            scale = max(
                x, np.abs(start[0::2, i]).max(), v * t[i], np.abs(start[1::2, i]).max() / rate
            )
            np.testing.assert_allclose(end[0::2, i], z[0:6:2], rtol=0, atol=1e-10 * scale)
            np.testing.assert_allclose(end[1::2, i], z[1:6:2], rtol=0, atol=1e-10 * scale * rate)
            checked += 1
    assert checked > 200


def test_no_regime_ends_on_the_way(watched):
    for parameters, state, motion, new in watched.passed():
        pair, length = pair_motion(motion, state.position), new.time - state.time
        for fraction in np.linspace(0.0, 1.0, 301):
            x = pair.after(fraction * length)
            orders = [(x.d1, x.d2, x.xp), (x.u1, x.u2, x.vp), accelerations(motion, x)]
            for event, order, parts, level in event_functions(parameters, state, motion, ARRAYS):
                value = level + sum(weight * orders[order][which] for weight, which in parts)
                assert (value <= 0.0).all(), event


def test_looks_are_at_pairs_only(watched):
    for _, state, motion, _ in watched.looks:
        assert are_pairs(state, motion).all()


def test_step_by_step_it_is_the_same(both_ways):
    found, stepped = both_ways
    assert not stepped.looks
    for name in ("engine", "cargo", "engine_contact_time", "cargo_contact_time", "ductility"):
        np.testing.assert_allclose(
            getattr(found.peaks, name), getattr(stepped.peaks, name), rtol=1e-9, err_msg=name
        )


def test_there_are_fewer_steps(both_ways):
    found, stepped = both_ways
    assert found.steps < 0.95 * stepped.steps
