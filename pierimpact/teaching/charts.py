"""The charts that Python calculates for explorers, as `templates/page/figures.mjs` draws them."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pierimpact.plots.style import BODIES, round_out, round_up
from pierimpact.symbols import Symbol
from pierimpact.teaching import explorer_data
from pierimpact.teaching.readouts import force
from pierimpact.teaching.scenario import Scenario

Array = NDArray[np.float64]
Chart = dict[str, Any]

# What depends on the impact height: its heading, and the unit shown with its size in SI.
_ALONG = {
    "stiffness": ("Stiffness kₚ (Eq. 3)", "MN/m", 1e6),
    "mass": ("Mass mₚ (Eq. 1)", "t", 1e3),
}
_LINES = ("impulse", "static", "closed form", "exact")


def pier(scenario: Scenario) -> list[Chart]:
    """Return the shape function, and stiffness and mass against the impact height."""
    column = scenario.column
    struck, along = column.struck_at(scenario.impact_height), explorer_data.by_height(column)
    z = np.union1d(np.linspace(0.0, column.height, 81), struck.impact_height)
    shape = struck.shape(z)
    lowest, highest = float(shape.min()), max(float(shape.max()), float((shape**2).max()))
    tall = float(math.ceil(column.height))
    charts: list[Chart] = [
        {
            "kind": "lines",
            "title": "Shape function",
            "x": _axis("φ, φ² [-]", -round_up(-1.05 * lowest) if lowest < -1e-9 else 0.0,
                       round_up(1.05 * highest)),
            "y": _axis("Height z [m]", 0.0, tall),
            "curves": [
                _curve("", "square", shape**2, z) | {"filled": True},
                _curve("φ²", "square", [], []),
                _curve("φ", "shape", shape, z),
            ],
            "level": {"y": struck.impact_height, "words": "impact height"},
        }
    ]  # fmt: skip
    here = {"stiffness": struck.stiffness, "mass": struck.mass}
    for name, (title, unit, size) in _ALONG.items():
        values, value = getattr(along, name) / size, here[name] / size
        # Next to a support the stiffness has no bound: the curve is cut off above.
        top = round_up(min(1.05 * float(values.max()), 4.0 * value))
        charts.append(
            {
                "kind": "lines",
                "title": title,
                "x": _axis("Impact height zₙ [m]", 0.0, tall),
                "y": _axis(f"{name.capitalize()} [{unit}]", 0.0, top),
                "curves": [_curve("", "shape", along.height, values)],
                "here": _here(struck.impact_height, value, f"{value:.3g} {unit}", "shape"),
            }
        )
    return charts


def amplification(scenario: Scenario, values: dict[str, float]) -> list[Chart]:
    """Return the amplification of either body against the frequency ratio, with its limits.

    Parameters
    ----------
    scenario : Scenario
        The collision.
    values : dict of str to float
        Its `explorer_data.short_procedure`.
    """
    mu, e = ((values[f"{name}1"], values[f"{name}2"]) for name in ("mu", "e"))
    found = explorer_data.amplifications(mu, e, scenario.damping_ratio)
    charts = []
    for i, body in enumerate(BODIES, 1):
        curves, ratio, here = found[body], values[f"beta{i}"], values[f"S{i}"]
        low, high = round_out(float(curves.ratio[0]), float(curves.ratio[-1]), ratio)
        top = round_up(1.2 * max(float(curves.exact.max()), here))
        styles = ("impulse", "static", "formula", body)
        charts.append(
            {
                "kind": "lines",
                "title": body.capitalize(),
                "x": _axis("Frequency ratio β = fₚ / fᵢ [-]", low, high) | {"log": True},
                "y": _axis("Amplification S [-]", 0.0, top),
                "curves": [
                    _curve(name, style, curves.ratio, line)
                    for name, style, line in zip(_LINES, styles, curves[1:], strict=True)
                ],
                "here": _here(ratio, here, f"S = {here:.3f}", body),
            }
        )
    return charts


def reactions(scenario: Scenario) -> list[Chart]:
    """Return the reactions and the forces of codes side by side."""
    bars = explorer_data.bars(scenario)
    rows = []
    for bar in bars:
        words = force(bar.value)
        rows.append(
            {
                "name": bar.name,
                "bars": [_bar(None if bar.value is None else 1e-6 * bar.value, bar.style)],
                "words": f"{words}: {bar.remark}" if bar.remark else words,
            }
        )
    axis = _axis("Force [MN]", 0.0, 1e-6 * round_up(max(bar.value or 0.0 for bar in bars)))
    return [{"kind": "bars", "title": "", "x": axis, "rows": rows}]


def influences(changes: dict[str, Array | None]) -> list[Chart]:
    """Return what each parameter of the truck does to either peak, as bars to both sides.

    Parameters
    ----------
    changes : dict of str to ndarray, or None
        As `explorer_data.influences` returns them.
    """
    share = f"{explorer_data.CHANGE:.0%}"
    signs = {"smaller": f"−{share}", "larger": f"+{share}"}
    charts = []
    for body, change in changes.items():
        rows = change if change is not None else np.full((len(explorer_data.PARAMETERS), 2), np.nan)
        widest = round_up(max(0.1, 1.05 * float(np.nanmax(np.abs(rows), initial=0.0))))
        charts.append(
            {
                "kind": "bars",
                "title": f"{body.capitalize()} peak",
                "x": _axis("Change of the peak", -100.0 * widest, 100.0 * widest) | {"unit": " %"},
                "key": [{"name": words, "style": style} for style, words in signs.items()],
                "rows": [
                    {
                        "name": _short_name(symbol),
                        "bars": [
                            _bar(100.0 * value, style)
                            for style, value in zip(signs, row.tolist(), strict=True)
                        ],
                        "words": "" if change is None or np.isfinite(row).all() else "no peak",
                    }
                    for symbol, row in zip(explorer_data.PARAMETERS, rows, strict=True)
                ],
                "empty": f"The {body} does not reach the pier." if change is None else "",
            }
        )
    return charts


def _short_name(parameter: Symbol) -> str:
    """Return the name of a truck parameter as a chart has room for it."""
    words, of, spring = parameter.meaning.partition(" of the ")
    return f"{spring.removesuffix(' spring')}: {words}" if of else parameter.meaning


def _axis(label: str, low: float, high: float) -> dict[str, Any]:
    return {"label": label, "low": low, "high": high}


def _curve(name: str, style: str, x: Any, y: Any) -> dict[str, Any]:
    return {"name": name, "style": style, "x": _few(x), "y": _few(y)}


def _here(x: float, y: float, words: str, style: str) -> dict[str, Any] | None:
    if math.isnan(x) or math.isnan(y):
        return None
    return {"x": x, "y": y, "words": words, "style": style}


def _bar(value: float | None, style: str) -> dict[str, Any]:
    known = value is not None and math.isfinite(value)
    return {"value": value if known else None, "style": style}


def _few(values: Any) -> list[float | None]:
    """Return values with figures enough for a picture; none where there is no number."""
    return [float(f"{v:.5g}") if math.isfinite(v) else None for v in np.asarray(values).tolist()]
