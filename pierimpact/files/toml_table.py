"""TOML files of the user's own: read once, with their SHA-256."""

import hashlib
import tomllib
from pathlib import Path
from typing import Any, NamedTuple

from pierimpact.checks import InputError, shortened
from pierimpact.files.reading import read_text

_MOST = 64_000  # bytes; a longer file is none of ours: this project's choice


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
    content, text = read_text(path, _MOST)
    try:
        table = tomllib.loads(text)
    except ValueError as error:  # some are no TOMLDecodeError, as of a number too long
        raise InputError(f"is not valid TOML: {shortened(str(error), 200)}") from None
    except RecursionError:
        raise InputError("is not valid TOML: nested too deeply") from None
    return TomlFile(table, text, hashlib.sha256(content).hexdigest())
