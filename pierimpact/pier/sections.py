"""Cross-sections of the pier: area, second moment of area and shear area."""

from dataclasses import dataclass
from math import pi
from typing import ClassVar

from pierimpact.checks import InputError, positive
from pierimpact.handcalc import Calculation, Real


@Calculation
def circle(D: Real) -> dict[str, Real]:
    """A solid circle."""
    A = pi * D**2 / 4
    I = pi * D**4 / 64
    return locals()


@Calculation
def rectangle(b: Real, h: Real) -> dict[str, Real]:
    """A solid rectangle, for bending in the direction of its depth h."""
    A = b * h
    I = b * h**3 / 12
    return locals()


@dataclass(frozen=True, kw_only=True)
class _Section:
    """What all sections have in common: dimensions that are positive, κ that is at most 1."""

    #: The section's equations.
    calculation: ClassVar[Calculation]
    #: The symbol of each of its dimensions.
    dimensions: ClassVar[dict[str, str]]
    shear_coefficient: float

    def __post_init__(self) -> None:
        for name in (*self.dimensions, "shear_coefficient"):
            object.__setattr__(self, name, positive(name, getattr(self, name)))
        if self.shear_coefficient > 1.0:
            raise InputError(f"shear_coefficient must be at most 1, got {self.shear_coefficient:g}")

    @property
    def values(self) -> dict[str, float]:
        """Dimensions, shear coefficient, area and second moment of area, by symbol."""
        sizes = {symbol: getattr(self, name) for name, symbol in self.dimensions.items()}
        return self.calculation(**sizes) | {"kappa": self.shear_coefficient}

    @property
    def area(self) -> float:
        """Area A [m²]."""
        return self.values["A"]

    @property
    def second_moment(self) -> float:
        """Second moment of area I for bending in the direction of travel [m⁴]."""
        return self.values["I"]


@dataclass(frozen=True, kw_only=True)
class CircularSection(_Section):
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

    calculation = circle
    dimensions: ClassVar = {"diameter": "D"}
    diameter: float
    shear_coefficient: float = 0.9


@dataclass(frozen=True, kw_only=True)
class RectangularSection(_Section):
    """A solid rectangle struck square on one face.

    Parameters
    ----------
    width : float
        Side b across the direction of travel [m].
    depth : float
        Side h along the direction of travel [m].
    shear_coefficient : float, optional
        As of the circle, with the default 5/6.

    Raises
    ------
    InputError
        When a value is not positive, or κ exceeds 1.
    """

    calculation = rectangle
    dimensions: ClassVar = {"width": "b", "depth": "h"}
    width: float
    depth: float
    shear_coefficient: float = 5.0 / 6.0


Section = CircularSection | RectangularSection
