"""Figures of the spectra and of their validation, drawn as SVG like those of the sheet."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pierimpact.design.procedure import amplification
from pierimpact.design.reduction import exact_amplification
from pierimpact.design.spectra import Spectrum
from pierimpact.design.study import Reactions
from pierimpact.plots.figures import DESIGN, MODEL
from pierimpact.plots.style import BLUE, GREY, VERMILION, logarithmic, sheet_figure, to_svg
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
    with sheet_figure(6.5, 3.0, left=0.085, right=0.985, bottom=0.15, top=0.97) as figure:
        axes = figure.add_subplot()
        for mu in mass_ratios:
            exact = exact_amplification(_RATIOS, mu, restitution, damping)
            closed = amplification(_RATIOS, mu, restitution, damping)
            first = mu == mass_ratios[0]
            axes.plot(
                _RATIOS,
                closed,
                color=VERMILION,
                linewidth=1.0,
                dashes=(5, 2),
                label="closed form" if first else None,
            )
            axes.plot(
                _RATIOS,
                exact,
                color=BLUE,
                linewidth=1.3,
                label="two-degree-of-freedom system, exact" if first else None,
            )
            axes.annotate(
                f"$\\mu$ = {mu:g}",
                (_RATIOS[_LABELLED], exact[_LABELLED]),
                ha="center",
                va="center",
                fontsize=8.5,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
            )
        logarithmic(axes, (0.1, 0.2, 0.5, 1, 2, 5, 10))
        axes.set_xlim(_RATIOS[0], _RATIOS[-1])
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel("Frequency ratio $\\beta = f_\\mathrm{p} / f_i$")
        axes.set_ylabel("Amplification $S$")
        axes.legend(frameon=False, loc="upper left", fontsize=8.5)
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
    with sheet_figure(
        6.5, 2.9, left=0.105, right=0.985, bottom=0.16, top=0.91, wspace=0.1
    ) as figure:
        panels = figure.subplots(1, 2, sharey=True)
        for axes, name, spectrum in zip(panels, ("Engine", "Cargo"), (engine, cargo), strict=True):
            axes.plot(
                spectrum.frequency,
                spectrum.two_degrees / size,
                color=GREY,
                linewidth=1.0,
                dashes=(1, 1.5),
                label="hand formula, exact $S$",
            )
            axes.plot(
                spectrum.frequency,
                spectrum.closed_form / size,
                color=VERMILION,
                linewidth=1.0,
                dashes=(5, 2),
                label=DESIGN,
            )
            axes.plot(
                spectrum.frequency,
                spectrum.full_model / size,
                color=BLUE,
                linewidth=1.4,
                label=MODEL,
            )
            logarithmic(axes)
            axes.set_xlim(spectrum.frequency[0], spectrum.frequency[-1])
            axes.set_xlabel("Pier frequency [Hz]")
            axes.set_title(name, loc="left", fontsize=9.0)
            if np.all(np.isnan(spectrum.full_model)):
                axes.text(0.5, 0.5, "no contact", transform=axes.transAxes, ha="center")
        panels[0].set_ylim(bottom=0.0)
        panels[0].set_ylabel(f"Reaction [{unit_of('force', system)}]")
        handles, names = panels[0].get_legend_handles_labels()
        panels[0].legend(handles[::-1], names[::-1], frameon=False, loc="upper left", fontsize=8.5)
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
    ends = 0.5e6 / size, 20e6 / size
    with sheet_figure(
        6.5, 2.75, left=0.1, right=0.99, bottom=0.26, top=0.91, wspace=0.08
    ) as figure:
        panels = figure.subplots(1, 3, sharey=True)
        for axes, name in zip(panels, Reactions._fields, strict=True):
            for share, line in ((1.0, "-"), (0.9, ":"), (1.1, ":")):
                axes.plot(ends, [share * end for end in ends], line, color="black", linewidth=0.6)
            for (low, high), colour in zip(pairwise(SCATTER_BANDS), _BAND_COLOURS, strict=True):
                band = (frequency >= low) & (frequency < high)
                axes.plot(
                    getattr(exact, name)[band] / size,
                    getattr(predicted, name)[band] / size,
                    color=colour,
                    label=f"{low:g}–{high:g} Hz",
                    **_DOTS,
                )
            axes.set_title(name.capitalize(), loc="left", fontsize=9.0)
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.set_xlim(ends)
            axes.set_ylim(ends)
            axes.set_aspect("equal")
            ticks = _FORCE_TICKS[system]
            axes.set_xticks(ticks, map(str, ticks))
            axes.set_yticks(ticks, map(str, ticks))
            axes.minorticks_off()
        panels[1].set_xlabel(f"Reaction by the {MODEL} [{unit_of('force', system)}]")
        panels[0].set_ylabel(f"Predicted [{unit_of('force', system)}]")
        handles, names = panels[0].get_legend_handles_labels()
        figure.legend(
            handles,
            names,
            frameon=False,
            loc="lower center",
            ncols=len(names),
            fontsize=8.5,
            markerscale=5.0,
            handletextpad=0.1,
        )
        figure.set_dpi(300)
        return to_svg(figure)


def draw_ratios(frequency: Array, exact: Reactions, predicted: Reactions) -> str:
    """Draw predicted over full-model reactions against pier frequency; return SVG.

    Engine, cargo and governing apart; arguments as in `draw_scatter`.
    """
    with sheet_figure(6.5, 2.4, left=0.1, right=0.99, bottom=0.19, top=0.91, wspace=0.08) as figure:
        panels = figure.subplots(1, 3, sharey=True)
        for axes, name in zip(panels, Reactions._fields, strict=True):
            axes.axhline(1.0, color="black", linewidth=0.6)
            ratio = getattr(predicted, name) / getattr(exact, name)
            axes.plot(frequency, ratio, color=BLUE, **_DOTS)
            axes.set_title(name.capitalize(), loc="left", fontsize=9.0)
            logarithmic(axes, (5, 10, 20, 50, 100))
        panels[0].set_ylim(0.7, 1.7)
        panels[1].set_xlabel("Pier frequency [Hz]")
        panels[0].set_ylabel(f"Predicted / {MODEL}")
        figure.set_dpi(300)
        return to_svg(figure)
