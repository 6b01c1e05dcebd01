"""One user's case: what is typed, the text of its file, what it comes to, and its report."""

import errno
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pierimpact.app.results import shown
from pierimpact.checks import InputError, brief, shortened
from pierimpact.files.case import MOST_BYTES, read_case_file
from pierimpact.files.edit_case import edited, typed_in, written_anew
from pierimpact.files.find import ENDINGS
from pierimpact.files.inputs import KEYS, faults
from pierimpact.files.new_case import EXAMPLE, new_case
from pierimpact.files.office import SHARED_FILE
from pierimpact.files.reading import read_text
from pierimpact.files.scratch import ScratchFolder
from pierimpact.files.yaml_keys import yaml_keys
from pierimpact.report.calculation import calculate
from pierimpact.report.kernel import Kernels
from pierimpact.report.write import write_report

#: Bytes of a file that is put beside the case: this project's choice.
MOST_BESIDE = 1_000_000
_COMMENTS_LOST = (
    "The comments of the file that was opened cannot be kept with these values; its keys and "
    "values are."
)


class Session:
    """A case that is being edited, in a folder of its own.

    The files beside the case, such as truck files, are there as links, so that what the case names
    is found and nothing in the user's folder is written to.

    Parameters
    ----------
    case : Path, optional
        Case file to begin with; an example where there is none.

    Raises
    ------
    InputError
        When the case file cannot be read.
    """

    def __init__(self, case: Path | None = None) -> None:
        text = None if case is None else _case_text(case)
        self._scratch = ScratchFolder()
        self.folder = self._scratch.path / "case"
        self.folder.mkdir()
        self.name, self.text, self.note = "case.yaml", new_case(), ""
        if case is not None and text is not None:
            for beside in case.absolute().parent.iterdir():
                if beside.name != case.name:
                    (self.folder / beside.name).symlink_to(beside)
            self._take(case.name, text)

    def close(self) -> None:
        """Remove its folder."""
        self._scratch.cleanup()

    def new(self, system: str) -> None:
        """Begin with an example, in "SI" or "US" units."""
        self._take("case.yaml", new_case(system=system))

    def open(self, name: str, content: bytes) -> None:
        """Take a case file that was opened in the browser.

        Raises
        ------
        InputError
            When it is no case file; the case before is kept.
        """
        _check_name(name)
        with ScratchFolder() as folder:
            path = Path(folder) / name
            path.write_bytes(content)
            text = _case_text(path)
        self._take(name, text)

    def add(self, name: str, content: bytes) -> None:
        """Put a file beside the case: a truck file, a logo, the case before, `pierimpact.toml`.

        Raises
        ------
        InputError
            When it has a name that is none, or is too long.
        """
        _check_name(name)
        if len(content) > MOST_BESIDE:
            raise InputError(f"{shortened(name, 100)} must be at most {MOST_BESIDE / 1e6:g} MB")
        if name == self.name:
            raise InputError(f"{shortened(name, 100)} is the name of the case itself")
        self._write(name, content)

    def change(self, name: str, typed: dict[str, str]) -> None:
        """Take what is typed: the text of the case becomes what the form says.

        What is said of a value that is not given is left out, and that a value is an example once
        it is changed.

        Raises
        ------
        InputError
            When the name is none of a case file.
        """
        before = typed_in(self.text)
        typed = {key: value.strip() for key, value in typed.items()}
        changed = {key for key, value in typed.items() if value != before.get(key, "")}
        for listed in ("assumed", "sources"):
            lines = [
                line
                for line in typed.get(listed, "").splitlines()
                if not _is_stale(line, typed, changed)
            ]
            typed[listed] = "\n".join(lines)
        text, self.note = edited(self.text, typed), ""
        wanted = {key: value for key, value in typed.items() if value}
        if typed_in(text) != wanted:
            text, self.note = written_anew(typed), _COMMENTS_LOST
        self.text = text
        _check_case_name(name)
        self.name = name

    def answer(self) -> dict[str, Any]:
        """Return what the page is to show.

        "name", "text" and "typed" are the case; "errors" are lines by key, "general" the others;
        "result" is what the case comes to, as `results.shown`, or None.
        """
        values = yaml_keys(self.text)
        errors, general, result = faults(values), [], None
        if not errors:
            try:
                result = self._calculated()
            except InputError as error:
                line = str(error).removeprefix(f"{shortened(self.name, 100)}: ")
                line = line.replace(f"{self.folder}{os.sep}", "")
                if line.endswith(os.strerror(errno.ENOENT)):
                    line += "; Add file… puts it beside the case"
                key = _key_of(line)
                if key:
                    errors = {key: line}
                else:
                    general.append(line)
            except Exception as error:  # the form stays, whatever it is
                general.append(
                    f"{type(error).__name__}: {shortened(str(error), 300)}; this is a defect of "
                    "the program: save the case and run pierimpact check --debug on it"
                )
        return {
            "name": self.name,
            "text": self.text,
            "typed": typed_in(self.text),
            "errors": {str(key): line for key, line in errors.items()},
            "general": general,
            "note": self.note,
            "result": result,
        }

    def report(
        self, kernels: Kernels, on_stage: Callable[[], object] = lambda: None
    ) -> dict[str, bytes]:
        """Return the report of the case as it is now: PDF, HTML and Word, by ending.

        It is that of `pierimpact report` for the file of this name that `text` is. Called in
        another thread, it goes on while the form is changed. Errors as in `write_report`.
        """
        name, text = self.name, self.text
        with ScratchFolder() as folder:
            beside = Path(folder) / "case"
            shutil.copytree(self.folder, beside, symlinks=True)
            _put(beside / name, text.encode())
            report = write_report(
                beside / name,
                Path(folder) / "report",
                docx=True,
                kernels=kernels,
                on_stage=on_stage,
            )
            return {file.suffix: file.read_bytes() for file in report.files}

    def _take(self, name: str, text: str) -> None:
        self.name, self.text, self.note = name, text, ""

    def _calculated(self) -> dict[str, Any]:
        path, kept = self.folder / self.name, self.folder.with_name("kept")
        if os.path.lexists(path):  # a file beside it of the same name
            path.rename(kept)
        self._write(self.name, self.text.encode())
        try:
            return shown(calculate(read_case_file(path).case))
        finally:
            path.unlink()
            if os.path.lexists(kept):
                kept.rename(path)

    def _write(self, name: str, content: bytes) -> None:
        try:
            _put(self.folder / name, content)
        except (OSError, ValueError) as error:
            raise InputError(
                f"{shortened(name, 100)} cannot be the name of a file: {error}"
            ) from None


def _put(path: Path, content: bytes) -> None:
    """Write a file in place of a link or a file of its name."""
    path.unlink(missing_ok=True)
    path.write_bytes(content)


def _case_text(path: Path) -> str:
    """Return the text of a case file that has keys and values."""
    try:
        _, text = read_text(path, MOST_BYTES)
        typed_in(text)
    except InputError as error:
        raise InputError(f"{shortened(path.name, 100)}: {error}") from None
    return text


def _check_name(name: str) -> None:
    if not name or name.startswith(".") or Path(name).name != name or not name.isprintable():
        raise InputError(f"file name must be a name without a folder, got {brief(name)}")


def _check_case_name(name: str) -> None:
    _check_name(name)
    if Path(name).suffix.lower() not in ENDINGS:
        raise InputError(f"file name must end in .yaml, got {brief(name)}")


def _is_stale(line: str, typed: dict[str, str], changed: set[str]) -> bool:
    """Whether a line says of a value what holds no more."""
    key, _, reason = (part.strip() for part in line.partition(":"))
    return key in KEYS and (not typed.get(key) or (key in changed and reason == EXAMPLE))


def _key_of(line: str) -> str:
    """Return the key that an error names first; "" where it names none of the case's."""
    if line.startswith(SHARED_FILE):
        return ""
    places = {key: place for key in KEYS if (place := _place(key, line)) is not None}
    return min(places, key=lambda key: (places[key], -len(key)), default="")


def _place(key: str, line: str) -> int | None:
    """Return where a line names a key as a word of its own."""
    words = "".join(letter if letter.isalnum() or letter == "_" else " " for letter in line)
    place = f" {words} ".find(f" {key} ")
    return None if place < 0 else place
