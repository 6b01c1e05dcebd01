"""Distributions as a case file has them: "lognorm(s=0.5, scale=18 t)", "… from 3.5 t to 60 t"."""

import math
import re
import warnings
from collections.abc import Mapping
from typing import Any

from pierimpact.checks import InputError, brief, did_you_mean
from pierimpact.files.csv_lines import decimal
from pierimpact.risk.distributions import Distribution
from pierimpact.risk.laws import Lognormal, Normal
from pierimpact.units import parse

_LAW = re.compile(
    r"\s*(\w+)\s*\(([^()]*)\)\s*(?:from\s+(\S.*?))??\s*(?:to\s+(\S.*?))?\s*", re.ASCII
)
_EXAMPLE = "such as lognorm(s=0.5, scale=18 t) or normal(mean=20 t, sd=12 t) from 3.5 t"
# Laws by mean and standard deviation, which SciPy has by other parameters.
_BY_MEAN = ("lognormal", "normal")


def parse_distribution(
    name: str, text: str, dimension: str, bounds: tuple[float, float] = (0.0, math.inf)
) -> Distribution:
    """Return the distribution that a text names, in SI units.

    It is a continuous one of `scipy.stats` with its parameters by name, loc and scale with a unit;
    or normal or lognormal with mean and sd. After it may stand from where, and to where, it is
    truncated.

    Parameters
    ----------
    name : str
        What the distribution is for, to be named in errors.
    text : str
        The text.
    dimension : str
        What its values must be, one of `units.DIMENSIONS`.
    bounds : tuple of float, optional
        What values there can be [SI].

    Raises
    ------
    InputError
        When it is none, a parameter is missing or unknown, or it gives values beyond the bounds and
        is not truncated.
    """
    match = _LAW.fullmatch(text)
    if match is None:
        raise InputError(f"{name} must be a distribution, {_EXAMPLE}, got {brief(text)}")
    law = match[1]
    given = _parameters(name, match[2])
    low, high = (
        None if end is None else parse(name, end, dimension) for end in (match[3], match[4])
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of SciPy, about what is refused below
        frozen = (_by_mean if law in _BY_MEAN else _of_scipy)(name, law, given, dimension)
        try:
            return Distribution(
                law=frozen,
                words=" ".join(text.split()),
                status=None,
                low=-math.inf if low is None else low,
                high=math.inf if high is None else high,
                bounds=bounds,
            )
        except InputError as error:
            raise InputError(f"{name} {error}") from None


def _parameters(name: str, text: str) -> dict[str, str]:
    """Return the parameters of a law as they are typed."""
    given: dict[str, str] = {}
    for part in filter(str.strip, text.split(",")):
        key, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals or not key or not value:
            raise InputError(f"{name} must name its parameters, {_EXAMPLE}, got {brief(part)}")
        if key in given:
            raise InputError(f"{name}: {key} is given twice")
        given[key] = value
    return given


def _by_mean(name: str, law: str, given: Mapping[str, str], dimension: str) -> Any:
    _refuse_others(name, law, given, ("mean", "sd"), ())
    mean, deviation = (parse(f"{name}: {key}", given[key], dimension) for key in ("mean", "sd"))
    if not deviation > 0.0 or (law == "lognormal" and not mean > 0.0):
        raise InputError(f"{name}: mean and sd must be positive, got {brief(dict(given))}")
    if law == "normal":
        return Normal(mean, deviation)
    found = Lognormal.of(mean, deviation)
    if not found.logarithm.deviation > 0.0:
        raise InputError(f"{name}: sd must not vanish beside mean, got {brief(dict(given))}")
    return found


def _of_scipy(name: str, law: str, given: Mapping[str, str], dimension: str) -> Any:
    from scipy import stats

    found = getattr(stats, law, None)
    if not isinstance(found, stats.rv_continuous):
        names = [
            each for each in dir(stats) if isinstance(getattr(stats, each), stats.rv_continuous)
        ]
        raise InputError(
            f"{name}: {brief(law)} is no continuous distribution of scipy.stats"
            f"{did_you_mean(law, [*names, *_BY_MEAN])}"
        )
    shapes = tuple(shape.strip() for shape in (found.shapes or "").split(",") if shape.strip())
    _refuse_others(name, law, given, (*shapes, "scale"), ("loc",))
    values = {
        key: parse(f"{name}: {key}", value, dimension)
        if key in ("loc", "scale")
        else float(decimal(f"{name}: {key}", value))
        for key, value in given.items()
    }
    if not values["scale"] > 0.0:
        raise InputError(f"{name}: scale must be positive, got {brief(given['scale'])}")
    frozen = found(**values)
    if any(math.isnan(float(x)) for x in (frozen.cdf(0.0), frozen.cdf(1.0))):
        raise InputError(
            f"{name} has parameters that {law} does not take, got {brief(dict(given))}"
        )
    if math.isnan(float(frozen.mean())):
        raise InputError(f"{name} must have a mean, which {law} has not, got {brief(dict(given))}")
    return frozen


def _refuse_others(
    name: str, law: str, given: Mapping[str, str], needed: tuple[str, ...], more: tuple[str, ...]
) -> None:
    for key in needed:
        if key not in given:
            raise InputError(f"{name}: {law} needs {', '.join(needed)}, and {key} is missing")
    for key in given:
        if key not in (*needed, *more):
            hint = did_you_mean(key, (*needed, *more))
            raise InputError(f"{name}: {brief(key)} is no parameter of {law}{hint}")
