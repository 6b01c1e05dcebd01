"""Hints and values that the questions of several lessons share."""

from functools import cache

from pierimpact.collision.history import CollisionHistory
from pierimpact.teaching.scenario import Scenario

KMH = 1.0 / 3.6

IN_KMH = "Was the speed that you put in in m/s? 36 km/h are 10 m/s."
MS_AS_KMH = "That is the number in m/s: convert it, or give it that unit."
KMH_AS_MS = "That is the number in km/h: convert it, or give it that unit."
NO_HALF = "Look at the kinetic energy again: there is a factor ½ in it."
IN_TONNES = "Was the mass that you put in in kg? One tonne is 1000 kg."
NO_ROOT = "The square root is missing."
OMEGA = "A circular frequency ω in rad/s and a frequency f in Hz differ by 2π."


@cache
def history(scenario: Scenario) -> CollisionHistory:
    """Return a collision by the full model."""
    return scenario.history


def growth(before: Scenario, after: Scenario) -> dict[str, float]:
    """Return engine and cargo peak after a change over those before it [-]."""
    pairs = zip(history(before).peaks.items(), history(after).peaks.values(), strict=True)
    return {body: new.reaction / old.reaction for (body, old), new in pairs if old and new}
