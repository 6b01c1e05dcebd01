"""The parametric study behind the design formulas: refits them and says how good they are.

`python -m pierimpact.study` draws the random collisions of `pierimpact.domain`, solves each by
the full model, refits the closed spectrum, and writes the outcome to `study.json` beside this
file. The coefficients in `pierimpact.formulas` are those of the file, rounded.
"""

import json
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pierimpact import domain, formulas
from pierimpact.cases import CHUNK
from pierimpact.motion import OUTCOMES, Collision, Spring, follow_all
from pierimpact.procedure import LEVELS, design_values
from pierimpact.reduction import exact_amplification

Array = NDArray[np.float64]

SIZE, SEED = 6000, 20170101
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


def full_model(case: Collision) -> dict[str, Array]:
    """Return engine, cargo and governing peak reactions by the full model [N]."""
    parts = [
        follow_all(take(case, slice(first, first + CHUNK)))
        for first in range(0, len(case.speed), CHUNK)
    ]
    peaks = dict(zip(OUTCOMES, np.concatenate(parts, axis=1), strict=True))
    engine = case.pier_stiffness * peaks["engine_peak"]
    cargo = case.pier_stiffness * peaks["cargo_peak"]
    return {"engine": engine, "cargo": cargo, "governing": np.fmax(engine, cargo)}


def predictions(case: Collision, level: str) -> dict[str, Array]:
    """Return the same reactions by the design procedure [N]."""
    values = design_values(case, level)
    engine, cargo = values["engine"], values["cargo"]
    return {"engine": engine, "cargo": cargo, "governing": np.fmax(engine, cargo)}


def take(case: Collision, part: Any) -> Collision:
    """Return a part of many collisions."""
    return Collision(
        *(
            Spring(*(x[part] for x in item)) if isinstance(item, Spring) else item[part]
            for item in case
        )
    )


def summary(ratios: Array) -> dict[str, float]:
    """Return what is reported of predicted over CMSD reactions; pairs with a nan are left out."""
    ratios = ratios[np.isfinite(ratios)]
    return {
        "cases": len(ratios),
        "mean": float(ratios.mean()),
        "coefficient of variation": float(ratios.std() / ratios.mean()),
        "1st percentile": float(np.quantile(ratios, 0.01)),
        "smallest": float(ratios.min()),
        "99th percentile": float(np.quantile(ratios, 0.99)),
        "largest": float(ratios.max()),
    }


def assessment(case: Collision) -> dict[str, Any]:
    """Return the summaries by level, reaction and frequency band."""
    exact = full_model(case)
    frequency = domain.values(case)["pier frequency"]
    found: dict[str, Any] = {}
    for level in LEVELS:
        predicted = predictions(case, level)
        found[level] = {}
        for which in exact:
            ratios = predicted[which] / exact[which]
            found[level][which] = {"all": summary(ratios)} | {
                f"{low:g}–{high:g} Hz": summary(ratios[(frequency >= low) & (frequency < high)])
                for low, high in pairwise(BANDS)
            }
    return found


def spectrum_arguments(case: Collision) -> tuple[Array, Array, Array, Array]:
    """Return β, μ, e and ζ of every engine, followed by those of every cargo."""
    omega = np.sqrt(case.pier_stiffness / case.pier_mass)
    zeta = domain.values(case)["damping ratio"]
    pairs = [
        (
            omega / np.sqrt(spring.stiffness / spring.mass),
            spring.mass / case.pier_mass,
            np.sqrt(spring.stiffness / spring.unloading_stiffness),
            zeta,
        )
        for spring in (case.engine, case.body)
    ]
    beta, mu, e, zeta = (np.concatenate(pair) for pair in zip(*pairs, strict=True))
    return beta, mu, e, zeta


def fit(arguments: tuple[Array, Array, Array, Array], exact: Array) -> dict[str, float]:
    """Return the coefficients of the closed spectrum that fit the exact amplification best."""
    from scipy.optimize import least_squares

    def residual(coefficients: Array) -> Array:
        named = dict(zip(COEFFICIENTS, coefficients, strict=True))
        error = np.log(formulas.amplification(*arguments, **named) / exact)
        return np.asarray(np.where(error < 0.0, PRUDENCE * error, error))

    found = least_squares(residual, list(COEFFICIENTS.values())).x
    return {name: float(value) for name, value in zip(COEFFICIENTS, found, strict=True)}


def study(size: int = SIZE, seed: int = SEED) -> dict[str, Any]:
    """Run the study and return what goes into the file."""
    case = domain.sample(size, seed)
    arguments = spectrum_arguments(case)
    exact = exact_amplification(*arguments)
    closed = formulas.amplification(*arguments)
    return {
        "seed": seed,
        "size": size,
        "domain": {name: list(bounds) for name, bounds in domain.DOMAIN.items()},
        "fitted": fit(arguments, exact),
        "used": COEFFICIENTS,
        "closed over exact amplification": {
            "engine": summary(closed[:size] / exact[:size]),
            "cargo": summary(closed[size:] / exact[size:]),
        },
        "predicted over CMSD": assessment(case),
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
