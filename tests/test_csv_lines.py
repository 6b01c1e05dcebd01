"""CSV files: whatever reads them takes the same forms of a number, and refuses the same."""

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from pierimpact import cli
from pierimpact.checks import InputError
from pierimpact.files.csv_lines import csv_rows, name_and_unit
from pierimpact.files.distributions import parse_distribution
from pierimpact.files.piers import REQUIRED, read_pier_table
from pierimpact.files.records import read_record_file
from pierimpact.files.responses import read_responses
from pierimpact.files.weigh_in_motion import read_weigh_in_motion
from pierimpact.units import parse

WORDS = dict.fromkeys(REQUIRED, "fixed") | {"id": "1,5"}
MEASURED = {
    "case": "A", "source": "a paper", "status": "read", "truck": "single-unit-8t",
    "speed [m/s]": "20", "pier_mass [kg]": "8000", "pier_stiffness [N/m]": "3e8",
}  # fmt: skip


def pier(path, number=0):
    table = read_pier_table(path)
    (rows,) = table.pieces(9)
    return table.pier(rows[number])


def pier_number(place, name):
    """The number of the pier in a row of several."""
    key = "damping_ratio" if name == "piers, plain" else "shear_resistance"
    return lambda path: pier(path, place).values[key]


# The columns of a table with a number in one of them, and what is read from it.
READERS = {
    "record": (
        {"time [s]": [*map(str, range(60))], "contact force [N]": [*["0"] * 30, None, *["0"] * 29]},
        lambda path: read_record_file(path).force[30],
    ),
    "trucks": (
        {"speed [m/s]": ["20"], "mass [kg]": [None]},
        lambda path: read_weigh_in_motion(path).mass[0],
    ),
    "piers": (
        {key: [word] for key, word in WORDS.items()} | {"shear_resistance [N]": [None]},
        lambda path: parse("shear_resistance", pier(path).values["shear_resistance"], "force"),
    ),
    "piers, unit in the cell": (
        {key: [word] for key, word in WORDS.items()} | {"shear_resistance": [None]},
        lambda path: parse("shear_resistance", pier(path).values["shear_resistance"], "force"),
    ),
    "piers, plain": (
        {key: [word] for key, word in WORDS.items()} | {"damping_ratio": [None]},
        lambda path: pier(path).values["damping_ratio"],
    ),
    "responses": (
        {key: [word] for key, word in MEASURED.items()} | {"peak_reaction [N]": [None]},
        lambda path: read_responses(path)[0].responses["peak_reaction"],
    ),
}


def read(folder, name, cell, separator=",", end="\n", mark="", blank="", quote='"'):
    """Write a table with a number in it; return what is read."""
    columns, number = READERS[name]
    own = f"{cell}\u00a0N" if name == "piers, unit in the cell" else cell
    rows = [[*columns], *zip(*columns.values(), strict=True)]
    lines = [
        separator.join(f"{quote}{own if text is None else text}{quote}" for text in row)
        for row in rows
    ]
    path = folder / "table.csv"
    path.write_bytes((mark + end.join([blank, lines[0], "", blank, *lines[1:]])).encode())
    return number(path)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("tables")


@settings(deadline=None, max_examples=60)
@given(
    whole=st.integers(1, 900_000),
    decimals=st.from_regex(r"[0-9]{0,2}|[0-9]{4,9}", fullmatch=True),
    sign=st.sampled_from(["", "+"]),
    power=st.sampled_from(["", "e0", "E+0", "e-1"]),
    around=st.sampled_from(["", " ", "\u00a0"]),
    form=st.tuples(
        st.sampled_from(",;\t"),
        st.sampled_from(["\n", "\r\n", "\r"]),
        st.sampled_from(["", "\ufeff"]),
        st.sampled_from(["", " ", "\u00a0"]),
    ),
    comma=st.booleans(),
)
def test_every_reader_reads_the_same_number(
    folder, whole, decimals, sign, power, around, form, comma
):
    number = f"{sign}{whole}.{decimals}" if decimals else f"{sign}{whole}"
    typed = number.replace(".", "," if comma and form[0] != "," else ".")
    for name in READERS:
        # Text of a cell is no number, and keeps its comma.
        quote = '"' if form[0] == "," else ""
        found = read(folder, name, f"{around}{typed}{power}{around}", *form, quote)
        assert found == float(number + power), name


@pytest.mark.parametrize("separator", [";", "\t"])
@pytest.mark.parametrize("name", READERS)
def test_a_comma_that_parts_no_columns_is_that_of_decimals(folder, name, separator):
    for typed, number in {"0,125": 0.125, ",5": 0.5, "1234,567": 1234.567, "2,5e1": 25.0}.items():
        assert read(folder, name, typed, separator, quote="") == number
    for typed in ("1,250", "12,000", "1,250.5", "1.250,5", "1,250,000", "1,"):
        assert "table.csv" in refused(folder, name, typed, separator)


@pytest.mark.parametrize("name", READERS)
def test_a_point_may_part_thousands_where_another_decimal_has_a_comma(
    folder, name, monkeypatch, tmp_path
):
    """The other stands in the row before or after."""
    columns, number = READERS[name]
    (column,) = (key for key, cells in columns.items() if None in cells)
    readers = (number, number)
    if name.startswith("piers"):
        readers = (pier_number(0, name), pier_number(1, name))
    for place in (0, 1):
        more = {key: list(cells) for key, cells in columns.items()}
        gap = more[column].index(None)
        for key, cells in more.items():
            cell = cells[gap]
            if key in ("id", "case"):
                cells[gap : gap + 1] = ["a", "b"] if place else ["b", "a"]
            elif key == "time [s]":
                cells.append("60")
            elif key == column:
                suffix = "\u00a0N" * name.endswith("in the cell")
                cells[gap : gap + 1] = [f"2,5{suffix}", None] if place else [None, f"2,5{suffix}"]
            else:
                cells[gap : gap + 1] = [cell, cell]
        monkeypatch.setitem(READERS, name, (more, readers[place]))
        for typed, ways in {"2.500": "2.5000 or 2500", "1.250.000": "1250000"}.items():
            line = refused(tmp_path, name, typed, ";")
            assert "other decimals have a comma, so its point may part thousands" in line
            assert line.endswith(f"; write {ways}")
        for typed in ("2.5000", "2500", "0.125", "1234.567"):
            read(tmp_path, name, typed, ";", quote="")


@pytest.mark.parametrize("name", READERS)
def test_what_is_said_of_a_mark_is_true_where_decimals_may_have_a_comma(folder, name):
    said = refused(folder, name, "2.400,0", ";")
    assert "thousands have no mark, decimals a point or a comma" in said
    for typed, ways in {"1,250": "1,2500 or 1250", "1,250,000": "1250000"}.items():
        said = refused(folder, name, typed, ";")
        assert "its comma may part thousands; write " + ways in said


@pytest.mark.parametrize("name", READERS)
def test_a_comma_that_parts_columns_is_no_other(folder, name):
    assert "decimals have a point, thousands no comma" in refused(folder, name, "2,5")


NO_NUMBERS = (
    *("1_0", "\u0661\u0660", "\uff11", "\u00b2", "nan", "NaN", "inf", "-Infinity", "1e999"),
    *("0x10", "1e", "--1", "1 0", "1\u00a0000", "1.2.3", "x", "1;5"),
)


def refused(folder, name, typed, separator=","):
    """The one line in which a number is refused, with the file before what `pier` says."""
    with pytest.raises(InputError) as caught:
        read(folder, name, typed, separator)
    line = str(caught.value)
    assert len(line.splitlines()) == 1
    return line if "table.csv" in line else f"table.csv: {line}"


@settings(deadline=None)
@given(st.sampled_from(sorted(READERS)), st.sampled_from(NO_NUMBERS), st.sampled_from(",;\t"))
def test_every_reader_refuses_the_same_in_one_line(folder, name, typed, separator):
    (column,) = (key for key, cells in READERS[name][0].items() if None in cells)
    assert f"{name_and_unit(column)[0]} must be " in refused(folder, name, typed, separator)


@pytest.mark.parametrize("typed", NO_NUMBERS)
def test_what_is_typed_elsewhere_is_refused_as_well(typed, capsys):
    with pytest.raises(InputError, match=r"^mass: s must be .*got "):
        parse_distribution("mass", f"lognorm(s={typed}, scale=18 t)", "mass")
    for option in ("--accuracy", "--damping-ratio"):
        assert cli.main(["fit", "none.csv", "--speed", "80 km/h", f"{option}={typed}"]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert f"{option} must be " in line


@given(st.text(max_size=30))
@example("a" * 9 + " [" * 9)
@example("[m]")
def test_a_heading_is_a_name_with_or_without_a_unit(text):
    name, unit = name_and_unit(text)
    assert name == " ".join(name.split())
    assert not unit or text.strip().endswith("]")


def test_headings_in_any_letters_and_spaces():
    assert name_and_unit(" Contact\u00a0Force [ kN ] ") == ("contact force", "kN")
    assert name_and_unit("speed[km/h]") == ("speed", "km/h")
    assert name_and_unit("speed []") == name_and_unit("speed") == ("speed", "")
    assert name_and_unit("speed [km/h") == ("speed [km/h", "")


def test_rows_are_counted_as_a_spreadsheet_does():
    lines = ["# of whom\n", "\n", "a;b\n", ";\n", "# no\n", '"1;2";"3\n', '4"\n', "5\n"]
    found = [(row.number, row.cells) for row in csv_rows(lines, comments=True)]
    assert found == [(3, ["a", "b"]), (6, ["1;2", "3\n4"]), (7, ["5"])]
    assert next(csv_rows(lines)).cells == ["# of whom"]
    assert list(csv_rows([])) == list(csv_rows(["\n", "#"], comments=True)) == []


@pytest.mark.parametrize("name", READERS)
def test_a_quotation_mark_that_is_not_closed_is_one_line(folder, name):
    for more in (0, 9000):
        with pytest.raises(InputError, match=r"row \d+: (not valid CSV|a quotation mark is not)"):
            read(folder, name, '"1' + more * "\n1", ";", quote="")
