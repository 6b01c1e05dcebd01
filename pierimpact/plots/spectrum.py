"""A spectrum: the peak reaction of engine or cargo against the pier's frequency."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pierimpact.plots import style
from pierimpact.units import printed

Array = NDArray[np.float64]


def spectrum_panel(figure: Figure, body: str) -> Axes:
    """Return the axes of `draw_spectrum`, for "engine" or "cargo"."""
    frequency = "Pier frequency $f_\\mathrm{p}$ [Hz]"
    axes = style.panel(figure, f"{body.capitalize()} peak", frequency, "Peak reaction [MN]")
    style.logarithmic(axes)
    full = {"color": style.BODIES[body]}
    style.key(axes, {"full model": full, "two-degree formula": style.FORMULA})
    return axes


def draw_spectrum(axes: Axes, frequency: Array, full: Array, reduced: Array, *, body: str) -> None:
    """Draw the peaks of a body against pier frequency, or say that it does not arrive.

    Parameters
    ----------
    axes : Axes
        Axes of a `spectrum_panel`.
    frequency : ndarray, shape (n,)
        Pier frequencies [Hz].
    full, reduced : ndarray, shape (n,)
        Peaks by the full model and by the formula for two degrees of freedom; nan where the body
        does not meet the pier [N].
    body : {"engine", "cargo"}
        Which body.
    """
    if np.isnan(full).all() and np.isnan(reduced).all():
        words = f"The {body} does not reach the pier at this speed."
        axes.text(0.5, 0.45, words, transform=axes.transAxes, ha="center", color=style.MUTED)
        return
    axes.plot(frequency, 1e-6 * full, color=style.BODIES[body])
    axes.plot(frequency, 1e-6 * reduced, **style.FORMULA)


def draw_place(
    axes: Axes,
    frequency: Array,
    full: Array,
    reduced: Array,
    here: float,
    reaction: float | None,
    *,
    body: str,
) -> None:
    """Mark one pier on the spectrum of a body, and set the limits of the axes.

    Parameters
    ----------
    axes, frequency, full, reduced, body
        As in `draw_spectrum`.
    here : float
        Frequency of the pier [Hz].
    reaction : float or None
        Its peak [N]; None where the body does not meet the pier.
    """
    known = [8e5, reaction or 0.0, *full[np.isfinite(full)], *reduced[np.isfinite(reduced)]]
    axes.set_xlim(style.round_out(float(frequency[0]), float(frequency[-1]), here))
    axes.set_ylim(0.0, style.round_up(1.2e-6 * max(known)))
    place = None if reaction is None else 1e-6 * reaction
    words = "" if reaction is None else str(printed(reaction, "force", "SI"))
    style.mark_here(axes, here, place, style.BODIES[body], words)
