import dataclasses
import math
import pickle
import warnings

import numpy as np
import pytest

from pierimpact import CrushSpring, InputError, Lognormal, MassRangeWarning, Truck, Uniform

SPRING = CrushSpring(
    plateau_force=150e3, plateau_length=0.5, stiffness=150e6, unloading_stiffness=900e6
)
STIFF = dataclasses.replace(SPRING, stiffness=300e6)
EXAMPLE = {
    "name": "test truck",
    "engine_mass": 700.0,
    "body_mass": 7300.0,
    "engine_spring": SPRING,
    "body_spring": STIFF,
}


def test_defaults():
    truck = Truck(**EXAMPLE)
    assert (truck.friction_force, truck.friction_on, truck.source) == (0.0, "road", "not given")
    assert truck.mass == 700.0 + 7300.0


def test_other_cargo_changes_the_body_mass_alone():
    truck = Truck(**EXAMPLE, friction_force=21.5e3, friction_on="pier", source="a source")
    laden = truck.with_mass(20e3)
    assert laden.mass == 20e3
    assert laden == dataclasses.replace(truck, body_mass=20e3 - 700.0)
    assert laden.with_mass(truck.mass) == truck


@pytest.mark.parametrize(
    ("mass", "message"),
    [
        (700.0, "mass must exceed the engine's 700 kg, got 700 kg"),
        (0.0, "mass must be positive, got 0"),
        (math.inf, "mass must be finite, got inf"),
    ],
)
def test_a_truck_is_heavier_than_its_engine(mass, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        Truck(**EXAMPLE).with_mass(mass)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"engine_mass": 0.0}, "engine_mass must be positive, got 0"),
        ({"body_mass": -1.0}, "body_mass must be positive, got -1"),
        ({"body_mass": "full"}, "body_mass must be a number, got 'full'"),
        ({"friction_force": -5.0}, "friction_force must not be negative, got -5"),
        ({"friction_on": "air"}, "friction_on must be one of road, pier, got 'air'"),
        ({"engine_spring": 150e3}, r"engine_spring must be a CrushSpring, got 150000\.0"),
        ({"body_spring": None}, "body_spring must be a CrushSpring, got None"),
        (
            {"body_spring": np.zeros((2, 1))},
            r"body_spring must be a CrushSpring, got array\(\[\[0\.\], \[0\.\]\]\)",
        ),
    ],
)
def test_bad_values_are_named(changes, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        Truck(**(EXAMPLE | changes))


def test_trucks_do_not_change():
    with pytest.raises(dataclasses.FrozenInstanceError):
        Truck(**EXAMPLE).body_mass = 1.0


SPREAD = {"engine_mass": Uniform.about(0.3), "body_spring.stiffness": Lognormal(0.1)}


def test_the_spread_travels_with_the_truck():
    asked = dict(SPREAD)
    truck = Truck(**EXAMPLE, spread=asked)
    asked.clear()
    assert truck.spread == SPREAD
    assert dataclasses.replace(truck, engine_mass=1e3).spread == SPREAD
    assert pickle.loads(pickle.dumps(truck)).spread == SPREAD
    assert Truck(**EXAMPLE).spread == {}


def test_a_spread_does_not_make_another_truck():
    plain, uncertain = Truck(**EXAMPLE), Truck(**EXAMPLE, spread=SPREAD)
    assert plain == uncertain
    assert hash(plain) == hash(uncertain)
    assert repr(plain) == repr(uncertain)


def test_a_stated_mass_is_known():
    truck = Truck(**EXAMPLE, spread=SPREAD | {"body_mass": Uniform.about(0.2)})
    assert truck.with_mass(20e3).spread == SPREAD


@pytest.mark.parametrize(
    ("spread", "message"),
    [
        ({"engin_mass": Uniform.about(0.1)}, "'engin_mass' is not a parameter with a spread; did"),
        ({"friction_on": Uniform.about(0.1)}, "'friction_on' is not a parameter with a spread"),
        ({"engine_mass": 0.3}, r"spread of engine_mass must be Uniform or Lognormal, got 0\.3"),
        ({"body_mass": Uniform(0.0, 2.0)}, "spread of body_mass must not begin at zero"),
    ],
)
def test_bad_spreads_are_named(spread, message):
    with pytest.raises(InputError, match=f"^{message}"):
        Truck(**EXAMPLE, spread=spread)


def test_friction_may_be_none_at_all():
    assert Truck(**EXAMPLE, spread={"friction_force": Uniform(0.0, 1.3)}).spread


@pytest.mark.parametrize(("mass", "inside"), [(4.9e3, False), (5e3, True), (12e3, True)])
def test_a_truck_outside_its_mass_range_warns(mass, inside):
    truck = Truck(**EXAMPLE, mass_range=(5e3, 12e3))
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always")
        laden = truck.with_mass(mass)
        assert laden == truck.loaded_to(mass)
    assert laden.in_mass_range is inside
    assert laden.mass_range == truck.mass_range
    assert len(raised) == (not inside)
    assert all(own.category is MassRangeWarning and own.filename == __file__ for own in raised)


def test_the_warning_is_one_sentence_with_the_range():
    truck = Truck(**EXAMPLE, mass_range=(5e3, 12e3))
    sentence = (
        "^A 29 t mass on the springs of test truck is another truck: they stand for a total of "
        "5 t to 12 t\\.$"
    )
    with pytest.warns(MassRangeWarning, match=sentence):
        truck.with_mass(29e3)


def test_a_mass_range_does_not_make_another_truck():
    plain, limited = Truck(**EXAMPLE), Truck(**EXAMPLE, mass_range=(5e3, 12e3))
    assert plain == limited
    assert hash(plain) == hash(limited)
    assert pickle.loads(pickle.dumps(limited)).mass_range == (5e3, 12e3)
    assert plain.in_mass_range


@pytest.mark.parametrize(
    ("mass_range", "message"),
    [
        (5e3, r"mass_range must be two masses, got 5000\.0"),
        ((5e3, 6e3, 7e3), r"mass_range must be two masses, got \(5000\.0, 6000\.0, 7000\.0\)"),
        ((0.0, 6e3), "mass_range must be positive, got 0"),
        ((5e3, math.inf), "mass_range must be finite, got inf"),
        ((7e3, 6e3), "mass_range must run upward, got 7000 kg to 6000 kg"),
    ],
)
def test_a_bad_mass_range_is_named(mass_range, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        Truck(**EXAMPLE, mass_range=mass_range)
