"""Many piers in one view: how results are distributed, and where the worst of them are."""

import math
from typing import Any, TypeAlias

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.ticker import FuncFormatter, MaxNLocator
from numpy.typing import NDArray

from pierimpact.plots.style import BLUE, GREY, VERMILION, sheet_figure
from pierimpact.plots.svg import to_svg
from pierimpact.units import unit_of, unit_size

Array: TypeAlias = NDArray[np.float64]

_BINS = 40  # of a histogram
_CELLS = 60  # of the map, from west to east


def draw_distributions(
    reaction: Array, frequency: Array, code_ratio: Array, utilisation: Array, system: str
) -> str:
    """Draw how four results of piers are distributed; return SVG.

    Parameters
    ----------
    reaction : ndarray, shape (n,)
        Design reactions [N].
    frequency : ndarray, shape (n,)
        Pier frequencies [Hz].
    code_ratio : ndarray, shape (n,)
        25 ms averages over the force of the code; nan where there is none [-].
    utilisation : ndarray, shape (n,)
        Larger utilisations; nan where there is none [-].
    system : {"SI", "US"}
        Units to print in.
    """
    panels = (
        (reaction / unit_size("force", system), f"Design reaction [{unit_of('force', system)}]"),
        (frequency, "Pier frequency [Hz]"),
        (code_ratio, "25 ms average over 600 kip (AASHTO LRFD) [-]"),
        (utilisation, "Utilisation, the larger of shear and moment [-]"),
    )
    margins = {"left": 0.08, "right": 0.985, "bottom": 0.1, "top": 0.97}
    with sheet_figure(4.2, **margins, hspace=0.42, wspace=0.22) as figure:
        for axes, (values, label) in zip(figure.subplots(2, 2).flat, panels, strict=True):
            known = values[np.isfinite(values)]
            axes.set_xlabel(label)
            axes.grid(axis="y", color="#e2e6e9", linewidth=0.6)
            axes.set_axisbelow(True)
            if not len(known):
                axes.text(0.5, 0.5, "none given", transform=axes.transAxes, ha="center")
                axes.set(xticks=[], yticks=[])
                continue
            highest = float(known.max())
            axes.hist(known, bins=_BINS, range=(0.0, 1.02 * highest), color=BLUE)
            if values is code_ratio or values is utilisation:
                axes.axvline(1.0, color=VERMILION, linewidth=1.0)
            axes.set_ylabel("Piers")
            axes.yaxis.set_major_locator(MaxNLocator(integer=True))
            axes.set_xlim(left=0.0)
        return to_svg(figure)


def draw_map(latitude: Array, longitude: Array, value: Array, words: str) -> str:
    """Draw where piers are, each cell in the colour of the worst of its piers; return SVG.

    Degrees of longitude are as much shorter as they are at the middle latitude.

    Parameters
    ----------
    latitude, longitude : ndarray, shape (n,)
        Where they are, at least one [°].
    value : ndarray, shape (n,)
        What makes one the worst, the largest; nan where it is not known.
    words : str
        What that is, beside the colours.
    """
    known = np.isfinite(value)
    west, east = float(longitude.min()), float(longitude.max())
    south, north = float(latitude.min()), float(latitude.max())
    middle = 0.5 * (south + north)
    aspect = 1.0 / max(math.cos(math.radians(middle)), 0.05)  # numerical: near a pole
    room = max(east - west, (north - south) * aspect, 0.01)  # numerical: of a single pier
    width, height = max(east - west, 0.3 * room), max(north - south, 0.3 * room / aspect)
    centre = 0.5 * (west + east)
    tall = min(max(5.6 * height * aspect / width, 2.2), 6.5)
    margins = {"left": 0.1, "right": 0.91, "bottom": 0.5 / (tall + 0.6), "top": 0.98}
    with sheet_figure(tall + 0.6, **margins) as figure:
        axes = figure.subplots()
        ends = centre - 0.54 * width, centre + 0.54 * width
        sides = middle - 0.54 * height, middle + 0.54 * height
        rows = max(int(_CELLS * tall / 5.6 / math.sqrt(3.0)), 4)
        cells: Any = {"gridsize": (_CELLS, rows), "extent": (*ends, *sides), "linewidths": 0.2}
        if not known.all():
            grey: Any = {"mincnt": 1, "cmap": ListedColormap([GREY])}
            axes.hexbin(longitude[~known], latitude[~known], **grey, **cells)
        if known.any():
            colours: Any = {"C": value[known], "reduce_C_function": np.max, "cmap": "viridis_r"}
            drawn = axes.hexbin(longitude[known], latitude[known], **colours, **cells)
            figure.colorbar(drawn, ax=axes, label=words, pad=0.02, fraction=0.04)
        axes.set(xlim=ends, ylim=sides, aspect=aspect)
        axes.grid(color="#e2e6e9", linewidth=0.6)
        axes.set_axisbelow(True)
        axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: _degrees(x, "EW")))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda y, _: _degrees(y, "NS")))
        return to_svg(figure)


def _degrees(value: float, sides: str) -> str:
    """Return an angle as "83.5° W"."""
    return f"{abs(value):.6g}°" + (f" {sides[int(value < 0.0)]}" if round(value, 6) else "")
