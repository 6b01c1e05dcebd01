"""Exercises of the lesson on the spectra."""

import math

from pierimpact.teaching.checker import Question, Trap
from pierimpact.teaching.questions.common import (
    CARGO_NOT_ENGINE,
    ENGINE_NOT_CARGO,
    PEAKS,
    cargo_peak,
    engine_peak,
    growth,
)
from pierimpact.teaching.scenario import EXAMPLE, FREQUENCIES, Scenario

_SOFT = Scenario(pier_mass=8e3, pier_frequency=10.0)


def _crossing() -> float:
    """Return the frequency from which the engine governs, between two of the spectrum's [Hz]."""
    full = EXAMPLE.curves.full
    first = int((full["engine"] > full["cargo"]).argmax())
    return float(math.sqrt(FREQUENCIES[first - 1] * FREQUENCIES[first]))


def _least_by_mass() -> str:
    pair = (Scenario(truck_mass=m, pier_mass=8e3, pier_frequency=60.0) for m in (8e3, 16e3))
    engine, cargo = growth(*pair)
    return PEAKS[0] if abs(engine - 1) < abs(cargo - 1) else PEAKS[1]


QUESTIONS = (
    Question(
        words="Set the pier to 10 Hz and 8 t and leave the rest at the defaults. What is the "
        "engine peak?",
        dimension="force",
        answer=lambda: engine_peak(_SOFT),
        traps=(Trap(lambda: cargo_peak(_SOFT), ENGINE_NOT_CARGO),),
        reason="The engine’s spring force was far larger, but too brief for this pier.",
    ),
    Question(
        words="And the cargo peak of the same pier?",
        dimension="force",
        answer=lambda: cargo_peak(_SOFT),
        traps=(Trap(lambda: engine_peak(_SOFT), CARGO_NOT_ENGINE),),
        reason="The cargo’s force lasts long enough for the pier to respond.",
    ),
    Question(
        words="For a pier of 8 t and the default truck and speed, above which frequency does the "
        "engine govern? (within 5 %)",
        dimension="frequency",
        tolerance=0.05,
        answer=_crossing,
        reason="A stiff pier responds to the engine, a soft one does not.",
    ),
    Question(
        words="Double the truck’s mass to 16 t at 60 Hz. Which peak hardly changes?",
        choices=PEAKS,
        answer=_least_by_mass,
        reason="The engine’s mass did not change.",
    ),
)
