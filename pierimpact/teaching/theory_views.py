"""Figures of the ideas behind the model: shape function, amplification, design, sensitivity."""

import html
import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pierimpact.cases import collision
from pierimpact.codes import code_forces
from pierimpact.collision import peak_reactions
from pierimpact.crush import CrushSpring
from pierimpact.design.formulas import amplification
from pierimpact.design.procedure import LEVELS, design_values
from pierimpact.design.reaction import design_reaction
from pierimpact.reduction import exact_amplification
from pierimpact.teaching import views
from pierimpact.teaching.chart import (
    GREEN,
    GREY,
    INK,
    ORANGE,
    PALE,
    SKY,
    VERMILION,
    Panel,
    canvas,
    figure,
    text,
    ticks,
)
from pierimpact.teaching.scenario import FREQUENCIES, Scenario, Strike, body_frequency
from pierimpact.units import printed

#: How far each parameter is moved in the sensitivity view, as in the parametric study.
VARIATION = 0.3
_PARAMETERS = {
    "plateau_force": "plateau force P",
    "plateau_length": "plateau length d",
    "stiffness": "steep stiffness k",
    "unloading_stiffness": "unloading stiffness k_u",
}


def shape_figure(scenario: Scenario) -> str:
    """Draw the shape function of a column, and how mass and stiffness depend on the height."""
    column, struck = scenario.column, scenario.column.struck_at(scenario.impact_height)
    z = np.linspace(0.0, column.height, 121)
    shape = struck.shape(z)
    low, high = min(0.0, float(shape.min())), max(1.0, float(shape.max()))
    deflected = Panel(
        title="Shape function",
        x_label="φ (line) and φ² (filled) [-]",
        y_label="Height z [m]",
        x_range=(1.06 * low, 1.06 * max(high, high**2)),
        y_range=(0.0, column.height),
        width=330.0,
        height=430.0,
    )
    square = shape**2
    deflected.fill([0.0, *square, 0.0], [0.0, *z, column.height], "#d5ebe4")
    deflected.line(np.zeros(2), [0.0, column.height], PALE)
    deflected.line(shape, z, GREEN, width=2.6)
    deflected.level(struck.impact_height, VERMILION, "impact height z_n")
    deflected.mark(1.0, struck.impact_height, VERMILION, ring=True)
    heights = np.linspace(0.04, 0.96, 47) * column.height
    along = [column.struck_at(float(height)) for height in heights]
    panels = []
    for title, unit, size, values, value in (
        (
            "Stiffness k_p (Eq. 3)",
            "Stiffness [GN/m]",
            1e-9,
            np.array([at.stiffness for at in along]),
            struck.stiffness,
        ),
        ("Mass m_p (Eq. 1)", "Mass [t]", 1e-3, np.array([at.mass for at in along]), struck.mass),
    ):
        # Next to a support the stiffness has no bound: the curve is cut off above.
        top = views.round_up(size * min(float(values.max()), 4.0 * value))
        panel = Panel(
            title=title,
            x_label="Impact height z_n [m]",
            y_label=unit,
            x_range=(0.0, column.height),
            y_range=(0.0, top),
            height=215.0,
        )
        shown = np.where(size * values <= top, size * values, np.nan)
        panel.upright(struck.impact_height, PALE)
        panel.line(heights, shown, GREEN, width=2.2)
        panel.mark(struck.impact_height, size * value, VERMILION, ring=True)
        panels.append(panel.svg())
    content = (
        deflected.svg()
        + f'<g transform="translate(340 0)">{panels[0]}</g>'
        + f'<g transform="translate(340 215)">{panels[1]}</g>'
    )
    return canvas(740.0, 430.0, content, f"Shape function. {shape_words(scenario)}")


def shape_readout(scenario: Scenario) -> str:
    """Return the numbers of Eqs 1–3 as HTML."""
    column = scenario.column
    pier = scenario.strike.pier
    whole = column.mass_per_length * column.height
    items = [
        ("k_p", printed(pier.stiffness, "stiffness", "SI"), "stiffness, Eq. 3"),
        ("m_p", printed(pier.mass, "mass", "SI"), "equivalent mass, Eq. 1"),
        ("f_p", printed(pier.frequency, "frequency", "SI"), "frequency √(k_p/m_p)/2π"),
        ("Whole column", printed(whole, "mass", "SI"), "mass per length times height"),
    ]
    return views.table_line(items) + views.sentence(shape_words(scenario))


def shape_words(scenario: Scenario) -> str:
    """Say what share of the column takes part."""
    column = scenario.column
    struck = column.struck_at(scenario.impact_height)
    whole = column.mass_per_length * column.height
    shear = struck.shear_deflection / struck.impact_deflection
    return (
        f"The pier moves as if {struck.mass / whole:.0%} of the column’s mass sat at the impact "
        f"height. Shear makes {shear:.0%} of the deflection there, flexure the rest."
    )


def amplification_figure(strike: Strike) -> str:
    """Draw S against β for engine and cargo, with the limits that any formula must meet."""
    rows = []
    values = _by_hand(strike)
    truck, zeta = strike.truck, strike.pier.damping_ratio
    parts = {
        "engine": (truck.engine_mass, truck.engine_spring),
        "cargo": (truck.body_mass, truck.body_spring),
    }
    own = [body_frequency(mass, spring.stiffness) for mass, spring in parts.values()]
    mus = [values[f"{body}_mu"] for body in parts]
    es = [spring.restitution for _, spring in parts.values()]
    curves = _amplifications(*own, *mus, *es, zeta)
    for body, frequency, mu, e, exact in zip(parts, own, mus, es, curves, strict=True):
        colour, beta = views.BODIES[body], values[f"{body}_beta"]
        grid = FREQUENCIES / frequency
        top = views.round_up(1.15 * float(exact.max()))
        low, high = min(grid[0], beta / 1.1), max(grid[-1], beta * 1.1)
        panel = Panel(
            title=f"{body.capitalize()}: μ = {mu:.3g}, e = {e:.2f}",
            x_label="Frequency ratio β = f_p / f_i [-]",
            y_label="Amplification S [-]",
            x_range=(low, high),
            y_range=(0.0, top),
            x_log=True,
            width=740.0,
            height=225.0,
        )
        impulse, static = (1.0 + e) * grid, 1.0 / np.sqrt(1.0 + mu / grid**2)
        panel.line(grid, np.where(impulse <= top, impulse, np.nan), ORANGE, "impulse (1 + e) β",
                   width=1.4)  # fmt: skip
        panel.line(grid, static, GREY, "static", width=1.4)
        panel.line(grid, amplification(grid, mu, e, zeta), INK, "closed form", width=1.2,
                   dash="5 3")  # fmt: skip
        panel.line(grid, exact, colour, "exact", width=2.2)
        panel.upright(beta, PALE)
        s = values[f"{body}_S"]
        panel.mark(beta, s, colour, f"S = {s:.3f}", ring=True, name_on_top=True)
        rows.append([panel])
    return figure(rows, "Amplification of engine and cargo against the frequency ratio.")


def amplification_readout(strike: Strike) -> str:
    """Return the steps from approach speed to reaction beside the full model's, as HTML."""
    values, history = _by_hand(strike), strike.history
    peaks = {"engine": history.engine_peak, "cargo": history.cargo_peak}
    rows = ""
    for body, colour in views.BODIES.items():
        speed, reaction, peak = values[f"{body}_speed"], values[body], peaks[body]
        cells = [
            str(printed(speed, "speed", "SI")),
            f"{values[f'{body}_beta']:.3f}",
            f"{values[f'{body}_S']:.3f}",
            "none" if math.isnan(reaction) else views.force(reaction),
            "none" if peak is None else views.force(peak.reaction),
        ]
        rows += (
            f'<tr><th style="text-align:left;color:{colour};padding:2px 14px 2px 0">{body}</th>'
            + "".join(f'<td style="text-align:right;padding:2px 14px">{c}</td>' for c in cells)
            + "</tr>"
        )
    heads = ("", "approach speed", "β", "S", "two degrees of freedom", "full model")
    head = "".join(
        f'<th style="text-align:right;font-weight:400;color:{GREY};padding:2px 14px">{h}</th>'
        for h in heads
    )
    return f'<table style="border-collapse:collapse;font-size:13px">{head}{rows}</table>'


@lru_cache(maxsize=16)
def _amplifications(
    engine_frequency: float,
    cargo_frequency: float,
    engine_mu: float,
    cargo_mu: float,
    engine_e: float,
    cargo_e: float,
    zeta: float,
) -> NDArray[np.float64]:
    """Return the exact amplification of engine and cargo over the frequencies, shape (2, n)."""
    own = np.array([[engine_frequency], [cargo_frequency]])
    mu, e = np.array([[engine_mu], [cargo_mu]]), np.array([[engine_e], [cargo_e]])
    return exact_amplification(FREQUENCIES / own, mu, e, zeta)


@lru_cache(maxsize=2)
def _by_hand(strike: Strike) -> dict[str, float]:
    """Return the hand procedure's values, with the exact amplification of either body."""
    case = collision(strike.truck, strike.pier, strike.speed)
    closed = design_values(case, "hand")
    names = [[f"{body}_{name}" for body in ("engine", "cargo")] for name in ("beta", "mu", "e")]
    beta, mu, e = ([float(closed[name]) for name in pair] for pair in names)
    exact = exact_amplification(beta, mu, e, strike.pier.damping_ratio)
    known = dict(zip(beta, exact.tolist(), strict=True))
    values = design_values(case, "hand", lambda b, *_: known[float(b)])
    return {name: float(value) for name, value in values.items()}


def design_figure(strike: Strike) -> str:
    """Draw full model, design procedure and code values as bars."""
    history = strike.history
    rows: list[tuple[str, float, str, str]] = []
    for body, peak in (("engine", history.engine_peak), ("cargo", history.cargo_peak)):
        if peak is not None:
            rows.append((f"Full model, {body}", peak.reaction, views.BODIES[body], ""))
    for level in LEVELS:
        design = design_reaction(strike.truck, strike.pier, strike.speed, level)
        ratio = design.reaction / history.governing_peak.reaction
        rows.append(
            (f"Design procedure, {level}", design.reaction, GREEN,
             f"{ratio:.2f} of the full model")
        )  # fmt: skip
    for code in code_forces(strike.speed, strike.truck.mass):
        rows.append((code.code, code.along.value, GREY, code.along.remark))
    return bars(rows, "Reactions and code forces")


def bars(rows: list[tuple[str, float, str, str]], title: str) -> str:
    """Draw named forces [N] as horizontal bars, with a remark each."""
    left, step, width = 190.0, 22.0, 740.0
    scale = (width - left - 190.0) / max(value for _, value, _, _ in rows)
    parts = [f'<rect width="{width:g}" height="{32 + step * len(rows):g}" fill="white"/>']
    parts.append(text(0.0, 15.0, title, INK, 12.5, weight=600))
    for row, (name, value, colour, remark) in enumerate(rows):
        y = 28.0 + step * row
        parts.append(text(left - 8.0, y + 12.0, name, INK, 11.5, "end"))
        parts.append(
            f'<rect x="{left:g}" y="{y:.1f}" width="{scale * value:.1f}" height="15" '
            f'fill="{colour}" fill-opacity="0.85"/>'
        )
        words = f"{views.force(value)}" + (f" — {remark}" if remark else "")
        parts.append(text(left + scale * value + 6.0, y + 12.0, words, INK, 11))
    return canvas(width, 32.0 + step * len(rows), "".join(parts), title)


def design_readout(strike: Strike) -> str:
    """Return what the design procedure found, with its warnings, as HTML."""
    design = design_reaction(strike.truck, strike.pier, strike.speed)
    cargo = "none" if design.cargo is None else views.force(design.cargo)
    items = [
        ("f_p", printed(strike.pier.frequency, "frequency", "SI"), "pier frequency"),
        ("Design, engine", views.force(design.engine), "refined level"),
        ("Design, cargo", cargo, "refined level"),
        ("Design reaction", views.force(design.reaction), f"{design.governs} governs"),
    ]
    warned = "".join(
        f'<div style="color:#8a5300">{html.escape(words)}.</div>' for words in design.warnings
    )
    return views.table_line(items) + warned


def sensitivity_figure(strike: Strike) -> str:
    """Draw what moving each parameter of the truck by ±30 % does to either peak."""
    names, trucks = [], []
    truck = strike.truck
    for body in ("engine", "body"):
        spring = getattr(truck, f"{body}_spring")
        for name, words in _PARAMETERS.items():
            moved = [_moved(spring, name, factor) for factor in (1 - VARIATION, 1 + VARIATION)]
            trucks += [replace(truck, **{f"{body}_spring": s}) for s in moved]  # type: ignore[arg-type]
            names.append(f"{body.capitalize()}: {words}")
    for field, words in (
        ("engine_mass", "Engine mass m₁"),
        ("body_mass", "Body mass m₂"),
        ("friction_force", "Friction c_s"),
    ):
        for factor in (1 - VARIATION, 1 + VARIATION):
            trucks.append(replace(truck, **{field: factor * getattr(truck, field)}))
        names.append(words)
    peaks = peak_reactions(
        trucks,
        strike.pier.mass,
        strike.pier.stiffness,
        strike.pier.damping_ratio,
        strike.speed,
    )
    history = strike.history
    parts, x = [], 0.0
    base = {"engine": history.engine_peak, "cargo": history.cargo_peak}
    for body, left in (("engine", 190.0), ("cargo", 20.0)):
        at, changes = base[body], getattr(peaks, body).reshape(-1, 2)
        width = left + 265.0
        parts.append(f'<g transform="translate({x:g} 0)">')
        parts.append(text(left, 15.0, f"{body.capitalize()} peak", INK, 12.5, weight=600))
        if at is None:
            parts.append(text(left, 60.0, "The cargo does not reach the pier.", GREY, 12))
        else:
            parts.append(_tornado(names if left > 100.0 else [], changes / at.reaction, left))
        parts.append("</g>")
        x += width
    height = 76.0 + 22.0 * len(names)
    return canvas(
        x + 10.0,
        height,
        f'<rect width="{x + 10:g}" height="{height:g}" fill="white"/>' + "".join(parts),
        "Change of either peak when a parameter of the truck changes by 30 %.",
    )


def _tornado(names: list[str], ratios: np.ndarray, left: float) -> str:
    width, step = 250.0, 22.0
    widest = max(0.1, math.ceil(10.5 * float(np.nanmax(np.abs(ratios - 1.0)))) / 10.0)
    scale, middle = 0.5 * width / widest, left + 0.5 * width
    bottom = 26.0 + step * len(ratios)
    parts = [f'<path d="M{middle:g} 24V{bottom + 4:g}" stroke="{INK}"/>']
    for value in ticks(-widest, widest, 5):
        x = middle + scale * value
        words = f"{value:+.0%}".replace("-", "−") if abs(value) > 1e-9 else "0"
        parts.append(f'<path d="M{x:.1f} 24V{bottom:g}" stroke="{PALE}"/>')
        if abs(value) < 0.95 * widest:  # not into the chart beside
            parts.append(text(x, bottom + 18.0, words, GREY, 10.5, "middle"))
    for row, pair in enumerate(ratios):
        y = 28.0 + step * row
        if names:
            parts.append(text(left - 8.0, y + 12.0, names[row], INK, 11.5, "end"))
        for ratio, colour in zip(pair, (SKY, ORANGE), strict=True):
            if not math.isfinite(ratio):
                continue
            change = scale * (ratio - 1.0)
            parts.append(
                f'<rect x="{middle + min(change, 0.0):.1f}" y="{y:g}" width="{abs(change):.1f}" '
                f'height="15" fill="{colour}" fill-opacity="0.8"/>'
            )
    key = bottom + 32.0
    parts.append(f'<rect x="{left:g}" y="{key:g}" width="10" height="9" fill="{SKY}"/>')
    parts.append(text(left + 14.0, key + 8.5, f"parameter −{VARIATION:.0%}", INK, 10.5))
    parts.append(f'<rect x="{left + 120:g}" y="{key:g}" width="10" height="9" fill="{ORANGE}"/>')
    parts.append(text(left + 134.0, key + 8.5, f"parameter +{VARIATION:.0%}", INK, 10.5))
    return "".join(parts)


def _moved(spring: CrushSpring, name: str, factor: float) -> CrushSpring:
    """Return the spring with one value changed, and k_u raised where it would be below k."""
    values = {field: getattr(spring, field) for field in CrushSpring.__dataclass_fields__}
    values[name] *= factor
    values["unloading_stiffness"] = max(
        values["unloading_stiffness"],
        values["stiffness"],
        values["plateau_force"] / values["plateau_length"],
    )
    return CrushSpring(**values)
