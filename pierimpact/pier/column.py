"""The pier as a column: its deflection under the impact, and the equivalent pier (Eqs 1–3)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import InputError, not_negative, number, one_of, positive
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.pier.member_forces import MemberForces
from pierimpact.pier.sections import Section

# What is not known beforehand at each kind of end, among its deflection (0), rotation (1),
# moment (2) and shear (3). The other two are zero.
_UNKNOWNS = {"fixed": [2, 3], "pinned": [1, 3], "free": [0, 1]}
END_CONDITIONS = tuple(_UNKNOWNS)


@dataclass(frozen=True, kw_only=True)
class PierColumn:
    """A uniform column between two ends; deflects in flexure and shear (Timoshenko beam).

    Heights z run from the base upward.

    Parameters
    ----------
    height : float
        Column height H from base to top [m].
    section : CircularSection or RectangularSection
        Cross-section.
    elastic_modulus : float
        Young's modulus E [Pa].
    poisson_ratio : float, optional
        Poisson's ratio ν, from 0 to 0.5 [-].
    density : float
        Density ρ [kg/m³].
    base, top : {"fixed", "pinned", "free"}, optional
        End conditions. A fixed end neither moves nor turns, a pinned end turns, a free end does
        both.

    Raises
    ------
    InputError
        When a value is out of its range, or the ends leave the column a mechanism: one end must
        be fixed, or both pinned.
    """

    height: float
    section: Section
    elastic_modulus: float
    poisson_ratio: float = 0.2
    density: float
    base: str = "fixed"
    top: str = "pinned"

    def __post_init__(self) -> None:
        for name in ("height", "elastic_modulus", "density"):
            object.__setattr__(self, name, positive(name, getattr(self, name)))
        if not isinstance(self.section, Section):
            raise InputError(
                f"section must be a CircularSection or a RectangularSection, got {self.section!r}"
            )
        poisson_ratio = not_negative("poisson_ratio", self.poisson_ratio)
        if poisson_ratio > 0.5:
            raise InputError(f"poisson_ratio must be at most 0.5, got {poisson_ratio:g}")
        object.__setattr__(self, "poisson_ratio", poisson_ratio)
        one_of("base", self.base, END_CONDITIONS)
        one_of("top", self.top, END_CONDITIONS)
        ends = (self.base, self.top)
        if "fixed" not in ends and "free" in ends:
            raise InputError(
                f"base and top must include a fixed end or both be pinned, got base "
                f"{self.base!r} and top {self.top!r}: the column would be a mechanism"
            )

    @property
    def flexural_rigidity(self) -> float:
        """Flexural rigidity EI [N m²]."""
        return self.elastic_modulus * self.section.second_moment

    @property
    def shear_modulus(self) -> float:
        """Shear modulus G = E / 2(1 + ν) [Pa]."""
        return self.elastic_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def shear_rigidity(self) -> float:
        """Shear rigidity κGA [N]."""
        return self.shear_modulus * self.section.shear_area

    @property
    def mass_per_length(self) -> float:
        """Mass per unit length m̄ = ρA [kg/m]."""
        return self.density * self.section.area

    def struck_at(self, impact_height: float) -> "StruckColumn":
        """Return the column under a unit force at `impact_height` [m]."""
        return StruckColumn(column=self, impact_height=impact_height)

    def equivalent(self, impact_height: float, damping_ratio: float = 0.05) -> EquivalentPier:
        """Return the pier as one degree of freedom (Eqs 1–3 of the source paper).

        Parameters
        ----------
        impact_height : float
            Nominal impact height z_n [m].
        damping_ratio : float, optional
            Fraction ζ of critical damping [-].

        Returns
        -------
        EquivalentPier
            Mass m_p, stiffness k_p and damping ratio ζ.
        """
        struck = self.struck_at(impact_height)
        return EquivalentPier(
            mass=struck.mass, stiffness=struck.stiffness, damping_ratio=damping_ratio
        )

    def deflection(
        self, z: ArrayLike, impact_height: float, force: float = 1.0
    ) -> NDArray[np.float64]:
        """Deflection x(z) under a static force at the impact height.

        Parameters
        ----------
        z : array_like, any shape
            Heights, from 0 to H [m].
        impact_height : float
            Height z_n of the force [m].
        force : float, optional
            Force, positive in the direction of travel [N].

        Returns
        -------
        ndarray, shape of `z`
            Deflection, positive in the direction of travel [m].
        """
        struck = self.struck_at(impact_height)
        return np.asarray(number("force", force) * struck.impact_deflection * struck.shape(z))

    def shape(self, z: ArrayLike, impact_height: float) -> NDArray[np.float64]:
        """Shape function φ(z) = x(z)/x(z_n) (Eq. 2 of the source paper).

        Parameters
        ----------
        z : array_like, any shape
            Heights, from 0 to H [m].
        impact_height : float
            Nominal impact height z_n [m].

        Returns
        -------
        ndarray, shape of `z`
            Deflection as a fraction of that at the impact height [-].
        """
        return self.struck_at(impact_height).shape(z)

    def member_forces(self, reaction: float, impact_height: float) -> MemberForces:
        """Support reactions, shear and moment under the static force R at the impact height.

        Parameters
        ----------
        reaction : float
            Force R, positive in the direction of travel [N].
        impact_height : float
            Height z_n of the force [m].
        """
        return self.struck_at(impact_height).member_forces(reaction)


@dataclass(frozen=True, kw_only=True)
class StruckColumn:
    """A column under a unit force at the impact height z_n, and what Eqs 1–3 make of it.

    Each of the two parts, below and above the impact, is seen from its own end: with the
    distance s from that end both obey the same equations (`_carry`), whatever the end. Each
    resists the deflection and rotation of the joint at z_n with its own stiffness; the two
    stiffnesses add up, and carry the unit force. Derived here from beam theory.

    Parameters
    ----------
    column : PierColumn
        The column.
    impact_height : float
        Height z_n of the force: between the ends, or at a free end [m].

    Raises
    ------
    InputError
        When the force misses the column, or acts on a support.
    """

    column: PierColumn
    impact_height: float

    def __post_init__(self) -> None:
        impact_height = number("impact_height", self.impact_height)
        object.__setattr__(self, "impact_height", impact_height)
        height, base, top = self.column.height, self.column.base, self.column.top
        above_base = impact_height > 0.0 or (base == "free" and impact_height == 0.0)
        below_top = impact_height < height or (top == "free" and impact_height == height)
        if not (above_base and below_top):
            raise InputError(
                f"impact_height must be {'at least' if base == 'free' else 'above'} 0 m and "
                f"{'at most' if top == 'free' else 'below'} the height {height:g} m "
                f"of a column with {base} base and {top} top, got {impact_height:g} m"
            )

    @cached_property
    def _lengths(self) -> tuple[float, float]:
        """Lengths of the parts below and above the impact, over H [-]."""
        height = self.column.height
        return self.impact_height / height, (height - self.impact_height) / height

    @cached_property
    def _shear_flexibility(self) -> float:
        """Shear flexibility EI / (κGA H²) beside that of flexure [-]."""
        column = self.column
        return column.flexural_rigidity / (column.shear_rigidity * column.height**2)

    @cached_property
    def _end_states(self) -> NDArray[np.float64]:
        """Deflection, rotation, moment and shear at base and top, shape (2, 4) [-].

        Each end's are reckoned along its own distance s, in the units H³/EI, H²/EI, H and 1 per
        unit force.
        """
        unknowns = [_UNKNOWNS[self.column.base], _UNKNOWNS[self.column.top]]
        below, above = (
            _carry(length, self._shear_flexibility)[:, columns]
            for length, columns in zip(self._lengths, unknowns, strict=True)
        )
        # Seen from the base, the part above turns, and is bent by the joint, the other way.
        above *= np.array([[1.0], [-1.0], [-1.0], [1.0]])
        # Each end's two unknowns follow from the joint's deflection and rotation, and so do the
        # part's moment and shear there. Together the parts balance no moment and a unit force.
        from_joint = [np.linalg.inv(part[:2]) for part in (below, above)]
        stiffness = below[2:] @ from_joint[0] + above[2:] @ from_joint[1]
        joint = np.linalg.solve(stiffness, [0.0, 1.0])
        states = np.zeros((2, 4))
        for end in (0, 1):
            states[end, unknowns[end]] = from_joint[end] @ joint
        return states

    def member_forces(self, reaction: float) -> MemberForces:
        """Support reactions, shear and moment under the static force R [N] at z_n."""
        reaction = number("reaction", reaction)
        height = self.column.height
        (_, _, base_moment, base_force), (_, _, top_moment, top_force) = self._end_states.tolist()
        return MemberForces(
            reaction=reaction,
            height=height,
            impact_height=self.impact_height,
            base_force=reaction * base_force,
            top_force=reaction * top_force,
            base_moment=reaction * height * base_moment,
            top_moment=reaction * height * top_moment,
        )

    @cached_property
    def unit_forces(self) -> MemberForces:
        """Member forces under the unit force; moments in N m per N."""
        return self.member_forces(1.0)

    @property
    def flexural_deflection(self) -> float:
        """Flexural part of x(z_n), the integral of M²/EI over the column [m/N].

        [z_n (M_b² + M_b M_n + M_n²) + (H − z_n)(M_n² + M_n M_t + M_t²)] / 3EI, with the moments
        under the unit force: the supports do no work, so x(z_n) is twice the strain energy.
        """
        forces = self.unit_forces
        base, impact, top = forces.base_moment, forces.impact_moment, forces.top_moment
        below = self.impact_height * (base**2 + base * impact + impact**2)
        above = (self.column.height - self.impact_height) * (impact**2 + impact * top + top**2)
        return (below + above) / (3.0 * self.column.flexural_rigidity)

    @property
    def shear_deflection(self) -> float:
        """Shear part of x(z_n): [z_n R_b² + (H − z_n) R_t²] / κGA [m/N].

        The integral of V²/κGA over the column, with the support forces under the unit force.
        """
        forces = self.unit_forces
        below = self.impact_height * forces.base_force**2
        above = (self.column.height - self.impact_height) * forces.top_force**2
        return (below + above) / self.column.shear_rigidity

    @property
    def impact_deflection(self) -> float:
        """Deflection x(z_n) under the unit force, of flexure and shear [m/N]."""
        return self.flexural_deflection + self.shear_deflection

    @property
    def stiffness(self) -> float:
        """Stiffness k_p = 1/x(z_n) (Eq. 3 of the source paper) [N/m]."""
        return 1.0 / self.impact_deflection

    @cached_property
    def shape_coefficients(self) -> NDArray[np.float64]:
        """Coefficients of φ = c0 + c1 s + c2 s² + c3 s³ below and above, shape (2, 4) [-].

        s is the distance over H: from the base in the first row, from the top in the second.
        """
        deflection, rotation, moment, shear = self._end_states.T
        slope = rotation + self._shear_flexibility * shear
        coefficients = np.stack([deflection, slope, -moment / 2.0, -shear / 6.0], axis=1)
        unit = self.column.height**3 / self.column.flexural_rigidity
        scaled: NDArray[np.float64] = coefficients * (unit / self.impact_deflection)
        return scaled

    def shape(self, z: ArrayLike) -> NDArray[np.float64]:
        """Shape function φ(z) = x(z)/x(z_n) (Eq. 2) at heights `z` [m], in the shape of `z` [-]."""
        z = np.asarray(z, dtype=float)
        height = self.column.height
        if not np.all((z >= 0.0) & (z <= height)):
            raise InputError(f"z must be from 0 m to the height {height:g} m throughout")
        from_base, from_top = self.shape_coefficients
        below: NDArray[np.float64] = polynomial.polyval(z / height, from_base)
        above: NDArray[np.float64] = polynomial.polyval((height - z) / height, from_top)
        return np.where(z <= self.impact_height, below, above)

    @property
    def shape_integral(self) -> float:
        """Integral of φ² over the column, of each part's polynomial exactly [m]."""
        integral = 0.0
        for coefficients, length in zip(self.shape_coefficients, self._lengths, strict=True):
            square = polynomial.polymul(coefficients, coefficients)
            integral += float(polynomial.polyval(length, polynomial.polyint(square)))
        return self.column.height * integral

    @property
    def mass(self) -> float:
        """Equivalent mass m_p = m̄ ∫ φ² dz (Eq. 1 of the source paper) [kg]."""
        return self.column.mass_per_length * self.shape_integral


def _carry(length: float, shear_flexibility: float) -> NDArray[np.float64]:
    """Matrix that carries deflection, rotation, moment and shear from an end to a distance s.

    Timoshenko's beam without load between, in the units of `StruckColumn._end_states`:
    V' = 0, M' = V, θ' = −M, x' = θ + EI/(κGA H²) V.

    Parameters
    ----------
    length : float
        Distance s from the end, over H [-].
    shear_flexibility : float
        EI / (κGA H²) [-].

    Returns
    -------
    ndarray, shape (4, 4)
    """
    s = length
    return np.array(
        [
            [1.0, s, -(s**2) / 2.0, shear_flexibility * s - s**3 / 6.0],
            [0.0, 1.0, -s, -(s**2) / 2.0],
            [0.0, 0.0, 1.0, s],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )
