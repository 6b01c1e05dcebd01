"""Scrambled Sobol points, the same to the last bit as SciPy's.

`scipy.stats` takes most of a second to import, more than all else that a case needs.
"""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]

#: Bits of a coordinate.
BITS = 30

# For each coordinate but the first, a primitive polynomial, its coefficients as the bits of a
# number, and as many initial direction numbers as its degree: S. Joe and F. Y. Kuo, "Constructing
# Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30 (2008), as in
# SciPy. Two samples of each parameter of a truck and of the speed need no more.
_DIRECTIONS = (
    (3, (1,)), (7, (1, 3)), (11, (1, 3, 1)), (13, (1, 1, 1)), (19, (1, 1, 3, 3)),
    (25, (1, 3, 5, 13)), (37, (1, 1, 5, 5, 17)), (41, (1, 1, 5, 5, 5)), (47, (1, 1, 7, 11, 19)),
    (55, (1, 1, 5, 1, 1)), (59, (1, 1, 1, 3, 11)), (61, (1, 3, 5, 5, 31)),
    (67, (1, 3, 3, 9, 7, 49)), (91, (1, 1, 1, 15, 21, 21)), (97, (1, 3, 1, 13, 27, 49)),
    (103, (1, 1, 1, 15, 7, 5)), (109, (1, 3, 1, 15, 13, 25)), (115, (1, 1, 5, 5, 19, 61)),
    (131, (1, 3, 7, 11, 23, 15, 103)), (137, (1, 3, 7, 13, 13, 15, 69)),
    (143, (1, 1, 3, 13, 7, 35, 63)), (145, (1, 3, 5, 9, 1, 25, 53)),
    (157, (1, 3, 1, 13, 9, 35, 107)),
)  # fmt: skip
#: The most coordinates that a point may have.
MOST = len(_DIRECTIONS) + 1


def sobol_points(count: int, power: int, seed: int) -> Array:
    """Return the first 2**power points of a Sobol sequence, scrambled at random.

    The scrambling is that of J. Matoušek, J. Complexity 14 (1998): a random lower triangular
    matrix on the bits of each coordinate, and a random shift of them.

    Parameters
    ----------
    count : int
        Coordinates of a point, at most MOST.
    power : int
        Power of two of the number of points, at most BITS.
    seed : int
        Seed of the random numbers.

    Returns
    -------
    ndarray, shape (count, 2**power)
        Coordinates, from 0 to below 1 [-].
    """
    (random,) = np.random.default_rng(seed).spawn(1)  # as SciPy does
    shift = random.integers(2, size=(count, BITS), dtype=np.uint32) @ _weights()
    lower = np.tril(random.integers(2, size=(count, BITS, BITS), dtype=np.uint32), -1)
    scramble = lower + np.eye(BITS, dtype=np.uint32)
    plain = np.array([_directions(coordinate, power) for coordinate in range(count)], dtype=int)
    bits = plain[:, None, :] >> np.arange(BITS)[::-1, None] & 1
    directions = _weights()[::-1] @ (scramble @ bits % 2)
    number = np.arange(2**power)
    gray = number ^ number >> 1
    points = np.repeat(shift[:, None], 2**power, axis=1)
    for bit in range(power):
        points ^= np.where(gray >> bit & 1, directions[:, bit : bit + 1], 0)
    return points * 0.5**BITS


def _weights() -> NDArray[np.int64]:
    """Return what the bits of a coordinate count, the last first."""
    return 1 << np.arange(BITS)


def _directions(coordinate: int, count: int) -> list[int]:
    """Return the first direction numbers of a coordinate, by the recurrence of its polynomial."""
    if coordinate == 0:
        return [1 << BITS - 1 - place for place in range(count)]
    polynomial, initial = _DIRECTIONS[coordinate - 1]
    degree, numbers = len(initial), list(initial)
    while len(numbers) < count:
        new = numbers[-degree]
        for back in range(1, degree + 1):
            if polynomial >> degree - back & 1:
                new ^= numbers[-back] << back
        numbers.append(new)
    return [numbers[place] << BITS - 1 - place for place in range(count)]
