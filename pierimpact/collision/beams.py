"""The largest member forces of many collisions with one beam, by small equal steps.

`beam` follows one collision exactly, which takes it a tenth of a second. A band asks for hundreds,
to some per cent of their differences: here they advance side by side, all by the same step. The
contact forces at its start hold for the step, by which the bodies move on (leapfrog); the shapes
vibrate exactly, and stand exactly under a force that stays. The crush law needs no events: the
force of a spring is that of its envelope at the largest crush so far, less what it has unloaded.
Derived here.
"""

import math
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.parameters import Parameters
from pierimpact.pier.beam import BeamPier

Array: TypeAlias = NDArray[np.float64]

# Numerical settings.
HIGHEST_FREQUENCY = 1000.0  # up to which modes are kept, the others being one shape [Hz]
TURN = 0.5  # of a body on its spring in one step [rad]
RESIDUAL_TURN = 1.5  # of the last shape in one step [rad]
SHORTEST = 1e-5  # step [s]; springs that would ask for a shorter one are made softer
STEPS = 64  # between two looks at what they have come to
APART = 8  # heights between those looked at, besides the ends of parts
AT_REST = 1e-9  # share of the speed


class LargestMemberForces(NamedTuple):
    """Largest magnitudes anywhere on a beam, arrays of shape (n,) for n collisions."""

    shear: Array  #: [N]
    moment: Array  #: [N m]


def largest_member_forces(
    parameters: Parameters, beam: BeamPier, duration: float
) -> LargestMemberForces:
    """Return the largest shear and moment of a beam in each of many collisions.

    They are those of `simulate` to some tenths of a per cent, and to 3 % where its highest shapes
    matter; a shear by a blow of less than a millisecond, which modes beyond 1 kHz make, is smaller.

    Parameters
    ----------
    parameters : Parameters
        Trucks and speeds, arrays of shape (n,); the pier in it is not used.
    beam : BeamPier
        The pier that all of them strike.
    duration : float
        Time to follow them at most [s]. They are followed until all trucks have left and the beam
        has vibrated for a period of its first mode.
    """
    beam = beam.up_to(HIGHEST_FREQUENCY)
    omega, phi = beam.circular_frequencies, beam.impact_deflection
    heights = _looked_at(beam.z)
    fields = np.stack((beam.shear, beam.moment))[:, :, heights].transpose(0, 2, 1)

    mass, P, d, k, ku = map(np.stack, zip(parameters.engine, parameters.body, strict=True))
    square = ku * (1.0 / mass + 1.0 / beam.effective_mass)  # of a body's circular frequency
    step = max(min(TURN / math.sqrt(square.max()), RESIDUAL_TURN / omega[-1]), SHORTEST)
    softer = np.minimum(1.0, (TURN / step) ** 2 / square)
    k, ku = softer * k, softer * ku
    d = np.maximum(d, P / ku)

    # A shape's displacement follows from the two before it, and the force.
    zeta = beam.equivalent.damping_ratio
    decay = np.exp(-zeta * omega * step)
    last = 2.0 * decay * np.cos(math.sqrt(1.0 - zeta**2) * omega * step)
    before = -(decay**2)
    pushed = (1.0 - last - before) * phi / omega**2
    last, before, pushed = last[:, None], before[:, None], pushed[:, None]

    speed, on_pier, friction_force = (
        parameters.speed, parameters.on_pier, parameters.friction_force
    )  # fmt: skip
    per_mass, at_rest = step / mass, AT_REST * speed
    velocity, displacement = np.stack((speed, speed)), np.zeros((2, len(speed)))
    largest_crush, (q, q_before) = P / ku, np.zeros((2, len(omega), len(speed)))
    xp = vp = np.zeros(len(speed))
    motion = np.empty((STEPS, *q.shape))
    found = np.zeros((2, len(speed)))
    time = left = 0.0
    while time < duration and time <= left + 2.0 * math.pi / omega[0]:
        for number in range(STEPS):
            crush = displacement - xp
            largest_crush = np.maximum(largest_crush, crush)
            envelope = P + k * np.maximum(largest_crush - d, 0.0)
            force = np.maximum(envelope - ku * (largest_crush - crush), 0.0)
            velocity -= per_mass * force
            # Friction stops the body if it can, and slides at its limit otherwise.
            limit = friction_force * ((force[1] > 0.0) | ~on_pier)
            stopping = (velocity[1] - on_pier * vp) / per_mass[1]
            friction = np.maximum(np.minimum(stopping, limit), -limit)
            velocity[1] -= per_mass[1] * friction
            displacement += step * velocity
            on_beam = force[0] + force[1] + on_pier * friction
            q, q_before = last * q + before * q_before + pushed * on_beam, q
            motion[number] = q
            xp_before, xp = xp, phi @ q
            vp = (xp - xp_before) / step
        time += STEPS * step
        if ((force > 0.0) | (velocity > at_rest)).any():
            left = time
        there = [field @ motion for field in fields]
        largest = [np.maximum(values.max((0, 1)), -values.min((0, 1))) for values in there]
        found = np.maximum(found, largest)
    return LargestMemberForces(*found)


def _looked_at(z: Array) -> NDArray[np.intp]:
    """Return the numbers of the heights at which forces are looked at."""
    joints = np.flatnonzero(np.diff(z) == 0.0)
    last = len(z) - 1
    return np.unique(np.concatenate((np.arange(0, last, APART), joints, joints + 1, [last])))
