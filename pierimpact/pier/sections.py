"""Cross-sections of the pier: area, second moment of area and shear area.

All shear coefficients follow one rule: the strain energy of a uniform shear on κA equals that of
the shear stress of beam theory, V S/(I b), with S the first moment of the area beyond a cut of
width b. Solid sections are cut across the travel; the walls of hollow ones through their
thickness, because the stress runs along them. (Cut across the travel, a thin tube would have
κ = 2/3, and not 1/2; a hole below 0.12 of the diameter does not lower the 0.9 of a circle.)
"""

import math
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import ClassVar

import numpy as np
from numpy import maximum, minimum, tan, where
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from pierimpact.checks import InputError, positive, told_from
from pierimpact.handcalc import Calculation, Real

_NODES, _WEIGHTS = leggauss(32)


@Calculation
def circle(D: Real) -> dict[str, Real]:
    """A solid circle."""
    A = pi * D**2 / 4
    I = pi * D**4 / 64
    kappa = 9 / 10  # energy of the shear stress, derived here
    return locals()


@Calculation
def rectangle(b: Real, h: Real) -> dict[str, Real]:
    """A solid rectangle, for bending in the direction of its depth h."""
    A = b * h
    I = b * h**3 / 12
    kappa = 5 / 6  # energy of the shear stress, derived here
    return locals()


def _ring(D: Real, t: Real) -> tuple[Real, ...]:
    Di = D - 2 * t
    A = pi * t * (D - t)
    I = A * (D**2 + Di**2) / 16
    kappa = where(
        Di > 0.12 * D,
        9 / 8 * ((D**2 + Di**2) / (D**2 + D * Di + Di**2)) ** 2,
        9 / 10,  # energy of the shear stress, derived here
    )
    return Di, A, I, kappa


def _box(b: Real, h: Real, t: Real) -> tuple[Real, ...]:
    bi = b - 2 * t
    hi = h - 2 * t
    A = 2 * t * (b + hi)
    I = t * hi**3 / 6 + b * t * (h - t) ** 2 / 2 + b * t**3 / 6
    Sf = b * t * (h - t) / 2
    Uw = Sf**2 * hi / (2 * t) + Sf * hi**3 / 6 + t * hi**5 / 60
    Uf = b * t**3 / 2 * (h**2 / 3 - h * t / 2 + t**2 / 5)
    Uh = t * (h - t) ** 2 * bi**3 / 24
    kappa = I**2 / (A * (Uw + Uf + Uh))  # energy of the shear stress, derived here
    return bi, hi, A, I, Sf, Uw, Uf, Uh, kappa


@Calculation
def hollow_circle(D: Real, t: Real) -> dict[str, Real]:
    """A circle with a concentric round hole."""
    Di, A, I, kappa = _ring(D, t)
    return locals()


@Calculation
def hollow_rectangle(b: Real, h: Real, t: Real) -> dict[str, Real]:
    """A rectangle with walls of one thickness, for bending in the direction of its depth h."""
    bi, hi, A, I, Sf, Uw, Uf, Uh, kappa = _box(b, h, t)
    return locals()


@Calculation
def oblong(b: Real, h: Real, U: Real) -> dict[str, Real]:
    """A rectangle with semicircles on its short sides, for bending in the direction of h.

    U is used where the semicircles are on the left and on the right.
    """
    r = minimum(b, h) / 2
    c = maximum(b, h) - 2 * r
    A = 2 * r * c + pi * r**2
    I = where(
        h >= b,
        r * c**3 / 6 + pi * r**4 / 4 + 4 * c * r**3 / 3 + pi * c**2 * r**2 / 4,
        2 * c * r**3 / 3 + pi * r**4 / 4,
    )
    Sf = 2 * r**3 / 3 + pi * c * r**2 / 4
    Uf = 5 * pi * r**6 / 72 + 52 * c * r**5 / 135 + (pi**3 / 96 - 3 * pi / 64) * c**2 * r**4
    Uw = Sf**2 * c / (2 * r) + Sf * c**3 / 6 + r * c**5 / 60
    kappa = I**2 / (A * where(h >= b, Uf + Uw, U))  # energy of the shear stress, derived here
    return locals()


@Calculation
def regular_polygon(ns: Real, Df: Real, U: Real) -> dict[str, Real]:
    """A regular polygon."""
    ls = Df * tan(pi / ns)
    A = ns * ls * Df / 4
    I = A * (3 * Df**2 + ls**2) / 48
    kappa = I**2 / (A * U)  # energy of the shear stress, derived here
    return locals()


@Calculation
def free_section(A: Real, I: Real, Av: Real) -> dict[str, Real]:
    """A section of any shape."""
    kappa = Av / A
    return locals()


@Calculation
def filled_circle(D: Real, t: Real, alpha_E: Real, alpha_rho: Real) -> dict[str, Real]:
    """A round steel tube filled with concrete, as concrete."""
    Di, As, Is, kappa_s = _ring(D, t)
    Ac = pi * Di**2 / 4
    Ic = pi * Di**4 / 64
    A = Ac + alpha_E * As  # as concrete
    I = Ic + alpha_E * Is  # as concrete
    kappa = (
        9 / 10 * Ac + alpha_E * kappa_s * As
    ) / A  # core and tube side by side, with the same ν
    Am = Ac + alpha_rho * As
    return locals()


@Calculation
def filled_rectangle(b: Real, h: Real, t: Real, alpha_E: Real, alpha_rho: Real) -> dict[str, Real]:
    """A rectangular steel tube filled with concrete, as concrete."""
    bi, hi, As, Is, Sf, Uw, Uf, Uh, kappa_s = _box(b, h, t)
    Ac = bi * hi
    Ic = bi * hi**3 / 12
    A = Ac + alpha_E * As  # as concrete
    I = Ic + alpha_E * Is  # as concrete
    kappa = (5 / 6 * Ac + alpha_E * kappa_s * As) / A  # core and tube side by side, with the same ν
    Am = Ac + alpha_rho * As
    return locals()


class _Own(float):
    """The shear coefficient of a shape; a copy of the section in another size finds its own."""


@dataclass(frozen=True, kw_only=True)
class Section:
    """A cross-section: dimensions that are positive, and its equations."""

    #: The section's equations.
    calculation: ClassVar[Calculation]
    #: The symbol of each of its dimensions.
    dimensions: ClassVar[dict[str, str]]

    def __post_init__(self) -> None:
        for name in self.dimensions:
            object.__setattr__(self, name, positive(name, getattr(self, name)))
        self._check()

    def _check(self) -> None:
        """Refuse dimensions that do not go together."""

    @cached_property
    def _calculated(self) -> dict[str, float]:
        given = {symbol: getattr(self, name) for name, symbol in self.dimensions.items()}
        if "U" in self.calculation.given:
            given["U"] = self._shear_integral()
        return {name: float(value) for name, value in self.calculation(**given).items()}

    def _shear_integral(self) -> float:
        """Return ∫ S²/b dy, with S the first moment of the area beyond a cut of width b [m⁶]."""
        raise NotImplementedError

    @property
    def values(self) -> dict[str, float]:
        """Dimensions, area, second moment of area and shear coefficient, by symbol."""
        return self._calculated

    @property
    def extent(self) -> float:
        """Extent along the travel [m]."""
        raise NotImplementedError

    @property
    def mass_second_moment(self) -> float:
        """Second moment of area with which it gives the rotary inertia per length [m⁴]."""
        return self.values["I"]


@dataclass(frozen=True, kw_only=True)
class _Shape(Section):
    """A section of a certain shape, whose properties follow from its dimensions."""

    shear_coefficient: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        kappa = self.shear_coefficient
        if kappa is None or isinstance(kappa, _Own):
            kappa = _Own(self._calculated["kappa"])
        elif (kappa := positive("shear_coefficient", kappa)) > 1.0:
            raise InputError(f"shear_coefficient must be at most 1, got {told_from(kappa, 1.0)}")
        object.__setattr__(self, "shear_coefficient", kappa)

    @property
    def values(self) -> dict[str, float]:
        """Dimensions, area, second moment of area and shear coefficient, by symbol."""
        return self._calculated | {"kappa": float(self.shear_coefficient or 0.0)}

    @property
    def area(self) -> float:
        """Area A, of a filled tube as concrete [m²]."""
        return self.values["A"]

    @property
    def second_moment(self) -> float:
        """Second moment of area I for bending in the direction of travel, likewise [m⁴]."""
        return self.values["I"]

    @property
    def shear_area(self) -> float:
        """Shear area κA [m²]."""
        return self.values["kappa"] * self.values["A"]


@dataclass(frozen=True, kw_only=True)
class _Round(_Shape):
    dimensions: ClassVar = {"diameter": "D"}
    diameter: float

    @property
    def extent(self) -> float:
        """Diameter [m]."""
        return self.diameter


@dataclass(frozen=True, kw_only=True)
class _Wide(_Shape):
    dimensions: ClassVar = {"width": "b", "depth": "h"}
    width: float
    depth: float

    @property
    def extent(self) -> float:
        """Depth [m]."""
        return self.depth


def _leave_a_hole(thickness: float, **sizes: float) -> None:
    name, size = min(sizes.items(), key=lambda item: item[1])
    if thickness >= 0.5 * size:
        raise InputError(
            f"wall_thickness must be below half the {name} of {size:g} m, "
            f"got {told_from(thickness, 0.5 * size)} m"
        )


@dataclass(frozen=True, kw_only=True)
class CircularSection(_Round):
    """A solid circle.

    Parameters
    ----------
    diameter : float
        Diameter D [m].
    shear_coefficient : float, optional
        As of every section: share κ of the area that carries shear, at most 1 [-]. The default
        0.9 makes the strain energy of a uniform shear on κA equal to that of the parabolic shear
        stress of beam theory.

    Raises
    ------
    InputError
        When a value is not positive, or κ exceeds 1.

    Examples
    --------
    >>> from pierimpact import CircularSection
    >>> round(CircularSection(diameter=1.0).area, 4)
    0.7854
    """

    calculation = circle


@dataclass(frozen=True, kw_only=True)
class RectangularSection(_Wide):
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

    Examples
    --------
    >>> from pierimpact import RectangularSection
    >>> section = RectangularSection(width=0.8, depth=1.2)
    >>> round(section.second_moment, 4)
    0.1152
    """

    calculation = rectangle


@dataclass(frozen=True, kw_only=True)
class HollowCircularSection(_Round):
    """A circle with a concentric round hole; also a steel tube, in a column of steel.

    Parameters
    ----------
    diameter : float
        Outer diameter D [m].
    wall_thickness : float
        Thickness t of the wall, below half the diameter [m].
    shear_coefficient : float, optional
        As of the circle; by default from 1/2 of a thin tube to 0.9 of a circle.

    Raises
    ------
    InputError
        When a value is not positive, the wall leaves no hole, or κ exceeds 1.

    Examples
    --------
    >>> from pierimpact import HollowCircularSection
    >>> section = HollowCircularSection(diameter=2.0, wall_thickness=0.3)
    >>> round(section.area, 4)
    1.6022
    """

    calculation = hollow_circle
    dimensions: ClassVar = {"diameter": "D", "wall_thickness": "t"}
    wall_thickness: float

    def _check(self) -> None:
        _leave_a_hole(self.wall_thickness, diameter=self.diameter)


@dataclass(frozen=True, kw_only=True)
class HollowRectangularSection(_Wide):
    """A rectangle with walls of one thickness; other boxes are a `FreeSection`.

    Parameters
    ----------
    width, depth : float
        Outer sides b across and h along the direction of travel [m].
    wall_thickness : float
        Thickness t of all walls, below half of either side [m].
    shear_coefficient : float, optional
        As of the circle; by default of the shear stress in webs and flanges, in these along the
        flange too.

    Raises
    ------
    InputError
        When a value is not positive, the walls leave no hole, or κ exceeds 1.

    Examples
    --------
    >>> from pierimpact import HollowRectangularSection
    >>> section = HollowRectangularSection(width=2.0, depth=3.0, wall_thickness=0.3)
    >>> round(section.area, 4)
    2.64
    """

    calculation = hollow_rectangle
    dimensions: ClassVar = {"width": "b", "depth": "h", "wall_thickness": "t"}
    wall_thickness: float

    def _check(self) -> None:
        _leave_a_hole(self.wall_thickness, width=self.width, depth=self.depth)


@dataclass(frozen=True, kw_only=True)
class OblongSection(_Wide):
    """A rectangle whose two short sides are semicircles.

    Parameters
    ----------
    width, depth : float
        Full width b across and depth h along the direction of travel, either the longer [m].
    shear_coefficient : float, optional
        As of the circle; by default between 5/6 of a rectangle and 0.9 of a circle.

    Raises
    ------
    InputError
        When a value is not positive, or κ exceeds 1.

    Examples
    --------
    >>> from pierimpact import OblongSection
    >>> round(OblongSection(width=1.0, depth=3.0).area, 4)
    2.7854
    """

    calculation = oblong

    def _shear_integral(self) -> float:
        # With the half width of a semicircle r cos θ at the distance r sin θ from the axis.
        straight, radius = max(self.width - self.depth, 0.0), 0.5 * self.depth
        theta, weight = 0.25 * np.pi * (_NODES + 1.0), 0.25 * np.pi * _WEIGHTS
        half = radius * np.cos(theta)
        first_moment = half**2 * (straight / 2.0 + 2.0 * half / 3.0)
        energy = first_moment**2 / (straight + 2.0 * half)
        return float(2.0 * np.sum(weight * half * energy))


@dataclass(frozen=True, kw_only=True)
class RegularPolygonSection(_Shape):
    """A regular polygon struck square on one face.

    Parameters
    ----------
    sides : int
        Number of sides, from 3 to 100.
    across_flats : float
        Twice the distance of a side from the centre; with an even number of sides, from side to
        side [m].
    shear_coefficient : float, optional
        As of the circle; by default from 5/6 of triangle and square to 0.9 of a circle.

    Raises
    ------
    InputError
        When a value is not positive, the sides are not a whole number, or κ exceeds 1.

    Examples
    --------
    >>> from pierimpact import RegularPolygonSection
    >>> round(RegularPolygonSection(sides=8, across_flats=1.2).area, 4)
    1.1929
    """

    calculation = regular_polygon
    dimensions: ClassVar = {"sides": "ns", "across_flats": "Df"}
    sides: int
    across_flats: float

    def _check(self) -> None:
        if self.sides != int(self.sides) or not 3 <= self.sides <= 100:
            raise InputError(f"sides must be a whole number from 3 to 100, got {self.sides:g}")
        object.__setattr__(self, "sides", int(self.sides))

    @property
    def corners(self) -> NDArray[np.float64]:
        """Corners about the centre, across and along the travel, shape (sides, 2) [m]."""
        angle = (2.0 * np.arange(self.sides) + 1.0) * np.pi / self.sides
        radius = 0.5 * self.across_flats / np.cos(np.pi / self.sides)
        return np.asarray(radius * np.array([np.sin(angle), np.cos(angle)]).T)

    @property
    def extent(self) -> float:
        """Extent along the travel [m]."""
        return float(np.ptp(self.corners[:, 1]))

    def _shear_integral(self) -> float:
        # In strips from one pair of corners to the next; across each the width is linear.
        x, y = self.corners[: (self.sides + 1) // 2].T
        y0, height, width = y[:-1, None], -np.diff(y)[:, None], 2.0 * x[:-1, None]
        slope = 2.0 * np.diff(x)[:, None] / height

        def first_moment(down: NDArray[np.float64]) -> NDArray[np.float64]:
            linear = (slope * y0 - width) / 2.0
            return np.asarray(down * (width * y0 + down * (linear - down * slope / 3.0)))

        down = 0.5 * height * (_NODES + 1.0)
        whole = first_moment(height)
        beyond = np.cumsum(whole, axis=0) - whole + first_moment(down)
        energy = beyond**2 / (width + slope * down)
        return float(np.sum(0.5 * height * _WEIGHTS * energy))


@dataclass(frozen=True, kw_only=True)
class FreeSection(Section):
    """A section of any shape, by its properties.

    Parameters
    ----------
    area : float
        Area A [m²].
    second_moment : float
        Second moment of area I for bending in the direction of travel [m⁴].
    shear_area : float
        Area κA that carries shear, at most the area [m²].

    Raises
    ------
    InputError
        When a value is not positive, or the shear area exceeds the area.

    Examples
    --------
    >>> from pierimpact import FreeSection
    >>> FreeSection(area=0.66, second_moment=0.034, shear_area=0.59).shear_area
    0.59
    """

    calculation = free_section
    dimensions: ClassVar = {"area": "A", "second_moment": "I", "shear_area": "Av"}
    area: float
    second_moment: float
    shear_area: float

    def _check(self) -> None:
        if self.shear_area > self.area:
            raise InputError(
                f"shear_area must be at most the area of {self.area:g} m², "
                f"got {told_from(self.shear_area, self.area)} m²"
            )

    @property
    def shear_coefficient(self) -> float:
        """Shear coefficient κ [-]."""
        return self.values["kappa"]

    @property
    def extent(self) -> float:
        """Depth of the rectangle with the same area and second moment [m]."""
        return math.sqrt(12.0 * self.second_moment / self.area)


@dataclass(frozen=True, kw_only=True)
class _Filled(_Shape):
    """What both filled tubes have in common."""

    dimensions: ClassVar = {
        "wall_thickness": "t",
        "modular_ratio": "alpha_E",
        "density_ratio": "alpha_rho",
    }
    wall_thickness: float
    modular_ratio: float
    density_ratio: float

    @property
    def mass_second_moment(self) -> float:
        """Second moment of area with which the concrete's density gives the rotary inertia [m⁴]."""
        return self.values["Ic"] + self.density_ratio * self.values["Is"]


@dataclass(frozen=True, kw_only=True)
class FilledCircularSection(_Filled, _Round):
    """A round steel tube filled with concrete; the material of the column is the concrete.

    Core and tube deflect alike: their rigidities add, in flexure and in shear. Poisson's ratio
    of the steel is taken to be that of the concrete, which makes its shear modulus some 8 % large.

    Parameters
    ----------
    diameter : float
        Outer diameter D of the tube [m].
    wall_thickness : float
        Thickness t of the tube, below half the diameter [m].
    modular_ratio : float
        Elastic modulus of the steel over that of the concrete [-].
    density_ratio : float
        Density of the steel over that of the concrete [-].
    shear_coefficient : float, optional
        Share κ of the transformed area that carries shear, at most 1 [-].

    Raises
    ------
    InputError
        When a value is not positive, the wall leaves no core, or κ exceeds 1.

    Examples
    --------
    >>> from pierimpact import FilledCircularSection
    >>> section = FilledCircularSection(
    ...     diameter=0.8, wall_thickness=0.012, modular_ratio=6.5, density_ratio=3.2
    ... )
    >>> round(section.area, 4)
    0.666
    """

    calculation = filled_circle
    dimensions: ClassVar = _Round.dimensions | _Filled.dimensions

    def _check(self) -> None:
        _leave_a_hole(self.wall_thickness, diameter=self.diameter)


@dataclass(frozen=True, kw_only=True)
class FilledRectangularSection(_Filled, _Wide):
    """A rectangular steel tube filled with concrete, as the round one.

    Parameters
    ----------
    width, depth : float
        Outer sides b across and h along the direction of travel [m].
    wall_thickness : float
        Thickness t of the tube, below half of either side [m].
    modular_ratio, density_ratio : float
        Elastic modulus and density of the steel over those of the concrete [-].
    shear_coefficient : float, optional
        Share κ of the transformed area that carries shear, at most 1 [-].

    Raises
    ------
    InputError
        When a value is not positive, the wall leaves no core, or κ exceeds 1.

    Examples
    --------
    >>> from pierimpact import FilledRectangularSection
    >>> section = FilledRectangularSection(
    ...     width=0.6, depth=0.8, wall_thickness=0.012, modular_ratio=6.5, density_ratio=3.2
    ... )
    >>> round(section.area, 4)
    0.6616
    """

    calculation = filled_rectangle
    dimensions: ClassVar = _Wide.dimensions | _Filled.dimensions

    def _check(self) -> None:
        _leave_a_hole(self.wall_thickness, width=self.width, depth=self.depth)
