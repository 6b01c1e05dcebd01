"""The model beside responses of others: of crash tests, or of finite-element calculations."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.certainty import Certainty
from pierimpact.checks import InputError, known, positive, whole
from pierimpact.collision.contact_forces import contact_forces
from pierimpact.collision.parameters import Collision
from pierimpact.design.band import LEVELS, reaction_band
from pierimpact.pier.equivalent import EquivalentPier

Array: TypeAlias = NDArray[np.float64]

#: A pier so stiff and quick that the contact force is as on a rigid one; this project's choice.
RIGID = EquivalentPier.from_frequency(mass=10e3, frequency=200.0)
#: Responses, and what they are in words; any average over some milliseconds is one too.
RESPONSES = {
    "peak_reaction": "largest reaction",
    "engine_peak": "engine reaction",
    "cargo_peak": "cargo reaction",
    "peak_contact_force": "largest contact force",
    "average_10_ms": "10 ms average of the contact force",
    "average_25_ms": "25 ms average of the contact force",
    "average_50_ms": "50 ms average of the contact force",
}
_BANDS = {"peak_reaction": "governing", "engine_peak": "engine", "cargo_peak": "cargo"}
_AVERAGE = re.compile(r"average_([1-9]\d*)_ms")


@dataclass(frozen=True, kw_only=True)
class Measured:
    """A collision that was measured, or calculated by others, with its responses.

    Parameters
    ----------
    name : str
        What the case is called.
    collision : Collision
        The truck, the pier and the speed that stand for it in the model.
    responses : mapping of str to float
        By name, one of RESPONSES or as "average_30_ms" [N].
    source : str
        Where they come from.
    status : Certainty
        How certain they are.
    remark : str, optional
        What else to know of them.

    Raises
    ------
    InputError
        When a response is unknown or not positive, or there is none.
    """

    name: str
    collision: Collision
    responses: Mapping[str, float]
    source: str
    status: Certainty
    remark: str = ""

    def __post_init__(self) -> None:
        if not self.responses:
            raise InputError("responses must have at least one, got none")
        for name, value in self.responses.items():
            check_response(name)
            positive(name, value)


class Compared(NamedTuple):
    """A response beside that of the model."""

    measured: Measured
    response: str  #: its name
    nominal: float  #: of the model, parameters at their values; nan where it has none [N]
    band: Array  #: of the model, what LEVELS of all trucks stay below, shape (3,) [N]

    @property
    def value(self) -> float:
        """The response as measured [N]."""
        return self.measured.responses[self.response]

    @property
    def ratio(self) -> float:
        """Model over measured, parameters at their values [-]."""
        return self.nominal / self.value

    @property
    def ratios(self) -> Array:
        """Band of the model over measured, shape (3,) [-]."""
        return self.band / self.value


def check_response(name: str) -> None:
    """Refuse a name that is of no response."""
    if _AVERAGE.fullmatch(name) is None:
        known(name, RESPONSES, "a response")


def response_words(name: str) -> str:
    """Return what a response is, in words."""
    average = _AVERAGE.fullmatch(name)
    return f"{average[1]} ms average of the contact force" if average else RESPONSES[name]


def compare(
    measured: Measured, size: int = 512, histories: int = 64, seed: int = 0
) -> list[Compared]:
    """Return each response of a case beside that of the model, with its band.

    The trucks are those of `reaction_band`. The cargo's band is of the trucks whose cargo meets
    the pier. Contact forces are the largest of the whole collision.

    Parameters
    ----------
    measured : Measured
        The case.
    size : int, optional
        Number of collisions behind the band of a reaction.
    histories : int, optional
        Number of collisions behind the band of a contact force; at most `size`.
    seed : int, optional
        Seed of the random numbers.
    """
    own, names = measured.collision, list(measured.responses)
    count = min(whole("histories", histories, 1), size)
    # The first collisions of a larger sample are those of a smaller one.
    size = size if set(names) & set(_BANDS) else count
    band = reaction_band(own.truck, own.pier, own.speed, size=size, seed=seed)
    collisions = [own]
    if set(names) - set(_BANDS):
        collisions += [band.sampled(index) for index in range(count)]
    windows = {name: 1e-3 * int(of[1]) for name in names if (of := _AVERAGE.fullmatch(name))}
    peaks, forces = contact_forces(collisions, list(windows.values()))
    found = {
        "peak_reaction": peaks.governing,
        "engine_peak": peaks.engine,
        "cargo_peak": peaks.cargo,
        "peak_contact_force": forces.largest,
    } | dict(zip(windows, forces.averages, strict=True))
    compared = []
    for name in names:
        nominal, *sampled = found[name].tolist()
        quantiles = (
            band.quantiles(of=_BANDS[name]) if name in _BANDS else np.quantile(sampled, LEVELS)
        )
        compared.append(Compared(measured, name, nominal, quantiles))
    return compared


def average_bands(
    collision: Collision, windows: Sequence[float], count: int = 32, seed: int = 0
) -> tuple[Array, Array]:
    """Return the largest averages of the contact force, and the band of them.

    Parameters
    ----------
    collision : Collision
        The collision, parameters at their values.
    windows : sequence of float, length n
        Lengths of the moving window [s].
    count, seed : int, optional
        Number of collisions behind the band, and seed of the random numbers.

    Returns
    -------
    nominal : ndarray, shape (n,)
        With parameters at their values [N].
    band : ndarray, shape (3, n)
        What LEVELS of all trucks stay below [N].
    """
    nominal = contact_forces([collision], windows)[1].averages[:, 0]
    band = reaction_band(collision.truck, collision.pier, collision.speed, size=count, seed=seed)
    sampled = band.average_forces(windows, count)
    return nominal, np.quantile(sampled, LEVELS, axis=1)
