"""The truck, peaks and hints that the questions of several lessons share."""

from functools import cache

from pierimpact.collision.history import CollisionHistory
from pierimpact.teaching.scenario import REFERENCE, Scenario

KMH = 1.0 / 3.6
SLOW = 60.0 * KMH  #: A speed that several questions ask about [m/s].
M1, M2 = REFERENCE.engine_mass, REFERENCE.body_mass
ENGINE, BODY = REFERENCE.engine_spring, REFERENCE.body_spring
ENGINE_NOT_CARGO = "That is the cargo’s, not the engine’s."
CARGO_NOT_ENGINE = "That is the engine’s, not the cargo’s."
PEAKS = ("the engine peak", "the cargo peak")


@cache
def _history(scenario: Scenario) -> CollisionHistory:
    return scenario.history


def engine_peak(scenario: Scenario) -> float:
    """Return the engine peak of a collision [N]."""
    return _history(scenario).engine_peak.reaction


def cargo_peak(scenario: Scenario) -> float:
    """Return the cargo peak of a collision that has one [N]."""
    peak = _history(scenario).cargo_peak
    assert peak is not None
    return peak.reaction


def growth(before: Scenario, after: Scenario) -> list[float]:
    """Return the engine and the cargo peak after a change over those before it [-]."""
    return [peak(after) / peak(before) for peak in (engine_peak, cargo_peak)]
