"""Many cases at once: a report each, their summary, and what is said of those that fail."""

import contextlib
import csv
import datetime
import html
import io
import os
import random
import re
import signal
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path
from urllib.parse import unquote

import pypdf
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pierimpact import cli
from pierimpact.checks import InputError
from pierimpact.design.codes import KIP
from pierimpact.files.case import read_case_file
from pierimpact.files.unchanged import RECORD, put_unchanged, write_unchanged
from pierimpact.files.write import temporary_folder
from pierimpact.report import batch as batch_module
from pierimpact.report.batch import find_cases, write_reports
from pierimpact.report.calculation import calculate
from pierimpact.report.document.blocks import Headline
from pierimpact.report.results import Results
from pierimpact.report.summary import Row, no_formula, summary_blocks, summary_csv
from pierimpact.report.write import OutputError, Report, ReportError, stages
from pierimpact.units import QUANTITIES, parse, printed, rounded

ROOT = Path(__file__).parent.parent
EXAMPLE = (ROOT / "notebooks" / "tti-column.yaml").read_text("utf-8") + "date: 2026-02-03\n"


def write_case(path, **changes):
    """Write the example to a file, with other values, and return the file."""
    text = EXAMPLE
    for key, value in changes.items():
        text = re.sub(rf"^{key}: .*\n", "", text, flags=re.MULTILINE) + f"{key}: {value}\n"
    path.write_text(text, encoding="utf-8")
    return path


def calculated(path):
    return calculate(read_case_file(path).case)


def results_of(path):
    return Results.of(calculated(path))


def page_of(rows):
    """Return the summary of rows as a page."""
    return "".join(block._repr_html_() for block in summary_blocks(rows))


@pytest.fixture(scope="module")
def tti_results(tmp_path_factory):
    return results_of(write_case(tmp_path_factory.mktemp("tti") / "tti.yaml"))


class Bar:
    """Stands in for the progress bar."""

    def __init__(self, **options):
        self.total, self.updates = options["total"], []

    def __enter__(self):
        return self

    def __exit__(self, *error):
        pass

    def update(self, count=1):
        self.updates.append(count)

    def set_description(self, words):
        self.words = words


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Two good cases, one of them odd, and three bad ones, from two folders."""
    root = tmp_path_factory.mktemp("batch")
    folder, other = root / "cases", root / "other"
    folder.mkdir()
    other.mkdir()
    write_case(folder / "P 1 & <b>.yaml", shear_resistance="2.5 MN", moment_resistance="9 MN*m")
    write_case(folder / "P3.yaml", sped="80 km/h")
    (folder / "P4.yml").write_bytes(b"\xff")
    (folder / "P5.yaml").symlink_to("nowhere")
    write_case(other / "A.yaml", project="'=1+1'", element="'@x;-y'", speed="20 km/h")
    bars = []

    def bar(**options):
        bars.append(Bar(**options))
        return bars[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(batch_module, "tqdm", bar)
        cases = find_cases([folder, other / "A.yaml"])
        result = write_reports(cases, root / "out", binder=True)
    return cases, result, root / "out", bars[0]


def rows_of(page):
    """Return the rows of the tables of a page as lists of texts."""
    return [
        [
            html.unescape(re.sub("<[^>]+>", "", cell)).rstrip("\u2007\u2008")
            for cell in re.findall(r"<t[hd].*?</t[hd]>", row, re.DOTALL)
        ]
        for row in re.findall(r"<tr.*?</tr>", page, re.DOTALL)
    ]


def test_a_folder_stands_for_its_cases_in_the_order_of_their_names(tmp_path):
    for name in ("b.yaml", "a.yml", "C.YAML", ".hidden.yaml", "notes.txt", "truck.toml"):
        (tmp_path / name).touch()
    (tmp_path / "below").mkdir()
    (tmp_path / "below" / "d.yaml").touch()
    found = find_cases([tmp_path / "b.yaml", tmp_path, "nowhere.yaml", tmp_path / "." / "a.yml"])
    expected = [tmp_path / name for name in ("b.yaml", "C.YAML", "a.yml")]
    assert found == [*expected, Path("nowhere.yaml")]


@pytest.mark.parametrize("files", [[], ["notes.txt"]])
def test_a_folder_without_case(tmp_path, capsys, files):
    folder = tmp_path / "folder"
    folder.mkdir()
    for name in files:
        (folder / name).touch()
    good = write_case(tmp_path / "good.yaml")
    output = tmp_path / "out"
    assert cli.main(["report", str(good), str(folder), "--output", str(output)]) == 2
    printed_lines = capsys.readouterr()
    assert printed_lines.out == ""
    assert printed_lines.err == (
        f"pierimpact: {folder}: no case in this folder, no *.yaml and no *.yml\n"
    )
    assert not output.exists()


@pytest.mark.parametrize(
    ("first", "second", "message"),
    [
        ("a/P1.yaml", "b/P1.yaml", "{} and {} would write files of the same name"),
        ("a/P1.yaml", "a/P1.yml", "{} and {} would write files of the same name"),
        ("a/P1.yaml", "b/p1.yaml", "{} and {} would write files of the same name"),
        ("a/P1.failed.yaml", "b/P1.yaml", "{} and {} would write files of the same name"),
        ("a/P1.yaml", "b/Summary.yaml", "{1} would overwrite the summary of the cases"),
    ],
)
def test_no_case_overwrites_another(tmp_path, first, second, message):
    paths = [tmp_path / first, tmp_path / second]
    with pytest.raises(InputError, match=re.escape(message.format(*paths))):
        find_cases(paths)
    assert find_cases(paths[1:]) == paths[1:]


def test_each_good_case_has_its_report_and_all_a_summary(made):
    cases, result, output, _ = made
    names = ["P 1 & <b>", "A"]
    assert [report.pdf.stem for report in result.reports] == names
    expected = {f"{name}.{ending}" for name in names for ending in ("ipynb", "html", "pdf")}
    expected |= {f"summary.{ending}" for ending in ("html", "pdf", "csv")} | {"binder.pdf", RECORD}
    assert {path.name for path in output.iterdir()} == expected
    assert set(result.summary) - {None} == {
        output / f"summary.{end}" for end in ("html", "pdf", "csv")
    }
    assert len(cases) == 5


def test_the_binder_has_contents_summary_and_every_sheet(made):
    _, result, output, _ = made
    bound = pypdf.PdfReader(result.binder)
    documents = [result.summary.pdf, *(report.pdf for report in result.reports)]
    pages = [len(pypdf.PdfReader(document).pages) for document in documents]
    assert len(bound.pages) == 1 + sum(pages)
    titles = [each["/Title"] for each in bound.outline if not isinstance(each, list)]
    assert titles == [
        "Contents",
        "Summary (all)",
        "Round column, 36 in (P 1 & <b>)",
        "@x;-y (A)",
    ]
    contents = bound.pages[0].extract_text()
    for failure in result.failures:
        assert failure.reason in contents
    assert result.binder == output / "binder.pdf"


def test_each_bad_case_has_one_line_that_says_why(made):
    reasons = [failure.reason for failure in made[1].failures]
    assert all(failure.bad_input for failure in made[1].failures)
    assert reasons == [
        "P3.yaml: 'sped' is not a key of a case file; did you mean speed?",
        "P4.yml: is not UTF-8 text: line 1 cannot be decoded",
        "P5.yaml: cannot be read: No such file or directory",
    ]
    page = html.unescape((made[2] / "summary.html").read_text("utf-8"))
    sheet = pypdf.PdfReader(made[2] / "summary.pdf").pages[0].extract_text()
    for reason in reasons:
        assert reason in page
        assert reason in sheet


def test_the_progress_bar_counts_every_stage_of_every_case(made):
    cases, _, _, bar = made
    assert bar.total == sum(bar.updates) == len(cases) * stages()
    # All that a good case has left at its end is nothing, and a bad one all.
    assert sorted(count for count in bar.updates if count != 1) == [0, 0, *[stages()] * 3]
    assert bar.words == "5 of 5 cases"


def test_the_summary_has_the_values_of_the_reports(made):
    cases, result, output, _ = made
    rows = rows_of((output / "summary.html").read_text("utf-8"))
    sheet = "".join(page.extract_text() for page in pypdf.PdfReader(output / "summary.pdf").pages)
    for report, case in zip(result.reports, (cases[0], cases[-1]), strict=True):
        outcome = calculated(case)
        history = outcome.history
        cargo = history.cargo_peak
        of_the_report = html.unescape(report.html.read_text("utf-8"))
        results, peaks = (row for row in rows if row[0] == report.html.stem and len(row) > 2)
        results, peaks = results[2:], peaks[-4:]
        low, _, high = outcome.band.quantiles()
        shear, moment = (outcome.demands[name] for name in ("shear", "moment"))
        in_report = [printed(outcome.design_force, "force", "SI").number]
        assert results[3] == in_report[0]
        assert results[4] == "–".join(rounded(end / 1e3, 4) for end in (low, high))
        for shown, demand, quantity in (
            (results[5:7], shear, "force"),
            (results[7:9], moment, "moment"),
        ):
            in_report.append(printed(demand.value, quantity, "SI").number)
            assert shown == [in_report[-1], demand.method]
        ratio = rounded(outcome.average_forces[0.025].force / (600.0 * KIP), 3)
        assert results[9] == ratio
        in_report += [
            printed(outcome.pier.frequency, "frequency", "SI").number,
            printed(history.engine_peak.reaction, "force", "SI").number,
            printed(cargo.reaction, "force", "SI").number if cargo else "none",
        ]
        assert peaks == [*in_report[-3:], outcome.governs]
        for number in in_report:
            assert number in of_the_report
            assert number in sheet
        if outcome.utilisations:
            for shown in results[:2]:
                assert shown in of_the_report
            assert results[2] == "exceeded"
        else:
            assert results[:3] == ["—", "—", "—"]


def test_the_summary_leads_to_the_reports(made):
    _, result, output, _ = made
    page = (output / "summary.html").read_text("utf-8")
    targets = {output / unquote(link) for link in re.findall(r'<a href="([^"#]+)"', page)}
    assert targets == {report.html for report in result.reports}
    assert "<script" not in page
    assert "<b>" not in page


def test_the_csv_reads_back_to_four_figures(made):
    cases, result, output, _ = made
    text = (output / "summary.csv").read_bytes().decode("utf-8")
    rows = list(csv.DictReader(io.StringIO(text, newline="")))
    names = ["P 1 & <b>", "P3", "P4", "P5", "A"]
    assert [row["case"] for row in rows] == names
    assert [row["status"] for row in rows] == [
        "calculated",
        *["not calculated"] * 3,
        "calculated",
    ]
    by_name = {row["case"]: row for row in rows}
    for report, case in zip(result.reports, (cases[0], cases[-1]), strict=True):
        row, outcome = by_name[report.html.stem], calculated(case)
        cargo = outcome.history.cargo_peak
        values = {
            "truck mass [kg]": outcome.case.truck.mass,
            "speed [km/h]": outcome.case.inputs.speed * 3.6,
            "impact height [m]": outcome.struck.impact_height,
            "pier frequency [Hz]": outcome.pier.frequency,
            "engine peak [kN]": outcome.history.engine_peak.reaction / 1e3,
            "cargo peak [kN]": cargo.reaction / 1e3 if cargo else None,
            "design reaction [kN]": outcome.design_force / 1e3,
            "reaction, 5 % of trucks below [kN]": outcome.band.quantiles()[0] / 1e3,
            "reaction, 95 % of trucks below [kN]": outcome.band.quantiles()[-1] / 1e3,
            "largest shear [kN]": outcome.demands["shear"].value / 1e3,
            "largest moment [kN·m]": outcome.demands["moment"].value / 1e3,
            "code ratio": outcome.average_forces[0.025].force / (600.0 * KIP),
            "utilisation in shear": outcome.utilisations.get("shear"),
            "utilisation in moment": outcome.utilisations.get("moment"),
            "shear, 95 % of trucks below [kN]": outcome.demand_bands["shear"][1] / 1e3,
            "moment, 95 % of trucks below [kN·m]": outcome.demand_bands["moment"][1] / 1e3,
            "utilisation in shear at 95 %": outcome.upper_utilisations.get("shear"),
            "utilisation in moment at 95 %": outcome.upper_utilisations.get("moment"),
        }
        for column, value in values.items():
            found = float(row[column]) if row[column] else None
            assert found == (None if value is None else pytest.approx(value, rel=5e-4))
            assert len(row[column].replace(".", "").strip("0")) <= 4
        assert row["governs"] == outcome.governs
        assert row["shear method"] == outcome.demands["shear"].method
        assert row["moment method"] == outcome.demands["moment"].method
        assert row["warnings"] == "; ".join((*report.results.warnings, *report.warnings))
    assert by_name["A"]["project"] == "'=1+1"
    assert by_name["A"]["element"] == "'@x;'-y"
    assert by_name["P4"]["warnings"] == ""
    assert by_name["P4"]["reason"] == "P4.yml: is not UTF-8 text: line 1 cannot be decoded"
    assert by_name["P4"]["speed [km/h]"] == ""
    assert by_name["P 1 & <b>"]["resistance"] == "exceeded"


@given(st.text(alphabet="=+-@＝;, '\t\u00a0aä1\"", max_size=12))
def test_no_text_is_a_formula_to_a_spreadsheet(text):
    safe = no_formula(text)
    for field in safe.split(";"):
        assert field.strip()[:1] not in tuple("=+-@＝")
    assert re.sub(r"(^|;)'(?=\s*[=+\-@＝])", r"\1", safe) == re.sub(
        r"(^|;)'(?=\s*[=+\-@＝])", r"\1", text
    )


@given(st.floats(1.0, 1.0 + 1e-3, exclude_min=True) | st.floats(1.0 - 1e-3, 1.0))
def test_the_summary_shows_on_which_side_of_one_a_utilisation_is(tti_results, ratio):
    results = tti_results.model_copy(update={"utilisations": {"shear": ratio}})
    rows = [Row("case", results, [])]
    (row,) = csv.DictReader(io.StringIO(summary_csv(rows), newline=""))
    in_csv = float(row["utilisation in shear"])
    headline = re.search(r"largest utilisation ([\d.]+): case, in shear", page_of(rows))
    for shown in (in_csv, float(headline[1])):
        assert (shown > 1.0, shown < 1.0) == (ratio > 1.0, ratio < 1.0)
    assert in_csv == pytest.approx(ratio, abs=5e-4)


@pytest.mark.parametrize("systems", [["US", "US"], ["SI", "US"]])
def test_units_of_the_summary(tmp_path, systems):
    rows = []
    for index, system in enumerate(systems):
        case = write_case(tmp_path / f"{index}.yaml", units=system)
        rows.append(Row(case.stem, results_of(case), []))
    page = page_of(rows)
    system = "US" if systems == ["US", "US"] else "SI"
    assert ("this summary is in SI" in page) == (systems != ["US", "US"])
    reader = csv.DictReader(io.StringIO(summary_csv(rows), newline=""))
    kinds = {"force": 0, "mass": 0, "speed": 0, "length": 0}
    for row in reader:
        for column, text in row.items():
            # Of a unit of the header and a number below it, the value in SI units again.
            match = re.fullmatch(r"(truck mass|speed|impact height|.* peak) \[(.*)\]", column)
            if not match:
                continue
            kind = {"truck mass": "mass", "speed": "speed", "impact height": "length"}.get(
                match[1], "force"
            )
            unit = QUANTITIES[kind].us if system == "US" else QUANTITIES[kind].si
            assert match[2] == unit[1]
            assert f"[{match[2]}]" in page
            outcome = calculated(tmp_path / f"{row['case']}.yaml")
            value = {
                "truck mass": outcome.case.truck.mass,
                "speed": outcome.case.inputs.speed,
                "impact height": outcome.struck.impact_height,
                "engine peak": outcome.history.engine_peak.reaction,
                "cargo peak": outcome.history.cargo_peak.reaction,
            }[match[1]]
            assert parse(column, f"{text} {match[2]}", kind) == pytest.approx(value, rel=5e-4)
            kinds[kind] += 1
    assert kinds == {"force": 4, "mass": 2, "speed": 2, "length": 2}


def faked(results, **values):
    return results.model_copy(update=values)


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    return results_of(write_case(tmp_path_factory.mktemp("one") / "one.yaml"))


def ranked_in(page):
    """Return the names of the cases in the order of the table of results."""
    table = page.partition('id="tab-results"')[2].partition("</table>")[0]
    return [row[0] for row in rows_of(table)[1:]]


def test_the_worst_case_stands_first(example):
    draw = random.Random(5)
    rows = []
    for index in range(25):
        checks = draw.sample(("shear", "moment"), draw.randint(0, 2))
        values = {
            "utilisations": {check: draw.uniform(0.2, 1.8) for check in checks},
            "upper_utilisations": {},
            "code_ratio": draw.uniform(0.1, 3.0),
            "design_reaction": draw.uniform(1e6, 2e7),
        }
        rows.append(Row(f"P{index}", faked(example, **values), []))
    blocks = summary_blocks(rows)
    page = "".join(block._repr_html_() for block in blocks)
    by_name = {row.name: row.results for row in rows}
    ranked = ranked_in(page)
    assert sorted(ranked) == sorted(by_name)
    for one, other in pairwise(by_name[name] for name in ranked):
        worst, next_worst = (max(each.utilisations.values(), default=None) for each in (one, other))
        if worst is None:  # none with a resistance comes after one without
            assert next_worst is None
            assert one.code_ratio >= other.code_ratio
        elif next_worst is not None:
            assert worst >= next_worst
    exceeding = {n for n, r in by_name.items() if max(r.utilisations.values(), default=0) > 1}
    strong = re.findall(r'<tr class="strong">\s*<th[^>]*><a[^>]*>([^<]*)</a>', page)
    assert strong[: len(exceeding)] == ranked[: len(exceeding)]
    assert set(strong) == exceeding
    words = [row[4] for row in rows_of(page) if len(row) == 13 and row[0] in by_name]
    assert words.count("exceeded") == len(exceeding)
    assert words.count("—") == sum(not result.utilisations for result in by_name.values())


def headline_of(rows):
    """Return label, value and remark of each entry of the summary's headline."""
    _, headline, *_ = summary_blocks(rows)
    return re.findall(
        r'<dt>([^<]+)</dt>\s*<dd><span class="value">([^<]*)<.*?<span class="remark">([^<]*)',
        headline._repr_html_(),
    )


def test_the_summary_leads_with_how_many_are_not_as_they_should_be(example):
    rows = [
        Row("fast", faked(example, design_reaction=9e6, code_ratio=0.5), ["a letter is missing"]),
        Row("slow", faked(example, utilisations={"shear": 1.234, "moment": 1.1}), []),
        Row("bad", None, ["bad.yaml: is not UTF-8 text"]),
        Row("middle", faked(example, utilisations={"shear": 0.8}, code_ratio=2.0), []),
    ]
    assert headline_of(rows) == [
        ("Cases", "4", "3 calculated"),
        ("Exceed a resistance", "1", "largest utilisation 1.23: slow, in shear"),
        ("Without a report", "1", "reasons below"),
        ("With warnings", "3", "of 3 calculated"),
        ("Largest design reaction", "9000", "fast"),
        ("Largest code ratio", "2.00", "middle; 25 ms average over AASHTO LRFD"),
    ]
    quiet = [Row(name, faked(example), []) for name in "ab"]
    assert headline_of(quiet)[1:3] == [
        ("Exceed a resistance", "0", "no case gives a resistance"),
        ("Without a report", "0", "every case has its report"),
    ]
    assert len(headline_of(quiet)) == 6


def test_what_holds_but_not_for_every_truck_is_counted_and_ranked_apart(example):
    def row(name, ratio, at_upper):
        ratios = {"utilisations": {"shear": ratio}, "upper_utilisations": {"shear": at_upper}}
        return Row(name, faked(example, **ratios), [])

    rows = [row("kept", 0.95, 0.99), row("over", 1.01, 1.2), row("upper", 0.9, 1.06)]
    page = page_of(rows)
    assert ranked_in(page) == ["over", "upper", "kept"]
    strong = re.findall(r'<tr class="strong">\s*<th[^>]*><a[^>]*>([^<]*)</a>', page)
    assert set(strong) == {"over"}
    table = page.partition('id="tab-results"')[2].partition("</table>")[0]
    verdicts = ["exceeded", "exceeded at 95 %", "kept"]
    assert [found[3] for found in rows_of(table)[1:]] == verdicts
    in_csv = csv.DictReader(io.StringIO(summary_csv(rows), newline=""))
    assert {line["case"]: line["resistance"] for line in in_csv} == dict(
        zip(("over", "upper", "kept"), verdicts, strict=True)
    )
    assert headline_of(rows)[1:3] == [
        ("Exceed a resistance", "1", "largest utilisation 1.01: over, in shear"),
        ("Exceed one at 95 % only", "1", "1.06: upper, in shear"),
    ]


def test_the_summary_says_at_95_percent_what_the_sheets_say(tmp_path):
    path = write_case(tmp_path / "P.yaml", shear_resistance="8 MN", moment_resistance="9 MN*m")
    results = results_of(path)
    assert max(results.utilisations.values()) < 1.0 < max(results.upper_utilisations.values())
    (line,) = csv.DictReader(io.StringIO(summary_csv([Row("P", results, [])]), newline=""))
    assert line["resistance"] == "exceeded at 95 %"


def test_a_case_that_another_supersedes_is_counted_nowhere(tmp_path, example):
    names = ["old", "new", "other"]
    cases = [write_case(tmp_path / f"{name}.yaml") for name in names]
    supersedes = {"new": "./old.yaml", "other": "elsewhere.yaml"}
    (tmp_path / "cases").symlink_to(tmp_path)
    reports = [
        Report(
            *(Path(f"{name}.{ending}") for ending in ("ipynb", "html", "pdf")),
            [],
            faked(
                example,
                supersedes=supersedes.get(name),
                revision=name,
                utilisations={"shear": 0.9 if name != "old" else 5.0},
                upper_utilisations={},
            ),
        )
        for name in names
    ]
    cases = [tmp_path / "old.yaml", *(tmp_path / "cases" / case.name for case in cases[1:])]
    rows = batch_module._rows(cases, reports)
    assert [row.superseded_by for row in rows] == ["new", "", ""]
    blocks = summary_blocks(rows)
    (head,) = (block for block in blocks if isinstance(block, Headline))
    found = {label: (value.number, remark) for label, value, remark in head.results}
    assert found["Cases"] == ("2", "2 calculated, 1 superseded left out")
    assert found["Exceed a resistance"][0] == "0"
    page = "".join(block._repr_html_() for block in blocks)
    assert sorted(ranked_in(page)) == ["new", "other"]
    assert "supersedes it: old (by new)." in page
    lines = csv.DictReader(io.StringIO(summary_csv(rows), newline=""))
    assert [line["status"] for line in lines] == ["superseded by new", "calculated", "calculated"]
    # Two that supersede each other are both there, and so is what is beside them.
    old = reports[0]._replace(results=faked(reports[0].results, supersedes="new.yaml"))
    circle = batch_module._rows(cases, [old, *reports[1:]])
    assert [row.superseded_by for row in circle] == ["", "", ""]


def test_a_given_value_in_another_unit_has_the_figures_of_the_csv(example):
    rows = [Row("P", faked(example, speed=60.0 * 0.44704), [])]
    table = page_of(rows).partition('id="tab-cases"')[2].partition("</table>")[0]
    (line,) = csv.DictReader(io.StringIO(summary_csv(rows), newline=""))
    assert line["speed [km/h]"] == "96.561"
    assert "96.561" in rows_of(table)[1]


def test_the_summary_has_the_date_of_the_last_revision(example):
    rows = [
        Row(f"P{day}", faked(example, date=datetime.date(2026, 5, day)), []) for day in (3, 9, 6)
    ]
    assert "2026-05-09" in summary_blocks(rows)[0]._repr_html_()


def test_every_warning_stands_by_its_case_and_in_the_csv(example):
    rows = [
        Row("P1", faked(example, warnings=("Of two.", "Known by all.", "<b> & so on.")), []),
        Row("P2", None, ["P2.yaml: is not UTF-8 text"]),
        Row("P3", faked(example, warnings=("Known by all.", "Of two.")), ["a letter is missing"]),
        Row("P4", faked(example, warnings=("Known by all.",)), []),
    ]
    page = "".join(block._repr_html_() for block in summary_blocks(rows))
    assert "<b>" not in page
    order = ranked_in(page)
    found = [row for row in rows_of(page) if len(row) == 2]
    assert found[0] == ["Warning", "Cases"]
    assert {tuple(row) for row in found[1:]} == {
        ("Known by all.", "all"),
        ("Of two.", ", ".join(name for name in order if name != "P4")),
        ("<b> & so on.", "P1"),
        ("a letter is missing", "P3"),
    }
    assert len(found) == 5
    lines = list(csv.DictReader(io.StringIO(summary_csv(rows), newline="")))
    assert [(line["warnings"], line["reason"]) for line in lines] == [
        ("Of two.; Known by all.; <b> & so on.", ""),
        ("", "P2.yaml: is not UTF-8 text"),
        ("Known by all.; Of two.; a letter is missing", ""),
        ("Known by all.", ""),
    ]
    alone = "".join(block._repr_html_() for block in summary_blocks(rows[3:]))
    assert [row for row in rows_of(alone) if len(row) == 2][1:] == [["Known by all.", "P4"]]


def test_a_project_of_their_own_is_a_column(tmp_path):
    rows = []
    for name, project in (("a", "One"), ("b", "Two"), ("c", "Two")):
        case = write_case(tmp_path / f"{name}.yaml", project=project)
        rows.append(Row(name, results_of(case), []))

    def heads(rows):
        page = "".join(block._repr_html_() for block in summary_blocks(rows))
        return re.findall(r'<th scope="col"[^>]*>(.*?)</th>', page)

    assert "Project" in heads(rows)
    assert "Project" not in heads(rows[1:])


class Panic(BaseException):
    """What Typst raises where it has a fault of its own is no Exception either."""


@pytest.mark.parametrize(
    ("outcomes", "code"),
    [
        ([None, None], 0),
        ([None, InputError("b.yaml: bad")], 2),
        ([InputError("a.yaml: bad"), InputError("b.yaml: bad")], 2),
        ([InputError("a.yaml: bad"), None, ReportError("c.yaml: failed")], 1),
        ([None, KeyError("a\nb")], 1),
        ([None, Panic("no such glyph")], 1),
    ],
)
def test_exit_codes(tmp_path, monkeypatch, capsys, outcomes, code):
    names = "abc"[: len(outcomes)]
    cases = [write_case(tmp_path / f"{name}.yaml") for name in names]

    def write(case, output, docx, force, kernels, on_stage):
        if error := outcomes[names.index(case.stem)]:
            raise error
        files = (output / f"{case.stem}.{ending}" for ending in ("ipynb", "html", "pdf"))
        return Report(*files, [], results_of(case))

    monkeypatch.setattr(batch_module, "write_report", write)
    output = tmp_path / "out"
    assert cli.main(["report", *map(str, cases), "--output", str(output)]) == code
    lines = capsys.readouterr()
    failures = [error for error in outcomes if error]
    good = len(outcomes) - len(failures)
    assert len(lines.out.splitlines()) == (3 * good + 3 if good else 0)
    expected = [
        {"KeyError": "b.yaml: KeyError: 'a\\nb'", "Panic": "b.yaml: Panic: no such glyph"}.get(
            type(error).__name__, str(error)
        )
        for error in failures
    ]
    if failures:
        expected.append(f"{len(failures)} of {len(outcomes)} cases have no report")
    assert lines.err.splitlines() == [f"pierimpact: {line}" for line in expected]
    assert output.exists() == (good > 0)


def test_nothing_is_written_where_somebody_changed_a_report(tmp_path, monkeypatch, capsys):
    cases, output = [write_case(tmp_path / f"{name}.yaml") for name in "ab"], tmp_path / "out"
    output.mkdir()
    names = ["a.html", "a.pdf", "b.docx", "b.ipynb", "summary.csv", "binder.pdf"]
    with temporary_folder(output) as temporary:
        for name in names:
            (temporary / name).write_text(name)
        put_unchanged([temporary / name for name in names], output)
    for name in ("a.pdf", "b.docx", "summary.csv", "binder.pdf"):
        (output / name).write_text("mine")
    before = {path.name: path.read_bytes() for path in output.iterdir()}
    calls = []
    monkeypatch.setattr(batch_module, "write_report", lambda *_, **__: calls.append(1))
    for options, changed in (
        ([], ("a.pdf", "summary.csv")),
        (["--docx", "--binder"], ("a.pdf", "b.docx", "summary.csv", "binder.pdf")),
    ):
        command = ["report", *map(str, cases), "--output", str(output), *options]
        assert cli.main(command) == 2
        assert capsys.readouterr() == (
            "",
            f"pierimpact: {', '.join(str(output / name) for name in changed)} were not written by "
            "pierimpact, or changed since: move what you want to keep, or give --force to "
            "overwrite\n",
        )
    assert {path.name: path.read_bytes() for path in output.iterdir()} == before
    assert calls == []


def test_what_earlier_runs_wrote_is_removed_or_named(tmp_path, capsys):
    cases, output = [write_case(tmp_path / f"{name}.yaml") for name in "ab"], tmp_path / "out"
    cases[1].write_text("speed: 80", encoding="utf-8")
    texts = {"a.docx": b"", "b.docx": b"", "b.pdf": b"", "summary.docx": b"", "binder.pdf": b""}
    output.mkdir()
    write_unchanged(texts, output)
    (output / "b.docx").write_text("mine")
    (output / "other.docx").write_text("mine")
    assert cli.main(["report", *map(str, cases), "--output", str(output)]) == 2
    assert capsys.readouterr().err.splitlines()[-1] == (
        "pierimpact: warning: of an earlier run, not of this one: "
        "b.docx, b.pdf, binder.pdf, summary.docx"
    )
    assert {file.name for file in output.iterdir()} == {
        RECORD, "other.docx", *texts, *(f"a.{ending}" for ending in ("ipynb", "html", "pdf")),
        *(f"summary.{ending}" for ending in ("csv", "html", "pdf")),
    } - {"a.docx"}  # fmt: skip


def test_a_name_that_is_not_utf_8_costs_its_own_case_only(tmp_path, monkeypatch, capsys):
    try:
        odd = write_case(tmp_path / "a\udcff.yaml")
    except OSError:
        pytest.skip("this file system has names in UTF-8 only")
    good, long = write_case(tmp_path / "b.yaml"), write_case(tmp_path / f"{'n' * 250}.yaml")
    results, original = results_of(good), batch_module.write_report

    def write(case, output, docx, force, kernels, on_stage):
        if case != good:
            return original(case, output, docx=docx, kernels=kernels)
        return Report(Path("x.ipynb"), Path("x.html"), Path("x.pdf"), [], results)

    monkeypatch.setattr(batch_module, "write_report", write)
    monkeypatch.setattr(batch_module, "start_kernels", lambda *_: contextlib.nullcontext([]))
    output = tmp_path / "out"
    assert cli.main(["report", *map(str, (odd, good, long)), "--output", str(output)]) == 2
    errors = capsys.readouterr().err.splitlines()
    assert errors[0] == (
        f"pierimpact: a\\udcff.yaml: a\\udcff.ipynb cannot be written to {output}: "
        "Its name is not in UTF-8"
    )
    assert errors[1].endswith("File name too long")
    assert errors[2:] == ["pierimpact: 2 of 3 cases have no report"]
    assert {path.suffix for path in output.glob("summary.*")} == {".html", ".pdf", ".csv"}


def test_one_case_has_no_summary(tmp_path, monkeypatch):
    case = write_case(tmp_path / "a.yaml")
    report = Report(Path("a.ipynb"), Path("a.html"), Path("a.pdf"), [], results_of(case))
    monkeypatch.setattr(batch_module, "write_report", lambda *_, **__: report)
    result = write_reports([case], tmp_path / "out", progress=False)
    assert result == ([report], [], None, "", None, "", [])


def test_a_summary_that_fails_leaves_the_reports(tmp_path, monkeypatch, capsys):
    cases = [write_case(tmp_path / f"{name}.yaml") for name in "ab"]

    def write(case, output, docx, force, kernels, on_stage):
        return Report(Path("x.ipynb"), Path("x.html"), Path("x.pdf"), [], results_of(case))

    def fail(rows):
        raise ValueError("no CSV")

    monkeypatch.setattr(batch_module, "write_report", write)
    monkeypatch.setattr(batch_module, "summary_csv", fail)
    output = tmp_path / "out"
    assert cli.main(["report", *map(str, cases), "--output", str(output)]) == 1
    lines = capsys.readouterr()
    assert lines.out.splitlines() == ["x.ipynb", "x.html", "x.pdf"] * 2
    assert lines.err == "pierimpact: the summary: ValueError: no CSV\n"
    assert list(output.iterdir()) == []


def test_a_binder_that_fails_leaves_the_rest(tmp_path, monkeypatch, capsys):
    case = write_case(tmp_path / "a.yaml")
    report = Report(Path("x.ipynb"), Path("x.html"), Path("x.pdf"), [], results_of(case))
    monkeypatch.setattr(batch_module, "write_report", lambda *_, **__: report)
    output = tmp_path / "out"
    assert cli.main(["report", str(case), "--binder", "--output", str(output)]) == 1
    lines = capsys.readouterr()
    assert lines.out.splitlines() == ["x.ipynb", "x.html", "x.pdf"]
    assert lines.err.startswith("pierimpact: the binder: FileNotFoundError: ")
    assert list(output.iterdir()) == []


def test_an_output_that_cannot_be_is_told_once(tmp_path):
    cases = [write_case(tmp_path / f"{name}.yaml") for name in "abc"]
    output = tmp_path / "file"
    output.touch()
    with pytest.raises(OutputError, match=rf"output {output} must be a folder"):
        write_reports(cases, output, progress=False)


@pytest.mark.skipif(os.name == "nt", reason="needs the signals of POSIX")
def test_ctrl_c_leaves_whole_reports_only(tmp_path):
    for name in "abcdefgh":
        write_case(tmp_path / f"{name}.yaml")
    output = tmp_path / "out"
    process = subprocess.Popen(
        [sys.executable, "-m", "pierimpact", "report", tmp_path, "--output", output],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        encoding="utf-8",
        start_new_session=True,
    )
    while not list(output.glob("*.ipynb")) and process.poll() is None:
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=600)  # only a hang takes that long
    assert process.returncode == 130
    left = {path.name for path in output.iterdir()} - {RECORD}
    stems = {name.partition(".")[0] for name in left}
    assert left == {f"{stem}.{ending}" for stem in stems for ending in ("ipynb", "html", "pdf")}
    assert 1 <= len(stems) < 8
    assert errors.splitlines() == [f"pierimpact: interrupted, {len(stems)} of 8 reports written"]
