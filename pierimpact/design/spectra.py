"""Engine and cargo spectra: reaction against pier frequency, by three routes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import one_of, positive, positive_array
from pierimpact.collision.parameters import parameter_chunks
from pierimpact.collision.simulate import peak_reactions
from pierimpact.design.procedure import LEVELS, design_values
from pierimpact.design.reduction import exact_amplification
from pierimpact.pier.equivalent import stiffness_at_frequency
from pierimpact.vehicle.truck import Truck

Array = NDArray[np.float64]

#: Frequencies of a spectrum unless others are asked for, evenly spaced in the logarithm [Hz].
FREQUENCIES = np.geomspace(2.0, 200.0, 200)


@dataclass(frozen=True, kw_only=True)
class Spectrum:
    """A reaction spectrum for one truck, speed, pier mass and damping.

    Each array has the shape of `frequency`; reactions are nan where the body does not meet the
    pier, by that route.

    Parameters
    ----------
    frequency : ndarray
        Pier frequency f_p [Hz].
    full_model : ndarray
        Peak reaction by the full CMSD model [N].
    two_degrees : ndarray
        Peak reaction with the two-degree-of-freedom system's exact amplification in the hand
        formula [N].
    closed_form : ndarray
        Design reaction at the level asked for [N].
    frequency_ratio : ndarray
        β = f_p/f_i [-].
    exact : ndarray
        Amplification S of the two-degree-of-freedom system [-].
    closed : ndarray
        Amplification S of the unified spectrum [-].
    """

    frequency: Array
    full_model: Array
    two_degrees: Array
    closed_form: Array
    frequency_ratio: Array
    exact: Array
    closed: Array


def engine_spectrum(
    truck: Truck,
    speed: float,
    pier_mass: float,
    damping_ratio: float = 0.05,
    frequency: ArrayLike = FREQUENCIES,
    level: str = "refined",
) -> Spectrum:
    """Return the engine's reaction against pier frequency.

    Parameters
    ----------
    truck : Truck
        The truck.
    speed : float
        Speed at first touch [m/s].
    pier_mass : float
        Equivalent mass of the pier; its stiffness follows from the frequency [kg].
    damping_ratio : float, optional
        Damping ratio of the pier [-].
    frequency : array_like, shape (n,), optional
        Pier frequencies [Hz].
    level : {"refined", "hand"}, optional
        Level of the closed form.

    Raises
    ------
    InputError
        When a value is out of range or the level unknown.
    """
    return _spectrum("engine", truck, speed, pier_mass, damping_ratio, frequency, level)


def cargo_spectrum(
    truck: Truck,
    speed: float,
    pier_mass: float,
    damping_ratio: float = 0.05,
    frequency: ArrayLike = FREQUENCIES,
    level: str = "refined",
) -> Spectrum:
    """Return the cargo's reaction against pier frequency; arguments as in `engine_spectrum`."""
    return _spectrum("cargo", truck, speed, pier_mass, damping_ratio, frequency, level)


def _spectrum(
    which: str,
    truck: Truck,
    speed: float,
    pier_mass: float,
    damping_ratio: float,
    frequency: ArrayLike,
    level: str,
) -> Spectrum:
    one_of("level", level, LEVELS)
    frequency = np.atleast_1d(positive_array("frequency", frequency))
    pier_mass = positive("pier_mass", pier_mass)
    stiffness = stiffness_at_frequency(pier_mass, frequency)
    peaks = peak_reactions(truck, pier_mass, stiffness, damping_ratio, speed)
    _, chunks = parameter_chunks(truck, pier_mass, stiffness, damping_ratio, speed)
    found = np.empty((5, len(frequency)))
    for part, parameters in chunks:
        exact = design_values(parameters, "hand", exact_amplification)
        closed = design_values(parameters, "hand")
        found[:, part] = (
            exact[which],
            design_values(parameters, level)[which],
            exact[f"{which}_beta"],
            exact[f"{which}_S"],
            closed[f"{which}_S"],
        )
    two_degrees, closed_form, ratio, exact_S, closed_S = found
    return Spectrum(
        frequency=frequency,
        full_model=getattr(peaks, which),
        two_degrees=two_degrees,
        closed_form=closed_form,
        frequency_ratio=ratio,
        exact=exact_S,
        closed=closed_S,
    )
