"""The pier as a column: its deflection under the impact, and the equivalent pier (Eqs 1–3)."""

import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import (
    InputError,
    brief,
    finite_array,
    not_negative,
    number,
    one_of,
    positive,
    told_from,
)
from pierimpact.handcalc import Calculation
from pierimpact.pier.arrangement import SUPPORTS, Arrangement, Part, Support, refuse_mechanism
from pierimpact.pier.beam import BeamPier, beam_pier
from pierimpact.pier.equivalent import (
    DAMPING_RATIO,
    EquivalentPier,
    equivalent_mass,
    natural_frequency,
)
from pierimpact.pier.member_forces import MemberForces
from pierimpact.pier.rigidities import rigidities
from pierimpact.pier.sections import Section
from pierimpact.pier.static import UnitForce, unit_force
from pierimpact.pier.static_forces import StaticForces, StaticForcesWarning
from pierimpact.pier.unit_force import BY_ENDS

END_CONDITIONS = tuple(SUPPORTS)
#: Poisson's ratio unless another is given: this project's assumption, usual for concrete.
POISSON_RATIO = 0.2
#: Numerical: the shortest part as a share of the height, short of which round-off would grow.
SHORTEST = 1e-6
_SPRINGS = ("base_stiffness", "base_rotation_stiffness", "top_stiffness", "top_rotation_stiffness")


@dataclass(frozen=True, kw_only=True)
class Step:
    """A change of a column's cross-section.

    Parameters
    ----------
    height : float
        Height from which the column has the new section [m].
    section : Section
        Cross-section from there upward.

    Raises
    ------
    InputError
        When the height is not a number or the section not a section.

    Examples
    --------
    >>> from pierimpact import CircularSection, Step
    >>> Step(height=2.0, section=CircularSection(diameter=1.0)).height
    2.0
    """

    height: float
    section: Section

    def __post_init__(self) -> None:
        object.__setattr__(self, "height", number("step height", self.height))
        _require_section("step section", self.section)


@dataclass(frozen=True, kw_only=True)
class PierColumn:
    """A column between two ends; deflects in flexure and shear (Timoshenko beam).

    Heights z run upward from the ground, where the base is unless the column is embedded.

    Parameters
    ----------
    height : float
        Column height H from base to top [m].
    section : Section
        Cross-section from the base on, of `pierimpact.pier.sections`.
    elastic_modulus : float
        Young's modulus E [Pa].
    poisson_ratio : float, optional
        Poisson's ratio ν, from 0 to 0.5 [-].
    density : float
        Density ρ [kg/m³].
    base, top : {"fixed", "pinned", "free"}, optional
        End conditions. A fixed end neither moves nor turns, a pinned end turns, a free end does
        both.
    stiffness_factor : float, optional
        Share ψ of the gross EI that is effective in flexure, as of a cracked section: above 0 and
        at most 1, since cracks only take stiffness away [-]. Shear is not reduced.
    effective_stiffness : float, optional
        Effective flexural rigidity, instead of a share of the gross one [N m²].
    base_stiffness, top_stiffness : float, optional
        Lateral stiffness of what holds the end (footing, bearings); takes the place of what the
        end condition says of its deflection [N/m].
    base_rotation_stiffness, top_rotation_stiffness : float, optional
        Rotational stiffness of what holds the end; takes the place of what the end condition says
        of its rotation [N m/rad].
    steps : sequence of Step, optional
        Changes of the cross-section, from the base upward.
    top_mass : float, optional
        Mass of a cap or a share of the superstructure that moves with the top [kg].
    embedment : float, optional
        Equivalent depth of fixity: the column goes on as far below z = 0, where its base then is,
        with the section that it has there [m].

    Raises
    ------
    InputError
        When a value is out of its range, both kinds of stiffness are given, a step is not above
        the one below it and within the column, by a millionth of the height, or the ends leave the
        column a mechanism.

    Examples
    --------
    >>> from pierimpact import CircularSection, PierColumn
    >>> column = PierColumn(
    ...     height=5.0, section=CircularSection(diameter=0.9), elastic_modulus=25e9, density=2400.0
    ... )
    >>> pier = column.equivalent(impact_height=1.2)
    >>> round(pier.frequency, 1)
    85.0
    """

    height: float
    section: Section
    elastic_modulus: float
    poisson_ratio: float = POISSON_RATIO
    density: float
    base: str = "fixed"
    top: str = "pinned"
    stiffness_factor: float = 1.0
    effective_stiffness: float | None = None
    base_stiffness: float | None = None
    base_rotation_stiffness: float | None = None
    top_stiffness: float | None = None
    top_rotation_stiffness: float | None = None
    steps: Sequence[Step] = ()
    top_mass: float = 0.0
    embedment: float = 0.0

    def __post_init__(self) -> None:
        for name in ("height", "elastic_modulus", "density"):
            object.__setattr__(self, name, positive(name, getattr(self, name)))
        _require_section("section", self.section)
        poisson_ratio = not_negative("poisson_ratio", self.poisson_ratio)
        if poisson_ratio > 0.5:
            raise InputError(
                f"poisson_ratio must be at most 0.5, got {told_from(poisson_ratio, 0.5)}"
            )
        object.__setattr__(self, "poisson_ratio", poisson_ratio)
        self._check_stiffness()
        for name in ("top_mass", "embedment", *_SPRINGS):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, not_negative(name, getattr(self, name)))
        one_of("base", self.base, END_CONDITIONS)
        one_of("top", self.top, END_CONDITIONS)
        refuse_mechanism(*self.supports)
        try:
            object.__setattr__(self, "steps", tuple(self.steps))
        except TypeError:
            raise InputError(f"steps must be Steps, got {brief(self.steps)}") from None
        below, least = 0.0, SHORTEST * self.height
        for place, step in enumerate(self.steps, 1):
            if not isinstance(step, Step):
                raise InputError(f"steps must be Steps, got {brief(step)}")
            if not below + least <= step.height <= self.height - least:
                raise InputError(
                    f"steps[{place}].height must be above {below:g} m and below the height "
                    f"{self.height:g} m, got {told_from(step.height, self.height)} m: no part may "
                    f"be shorter than {least:g} m"
                )
            below = step.height

    @property
    def supports(self) -> tuple[Support, Support]:
        """What holds base and top: by the end conditions, and springs in their place."""
        springs = [getattr(self, name) for name in _SPRINGS]
        rigid = (*SUPPORTS[self.base], *SUPPORTS[self.top])
        k = [end if own is None else own for own, end in zip(springs, rigid, strict=True)]
        return Support(*k[:2]), Support(*k[2:])

    @property
    def uniform(self) -> bool:
        """Whether it has one section, rigid or no supports and no other mass."""
        extras = (self.steps, self.top_mass, self.embedment)
        return not any(extras) and all(getattr(self, name) is None for name in _SPRINGS)

    def _check_stiffness(self) -> None:
        factor = positive("stiffness_factor", self.stiffness_factor)
        if factor > 1.0:
            raise InputError(f"stiffness_factor must be at most 1, got {told_from(factor, 1.0)}")
        object.__setattr__(self, "stiffness_factor", factor)
        if self.effective_stiffness is None:
            return
        stiffness = positive("effective_stiffness", self.effective_stiffness)
        if factor < 1.0:
            raise InputError(
                "give only one of stiffness_factor and effective_stiffness, "
                f"got {factor:g} and {stiffness:g} N m²"
            )
        if self.steps:
            raise InputError("effective_stiffness belongs to a column of one section, got steps")
        object.__setattr__(self, "effective_stiffness", stiffness)

    def calculations(self, section: Section) -> tuple[Calculation, ...]:
        """Return what leads from a section and the material to its rigidities, in order."""
        cracked, given = self.stiffness_factor < 1.0, self.effective_stiffness is not None
        return section.calculation, *rigidities(section, cracked=cracked, given=given)

    @cached_property
    def values(self) -> dict[str, float]:
        """Dimensions, material, rigidities and mass per length at the base, by symbol."""
        return self.section_values(self.section)

    def section_values(self, section: Section) -> dict[str, float]:
        """Return dimensions, material, rigidities and mass per length of a section, by symbol."""
        found = section.values | {
            "E": self.elastic_modulus,
            "nu": self.poisson_ratio,
            "rho": self.density,
            "H": self.height,
            "psi": self.stiffness_factor,
            "EIe": self.effective_stiffness or 0.0,
        }
        for calculation in self.calculations(section)[1:]:
            found |= calculation(**{name: found[name] for name in calculation.given})
        return found

    @property
    def stretches(self) -> list[tuple[Section, float, float]]:
        """Each section with the heights from and to which the column has it, upward [m]."""
        joints = [0.0 - self.embedment, *(step.height for step in self.steps), self.height]
        sections = [self.section, *(step.section for step in self.steps)]
        return [(own, *ends) for own, ends in zip(sections, pairwise(joints), strict=True)]

    @cached_property
    def arrangement(self) -> Arrangement:
        """The column as uniform parts between its supports."""
        parts = []
        for section, bottom, top in self.stretches:
            values = self.section_values(section)
            EI, GA, mbar = (values[name] for name in ("EI", "GA", "mbar"))
            rotary_inertia = self.density * section.mass_second_moment
            parts.append(Part(bottom, top, EI, GA, mbar, rotary_inertia))
        return Arrangement(tuple(parts), *self.supports, self.top_mass)

    @property
    def mass(self) -> float:
        """Mass of the column itself [kg]."""
        return sum(part.mass_per_length * part.length for part in self.arrangement.parts)

    @property
    def flexural_rigidity(self) -> float:
        """Effective flexural rigidity EI [N m²]."""
        return self.values["EI"]

    @property
    def shear_rigidity(self) -> float:
        """Shear rigidity κGA [N]."""
        return self.values["GA"]

    @property
    def mass_per_length(self) -> float:
        """Mass per unit length m̄ = ρA, of filled tubes ρA_m [kg/m]."""
        return self.values["mbar"]

    def struck_at(self, impact_height: float) -> "StruckColumn":
        """Return the column under a unit force at `impact_height` [m]."""
        return StruckColumn(column=self, impact_height=impact_height)

    def equivalent(
        self, impact_height: float, damping_ratio: float = DAMPING_RATIO
    ) -> EquivalentPier:
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

        Warns
        -----
        StaticForcesWarning
            Where member forces under the reaction as a static force may be too low.
        """
        struck = self.struck_at(impact_height)
        pier = struck.equivalent(damping_ratio)
        if not struck.static_forces.hold:
            words = f"{struck.static_forces.sentence} PierColumn.beam gives it."
            warnings.warn(words, StaticForcesWarning, stacklevel=2)
        return pier

    def beam(
        self, impact_height: float, damping_ratio: float = DAMPING_RATIO, modes: int | None = None
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
        equivalent = self.struck_at(impact_height).equivalent(damping_ratio)
        return beam_pier(*self.arrangement.with_joint(float(impact_height)), equivalent, modes)

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
        column = self.column
        _, base, top, _ = column.arrangement
        # Above ground, and not where a support holds it.
        on_base = column.embedment > 0.0 or math.isfinite(base.stiffness)
        on_top = math.isfinite(top.stiffness)
        above_base = impact_height > 0.0 or (on_base and impact_height == 0.0)
        below_top = impact_height < column.height or (on_top and impact_height == column.height)
        if not (above_base and below_top):
            raise InputError(
                f"impact_height must be {'at least' if on_base else 'above'} 0 m and "
                f"{'at most' if on_top else 'below'} the height {column.height:g} m "
                f"of a column with {column.base} base and {column.top} top, got "
                f"{told_from(impact_height, column.height)} m"
            )

    @cached_property
    def unit_force(self) -> UnitForce:
        """What the unit force does to the column."""
        return unit_force(self.column.arrangement, self.impact_height)

    @cached_property
    def values(self) -> dict[str, float]:
        """Every value on the way from the column to its stiffness and shape, by symbol.

        For a uniform column by the closed forms of `pierimpact.pier.unit_force`, which can be
        followed by hand; for any other those of its base, and what the unit force does to it.
        """
        column, z, found = self.column, self.impact_height, self.unit_force
        if not column.uniform:
            return column.values | {
                "z": z,
                "Rb": found.base_force,
                "Rt": found.top_force,
                "Mb": found.base_moment,
                "Mn": self.member_forces(1.0).impact_moment,
                "Mt": found.top_moment,
                "xn": found.deflection,
                "kp": self.stiffness,
                "mp": self.mass,
            }
        rigidity = {name: column.values[name] for name in ("H", "EI", "GA")}
        closed = BY_ENDS[column.base, column.top](z=z, y=column.height - z, **rigidity)
        values = column.values | closed
        return values | equivalent_mass(**{name: values[name] for name in equivalent_mass.given})

    def member_forces(self, reaction: float) -> MemberForces:
        """Support reactions, shear and moment under the static force R [N] at z_n."""
        reaction = number("reaction", reaction)
        found = self.unit_force
        return MemberForces(
            reaction=reaction,
            height=self.column.height,
            bottom=0.0 - self.column.embedment,
            impact_height=self.impact_height,
            base_force=reaction * found.base_force,
            top_force=reaction * found.top_force,
            base_moment=reaction * found.base_moment,
            top_moment=reaction * found.top_moment,
        )

    def yield_reaction(self, moment_resistance: float) -> float:
        """Return the static reaction at which the column first reaches its moment resistance [N].

        At this reaction R_y the largest moment anywhere, elastic and without axial force, is the
        resistance M_R, and the first hinge forms. A redundant column carries more until its hinges
        make it a mechanism, so that R_y is on the safe side for the reaction. It is infinite where
        the force bends nothing, as at a pinned base. Derived here.

        Parameters
        ----------
        moment_resistance : float
            Resistance M_R of the section in bending [N m].
        """
        moment_resistance = positive("moment_resistance", moment_resistance)
        largest = abs(self.member_forces(1.0).largest_moment.value)
        return moment_resistance / largest if largest > 0.0 else math.inf

    @property
    def stiffness(self) -> float:
        """Stiffness k_p = 1/x(z_n) (Eq. 3 of the source paper) [N/m]."""
        return 1.0 / self.unit_force.deflection

    def shape(self, z: ArrayLike) -> NDArray[np.float64]:
        """Shape function φ(z) = x(z)/x(z_n) (Eq. 2) at heights `z` [m], in the shape of `z` [-]."""
        z = finite_array("z", z)
        bottom, height = 0.0 - self.column.embedment, self.column.height
        if not np.all((z >= bottom) & (z <= height)):
            raise InputError(f"z must be from {bottom:g} m to the height {height:g} m throughout")
        return self.unit_force.deflections(z) / self.unit_force.deflection

    def deflection(self, z: ArrayLike, force: float = 1.0) -> NDArray[np.float64]:
        """Deflection x(z) at heights `z` [m] under a static force [N] at z_n, as `z` [m]."""
        return np.asarray(number("force", force) * self.unit_force.deflection * self.shape(z))

    @property
    def mass(self) -> float:
        """Equivalent mass m_p = ∫ m̄ φ² dz + m_t φ(H)² (Eq. 1 of the source paper) [kg]."""
        return self.unit_force.mass

    @property
    def static_forces(self) -> StaticForces:
        """Whether member forces under the reaction as a static force hold for the column."""
        frequency = float(natural_frequency(self.mass, self.stiffness))
        base, top = (
            "fixed" if end.rotation_stiffness > 0.0 else "pinned" for end in self.column.supports
        )
        return StaticForces(base, top, frequency)

    def equivalent(self, damping_ratio: float = DAMPING_RATIO) -> EquivalentPier:
        """Return the pier as one degree of freedom, with a damping ratio ζ [-]."""
        return EquivalentPier(mass=self.mass, stiffness=self.stiffness, damping_ratio=damping_ratio)


def _require_section(name: str, section: object) -> None:
    if not isinstance(section, Section):
        raise InputError(
            f"{name} must be a section such as CircularSection(…), got {brief(section)}"
        )
