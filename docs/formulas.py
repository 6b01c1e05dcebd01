"""A Sphinx extension: formulas as MathML, which browsers show without a program or a network.

pandoc, which makes the sheet's formulas too, converts all formulas of a page in one call.
"""

import html
import re
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx

from pierimpact.report.exporters import pandoc

_MATH = re.compile(r"<math.*?</math>", re.DOTALL)
_IN_OUTPUT = re.compile(r"\\\((.*?)\\\)", re.DOTALL)  # as a block of the sheet shows it


def _mathml(formulas: list[str]) -> list[str]:
    """Return LaTeX, each with its dollars, as MathML."""
    text = "\n\n".join(formulas)
    return _MATH.findall(pandoc("--from=markdown", "--to=html", "--mathml", text=text).decode())


def _convert(app: Sphinx, doctree: nodes.document, docname: str) -> None:
    """Keep with each formula of a page its MathML, and put it into the outputs of code."""
    if app.builder.format != "html":
        return
    inline, block = list(doctree.findall(nodes.math)), list(doctree.findall(nodes.math_block))
    outputs = [node for node in doctree.findall(nodes.raw) if _IN_OUTPUT.search(node.astext())]
    printed = [math for node in outputs for math in _IN_OUTPUT.findall(node.astext())]
    texts = [f"${node.astext().strip()}$" for node in inline]
    texts += [f"$${node.astext().strip()}$$" for node in block]
    texts += [f"${html.unescape(math).strip()}$" for math in printed]
    if not texts:
        return
    found = iter(_mathml(texts))
    for node in (*inline, *block):
        node["mathml"] = next(found)
    for node in outputs:
        changed = _IN_OUTPUT.sub(lambda _: next(found), node.astext())
        node.replace_self(nodes.raw("", changed, format="html"))


def _inline(translator: Any, node: Any) -> None:
    if "mathml" not in node:  # a heading's, where it is listed
        node["mathml"] = _mathml([f"${node.astext().strip()}$"])[0]
    translator.body.append(node["mathml"])
    raise nodes.SkipNode


def _block(translator: Any, node: Any) -> None:
    translator.body.append(f'<div class="math">{node["mathml"]}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the renderer and choose it."""
    app.connect("doctree-resolved", _convert)
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    app.config.html_math_renderer = "mathml"
    return {"parallel_read_safe": True, "parallel_write_safe": False}
