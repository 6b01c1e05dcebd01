"""Locks between processes, which end with the process that has them, whatever ends it."""

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_PATIENCE = 60.0  # this project's choice: what is done under a lock takes milliseconds [s]
_PAUSE = 0.01  # this project's choice [s]


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep others, in this process or another, from changing the same folder meanwhile.

    On Windows, and in file systems without locks, it keeps nobody.

    Raises
    ------
    OSError
        When the folder cannot be opened, or another has had it for a minute.
    """
    if sys.platform == "win32":
        yield
        return
    place, end = os.open(folder, os.O_RDONLY), time.monotonic() + _PATIENCE
    try:
        while _lock(place) is False:
            if time.monotonic() > end:
                raise TimeoutError(0, "another run has had it for a minute")
            time.sleep(_PAUSE)
        yield
    finally:
        os.close(place)


@contextmanager
def held(file: Path) -> Iterator[None]:
    """Hold a new file, so that others can see by `is_held` that its owner lives."""
    at_once = sys.platform == "win32"  # where it is held by being open
    begun = file if at_once else file.with_name(f"{file.name}.part")
    place = os.open(begun, os.O_RDWR | os.O_CREAT)
    try:
        if not at_once:
            _lock(place)
            begun.rename(file)  # nobody sees it before it is held
        yield
    finally:
        os.close(place)


def is_held(file: Path) -> bool:
    """Whether a process holds the file, or may do so where there are no locks."""
    try:
        if sys.platform == "win32":
            file.unlink()  # which fails while it is open
            return False
        place = os.open(file, os.O_RDWR)
    except FileNotFoundError:
        return False
    except OSError:
        return True
    try:
        return _lock(place) is not True
    finally:
        os.close(place)


def _lock(place: int) -> bool | None:
    """Return whether what is open could be locked, or None where there are no locks."""
    if sys.platform != "win32":
        import fcntl

        try:
            fcntl.flock(place, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return True
        except BlockingIOError:
            return False
        except OSError:
            pass
    return None
