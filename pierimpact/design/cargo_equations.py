"""The equations of the design procedure for the cargo, by hand and refined.

Formulas are LaTeX with names in angle brackets, as `pierimpact.design.equations` says.
"""

from pierimpact.design.formulas import RINGING_BETA, RINGING_SHARE
from pierimpact.design.terms import Equation, before_cargo, closing_time, spectrum, speed_left


def cargo_by_hand(values: dict[str, float]) -> dict[str, Equation]:
    """Return the equations of contact and reaction by hand."""
    meets = values["engine_speed"] > 0.0
    contact = {
        "cargo_time": Equation(
            "time of cargo contact", "t_2", closing_time("cargo_deceleration", "<d2>"), "s"
        ),
        "cargo_speed": Equation(
            "speed of the cargo at $t_2$; zero if it stops before",
            "v_2",
            speed_left("cargo_deceleration", "<d2>"),
            "m/s",
        ),
    }
    if not values["cargo_speed"] > 0.0:
        return contact
    decay = "e^{-<zeta> <x> <omega> <x>"
    return (
        contact
        | spectrum("cargo", 2)
        | {
            "cargo_rise": Equation(
                "rise of the cargo’s force above its plateau on a rigid pier",
                r"\hat F_2",
                r"\sqrt{<cargo_holding>^2 + <k2> <x> <m2> <x> <cargo_speed>^2} - <cargo_holding>",
                "N",
            ),
            "ringing": Equation(
                "swing that is left when the cargo arrives, as a force",
                "A_2",
                f"<engine_swing> <x> {decay} (<cargo_time> - <engine_time>)}}"
                if meets
                else f"<plateau_push> <x> {decay} <cargo_time>}}",
                "N",
            ),
            "ringing_share": Equation(
                "share of this swing that counts",
                r"\eta",
                rf"\frac{{{RINGING_SHARE}}}{{1 + ({RINGING_BETA} / <cargo_beta>)^2}}",
                "-",
            ),
            "cargo": Equation(
                "cargo reaction",
                "R_2",
                "<body_push> + <cargo_S> <x> <cargo_rise> + <ringing_share> <x> <ringing>",
                "N",
            ),
        }
    )


def cargo_contact(values: dict[str, float]) -> dict[str, Equation]:
    """Return the equations of when and how fast the cargo meets the moving pier."""
    return {
        "cargo_first_time": Equation(
            "time of cargo contact if the pier stood still",
            "t_2'",
            closing_time("cargo_deceleration", "<d2>"),
            "s",
        ),
        "cargo_first_x": Equation(
            "displacement of the pier at $t_2'$",
            "x_2'",
            before_cargo("cargo_first_time", values)[0],
            "m",
        ),
        "cargo_time": Equation(
            "time of cargo contact",
            "t_2",
            closing_time("cargo_deceleration", "<d2> + <cargo_first_x>"),
            "s",
        ),
        "cargo_pier_x": Equation(
            "displacement of the pier at $t_2$", "x_2", before_cargo("cargo_time", values)[0], "m"
        ),
        "cargo_pier_v": Equation(
            "velocity of the pier at $t_2$",
            r"\dot x_2",
            before_cargo("cargo_time", values)[1],
            "m/s",
        ),
        "cargo_speed": Equation(
            "speed of the cargo at $t_2$; zero if it stops before",
            "v_2",
            speed_left("cargo_deceleration", "<d2> + <cargo_pier_x>"),
            "m/s",
        ),
    }


def _mode(mode: str, omega: str, body: str) -> dict[str, Equation]:
    """Return the equations of the slow or the fast mode."""
    s = rf"\mathrm{{{mode[0]}}}"
    share = rf"1 + <cargo_mu> <x> <{mode}_body>^2"
    joined = "(<cargo_pier_x> - <rest> + <cargo_holding> / <k2>)"
    return {
        f"{mode}_{name}": Equation(f"{mode} mode: {meaning}", rf"{symbol}_{s}", formula, unit)
        for name, meaning, symbol, formula, unit in (
            ("omega", "circular frequency", r"\omega", omega, "rad/s"),
            ("body", "motion of the body over the pier’s", r"\psi", body, "-"),
            ("sigma", "decay", r"\sigma", rf"\frac{{<zeta> <x> <omega>}}{{{share}}}", "1/s"),
            (
                "cosine",
                "cosine part",
                "a",
                rf"\frac{{<cargo_pier_x> - <rest> + <cargo_mu> <x> <{mode}_body> <x> {joined}}}"
                rf"{{{share}}}",
                "m",
            ),
            (
                "sine",
                "sine part",
                "b",
                rf"\frac{{1}}{{<{mode}_omega>}} <x> \left[\frac{{<cargo_pier_v>"
                rf" + <cargo_mu> <x> <{mode}_body> <x> <cargo_speed>}}{{{share}}}"
                rf" + <{mode}_sigma> <x> <{mode}_cosine>\right]",
                "m",
            ),
            ("amplitude", "amplitude", "A", rf"\sqrt{{<{mode}_cosine>^2 + <{mode}_sine>^2}}", "m"),
            (
                "phase",
                f"phase, the angle of the point $(a_{s}, b_{s})$",
                r"\varphi",
                rf"\operatorname{{atan2}}(<{mode}_sine>, <{mode}_cosine>)",
                "rad",
            ),
            (
                "crest",
                "angle of its first crest, from 0 to 2π",
                r"\theta",
                rf"(<{mode}_phase> - \arctan(<{mode}_sigma> / <{mode}_omega>)) \bmod (2 \pi)",
                "rad",
            ),
        )
    }


def _displacement(time: str) -> str:
    """Return both modes' displacement at a time."""
    return "<rest> + " + " + ".join(
        rf"<{mode}_amplitude> <x> e^{{-<{mode}_sigma> <x> {time}}}"
        rf" <x> \cos(<{mode}_omega> <x> {time} - <{mode}_phase>)"
        for mode in ("slow", "fast")
    )


def cargo_modes() -> dict[str, Equation]:
    """Return the equations of the cargo's reaction by the modes of body and pier."""
    ratios = spectrum("cargo", 2)
    fast_crest = r"\frac{<fast_crest> + 2 \pi <x> TURNS}{<fast_omega>}"
    return {
        **{name: ratios[name] for name in ("cargo_beta", "cargo_mu", "cargo_e")},
        "rest": Equation(
            "displacement at which pier and body joined would rest",
            "x_0",
            r"\frac{<body_push> - <cargo_holding>}{<kp>}",
            "m",
        ),
        "gamma": Equation(
            "detuning of pier and cargo",
            r"\gamma",
            r"\frac{<cargo_beta>^2 + <cargo_mu> - 1}{2}",
            "-",
        ),
        "root": Equation("root of the modes", r"\lambda", r"\sqrt{<gamma>^2 + <cargo_mu>}", "-"),
        **_mode(
            "slow",
            r"\frac{<omega>}{\sqrt{1 + <gamma> + <root>}}",
            r"(<root> + <gamma>) / <cargo_mu>",
        ),
        **_mode(
            "fast",
            r"\frac{<omega>}{<cargo_beta>} <x> \sqrt{1 + <gamma> + <root>}",
            r"-1 / (<root> + <gamma>)",
        ),
        "turn_time": Equation(
            "time after contact at which the slow mode crests and the spring turns",
            r"t_\mathrm{u}",
            r"<slow_crest> / <slow_omega>",
            "s",
        ),
        "fast_share": Equation(
            "weight of the fast mode in the crest of both modes",
            "w",
            r"\frac{<fast_amplitude> <x> <fast_omega>^2"
            r" <x> e^{-(<fast_sigma> - <slow_sigma>) <x> <turn_time>}}"
            r"{<fast_amplitude> <x> <fast_omega>^2"
            r" <x> e^{-(<fast_sigma> - <slow_sigma>) <x> <turn_time>}"
            r" + <slow_amplitude> <x> <slow_omega>^2}",
            "-",
        ),
        "fast_turns": Equation(
            "whole turns of the fast mode before $t_\\mathrm{u}$",
            "n",
            r"\left\lfloor \frac{<fast_omega> <x> <turn_time> - <fast_crest>}{2 \pi}"
            r" \right\rfloor",
            "-",
        ),
        "early_time": Equation(
            "time after contact of the last crest of both modes before $t_\\mathrm{u}$",
            r"t_\mathrm{a}",
            r"\max(<turn_time> + <fast_share> <x> ("
            + fast_crest.replace("TURNS", "<fast_turns>")
            + " - <turn_time>), 0)",
            "s",
        ),
        "late_time": Equation(
            "time after contact of the first crest of both modes after $t_\\mathrm{u}$",
            r"t_\mathrm{b}",
            "<turn_time> + <fast_share> <x> ("
            + fast_crest.replace("TURNS", "(<fast_turns> + 1)")
            + " - <turn_time>)",
            "s",
        ),
        "turn_x": Equation(
            "displacement of the pier at $t_\\mathrm{u}$, as the spring turns",
            r"x_\mathrm{u}",
            _displacement("<turn_time>"),
            "m",
        ),
        "early_x": Equation(
            "displacement of the pier at $t_\\mathrm{a}$",
            r"x_\mathrm{a}",
            _displacement("<early_time>"),
            "m",
        ),
        "late_x": Equation(
            "displacement of the pier at $t_\\mathrm{b}$; the spring unloads on $k_{\\mathrm{u}2}$",
            r"x_\mathrm{b}",
            r"<turn_x> + \frac{1 + <cargo_e>}{2} <x> \left("
            + _displacement("<late_time>")
            + r" - <turn_x>\right)",
            "m",
        ),
        "cargo": Equation(
            "cargo reaction",
            "R_2",
            r"<kp> <x> \max(<cargo_pier_x>, <early_x>, <late_x>)",
            "N",
        ),
    }
