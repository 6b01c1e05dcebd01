"""Figures of the spectra and of their validation, drawn as SVG like those of the sheet."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.reactions import Reactions
from pierimpact.design.procedure import amplification
from pierimpact.design.reduction import exact_amplification
from pierimpact.design.spectra import Spectrum
from pierimpact.plots.figures import CLOSED, DESIGN, EXACT, MODEL, name_spectra
from pierimpact.plots.style import BLUE, GREY, logarithmic, sheet_figure
from pierimpact.plots.svg import to_svg
from pierimpact.units import unit_of, unit_size

Array = NDArray[np.float64]

#: Limits of the frequency bands that the scatter plot tells apart [Hz].
SCATTER_BANDS = (5.0, 10.0, 20.0, 40.0, 150.0)
# From dark to light, so that they stay apart in grey and to colour-blind readers; see figures.
_BAND_COLOURS = ("#12304a", BLUE, "#56b4e9", "#e69f00")
# Thousands of points are drawn as one picture, of the figure's resolution.
_DOTS: Any = {
    "linestyle": "none",
    "marker": ".",
    "markersize": 1.6,
    "markeredgewidth": 0.0,
    "rasterized": True,
}
_DOTTED: Any = {"color": GREY, "linewidth": 1.0, "dashes": (1, 1.5)}
# Margins of three panels.
_THREE = {"left": 0.1, "right": 0.99, "top": 0.91, "wspace": 0.08}
_RATIOS = np.geomspace(0.1, 10.0, 81)
_LABELLED = 34  # where the curves of different mass ratios are apart
_FORCE_TICKS = {"SI": (1000, 2000, 5000, 10000), "US": (200, 500, 1000, 2000)}


def draw_amplification(mass_ratios: Sequence[float], restitution: float, damping: float) -> str:
    """Draw the unified spectrum, exact and closed, for several mass ratios; return SVG.

    Parameters
    ----------
    mass_ratios : sequence of float
        Values of μ, each a pair of curves [-].
    restitution, damping : float
        e and ζ of all of them [-].
    """
    with sheet_figure(3.0, left=0.085, right=0.985, bottom=0.15, top=0.97) as figure:
        axes = figure.add_subplot()
        white = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
        for mu in mass_ratios:
            exact = exact_amplification(_RATIOS, mu, restitution, damping)
            axes.plot(_RATIOS, amplification(_RATIOS, mu, restitution, damping), **CLOSED)
            axes.plot(_RATIOS, exact, **EXACT | {"linewidth": 1.3})
            place = _RATIOS[_LABELLED], exact[_LABELLED]
            axes.annotate(
                f"$\\mu$ = {mu:g}", place, ha="center", va="center", fontsize=8.5, bbox=white
            )
        logarithmic(axes, (0.1, 0.2, 0.5, 1, 2, 5, 10))
        axes.set(
            xlabel="Frequency ratio $\\beta = f_\\mathrm{p} / f_i$",
            ylabel="Amplification $S$",
            xlim=(_RATIOS[0], _RATIOS[-1]),
        )
        axes.set_ylim(bottom=0.0)
        names = ("closed form", "two-degree-of-freedom system, exact")
        axes.legend(axes.lines[:2], names, loc="upper left")
        return to_svg(figure)


def draw_routes(engine: Spectrum, cargo: Spectrum, system: str) -> str:
    """Draw engine and cargo reaction against pier frequency by three routes; return SVG.

    Parameters
    ----------
    engine, cargo : Spectrum
        The spectra of one truck, speed and pier mass.
    system : {"SI", "US"}
        Units to print in.
    """
    size = unit_size("force", system)
    with sheet_figure(2.9, left=0.105, right=0.985, bottom=0.16, top=0.91, wspace=0.1) as figure:
        panels = figure.subplots(1, 2, sharey=True)
        for axes, spectrum in zip(panels, (engine, cargo), strict=True):
            for values, words, line in (
                (spectrum.two_degrees, "hand formula, exact $S$", _DOTTED),
                (spectrum.closed_form, DESIGN, CLOSED),
                (spectrum.full_model, MODEL, EXACT),
            ):
                axes.plot(spectrum.frequency, values / size, label=words, **line)
        name_spectra(panels, engine.frequency, (engine.full_model, cargo.full_model), system)
        return to_svg(figure)


def draw_scatter(frequency: Array, exact: Reactions, predicted: Reactions, system: str) -> str:
    """Draw predicted reactions against those of the full model; return SVG.

    Engine, cargo and governing apart, the frequency of the pier by colour.

    Parameters
    ----------
    frequency : ndarray, shape (n,)
        Pier frequencies [Hz].
    exact, predicted : Reactions
        Reactions by the full model and by the design procedure, each of shape (n,).
    system : {"SI", "US"}
        Units to print in.
    """
    size = unit_size("force", system)
    ends, ticks = (0.5e6 / size, 20e6 / size), _FORCE_TICKS[system]
    with sheet_figure(2.75, **_THREE, bottom=0.26) as figure:
        panels = figure.subplots(1, 3, sharey=True)
        for axes, name in zip(panels, Reactions._fields, strict=True):
            for share, line in ((1.0, "-"), (0.9, ":"), (1.1, ":")):
                axes.plot(ends, [share * end for end in ends], line, color="black", linewidth=0.6)
            there, here = getattr(exact, name) / size, getattr(predicted, name) / size
            for (low, high), colour in zip(pairwise(SCATTER_BANDS), _BAND_COLOURS, strict=True):
                band = (frequency >= low) & (frequency < high)
                words = f"{low:g}–{high:g} Hz"
                axes.plot(there[band], here[band], color=colour, label=words, **_DOTS)
            axes.set(title=name.capitalize(), xscale="log", yscale="log", aspect="equal")
            axes.set(xlim=ends, ylim=ends)
            axes.set_xticks(ticks, map(str, ticks))
            axes.set_yticks(ticks, map(str, ticks))
            axes.minorticks_off()
        panels[1].set_xlabel(f"Reaction by the {MODEL} [{unit_of('force', system)}]")
        panels[0].set_ylabel(f"Predicted [{unit_of('force', system)}]")
        bands = axes.get_legend_handles_labels()
        figure.legend(*bands, loc="lower center", ncols=4, markerscale=5.0, handletextpad=0.1)
        figure.set_dpi(300)
        return to_svg(figure)


def draw_ratios(frequency: Array, exact: Reactions, predicted: Reactions) -> str:
    """Draw predicted over full-model reactions against pier frequency; return SVG.

    Engine, cargo and governing apart; arguments as in `draw_scatter`.
    """
    with sheet_figure(2.4, **_THREE, bottom=0.19) as figure:
        panels = figure.subplots(1, 3, sharey=True)
        for axes, name in zip(panels, Reactions._fields, strict=True):
            axes.axhline(1.0, color="black", linewidth=0.6)
            ratio = getattr(predicted, name) / getattr(exact, name)
            axes.plot(frequency, ratio, color=BLUE, **_DOTS)
            axes.set_title(name.capitalize())
            logarithmic(axes, (5, 10, 20, 50, 100))
        panels[0].set(ylim=(0.7, 1.7), ylabel=f"Predicted / {MODEL}")
        panels[1].set_xlabel("Pier frequency [Hz]")
        figure.set_dpi(300)
        return to_svg(figure)
