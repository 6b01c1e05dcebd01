"""Figures, drawn as SVG with text as outlines: they look the same whatever fonts there are."""

from typing import Any

import numpy as np

from pierimpact.design.sensitivity import Sensitivity, Variation
from pierimpact.pier.member_forces import MemberForceHistory, MemberForces
from pierimpact.plots.style import BLUE, GREY, VERMILION, logarithmic, note, sheet_figure, to_svg
from pierimpact.units import printed, unit_of, unit_size

MODEL, DESIGN = "full model", "design procedure"
#: Lines of the full model and of a closed form beside it.
EXACT: Any = {"color": BLUE, "linewidth": 1.4}
CLOSED: Any = {"color": VERMILION, "linewidth": 1.0, "dashes": (5, 2)}


def draw_spectra(spectrum: Variation, frequency: float, system: str) -> str:
    """Draw engine and cargo reaction against pier frequency, this pier marked; return SVG.

    Parameters
    ----------
    spectrum : Variation
        Reactions over frequency [Hz].
    frequency : float
        Frequency of this pier, among those of the spectrum [Hz].
    system : {"SI", "US"}
        Units to print in.
    """
    here = int(np.argmin(np.abs(spectrum.values - frequency)))
    with sheet_figure(2.7, left=0.105, right=0.985, bottom=0.17, top=0.9, wspace=0.1) as figure:
        panels = figure.subplots(1, 2, sharey=True)
        models = spectrum.engine, spectrum.cargo
        designs = spectrum.design_engine, spectrum.design_cargo
        for axes, model, design in zip(panels, models, designs, strict=True):
            axes.axvline(frequency, color=GREY, linewidth=0.8)
            _plot_both(axes, spectrum.values, model, design, system)
            _mark_both(axes, frequency, model[here], design[here], system)
        name_spectra(panels, spectrum.values, models, system)
        return to_svg(figure)


def name_spectra(panels: Any, frequency: Any, models: tuple[Any, Any], system: str) -> None:
    """Name the panels of engine and cargo with their axes and lines, once these are drawn.

    Parameters
    ----------
    panels : ndarray of Axes, shape (2,)
        The panels.
    frequency : ndarray, shape (n,)
        Pier frequencies, the ends of the axes [Hz].
    models : tuple of ndarray, shape (n,)
        Reactions by the full model, all nan without contact [N].
    system : {"SI", "US"}
        Units to print in.
    """
    for axes, name, model in zip(panels, ("Engine", "Cargo"), models, strict=True):
        logarithmic(axes)
        ends = float(frequency[0]), float(frequency[-1])
        axes.set(title=name, xlabel="Pier frequency [Hz]", xlim=ends)
        if np.all(np.isnan(model)):
            axes.text(0.5, 0.5, "no contact", transform=axes.transAxes, ha="center")
    panels[0].set_ylim(bottom=0.0)
    panels[0].set_ylabel(f"Reaction [{unit_of('force', system)}]")
    panels[0].legend(reverse=True, loc="upper left")


def draw_member_forces(
    forces: MemberForces,
    beam: MemberForceHistory | None,
    resistances: tuple[float | None, float | None],
    system: str,
) -> str:
    """Draw the column with its force, and the diagrams of shear and moment; return SVG.

    Parameters
    ----------
    forces : MemberForces
        The member forces under a static force.
    beam : MemberForceHistory or None
        Those of the column as a beam, for the envelopes.
    resistances : tuple of float or None
        Shear resistance [N] and moment resistance [N m].
    system : {"SI", "US"}
        Units to print in.
    """
    z = forces.z / unit_size("length", system)
    impact = z[1]
    with sheet_figure(2.7, left=0.105, right=0.985, bottom=0.09, top=0.91, wspace=0.12) as figure:
        column, *diagrams = figure.subplots(1, 3, sharey=True, width_ratios=[0.7, 1.0, 1.0])
        column.plot([0.0, 0.0], [z[0], z[-1]], color="black", linewidth=3.0)
        arrow = {"arrowstyle": "-|>", "color": VERMILION, "linewidth": 1.4}
        column.annotate("", (-0.03, impact), xytext=(-0.8, impact), arrowprops=arrow)
        force = printed(forces.reaction, "force", system)
        column.text(-0.85, impact, f"{force}\n", va="center", fontsize=8.5)
        column.spines["bottom"].set_visible(False)
        height = f"Height above the ground [{unit_of('length', system)}]"
        column.set(ylabel=height, xlim=(-1.0, 0.5), ylim=(z[0], z[-1]), xticks=[])
        for axes, (name, quantity), resistance in zip(
            diagrams, (("Shear", "force"), ("Moment", "moment")), resistances, strict=True
        ):
            unit = unit_size(quantity, system)
            values = forces.shear if name == "Shear" else forces.moment
            axes.axvline(0.0, color="black", linewidth=0.8)
            axes.plot(values / unit, z, color=VERMILION, linewidth=1.3)
            if beam is None:
                axes.fill_betweenx(z, 0.0, values / unit, color=VERMILION, alpha=0.1, linewidth=0.0)
                labels = _labelled_corners(forces.z, values, name)
            else:
                heights = beam.z / unit_size("length", system)
                most, least, extremes = (
                    (beam.largest_shear, beam.smallest_shear, beam.shear_extremes)
                    if name == "Shear"
                    else (beam.largest_moment, beam.smallest_moment, beam.moment_extremes)
                )
                axes.fill_betweenx(
                    heights, least / unit, most / unit, color=BLUE, alpha=0.18, linewidth=0.0
                )
                for edge in (least, most):
                    axes.plot(edge / unit, heights, color=BLUE, linewidth=0.8)
                labels = [(extreme.z, extreme.value) for extreme in extremes if extreme.value]
            if resistance is not None:
                for side in (-resistance, resistance):
                    axes.axvline(side / unit, color=GREY, linewidth=1.0, dashes=(4, 3))
            axes.margins(x=0.32)
            axes.set_title(f"{name} [{unit_of(quantity, system)}]")
            axes.locator_params(axis="x", nbins=4)
            for at, value in labels:
                words = printed(value, quantity, system).number
                offset, ha = ((4, 0), "left") if value >= 0.0 else ((-4, 0), "right")
                share = (at - forces.z[0]) / (forces.z[-1] - forces.z[0])
                va = "bottom" if share < 0.04 else "top" if share > 0.96 else "center"
                place = value / unit, at / unit_size("length", system)
                note(axes, words, place, offset, ha=ha, va=va, fontsize=8.5)
        return to_svg(figure)


def _labelled_corners(z: Any, values: Any, name: str) -> list[tuple[float, float]]:
    """Return height and value of what is to be printed: each stretch or corner once."""
    if name == "Shear":
        return [(0.5 * (z[i] + z[i + 1]), values[i]) for i in (0, 2)]
    largest = np.max(np.abs(values))
    return [(z[i], values[i]) for i in (0, 1, 3) if abs(values[i]) > 1e-9 * largest]


def draw_sensitivity(
    variations: Sensitivity, here: dict[str, float], force: tuple[float, float], system: str
) -> str:
    """Draw the governing reaction against four quantities, this case marked; return SVG.

    Parameters
    ----------
    variations : Sensitivity
        The reactions.
    here : dict of str to float
        The case's own speed [m/s], mass [kg], impact_height [m] and frequency [Hz].
    force : tuple of float
        Its reaction by the full model and by the design procedure [N].
    system : {"SI", "US"}
        Units to print in.
    """
    panels = (
        ("speed", "speed", "Speed"),
        ("mass", "mass", "Truck mass"),
        ("impact_height", "length", "Impact height"),
        ("frequency", "frequency", "Pier frequency"),
    )
    margins = {"left": 0.105, "right": 0.985, "bottom": 0.115, "top": 0.985}
    with sheet_figure(3.9, **margins, hspace=0.38, wspace=0.1) as figure:
        grid = figure.subplots(2, 2, sharey=True)
        for axes, (name, quantity, words) in zip(grid.flat, panels, strict=True):
            variation = getattr(variations, name)
            size = unit_size(quantity, system)
            _plot_both(axes, variation.values / size, variation.model, variation.design, system)
            _mark_both(axes, here[name] / size, *force, system)
            axes.set_xlabel(f"{words} [{unit_of(quantity, system)}]")
            if name == "frequency":
                logarithmic(axes)
            else:  # the last number would run into the first of the panel beside it
                axes.locator_params(axis="x", prune="upper")
            axes.set_xlim(float(variation.values[0]) / size, float(variation.values[-1]) / size)
            axes.grid(axis="y", color="#e2e6e9", linewidth=0.6)
        grid[0, 0].set_ylim(bottom=0.0)
        for axes in grid[:, 0]:
            axes.set_ylabel(f"Reaction [{unit_of('force', system)}]")
        grid[0, 0].legend(reverse=True, loc="upper left")
        return to_svg(figure)


def _plot_both(axes: Any, x: Any, model: Any, design: Any, system: str) -> None:
    size = unit_size("force", system)
    axes.plot(x, design / size, label=DESIGN, **CLOSED)
    axes.plot(x, model / size, label=MODEL, **EXACT)


def _mark_both(axes: Any, x: float, model: float, design: float, system: str) -> None:
    size = unit_size("force", system)
    axes.plot([x], [design / size], "s", color=VERMILION, markersize=5.0, fillstyle="none")
    axes.plot([x], [model / size], "o", color=BLUE, markersize=4.0, zorder=5)
