"""Exercises of the lesson on one collision."""

import math

from pierimpact.teaching.checker import Question, Trap
from pierimpact.teaching.questions.common import (
    BODY,
    CARGO_NOT_ENGINE,
    ENGINE,
    ENGINE_NOT_CARGO,
    PEAKS,
    SLOW,
    cargo_peak,
    engine_peak,
)
from pierimpact.teaching.scenario import REFERENCE, Scenario

_RESISTANCE = BODY.plateau_force + REFERENCE.friction_force


def _energy(speed: float, mass: float = REFERENCE.mass) -> float:
    return 0.5 * mass * speed**2


def _stopping_speed(force: float, mass: float, length: float) -> float:
    """Return the speed from which a constant force stops a mass over a length."""
    return math.sqrt(2.0 * force * length / mass)


def _speed_left(force: float, mass: float, length: float) -> float:
    """Return the speed left of 60 km/h after a constant force has slowed a mass over a length."""
    return math.sqrt(SLOW**2 - 2.0 * force * length / mass)


def _grows_with_mass() -> str:
    light, heavy = Scenario(), Scenario(truck_mass=20e3)
    growth = (engine_peak(heavy) / engine_peak(light), cargo_peak(heavy) / cargo_peak(light))
    return PEAKS[0] if growth[0] > growth[1] else PEAKS[1]


QUESTIONS = (
    Question(
        words=f"The explorer’s truck has a mass of {REFERENCE.mass / 1e3:g} t. What is its kinetic "
        "energy at 60 km/h?",
        dimension="energy",
        answer=lambda: _energy(SLOW),
        traps=(
            Trap(
                lambda: _energy(SLOW, REFERENCE.engine_mass),
                "That is the energy of the engine alone; the question is about the whole truck.",
            ),
            Trap(
                lambda: _energy(SLOW, REFERENCE.body_mass),
                "That leaves out the engine; the question is about the whole truck.",
            ),
        ),
        reason="Almost all of it is dissipated in crushing metal.",
    ),
    Question(
        words=f"On its way to the pier the engine (m₁ = {REFERENCE.engine_mass:g} kg) is slowed by "
        f"the plateau force P₁ = {ENGINE.plateau_force / 1e3:g} kN over the length d₁ = "
        f"{ENGINE.plateau_length:g} m. The truck’s speed is 60 km/h. How fast is the engine when "
        "it strikes a rigid pier?",
        dimension="speed",
        answer=lambda: _speed_left(
            ENGINE.plateau_force, REFERENCE.engine_mass, ENGINE.plateau_length
        ),
        traps=(
            Trap(
                lambda: _speed_left(_RESISTANCE, REFERENCE.body_mass, BODY.plateau_length),
                ENGINE_NOT_CARGO,
            ),
            Trap(
                lambda: _speed_left(ENGINE.plateau_force, REFERENCE.mass, ENGINE.plateau_length),
                "That slows the whole truck; P₁ acts on the engine alone.",
            ),
            Trap(
                lambda: (
                    SLOW
                    - _stopping_speed(
                        ENGINE.plateau_force, REFERENCE.engine_mass, ENGINE.plateau_length
                    )
                ),
                "Energies subtract, speeds do not: the plateau reduces v².",
            ),
        ),
        reason="The engine is light, so its plateau slows it quickly.",
    ),
    Question(
        words=f"Spring 2 and friction slow the body (m₂ = {REFERENCE.body_mass:g} kg) with "
        f"{BODY.plateau_force / 1e3:g} kN and {REFERENCE.friction_force / 1e3:g} kN over "
        f"{BODY.plateau_length:g} m. Above which speed of the truck does its cargo reach a rigid "
        "pier?",
        dimension="speed",
        answer=lambda: _stopping_speed(_RESISTANCE, REFERENCE.body_mass, BODY.plateau_length),
        traps=(
            Trap(
                lambda: _stopping_speed(
                    BODY.plateau_force, REFERENCE.body_mass, BODY.plateau_length
                ),
                "That leaves out the friction.",
            ),
            Trap(
                lambda: _stopping_speed(
                    ENGINE.plateau_force, REFERENCE.engine_mass, ENGINE.plateau_length
                ),
                CARGO_NOT_ENGINE,
            ),
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
