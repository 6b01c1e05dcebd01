"""What the lessons say is so: each claim of their prose is computed."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from in_node import contents_of, in_node
from one_at_a_time import one_at_a_time
from reference import solve
from test_page import as_arguments

from pierimpact import EquivalentPier, load_truck, peak_reactions
from pierimpact.design.codes import aashto_lrfd
from pierimpact.design.procedure import design_values
from pierimpact.design.reduction import exact_amplification
from pierimpact.pier.equivalent import stiffness_at_frequency
from pierimpact.teaching import widgets
from pierimpact.teaching.checker import check
from pierimpact.teaching.questions import LESSONS, questions
from pierimpact.teaching.questions.common import growth
from pierimpact.teaching.scenario import EXAMPLE, FREQUENCIES, Scenario
from pierimpact.vehicle.spread import Uniform
from pierimpact.vehicle.truck import QUANTITIES

KMH = 1.0 / 3.6
FILES = sorted((Path(__file__).parents[1] / "notebooks").glob("0*.ipynb"))


def prose(lesson):
    cells = json.loads(FILES[list(LESSONS).index(lesson)].read_text(encoding="utf-8"))["cells"]
    return "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")


def on_a_pier(hertz, **other):
    return Scenario(pier_mass=8e3, pier_frequency=float(hertz), **other)


def says(lesson, words):
    """Hold the prose to the words whose truth is computed beside the call."""
    assert words in prose(lesson), words


@pytest.mark.parametrize("lesson", LESSONS)
def test_a_lesson_names_its_title_and_every_belief_that_it_corrects(lesson):
    assert prose(lesson).startswith(f"# {LESSONS[lesson].title}")
    for belief, truth in LESSONS[lesson].misconceptions:
        says(lesson, f"- *{belief}* {truth}")


@pytest.mark.parametrize("lesson", LESSONS)
def test_a_prediction_has_one_right_choice_and_a_word_to_each(lesson):
    prediction = LESSONS[lesson].prediction
    assert prediction.answer() in prediction.choices
    assert len(prediction.choices) >= 3
    assert all(prediction.choices.values())


def test_the_predictions_come_true():
    """By the tests' own integration where there is one, by the explorer's numbers otherwise."""
    truck = load_truck("single-unit-8t")
    right = {name: lesson.prediction.answer() for name, lesson in LESSONS.items()}
    default = Scenario()
    found = solve(truck, default.pier, 80.0 * KMH)
    assert right["collision"].startswith("two spikes")
    assert found.cargo > 1.5 * (truck.engine_spring.plateau_force + truck.body_spring.plateau_force)
    assert right["design"].startswith("more than twice")
    assert max(found.engine, found.cargo) > 2.0 * 2668.9e3
    assert aashto_lrfd().along.value == pytest.approx(2668.9e3, rel=1e-4)
    soft, stiff = (
        solve(truck, EquivalentPier(mass=8e3, stiffness=8e3 * (2 * np.pi * f) ** 2), 80.0 * KMH)
        for f in (10.0, 100.0)
    )
    assert right["spectra"] == "mainly the engine’s"
    assert stiff.engine / soft.engine > 3.0 > 1.2 > stiff.cargo / soft.cargo
    assert right["reduction"] == "a smaller reaction"
    assert soft.engine < 0.4 * stiff.engine
    free = Scenario(top="free").column
    assert right["pier"].startswith("more than")
    assert free.struck_at(1.2).mass > free.mass_per_length * free.height
    assert right["limits"] == "the engine’s mass"
    spreads = dict.fromkeys(QUANTITIES, Uniform.about(0.3))
    changed = np.abs(one_at_a_time(default.history.collision, spreads).engine - found.engine).max(
        axis=1
    )
    assert QUANTITIES[int(changed.argmax())] == "engine_mass"


def test_what_stands_for_an_engine_peak_is_named_as_the_explorer_names_it():
    slow, soft, usual = Scenario(speed=40.0 * KMH), on_a_pier(3.0), Scenario()
    given = [as_arguments(each.history.collision) for each in (slow, soft, usual)]
    program = "cases.map((each) => sentencesModule.firstPeak(simulate(...each)))"
    names = in_node(program, given)
    assert names == ["Sheet metal", "Until cargo hits", "Engine’s peak"]
    metal, rising, _ = (name.lower() for name in names)
    words = "in its place the explorer then gives the largest reaction to"
    says("collision", f"there is no engine peak: {words} *{metal}*, or that *{rising}*.")


EXPLORERS = {name: name for name in LESSONS} | {"limits": "sensitivity"}


def opening(explorer):
    """Return the words that an explorer opens with."""
    if "kind" in explorer.widget.setup:
        (found,) = contents_of(explorer, {})
        table = found.get("table", {"rows": found.get("facts")})["rows"]
        return " ".join(
            [*(re.sub("<[^>]+>", "", cell) for row in table for cell in row), found["words"]]
        )
    scenario = explorer.scenario()
    pier, peaks = scenario.pier, scenario.history.peaks.values()
    facts = [
        f"{pier.frequency:.1f} Hz",
        f"{pier.stiffness / 1e6:.0f} MN/m",
        f"{pier.mass / 1e3:.3g} t",
    ]
    facts += [f"{scenario.history.collision.energy / 1e6:.2f} MJ"]
    return " ".join([*facts, *(f"{peak.reaction / 1e6:.2f} MN" for peak in peaks if peak)])


@pytest.mark.parametrize("lesson", LESSONS)
def test_no_answer_stands_above_its_question(lesson):
    """Neither in the prose nor in the explorer as it opens, but for what chance brings about."""
    shown = prose(lesson) + opening(getattr(widgets, EXPLORERS[lesson])())
    quantities = set(re.findall(r"(?<![\w.])\d[\d.\u202f]*(?: [A-Za-z/]+)?", shown))
    everyones = [questions(lesson, str(index)) for index in range(20)]
    for asked in zip(*everyones, strict=True):
        if not asked[0].choices:
            given_away = [any(check(q, text).right for text in quantities) for q in asked]
            assert sum(given_away) < 0.3 * len(asked), asked[0].words


def test_collision_claims():
    history, scenario = Scenario().history, Scenario()
    energy, truck = history.energy, scenario.truck
    whole = scenario.history.collision.energy
    says(
        "collision",
        "Nine tenths of it are dissipated in crushing metal, more than half of it all on",
    )
    assert 0.88 < energy.crush[-1] / whole < 0.92
    says("collision", "more than half of it all on the plateaus")
    plateaus = sum(
        spring.plateau_force * spring.plateau_length
        for spring in (truck.engine_spring, truck.body_spring)
    )
    assert 0.5 < plateaus / whole < 0.55
    says("collision", "With the values at first never more than a hundredth is in the pier")
    in_pier = energy.pier_elastic + 0.5 * scenario.pier.mass * history.pier_velocity**2
    assert in_pier.max() < 0.01 * whole
    says("collision", "Below 60 km/h the second spike disappears, and below 53 km/h the first.")
    for speed, engine, cargo in ((60.0, True, True), (59.0, True, False), (52.5, False, False)):
        slow = Scenario(speed=speed * KMH).history
        assert (slow.engine_contact_time is not None) is engine
        assert (slow.cargo_contact_time is not None) is cargo
    says("collision", "the push of the plateaus, at 1.2 MN: the pier overshoots their force")
    for speed in (20.0, 35.0, 50.0):
        slow = Scenario(speed=speed * KMH).history
        assert slow.engine_peak.reaction == pytest.approx(1.2e6, rel=0.02)
        assert slow.engine_peak.reaction > 1.8 * slow.contact_force.max() * 650.0 / 671.5 * 0.98
    says("collision", "The engine's spring force hardly changes, but the reaction does.")
    soft = Scenario(column_diameter=0.6, column_height=8.0, top="free").history
    assert soft.engine_force.max() == pytest.approx(history.engine_force.max(), rel=0.05)
    assert soft.engine_peak.reaction < 0.25 * history.engine_peak.reaction


@pytest.mark.parametrize("top", ["pinned", "free"])
def test_pier_claims(top):
    says("pier", "at 0.6 m the default column deflects more in shear than in bending")
    struck = Scenario(top=top).column.struck_at(0.6)
    assert struck.values["xs"] > 0.5 * struck.values["xn"]
    higher = Scenario(top=top).column.struck_at(1.2)
    assert higher.values["xs"] < 0.5 * higher.values["xn"]


def test_the_limit_of_the_impulse_is_that_of_two_free_masses():
    """The yellow line, with 1/(1+μ); damping takes what a damped oscillator's first swing lacks."""
    says("reduction", "S \\to \\frac{(1+e)\\, \\beta}{1+\\mu}")
    generator = np.random.default_rng(3)
    for share, e in generator.uniform((0.05, 0.1), (0.9, 0.9), (4, 2)):
        # Lighter bodies than this leave the pier for good: their speed exceeds the largest chord
        # of its way back, max |sin θ|/θ for θ from π to 2π.
        mu = share * e / (1.0 + 0.2172 * (1.0 + e))
        soft = np.geomspace(0.02, 0.03, 8)
        impulse = (1.0 + e) * soft / (1.0 + mu)
        assert exact_amplification(soft, mu, e, 0.0) == pytest.approx(impulse, rel=5e-3)
        first = np.exp(-0.05 / np.sqrt(1.0 - 0.05**2) * np.arccos(0.05))
        damped = exact_amplification(soft, mu, e, 0.05)
        assert damped == pytest.approx(first * impulse, rel=5e-3)
    says("reduction", "With 5 % of damping the exact curve stays 7 % below it")
    values = reduced(EXAMPLE)
    soft = np.geomspace(0.02, 0.1, 20)
    for mu, e in ((values[f"mu{i}"], values[f"e{i}"]) for i in (1, 2)):
        exact = exact_amplification(soft, mu, e, EXAMPLE.damping_ratio)
        assert exact / ((1.0 + e) * soft / (1.0 + mu)) == pytest.approx(0.93, abs=0.005)


def reduced(scenario):
    """Return the values of the short level with the exact amplification."""
    return design_values(
        scenario.history.collision.parameters,
        "short",
        lambda *ratios: float(exact_amplification(*ratios)),
    )


def amplifications_at(hertz):
    values = reduced(on_a_pier(hertz))
    return values["S1"], values["S2"]


def test_reduction_claims():
    values = reduced(EXAMPLE)
    says(
        "reduction",
        "the engine (stiff, light, fast) has a β below 1",
    )
    assert values["beta1"] < 0.5 < 5.0 < values["beta2"]
    says("reduction", "its blow lasts about a third of that period")
    assert 0.25 * (1.0 + values["e1"]) == pytest.approx(1.0 / 3.0, abs=0.03)  # up, and down faster
    says("reduction", "the engine's rises while the cargo's stays within a tenth of 1")
    engine, cargo = np.array([amplifications_at(f) for f in np.geomspace(30.0, 200.0, 13)]).T
    assert np.abs(cargo - 1.0).max() < 0.1
    assert engine[-1] > 2.5 * engine[0]
    says("reduction", "up to *S* = 1.3 near 14 Hz, and down to 0.6 at 5 Hz")
    frequencies = np.linspace(5.0, 30.0, 26)
    below = np.array([amplifications_at(f)[1] for f in frequencies])
    assert below.max() == pytest.approx(1.3, abs=0.05)
    assert frequencies[below.argmax()] == pytest.approx(14.0, abs=1.5)
    assert below[0] == pytest.approx(0.6, abs=0.02)
    says("reduction", "here up to one and a half times as far. That is not resonance")
    ratios = np.geomspace(0.5, 20.0, 120)
    for i in (1, 2):
        curve = exact_amplification(ratios, values[f"mu{i}"], values[f"e{i}"], 0.05)
        assert 1.3 < curve.max() < 1.6
    assert exact_amplification([400.0], values["mu1"], values["e1"], 0.05) == pytest.approx(1, 0.01)


def test_no_prose_calls_an_overshoot_resonance():
    for lesson in LESSONS:
        for sentence in re.split(r"(?<=[.:])\s", prose(lesson)):
            if "resonan" in sentence.lower():
                assert "not resonance" in sentence or "repeats" in sentence or "exceeds" in sentence


def spectra_of(scenario):
    """Return the frequencies of the spectra and the peaks there."""
    frequency = np.geomspace(*FREQUENCIES, 121)
    pier = scenario.pier
    stiffness = stiffness_at_frequency(pier.mass, frequency)
    truck = scenario.truck
    peaks = peak_reactions(truck, pier.mass, stiffness, pier.damping_ratio, scenario.speed)
    return frequency, peaks


def turns(scenario):
    """Return where the cargo's line has its tops and its dips from 8 to 24 Hz."""
    frequency = np.linspace(8.0, 24.0, 161)
    truck, pier = scenario.truck, scenario.pier
    stiffness = stiffness_at_frequency(pier.mass, frequency)
    peaks = peak_reactions(truck, pier.mass, stiffness, pier.damping_ratio, scenario.speed)
    up = np.diff(peaks.cargo) > 0.0
    return frequency[1:-1][up[:-1] & ~up[1:]], frequency[1:-1][~up[:-1] & up[1:]]


def test_the_spectra_in_short():
    says("spectra", "The engine's grows with frequency: slowly at first")
    engine, cargo = (
        {hertz: on_a_pier(hertz).history.peaks[body].reaction for hertz in (4, 10, 20, 100, 200)}
        for body in ("engine", "cargo")
    )
    assert engine[20] < 2.0 * engine[4]
    assert 2.0e6 < engine[20] < 2.3e6
    assert engine[100] == pytest.approx(7.5e6, rel=0.01)
    says("spectra", "in proportion to frequency but less than the push of the plateaus")
    spring = EXAMPLE.truck.engine_spring.stiffness * EXAMPLE.truck.engine_mass
    for hertz in (4, 10):
        blow = amplifications_at(hertz)[0] * reduced(EXAMPLE)["v1"] * spring**0.5
        assert blow / hertz == pytest.approx(0.0882e6, rel=0.01)
        assert blow < 0.5 * engine[hertz]
    says("spectra", "The cargo's rises up to 10 Hz and has no such trend above")
    soft = [on_a_pier(hertz).history.cargo_peak.reaction for hertz in np.linspace(2.0, 10.0, 9)]
    assert np.all(np.diff(soft) > 0.0)
    frequency, peaks = spectra_of(EXAMPLE)
    above = peaks.cargo[frequency > 10.0]
    says(
        "spectra",
        "its ripples, which swing between 4 and 6 MN, it settles at 4.1 MN, little more",
    )
    assert 3.8e6 < above.min() < above.max() < 6.0e6
    assert cargo[200] == pytest.approx(4.1e6, rel=0.02)
    assert 1.0 < cargo[200] / on_a_pier(200.0).history.body_force.max() < 1.02


def test_spectra_claims():
    says("spectra", "Below 3.5 Hz there is no engine peak at all")
    for hertz, is_peak in ((2.0, False), (3.0, False), (3.5, True), (4.0, True), (100.0, True)):
        history = on_a_pier(hertz).history  # where there is none, it rises until the cargo arrives
        assert (history.engine_peak.time < 0.999999 * history.cargo_contact_time) is is_peak
    frequency, peaks = spectra_of(EXAMPLE)
    says("spectra", "between 10 and 20 Hz, the pier overshoots the cargo's force most")
    says("spectra", "*S* of notebook 3 is above 1.1 there, and largest near 14 Hz")
    assert min(amplifications_at(hertz)[1] for hertz in (10.0, 12.0, 14.0, 17.0, 20.0)) > 1.1
    says("spectra", "it has two tops, at 11 and 19 Hz, and a dip of theirs where *S* is largest")
    assert frequency[peaks.cargo.argmax()] == pytest.approx(19.0, abs=0.8)
    tops, dips = turns(EXAMPLE)
    assert tops == pytest.approx([11.0, 19.0], abs=0.5)
    assert dips == pytest.approx([14.0], abs=0.5)
    says("spectra", "Set the damping to 0.2, and one top is left")
    assert [len(each) for each in turns(on_a_pier(30.0, damping_ratio=0.2))] == [1, 0]
    says("spectra", "Increase the damping and they fade.")
    rough = [
        np.abs(np.diff(np.log(spectra_of(on_a_pier(30.0, damping_ratio=ratio))[1].cargo), 2)).sum()
        for ratio in (0.05, 0.1, 0.2)
    ]
    assert rough[0] > 1.5 * rough[1] > 3.0 * rough[2]
    says("spectra", "Its mass changes the cargo's spectrum, but not the engine's.")
    says("spectra", "The cargo's spectrum falls faster than the engine's, and disappears.")
    for hertz in (10.0, 30.0, 60.0, 100.0):
        loaded = growth(on_a_pier(hertz), on_a_pier(hertz, truck_mass=16e3))
        assert loaded["engine"] == pytest.approx(1.0, abs=1e-3)
        assert loaded["cargo"] > 1.4
        slower = growth(on_a_pier(hertz), on_a_pier(hertz, speed=70.0 * KMH))
        assert slower["cargo"] < slower["engine"] < 1.0
        assert on_a_pier(hertz, speed=58.0 * KMH).history.cargo_peak is None
    says("spectra", "soft piers are governed by the cargo, stiff ones by the engine")
    governs = peaks.engine > peaks.cargo
    assert np.abs(np.diff(governs.astype(int))).sum() == 1
    assert governs[-1]


def test_the_stiffness_of_a_spring_counts_on_a_soft_pier_through_the_rebound():
    reason = questions("limits")[0].reason
    assert "counts only through the rebound, e = √(k/k_u), and moves the peak by less" in reason
    for hertz in (4.0, 7.0, 10.0):
        before, unloading = on_a_pier(hertz), EXAMPLE.engine_unloading_stiffness
        for share in (1.3, 1.8):  # as far as the question asks
            stiffer = {"engine_stiffness": share * before.engine_stiffness}
            assert 1.0 < growth(before, on_a_pier(hertz, **stiffer))["engine"] < share**0.25
        stiffer = {"engine_stiffness": 1.5 * before.engine_stiffness}
        stiffer["engine_unloading_stiffness"] = 1.5 * unloading  # and no other rebound
        assert growth(before, on_a_pier(hertz, **stiffer))["engine"] == pytest.approx(1.0, abs=2e-3)
