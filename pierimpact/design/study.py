"""The parametric study behind the design formulas: refits them and says how good they are.

`python -m pierimpact.design.study` draws random collisions of the domain, solves each by
the full model, refits the closed spectrum, and writes the outcome to `study.json` beside this
file. The coefficients in `pierimpact.design.formulas` are those of the file, rounded.
"""

import json
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.groups import select, single
from pierimpact.collision.parameters import Collision, Parameters, Spring, in_chunks
from pierimpact.collision.regimes import STEEP, LinearMotion, State
from pierimpact.collision.stepping import propagate, propagate_all
from pierimpact.design import domain, formulas
from pierimpact.design.procedure import LEVELS, design_values
from pierimpact.design.reduction import exact_amplification
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.vehicle.truck import Truck

Array = NDArray[np.float64]
Summary = dict[str, float]

SIZE, SEED = 6000, 20170101
#: So many of the collisions are also simulated one by one, for the speeds at contact.
FOLLOWED = 1000
#: So many collisions are in the file one by one, so that anyone sees whether it is up to date.
SHOWN = 20
OUTCOME_FILE = Path(__file__).with_name("study.json")
#: Arguments of the closed spectrum that are fitted, and the values in use.
COEFFICIENTS = {
    "height": formulas.HUMP,
    "end": formulas.HUMP_END,
    "decline": formulas.HUMP_DECLINE,
    "mass_effect": formulas.MASS_EFFECT,
    "damping_effect": formulas.DAMPING_EFFECT,
}
#: Limits of the frequency bands that are reported apart [Hz].
BANDS = (5.0, 7.0, 10.0, 15.0, 20.0, 40.0, 80.0, 150.0)
#: An amplification that is too low weighs this much more in the fit than one too high.
PRUDENCE = 2.0


class Reactions(NamedTuple):
    """Engine, cargo and governing reactions, each of shape (n,); cargo is nan without it [N]."""

    engine: Array
    cargo: Array
    governing: Array


def full_model(parameters: Parameters) -> Reactions:
    """Return the peak reactions by the full model."""
    peaks = propagate_all(in_chunks(parameters), len(parameters.speed))
    engine = parameters.pier_stiffness * peaks.engine_peak
    cargo = parameters.pier_stiffness * peaks.cargo_peak
    return Reactions(engine, cargo, np.fmax(engine, cargo))


def predictions(parameters: Parameters, level: str) -> Reactions:
    """Return the same reactions by the design procedure."""
    values = design_values(parameters, level)
    engine, cargo = values["engine"], values["cargo"]
    return Reactions(engine, cargo, np.fmax(engine, cargo))


def with_truck(parameters: Parameters, truck: Truck) -> Parameters:
    """Return the collisions with another truck, the same in each."""
    other = Collision(truck, EquivalentPier(mass=1.0, stiffness=1.0), 1.0).parameters
    same = np.ones_like(parameters.speed)
    return parameters._replace(
        engine=Spring(*(same * x for x in other.engine)),
        body=Spring(*(same * x for x in other.body)),
        friction_force=same * other.friction_force,
        on_pier=np.full(same.shape, other.on_pier),
    )


def summary(ratios: Array) -> Summary:
    """Return what is reported of predicted over CMSD reactions; pairs with a nan are left out."""
    ratios = ratios[np.isfinite(ratios)]
    if not len(ratios):
        return {"cases": 0}
    return {
        "cases": len(ratios),
        "mean": float(ratios.mean()),
        "coefficient of variation": float(ratios.std() / ratios.mean()),
        "1st percentile": float(np.quantile(ratios, 0.01)),
        "smallest": float(ratios.min()),
        "99th percentile": float(np.quantile(ratios, 0.99)),
        "largest": float(ratios.max()),
    }


def assessment(
    parameters: Parameters, exact: Reactions, predicted: Reactions
) -> dict[str, dict[str, Summary]]:
    """Return summaries of predicted over CMSD by reaction and frequency band."""
    frequency = domain.values(parameters)["pier frequency"]
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
        found[level] = {}
        for body, speed in zip(("engine", "cargo"), exact, strict=True):
            error = (values[f"{body}_speed"] - speed) / parameters.speed
            error = error[np.isfinite(error)]
            found[level][body] = {
                "cases": len(error),
                "mean": float(error.mean()),
                "standard deviation": float(error.std()),
                "smallest": float(error.min()),
                "largest": float(error.max()),
            }
    return found


def spectrum_arguments(parameters: Parameters) -> tuple[Array, Array, Array, Array]:
    """Return β, μ, e and ζ of every engine, followed by those of every cargo."""
    values = design_values(parameters, "hand")
    beta, mu, e = (
        np.concatenate([values[f"{body}_{name}"] for body in ("engine", "cargo")])
        for name in ("beta", "mu", "e")
    )
    return beta, mu, e, np.tile(values["zeta"], 2)


def fit(arguments: tuple[Array, Array, Array, Array], exact: Array) -> dict[str, float]:
    """Return the coefficients of the closed spectrum that fit the exact amplification best."""
    from scipy.optimize import least_squares

    beta, mu, e, zeta = arguments

    def residual(coefficients: Array) -> Array:
        named = dict(zip(COEFFICIENTS, coefficients, strict=True))
        closed = formulas.joined(beta, mu, e, formulas.hump(beta, mu, zeta, **named))
        error = np.log(closed / exact)
        return np.asarray(np.where(error < 0.0, PRUDENCE * error, error))

    found = least_squares(residual, list(COEFFICIENTS.values())).x
    return {name: float(value) for name, value in zip(COEFFICIENTS, found, strict=True)}


def study(size: int = SIZE, seed: int = SEED) -> dict[str, Any]:
    """Run the study and return what goes into the file."""
    parameters = domain.sample(size, seed)
    arguments = spectrum_arguments(parameters)
    exact = exact_amplification(*arguments)
    closed = formulas.amplification(*arguments)
    reactions = full_model(parameters)
    return {
        "seed": seed,
        "size": size,
        "domain": {
            name: f"{low:g} to {high:g} {unit}"
            for name, (low, high, unit, _) in domain.DOMAIN.items()
        },
        "fitted": fit(arguments, exact),
        "used": COEFFICIENTS,
        "closed over exact amplification": {
            "engine": summary(closed[:size] / exact[:size]),
            "cargo": summary(closed[size:] / exact[size:]),
        },
        "predicted over CMSD": {
            level: assessment(parameters, reactions, predictions(parameters, level))
            for level in LEVELS
        },
        "governing of the first cases, predicted over CMSD": {
            level: (predictions(parameters, level).governing / reactions.governing)[:SHOWN].tolist()
            for level in LEVELS
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
