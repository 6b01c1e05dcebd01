"""The laws of JCSS, with the methods of those of `scipy.stats` that are used here.

`scipy.stats` takes a second to import, in each process that draws trucks; these do without it, and
take `scipy.special` only once they are asked.
"""

import math
from typing import Any, NamedTuple, Protocol

import numpy as np

_LEAST = float(np.finfo(float).tiny)  # stands for what is not above zero, in a logarithm


class Law(Protocol):
    """A law of chance, such as a frozen continuous distribution of `scipy.stats`."""

    def cdf(self, value: Any) -> Any:
        """Return the shares of all below these values."""

    def sf(self, value: Any) -> Any:
        """Return the shares of all above these values."""

    def isf(self, share: Any) -> Any:
        """Return the values that these shares of all lie above."""


class Normal(NamedTuple):
    """The normal law of a mean and a standard deviation."""

    mean: float
    deviation: float

    def cdf(self, value: Any) -> Any:
        """As in `Law`."""
        return _below((value - self.mean) / self.deviation)

    def sf(self, value: Any) -> Any:
        """As in `Law`."""
        return _below((self.mean - value) / self.deviation)

    def isf(self, share: Any) -> Any:
        """As in `Law`."""
        from scipy.special import ndtri

        return self.mean - self.deviation * ndtri(share)


def _below(value: Any) -> Any:
    """Return the share of the standard normal law below these values."""
    from scipy.special import ndtr

    return ndtr(value)


class Lognormal(NamedTuple):
    """The law of values whose logarithm has a normal one."""

    logarithm: Normal

    @classmethod
    def of(cls, mean: float, deviation: float) -> "Lognormal":
        """Return the law of a mean and a standard deviation, derived here."""
        ratio = deviation / mean
        variance = math.log1p(ratio * ratio)
        return cls(Normal(math.log(mean) - 0.5 * variance, math.sqrt(variance)))

    def cdf(self, value: Any) -> Any:
        """As in `Law`."""
        return self.logarithm.cdf(np.log(np.maximum(value, _LEAST)))

    def sf(self, value: Any) -> Any:
        """As in `Law`."""
        return self.logarithm.sf(np.log(np.maximum(value, _LEAST)))

    def isf(self, share: Any) -> Any:
        """As in `Law`."""
        return np.exp(self.logarithm.isf(share))


class Rayleigh(NamedTuple):
    """The law of the length of a vector of two independent normal components about zero."""

    scale: float  #: standard deviation of a component

    @classmethod
    def of(cls, mean: float) -> "Rayleigh":
        """Return the law of a mean, derived here."""
        return cls(mean / math.sqrt(0.5 * math.pi))

    def cdf(self, value: Any) -> Any:
        """As in `Law`."""
        return -np.expm1(-0.5 * (np.maximum(value, 0.0) / self.scale) ** 2)

    def sf(self, value: Any) -> Any:
        """As in `Law`."""
        return np.exp(-0.5 * (np.maximum(value, 0.0) / self.scale) ** 2)

    def isf(self, share: Any) -> Any:
        """As in `Law`."""
        return self.scale * np.sqrt(-2.0 * np.log(share))
