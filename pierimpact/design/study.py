"""The parametric study behind the design formulas: refits them and says how good they are.

`python -m pierimpact.design.study` draws random collisions of the domain, solves each by
the full model, refits the closed spectrum, and writes the outcome to `study.json` beside this
file. The coefficients in `pierimpact.design.procedure` are those of the file, rounded.
"""

import json
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.groups import select, single
from pierimpact.collision.parameters import Collision, Parameters, Spring
from pierimpact.collision.propagation import propagate
from pierimpact.collision.reactions import Reactions, full_model
from pierimpact.collision.regimes import STEEP, LinearMotion, State
from pierimpact.design import domain, procedure
from pierimpact.design.procedure import LEVELS, design_values
from pierimpact.design.reaction import predictions
from pierimpact.design.reduction import exact_amplification
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.symbols import SYMBOLS
from pierimpact.vehicle.truck import Truck

Array = NDArray[np.float64]
Summary = dict[str, float]
Statistics = Mapping[str, Callable[[Array], Any]]

SIZE, SEED = 6000, 20170101
#: So many of the cases are also followed one by one, for the speeds at contact.
FOLLOWED = 1000
#: So many cases are in the file one by one, so that anyone sees whether it is up to date.
SHOWN = 20
OUTCOME_FILE = Path(__file__).with_name("study.json")
#: Arguments of the closed spectrum that are fitted, and the values in use.
COEFFICIENTS = {
    "height": procedure.RESONANCE,
    "end": procedure.RESONANCE_END,
    "decline": procedure.RESONANCE_DECLINE,
    "mass_effect": procedure.MASS_EFFECT,
    "damping_effect": procedure.DAMPING_EFFECT,
}
#: Limits of the frequency bands that are reported apart, this project's choice [Hz].
BANDS = (5.0, 7.0, 10.0, 15.0, 20.0, 40.0, 80.0, 150.0)
#: An amplification that is too low weighs this much more in the fit than one too high: this
#: project's choice.
PRUDENCE = 2.0


def with_truck(parameters: Parameters, truck: Truck) -> Parameters:
    """Return the collisions with another truck, the same in each."""
    own = Collision(truck, EquivalentPier(mass=1.0, stiffness=1.0), 1.0).parameters
    same = np.ones_like(parameters.speed)
    return parameters._replace(
        engine=Spring(*(same * x for x in own.engine)),
        body=Spring(*(same * x for x in own.body)),
        friction_force=same * own.friction_force,
        on_pier=np.full(same.shape, own.on_pier),
    )


#: What is reported of predicted over CMSD reactions, this project's choice.
RATIO_STATISTICS: Statistics = {
    "mean": np.mean,
    "coefficient of variation": lambda ratios: ratios.std() / ratios.mean(),
    "1st percentile": lambda ratios: np.quantile(ratios, 0.01),
    "smallest": np.min,
    "99th percentile": lambda ratios: np.quantile(ratios, 0.99),
    "largest": np.max,
}
#: What is reported of errors, which are zero on average if all is well.
ERROR_STATISTICS: Statistics = {
    "mean": np.mean,
    "standard deviation": np.std,
    "smallest": np.min,
    "largest": np.max,
}


def summary(values: Array, statistics: Statistics = RATIO_STATISTICS) -> Summary:
    """Return the number of values and, if there are any, their statistics; nan is left out."""
    values = values[np.isfinite(values)]
    found = {name: float(of(values)) for name, of in statistics.items()} if len(values) else {}
    return {"cases": len(values)} | found


def assessment(
    parameters: Parameters, exact: Reactions, predicted: Reactions
) -> dict[str, dict[str, Summary]]:
    """Return summaries of predicted over CMSD by reaction and frequency band."""
    frequency = domain.values(parameters)["fp"]
    found: dict[str, dict[str, Summary]] = {}
    for which in Reactions._fields:
        ratios = getattr(predicted, which) / getattr(exact, which)
        found[which] = {"all": summary(ratios)} | {
            f"{low:g}–{high:g} Hz": summary(ratios[(frequency >= low) & (frequency < high)])
            for low, high in pairwise(BANDS)
        }
    return found


def contact_speeds(parameters: Parameters) -> tuple[Array, Array]:
    """Return the speeds of engine and cargo as they meet the pier by the full model.

    Over the road, each of shape (n,); nan where the body does not meet the pier [m/s].
    """
    speeds = np.full((2, len(parameters.speed)), np.nan)
    for i in range(len(parameters.speed)):
        found = speeds[:, i]

        def record(state: State, motion: LinearMotion, h: float, found: Array = found) -> None:
            position = state.position
            if np.isnan(found[0]) and state.engine.regime == STEEP:
                found[0] = position.u1 + position.vp
            if np.isnan(found[1]) and state.body.regime == STEEP:
                found[1] = position.u2 + position.vp

        propagate(single(parameters, i), record=record)
    return speeds[0], speeds[1]


def speed_errors(parameters: Parameters) -> dict[str, dict[str, Summary]]:
    """Return how far contact speeds are off by level and body, over the speed of the truck.

    Where the body meets the pier by the full model.
    """
    exact = contact_speeds(parameters)
    found: dict[str, dict[str, Summary]] = {}
    for level in LEVELS:
        values = design_values(parameters, level)
        found[level] = {
            body: summary((values[name] - speed) / parameters.speed, ERROR_STATISTICS)
            for name, body, speed in zip(("v1", "v2"), ("engine", "cargo"), exact, strict=True)
        }
    return found


def spectrum_arguments(parameters: Parameters) -> tuple[Array, Array, Array, Array]:
    """Return β, μ, e and ζ of every engine, followed by those of every cargo."""
    values = design_values(parameters)
    beta, mu, e, zeta = (
        np.concatenate([values[name.format(i)] for i in (1, 2)])
        for name in ("beta{}", "mu{}", "e{}", "zeta")
    )
    return beta, mu, e, zeta


def fit(arguments: tuple[Array, Array, Array, Array], exact: Array) -> dict[str, float]:
    """Return the coefficients of the closed spectrum that fit the exact amplification best."""
    from scipy.optimize import least_squares

    beta, mu, e, zeta = arguments

    def residual(coefficients: Array) -> Array:
        named = dict(zip(COEFFICIENTS, coefficients, strict=True))
        closed = procedure.combined(beta, mu, e, procedure.resonance(beta, mu, zeta, **named))
        error = np.log(closed / exact)
        return np.asarray(np.where(error < 0.0, PRUDENCE * error, error))

    found = least_squares(residual, list(COEFFICIENTS.values())).x
    return {name: float(value) for name, value in zip(COEFFICIENTS, found, strict=True)}


def amplification_ratios(parameters: Parameters) -> dict[str, Summary]:
    """Return summaries of the closed over the exact amplification by body."""
    arguments = spectrum_arguments(parameters)
    ratios = procedure.amplification(*arguments) / exact_amplification(*arguments)
    engine, cargo = np.split(ratios, 2)
    return {"engine": summary(engine), "cargo": summary(cargo)}


def study(size: int = SIZE, seed: int = SEED) -> dict[str, Any]:
    """Run the study and return what goes into the file."""
    parameters = domain.sample(size, seed)
    arguments = spectrum_arguments(parameters)
    exact = full_model(parameters)
    predicted = {level: predictions(parameters, level) for level in LEVELS}
    return {
        "seed": seed,
        "size": size,
        "domain": {
            SYMBOLS[name].meaning: f"{low:g} to {high:g} {unit}"
            for name, (low, high, unit, _) in domain.DOMAIN.items()
        },
        "fitted": fit(arguments, exact_amplification(*arguments)),
        "used": COEFFICIENTS,
        "closed over exact amplification": amplification_ratios(parameters),
        "predicted over CMSD": {
            level: assessment(parameters, exact, found) for level, found in predicted.items()
        },
        "governing of the first cases, predicted over CMSD": {
            level: (found.governing / exact.governing)[:SHOWN].tolist()
            for level, found in predicted.items()
        },
        "error of the contact speed over the truck's": speed_errors(
            select(parameters, slice(0, FOLLOWED))
        ),
    }


def main(report: Callable[[str], None] = print) -> None:
    """Run the study and write its file."""
    outcome = study()
    OUTCOME_FILE.write_text(
        json.dumps(outcome, indent=1, ensure_ascii=False) + "\n", encoding="utf-8"
    )
    for level, reactions in outcome["predicted over CMSD"].items():
        for which, bands in reactions.items():
            row = ", ".join(f"{name} {value:.4g}" for name, value in bands["all"].items())
            report(f"{level} {which}: {row}")


if __name__ == "__main__":
    main()
