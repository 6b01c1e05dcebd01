"""Our Sobol points against SciPy's, bit by bit, and where they must lie."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats.qmc import Sobol

from pierimpact.design.band import UNCERTAIN
from pierimpact.design.sobol import BITS, MOST, sobol_points


@given(count=st.integers(1, MOST), power=st.integers(0, 12), seed=st.integers(0, 2**63))
def test_points_are_those_of_scipy_to_the_last_bit(count, power, seed):
    expected = Sobol(count, bits=BITS, rng=seed).random_base2(power).T
    np.testing.assert_array_equal(sobol_points(count, power, seed), expected)


@pytest.mark.parametrize("power", [1, 5, 10])
def test_one_point_is_in_each_of_the_equal_parts_of_each_coordinate(power):
    points = sobol_points(MOST, power, 3)
    parts = np.sort(np.floor(points * 2**power), axis=1)
    np.testing.assert_array_equal(parts, np.broadcast_to(np.arange(2**power), parts.shape))


def test_there_are_coordinates_for_all_that_may_be_uncertain():
    assert 2 * len(UNCERTAIN) <= MOST


def test_a_band_does_without_the_statistics_of_scipy():
    program = (
        "import sys; from pierimpact import *; truck = load_truck('single-unit-8t');"
        "reaction_band(truck, EquivalentPier(mass=8e3, stiffness=3e8), 20.0, size=4);"
        "print('scipy.stats' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (done.stdout.strip(), done.stderr) == ("False", "")
