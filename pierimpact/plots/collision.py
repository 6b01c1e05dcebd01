"""The peaks of a collision, marked on its reaction against time."""

from collections.abc import Mapping

from matplotlib.axes import Axes

from pierimpact.collision.history import CollisionHistory
from pierimpact.plots.style import note
from pierimpact.units import printed, unit_size


def mark_peaks(
    axes: Axes, history: CollisionHistory, system: str, unit: float, colours: Mapping[str, str]
) -> None:
    """Mark the peaks of engine and cargo on the reaction against time, with their values.

    Parameters
    ----------
    axes : Axes
        Where the reaction is drawn.
    history : CollisionHistory
        The collision.
    system : {"SI", "US"}
        Units that the values are printed in.
    unit : float
        Unit of the vertical axis [N].
    colours : mapping
        Colours of "engine" and "cargo".
    """
    for name, peak in history.peaks.items():
        if peak is None:
            continue
        x, y = peak.time / unit_size("time", system), peak.reaction / unit
        late = x > 0.6 * axes.get_xlim()[1]  # no room on the right
        axes.plot([x], [y], "o", color=colours[name], markersize=5.0, zorder=5)
        words = f"{name.capitalize()} peak {printed(peak.reaction, 'force', system)}"
        pale = {"facecolor": "white", "edgecolor": "none", "alpha": 0.6, "pad": 0.5}
        offset, align = ((-6, 5), "right") if late else ((6, 5), "left")
        note(axes, words, (x, y), offset, ha=align, bbox=pale)
