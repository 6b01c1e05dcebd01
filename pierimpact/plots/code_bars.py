"""The forces of codes beside what this collision does, as bars, for a page."""

from collections.abc import Mapping, Sequence
from typing import Any

from pierimpact.design.codes import CodeForce
from pierimpact.plots.bars import End, name_bars, write_ends
from pierimpact.plots.style import INK, SKY, TEXT_WIDTH, page_figure
from pierimpact.plots.svg import to_svg
from pierimpact.plots.words import shown
from pierimpact.units import unit_size

_ROW, _MARGIN, _NAMES = 3.2, 0.8, 56.0  # heights of a row and of a margin, width of names [mm]
_BAR = 0.68  # height of a bar, over that of its row
_LINE: dict[str, Any] = {"edgecolor": INK, "linewidth": 0.5}
_READ: dict[str, Any] = _LINE | {"facecolor": "#aab4bd"}
_UNVERIFIED: dict[str, Any] = _LINE | {"facecolor": "white", "hatch": "//////"}
_AVERAGE: dict[str, Any] = _LINE | {"facecolor": "#cfe6f7"}
_REACTION: dict[str, Any] = _LINE | {"facecolor": SKY}


def draw_code_bars(
    codes: Sequence[CodeForce],
    averages: Mapping[float, float],
    reaction: float,
    band: tuple[float, float] | None,
    system: str,
) -> str:
    """Draw the forces of codes below averages of the contact force and the reaction; return SVG.

    168 mm wide and, with twelve codes and three averages, 53 mm high. Hatched: a force that was
    neither read in the code nor cited by the source paper.

    Parameters
    ----------
    codes : sequence of CodeForce
        The clauses.
    averages : mapping of float to float
        Largest averages of the contact force [N] by their windows [s].
    reaction : float
        The design reaction [N].
    band : tuple of float or None
        Its values at 5 and 95 % [N].
    system : {"SI", "US"}
        Units to print in.
    """
    size = unit_size("force", system)
    name = "Peak reaction" + ("" if band is None else ", with its band, 5 to 95 %")
    rows = [(name, shown(reaction, "force", system), reaction, _REACTION)]
    for window, force in averages.items():
        words = f"Contact force, {shown(window, 'time', system, given=True)} average"
        rows.append((words, shown(force, "force", system), force, _AVERAGE))
    for code in codes:
        name, force = ", ".join(filter(None, (code.code, code.clause))), code.along.value
        words = shown(force, "force", system, given=code.stiffness is None)
        rows.append((name, words, force, _READ if code.along.verified else _UNVERIFIED))
    height = _ROW * len(rows) + 2.0 * _MARGIN
    margins = {"left": _NAMES, "right": 1.0, "bottom": _MARGIN, "top": _MARGIN}
    with page_figure(TEXT_WIDTH, height, **margins) as figure:
        axes = figure.add_subplot()
        ends = []
        for row, (_, words, force, look) in enumerate(rows):
            axes.barh(row, force / size, _BAR, **look)
            end = force / size
            if row == 0 and band is not None:
                low, high = (value / size for value in band)
                axes.plot([low, high], [0.0, 0.0], color=INK, linewidth=1.0, marker="|")
                words += f" ({' to '.join(shown(value, 'force', system) for value in band)})"
                end = max(end, high)
            ends.append(End(row, end, words))
        name_bars(axes, [name for name, *_ in rows])
        axes.set_xticks([])
        axes.spines["bottom"].set_visible(False)
        axes.axvline(0.0, color=INK, linewidth=0.8)
        write_ends(axes, ends, lowest=0.0)
        return to_svg(figure)
