"""Writing files, all or none."""

from collections.abc import Mapping
from pathlib import Path

from pierimpact.checks import InputError


def write_files(contents: Mapping[Path, bytes]) -> None:
    """Write files, all or none.

    Raises
    ------
    InputError
        When one cannot be written.
    """
    parts = {path: path.with_name(f".{path.name}.part") for path in contents}
    path = Path()
    try:
        for path, content in contents.items():
            parts[path].write_bytes(content)
            if path.is_dir():
                raise IsADirectoryError(0, "there is a folder of that name")
        for path, part in parts.items():
            part.replace(path)
    except OSError as error:
        raise InputError(f"{path} cannot be written to: {error.strerror}") from None
    finally:
        for part in parts.values():
            part.unlink(missing_ok=True)
