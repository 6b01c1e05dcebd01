"""Engine and cargo spectra: reaction against pier frequency, by three routes."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import one_row, positive, positive_array
from pierimpact.collision.parameters import parameter_chunks
from pierimpact.collision.simulate import peak_reactions
from pierimpact.design.procedure import amplification, calculation_of, design_values
from pierimpact.design.reduction import exact_amplification
from pierimpact.pier.equivalent import DAMPING_RATIO, stiffness_at_frequency
from pierimpact.vehicle.truck import Truck

Array = NDArray[np.float64]

#: Frequencies of a spectrum unless others are asked for, this project's choice: evenly spaced in
#: the logarithm [Hz].
FREQUENCIES = np.geomspace(2.0, 200.0, 200)


class Spectrum(NamedTuple):
    """A reaction spectrum for one truck, speed, pier mass and damping.

    Each array has the shape of `frequency`. Where the cargo does not meet the pier, by that route,
    its reaction is nan; where the engine does not, its reaction is the plateau peak.

    Examples
    --------
    >>> from pierimpact import engine_spectrum, load_truck
    >>> truck = load_truck("single-unit-8t")
    >>> spectrum = engine_spectrum(truck, 22.2, pier_mass=8e3, frequency=[10.0, 30.0, 100.0])
    >>> spectrum.frequency_ratio.round(2)
    array([0.14, 0.41, 1.36])
    >>> (spectrum.closed_form / spectrum.full_model).round(2)
    array([1.09, 1.09, 1.02])
    """

    frequency: Array  #: f_p of the pier [Hz]
    full_model: Array  #: peak reaction by the full CMSD model [N]
    two_degrees: Array  #: hand formula with the two-degree-of-freedom system's exact S [N]
    closed_form: Array  #: design reaction at the level asked for [N]
    frequency_ratio: Array  #: β = f_p/f_i [-]
    exact: Array  #: amplification S of the two-degree-of-freedom system [-]
    closed: Array  #: amplification S of the unified spectrum [-]


def engine_spectrum(
    truck: Truck,
    speed: float,
    pier_mass: float,
    damping_ratio: float = DAMPING_RATIO,
    frequency: ArrayLike = FREQUENCIES,
    level: str = "short",
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
    level : {"short", "long"}, optional
        Level of the closed form, as in `design_reaction`.

    Raises
    ------
    InputError
        When a value is out of range or the level unknown.

    Examples
    --------
    >>> from pierimpact import engine_spectrum, load_truck
    >>> truck = load_truck("single-unit-8t")
    >>> spectrum = engine_spectrum(truck, 22.2, pier_mass=8e3, frequency=[10.0, 100.0])
    >>> (spectrum.full_model / 1e6).round(2)  # MN
    array([1.87, 7.52])
    """
    return _spectrum(1, truck, speed, pier_mass, damping_ratio, frequency, level)


def cargo_spectrum(
    truck: Truck,
    speed: float,
    pier_mass: float,
    damping_ratio: float = DAMPING_RATIO,
    frequency: ArrayLike = FREQUENCIES,
    level: str = "short",
) -> Spectrum:
    """Return the cargo's reaction against pier frequency; arguments as in `engine_spectrum`.

    Examples
    --------
    >>> from pierimpact import cargo_spectrum, load_truck
    >>> truck = load_truck("single-unit-8t")
    >>> spectrum = cargo_spectrum(truck, 22.2, pier_mass=8e3, frequency=[10.0, 100.0])
    >>> (spectrum.full_model / 1e6).round(2)  # MN
    array([5.12, 4.33])
    """
    return _spectrum(2, truck, speed, pier_mass, damping_ratio, frequency, level)


def _spectrum(
    i: int,
    truck: Truck,
    speed: float,
    pier_mass: float,
    damping_ratio: float,
    frequency: ArrayLike,
    level: str,
) -> Spectrum:
    """Return the spectrum of the engine, i = 1, or of the cargo, i = 2."""
    calculation_of(level)  # an error here, before anything is calculated
    frequency = one_row("frequency", np.atleast_1d(positive_array("frequency", frequency)))
    pier_mass = positive("pier_mass", pier_mass)
    stiffness = stiffness_at_frequency(pier_mass, frequency)
    peaks = peak_reactions(truck, pier_mass, stiffness, damping_ratio, speed)
    _, chunks = parameter_chunks(truck, pier_mass, stiffness, damping_ratio, speed)
    found = np.empty((5, *frequency.shape))
    for part, parameters in chunks:
        exact = design_values(parameters, "short", exact_amplification)
        closed = design_values(parameters, level)
        arguments = [exact[name] for name in (f"beta{i}", f"mu{i}", f"e{i}", "zeta")]
        found[:, part] = (
            exact[f"R{i}"], closed[f"R{i}"], arguments[0], exact[f"S{i}"], amplification(*arguments)
        )  # fmt: skip
    return Spectrum(frequency, peaks.engine if i == 1 else peaks.cargo, *found)
