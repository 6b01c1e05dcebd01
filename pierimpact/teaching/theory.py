"""What the explorers of the ideas behind the model show, computed from a scenario."""

from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.simulate import peak_reactions
from pierimpact.design.codes import code_forces
from pierimpact.design.procedure import LEVELS, amplification, design_values
from pierimpact.design.reduction import exact_amplification
from pierimpact.pier.column import PierColumn
from pierimpact.plots.amplification import Amplification
from pierimpact.plots.comparison import Bar
from pierimpact.plots.style import BODIES, GREEN, GREY
from pierimpact.teaching.scenario import Scenario
from pierimpact.vehicle.crush import CrushSpring

Array = NDArray[np.float64]

#: Frequency ratios of the amplification: those of all piers, for engine and cargo alike [-].
RATIOS = np.geomspace(0.02, 50.0, 141)
#: How far each parameter is moved, as in the parametric study [-].
CHANGE = 0.3
_SPRING = {
    "plateau_force": "plateau force $P$",
    "plateau_length": "plateau length $d$",
    "stiffness": "steep stiffness $k$",
    "unloading_stiffness": "unloading stiffness $k_\\mathrm{u}$",
}
_REST = {
    "engine_mass": "Engine mass $m_1$",
    "body_mass": "Body mass $m_2$",
    "friction_force": "Friction $c_\\mathrm{s}$",
}
#: The parameters whose influence is shown, from above.
PARAMETERS = (
    *(f"{body}: {words}" for body in ("Engine", "Body") for words in _SPRING.values()),
    *_REST.values(),
)


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
    return ByHeight(
        heights,
        np.array([struck.stiffness for struck in along]),
        np.array([struck.mass for struck in along]),
    )


def by_hand(scenario: Scenario) -> dict[str, float]:
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
            impulse=(1.0 + e[row]) * RATIOS,
            static=1.0 / np.sqrt(1.0 + mu[row] / RATIOS**2),
        )
        for row, body in enumerate(BODIES)
    }


def bars(scenario: Scenario) -> list[Bar]:
    """Return the forces of full model, design procedure and codes."""
    history = scenario.history
    peaks = {"engine": history.engine_peak, "cargo": history.cargo_peak}
    found = [
        Bar(f"Full model, {body}", None if peak is None else peak.reaction, BODIES[body], "")
        for body, peak in peaks.items()
    ]
    for level in LEVELS:
        reaction = scenario.design(level).reaction
        ratio = reaction / history.governing_peak.reaction
        remark = f"{ratio:.2f} of the full model"
        found.append(Bar(f"Design procedure, {level}", reaction, GREEN, remark))
    for code in code_forces(scenario.speed, scenario.truck.mass):
        found.append(Bar(code.code, code.along.value, GREY, code.along.remark))
    return found


def influences(scenario: Scenario) -> dict[str, Array | None]:
    """Return the relative change of each peak with every one of PARAMETERS.

    Returns
    -------
    dict of str to ndarray, shape (n, 2), or None
        For "engine" and "cargo": the change with the parameter smaller and larger, nan where the
        peak is gone [-]; None where there is no such peak to begin with.
    """
    truck = scenario.truck
    factors = (1.0 - CHANGE, 1.0 + CHANGE)
    trucks = [
        replace(truck, **{spring: _changed(getattr(truck, spring), name, factor)})  # type: ignore[arg-type]
        for spring in ("engine_spring", "body_spring")
        for name in _SPRING
        for factor in factors
    ]
    trucks += [
        replace(truck, **{name: factor * getattr(truck, name)})
        for name in _REST
        for factor in factors
    ]
    pier, history = scenario.pier, scenario.history
    peaks = peak_reactions(trucks, pier.mass, pier.stiffness, pier.damping_ratio, scenario.speed)
    before = {"engine": history.engine_peak, "cargo": history.cargo_peak}
    return {
        body: None if peak is None else getattr(peaks, body).reshape(-1, 2) / peak.reaction - 1.0
        for body, peak in before.items()
    }


def _changed(spring: CrushSpring, name: str, factor: float) -> CrushSpring:
    """Return the spring with one value changed, and k_u raised where it would be below k."""
    values = {field: getattr(spring, field) for field in CrushSpring.__dataclass_fields__}
    values[name] *= factor
    values["unloading_stiffness"] = max(
        values["unloading_stiffness"],
        values["stiffness"],
        values["plateau_force"] / values["plateau_length"],
    )
    return CrushSpring(**values)
