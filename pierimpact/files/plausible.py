"""Values that a case may have but seldom has: a slip of a digit or of a unit, most likely."""

from collections.abc import Iterator
from typing import NamedTuple

from pierimpact.files.inputs import Inputs

#: What is usual, by key, in SI units: wide, and this project's judgement.
USUAL = {
    "column_diameter": (0.3, 5.0),
    "column_width": (0.2, 10.0),
    "column_depth": (0.2, 5.0),
    "column_wall_thickness": (5e-3, 1.5),
    "column_across_flats": (0.3, 5.0),
    "column_height": (2.0, 30.0),
    "elastic_modulus": (10e9, 220e9),
    "concrete_strength": (15e6, 120e6),
    "poisson_ratio": (0.1, 0.35),
    "density": (1500.0, 8000.0),
    "stiffness_factor": (0.2, 1.0),
    "top_mass": (100.0, 2e6),
    "embedment": (0.1, 10.0),
    "truck_mass": (1e3, 80e3),
    "speed": (10.0 / 3.6, 160.0 / 3.6),
    "impact_height": (0.3, 3.0),
    "damping_ratio": (0.005, 0.2),
    "shear_resistance": (50e3, 100e6),
    "moment_resistance": (50e3, 500e6),
}


class Unusual(NamedTuple):
    """A value outside what is usual, in SI units."""

    key: str
    value: float
    least: float
    most: float


def unusual(inputs: Inputs) -> Iterator[Unusual]:
    """Yield the values of a case that are outside what is usual."""
    for key, (least, most) in USUAL.items():
        value = getattr(inputs, key)
        if isinstance(value, float) and not least <= value <= most:
            yield Unusual(key, value, least, most)
