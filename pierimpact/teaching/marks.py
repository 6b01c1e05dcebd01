"""The marks of a class: a folder of answer files in one table."""

import csv
import io
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import pierimpact
from pierimpact.checks import InputError, no_formula
from pierimpact.teaching.numbers import same_name
from pierimpact.teaching.questions import LESSONS
from pierimpact.teaching.work import ENDING, Work, file_name, read_work


class Marks(NamedTuple):
    """What was collected: a table of CSV, and what was left out of it or is to be looked at."""

    table: str
    students: int
    files: int  #: that were read
    remarks: list[str]


def collect(folder: str | Path) -> Marks:
    """Return the marks in a folder and all folders below it, a row a student.

    Students are told apart by the names or numbers that they gave; capitals and needless spaces do
    not count. Without one the files of a folder with the same words before their names are one
    student's, who goes by those words. Answers are checked again, whatever scores a file has.

    Parameters
    ----------
    folder : str or Path
        Folder with files such as "01_collision.answers.json"; anything may stand before that.

    Raises
    ------
    InputError
        When there is no such folder, or no file in it can be read.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise InputError(f"folder {folder} does not exist")
    # A browser that saves a file again puts a number before its ending.
    found_files = folder.rglob(f"*{Path(ENDING).stem}*{Path(ENDING).suffix}")
    paths = sorted(path for path in found_files if not path.name.startswith("."))
    remarks: list[str] = []
    found: dict[str, dict[str, tuple[Work, Path]]] = {}
    read = 0
    for path in paths:
        try:
            work = read_work(path)
        except InputError as error:
            remarks.append(f"{path}: {error}")
            continue
        read += 1
        if work.version != pierimpact.__version__:
            remarks.append(
                f"{path}: answered with pierimpact {work.version}, checked by "
                f"{pierimpact.__version__}"
            )
        student = same_name(work.name) or f"\n{path.parent / _before(work, path)}"
        remarks += _take(found.setdefault(student, {}), work, path)
    if not read:
        why = f"; {remarks[0]}" if remarks else f": there is no file named *{ENDING}"
        raise InputError(f"folder {folder} has no answers that can be read{why}")
    rows = [_heads(), *(_row(works, folder) for _, works in sorted(found.items()))]
    return Marks(_csv(rows), len(found), read, remarks)


def _take(works: dict[str, tuple[Work, Path]], work: Work, path: Path) -> list[str]:
    """Take a lesson's work; where there are two, the one with more answers in it."""
    other = works.setdefault(work.lesson, (work, path))
    if other[1] == path:
        return []
    whose = "the same student" if work.name else "a student without a name, taken for the same"
    if _size(work) > _size(other[0]):
        works[work.lesson] = (work, path)
        return [f"{other[1]}: not used, for {path} has more work of {whose}"]
    return [f"{path}: not used, for {other[1]} has as much work of {whose}"]


def _before(work: Work, path: Path) -> str:
    """Return what stands before the name of a lesson's file, such as "Meier_"."""
    return path.name.partition(Path(file_name(work.lesson)).stem)[0]


def _size(work: Work) -> int:
    return sum(map(len, work.answers.values())) + bool(work.prediction)


def _heads() -> list[str | int]:
    heads: list[str | int] = ["name", "folder", "right", "questions", "predictions right"]
    for name, lesson in LESSONS.items():
        heads += [f"{name} prediction", f"{name} prediction right"]
        for number in range(1, len(lesson.questions) + 1):
            heads += [f"{name} {number} right", f"{name} {number} tries"]
    return heads


def _row(works: dict[str, tuple[Work, Path]], folder: Path) -> list[str | int]:
    cells: list[str | int] = []
    right = asked = came_true = 0
    for name, lesson in LESSONS.items():
        asked += len(lesson.questions)
        if name not in works:
            cells += [""] * (2 + 2 * len(lesson.questions))
            continue
        work = works[name][0]
        right += work.solved
        came_true += work.predicted_right
        made = bool(work.prediction)
        cells += [work.prediction, int(work.predicted_right) if made else ""]
        for score in work.scores:
            cells += [int(score.right) if score.tries else "", score.tries]
    work, path = next(iter(works.values()))
    name = work.name or _before(work, path).strip(" _-")
    return [name, str(path.parent.relative_to(folder)), right, asked, came_true, *cells]


def _csv(rows: Iterable[list[str | int]]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([_plain(cell) for cell in row] for row in rows)
    return text.getvalue()


def _plain(cell: str | int) -> str | int:
    return no_formula(cell) if isinstance(cell, str) else cell
