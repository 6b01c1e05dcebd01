"""The numbered blocks of a calculation sheet: tables, equations and figures.

The exporters number them, in the order they come.
"""

import base64
import html
from collections.abc import Sequence
from dataclasses import dataclass

from pierimpact.report.document.blocks import Block
from pierimpact.report.document.markup import Inline, tex_length, to_html, to_typst, typst_string

#: What a line of a formula begins with that goes on with the line before it.
CONTINUED = r"\qquad"


@dataclass(frozen=True, kw_only=True)
class Column:
    """A column of a table.

    Parameters
    ----------
    heading : str or Tex or tuple
        What it holds.
    align : {"left", "decimal"}, optional
        Numbers are aligned at their decimal points.
    wide : bool, optional
        Whether it takes the width that the others leave.
    """

    heading: Inline
    align: str = "left"
    wide: bool = False


@dataclass(frozen=True, kw_only=True)
class Table(Block):
    """A table with a caption above it.

    Parameters
    ----------
    label : str
        Anchor that text can refer to, such as "tab-inputs".
    caption : str or Tex or tuple
        What it shows.
    columns : sequence of Column
        Its columns.
    rows : sequence of sequences of str or Tex or tuple
        Its rows; the first cell of a row is its heading.
    strong : sequence of int, optional
        Rows that matter most.
    centred : bool, optional
        Whether cells are centred between the rows above and below, as tall formulas want it.
    """

    label: str
    caption: Inline
    columns: Sequence[Column]
    rows: Sequence[Sequence[Inline]]
    strong: Sequence[int] = ()
    centred: bool = False

    def _aligned(self) -> list[list[Inline]]:
        """Return the rows, with the numbers of decimal columns padded to equal decimals."""
        columns = [
            align_decimals([row[index] for row in self.rows])
            if column.align == "decimal"
            else [row[index] for row in self.rows]
            for index, column in enumerate(self.columns)
        ]
        return [list(row) for row in zip(*columns, strict=True)]

    def to_html(self) -> str:
        """Return the block as HTML."""
        classes = [f' class="{column.align}"' for column in self.columns]
        head = "".join(
            f'<th scope="col"{kind}>{to_html(column.heading)}</th>'
            for kind, column in zip(classes, self.columns, strict=True)
        )
        body = ""
        for index, row in enumerate(self._aligned()):
            first, *others = map(to_html, row)
            cells = "".join(
                f"<td{kind}>{cell}</td>" for kind, cell in zip(classes[1:], others, strict=True)
            )
            strong = ' class="strong"' if index in self.strong else ""
            body += f'<tr{strong}><th scope="row"{classes[0]}>{first}</th>{cells}</tr>'
        kinds = [] if any(column.wide for column in self.columns) else ["narrow"]
        kinds += ["centred"] * self.centred
        kind = f' class="{" ".join(kinds)}"' if kinds else ""
        return (
            f'<div class="table"><table{kind} id="{self.label}"><caption>{_numbered("Table")}'
            f"{to_html(self.caption)}</caption><thead><tr>{head}</tr></thead>"
            f"<tbody>{body}</tbody></table></div>"
        )

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        widths = ", ".join("1fr" if column.wide else "auto" for column in self.columns)
        aligns = ", ".join(
            ("right" if column.align == "decimal" else "left") + " + horizon" * self.centred
            for column in self.columns
        )
        inset = "inset: (x: 5pt, y: 5pt), " * self.centred
        head = "".join(f"[{to_typst(column.heading)}]," for column in self.columns)
        cells = "".join(
            f"strong[{to_typst(cell)}]," if index in self.strong else f"[{to_typst(cell)}],"
            for index, row in enumerate(self._aligned())
            for cell in row
        )
        return (
            f"#figure(kind: table, caption: [{to_typst(self.caption)}], "
            f"table({inset}columns: ({widths},), align: ({aligns},), table.header({head}), {cells}"
            f")) <{self.label}>"
        )


@dataclass(frozen=True, kw_only=True)
class Equation:
    """A numbered step: symbol = formula = substitution = result.

    Parameters
    ----------
    label : str
        Anchor that text can refer to, such as "eq-stiffness".
    name : str or Tex or tuple
        What is calculated.
    symbol : str
        Left-hand side, in LaTeX.
    lines : sequence of str
        Right-hand sides in LaTeX, one below the other.
    source : str or Tex or tuple, optional
        Where the formula is from.
    """

    label: str
    name: Inline
    symbol: str
    lines: Sequence[str]
    source: Inline = ""

    @property
    def long(self) -> bool:
        """Whether it wants the width of the page."""
        return max(map(tex_length, self.lines)) > 48

    @property
    def tex(self) -> str:
        """The step in LaTeX; lines that are continued have no equals sign."""
        lines = r" \\ ".join(
            f"& {line}" if line.startswith(CONTINUED) else f"&= {line}" for line in self.lines
        )
        return rf"\begin{{aligned}} {self.symbol} {lines} \end{{aligned}}"


@dataclass(frozen=True)
class Steps(Block):
    """Numbered equations, one below the other.

    Parameters
    ----------
    equations : sequence of Equation
        The steps, in the order they are taken.
    """

    equations: Sequence[Equation]

    def to_html(self) -> str:
        """Return the block as HTML."""
        rows = ""
        for step in self.equations:
            source = f"<small>{to_html(step.source)}</small>" if step.source else ""
            long = " long" if step.long else ""
            rows += (
                f'<div class="step{long}" id="{step.label}"><div>{to_html(step.name)}{source}</div>'
                f'<div class="math display">\\[{html.escape(step.tex)}\\]</div>'
                f'<span class="number" data-count="Equation"></span></div>'
            )
        return f'<div class="steps">{rows}</div>'

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        return "\n".join(
            f"#step([{to_typst(step.name)}], [{to_typst(step.source)}], "
            f"[#texblock({typst_string(step.tex)}) <{step.label}>])"
            for step in self.equations
        )


@dataclass(frozen=True, kw_only=True)
class Figure(Block):
    """A drawing with a caption below it.

    Parameters
    ----------
    label : str
        Anchor that text can refer to, such as "fig-history".
    caption : str or Tex or tuple
        What it shows.
    alt : str
        What it shows, for those who cannot see it.
    svg : str
        The drawing.
    """

    label: str
    caption: Inline
    alt: str
    svg: str

    def to_html(self) -> str:
        """Return the block as HTML."""
        data = base64.b64encode(self.svg.encode()).decode()
        return (
            f'<figure id="{self.label}"><img alt="{html.escape(self.alt)}" '
            f'src="data:image/svg+xml;base64,{data}"><figcaption>{_numbered("Figure")}'
            f"{to_html(self.caption)}</figcaption></figure>"
        )

    def to_typst(self) -> str:
        """Return the block as Typst markup."""
        image = f'image(bytes({typst_string(self.svg)}), format: "svg", width: 100%, '
        return (
            f"#figure(kind: image, caption: [{to_typst(self.caption)}], "
            f"{image}alt: {typst_string(self.alt)})) <{self.label}>"
        )


def align_decimals(cells: Sequence[Inline]) -> list[Inline]:
    """Pad numbers on the right so that, set flush right, their decimal points stand in line.

    Figure and punctuation spaces are as wide as a figure and a point.
    """
    decimals = [len(cell.partition(".")[2]) if isinstance(cell, str) else 0 for cell in cells]
    longest = max(decimals, default=0)
    padded: list[Inline] = []
    for cell, count in zip(cells, decimals, strict=True):
        if isinstance(cell, str) and cell[-1:].isdigit() and "×" not in cell:
            point = "\u2008" if longest and not count else ""
            padded.append(cell + point + "\u2007" * (longest - count))
        else:
            padded.append(cell)
    return padded


def _numbered(kind: str) -> str:
    return f'<span class="number" data-count="{kind}">{kind}.</span> '
