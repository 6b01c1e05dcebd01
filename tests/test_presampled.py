"""The collisions that the explorer of the risk weighs are those of the model and the traffic."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from in_node import contents_of, in_node
from scipy import stats
from traffic_of_jcss import jcss_traffic

from pierimpact import EquivalentPier, load_truck
from pierimpact.risk import exceedance
from pierimpact.risk.analysis import risk
from pierimpact.risk.laws import Lognormal
from pierimpact.risk.traffic import YEAR, jcss_speed
from pierimpact.teaching import presampled, widgets
from pierimpact.teaching.questions import LESSONS
from pierimpact.teaching.questions.risk import shares
from pierimpact.teaching.scenario import Scenario
from pierimpact.teaching.variables import VARIABLES

FLEET = [load_truck("single-unit-8t"), load_truck("tractor-trailer-36t")]
HOUSE = Path(__file__).parents[1]


def outcome(scenario):
    """Frequencies of hits and of reactions above the resistance, and the one at 1e-4 [1/year]."""
    own, weights = presampled.presampled(), presampled.weights(scenario)
    reaction = own.reaction[scenario.risk_pier]
    order = np.argsort(-reaction)
    place = min(np.searchsorted(np.cumsum(weights[order]), 1e-4), len(order) - 1)
    above = weights[reaction > scenario.resistance].sum()
    return weights.sum(), above, reaction[order][place]


def test_the_file_is_up_to_date():
    """Of a shorter sequence of points, which the longer begins with."""
    few, all_of_them = presampled.solve(4), presampled.presampled()
    for name in ("mass", "speed"):
        np.testing.assert_allclose(getattr(all_of_them, name)[:16], getattr(few, name), rtol=1e-3)
    for name in presampled.PIERS:
        np.testing.assert_allclose(all_of_them.reaction[name][:16], few.reaction[name], rtol=1e-3)
        np.testing.assert_array_equal(all_of_them.engine[name][:16], few.engine[name])


@given(st.floats(0.5, 20.0), st.floats(12.0, 30.0))
@settings(max_examples=8, deadline=None)
def test_the_chance_of_arriving_faster_is_that_of_the_laws(distance, speed):
    """By Monte Carlo with trucks one by one, at three speeds."""
    scenario = Scenario(distance_from_road=distance, mean_speed=speed)
    x, beyond = presampled.arrival_speeds(scenario)
    n, random = 40_000, np.random.default_rng(1)

    def lognormal(mean, deviation):
        s = np.sqrt(np.log1p((deviation / mean) ** 2))
        return mean * np.exp(s * random.standard_normal(n) - 0.5 * s**2)

    angle = random.rayleigh(np.radians(10.0) / np.sqrt(np.pi / 2.0), n)
    left = lognormal(speed, 10.0 / 3.6) ** 2 - 2.0 * lognormal(4.0, 1.3) * distance / np.sin(angle)
    for place in (0, 16, 36):
        found = np.mean(left > x[place] ** 2)
        error = np.sqrt(max(beyond[place], 1e-4) / n)
        assert beyond[place] == pytest.approx(found, abs=5.0 * error + 1e-3)


@pytest.mark.parametrize("distance", [0.0, 6.0, 14.0])
def test_weighed_they_are_the_hits_of_the_traffic(distance):
    scenario = Scenario(distance_from_road=distance)
    traffic = jcss_traffic(scenario.traffic_volume * scenario.truck_share, distance)
    own = risk(traffic, FLEET[:1], EquivalentPier.from_frequency(8e3, 30.0), 300)
    hits = own.reaction.total
    assert float(hits.low) < outcome(scenario)[0] / YEAR * 1.03
    assert float(hits.high) > outcome(scenario)[0] / YEAR * 0.97


def test_weighed_they_exceed_as_often_as_collisions_of_that_traffic(monkeypatch):
    monkeypatch.setattr(exceedance, "CONFIDENCE", 0.999)
    for name, frequency in presampled.PIERS.items():
        scenario = Scenario(risk_pier=name)
        traffic = jcss_traffic(scenario.traffic_volume * scenario.truck_share, 6.0)
        own = risk(traffic, FLEET, EquivalentPier.from_frequency(8e3, frequency), 1000, 5)
        rate = own.reaction.rate(scenario.resistance)
        above = outcome(scenario)[1] / YEAR
        assert 0.95 * float(rate.low) < above < 1.05 * float(rate.high)


FASTEST = Scenario(
    traffic_volume=1e5 / 86400.0,
    truck_share=0.5,
    distance_from_road=2.0,
    mean_speed=VARIABLES["mean_speed"].high / 3.6,
)


def test_no_truck_of_the_fastest_traffic_is_faster_than_those_of_the_file():
    for distance in (0.0, 2.0, 20.0):
        _, beyond = presampled.arrival_speeds(replace(FASTEST, distance_from_road=distance))
        assert beyond[-1] == 0.0
        assert beyond[48] > 0.0  # at 120 km/h


@pytest.mark.parametrize("resistance", [5e6, 10e6, 15e6])
def test_of_fast_traffic_they_exceed_as_often(resistance, monkeypatch):
    """However large the resistance: with more than 130 km/h beside the rest."""
    monkeypatch.setattr(exceedance, "CONFIDENCE", 0.999)
    speed = replace(jcss_speed(), law=Lognormal.of(FASTEST.mean_speed, 10.0 / 3.6))
    trucks = FASTEST.traffic_volume * FASTEST.truck_share
    traffic = jcss_traffic(trucks, FASTEST.distance_from_road, speed=speed)
    own = risk(traffic, FLEET, EquivalentPier.from_frequency(8e3, 30.0), 4000, 5)
    rate = own.reaction.rate(resistance)
    above = outcome(replace(FASTEST, resistance=resistance))[1] / YEAR
    assert 0.8 * float(rate.low) < above < 1.25 * float(rate.high)


def test_the_explorer_says_where_few_collisions_account_for_a_frequency():
    fast = {
        name: getattr(FASTEST, name)
        for name in ("traffic_volume", "truck_share", "distance_from_road", "mean_speed")
    }
    resistances = (5e6, 15e6, 30e6)
    found = contents_of(widgets.risk(), *({**fast, "resistance": value} for value in resistances))
    often, rare, never = (content["words"] for content in found)
    assert often.endswith(" by the engine’s peak.")
    scenario = replace(FASTEST, resistance=15e6)
    above = presampled.weights(scenario) * (presampled.presampled().reaction["30 Hz"] > 15e6)
    few = round(above.sum() ** 2 / (above**2).sum())
    assert 1 < few < 10
    assert rare.endswith(
        f" Only some {few} of the 4096 collisions solved account for that: it is rough."
    )
    assert never.endswith(" its resistance is exceeded by none of the 4096 collisions solved.")
    facts = {name: value for name, value, _ in found[2]["facts"]}
    assert facts["Resistance exceeded"] == "by none of the collisions solved"
    assert "None of the collisions solved" in found[2]["charts"][1]["empty"]


def test_the_browser_weighs_them_alike():
    setup = widgets.risk().widget.setup
    changes = [
        {},
        {"distance_from_road": 0.0, "mean_mass": 9e3},
        {"distance_from_road": 17.0, "mean_speed": 12.0, "truck_share": 0.4},
        {"mean_speed": 29.0, "traffic_volume": 0.9, "mean_mass": 33e3},
    ]
    cases = [[setup["defaults"] | change for change in changes], setup["presampled"]]
    found = in_node("cases[0].map((values) => riskModule.yearly(values, cases[1]))", cases)
    for change, weights in zip(changes, found, strict=True):
        np.testing.assert_allclose(weights, presampled.weights(Scenario(**change)), rtol=1e-9)


def test_the_explorer_says_what_the_weights_come_to():
    scenario = Scenario()
    hits, above, at = outcome(scenario)
    (found,) = contents_of(widgets.risk(), {})
    facts = {name: value for name, value, _ in found["facts"]}
    assert facts["Struck"] == f"once in {round(1 / hits, -1):.0f} years"
    assert (
        facts["Resistance exceeded"].replace("\u202f", "")
        == f"once in {round(1 / above, -2):.0f} years"
    )
    assert facts["Once in 10 000 years"] == f"{at / 1e6:.2f} MN"
    curve = found["charts"][0]["curves"][0]
    assert np.all(np.diff(curve["x"]) < 0.0)
    assert np.all(np.diff(curve["y"]) <= 0.0)
    for chart in found["charts"][1:]:
        assert sum(row["bars"][0]["value"] for row in chart["rows"]) == pytest.approx(100.0)
    (none,) = contents_of(widgets.risk(), {"resistance": 1e9})
    assert none["charts"][1]["empty"]


def test_the_lesson_says_what_is_so():
    prose = (HOUSE / "notebooks" / "07_risk.ipynb").read_text(encoding="utf-8")
    cells = json.loads(prose)["cells"]
    prose = "\n".join("".join(cell["source"]) for cell in cells)
    own, default = presampled.presampled(), Scenario()
    weights = presampled.weights(default)
    above = weights * (own.reaction["30 Hz"] > 5e6)
    assert LESSONS["risk"].prediction.answer().startswith("the fastest")
    assert max(shares(default).values()) > 0.7
    assert "one in five of those that strike, and three in four of those that exceed 5 MN" in prose
    fast = 3.6 * own.speed > 70.0
    assert weights[fast].sum() / weights.sum() == pytest.approx(0.2, abs=0.02)
    assert above[fast].sum() / above.sum() == pytest.approx(0.75, abs=0.03)
    assert "masses up to 60 t and speeds up to 160 km/h drawn evenly" in prose
    assert 3.6 * presampled.SPEEDS[1] == pytest.approx(160.0)
    assert presampled.MASSES[1] == 60e3
    assert "Their mean mass is 22 t either way." in prose
    for counted in (weights, above):
        assert np.average(own.mass, weights=counted) == pytest.approx(22e3, abs=600.0)
    soft = weights * (own.reaction["10 Hz"] > 5e6)
    assert np.average(own.engine["10 Hz"], weights=soft) < 0.02
    assert np.average(own.mass < 15.5e3, weights=soft) > 0.6
    assert "about half of the hits are left, but less than a quarter of the cases" in prose
    near, far = outcome(default), outcome(replace(default, distance_from_road=12.0))
    assert far[0] / near[0] == pytest.approx(0.5, abs=0.05)
    assert far[1] / near[1] < 0.25
    assert "grows by a tenth" in prose
    double = outcome(replace(default, traffic_volume=2.0 * default.traffic_volume))
    assert double[0] / near[0] == pytest.approx(2.0)
    assert double[2] / near[2] == pytest.approx(1.1, abs=0.03)
    force = own.speed * np.sqrt(300e3 * own.mass)
    assert stats.spearmanr(force, own.reaction["30 Hz"]).statistic > 0.5
    assert weights[force > 5e6].sum() < 0.01 * above.sum()
