import math

import numpy as np
import pytest

from pierimpact import Collision, EquivalentPier, InputError, load_truck
from pierimpact.collision.groups import CHUNK
from pierimpact.collision.parameters import parameter_chunks

TRUCK = load_truck("single-unit-8t")


def test_one_collision_is_the_numbers_of_truck_pier_and_speed():
    pier = EquivalentPier(mass=8e3, stiffness=284e6, damping_ratio=0.04)
    parameters = Collision(TRUCK, pier, 20.0).parameters
    assert tuple(parameters.engine) == pytest.approx((700.0, 150e3, 0.5, 150e6, 900e6))
    assert tuple(parameters.body) == pytest.approx((7300.0, 500e3, 1.9, 10e6, 60e6))
    assert (parameters.friction_force, parameters.on_pier, parameters.speed) == (
        21.5e3,
        False,
        20.0,
    )
    assert parameters.pier_damping == 2.0 * 0.04 * math.sqrt(284e6 * 8e3)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"truck": "truck"}, "truck must be a Truck, got str"),
        ({"pier": 8e3}, "pier must be an EquivalentPier or a BeamPier, got float"),
        ({"speed": 0.0}, "speed must be positive, got 0"),
        ({"speed": None}, "speed must be a number, got None"),
    ],
)
def test_what_is_no_collision(changes, message):
    usual = {"truck": TRUCK, "pier": EquivalentPier(mass=8e3, stiffness=284e6), "speed": 20.0}
    with pytest.raises(InputError, match=f"^{message}$"):
        Collision(**(usual | changes))


def test_many_collisions_keep_their_order_and_shape():
    random = np.random.default_rng(0)
    count = 2 * CHUNK + 10
    trucks = [TRUCK.loaded_to(mass) for mass in random.uniform(6e3, 20e3, count)]
    mass, damping = random.uniform(3e3, 1e5, (3, 1)), random.uniform(0.0, 0.1, count)
    shape, parts = parameter_chunks(trucks, mass, 1e8, damping, 20.0)
    assert shape == (3, count)
    parts = list(parts)
    assert [part.start for part, _ in parts] == list(range(0, 3 * count, CHUNK))
    flat = {
        "pier_mass": np.broadcast_to(mass, shape).ravel(),
        "pier_damping": (2.0 * damping * np.sqrt(1e8 * mass)).ravel(),
        "body_mass": np.tile([truck.body_mass for truck in trucks], 3),
    }
    for part, parameters in parts:
        np.testing.assert_allclose(parameters.pier_mass, flat["pier_mass"][part], rtol=1e-15)
        np.testing.assert_allclose(parameters.pier_damping, flat["pier_damping"][part], rtol=1e-14)
        np.testing.assert_array_equal(parameters.body.mass, flat["body_mass"][part])
        assert parameters.speed.shape == parameters.on_pier.shape == parameters.pier_mass.shape


def test_scalars_and_empty_inputs():
    shape, parts = parameter_chunks(TRUCK, 1e4, 1e8, 0.05, 20.0)
    assert shape == ()
    assert len(list(parts)) == 1
    shape, parts = parameter_chunks(TRUCK, [], 1e8, 0.05, 20.0)
    assert shape == (0,)
    assert list(parts) == []


@pytest.mark.parametrize(
    ("truck", "message"),
    [
        ("truck", "truck must be a Truck or a sequence of them, got str"),
        (None, "truck must be a Truck or a sequence of them, got NoneType"),
        ([TRUCK, 8], "truck must be a Truck or a sequence of them, got int"),
    ],
)
def test_what_is_no_truck(truck, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        parameter_chunks(truck, 1e4, 1e8, 0.05, 20.0)
