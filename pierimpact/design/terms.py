r"""What recurs in the equations of the design procedure: motions of the pier, S, slowed bodies.

Formulas are LaTeX with names in angle brackets, as `pierimpact.design.equations` says.
"""

from typing import NamedTuple

from pierimpact.design.formulas import DAMPING_EFFECT, HUMP, HUMP_DECLINE, HUMP_END, MASS_EFFECT


class Equation(NamedTuple):
    """What a value of the procedure is, with symbol and formula in LaTeX."""

    meaning: str
    symbol: str
    formula: str
    unit: str


# Motions of the pier a time T after first touch, and after the engine let go.
_DECAY = "e^{-<zeta> <x> <omega> <x> T}"
_COS, _SIN = r"\cos(<omega_d> <x> T)", r"\sin(<omega_d> <x> T)"
_PUSHED_X = (
    rf"\frac{{<plateau_push>}}{{<kp>}} <x> \left[1 - {_DECAY} <x> \left({_COS}"
    rf" + \frac{{<zeta> <x> <omega>}}{{<omega_d>}} <x> {_SIN}\right)\right]"
)
_PUSHED_V = rf"\frac{{<plateau_push>}}{{<mp> <x> <omega_d>}} <x> {_DECAY} <x> {_SIN}"
_RINGS_X = (
    rf"\frac{{<body_push>}}{{<kp>}} + {_DECAY} <x> \left[<ringing_x> <x> {_COS}"
    rf" + \frac{{<ringing_v> + <zeta> <x> <omega> <x> <ringing_x>}}{{<omega_d>}} <x> {_SIN}\right]"
)
_RINGS_V = (
    rf"{_DECAY} <x> \left[<ringing_v> <x> {_COS} - \frac{{<omega>^2 <x> <ringing_x>"
    rf" + <zeta> <x> <omega> <x> <ringing_v>}}{{<omega_d>}} <x> {_SIN}\right]"
)


def pushed(time: str) -> tuple[str, str]:
    """Return displacement and velocity of the pier under both plateaus, at the time named."""
    return _PUSHED_X.replace("T", f"<{time}>"), _PUSHED_V.replace("T", f"<{time}>")


def before_cargo(time: str, values: dict[str, float]) -> tuple[str, str]:
    """Return displacement and velocity of the pier at the time named, pushed or ringing."""
    if values[time] <= values["ringing_time"]:
        return pushed(time)
    since = f"(<{time}> - <ringing_time>)"
    return _RINGS_X.replace("T", since), _RINGS_V.replace("T", since)


def closing_time(deceleration: str, length: str) -> str:
    """Return the time in which a body slowed on its plateau covers a length."""
    covered = f"({length})" if "+" in length else length
    return rf"\frac{{2 <x> {covered}}}{{<V> + {speed_left(deceleration, length)}}}"


def speed_left(deceleration: str, length: str) -> str:
    """Return the speed that a body slowed on its plateau has left after a length."""
    length = f"({length})" if "+" in length else length
    return rf"\sqrt{{\max(<V>^2 - 2 <x> <{deceleration}> <x> {length}, 0)}}"


def spectrum(body: str, i: int) -> dict[str, Equation]:
    """Return the equations of the unified spectrum, for engine or cargo."""
    beta, mu, e, h = (f"<{body}_{name}>" for name in ("beta", "mu", "e", "hump"))
    return {
        f"{body}_beta": Equation(
            f"frequency ratio, {body}",
            rf"\beta_{i}",
            rf"\frac{{<omega>}}{{\sqrt{{<k{i}> / <m{i}>}}}}",
            "-",
        ),
        f"{body}_mu": Equation(f"mass ratio, {body}", rf"\mu_{i}", rf"<m{i}> / <mp>", "-"),
        f"{body}_e": Equation(f"restitution, {body}", f"e_{i}", rf"\sqrt{{<k{i}> / <ku{i}>}}", "-"),
        f"{body}_hump": Equation(
            f"hump of the spectrum, {body}",
            f"h_{i}",
            rf"\frac{{{HUMP} <x> e^{{-{DAMPING_EFFECT} <x> <zeta>}}}}"
            rf"{{\left[1 + ({beta} / {HUMP_END})^{{{HUMP_DECLINE}}}\right]"
            rf" <x> (1 + {MASS_EFFECT} <x> {mu} / {beta})}}",
            "-",
        ),
        f"{body}_S": Equation(
            f"amplification, {body}",
            f"S_{i}",
            rf"\left[\frac{{1}}{{[(1 + {e}) <x> {beta}]^2}}"
            rf" + \frac{{1 + {mu} / {beta}^2}}{{(1 + {h})^2}}\right]^{{-1/2}}",
            "-",
        ),
    }
