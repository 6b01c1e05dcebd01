"""Exercises of the lesson on one collision."""

import math

from pierimpact.teaching.checker import Question, Trap
from pierimpact.teaching.questions.common import (
    BODY,
    CARGO_NOT_ENGINE,
    ENGINE,
    ENGINE_NOT_CARGO,
    M1,
    M2,
    PEAKS,
    SLOW,
    growth,
)
from pierimpact.teaching.scenario import REFERENCE, Scenario

# What slows engine and body before they strike: the work of a force over a length [J].
_ENGINE_WORK = ENGINE.plateau_force * ENGINE.plateau_length
_BODY_WORK = (BODY.plateau_force + REFERENCE.friction_force) * BODY.plateau_length


def _energy(mass: float) -> float:
    return 0.5 * mass * SLOW**2


def _stopping_speed(work: float, mass: float) -> float:
    """Return the speed from which the work [J] of a force stops a mass."""
    return math.sqrt(2.0 * work / mass)


def _speed_left(work: float, mass: float) -> float:
    """Return the speed left of 60 km/h after the work [J] of a force has slowed a mass."""
    return math.sqrt(SLOW**2 - 2.0 * work / mass)


def _grows_with_mass() -> str:
    engine, cargo = growth(Scenario(), Scenario(truck_mass=20e3))
    return PEAKS[0] if engine > cargo else PEAKS[1]


QUESTIONS = (
    Question(
        words=f"The explorer’s truck has a mass of {REFERENCE.mass / 1e3:g} t. What is its kinetic "
        "energy at 60 km/h?",
        dimension="energy",
        answer=lambda: _energy(REFERENCE.mass),
        traps=(
            Trap(
                lambda: _energy(M1),
                "That is the energy of the engine alone; the question is about the whole truck.",
            ),
            Trap(
                lambda: _energy(M2),
                "That leaves out the engine; the question is about the whole truck.",
            ),
        ),
        reason="Almost all of it is dissipated in crushing metal.",
    ),
    Question(
        words=f"On its way to the pier the engine (m₁ = {M1:g} kg) is slowed by "
        f"the plateau force P₁ = {ENGINE.plateau_force / 1e3:g} kN over the length d₁ = "
        f"{ENGINE.plateau_length:g} m. The truck’s speed is 60 km/h. How fast is the engine when "
        "it strikes a rigid pier?",
        dimension="speed",
        answer=lambda: _speed_left(_ENGINE_WORK, M1),
        traps=(
            Trap(lambda: _speed_left(_BODY_WORK, M2), ENGINE_NOT_CARGO),
            Trap(
                lambda: _speed_left(_ENGINE_WORK, REFERENCE.mass),
                "That slows the whole truck; P₁ acts on the engine alone.",
            ),
            Trap(
                lambda: SLOW - _stopping_speed(_ENGINE_WORK, M1),
                "Energies subtract, speeds do not: the plateau reduces v².",
            ),
        ),
        reason="The engine is light, so its plateau slows it quickly.",
    ),
    Question(
        words=f"Spring 2 and friction slow the body (m₂ = {M2:g} kg) with "
        f"{BODY.plateau_force / 1e3:g} kN and {REFERENCE.friction_force / 1e3:g} kN over "
        f"{BODY.plateau_length:g} m. Above which speed of the truck does its cargo reach a rigid "
        "pier?",
        dimension="speed",
        answer=lambda: _stopping_speed(_BODY_WORK, M2),
        traps=(
            Trap(
                lambda: _stopping_speed(BODY.plateau_force * BODY.plateau_length, M2),
                "That leaves out the friction.",
            ),
            Trap(lambda: _stopping_speed(_ENGINE_WORK, M1), CARGO_NOT_ENGINE),
        ),
        tolerance=0.01,
        reason="Move the speed slider past this value: the second spike appears or disappears.",
    ),
    Question(
        words="Load the explorer’s truck from 8 t to 20 t and change nothing else. Which spike "
        "grows more?",
        choices=PEAKS,
        answer=_grows_with_mass,
        reason="The load is behind the engine, and not connected to it in this model.",
    ),
)
