"""`pierimpact trucks`: the catalogue, and a truck with the sources of its parameters."""

import shutil

import pytest

from pierimpact import cli
from pierimpact.files.trucks import read_truck_file, truck_names
from pierimpact.resources import shipped
from pierimpact.symbols import BY_KEY


def words_of(text):
    return " ".join(text.split())


def columns_of(lines):
    """Return the cells of a table, its lines below a heading that begins each column."""
    heading = lines[0]
    starts = [
        at for at, letter in enumerate(heading) if letter != " " and heading[:at][-2:] in ("", "  ")
    ]
    ends = [*starts[1:], None]
    rows = []
    for line in lines[1:]:
        cells = [line[start:end].strip() for start, end in zip(starts, ends, strict=True)]
        if cells[1]:
            rows.append(cells)
        else:  # a cell goes on
            rows[-1] = [
                words_of(f"{one} {more}") for one, more in zip(rows[-1], cells, strict=True)
            ]
    return rows


def test_the_catalogue_has_every_truck(capsys):
    assert cli.main(["trucks"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 102
    rows = columns_of(lines)
    assert [row[0] for row in rows] == truck_names()
    for name, mass, stands_for, status, spread, description in rows:
        file = read_truck_file(name)
        low, high, *_ = file.mass_range
        assert float("".join(mass.removesuffix(" kg").split())) == file.truck.mass
        ends = stands_for.removesuffix(" kg").split("–")
        assert [float("".join(end.split())) for end in ends] == [low, high]
        assert status == file.status.words
        assert description == words_of(file.description)
        largest = max(abs(end - 1.0) for own in file.truck.spread.values() for end in own.ends)
        assert spread == f"up to {100.0 * largest:.0f} %"


@pytest.mark.parametrize("name", truck_names())
def test_a_truck_has_all_that_its_file_says_of_a_parameter(name, tmp_path, capsys):
    assert cli.main(["trucks", name]) == 0
    printed = capsys.readouterr().out
    head, table = printed.split("\n\n")
    file = read_truck_file(name)
    for text in (name, file.description, file.source, file.mass_range.source):
        assert words_of(text) in words_of(head)
    rows = columns_of(table.splitlines())
    assert len(rows) == len(file.parameters)
    for row, own in zip(rows, file.parameters, strict=True):
        spread = own.spread.words if own.spread else "none"
        expected = (BY_KEY[own.name].heading, own.given, spread, own.status.words, own.source)
        assert row == [words_of(cell) for cell in expected]
    copy = tmp_path / "mine.toml"
    shutil.copy(shipped("trucks") / f"{name}.toml", copy)
    assert cli.main(["trucks", str(copy)]) == 0
    assert capsys.readouterr().out == printed


def test_a_truck_without_spread_and_range_says_so(tmp_path, capsys):
    text = (shipped("trucks") / "single-unit-8t.toml").read_text("utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("spread")]
    start = lines.index("[mass_range]")
    del lines[start : start + 6]
    (tmp_path / "mine.toml").write_text("\n".join(lines), encoding="utf-8")
    assert cli.main(["trucks", str(tmp_path / "mine.toml")]) == 0
    printed = capsys.readouterr().out
    assert "the springs stand for any mass." in printed
    assert {row[2] for row in columns_of(printed.split("\n\n")[1].splitlines())} == {"none"}


def test_no_such_truck_is_one_line_and_code_2(capsys):
    assert cli.main(["trucks", "single-unit-9t"]) == 2
    assert "did you mean single-unit-8t?" in capsys.readouterr().err
