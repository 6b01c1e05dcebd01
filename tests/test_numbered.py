"""The numbers of a table's column, one below the other."""

from pierimpact.report.document.numbered import Table, columns, decimal
from pierimpact.units import rounded


def column_of(*values):
    rows = [["x", rounded(value, 5)] for value in values]
    table = Table(label="tab-x", caption="x", columns=columns("x", decimal("kg")), rows=rows)
    return [row[1] for row in table.data()["rows"]]


def test_decimal_points_stand_in_line():
    cells = column_of(1787.3, 408110.0, 3186300.0, -0.25, 0.0)
    points = [len(cell) - max(cell.find("."), cell.find("\u2008")) for cell in cells]
    assert len(set(points)) == 1


def test_a_power_of_ten_is_written_out_among_others_without_one():
    *others, largest = column_of(1787.3, 7168400.0, 1.1389e7)
    assert largest.strip() == "11\u202f389\u202f000"
    assert max(map(len, others)) <= len(largest)
    assert [cell.strip() for cell in column_of(-1.1389e7, 2.5, 2.5e12)] == [
        "−11\u202f389\u202f000",
        "2.5000",
        "2.5000×10¹²",
    ]


def test_powers_of_ten_stay_where_all_have_one_and_where_they_are_small():
    assert column_of(1.1389e7, 2.5e8, 0.0)[:2] == ["1.1389×10⁷", "2.5000×10⁸"]
    assert column_of(1.1389e-7, 2.5)[0] == "1.1389×10⁻⁷"
