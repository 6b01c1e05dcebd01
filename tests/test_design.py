"""The design procedure: its accuracy, its numbers one by one, and what it says of itself."""

import dataclasses
import math

import numpy as np
import pytest
from calculator import Procedure
from generated_collisions import HARD
from generated_collisions import collisions as collisions_over_the_domain

from pierimpact import (
    EquivalentPier,
    InputError,
    PierColumn,
    design_reaction,
    design_reactions,
    load_truck,
    peak_reactions,
    simulate,
)
from pierimpact.collision.groups import select
from pierimpact.collision.parameters import parameter_chunks
from pierimpact.collision.reactions import full_model
from pierimpact.design import domain, study
from pierimpact.design.procedure import LEVELS, design_values
from pierimpact.design.reaction import predictions
from pierimpact.design.reduction import exact_amplification

TRUCK = load_truck("single-unit-8t")
PIER = EquivalentPier(mass=8e3, stiffness=284e6, damping_ratio=0.05)
SPEED = 80.0 / 3.6


# Accuracy, on cases that the formulas were not fitted to

SIZE, SEED = 1500, 1


@pytest.fixture(scope="module")
def sample():
    case = domain.sample(SIZE, SEED)
    assert study.SEED != SEED
    return case, full_model(case)


TARGETS = {
    # mean from and to, coefficient of variation, 1st percentile
    "long": (1.00, 1.06, 0.06, 0.93),
    "short": (1.00, 1.10, 0.09, 0.88),
}


@pytest.mark.parametrize("level", LEVELS)
def test_targets_over_the_domain(level, sample):
    case, exact = sample
    low, high, variation, percentile = TARGETS[level]
    found = study.assessment(case, exact, predictions(case, level))
    overall = found["governing"]["all"]
    assert overall["cases"] == SIZE
    assert low <= overall["mean"] <= high
    assert overall["coefficient of variation"] <= variation
    assert overall["1st percentile"] >= percentile
    # Engine and cargo apart, and every band of frequency: nowhere far off, nowhere low.
    for which in ("engine", "cargo", "governing"):
        assert 0.98 <= found[which]["all"]["mean"] <= 1.10
        for band, ratios in found[which].items():
            assert 0.97 <= ratios["mean"] <= 1.15, (which, band)
            assert ratios["coefficient of variation"] <= 2.0 * variation, (which, band)


@pytest.mark.parametrize("level", LEVELS)
def test_targets_with_friction_on_the_pier_and_with_none(level, sample):
    low, high, variation, percentile = TARGETS[level]
    case, _ = sample
    for changed in (
        case._replace(on_pier=np.ones(SIZE, dtype=bool)),
        case._replace(friction_force=np.zeros(SIZE)),
    ):
        exact = full_model(changed)
        predicted = predictions(changed, level)
        ratios = study.summary(predicted.governing / exact.governing)
        assert low <= ratios["mean"] <= high
        assert ratios["coefficient of variation"] <= variation
        assert ratios["1st percentile"] >= percentile


@pytest.mark.parametrize("level", LEVELS)
def test_contacts_are_those_of_the_full_model(level, sample):
    case, exact = sample
    predicted = predictions(case, level)
    differ = np.isnan(predicted.cargo) != np.isnan(exact.cargo)
    assert differ.mean() < 0.005
    # Where they differ, hardly any speed is left.
    values = design_values(select(case, differ), level)
    assert (values["v2"] < 0.1 * case.speed[differ]).all()


@pytest.mark.parametrize(("level", "largest"), [("long", 0.01), ("short", 0.06)])
def test_approach_speeds(level, largest, sample):
    case = select(sample[0], slice(0, 250))
    errors = study.speed_errors(case)[level]
    for body in ("engine", "cargo"):
        assert errors[body]["cases"] > 200
        assert abs(errors[body]["mean"]) < 0.005
        assert errors[body]["standard deviation"] < 0.01
    assert abs(errors["engine"]["largest"]) < largest
    assert errors["engine"]["smallest"] > -largest


def test_speeds_at_contact_are_those_of_the_histories():
    _, parts = parameter_chunks(TRUCK, PIER.mass, [284e6, 40e6], 0.05, [SPEED, 20.0])
    ((_, case),) = parts
    engine, cargo = study.contact_speeds(case)
    for i, (stiffness, speed) in enumerate([(284e6, SPEED), (40e6, 20.0)]):
        pier = dataclasses.replace(PIER, stiffness=stiffness)
        history = simulate(TRUCK, pier, speed)
        for found, time, velocity in (
            (engine[i], history.engine_contact_time, history.engine_velocity),
            (cargo[i], history.cargo_contact_time, history.body_velocity),
        ):
            assert found == pytest.approx(np.interp(time, history.time, velocity), rel=1e-6)


@pytest.mark.parametrize("level", LEVELS)
def test_heavier_trucks_stay_within_the_targets(level):
    # Outside the domain, but nothing in the formulas gives way.
    case = study.with_truck(domain.sample(600, 2), TRUCK.loaded_to(36e3))
    exact, predicted = full_model(case), predictions(case, level)
    ratios = study.summary(predicted.governing / exact.governing)
    assert 0.98 <= ratios["mean"] <= 1.10
    assert ratios["1st percentile"] >= 0.9


def test_a_truck_whose_cargo_follows_at_once_is_not_for_these_formulas():
    spring = dataclasses.replace(TRUCK.body_spring, plateau_length=0.45)
    short = dataclasses.replace(TRUCK, body_spring=spring)
    design = design_reaction(short, PIER, SPEED)
    assert any("before the engine has separated" in warning for warning in design.warnings)
    case = study.with_truck(domain.sample(300, 2), short)
    exact, predicted = full_model(case), predictions(case, "long")
    assert study.summary(predicted.governing / exact.governing)["1st percentile"] < 0.8
    assert not any(
        "has separated" in warning for warning in design_reaction(TRUCK, PIER, SPEED).warnings
    )


# The numbers, one by one


@pytest.mark.parametrize("level", LEVELS)
def test_by_a_calculator(level):
    ways = set()
    for case in [*collisions_over_the_domain(400, seed=8), *HARD.values()]:
        design, expected = design_reaction(*case, level=level), Procedure(*case, level)
        assert design.engine == pytest.approx(expected.engine, rel=1e-12)
        assert design.engine_contact == (expected.v1 > 0.0)
        cargo = math.nan if design.cargo is None else design.cargo
        assert cargo == pytest.approx(expected.cargo, rel=1e-12, nan_ok=True)
        assert design.reaction == max(design.engine, design.cargo or 0.0)
        cut_short = expected.engine < expected.alone
        ways.add((design.engine_contact, design.cargo is None, expected.crested, cut_short))
    assert len(ways) == 8


@pytest.mark.parametrize("level", LEVELS)
def test_one_pier_and_many_agree(level):
    random = np.random.default_rng(5)
    mass = np.exp(random.uniform(np.log(3e3), np.log(1e5), 3000))
    stiffness = mass * (2.0 * np.pi * np.exp(random.uniform(np.log(3), np.log(200), 3000))) ** 2
    damping, speed = random.uniform(0.0, 0.2, (2, 1)), random.uniform(5.0, 35.0, 3000)
    trucks = [TRUCK.loaded_to(m) for m in random.uniform(6e3, 40e3, 3000)]
    found = design_reactions(trucks, mass, stiffness, damping, speed, level=level)
    assert found.engine.shape == found.cargo.shape == found.reaction.shape == (2, 3000)
    assert np.isnan(found.cargo).any()
    for i, j in [(0, 0), (0, 2047), (1, 2048), (1, 2999), *((0, j) for j in range(10, 3000, 97))]:
        pier = EquivalentPier(
            mass=mass[j], stiffness=stiffness[j], damping_ratio=float(damping[i, 0])
        )
        one = design_reaction(trucks[j], pier, speed[j], level=level)
        assert found.engine[i, j] == pytest.approx(one.engine, rel=1e-11)
        assert found.reaction[i, j] == pytest.approx(one.reaction, rel=1e-11)
        if one.cargo is None:
            assert math.isnan(found.cargo[i, j])
        else:
            assert found.cargo[i, j] == pytest.approx(one.cargo, rel=1e-11)


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("damping", [0.0, 0.2, 0.95])
@pytest.mark.parametrize("frequency", [2.0, 200.0])
@pytest.mark.parametrize("mass", [2e3, 2e5, 1e15])
@pytest.mark.parametrize("speed", [0.1, 3.0, 9.0, 36.0])
def test_extremes_give_finite_positive_reactions(level, damping, frequency, mass, speed):
    pier = EquivalentPier(
        mass=mass, stiffness=mass * (2.0 * math.pi * frequency) ** 2, damping_ratio=damping
    )
    design = design_reaction(TRUCK, pier, speed, level=level)
    assert all(math.isfinite(design.values[step.name]) for step in design.steps)
    assert 0.0 < design.engine < math.inf
    assert design.cargo is None or 0.0 < design.cargo < math.inf


@pytest.mark.parametrize("level", LEVELS)
def test_a_rigid_pier_feels_each_body_on_its_spring(level):
    # Energy alone: ½ m v² = P y + ½ k y² for the cargo, whose plateau force goes on.
    pier = EquivalentPier(mass=1e6, stiffness=1e16, damping_ratio=0.05)
    design = design_reaction(TRUCK, pier, SPEED, level=level)
    v1 = math.sqrt(SPEED**2 - 2.0 * 150e3 * 0.5 / 700.0)
    v2 = math.sqrt(SPEED**2 - 2.0 * 521.5e3 * 1.9 / 7300.0)
    engine = 500e3 + math.hypot(150e3, v1 * math.sqrt(150e6 * 700.0))
    cargo = 500e3 + math.hypot(521.5e3, v2 * math.sqrt(10e6 * 7300.0)) - 521.5e3
    assert design.engine == pytest.approx(engine, rel=0.01)
    assert design.cargo == pytest.approx(cargo, rel=0.02)


@pytest.mark.parametrize("level", LEVELS)
def test_the_exact_spectrum_can_take_the_place_of_the_closed_one(level):
    case = domain.sample(200, 3)
    closed, exact = design_values(case, level), design_values(case, level, exact_amplification)
    np.testing.assert_allclose(
        exact["S1"],
        exact_amplification(exact["beta1"], exact["mu1"], exact["e1"], exact["zeta"]),
    )
    ratio = closed["R1"] / exact["R1"]
    assert 0.9 < ratio.min() < ratio.max() < 1.25
    assert ratio.std() > 0.0


# An engine whose crest comes after the cargo


def test_the_cargo_may_cut_the_engine_short():
    # Soft and heavy: half a period is longer than the cargo takes.
    random = np.random.default_rng(7)
    mass, speed = random.uniform(60e3, 100e3, 100), random.uniform(24.0, 30.0, 100)
    stiffness = mass * (2.0 * np.pi * random.uniform(4.0, 5.5, 100)) ** 2
    exact = peak_reactions(TRUCK, mass, stiffness, 0.05, speed)
    rising = exact.engine_time == exact.cargo_contact_time
    assert 20 < np.count_nonzero(rising) < 80
    long = design_reactions(TRUCK, mass, stiffness, 0.05, speed, level="long")
    alone = design_reactions(TRUCK, mass, stiffness, 0.05, speed, level="short")
    assert (alone.engine / exact.engine)[rising].max() > 1.15
    np.testing.assert_allclose(long.engine[rising] / exact.engine[rising], 1.0, atol=0.06)
    # The reaction goes on rising: the cargo governs.
    assert (long.cargo > long.engine)[rising].all()
    assert (exact.cargo > exact.engine)[rising].all()


# What it says of itself


def test_no_contact_is_said():
    slow = design_reaction(TRUCK, PIER, 20.0 / 3.6)
    assert not slow.engine_contact
    assert slow.cargo is None
    assert slow.governs == "engine"
    assert slow.reaction == slow.engine
    # The step response to the plateaus' force.
    step = 650e3 * (1.0 + math.exp(-math.pi * 0.05 / math.sqrt(1.0 - 0.05**2)))
    assert slow.engine == pytest.approx(step, rel=1e-12)
    middle = design_reaction(TRUCK, PIER, 55.0 / 3.6)
    assert middle.engine_contact
    assert middle.cargo is None
    fast = design_reaction(TRUCK, PIER, SPEED)
    assert fast.cargo is not None
    assert (fast.governs, fast.reaction) == ("cargo", fast.cargo)
    for level in LEVELS:
        found = design_reactions(TRUCK, PIER.mass, PIER.stiffness, 0.05, [5.0, SPEED], level=level)
        assert np.isnan(found.cargo).tolist() == [True, False]
        assert np.isfinite(found.reaction).all()


def test_within_the_domain_there_is_no_warning():
    assert design_reaction(TRUCK, PIER, SPEED).warnings == ()


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"speed": 40.0}, "speed at first touch 144 km/h is outside the studied 50 to 110 km/h"),
        ({"mass": 2e3}, "equivalent mass of the pier 2 t is outside the studied 3 to 100 t"),
        (
            {"stiffness": 8e9},
            "stiffness of the pier 8000 MN/m is outside the studied 50 to 6000 MN/m",
        ),
        ({"damping_ratio": 0.1}, "damping ratio of the pier 10 % is outside the studied 2 to 7 %"),
        ({"yield_reaction": 3e6}, "yield reaction 3 MN is of a pier that yields"),
    ],
)
def test_warnings_name_value_and_range(changes, sentence):
    speed = changes.pop("speed", SPEED)
    warnings = design_reaction(TRUCK, dataclasses.replace(PIER, **changes), speed).warnings
    assert any(warning.startswith(sentence + ":") for warning in warnings), warnings


def test_a_tractor_trailer_warns():
    (warning,) = design_reaction(TRUCK.loaded_to(36e3), PIER, SPEED).warnings
    assert warning.startswith("total mass of the truck 36 t is outside the studied 6 to 20 t:")


@pytest.mark.parametrize(("old", "level"), [("hand", "short"), ("refined", "long")])
def test_levels_have_their_old_names_as_well(old, level):
    one, other = (design_reaction(TRUCK, PIER, SPEED, name) for name in (old, level))
    assert one == other
    assert one.level == level
    assert design_reaction(TRUCK, PIER, SPEED).level == "short"
    assert (
        design_reactions(TRUCK, 8e3, 284e6, 0.05, SPEED, old).engine
        == design_reactions(TRUCK, 8e3, 284e6, 0.05, SPEED, level).engine
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((TRUCK, PIER, 0.0), "speed must be positive, got 0"),
        ((TRUCK, PIER, math.inf), "speed must be finite, got inf"),
        ((TRUCK, PIER, SPEED, "rough"), "level must be one of short, long, got 'rough'"),
        (("truck", PIER, SPEED), "truck must be a Truck, got str"),
        ((TRUCK, PierColumn, SPEED), "pier must be an EquivalentPier or a BeamPier, got type"),
    ],
)
def test_bad_input_of_one(arguments, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        design_reaction(*arguments)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"pier_mass": [1e4, 0.0]}, "pier_mass must be positive, got 0 at index 1"),
        ({"pier_stiffness": math.nan}, "pier_stiffness must be finite, got nan"),
        ({"damping_ratio": 1.0}, "damping_ratio must lie from 0 to below 1, got 1"),
        ({"speed": "fast"}, "speed must be an array of numbers, got 'fast'"),
        ({"level": "rough"}, "level must be one of short, long, got 'rough'"),
        ({"truck": 3}, "truck must be a Truck or a sequence of them, got int"),
        (
            {"pier_mass": [1e4, 1e4], "speed": [1.0, 2.0, 3.0]},
            "shapes must broadcast against each other, got truck (), pier_mass (2,), "
            "pier_stiffness (), damping_ratio (), speed (3,)",
        ),
    ],
)
def test_bad_input_of_many(changes, message):
    arguments = {
        "truck": TRUCK,
        "pier_mass": 1e4,
        "pier_stiffness": 1e8,
        "damping_ratio": 0.05,
        "speed": SPEED,
    }
    with pytest.raises(InputError) as error:
        design_reactions(**(arguments | changes))
    assert str(error.value) == message
