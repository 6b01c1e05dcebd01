"""TOML files of the user's own: read once, with their SHA-256."""

import hashlib
import tomllib
from pathlib import Path
from typing import Any, NamedTuple

from pierimpact.checks import InputError

_MOST = 65_536  # bytes; a longer file is none of ours: this project's choice


class TomlFile(NamedTuple):
    """A TOML file, read once."""

    table: dict[str, Any]
    text: str
    sha256: str  #: of its bytes, in hexadecimal


def read_toml(path: Path) -> TomlFile:
    """Return a TOML file.

    Raises
    ------
    InputError
        When the file cannot be read, is too long, or is not TOML.
    """
    try:
        with path.open("rb") as file:
            content = file.read(_MOST + 1)
        if len(content) > _MOST:
            raise InputError(f"must be at most {_MOST // 1024} kB")
        text = content.decode("utf-8-sig")
        table = tomllib.loads(text)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError("is not UTF-8 text") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"is not valid TOML: {error}") from None
    except RecursionError:
        raise InputError("is not valid TOML: nested too deeply") from None
    return TomlFile(table, text, hashlib.sha256(content).hexdigest())
