"""Writing files, all or none, whatever ends the run.

They are written to a temporary folder beside their places and moved there when all are whole. What
was there before is kept meanwhile, so that moves that fail are undone. A run that is killed leaves
its temporary folder: the next one that writes to the same place ends the moves, if these had
begun, and removes it.
"""

import atexit
import errno
import filecmp
import os
import secrets
import shutil
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from pierimpact.checks import InputError
from pierimpact.files.locks import held, is_held, locked

_TEMPORARY = ".pierimpact-"  # begins the names of temporary folders
# In these: the new files, those they replace, the same before they are all there, and a file held.
_NEW, _OLD, _INCOMPLETE, _HELD = "new", "old", "old.part", "held"

#: The files that this process has put in place, in order.
written: list[Path] = []

_temporary: list[Path] = []  # folders that are in use


def write_files(contents: Mapping[Path, bytes]) -> None:
    """Write files, all or none.

    Files in one folder are safe even from a run that is killed between their moves.

    Raises
    ------
    InputError
        When one cannot be written.
    """
    path = Path()
    try:
        with ExitStack() as stack:
            sets: dict[Path, list[Path]] = {}
            for path, content in contents.items():
                place = Path(os.path.realpath(path))  # what a link leads to
                _refuse_what_is_no_file(place)
                if place.parent not in sets:
                    sets[place.parent] = [stack.enter_context(temporary_folder(place.parent))]
                sets[place.parent].append(sets[place.parent][0] / place.name)
                sets[place.parent][-1].write_bytes(content)
            for folder, (_, *files) in sets.items():
                put_in_place(files, folder)
    except OSError as error:
        raise InputError(f"{path} cannot be written to: {error.strerror}") from None


def refuse_to_replace(path: Path, *, force: bool = False) -> None:
    """Refuse to write a file where there is one, unless forced, or where there can be none.

    Raises
    ------
    InputError
        When it must not be written.
    """
    if path.is_dir():
        raise InputError(f"{path} is a folder: name a file in it")
    if path.exists() and not force:
        raise InputError(f"{path} is there already: give --force to replace it")
    if not path.parent.is_dir():
        raise InputError(f"{path} cannot be written to: there is no folder {path.parent}")


@contextmanager
def temporary_folder(folder: Path) -> Iterator[Path]:
    """Make a temporary folder in a folder, for new files that are to be put in place there.

    Raises
    ------
    OSError
        When it cannot be made.
    """
    with ExitStack() as stack:
        with locked(folder):
            clean(folder)
            temporary = folder / f"{_TEMPORARY}{secrets.token_hex(8)}"
            stack.callback(_remove, temporary)
            _temporary.append(temporary)
            temporary.mkdir()
            stack.enter_context(held(temporary / _HELD))
            (temporary / _NEW).mkdir()
        yield temporary / _NEW


def put_in_place(files: Sequence[Path], folder: Path) -> list[Path]:
    """Move whole files from a temporary folder to its folder, all or none; return where they are.

    The last is moved first: it is the one most likely to be open in a viewer that locks it.

    Raises
    ------
    OSError
        When one cannot be moved.
    """
    with locked(folder):
        clean(folder)
        return move(files, folder)


def move(files: Sequence[Path], folder: Path) -> list[Path]:
    """Move files as `put_in_place`, in a folder that is `locked` and `clean`."""
    old, incomplete = (files[0].parents[1] / name for name in (_OLD, _INCOMPLETE))
    places, before = [folder / file.name for file in files], len(written)
    for left in (old, incomplete):  # of moves that failed
        shutil.rmtree(left, ignore_errors=True)
    incomplete.mkdir()
    kept = [place for place in places if _keep(place, incomplete / place.name)]
    new = [file.stat() for file in files]
    incomplete.rename(old)
    try:
        for file, place in reversed([*zip(files, places, strict=True)]):
            file.replace(place)
        written.extend(places)
    except BaseException:
        del written[before:]
        for place, stat in zip(places, new, strict=True):
            if place.exists() and os.path.samestat(place.stat(), stat):
                (old / place.name).replace(place) if place in kept else place.unlink()
        shutil.rmtree(old, ignore_errors=True)
        raise
    return places


def clean(folder: Path) -> None:
    """End what killed runs began in a folder that is `locked`, and remove what they left."""
    for temporary in folder.glob(f"{_TEMPORARY}*"):
        if is_held(temporary / _HELD):
            continue
        with suppress(OSError):
            for file in (temporary / _NEW).iterdir() if (temporary / _OLD).is_dir() else ():
                # What somebody changed since then stays.
                if _same(temporary / _OLD / file.name, folder / file.name):
                    file.replace(folder / file.name)
        shutil.rmtree(temporary, ignore_errors=True)


def _remove(temporary: Path) -> None:
    shutil.rmtree(temporary, ignore_errors=True)
    _temporary.remove(temporary)


@atexit.register
def _remove_all() -> None:
    """Remove what is left where an interrupt came in the midst of removing."""
    for temporary in _temporary:
        shutil.rmtree(temporary, ignore_errors=True)


def _refuse_what_is_no_file(place: Path) -> None:
    if place.is_dir():
        raise IsADirectoryError(errno.EISDIR, "there is a folder of that name", str(place))
    if place.exists() and not place.is_file():
        raise OSError(errno.EINVAL, "it is no regular file", str(place))


def _keep(place: Path, second: Path) -> bool:
    """Keep a file, if there is one, under a second name too; return whether there is."""
    _refuse_what_is_no_file(place)
    if not os.path.lexists(place):
        return False
    try:
        os.link(place, second, follow_symlinks=False)
    except OSError:  # not all file systems have links
        shutil.copy2(place, second, follow_symlinks=False)
    return True


def _same(one: Path, other: Path) -> bool:
    """Whether two files are the same, or neither exists."""
    if one.exists() and other.exists():
        return filecmp.cmp(one, other, shallow=False)
    return one.exists() == other.exists()
