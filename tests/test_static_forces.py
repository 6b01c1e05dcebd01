"""The rules for static member forces are those of the study, and warn where they should."""

import json
import math
import re
import warnings
from itertools import islice, product

import numpy as np
import pytest
from generated_columns import GENERATED, round_column, struck_columns
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_hex

from pierimpact import CrushSpring, InputError, StaticForcesWarning, Truck, load_truck, maps
from pierimpact.design import static_forces, static_study
from pierimpact.design.sensitivity import sensitivity
from pierimpact.design.static_forces import ABOVE, AS_LARGE, BELOW, StaticForcesInCollision
from pierimpact.files.case import case_from, read_case_file
from pierimpact.pier.static_forces import (
    LOWEST_FREQUENCY,
    QUICK,
    RATIOS,
    SLOW,
    TOP,
    StaticForces,
)
from pierimpact.plots.static_forces import map_figure
from pierimpact.report.calculation import calculate
from pierimpact.report.warnings import warnings_of
from pierimpact.resources import shipped
from pierimpact.teaching.scenario import Scenario
from pierimpact.teaching.tables import static_forces as table_of_rules

TRUCK = load_truck("single-unit-8t")


@pytest.fixture(scope="module")
def outcome():
    return json.loads(static_study.OUTCOME_FILE.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def columns(outcome):
    return static_study.as_columns(outcome["found"])


# The study.


def test_the_file_is_of_this_study(outcome, columns):
    assert (outcome["seed"], outcome["size"]) == (static_study.SEED, static_study.SIZE)
    assert {len(values) for values in columns.values()} == {outcome["size"]}
    assert tuple(columns) == static_study.Found._fields
    assert list(outcome["varied"]) == list(static_study.VARIED)
    assert all(np.isfinite(values).all() for values in columns.values())
    assert static_study.OUTCOME_FILE.stat().st_size < 200e3


def test_the_first_columns_of_the_file_come_out_again(outcome):
    sample = static_study.sample(outcome["size"], outcome["seed"])
    for number, struck in enumerate(islice(sample, 6)):
        found = static_study.compare(struck)
        stated = {name: outcome["found"][name][number] for name in found._fields}
        assert found._asdict() == pytest.approx(stated, rel=5e-3)


def test_what_is_sampled_keeps_the_ranges(outcome):
    sampled = list(static_study.sample(600, 4))
    assert len(sampled) == 600
    for struck in sampled:
        section, height = struck.column.section, struck.column.height
        depth = section.values.get("D", section.values.get("h"))
        values = {
            "diameter, or depth along the travel": depth,
            "height over diameter or depth": height / depth,
            "nominal impact height": struck.impact_height,
            "elastic modulus": struck.column.elastic_modulus,
            "damping ratio": struck.damping_ratio,
            "speed at first touch": struck.speed,
            "total mass of the truck": struck.truck.mass,
            "width over depth of a rectangle": section.values.get("b", depth) / depth,
        }
        assert list(values) == list(static_study.VARIED)
        for name, (low, high, _, size) in static_study.VARIED.items():
            assert low * size * (1 - 1e-9) <= values[name] <= high * size * (1 + 1e-9), name
        assert struck.impact_height <= static_study.HIGHEST * height
    found = {(struck.column.base, struck.column.top) for struck in sampled}
    assert found == set(static_study.ENDS)


def test_samples_repeat_with_their_seed():
    first, again, other = (next(static_study.sample(5, seed)) for seed in (1, 1, 2))
    assert first == again
    assert first != other


@pytest.mark.parametrize("ends", static_study.ENDS[1::2])
def test_under_a_slow_load_static_forces_are_those_of_the_beam(ends):
    spring = CrushSpring(
        plateau_force=100e3, plateau_length=5.0, stiffness=3e5, unloading_stiffness=3e5
    )
    truck = Truck(
        name="slow", engine_mass=6e4, body_mass=6e4, engine_spring=spring, body_spring=spring
    )
    struck = static_study.Struck(truck, round_column(3.0, 1.0, *ends), 1.2, 0.3, 1.0)
    found = static_study.compare(struck)
    assert (found.shear, found.moment, found.reaction) == pytest.approx((1.0, 1.0, 1.0), abs=0.01)
    # The whole blow is one long plateau.
    assert found.blow > 1.0


def test_the_conclusions_are_those_of_the_columns(outcome, columns):
    assert static_study.conclusions(columns) == outcome["conclusions"]


def test_main_writes_the_file_and_reports(outcome, tmp_path, monkeypatch):
    monkeypatch.setattr(static_study, "OUTCOME_FILE", tmp_path / "static_study.json")
    known = iter(zip(*outcome["found"].values(), strict=True))
    monkeypatch.setattr(static_study, "compare", lambda _: static_study.Found(*next(known)))
    lines = []
    static_study.main(report=lines.append)
    assert json.loads((tmp_path / "static_study.json").read_text(encoding="utf-8")) == outcome
    assert len(lines) == len(outcome["conclusions"])


# How the study counts.


def made_up(count, seed):
    random = np.random.default_rng(seed)
    found = {name: random.uniform(0.5, 1.5, count) for name in static_study.Found._fields}
    return found | {"ends": random.integers(0, 6, count).astype(float)}


def test_telling_is_the_chance_of_a_right_guess():
    random = np.random.default_rng(6)
    for _ in range(20):
        values = random.integers(0, 12, 60).astype(float)  # some of them equal
        low = random.uniform(size=60) < 0.4
        guesses = [0.5 if a == b else float(a > b) for a, b in product(values[low], values[~low])]
        chance = np.mean(guesses)
        assert static_study.telling(values, low) == pytest.approx(max(chance, 1 - chance), abs=6e-4)
    assert static_study.telling(np.arange(9.0), np.arange(9) < 4) == 1.0
    assert static_study.telling(np.ones(9), np.arange(9) < 4) == 0.5


def test_alarms_and_summary_count_cases_one_by_one():
    for seed in range(5):
        found = made_up(200, seed)
        random = np.random.default_rng(seed)
        warned, cases = random.uniform(size=(2, 200)) < 0.6
        rates, summary = (
            static_study.alarms(found, warned, cases),
            static_study.summary(found, cases, 1.1),
        )
        members = [i for i in range(200) if cases[i]]
        assert rates["warned"] == pytest.approx(sum(warned[members]) / len(members), abs=5e-4)
        assert summary["cases"] == len(members)
        for force in static_study.FORCES:
            low = {i for i in members if found[force][i] < static_study.TOO_LOW}
            alarmed = {i for i in members if warned[i]}
            caught, false = len(low & alarmed) / len(low), len(alarmed - low) / len(alarmed)
            assert rates[force] == pytest.approx({"caught": caught, "false": false}, abs=5e-4)
            ratios = sorted(1.1 * found[force][i] for i in members)
            share = sum(ratio < static_study.TOO_LOW for ratio in ratios) / len(ratios)
            assert summary[force]["too low"] == pytest.approx(share, abs=5e-4)
            least, most = (summary[force][name] for name in ("5 %", "95 %"))
            inside = sum(least - 5e-4 <= ratio <= most + 5e-4 for ratio in ratios)
            assert inside / len(ratios) == pytest.approx(0.9, abs=0.02)


# The rules against the study.


def stated(group):
    return [group[force][name] for force in static_study.FORCES for name in ("5 %", "95 %")]


def test_the_figures_in_use_are_those_of_the_file(outcome):
    found = outcome["conclusions"]
    by_column = found["by the column"]
    assert set(by_column) == set(RATIOS)
    for kind, ratios in RATIOS.items():
        assert np.ravel(ratios) == pytest.approx(stated(by_column[kind]), abs=0.0051)
    below = found[static_study.BELOW_BY_RATIO]
    assert np.ravel(static_forces.RATIOS_BELOW) == pytest.approx(stated(below), abs=0.0051)


def test_where_the_rules_are_silent_static_forces_are_seldom_too_low(outcome):
    found = outcome["conclusions"]
    quick, slow = (found["by the column"][kind] for kind in (QUICK, SLOW))
    above, below = (found["by the collision"][kind] for kind in (ABOVE, BELOW))
    assert quick["cases"] + slow["cases"] == above["cases"] + below["cases"]
    assert quick["shear"]["5 %"] > 0.9
    assert quick["moment"]["5 %"] > 0.95
    for group in (above, found[static_study.UNDER_THE_LARGER]):
        assert group["shear"]["5 %"] > 0.95
        assert group["moment"]["5 %"] > 0.97
    # Most that is too low is caught, and by the collision with few false alarms.
    by_column, by_collision = (found[static_study.WARNINGS][name] for name in static_study.RULES)
    assert by_column["shear"]["caught"] > 0.75
    assert by_collision["shear"]["caught"] > 0.8
    assert by_collision["shear"]["false"] < 0.1 < 0.6 < by_column["shear"]["false"]
    assert by_collision["warned"] < 0.5 * by_column["warned"]


def test_the_rules_go_by_the_quantities_that_tell_most(outcome):
    found = outcome["conclusions"][static_study.TELLING]
    for force in static_study.FORCES:
        of_column = {name: found[name][force] for name in ("mass", "shape", "frequency", "height")}
        assert max(of_column, key=of_column.get) == "frequency"
        assert max(found, key=lambda name: found[name][force]) == "reaction"


# The rule by the column.


def by_hand(struck):
    """Return whether static forces hold by the rule."""
    frequency = math.sqrt(struck.stiffness / struck.mass) / (2.0 * math.pi)
    rests_on_top = struck.column.top == "fixed" and struck.column.base in ("pinned", "free")
    return frequency >= LOWEST_FREQUENCY and not rests_on_top


@GENERATED
@given(struck_columns())
def test_equivalent_warns_by_the_rule_and_nothing_else_does(generated):
    column, impact_height = generated
    struck = column.struck_at(impact_height)
    assert struck.static_forces.hold == by_hand(struck)
    assert (struck.static_forces.sentence == "") == struck.static_forces.hold
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always")
        pier = column.equivalent(impact_height)
    assert pier == struck.equivalent()
    assert [str(warning.message) for warning in raised] == (
        [] if by_hand(struck) else [f"{struck.static_forces.sentence} PierColumn.beam gives it."]
    )
    assert all(warning.category is StaticForcesWarning for warning in raised)
    assert all(warning.filename == __file__ for warning in raised)  # where the user called it


def test_the_sentence_says_what_is_off_by_how_much_and_what_to_do():
    slow, top = StaticForces("fixed", "free", 17.6), StaticForces("pinned", "fixed", 90.0)
    assert slow.sentence == (
        "Shear and moment under the reaction as a static force may be too low: at 17.6 Hz, below "
        "55 Hz, the pier may be too slow to follow the blow of the engine in its static shape; in "
        "nine of ten such cases studied, the static shear was 0.41 to 1.56 times and the static "
        "moment 0.52 to 1.61 times that of the column as a beam, from which both should be taken."
    )
    assert "only the top of the column" in top.sentence
    assert (slow.kind, top.kind) == (SLOW, TOP)


def test_bad_input_is_refused_before_any_warning():
    slow = round_column(9.0, 1.5, "fixed", "free", modulus=15e9)
    for arguments in ((9.1,), (0.0,), (1.2, 1.5)):
        with pytest.raises(InputError):
            slow.equivalent(*arguments)
    with pytest.warns(StaticForcesWarning, match="may be too low"):
        slow.equivalent(1.2)


def test_nothing_inside_warns():
    slow = round_column(9.0, 1.5, "fixed", "free")
    pier = slow.struck_at(1.2).equivalent()
    assert slow.beam(1.2).equivalent == pier
    sensitivity(TRUCK, slow, pier, 1.2, 20.0)
    assert Scenario(column_height=9.0, top="free").pier.frequency < LOWEST_FREQUENCY


# The rule by the collision.

forces = st.floats(1e3, 1e8)


@GENERATED
@given(st.sampled_from(static_study.ENDS), st.floats(1.0, 500.0), forces, forces)
def test_a_collision_is_judged_by_its_reaction(ends, frequency, reaction, contact_force):
    column = StaticForces(*ends, frequency)
    found = StaticForcesInCollision(column, reaction, contact_force)
    if column.kind == TOP:
        assert (found.hold, found.sentence) == (False, column.sentence)
        return
    assert found.hold == (reaction / contact_force >= AS_LARGE)
    assert (found.sentence == "") == found.hold
    if found.kind == BELOW:
        share = reaction / contact_force
        (least, most), (low, high) = static_forces.RATIOS_BELOW
        assert f"only {share:.2f} times the largest contact force" in found.sentence
        assert f"shear was {share * least:.2f} to {share * most:.2f} times" in found.sentence
        assert f"moment {share * low:.2f} to {share * high:.2f} times" in found.sentence


def test_the_columns_of_the_map_are_judged_as_they_should():
    """The five columns that are marked by default; the truth is their beam."""
    for struck in maps.EXAMPLES.values():
        found = static_study.compare(struck)
        column = struck.column.struck_at(struck.impact_height).static_forces
        hold = StaticForcesInCollision(column, found.reaction, 1.0).hold
        assert hold == (min(found.shear, found.moment) >= static_study.TOO_LOW)


CANTILEVER = {
    "project": "p", "element": "e", "job_number": "1", "revision": "A", "prepared_by": "a",
    "checked_by": "b", "date": "2026-01-01", "column_shape": "circular", "column_diameter": "1.5 m",
    "column_height": "9 m", "elastic_modulus": "28 GPa", "poisson_ratio": 0.2,
    "density": "2450 kg/m^3", "base": "fixed", "top": "free", "truck": "single-unit-8t",
    "speed": "62 km/h", "impact_height": "1.2 m", "damping_ratio": 0.05, "units": "SI",
    "member_forces": "static",
}  # fmt: skip


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, "times the largest contact force"),
        ({"base": "pinned", "top": "fixed"}, "only the top of the column"),
        ({"speed": "80 km/h", "column_height": "5 m", "top": "pinned"}, None),
    ],
    ids=["tall cantilever", "held at the top", "propped"],
)
def test_the_sheet_warns_of_a_tall_cantilever(changes, words):
    calculation = calculate(case_from(CANTILEVER | changes))
    expected = calculation.static_forces.sentence
    given = [sentence for sentence in warnings_of(calculation) if "static force" in sentence]
    assert given == ([expected] if words else [])
    assert words is None or words in expected
    # By the beam there is nothing to warn of.
    calculation = calculate(case_from(CANTILEVER | changes | {"member_forces": "larger"}))
    assert expected not in warnings_of(calculation)


def test_the_sheet_of_the_example_does_not_warn():
    calculation = calculate(read_case_file(shipped("notebooks") / "tti-column.yaml").case)
    assert calculation.static_forces.hold
    assert not [words for words in warnings_of(calculation) if "static force" in words]


# Map and table.


def test_the_map_shows_every_column_and_those_marked(outcome, columns):
    marks = {"mine": static_study.Found(0, 0.8, 0.9, 1.0, 1.0, 40.0, 0.2, 1.0, 0.85, 0)}
    figure = map_figure(columns, marks)
    found = outcome["conclusions"]
    kinds = ((SLOW, QUICK), (BELOW, ABOVE))
    for number, axes in enumerate(figure.axes):
        quantity, force = ("frequency", "reaction")[number // 2], static_study.FORCES[number % 2]
        dots = [line for line in axes.lines if len(line.get_xdata()) > 10]
        assert len(dots) == len(static_study.ENDS)
        drawn = np.concatenate([np.transpose(line.get_data()) for line in dots])
        expected = np.transpose([columns[quantity], columns[force]])
        assert sorted(map(tuple, drawn)) == sorted(map(tuple, expected))
        assert len({to_hex(line.get_color()) for line in dots}) == len(static_study.ENDS)
        (low, high), (least, most) = axes.get_xlim(), axes.get_ylim()
        inside = (drawn > (low, least)) & (drawn < (high, most))
        assert inside.all(axis=1).mean() > 0.99
        (mark,) = [line for line in axes.lines if line.get_marker() == "D"]
        assert mark.get_xydata().tolist() == [
            [getattr(marks["mine"], quantity), getattr(marks["mine"], force)]
        ]
        groups = found[static_study.RULES[number // 2]]
        shares = [groups[kind][force]["too low"] for kind in kinds[number // 2]]
        words = [text.get_text() for text in axes.texts]
        assert words == [*(f"{share:.0%} too low" for share in shares), "mine"]


def test_the_map_says_what_it_marks():
    page = maps.static_forces({"<my> column": maps.EXAMPLES["E"]})
    assert page.data.count("data:image/png;base64,") == 1
    assert "&lt;my&gt; column: shear 0.61, moment 0.8" in page.data
    assert "<my>" not in page.data


def test_the_table_is_that_of_the_study(outcome):
    _, *rows = re.findall(r"<tr.*?</tr>", table_of_rules().data)
    shown = [re.findall(r">([^<]+)</td>", row) for row in rows]
    found = outcome["conclusions"]
    for group in [
        *found["by the column"].values(),
        *found["by the collision"].values(),
        found[static_study.UNDER_THE_LARGER],
    ]:
        cells = [str(group["cases"])]
        for force in static_study.FORCES:
            cells += [f"{group[force][name]:.2f}" for name in ("5 %", "50 %", "95 %")]
            cells += [f"{group[force]['too low']:.0%}"]
        assert cells in shown
