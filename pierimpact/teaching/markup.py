"""HTML that explorers, exercises and tables share, and the still beside a live widget."""

import html
import re
from collections.abc import Sequence
from unicodedata import lookup

import ipywidgets as ipw
from IPython.display import display

from pierimpact.plots.style import INK, MUTED, ORANGE

# Live widgets and their still stand side by side in a notebook's output; one of them shows. In
# JupyterLab and Voilà that is the widgets. In a page exported from the notebook, where they would
# be dead, it is the still.
_LIVE, _STILL = "pierimpact-live", "pierimpact-still"
_STYLE = (
    f"<style>.jp-NotebookPanel .{_STILL}, body[data-voila] .{_STILL} {{display:none}} "
    f"body.jp-Notebook:not([data-voila]) .{_LIVE} {{display:none}}</style>"
)


def indexed(words: str) -> str:
    """Return plain text as HTML, with symbols such as f_p set in italics with their index."""
    return re.sub(r"\b([^\W\d_])_(\w+)\b", _italic, html.escape(words))


def symbol(latex: str) -> str:
    """Return a symbol of `pierimpact.symbols` as HTML."""
    plain = re.sub(r"\\mathrm|[{}]", "", latex)
    plain = re.sub(r"\\([a-z]+)", lambda name: lookup(f"GREEK SMALL LETTER {name[1]}"), plain)
    return re.sub(r"([^\W\d_])(?:_(\w+))?", _italic, plain)


def _italic(match: re.Match[str]) -> str:
    letter, index = match.groups()
    return f"<i>{letter}</i>" + (f"<sub>{index}</sub>" if index else "")


def paragraph(content: str, style: str = "padding:3px 0", role: str = "") -> str:
    """Return HTML as a paragraph in the colour of text; `role` is for screen readers."""
    kind = f' role="{role}"' if role else ""
    return f'<div{kind} style="color:{INK};line-height:1.45;{style}">{content}</div>'


def refusal(words: str) -> str:
    """Return the sentence that stands where a figure would be."""
    style = f"border-left:4px solid {ORANGE};background:#fff8ec;padding:14px 16px"
    return paragraph(html.escape(words), style, role="alert")


def named_values(items: Sequence[tuple[str, object, str]]) -> str:
    """Return values side by side: the name of each as HTML, the value, and what it is."""
    cells = "".join(
        f'<div title="{html.escape(hint)}" style="padding:2px 18px 2px 0">'
        f'<div style="font-size:11px;color:{MUTED}">{name}</div>'
        f'<div style="font-size:16px;font-weight:600;color:{INK};white-space:nowrap">'
        f"{html.escape(str(value))}</div></div>"
        for name, value, hint in items
    )
    return f'<div style="display:flex;flex-wrap:wrap;line-height:1.35">{cells}</div>'


def table(
    heads: Sequence[str],
    rows: Sequence[Sequence[str]],
    *,
    right: Sequence[int] = (),
    colours: Sequence[str] = (),
) -> str:
    """Return a table of plain text.

    Parameters
    ----------
    heads : sequence of str
        Headings of the columns.
    rows : sequence of sequences of str
        The rows; the first cell of a row is its heading.
    right : sequence of int, optional
        Columns of numbers, set flush right.
    colours : sequence of str, optional
        Colour of the heading of each row.
    """

    def cell(kind: str, column: int, words: str, style: str = "") -> str:
        align = "text-align:right;white-space:nowrap" if column in right else "text-align:left"
        return (
            f'<{kind} style="padding:3px 12px 3px 0;vertical-align:top;{align}{style}">'
            f"{html.escape(words)}</{kind}>"
        )

    head = "".join(cell("th", column, words) for column, words in enumerate(heads))
    styles = [f";color:{colour}" for colour in colours] or [";font-weight:400"] * len(rows)
    body = ""
    for (first, *others), style in zip(rows, styles, strict=True):
        cells = "".join(cell("td", column, words) for column, words in enumerate(others, 1))
        body += f"<tr>{cell('th', 0, first, style)}{cells}</tr>"
    return (
        f'<table style="border-collapse:collapse"><thead><tr style="color:{MUTED}">{head}</tr>'
        f"</thead><tbody>{body}</tbody></table>"
    )


def still(content: str) -> str:
    """Return HTML that shows only where widgets are dead: in a page made from the notebook."""
    return f'{_STYLE}<div class="{_STILL}" style="margin:0.7em 0">{content}</div>'


def show(widget: ipw.Widget, shown_instead: str, text: str = "") -> None:
    """Display a widget, with what stands for it where it is dead as a `still` and in plain text."""
    widget.add_class(_LIVE)
    display(widget)  # type: ignore[no-untyped-call]
    display({"text/html": shown_instead, "text/plain": text}, raw=True)  # type: ignore[no-untyped-call]
