"""`pierimpact check`: what a case comes to, on a terminal and for programs."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from sheet_page import US_CASE

from pierimpact import cli
from pierimpact.files.case import case_from, read_case_file
from pierimpact.report.calculation import calculate
from pierimpact.report.check import check_text
from pierimpact.report.results import Results
from pierimpact.report.warnings import warnings_of
from pierimpact.units import printed, rounded

HOUSE = Path(__file__).parents[1]
EXAMPLE = HOUSE / "notebooks" / "tti-column.yaml"
STATIC = US_CASE | {"member_forces": "static", "impact_height": "4 ft"}


def write_case(path, **changes):
    path.parent.mkdir(exist_ok=True)
    path.write_text(yaml.safe_dump(STATIC | changes), encoding="utf-8")
    return str(path)


def words_of(text):
    """Return a text in one line, as it was before it was wrapped into the table's column."""
    return " ".join(text.split())


@pytest.mark.parametrize(
    ("changes", "sentence", "verdicts"),
    [
        ({}, "The column does not hold: utilisation ", {"shear": "within", "moment": "EXCEEDS"}),
        (
            {"moment_resistance": "6500 kip*ft", "shear_resistance": None},
            "The column holds this truck as far as it is checked: utilisation ",
            {"moment": "within"},
        ),
        (
            {"moment_resistance": None, "shear_resistance": None, "units": "SI"},
            "The column must resist a shear of ",
            {},
        ),
    ],
)
def test_the_text_has_all_that_was_calculated(changes, sentence, verdicts):
    calculation = calculate(case_from(STATIC | changes))
    text, system = check_text("my case", calculation), calculation.case.inputs.units
    lines = text.splitlines()
    assert lines[0] == "my case"
    assert lines[1].startswith(sentence)
    assert max(map(len, lines)) <= 100
    by_label = {line[:23].strip(): words_of(line[23:]) for line in lines if line[:1].isalpha()}
    low, _, high = calculation.band.quantiles()
    for label, value, quantity in (
        ("Design reaction", calculation.design_force, "force"),
        ("Band, 5 to 95 %", high, "force"),
        ("Largest shear", calculation.demands["shear"].value, "force"),
        ("Largest moment", calculation.demands["moment"].value, "moment"),
        ("Pier frequency", calculation.pier.frequency, "frequency"),
    ):
        assert words_of(str(printed(value, quantity, system))) in by_label[label]
    assert by_label["Band, 5 to 95 %"].startswith(words_of(printed(low, "force", system).number))
    assert "static reaction" in by_label["Largest moment"]
    hand = printed(calculation.short.reaction, "force", system)
    assert words_of(f"by hand {hand}, {rounded(calculation.ratio, 3)} times") in words_of(text)
    assert {name for name in ("shear", "moment") if f"Utilisation in {name}" in by_label} == set(
        verdicts
    )
    for name, verdict in verdicts.items():
        ratio = rounded(calculation.utilisations[name], 3)
        assert by_label[f"Utilisation in {name}"].startswith(f"{ratio} {verdict}")
    warnings = warnings_of(calculation)
    assert warnings
    assert all(words_of(warning) in words_of(text) for warning in warnings)


def test_json_is_the_results_in_si_units(tmp_path, capsys):
    paths = [write_case(tmp_path / "a.yaml"), write_case(tmp_path / "b.yaml", speed="30 mph")]
    assert cli.main(["check", "--json", str(tmp_path)]) == 0
    found = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [one.pop("case") for one in found] == paths
    for path, one in zip(paths, found, strict=True):
        assert list(one) == [*Results.model_fields, "resistance"]
        assert one["sheet_units"] == calculate(read_case_file(path).case).case.inputs.units
        assert Results(**one) == Results.of(calculate(read_case_file(path).case))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.yaml", "b.yaml"]


def test_json_has_a_line_for_a_bad_case_too(tmp_path, capsys):
    good, bad = write_case(tmp_path / "a.yaml"), write_case(tmp_path / "b.yaml", speed="55 mp")
    assert cli.main(["check", "--json", str(tmp_path)]) == 2
    printed = capsys.readouterr()
    found = [json.loads(line) for line in printed.out.splitlines()]
    assert [one["case"] for one in found] == [good, bad]
    assert printed.err == f"pierimpact: {found[1]['error']}\n"


def test_several_cases_and_exit_codes(tmp_path, capsys, monkeypatch):
    good = write_case(tmp_path / "good" / "P1.yaml")  # whose column does not hold
    bad = write_case(tmp_path / "bad" / "P1.yaml", speed="55 mp")
    assert cli.main(["check", good]) == 0
    alone = capsys.readouterr()
    assert alone.err == ""
    assert cli.main(["check", bad, good]) == 2
    both = capsys.readouterr()
    assert both.out == alone.out
    assert both.err.startswith(f"pierimpact: {bad}: speed must be a speed")
    assert cli.main(["check", str(tmp_path / "nowhere.yaml")]) == 2
    assert cli.main(["check", str(tmp_path)]) == 2  # a folder without a case
    assert len(capsys.readouterr().err.splitlines()) == 2

    def fail(case):
        raise ZeroDivisionError("why")

    monkeypatch.setattr("pierimpact.report.calculation.calculate", fail)
    assert cli.main(["check", bad, good]) == 1
    line = capsys.readouterr().err.splitlines()[1]
    assert line.startswith(f"pierimpact: {good}: ZeroDivisionError: why; this is a defect")


def test_a_check_loads_nothing_that_draws_or_writes():
    heavy = ("scipy.stats", "scipy.special", "matplotlib", "IPython", "nbconvert", "jinja2", "tqdm")
    program = (
        f"import sys; from pierimpact import cli; cli.main(['check', '--json', {str(EXAMPLE)!r}]);"
        f"print([name for name in {heavy!r} if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=HOUSE, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines()[1] == "[]"
