"""How Sphinx builds the documentation: one command, in CONTRIBUTING.md, without a network.

With the tag `quick` no page's code is executed: what it makes is left out.
"""

import shutil
import sys
from pathlib import Path
from typing import Any

import pierimpact

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

# The gallery is the folder of the notebooks, and links lead to it: Sphinx wants it among its pages.
shutil.rmtree(HERE / "notebooks", ignore_errors=True)
shutil.copytree(HERE.parent / "notebooks", HERE / "notebooks")

project = "pierimpact"
author = "The pierimpact authors"
version = release = pierimpact.__version__

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "formulas"]
exclude_patterns = ["_build", "notebooks/report.ipynb"]
nitpicky = True
default_role = "code"

# Reference: what there is to say of a type stands in the docstring.
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
napoleon_google_docstring = False
napoleon_use_param = False
napoleon_use_rtype = False

# Pages: Markdown, with formulas and with what their code makes.
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
nb_execution_mode = "cache"
# Widgets and blocks stand beside HTML that shows the same.
suppress_warnings = ["mystnb.mime_priority", "mystnb.unknown_mime_type"]
if "quick" in globals()["tags"]:
    nb_execution_mode = "off"
    suppress_warnings.append("myst-nb.lexer")  # the kernel would say which language it is
nb_execution_cache_path = str(HERE / "_build" / "executed")
nb_execution_timeout = 300
nb_execution_raise_on_error = True
# A page has no kernel: of each output, what stands without one, and nothing fetched for widgets.
nb_mime_priority_overrides = [
    ("html", "application/vnd.jupyter.widget-view+json", None),
    ("html", "text/html", 0),
]
nb_ipywidgets_js: dict[str, Any] = {}

html_theme = "furo"
html_title = "pierimpact"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_domain_indices = False
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False
linkcheck_anchors = False


def setup(app: Any) -> None:
    """Read docstrings as they are meant, and write the page without Python beside the others."""
    app.connect("autodoc-process-docstring", _keep_colons, priority=100)
    app.connect("build-finished", _write_live_page)


def _keep_colons(_: Any, what: str, __: str, ___: Any, ____: Any, lines: list[str]) -> None:
    if what == "property":  # napoleon takes what is before a colon for a type
        lines[0] = f": {lines[0]}"


def _write_live_page(app: Any, exception: Exception | None) -> None:
    if exception is None and app.builder.format == "html":
        from pierimpact.teaching.page import write_page

        write_page(Path(app.outdir) / "explorer.html")
