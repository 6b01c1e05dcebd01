"""What a value of a file may be: far beyond any real pier or truck, yet within what can be worked.

A value outside is a slip of a unit or of many digits, and is refused; one that is only seldom seen
is named on the sheet (`pierimpact.files.plausible`).
"""

from collections.abc import Sequence
from typing import Any

from pierimpact.checks import InputError, brief
from pierimpact.symbols import BY_KEY
from pierimpact.units import SYSTEMS, Printed, rounded, unit_of, unit_size

# Of either spring, in SI units: this project's choice.
_SPRING = {
    "plateau_force": (1.0, 1e9),
    "plateau_length": (1e-6, 50.0),
    "stiffness": (1e3, 1e12),
    "unloading_stiffness": (1e3, 1e13),
}
#: What is possible, by key of case and truck files, in SI units: this project's choice.
POSSIBLE = {
    **dict.fromkeys(("column_diameter", "column_width", "column_depth"), (0.05, 50.0)),
    "column_wall_thickness": (1e-3, 10.0),
    "column_across_flats": (0.05, 50.0),
    "column_area": (1e-3, 1e3),
    "column_second_moment": (1e-7, 1e5),
    "column_shear_area": (1e-4, 1e3),
    "modular_ratio": (0.1, 100.0),
    "density_ratio": (0.1, 100.0),
    "column_height": (0.2, 200.0),
    "elastic_modulus": (1e8, 1e12),
    "concrete_strength": (1e6, 1e9),
    "density": (100.0, 3e4),
    "stiffness_factor": (0.01, 1.0),
    "effective_stiffness": (1e3, 1e14),
    **dict.fromkeys(("base_stiffness", "top_stiffness"), (1e3, 1e13)),
    **dict.fromkeys(("base_rotation_stiffness", "top_rotation_stiffness"), (1e3, 1e14)),
    "top_mass": (0.1, 1e8),
    "embedment": (1e-3, 50.0),
    "truck_mass": (100.0, 1e6),
    "speed": (0.1, 150.0),
    "impact_height": (0.0, 50.0),
    **dict.fromkeys(("shear_resistance", "moment_resistance"), (100.0, 1e12)),
    "traffic_volume": (1.0 / 86400.0, 1e7 / 86400.0),
    "distance_from_road": (0.0, 1e3),
    "exposed_width": (0.1, 100.0),
    "encroachment_rate": (1e-15, 1e-4),
    **dict.fromkeys(("engine_mass", "body_mass"), (1.0, 1e6)),
    "friction_force": (0.0, 1e9),
    **{f"engine_spring.{name}": ends for name, ends in _SPRING.items()},
    **{f"body_spring.{name}": ends for name, ends in _SPRING.items()},
}
#: Most that a deceleration off the road may be [m/s²]: this project's choice.
BRAKING = 100.0
#: Of a pier given as one degree of freedom: mass [kg] and stiffness [N/m]; this project's choice.
PIER_MASS, PIER_STIFFNESS = (1.0, 1e9), (1e3, 1e13)
#: Least distance of the impact from the ends of the column, and of its steps from each other and
#: from the ends [m]: this project's choice.
LEAST_PART = 0.05


def possible(key: str, value: float, given: object) -> float:
    """Return a value [SI units] if it is possible.

    Parameters
    ----------
    key : str
        Key of a case file or of a truck file; any value is possible where it has no limits.
    value : float
        The value [SI units].
    given : object
        The value as it was typed, to be named in errors.

    Raises
    ------
    InputError
        When it is outside.
    """
    if key in POSSIBLE:
        within(key, value, POSSIBLE[key], BY_KEY[key].quantity, given)
    return value


def within(
    name: str, value: float, ends: tuple[float, float], quantity: str, given: object
) -> float:
    """Return a value [SI units] if it lies between the ends; errors as in `possible`."""
    if not ends[0] <= value <= ends[1]:
        words, *others = dict.fromkeys(ends_in(quantity, ends, system) for system in SYSTEMS)
        more = f" ({others[0]})" if others else ""
        raise InputError(f"{name} must be from {words}{more}, got {brief(given)}")
    return value


def ends_in(quantity: str, ends: Sequence[float], system: str) -> str:
    """Return a range in words, such as "2.0 to 30 m".

    Parameters
    ----------
    quantity : str
        Kind of the value, of `units.QUANTITIES`.
    ends : sequence of float
        Least and most [SI units].
    system : {"SI", "US"}
        Units to print in.
    """
    size: Any = unit_size(quantity, system)
    least, most = (rounded(end / size, 2) for end in ends)
    return str(Printed(f"{least} to {most}", unit_of(quantity, system)))


def possible_in(key: str, system: str) -> str:
    """Return what is possible for a key's value in words; "" where it has no limits."""
    return ends_in(BY_KEY[key].quantity, POSSIBLE[key], system) if key in POSSIBLE else ""
