"""The crush law of a spring between a truck's mass and the pier."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import InputError, positive, told_from


@dataclass(frozen=True, kw_only=True)
class CrushSpring:
    """A plateau (sheet metal crumples), then a steep rise (a hard body meets the pier).

    Virgin loading follows the envelope E(δ); unloading and reloading run on a line of slope k_u
    through the point of largest crush, never in tension. The plateau and the steep rise are the
    source paper's description; the law that joins them is derived here.

    Parameters
    ----------
    plateau_force : float
        Force P while the soft part crumples [N].
    plateau_length : float
        Crush d at which the hard body meets the pier, at least P/k_u [m].
    stiffness : float
        Slope k of the steep rise [N/m].
    unloading_stiffness : float
        Slope k_u of unloading and reloading, at least k [N/m].

    Raises
    ------
    InputError
        When a value is not positive, k_u < k, or d < P/k_u.

    Examples
    --------
    >>> from pierimpact import CrushSpring
    >>> spring = CrushSpring(
    ...     plateau_force=150e3, plateau_length=0.5, stiffness=150e6, unloading_stiffness=900e6
    ... )
    >>> round(float(spring.envelope(0.51)) / 1e6, 2)  # MN
    1.65
    """

    plateau_force: float
    plateau_length: float
    stiffness: float
    unloading_stiffness: float

    def __post_init__(self) -> None:
        for name in self.__dataclass_fields__:
            object.__setattr__(self, name, positive(name, getattr(self, name)))
        if self.unloading_stiffness < self.stiffness:
            raise InputError(
                f"unloading_stiffness must be at least stiffness ({self.stiffness:g} N/m), "
                f"got {told_from(self.unloading_stiffness, self.stiffness)} N/m"
            )
        if self.plateau_length < self.elastic_limit:
            raise InputError(
                f"plateau_length must be at least plateau_force/unloading_stiffness "
                f"({self.elastic_limit:g} m), "
                f"got {told_from(self.plateau_length, self.elastic_limit)} m"
            )

    @property
    def elastic_limit(self) -> float:
        """Crush P/k_u at which the plateau begins [m]."""
        return self.plateau_force / self.unloading_stiffness

    @property
    def restitution(self) -> float:
        """Restitution e = √(k/k_u) of the steep part [-]. Derived here."""
        return math.sqrt(self.stiffness / self.unloading_stiffness)

    def envelope(self, crush: ArrayLike) -> NDArray[np.float64]:
        """Return the virgin loading force of crushes δ ≥ 0 [m], of the same shape [N].

        E(δ) = min(k_u δ, P) up to d, P + k (δ − d) beyond.
        """
        crush = np.asarray(crush, dtype=float)
        rise = self.stiffness * np.maximum(crush - self.plateau_length, 0.0)
        plateau = np.minimum(self.unloading_stiffness * crush, self.plateau_force)
        return np.asarray(plateau + rise)

    def dissipated(self, largest_crush: ArrayLike) -> NDArray[np.float64]:
        """Return the energy dissipated up to the largest crushes so far [m], of their shape [J].

        The area under the envelope less the triangle that is recovered on unloading.
        """
        crush = np.asarray(largest_crush, dtype=float)
        force = self.envelope(crush)
        beyond = np.maximum(crush - self.plateau_length, 0.0)
        elastic = np.minimum(crush, self.elastic_limit)
        area = (
            0.5 * self.unloading_stiffness * elastic**2
            + self.plateau_force * (crush - elastic)
            + 0.5 * self.stiffness * beyond**2
        )
        return np.asarray(area - 0.5 * force**2 / self.unloading_stiffness)
