"""The exercises of the teaching notebooks; every answer is computed by the package."""

import math
from functools import cache

from pierimpact.codes import aashto_lrfd, en_1991_1_7_hard_impact
from pierimpact.collision import peak_reactions, simulate
from pierimpact.design.formulas import approach_speed
from pierimpact.design.reaction import design_reaction
from pierimpact.history import CollisionHistory
from pierimpact.teaching.checker import Question, Trap
from pierimpact.teaching.scenario import FREQUENCIES, REFERENCE, Scenario, body_frequency
from pierimpact.units import printed

_KMH = 1.0 / 3.6
_ENGINE, _BODY = REFERENCE.engine_spring, REFERENCE.body_spring
_HELD = _BODY.plateau_force + REFERENCE.friction_force
_ENGINE_NOT_CARGO = "That is the cargo’s, not the engine’s."
_CARGO_NOT_ENGINE = "That is the engine’s, not the cargo’s."


def _energy(speed: float, mass: float = REFERENCE.mass) -> float:
    return 0.5 * mass * speed**2


def _stopping_speed(force: float, mass: float, length: float) -> float:
    """Return the speed that a constant force over a length takes off a mass altogether."""
    return math.sqrt(2.0 * force * length / mass)


def _speed_left(force: float, mass: float, length: float) -> float:
    """Return what is left of 60 km/h when a constant force has slowed a mass over a length."""
    return float(approach_speed(_SLOW, force / mass, length))


@cache
def _history(scenario: Scenario) -> CollisionHistory:
    strike = scenario.strike
    return simulate(strike.truck, strike.pier, strike.speed)


def _cargo(scenario: Scenario) -> float:
    peak = _history(scenario).cargo_peak
    assert peak is not None
    return peak.reaction


def _engine(scenario: Scenario) -> float:
    return _history(scenario).engine_peak.reaction


_SLOW, _USUAL = 60.0 * _KMH, 80.0 * _KMH


def _grows_with_mass() -> str:
    light, heavy = Scenario(), Scenario(truck_mass=20e3)
    growth = (_engine(heavy) / _engine(light), _cargo(heavy) / _cargo(light))
    return _CHOICES_BODY[0] if growth[0] > growth[1] else _CHOICES_BODY[1]


_CHOICES_BODY = ("the engine peak", "the cargo peak")

_COLLISION = (
    Question(
        words=f"The truck of the explorer weighs {REFERENCE.mass / 1e3:g} t. What is its kinetic "
        "energy at 60 km/h?",
        dimension="energy",
        answer=lambda: _energy(_SLOW),
        traps=(
            Trap(
                lambda: _energy(_SLOW, REFERENCE.engine_mass),
                "That is the engine’s energy alone; the whole truck is asked for.",
            ),
            Trap(
                lambda: _energy(_SLOW, REFERENCE.body_mass),
                "That leaves the engine out; the whole truck is asked for.",
            ),
        ),
        reason="Almost all of it ends as crushed metal.",
    ),
    Question(
        words=f"On its way to the pier the engine (m₁ = {REFERENCE.engine_mass:g} kg) is slowed by "
        f"the plateau force P₁ = {_ENGINE.plateau_force / 1e3:g} kN over the length d₁ = "
        f"{_ENGINE.plateau_length:g} m. The truck comes at 60 km/h. How fast is the engine when "
        "it meets a pier that does not give way?",
        dimension="speed",
        answer=lambda: _speed_left(
            _ENGINE.plateau_force, REFERENCE.engine_mass, _ENGINE.plateau_length
        ),
        traps=(
            Trap(
                lambda: _speed_left(_HELD, REFERENCE.body_mass, _BODY.plateau_length),
                _ENGINE_NOT_CARGO,
            ),
            Trap(
                lambda: _speed_left(_ENGINE.plateau_force, REFERENCE.mass, _ENGINE.plateau_length),
                "That slows the whole truck; P₁ acts on the engine alone.",
            ),
            Trap(
                lambda: (
                    _SLOW
                    - _stopping_speed(
                        _ENGINE.plateau_force, REFERENCE.engine_mass, _ENGINE.plateau_length
                    )
                ),
                "Energies add up, speeds do not: v² is what the plateau takes from.",
            ),
        ),
        reason="The engine is light, so its plateau slows it quickly.",
    ),
    Question(
        words=f"Spring 2 and friction hold the body (m₂ = {REFERENCE.body_mass:g} kg) with "
        f"{_BODY.plateau_force / 1e3:g} kN and {REFERENCE.friction_force / 1e3:g} kN over "
        f"{_BODY.plateau_length:g} m. How fast must the truck be for its cargo to reach a pier "
        "that does not give way?",
        dimension="speed",
        answer=lambda: _stopping_speed(_HELD, REFERENCE.body_mass, _BODY.plateau_length),
        traps=(
            Trap(
                lambda: _stopping_speed(
                    _BODY.plateau_force, REFERENCE.body_mass, _BODY.plateau_length
                ),
                "That leaves out the friction.",
            ),
            Trap(
                lambda: _stopping_speed(
                    _ENGINE.plateau_force, REFERENCE.engine_mass, _ENGINE.plateau_length
                ),
                _CARGO_NOT_ENGINE,
            ),
        ),
        tolerance=0.01,
        reason="Move the speed slider across it: the second spike comes and goes.",
    ),
    Question(
        words="Load the truck of the explorer from 8 t to 20 t, all else as it is. Which spike "
        "grows more?",
        choices=_CHOICES_BODY,
        answer=_grows_with_mass,
        reason="The load is behind the engine, and not tied to it in this model.",
    ),
)

_PILLAR = Scenario(column_diameter=0.8, column_height=4.0, top="free", impact_height=1.2)


def _flexure() -> float:
    return _PILLAR.impact_height**3 / (3.0 * _PILLAR.column.flexural_rigidity)


def _shear() -> float:
    return _PILLAR.impact_height / _PILLAR.column.shear_rigidity


def _softer_when_higher() -> str:
    low, high = Scenario(impact_height=1.05), Scenario(impact_height=1.35)
    stiffer = high.strike.pier.stiffness > low.strike.pier.stiffness
    return "stiffer" if stiffer else "softer"


_PIER = (
    Question(
        words="A cantilever is fixed at its base and free at its top. It is struck at z_n = "
        f"{_PILLAR.impact_height:g} m; EI = "
        f"{printed(_PILLAR.column.flexural_rigidity, 'flexural rigidity', 'SI')} and κGA = "
        f"{printed(_PILLAR.column.shear_rigidity, 'shear rigidity', 'SI')}. What is its stiffness "
        "k_p there?",
        dimension="stiffness",
        answer=lambda: _PILLAR.strike.pier.stiffness,
        traps=(
            Trap(lambda: 1.0 / _flexure(), "That leaves out the shear deflection."),
            Trap(lambda: 1.0 / _shear(), "That leaves out the flexural deflection."),
            Trap(
                lambda: 1.0 / _flexure() + 1.0 / _shear(),
                "The deflections of flexure and shear add up, not their stiffnesses.",
            ),
        ),
        reason="So low on a stout column shear matters as much as flexure does.",
    ),
    Question(
        words=f"The column of the explorer at its defaults weighs "
        f"{printed(Scenario().column.mass_per_length, 'mass per length', 'SI')} and is "
        f"{Scenario().column_height:g} m high; the integral of φ² over its height is "
        f"{Scenario().column.struck_at(1.2).shape_integral:.4g} m. What is m_p?",
        dimension="mass",
        answer=lambda: Scenario().strike.pier.mass,
        traps=(
            Trap(
                lambda: Scenario().column.mass_per_length * Scenario().column_height,
                "That is the whole column; only what moves with the impact counts, by φ².",
            ),
        ),
        reason="φ exceeds 1 above the impact, and yet less than the whole column takes part.",
    ),
    Question(
        words=f"A pier has k_p = {printed(500e6, 'stiffness', 'SI', given=True)} and m_p = "
        f"{printed(5e3, 'mass', 'SI', given=True)}. What is its frequency f_p?",
        dimension="frequency",
        answer=lambda: math.sqrt(500e6 / 5e3) / (2.0 * math.pi),
        traps=(
            Trap(lambda: math.sqrt(500e6 / 5e3), "That is ω_p in rad/s; f_p is asked for."),
            Trap(lambda: 500e6 / 5e3 / (2.0 * math.pi), "The root is missing."),
        ),
        reason="Most bridge piers struck low down are this stiff, or stiffer.",
    ),
    Question(
        words="The column of the explorer is fixed at its base. When the impact moves up from "
        "1.05 m to 1.35 m, the pier becomes …",
        choices=("stiffer", "softer"),
        answer=_softer_when_higher,
        reason="The lever is longer: less force for the same deflection.",
    ),
)

_MIDDLE = Scenario(pier_mass=8e3, pier_frequency=30.0)


def _beta(body: str) -> float:
    mass, spring = (
        (REFERENCE.engine_mass, _ENGINE) if body == "engine" else (REFERENCE.body_mass, _BODY)
    )
    return _MIDDLE.strike.pier.frequency / body_frequency(mass, spring.stiffness)


_REDUCTION = (
    Question(
        words=f"The engine has m₁ = {REFERENCE.engine_mass:g} kg and k₁ = "
        f"{_ENGINE.stiffness / 1e6:g} MN/m, the pier has f_p = 30 Hz. What is the engine’s "
        "frequency ratio β?",
        answer=lambda: _beta("engine"),
        traps=(
            Trap(lambda: _beta("cargo"), _ENGINE_NOT_CARGO),
            Trap(lambda: 1.0 / _beta("engine"), "β has the pier’s frequency above the engine’s."),
        ),
        reason="Below 1 the pier is slow: it feels the engine’s blow as an impulse.",
    ),
    Question(
        words=f"The engine meets the pier at 50 km/h. What is v₁ √(k₁ m₁), the largest force of "
        f"its spring on a rigid pier? (m₁ = {REFERENCE.engine_mass:g} kg, k₁ = "
        f"{_ENGINE.stiffness / 1e6:g} MN/m)",
        dimension="force",
        answer=lambda: 50.0 * _KMH * math.sqrt(_ENGINE.stiffness * REFERENCE.engine_mass),
        traps=(
            Trap(
                lambda: 50.0 * _KMH * math.sqrt(_BODY.stiffness * REFERENCE.body_mass),
                _ENGINE_NOT_CARGO,
            ),
        ),
        reason="Speed, stiffness and mass: nothing else enters a hard impact.",
    ),
    Question(
        words=f"A soft, heavy pier has β = 0.1 for the engine. The engine’s spring unloads on "
        f"k_u1 = {_ENGINE.unloading_stiffness / 1e6:g} MN/m after loading on "
        f"{_ENGINE.stiffness / 1e6:g} MN/m. What is S by the impulse limit?",
        answer=lambda: (1.0 + _ENGINE.restitution) * 0.1,
        traps=(
            Trap(lambda: 0.1, "That leaves out the rebound: the engine does not just stop."),
            Trap(
                lambda: (1.0 + _ENGINE.restitution**2) * 0.1,
                "The restitution is the root of k over k_u.",
            ),
        ),
        reason="The pier feels a tenth of the force and all of the impulse.",
    ),
)

_SOFT = Scenario(pier_mass=8e3, pier_frequency=10.0)


def _crossing() -> float:
    """Return the frequency from which the engine governs, between two of the spectrum's [Hz]."""
    full = _MIDDLE.strike.curves.full
    first = int((full["engine"] > full["cargo"]).argmax())
    return float(math.sqrt(FREQUENCIES[first - 1] * FREQUENCIES[first]))


def _least_by_mass() -> str:
    light, heavy = (Scenario(truck_mass=m, pier_mass=8e3, pier_frequency=60.0) for m in (8e3, 16e3))
    changes = (_engine(heavy) / _engine(light), _cargo(heavy) / _cargo(light))
    return _CHOICES_BODY[0] if abs(changes[0] - 1) < abs(changes[1] - 1) else _CHOICES_BODY[1]


_SPECTRA = (
    Question(
        words="Set the pier to 10 Hz and 8 t, the rest to the defaults. What is the engine peak?",
        dimension="force",
        answer=lambda: _engine(_SOFT),
        traps=(Trap(lambda: _cargo(_SOFT), _ENGINE_NOT_CARGO),),
        reason="The engine’s spring pressed far harder, but the pier was too slow to feel it.",
    ),
    Question(
        words="And the cargo peak of the same pier?",
        dimension="force",
        answer=lambda: _cargo(_SOFT),
        traps=(Trap(lambda: _engine(_SOFT), _CARGO_NOT_ENGINE),),
        reason="The cargo presses for longer than the pier takes to swing.",
    ),
    Question(
        words="For a pier of 8 t struck at the defaults: from which frequency on does the engine "
        "govern? (within 5 %)",
        dimension="frequency",
        tolerance=0.05,
        answer=_crossing,
        reason="A stiff pier feels the engine, a soft one does not.",
    ),
    Question(
        words="Double the truck’s mass to 16 t at 60 Hz. Which peak hardly moves?",
        choices=_CHOICES_BODY,
        answer=_least_by_mass,
        reason="The engine’s mass did not change.",
    ),
)

_HEAVY_MASS, _HEAVY_SPEED = 30e3, 90.0 * _KMH


def _design(level: str = "refined") -> float:
    strike = Scenario(speed=_SLOW).strike
    return design_reaction(strike.truck, strike.pier, strike.speed, level).reaction


def _design_of(body: str) -> float:
    strike = Scenario(speed=_SLOW).strike
    design = design_reaction(strike.truck, strike.pier, strike.speed)
    return design.engine if body == "engine" else design.cargo or 0.0


_DESIGN = (
    Question(
        words="Set the speed to 60 km/h, the rest to the defaults. What is the design reaction?",
        dimension="force",
        tolerance=0.01,
        answer=_design,
        traps=(
            Trap(lambda: _design_of("cargo"), "That is the cargo’s; the larger of the two counts."),
            Trap(lambda: _engine(Scenario(speed=_SLOW)), "That is the full model’s engine peak."),
        ),
        reason="The procedure takes the larger of engine and cargo.",
    ),
    Question(
        words="EN 1991-1-7, Annex C, has F = v √(k m) for a hard impact. With k = 300 kN/m "
        "(second-hand: check against the standard), what is F for 30 t at 90 km/h?",
        dimension="force",
        answer=lambda: en_1991_1_7_hard_impact(_HEAVY_SPEED, _HEAVY_MASS).along.value,
        reason="The formula is that of a spring on a rigid pier: S = 1.",
    ),
    Question(
        words="How many times the AASHTO force of 600 kip is the design reaction of the first "
        "exercise?",
        tolerance=0.03,
        answer=lambda: _design() / aashto_lrfd().along.value,
        traps=(
            Trap(
                lambda: aashto_lrfd().along.value / _design(),
                "Upside down: the design reaction over the code’s force.",
            ),
        ),
        reason="A peak reaction and an equivalent static force are not the same thing: see below.",
    ),
)


def _most_for_engine() -> str:
    strike = Scenario().strike
    changed = {
        "the engine’s mass": Scenario(engine_mass=1.3 * REFERENCE.engine_mass),
        "the body’s plateau length": Scenario(body_plateau_length=1.3 * _BODY.plateau_length),
        "the friction": Scenario(friction_force=1.3 * REFERENCE.friction_force),
    }
    pier = strike.pier
    peaks = peak_reactions(
        [scenario.truck for scenario in changed.values()],
        pier.mass, pier.stiffness, pier.damping_ratio, strike.speed,
    ).engine  # fmt: skip
    before = _engine(Scenario())
    return max(zip(changed, peaks, strict=True), key=lambda pair: abs(pair[1] - before))[0]


_LIMITS = (
    Question(
        words="Each of these grows by 30 %. Which moves the engine peak most?",
        choices=("the engine’s mass", "the body’s plateau length", "the friction"),
        answer=_most_for_engine,
        reason="It enters through the root of the mass, and through the time it takes to arrive.",
    ),
    Question(
        words=f"The body’s spring has k = {_BODY.stiffness / 1e6:g} MN/m and k_u = "
        f"{_BODY.unloading_stiffness / 1e6:g} MN/m. With which fraction of its approach speed "
        "would the cargo come back from a rigid pier, by its steep spring alone?",
        answer=lambda: _BODY.restitution,
        traps=(
            Trap(
                lambda: _BODY.restitution**2,
                "That is the fraction of the energy; the speed is its root.",
            ),
            Trap(lambda: 1.0 / _BODY.restitution, "No more speed comes back than arrived."),
        ),
        reason="The law that joins loading and unloading is this project’s own.",
    ),
    Question(
        words="Whose numbers are the truck’s parameters in these notebooks?",
        choices=(
            "Table 1 of the source paper",
            "illustrative values of this project",
            "a crash test",
        ),
        answer=lambda: "illustrative values of this project",
        reason="Enter your own truck’s, with their source, before you rely on a result.",
    ),
)

#: The exercises of each notebook.
QUESTIONS: dict[str, tuple[Question, ...]] = {
    "collision": _COLLISION,
    "pier": _PIER,
    "reduction": _REDUCTION,
    "spectra": _SPECTRA,
    "design": _DESIGN,
    "limits": _LIMITS,
}
