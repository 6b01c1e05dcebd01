"""Files that are replaced by later runs only as long as nobody has changed them.

Their folder has a hidden file with the SHA-256 of each as it was written.
"""

import hashlib
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from pierimpact.checks import InputError
from pierimpact.files.locks import locked
from pierimpact.files.write import clean, move, temporary_folder

RECORD = ".pierimpact.json"  #: the hidden file


class ChangedError(InputError):
    """Files would be replaced that must not be."""


def put_unchanged(files: Sequence[Path], folder: Path, *, force: bool = False) -> list[Path]:
    """Move files in place as `write.put_in_place`, and record what they are.

    Parameters
    ----------
    files : sequence of Path
        Whole files in a temporary folder of the folder.
    folder : Path
        Folder they come to.
    force : bool, optional
        Whether they may replace files that somebody changed.

    Raises
    ------
    ChangedError
        When they would replace what `refuse_changed` refuses; nothing is moved.
    OSError
        When one cannot be moved.
    """
    names = [file.name for file in files]
    with locked(folder):
        clean(folder)
        _refuse(folder, names, force)
        others = {name: was for name, was in _recorded(folder).items() if (folder / name).exists()}
        record = others | {file.name: _digest(file) for file in files}
        new = files[0].with_name(RECORD)
        new.write_text(json.dumps(record, indent=0, sort_keys=True), encoding="ascii")
        return move([*files, new], folder)[:-1]


def write_unchanged(
    contents: Mapping[str, bytes], folder: Path, *, force: bool = False
) -> list[Path]:
    """Write files of a folder by their names, all or none, and record what they are.

    Parameters
    ----------
    contents : mapping of str to bytes
        What comes into each.
    folder, force
        As in `put_unchanged`; the folder exists.

    Raises
    ------
    InputError
        When one cannot be written, or must not be replaced.
    """
    try:
        with temporary_folder(folder) as temporary:
            files = [temporary / name for name in contents]
            for file in files:
                file.write_bytes(contents[file.name])
            return put_unchanged(files, folder, force=force)
    except OSError as error:
        raise InputError(f"{folder} cannot be written to: {error.strerror}") from None


def refuse_changed(folder: Path, names: Iterable[str], *, force: bool = False) -> None:
    """Refuse to replace files of a folder that somebody changed, or that others wrote.

    Parameters
    ----------
    folder : Path
        Folder of the files; it may not exist yet.
    names : iterable of str
        Names of the files that are to be replaced; not all need exist.
    force : bool, optional
        Whether all may be replaced that are files.

    Raises
    ------
    ChangedError
        When one must not be replaced; it names all of them.
    OSError
        When one cannot be read.
    """
    if folder.is_dir():
        with locked(folder):
            clean(folder)
            _refuse(folder, names, force)


def written_before(folder: Path) -> list[Path]:
    """Return the files of a folder that were written by earlier runs, changed since or not."""
    return [folder / name for name in sorted(_recorded(folder)) if (folder / name).is_file()]


def remove_unchanged(file: Path) -> None:
    """Remove a file, if there is one and nobody has changed it."""
    with suppress(OSError):
        if _digest(file) == _recorded(file.parent).get(file.name):
            file.unlink()


def _refuse(folder: Path, names: Iterable[str], force: bool) -> None:
    there = [folder / name for name in names if os.path.lexists(folder / name)]
    for place in there:
        if place.exists() and not place.is_file():
            raise ChangedError(f"{place} cannot be written to: what is there is no file")
    recorded = _recorded(folder)
    changed = [
        str(place)
        for place in there
        if not force and place.is_file() and _digest(place) != recorded.get(place.name)
    ]
    if changed:
        was = "was" if len(changed) == 1 else "were"
        raise ChangedError(
            f"{', '.join(changed)} {was} not written by pierimpact, or changed since: "
            "move what you want to keep, or give --force to overwrite"
        )


def _recorded(folder: Path) -> dict[str, str]:
    """Return the digests of the files as they were written, none if they cannot be read."""
    with suppress(OSError, ValueError, RecursionError):
        recorded = json.loads((folder / RECORD).read_bytes())
        if isinstance(recorded, dict):
            return recorded
    return {}


def _digest(file: Path) -> str:
    with file.open("rb") as content:
        return hashlib.file_digest(content, "sha256").hexdigest()
