"""The values that a control of an explorer can set, with their units and ranges."""

from dataclasses import dataclass

from pierimpact.symbols import SYMBOLS, Symbol, dimension
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
    def size(self) -> float:
        """Return the unit in SI units."""
        if not self.unit:
            return 1.0
        return parse(self.symbol.heading, f"1 {self.unit}", dimension(self.symbol))


#: The truck's parameters.
CRUSH = {
    "engine_mass": Variable(SYMBOLS["m1"], "kg", 200.0, 2000.0, 50.0),
    "friction_force": Variable(SYMBOLS["cs"], "kN", 0.0, 100.0, 0.5),
    "engine_plateau_force": Variable(SYMBOLS["P1"], "kN", 20.0, 600.0, 10.0),
    "engine_plateau_length": Variable(SYMBOLS["d1"], "m", 0.05, 1.5, 0.05),
    "engine_stiffness": Variable(SYMBOLS["k1"], "MN/m", 20.0, 600.0, 0.01, log=True),
    "engine_unloading_stiffness": Variable(SYMBOLS["ku1"], "MN/m", 20.0, 6000.0, 0.01, log=True),
    "body_plateau_force": Variable(SYMBOLS["P2"], "kN", 50.0, 1500.0, 10.0),
    "body_plateau_length": Variable(SYMBOLS["d2"], "m", 0.2, 4.0, 0.05),
    "body_stiffness": Variable(SYMBOLS["k2"], "MN/m", 1.0, 100.0, 0.01, log=True),
    "body_unloading_stiffness": Variable(SYMBOLS["ku2"], "MN/m", 1.0, 1000.0, 0.01, log=True),
}
_ENDS = ("fixed", "pinned", "free")
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
    "traffic_volume": Variable(SYMBOLS["N_v"], "veh/day", 1e3, 1e5, 0.01, log=True),
    "truck_share": Variable(SYMBOLS["p_t"], low=0.02, high=0.5, step=0.01),
    "distance_from_road": Variable(SYMBOLS["d_r"], "m", 0.0, 20.0, 0.5),
    "mean_mass": Variable(SYMBOLS["mu_m"], "t", 5.0, 35.0, 0.5),
    "mean_speed": Variable(SYMBOLS["mu_V"], "km/h", 30.0, 110.0, 1.0),
    "resistance": Variable(SYMBOLS["R_R"], "MN", 0.5, 15.0, 0.1),
    "risk_pier": Variable(SYMBOLS["risk_pier"], choices=("10 Hz", "30 Hz", "100 Hz")),
}
