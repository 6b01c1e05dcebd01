"""A student's work is kept and restored; a class's is collected; the teacher has the answers."""

import csv
import json
import random
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from nbclient import NotebookClient
from traitlets.config import Config

import pierimpact
from pierimpact import cli, exercises, predictions, widgets
from pierimpact.checks import InputError
from pierimpact.teaching import work
from pierimpact.teaching.checker import TRIES
from pierimpact.teaching.explorer import Explorer
from pierimpact.teaching.marks import collect
from pierimpact.teaching.questions import LESSONS, questions
from pierimpact.teaching.reading import readings
from pierimpact.teaching.work import ENDING, KeptWork, Work, file_name, read_work
from pierimpact.units import DIMENSIONS


@pytest.fixture
def desk(tmp_path, monkeypatch):
    """A folder of one's own, with nothing answered yet."""
    monkeypatch.chdir(tmp_path)
    work.kept_work.cache_clear()
    return tmp_path


@pytest.fixture
def reopened(desk):
    """Forget what is in memory, as a new kernel does."""
    return work.kept_work.cache_clear


def right(question):
    if isinstance(question.answer, str):
        return question.answer
    unit = DIMENSIONS[question.dimension].si if question.dimension else ""
    return f"{question.answer:.6g} {unit}".strip()


def test_work_is_restored_when_the_notebook_is_reopened(desk, reopened):
    exercises.begin("pier").box.value = "  Anna   Müller "
    box = predictions.ask("pier")
    box.choice.value = list(LESSONS["pier"].prediction.choices)[1]
    box.lock()
    asked = [exercises.ask("pier", number) for number in (1, 4)]
    asked[0].box.value = "1 MN/m"
    asked[0].box.value = right(asked[0].question)
    asked[1].box.value = "4 times as high"
    asked[1].answer()
    words = [exercise.words.value for exercise in asked]
    replies = [exercise.feedback.value for exercise in asked]
    board = exercises.score("pier").board.value
    reopened()
    student = exercises.begin("pier")
    assert student.box.value == "Anna Müller"
    assert student.box.disabled
    again = [exercises.ask("pier", number) for number in (1, 4)]
    assert [exercise.words.value for exercise in again] == words
    assert [exercise.feedback.value for exercise in again] == replies
    assert [e.box.value for e in again] == [right(again[0].question), "4 times as high"]
    assert exercises.score("pier").board.value == board
    assert predictions.ask("pier").choice.disabled
    assert predictions.ask("pier").choice.value == box.choice.value
    reopened()
    assert exercises.begin("spectra").box.value == "Anna Müller"  # from the other lesson
    assert not exercises.begin("spectra").box.disabled


def test_nothing_is_written_before_there_is_work(desk):
    exercises.begin("pier")
    exercises.ask("pier", 1)
    predictions.ask("pier")
    exercises.score("pier")
    assert list(desk.iterdir()) == []


def test_a_name_decides_the_numbers_until_the_first_answer(desk):
    student, exercise = exercises.begin("collision"), exercises.ask("collision", 1)
    common = exercise.words.value
    student.box.value = "Anna"
    own = exercise.words.value
    assert own != common
    exercise.box.value = "3 m"
    assert student.box.disabled
    student.box.value = "Bob"
    assert "fixed with your first answer" in student.message.value
    assert "To begin anew, move the file away" in student.message.value
    assert exercise.words.value == own
    assert read_work(desk / file_name("collision")).name == "Anna"


def test_a_new_kernel_restores_it_and_the_saved_notebook_shows_it(tmp_path):
    """What is answered after a cell has run is in the notebook as it is saved."""

    def run(*sources):
        cells = [nbformat.v4.new_code_cell(source) for source in sources]
        config = Config()
        config.KernelManager.transport_encryption = "auto"
        config.KernelManager.kernel_name = "python3"
        resources = {"metadata": {"path": tmp_path}}
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("PYTHONPATH", str(Path(pierimpact.__file__).parents[1]))
            notebook = nbformat.v4.new_notebook(cells=cells)
            NotebookClient(notebook, timeout=600, resources=resources, config=config).execute()
        return ["".join(o.data.get("text/html", "") for o in cell.outputs) for cell in cells[1:4]]

    shown = (
        "from pierimpact import exercises",
        "student = exercises.begin('pier'); student",
        "exercise = exercises.ask('pier', 3); exercise",
        "exercises.score('pier')",
    )
    answered = run(*shown, "student.box.value = 'Anna'; exercise.box.value = '3 Hz'")
    assert "Anna" in answered[0]
    assert "3 Hz" in answered[1]
    assert "not solved yet, 1 try" in answered[2]
    assert run(*shown) == answered


@pytest.mark.parametrize("name", ["a\nb", "x" * 81])
def test_a_name_is_one_line(desk, name):
    kept = KeptWork("pier", desk)
    if "\n" in name:
        kept.rename(name)
        assert kept.work.name == "a b"
    else:
        with pytest.raises(InputError, match="at most 80"):
            kept.rename(name)


def entry(**changed):
    """Return the text of a file that is right but for what was changed."""
    good = {"pierimpact": "1", "lesson": "pier", "name": "", "prediction": "", "answers": {}}
    return json.dumps(good | changed)


@pytest.mark.parametrize(
    "content",
    ["", "{", "[]", '"x"', "{}", '{"lesson": "pier"}', "\udcff", "[" * 100000,
     entry(lesson="none"), entry(lesson="spectra"), entry(lesson=[]), entry(name=3),
     entry(name="a\nb\u0007"), entry(prediction="?"), entry(answers=3), entry(answers={"x": []}),
     entry(answers={"9": ["3 m"]}), entry(answers={"1": [3]}), entry(answers={"1": "abc"})],
    ids=range(19),
)  # fmt: skip
def test_a_damaged_file_is_set_aside_and_said(desk, content):
    path = desk / file_name("pier")
    for number in (1, 2):
        path.write_bytes(content.encode("utf-8", "surrogateescape"))
        kept = KeptWork("pier", desk)
        assert kept.trouble.startswith("02_pier.answers.json was not restored, for ")
        assert f"02_pier.answers.json.damaged-{number}" in kept.trouble
        assert "\n" not in kept.trouble
        assert not path.exists()
    assert len(list(desk.iterdir())) == 2
    kept.answer(1, "3 MN/m")
    assert read_work(path).answers == {1: ["3 MN/m"]}


def test_the_damage_is_said_in_the_notebook(desk):
    (desk / file_name("pier")).write_text("{")
    assert 'role="alert"' in exercises.begin("pier").message.value


def test_a_write_that_fails_leaves_the_file_and_is_said(desk, monkeypatch):
    student, exercise = exercises.begin("pier"), exercises.ask("pier", 1)
    exercise.box.value = "3 MN/m"
    before = (desk / file_name("pier")).read_bytes()

    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(work.Path, "replace", full)
    exercise.box.value = "4 MN/m"
    assert (desk / file_name("pier")).read_bytes() == before
    assert [path.name for path in desk.iterdir()] == [file_name("pier")]
    assert "cannot be kept in 02_pier.answers.json: No space left" in student.message.value
    monkeypatch.undo()


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    lesson=st.sampled_from(list(LESSONS)),
    name=st.text(
        st.characters(exclude_categories=["C", "Z"], exclude_characters="\ufeff"), max_size=30
    ),
    texts=st.lists(st.text(max_size=12), max_size=5),
    choice=st.integers(-1, 2),
)
def test_what_is_written_is_read_back(desk, lesson, name, texts, choice):
    choices = ["", *LESSONS[lesson].prediction.choices]
    texts = [text.encode("utf-8", "replace").decode() for text in texts]
    before = Work(lesson, name, choices[choice + 1], {1: texts} if texts else {})
    path = desk / "file.json"
    path.write_text(before.written(), encoding="utf-8")
    assert read_work(path) == before
    content = json.loads(before.written())
    assert content["solved"] == f"{before.solved} of {len(before.questions)}"


def test_an_explorer_shows_after_the_prediction_and_says_what_came_of_it(desk):
    for lesson, known in LESSONS.items():
        explorer = Explorer(title="", controls=["speed"], heights=(90, 45, 45))
        box, shown = predictions.ask(lesson), predictions.reveal(lesson, explorer)
        box.lock()
        assert "Choose first" in box.message.value
        assert shown.explorer.widget.layout.display == "none"
        wrong = next(c for c in known.prediction.choices if c != known.prediction.answer())
        box.choice.value = wrong
        box.lock()
        assert shown.explorer.widget.layout.display == "flex"
        assert f"It is: <b>{known.prediction.answer()}</b>" in shown.words.value
        assert box.choice.disabled
        box.choice.value = known.prediction.answer()
        box.lock()  # too late
        assert read_work(desk / file_name(lesson)).prediction == wrong


def test_the_right_prediction_is_said(desk):
    box, shown = predictions.ask("pier"), predictions.reveal("pier", widgets.pier())
    box.choice.value = LESSONS["pier"].prediction.answer()
    box.lock()
    assert "✓" in shown.words.value
    assert "It is:" not in shown.words.value


@pytest.fixture(scope="module")
def school(tmp_path_factory):
    """Thirty students with generated work, and what is right by another way of counting."""
    folder, chance = tmp_path_factory.mktemp("class"), random.Random(7)
    expected = {}
    for index in range(30):
        name = f"Student {index:02d}"
        counts = expected[name] = {"right": 0, "predictions right": 0}
        for lesson in LESSONS:
            if chance.random() < 0.1:
                continue
            made = Work(lesson, name)
            if chance.random() < 0.8:
                made.prediction = chance.choice(list(LESSONS[lesson].prediction.choices))
                counts["predictions right"] += (
                    made.prediction == LESSONS[lesson].prediction.answer()
                )
            for number, question in enumerate(questions(lesson, name), 1):
                wrong = chance.randint(0, TRIES)
                bad = [c for c in question.choices if c != question.answer] or ["-17", "-18", "-19"]
                unit = DIMENSIONS[question.dimension].si if question.dimension else ""
                given = [text if question.choices else f"{text} {unit}" for text in bad[:wrong]]
                if wrong < TRIES and chance.random() < 0.7:
                    given.append(right(question))
                    counts["right"] += 1
                    counts[f"{lesson} {number} right"] = "1"
                elif given:
                    counts[f"{lesson} {number} right"] = "0"
                if given:
                    made.answers[number] = given
                counts[f"{lesson} {number} tries"] = str(len(given))
            place = folder / f"{index:02d}"
            place.mkdir(exist_ok=True)
            upload = f"{name}_assign_{file_name(lesson)}" if index % 2 else file_name(lesson)
            (place / upload).write_text(made.written(), encoding="utf-8")
    return folder, expected


def table(text):
    return list(csv.DictReader(text.splitlines()))


def test_a_class_is_collected_a_row_a_student(school):
    folder, expected = school
    marks = collect(folder)
    rows = table(marks.table)
    assert [row["name"] for row in rows] == sorted(expected)
    assert (marks.students, marks.files) == (30, len(list(folder.rglob(f"*{ENDING}"))))
    assert marks.remarks == []
    for row in rows:
        assert row["questions"] == str(sum(len(lesson.questions) for lesson in LESSONS.values()))
        for head, value in expected[row["name"]].items():
            assert row[head] == str(value), (row["name"], head)


def test_files_that_cannot_be_read_are_listed_and_stop_nothing(tmp_path, capsys):
    (tmp_path / "a").mkdir()
    good = Work("pier", "=cmd()", answers={1: ["1 MN/m"]})
    (tmp_path / "a" / file_name("pier")).write_text(good.written(), encoding="utf-8")
    (tmp_path / f"x{ENDING}").write_text("{")
    (tmp_path / f"y{ENDING}").mkdir()
    old = Work("limits", "=CMD()", version="0.0.1")
    (tmp_path / "z.answers (1).json").write_text(old.written(), encoding="utf-8")
    for name in ("notes.txt", f"._x{ENDING}", f"x{ENDING}.damaged-1"):
        (tmp_path / name).write_text("no answers")
    assert cli.main(["collect", str(tmp_path), "--csv", str(tmp_path / "marks.csv")]) == 0
    out, err = capsys.readouterr()
    assert out == f"{tmp_path / 'marks.csv'}: students 1, files read 2\n"
    lines = err.splitlines()
    assert len(lines) == 3
    assert "not the text of a JSON file" in lines[0]
    assert "cannot be read" in lines[1]
    assert f"answered with pierimpact 0.0.1, checked by {pierimpact.__version__}" in lines[2]
    [row] = table((tmp_path / "marks.csv").read_text(encoding="utf-8"))
    assert row["name"] == "'=cmd()"


def test_of_two_files_of_a_lesson_the_one_with_more_work_counts(tmp_path):
    for folder, answers in (("a", ["1 MN/m"]), ("b", ["1 MN/m", "2 MN/m"]), ("c", ["3 MN/m"])):
        (tmp_path / folder).mkdir()
        made = Work("pier", "Anna", answers={1: answers})
        (tmp_path / folder / file_name("pier")).write_text(made.written(), encoding="utf-8")
    marks = collect(tmp_path)
    [row] = table(marks.table)
    assert row["pier 1 tries"] == "2"
    assert [remark.partition(": not used")[0] for remark in marks.remarks] == [
        str(tmp_path / folder / file_name("pier")) for folder in "ac"
    ]


def test_students_without_a_name_are_told_apart_by_folder_and_file(tmp_path):
    """What a learning platform puts before the name of a file is whose it is."""
    given = {
        "01_collision.answers.json": "1 m",
        "Meier_01_collision.answers.json": "2 m",
        "Meier_02_pier.answers.json": "1 MN/m",
        "a/01_collision.answers.json": "3 m",
    }
    (tmp_path / "a").mkdir()
    for name, text in given.items():
        lesson = "pier" if "pier" in name else "collision"
        (tmp_path / name).write_text(Work(lesson, answers={1: [text]}).written(), encoding="utf-8")
    marks = collect(tmp_path)
    assert marks.remarks == []
    rows = {(row["name"], row["folder"]): row for row in table(marks.table)}
    assert set(rows) == {("", "."), ("Meier", "."), ("", "a")}
    tries = [
        [row[f"{lesson} 1 tries"] for lesson in ("collision", "pier")] for row in rows.values()
    ]
    assert sorted(tries) == [["1", ""], ["1", ""], ["1", "1"]]


def test_a_second_file_without_a_name_is_not_said_to_be_the_same_students(tmp_path):
    for name in ("01_collision.answers.json", "01_collision.answers (1).json"):
        (tmp_path / name).write_text(Work("collision", answers={1: ["1 m"]}).written())
    marks = collect(tmp_path)
    assert marks.students == 1
    [remark] = marks.remarks
    assert remark.endswith("has as much work of a student without a name, taken for the same")


@pytest.mark.parametrize("content", ["[]", "{}", "3", '"x"', entry(answers=None), entry(name=3)])
def test_what_is_no_answer_file_is_said_plainly(tmp_path, content):
    (tmp_path / "x.answers.json").write_text(content)
    (tmp_path / file_name("pier")).write_text(Work("pier", "Anna").written())
    [remark] = collect(tmp_path).remarks
    assert remark.partition(": ")[2] == (
        "it is no answer file: it is not of the form that notebooks write"
    )


def test_scores_that_were_edited_do_not_count(tmp_path):
    made = json.loads(Work("pier", "Anna", answers={1: ["1 MN/m"]}).written())
    made["scores"]["1"]["right"] = True
    made["solved"] = "4 of 4"
    (tmp_path / file_name("pier")).write_text(json.dumps(made))
    [row] = table(collect(tmp_path).table)
    assert (row["right"], row["pier 1 right"], row["pier 1 tries"]) == ("0", "0", "1")


@pytest.mark.parametrize("content", [None, "", "{"])
def test_none_that_can_be_read_is_bad_input(tmp_path, capsys, content):
    folder = tmp_path / "class"
    if content is not None:
        folder.mkdir()
    if content:
        (folder / f"x{ENDING}").write_text(content)
    assert cli.main(["collect", str(folder), "--csv", str(tmp_path / "marks.csv")]) == 2
    assert not (tmp_path / "marks.csv").exists()
    err = capsys.readouterr().err
    assert err.startswith(f"pierimpact: folder {folder} ")
    assert err.count("\n") == 1


def test_a_table_to_which_a_teacher_added_is_kept(tmp_path, capsys):
    (tmp_path / file_name("pier")).write_text(Work("pier", "Anna").written())
    marks = tmp_path / "marks.csv"
    command = ["collect", str(tmp_path), "--csv", str(marks)]
    assert cli.main(command) == cli.main(command) == 0
    marks.write_text(marks.read_text("utf-8") + "my remarks\n", "utf-8")
    assert cli.main(command) == 2
    assert f"{marks} was not written by pierimpact, or changed since" in capsys.readouterr().err
    assert marks.read_text("utf-8").endswith("my remarks\n")
    assert cli.main([*command, "--force"]) == 0
    assert "my remarks" not in marks.read_text("utf-8")


def test_a_table_that_cannot_be_written_is_bad_input(tmp_path, capsys):
    (tmp_path / file_name("pier")).write_text(Work("pier", "Anna").written())
    assert cli.main(["collect", str(tmp_path), "--csv", str(tmp_path / "no" / "marks.csv")]) == 2
    assert "cannot be written to" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["", "Anna Müller"])
def test_the_teachers_sheet_has_times_beliefs_and_worked_answers(name, capsys):
    assert cli.main(["teach", "--answers", name]) == 0
    sheet = capsys.readouterr().out
    for lesson, known in LESSONS.items():
        assert f"## {known.title}\n" in sheet
        assert f"Time: {known.minutes} minutes" in sheet
        assert f"- **right:** {known.prediction.answer()} — " in sheet
        for belief, truth in known.misconceptions:
            assert f"- “{belief}” {truth}" in sheet
        for question in questions(lesson, name):
            assert question.words in sheet
            assert f"Answer: {question.solution}\n" in sheet
            for value, hint in question.mistakes:
                [line] = [row for row in sheet.splitlines() if row.endswith(f": {hint}")
                          and _says(row, value, question.dimension)][:1]  # fmt: skip
                assert line.startswith("- ")
    assert sheet.count("### Exercise") == sum(len(k.questions) for k in LESSONS.values())


def _says(line, value, dimension):
    shown = line.removeprefix("- ").partition(": ")[0]
    try:
        [reading] = readings(shown, dimension)
    except InputError:  # of another question
        return False
    return abs(reading.value / value - 1.0) < 1e-3


def test_collecting_needs_no_widgets_and_no_figures(tmp_path):
    (tmp_path / file_name("pier")).write_text(Work("pier", "Anna").written())
    program = (
        "import sys\n"
        "for name in ('ipywidgets', 'matplotlib', 'IPython', 'PIL'): sys.modules[name] = None\n"
        "from pierimpact import cli\n"
        f"sys.exit(cli.main(['collect', {str(tmp_path)!r}, '--csv', {str(tmp_path / 'm.csv')!r}])\n"
        "    or cli.main(['teach', '--answers', 'x']))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode()
