"""Where member forces under the reaction as a static force stand for those of the struck column.

A pier of one degree of freedom deflects in its static shape. A real column does so only where it
has time to: the engine's blow lasts some 5 ms, in which a slow column passes the contact force to
its nearest support before its far parts move. The reaction is then smaller than the contact force,
and with it the static shear and moment.

Rule and figures are this project's, from the study in `pierimpact.design.static_study`. Where the
truck is known, that in `pierimpact.design.static_forces` is sharper.
"""

from typing import NamedTuple


class StaticForcesWarning(UserWarning):
    """Member forces under the reaction as a static force may be too low.

    Examples
    --------
    >>> import warnings
    >>> from pierimpact import CircularSection, PierColumn
    >>> column = PierColumn(
    ...     height=8.0, section=CircularSection(diameter=0.9), elastic_modulus=25e9, density=2400.0
    ... )
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     pier = column.equivalent(impact_height=1.2)
    >>> str(caught[0].message).partition(":")[0]
    'Shear and moment under the reaction as a static force may be too low'
    """


#: Frequency f_p below which a pier is too slow for the engine's blow, from the study [Hz].
LOWEST_FREQUENCY = 55.0
#: Static over beam below which a static force counts as too low: this project's choice [-].
TOO_LOW = 0.95


class Ratios(NamedTuple):
    """Largest static shear and moment over those of the beam: where nine in ten columns lie [-].

    The 5 % and 95 % quantiles, rounded.
    """

    shear: tuple[float, float]
    moment: tuple[float, float]


QUICK, SLOW, TOP = "quick", "slow", "held at the top"
#: By kind of column, from the study.
RATIOS = {
    QUICK: Ratios((0.91, 1.42), (0.97, 1.44)),
    SLOW: Ratios((0.41, 1.56), (0.52, 1.61)),
    TOP: Ratios((0.38, 1.37), (0.70, 1.27)),
}


class StaticForces(NamedTuple):
    """Whether member forces under the reaction as a static force hold for a column."""

    base: str  #: its ends; "fixed" where anything holds one against rotation
    top: str
    frequency: float  #: f_p [Hz]

    @property
    def kind(self) -> str:
        """One of RATIOS; held at the top is a column that only its top holds against rotation."""
        if self.top == "fixed" and self.base != "fixed":
            return TOP
        return SLOW if self.frequency < LOWEST_FREQUENCY else QUICK

    @property
    def hold(self) -> bool:
        """Whether they hold: seldom are they much too low."""
        return self.kind == QUICK

    @property
    def sentence(self) -> str:
        """What to know before relying on them, in one sentence; empty where they hold."""
        if self.kind == QUICK:
            return ""
        reasons = {
            SLOW: f"at {self.frequency:.3g} Hz, below {LOWEST_FREQUENCY:g} Hz, the pier may be too "
            "slow to follow the blow of the engine in its static shape",
            TOP: "only the top of the column, far from the impact, is held against rotation",
        }
        return too_low(reasons[self.kind], RATIOS[self.kind])


def too_low(reason: str, ratios: Ratios) -> str:
    """Return the sentence that warns of static member forces, with the reason."""
    (least, most), (low, high) = ratios
    return (
        f"Shear and moment under the reaction as a static force may be too low: {reason}; in "
        f"nine of ten such cases studied, the static shear was {least:.2f} to {most:.2f} times "
        f"and the static moment {low:.2f} to {high:.2f} times that of the column as a beam, from "
        "which both should be taken."
    )
