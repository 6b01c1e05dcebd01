"""The arithmetic of the design procedure, value by value, in the order of a collision.

The plateau forces push the pier aside; the engine strikes it and leaves it ringing; the cargo
strikes it while it rings. Two levels, both in closed form: "hand" fits on a page and needs a
calculator; "refined" keeps the phase of the ringing and lets the pier's own motion correct the
times and speeds of contact. All is derived here. `equations` has the same equations
in print, under the same names.
"""

import math
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from pierimpact.collision.parameters import Parameters, Spring
from pierimpact.design.formulas import (
    RINGING_BETA,
    RINGING_SHARE,
    Motion,
    approach_speed,
    closing_time,
    contact_modes,
    crests,
    engine_pulse,
    hump,
    joined,
    swing,
)

Real: TypeAlias = Any  # a float, or an array
Values: TypeAlias = dict[str, Real]
Spectrum: TypeAlias = Callable[[Real, Real, Real, Real], Real]

LEVELS = ("refined", "hand")


def design_values(case: Parameters, level: str, spectrum: Spectrum | None = None) -> Values:
    """Return every value of the procedure by name, in order.

    Parameters
    ----------
    case : Parameters
        Floats, or arrays of one shape.
    level : {"refined", "hand"}
        Level of the formulas.
    spectrum : callable, optional
        S of β, μ, e and ζ to use in place of the closed form.

    Returns
    -------
    dict
        Values in SI, each a float or an array. Where a body does not meet the pier, the values
        of its contact mean nothing; "cargo" is nan.
    """
    values = _plateau(case)
    values |= _engine_contact(case, values, pier_moves=level == "refined")
    values |= _engine_blow(case, values, spectrum)
    if level == "hand":
        values["engine"] = values.pop("engine_alone")
        return values | _cargo_by_hand(case, values, spectrum)
    values |= _ringing(case, values)
    values |= _cargo_contact(case, values)
    values |= _engine_cut_short(case, values)
    return values | _cargo_modes(case, values)


def _plateau(case: Parameters) -> Values:
    """Return what the pier is, and how the plateau forces push it."""
    omega = np.sqrt(case.pier_stiffness / case.pier_mass)
    zeta = case.pier_damping / (2.0 * np.sqrt(case.pier_stiffness * case.pier_mass))
    omega_d = omega * np.sqrt(1.0 - zeta**2)
    push = case.body.plateau_force + np.where(case.on_pier, case.friction_force, 0.0)
    both = case.engine.plateau_force + push
    return {
        "omega": omega,
        "zeta": zeta,
        "omega_d": omega_d,
        "body_push": push,
        "plateau_push": both,
        "overshoot": both * (1.0 + np.exp(-math.pi * zeta * omega / omega_d)),
        "engine_deceleration": case.engine.plateau_force / case.engine.mass,
        "cargo_holding": case.body.plateau_force + case.friction_force,
        "cargo_deceleration": (case.body.plateau_force + case.friction_force) / case.body.mass,
    }


def _pushed(case: Parameters, values: Values, t: Real) -> Motion:
    """Return the pier's response to the plateau forces, applied at t = 0."""
    rest = values["plateau_push"] / case.pier_stiffness
    x, v = swing(Motion(-rest, 0.0), values["omega"], values["zeta"], t)
    return Motion(x + rest, v)


def _engine_contact(case: Parameters, values: Values, pier_moves: bool) -> Values:
    """Return when and how fast the engine meets the pier, and the pier's motion then."""
    length, deceleration = case.engine.plateau_length, values["engine_deceleration"]
    time = closing_time(case.speed, deceleration, length)
    found: Values = {}
    if pier_moves:
        shift = _pushed(case, values, time).x
        found = {"engine_first_time": time, "engine_first_x": shift}
        time = closing_time(case.speed, deceleration, length + shift)
    x, v = _pushed(case, values, time)
    way = length + x if pier_moves else length
    return found | {
        "engine_time": time,
        "engine_pier_x": x,
        "engine_pier_v": v,
        "engine_speed": approach_speed(case.speed, deceleration, way),
    }


def _engine_blow(case: Parameters, values: Values, spectrum: Spectrum | None) -> Values:
    """Return the engine's reaction."""
    mass, stiffness = case.engine.mass, case.engine.stiffness
    found = _spectrum_values("engine", case.engine, case, values, spectrum)
    closing = np.maximum(values["engine_speed"] - values["engine_pier_v"], 0.0)
    # Displacement and velocity of the pier's swing about its rest under the body's push, both
    # as forces.
    swing_x = case.pier_stiffness * values["engine_pier_x"] - values["body_push"]
    swing_v = case.pier_stiffness * values["engine_pier_v"] / values["omega"]
    blow = np.hypot(swing_x, swing_v + found["engine_S"] * closing * np.sqrt(stiffness * mass))
    struck = values["body_push"] + blow
    # The pier's first crest under the plateaus counts only where the engine lets it come.
    crested = values["omega_d"] * values["engine_time"] >= math.pi
    highest = np.where(crested, np.maximum(struck, values["overshoot"]), struck)
    found |= {
        "engine_closing": closing,
        "engine_swing": blow,
        "engine_alone": np.where(values["engine_speed"] > 0.0, highest, values["overshoot"]),
    }
    return found


def _spectrum_values(
    body: str, spring: Spring, case: Parameters, values: Values, spectrum: Spectrum | None
) -> Values:
    """Return the arguments of the unified spectrum and the amplification, of engine or cargo."""
    zeta = values["zeta"]
    beta = values["omega"] / np.sqrt(spring.stiffness / spring.mass)
    mu, e = spring.mass / case.pier_mass, np.sqrt(spring.stiffness / spring.unloading_stiffness)
    rise = hump(beta, mu, zeta)
    return {
        f"{body}_beta": beta,
        f"{body}_mu": mu,
        f"{body}_e": e,
        f"{body}_hump": rise,
        f"{body}_S": joined(beta, mu, e, rise) if spectrum is None else spectrum(beta, mu, e, zeta),
    }


def _cargo_by_hand(case: Parameters, values: Values, spectrum: Spectrum | None) -> Values:
    """Return the cargo's reaction by its spectrum, plus a share of the ringing that is left."""
    mass, length, stiffness = case.body.mass, case.body.plateau_length, case.body.stiffness
    time = closing_time(case.speed, values["cargo_deceleration"], length)
    speed = approach_speed(case.speed, values["cargo_deceleration"], length)
    found = {"cargo_time": time, "cargo_speed": speed}
    found |= _spectrum_values("cargo", case.body, case, values, spectrum)
    holding = values["cargo_holding"]
    rise = np.hypot(holding, speed * np.sqrt(stiffness * mass)) - holding
    meets = values["engine_speed"] > 0.0
    since = time - np.where(meets, values["engine_time"], 0.0)
    ringing = np.where(meets, values["engine_swing"], values["plateau_push"])
    ringing = ringing * np.exp(-values["zeta"] * values["omega"] * since)
    # The slower the pier, the less its ringing adds up with the cargo's own peak.
    share = RINGING_SHARE / (1.0 + (RINGING_BETA / found["cargo_beta"]) ** 2)
    struck = values["body_push"] + found["cargo_S"] * rise + share * ringing
    found |= {
        "cargo_rise": rise,
        "ringing": ringing,
        "ringing_share": share,
        "cargo": np.where(speed > 0.0, struck, np.nan),
    }
    return found


def _ringing(case: Parameters, values: Values) -> Values:
    """Return when the engine lets go and the pier's motion then, from its rest without it.

    The blow acts on the pier as if at one instant, its centroid; a slow blow excites a fast
    pier less.
    """
    omega, meets = values["omega"], values["engine_speed"] > 0.0
    pulse = engine_pulse(
        case.engine.mass,
        case.engine.stiffness,
        values["engine_e"],
        case.pier_mass,
        values["engine_closing"],
    )
    felt = pulse.impulse * np.exp(-0.5 * (omega * pulse.spread) ** 2)
    felt = np.where(meets, felt, 0.0)
    # Without contact the engine stops on its plateau, and pushes no more.
    end = np.where(
        meets,
        values["engine_time"] + pulse.centroid,
        case.speed / values["engine_deceleration"],
    )
    x, v = _pushed(case, values, end)
    return {
        "pulse_mass": pulse.mass,
        "pulse_omega": pulse.omega,
        "pulse_centroid": pulse.centroid,
        "pulse_spread": pulse.spread,
        "impulse": felt,
        "ringing_time": end,
        "ringing_x": x - values["body_push"] / case.pier_stiffness,
        "ringing_v": v + felt / case.pier_mass,
    }


def _pier_at(case: Parameters, values: Values, t: Real) -> Motion:
    """Return the pier's motion before cargo contact."""
    rings = t > values["ringing_time"]
    push = np.where(rings, values["body_push"], values["plateau_push"]) / case.pier_stiffness
    x, v = swing(
        Motion(np.where(rings, values["ringing_x"], -push), values["ringing_v"] * rings),
        values["omega"],
        values["zeta"],
        t - values["ringing_time"] * rings,
    )
    return Motion(x + push, v)


def _cargo_contact(case: Parameters, values: Values) -> Values:
    """Return when and how fast the cargo meets the pier, and the pier's motion then."""
    length, deceleration = case.body.plateau_length, values["cargo_deceleration"]
    first_time = closing_time(case.speed, deceleration, length)
    first_x = _pier_at(case, values, first_time).x
    time = closing_time(case.speed, deceleration, length + first_x)
    x, v = _pier_at(case, values, time)
    return {
        "cargo_first_time": first_time,
        "cargo_first_x": first_x,
        "cargo_time": time,
        "cargo_pier_x": x,
        "cargo_pier_v": v,
        "cargo_speed": approach_speed(case.speed, deceleration, length + x),
    }


def _engine_cut_short(case: Parameters, values: Values) -> Values:
    """Return the engine's reaction where the cargo may arrive before the pier has crested."""
    omega, omega_d, zeta = values["omega"], values["omega_d"], values["zeta"]
    x, v = values["ringing_x"], values["ringing_v"]
    swing_time = np.arctan2(v * omega_d, omega**2 * x + zeta * omega * v) / omega_d
    crest_time = values["ringing_time"] + swing_time
    earlier = np.where(omega_d * values["engine_time"] >= math.pi, values["overshoot"], 0.0)
    reached = np.maximum(case.pier_stiffness * values["cargo_pier_x"], earlier)
    cut = (
        (values["engine_speed"] > 0.0)
        & (values["cargo_speed"] > 0.0)
        & (values["cargo_time"] < crest_time)
    )
    return {
        "engine_crest_time": crest_time,
        "engine": np.where(
            cut, np.minimum(reached, values["engine_alone"]), values["engine_alone"]
        ),
    }


def _cargo_modes(case: Parameters, values: Values) -> Values:
    """Return the cargo's reaction by the modes of body and pier, with the ringing's phase."""
    holding = values["cargo_holding"]
    beta = values["omega"] / np.sqrt(case.body.stiffness / case.body.mass)
    mu = case.body.mass / case.pier_mass
    rest = (values["body_push"] - holding) / case.pier_stiffness
    x, v = values["cargo_pier_x"], values["cargo_pier_v"]
    modes = contact_modes(
        beta,
        mu,
        values["omega"],
        values["zeta"],
        pier=Motion(x - rest, v),
        body=Motion(x - rest + holding / case.body.stiffness, values["cargo_speed"]),
    )
    slow, fast, when = modes.slow, modes.fast, crests(modes.slow, modes.fast)
    turn_x, early_x, late_x = (
        rest + slow.at(t) + fast.at(t) for t in (when.slow, when.early, when.late)
    )
    # As the slow mode crests the spring turns to the slope k_u. The modes would push the pier
    # as much again from there on; the spring does only e times as much.
    e = np.sqrt(case.body.stiffness / case.body.unloading_stiffness)
    late_x = turn_x + 0.5 * (1.0 + e) * (late_x - turn_x)
    highest = case.pier_stiffness * np.maximum(np.maximum(x, early_x), late_x)
    found = {"cargo_beta": beta, "cargo_mu": mu, "cargo_e": e, "rest": rest}
    found |= {"gamma": modes.gamma, "root": modes.root}
    for name, mode in (("slow", slow), ("fast", fast)):
        found |= {f"{name}_{field}": value for field, value in mode._asdict().items()}
    return found | {
        "turn_time": when.slow,
        "fast_share": when.share,
        "fast_turns": when.turns,
        "early_time": when.early,
        "late_time": when.late,
        "turn_x": turn_x,
        "early_x": early_x,
        "late_x": late_x,
        "cargo": np.where(values["cargo_speed"] > 0.0, highest, np.nan),
    }
