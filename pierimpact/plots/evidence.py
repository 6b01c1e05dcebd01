"""Figures of the model beside what others measured and found, as SVG like those of the sheet."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.history import CollisionHistory
from pierimpact.plots.style import (
    BLUE,
    GREY,
    ORANGE,
    PALE,
    SKY,
    VERMILION,
    name_rows,
    note,
    sheet_figure,
)
from pierimpact.plots.svg import to_svg
from pierimpact.units import unit_of, unit_size

Array = NDArray[np.float64]

_ROW = 0.3  # height of a row [in]
# Told apart by width and dash too, where lines lie on each other.
_LINES: tuple[dict[str, Any], ...] = (
    {"color": SKY, "linewidth": 4.0},
    {"color": BLUE, "linewidth": 2.2},
    {"color": ORANGE, "linewidth": 1.2, "dashes": (3, 2)},
)
_LIMIT: dict[str, Any] = {"color": "black", "linewidth": 0.8, "linestyle": ":"}


class Mark(NamedTuple):
    """A published force at a speed."""

    speed: float  #: [m/s]
    force: float  #: [N]
    words: str


def draw_cargo(histories: Mapping[str, CollisionHistory], system: str) -> str:
    """Draw contact force and impulse against time, a line for each collision by name; SVG."""
    size = unit_size("force", system)
    with sheet_figure(2.4, left=0.1, right=0.985, bottom=0.19, top=0.9, wspace=0.26) as figure:
        force, impulse = figure.subplots(1, 2)
        for (name, own), line in zip(histories.items(), _LINES[1:], strict=False):
            width = line | {"linewidth": 1.3}
            force.plot(1e3 * own.time, own.contact_force / size, label=name, **width)
            impulse.plot(1e3 * own.time, own.impulse / size, label=name, **width)
        ends = [own.time[own.contact_force > 0.0][-1] for own in histories.values()]
        end = 1.2e3 * float(max(ends))
        for axes in (force, impulse):
            axes.set(xlabel="Time after first touch [ms]", xlim=(0.0, end))
            axes.set_ylim(bottom=0.0)
        force.set_ylabel(f"Contact force [{unit_of('force', system)}]")
        impulse.set_ylabel(f"Impulse [{unit_of('impulse', system)}]")
        impulse.legend(loc="upper left")
        return to_svg(figure)


def draw_first_peak(speeds: Array, peaks: Mapping[str, Array], system: str) -> str:
    """Draw the first peak against the speed [m/s], a line for each truck by name; SVG."""
    with sheet_figure(2.3, left=0.1, right=0.985, bottom=0.2, top=0.95) as figure:
        axes = figure.add_subplot()
        for (name, forces), line in zip(peaks.items(), _LINES, strict=False):
            axes.plot(3.6 * speeds, forces / unit_size("force", system), label=name, **line)
        axes.set(xlabel="Speed [km/h]", ylabel=f"First peak [{unit_of('force', system)}]")
        axes.set_xlim(3.6 * speeds[0], 3.6 * speeds[-1])
        axes.set_ylim(bottom=0.0)
        axes.legend(loc="upper left")
        return to_svg(figure)


def draw_averages(
    speeds: Array,
    windows: Sequence[float],
    averages: Array,
    band: Array,
    limit: float,
    marks: Sequence[Mark],
    system: str,
) -> str:
    """Draw largest averages of the contact force against the speed; return SVG.

    Parameters
    ----------
    speeds : ndarray, shape (n,)
        Speeds [m/s].
    windows : sequence of float, length m
        Lengths of the moving windows [s].
    averages : ndarray, shape (n, m)
        The averages [N].
    band : ndarray, shape (n, 2)
        Ends of the band of the second of them [N].
    limit : float
        Force of a code [N].
    marks : sequence of Mark
        Published averages.
    system : {"SI", "US"}
        Units to print in.
    """
    size = unit_size("force", system)
    with sheet_figure(3.0, left=0.1, right=0.985, bottom=0.16, top=0.97) as figure:
        axes = figure.add_subplot()
        words = f"{1e3 * windows[1]:g} ms, 5 to 95 % of trucks"
        axes.fill_between(3.6 * speeds, *band.T / size, color=BLUE, alpha=0.2, lw=0, label=words)
        for window, forces, colour in zip(
            windows, averages.T, (VERMILION, BLUE, GREY), strict=True
        ):
            label = f"{1e3 * window:g} ms average"
            axes.plot(3.6 * speeds, forces / size, color=colour, linewidth=1.4, label=label)
        axes.axhline(limit / size, label="600 kip, AASHTO LRFD", **_LIMIT)
        for speed, force, name in marks:
            axes.plot(3.6 * speed, force / size, "ko", markersize=4.0)
            note(axes, name, (3.6 * speed, force / size), (-6.0, 4.0), ha="right")
        axes.set(xlabel="Speed [km/h]", ylabel=f"Largest average [{unit_of('force', system)}]")
        axes.set_xlim(3.6 * speeds[0], 3.6 * speeds[-1])
        axes.set_ylim(bottom=0.0)
        axes.legend(loc="upper left")
        return to_svg(figure)


def draw_agreement(names: Sequence[str], ratios: Array) -> str:
    """Draw model over published forces, a row for each response; return SVG.

    Parameters
    ----------
    names : sequence of str, length n
        What stands beside the rows.
    ratios : ndarray, shape (n, 4)
        With parameters at their values, then the lower end, the middle and the upper end of the
        band; nan where the model has none [-].
    """
    height = 0.55 + _ROW * len(names)
    margins = {"left": 0.52, "right": 0.98, "top": 1.0 - 0.05 / height, "bottom": 0.45 / height}
    with sheet_figure(height, **margins) as figure:
        axes = figure.add_subplot()
        name_rows(axes, names)
        axes.tick_params(axis="y", labelsize=8.5, labelcolor="black", length=0.0)
        axes.grid(axis="x", color=PALE, linewidth=0.6)
        axes.set_axisbelow(True)
        axes.axvline(1.0, color="black", linewidth=0.8)
        for row, (nominal, low, middle, high) in enumerate(ratios):
            axes.barh(row, high - low, left=low, height=0.5, color=BLUE, alpha=0.35)
            axes.plot([middle, middle], [row - 0.25, row + 0.25], color=BLUE, linewidth=1.6)
            axes.plot(nominal, row, "ko", markersize=4.0)
        axes.set_xlim(left=0.0)
        axes.set_xlabel("Model over published")
        return to_svg(figure)
