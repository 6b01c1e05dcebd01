"""Values that a case may have but seldom has: a slip of a digit or of a unit, most likely."""

from collections.abc import Iterator
from typing import NamedTuple

from pierimpact.files.inputs import Inputs, SectionInputs
from pierimpact.symbols import BY_KEY
from pierimpact.units import printed, rounded, unit_size

#: What is usual, by key, in SI units: wide, and this project's judgement.
USUAL = {
    "column_diameter": (0.3, 5.0),
    "column_width": (0.2, 10.0),
    "column_depth": (0.2, 5.0),
    "column_wall_thickness": (5e-3, 1.5),
    "column_across_flats": (0.3, 5.0),
    "column_area": (0.05, 50.0),
    "column_second_moment": (1e-4, 500.0),
    "column_shear_area": (0.01, 50.0),
    "modular_ratio": (3.0, 20.0),
    "density_ratio": (2.5, 5.0),
    "column_height": (2.0, 30.0),
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
    "traffic_volume": (100.0 / 86400.0, 200e3 / 86400.0),
    "truck_share": (0.01, 1.0),
    "distance_from_road": (0.3, 30.0),
    "exposed_width": (2.5, 20.0),
    "encroachment_rate": (1e-12, 1e-8),
}
#: The elastic modulus that is usual up to a density, concrete and the like below steel [Pa]: this
#: project's judgement, as is the density between them [kg/m³].
USUAL_MODULI = {4500.0: (10e9, 60e9), float("inf"): (180e9, 220e9)}


class Unusual(NamedTuple):
    """A value outside what is usual, in SI units."""

    key: str
    value: float
    least: float
    most: float
    step: int = 0  #: number of the step that it is of, from 1; 0 where it is of none

    def sentence(self, system: str) -> str:
        """Return the sentence that names the value and what is usual, in "SI" or "US" units."""
        symbol = BY_KEY[self.key]
        size = unit_size(symbol.quantity, system)
        least, most = (rounded(end / size, 2) for end in (self.least, self.most))
        where = f" in step {self.step}" if self.step else ""
        shown = printed(self.value, symbol.quantity, system, given=True)
        return (
            f"Unusual: {symbol.meaning} {shown}{where}, where {least} to {most} is usual. "
            "Check the value and its unit."
        )


def unusual(inputs: Inputs) -> Iterator[Unusual]:
    """Yield the values of a case that are outside what is usual, those of its steps last."""
    modulus = next(usual for most, usual in USUAL_MODULI.items() if inputs.density <= most)
    yield from _of(inputs, USUAL | {"elastic_modulus": modulus})
    for number, step in enumerate(inputs.steps, 1):
        yield from (found._replace(step=number) for found in _of(step, USUAL))


def _of(inputs: SectionInputs, usual: dict[str, tuple[float, float]]) -> Iterator[Unusual]:
    for key, (least, most) in usual.items():
        value = getattr(inputs, key, None)
        if isinstance(value, float) and not least <= value <= most:
            yield Unusual(key, value, least, most)
