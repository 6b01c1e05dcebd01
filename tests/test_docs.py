"""The documentation: it builds without a word of complaint, leads everywhere, fetches nothing."""

import doctest
import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from importlib import import_module
from pathlib import Path
from urllib.parse import unquote, urlsplit

import nbformat
import pytest
from sphinx.util.inventory import InventoryFile

import pierimpact

HOUSE = Path(__file__).parents[1]
DOCS = HOUSE / "docs"
RUN = [
    path
    for path in sorted(DOCS.rglob("*.md"))
    if "{code-cell}" in path.read_text("utf-8") and "notebooks" not in path.parts
]
# A directive of the reference, with the members that it names.
DIRECTIVE = re.compile(r"\.\. (auto\w+|currentmodule):: ([\w.]+)(?:\n   :members: ?(.*))?")


class _Page(HTMLParser):
    """What a page links to, and what it loads."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loads, self.anchors = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.anchors |= {found[name] for name in ("id", "name") if found.get(name)}
        if tag == "a" and found.get("href"):
            self.links.append(found["href"])
        loads = [
            found.get("src"),
            found.get("poster"),
            *re.split(r"[\s,]+", found.get("srcset", "")),
        ]
        if tag == "link" and found.get("rel") not in (
            "search",
            "index",
            "next",
            "prev",
            "canonical",
        ):
            loads.append(found.get("href"))
        self.loads += [address for address in loads if address]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", "-W", "-n", "--keep-going", "-q", "-t", "quick",
         "-d", folder / "doctrees", DOCS, folder / "html"],
        cwd=HOUSE, env=os.environ | {"PYTHONPATH": str(HOUSE)}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-5000:]
    assert done.stderr == ""
    return folder / "html"


@pytest.fixture(scope="module")
def pages(site):
    return {path: _Page(path.read_text("utf-8")) for path in site.rglob("*.html")}


def _target(page, link):
    """Return the file and the anchor that a link of a page leads to."""
    parts = urlsplit(link)
    file = (page.parent / unquote(parts.path)).resolve() if parts.path else page
    return file, unquote(parts.fragment)


def test_every_link_within_it_leads_somewhere(pages):
    broken = []
    for page, content in pages.items():
        for link in (*content.links, *content.loads):
            if urlsplit(link).scheme or link == "#":
                continue
            file, anchor = _target(page, link)
            found = pages.get(file)
            if not file.exists() or (anchor and found is not None and anchor not in found.anchors):
                broken.append((page.name, link))
    assert broken == []


def test_every_page_can_be_reached(site, pages):
    reached, more = set(), {site / "index.html"}
    while more:
        page = more.pop()
        reached.add(page)
        files = {_target(page, link)[0] for link in pages[page].links if not urlsplit(link).scheme}
        more |= (files & pages.keys()) - reached
    # The search box submits a form to its page.
    assert {page.name for page in pages.keys() - reached} <= {"search.html"}


def test_it_fetches_nothing(site, pages):
    for content in pages.values():
        away = [address for address in content.loads if re.match(r"(?:\w+:)?//", address)]
        assert away == []
    for sheet in site.rglob("*.css"):
        text = sheet.read_text("utf-8")
        assert not re.search(
            r"@import\s+(?:url\()?['\"]?(?:\w+:)?//|url\(\s*['\"]?(?:\w+:)?//", text
        )


def test_every_public_name_has_its_entry(site):
    with (site / "objects.inv").open("rb") as file:
        kinds = InventoryFile.load(file, "", lambda *parts: "/".join(parts)).values()
    entries = {name for kind in kinds for name in kind}
    wanted = {
        name: f"pierimpact.{name}"
        if f"pierimpact.{name}" in entries
        else getattr(getattr(pierimpact, name), "__name__", name)
        for name in pierimpact.__all__
    }
    assert {name for name, entry in wanted.items() if entry not in entries} == set()


def test_search_finds_words_of_all_parts(site):
    index = (site / "searchindex.js").read_text("utf-8")
    assert index.startswith("Search.setIndex(")  # a script: a page from a disk may load it
    for word in ("timoshenko", "sobol", "deadlin", "simul"):
        assert f'"{word}"' in index or f"{word}:" in index


def test_the_page_without_python_stands_in_one_of_the_site(site, pages):
    assert "explorer.html" in pages[site / "live.html"].loads
    assert "Content-Security-Policy" in (site / "explorer.html").read_text("utf-8")


def test_its_formulas_are_mathml(site):
    page = (site / "theory" / "cmsd.html").read_text("utf-8")
    prose = (DOCS / "theory" / "cmsd.md").read_text("utf-8")
    assert page.count("<math") == len(re.findall(r"\$\$.+?\$\$|\$[^$\n]+\$", prose, re.DOTALL))
    assert not re.search(r"\$\S[^$<]*\$", re.sub("<annotation.*?</annotation>", "", page))


@pytest.mark.parametrize("path", RUN, ids=lambda path: path.stem)
def test_code_of_a_page_runs(path):
    text = path.read_text("utf-8")
    scope = {}
    for cell in re.findall(r"```\{code-cell\}\n(?::.*\n)*(.*?)```", text, re.DOTALL):
        exec(compile(cell, path.name, "exec"), scope)


def test_notebook_of_the_how_to_runs(tmp_path, monkeypatch):
    path = DOCS / "how-to" / "own-notebook.ipynb"
    cells = [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]
    monkeypatch.chdir(tmp_path)  # it writes a figure
    scope = {}
    for cell in cells:
        assert cell.outputs == []
        assert cell.execution_count is None
        exec(compile(cell.source, path.name, "exec"), scope)
    assert (tmp_path / "history.png").stat().st_size > 10_000


def _named(full):
    home, _, last = full.rpartition(".")
    return getattr(import_module(home), last)


def _documented():
    """Return the objects that the reference's directives name, by full name."""
    found = {}
    for page in sorted((DOCS / "reference").glob("*.md")):
        module = ""
        for kind, name, members in DIRECTIVE.findall(page.read_text("utf-8")):
            full = name if name.startswith("pierimpact") else f"{module}.{name}"
            if kind == "currentmodule":
                module = full
            elif kind == "automodule":
                own = vars(import_module(full))
                names = [each.strip() for each in members.split(",")] if members else [
                    each for each, value in own.items()
                    if getattr(value, "__module__", "") == full and not each.startswith("_")
                ]  # fmt: skip
                found |= {f"{full}.{each}": own[each] for each in names}
            else:
                found[full] = _named(full)
    return found


DOCUMENTED = _documented()


def test_examples_are_asked_of_every_entry_of_the_reference(site):
    with (site / "objects.inv").open("rb") as file:
        entries = InventoryFile.load(file, "", lambda *parts: "/".join(parts))
    kinds = ("py:class", "py:exception", "py:function")
    named = {_named(name) for kind in kinds for name in entries.get(kind, {})}
    assert named == set(DOCUMENTED.values())


@pytest.mark.parametrize("name", DOCUMENTED)
def test_example_of_a_docstring_runs(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # Without the names of its module: an example imports all that it uses.
    finder = doctest.DocTestFinder(recurse=False)
    tests = [test for test in finder.find(DOCUMENTED[name], name, globs={}) if test.examples]
    assert tests, f"{name} has no runnable example"
    found = []
    for test in tests:
        doctest.DocTestRunner().run(test, out=found.append)
    assert not found, "".join(found)
    assert list(tmp_path.iterdir()) == []
