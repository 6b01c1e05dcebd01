"""How uncertain a parameter is: the distribution of a factor on its value.

As factors, spreads stay what they are when the value they belong to is changed.
"""

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import InputError, brief, known, number, ratio

Array: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True)
class Uniform:
    """The parameter lies between two bounds, anywhere with equal chance.

    Parameters
    ----------
    low, high : float
        Bounds as factors on the parameter's value, 0 ≤ low ≤ 1 ≤ high [-].

    Raises
    ------
    InputError
        When the value is not between the bounds, or the lower bound is negative.

    Examples
    --------
    >>> from pierimpact import Uniform
    >>> Uniform.about(0.3).words
    '±30 %'
    """

    low: float
    high: float

    def __post_init__(self) -> None:
        for name in ("low", "high"):
            object.__setattr__(self, name, number(name, getattr(self, name)))
        if not 0.0 <= self.low <= 1.0 <= self.high:
            raise InputError(
                f"low and high must be factors with 0 ≤ low ≤ 1 ≤ high, got {self.low:g} and "
                f"{self.high:g}"
            )

    @classmethod
    def about(cls, spread: float) -> "Uniform":
        """Return the spread to either side of the value, a share of it from 0 to below 1 [-]."""
        spread = ratio("spread", spread)
        return cls(1.0 - spread, 1.0 + spread)

    def factor(self, fraction: Array) -> Array:
        """Return the factors that these fractions of all parameters lie below, same shape [-]."""
        return self.low + (self.high - self.low) * fraction

    @property
    def ends(self) -> tuple[float, float]:
        """The bounds [-]."""
        return self.low, self.high

    @property
    def words(self) -> str:
        """As it prints, such as "±30 %"."""
        below, above = 100.0 * (1.0 - self.low), 100.0 * (self.high - 1.0)
        if math.isclose(below, above, abs_tol=1e-9):
            return f"±{above:.3g} %"
        return f"−{below:.3g} % to +{above:.3g} %"


@dataclass(frozen=True)
class Lognormal:
    """The parameter's logarithm is normal, and its value in the truck is its mean.

    Parameters
    ----------
    coefficient_of_variation : float
        Standard deviation over the mean, from 0 to below 1 [-].

    Raises
    ------
    InputError
        When it is not.

    Examples
    --------
    >>> from pierimpact import Lognormal
    >>> Lognormal(0.1).words
    'c.o.v. 10 %'
    """

    coefficient_of_variation: float

    def __post_init__(self) -> None:
        name = "coefficient_of_variation"
        object.__setattr__(self, name, ratio(name, self.coefficient_of_variation))

    def factor(self, fraction: Array) -> Array:
        """Return the factors that these fractions of all parameters lie below, same shape [-].

        exp(σ z − σ²/2) with σ² = ln(1 + c²) and the standard normal quantile z; its mean is one.
        """
        from scipy.special import ndtri

        variance = math.log1p(self.coefficient_of_variation**2)
        return np.asarray(np.exp(math.sqrt(variance) * ndtri(fraction) - 0.5 * variance))

    @property
    def ends(self) -> tuple[float, float]:
        """The factors that 5 % and 95 % of all parameters lie below, this project's choice [-]."""
        low, high = self.factor(np.array([0.05, 0.95]))
        return float(low), float(high)

    @property
    def words(self) -> str:
        """As it prints, such as "c.o.v. 10 %"."""
        return f"c.o.v. {100.0 * self.coefficient_of_variation:.3g} %"


Spread: TypeAlias = Uniform | Lognormal


def checked_spreads(spreads: Mapping[str, object], names: Collection[str]) -> dict[str, Spread]:
    """Return a copy of the spreads by parameter, each of one of `names` and of a value above zero.

    Friction alone may be zero.
    """
    if not isinstance(spreads, Mapping):
        raise InputError(f"spread must be a mapping of parameters, got {brief(spreads)}")
    checked: dict[str, Spread] = {}
    for name, spread in spreads.items():
        known(name, names, "a parameter with a spread")
        if not isinstance(spread, Uniform | Lognormal):
            raise InputError(f"spread of {name} must be Uniform or Lognormal, got {brief(spread)}")
        if spread.ends[0] == 0.0 and name != "friction_force":
            raise InputError(f"spread of {name} must not begin at zero, got {spread}")
        checked[name] = spread
    return checked
