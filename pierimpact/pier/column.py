"""The pier as a column: its deflection under the impact, and the equivalent pier (Eqs 1–3)."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import InputError, not_negative, number, one_of, positive
from pierimpact.handcalc import Calculation, Real
from pierimpact.pier.beam import BeamPier, Part, beam_pier
from pierimpact.pier.equivalent import EquivalentPier, equivalent_mass
from pierimpact.pier.member_forces import MemberForces
from pierimpact.pier.sections import Section
from pierimpact.pier.unit_force import BY_ENDS

END_CONDITIONS = ("fixed", "pinned", "free")


@Calculation
def rigidities(E: Real, nu: Real, rho: Real, A: Real, I: Real, kappa: Real) -> dict[str, Real]:
    """The rigidities of a section, and its mass per length."""
    EI = E * I
    G = E / (2 * (1 + nu))
    GA = kappa * G * A
    mbar = rho * A
    return locals()


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

    @cached_property
    def values(self) -> dict[str, float]:
        """Dimensions, material, rigidities and mass per length, by symbol."""
        section = self.section.values
        sizes = {name: section[name] for name in ("A", "I", "kappa")}
        material = {"E": self.elastic_modulus, "nu": self.poisson_ratio, "rho": self.density}
        return {**section, **rigidities(**material, **sizes), "H": self.height}

    @property
    def flexural_rigidity(self) -> float:
        """Flexural rigidity EI [N m²]."""
        return self.values["EI"]

    @property
    def shear_rigidity(self) -> float:
        """Shear rigidity κGA [N]."""
        return self.values["GA"]

    @property
    def mass_per_length(self) -> float:
        """Mass per unit length m̄ = ρA [kg/m]."""
        return self.values["mbar"]

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
        return self.struck_at(impact_height).equivalent(damping_ratio)

    def beam(
        self, impact_height: float, damping_ratio: float = 0.05, modes: int | None = None
    ) -> BeamPier:
        """Return the pier as a beam that vibrates in its natural modes.

        Parameters
        ----------
        impact_height : float
            Nominal impact height z_n [m].
        damping_ratio : float, optional
            Fraction ζ of critical damping of each mode [-].
        modes : int, optional
            As in `pierimpact.pier.beam.beam_pier`.
        """
        equivalent = self.equivalent(impact_height, damping_ratio)
        joints = np.unique([0.0, float(impact_height), self.height]).tolist()
        rotary_inertia = self.density * self.section.second_moment
        uniform = (self.flexural_rigidity, self.shear_rigidity, self.mass_per_length)
        parts = [Part(*stretch, *uniform, rotary_inertia) for stretch in pairwise(joints)]
        struck = joints.index(float(impact_height))
        return beam_pier(parts, (self.base, self.top), struck, equivalent, modes)

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

    The equations are in `pierimpact.pier.unit_force`, and their values in `values`, by symbol.
    Forces and deflections are positive in the direction of travel.

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
    def values(self) -> dict[str, float]:
        """Every value on the way from the column to its stiffness and shape, by symbol."""
        column, z = self.column, self.impact_height
        calculation = BY_ENDS[column.base, column.top]
        rigidity = {name: column.values[name] for name in ("H", "EI", "GA")}
        found = column.values | calculation(z=z, y=column.height - z, **rigidity)
        return found | equivalent_mass(**{name: found[name] for name in equivalent_mass.given})

    def member_forces(self, reaction: float) -> MemberForces:
        """Support reactions, shear and moment under the static force R [N] at z_n."""
        reaction = number("reaction", reaction)
        base_force, top_force, base_moment, top_moment = (
            reaction * self.values[name] for name in ("Rb", "Rt", "Mb", "Mt")
        )
        return MemberForces(
            reaction=reaction,
            height=self.column.height,
            impact_height=self.impact_height,
            base_force=base_force,
            top_force=top_force,
            base_moment=base_moment,
            top_moment=top_moment,
        )

    def yield_reaction(self, moment_resistance: float) -> float:
        """Return the static reaction at which the column first reaches its moment resistance [N].

        At this reaction R_y the largest moment anywhere, elastic and without axial force, is the
        resistance M_R, and the first hinge forms. A redundant column carries more until its hinges
        make it a mechanism, so that R_y is on the safe side for the reaction. Derived here.

        Parameters
        ----------
        moment_resistance : float
            Resistance M_R of the section in bending [N m].
        """
        moment_resistance = positive("moment_resistance", moment_resistance)
        return moment_resistance / abs(self.member_forces(1.0).largest_moment.value)

    @property
    def stiffness(self) -> float:
        """Stiffness k_p = 1/x(z_n) (Eq. 3 of the source paper) [N/m]."""
        return self.values["kp"]

    @property
    def shape_coefficients(self) -> NDArray[np.float64]:
        """Coefficients of φ = c0 + c1 s + c2 s² + c3 s³ below and above, shape (2, 4) [-].

        s is the distance over H: from the base in the first row, from the top in the second.
        """
        return np.array(
            [[self.values.get(f"c{end}{power}", 0.0) for power in range(4)] for end in "bt"]
        )

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

    def deflection(self, z: ArrayLike, force: float = 1.0) -> NDArray[np.float64]:
        """Deflection x(z) at heights `z` [m] under a static force [N] at z_n, as `z` [m]."""
        return np.asarray(number("force", force) * self.values["xn"] * self.shape(z))

    @property
    def mass(self) -> float:
        """Equivalent mass m_p = m̄ ∫ φ² dz (Eq. 1 of the source paper) [kg]."""
        return self.values["mp"]

    def equivalent(self, damping_ratio: float = 0.05) -> EquivalentPier:
        """Return the pier as one degree of freedom, with a damping ratio ζ [-]."""
        return EquivalentPier(mass=self.mass, stiffness=self.stiffness, damping_ratio=damping_ratio)
