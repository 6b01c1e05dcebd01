"""Files of others: read once, if they are regular and no longer than such a file would be."""

import os
import stat
from pathlib import Path

from pierimpact.checks import InputError

# Opening a fifo would wait for whoever writes to it.
_AT_ONCE = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


def read_content(path: Path, most: int) -> bytes:
    """Return the content of a file, so that what is checked, hashed and parsed is the same.

    Parameters
    ----------
    path : Path
        A regular file, or a link to one.
    most : int
        How long it may be [bytes].

    Raises
    ------
    InputError
        When it cannot be read, is no regular file (a folder, a device, a pipe), or is longer; the
        message goes on after the name of the file.
    """
    try:
        require_regular(path)
        with os.fdopen(os.open(path, os.O_RDONLY | _AT_ONCE), "rb") as file:
            _require_regular(os.fstat(file.fileno()).st_mode)
            content = file.read(most + 1)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}") from None
    if len(content) > most:
        size = f"{most // 1_000_000} MB" if most >= 1_000_000 else f"{most // 1000} kB"
        raise InputError(f"must be at most {size} long")
    return content


def read_text(path: Path, most: int) -> tuple[bytes, str]:
    """Return a file's content and its text in UTF-8, with or without a byte order mark.

    Arguments and errors as in `read_content`.
    """
    content = read_content(path, most)
    try:
        return content, content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise InputError(f"is not UTF-8 text: line {line} cannot be decoded") from None


def require_regular(path: Path) -> None:
    """Refuse what is no regular file, before it is opened: to open a device may do something.

    Raises
    ------
    InputError
        When it is a folder, a device or a pipe; the message goes on after the name of the file.
    OSError
        When it is not there.
    """
    _require_regular(path.stat().st_mode)


def _require_regular(mode: int) -> None:
    if stat.S_ISDIR(mode):
        raise InputError("cannot be read: Is a directory")
    if not stat.S_ISREG(mode):
        raise InputError("cannot be read: it is no regular file")
