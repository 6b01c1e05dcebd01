"""What an office adds to its cases: shared values, logo, revisions, annexes, the case before."""

import base64
import datetime
import hashlib
import re

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from sheet_page import US_CASE

from pierimpact.checks import InputError
from pierimpact.files.case import case_from, case_from_notebook, read_case_file
from pierimpact.files.inputs import ANNEXES, SharedInputs
from pierimpact.files.new_case import new_case
from pierimpact.files.office import SHARED_FILE, read_logo
from pierimpact.report.calculation import calculate
from pierimpact.report.warnings import warnings_of

# One white pixel.
PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAWk1v8QAAAABJRU5ErkJggg=="
)
JPEG = b"\xff\xd8\xff\xe0" + bytes(20) + b"\xff\xd9"
SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 2 1"><path d="M0 0h2v1z"/></svg>'
DOCTYPE = (
    b'<?xml version="1.0"?><!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" '
    b'"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
)
ENTITY = b'<!DOCTYPE svg [<!ENTITY a "aaaa">]>'
CASE = {key: value for key, value in US_CASE.items() if key != "units"}
TABLE = """\
office = "Bridges & Sons"
project = "All our bridges"
prepared_by = "A. B."
checked_by = "C. D."
approved_by = "E. F."
units = "US"
logo = "logo.png"
"""


def write_case(folder, name="case.yaml", **values):
    path = folder / name
    path.write_text(yaml.safe_dump(CASE | values, allow_unicode=True), encoding="utf-8")
    return path


def one_line_of(path):
    with pytest.raises(InputError) as caught:
        read_case_file(path)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_shared_values_stand_for_what_the_case_does_not_give(tmp_path):
    (tmp_path / "logo.png").write_bytes(PNG)
    (tmp_path / SHARED_FILE).write_bytes(b"\xef\xbb\xbf" + TABLE.encode())
    case_file = read_case_file(write_case(tmp_path, project="This bridge", checked_by=None))
    inputs = case_file.case.inputs
    assert (inputs.office, inputs.project) == ("Bridges & Sons", "This bridge")
    assert (inputs.prepared_by, inputs.checked_by, inputs.approved_by) == (
        "A. B.",
        "C. D.",
        "E. F.",
    )
    assert inputs.units == "US"
    assert case_file.case.logo.content == PNG
    sha256 = hashlib.sha256((tmp_path / SHARED_FILE).read_bytes()).hexdigest()
    assert case_file.case.shared_sha256 == sha256


def test_the_notebook_has_the_shared_values(tmp_path, monkeypatch):
    (tmp_path / "logo.png").write_bytes(PNG)
    (tmp_path / SHARED_FILE).write_text(TABLE, encoding="utf-8")
    case_file = read_case_file(write_case(tmp_path, project="This bridge"))
    monkeypatch.chdir(tmp_path)
    assert case_from_notebook(case_file.parameters) == case_file.case
    (tmp_path / SHARED_FILE).unlink()
    with pytest.raises(InputError, match=r"case_file .* has other values than the notebook"):
        case_from_notebook(case_file.parameters)


def test_a_folder_without_shared_values_has_none(tmp_path):
    write_case(tmp_path)
    (tmp_path / "below").mkdir()
    (tmp_path / SHARED_FILE).write_text(TABLE.replace('logo = "logo.png"', ""), encoding="utf-8")
    case = read_case_file(write_case(tmp_path / "below")).case  # the same folder only
    assert (case.inputs.office, case.logo, case.shared_sha256) == ("—", None, None)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ('ofice = "x"', "'ofice' is not a key of pierimpact.toml (office, logo, "),
        ('speed = "80 km/h"', "'speed' is not a key of pierimpact.toml"),
        ("project = 7", "project must be text (in quotes if it is a number), got 7"),
        ('units = "metric"', "units must be 'SI' or 'US', got 'metric'"),
        ('logo = "none.png"', "logo 'none.png' cannot be read: No such file"),
        ("office = Bridges", "is not valid TOML: Invalid value (at line 1"),
        ("office = '\xff'", "is not UTF-8 text"),
        ("#" * 70_000, "must be at most 64 kB"),
        ("a = " + "[" * 30_000, "is not valid TOML"),
        ("[office]\nname = 'x'", "office must be text"),
    ],
)
def test_a_bad_shared_file_is_one_line(tmp_path, table, message):
    (tmp_path / SHARED_FILE).write_bytes(table.encode("latin-1"))
    found = one_line_of(write_case(tmp_path))
    assert found.startswith(f"case.yaml: {SHARED_FILE}: {message}")


def test_only_words_and_units_can_be_shared():
    assert set(SharedInputs.model_fields) == {
        *("office", "logo", "project", "job_number", "units"),
        *("prepared_by", "checked_by", "approved_by"),
    }


@pytest.mark.parametrize(
    ("content", "mime"),
    [
        (PNG, "image/png"),
        (JPEG, "image/jpeg"),
        (SVG, "image/svg+xml"),
        (DOCTYPE + SVG, "image/svg+xml"),
        (SVG.decode().encode("utf-16"), "image/svg+xml"),
    ],
)
def test_the_kind_of_a_logo_is_that_of_its_content(tmp_path, content, mime):
    (tmp_path / "logo").write_bytes(content)
    assert read_logo("logo", tmp_path) == (content, mime)
    case = case_from(CASE | {"logo": "logo"}, tmp_path)
    assert (case.logo.content, case.logo.mime) == (content, mime)


def svg_with(inside):
    return SVG.replace(b"<path", inside + b"<path")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"GIF89a", "logo must be PNG, JPEG or well-formed SVG, got 'logo'"),
        (b"", "logo must be PNG, JPEG or well-formed SVG"),
        (PNG[:-8], "logo must be a whole image, got 'logo' without its end"),
        (JPEG[:-1], "logo must be a whole image"),
        (SVG[:-6], "well-formed SVG"),
        (b"<html><body/></html>", "got 'logo' which begins <html>"),
        (b"<svg/>", "which begins <svg>"),  # without its namespace nothing shows it
        (svg_with(b"<script>x</script>"), "an SVG without <script>"),
        (svg_with(b"<g><SCRIPT/></g>"), "an SVG without <SCRIPT>"),
        (svg_with(b"<foreignObject/>"), "an SVG without <foreignObject>"),
        (SVG.replace(b"<svg", b'<svg onload="x"'), "an SVG without onload=…"),
        (svg_with(b'<image href="http://a.b/c.png"/>'), "with 'http://a.b/c.png'"),
        (svg_with(b'<use href="/etc/passwd"/>'), "with '/etc/passwd'"),
        (
            svg_with(b'<a xmlns:l="http://www.w3.org/1999/xlink" l:href="javascript:x"/>'),
            "with 'javascript:x'",
        ),
        (svg_with(b"<style>@import 'http://a.b/c.css';</style>"), "with '@import'"),
        (svg_with(b"<style>path { fill: URL( 'http://a.b/c') }</style>"), "all that it shows"),
        (svg_with(b"<style>path { fill: \\75rl(http://a.b/c) }</style>"), "all that it shows"),
        (svg_with(b"<style><![CDATA[@imp]]><![CDATA[ort 'x';]]></style>"), "with '@import'"),
        (svg_with(b"<g style=\"mask: image-set('http://a.b/c' 1x)\"/>"), "all that it shows"),
        (svg_with(b'<g fill="url(//a.b/c)"/>'), "with 'url(//a.b/c)'"),
        (svg_with(b'<set attributeName="xlink:href" to="x"/>'), "whose links stay"),
        (b"<?xml-stylesheet href='http://a.b/c.css'?>" + SVG, "without <?xml-stylesheet … ?>"),
        (ENTITY + SVG, "an SVG without entities of its own"),
        ((ENTITY + SVG).decode().encode("utf-16"), "an SVG without entities"),
        (b'<?xml version="1.0" encoding="klingon"?>' + SVG, "well-formed SVG"),
        (PNG + bytes(1_000_000), "logo 'logo' must be at most 1 MB long"),
    ],
)
def test_a_bad_logo_is_one_line(tmp_path, content, message):
    (tmp_path / "logo").write_bytes(content)
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        read_logo("logo", tmp_path)
    assert "\n" not in str(caught.value)


def test_links_within_a_drawing_are_no_links_to_elsewhere(tmp_path):
    inside = b'<use href="#a"/><image href="data:image/png;base64,AAAA"/>'
    (tmp_path / "logo").write_bytes(svg_with(inside))
    assert read_logo("logo", tmp_path).mime == "image/svg+xml"


def test_a_logo_is_a_file(tmp_path):
    (tmp_path / "logos").mkdir()
    assert one_line_of(write_case(tmp_path, logo="logos")) == (
        "case.yaml: logo 'logos' cannot be read: Is a directory"
    )
    assert one_line_of(write_case(tmp_path, logo="none.svg")).startswith(
        "case.yaml: logo 'none.svg' cannot be read: No such file"
    )
    assert one_line_of(write_case(tmp_path, logo="x" * 300)).startswith("case.yaml: logo 'xxx")


@given(st.binary(max_size=60) | st.binary(max_size=20).map(lambda b: SVG[:30] + b + SVG[30:]))
def test_any_content_is_a_logo_or_a_line(tmp_path_factory, content):
    folder = tmp_path_factory.getbasetemp()
    (folder / "any").write_bytes(content)
    message = ""
    try:
        assert read_logo("any", folder).content == content
    except InputError as error:
        message = str(error)
    assert len(message.splitlines()) <= 1


def test_revisions(tmp_path, monkeypatch):
    lines = [
        {"revision": "A", "date": datetime.date(2026, 1, 31), "description": "First", "by": "X"},
        {"revision": "B", "date": "2026-02-28"},
    ]
    case_file = read_case_file(write_case(tmp_path, revisions=lines))
    first, second = case_file.case.inputs.revisions
    assert (first.revision, first.date, first.by) == ("A", datetime.date(2026, 1, 31), "X")
    assert (second.date, second.description) == (datetime.date(2026, 2, 28), "—")
    assert case_file.parameters["revisions"][0]["date"] == "2026-01-31"
    monkeypatch.chdir(tmp_path)
    assert case_from_notebook(case_file.parameters).inputs == case_file.case.inputs


LINE = {"revision": "A", "date": "2026-01-31"}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"revisions": "A"}, "revisions must be a list of revisions with revision, date, descript"),
        ({"revisions": [LINE, "B"]}, "revisions must be a list of revisions with"),
        ({"revisions": [LINE | {"date": "soon"}]}, "revisions[1].date must be a date such as 2026"),
        ({"revisions": [LINE, {"revision": "B"}]}, "revisions[2].date is missing"),
        ({"revisions": [LINE | {"revision": 2}]}, "revisions[1].revision must be text (in quotes"),
        ({"revisions": [LINE | {"name": "x"}]}, "'name' is not a key of a revision"),
        ({"revisions": [LINE | {"descripton": "x"}]}, "did you mean description?"),
        ({"revisions": [LINE] * 9}, "revisions must be at most 8, got 9"),
        ({"annexes": "pier"}, "annexes must be all or a list (pier, procedure, truck, codes, sens"),
        ({"annexes": ["pir"]}, "'pir' is not an annex (pier, procedure, truck, codes, sensitivity"),
        ({"annexes": ["provenence"]}, "did you mean provenance?"),
        ({"annexes": [["pier"]]}, "['pier'] is not an annex"),
        ({"annexes": 1}, "annexes must be all or a list"),
        ({"approved_by": 1}, "approved_by must be text"),
        ({"supersedes": 1}, "supersedes must be text"),
        ({"supersedes": "none.yaml"}, "supersedes none.yaml: cannot be read: No such file"),
    ],
)
def test_a_bad_value_is_one_line(change, message):
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        case_from(CASE | change)
    assert "\n" not in str(caught.value)


@given(st.lists(st.sampled_from(ANNEXES)))
def test_annexes_are_in_the_order_of_the_sheet(names):
    found = case_from(CASE | {"annexes": names}).inputs.annexes
    assert set(found) == set(names)
    assert list(found) == sorted(found, key=ANNEXES.index)


def test_all_annexes_or_none():
    assert case_from(CASE | {"annexes": "all"}).inputs.annexes == ANNEXES
    assert case_from(CASE).inputs.annexes == ()


def test_the_case_before(tmp_path, monkeypatch):
    (tmp_path / "old").mkdir()
    before = write_case(tmp_path / "old", "a.yaml", speed="50 mph", supersedes="none.yaml")
    case_file = read_case_file(write_case(tmp_path, supersedes="old/a.yaml"))
    superseded = case_file.case.superseded_file.case
    assert superseded.given["speed"] == "50 mph"
    assert superseded.superseded_file is None  # one level is read
    assert case_file.case.superseded_file.name == "a.yaml"
    assert case_file.case.superseded_file.sha256 == hashlib.sha256(before.read_bytes()).hexdigest()
    monkeypatch.chdir(tmp_path)
    assert case_from_notebook(case_file.parameters) == case_file.case
    assert read_case_file(write_case(tmp_path)).case.superseded_file is None


def test_a_bad_case_before_is_one_line_with_both_files(tmp_path):
    write_case(tmp_path, "a.yaml", speed="80")
    found = one_line_of(write_case(tmp_path, "b.yaml", supersedes="a.yaml"))
    assert found.startswith("b.yaml: supersedes a.yaml: speed must have a unit")
    found = one_line_of(write_case(tmp_path, "b.yaml", supersedes="./b.yaml"))
    assert (
        found == "b.yaml: supersedes must be an earlier case file, got ./b.yaml, which is this one"
    )
    (tmp_path / "folder").mkdir()
    found = one_line_of(write_case(tmp_path, "b.yaml", supersedes="folder"))
    assert found == "b.yaml: supersedes folder: cannot be read: Is a directory"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, []),
        ({"revision": "A"}, ["a.yaml, which this case supersedes, is of revision A, too."]),
        ({"element": "Pier 2"}, ["a.yaml, which this case supersedes, is of another element: P1."]),
        ({"revision": "C"}, ["The table of revisions has no line for revision C, of which it is."]),
    ],
)
def test_revisions_that_do_not_go_together_are_named(tmp_path, changes, words):
    common = {"element": "P1", "revision": "A"}
    write_case(tmp_path, "a.yaml", **common)
    table = [LINE | {"revision": letter} for letter in "AB"]
    values = common | {"revision": "B", "supersedes": "a.yaml", "revisions": table} | changes
    found = warnings_of(calculate(read_case_file(write_case(tmp_path, "b.yaml", **values)).case))
    assert [text for text in found if "revision" in text or "supersedes" in text] == words


def test_an_office_shares_its_job_number(tmp_path):
    (tmp_path / "pierimpact.toml").write_text('job_number = "24-117"\n', "utf-8")
    assert read_case_file(write_case(tmp_path)).case.inputs.job_number == "24-117"
    (tmp_path / "pierimpact.toml").write_text("date = 2026-01-31\n", "utf-8")
    found = one_line_of(tmp_path / "case.yaml")
    assert found.endswith(
        "is not a key of pierimpact.toml (" + ", ".join(SharedInputs.model_fields) + ")"
    )


def test_a_new_case_leaves_to_the_office_what_it_may_share():
    given = yaml.safe_load(new_case(system="US"))
    assert set(given) & set(SharedInputs.model_fields) == {"units"}
