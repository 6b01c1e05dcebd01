"""`pierimpact new`: a case file that runs as it stands, and with every optional key of it."""

import re
from pathlib import Path

import pytest
import yaml
from test_office import PNG

from pierimpact import cli
from pierimpact.checks import InputError
from pierimpact.files.case import SHAPES, read_case_file, section_keys
from pierimpact.files.inputs import KEYS, PHYSICAL_KEYS
from pierimpact.files.keys import explanation, quantity_of
from pierimpact.files.new_case import SCHEMA_FILE, new_case
from pierimpact.files.plausible import unusual
from pierimpact.report.calculation import calculate
from pierimpact.report.warnings import warnings_of
from pierimpact.units import SYSTEMS, parse

KEY = re.compile(r"^(# )?([a-z_]+):", re.MULTILINE)
# What stands in the place of another key.
INSTEAD = {"elastic_modulus": "concrete_strength"}


def read(folder, text):
    path = folder / "case.yaml"
    path.write_text(text, encoding="utf-8")
    return read_case_file(path).case


def keys_of(text, mark):
    return [key for hash_, key in KEY.findall(text) if bool(hash_) == mark]


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("shape", SHAPES)
def test_it_runs_as_it_stands_and_says_that_it_is_an_example(tmp_path, shape, system):
    text = new_case(shape=shape, system=system)
    case = read(tmp_path, text)
    assert (case.inputs.column_shape, case.inputs.units) == (shape, system)
    assert not list(unusual(case.inputs))
    assert set(case.inputs.assumed) == set(case.given) & set(PHYSICAL_KEYS)
    assert set(section_keys(SHAPES[shape])) < set(case.given)
    assert max(map(len, text.splitlines())) <= 100


def test_the_sheet_warns_of_a_template_that_is_not_filled_in(tmp_path):
    case = read(
        tmp_path, new_case().replace("impact_height:", "member_forces: static\nimpact_height:", 1)
    )
    (warning,) = (line for line in warnings_of(calculate(case)) if line.startswith("Assumed"))
    assert "speed at first touch" in warning


def test_every_key_is_in_it_once_with_its_comment():
    of_all_shapes = set()
    for shape in SHAPES:
        text = new_case(shape=shape)
        keys = [key for _, key in KEY.findall(text)]
        assert len(keys) == len(set(keys))
        of_all_shapes |= set(keys)
        words = re.sub(r"\s+(# )?", " ", text)
        assert [key for key in keys if re.sub(r"\s+", " ", explanation(key)) not in words] == []
    assert of_all_shapes == set(KEYS)


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("shape", ["circular", "hollow rectangular", "free"])
def test_every_optional_key_can_be_taken_up(tmp_path, shape, system):
    text = new_case(shape=shape, system=system)
    (tmp_path / "logo.png").write_bytes(PNG)
    (tmp_path / "case-0.yaml").write_text(text, encoding="utf-8")
    optional = keys_of(text, mark=True)
    assert "embedment" in optional
    for key in optional:
        changed = text.replace(f"\n# {key}:", f"\n{key}:")
        if key in INSTEAD:
            changed = re.sub(rf"^( *){INSTEAD[key]}:", r"\1# :", changed, flags=re.MULTILINE)
        inputs = read(tmp_path, changed).inputs
        assert getattr(inputs, key)
        assert not list(unusual(inputs))


@pytest.mark.parametrize("shape", SHAPES)
def test_both_systems_have_about_the_same_values(shape):
    si, us = (
        yaml.safe_load(re.sub(r"^# (?=[a-z_]+:)", "", new_case(shape=shape, system=s), flags=re.M))
        for s in SYSTEMS
    )
    assert list(si) == list(us)
    for key in filter(quantity_of, si):
        one, other = (parse(key, values[key], quantity_of(key)) for values in (si, us))
        assert one == pytest.approx(other, rel=0.12)


def test_the_command_keeps_what_is_there(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = Path("P1.yaml")
    assert cli.main(["new", "P1.yaml", "--shape", "oblong", "--units", "US"]) == 0
    assert capsys.readouterr().out == "P1.yaml\n"
    assert path.read_text("utf-8") == new_case("P1.yaml", "oblong", "US")
    assert cli.main(["new", "P1.yaml"]) == 2
    assert capsys.readouterr().err == (
        "pierimpact: P1.yaml is there already: give --force to replace it\n"
    )
    assert path.read_text("utf-8") == new_case("P1.yaml", "oblong", "US")
    assert cli.main(["new", "P1.yaml", "--force"]) == 0
    assert path.read_text("utf-8") == new_case("P1.yaml")
    assert list(tmp_path.iterdir()) == [tmp_path / "P1.yaml"]


def test_editors_find_the_schema_where_it_is_beside_the_case(tmp_path):
    path, line = tmp_path / "P1.yaml", f"# yaml-language-server: $schema={SCHEMA_FILE}\n"
    assert cli.main(["new", str(path)]) == 0
    assert "yaml-language-server" not in path.read_text("utf-8")
    (tmp_path / SCHEMA_FILE).write_text("{}", encoding="utf-8")
    assert cli.main(["new", str(path), "--force"]) == 0
    assert path.read_text("utf-8") == line + new_case("P1.yaml")
    assert read_case_file(path).case.inputs.column_shape == "circular"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["no/folder.yaml"], "no/folder.yaml cannot be written to: there is no folder no"),
        (["a.yaml", "--shape", "round"], "shape must be one of circular, rectangular, "),
        ([".", "--force"], ". is a folder: name a file in it"),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(tmp_path, monkeypatch, capsys, arguments, words):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["new", *arguments]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"pierimpact: {words}")
    assert len(printed.err.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_cannot_be_finished_leaves_the_one_before(tmp_path, monkeypatch, capsys):
    path = tmp_path / "P1.yaml"
    path.write_text("mine", encoding="utf-8")

    def full(file, content):
        file.touch()
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    assert cli.main(["new", str(path), "--force"]) == 2
    assert "No space left on device" in capsys.readouterr().err
    assert path.read_text("utf-8") == "mine"
    assert list(tmp_path.iterdir()) == [path]


def test_a_name_that_would_break_its_line_is_refused():
    with pytest.raises(InputError, match=r"^name must be one line"):
        new_case("a\nb.yaml")
