"""Cross-sections of the pier: area, second moment of area and shear area."""

import math
from dataclasses import dataclass

from pierimpact.checks import InputError, positive


def _shear_coefficient(value: float) -> float:
    """Return `value` as a shear coefficient κ, above 0 and at most 1."""
    coefficient = positive("shear_coefficient", value)
    if coefficient > 1.0:
        raise InputError(f"shear_coefficient must be at most 1, got {coefficient:g}")
    return coefficient


@dataclass(frozen=True, kw_only=True)
class CircularSection:
    """A solid circle.

    Parameters
    ----------
    diameter : float
        Diameter D [m].
    shear_coefficient : float, optional
        Share κ of the area that carries shear, at most 1 [-]. The default 0.9 makes the strain
        energy of a uniform shear on κA equal to that of the parabolic shear stress of beam theory.

    Raises
    ------
    InputError
        When a value is not positive, or κ exceeds 1.
    """

    diameter: float
    shear_coefficient: float = 0.9

    def __post_init__(self) -> None:
        object.__setattr__(self, "diameter", positive("diameter", self.diameter))
        object.__setattr__(self, "shear_coefficient", _shear_coefficient(self.shear_coefficient))

    @property
    def area(self) -> float:
        """Area A = π D²/4 [m²]."""
        return math.pi * self.diameter**2 / 4.0

    @property
    def second_moment(self) -> float:
        """Second moment of area I = π D⁴/64 [m⁴]."""
        return math.pi * self.diameter**4 / 64.0

    @property
    def shear_area(self) -> float:
        """Shear area κA [m²]."""
        return self.shear_coefficient * self.area


@dataclass(frozen=True, kw_only=True)
class RectangularSection:
    """A solid rectangle struck square on one face.

    Parameters
    ----------
    width : float
        Side b across the direction of travel [m].
    depth : float
        Side h along the direction of travel [m].
    shear_coefficient : float, optional
        Share κ of the area that carries shear, at most 1 [-]. The default 5/6 makes the strain
        energy of a uniform shear on κA equal to that of the parabolic shear stress of beam theory.

    Raises
    ------
    InputError
        When a value is not positive, or κ exceeds 1.
    """

    width: float
    depth: float
    shear_coefficient: float = 5.0 / 6.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "width", positive("width", self.width))
        object.__setattr__(self, "depth", positive("depth", self.depth))
        object.__setattr__(self, "shear_coefficient", _shear_coefficient(self.shear_coefficient))

    @property
    def area(self) -> float:
        """Area A = b h [m²]."""
        return self.width * self.depth

    @property
    def second_moment(self) -> float:
        """Second moment of area I = b h³/12 for bending in the direction of travel [m⁴]."""
        return self.width * self.depth**3 / 12.0

    @property
    def shear_area(self) -> float:
        """Shear area κA [m²]."""
        return self.shear_coefficient * self.area


Section = CircularSection | RectangularSection
