"""The distribution of a quantity of the traffic, truncated where it would give impossible values.

Values are drawn by the share of all that is larger, which keeps its figures in the upper tail.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.certainty import Certainty
from pierimpact.checks import InputError
from pierimpact.risk.laws import Law

Array: TypeAlias = NDArray[np.float64]

#: Share of values outside their bounds that a law may have without saying that it is truncated:
#: this project's choice, less than one in a thousand runs of a million draws.
NEGLIGIBLE = 1e-9


@dataclass(frozen=True, kw_only=True, eq=False)
class Distribution:
    """A quantity that differs from truck to truck.

    Parameters
    ----------
    law : Law
        Frozen continuous distribution of `scipy.stats`, or one of `risk.laws`, in SI units.
    words : str
        How it prints.
    status : Certainty or None
        How certain it is; None where a user gives it.
    low, high : float, optional
        Where it is truncated; infinite where it is not [SI].
    bounds : tuple of float, optional
        What values there can be: of a mass or a speed, all above zero [SI].

    Raises
    ------
    InputError
        When the law gives values beyond the bounds and is not truncated, or hardly any within.
    """

    law: Law
    words: str
    status: Certainty | None
    low: float = -math.inf
    high: float = math.inf
    bounds: tuple[float, float] = (0.0, math.inf)

    def __post_init__(self) -> None:
        least, most = self.bounds
        beyond = self.law.cdf(least) * (self.low < least) + self.law.sf(most) * (self.high > most)
        if not beyond <= NEGLIGIBLE:
            which = "negative" if self.law.cdf(least) > NEGLIGIBLE else "impossible"
            raise InputError(
                f"gives {which} values ({100.0 * beyond:.2g} % of all): say where it is "
                f"truncated, got {self.words}"
            )
        object.__setattr__(self, "low", max(self.low, least))
        object.__setattr__(self, "high", min(self.high, most))
        if not self.low < self.high:
            raise InputError(f"must be truncated from a lower to a higher value, got {self.words}")
        above, share = self._above, self._share
        if not (share > NEGLIGIBLE and math.isfinite(above)):
            raise InputError(f"has no values between its bounds, got {self.words}")

    @property
    def _above(self) -> float:
        """Share of the law above the upper end."""
        return float(self.law.sf(self.high))

    @property
    def _share(self) -> float:
        """Share of the law between the ends."""
        return float(self.law.sf(self.low)) - self._above

    def exceeded_by(self, share: Array) -> Array:
        """Return the values that these shares of all lie above, same shape [SI]."""
        values = np.asarray(self.law.isf(self._above + share * self._share), dtype=float)
        return np.asarray(np.clip(values, self.low, self.high))

    def share_above(self, value: Array) -> Array:
        """Return the shares of all that lie above these values, same shape [-]."""
        inside = np.clip(value, self.low, self.high)
        return np.asarray((self.law.sf(inside) - self._above) / self._share)

    @cached_property
    def mean(self) -> float:
        """The mean, by quadrature over the shares [SI]."""
        nodes, weights = np.polynomial.legendre.leggauss(200)
        # The substitution flattens either end of the quantile function: numerical.
        angle = 0.25 * math.pi * (nodes + 1.0)
        shares = np.sin(angle) ** 2
        return float(weights @ (self.exceeded_by(shares) * np.sin(2.0 * angle)) * 0.25 * math.pi)
