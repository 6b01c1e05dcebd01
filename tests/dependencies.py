"""What installing pierimpact brings along: licences and sizes, by extra.

`python tests/dependencies.py` writes DEPENDENCIES.md; `.ci/lock` does so where just the versions of
the lock are installed.
"""

from importlib.metadata import Distribution, distribution
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

FILE = Path(__file__).parent.parent / "DEPENDENCIES.md"
PROJECT = "pierimpact"
#: What a package ships beyond what its licence speaks of.
SHIPS = {
    "axe-core-python": "; ships axe-core, MPL-2.0",
    "openseespy": "own terms: free for research, education and internal use",
    "openseespylinux": "own terms: free for research, education and internal use",
    "pypandoc-binary": "; **ships the program pandoc, GPL-2.0-or-later**",
}
HEAD = """# What gets installed

Measured on Linux, x86-64, with the versions of `.ci/lock.txt`; `.ci/lock` writes this page. Why
each is needed is in CONTRIBUTING.md. pierimpact itself is MIT. `pypandoc_binary` states MIT for its
Python code and ships the program pandoc, which is GPL-2.0-or-later. pierimpact runs pandoc as a
program of its own and contains nothing of it; who passes it on, in an image or on a medium, keeps
to the GPL, its source included. What only `[test]` brings is on no user's machine.
"""


def brought(extra: str = "") -> dict[str, Distribution]:
    """Return what the project with an extra needs, by name, as far as this machine does."""
    found: dict[str, Distribution] = {}
    asked, seen = [(PROJECT, extra)], set()
    while asked:
        name, wanted = asked.pop()
        if (name, wanted) in seen:
            continue
        seen.add((name, wanted))
        found[name] = distribution(name)
        for line in found[name].requires or []:
            needed = Requirement(line)
            if needed.marker is None or needed.marker.evaluate({"extra": wanted}):
                asked += [(canonicalize_name(needed.name), more) for more in ("", *needed.extras)]
    del found[PROJECT]
    return dict(sorted(found.items()))


def licence(package: Distribution) -> str:
    """Return the licence that the metadata of a package state."""
    name = canonicalize_name(package.name)
    if "own terms" in SHIPS.get(name, ""):
        return SHIPS[name]
    about = package.metadata
    classes = [
        line.split(" :: ")[-1].removesuffix(" License")
        for line in about.get_all("Classifier", [])
        if line.startswith("License :: ")
    ]
    stated = about["License-Expression"] or ", ".join(classes) or about["License"] or "not stated"
    return stated.strip() + SHIPS.get(name, "")


def size(packages: dict[str, Distribution]) -> float:
    """Return what packages take on disk [MB], without what Python compiles."""
    files = {
        Path(file.locate())
        for package in packages.values()
        for file in package.files or []
        if file.suffix != ".pyc"
    }
    return sum(file.stat().st_size for file in files if file.is_file()) / 1e6


def page() -> str:
    """Return DEPENDENCIES.md for what is installed here."""
    parts, before = [HEAD], {}
    for extra in ("", *distribution(PROJECT).metadata.get_all("Provides-Extra", [])):
        all_of = brought(extra)
        new = {name: package for name, package in all_of.items() if name not in before}
        before |= new
        name = f"{PROJECT}[{extra}]" if extra else PROJECT
        parts.append(
            f"\n## {name}: {len(all_of)} packages, {size(all_of):.0f} MB\n\n"
            "| package | version | licence | MB |\n|---|---|---|---|\n"
        )
        parts += [
            f"| {name} | {package.version} | {licence(package)} | {size({name: package}):.1f} |\n"
            for name, package in new.items()
        ]
    return "".join(parts)


if __name__ == "__main__":
    FILE.write_text(page(), encoding="utf-8")
