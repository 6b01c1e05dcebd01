"""Files that nobody meant: each is refused in one line, soon, or rightly taken."""

import os
import random
import re
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import pierimpact
from pierimpact.checks import InputError, brief
from pierimpact.files.case import read_case_file
from pierimpact.files.inputs import PHYSICAL_KEYS, Inputs, SectionInputs
from pierimpact.files.keys import quantity_of
from pierimpact.files.limits import POSSIBLE
from pierimpact.files.records import read_record_file
from pierimpact.files.responses import read_responses
from pierimpact.files.trucks import read_truck_file
from pierimpact.files.yaml_keys import yaml_keys
from pierimpact.report.calculation import calculate
from pierimpact.symbols import BY_KEY
from pierimpact.units import DIMENSIONS

CASE = """\
project: Example
column_shape: circular
column_diameter: 1 m
column_height: 5 m
elastic_modulus: 25 GPa
density: 2400 kg/m^3
base: fixed
top: pinned
truck: single-unit-8t
speed: 80 km/h
impact_height: 1.2 m
damping_ratio: 0.05
notes: [one, two]
sources: {speed: posted limit}
"""
TRUCK = (Path(pierimpact.__file__).parent / "trucks" / "single-unit-8t.toml").read_text("utf-8")
RECORD = "time [ms], contact force [kN]\n" + "".join(f"{n}, {n * (60 - n)}\n" for n in range(60))
RESPONSES = (
    "case,source,status,truck,speed [km/h],pier_mass [kg],pier_stiffness [N/m],peak_reaction [kN]\n"
    "a,b,read,single-unit-8t,80,8000,2.8e8,3000\n"
)
SHARED = 'office = "Bridges"\nunits = "US"\n'
READERS = {
    "case.yaml": (CASE, read_case_file),
    "truck.toml": (TRUCK, read_truck_file),
    "record.csv": (RECORD, read_record_file),
    "responses.csv": (RESPONSES, read_responses),
    "pierimpact.toml": (SHARED, lambda path: read_case_file(path.with_name("beside.yaml"))),
    "superseded.yaml": (CASE, lambda path: read_case_file(path.with_name("superseding.yaml"))),
}
LAUGHS = "".join(
    f"{name}: &{name} [{', '.join(['*' + before] * 9)}]\n"
    for before, name in zip("abcdefghi", "bcdefghij", strict=True)
)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "beside.yaml").write_text(CASE, encoding="utf-8")
    (tmp_path / "superseding.yaml").write_text(CASE + "supersedes: superseded.yaml\n", "utf-8")
    return tmp_path


def outcome(path, read):
    """The one line in which a file is refused; "" where it is taken."""
    try:
        read(path)
    except InputError as error:
        line = str(error)
        assert len(line.splitlines()) == 1
        assert len(line) < 500
        return line
    return ""


@pytest.mark.parametrize("name", READERS)
def test_what_the_attacks_start_from_is_taken(folder, name):
    text, read = READERS[name]
    (folder / name).write_text(text, encoding="utf-8")
    assert outcome(folder / name, read) == ""
    (folder / name).write_text("\ufeff" + text, encoding="utf-8")
    assert outcome(folder / name, read) == ""


@pytest.mark.parametrize("name", READERS)
@pytest.mark.parametrize("kind", ["folder", "pipe", "device", "broken link", "link in a circle"])
def test_what_is_no_regular_file(folder, name, kind):
    path = folder / name
    if kind == "folder":
        path.mkdir()
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind == "device":
        path.symlink_to("/dev/zero")
    else:
        path.symlink_to("nowhere" if kind == "broken link" else name)
    line = outcome(path, READERS[name][1])
    assert name in line
    assert "cannot be read: " in line


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
@pytest.mark.parametrize("name", READERS)
def test_a_file_without_permission(folder, name):
    (folder / name).write_text(READERS[name][0], encoding="utf-8")
    (folder / name).chmod(0)
    assert "cannot be read: Permission denied" in outcome(folder / name, READERS[name][1])


@pytest.mark.parametrize("name", READERS)
@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"\xff\xfe", "is not UTF-8 text: line 1 cannot be decoded"),
        (b"a\nb\nc\xe9", "is not UTF-8 text: line 3 cannot be decoded"),
        (b"[" * 30_000, ""),
        (b'"' + b"a" * 60_000 + b'" = 1', ""),
        (b"a = " + b"9" * 6_000, ""),
        (b"\0", ""),
    ],
    ids=["binary", "Latin", "deep", "a long key", "a long number", "zero"],
)
def test_a_file_that_is_none_of_ours(folder, name, content, words):
    (folder / name).write_bytes(content)
    assert words in outcome(folder / name, READERS[name][1]) != ""


@pytest.mark.parametrize("name", READERS)
def test_a_file_of_a_gigabyte(folder, name):
    with (folder / name).open("wb") as file:
        file.truncate(10**9)
    assert outcome(folder / name, READERS[name][1]).endswith("B long")


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("a: &a [1, 2, 3]\n" + LAUGHS, "line 6: with its aliases (*) written out it is too long"),
        ("- &a [1, 2]\n" + re.sub(r"^\w:", "-", LAUGHS, flags=re.M), "line 6: with its aliases"),
        (f"notes: [&a {'x' * 9000}{', *a' * 9000}]", "line 1: with its aliases (*) written out"),
        ("a: &a [*a]", "line 1: the alias *a is within what it stands for"),
        ("a: &a {b: [*a]}", "line 1: the alias *a is within what it stands for"),
        ("\n".join(" " * n + "a:" for n in range(99)), "line 12: nested more than 12 deep"),
        ("a: " + "[" * 9000, "line 1: nested more than 12 deep"),
        ("a: 1\nb: 2\na: 3", "line 3: 'a' is given twice"),
        ("a: !!bool x", "line 1: 'x' cannot be read as a bool"),
        ("a: !!timestamp x", "line 1: 'x' cannot be read as a timestamp"),
        ("a: !!float ''", "line 1: '' is not a decimal number; put it in quotes if it is text"),
        ("a: !!int ''", "line 1: '' is not a decimal number"),
        ("a: !!int _", "line 1: '_' is not a decimal number"),
        ("a: !!map x", "line 1: not valid YAML: expected a mapping node"),
        ("a: !!binary x", "line 1: not valid YAML: failed to decode base64"),
        ("a: !!python/object:os.system x", "line 1: not valid YAML: could not determine"),
        ("a: 0x10", "line 1: '0x10' is not a decimal number"),
        ("a: 010", "line 1: '010' is not a decimal number"),
        ("a: 1:30", "line 1: '1:30' is not a decimal number"),
        ("a: 1_000", "line 1: '1_000' is not a decimal number"),
        ("a: " + "9" * 6000, "line 1: '99999"),
        ("{[a]: b}", "line 1: not valid YAML: found unhashable key"),
    ],
)
def test_yaml_that_nobody_means(text, line):
    with pytest.raises(InputError, match=f"^{re.escape(line)}"):
        yaml_keys(text)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        *(("5e-2", 0.05), ("1.5e3", 1500.0), ("-.5", -0.5), ("7", 7), ("+2.", 2.0)),
        *((".inf", float("inf")), ("-.inf", -float("inf")), ("'010'", "010"), ("1e", "1e")),
    ],
)
def test_numbers_that_are_decimal(text, value):
    assert yaml_keys(f"a: {text}") == {"a": value}


def test_twenty_thousand_keys_are_looked_at_once():
    text = ",".join(f"k{n}" for n in range(9000))
    assert len(yaml_keys(f"{{{text}}}")) == 9000


def test_an_alias_may_stand_for_what_is_short():
    assert yaml_keys("a: &a [x]\nb: *a\nc: [*a, *a]") == {"a": ["x"], "b": ["x"], "c": [["x"]] * 2}


@pytest.mark.parametrize(
    ("key", "value", "line"),
    [
        (
            "truck_mass",
            "8 kip",
            "truck_mass must be a mass (kg, t, lb), got '8 kip', which is a fo",
        ),
        ("column_height", "25 °C", "column_height must be a length (m, mm, ft, in), got unknown u"),
        ("speed", "80 knot", "speed must be a speed (km/h, m/s, mph), got unknown unit in '80 kno"),
        ("impact_height", "1,2 m", "unknown unit in '1,2 m': decimals have a point, thousands no"),
        ("column_height", "1e400 m", "column_height must be finite, got '1e400 m'"),
        ("speed", "nan m/s", "speed must be finite, got 'nan m/s'"),
        ("speed", "0x10 m/s", "speed must be a speed (km/h, m/s, mph), got unknown unit in '0x10"),
        ("speed", f"'80{' ' * 9000}km/h  x'", "speed must be a speed, a number with a unit (km/h"),
        ("speed", "2026-01-31", "speed must be a speed, a number with a unit (km/h, m/s, mph), go"),
        ("speed", "yes", "speed must be a speed, a number with a unit (km/h, m/s, mph), got True"),
        ("damping_ratio", ".nan", "damping_ratio must be finite, got nan"),
        ("damping_ratio", "true", "damping_ratio must be a plain number without unit, got True"),
        ("damping_ratio", "2026-01-31", "damping_ratio must be a number, got 2026-01-31"),
        (
            "column_diameter",
            "1e-6 m",
            "column_diameter must be from 0.050 to 50 m (2.0 to 2000 in)",
        ),
        ("truck_mass", "1e12 t", "truck_mass must be from 100 to 1.0×10⁶ kg (220 to 2.2×10⁶ lb)"),
        ("elastic_modulus", "1e30 Pa", "elastic_modulus must be from 0.10 to 1000 GPa (15 to"),
        ("density", "1e-9 kg/m^3", "density must be from 100 to 3.0×10⁴ kg/m³"),
        ("speed", "1e-320 m/s", "speed must be from 0.36 to 540 km/h (0.22 to 340 mph), got '1e-3"),
        ("impact_height", "4.999999 m", "impact_height must be 0.05 m at least from the top, got "),
        ("impact_height", "1e-9 m", "impact_height must be 0.05 m at least from the base, got 1e-"),
        ("supersedes", "x" * 5000, "supersedes xxxxx"),
        ("'a\\nb'", "1", r"'a\\nb' is not a key of a case file"),
        ('"a\\nb"', "1", r"'a\nb' is not a key of a case file"),
        ("k" * 900, "1", "'kkkkk"),
    ],
)
def test_a_value_that_nobody_means(folder, key, value, line):
    lines = [row for row in CASE.splitlines() if not row.startswith(f"{key}:")]
    path = folder / "case.yaml"
    path.write_text("\n".join([*lines, f"{key}: {value}"]), encoding="utf-8")
    found = outcome(path, read_case_file)
    assert found.startswith("case.yaml: ")
    assert line in found


def test_a_dotted_parameter_at_the_top_is_no_parameter(folder):
    (folder / "truck.toml").write_text('"engine_spring.stiffness" = 3\n' + TRUCK, "utf-8")
    assert outcome(folder / "truck.toml", read_truck_file).endswith(
        "'engine_spring.stiffness' is not a truck parameter"
    )


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("value = 700\n", "value = 1e12\n", "engine_mass must be from 1.0 to 1.0×10⁶ kg (2.2 to"),
        ("value = 700\n", "value = 2026-01-31\n", "engine_mass.value must be a number, got 2026"),
        ("value = 700\n", "value = true\n", "engine_mass.value must be a number, got True"),
        ("value = 700\n", f"value = 0x{'f' * 5000}\n", "engine_mass.value must be a number, got"),
    ],
)
def test_a_truck_that_nobody_means(folder, old, new, line):
    (folder / "truck.toml").write_text(TRUCK.replace(old, new, 1), encoding="utf-8")
    assert line in outcome(folder / "truck.toml", read_truck_file)


def test_every_quantity_has_its_limits():
    assert set(POSSIBLE) <= set(BY_KEY)
    for model in (Inputs, SectionInputs):
        for key in model.model_fields:
            assert key in POSSIBLE or not quantity_of(key)
    assert all(0.0 <= least < most for least, most in POSSIBLE.values())


def test_what_is_brief_is_brief():
    assert brief(10**5000) == "a number of thousands of digits"
    assert brief(["x" * 10**6])[-1] == "…"


# Fuzzing.

# Pieces that have broken readers, to be put anywhere.
PIECES = (
    *(
        "\0",
        "\n",
        "\t",
        "\r",
        "\ufeff",
        "\u202e",
        "\u2028",
        "\ud800",
        '"',
        "'",
        "#",
        ":",
        ": ",
        "-",
    ),
    *(
        "- ",
        "? ",
        "&a ",
        "*a",
        "!!int ",
        "!!bool ",
        "!!binary ",
        "!!set ",
        "!x ",
        "{",
        "}",
        "[",
        "]",
    ),
    *(
        "<<: *a",
        "|",
        ">",
        "%",
        "@",
        "`",
        "~",
        "=",
        "[[",
        "]]",
        '"""',
        ",",
        ";",
        "1e400",
        "nan",
        "inf",
    ),
    *(
        "0x10",
        "1_0",
        "1:30",
        "2026-01-31",
        "true",
        "null",
        "1e-320 m",
        "9" * 5000,
        "x" * 5000,
        " m",
    ),
)


def mutated(text, number):
    """Return a text with a few changes: letters and lines taken out, doubled, moved, replaced."""
    chance = random.Random(number)
    for _ in range(chance.choice([1, 1, 2, 4, 12])):
        start, end = sorted(chance.randrange(len(text) + 1) for _ in range(2))
        end = min(end, start + chance.choice([0, 1, 8, 60, 400]))
        kind = chance.randrange(5)
        new = (
            "",
            chance.choice(PIECES),
            chr(chance.choice([chance.randrange(128), chance.randrange(0x110000)])),
            text[start:end] * 2,
            "".join(chance.sample((text + "\n\n").splitlines(keepends=True), 2)),
        )[kind]
        text = text[:start] + new + text[end:]
    return text.encode("utf-8", "surrogatepass")


def attack(folder, numbers):
    """Read mutated files of all kinds, one for each number; return how many were taken."""
    names, taken = list(READERS), 0
    for number in numbers:
        name = names[number % len(names)]
        text, read = READERS[name]
        path = folder / name
        path.write_bytes(mutated(text, number))
        taken += not outcome(path, read)
        path.unlink()
    return taken


def test_a_mutated_file_is_taken_or_a_line(folder):
    assert 0 < attack(folder, range(240)) < 240


@pytest.mark.attack
@pytest.mark.parametrize("part", range(20))
def test_twenty_thousand_mutated_files_are_taken_or_a_line(folder, part):
    attack(folder, range(1000 + 1000 * part, 2000 + 1000 * part))


NUMBERS = st.floats(allow_nan=True).map(str) | st.from_regex(r"[-+]?[0-9._]{1,8}([eE][-+]?[0-9]+)?")
UNITS = st.sampled_from([unit for kind in DIMENSIONS.values() for unit in kind.units.split(", ")])
TYPED = (
    st.builds("{} {}".format, NUMBERS, UNITS)
    | st.text(max_size=20)
    | NUMBERS
    | st.sampled_from(PIECES)
)


@settings(deadline=None, max_examples=60)
@given(st.sampled_from(PHYSICAL_KEYS), TYPED)
@example("speed", "1e-320 m/s")
@example("column_height", "24'-6 1/2\"")
def test_any_typed_value_is_taken_or_a_line(tmp_path_factory, key, typed):
    path = tmp_path_factory.getbasetemp() / "typed.yaml"
    lines = [row for row in CASE.splitlines() if not row.startswith(f"{key}:")]
    path.write_bytes("\n".join([*lines, f"{key}: {typed}"]).encode("utf-8", "surrogatepass"))
    outcome(path, read_case_file)


def corners(number):
    """Keys of a case, each at one of its limits or somewhere between."""
    chance = random.Random(number)

    def within(key, unit):
        least, most = POSSIBLE[key]
        share = chance.choice([0.0, 1.0, chance.random()])
        return f"{least ** (1.0 - share) * most**share:.12g} {unit}"

    height = chance.choice([0.2, 200.0, 10.0 ** chance.uniform(-0.69, 2.3)])
    impact = chance.choice([0.05, 0.5 * min(height, 100.0), min(height, 50.0) - 0.05])
    return {
        "column_shape": "circular",
        "column_diameter": within("column_diameter", "m"),
        "column_height": f"{height} m",
        "elastic_modulus": within("elastic_modulus", "Pa"),
        "density": within("density", "kg/m^3"),
        "base": "fixed",
        "top": chance.choice(["fixed", "pinned", "free"]),
        "truck": "single-unit-8t",
        "truck_mass": chance.choice(["701 kg", "1e6 kg", "8 t"]),
        "speed": within("speed", "m/s"),
        "impact_height": f"{max(impact, 0.05)} m",
        "damping_ratio": chance.choice(["0.0", "0.05", "0.999999"]),
    } | ({"top_mass": within("top_mass", "kg")} if chance.random() < 0.3 else {})


def calculated(folder, number):
    path = folder / "corner.yaml"
    path.write_text("".join(f"{key}: {value}\n" for key, value in corners(number).items()), "utf-8")
    case = read_case_file(path).case
    return calculate(case)


@pytest.mark.parametrize("number", range(4))
def test_what_is_possible_can_be_calculated(folder, number):
    assert calculated(folder, number).governing.reaction > 0.0
