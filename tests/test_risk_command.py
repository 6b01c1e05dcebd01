"""`pierimpact risk`: keys, distributions and samples of a case, its results, page and curve."""

import csv
import io
import json
import math
import re
from contextlib import contextmanager, nullcontext
from unittest.mock import patch

import numpy as np
import pytest
from dask_cluster import dask_cluster
from figure_collisions import collisions
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from test_casefile import CASE

from pierimpact import cli
from pierimpact.checks import InputError
from pierimpact.collision.groups import single
from pierimpact.collision.reactions import full_model
from pierimpact.collision.simulate import simulate
from pierimpact.design.band import truck_of
from pierimpact.files.case import case_from
from pierimpact.files.distributions import parse_distribution
from pierimpact.files.weigh_in_motion import read_weigh_in_motion
from pierimpact.network.workers import LostWorkersError
from pierimpact.plots.risk import draw_exceedance, reactions
from pierimpact.report.risk import RATES, case_risk, risk_json, risk_text
from pierimpact.report.risk_page import risk_blocks, risk_csv
from pierimpact.risk.traffic import ANGLES, YEAR, jcss_mass

TRAFFIC = {
    "traffic_volume": "20000 vehicles/day",
    "truck_share": 0.15,
    "distance_from_road": "6 m",
    "shear_resistance": "6 MN",
}
CASE = {key: value for key, value in CASE.items() if not key.endswith("_resistance")} | TRAFFIC


@pytest.fixture(scope="module")
def result():
    return case_risk(case_from(CASE), 400, 3)


def written(folder, values):
    path = folder / "pier.yaml"
    path.write_text("".join(f"{key}: {value}\n" for key, value in values.items()), "utf-8")
    return path


def test_on_a_cluster_of_which_a_worker_is_killed_it_comes_to_the_same(
    tmp_path, capsys, monkeypatch
):
    pytest.importorskip("distributed")
    command = ["risk", str(written(tmp_path, CASE)), "--samples", "20000", "--json"]
    assert cli.main([*command, "--workers", "1"]) == 0
    alone = capsys.readouterr().out
    with dask_cluster(tmp_path, 2) as (address, processes):
        monkeypatch.setattr(
            "pierimpact.cli.risk.progress_bar",
            lambda unit, total: nullcontext(lambda count: processes[0].kill()),
        )
        assert cli.main([*command, "--scheduler", address]) == 0
        assert processes[0].poll() is not None
    said = capsys.readouterr()
    assert said.out == alone
    assert "Dask dashboard: http" in said.err


def test_lost_workers_are_one_line(tmp_path, capsys, monkeypatch):
    @contextmanager
    def lost(**options):
        def run(function, tasks):
            raise LostWorkersError("the scheduler is gone")

        yield run

    monkeypatch.setattr("pierimpact.network.workers.worker_pool", lost)
    command = ["risk", str(written(tmp_path, CASE)), "--workers", "2", "--output", str(tmp_path)]
    assert cli.main(command) == 1
    said = capsys.readouterr()
    assert said.err.strip() == "pierimpact: the scheduler is gone; nothing is written"
    assert [path.name for path in tmp_path.iterdir()] == ["pier.yaml"]


LAWS = {
    "lognorm(s=0.5, scale=18 t)": stats.lognorm(0.5, scale=18e3),
    "weibull_min(c=2.1, scale=40000 lb, loc=3 t)": stats.weibull_min(
        2.1, scale=40000 * 0.45359237, loc=3e3
    ),
    "gamma( a = 3,scale=6 t )": stats.gamma(3.0, scale=6e3),
    "uniform(loc=4 t, scale=30 t)": stats.uniform(4e3, 30e3),
    "beta(a=2, b=5, loc=3.5 t, scale=60 t)": stats.beta(2.0, 5.0, 3.5e3, 60e3),
}


@given(st.sampled_from(sorted(LAWS)), st.floats(1e-4, 0.9999))
def test_a_distribution_is_that_of_scipy(text, share):
    law = parse_distribution("traffic_mass", text, "mass")
    assert law.exceeded_by(np.array([share]))[0] == pytest.approx(LAWS[text].isf(share))
    assert law.words == text.strip()


@given(st.floats(5.0, 40.0), st.floats(0.5, 10.0), st.sampled_from(["normal", "lognormal"]))
def test_a_law_by_its_mean_has_it(mean, deviation, law):
    text = f"{law}(mean={mean} t, sd={deviation} t) from 0 t"
    found = parse_distribution("traffic_mass", text, "mass").law
    ratio = deviation / mean
    if law == "normal":
        same = stats.norm(mean, deviation)
    else:
        sigma = math.sqrt(math.log(1.0 + ratio**2))
        same = stats.lognorm(s=sigma, scale=mean / math.sqrt(1.0 + ratio**2))
        assert (same.mean(), same.std()) == pytest.approx((mean, deviation))
    shares = np.linspace(0.01, 0.99, 50)
    np.testing.assert_allclose(found.isf(shares), 1e3 * same.isf(shares), rtol=1e-9)


def test_a_law_is_truncated_where_it_says():
    law = parse_distribution(
        "traffic_mass", "norm(loc=20 t, scale=12 t) from 3.5 t to 44 t", "mass"
    )
    values = law.exceeded_by(np.linspace(1e-9, 1.0, 999))
    assert (values.max(), values.min()) == pytest.approx((44e3, 3.5e3))
    open_above = parse_distribution("traffic_mass", "norm(loc=20 t, scale=12 t) from 3.5 t", "mass")
    assert open_above.mean == pytest.approx(jcss_mass().mean)
    below = parse_distribution("traffic_mass", "norm(loc=20 t, scale=2 t) to 21 t", "mass")
    assert (below.low, below.high) == (0.0, 21e3)


BAD = {
    "norm(loc=20 t, scale=12 t)": "gives negative values (4.8 % of all): say where it is truncated",
    "normal(mean=20 t, sd=12 t) to 50 t": "gives negative values",
    "norm": "must be a distribution, such as lognorm(s=0.5, scale=18 t)",
    "nrom(loc=20 t, scale=1 t)": "'nrom' is no continuous distribution of scipy.stats; did you",
    "poisson(mu=3, scale=1 t)": "'poisson' is no continuous distribution",
    "lognorm(scale=18 t)": "lognorm needs s, scale, and s is missing",
    "lognorm(s=0.5, scale=18)": "scale must have a unit",
    "lognorm(s=0.5, scale=18 km/h)": "scale must be a mass",
    "lognorm(s=half, scale=18 t)": "s must be a number, got 'half'",
    "lognorm(s=-1, scale=18 t)": "has parameters that lognorm does not take",
    "cauchy(loc=18 t, scale=3 t) from 3.5 t to 60 t": "must have a mean, which cauchy has not",
    "lognormal(mean=18 t, sd=1e-200 t)": "sd must not vanish beside mean",
    "lognormal(mean=1e-200 t, sd=1e200 t)": "gives impossible values",
    "lognorm(s=1, skale=18 t, scale=1 t)": "'skale' is no parameter of lognorm; did you mean",
    "lognorm(0.5, scale=18 t)": "must name its parameters",
    "lognorm(s=1, s=2, scale=1 t)": "s is given twice",
    "lognorm(s=1, scale=-1 t)": "scale must be positive",
    "normal(mean=20 t)": "normal needs mean, sd, and sd is missing",
    "lognorm(s=0.5, scale=18 t) from 9 t to 8 t": "must be truncated from a lower to a higher",
    "uniform(loc=4 t, scale=1 t) from 7 t": "has no values between its bounds",
}


@pytest.mark.parametrize("text", BAD)
def test_a_bad_distribution_is_one_line_that_says_why(text):
    with pytest.raises(InputError) as caught:
        case_from(CASE | {"traffic_mass": text})
    message = str(caught.value)
    assert message.startswith("traffic_mass")
    assert BAD[text] in message
    assert "\n" not in message


@given(st.text(alphabet="norm lg(=),.0123456789tfro%μ", max_size=40))
def test_any_text_is_a_distribution_or_a_line(text):
    message = ""
    try:
        parse_distribution("traffic_mass", text, "mass")
    except InputError as error:
        message = str(error)
    assert "\n" not in message


def test_angles_stay_below_a_right_angle():
    with pytest.raises(InputError, match="impossible values"):
        parse_distribution("traffic_angle", "uniform(loc=0 deg, scale=100 deg)", "angle", ANGLES)
    law = parse_distribution("traffic_angle", "rayleigh(scale=8 deg)", "angle", ANGLES)
    assert law.mean == pytest.approx(math.radians(8.0) * math.sqrt(math.pi / 2.0))


def test_weighed_trucks_are_read_in_their_units(tmp_path):
    path = tmp_path / "trucks.csv"
    path.write_text("# station 7\nspeed [mph]; mass [lb]\n50; 40000\n60;20000\n", "utf-8")
    sample = read_weigh_in_motion(path)
    assert sample.mass == pytest.approx(np.array([40000.0, 20000.0]) * 0.45359237)
    assert sample.speed == pytest.approx(np.array([50.0, 60.0]) * 1609.344 / 3600.0)
    path.write_text("mass [t]\n12\n8.5\n", "utf-8")
    assert read_weigh_in_motion(path).speed is None


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "must have a heading"),
        ("mass\n3\n", "row 1: the heading must name mass"),
        ("mas [t]\n3\n", "did you mean mass?"),
        ("mass [km]\n3\n", "row 1: mass must be a mass"),
        ("speed [km/h]\n3\n", "row 1: there must be a column of masses"),
        ("mass [t], mass [t]\n3,3\n", "row 1: mass is given twice"),
        ("mass [t]\n", "must have a row for each truck"),
        ("mass [t]\n3\n-4\n", "row 3: mass must be positive, got '-4'"),
        ("mass [t]\n3\nheavy\n", "row 3: mass must be a number"),
        ("mass [t], speed [km/h]\n3\n", "row 2: must have 2 columns, got 1"),
    ],
)
def test_a_bad_sample_is_one_line_with_its_row(tmp_path, text, words):
    path = tmp_path / "trucks.csv"
    path.write_text(text, "utf-8")
    with pytest.raises(InputError) as caught:
        case_from(CASE | {"weigh_in_motion": "trucks.csv"}, tmp_path)
    assert str(caught.value).startswith("trucks.csv: ")
    assert words in str(caught.value)


def test_keys_that_contradict_each_other_are_refused(tmp_path):
    (tmp_path / "trucks.csv").write_text("mass [t], speed [km/h]\n12, 70\n", "utf-8")
    sample = CASE | {"weigh_in_motion": "trucks.csv"}
    for key, value in (("traffic_mass", "gamma(a=3, scale=6 t)"), ("traffic_speed", "urban")):
        with pytest.raises(InputError, match=key):
            case_from(sample | {key: value}, tmp_path)
    traffic = case_from(sample, tmp_path).traffic.traffic
    assert traffic.mass.mass.tolist() == [12e3]


def test_the_values_of_a_case_are_those_of_its_traffic():
    case = case_from(CASE | {"exposed_width": "3.4 m", "encroachment_rate": "2e-7 1/vehicle/km"})
    traffic = case.traffic.traffic
    assert traffic.trucks * 86400.0 == pytest.approx(3000.0)
    assert (traffic.distance, traffic.width) == (6.0, 3.4)
    assert traffic.encroachment_rate == pytest.approx(2e-10)
    assert YEAR * traffic.departures == pytest.approx(
        3000 * 365 * 2e-10 * 3.4 / math.sin(math.radians(10.0)), rel=1e-6
    )
    assert [file.truck.name for file in case.traffic.truck_files] == [
        "single-unit-8t", "tractor-trailer-36t",
    ]  # fmt: skip
    one = case_from(CASE | {"traffic_trucks": ["tractor-trailer-36t"]})
    assert [file.truck.name for file in one.traffic.truck_files] == ["tractor-trailer-36t"]
    fewer = {key: value for key, value in CASE.items() if key != "truck_share"}
    assert case_from(fewer).traffic is None
    with pytest.raises(InputError, match="truck_share is missing: a risk needs traffic_volume"):
        case_risk(case_from(fewer))


def test_all_that_is_said_is_of_the_same_curve(result):
    found = result.risk.reaction
    (check,) = result.checks
    shear = result.effects["shear"].rate(6e6)
    assert check.rate == tuple(YEAR * part for part in shear)
    assert float(found.rate(check.reaction * 0.9999).value) >= float(shear.value)
    data = json.loads(risk_json("pier.yaml", result))
    assert data["hits"][0] == pytest.approx(YEAR * float(found.total.value))
    assert data["annual_hit_probability"] == pytest.approx(-math.expm1(-data["hits"][0]))
    exceeded = data["checks"]["shear"]["exceeded"]
    assert exceeded == pytest.approx([YEAR * float(x) for x in shear])
    assert data["impact_heights"] == result.heights == [1.2]
    assert data["checks"]["shear"]["return_period"] == pytest.approx(1.0 / exceeded[0])
    for rate in RATES:
        assert data["reactions"][f"{rate:g}"][0] == pytest.approx(
            float(found.value(rate / YEAR).value)
        )
    text = risk_text("pier.yaml", result)
    assert "The shear resistance is exceeded" in text
    assert "read in a public copy" in text
    assert max(map(len, text.splitlines())) <= 100


def test_collisions_drawn_once_more_are_the_same(result):
    strikes = result.risk.strikes
    there, again = result.risk.followed_again(50)
    np.testing.assert_array_equal(again.speed, strikes.speed[there])
    np.testing.assert_allclose(again.engine.mass + again.body.mass, strikes.mass[there])
    np.testing.assert_array_equal(full_model(again).governing, strikes.reaction[there])
    assert len(result.risk.followed_again(10**6)[0]) == (strikes.weight > 0.0).sum()


def test_shear_and_moment_are_the_larger_of_both_methods_in_each_collision(result):
    """As `simulate` and the static forces have them, one collision after the other."""
    there, trucks = result.risk.followed_again(400)
    impact = result.calculation.governing
    for place in np.argsort(-trucks.speed)[[0, 50, 100, 200]].tolist():
        draw = there[place]
        truck = truck_of(single(trucks, place), result.risk.trucks[result.risk.strikes.truck[draw]])
        forces = simulate(truck, impact.beam, float(trucks.speed[place])).member_forces
        static = impact.struck.member_forces(float(result.risk.strikes.reaction[draw]))
        for name in ("shear", "moment"):
            own = abs(getattr(forces, f"{name}_extremes").governing.value)
            assert result.as_beam[name][draw] == pytest.approx(own, rel=0.03)
            assert result.static[name][draw] == pytest.approx(
                abs(getattr(static, f"largest_{name}").value)
            )
            larger = max(result.as_beam[name][draw], result.static[name][draw])
            assert larger in result.effects[name].values
    for least, middle, most in result.beam.values():
        assert 0.3 < least <= middle <= most < 3.0


def test_each_part_of_a_column_is_held_against_what_it_resists():
    step = {"height": "2.4 m", "column_shape": "circular", "column_diameter": "0.7 m"}
    own = {"shear_resistance": "1.5 MN", "moment_resistance": "2 MN*m"}
    values = CASE | {"moment_resistance": "5 MN*m", "steps": [step | own]}
    result = case_risk(case_from(values), 300, 3)
    parts, impact = result.case.parts, result.calculation.governing
    there, trucks = result.risk.followed_again(300)
    for place in np.argsort(-trucks.speed)[[0, 40, 120]].tolist():
        draw = there[place]
        truck = truck_of(single(trucks, place), result.risk.trucks[result.risk.strikes.truck[draw]])
        forces = simulate(truck, impact.beam, float(trucks.speed[place])).member_forces
        static = impact.struck.member_forces(float(result.risk.strikes.reaction[draw]))
        for name in ("shear", "moment"):
            by_beam, by_static = zip(
                *(
                    (
                        abs(getattr(there, f"{name}_extremes").governing.value) / limit,
                        getattr(static, f"{name}_within")(part.low, part.high) / limit,
                    )
                    for part in parts
                    for there in [forces.between(part.low, part.high)]
                    for limit in [part.resistances[name]]
                ),
                strict=True,
            )
            used = result.against[name].values / parts[0].resistances[name]
            largest = max(*by_beam, *by_static)
            assert np.min(np.abs(used / largest - 1.0)) < 0.03
    assert "Shear resistance of a part" in risk_text("pier.yaml", result)
    plain = case_risk(case_from(values | {"steps": [step]}), 300, 3)
    for check, of_one in zip(result.checks, plain.checks, strict=True):
        assert float(check.rate.value) >= float(of_one.rate.value)
    # The forces are those of the same column, whatever it resists.
    assert risk_csv(result) == risk_csv(plain)
    assert result.beam == plain.beam


def test_frequencies_of_shear_and_moment_agree_between_seeds_within_their_bands():
    """Of a slender column, whose shear as a beam differs much from truck to truck."""
    values = CASE | {"column_diameter": "0.762 m", "column_height": "8 m"}
    case = case_from(values | {"shear_resistance": "6 MN", "moment_resistance": "5 MN*m"})
    found = [case_risk(case, 2000, seed).checks for seed in range(4)]
    for checks in zip(*found, strict=True):
        middle = np.mean([check.rate.value for check in checks])
        assert all(check.rate.low <= middle <= check.rate.high for check in checks)
        assert all(check.rate.high < 1.5 * check.rate.low for check in checks)


def test_of_both_heights_of_the_rule_each_truck_counts_with_the_larger_effect():
    values = CASE | {"moment_resistance": "5 MN*m"}
    rates = {}
    for height in ("auto", "1.05 m", "1.35 m"):
        result = case_risk(case_from(values | {"impact_height": height}), 300, 2)
        rates[height] = [float(check.rate.value) for check in result.checks]
    both, *single_heights = rates.values()
    assert np.all(both >= np.max(single_heights, axis=0))
    result = case_risk(case_from(values | {"impact_height": "auto"}), 50, 2)
    assert result.heights == pytest.approx([1.05, 1.35], abs=0.1)
    assert "at nominal heights of" in risk_text("pier.yaml", result)
    assert json.loads(risk_json("pier.yaml", result))["impact_heights"] == result.heights


def test_the_curve_of_the_file_is_the_curve(result):
    head, *rows = csv.reader(io.StringIO(risk_csv(result)))
    assert head[:2] == ["reaction [kN]", "frequency [1/year]"]
    values = np.array([[cell or "nan" for cell in row] for row in rows], dtype=float)
    assert len(values) == 200
    rate = result.risk.reaction.rate(1e3 * values[:, 0])
    np.testing.assert_allclose(values[:, 1], YEAR * rate.value, rtol=0.05, atol=1e-7)
    assert np.all(values[:, 2] <= values[:, 1] * (1 + 1e-4))
    assert np.all(values[:, 1] <= values[:, 3] * (1 + 1e-4))
    total = float(result.hits.value)
    np.testing.assert_allclose(values[:, 4], values[:, 1] / total, rtol=1e-3, atol=1e-9)
    shear = result.effects["shear"]
    rates = result.risk.reaction.rate(reactions(result.risk, 200)).value
    for rate, own in zip(rates, values[:, 6], strict=True):
        assert (rate == 0.0) == math.isnan(own)
        if rate > 0.0:
            assert own == pytest.approx(1e-3 * float(shear.value(float(rate)).value), rel=1e-4)


def test_the_page_has_figures_and_says_what_is_default(result):
    blocks = {type(block).__name__: block for block in risk_blocks("pier", result)}
    figures = [b for b in risk_blocks("pier", result) if type(b).__name__ == "Figure"]
    assert [figure.label for figure in figures] == ["fig-exceedance", "fig-feared"]
    assert all(figure.svg.startswith("<?xml") and figure.alt for figure in figures)
    assert any("quite conservative" in text for text in blocks["Notice"].body)


def test_powers_of_ten_of_the_page_stay_in_a_line(result):
    (words,) = (
        block.body
        for block in risk_blocks("pier", result)
        if type(block).__name__ == "Paragraph" and "strikes the pier" in str(block.body)
    )
    assert "×\u206010\u2060⁻" in words
    assert "×10" not in words


@pytest.mark.parametrize("gap", [0.0, 0.01, 0.2])
def test_the_figures_of_a_risk_are_clear(result, gap):
    marks = {
        f"{name} resistance": 5e6 * (1.0 + gap * place)
        for place, name in enumerate(("shear", "moment", "design"))
    }
    with patch.dict(draw_exceedance.__globals__, to_svg=lambda figure: figure):
        figure = draw_exceedance(result.risk, marks, {"TxDOT 0.001": 1e-3}, "SI")
    assert not [line for line in collisions(figure) if "resistance' on '" in line]


def test_the_command_writes_both_files_or_none(tmp_path, capsys):
    path = written(tmp_path, CASE | {"traffic_speed": "urban"})
    out = tmp_path / "out"
    arguments = ["risk", str(path), "--samples", "1000", "--output", str(out)]
    assert cli.main(arguments) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert "JCSS, urban: lognormal, 40 ± 7" in printed.out
    assert sorted(file.name for file in out.iterdir()) == [
        ".pierimpact.json", "pier-risk.csv", "pier-risk.html"
    ]  # fmt: skip
    page = (out / "pier-risk.html").read_text("utf-8")
    assert "<script" not in page
    sources = re.findall(r'(?:src|srcset)="([^"]*)"', page)
    assert all(source.startswith("data:image/") for source in sources)
    assert "1,000 trucks drawn with seed 0" in printed.out
    (out / "pier-risk.csv").write_text("mine")
    assert cli.main(arguments) == 2
    assert (
        "pier-risk.csv was not written by pierimpact, or changed since" in capsys.readouterr().err
    )
    assert (out / "pier-risk.csv").read_text() == "mine"
    assert cli.main([*arguments, "--force"]) == 0
    assert cli.main(arguments) == 0
    taken = tmp_path / "file"
    taken.write_text("mine")
    assert cli.main([*arguments[:-1], str(taken)]) == 2
    assert taken.read_text() == "mine"


@pytest.mark.parametrize(
    ("change", "options", "words"),
    [
        ({"truck_share": None}, [], "pier.yaml: truck_share is missing"),
        ({"truck_share": 1.5}, [], "pier.yaml: truck_share must lie above 0 to 1, got 1.5"),
        ({"traffic_volume": "20000"}, [], "pier.yaml: traffic_volume must have a unit"),
        ({"traffic_volume": "5 Hz"}, [], "pier.yaml: traffic_volume must be a number of vehicles"),
        (
            {"distance_from_road": "-1 m"},
            [],
            "pier.yaml: distance_from_road must be from 0 to 1000 m",
        ),
        ({"traffic_mass": "norm(loc=20 t, scale=12 t)"}, [], "pier.yaml: traffic_mass gives neg"),
        ({"traffic_mass": "pareto(b=1, scale=5 t)"}, [], "pier.yaml: traffic_mass gives imposs"),
        ({"traffic_speed": "motorwy"}, [], "pier.yaml: traffic_speed must be a distribution"),
        ({"weigh_in_motion": "no.csv"}, [], "no.csv: cannot be read"),
        ({}, ["--samples", "999"], "--samples must be at least 1000, got 999"),
        ({}, ["--workers", "0"], "--workers must be at least 1, got 0"),
        ({}, ["--output", __file__], "must be a folder, and there is a file"),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(tmp_path, capsys, change, options, words):
    values = {key: value for key, value in (CASE | change).items() if value is not None}
    path = written(tmp_path, values)
    assert cli.main(["risk", str(path), "--output", str(tmp_path / "out"), *options]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert len(printed.err.splitlines()) == 1
    assert words in printed.err
    assert not (tmp_path / "out").exists()
