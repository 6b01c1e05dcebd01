"""The direct stiffness method for a column, in exact rational arithmetic.

Shares nothing with the package: textbook stiffness matrices of Timoshenko elements between the
heights of interest, assembled and solved with fractions, so that a difference found against it
is the package's own error.
"""

from fractions import Fraction
from itertools import pairwise

RESTRAINED = {"fixed": (True, True), "pinned": (True, False), "free": (False, False)}


def solve(column, heights, impact_height):
    """Deflections and rotations at `heights` and the support forces, for a unit force.

    `heights` increase from the column's bottom to its top and hold `impact_height` and those where
    the section changes. Returns the deflections [m/N], the rotations [rad/N], and the forces and
    moments at (base, top) that the supports exert, positive in the direction of travel and of
    positive rotation dx/dz.
    """
    nodes = [Fraction(height) for height in heights]
    size = 2 * len(nodes)
    stiffness = [[Fraction(0)] * size for _ in range(size)]
    for element, (bottom, top) in enumerate(pairwise(nodes)):
        matrix = element_stiffness(top - bottom, *rigidities(column, bottom))
        for i in range(4):
            for j in range(4):
                stiffness[2 * element + i][2 * element + j] += matrix[i][j]
    load = [Fraction(0)] * size
    load[2 * nodes.index(Fraction(impact_height))] = Fraction(1)
    ends = {0: "base", size - 2: "top"}
    held, springs = set(), {}
    for first, name in ends.items():
        for i, spring in enumerate(("stiffness", "rotation_stiffness")):
            value = getattr(column, f"{name}_{spring}")
            if value is not None:
                springs[first + i] = Fraction(value)
            elif RESTRAINED[getattr(column, name)][i]:
                held.add(first + i)
    moving = [i for i in range(size) if i not in held]
    sprung = [
        [stiffness[i][j] + (springs.get(i, 0) if i == j else 0) for j in moving] for i in moving
    ]
    moved = gauss(sprung, [load[i] for i in moving])
    displacement = [Fraction(0)] * size
    for i, value in zip(moving, moved, strict=True):
        displacement[i] = value
    support = [
        sum(k * u for k, u in zip(stiffness[i], displacement, strict=True)) - load[i]
        for i in (0, size - 2, 1, size - 1)
    ]
    return displacement[0::2], displacement[1::2], support[:2], support[2:]


def rigidities(column, height):
    """EI and κGA of the part that begins at a height."""
    section = column.section
    for step in column.steps:
        section = step.section if Fraction(step.height) <= height else section
    modulus, poisson = Fraction(column.elastic_modulus), Fraction(column.poisson_ratio)
    shear_area = Fraction(section.shear_coefficient * section.area)
    flexural = Fraction(column.stiffness_factor) * modulus * Fraction(section.second_moment)
    return flexural, modulus / (2 * (1 + poisson)) * shear_area


def element_stiffness(length, bending, shearing):
    """Stiffness of a Timoshenko element, for deflection and rotation at its two ends."""
    ratio = 12 * bending / (shearing * length**2)
    factor = bending / (length**3 * (1 + ratio))
    near, far = (4 + ratio) * length**2, (2 - ratio) * length**2
    side = 6 * length
    rows = [
        [12, side, -12, side],
        [side, near, -side, far],
        [-12, -side, 12, -side],
        [side, far, -side, near],
    ]
    return [[factor * entry for entry in row] for row in rows]


def gauss(matrix, right):
    """Solve by elimination; the matrix is positive definite, so no pivot vanishes."""
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    size = len(rows)
    for pivot in range(size):
        for row in range(pivot + 1, size):
            if rows[row][pivot]:
                factor = rows[row][pivot] / rows[pivot][pivot]
                for column in range(pivot, size + 1):
                    if rows[pivot][column]:
                        rows[row][column] -= factor * rows[pivot][column]
    solution = [Fraction(0)] * size
    for row in reversed(range(size)):
        known = sum(rows[row][j] * solution[j] for j in range(row + 1, size))
        solution[row] = (rows[row][size] - known) / rows[row][row]
    return solution
