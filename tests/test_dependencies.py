"""What comes with an installation: the lock, licences and sizes are those of pyproject.toml."""

import re
import tomllib
from pathlib import Path

import dependencies
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parent.parent
LOCK = (ROOT / ".ci" / "lock.txt").read_text("utf-8")
# A name may have several versions, for one Python each.
LOCKED = re.findall(r"^([a-z0-9-]+)==(\S+)", LOCK, re.M)
TABLE = {
    name: (version, licence)
    for name, version, licence in re.findall(
        r"^\| ([a-z0-9-]+) \| (\S+) \| (.+) \| [\d.]+ \|$",
        dependencies.FILE.read_text("utf-8"),
        re.M,
    )
}
#: What others may be asked to install with pierimpact, and what its tests need besides.
FREE = re.compile(
    r"MIT|0?BSD|Public Domain|Apache|ISC|PSF|Python Software Foundation|MPL|Mozilla|Zlib|CC0"
)
ONLY_IN_TESTS = {"codespell", "openseespy", "openseespylinux"}


def declared():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    lists = [project["dependencies"], *project["optional-dependencies"].values()]
    return [Requirement(line) for lines in lists for line in lines]


def test_lock_and_table_have_what_is_declared():
    asked = {canonicalize_name(one.name): one.specifier for one in declared()}
    del asked["pierimpact"]  # its extras ask for one another
    assert asked.keys() - dict(LOCKED).keys() == set(), "renew them: .ci/lock"
    assert asked.keys() - TABLE.keys() == set(), "renew them: .ci/lock"
    locked = [(name, version) for name, version in LOCKED if name in asked]
    assert [f"{name} {version}" for name, version in locked if version not in asked[name]] == []


def test_the_table_is_that_of_the_lock():
    assert {(name, version) for name, (version, _) in TABLE.items()} <= set(LOCKED)
    assert "://" not in LOCK  # any index will do


def test_licences_are_free_ones():
    odd = {name for name, (_, licence) in TABLE.items() if not FREE.match(licence)}
    assert odd == ONLY_IN_TESTS
    assert "pandoc, GPL-2.0-or-later" in TABLE["pypandoc-binary"][1]
    for name in ONLY_IN_TESTS:
        assert name not in dependencies.brought("teach")


def test_the_report_brings_no_more_than_is_stated():
    stated = re.search(r"under (\d+) MB", (ROOT / "CONTRIBUTING.md").read_text("utf-8"))
    report = dependencies.brought("report")
    assert {"numpy", "pypandoc-binary", "typst"} <= report.keys()
    assert "jupyterlab" not in report
    assert 100 < dependencies.size(report) < int(stated[1])
