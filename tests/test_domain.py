import math

import numpy as np
import pytest

from pierimpact import EquivalentPier, load_truck
from pierimpact.collision.groups import select
from pierimpact.collision.parameters import Collision
from pierimpact.design import domain
from pierimpact.symbols import SYMBOLS

SIZE = 4000


def test_the_truck_s_ranges_are_thirty_per_cent_about_the_reference():
    pier = EquivalentPier(mass=1e4, stiffness=1e8)
    collision = Collision(load_truck("single-unit-8t"), pier, 20.0)
    found = domain.values(collision.parameters)
    for name in domain.DOMAIN:
        if name[-1] in "12":
            low, high = domain.bounds(name)
            assert low == pytest.approx(0.7 * found[name], rel=1e-9)
            assert high == pytest.approx(1.3 * found[name], rel=1e-9)
    assert domain.bounds("cs")[1] == pytest.approx(1.3 * found["cs"])


def test_the_domain_is_the_one_asked_for():
    for name, low, high in (
        ("m", 6e3, 20e3),
        ("V", 50.0 / 3.6, 110.0 / 3.6),
        ("fp", 5.0, 150.0),
        ("mp", 3e3, 100e3),
        ("kp", 0.05e9, 6e9),
        ("zeta", 0.02, 0.07),
    ):
        assert domain.bounds(name) == pytest.approx((low, high), rel=1e-12)


def test_samples_fill_the_domain_and_stay_in_it():
    found = domain.values(domain.sample(SIZE, 0))
    assert set(found) == set(domain.DOMAIN)
    for name, values in found.items():
        low, high = domain.bounds(name)
        assert values.shape == (SIZE,)
        assert (values >= low * (1.0 - 1e-12)).all()
        assert (values <= high * (1.0 + 1e-12)).all()
        reach = np.log(values.max() / values.min()) if low > 0.0 else values.max() - values.min()
        whole = math.log(high / low) if low > 0.0 else high - low
        assert reach > 0.97 * whole, name


def test_samples_repeat_with_their_seed():
    same, again, other = (domain.sample(50, seed) for seed in (3, 3, 4))
    assert (same.speed == again.speed).all()
    assert (same.engine.stiffness == again.engine.stiffness).all()
    assert (same.speed != other.speed).any()
    assert 0.3 < domain.sample(SIZE, 0).on_pier.mean() < 0.7


def test_no_sample_warns_and_each_value_outside_does():
    case = domain.sample(40, 1)
    for i in range(40):
        assert domain.warnings(select(case, i)) == ()
    inside = select(case, 0)
    fields = {
        "P": "plateau_force",
        "d": "plateau_length",
        "k": "stiffness",
        "ku": "unloading_stiffness",
    }
    for body, i in (("engine", 1), ("body", 2)):
        for letter, field in fields.items():
            name = f"{letter}{i}"
            low, high = domain.bounds(name)
            for value in (0.99 * low, 1.01 * high):
                spring = getattr(inside, body)._replace(**{field: value})
                (warning,) = domain.warnings(inside._replace(**{body: spring}))
                size, unit = domain.DOMAIN[name].size, domain.DOMAIN[name].unit
                title = SYMBOLS[name].meaning
                assert warning.startswith(f"{title} {value / size:.4g} {unit} is outside")
                assert f"{domain.DOMAIN[name].low:g} to {domain.DOMAIN[name].high:g}" in warning


def test_a_bound_met_but_for_round_off_is_met():
    truck = load_truck("single-unit-8t").loaded_to(20e3)
    pier = EquivalentPier(
        mass=3e3, stiffness=3e3 * (2.0 * math.pi * 150.0) ** 2, damping_ratio=0.07
    )
    assert domain.warnings(Collision(truck, pier, 110.0 / 3.6).parameters) == ()
    beyond = domain.warnings(Collision(truck, pier, 110.1 / 3.6).parameters)
    assert beyond == (
        "speed at first touch 110.1 km/h is outside the studied 50 to 110 km/h: the design "
        "formulas were not checked there",
    )


def test_a_pier_that_yields_warns():
    pier = EquivalentPier(mass=8e3, stiffness=284e6, yield_reaction=2.5e6)
    parameters = Collision(load_truck("single-unit-8t"), pier, 20.0).parameters
    (warning,) = domain.warnings(parameters)
    assert warning.startswith("yield reaction 2.5 MN is of a pier that yields: ")
    assert domain.warnings(parameters._replace(yield_reaction=math.inf)) == ()
