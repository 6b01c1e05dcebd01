"""The files that come with the package."""

from pathlib import Path

PACKAGE = Path(__file__).parent


def shipped(name: str) -> Path:
    """Return a folder that comes with the package: "notebooks", "templates" or "trucks".

    In an installed package it is part of it; in a checkout it may stand beside it.
    """
    inside = PACKAGE / name
    return inside if inside.is_dir() else PACKAGE.parent / name
