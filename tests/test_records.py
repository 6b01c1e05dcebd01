"""Force records: what files say, the errors when they do not, and the model's own records."""

import dataclasses
import hashlib
import math

import numpy as np
import pytest
from generated_collisions import collisions

from pierimpact import EquivalentPier, InputError, load_truck, simulate
from pierimpact.collision.averages import largest_average_force
from pierimpact.collision.records import RIGID, Record, low_pass, moving_average
from pierimpact.files.records import read_record_file

TRUCK = load_truck("single-unit-8t")
TIMES = np.arange(60.0)
FORCES = 100.0 * np.sin(0.05 * TIMES)


def rows(times=TIMES, forces=FORCES, separator=", "):
    return [f"{t:g}{separator}{f:g}" for t, f in zip(times, forces, strict=True)]


def written(tmp_path, heading="time [ms], contact force [kN]", lines=None):
    path = tmp_path / "record.csv"
    path.write_text("\n".join([heading, *(rows() if lines is None else lines)]), encoding="utf-8")
    return path


# Files.


def test_a_record_with_its_units(tmp_path):
    path = written(tmp_path, "# measured\n\ntime [ms] , Reaction [kip]")
    record = read_record_file(path)
    assert (record.name, record.quantity) == ("record.csv", "reaction")
    np.testing.assert_allclose(record.time, 1e-3 * TIMES)
    np.testing.assert_allclose(record.force, 4448.2216 * np.round(FORCES, 4), rtol=1e-4)
    assert record.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_separators_and_order_of_columns(tmp_path, separator):
    lines = rows(FORCES, TIMES, separator)
    record = read_record_file(written(tmp_path, f"contact force [MN]{separator}time [s]", lines))
    np.testing.assert_allclose(record.time, TIMES)
    np.testing.assert_allclose(record.force, 1e6 * FORCES, rtol=1e-5)


def changed(index, line):
    lines = rows()
    lines[index] = line
    return lines


HEADING = "time [ms], contact force [kN]"
BAD = {
    "nothing": ("", [], "must have a heading, such as: time [ms], contact force [kN]; got nothing"),
    "no units": ("time, force", None, "row 1: the heading must name each quantity with its unit"),
    "unknown quantity": (
        "time [ms], contact farce [kN]",
        None,
        "row 1: 'contact farce' is not one of time, contact force, reaction; did you mean contact "
        "force?",
    ),
    "unknown unit": (
        "time [ms], contact force [kM]",
        None,
        "row 1: contact force must be a force (kN, MN, lbf, kip), got unknown unit",
    ),
    "no unit": ("time [nan], reaction [kN]", None, "row 1: time must be a time (ms, s), got unkn"),
    "mass for force": ("time [ms], contact force [lb]", None, "which is a mass"),
    "no force": ("time [ms]", None, "row 1: the heading must name time and one force"),
    "two forces": (
        "time [ms], contact force [kN], reaction [kN]",
        None,
        "row 1: the heading must name time and one force",
    ),
    "not ascending": (
        HEADING,
        changed(20, "18.5, 3"),
        "row 22: time must ascend, 18.5 ms follows 19 ms",
    ),
    "twice the same": (HEADING, changed(20, "19, 3"), "row 22: time must ascend"),
    "gap": (
        HEADING,
        rows(np.where(TIMES > 30, TIMES + 40, TIMES)),
        "row 33: there is a gap of 41 ms before it, where the usual step is 1 ms",
    ),
    "blank": (HEADING, changed(5, "5, "), "row 7: contact force is blank"),
    "nan": (HEADING, changed(5, "5, nan"), "row 7: contact force must be finite, got nan"),
    "infinite": (HEADING, changed(5, "inf, 3"), "row 7: time must be finite, got inf"),
    "word": (
        HEADING,
        changed(5, "5, broken"),
        "row 7: contact force must be a number, got 'broken'",
    ),
    "missing column": (HEADING, changed(5, "5"), "row 7: must have 2 columns, got 1"),
    "decimal commas": (
        HEADING,
        changed(5, "5,0,3,2"),
        "row 7: must have 2 columns, got 4; write decimals with a point, or part the columns by "
        "semicolons",
    ),
    "what may be thousands": (
        "time [ms]; contact force [kN]",
        [line.replace(", ", ";") for line in changed(5, "5;3,250")],
        "row 7: contact force must be a number, got '3,250': its comma may part thousands; write",
    ),
    "short": (HEADING, rows()[:9], "must have at least 50 rows of numbers, got 9"),
    "no impact": (
        HEADING,
        rows(forces=-np.abs(FORCES)),
        "there is no impact in it: contact force (compression is positive) never rises",
    ),
    "constant": (HEADING, rows(forces=0.0 * TIMES + 3.0), "its largest value is 3"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_records_are_one_line_with_the_row(tmp_path, name):
    heading, lines, message = BAD[name]
    with pytest.raises(InputError) as error:
        read_record_file(written(tmp_path, heading, lines))
    words = str(error.value)
    assert words.startswith("record.csv: ")
    assert message in words
    assert "\n" not in words


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(InputError, match=r"nowhere\.csv: cannot be read"):
        read_record_file(tmp_path / "nowhere.csv")
    path = tmp_path / "binary.csv"
    path.write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(InputError, match="is not UTF-8 text"):
        read_record_file(path)


# Records of the model.


@pytest.mark.parametrize("case", collisions(12, seed=41))
def test_forces_at_any_time_are_those_of_the_samples(case):
    history = simulate(*case, duration=0.2)
    time, force = history.time, history.contact_force
    inside = np.flatnonzero(np.diff(time) > 1e-7)[:-1]  # the last of a piece, not the next's first
    middle = 0.5 * (time[inside] + time[inside + 1])
    scale = np.abs(force).max()
    # Friction on the pier jumps where it reverses; there a sample belongs to either side.
    found = history.contact_force_at(time)
    assert np.mean(np.abs(found - force) > 1e-7 * scale) < 0.01
    lower = np.minimum(force[inside], force[inside + 1])
    higher = np.maximum(force[inside], force[inside + 1])
    between = history.contact_force_at(middle)
    assert np.all(between > lower - 0.01 * scale)
    assert np.all(between < higher + 0.01 * scale)
    np.testing.assert_allclose(
        history.reaction_at(time), history.reaction, atol=1e-7 * np.abs(history.reaction).max()
    )
    assert history.contact_force_at([-1e-3]) == 0.0


@pytest.mark.parametrize("speed", [8.0, 22.2, 30.0])
def test_a_rigid_pier_does_not_move(speed):
    history = simulate(TRUCK, RIGID, speed)
    assert np.abs(history.pier_displacement).max() < 1e-10
    # All momentum that the truck loses goes into the pier and the road.
    assert history.energy_error < 1e-6


def test_the_average_is_that_of_the_impulse():
    time = np.arange(-0.02, 0.2, 1e-4)
    record = Record(time=time, force=np.ones_like(time), speed=22.2, window=0.01)
    history = record.collision(TRUCK)
    found = record.modelled(history)
    expected = largest_average_force(history, 0.01)
    assert found.max() == pytest.approx(expected.force, rel=1e-3)
    assert time[np.argmax(found)] == pytest.approx(expected.start + 0.005, abs=2e-4)


@pytest.mark.parametrize("cutoff", [20.0, 60.0, 180.0])
def test_the_filter_halves_the_power_at_its_cutoff(cutoff):
    step = 1e-4
    time = step * np.arange(20_000)

    def gain(frequency):
        passed = low_pass(np.sin(2.0 * math.pi * frequency * time), step, cutoff)
        return passed[5000:15_000].std() * math.sqrt(2.0)

    assert gain(cutoff) == pytest.approx(math.sqrt(0.5), rel=2e-3)
    assert gain(0.1 * cutoff) == pytest.approx(1.0, rel=2e-3)
    # Four poles: (f/f_c)^−4 well above, with Ω⁴ = √2 − 1 at the cut-off frequency.
    above = math.tan(math.pi * 5.0 * cutoff * step) / math.tan(math.pi * cutoff * step)
    assert gain(5.0 * cutoff) == pytest.approx(
        1.0 / (1.0 + (math.sqrt(2.0) - 1.0) * above**4), rel=0.05
    )


def test_the_filter_shifts_nothing():
    time = np.linspace(0.0, 0.4, 4001)
    pulse = np.exp(-(((time - 0.2) / 0.01) ** 2))
    assert time[np.argmax(low_pass(pulse, 1e-4, 50.0))] == pytest.approx(0.2, abs=1e-4)
    assert time[np.argmax(moving_average(pulse, 1e-4, 0.02))] == pytest.approx(0.2, abs=1e-4)


def test_record_and_model_pass_the_same_filter():
    time = np.arange(0.0, 0.2, 1e-4)
    raw = Record(time=time, force=np.ones_like(time), speed=22.2)
    raw = dataclasses.replace(raw, force=raw.modelled(raw.collision(TRUCK)))
    filtered = raw.low_passed(100.0)
    left = filtered.modelled(filtered.collision(TRUCK)) - filtered.force
    assert np.abs(left).max() < 0.005 * filtered.peak
    assert filtered.peak < 0.9 * raw.peak
    with pytest.raises(InputError, match="filter of 100 Hz already"):
        filtered.low_passed(50.0)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"time": TIMES[::-1]}, "time must ascend"),
        ({"time": TIMES[None]}, "time must be in one row"),
        ({"force": FORCES[:-1]}, "two arrays of one length, at least 50"),
        ({"time": TIMES[:9], "force": FORCES[:9]}, "at least 50"),
        ({"force": np.full(60, np.nan)}, "force must be finite, got nan at index 0"),
        ({"force": -np.ones(60)}, "force must rise above zero"),
        ({"speed": 0.0}, "speed must be positive"),
        ({"quantity": "force"}, "quantity must be one of contact force, reaction"),
        ({"cutoff": -1.0}, "cutoff must be positive"),
        ({"cutoff": 450.0}, "cutoff must be at most 0.4 of the record's 1000 samples a second"),
        ({"cutoff": 1e-6}, r"cutoff must be at least 16\.9492 Hz, one period .*, got 1e-06 Hz"),
        ({"window": 0.0}, "window must be positive"),
        ({"window": 1e9}, r"window must be at most the record's 0\.059 s, got 1e\+09 s"),
        ({"first_touch": -1e6}, r"first_touch must lie at most 10 s before the end .* -1e\+06 s"),
        ({"first_touch": 1.0}, "first_touch must lie before the end of the record"),
    ],
)
def test_bad_values_are_refused(values, message):
    given = {"time": 1e-3 * TIMES, "force": FORCES, "speed": 20.0} | values
    with pytest.raises(InputError, match=message):
        Record(**given)


def test_a_record_stays_as_it_was_checked():
    time, force = 1e-3 * TIMES, FORCES.copy()
    record = Record(time=time, force=force, speed=20.0)
    time[:], force[:] = 0.0, np.nan
    np.testing.assert_array_equal(record.time, 1e-3 * TIMES)
    np.testing.assert_array_equal(record.force, FORCES)


def test_a_filter_is_bounded_like_that_of_a_record():
    record = Record(time=1e-3 * TIMES, force=FORCES, speed=20.0)
    with pytest.raises(InputError, match=r"cutoff must be at least 16\.9492 Hz"):
        record.low_passed(1e-6)


def test_an_average_shorter_than_a_sample_is_the_force():
    time = np.arange(0.0, 0.2, 1e-3)
    record = Record(time=time, force=np.ones_like(time), speed=22.2, window=1e-12)
    history = record.collision(TRUCK)
    plain = dataclasses.replace(record, window=None).modelled(history)
    np.testing.assert_allclose(record.modelled(history), plain, atol=0.01 * plain.max())


def test_resolution_is_the_longest_of_what_blurs():
    record = Record(time=1e-3 * TIMES, force=FORCES, speed=20.0)
    assert record.resolution == pytest.approx(2e-3)
    assert dataclasses.replace(record, cutoff=100.0).resolution == pytest.approx(5e-3)
    assert dataclasses.replace(record, cutoff=100.0, window=0.02).resolution == pytest.approx(0.02)


def test_a_reaction_of_a_flexible_pier():
    pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    time = np.arange(0.0, 0.2, 1e-3)
    record = Record(time=time, force=np.ones_like(time), speed=22.2, pier=pier, quantity="reaction")
    history = record.collision(TRUCK)
    expected = np.interp(time, history.time, history.reaction)
    np.testing.assert_allclose(record.modelled(history), expected, atol=0.003 * expected.max())
