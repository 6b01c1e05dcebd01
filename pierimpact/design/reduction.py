"""The two-degree-of-freedom reduction: one mass striking the pier through its steep spring.

Engine and cargo reach the pier at different times, so that each may be seen alone: a mass m_i
with the contact speed v_i, the steep spring k_i (unloading on k_ui), and the pier. The source
paper announces this reduction; its formulas are not in the surviving text and are derived here.

From the model to the reduction, step by step:

1. Until it meets the pier, body i is slowed by a constant force, P1 for the engine and P2 + c_s
   for the cargo, over the plateau length d_i. The energy left gives the contact speed
   v_i = √(V² − 2 P1 d_1/m_1) or √(V² − 2 (P2 + c_s) d_2/m_2).
2. From contact on, δ_i = d_i + y and spring i adds k_i y to the plateau force. With the plateau
   forces set aside, m_i y_i'' = −k_i y on the body, m_p x_p'' + c_p x_p' + k_p x_p = k_i y on the
   pier: a mass, a spring, and the pier.
3. At the largest y the spring turns to the slope k_ui, and contact ends at zero force.
4. Divided by v_i √(k_i m_i), the largest force of the spring on a rigid pier, the peak reaction
   depends on four numbers only: β = f_p/f_i, μ = m_i/m_p, e = √(k_i/k_ui) and ζ. That is the
   amplification S (`exact_amplification`).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import InputError, broadcast, positive_array, ratio_array, told_from
from pierimpact.collision.parameters import Parameters, Spring, in_chunks
from pierimpact.collision.propagation import propagate_all
from pierimpact.collision.regimes import FREE, STEEP, Position, State, branch, start
from pierimpact.collision.series import Ops
from pierimpact.pier.equivalent import damping_coefficient

# Numerical: distance of the absent body from the pier, in units of v_i √(m_i/k_i).
OUT_OF_REACH = 1e6


def exact_amplification(
    frequency_ratio: ArrayLike,
    mass_ratio: ArrayLike,
    restitution: ArrayLike,
    damping_ratio: ArrayLike,
) -> NDArray[np.float64]:
    """Amplification S of the two-degree-of-freedom system, propagated exactly.

    Parameters
    ----------
    frequency_ratio : array_like
        β = f_p/f_i, with f_i = √(k_i/m_i)/2π [-].
    mass_ratio : array_like
        μ = m_i/m_p [-].
    restitution : array_like
        e = √(k_i/k_ui), above 0 and at most 1 [-].
    damping_ratio : array_like
        ζ of the pier, from 0 to below 1 [-].

    Returns
    -------
    ndarray, of the shape to which the inputs broadcast
        Peak reaction over v_i √(k_i m_i) [-].

    Raises
    ------
    InputError
        When a value is out of range or the shapes do not broadcast.
    """
    beta = positive_array("frequency_ratio", frequency_ratio)
    mu = positive_array("mass_ratio", mass_ratio)
    e = positive_array("restitution", restitution)
    if np.any(e > 1.0):
        raise InputError(f"restitution must be at most 1, got {told_from(e.max(), 1.0)}")
    zeta = ratio_array("damping_ratio", damping_ratio)
    named = {"frequency_ratio": beta, "mass_ratio": mu, "restitution": e, "damping_ratio": zeta}
    arrays = broadcast(named)
    beta, mu, e, zeta = (array.reshape(-1) for array in arrays)
    # m_i = k_i = v_i = 1, so that the peak reaction is S.
    one = np.ones_like(beta)
    pier_mass, pier_stiffness = 1.0 / mu, beta**2 / mu
    parameters = Parameters(
        engine=Spring(one, 0.0 * one, one, one, 1.0 / e**2),
        body=Spring(one, one, OUT_OF_REACH * one, one, one),
        friction_force=one,
        on_pier=one < 0.0,
        pier_mass=pier_mass,
        pier_stiffness=pier_stiffness,
        pier_damping=damping_coefficient(pier_mass, pier_stiffness, zeta),
        speed=one,
    )
    shape = arrays[0].shape
    peak = propagate_all(in_chunks(parameters), shape, _at_contact).engine_peak
    return np.asarray(pier_stiffness.reshape(shape) * peak)


def _at_contact(parameters: Parameters, ops: Ops) -> State:
    """Return the state in which the mass meets the pier, and the other body rests out of reach."""
    one = parameters.speed
    return start(parameters, ops)._replace(
        position=Position(one, one, -OUT_OF_REACH * one, 0.0 * one, 0.0 * one, 0.0 * one),
        engine=branch(parameters.engine, STEEP * one, one, ops),
        body=branch(parameters.body, FREE * one, one, ops),
        slip=0.0 * one,
        stuck=one > 0.0,
        engine_contact=0.0 * one,
    )
