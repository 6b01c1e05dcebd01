"""Truck collisions with bridge piers: the CMSD model, its spectra, and design calculations."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pierimpact.catalogue import load_truck
    from pierimpact.checks import InputError
    from pierimpact.collision import peak_reactions, simulate
    from pierimpact.column import PierColumn
    from pierimpact.crush import CrushSpring
    from pierimpact.design.reaction import design_reaction, design_reactions
    from pierimpact.pier import EquivalentPier
    from pierimpact.sections import CircularSection, RectangularSection
    from pierimpact.spectra import cargo_spectrum, engine_spectrum
    from pierimpact.truck import Truck

__version__ = "0.1.0"

# Each public name is imported on first use, so that `import pierimpact` costs nothing that the
# caller does not need.
_HOMES = {
    "CircularSection": "sections",
    "CrushSpring": "crush",
    "EquivalentPier": "pier",
    "InputError": "checks",
    "PierColumn": "column",
    "RectangularSection": "sections",
    "Truck": "truck",
    "cargo_spectrum": "spectra",
    "design_reaction": "design.reaction",
    "design_reactions": "design.reaction",
    "engine_spectrum": "spectra",
    "load_truck": "catalogue",
    "peak_reactions": "collision",
    "simulate": "collision",
}

__all__ = [
    "CircularSection",
    "CrushSpring",
    "EquivalentPier",
    "InputError",
    "PierColumn",
    "RectangularSection",
    "Truck",
    "cargo_spectrum",
    "design_reaction",
    "design_reactions",
    "engine_spectrum",
    "load_truck",
    "peak_reactions",
    "simulate",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
