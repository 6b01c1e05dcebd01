"""Bands against single simulations, plain Monte Carlo and closed forms of Sobol indices."""

import dataclasses
import math

import numpy as np
import pytest
import scipy.stats
from hypothesis import given, settings
from hypothesis import strategies as st

from pierimpact import (
    CircularSection,
    Collision,
    CrushSpring,
    EquivalentPier,
    InputError,
    Lognormal,
    PierColumn,
    Truck,
    Uniform,
    load_truck,
    peak_reactions,
    reaction_band,
    simulate,
)
from pierimpact.collision.averages import largest_average_force
from pierimpact.design.band import REACTIONS, sobol_indices
from pierimpact.vehicle.truck import QUANTITIES

TRUCK, SPEED = load_truck("single-unit-8t"), 80.0 / 3.6
COLUMN = PierColumn(
    height=5.0,
    section=CircularSection(diameter=0.914),
    elastic_modulus=25e9,
    poisson_ratio=0.2,
    density=2400.0,
    base="fixed",
    top="pinned",
)
STIFF = COLUMN.equivalent(impact_height=1.2, damping_ratio=0.05)
SOFT = EquivalentPier(mass=8e3, stiffness=284e6, damping_ratio=0.05)
LAWS = tuple(CrushSpring.__dataclass_fields__)


def with_values(truck, values):
    """The truck with other values by parameter."""
    values = dict(values)
    for spring in ("engine_spring", "body_spring"):
        law = {name: values.pop(f"{spring}.{name}", None) for name in LAWS}
        law = {name: value for name, value in law.items() if value is not None}
        values[spring] = dataclasses.replace(getattr(truck, spring), **law)
    return dataclasses.replace(truck, **values)


def value_of(truck, name):
    for part in name.split("."):
        truck = getattr(truck, part)
    return truck


def random_trucks(rng, size, spread=0.3, only=QUANTITIES):
    """Trucks with parameters uniform about those of the reference, by NumPy alone."""
    values = {name: value_of(TRUCK, name) for name in only}
    return [
        with_values(
            TRUCK, {name: x * rng.uniform(1 - spread, 1 + spread) for name, x in values.items()}
        )
        for _ in range(size)
    ]


def governing(trucks, pier, speed=SPEED):
    return peak_reactions(trucks, pier.mass, pier.stiffness, pier.damping_ratio, speed).governing


@pytest.fixture(scope="module")
def band():
    return reaction_band(TRUCK, STIFF, SPEED)


def test_the_example(band):
    assert band.quantiles(of="engine") / 1e6 == pytest.approx([4.2, 6.9, 9.3], rel=0.02)
    assert band.quantiles() / 1e6 == pytest.approx([4.6, 6.9, 9.3], rel=0.02)
    # Where the truck's total mass is known, the cargo's reaction is better known too.
    stated = reaction_band(TRUCK.loaded_to(8e3), STIFF, SPEED)
    assert stated.quantiles(of="cargo") / 1e6 == pytest.approx([2.8, 4.4, 5.8], rel=0.025)
    assert "body_mass" not in stated.influence


def test_every_collision_is_that_of_a_simulation(band):
    assert band.nominal == pytest.approx(
        simulate(TRUCK, STIFF, SPEED).governing_peak.reaction, rel=1e-12
    )
    for index in (0, 1, 17, 500, 999):
        collision = band.sampled(index)
        history = simulate(collision.truck, collision.pier, collision.speed)
        assert band.engine[index] == pytest.approx(history.engine_peak.reaction, rel=1e-9)
        cargo = history.cargo_peak.reaction if history.cargo_peak else math.nan
        assert band.cargo[index] == pytest.approx(cargo, rel=1e-9, nan_ok=True)
        assert band.governing[index] == pytest.approx(history.governing_peak.reaction, rel=1e-9)


def test_samples_fill_their_spread(band):
    for name in QUANTITIES:
        factors = [
            value_of(band.sampled(index).truck, name) / value_of(TRUCK, name)
            for index in range(256)
        ]
        shares = (np.sort(factors) - 0.7) / 0.6
        # Scrambled Sobol points: one in each of the equal parts of every parameter's spread.
        assert np.array_equal(np.floor(256 * shares), np.arange(256))


def test_a_seed_gives_the_same_band_again():
    once, again, other = (reaction_band(TRUCK, STIFF, SPEED, None, 64, seed) for seed in (3, 3, 4))
    assert np.array_equal(once.governing, again.governing)
    assert once.influence == again.influence
    assert not np.any(once.governing == other.governing)


@pytest.mark.parametrize("size", [1, 7, 256])
def test_a_smaller_band_is_the_beginning_of_a_larger(band, size):
    small = reaction_band(TRUCK, STIFF, SPEED, size=size)
    assert small.governing.shape == small.engine.shape == small.cargo.shape == (size,)
    assert small.governing == pytest.approx(band.governing[:size], rel=1e-12)


@pytest.mark.parametrize("spread", [0.0, {}, {"engine_mass": 0.0, "speed": Lognormal(0.0)}, None])
def test_without_spread_the_reaction_is_known_exactly(spread):
    truck = dataclasses.replace(TRUCK, spread={})
    found = reaction_band(truck, SOFT, SPEED, spread=spread, size=50)
    history = simulate(truck, SOFT, SPEED)
    for name, peak in history.peaks.items():
        assert np.ptp(getattr(found, name)) == 0.0
        assert found.quantiles(of=name) == pytest.approx([peak.reaction] * 3, rel=1e-12)
    assert (found.spread, found.influence, found.first_order, found.tornado) == ({}, {}, {}, {})
    assert found.sampled(49) == Collision(truck, SOFT, SPEED)


@pytest.mark.parametrize("pier", [STIFF, SOFT], ids=["stiff", "soft"])
def test_a_larger_spread_gives_a_larger_band(pier):
    widths = [
        np.diff(reaction_band(TRUCK, pier, SPEED, spread=spread, size=256).quantiles((0.05, 0.95)))
        for spread in (0.02, 0.1, 0.2, 0.3, 0.4)
    ]
    assert np.all(np.diff(widths, axis=0) > 0.0)


def test_quantiles_are_those_of_plain_monte_carlo(band):
    size = 3000
    found = governing(random_trucks(np.random.default_rng(5), size), STIFF)
    levels = np.array([0.05, 0.25, 0.5, 0.75, 0.95])
    below = np.mean(found[:, None] <= band.quantiles(levels), axis=0)
    error = np.sqrt(levels * (1.0 - levels) * (1.0 / size + 1.0 / len(band.governing)))
    assert np.all(np.abs(below - levels) < 3.0 * error)


def test_a_larger_sample_is_more_exact():
    spread = {"body_mass": 0.3, "body_spring.plateau_length": Lognormal(0.2)}
    exact = reaction_band(TRUCK, SOFT, SPEED, spread, size=4096, seed=99).quantiles()

    def error(size):
        bands = [reaction_band(TRUCK, SOFT, SPEED, spread, size, seed) for seed in range(4)]
        ratios = np.array([band.quantiles() / exact - 1.0 for band in bands])
        return np.sqrt(np.mean(ratios**2))

    assert error(512) < 0.3 * error(32)
    assert error(512) < 0.01


def test_only_the_parameters_named_are_uncertain():
    spread = {
        "engine_mass": 0.2,
        "speed": Uniform(0.9, 1.2),
        "body_spring.stiffness": Lognormal(0.1),
    }
    found = reaction_band(TRUCK, SOFT, SPEED, spread=spread, size=32)
    assert set(found.influence) == set(spread) == set(found.tornado) == set(found.first_order)
    for index in range(32):
        collision = found.sampled(index)
        moved = {
            name for name in QUANTITIES if value_of(collision.truck, name) != value_of(TRUCK, name)
        }
        assert moved == set(spread) - {"speed"}
        assert 0.9 * SPEED < collision.speed < 1.2 * SPEED
        assert 0.8 * 700.0 < collision.truck.engine_mass < 1.2 * 700.0


def test_the_trucks_own_spread_is_used_unless_another_is_given():
    own, share = (reaction_band(TRUCK, STIFF, SPEED, spread, size=16) for spread in (None, 0.3))
    assert np.array_equal(own.governing, share.governing)
    one = dataclasses.replace(TRUCK, spread={"engine_mass": Uniform.about(0.1)})
    assert list(reaction_band(one, STIFF, SPEED, size=8).influence) == ["engine_mass"]


def test_a_beam_counts_as_its_one_degree_of_freedom(band):
    beam = COLUMN.beam(impact_height=1.2, damping_ratio=0.05)
    found = reaction_band(TRUCK, beam, SPEED, size=16)
    assert found.governing == pytest.approx(band.governing[:16], rel=1e-9)


@settings(max_examples=20, deadline=None)
@given(
    piers=st.lists(
        st.builds(
            EquivalentPier,
            mass=st.floats(3e3, 100e3),
            stiffness=st.floats(50e6, 6e9),
            damping_ratio=st.floats(0.0, 0.2),
            yield_reaction=st.one_of(st.just(math.inf), st.floats(5e5, 1e7)),
        ),
        min_size=2,
        max_size=2,
    )
)
def test_a_band_on_another_pier_is_the_band_of_that_pier(piers):
    bands = [reaction_band(TRUCK, pier, SPEED, size=8) for pier in piers]
    for band, other, pier in zip(bands, bands[::-1], piers[::-1], strict=True):
        for name, reactions in band.on(pier)._asdict().items():
            assert np.array_equal(reactions, getattr(other, name), equal_nan=True)


def test_collisions_without_cargo_contact_are_told_apart(band):
    missing = np.isnan(band.cargo)
    assert 0.0 < np.mean(missing) < 0.1
    assert band.cargo_contact == pytest.approx(1.0 - np.mean(missing))
    assert band.quantiles(of="cargo") == pytest.approx(
        np.quantile(band.cargo[~missing], (0.05, 0.5, 0.95))
    )
    assert np.array_equal(band.governing, np.fmax(band.engine, band.cargo))
    slow = reaction_band(TRUCK, STIFF, 20.0 / 3.6, size=64)
    assert slow.cargo_contact == 0.0
    assert np.all(np.isnan(slow.quantiles(of="cargo")))


@pytest.mark.parametrize("pier", [STIFF, SOFT], ids=["stiff", "soft"])
def test_one_parameter_at_a_time(pier):
    laws = {
        name: Lognormal(0.1) if i % 2 else Uniform(0.8, 1.3) for i, name in enumerate(QUANTITIES)
    }
    band = reaction_band(TRUCK, pier, SPEED, spread=laws, size=8)
    for name, law in laws.items():
        trucks = [with_values(TRUCK, {name: end * value_of(TRUCK, name)}) for end in law.ends]
        ends = [simulate(truck, pier, SPEED).governing_peak.reaction for truck in trucks]
        assert band.tornado[name] == pytest.approx(ends, rel=1e-9)


def test_averages_of_the_contact_force(band):
    windows = (0.010, 0.025)
    found = band.average_forces(windows, count=3)
    assert found.shape == (2, 3)
    for column in range(3):
        collision = band.sampled(column)
        history = simulate(collision.truck, collision.pier, collision.speed)
        expected = [largest_average_force(history, window).force for window in windows]
        assert found[:, column] == pytest.approx(expected, rel=1e-6)
    few = reaction_band(TRUCK, STIFF, SPEED, size=2)
    assert few.average_forces((0.05,)).shape == (1, 2)


# Shares of variance


def of_function(function, count, size, seed):
    """The indices of a function of `count` numbers between 0 and 1."""
    points = scipy.stats.qmc.Sobol(2 * count, rng=seed).random(size).T
    a, b = points[:count], points[count:]
    mixed = np.array([np.where(np.arange(count)[:, None] == i, b, a) for i in range(count)])
    return function(a), function(b), np.array([function(points) for points in mixed])


@pytest.mark.parametrize("seed", range(5))
def test_indices_of_a_product(seed):
    # Sobol's function: the product of 1 + c (12)^½ (x − ½), whose parts have the variances c².
    c = np.random.default_rng(seed).uniform(0.05, 0.6, 5)

    def product(x):
        return np.prod(1.0 + c[:, None] * math.sqrt(12.0) * (x - 0.5), axis=0)

    total, first = sobol_indices(*of_function(product, 5, 4096, seed))
    variance = np.prod(1.0 + c**2) - 1.0
    assert first == pytest.approx(c**2 / variance, abs=0.02)
    others = np.prod(1.0 + c**2) / (1.0 + c**2)
    assert total == pytest.approx(c**2 * others / variance, abs=0.02)


def test_indices_are_those_of_scipy():
    def ishigami(x):
        x = math.pi * (2.0 * x - 1.0)
        return np.sin(x[0]) + 7.0 * np.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * np.sin(x[0])

    a, b, mixed = of_function(ishigami, 3, 1024, 3)
    total, first = sobol_indices(a, b, mixed)
    functions = {"f_A": a[None], "f_B": b[None], "f_AB": mixed[:, None]}
    expected = scipy.stats.sobol_indices(func=functions, n=1024)
    assert total == pytest.approx(np.clip(expected.total_order, 0.0, 1.0), rel=1e-12)
    assert first == pytest.approx(np.clip(expected.first_order, 0.0, 1.0), rel=1e-12)


@pytest.mark.parametrize("name", ["engine_mass", "engine_spring.plateau_length", "speed"])
def test_a_parameter_that_is_uncertain_alone_has_the_whole_variance(name):
    found = reaction_band(TRUCK, STIFF, SPEED, spread={name: 0.2})
    assert found.influence == {name: pytest.approx(1.0, abs=0.02)}
    assert found.first_order == {name: pytest.approx(1.0, abs=0.02)}


def test_influence_against_nested_monte_carlo():
    """Mean variance over one parameter, and variance of the mean over the others."""
    rng, outer, inner = np.random.default_rng(11), 120, 24
    found = reaction_band(TRUCK, SOFT, SPEED, size=1024)
    variance = np.var(found.governing)
    name = "body_mass"
    others = [other for other in QUANTITIES if other != name]

    def nested(fixed, varied):
        trucks = []
        for truck in random_trucks(rng, outer, only=fixed):
            values = {key: value_of(truck, key) for key in fixed}
            trucks += [with_values(own, values) for own in random_trucks(rng, inner, only=varied)]
        return governing(trucks, SOFT).reshape(outer, inner)

    total = np.mean(np.var(nested(others, [name]), axis=1, ddof=1)) / variance
    assert found.influence[name] == pytest.approx(total, abs=0.06)
    by_value = nested([name], others)
    noise = np.mean(np.var(by_value, axis=1, ddof=1)) / inner
    first = (np.var(np.mean(by_value, axis=1), ddof=1) - noise) / variance
    assert found.first_order[name] == pytest.approx(first, abs=0.12)


def test_shares_of_variance_come_with_the_most_influential_first(band):
    for shares in (band.influence, band.first_order, band.tornado, band.spread):
        assert list(shares) == list(band.influence)
    assert list(band.influence.values()) == sorted(band.influence.values(), reverse=True)
    assert next(iter(band.influence)) == "engine_mass"
    # First-order shares are parts of the variance, total shares count interactions several times.
    assert sum(band.first_order.values()) < 1.05
    assert sum(band.influence.values()) > 0.95


def test_what_cannot_matter_has_no_influence():
    # At 20 km/h neither body makes contact: all is decided by the plateaus.
    slow = reaction_band(TRUCK, STIFF, 20.0 / 3.6, size=256)
    for name, share in slow.influence.items():
        if name.endswith("spring.stiffness") or name.endswith("plateau_length"):
            assert share < 1e-12
    smooth = dataclasses.replace(TRUCK, friction_force=0.0)
    found = reaction_band(smooth, STIFF, SPEED, size=256)
    assert found.influence["friction_force"] < 1e-12
    # Nor does round-off count, where nothing that is uncertain matters.
    alone = reaction_band(smooth, STIFF, SPEED, spread={"friction_force": 0.3}, size=256)
    assert alone.influence == {"friction_force": 0.0}
    assert np.ptp(alone.governing) < 1e-9 * alone.nominal


# Rules


springs = st.builds(
    lambda P, d, k, over: CrushSpring(
        plateau_force=P, plateau_length=d, stiffness=k, unloading_stiffness=over * max(k, P / d)
    ),
    st.floats(1e4, 1e6),
    st.floats(0.1, 3.0),
    st.floats(1e6, 3e8),
    st.one_of(st.just(1.0 + 1e-12), st.floats(1.0 + 1e-12, 8.0)),
)
laws = st.one_of(
    st.floats(0.0, 0.95),
    st.builds(Uniform, st.floats(0.05, 1.0), st.floats(1.0, 4.0)),
    st.builds(Lognormal, st.floats(0.0, 0.9)),
)


@settings(max_examples=20, deadline=None)
@given(
    engine=springs,
    body=springs,
    spread=st.dictionaries(st.sampled_from([*QUANTITIES, "speed"]), laws),
    seed=st.integers(0, 1000),
)
def test_sampled_trucks_keep_the_rules(engine, body, spread, seed):
    truck = Truck(
        name="any",
        engine_mass=800.0,
        body_mass=9e3,
        engine_spring=engine,
        body_spring=body,
        friction_force=2e4,
    )
    found = reaction_band(truck, SOFT, 15.0, spread=spread, size=8, seed=seed)
    assert np.all(found.engine > 0.0)
    for index in range(8):
        drawn = found.sampled(index).truck  # refused if it broke a rule
        for name in ("engine_spring", "body_spring"):
            law = getattr(drawn, name)
            key = f"{name}.unloading_stiffness"
            if law.unloading_stiffness != law.stiffness and key not in found.spread:
                assert law.unloading_stiffness == getattr(truck, name).unloading_stiffness


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"size": 0}, "size must be at least 1, got 0"),
        ({"size": 10**400}, "size must be at most 1073741824, got 1000.*…"),
        ({"size": 10.5}, r"size must be a whole number, got 10\.5"),
        ({"seed": -1}, "seed must be at least 0, got -1"),
        ({"spread": 1.0}, "spread must lie from 0 to below 1, got 1"),
        ({"spread": "wide"}, "spread must be a number, got 'wide'"),
        ({"spread": {"engine_mass": 1.5}}, "spread must .* below 1, got 1.5, for 'engine_mass'"),
        ({"spread": {"engin_mass": 0.1}}, "'engin_mass' is not a parameter .* mean engine_mass"),
        ({"spread": {"friction_on": 0.1}}, "'friction_on' is not a parameter with a spread"),
        ({"spread": {"speed": Uniform(0.0, 2.0)}}, "spread of speed must not begin at zero"),
        ({"speed": -1.0}, "speed must be positive, got -1"),
        ({"truck": "truck"}, "truck must be a Truck, got str"),
    ],
)
def test_bad_inputs_are_one_line(changes, message):
    arguments = {"truck": TRUCK, "pier": SOFT, "speed": SPEED} | changes
    with pytest.raises(InputError, match=f"^{message}") as caught:
        reaction_band(**arguments)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda band: band.sampled(True), "index must be a whole number, got True"),
        (lambda band: band.sampled(-1), "index must be at least 0, got -1"),
        (lambda band: band.sampled(10**6), "index must be at most .*, got 1000000"),
        (lambda band: band.average_forces([[0.01]]), r"windows must be in one row, .* \(1, 1\)"),
        (lambda band: band.average_forces([0.0]), "windows must be positive, got 0 at index 0"),
        (lambda band: band.average_forces([0.01], count="3"), "count must be a whole .*, got '3'"),
    ],
)
def test_what_a_band_is_asked_for_is_checked(band, ask, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        ask(band)


def test_bad_quantiles_are_one_line(band):
    with pytest.raises(InputError, match=r"^levels must lie from 0 to 1, got 5$"):
        band.quantiles((5, 95))
    with pytest.raises(InputError, match=r"^levels must be in one row, got shape \(\)$"):
        band.quantiles(0.5)
    with pytest.raises(InputError, match=r"^levels must be an array of numbers, got '3'$"):
        band.quantiles("3")
    with pytest.raises(
        InputError, match=f"^of must be one of {', '.join(REACTIONS)}, got 'truck'$"
    ):
        band.quantiles(of="truck")
