"""The addresses in the package's metadata: those of where git fetched the project from."""

import re
import subprocess
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

_REMOTE = re.compile(
    r"(?:(?:https?|ssh|git)://(?:[^@/]*@)?(?P<host>[\w.-]+)(?::\d+)?/|(?:[^@/:]+@)(?P<other>[\w.-]+):)"
    r"(?P<path>[\w./~-]+?)(?:\.git)?/?"
)


class Addresses(MetadataHookInterface):
    """Takes the addresses from the remote `origin`, as hatch-vcs takes the version from tags."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Set the project's URLs: none where its remote is not public."""
        home = _of_archive(Path(self.root)) or address(_origin(self.root))
        metadata["urls"] = {"Repository": home, "Issues": f"{home}/issues"} if home else {}


def address(remote: str) -> str | None:
    """Return the page of a remote, without names and passwords; None where it is not public."""
    match = _REMOTE.fullmatch(remote)
    host = match and (match["host"] or match["other"])
    public = host and re.search(r"\.[a-z]{2,}$", host)
    return f"https://{host}/{match['path']}" if match and public else None


def _origin(folder: str) -> str:
    try:
        git = ["git", "-C", folder, "remote", "get-url", "origin"]
        return subprocess.run(git, capture_output=True, text=True, check=False).stdout.strip()
    except OSError:  # there is no git
        return ""


def _of_archive(folder: Path) -> str | None:
    """Return the page that a source archive names, which has no remote."""
    information = folder / "PKG-INFO"
    if not information.is_file():
        return None
    text = information.read_text(encoding="utf-8")
    found = re.search(r"^Project-URL: Repository, (\S+)$", text, re.MULTILINE)
    return found and found[1]
