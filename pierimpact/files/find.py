"""Which case files are meant by the paths of files and folders."""

import os
from collections.abc import Iterable
from pathlib import Path

from pierimpact.checks import InputError

ENDINGS = (".yaml", ".yml")


def find_case_files(paths: Iterable[str | Path]) -> list[Path]:
    """Return the case files at the given paths, each once.

    Parameters
    ----------
    paths : iterable of str or Path
        Case files, and folders, which stand for the *.yaml and *.yml in them, sorted by name;
        subfolders are left alone.

    Raises
    ------
    InputError
        When there is no case in a folder.
    """
    found: dict[tuple[str, str], Path] = {}
    for path in map(Path, paths):
        try:
            files = sorted(path.iterdir())
        except OSError:  # no folder; whether it is a good file is seen when it is read
            cases = [path]
        else:
            cases = [file for file in files if file.suffix.lower() in ENDINGS]
            cases = [file for file in cases if not file.name.startswith(".")]
            if not cases:
                raise InputError(f"{path}: no case in this folder, no *.yaml and no *.yml")
        for case in cases:
            found.setdefault((case.name, os.path.realpath(case)), case)
    return list(found.values())
