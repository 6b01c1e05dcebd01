"""Engine and cargo reaction against pier frequency on one pair of axes, for a page."""

from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from pierimpact.design.sensitivity import Variation
from pierimpact.plots.labels import Label, place
from pierimpact.plots.style import (
    BODIES,
    INK,
    MUTED,
    TEXT_WIDTH,
    logarithmic,
    page_figure,
    round_out,
)
from pierimpact.plots.svg import to_svg
from pierimpact.plots.words import shown
from pierimpact.units import unit_of, unit_size

Array = NDArray[np.float64]

_LINES: dict[str, dict[str, Any]] = {
    "engine": {"color": BODIES["engine"], "linewidth": 1.6},
    "cargo": {"color": BODIES["cargo"], "linewidth": 1.6},
}
_BY_HAND: dict[str, Any] = {"linewidth": 0.8, "dashes": (4, 2)}
_GOVERNS = "#e9edf0"
# So many times its lowest is the highest frequency of a range that is named, and one change whose
# frequency is written the next below.
_NAMED, _APART = 2.0, 1.1


def draw_spectra(spectrum: Variation, frequency: float, system: str) -> str:
    """Draw engine and cargo reaction against pier frequency, this pier marked; return SVG.

    168 × 58 mm. Thick: the full model; thin and dashed: the spectrum method. Shaded where the cargo
    governs, by the full model.

    Parameters
    ----------
    spectrum : Variation
        Reactions over frequency [Hz].
    frequency : float
        Frequency of this pier, among those of the spectrum [Hz].
    system : {"SI", "US"}
        Units to print in.
    """
    size, here = unit_size("force", system), int(np.argmin(np.abs(spectrum.values - frequency)))
    margins = {"left": 15.0, "right": 2.0, "bottom": 8.0, "top": 1.5}
    with page_figure(TEXT_WIDTH, 58.0, **margins) as figure:
        axes = figure.add_subplot()
        axes.axvline(frequency, color=INK, linewidth=0.6)
        curves = {
            "engine": (spectrum.engine / size, spectrum.design_engine / size),
            "cargo": (spectrum.cargo / size, spectrum.design_cargo / size),
        }
        engine = "engine" if spectrum.by_engine.any() else "sheet metal"
        here_is = {"engine": "engine" if spectrum.by_engine[here] else "sheet metal"}
        values, names = [], []
        for body, (model, by_hand) in curves.items():
            line, name = _LINES[body], engine if body == "engine" else body
            axes.plot(spectrum.values, by_hand, **line | _BY_HAND)
            axes.plot(spectrum.values, model, **line)
            colour = {"color": line["color"]}
            if np.isfinite(model[here]):
                axes.plot([frequency], [model[here]], "o", color=line["color"], markersize=4.5)
                words = here_is.get(body, body) + f" {shown(model[here] * size, 'force', system)}"
                values.append(Label(axes, words, (frequency, model[here]), options=colour))
            names += [
                Label(axes, words, _along(spectrum.values, curve), options=colour)
                for words, curve in ((name, model), (f"{name}, by hand", by_hand))
                if np.any(np.isfinite(curve))
            ]
        logarithmic(axes)
        axes.set_xlim(round_out(float(spectrum.values[0]), float(spectrum.values[-1]), frequency))
        axes.set_ylim(0.0, 1.12 * axes.dataLim.y1)
        axes.set(xlabel="Pier frequency [Hz]", ylabel=f"Reaction [{unit_of('force', system)}]")
        governs = _shade(axes, spectrum)
        pier = f"this pier, {shown(frequency, 'frequency', system)}"
        upright = np.linspace(*axes.get_ylim(), 12)
        points = np.stack((np.full(12, frequency), upright), axis=-1)
        place(figure, [*values, *governs, Label(axes, pier, points), *names])
        return to_svg(figure)


def _shade(axes: Axes, spectrum: Variation) -> list[Label]:
    """Shade where the cargo governs, and mark where what governs changes; return the labels."""
    x, gap = spectrum.values, np.nan_to_num(spectrum.cargo, nan=0.0) - spectrum.engine
    first = np.where(spectrum.by_engine, "engine", "sheet metal")
    governs = np.where(gap > 0.0, "cargo", first)
    changes = np.flatnonzero(governs[1:] != governs[:-1])
    # Between engine and sheet metal no curves cross: it is where one follows the other.
    of_cargo = (gap[changes] > 0.0) != (gap[changes + 1] > 0.0)
    steps = np.where(of_cargo, gap[changes] - gap[changes + 1], 1.0)
    share = np.where(of_cargo, gap[changes] / steps, 0.5)
    crossings = x[changes] * (x[changes + 1] / x[changes]) ** share
    (left, right), (_, top) = axes.get_xlim(), axes.get_ylim()
    ends = np.array([left, *crossings, right])
    wide = ends[1:] / ends[:-1]
    labels = []
    bands = governs[[0, *(changes + 1)]]
    for number, (low, high) in enumerate(pairwise(ends)):
        if bands[number] == "cargo":
            axes.axvspan(low, high, color=_GOVERNS, linewidth=0.0, zorder=0.0)
        if wide[number] > _NAMED:
            places = [(own, 0.97 * top) for own in np.geomspace(low, high, 11)[3:-3]]
            labels.append(
                Label(axes, f"{bands[number]} governs", places, (0.0, 0.0), {"color": MUTED})
            )
    above = np.inf
    for crossing in crossings[::-1]:
        axes.axvline(crossing, color=MUTED, linewidth=0.6, dashes=(2, 2))
        if above > _APART * crossing:
            above = crossing
            points = [(crossing, share * top) for share in (0.04, 0.5, 0.9)]
            labels.append(Label(axes, f"{crossing:.3g} Hz", points, options={"color": MUTED}))
    return labels


def _along(x: Array, curve: Array) -> Array:
    """Return points of a curve that its name may stand beside."""
    known = np.flatnonzero(np.isfinite(curve))
    some = known[np.unique(np.linspace(0, len(known) - 1, 30).astype(int))]
    return np.stack((x[some], curve[some]), axis=-1)
