"""The form without its page: what is typed, the text of the case file, errors, and fields."""

import re

import pytest
import yaml
from hypothesis import example, given, settings
from hypothesis import strategies as st

from pierimpact import cli
from pierimpact.checks import InputError
from pierimpact.files.case import SHAPES, read_case_file, section_keys
from pierimpact.files.edit_case import LINES, edited, typed_in, written_anew
from pierimpact.files.inputs import KEYS, faults, read_inputs
from pierimpact.files.new_case import EXAMPLE, examples, new_case
from pierimpact.files.yaml_keys import yaml_keys
from pierimpact.units import SYSTEMS

pytest.importorskip("anywidget")
from pierimpact.app.form import GROUPS, fields
from pierimpact.app.launch import open_form
from pierimpact.app.session import MOST_BESIDE, Session

CASE = yaml_keys(new_case())
TEXT = st.text(st.characters(blacklist_categories=("C", "Z")) | st.just(" "), min_size=1)
ONE_LINE = TEXT.map(str.strip).filter(lambda text: text not in ("", "—"))
# Keys whose value is one text, whatever it says.
SINGLE = [key for key in KEYS if key not in (*LINES, "annexes", "traffic_trucks")]


@given(st.dictionaries(st.sampled_from(SINGLE), ONE_LINE, max_size=2), st.sampled_from(SYSTEMS))
@example({"speed": "24'-6\"", "job_number": "012", "project": "A: b # c"}, "US")
@example({"date": "2026-01-31", "revision": "1", "office": "yes", "speed": "[1"}, "SI")
@settings(max_examples=12, deadline=None)
def test_what_is_typed_is_what_the_file_says_and_all_else_stays(changes, system):
    text = new_case(system=system)
    wanted = typed_in(text) | changes
    new = edited(text, wanted)
    assert typed_in(new) == wanted
    assert typed_in(written_anew(wanted)) == wanted
    untouched = [
        line
        for line in text.splitlines()
        if not any(re.match(rf"(# )?{key}:", line) for key in changes)
    ]
    assert [line for line in new.splitlines() if line in untouched] == untouched


@given(st.sets(st.sampled_from(sorted(typed_in(new_case())))))
@settings(max_examples=5, deadline=None)
def test_what_is_emptied_is_left_out_and_can_be_typed_again(emptied):
    text = new_case()
    before = typed_in(text)
    without = edited(text, before | dict.fromkeys(emptied, ""))
    assert typed_in(without) == {key: each for key, each in before.items() if key not in emptied}
    assert typed_in(edited(without, before)) == before


def test_an_unchanged_file_is_the_same_to_the_byte():
    text = "speed:   80 km/h\r\n# said by Ann\r\nnotes: ['a: b', c]\r\nlogo: ~\r\n"
    assert edited(text, typed_in(text)) == text
    assert edited(text, {"logo": "", "speed": "80 km/h"}) == text


@pytest.mark.parametrize(
    ("key", "typed", "value"),
    [
        ("notes", "one\ntwo: and more", ["one", "two: and more"]),
        ("sources", "speed: sign: 80\ndensity: usual", {"speed": "sign: 80", "density": "usual"}),
        ("steps", "height: 2 m, column_shape: free", [{"height": "2 m", "column_shape": "free"}]),
        ("annexes", "procedure, codes", ["procedure", "codes"]),
        ("annexes", "all", "all"),
        ("job_number", "012", "012"),
        ("revision", "1", "1"),
        ("damping_ratio", "0.03", 0.03),
        ("column_sides", "8", 8),
    ],
)
def test_values_have_the_types_that_the_reader_wants(key, typed, value):
    for text in ("truck: a\n", f"truck: a\n{key}: [x, y]\nspeed: 1 m/s\n", new_case()):
        new = edited(text, {key: typed})
        assert yaml.safe_load(new)[key] == value
        assert typed_in(new)[key] == typed
    assert yaml.safe_load(written_anew({key: typed}))[key] == value


def test_a_block_stays_a_block():
    text = "notes:  # of the office\n  - a\n  - b\n# the truck\ntruck: c\n"
    new = edited(text, {"notes": "a\nd\ne", "truck": "c"})
    assert new == "notes:  # of the office\n  - a\n  - d\n  - e\n# the truck\ntruck: c\n"
    assert edited(new, {"notes": ""}) == "notes:  # of the office\n# the truck\ntruck: c\n"


def test_every_key_has_one_field_with_a_label_and_an_example():
    keys = [key for shown, more in GROUPS.values() for key in (*shown, *more)]
    assert sorted(keys) == sorted(KEYS)
    form = fields()
    for key, field in form["fields"].items():
        assert field["label"].replace(" ", "_").lower() == key
        assert field["choices"] or all(field["examples"].values()), key
        assert "in quotes" not in field["help"]


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("shape", SHAPES)
def test_the_examples_of_a_shape_are_a_case(shape, system, tmp_path):
    session = Session()
    typed = typed_in(new_case(system=system)) | {"column_diameter": "", "column_shape": shape}
    own = {key: examples(shape, system)[key] for key in section_keys(SHAPES[shape])}
    session.change("b.yaml", typed | own)
    (tmp_path / "b.yaml").write_text(session.text, encoding="utf-8")
    assert read_case_file(tmp_path / "b.yaml").case.inputs.column_shape == shape
    session.close()


def test_all_faults_are_said_and_the_first_is_the_readers():
    values = CASE | {"speeed": 1, "speed": "fast", "density": 3, "base": "loose"}
    found = faults(values)
    assert found.keys() == {"speeed", "speed", "density", "base"}
    with pytest.raises(InputError) as error:
        read_inputs(values)
    assert str(error.value) == found["speeed"]
    del values["speeed"]
    with pytest.raises(InputError) as error:
        read_inputs(values)
    assert str(error.value) in found.values()
    assert faults(CASE) == {}


@pytest.fixture
def session(tmp_path):
    (tmp_path / "mine.yaml").write_text(new_case(), encoding="utf-8")
    (tmp_path / "old.yaml").write_text(new_case(), encoding="utf-8")
    session = Session(tmp_path / "mine.yaml")
    yield session
    session.close()
    assert not session.folder.exists()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine.yaml", "old.yaml"]
    assert (tmp_path / "old.yaml").read_text(encoding="utf-8") == new_case()


def changed(session, **typed):
    session.change(session.name, typed_in(session.text) | typed)
    return session.answer()


@pytest.mark.parametrize(
    ("typed", "key", "said"),
    [
        ({"speed": "fast"}, "speed", "must be a speed, a number with a unit"),
        ({"column_height": "3"}, "column_height", "must have a unit"),
        ({"truck": "none.toml"}, "truck", "none.toml"),
        ({"base": "free"}, "base", "mechanism"),
        ({"column_shape": "rectangular", "column_diameter": ""}, "column_width", "is missing"),
        ({"elastic_modulus": "30 GPa"}, "elastic_modulus", "give one of"),
        ({"supersedes": "mine.yaml"}, "supersedes", "this one"),
        ({"sources": "nonsense"}, "sources", "") ,
        ({"steps": "2 m"}, "steps", "is not a key of a step"),
        ({"impact_height": "6 m"}, "impact_height", "impact_height"),
        ({"column_height": ""}, "column_height", "is missing"),
    ],
)  # fmt: skip
def test_an_error_is_beside_its_field(session, typed, key, said):
    answer = changed(session, **typed)
    assert said in answer["errors"][key]
    assert (answer["result"], answer["general"]) == (None, [])
    for line in answer["errors"].values():
        assert "\n" not in line
        assert "mine.yaml: " not in line


def test_the_answer_is_that_of_the_case_file(session, tmp_path):
    answer = changed(session, shear_resistance="1 MN", supersedes="old.yaml", speed="50 mph")
    assert answer["errors"] == {}
    result = answer["result"]
    assert result["kind"] == "exceeds"
    assert result["svg"].lstrip().startswith("<?xml")
    assert f"speed: {EXAMPLE}" not in answer["typed"]["assumed"]
    assert f"density: {EXAMPLE}" in answer["typed"]["assumed"]
    session.name = "old.yaml"  # what is beside it comes back
    session.answer()
    session.name = "mine.yaml"
    assert session.answer()["result"] == result


def test_keys_of_an_opened_file_that_are_none_are_errors(session):
    session.open("b.yaml", f"speeed: 1\n7: a\n{new_case()}".encode())
    answer = session.answer()
    assert "did you mean speed?" in answer["errors"]["speeed"]
    assert answer["errors"].keys() == {"speeed", "7"}
    answer = changed(session, speeed="", **{"7": ""})
    assert answer["errors"] == {}
    assert answer["result"]
    assert session.text == new_case()


@pytest.mark.parametrize("content", [b"\xff", b"a: [", b"", b"- 1", b"a: 1\na: 2", b"#" * 65_000])
def test_what_is_no_case_file_is_refused_and_the_case_is_kept(session, content):
    before = session.name, session.text
    with pytest.raises(InputError, match=r"^b\.yaml: [^\n]+$"):
        session.open("b.yaml", content)
    assert (session.name, session.text) == before


@pytest.mark.parametrize("name", ["../x.yaml", "a/b.yaml", "", ".yaml", "a\0.yaml", "a.txt", ".."])
def test_a_name_that_is_none_is_refused(session, name):
    with pytest.raises(InputError, match="file name must"):
        session.change(name, {})
    assert session.name == "mine.yaml"


def test_files_can_be_put_beside_the_case(session):
    assert changed(session, truck="mine.toml")["errors"]["truck"] == (
        "truck file mine.toml cannot be read: No such file or directory; "
        "Add file… puts it beside the case"
    )
    session.add("mine.toml", b"x = 1")
    assert "mine.toml" in changed(session, truck="mine.toml")["errors"]["truck"]
    session.add("pierimpact.toml", b"nonsense = 1")
    assert "pierimpact.toml" in changed(session, truck="single-unit-8t")["general"][0]
    session.add("pierimpact.toml", b"office = 'Ours'")
    assert session.answer()["result"]
    for name, content in (
        ("mine.yaml", b""),
        ("../a.toml", b""),
        ("a.png", bytes(MOST_BESIDE + 1)),
    ):
        with pytest.raises(InputError):
            session.add(name, content)


def test_a_case_that_cannot_be_read_ends_the_command(tmp_path, capsys):
    (tmp_path / "a.yaml").write_text("a: [", encoding="utf-8")
    for name in ("a.yaml", "none.yaml"):
        assert cli.main(["app", str(tmp_path / name)]) == 2
        assert name in capsys.readouterr().err
    with pytest.raises(InputError):
        open_form(tmp_path)
