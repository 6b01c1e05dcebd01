"""What the cases of an office share: `pierimpact.toml` beside a case file, and the logo."""

import base64
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple
from xml.parsers import expat

from pierimpact.checks import InputError, brief
from pierimpact.files.inputs import read_shared
from pierimpact.files.reading import read_content
from pierimpact.files.toml_table import read_toml

#: The file, in the folder of the case file, whose values stand for those a case does not give.
SHARED_FILE = "pierimpact.toml"

_MOST = 1_000_000  # bytes of a logo: this project's choice
# How the content of an image begins, and what it must have further on, by its MIME type.
_IMAGES = {
    "image/png": (b"\x89PNG\r\n\x1a\n", b"IEND"),
    "image/jpeg": (b"\xff\xd8\xff", b"\xff\xd9"),
}
_SVG = "http://www.w3.org/2000/svg"


@dataclass(frozen=True)
class Shared:
    """The values of a `pierimpact.toml`."""

    values: dict[str, Any]  #: by key, as the file has them
    sha256: str  #: of the file's bytes, in hexadecimal


class Logo(NamedTuple):
    """An image, as its file has it."""

    content: bytes
    mime: str  #: "image/png", "image/jpeg" or "image/svg+xml"

    @property
    def base64(self) -> str:
        """The content in base64."""
        return base64.b64encode(self.content).decode()


def read_shared_file(folder: Path) -> Shared | None:
    """Return what the cases of a folder share; None where it has no `pierimpact.toml`.

    Raises
    ------
    InputError
        When the file cannot be read, or has a key that it may not give or a value that breaks a
        rule; the message is one line that names the file.
    """
    path = folder / SHARED_FILE
    if not os.path.lexists(path):
        return None
    try:
        values, _, sha256 = read_toml(path)
        logo = read_shared(values, SHARED_FILE).logo
        if logo is not None:
            read_logo(logo, folder)
    except InputError as error:
        raise InputError(f"{SHARED_FILE}: {error}") from None
    return Shared(values, sha256)


def read_logo(name: str, folder: str | Path = ".") -> Logo:
    """Return a logo, of the kind that its content says; a relative path starts from `folder`.

    Raises
    ------
    InputError
        When it is not a regular file of at most 1 MB, or neither PNG nor JPEG nor SVG, or an SVG
        that is not well-formed or not of itself: with a script, an entity or a link to elsewhere.
    """
    shown = brief(name)
    try:
        content = read_content(Path(folder) / name, _MOST)
    except InputError as error:
        raise InputError(f"logo {shown} {error}") from None
    for mime, (start, within) in _IMAGES.items():
        if content.startswith(start):
            if within not in content:
                raise InputError(f"logo must be a whole image, got {shown} without its end")
            return Logo(content, mime)
    _check_svg(content, shown)
    return Logo(content, "image/svg+xml")


def _check_svg(content: bytes, shown: str) -> None:
    """Refuse what is no drawing that stands for itself."""
    depth = 0

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal depth
        space, _, tag = name.rpartition(" ")
        if depth == 0 and (space, tag) != (_SVG, "svg"):
            raise InputError(f"logo must be PNG, JPEG or SVG, got {shown} which begins <{tag}>")
        depth += 1
        if tag.lower() in ("script", "foreignobject"):
            raise InputError(f"logo must be an SVG without <{tag}>, got {shown}")
        for key, value in attributes.items():
            attribute = key.rpartition(" ")[2].lower()
            if attribute.startswith("on"):
                raise InputError(f"logo must be an SVG without {attribute}=…, got {shown}")
            elsewhere = not value.strip().startswith(("#", "data:image/"))
            if attribute == "href" and elsewhere:
                raise InputError(
                    f"logo must have all that it shows in itself, got {shown} with {brief(value)}"
                )

    def entity(*_: object) -> None:
        raise InputError(f"logo must be an SVG without entities of its own, got {shown}")

    parser = expat.ParserCreate(namespace_separator=" ")
    parser.StartElementHandler = start
    parser.EntityDeclHandler = entity
    try:
        parser.Parse(content, True)
    except (expat.ExpatError, LookupError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"logo must be PNG, JPEG or well-formed SVG, got {shown}") from None
