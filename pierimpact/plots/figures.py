"""Figures, drawn as SVG with text as outlines: they look the same whatever fonts there are."""

from collections.abc import Callable
from typing import Any, ParamSpec

import numpy as np
from matplotlib.figure import Figure

from pierimpact.checks import InputError
from pierimpact.design.sensitivity import Sensitivity
from pierimpact.plots.style import BLUE, VERMILION, key, logarithmic, sheet_figure
from pierimpact.plots.svg import KEPT, to_svg
from pierimpact.units import unit_of, unit_size

P = ParamSpec("P")

MODEL, DESIGN = "full model", "design procedure"
#: Lines of the full model and of a closed form beside it.
EXACT: Any = {"color": BLUE, "linewidth": 1.4}
CLOSED: Any = {"color": VERMILION, "linewidth": 1.0, "dashes": (5, 2)}


def figure_of(draw: Callable[P, object], *args: P.args, **kwargs: P.kwargs) -> Figure:
    """Return the matplotlib figure that a function draws, where it would return SVG or a block.

    Parameters
    ----------
    draw : callable
        A function that draws one figure: any `draw_…` of `pierimpact.plots`, or a block of a
        `Sheet` that is a figure. What follows is passed to it.

    Returns
    -------
    Figure
        The figure, to change and to save with its own methods.

    Raises
    ------
    InputError
        When the function draws no figure.

    Examples
    --------
    >>> from pierimpact import EquivalentPier, load_truck, simulate
    >>> from pierimpact.plots.figures import figure_of
    >>> from pierimpact.plots.history import draw_history
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    >>> history = simulate(load_truck("single-unit-8t"), pier, speed=22.2)
    >>> figure = figure_of(draw_history, history, "SI")
    >>> figure.axes[0].get_ylabel()
    'Force [kN]'
    """
    figures: list[Figure] = []
    before = KEPT.set(figures)
    try:
        draw(*args, **kwargs)
    finally:
        KEPT.reset(before)
    if not figures:
        raise InputError(f"draw must draw a figure, got {getattr(draw, '__name__', draw)}")
    return figures[0]


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
    margins = {"left": 0.105, "right": 0.985, "bottom": 0.112, "top": 0.935}
    with sheet_figure(4.0, **margins, hspace=0.38, wspace=0.1) as figure:
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
        key(grid[0, 1], {MODEL: EXACT, "spectrum method": CLOSED})
        return to_svg(figure)


def _plot_both(axes: Any, x: Any, model: Any, design: Any, system: str) -> None:
    size = unit_size("force", system)
    axes.plot(x, design / size, **CLOSED)
    axes.plot(x, model / size, **EXACT)


def _mark_both(axes: Any, x: float, model: float, design: float, system: str) -> None:
    size = unit_size("force", system)
    axes.plot([x], [design / size], "s", color=VERMILION, markersize=5.0, fillstyle="none")
    axes.plot([x], [model / size], "o", color=BLUE, markersize=4.0, zorder=5)
