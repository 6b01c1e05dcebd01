"""The US National Bridge Inventory as a table of piers, from a small file made by hand."""

import csv
import io
import os

import numpy as np
import pytest

from pierimpact.checks import InputError
from pierimpact.cli import main
from pierimpact.files.inventory import ITEMS, piers_of, read_rules
from pierimpact.files.piers import read_pier_table

RULES = """
[every]
truck = "single-unit-8t"
speed = "80 km/h"
impact_height = "1.2 m"
density = "2400 kg/m^3"
elastic_modulus = "25 GPa"
base = "fixed"
top = "pinned"
column_height = "5 m"
[[rules]]
when = { kind = ["1", "02"], built = [1950, 1989] }
column_shape = "circular"
column_diameter = "36 in"
[[rules]]
when = { kind = [3] }
column_shape = "rectangular"
column_width = "4 ft"
column_depth = "3 ft"
"""
BRIDGE = {
    "state": "26", "structure": "'00000000000A1, N'", "record": "2", "latitude": "42201500",
    "longitude": "083033045", "built": "1971", "lanes_under": "04", "traffic": "021000",
    "truck_share": "12", "kind": "1", "type": "02", "vertical_clearance": "4.42",
    "right_clearance": "2.1", "left_clearance": "0.0",
}  # fmt: skip


HEADINGS = {what: f"SOME_{what.upper()}_{item}" for what, item in ITEMS.items()}


def inventory(path, bridges, fields=HEADINGS):
    lines = [",".join(["OTHER_000", *fields.values()])]
    lines += [",".join(["'x, y'", *(BRIDGE | bridge).values()]) for bridge in bridges]
    path.write_text("\n".join(lines) + "\n", encoding="latin-1")
    return path


@pytest.fixture
def rules(tmp_path):
    path = tmp_path / "rules.toml"
    path.write_text(RULES)
    return path


def rows(content):
    return list(csv.DictReader(io.StringIO(content.decode())))


def test_a_bridge_becomes_a_pier_by_the_rule_of_its_kind(tmp_path, rules):
    bridges = [
        {},
        {"structure": "B2", "kind": "3", "built": "2001", "longitude": "83033045"},
        {"structure": "B3", "lanes_under": "00"},
        {"structure": "B4", "built": "1990"},
        {"structure": "B5", "latitude": "42601500"},
        {"structure": "B7", "latitude": "422015"},
        {"structure": "B8", "longitude": "181000000"},
        {"structure": "B6", "kind": "2", "latitude": "00000000", "longitude": "", "traffic": ""},
        {"structure": "B2"},
    ]
    found = piers_of(inventory(tmp_path / "nbi.txt", bridges), read_rules(rules))
    piers, held = rows(found.piers), rows(found.held)
    assert [own["id"] for own in piers] == [
        *("26-00000000000A1, N", "26-B2", "26-B5", "26-B7", "26-B8", "26-B6")
    ]
    assert [own["id"] for own in held] == [own["id"] for own in piers]
    assert [own["column_diameter"] for own in piers] == ["36 in", "", *4 * ["36 in"]]
    assert [own["column_depth"] for own in piers] == ["", "3 ft", *4 * [""]]
    assert float(piers[0]["latitude"]) == pytest.approx(42.0 + 20.0 / 60.0 + 15.0 / 3600.0)
    # Zeros before it may be lost, and it counts as west.
    longitude = -(83.0 + 3.0 / 60.0 + 30.45 / 3600.0)
    assert [float(own["longitude"]) for own in piers[:2]] == pytest.approx([longitude] * 2)
    for own in piers[2:]:
        assert own["latitude"] == own["longitude"] == ""
    assert [own["trucks [1/day]"] for own in held] == [*5 * ["2520"], ""]
    assert dict(found.left_out) == {
        "no lanes under it": 1,
        "no rule for kind 1, type 2": 1,
        "another route of a bridge that has a row already": 1,
    }
    assert dict(found.blank) == {
        "latitude is not degrees, minutes, seconds and hundredths": 2,
        "longitude is more than 180°": 1,
    }


def test_traffic_is_that_of_a_route_under_the_bridge(tmp_path, rules):
    over, under = {"record": "1", "traffic": "000100"}, {"record": "2", "traffic": "030000"}
    bridges = [
        {"structure": "B1", **over}, {"structure": "B1", **under},
        {"structure": "B2", **under}, {"structure": "B2", **over},
        {"structure": "B3", **over}, {"structure": "B3", **over},
        {"structure": "B4", "record": "A"}, {"structure": "B4", **under},
    ]  # fmt: skip
    found = piers_of(inventory(tmp_path / "nbi.txt", bridges), read_rules(rules))
    held = rows(found.held)
    assert [own["id"] for own in held] == [f"26-B{i}" for i in (1, 2, 3, 4)]
    assert [own["record"] for own in held] == ["2", "2", "1", "A"]
    assert [own["route"] for own in held] == ["under", "under", "over", "under"]
    assert [own["trucks [1/day]"] for own in held] == ["3600", "3600", "12", "2520"]
    assert found.left_out == {"another route of a bridge that has a row already": 4}


def test_numbers_that_are_none(tmp_path, rules):
    bridges = [
        {"structure": "B1", "lanes_under": "\u00b2"},
        {"structure": "B2", "built": "198\u00b9"},
        {"structure": "B3", "latitude": "4220150\u00b9"},
        {"structure": "B4", "traffic": "1_0"},
        {"structure": "B5", "truck_share": "nan"},
    ]
    found = piers_of(inventory(tmp_path / "nbi.txt", bridges), read_rules(rules))
    assert [own["trucks [1/day]"] for own in rows(found.held)] == ["2520", "", ""]
    assert dict(found.blank) == {"latitude is not degrees, minutes, seconds and hundredths": 1}
    assert dict(found.left_out) == {
        "no lanes under it": 1,
        "no rule for kind 1, type 2": 1,
    }


def test_coordinates_are_unpacked(tmp_path, rules):
    random = np.random.default_rng(2)
    places = random.integers((0, 0, 0, 0, 0, 0), (90, 60, 6000, 180, 60, 6000), (50, 6))
    bridges = [
        {
            "structure": f"B{i}",
            "latitude": f"{a:02}{b:02}{c:04}",
            "longitude": f"{d:03}{e:02}{f:04}",
        }
        for i, (a, b, c, d, e, f) in enumerate(places)
    ]
    found = rows(piers_of(inventory(tmp_path / "nbi.txt", bridges), read_rules(rules)).piers)
    for own, (a, b, c, d, e, f) in zip(found, places, strict=True):
        expected = a + (b + c / 6000.0) / 60.0, -(d + (e + f / 6000.0) / 60.0)
        assert (float(own["latitude"]), float(own["longitude"])) == pytest.approx(
            expected, abs=1e-6
        )


def test_the_command_writes_a_table_that_the_portfolio_reads(tmp_path, rules, capsys):
    file, output = inventory(tmp_path / "nbi.txt", [{}, {"lanes_under": "0"}]), tmp_path / "p.csv"
    assert main(["inventory", str(file), "--rules", str(rules), "--output", str(output)]) == 0
    table = read_pier_table(output)
    assert table.size == 1
    said = capsys.readouterr()
    assert said.out.splitlines() == [str(output), str(tmp_path / "p-inventory.csv")]
    assert "left out, 1: no lanes under it" in said.err
    assert "the inventory does not hold it: column_shape, column_diameter" in said.err


def test_lines_that_are_no_bridges_are_counted(tmp_path, rules):
    path = inventory(tmp_path / "nbi.txt", [{"structure": f"B{i}"} for i in range(9)])
    lines = path.read_text("latin-1").splitlines()
    lines[3] += ",more"
    lines[5] = lines[5].rpartition(",")[0]
    lines.insert(6, "")
    lines[8] = lines[8].replace("'x, y'", "'x, y")  # takes the next one, too
    path.write_text("\n".join(lines) + "\n", encoding="latin-1")
    found = piers_of(path, read_rules(rules))
    assert [row["id"] for row in rows(found.piers)] == [f"26-B{i}" for i in (0, 1, 3, 5, 8)]
    reason = "more or fewer cells than the heading, the first in line 4"
    assert found.left_out == {reason: 4}
    assert found.count + sum(found.left_out.values()) == 9


@pytest.mark.parametrize("quoted", [1, 5])
def test_quotes_are_told_from_more_than_the_first_lines(tmp_path, rules, quoted):
    bridges = [{"structure": f"B{i}"} for i in range(7)]
    path = inventory(tmp_path / "nbi.txt", bridges)
    lines = path.read_text("latin-1").splitlines()
    for number in range(1, len(lines)):
        if number != quoted:
            lines[number] = lines[number].replace("'x, y'", "O'BRIEN ROAD")
    path.write_text("\n".join(lines) + "\n", encoding="latin-1")
    found = piers_of(path, read_rules(rules))
    assert found.count == 7
    assert not found.left_out


def test_tables_that_somebody_changed_are_kept(tmp_path, rules, capsys):
    file, output = inventory(tmp_path / "nbi.txt", [{}]), tmp_path / "p.csv"
    command = ["inventory", str(file), "--rules", str(rules), "--output", str(output)]
    assert main(command) == main(command) == 0
    held = tmp_path / "p-inventory.csv"
    written = output.read_bytes()
    for changed in (output, held):
        changed.write_bytes(changed.read_bytes() + b"mine\n")
        assert main(command) == 2
        assert f"{changed} was not written by pierimpact, or changed" in capsys.readouterr().err
        assert changed.read_bytes().endswith(b"mine\n")
        assert main([*command, "--force"]) == 0
    assert output.read_bytes() == written


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("[fields]\nlat = 'x'", "'lat' is not a field of the inventory"),
        ("[every]\nspede = '80 km/h'", "'spede' is not a key .*did you mean speed"),
        ("[[rules]]\nwhen = {kinds = [1]}", "'kinds' is not a condition"),
        ("[[rules]]\nwhen = {built = [1950]}", "must be the first and the last year"),
        ("[[rules]]\nwhen = {kind = 1}", "must be a list of codes, got 1"),
        ("[rules]\nkind = 1", r"rules must be written as \[\[rules\]\]"),
        ("other = 1", "'other' is not a table of a rules file"),
    ],
)
def test_bad_rules_are_one_line(tmp_path, text, error):
    (tmp_path / "rules.toml").write_text(text)
    with pytest.raises(InputError, match=error) as caught:
        read_rules(tmp_path / "rules.toml")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("heading", "error"),
    [
        ("LATDD", "has no fields whose heading ends in _016, which is the latitude: name its"),
        ("OTHER_016,LAT_016", "has 2 fields whose heading ends in _016, which is the latitude"),
    ],
)
def test_a_heading_that_is_not_clear_is_asked_of_the_user(tmp_path, rules, heading, error):
    file = inventory(tmp_path / "nbi.txt", [], HEADINGS | {"latitude": heading})
    with pytest.raises(InputError, match=error):
        piers_of(file, read_rules(rules))


def test_a_heading_is_taken_from_the_rules(tmp_path, rules):
    file = inventory(tmp_path / "nbi.txt", [{}], HEADINGS | {"latitude": "LATDD"})
    rules.write_text(f'[fields]\nlatitude = "LATDD"\n{RULES}')
    assert piers_of(file, read_rules(rules)).count == 1
    rules.write_text(f'[fields]\nlatitude = "LATD"\n{RULES}')
    with pytest.raises(InputError, match="has no field LATD, which by the rules is the latitude"):
        piers_of(file, read_rules(rules))


def test_a_pipe_is_no_inventory(tmp_path, rules):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match="it is no regular file"):
        piers_of(tmp_path / "pipe", read_rules(rules))
    with pytest.raises(InputError, match="it is no regular file"):
        read_pier_table(tmp_path / "pipe")
