import dataclasses
import hashlib
import re
from pathlib import Path

import numpy as np
import pytest

import pierimpact
from pierimpact import EquivalentPier, simulate
from pierimpact.certainty import Certainty
from pierimpact.checks import InputError
from pierimpact.collision.averages import largest_average_force
from pierimpact.design.codes import KIP
from pierimpact.files.trucks import load_truck, read_truck_file, truck_names
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.spread import Lognormal, Uniform
from pierimpact.vehicle.truck import QUANTITIES

CATALOGUE = Path(pierimpact.__file__).parent / "trucks"
REFERENCE = (CATALOGUE / "single-unit-8t.toml").read_text("utf-8")


def with_spread(given, text=REFERENCE):
    """The reference truck with another spread of its engine's mass."""
    return text.replace("\nspread = 0.3\n", f"\n{given}\n", 1)


def test_the_reference_truck():
    truck = load_truck("single-unit-8t")
    assert (truck.engine_mass, truck.body_mass, truck.mass) == (700.0, 7300.0, 8000.0)
    assert truck.engine_spring == CrushSpring(
        plateau_force=150e3, plateau_length=0.5, stiffness=150e6, unloading_stiffness=900e6
    )
    assert truck.body_spring == CrushSpring(
        plateau_force=500e3, plateau_length=1.9, stiffness=10e6, unloading_stiffness=60e6
    )
    assert (truck.friction_force, truck.friction_on) == (21.5e3, "road")


def test_the_reference_truck_is_not_passed_off_as_the_papers():
    truck_file = read_truck_file("single-unit-8t")
    assert truck_file.status == "illustrative"
    assert "not Table 1 of the source paper" in truck_file.truck.source
    assert {parameter.status for parameter in truck_file.parameters} == {"illustrative", "assumed"}


@pytest.mark.parametrize("name", truck_names())
def test_every_parameter_has_value_unit_source_and_status(name):
    truck_file = read_truck_file(name)
    assert truck_file.truck.name == name
    assert len(truck_file.parameters) == 12
    for parameter in truck_file.parameters:
        assert parameter.source
        assert parameter.status in Certainty
        assert isinstance(parameter.value, str) or parameter.given.split()[1]
        assert truck_file[parameter.name] is parameter


def test_a_truck_of_ones_own_loads_by_path(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(
        REFERENCE.replace('name = "single-unit-8t"', 'name = "mine"').replace(
            'value = 700\nunit = "kg"', 'value = 0.7\nunit = "t"'
        ),
        encoding="utf-8",
    )
    assert load_truck(path) == load_truck(str(path))
    assert load_truck(path).engine_mass == pytest.approx(700.0, rel=1e-15)
    truck_file = read_truck_file("mine.toml", folder=tmp_path)
    assert (truck_file.truck.name, truck_file.file_name) == ("mine", "mine.toml")
    assert truck_file["engine_mass"].given == "0.7 t"
    assert truck_file.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "[engine_mass]",
            "[engin_mass]",
            "'engin_mass' is not a truck parameter; did you mean engine",
        ),
        (
            "[engine_spring.stiffness]",
            "[engine_spring.stifness]",
            "'engine_spring.stifness' is not a truck parameter; did you mean engine_spring.s",
        ),
        ("[friction_force]", "[body_spring.friction]", "'body_spring.friction' is not a truck"),
        (
            'unit = "kg"',
            'units = "kg"',
            "'engine_mass.units' is not a key; did you mean engine_mass.",
        ),
        (
            'source = "what is left of 8 t"',
            r'source = "what\nis left"',
            "body_mass.source must be one line without control characters, got 'what\\nis left'",
        ),
        ("value = 700\n", "", "engine_mass.value is missing"),
        ("value = 700\n", 'value = "700"\n', "engine_mass.value must be a number, got '700'"),
        ("value = 700\n", "value = nan\n", "engine_mass.value must be finite, got nan"),
        (
            "value = 700\n",
            "value = -700\n",
            "engine_mass must be from 1.0 to 1.0×10⁶ kg (2.2 to 2.2×10⁶ lb), got '-700 kg'",
        ),
        ('unit = "kg"', 'unit = "kip"', "engine_mass must be a mass (kg, t, lb), got '700 kip'"),
        ('unit = "kg"', 'unit = "nan"', "engine_mass must be a mass (kg, t, lb), got unknown unit"),
        ('unit = "kg"', "unit = 3", "engine_mass.unit must be text, got 3"),
        ('value = "road"', 'value = "sky"', "friction_on must be one of road, pier, got 'sky'"),
        ('status = "illustrative"', 'status = "sure"', "status must be one of read, secondary"),
        ('name = "single-unit-8t"', "", "name must be text, got None"),
        (
            'value = 900\nunit = "MN/m"',
            'value = 90\nunit = "MN/m"',
            "engine_spring.unloading_stiffness must be at least stiffness",
        ),
        ('status = "illustrative"', 'status = "cited"', "status must be one of read, secondary"),
        ("[engine_mass]", r'["a\nb"]', r"'a\nb' is not a truck parameter"),
        ("name =", "name", "is not valid TOML"),
        (
            'spread_status = "assumed"',
            'spread_status = "sure"',
            "engine_mass.spread_status must be one of read, secondary",
        ),
        ('value = "road"', 'value = "road"\nspread = 0.3', "'friction_on.spread' is not a key"),
    ],
)
def test_a_bad_truck_file_is_one_line(tmp_path, old, new, message):
    path = tmp_path / "mine.toml"
    assert old in REFERENCE
    path.write_text(REFERENCE.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        load_truck(path)
    assert "mine.toml" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("spread = 1.0", "engine_mass.spread must lie from 0 to below 1, got 1"),
        ("spread = -0.1", "engine_mass.spread must lie from 0 to below 1, got -0.1"),
        ('spread = "wide"', "engine_mass.spread must be a number, got 'wide'"),
        ("spread = true", "engine_mass.spread must be a number, got True"),
        (
            "coefficient_of_variation = 2",
            "engine_mass.coefficient_of_variation must lie from",
        ),
        (
            "sprea = 0.3",
            "'engine_mass.sprea' is not a key; did you mean engine_mass.spread?",
        ),
        (
            "low = 600",
            "engine_mass must have one of spread, coefficient_of_variation, or low",
        ),
        ("spread = 0.3\nlow = 600\nhigh = 800", "or low and high, got spread and low and h"),
        (
            "low = 710\nhigh = 800",
            "engine_mass must have 0 ≤ low ≤ value ≤ high and a value",
        ),
        ("low = 600\nhigh = 690", "got low 600, value 700 and high 690"),
        ("low = -1\nhigh = 800", "got low -1, value 700 and high 800"),
        ("low = 0\nhigh = 800", "spread of engine_mass must not begin at zero"),
        ("", "engine_mass has a spread_source or spread_status but no spread"),
    ],
)
def test_a_bad_spread_is_one_line(tmp_path, given, message):
    path = tmp_path / "mine.toml"
    path.write_text(with_spread(given), encoding="utf-8")
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        load_truck(path)
    assert "\n" not in str(caught.value)


def test_a_missing_parameter_or_spring(tmp_path):
    path = tmp_path / "mine.toml"
    start = REFERENCE.index("[friction_force]")
    path.write_text(
        REFERENCE[:start] + REFERENCE[REFERENCE.index("[friction_on]") :], encoding="utf-8"
    )
    with pytest.raises(InputError, match="friction_force must be a table with value, unit"):
        load_truck(path)
    path.write_text(REFERENCE[: REFERENCE.index("[body_spring")], encoding="utf-8")
    with pytest.raises(InputError, match="body_spring must be a table of its parameters, got None"):
        load_truck(path)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (
            "single-unit",
            r"catalogue \(single-unit-8t, tractor-trailer-36t\).*did you mean single-unit-8t\?",
        ),
        (
            "zzz",
            r"be a name of the catalogue \(single-unit-8t, tractor-trailer-36t\) or the path of",
        ),
        ("nowhere.toml", "truck file nowhere.toml cannot be read: No such file"),
    ],
)
def test_no_such_truck(name, message):
    with pytest.raises(InputError, match=message):
        load_truck(name)


def test_not_text(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_bytes(b"name = '\xff'")
    with pytest.raises(InputError, match="is not UTF-8 text"):
        load_truck(path)
    (tmp_path / "folder.toml").mkdir()
    with pytest.raises(InputError, match="cannot be read: Is a directory"):
        load_truck(tmp_path / "folder.toml")


def test_spreads_of_the_reference_truck_are_this_projects_judgement():
    truck_file = read_truck_file("single-unit-8t")
    assert truck_file.truck.spread == dict.fromkeys(QUANTITIES, Uniform.about(0.3))
    for name in QUANTITIES:
        parameter = truck_file[name]
        assert parameter.spread == Uniform.about(0.3)
        assert (parameter.spread_source, parameter.spread_status) == (
            "judgement of this project",
            Certainty.ASSUMED,
        )
    assert truck_file["friction_on"].spread is None


def test_a_truck_file_without_spreads_is_known_exactly(tmp_path):
    path = tmp_path / "mine.toml"
    lines = [line for line in REFERENCE.splitlines() if not line.startswith("spread")]
    path.write_text("\n".join(lines), encoding="utf-8")
    assert load_truck(path) == load_truck("single-unit-8t")
    assert load_truck(path).spread == {}
    parameter = read_truck_file(path)["engine_mass"]
    assert (parameter.spread, parameter.spread_source, parameter.spread_status) == (None, "", None)


def test_each_kind_of_spread(tmp_path):
    path = tmp_path / "mine.toml"
    for given, spread in (
        ("coefficient_of_variation = 0.1", Lognormal(0.1)),
        ("low = 560\nhigh = 1050", Uniform(0.8, 1.5)),
        ("low = 700.0\nhigh = 700", Uniform(1.0, 1.0)),
        ("spread = 0", Uniform(1.0, 1.0)),
    ):
        text = with_spread(given)
        path.write_text(text, encoding="utf-8")
        truck_file = read_truck_file(path)
        assert truck_file.truck.spread["engine_mass"] == truck_file["engine_mass"].spread == spread
        # Source and status are optional.
        for line in (
            'spread_source = "judgement of this project"\n',
            'spread_status = "assumed"\n',
        ):
            text = text.replace(line, "", 1)
            path.write_text(text, encoding="utf-8")
            assert load_truck(path).spread["engine_mass"] == spread
        assert read_truck_file(path)["engine_mass"].spread_status is None


def test_friction_may_begin_at_zero(tmp_path):
    path = tmp_path / "mine.toml"
    start = REFERENCE.index("[friction_force]")
    friction = with_spread("low = 0\nhigh = 43", REFERENCE[start:])
    path.write_text(REFERENCE[:start] + friction, encoding="utf-8")
    assert load_truck(path).spread["friction_force"] == Uniform(0.0, 2.0)


TRACTOR_TRAILER = load_truck("tractor-trailer-36t")
RIGID = EquivalentPier.from_frequency(mass=10e3, frequency=5000.0)
MPH = 1609.344 / 3600.0


def averages(truck):
    """The largest averages of the contact force in the first 60 ms, over 10 and 25 ms."""
    history = simulate(truck, RIGID, 50 * MPH, duration=0.06)
    return history, [largest_average_force(history, window) for window in (0.010, 0.025)]


def test_the_tractor_trailer_gives_the_two_published_averages_on_a_rigid_pier():
    history, (short, long) = averages(TRACTOR_TRAILER)
    assert short.force == pytest.approx(900 * KIP, rel=0.005)
    assert long.force == pytest.approx(600 * KIP, rel=0.005)
    # Both are of the first peak, and the trailer arrives long after it.
    assert short.start + 0.010 < long.start + 0.026 < 0.06
    assert history.cargo_contact_time > 0.06


@pytest.mark.parametrize("share", [0.4, 0.6, 2.0, 4.0])
def test_the_averages_say_nothing_about_the_stiffness_of_the_engine(share):
    engine = TRACTOR_TRAILER.engine_spring
    other = dataclasses.replace(
        engine,
        stiffness=share * engine.stiffness,
        unloading_stiffness=share * engine.unloading_stiffness,
    )
    before, same = averages(TRACTOR_TRAILER)
    history, found = averages(dataclasses.replace(TRACTOR_TRAILER, engine_spring=other))
    for one, another in zip(found, same, strict=True):
        assert one.force == pytest.approx(another.force, rel=0.015)
    # The peak itself goes with the square root.
    rise = [own.engine_peak.reaction - 1.78e6 for own in (history, before)]
    assert rise[0] / rise[1] == pytest.approx(share**0.5, rel=0.06)


def test_the_averages_follow_from_impulse_and_plateaus():
    # Before the blow both plateaus act, and the engine that rebounds leaves spring 1 without force.
    own, engine = TRACTOR_TRAILER, TRACTOR_TRAILER.engine_spring
    m1, k, ku = own.engine_mass, engine.stiffness, engine.unloading_stiffness
    P1, P2 = engine.plateau_force, own.body_spring.plateau_force
    v1 = ((50 * MPH) ** 2 - 2.0 * P1 * engine.plateau_length / m1) ** 0.5
    blow = m1 * v1 * (1.0 + engine.restitution)
    lasting = np.pi / 2.0 * (m1 / k) ** 0.5 * (1.0 + (k / ku) ** 0.5)
    assert lasting < 0.010
    _, found = averages(own)
    for window, average in zip((0.010, 0.025), found, strict=True):
        expected = blow + P2 * window + P1 * (window - lasting)
        assert average.force * window == pytest.approx(expected, rel=0.01)
    assert own.mass == pytest.approx(36.3e3)
    assert sum((P1, P2)) == pytest.approx(1.78e6)
    assert blow - P1 * lasting == pytest.approx(22.2e3, rel=0.02)


def test_the_tractor_trailer_is_not_passed_off_as_the_one_tested():
    truck_file = read_truck_file("tractor-trailer-36t")
    assert truck_file.status == "illustrative"
    fitted = {p.name for p in truck_file.parameters if p.status == "calibrated"}
    assert fitted == {"engine_mass", "body_spring.plateau_force"}
    assert {p.status for p in truck_file.parameters} == {"calibrated", "assumed"}
    assert set(truck_file.truck.spread) == set(QUANTITIES)


def test_a_mass_range_is_read_with_its_source(tmp_path):
    truck_file = read_truck_file("single-unit-8t")
    assert truck_file.truck.mass_range == truck_file.mass_range[:2] == (5e3, 12e3)
    assert truck_file.mass_range.status is Certainty.ASSUMED
    assert "judgement of this project" in truck_file.mass_range.source
    path = tmp_path / "mine.toml"
    start, end = REFERENCE.index("[mass_range]"), REFERENCE.index("[engine_mass]")
    path.write_text(REFERENCE[:start] + REFERENCE[end:], encoding="utf-8")
    assert read_truck_file(path).mass_range is read_truck_file(path).truck.mass_range is None


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("low = 5\n", "", "mass_range must be a table with low, high, unit, source, status, got {"),
        ("low = 5\n", "lowest = 5\n", "mass_range must be a table with low, high, unit, source"),
        ("low = 5\n", 'low = "5"\n', "mass_range.low must be a number, got '5'"),
        ("low = 5\n", "low = 0\n", "mass_range must be positive, got 0"),
        ("low = 5\n", "low = 13\n", "mass_range must run upward, got 13000 kg to 12000 kg"),
        ("low = 5\n", "low = 9\n", "mass_range must have the truck's own mass in it, 8000 kg"),
        ('unit = "t"', 'unit = "kN"', "mass_range.low must be a mass (kg, t, lb), got '5 kN'"),
    ],
)
def test_a_bad_mass_range_is_one_line(tmp_path, old, new, message):
    path = tmp_path / "mine.toml"
    path.write_text(REFERENCE.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        load_truck(path)
    assert "\n" not in str(caught.value)
