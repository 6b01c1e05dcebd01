"""What changed between two case files: inputs, results, and nothing else."""

import random

import pytest
import yaml

from pierimpact import cli
from pierimpact.files.case import case_from, read_case_file
from pierimpact.report.calculation import calculate
from pierimpact.report.comparison import Change, compare
from pierimpact.report.warnings import warnings_of
from pierimpact.resources import shipped
from pierimpact.symbols import BY_KEY
from pierimpact.units import parse

# With this truck file, whose parameters carry no spread, a calculation takes little time.
KNOWN = "\n".join(
    line
    for line in (shipped("trucks") / "single-unit-8t.toml").read_text("utf-8").splitlines()
    if not line.startswith("spread")
)
CASE = {
    "column_shape": "circular",
    "column_diameter": "0.9 m",
    "column_height": "5 m",
    "elastic_modulus": "25 GPa",
    "density": "2400 kg/m^3",
    "base": "fixed",
    "top": "pinned",
    "truck": "known.toml",
    "truck_mass": "9 t",
    "speed": "72 km/h",
    "impact_height": "1.2 m",
    "date": "2026-02-03",
    "member_forces": "static",
}
SAME = {
    "column_diameter": "900 mm",
    "column_height": "500 cm",
    "elastic_modulus": "25000 MPa",
    "density": "2.4 t/m^3",
    "truck_mass": "9000 kg",
    "speed": "20 m/s",
    "impact_height": "120 cm",
}
RANGES = {  # to draw another value from
    "column_diameter": (0.8, 1.6, "m", "length"),
    "column_height": (4.0, 7.0, "m", "length"),
    "elastic_modulus": (20.0, 35.0, "GPa", "pressure"),
    "density": (2300.0, 2600.0, "kg/m^3", "density"),
    "truck_mass": (6.0, 11.0, "t", "mass"),
    "speed": (60.0, 100.0, "km/h", "speed"),
    "impact_height": (1.0, 1.5, "m", "length"),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("compare")
    (path / "known.toml").write_text(KNOWN, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def calculated(folder):
    def calculated(**changes):
        return calculate(case_from(CASE | changes, folder))

    return calculated


def names(changes):
    return [change.name for change in changes]


def test_the_same_case_in_other_units_is_no_change(calculated):
    comparison = compare(calculated(), calculated(**SAME))
    assert not comparison.changed
    assert set(names(comparison.retyped)) == {BY_KEY[key].heading for key in SAME}
    assert comparison.text().startswith("No input and no result changed.")
    assert "Nominal impact height, 1.2 m before, 120 cm now" in comparison.text()


def test_exactly_what_was_changed_is_listed_and_undone_the_other_way(calculated):
    draw, one = random.Random(7), calculated()
    for _ in range(6):
        keys = draw.sample(sorted(RANGES), draw.randint(1, 3))
        typed = {key: f"{draw.uniform(*RANGES[key][:2]):.6g} {RANGES[key][2]}" for key in keys}
        other = calculated(**typed)
        forth, back = compare(one, other), compare(other, one)
        found = {change.name: change for change in forth.inputs}
        for key in keys:
            old, new = (parse(key, text, RANGES[key][3]) for text in (CASE[key], typed[key]))
            change = found.pop(BY_KEY[key].heading)
            assert change.percent == pytest.approx(100.0 * (new / old - 1.0), rel=1e-9)
        # A total mass leaves another mass to the body.
        assert list(found) == [BY_KEY["body_mass"].heading] * ("truck_mass" in keys)
        for there, again in zip(
            (*forth.inputs, *forth.results), (*back.inputs, *back.results), strict=True
        ):
            assert there[:3] == (again.name, again.new, again.old)
            assert (1.0 + there.percent / 100.0) * (1.0 + again.percent / 100.0) == pytest.approx(1)
        assert (forth.came, forth.went) == (back.went, back.came)


def test_other_units_are_no_other_warnings(calculated):
    wide = {"column_shape": "rectangular", "column_width": "9 m", "column_depth": "0.8 m"}
    wide |= {"column_diameter": None, "truck": "tractor-trailer-36t"}
    old, new = calculated(**wide, units="US"), calculated(**wide, units="SI")
    found = compare(old, new)
    assert (found.came, found.went, found.results) == ([], [], [])
    assert [change.name for change in found.inputs] == ["Units"]


def test_results_are_those_of_the_calculations(calculated):
    old, new = (
        calculated(shear_resistance="6 MN"),
        calculated(speed="90 km/h", shear_resistance="5 MN"),
    )
    found = {change.name: change.percent for change in compare(old, new).results}
    static = lambda each: each.member_forces  # noqa: E731
    expected = {
        "Engine peak": lambda each: each.history.engine_peak.reaction,
        "Cargo peak": lambda each: each.history.cargo_peak.reaction,
        "Design reaction": lambda each: each.design_force,
        "Reaction by hand": lambda each: each.short.reaction,
        "Largest shear": lambda each: abs(static(each).largest_shear.value),
        "Largest moment": lambda each: abs(static(each).largest_moment.value),
        "25 ms average over AASHTO LRFD": lambda each: each.average_forces[0.025].force,
        "Utilisation in shear": lambda each: (
            abs(static(each).largest_shear.value) / each.case.inputs.shear_resistance
        ),
    }
    # The pier is the same, and no resistance to moment is given.
    assert found.pop("Resistance") is None
    assert found == {
        name: pytest.approx(100.0 * (value(new) / value(old) - 1.0), rel=1e-9)
        for name, value in expected.items()
    }


def test_the_band_and_the_method_of_member_forces(calculated):
    old, new = (
        calculated(truck="single-unit-8t", truck_mass=None, member_forces=method)
        for method in ("static", "beam")
    )
    found = {change.name: change for change in compare(old, new).results}
    beam, static = new.demands["shear"], old.demands["shear"]
    assert (static.method, beam.method) == ("static", "beam")
    shear = found["Largest shear"]
    assert shear.old.endswith("kN (static)")
    assert shear.new.endswith("kN (beam)")
    assert shear.percent == pytest.approx(100.0 * (beam.value / static.value - 1.0))
    upper = found["Shear that 95 % of trucks stay below"]
    grown = new.demand_bands["shear"][1] / old.demand_bands["shear"][1]
    assert upper.percent == pytest.approx(100.0 * (grown - 1.0))
    assert not any("trucks" in name for name in found if name.startswith("Reaction"))
    (low, _, high), bands = old.band.quantiles(), old.demand_bands
    lost = {
        c.name: c for c in compare(old, calculated(truck_mass=None)).results if "trucks" in c.name
    }
    assert [(c.old, c.new) for c in lost.values()] == [
        (f"{low / 1e3:.0f} kN", "—"),
        (f"{high / 1e3:.0f} kN", "—"),
        (f"{bands['shear'][1] / 1e3:.0f} kN", "—"),
        (f"{bands['moment'][1] / 1e3:.0f} kN·m", "—"),
    ]


@pytest.mark.parametrize(
    ("old", "new", "rows"),
    [
        ({}, {"damping_ratio": 0.05}, []),
        ({}, {"damping_ratio": 0.02}, [("Damping ratio of the pier", "0.05 (default)", "0.02")]),
        (
            {"assumed": {"base": "not seen"}},
            {"sources": {"base": "drawing 3"}},
            [("Base of the column", "fixed (assumed: not seen)", "fixed (drawing 3)")],
        ),
        ({}, {"top_mass": "20 t"}, [("Mass at the top", "—", "20 000 kg")]),
        ({"revision": "A"}, {"revision": "B"}, [("Revision", "A", "B")]),
        ({"notes": ["one", "two"]}, {"notes": ["two", "three"]}, [
            ("Note", "—", "three"), ("Note", "one", "—")
        ]),
        ({}, {"units": "US"}, [("Units", "SI (default)", "US")]),
        (
            {},
            {"annexes": ["truck", "codes"], "revisions": [{"revision": "A", "date": "2026-02-03"}]},
            [
                ("Annexes", "—", "truck, codes"),
                ("Line of the table of revisions", "—", "A, 2026-02-03: —, —"),
            ],
        ),
        (
            {},
            {"steps": [
                {"height": "3 m", "column_shape": "circular", "column_diameter": "1.1 m"}
            ]},
            [
                ("Shape of the section, step 1", "—", "circular"),
                ("Column diameter, step 1", "—", "1.1 m"),
                ("Height, step 1", "—", "3 m"),
            ],
        ),
        ({"top_mass": "20 t"}, {}, [("Mass at the top", "20 000 kg", "—")]),
    ],
)  # fmt: skip
def test_what_is_no_number(calculated, old, new, rows):
    comparison = compare(calculated(**old), calculated(**new))
    plain = [
        (c.name, c.old.replace("\u202f", " "), c.new.replace("\u202f", " "))
        for c in comparison.inputs
    ]
    assert plain == rows
    assert comparison.changed == bool(rows)


def test_the_truck_by_its_name_its_file_and_its_parameters(calculated, folder):
    other = KNOWN.replace('name = "single-unit-8t"', 'name = "mine"').replace(
        "value = 700\n", "value = 750\n", 1
    )
    (folder / "mine.toml").write_text(other, encoding="utf-8")
    found = {
        change.name: change
        for change in compare(calculated(), calculated(truck="mine.toml")).inputs
    }
    assert [found[name][1:3] for name in ("Truck", "Truck file")] == [
        ("single-unit-8t", "mine"),
        ("known.toml", "mine.toml"),
    ]
    assert found["SHA-256 of the truck file"].old != found["SHA-256 of the truck file"].new
    assert found["Engine mass"] == (
        "Engine mass",
        "700 kg",
        "750 kg",
        pytest.approx(100 * 50 / 700),
    )
    assert found["Mass of body and cargo"][1:3] == ("8300 kg", "8250 kg")
    assert len(found) == 5
    # A remark in the file is no other truck, but another file.
    (folder / "remark.toml").write_text(KNOWN + "# seen\n", encoding="utf-8")
    changes = compare(calculated(), calculated(truck="remark.toml")).inputs
    assert names(changes) == ["Truck file", "SHA-256 of the truck file"]
    # Status and spread count, and another unit does not.
    text = KNOWN.replace('unit = "kg"', 'unit = "kg"\nspread = 0.1', 1).replace(
        'status = "illustrative"\n\n[body_mass]', 'status = "read"\n\n[body_mass]'
    )
    (folder / "known better.toml").write_text(text, encoding="utf-8")
    better = calculated(truck="known better.toml")
    (change,) = (c for c in compare(calculated(), better).inputs if c.name == "Engine mass")
    assert change[1:] == (
        "700 kg (illustrative; no spread)",
        "700 kg (read in the source; ±10 %)",
        None,
    )


def test_the_tables_of_a_sheet_and_of_a_terminal_have_every_change(calculated):
    comparison = compare(calculated(), calculated(speed="90 km/h", element="<b> & co."))
    inputs, results = comparison.blocks()
    for table, changes in ((inputs, comparison.inputs), (results, comparison.results)):
        assert [row[:3] for row in table.rows] == [list(change[:3]) for change in changes]
        assert table._repr_html_().count("<tr") == len(changes) + 1
    assert "&lt;b&gt; &amp; co." in inputs._repr_html_()
    lines = comparison.text().splitlines()
    for change in (*comparison.inputs, *comparison.results):
        (line,) = (line for line in lines if line.startswith(change.name))
        assert line.split("  ")[0] == change.name
        assert line.endswith(change.change or change.new)
    (same,) = compare(calculated(), calculated()).blocks()
    assert "No input and no result changed." in same._repr_html_()


@pytest.mark.parametrize(
    ("percent", "text"),
    [(None, ""), (12.5, "+12.5 %"), (-0.01234, "−0.0123 %"), (100.0, "+100 %")],
)
def test_a_change_in_per_cent(percent, text):
    assert Change("Speed", "1", "2", percent).change == text


def test_the_command_prints_and_writes_nothing(tmp_path, capsys, monkeypatch):
    text = yaml.safe_dump(CASE)
    old, new, bad = (tmp_path / name / "P1.yaml" for name in ("old", "new", "bad"))
    for path, speed in ((old, "speed: 72"), (new, "speed: 90"), (bad, "sped: 72")):
        path.parent.mkdir()
        path.write_text(text.replace("speed: 72", speed), encoding="utf-8")
        (path.parent / "known.toml").write_text(KNOWN, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    assert cli.main(["compare", "old/P1.yaml", "old/P1.yaml"]) == 0
    assert "No input and no result changed." in capsys.readouterr().out
    assert cli.main(["compare", str(old), str(new)]) == 0
    expected = compare(*(calculate(read_case_file(path).case) for path in (old, new))).text()
    assert capsys.readouterr() == (f"{old} → {new}\n\n{expected}\n", "")
    assert cli.main(["compare", "old/P1.yaml", "bad/P1.yaml"]) == 2
    assert capsys.readouterr() == (
        "",
        "pierimpact: bad/P1.yaml: 'sped' is not a key of a case file; did you mean speed?\n",
    )
    assert cli.main(["compare", "nowhere/P1.yaml", "old/P1.yaml"]) == 2
    assert capsys.readouterr().err == (
        "pierimpact: nowhere/P1.yaml: cannot be read: No such file or directory\n"
    )
    assert sorted(tmp_path.rglob("*")) == before


def of_resistance(calculation):
    return [text for text in warnings_of(calculation) if "times the resistance" in text]


def test_warnings_that_came_and_went(calculated):
    firm, weak, weaker = (calculated(shear_resistance=f"{r} MN") for r in (9, 4, 3))
    comparison = compare(firm, weak)
    (came,) = comparison.came
    assert came in of_resistance(weak)
    assert comparison.went == []
    assert (compare(weak, firm).came, compare(weak, firm).went) == ([], [came])
    assert f"Warnings that came\n- {came}" in comparison.text()
    assert comparison.blocks()[-1].rows == [["came", came]]
    # It is not another warning for another number in it.
    assert of_resistance(weaker) != of_resistance(weak)
    assert (compare(weak, weaker).came, compare(weak, weaker).went) == ([], [])


@pytest.mark.parametrize("above", [1.0004, 1.00000004])
def test_a_utilisation_near_one_shows_its_side(calculated, above):
    largest = abs(calculated().member_forces.largest_shear.value)
    firm, weak = (calculated(shear_resistance=f"{largest * r:.12g} N") for r in (above, 1 / above))
    changes = {change.name: change for change in compare(firm, weak).results}
    change = changes["Utilisation in shear"]
    assert 0.999 < float(change.old) < 1.0 < float(change.new) < 1.001
