"""The charts that the browser calculates for explorers are of the package's values."""

import math
import re

import numpy as np
import pytest
from in_node import contents_of, in_node
from one_at_a_time import one_at_a_time

from pierimpact import design_reaction, widgets
from pierimpact.design import domain
from pierimpact.design.codes import code_forces
from pierimpact.design.procedure import LEVELS, amplification, by_symbol, design_values
from pierimpact.design.reduction import exact_amplification
from pierimpact.pier.unit_force import BY_ENDS
from pierimpact.teaching.scenario import EXAMPLE, Scenario
from pierimpact.teaching.variables import VARIABLES
from pierimpact.vehicle.spread import Uniform

CHARTS = ("pier", "reduction", "design", "sensitivity", "risk")
KMH = 1.0 / 3.6


def drawn(curve):
    return np.array(curve["x"], dtype=float), np.array(curve["y"], dtype=float)


def inside(values, axis):
    return axis["low"] - 1e-9 <= min(values) and max(values) <= axis["high"]


def anywhere(explorer, count, seed):
    """Return random values on the sliders of an explorer."""
    random = np.random.default_rng(seed)

    def one(name):
        variable = VARIABLES[name]
        if variable.choices:
            return str(random.choice(variable.choices))
        return float(random.uniform(variable.low, variable.high) * variable.size)

    return [{name: one(name) for name in explorer.controls} for _ in range(count)]


@pytest.mark.parametrize("name", CHARTS)
def test_no_values_of_the_sliders_are_too_much(name):
    explorer = getattr(widgets, name)()
    found = contents_of(explorer, *anywhere(explorer, 40, 3))  # all of it finite
    assert all(each.get("refusal") or (each["charts"] and each["words"]) for each in found)
    assert sum("charts" in each for each in found) > 10
    for each in found:
        for chart in each.get("charts", ()):
            if here := chart.get("here"):
                assert inside([here["x"]], chart["x"])
                assert inside([here["y"]], chart["y"])


def test_a_mechanism_is_refused_in_a_sentence():
    (found,) = contents_of(widgets.pier(), {"base": "pinned", "top": "free"})
    assert "mechanism" in found["refusal"]


@pytest.mark.parametrize(("base", "top"), BY_ENDS)
def test_shape_stiffness_and_mass_are_the_columns(base, top):
    values = {"base": base, "top": top, "column_height": 5.3, "impact_height": 1.31}
    (found,) = contents_of(widgets.pier(), values)
    scenario = Scenario(**values)
    struck, (shape, *others) = scenario.struck_column, found["charts"]
    square, _, line = shape["curves"]
    phi, z = drawn(line)
    np.testing.assert_allclose(phi, struck.shape(z), atol=1e-9)
    np.testing.assert_allclose(drawn(square)[0], phi**2, atol=1e-12)
    assert inside([*phi, *phi**2], shape["x"])
    assert shape["level"]["y"] == 1.31
    for chart, name, size in zip(others, ("stiffness", "mass"), (1e6, 1e3), strict=True):
        heights, along = drawn(chart["curves"][0])
        for height, value in zip(heights[::9], along[::9], strict=True):
            other = scenario.column.struck_at(float(height))
            assert value == pytest.approx(getattr(other, name) / size, rel=1e-6)
        assert chart["here"]["y"] == pytest.approx(getattr(struck, name) / size)
    whole = scenario.column.mass_per_length * 5.3
    shear = struck.values["xs"] / struck.values["xn"]
    assert f"as if {100.0 * struck.mass / whole:.0f} %" in found["words"]
    assert f"Shear accounts for {100.0 * shear:.0f} %" in found["words"]


def test_the_exact_amplification_is_the_packages():
    random = np.random.default_rng(8)
    beta, mu = np.exp(random.uniform(np.log([0.02, 0.01]), np.log([60.0, 5.0]), (250, 2))).T
    e, zeta = random.uniform((0.1, 0.0), (1.0, 0.3), (250, 2)).T
    cases = np.transpose((beta, mu, e, zeta))
    found = in_node("cases.map((each) => exactAmplification(...each))", cases.tolist())
    np.testing.assert_allclose(found, exact_amplification(beta, mu, e, zeta), rtol=1e-5)


def test_its_line_is_right_between_its_points_and_its_limits_are_met():
    explorer = widgets.reduction()
    cases = anywhere(explorer, 12, 5)
    for values, found in zip(cases, contents_of(explorer, *cases), strict=True):
        scenario = Scenario(**values)
        given = design_values(scenario.history.collision.parameters, "short")
        for number, (chart, row) in enumerate(
            zip(found["charts"], found["table"]["rows"], strict=True), 1
        ):
            mu, e = given[f"mu{number}"], given[f"e{number}"]
            impulse, static, closed, exact = map(drawn, chart["curves"])
            ratio = np.geomspace(0.0201, 49.9, 400)
            line = np.interp(np.log(ratio), np.log(exact[0]), exact[1])
            model = exact_amplification(ratio, mu, e, scenario.damping_ratio)
            np.testing.assert_allclose(line, model, rtol=5e-3)
            of_body = (closed[0], mu, e, scenario.damping_ratio)
            np.testing.assert_allclose(closed[1], amplification(*of_body), rtol=1e-9)
            np.testing.assert_allclose(impulse[1], (1.0 + e) * impulse[0] / (1.0 + mu))
            np.testing.assert_allclose(static[1], 1.0 / np.sqrt(1.0 + mu / static[0] ** 2))
            beta = given[f"beta{number}"]
            assert chart["here"]["x"] == pytest.approx(beta)
            here = exact_amplification(beta, mu, e, scenario.damping_ratio)
            assert chart["here"]["y"] == pytest.approx(float(here), rel=1e-5)
            assert row[2:6] == [f"{value:.3f}" for value in (beta, mu, e, chart["here"]["y"])]


def test_the_table_has_the_reduction_beside_the_full_model():
    (found,) = contents_of(widgets.reduction(), {})
    parameters = EXAMPLE.history.collision.parameters
    values = design_values(
        parameters, "short", lambda b, m, e, z: float(exact_amplification(b, m, e, z))
    )
    for number, (row, peak) in enumerate(
        zip(found["table"]["rows"], EXAMPLE.history.peaks.values(), strict=True), 1
    ):
        assert row[1] == f"{values[f'v{number}']:.2f} m/s"
        assert row[6:] == [f"{values[f'R{number}'] / 1e6:.2f} MN", f"{peak.reaction / 1e6:.2f} MN"]
        assert (
            f"{values[f'R{number}'] / peak.reaction:.2f} times the full model’s" in found["words"]
        )


@pytest.mark.parametrize("level", LEVELS)
def test_the_procedure_in_the_browser_is_the_packages(level):
    parameters = domain.sample(300, 4)
    given = {name: np.asarray(value) for name, value in by_symbol(parameters).items()}
    cases = [{name: value[number].item() for name, value in given.items()} for number in range(300)]
    program = (
        f"cases.map(procedureModule.{level})"
        ".map(({ R1, R2, v1, v2 }) => [R1, R2 >= 0 ? R2 : null, v1, v2])"
    )
    found = np.array(in_node(program, cases), dtype=float)
    values = design_values(parameters, level)
    expected = np.transpose([values[name] for name in ("R1", "R2", "v1", "v2")])
    assert np.isnan(expected).any()
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-6)


def test_bars_are_as_long_as_their_forces():
    explorer, cases = widgets.design(), [{}, {"speed": 45.0 * KMH}, {"speed": 126.0 * KMH}]
    cases += anywhere(explorer, 30, 6)
    warned = 0
    for values, found in zip(cases, contents_of(explorer, *cases), strict=True):
        if "refusal" in found:
            continue
        scenario = Scenario(**values)
        (chart,) = found["charts"]
        rows = iter(chart["rows"])
        peaks = scenario.history.peaks.values()
        reactions = [
            design_reaction(scenario.truck, scenario.pier, scenario.speed, level)
            for level in LEVELS
        ]
        forces = [None if peak is None else peak.reaction for peak in peaks]
        forces += [each.reaction for each in reactions]
        codes = code_forces(scenario.speed, scenario.truck.mass)
        for force in [*forces, *(code.along.value for code in codes)]:
            row = next(rows)
            ((bar,),) = [row["bars"]]
            if force is None:
                assert (bar["value"], row["words"]) == (None, "none")
            else:
                assert bar["value"] == pytest.approx(force / 1e6, rel=1e-5)
                assert row["words"].startswith(f"{bar['value']:.2f} MN")
                assert bar["value"] <= chart["x"]["high"]
        names = [row["name"] for row in chart["rows"][4:]]
        assert names == [code.code for code in codes]
        remarks = [row["words"].partition(": ")[2] for row in chart["rows"][4:]]
        assert remarks == [code.along.remark for code in codes]
        long = reactions[-1]
        values = long.values
        what = f"The {long.governs}"
        if long.governs == "engine" and not (values["v1"] > 0.0 and long.engine > values["R0"]):
            what = "Crumpling sheet metal"
        assert f" {what} governs." in found["words"]
        ratio = long.reaction / scenario.history.governing_peak.reaction
        assert f"{ratio:.2f} times the full model" in found["words"]
        warnings = [f"{words}." for words in long.warnings]
        assert [plain(words) for words in found["warnings"]] == [plain(words) for words in warnings]
        warned += bool(long.warnings)
    assert warned


def plain(words):
    """Return a warning without the ways of writing its first letter and its number."""
    return re.sub(r"[\d.e+]+(?= \S+ is outside)", lambda n: f"{float(n[0]):.6g}", words.lower())


@pytest.mark.parametrize("speed", [10.0, 40.0, 52.0])
def test_where_the_engine_does_not_arrive_the_reaction_is_sheet_metals(speed):
    slow = {"speed": speed * KMH}
    assert Scenario(**slow).history.engine_contact_time is None
    explorers = widgets.reduction(), widgets.design(), widgets.sensitivity()
    reduced, designed, sensitive = (contents_of(each, slow)[0] for each in explorers)
    assert "There is no engine peak: crumpling sheet metal makes the" in reduced["words"]
    assert "There is no cargo peak." in reduced["words"]
    assert [row[6:] for row in reduced["table"]["rows"]] == [["none", "none"]] * 2
    assert "Crumpling sheet metal governs." in designed["words"]
    assert designed["charts"][0]["rows"][0]["name"] == "Full model, sheet metal"
    assert designed["facts"][1][0] == "Design, sheet metal"
    assert "The reaction to crumpling sheet metal is most sensitive" in sensitive["words"]
    assert sensitive["charts"][0]["title"] == sensitive["facts"][3][0] == "Sheet metal"
    for found in (designed, sensitive):
        assert "engine peak" not in found["words"]
        assert "engine governs" not in found["words"]


@pytest.mark.parametrize("speed", [45.0, 60.0, 80.0, 117.0])
def test_influences_are_the_packages(speed):
    (found,) = contents_of(widgets.sensitivity(), {"speed": speed * KMH})
    scenario = Scenario(speed=speed * KMH)
    springs = ("plateau_force", "plateau_length", "stiffness", "unloading_stiffness")
    names = [f"{body}_spring.{name}" for body in ("engine", "body") for name in springs]
    names += ["engine_mass", "body_mass", "friction_force"]
    changed = one_at_a_time(scenario.history.collision, dict.fromkeys(names, Uniform.about(0.3)))
    for chart, (body, peak) in zip(found["charts"], scenario.history.peaks.items(), strict=True):
        assert bool(chart["empty"]) == (peak is None)
        if peak is None:
            assert f"The {body} does not reach the pier" in found["words"]
            continue
        expected = 100.0 * (getattr(changed, body) / peak.reaction - 1.0)
        bars = [[bar["value"] for bar in row["bars"]] for row in chart["rows"]]
        np.testing.assert_allclose(np.array(bars, dtype=float), expected, atol=2e-3)
        most = np.nan_to_num(np.abs(expected), nan=math.inf).max(axis=1)
        name = chart["rows"][int(most.argmax())]["name"].split(": ")[-1]
        assert name in found["words"]
        vanishing = [
            row["name"].split(": ")[-1]
            for row, change in zip(chart["rows"], most, strict=True)
            if math.isinf(change)
        ]
        assert all(each in found["words"] for each in vanishing)
        assert inside(expected[np.isfinite(expected)], chart["x"])
        for row, pair in zip(chart["rows"], expected, strict=True):
            gone = [side for side, value in zip("−+", pair, strict=True) if np.isnan(value)]
            assert row["words"] == ", ".join(f"{side}30 %: no peak" for side in gone)
