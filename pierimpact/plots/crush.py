"""The crush laws of a truck's two springs, with their parameters where they act."""

from typing import Any

from matplotlib.axes import Axes

from pierimpact.plots.dimension import draw_dimension
from pierimpact.plots.style import BODIES, MUTED, PALE, TEXT_WIDTH, page_figure
from pierimpact.plots.svg import to_svg
from pierimpact.plots.words import named
from pierimpact.vehicle.truck import Truck

# Not to scale, so that every parameter can be seen whatever it is. Over the width of the panel:
# elastic limit, end of the plateau and largest crush; over its height: plateau and largest force.
_LIMIT, _END, _LARGEST = 0.035, 0.42, 0.62
_PLATEAU, _FORCE = 0.24, 0.92
_RELIEVED = _LARGEST - _LIMIT / _PLATEAU * _FORCE  # along a line as steep as the first


def draw_crush_curves(truck: Truck, system: str) -> str:
    """Draw force over crush of engine and body, not to scale, with the parameters; return SVG.

    168 × 48 mm.

    Parameters
    ----------
    truck : Truck
        The truck.
    system : {"SI", "US"}
        Units to print in.
    """
    margins = {"left": 5.0, "right": 1.0, "bottom": 5.0, "top": 5.0}
    with page_figure(TEXT_WIDTH, 48.0, **margins, wspace=0.1) as figure:
        bodies = (
            ("engine", "Engine and stiff parts", truck.engine_mass),
            ("cargo", "Body and cargo", truck.body_mass),
        )
        panels = figure.subplots(1, 2)
        for number, (axes, (body, words, mass)) in enumerate(zip(panels, bodies, strict=True), 1):
            axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0), xticks=[], yticks=[])
            axes.set_title(f"{words}: {named(f'm{number}', mass, system)}")
            axes.set_xlabel(f"Crush $\\delta_{number}$, not to scale")
            axes.set_ylabel(f"Force $F_{number}$")
            spring = truck.engine_spring if number == 1 else truck.body_spring
            values = {
                "P": spring.plateau_force,
                "d": spring.plateau_length,
                "k": spring.stiffness,
                "ku": spring.unloading_stiffness,
            }
            shown = {name: named(f"{name}{number}", own, system) for name, own in values.items()}
            _draw(axes, shown, "engine" if number == 1 else "cargo", BODIES[body])
        return to_svg(figure)


def _draw(axes: Axes, shown: dict[str, str], arrives: str, colour: str) -> None:
    line: Any = {"color": colour, "linewidth": 1.5, "clip_on": False}
    x, y = (0.0, _LIMIT, _END, _LARGEST), (0.0, _PLATEAU, _PLATEAU, _FORCE)
    axes.fill((*x, _RELIEVED), (*y, 0.0), color=PALE, alpha=0.5, linewidth=0.0)
    axes.plot(x, y, **line)
    axes.plot((_LARGEST, _RELIEVED), (_FORCE, 0.0), **line | {"linewidth": 1.0}, dashes=(4, 2))
    draw_dimension(axes, (0.0, 0.07), (_END, 0.07), "", "below")
    axes.plot([_END, _END], [0.0, _PLATEAU], color=MUTED, linewidth=0.5)
    middle = 0.5 * (_LIMIT + _END)
    for place, words, ha, va in (
        ((middle - 0.02, _PLATEAU + 0.03), f"crumpling: {shown['P']}", "center", "bottom"),
        ((middle, 0.09), shown["d"], "center", "bottom"),
        ((0.46, 0.62), f"{arrives} on the pier:\n{shown['k']}", "right", "center"),
        ((0.63, 0.62), f"unloading, reloading:\n{shown['ku']}", "left", "center"),
    ):
        axes.text(*place, words, ha=ha, va=va)
