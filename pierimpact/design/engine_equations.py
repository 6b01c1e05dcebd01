"""The equations of the design procedure up to the ringing that the engine leaves.

Formulas are LaTeX with names in angle brackets, as `pierimpact.design.equations` says.
"""

import math

from pierimpact.design.terms import Equation, closing_time, pushed, spectrum, speed_left


def plateau(on_pier: bool) -> dict[str, Equation]:
    """Return the equations of pier and plateau."""
    return {
        "omega": Equation(
            "circular frequency of the pier",
            r"\omega_\mathrm{p}",
            r"\sqrt{<kp> / <mp>}",
            "rad/s",
        ),
        "omega_d": Equation(
            "circular frequency of the damped pier",
            r"\omega_\mathrm{d}",
            r"<omega> <x> \sqrt{1 - <zeta>^2}",
            "rad/s",
        ),
        "body_push": Equation(
            "push of the body’s plateau" + (" and of its friction" if on_pier else ""),
            "Q",
            "<P2> + <cs>" if on_pier else "<P2>",
            "N",
        ),
        "plateau_push": Equation(
            "push of both plateaus", r"F_\mathrm{s}", "<P1> + <body_push>", "N"
        ),
        "overshoot": Equation(
            "largest reaction to the plateaus alone",
            r"R_\mathrm{s}",
            r"<plateau_push> <x> (1 + e^{-\pi <x> <zeta> <x> <omega> / <omega_d>})",
            "N",
        ),
        "engine_deceleration": Equation(
            "deceleration of the engine on its plateau", "a_1", "<P1> / <m1>", "m/s^2"
        ),
        "cargo_holding": Equation(
            "force on the body on its plateau", r"F_\mathrm{h}", "<P2> + <cs>", "N"
        ),
        "cargo_deceleration": Equation(
            "deceleration of the body on its plateau", "a_2", "<cargo_holding> / <m2>", "m/s^2"
        ),
    }


def engine_contact(hand: bool) -> dict[str, Equation]:
    """Return the equations of when and how fast the engine meets the pier."""
    first, table = "engine_deceleration", {}
    if not hand:
        table = {
            "engine_first_time": Equation(
                "time of engine contact if the pier stood still",
                "t_1'",
                closing_time(first, "<d1>"),
                "s",
            ),
            "engine_first_x": Equation(
                "displacement of the pier at $t_1'$",
                "x_1'",
                pushed("engine_first_time")[0],
                "m",
            ),
        }
    return table | {
        "engine_time": Equation(
            "time of engine contact",
            "t_1",
            closing_time(first, "<d1>" if hand else "<d1> + <engine_first_x>"),
            "s",
        ),
        "engine_pier_x": Equation(
            "displacement of the pier at $t_1$", "x_1", pushed("engine_time")[0], "m"
        ),
        "engine_pier_v": Equation(
            "velocity of the pier at $t_1$",
            r"\dot x_1",
            pushed("engine_time")[1],
            "m/s",
        ),
        "engine_speed": Equation(
            "speed of the engine at $t_1$; zero if it stops before",
            "v_1",
            speed_left(first, "<d1>" if hand else "<d1> + <engine_pier_x>"),
            "m/s",
        ),
    }


def engine_blow(values: dict[str, float], hand: bool) -> dict[str, Equation]:
    """Return the equations of the engine’s blow, or that the plateaus alone count."""
    name = "engine" if hand else "engine_alone"
    meaning = "engine reaction" if hand else "engine reaction if the cargo stays away"
    symbol = "R_1" if hand else "R_1'"
    if not values["engine_speed"] > 0.0:
        return {name: Equation(meaning + ", from the plateaus alone", symbol, "<overshoot>", "N")}
    struck = "<body_push> + <engine_swing>"
    if _crested(values):  # the pier has crested before the engine's contact
        struck = rf"\max({struck}, <overshoot>)"
    return spectrum("engine", 1) | {
        "engine_closing": Equation(
            "closing speed of engine and pier at contact",
            "u_1",
            r"\max(<engine_speed> - <engine_pier_v>, 0)",
            "m/s",
        ),
        "engine_swing": Equation(
            "the pier’s swing after the blow, as a force",
            "A_1",
            r"\sqrt{(<kp> <x> <engine_pier_x> - <body_push>)^2 + "
            r"\left(\frac{<kp> <x> <engine_pier_v>}{<omega>}"
            r" + <engine_S> <x> <engine_closing> <x> \sqrt{<k1> <x> <m1>}\right)^2}",
            "N",
        ),
        name: Equation(meaning, symbol, struck, "N"),
    }


def _crested(values: dict[str, float]) -> bool:
    return values["omega_d"] * values["engine_time"] >= math.pi


def ringing(values: dict[str, float]) -> dict[str, Equation]:
    """Return the equations of the pier’s motion as the engine lets go."""
    x, v = pushed("ringing_time")
    x += r" - \frac{<body_push>}{<kp>}"
    if not values["engine_speed"] > 0.0:
        return {
            "ringing_time": Equation(
                "time when the engine stops", r"t_\mathrm{J}", "<V> / <engine_deceleration>", "s"
            ),
            "ringing_x": Equation(
                "displacement of the pier at $t_\\mathrm{J}$, from its rest under $Q$",
                r"x_\mathrm{J}",
                x,
                "m",
            ),
            "ringing_v": Equation(
                "velocity of the pier at $t_\\mathrm{J}$", r"\dot x_\mathrm{J}", v, "m/s"
            ),
        }
    e, pi = "<engine_e>", r"\pi"
    first = rf"\frac{{1 + ({pi} / 2) <x> {e} + ({pi} / 2 - 1) <x> {e}^2}}{{1 + {e}}}"
    second = (
        rf"\frac{{{pi} - 2 + ({pi}^2 / 4) <x> {e} + {pi} <x> ({pi} / 2 - 1) <x> {e}^2"
        rf" + ({pi}^2 / 4 - 2) <x> {e}^3}}{{1 + {e}}}"
    )
    return {
        "pulse_mass": Equation(
            "reduced mass of engine and pier",
            r"m_\mathrm{r}",
            r"\frac{<m1>}{1 + <m1> / <mp>}",
            "kg",
        ),
        "pulse_omega": Equation(
            "circular frequency of the blow",
            r"\omega_\mathrm{r}",
            r"\sqrt{<k1> / <pulse_mass>}",
            "rad/s",
        ),
        "pulse_centroid": Equation(
            "centroid of the blow after contact",
            r"\bar t",
            rf"\frac{{1}}{{<pulse_omega>}} <x> {first}",
            "s",
        ),
        "pulse_spread": Equation(
            "spread of the blow about its centroid",
            r"\sigma_\mathrm{J}",
            rf"\sqrt{{\frac{{1}}{{<pulse_omega>^2}} <x> {second} - <pulse_centroid>^2}}",
            "s",
        ),
        "impulse": Equation(
            "impulse of the blow, as far as the pier feels it",
            "J",
            "(1 + <engine_e>) <x> <pulse_mass> <x> <engine_closing>"
            r" <x> e^{-<omega>^2 <x> <pulse_spread>^2 / 2}",
            "N s",
        ),
        "ringing_time": Equation(
            "time of the blow",
            r"t_\mathrm{J}",
            "<engine_time> + <pulse_centroid>",
            "s",
        ),
        "ringing_x": Equation(
            "displacement of the pier at $t_\\mathrm{J}$, from its rest under $Q$",
            r"x_\mathrm{J}",
            x,
            "m",
        ),
        "ringing_v": Equation(
            "velocity of the pier after the blow",
            r"\dot x_\mathrm{J}",
            v + r" + \frac{<impulse>}{<mp>}",
            "m/s",
        ),
    }


def engine_cut_short(values: dict[str, float]) -> dict[str, Equation]:
    """Return the equations of the engine’s reaction, which the cargo may cut short."""
    if not (values["engine_speed"] > 0.0 and values["cargo_speed"] > 0.0):
        return {"engine": Equation("engine reaction", "R_1", "<engine_alone>", "N")}
    formula = "<engine_alone>"
    meaning = "engine reaction: the crest comes before the cargo"
    if values["cargo_time"] < values["engine_crest_time"]:
        reached = "<kp> <x> <cargo_pier_x>"
        if _crested(values):
            reached = rf"\max({reached}, <overshoot>)"
        formula = rf"\min({reached}, <engine_alone>)"
        meaning = "engine reaction: the cargo comes before the crest"
    return {
        "engine_crest_time": Equation(
            "time of the crest that the engine leaves",
            r"t_\mathrm{c}",
            r"<ringing_time> + \frac{\operatorname{atan2}(<ringing_v> <x> <omega_d>, "
            r"<omega>^2 <x> <ringing_x> + <zeta> <x> <omega> <x> <ringing_v>)}{<omega_d>}",
            "s",
        ),
        "engine": Equation(meaning, "R_1", formula, "N"),
    }
