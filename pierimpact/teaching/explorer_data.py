"""The data of the explorers: what they show, computed from one collision."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.design.band import one_at_a_time
from pierimpact.design.codes import code_forces
from pierimpact.design.procedure import LEVELS, amplification, design_values
from pierimpact.design.reduction import exact_amplification
from pierimpact.pier.column import PierColumn
from pierimpact.plots.style import BODIES
from pierimpact.symbols import BY_KEY
from pierimpact.teaching.scenario import SPRING, Scenario
from pierimpact.vehicle.spread import Uniform

Array = NDArray[np.float64]

#: Frequency ratios of the amplification: those of all piers, for engine and cargo alike [-].
RATIOS = np.geomspace(0.02, 50.0, 141)
#: How far each parameter is moved, as in the parametric study [-].
CHANGE = 0.3
#: The parameters whose influence is shown, from above.
PARAMETERS = (
    *(BY_KEY[f"{spring}.{name}"] for spring in ("engine_spring", "body_spring") for name in SPRING),
    *(BY_KEY[name] for name in ("engine_mass", "body_mass", "friction_force")),
)


class Amplification(NamedTuple):
    """The amplification S of one body, each array of shape (n,) over the frequency ratio [-].

    Parameters
    ----------
    ratio : ndarray
        Frequency ratios β.
    impulse, static : ndarray
        The limits of S for a soft pier, without damping, and for a stiff one.
    closed, exact : ndarray
        S by the closed form, and of the two-degree-of-freedom system.
    """

    ratio: Array
    impulse: Array
    static: Array
    closed: Array
    exact: Array


class Bar(NamedTuple):
    """One force; `value` is None where there is none [N]."""

    name: str
    value: float | None
    style: str  #: of the bar, by what it is of
    remark: str


class ByHeight(NamedTuple):
    """Equivalent stiffness [N/m] and mass [kg] of a column, each of shape (n,) over height [m]."""

    height: Array
    stiffness: Array
    mass: Array


@lru_cache(maxsize=4)
def by_height(column: PierColumn) -> ByHeight:
    """Return a column's stiffness and mass against the impact height."""
    heights = np.linspace(0.04, 0.96, 47) * column.height
    along = [column.struck_at(float(height)) for height in heights]
    stiffness, mass = np.array([(struck.stiffness, struck.mass) for struck in along]).T
    return ByHeight(heights, stiffness, mass)


def short_procedure(scenario: Scenario) -> dict[str, float]:
    """Return the short level's values, with the exact amplification of either body."""
    parameters = scenario.collision.parameters
    closed = design_values(parameters, "short")
    names = [[f"{name}{i}" for i in (1, 2)] for name in ("beta", "mu", "e")]
    beta, mu, e = ([float(closed[name]) for name in pair] for pair in names)
    exact = exact_amplification(beta, mu, e, scenario.pier.damping_ratio)
    known = dict(zip(beta, exact.tolist(), strict=True))
    values = design_values(parameters, "short", lambda b, *_: known[float(b)])
    return {name: float(value) for name, value in values.items()}


@lru_cache(maxsize=8)
def amplifications(
    mu: tuple[float, float], e: tuple[float, float], damping_ratio: float
) -> dict[str, Amplification]:
    """Return the amplification of engine and cargo against the frequency ratio.

    Parameters
    ----------
    mu, e : tuple of float
        Mass ratio and restitution of engine and cargo [-].
    damping_ratio : float
        Of the pier [-].
    """
    ratios, restitutions = np.array([mu, e])[:, :, None]
    exact = exact_amplification(RATIOS, ratios, restitutions, damping_ratio)
    return {
        body: Amplification(
            ratio=RATIOS,
            exact=exact[row],
            closed=amplification(RATIOS, mu[row], e[row], damping_ratio),
            impulse=(1.0 + e[row]) * RATIOS / (1.0 + mu[row]),
            static=1.0 / np.sqrt(1.0 + mu[row] / RATIOS**2),
        )
        for row, body in enumerate(BODIES)
    }


def bars(scenario: Scenario) -> list[Bar]:
    """Return the forces of full model, design procedure and codes."""
    found = [
        Bar(f"Full model, {body}", None if peak is None else peak.reaction, body, "")
        for body, peak in scenario.history.peaks.items()
    ]
    for level in LEVELS:
        reaction = scenario.design(level).reaction
        remark = f"{reaction / scenario.history.governing_peak.reaction:.2f} × full model"
        found.append(Bar(f"Design procedure, {level}", reaction, "design", remark))
    for code in code_forces(scenario.speed, scenario.truck.mass):
        found.append(Bar(code.code, code.along.value, "code", code.along.remark))
    return found


def influences(scenario: Scenario) -> dict[str, Array | None]:
    """Return the relative change of each peak with every one of PARAMETERS.

    Returns
    -------
    dict of str to ndarray, shape (n, 2), or None
        For "engine" and "cargo": the change with the parameter smaller and larger, nan where the
        peak is gone [-]; None where there is no such peak to begin with.
    """
    spreads = dict.fromkeys([symbol.key for symbol in PARAMETERS], Uniform.about(CHANGE))
    changed = one_at_a_time(scenario.collision, spreads)
    return {
        body: None if peak is None else getattr(changed, body) / peak.reaction - 1.0
        for body, peak in scenario.history.peaks.items()
    }
