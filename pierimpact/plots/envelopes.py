"""Shear and moment over the height of a column, by two methods and of both signs, for a page."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from pierimpact.files.case import Part
from pierimpact.pier.column import PierColumn
from pierimpact.pier.member_forces import MemberForceHistory, MemberForces
from pierimpact.plots.ends import end_labels, mark_ends
from pierimpact.plots.labels import Label, place
from pierimpact.plots.style import BLUE, INK, TEXT_WIDTH, VERMILION, page_figure, trim_ticks
from pierimpact.plots.svg import to_svg
from pierimpact.plots.words import named, shown
from pierimpact.symbols import SYMBOLS
from pierimpact.units import unit_of, unit_size

Array = NDArray[np.float64]
#: Of an impact: static member forces, those as the pier swings back, and those of the beam.
Impact: TypeAlias = tuple[MemberForces, MemberForces, MemberForceHistory | None]

_ENVELOPE = "#dbe9f4"
_STATIC: dict[str, Any] = {"color": VERMILION, "linewidth": 1.1, "dashes": (5, 2)}
_REVERSED: dict[str, Any] = {"color": VERMILION, "linewidth": 0.9, "dashes": (1.5, 1.5)}
_RESISTANCE: dict[str, Any] = {"color": INK, "linewidth": 1.2, "dashes": (9, 2, 2, 2)}
_BAND: dict[str, Any] = {"color": INK, "linewidth": 1.0, "marker": "|"}
# Left free above and below the column, and below the bands, over its height.
_ROOM, _BAND_ROOM = 0.1, 0.1
_FAR = 1.8  # a resistance so many times beyond the largest demand is not drawn
_HEIGHTS = 601  # at which the envelope of several impacts is taken


class _Quantity(NamedTuple):
    name: str
    kind: str
    symbol: str
    resistance: str


_QUANTITIES = (
    _Quantity("shear", "force", "V", "V_R"),
    _Quantity("moment", "moment", "M", "M_R"),
)


def draw_envelopes(
    impacts: Sequence[Impact],
    parts: Sequence[Part],
    bands: Mapping[str, tuple[float, float]],
    system: str,
    column: PierColumn | None = None,
) -> str:
    """Draw the envelopes of shear and moment side by side, with the resistances; return SVG.

    168 × 72 mm. Filled: the column as a beam; dashed: under the reaction as a static force; dotted:
    under the smallest reaction, as the pier swings back. At the foot: bands of the largest ones.

    Parameters
    ----------
    impacts : sequence of tuple
        For each impact height the static member forces, those under the smallest reaction, and
        those of the column as a beam, or None where it was not calculated.
    parts : sequence of Part
        Parts of the column with what they resist, upward.
    bands : mapping of str to tuple of float
        Of the largest "shear" [N] and "moment" [N m] the values at 5 and 95 %, with their sign;
        empty without a spread.
    system : {"SI", "US"}
        Units to print in.
    column : PierColumn, optional
        The column, for what holds its ends.
    """
    size = unit_size("length", system)
    bottom, *_, top = impacts[0][0].z / size
    room = _ROOM * (top - bottom)
    band = bottom - room  # height of the bands
    foot = band - (_BAND_ROOM * (top - bottom) if bands else 0.0)
    margins = {"left": 11.0, "right": 2.0, "bottom": 8.0, "top": 1.0}
    with page_figure(TEXT_WIDTH, 72.0, **margins, wspace=0.05) as figure:
        panels: Any = figure.subplots(1, 2, sharey=True)
        labels: list[Label] = []
        for axes, quantity in zip(panels, _QUANTITIES, strict=True):
            axes.set_ylim(foot, top + room)
            axes.axvline(0.0, color=INK, linewidth=0.6)
            for static, _, _ in impacts:
                axes.axhline(static.impact_height / size, color=INK, linewidth=0.4, dashes=(2, 3))
            found = _draw_beam(axes, impacts, quantity, system)
            found += _draw_static(axes, impacts, quantity, system)
            if quantity.name in bands:
                found.insert(0, _draw_band(axes, bands[quantity.name], band, quantity, system))
            labels += _draw_resistances(axes, parts, quantity, system) + found
            axes.locator_params(axis="x", nbins=6)
            trim_ticks(axes, 0.06)
            if column is not None:
                mark_ends(axes, column, size)
        first = panels[0]
        first.set_yticks([z for z in first.get_yticks() if bottom <= z <= top])
        first.set_ylabel(f"Height $z$ [{unit_of('length', system)}]")
        struck = sorted(static.impact_height for static, _, _ in impacts)
        # One label for all lines: of several, each would stand beside another's line.
        words = [named("z", struck[0], system)]
        words += [shown(height, "length", system, given=True) for height in struck[1:]]
        low, high = first.get_xlim()
        points = [(x, height / size) for height in struck for x in np.linspace(low, high, 15)]
        labels.append(Label(first, "\nand ".join(words), points))
        ends = [] if column is None else end_labels(first, column, size)
        place(figure, ends + labels)
        return to_svg(figure)


def _draw_beam(
    axes: Axes, impacts: Sequence[Impact], quantity: _Quantity, system: str
) -> list[Label]:
    """Draw the envelope of the beam over all impacts; return its extremes as labels."""
    size, unit = unit_size("length", system), unit_size(quantity.kind, system)
    beams = [beam for _, _, beam in impacts if beam is not None]
    if not beams:
        return []
    z = np.linspace(beams[0].z[0], beams[0].z[-1], _HEIGHTS)
    z = np.unique(np.concatenate([z, *(beam.z for beam in beams)]))
    ends = {}
    for side, extreme in (("smallest", np.min), ("largest", np.max)):
        of_each = [np.interp(z, beam.z, getattr(beam, f"{side}_{quantity.name}")) for beam in beams]
        ends[side] = extreme(of_each, axis=0) / unit
    heights = z / size
    axes.fill_betweenx(heights, ends["smallest"], ends["largest"], color=_ENVELOPE, linewidth=0.0)
    labels = []
    for side, values in ends.items():
        axes.plot(values, heights, color=BLUE, linewidth=0.9)
        extremes = [getattr(getattr(beam, f"{quantity.name}_extremes"), side) for beam in beams]
        extreme = max(extremes, key=lambda own: abs(own.value))
        point = extreme.value / unit, extreme.z / size
        axes.plot(*point, "o", color=BLUE, markersize=3.5, clip_on=False)
        words = _number(extreme.value, quantity, system)
        labels.append(Label(axes, words, point, (1.0 if side == "largest" else -1.0, 0.3)))
    some = slice(len(z) // 10, None, max(len(z) // 20, 1))
    points = np.stack((ends["largest"][some], heights[some]), axis=-1)
    return [*labels, Label(axes, "beam", points, (1.0, 0.0), {"color": BLUE})]


def _draw_static(
    axes: Axes, impacts: Sequence[Impact], quantity: _Quantity, system: str
) -> list[Label]:
    """Draw the diagrams under the reaction and under the smallest one; return their labels."""
    size, unit = unit_size("length", system), unit_size(quantity.kind, system)
    values, names, share = [], [], np.linspace(0.06, 0.94, 12)[:, None]
    for words, number, line in (("static", 0, _STATIC), ("swinging back", 1, _REVERSED)):
        corners = []
        for impact in impacts:
            forces: Any = impact[number]
            drawn = np.stack((getattr(forces, quantity.name) / unit, forces.z / size), axis=-1)
            axes.plot(*drawn.T, **line)
            corners.append(drawn)
        largest = max(np.concatenate(corners), key=lambda corner: abs(corner[0]))
        if abs(largest[0]) > 0.0:
            side, colour = float(np.sign(largest[0])), {"color": VERMILION}
            value = _number(largest[0] * unit, quantity, system)
            values.append(Label(axes, value, tuple(largest), (side, 0.3), colour))
            along = [own[i] + share * (own[i + 1] - own[i]) for own in corners for i in (0, 2)]
            names.append(Label(axes, words, np.concatenate(along), (side, 0.0), colour))
    return values + names


def _draw_band(
    axes: Axes, band: tuple[float, float], z: float, quantity: _Quantity, system: str
) -> Label:
    """Draw a band at a height below the column; return its label."""
    low, high = (value / unit_size(quantity.kind, system) for value in band)
    axes.plot([low, high], [z, z], **_BAND)
    return Label(axes, "5 to 95 %", [(x, z) for x in np.linspace(low, high, 9)], (0.0, -1.0))


def _number(value: float, quantity: _Quantity, system: str) -> str:
    return shown(value, quantity.kind, system).removesuffix(f" {unit_of(quantity.kind, system)}")


def _draw_resistances(
    axes: Axes, parts: Sequence[Part], quantity: _Quantity, system: str
) -> list[Label]:
    """Draw resistances on both sides, or say which are far away; return their labels."""
    size, unit = unit_size("length", system), unit_size(quantity.kind, system)
    largest = float(np.max(np.abs(axes.dataLim.intervalx))) or 1.0  # nothing bends it
    heading = f"{quantity.name.capitalize()} ${quantity.symbol}$ [{unit_of(quantity.kind, system)}]"
    low, high = axes.get_ylim()
    ends = [low, *(part.high / size for part in parts[:-1]), high]
    labels: list[Label] = []
    far: list[str] = []
    near: list[float] = []
    drawn: list[str] = []
    for part, start, end in zip(parts, ends[:-1], ends[1:], strict=True):
        resistance = part.resistances.get(quantity.name)
        if resistance is None:
            continue
        at, words = resistance / unit, named(quantity.resistance, resistance, system)
        if at > _FAR * largest:
            far += [words] if words not in far else []
            continue
        near.append(at)
        for side in (-1.0, 1.0):
            axes.plot([side * at] * 2, [start, end], **_RESISTANCE)
            if words in drawn:
                continue
            z = np.linspace(start, end, 9)
            points = np.stack((np.full(9, side * at), z), axis=-1)
            text = words if side > 0.0 else f"$-{SYMBOLS[quantity.resistance].latex}$"
            labels.append(Label(axes, text, points, (side, 0.0), {"rotation": 90.0}))
        drawn.append(words)
    most = max([1.35 * largest, *(1.2 * own for own in near)])
    axes.set_xlim(-most, most)
    axes.set_xlabel(f"{heading}; {', '.join(far)}, beyond this figure" if far else heading)
    return labels
