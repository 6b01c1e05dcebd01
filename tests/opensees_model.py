"""The CMSD model in OpenSees: a third opinion, by a program that shares nothing with the package.

OpenSees knows no crush spring, but its hysteretic material is one when unloading keeps the first
slope (beta 0) and reloading returns along it (pinching 1 in strain, 0 in stress).
"""

import math
from typing import Any, NamedTuple

import numpy as np

from pierimpact import CrushSpring, EquivalentPier, Truck

GROUND, ENGINE, BODY, PIER = range(4)
FAR = 10.0  # crush at which the steep rise ends [m]; none comes near
TENSION = -1e-6  # the material wants some strength in tension: this share of the plateau force
RIGID = 1e9  # stiffness of the friction damper before it slides [N/m]


class Peaks(NamedTuple):
    """Engine and cargo peak of the reaction [N]; NaN without cargo contact."""

    engine: float
    cargo: float


def solve(
    ops: Any, truck: Truck, pier: EquivalentPier, speed: float, duration: float, step: float
) -> Peaks:
    """Solve one collision by Newmark's method of constant acceleration."""
    count = math.ceil(duration / step)
    reaction, crush = np.empty(count), np.empty(count)
    build(ops, truck, pier, speed)
    for i in range(count):
        if ops.analyze(1, step):
            raise RuntimeError(f"OpenSees found no equilibrium in step {i}")
        moved = ops.nodeDisp(PIER, 1)
        reaction[i], crush[i] = pier.stiffness * moved, ops.nodeDisp(BODY, 1) - moved
    met = crush >= truck.body_spring.plateau_length
    contact = int(met.argmax()) if met.any() else count
    after = reaction[contact:]
    return Peaks(reaction[:contact].max(), after.max() if len(after) else math.nan)


def build(ops: Any, truck: Truck, pier: EquivalentPier, speed: float) -> None:
    """Set up the collision at first touch."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for node in (GROUND, ENGINE, BODY, PIER):
        ops.node(node, 0.0)
    ops.fix(GROUND, 1)
    for node, mass in ((ENGINE, truck.engine_mass), (BODY, truck.body_mass), (PIER, pier.mass)):
        ops.mass(node, mass)
    ops.uniaxialMaterial("Hysteretic", ENGINE, *crush_material(truck.engine_spring))
    ops.uniaxialMaterial("Hysteretic", BODY, *crush_material(truck.body_spring))
    ops.uniaxialMaterial("Elastic", PIER, pier.stiffness, pier.damping)
    for node, other in ((ENGINE, PIER), (BODY, PIER), (PIER, GROUND)):
        ops.element("zeroLength", node, other, node, "-mat", node, "-dir", 1)
    if truck.friction_force:
        friction = PIER + 1
        ops.uniaxialMaterial("ElasticPP", friction, RIGID, truck.friction_force / RIGID)
        ops.element("zeroLength", friction, GROUND, BODY, "-mat", friction, "-dir", 1)
    for node in (ENGINE, BODY):
        ops.setNodeVel(node, 1, speed, "-commit")
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-10, 20)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def crush_material(spring: CrushSpring) -> list[float]:
    """Return the arguments of OpenSees' hysteretic material: stress and strain of its corners."""
    P, d = spring.plateau_force, spring.plateau_length
    compression = [P, spring.elastic_limit, P, d, P + spring.stiffness * FAR, d + FAR]
    tear = TENSION * P
    tension = [tear, TENSION * spring.elastic_limit, tear, -FAR, tear, -2.0 * FAR]
    pinching, damage, beta = [1.0, 0.0], [0.0, 0.0], [0.0]
    return [*compression, *tension, *pinching, *damage, *beta]
