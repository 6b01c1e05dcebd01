"""Truck collisions with bridge piers: the CMSD model, its spectra, and design calculations."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pierimpact.checks import InputError
    from pierimpact.collision.parameters import Collision
    from pierimpact.collision.simulate import peak_reactions, simulate
    from pierimpact.design.band import reaction_band
    from pierimpact.design.fit import fit_truck
    from pierimpact.design.reaction import design_reaction, design_reactions
    from pierimpact.design.spectra import cargo_spectrum, engine_spectrum
    from pierimpact.files.trucks import load_truck
    from pierimpact.pier.column import PierColumn, Step
    from pierimpact.pier.equivalent import EquivalentPier
    from pierimpact.pier.sections import (
        CircularSection,
        FilledCircularSection,
        FilledRectangularSection,
        FreeSection,
        HollowCircularSection,
        HollowRectangularSection,
        OblongSection,
        RectangularSection,
        RegularPolygonSection,
    )
    from pierimpact.pier.static_forces import StaticForcesWarning
    from pierimpact.vehicle.crush import CrushSpring
    from pierimpact.vehicle.spread import Lognormal, Uniform
    from pierimpact.vehicle.truck import MassRangeWarning, Truck

    __version__: str

__all__ = [
    "CircularSection",
    "Collision",
    "CrushSpring",
    "EquivalentPier",
    "FilledCircularSection",
    "FilledRectangularSection",
    "FreeSection",
    "HollowCircularSection",
    "HollowRectangularSection",
    "InputError",
    "Lognormal",
    "MassRangeWarning",
    "OblongSection",
    "PierColumn",
    "RectangularSection",
    "RegularPolygonSection",
    "StaticForcesWarning",
    "Step",
    "Truck",
    "Uniform",
    "cargo_spectrum",
    "design_reaction",
    "design_reactions",
    "engine_spectrum",
    "exercises",
    "fit_truck",
    "load_truck",
    "maps",
    "peak_reactions",
    "predictions",
    "reaction_band",
    "simulate",
    "tables",
    "widgets",
]

# Each public name is imported on first use, so that `import pierimpact` costs nothing that the
# caller does not need.
_HOMES = {
    "checks": ["InputError"],
    "collision.parameters": ["Collision"],
    "collision.simulate": ["peak_reactions", "simulate"],
    "design.band": ["reaction_band"],
    "design.fit": ["fit_truck"],
    "design.reaction": ["design_reaction", "design_reactions"],
    "design.spectra": ["cargo_spectrum", "engine_spectrum"],
    "files.trucks": ["load_truck"],
    "pier.column": ["PierColumn", "Step"],
    "pier.equivalent": ["EquivalentPier"],
    "pier.sections": [
        "CircularSection",
        "FilledCircularSection",
        "FilledRectangularSection",
        "FreeSection",
        "HollowCircularSection",
        "HollowRectangularSection",
        "OblongSection",
        "RectangularSection",
        "RegularPolygonSection",
    ],
    "pier.static_forces": ["StaticForcesWarning"],
    "vehicle.crush": ["CrushSpring"],
    "vehicle.spread": ["Lognormal", "Uniform"],
    "vehicle.truck": ["MassRangeWarning", "Truck"],
}
_MODULES = ("exercises", "maps", "predictions", "tables", "widgets")


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return _version()
    if name in _MODULES:
        return import_module(f"{__name__}.teaching.{name}")
    for home, names in _HOMES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{home}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def _version() -> str:
    metadata = import_module("importlib.metadata")  # slow to import
    try:
        return str(metadata.version(__name__))
    except metadata.PackageNotFoundError:  # a checkout that was never installed
        return "0+unknown"


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
