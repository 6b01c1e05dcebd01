"""What moves the governing reaction, one thing at a time, the most first; for a page."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from pierimpact.collision.parameters import Collision
from pierimpact.design.band import ReactionBand
from pierimpact.design.sensitivity import NEAR, SHARES, Sensitivity, Variation
from pierimpact.plots.bars import End, name_bars, write_ends
from pierimpact.plots.style import BLUE, INK, SKY, TEXT_WIDTH, page_figure, trim_ticks
from pierimpact.plots.svg import to_svg
from pierimpact.plots.words import shown
from pierimpact.symbols import BY_KEY
from pierimpact.units import unit_of, unit_size

_ROW, _TOP, _BOTTOM, _NAMES = 3.6, 4.0, 9.0, 56.0  # [mm]
_BAR = 0.62  # height of a bar, over that of its row
_FEWEST, _MOST = 4, 8  # rows, the others move the reaction less
_LEAST = 0.002  # of the reaction, by which a change that is drawn moves it
_LINE: dict[str, Any] = {"edgecolor": INK, "linewidth": 0.5}
_LESS: dict[str, Any] = _LINE | {"facecolor": SKY}
_MORE: dict[str, Any] = _LINE | {"facecolor": BLUE}


class Change(NamedTuple):
    """A quantity at two other values, and the governing reaction there; nan where there is none."""

    name: str
    values: tuple[str, str]  #: the lower and the higher, in words
    reactions: tuple[float, float]  #: [N]

    def width(self, nominal: float) -> float:
        """Return by how much it moves the reaction in all [N]."""
        ends = [nominal, *(value for value in self.reactions if np.isfinite(value))]
        return max(ends) - min(ends)


def draw_tornado(sensitivity: Sensitivity, band: ReactionBand, reaction: float, system: str) -> str:
    """Draw the governing reaction of the full model as one thing changes at a time; return SVG.

    168 mm wide and at most 60 mm high. Each end says which value it stands for.

    Parameters
    ----------
    sensitivity : Sensitivity
        Reactions at other speeds, masses, impact heights and pier frequencies.
    band : ReactionBand
        Those with each of the truck's parameters at either end of its spread.
    reaction : float
        The governing reaction of the case [N].
    system : {"SI", "US"}
        Units to print in.
    """
    changes = [*_by_sensitivity(sensitivity, band.collision, system), *_by_spread(band)]
    changes.sort(key=lambda change: -change.width(reaction))
    moving = sum(change.width(reaction) >= _LEAST * reaction for change in changes)
    changes = changes[: min(max(moving, _FEWEST), _MOST)]
    size = unit_size("force", system)
    height = _ROW * len(changes) + _TOP + _BOTTOM
    margins = {"left": _NAMES, "right": 1.0, "bottom": _BOTTOM, "top": _TOP}
    with page_figure(TEXT_WIDTH, height, **margins) as figure:
        axes = figure.add_subplot()
        nominal = reaction / size
        ends = [
            end
            for row, change in enumerate(changes)
            for end in _draw_row(axes, row, change, nominal, size, system)
        ]
        name_bars(axes, [change.name for change in changes])
        axes.axvline(nominal, color=INK, linewidth=1.0)
        write_ends(axes, ends or [End(0.0, nominal, "")])
        trim_ticks(axes, 0.04, lowest=0.0)
        axes.set_xlabel(f"Governing reaction [{unit_of('force', system)}]")
        words = f"this case {shown(reaction, 'force', system)}"
        axes.annotate(
            words, (nominal, 1.0), (0.0, 2.0), xycoords=("data", "axes fraction"),
            textcoords="offset points", ha="center", va="bottom",
        )  # fmt: skip
        return to_svg(figure)


def _draw_row(
    axes: Axes, row: int, change: Change, nominal: float, size: float, system: str
) -> list[End]:
    """Draw the bars of a change, the shorter in front; return their words."""
    ends: list[tuple[float, str]] = []
    drawn = zip(change.values, np.divide(change.reactions, size), (_LESS, _MORE), strict=True)
    for words, value, look in sorted(drawn, key=lambda own: -abs(own[1] - nominal)):
        if np.isfinite(value):
            axes.barh(row, value - nominal, _BAR, nominal, **look)
            number = shown(value * size, "force", system).removesuffix(
                f" {unit_of('force', system)}"
            )
            ends.append((value, f"{words}: {number}"))
    beside = {
        right: [own for own in ends if (own[0] >= nominal) == right] for right in (False, True)
    }
    return [
        End(row, own[0][0], ", ".join(words for _, words in own), right)
        for right, own in beside.items()
        if own
    ]


def _by_sensitivity(found: Sensitivity, collision: Collision, system: str) -> Iterator[Change]:
    """Yield the changes of speed, mass, impact height and pier frequency."""
    height = float(found.impact_height.values[0]) / SHARES[0]
    frequency = collision.equivalent_pier.frequency
    for name, quantity, ends in (
        ("Speed $V$", "speed", (found.slower, found.faster)),
        ("Truck mass $m_1 + m_2$", "mass", (found.lighter, found.heavier)),
        ("Impact height $z_\\mathrm{n}$", "length", _beside(found.impact_height, height)),
        ("Pier frequency $f_\\mathrm{p}$", "frequency", _beside(found.frequency, frequency)),
    ):
        words, reactions = zip(
            *(
                ("", np.nan)
                if own is None
                else (_value(float(own.values[0]), quantity, system), float(own.model[0]))
                for own in ends
            ),
            strict=True,
        )
        yield Change(name, words, reactions)


def _value(value: float, quantity: str, system: str) -> str:
    return shown(value, quantity, system, given=quantity != "frequency")


def _beside(variation: Variation, here: float) -> list[Variation | None]:
    """Return the calculated values nearest to a share below and above; None where there is none."""
    found: list[Variation | None] = []
    for wanted in (here * (1.0 - NEAR), here * (1.0 + NEAR)):
        i = int(np.argmin(np.abs(variation.values - wanted)))
        near = abs(variation.values[i] - wanted) < 0.5 * abs(here - wanted)
        found.append(Variation._make(own[i : i + 1] for own in variation) if near else None)
    return found


def _by_spread(band: ReactionBand) -> Iterator[Change]:
    """Yield the changes of each parameter of the truck within its spread."""
    for name, reactions in band.tornado.items():
        symbol = BY_KEY[name]
        words = tuple(
            f"{100.0 * (end - 1.0):+.0f} %".replace("-", "−") for end in band.spread[name].ends
        )
        yield Change(f"{symbol.heading} ${symbol.latex}$", (words[0], words[1]), reactions)
