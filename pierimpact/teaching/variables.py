"""The values that a control of an explorer can set, with their units and ranges."""

from dataclasses import dataclass

from pierimpact.checks import InputError, brief, number
from pierimpact.symbols import BY_KEY, SYMBOLS, Symbol, dimension
from pierimpact.units import parse


@dataclass(frozen=True)
class Variable:
    """A value that a control sets.

    Parameters
    ----------
    symbol : Symbol
        The quantity.
    unit : str, optional
        Unit in which it is shown; empty for a plain number.
    low, high : float, optional
        Ends of the slider, in that unit.
    step : float, optional
        Step of the slider; of the power of ten where `log`.
    log : bool, optional
        Whether the slider is logarithmic.
    choices : tuple of str, optional
        The choices of a list, in place of a slider.
    """

    symbol: Symbol
    unit: str = ""
    low: float = 0.0
    high: float = 1.0
    step: float = 0.1
    log: bool = False
    choices: tuple[str, ...] = ()

    @property
    def label(self) -> str:
        """The name beside the control."""
        return self.symbol.heading

    @property
    def size(self) -> float:
        """Return the unit in SI units."""
        if not self.unit:
            return 1.0
        return parse(self.label, f"1 {self.unit}", dimension(self.symbol))

    def shown(self, value: float) -> str:
        """Return a value in SI units as it would be typed."""
        return f"{value / self.size:.4g} {self.unit}".strip()

    def parsed(self, text: str) -> float:
        """Return a text in SI units; a bare number is in the unit shown.

        Raises
        ------
        InputError
            When the text is not such a value.
        """
        try:
            plain = float(text)
        except ValueError:
            if self.unit:
                return parse(self.label, text.strip(), dimension(self.symbol))
            raise InputError(f"{self.label} must be a number, got {brief(text)}") from None
        return number(self.label, plain) * self.size


def _spring(
    body: str, force: tuple[float, float], length: tuple[float, float], stiff: tuple[float, float]
) -> dict[str, Variable]:
    """Return the variables of the crush law of engine or body, by their ranges."""

    def of(name: str) -> Symbol:
        return BY_KEY[f"{body}_spring.{name}"]

    soft, hard = stiff
    return {
        f"{body}_plateau_force": Variable(of("plateau_force"), "kN", *force, 10.0),
        f"{body}_plateau_length": Variable(of("plateau_length"), "m", *length, 0.05),
        f"{body}_stiffness": Variable(of("stiffness"), "MN/m", soft, hard, 0.01, log=True),
        f"{body}_unloading_stiffness": Variable(
            of("unloading_stiffness"), "MN/m", soft, 10.0 * hard, 0.01, log=True
        ),
    }


_ENDS = ("fixed", "pinned", "free")
#: The truck's parameters.
CRUSH = {
    "engine_mass": Variable(SYMBOLS["m1"], "kg", 200.0, 2000.0, 50.0),
    "friction_force": Variable(SYMBOLS["cs"], "kN", 0.0, 100.0, 0.5),
    **_spring("engine", force=(20.0, 600.0), length=(0.05, 1.5), stiff=(20.0, 600.0)),
    **_spring("body", force=(50.0, 1500.0), length=(0.2, 4.0), stiff=(1.0, 100.0)),
}
#: Every variable, by its name in a `Scenario`.
VARIABLES = {
    "speed": Variable(SYMBOLS["V"], "km/h", 10.0, 130.0, 1.0),
    "truck_mass": Variable(SYMBOLS["m"], "t", 3.0, 40.0, 0.5),
    "column_diameter": Variable(SYMBOLS["D"], "m", 0.4, 2.5, 0.02),
    "column_height": Variable(SYMBOLS["H"], "m", 2.0, 15.0, 0.1),
    "impact_height": Variable(SYMBOLS["z"], "m", 0.2, 5.0, 0.05),
    "base": Variable(SYMBOLS["base"], choices=_ENDS),
    "top": Variable(SYMBOLS["top"], choices=_ENDS),
    "damping_ratio": Variable(SYMBOLS["zeta"], low=0.0, high=0.3, step=0.005),
    "pier_frequency": Variable(SYMBOLS["fp"], "Hz", 2.0, 200.0, 0.01, log=True),
    "pier_mass": Variable(SYMBOLS["mp"], "t", 0.5, 100.0, 0.01, log=True),
    **CRUSH,
}
