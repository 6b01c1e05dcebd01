"""The shape function of a column over its height."""

import numpy as np

from pierimpact.pier.column import StruckColumn
from pierimpact.plots.ends import end_labels, mark_ends
from pierimpact.plots.labels import Label, place
from pierimpact.plots.style import BLUE, INK, page_figure
from pierimpact.plots.svg import to_svg
from pierimpact.plots.words import named
from pierimpact.units import rounded, unit_of, unit_size


def draw_shape_function(struck: StruckColumn, system: str) -> str:
    """Draw the shape function of a column over its height, for a page; return SVG.

    60 × 70 mm; with 1 at the impact, the largest value, the column at rest and its ends.

    Parameters
    ----------
    struck : StruckColumn
        The column and where it is struck.
    system : {"SI", "US"}
        Units to print in.
    """
    column, impact, size = struck.column, struck.impact_height, unit_size("length", system)
    z = np.union1d(np.linspace(0.0 - column.embedment, column.height, 301), impact)
    shape = struck.shape(z)
    most = int(np.argmax(np.abs(shape)))
    largest, place_of_it, unit = float(shape[most]), float(z[most]), unit_of("length", system)
    with page_figure(60.0, 70.0, left=13.0, right=2.0, bottom=9.0, top=3.0) as figure:
        axes = figure.add_subplot()
        axes.plot([0.0, 0.0], [z[0] / size, z[-1] / size], color=INK, linewidth=0.8)
        axes.plot(shape, z / size, color=BLUE, linewidth=1.6)
        axes.plot([0.0, 1.0], [impact / size] * 2, color=INK, linewidth=0.6, dashes=(4, 3))
        axes.plot([1.0], [impact / size], "o", color=BLUE, markersize=4.0)
        axes.margins(x=0.12, y=0.12)
        axes.set_xlabel("Shape function $\\varphi$ [-]")
        axes.set_ylabel(f"Height $z$ [{unit}]")
        axes.locator_params(nbins=5)
        mark_ends(axes, column, size)
        labels = [Label(axes, f"1 at {named('z', impact, system)}", (1.0, impact / size))]
        if abs(largest) > 1.0 + 1e-6:
            words = f"{rounded(largest, 3)} at {rounded(place_of_it / size, 3)} {unit}"
            axes.plot([largest], [place_of_it / size], "o", color=BLUE, markersize=4.0, mfc="w")
            labels.append(Label(axes, f"largest {words}", (largest, place_of_it / size)))
        place(figure, labels + end_labels(axes, column, size))
        return to_svg(figure)
