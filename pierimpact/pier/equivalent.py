"""The pier as one degree of freedom at the nominal impact height."""

from dataclasses import dataclass
from math import inf, isfinite, pi

from numpy import sqrt

from pierimpact.checks import InputError, not_negative, positive, positive_or_infinite, told_from
from pierimpact.handcalc import Calculation, Real

#: Damping ratio ζ unless another is given: this project's assumption, usual for concrete piers.
DAMPING_RATIO = 0.05


def natural_frequency(mass: Real, stiffness: Real) -> Real:
    """Return the undamped frequency √(k/m)/2π of a mass [kg] on a spring [N/m] [Hz]."""
    return 1 / (2 * pi) * sqrt(stiffness / mass)


def stiffness_at_frequency(mass: Real, frequency: Real) -> Real:
    """Return the stiffness m (2π f)² on which a mass [kg] has that frequency [Hz] [N/m]."""
    return mass * (2.0 * pi * frequency) ** 2


def damping_coefficient(mass: Real, stiffness: Real, damping_ratio: Real) -> Real:
    """Return c = 2 ζ √(k m) for a mass [kg], a stiffness [N/m] and a damping ratio [N s/m]."""
    return 2 * damping_ratio * sqrt(stiffness * mass)


@Calculation
def equivalent_mass(mbar: Real, phi2b: Real, phi2t: Real) -> dict[str, Real]:
    """Mass of the pier as one degree of freedom."""
    phi2 = phi2b + phi2t
    mp = mbar * phi2  # Eq. 1 of the source paper
    return locals()


@Calculation
def vibration(kp: Real, mp: Real, zeta: Real) -> dict[str, Real]:
    """Frequency and damping of the pier as one degree of freedom."""
    fp = natural_frequency(mp, kp)
    cp = damping_coefficient(mp, kp, zeta)
    return locals()


@dataclass(frozen=True, kw_only=True)
class EquivalentPier:
    """The pier's single-degree-of-freedom mass, spring and damper.

    The spring is elastic, or elastic–perfectly plastic: its force is k_p times the elastic part of
    the displacement and stays within ±R_y, the rest of the displacement is plastic. The damper
    acts beside it all the same. The law of yielding is this project's, not the source paper's.

    Parameters
    ----------
    mass : float
        Equivalent mass m_p (Eq. 1 of the source paper) [kg].
    stiffness : float
        Static transverse stiffness k_p at the nominal impact height (Eq. 3) [N/m].
    damping_ratio : float, optional
        Fraction ζ of critical damping, from 0 to below 1 [-].
    yield_reaction : float, optional
        Reaction R_y at which the pier yields, in either direction; infinite where it never does
        [N].

    Raises
    ------
    InputError
        When mass, stiffness or yield reaction is not positive, or the damping ratio is out of
        range.

    Examples
    --------
    >>> from pierimpact import EquivalentPier
    >>> pier = EquivalentPier(mass=8e3, stiffness=284e6)
    >>> round(pier.frequency, 2)
    29.99
    """

    mass: float
    stiffness: float
    damping_ratio: float = DAMPING_RATIO
    yield_reaction: float = inf

    def __post_init__(self) -> None:
        object.__setattr__(self, "mass", positive("mass", self.mass))
        object.__setattr__(self, "stiffness", positive("stiffness", self.stiffness))
        damping_ratio = not_negative("damping_ratio", self.damping_ratio)
        if damping_ratio >= 1.0:
            raise InputError(f"damping_ratio must be below 1, got {told_from(damping_ratio, 1.0)}")
        object.__setattr__(self, "damping_ratio", damping_ratio)
        yield_reaction = positive_or_infinite("yield_reaction", self.yield_reaction)
        object.__setattr__(self, "yield_reaction", yield_reaction)

    @classmethod
    def from_frequency(
        cls, mass: float, frequency: float, damping_ratio: float = DAMPING_RATIO
    ) -> "EquivalentPier":
        """Return the pier of a mass [kg] and an undamped frequency f_p [Hz]."""
        mass, frequency = positive("mass", mass), positive("frequency", frequency)
        stiffness = stiffness_at_frequency(mass, frequency)
        return cls(mass=mass, stiffness=stiffness, damping_ratio=damping_ratio)

    @property
    def yields(self) -> bool:
        """Whether the pier yields at any reaction."""
        return isfinite(self.yield_reaction)

    @property
    def values(self) -> dict[str, float]:
        """Stiffness, mass and damping ratio with what follows from them, by symbol."""
        return vibration(kp=self.stiffness, mp=self.mass, zeta=self.damping_ratio)

    @property
    def frequency(self) -> float:
        """Undamped frequency f_p [Hz]."""
        return float(natural_frequency(self.mass, self.stiffness))

    @property
    def damping(self) -> float:
        """Damping coefficient c_p = 2 ζ √(k_p m_p) [N s/m]."""
        return float(damping_coefficient(self.mass, self.stiffness, self.damping_ratio))
