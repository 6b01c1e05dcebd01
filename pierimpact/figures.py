"""Figures, drawn as SVG with text as outlines: they look the same whatever fonts there are."""

import io
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure

from pierimpact.history import CollisionHistory
from pierimpact.units import printed, unit_of, unit_size

# Colours of Okabe and Ito, told apart by colour-blind readers too.
BLUE, VERMILION, GREY = "#0072b2", "#d55e00", "#8a8a8a"

_STYLE: Any = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "axes.labelsize": 9.0,
    "svg.fonttype": "path",
    "svg.hashsalt": "pierimpact",  # the same drawing gives the same bytes
}


def draw_history(history: CollisionHistory, system: str) -> str:
    """Draw reaction and contact force against time, with the peaks marked; return SVG.

    Parameters
    ----------
    history : CollisionHistory
        The collision.
    system : {"SI", "US"}
        Units to print in.
    """
    with rc_context(_STYLE):
        figure = Figure(figsize=(6.5, 2.9), layout="constrained")
        axes = figure.add_subplot()
        time = history.time / unit_size("time", system)
        force = history.contact_force / unit_size("force", system)
        reaction = history.reaction / unit_size("force", system)
        axes.axhline(0.0, color="black", linewidth=0.5)
        axes.plot(time, force, color=GREY, linewidth=0.8)
        axes.plot(time, reaction, color=BLUE, linewidth=1.5)
        axes.set_xlabel(f"Time after first touch [{unit_of('time', system)}]")
        axes.set_ylabel(f"Force [{unit_of('force', system)}]")
        axes.set_xlim(0.0, float(time[-1]))
        _mark_peaks(axes, history, system)
        return to_svg(figure)


def _mark_peaks(axes: Any, history: CollisionHistory, system: str) -> None:
    peaks = {"Engine": history.engine_peak, "Cargo": history.cargo_peak}
    for name, peak in peaks.items():
        if peak is None:
            continue
        x = peak.time / unit_size("time", system)
        y = peak.reaction / unit_size("force", system)
        late = x > 0.7 * axes.get_xlim()[1]  # no room on the right
        axes.plot([x], [y], "o", color=VERMILION, markersize=4.5, zorder=5)
        axes.annotate(
            f"{name} peak {printed(peak.reaction, 'force', system)}",
            (x, y),
            xytext=(-6, 5) if late else (6, 5),
            textcoords="offset points",
            horizontalalignment="right" if late else "left",
        )


def to_svg(figure: Figure) -> str:
    """Return a figure as SVG, without its date."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None})
    return buffer.getvalue()
