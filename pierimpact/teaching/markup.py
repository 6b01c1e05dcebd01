"""HTML that explorers, exercises and tables share, and the still beside a live widget."""

import html
import re
from collections.abc import Iterable, Sequence
from typing import Any
from unicodedata import lookup

import ipywidgets as ipw
from IPython.display import display

from pierimpact.plots import style

#: Colours of text and of what stands back: those of JupyterLab's theme, where there is one.
INK = f"var(--jp-ui-font-color1, {style.INK})"
MUTED = f"var(--jp-ui-font-color2, {style.MUTED})"
#: Ground of what stands out.
GROUND = "var(--jp-layout-color2, #f6f8fa)"
_WARNED = f"border-left:4px solid {style.ORANGE};background:{GROUND}"
#: Line beside what asks something.
FRAME = f"3px solid {style.GREY}"

# Live widgets and their still stand side by side in a notebook's output; one of them shows. In
# Voilà that is the widgets, in JupyterLab too as long as they have their kernel. A notebook opened
# again has none, but a word of JupyterLab on what is missing, which bears no type as other outputs
# do: the still shows instead. In a page made from the notebook, where widgets are dead, it does,
# too. A frame does not see JupyterLab's theme, but takes the colour scheme of its element; nor does
# it grow with what is in it, but has a height for each of three widths.
_LIVE, _STILL = "pierimpact-live", "pierimpact-still"
_LIVES = f":has(.{_LIVE}:not(.jupyter-widgets-disconnected))"
_STYLE = (
    f"<style>.jp-NotebookPanel .jp-OutputArea{_LIVES} .{_STILL}, "
    f"body[data-voila] .{_STILL}, "
    f".jp-NotebookPanel .jp-OutputArea:has(.{_STILL}):not({_LIVES}) "
    ".jp-OutputArea-output:not([data-mime-type]) {display:none} "
    f"body.jp-Notebook:not([data-voila]) .{_LIVE} {{display:none}} "
    f".{_STILL} iframe {{color-scheme:light}} "
    f"[data-jp-theme-light=false] .{_STILL} iframe {{color-scheme:dark}} "
    f".{_STILL} figure {{container-type:inline-size}} "
    f".{_STILL} iframe {{height:var(--narrow)}} "
    f"@container (min-width:47rem) {{.{_STILL} iframe {{height:var(--middling)}}}} "
    f"@container (min-width:60rem) {{.{_STILL} iframe {{height:var(--wide)}}}}</style>"
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


def paragraph(content: str, css: str = "padding:3px 0", role: str = "") -> str:
    """Return HTML as a paragraph in the colour of text; `role` is for screen readers."""
    kind = f' role="{role}"' if role else ""
    return f'<div{kind} style="color:{INK};line-height:1.45;{css}">{content}</div>'


def refusal(words: str) -> str:
    """Return the sentence that stands where a figure would be."""
    return paragraph(html.escape(words), f"{_WARNED};padding:14px 16px", role="alert")


def muted(content: str) -> str:
    """Return HTML as a remark that stands back."""
    return f'<div style="color:{MUTED}">{content}</div>'


def choice_list(choices: Iterable[str]) -> str:
    """Return choices as a list, nothing where there are none."""
    items = "".join(f"<li>{html.escape(words)}</li>" for words in choices)
    return items and f'<ul style="color:{INK}">{items}</ul>'


def table(
    heads: Sequence[str],
    rows: Sequence[Sequence[str]],
    *,
    right: Sequence[int] = (),
) -> str:
    """Return a table of plain text, which is scrolled by itself where it is too wide.

    Parameters
    ----------
    heads : sequence of str
        Headings of the columns.
    rows : sequence of sequences of str
        The rows; the first cell of a row is its heading.
    right : sequence of int, optional
        Columns of numbers, set flush right.
    """

    def cell(kind: str, column: int, words: str, css: str = "") -> str:
        align = "text-align:right" if column in right else "text-align:left"
        if column in right and kind == "td":
            align += ";white-space:nowrap"
        return (
            f'<{kind} style="padding:3px 12px 3px 0;vertical-align:top;{align}{css}">'
            f"{html.escape(words)}</{kind}>"
        )

    head = "".join(cell("th", column, words) for column, words in enumerate(heads))
    body = ""
    for first, *others in rows:
        cells = "".join(cell("td", column, words) for column, words in enumerate(others, 1))
        body += f"<tr>{cell('th', 0, first, ';font-weight:400')}{cells}</tr>"
    return (
        '<div class="table" style="overflow-x:auto"><table style="border-collapse:collapse">'
        f'<thead><tr style="color:{MUTED}">{head}</tr></thead><tbody>{body}</tbody></table></div>'
    )


def still(content: str) -> str:
    """Return HTML that shows only where widgets are dead: in a page made from the notebook."""
    return f'{_STYLE}<div class="{_STILL}" style="margin:0.7em 0">{content}</div>'


def show(widget: ipw.Widget, shown_instead: str, text: str = "") -> None:
    """Display a widget, with what stands for it where it is dead as a `still` and in plain text."""
    shown = Shown(widget, text)
    shown.instead(shown_instead)
    shown.display()


class Shown:
    """A widget, and what stands for it where it is dead.

    Parameters
    ----------
    widget : Widget
        The widget.
    text : str, optional
        Title that stands for it in plain text.
    """

    def __init__(self, widget: ipw.Widget, text: str = "") -> None:
        self._widget, self._text = widget, text
        self._instead = ""
        self._handle: Any = None
        widget.add_class(_LIVE)

    def instead(self, content: str) -> None:
        """Set what stands for the widget, a `still`; the notebook saves what was set last."""
        changed, self._instead = content != self._instead, content
        if self._handle is not None and changed:
            self._handle.update(self._bundle, raw=True)

    def display(self) -> None:
        """Display both."""
        # A page made from the notebook would show the widget's plain text.
        display(self._widget, exclude=["text/plain"])  # type: ignore[no-untyped-call]
        self._handle = display(self._bundle, raw=True, display_id=True)  # type: ignore[no-untyped-call]

    @property
    def _bundle(self) -> dict[str, str]:
        return {"text/html": self._instead, "text/plain": self._text}
