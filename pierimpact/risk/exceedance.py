"""How often a value is exceeded, with a confidence band, from draws that count with a weight.

With weights w_i the frequency is ν Σ w_i / n over the draws that exceed. Its band is that of a
gamma distribution of the same mean and variance, whose upper end counts one more draw, of the
largest weight. Without weights, and for rare values, that is the exact band of a Poisson count; it
is the band of M. P. Fay and E. J. Feuer, Statistics in Medicine 16 (1997), from memory, with the
variance of a mean of n draws in place of that of a Poisson count.

Where the values are rough, and better ones are known of the first m draws, those draws correct the
frequency: it is that of the rough values of all, more by that of the better values of the first m,
less by that of their rough ones. The variance is the sum of both parts', of which the second has
only the draws that exceed by one of both; the upper end counts one more of these. Derived here: it
is the regression estimator of two-phase sampling with a slope of one.
"""

import math
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import positive

Array: TypeAlias = NDArray[np.float64]

#: Chance that a band holds the frequency: this project's choice.
CONFIDENCE = 0.95
_ROUNDING = 1.0 - 1e-12  # numerical: of sums of the same weights in another order


class Estimate(NamedTuple):
    """An estimate with its confidence band, floats or arrays of one shape."""

    value: Array
    low: Array
    high: Array


class Exceedance:
    """The frequencies at which a quantity exceeds values.

    Parameters
    ----------
    values, weights : ndarray, shape (n,)
        Of the draws; a weight of zero is a draw that does not count [-].
    frequency : float
        Frequency ν of all events that are drawn from [1/s].
    better : ndarray, shape (m,), optional
        Values of the first draws of which those above are rough.
    """

    def __init__(
        self, values: Array, weights: Array, frequency: float, better: Array | None = None
    ) -> None:
        self.frequency, self.size = frequency, len(values)
        if better is None or len(better) == len(values):  # all, or none, are better known
            values, better = values if better is None else better, values[:0]
        self.corrected = len(better)  #: draws that correct
        changed = better != values[: len(better)]
        better, rough = better[changed], values[: len(better)][changed]
        first = weights[: self.corrected][changed]
        none, doubt = np.zeros_like(first), np.where(better > rough, 1.0, -1.0) * first**2
        more = np.concatenate((np.zeros_like(weights), first, -first))
        doubts = np.concatenate((np.zeros_like(weights), doubt, -doubt))
        most = np.concatenate((weights, first, first))
        weights = np.concatenate((weights, none, none))
        values = np.concatenate((values, better, rough))
        counts = most > 0.0
        order = np.flatnonzero(counts)[np.argsort(-values[counts], kind="stable")]
        self.values = values[order]  #: that count, the largest first

        def sums(parts: Array) -> Array:
            return np.concatenate((np.zeros(1), np.cumsum(parts[order])))

        self._sum, self._squares = sums(weights), sums(weights**2)
        self._more, self._doubt = sums(more), sums(doubts)
        largest = np.maximum.accumulate(most[order])
        # Where no draw exceeds, the next that would counts as much as the largest.
        self._most = np.concatenate((largest[:1], largest)) if len(order) else np.zeros(1)

    def rate(self, value: ArrayLike) -> Estimate:
        """Return how often these values are exceeded, with the band [1/s]."""
        count = np.searchsorted(-self.values, -np.asarray(value, dtype=float), side="left")
        return Estimate(*(self.frequency * part for part in self._shares(count)))

    def value(self, rate: float) -> Estimate:
        """Return the value that is exceeded at a rate [1/s], and those where the band has it.

        Zero where even that is not exceeded so often; infinite where the draws cannot tell.
        """
        share = positive("rate", rate) / self.frequency * _ROUNDING
        values = np.concatenate(((math.inf,), self.values, (0.0,)))
        return Estimate(*(values[np.searchsorted(each, share)] for each in self._grown))

    @property
    def total(self) -> Estimate:
        """How often there is any event that counts [1/s]."""
        return self.rate(-math.inf)

    @cached_property
    def _grown(self) -> Estimate:
        """The shares with the number that exceed; of a million they take a second."""
        found = self._shares(np.arange(len(self.values) + 1))
        return Estimate(*map(np.maximum.accumulate, found))

    def _shares(self, count: NDArray[np.int_]) -> Estimate:
        """Return the shares of all events in which the largest `count` values are exceeded."""
        from scipy.special import gammainccinv, gammaincinv

        n, tail = self.size, 0.5 * (1.0 - CONFIDENCE)
        mean = self._sum[count] / n
        variance = np.maximum(self._squares[count] / n - mean**2, 0.0) / n
        one = self._most[count] / (self.corrected or n)
        if self.corrected:
            mean = np.clip(mean + self._more[count] / self.corrected, 0.0, self._sum[-1] / n)
            variance += np.maximum(self._doubt[count], 0.0) / self.corrected**2
        upper, spread = mean + one, variance + one**2
        some = (variance > 0.0) & (mean > 0.0)
        scale = np.divide(variance, mean, out=np.ones_like(mean), where=some)
        low = np.where(some, scale * gammaincinv(mean / scale, tail), mean)
        wide = np.where(spread > 0.0, spread / np.where(upper > 0.0, upper, 1.0), 1.0)
        high = np.where(spread > 0.0, wide * gammainccinv(upper / wide, tail), upper)
        return Estimate(mean, low, high)


def probability(rate: ArrayLike, time: float) -> Array:
    """Return the chance of an event within a time [s] where they occur at a rate [1/s]."""
    return np.asarray(-np.expm1(-np.asarray(rate) * time))
