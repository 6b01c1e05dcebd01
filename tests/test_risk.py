"""The risk from traffic: closed forms and quadratures, importance sampling against plain, bands."""

import math
import pickle
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy import stats
from traffic_of_jcss import jcss_traffic

from pierimpact import EquivalentPier, load_truck, peak_reactions
from pierimpact.checks import InputError
from pierimpact.design.codes import KIP
from pierimpact.risk.analysis import Task, risk, strikes_of, weighted_quantiles
from pierimpact.risk.distributions import Distribution
from pierimpact.risk.exceedance import CONFIDENCE, Exceedance, probability
from pierimpact.risk.laws import Lognormal, Normal, Rayleigh
from pierimpact.risk.sampling import BLOCK, draw, nearest
from pierimpact.risk.traffic import (
    ROAD_SPEEDS,
    YEAR,
    WeighedTrucks,
    jcss_mass,
    jcss_speed,
)

LIGHT, HEAVY = load_truck("single-unit-8t"), load_truck("tractor-trailer-36t")
SIGMA = math.radians(10.0) / math.sqrt(math.pi / 2.0)  # of JCSS' Rayleigh law of the angle
PIER = EquivalentPier.from_frequency(8e3, 30.0)


def lognormal_parameters(mean, deviation):
    """μ and σ of the logarithm, once more."""
    variance = math.log(1.0 + (deviation / mean) ** 2)
    return math.log(mean) - 0.5 * variance, math.sqrt(variance)


def masses():
    """Masses of the truncated normal law of JCSS with their weights, by the trapezoidal rule."""
    m = np.linspace(3.5e3, 120e3, 4001)
    w = np.exp(-0.5 * ((m - 20e3) / 12e3) ** 2)
    w[[0, -1]] *= 0.5
    return m, w / w.sum()


def hard_impact_exceeded(force):
    """P(v √(k m) > F) for trucks of a motorway without run-out: v √k is lognormal."""
    (mv, sv), (mk, sk) = lognormal_parameters(80 / 3.6, 10 / 3.6), lognormal_parameters(3e5, 6e4)
    m, w = masses()
    z = (np.log(force) - 0.5 * np.log(m) - mv - 0.5 * mk) / math.hypot(sv, 0.5 * sk)
    return float(w @ stats.norm.sf(z))


def drawn(traffic, blocks, **options):
    """Weights and forces v √(k m) of some blocks, shape (blocks, BLOCK)."""
    arrivals = [draw(traffic, [LIGHT], block, **options) for block in blocks]
    return (np.array([getattr(a, name) for a in arrivals]) for name in ("weight", "hard_impact"))


@cache
def motorway(tilted):
    """A million trucks of a motorway without run-out, or half as many that are tilted."""
    return tuple(drawn(jcss_traffic(1.0, 0.0), range(62 if tilted else 123), tilted=tilted))


def test_hard_impacts_of_a_motorway_are_those_to_compare_with():
    weight, force = (part.ravel()[:1_000_000] for part in motorway(0.0))
    assert np.all(weight == 1.0)
    assert force.mean() / 1e6 == pytest.approx(1.74, abs=0.005)
    assert np.quantile(force, (0.95, 0.99)) / 1e6 == pytest.approx((2.65, 3.09), abs=0.005)
    above = float(np.mean(force > 600.0 * KIP))
    exact = hard_impact_exceeded(600.0 * KIP)
    assert above == pytest.approx(0.046, abs=0.001)
    assert above == pytest.approx(exact, abs=4.0 * math.sqrt(exact / 1e6))


@given(st.integers(0, 10**6), st.floats(0.5e6, 5e6))
@settings(max_examples=8, deadline=None)
def test_tilted_draws_come_to_the_same_as_the_quadrature(seed, force):
    weight, forces = (part.ravel() for part in drawn(jcss_traffic(1.0, 0.0), (0, 7), seed=seed))
    found = weight * (forces > force)
    error = found.std() / math.sqrt(len(found))
    assert found.mean() == pytest.approx(hard_impact_exceeded(force), abs=5.0 * error)
    assert weight.max() <= 1.0 / 0.4
    assert weight.mean() == pytest.approx(1.0, abs=5.0 * weight.std() / math.sqrt(len(weight)))


@given(st.floats(0.5, 40.0), st.floats(10.0, 35.0), st.floats(1.0, 8.0))
def test_the_chance_of_arriving_has_a_closed_form(distance, speed, braking):
    """exp(−α0²/2σ²) with sin α0 = 2 a d / v², and the drawn speeds obey the law of energy."""
    traffic = jcss_traffic(1.0, distance)
    chance, arrived = traffic.arrivals(
        np.full(3, speed), np.full(3, braking), np.array([1e-9, 0.5, 1.0])
    )
    sine = 2.0 * braking * distance / speed**2
    if sine > 0.9:  # where next to none arrive, and angles end at a right one
        assert np.all(chance < 1e-12)
        return
    assert chance == pytest.approx(math.exp(-0.5 * (math.asin(sine) / SIGMA) ** 2), rel=1e-9)
    assert arrived[2] == pytest.approx(0.0, abs=1e-5 * speed)  # the smallest angle just arrives
    assert arrived[0] > arrived[1] > arrived[2]
    # Half of those that arrive come at an angle above this.
    angle = SIGMA * math.sqrt(-2.0 * math.log(0.5 * float(chance[1])))
    expected = math.sqrt(speed**2 - 2.0 * braking * distance / math.sin(angle))
    assert arrived[1] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("road", ROAD_SPEEDS)
@pytest.mark.parametrize("distance", [0.0, 3.0, 12.0])
def test_the_frequency_of_hits_is_the_rayleigh_integral(road, distance):
    """n λ b / sin 10° ∫ exp(−α0²/2σ²) over v0 and a, of which 2 a d / v0² is lognormal."""
    traffic = jcss_traffic(0.04, distance, speed=jcss_speed(road), width=3.1)
    assert traffic.stretch == pytest.approx(3.1 / math.sin(math.radians(10.0)), rel=1e-6)
    mean, deviation = ROAD_SPEEDS[road]
    (mv, sv), (ma, sa) = (
        lognormal_parameters(mean / 3.6, deviation / 3.6), lognormal_parameters(4.0, 1.3)
    )  # fmt: skip
    z, w = np.polynomial.hermite_e.hermegauss(180)
    w = w / w.sum()
    sine = 2.0 * distance * np.exp(ma - 2.0 * mv + math.hypot(sa, 2.0 * sv) * z)
    arrive = np.where(sine < 1.0, np.exp(-0.5 * (np.arcsin(np.minimum(sine, 1)) / SIGMA) ** 2), 0)
    exact = 0.04 * 1e-10 * 3.1 / math.sin(math.radians(10.0)) * float(w @ arrive)
    weight, force = (part.ravel() for part in drawn(traffic, range(3)))
    total = Exceedance(force, weight, traffic.departures).total
    width = float(total.high - total.low)
    assert float(total.value) == pytest.approx(exact, abs=1.5 * width + 2e-3 * exact)


def test_speeds_at_the_pier_are_those_of_trucks_that_go_their_way_one_by_one():
    traffic, n = jcss_traffic(1.0, 8.0), 400_000
    random = np.random.default_rng(5)
    (mv, sv), (ma, sa) = lognormal_parameters(80 / 3.6, 10 / 3.6), lognormal_parameters(4.0, 1.3)
    v = np.exp(mv + sv * random.standard_normal(n))
    a = np.exp(ma + sa * random.standard_normal(n))
    left = v**2 - 2.0 * a * 8.0 / np.sin(random.rayleigh(SIGMA, n))
    left = left[left > 0.0]
    arrivals = draw(traffic, [LIGHT], 0)
    assert arrivals.weight.mean() == pytest.approx(len(left) / n, rel=0.03)
    for share in (0.05, 0.3, 0.7, 0.95, 0.999):
        above = arrivals.weight * (arrivals.speed**2 > np.quantile(left, share))
        error = above.std() / math.sqrt(len(above))
        assert above.mean() == pytest.approx((1.0 - share) * len(left) / n, abs=4.5 * error)


def estimates(size, force, tilted):
    """Estimates of P(F > force) from `size` trucks each."""
    weight, forces = (part[:, :size] for part in motorway(tilted))
    return np.mean(weight * (forces > force), axis=1)


def test_the_error_falls_with_the_root_of_the_number_and_is_less_than_plain_in_the_tail():
    force = 4.2e6
    few, many = (estimates(size, force, 0.6).std() for size in (512, 8192))
    assert few / many == pytest.approx(4.0, rel=0.3)
    plain = estimates(8192, force, 0.0).std()
    exact = hard_impact_exceeded(force)
    assert exact < 1e-4
    assert plain == pytest.approx(math.sqrt(exact / 8192), rel=0.3)
    assert plain > 3.0 * many  # nine times fewer trucks for the same error


@pytest.mark.parametrize("tilted", [0.0, 0.6])
@pytest.mark.parametrize("force", [1.4e6, 2.4e6, 3.4e6])
def test_the_band_holds_the_truth_as_often_as_it_says(force, tilted):
    weights, forces = (part.reshape(-1, 2048) for part in motorway(tilted))
    exact, held = hard_impact_exceeded(force), 0
    for weight, found in zip(weights, forces, strict=True):
        rate = Exceedance(found, weight, 1.0).rate(force)
        held += bool(rate.low <= exact <= rate.high)
    # Three standard errors below; a band that counts one draw more may hold it more often.
    share = held / len(weights)
    assert 0.95 - 3.0 * math.sqrt(0.95 * 0.05 / len(weights)) <= share <= 0.995


@given(st.integers(1, 40))
def test_a_rare_count_has_the_exact_band_of_poisson(count):
    n = 10**7
    found = Exceedance(np.arange(count + 50.0), np.ones(count + 50), 1.0)
    found.size = n
    rate = found.rate(49.5)
    tail = 0.5 * (1.0 - CONFIDENCE)
    low, high = stats.chi2.ppf(tail, 2 * count), stats.chi2.isf(tail, 2 * count + 2)
    assert float(rate.value) == pytest.approx(count / n)
    assert float(rate.low) == pytest.approx(0.5 * low / n, rel=1e-4)
    assert float(rate.high) == pytest.approx(0.5 * high / n, rel=1e-4)


@given(st.lists(st.tuples(st.floats(0.0, 10.0), st.floats(0.0, 2.0)), min_size=1, max_size=50))
def test_rates_fall_and_values_are_where_they_pass(pairs):
    values, weights = (np.array(part) for part in zip(*pairs, strict=True))
    found = Exceedance(values, weights, 3.0)
    x = np.unique(values)
    rate = found.rate(x)
    assert np.all(np.diff(rate.value) <= 1e-12)
    assert np.all(rate.low <= rate.value + 1e-12)
    assert np.all(rate.value <= rate.high + 1e-12)
    exact = 3.0 * np.array([weights[values > one].sum() for one in x]) / len(values)
    np.testing.assert_allclose(rate.value, exact, atol=1e-12)
    for wanted in (1e-3, 0.1, 1.0):
        value = float(found.value(wanted).value)
        if value > 0.0:
            assert float(found.rate(value).value) < wanted * (1.0 + 1e-12)
            assert float(found.rate(np.nextafter(value, -1.0)).value) >= wanted * (1.0 - 1e-12)
        else:
            assert float(found.total.value) < wanted * (1 + 1e-12) or not values.any()


def test_nothing_that_exceeds_is_no_proof_of_never():
    found = Exceedance(np.ones(1000), np.ones(1000), 1.0)
    rate = found.rate(2.0)
    assert (float(rate.value), float(rate.low)) == (0.0, 0.0)
    assert float(rate.high) == pytest.approx(-math.log(0.025) / 1000, rel=1e-6)
    assert float(found.value(1e-9).high) == math.inf
    none = Exceedance(np.zeros(5), np.zeros(5), 1.0)
    assert [float(part) for part in none.total] == [0.0, 0.0, 0.0]


@given(st.integers(0, 10**6))
@settings(max_examples=5)
def test_rough_values_corrected_by_some_better_ones_are_exceeded_as_often(seed):
    """Of 100 samples nearly all bands hold the frequency, and they are narrower than of the few."""
    random = np.random.default_rng(seed)
    level, size, few, held, narrower = 2.0, 3000, 300, 0, 0
    true = stats.norm.sf(level / math.hypot(1.0, 0.2))
    for _ in range(100):
        rough = random.standard_normal(size)
        better = rough[:few] + 0.2 * random.standard_normal(few)
        found = Exceedance(rough, np.ones(size), 1.0, better).rate(level)
        alone = Exceedance(better, np.ones(few), 1.0).rate(level)
        held += bool(found.low <= true <= found.high)
        narrower += bool(found.high - found.low < alone.high - alone.low)
    assert held >= 87
    assert narrower > 87


def test_where_all_values_are_better_known_the_rough_ones_do_not_count():
    random = np.random.default_rng(1)
    rough, better, weights = random.random((3, 50))
    known, same = Exceedance(rough, weights, 2.0, better), Exceedance(better, weights, 2.0)
    for one, other in zip(known.rate(better), same.rate(better), strict=True):
        np.testing.assert_array_equal(one, other)
    alike = Exceedance(rough, weights, 2.0, rough[:9])
    np.testing.assert_array_equal(
        alike.rate(rough).value, Exceedance(rough, weights, 2.0).rate(rough).value
    )


@given(st.floats(1e-9, 1e3), st.floats(0.0, 100.0))
def test_the_chance_of_an_event_is_that_of_poisson(rate, time):
    assert float(probability(rate, time)) == pytest.approx(stats.poisson.sf(0, rate * time))


def test_the_same_seed_gives_the_same_trucks_for_all_piers_workers_and_numbers():
    traffic, trucks = jcss_traffic(0.05, 5.0), [LIGHT, HEAVY]
    both = [risk(traffic, trucks, pier, 600, 4).strikes for pier in
            (PIER, EquivalentPier.from_frequency(20e3, 90.0))]  # fmt: skip
    for name in ("weight", "mass", "road_speed", "speed", "truck", "hard_impact"):
        np.testing.assert_array_equal(*(getattr(strikes, name) for strikes in both))
    assert np.any(both[0].reaction != both[1].reaction)
    fewer = risk(traffic, trucks, PIER, 60, 4).strikes
    for short, long in zip(fewer, both[0], strict=True):
        np.testing.assert_array_equal(short, long[:60])

    def backward(task, blocks):
        found = {block: task(block) for block in reversed(list(blocks))}
        return (found[block] for block in sorted(found))

    size = BLOCK + 50  # more than a block, of trucks that seldom arrive
    far = jcss_traffic(0.05, 300.0)
    one, other = (risk(far, trucks, PIER, size, run=run).strikes for run in (map, backward))
    for first, second in zip(one, other, strict=True):
        assert first.tobytes() == second.tobytes()
        assert len(first) == size


@given(st.integers(0, 5000))
@settings(max_examples=10)
def test_a_block_is_of_the_masses_of_the_traffic(block):
    own = draw(jcss_traffic(1.0, 4.0), [LIGHT, HEAVY], block, 9, 400)
    assert own.mass.min() >= 3500.0
    assert np.all((own.truck == 0) == (own.mass <= math.sqrt(12e3 * 20e3)))
    assert np.all(own.speed <= own.road_speed)


def test_a_mass_goes_with_the_truck_whose_range_is_next_to_it():
    mass = np.array([4e3, 8e3, 15e3, 16e3, 30e3, 60e3])
    assert nearest(mass, [LIGHT, HEAVY]).tolist() == [0, 0, 0, 1, 1, 1]
    assert nearest(mass, [HEAVY, LIGHT]).tolist() == [1, 1, 1, 0, 0, 0]


def test_the_collisions_are_those_of_peak_reactions():
    """One truck without spread: mass, speed and springs as `loaded_to` has them."""
    truck = replace(LIGHT, spread={})
    strikes = risk(jcss_traffic(1.0, 5.0), [truck], PIER, 60).strikes
    there = strikes.weight > 0.0
    loaded = [truck.loaded_to(mass) for mass in strikes.mass[there]]
    exact = peak_reactions(
        loaded, PIER.mass, PIER.stiffness, PIER.damping_ratio, strikes.speed[there]
    )
    np.testing.assert_allclose(strikes.reaction[there], exact.governing, rtol=1e-12)
    np.testing.assert_array_equal(strikes.by_engine[there], ~(exact.cargo > exact.engine))


def test_of_several_piers_the_larger_reaction_counts():
    piers = (PIER, EquivalentPier.from_frequency(20e3, 60.0))
    traffic = jcss_traffic(1.0, 5.0)
    both = risk(traffic, [LIGHT], piers, 100).strikes
    one, other = (risk(traffic, [LIGHT], pier, 100).strikes for pier in piers)
    np.testing.assert_array_equal(both.reaction, np.maximum(one.reaction, other.reaction))
    by_engine = np.where(one.reaction >= other.reaction, one.by_engine, other.by_engine)
    np.testing.assert_array_equal(both.by_engine, by_engine)


def test_the_tail_of_the_full_model_is_that_of_plain_monte_carlo():
    traffic = jcss_traffic(0.05, 10.0)
    plain, tilted = (
        risk(traffic, [LIGHT, HEAVY], PIER, 1024, seed, tilted=share).reaction
        for seed, share in ((1, 0.0), (2, 0.6))
    )
    for rate in (1e-3, 3e-4, 1e-4):
        value = float(tilted.value(rate / YEAR).value)
        one, other = plain.rate(value), tilted.rate(value)
        assert one.low <= other.high
        assert other.low <= one.high


def test_the_trucks_that_a_pier_fears_are_heavier_and_faster_than_those_that_strike_it():
    found = risk(jcss_traffic(0.05, 10.0), [LIGHT], PIER, 800)
    every, worst = found.feared(0.0), found.feared(9e6)
    assert worst.mass[1] > every.mass[1]
    assert worst.speed[1] > every.speed[1]
    assert 0.0 <= worst.by_engine <= 1.0
    assert worst.beyond > 0.9  # of a truck of 5 to 12 t
    assert found.feared(1e12) is None


@example([1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
@given(st.lists(st.floats(1.0, 9.0), min_size=1, max_size=30))
def test_weighted_quantiles_of_equal_weights_are_order_statistics(values):
    own = np.sort(np.array(values))
    found = weighted_quantiles(np.array(values), np.full(len(values), 0.3))
    places = [max(math.ceil(share * len(own) - 1e-9) - 1, 0) for share in (0.05, 0.5, 0.95)]
    assert list(found) == [own[place] for place in places]


LAWS = {
    "weibull": Distribution(law=stats.weibull_min(2.1, scale=22.0), words="w", status=None),
    "normal": Distribution(law=stats.norm(20.0, 12.0), words="n", status=None, low=3.5, high=60.0),
    "lognormal": Distribution(law=Lognormal.of(4.0, 1.3), words="l", status=None, high=9.0),
    "gamma": Distribution(law=stats.gamma(3.0, loc=2.0), words="g", status=None, low=4.0),
}


@given(st.sampled_from(sorted(LAWS)), st.floats(1e-6, 1.0 - 1e-6))
def test_a_share_and_its_value_belong_together(name, share):
    law = LAWS[name]
    value = law.exceeded_by(np.array([share]))
    assert law.low <= value[0] <= law.high
    assert law.share_above(value)[0] == pytest.approx(share, rel=1e-6)


@pytest.mark.parametrize("name", LAWS)
def test_the_mean_is_that_of_many_values(name):
    law = LAWS[name]
    shares = (np.arange(200_000) + 0.5) / 200_000
    assert law.mean == pytest.approx(law.exceeded_by(shares).mean(), rel=1e-4)


@given(
    st.sampled_from([Normal, Lognormal.of, Rayleigh.of]), st.floats(0.01, 1e4), st.floats(0.02, 5.0)
)
def test_laws_are_those_of_scipy(law, mean, variation):
    deviation = variation * mean
    if law == Normal:
        found, same = law(mean, deviation), stats.norm(mean, deviation)
    elif law == Rayleigh.of:
        found, same = law(mean), stats.rayleigh(scale=mean / math.sqrt(0.5 * math.pi))
    else:
        mu, sigma = lognormal_parameters(mean, deviation)
        found, same = law(mean, deviation), stats.lognorm(s=sigma, scale=math.exp(mu))
        assert (same.mean(), same.std()) == pytest.approx((mean, deviation))
    shares = np.array([1e-12, 1e-6, 0.01, 0.3, 0.5, 0.8, 0.999])
    values = same.isf(shares)
    np.testing.assert_allclose(found.isf(shares), values, rtol=1e-9, atol=1e-12 * deviation)
    for ends in ([-1.0, 0.0, math.inf], values):
        ends = np.array(ends)
        np.testing.assert_allclose(found.cdf(ends), same.cdf(ends), rtol=1e-9, atol=1e-15)
        np.testing.assert_allclose(found.sf(ends), same.sf(ends), rtol=1e-9, atol=1e-15)


def test_what_gives_negative_masses_is_refused_unless_it_is_truncated():
    with pytest.raises(InputError, match=r"negative values \(4\.8 % of all\)"):
        Distribution(law=stats.norm(20e3, 12e3), words="normal", status=None)
    assert jcss_mass().low == 3500.0
    with pytest.raises(InputError, match="no values between"):
        Distribution(law=stats.uniform(5.0, 1.0), words="u", status=None, low=7.0, high=9.0)


def test_traffic_has_laws_and_a_risk_has_trucks():
    traffic = jcss_traffic(1.0, 5.0)
    with pytest.raises(InputError, match=r"^speed must be a Distribution, got None$"):
        replace(traffic, speed=None)
    weighed = WeighedTrucks(mass=np.array([9e3]))
    assert replace(traffic, mass=weighed).mass is weighed
    for name in ("speed", "deceleration", "angle"):
        with pytest.raises(InputError, match=f"^{name} must be a Distribution, got Weighed"):
            replace(traffic, **{name: weighed})
    for trucks, shown in (([], r"\[\]"), (LIGHT, "Truck"), ([None], r"\[None\]"), (3, "3")):
        with pytest.raises(InputError, match=f"^trucks must be one or more Trucks, got {shown}"):
            risk(traffic, trucks, PIER)
    with pytest.raises(InputError, match=r"^size must be at least 1, got 0$"):
        risk(traffic, [LIGHT], PIER, size=0)


def test_weighed_trucks_keep_mass_and_speed_together():
    random = np.random.default_rng(1)
    mass = random.uniform(4e3, 40e3, 300)
    sample = WeighedTrucks(mass=mass, speed=mass / 1e3)
    traffic = jcss_traffic(1.0, 0.0, mass=sample)
    own = draw(traffic, [LIGHT], 0)
    np.testing.assert_array_equal(own.road_speed, own.mass / 1e3)
    mean = np.average(own.mass, weights=own.weight)
    assert mean == pytest.approx(mass.mean(), rel=0.02)
    counted = np.bincount(np.searchsorted(np.sort(mass), own.mass), own.weight)
    assert len(counted) == 300
    with pytest.raises(InputError, match="must have a truck"):
        WeighedTrucks(mass=np.array([]))


def test_a_block_alone_is_that_of_all():
    traffic = jcss_traffic(0.05, 300.0)
    whole = risk(traffic, [LIGHT], PIER, BLOCK + 100, 2).strikes
    task = Task(traffic, (LIGHT,), (PIER,), BLOCK + 100, 2, 0.6)
    last = strikes_of(pickle.loads(pickle.dumps(task)), 1)  # as another process does
    for part, every in zip(last, whole, strict=True):
        np.testing.assert_array_equal(part, every[BLOCK:])


@pytest.mark.parametrize("seed", range(40))
def test_nothing_is_exceeded_more_often_than_there_are_events(seed):
    random = np.random.default_rng(seed)
    values, weights = random.lognormal(size=300), random.gamma(0.5, size=300)
    better = values[:60] * random.lognormal(0.5, 0.6, 60)
    found = Exceedance(values, weights, 2.0, better)
    total = 2.0 * weights.sum() / 300
    at = np.concatenate(([-1.0, 0.0], np.sort(np.concatenate((values, better)))))
    assert np.all(found.rate(at).value <= total * (1.0 + 1e-12))
    # The value that is exceeded as often as it is exceeded is itself, whatever sums round to.
    first = Exceedance(values, weights, 2.0)
    backwards = Exceedance(values[::-1], weights[::-1], 2.0)
    for value in np.sort(values)[[0, 1, 100, -1]]:
        there = float(first.rate(value * (1.0 - 1e-9)).value)
        assert backwards.value(there).value == value
