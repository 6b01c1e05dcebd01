"""The design procedure as a checker reads it: symbol, equation and unit of every value."""

from typing import NamedTuple


class Equation(NamedTuple):
    """What a value of `pierimpact.design` is, with symbol and equation in LaTeX."""

    meaning: str
    symbol: str
    formula: str
    unit: str


class DesignStep(NamedTuple):
    """One value of the procedure: what it is, symbol and equation in LaTeX, unit, value [SI]."""

    name: str
    meaning: str
    symbol: str
    formula: str
    unit: str
    value: float


EQUATIONS = {
    # Pier and plateau
    "pier_omega": Equation(
        "circular frequency of the pier", r"\omega_p", r"\sqrt{k_p/m_p}", "rad/s"
    ),
    "damping_ratio": Equation(
        "damping ratio of the pier", r"\zeta", r"c_p / (2\sqrt{k_p m_p})", "-"
    ),
    "body_push": Equation(
        "push of the body's plateau, with the friction if it acts on the pier",
        "Q",
        r"P_2 \;(+\,c_s)",
        "N",
    ),
    "plateau_push": Equation("push of both plateaus", "F_s", r"P_1 + Q", "N"),
    "overshoot": Equation(
        "largest reaction to the plateaus alone",
        "R_s",
        r"F_s \left(1 + e^{-\pi\zeta/\sqrt{1-\zeta^2}}\right)",
        "N",
    ),
    "engine_deceleration": Equation(
        "deceleration of the engine on its plateau", "a_1", r"P_1/m_1", "m/s^2"
    ),
    "cargo_deceleration": Equation(
        "deceleration of the body on its plateau", "a_2", r"(P_2 + c_s)/m_2", "m/s^2"
    ),
    # Engine
    "engine_speed": Equation(
        "speed of the engine at contact, zero if it stops before",
        "v_1",
        r"\sqrt{V^2 - 2 P_1 (d_1 + x_1)/m_1}",
        "m/s",
    ),
    "engine_time": Equation("time of engine contact", "t_1", r"2 (d_1 + x_1)/(V + v_1)", "s"),
    "engine_pier_x": Equation(
        "displacement of the pier then",
        "x_1",
        r"\frac{F_s}{k_p}\left[1 - e^{-\zeta\omega_p t_1}\left(\cos\omega_d t_1"
        r" + \frac{\zeta\omega_p}{\omega_d}\sin\omega_d t_1\right)\right]",
        "m",
    ),
    "engine_pier_v": Equation(
        "velocity of the pier then",
        r"\dot x_1",
        r"\frac{F_s}{m_p\omega_d}\, e^{-\zeta\omega_p t_1}\sin\omega_d t_1",
        "m/s",
    ),
    "engine_beta": Equation("frequency ratio, engine", r"\beta_1", r"\omega_p/\sqrt{k_1/m_1}", "-"),
    "engine_mu": Equation("mass ratio, engine", r"\mu_1", r"m_1/m_p", "-"),
    "engine_e": Equation("restitution, engine", "e_1", r"\sqrt{k_1/k_{u1}}", "-"),
    "engine_S": Equation("amplification, engine", "S_1", r"S(\beta_1, \mu_1, e_1, \zeta)", "-"),
    "engine_closing": Equation(
        "closing speed of engine and pier", "u_1", r"v_1 - \dot x_1 \ge 0", "m/s"
    ),
    "engine_blow": Equation(
        "the pier's swing after the blow, as a force",
        "A_1",
        r"\sqrt{(k_p x_1 - Q)^2 + \left(k_p \dot x_1/\omega_p + S_1 u_1 \sqrt{k_1 m_1}\right)^2}",
        "N",
    ),
    "engine": Equation(
        "engine reaction; without contact, or where it is larger, $R_s$",
        "R_1",
        r"Q + A_1",
        "N",
    ),
    # Cargo, by hand
    "cargo_S": Equation("amplification, cargo", "S_2", r"S(\beta_2, \mu_2, e_2, \zeta)", "-"),
    "cargo_beta": Equation("frequency ratio, cargo", r"\beta_2", r"\omega_p/\sqrt{k_2/m_2}", "-"),
    "cargo_mu": Equation("mass ratio, cargo", r"\mu_2", r"m_2/m_p", "-"),
    "cargo_e": Equation("restitution, cargo", "e_2", r"\sqrt{k_2/k_{u2}}", "-"),
    "cargo_rise": Equation(
        "rise of the cargo's force above its plateau on a rigid pier",
        r"\hat F_2",
        r"\sqrt{(P_2 + c_s)^2 + k_2 m_2 v_2^2} - (P_2 + c_s)",
        "N",
    ),
    "ringing": Equation(
        "ringing left when the cargo arrives, as a force; $F_s$ for $A_1$ and 0 for $t_1$ "
        "without engine contact",
        "A_2",
        r"A_1 e^{-\zeta\omega_p (t_2 - t_1)}",
        "N",
    ),
    # Cargo, refined
    "impulse": Equation(
        "impulse of the engine's blow that the pier feels",
        "J",
        r"(1 + e_1)\, m_r u_1\, e^{-\omega_p^2\sigma_J^2/2}",
        "N s",
    ),
    "blow_time": Equation(
        "time of the blow's centroid; $V/a_1$ without engine contact", "t_J", r"t_1 + \bar t", "s"
    ),
    "blow_x": Equation("displacement from rest after the blow", "x_J", r"x(t_J) - Q/k_p", "m"),
    "blow_v": Equation("velocity after the blow", r"\dot x_J", r"\dot x(t_J) + J/m_p", "m/s"),
    "cargo_speed": Equation(
        "speed of the cargo at contact, zero if it stops before",
        "v_2",
        r"\sqrt{V^2 - 2 a_2 (d_2 + x_2)}",
        "m/s",
    ),
    "cargo_time": Equation("time of cargo contact", "t_2", r"2 (d_2 + x_2)/(V + v_2)", "s"),
    "cargo_pier_x": Equation("displacement of the pier then", "x_2", r"x(t_2)", "m"),
    "cargo_pier_v": Equation("velocity of the pier then", r"\dot x_2", r"\dot x(t_2)", "m/s"),
    "rest": Equation("rest of pier and body joined", "x_0", r"(Q - P_2 - c_s)/k_p", "m"),
    "slow_omega": Equation("slow mode: frequency", r"\omega_s", r"\sqrt{\lambda_s}", "rad/s"),
    "slow_sigma": Equation("slow mode: decay", r"\sigma_s", r"c_p/(2 M_s)", "1/s"),
    "slow_body": Equation(
        "slow mode: body over pier", r"\psi_s", r"\omega_2^2/(\omega_2^2 - \lambda_s)", "-"
    ),
    "slow_cosine": Equation(
        "slow mode: cosine part",
        "a_s",
        r"[m_p (x_2 - x_0) + m_2\psi_s (x_2 - x_0 + (P_2 + c_s)/k_2)]/M_s",
        "m",
    ),
    "slow_sine": Equation(
        "slow mode: sine part",
        "b_s",
        r"[(m_p \dot x_2 + m_2\psi_s v_2)/M_s + \sigma_s a_s]/\omega_s",
        "m",
    ),
    "fast_omega": Equation("fast mode: frequency", r"\omega_f", r"\sqrt{\lambda_f}", "rad/s"),
    "fast_sigma": Equation("fast mode: decay", r"\sigma_f", r"c_p/(2 M_f)", "1/s"),
    "fast_body": Equation(
        "fast mode: body over pier", r"\psi_f", r"\omega_2^2/(\omega_2^2 - \lambda_f)", "-"
    ),
    "fast_cosine": Equation("fast mode: cosine part", "a_f", r"\text{as } a_s", "m"),
    "fast_sine": Equation("fast mode: sine part", "b_f", r"\text{as } b_s", "m"),
    "turn_time": Equation(
        "time after contact at which the crush turns",
        "t_u",
        r"\text{crest of } (\psi_s - 1) q_s + (\psi_f - 1) q_f",
        "s",
    ),
    "turn_x": Equation("displacement of the pier then", "x_u", r"x_0 + q_s(t_u) + q_f(t_u)", "m"),
    "early_crest_time": Equation(
        "crest of the ringing before the slow mode's", "t_a", r"\text{crest of } q_s + q_f", "s"
    ),
    "early_crest_x": Equation(
        "displacement there; beyond the turn $x_u + 0.8\\,(x - x_u)$",
        "x_a",
        r"x_0 + q_s(t_a) + q_f(t_a)",
        "m",
    ),
    "late_crest_time": Equation(
        "crest of the ringing after the slow mode's", "t_b", r"\text{crest of } q_s + q_f", "s"
    ),
    "late_crest_x": Equation(
        "displacement there; beyond the turn $x_u + 0.8\\,(x - x_u)$",
        "x_b",
        r"x_0 + q_s(t_b) + q_f(t_b)",
        "m",
    ),
}
#: The cargo's reaction differs with the level.
CARGO = {
    "hand": Equation(
        "cargo reaction", "R_2", r"Q + S_2 \hat F_2 + 0.6\, A_2/(1 + 4/\beta_2^2)", "N"
    ),
    "refined": Equation("cargo reaction", "R_2", r"k_p \max(x_2,\, x_a,\, x_b)", "N"),
}


def steps(values: dict[str, float]) -> tuple[DesignStep, ...]:
    """Return the values of the design procedure, in order, each with its equation."""
    level = "hand" if "cargo_rise" in values else "refined"
    table = EQUATIONS | {"cargo": CARGO[level]}
    return tuple(DesignStep(name, *table[name], value) for name, value in values.items())
