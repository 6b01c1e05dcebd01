"""The collision with a column in OpenSees: elastic Timoshenko elements, masses at the joints.

OpenSees has no damping of the same ratio in all modes of a part of its model: the column is damped
in proportion to its stiffness, and the beam that it is compared with as well.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from opensees_model import RIGID, crush_material

from pierimpact import PierColumn, Truck

HELD = {"fixed": (1, 1, 1), "pinned": (1, 1, 0), "free": (0, 0, 0)}


class Largest(NamedTuple):
    """Largest displacement at the impact [m]; shear [N] and moment [N m] of largest magnitude
    beside the supports and the impact."""

    displacement: float
    shear: float
    moment: float


def solve(
    ops: Any,
    truck: Truck,
    column: PierColumn,
    impact_height: float,
    speed: float,
    damping: float,
    duration: float,
    elements: int,
    step: float,
) -> Largest:
    """Solve one collision by Newmark's method of constant acceleration.

    The matrix of the column's damping is `damping` times its stiffness [s].
    """
    struck, last = build(ops, truck, column, impact_height, speed, elements)
    ops.region(1, "-ele", *range(1, last + 1), "-rayleigh", 0.0, 0.0, damping, 0.0)
    # Beside each corner, from the middles of two elements to the end of the nearer one.
    pairs = ((1, 2), (struck - 1, struck - 2), (struck, struck + 1), (last, last - 1))
    ends = (2, 5, 2, 5)  # the moment of the lower joint, or of the upper
    moved, shears, moments = [], [], []
    for _ in range(math.ceil(duration / step)):
        if ops.analyze(1, step):
            raise RuntimeError("OpenSees found no equilibrium")
        moved.append(ops.nodeDisp(struck, 1))
        forces = [[ops.eleForce(element) for element in pair] for pair in pairs]
        shears.append([1.5 * near[0] - 0.5 * far[0] for near, far in forces])
        moments.append([near[end] for (near, _), end in zip(forces, ends, strict=True)])
    shear, moment = np.abs(shears).max(), np.abs(moments).max()
    return Largest(max(moved), float(shear), float(moment))


def heights(column: PierColumn, impact_height: float, elements: int) -> tuple[NDArray[Any], int]:
    """Return the heights of the joints, and the number of the one that is struck, from 1."""
    below = max(3, round(elements * impact_height / column.height))
    lower = np.linspace(0.0, impact_height, below + 1)
    upper = np.linspace(impact_height, column.height, elements - below + 1)
    return np.concatenate((lower, upper[1:])), below + 1


def build(
    ops: Any, truck: Truck, column: PierColumn, impact_height: float, speed: float, elements: int
) -> tuple[int, int]:
    """Set up the collision at first touch; return the joint that is struck and the top element."""
    z, struck = heights(column, impact_height, elements)
    area, second = column.section.area, column.section.second_moment
    modulus = column.elastic_modulus
    shear_modulus = 0.5 * modulus / (1.0 + column.poisson_ratio)
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    lengths = np.diff(z)
    shares = 0.5 * (np.append(lengths, 0.0) + np.append(0.0, lengths))
    for node, (height, share) in enumerate(zip(z.tolist(), shares.tolist(), strict=True), start=1):
        ops.node(node, 0.0, height)
        mass, inertia = column.density * area * share, column.density * second * share
        ops.mass(node, mass, mass, inertia)
    last = len(lengths)
    for element in range(1, last + 1):
        rigidities = (modulus, shear_modulus, area, second, column.shear_rigidity / shear_modulus)
        ops.element("ElasticTimoshenkoBeam", element, element, element + 1, *rigidities, 1)
    ops.fix(1, *HELD[column.base])
    ops.fix(last + 1, *HELD[column.top])
    # The truck's bodies move across the column only.
    ground, engine, body = range(last + 2, last + 5)
    for node in (ground, engine, body):
        ops.node(node, 0.0, impact_height)
        ops.fix(node, int(node == ground), 1, 1)
    for node, mass, spring in (
        (engine, truck.engine_mass, truck.engine_spring),
        (body, truck.body_mass, truck.body_spring),
    ):
        ops.mass(node, mass, 0.0, 0.0)
        ops.uniaxialMaterial("Hysteretic", node, *crush_material(spring))
        ops.element("zeroLength", node, struck, node, "-mat", node, "-dir", 1)
        ops.setNodeVel(node, 1, speed, "-commit")
    if truck.friction_force:
        ops.uniaxialMaterial("ElasticPP", ground, RIGID, truck.friction_force / RIGID)
        ops.element("zeroLength", ground, ground, body, "-mat", ground, "-dir", 1)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-10, 20)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    return struck, last
