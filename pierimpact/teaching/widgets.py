"""The explorers of the teaching notebooks: `widgets.collision()` and its siblings."""

from functools import partial

from pierimpact.plots import amplification, comparison, influence, shape
from pierimpact.plots.style import BODIES
from pierimpact.symbols import Symbol
from pierimpact.teaching import explorer_data, readouts
from pierimpact.teaching.collision_explorer import CollisionExplorer
from pierimpact.teaching.explorer import HALF, Explorer, Shown
from pierimpact.teaching.live import LiveFigure
from pierimpact.teaching.scenario import EXAMPLE, Scenario
from pierimpact.teaching.variables import CRUSH

_TRUCK = ["speed", "truck_mass"]
_COLUMN = ["column_diameter", "column_height", "base", "top", "damping_ratio"]
_PIER = ["pier_frequency", "pier_mass", "damping_ratio"]
_THIRD = (280.0, 316.0)  # of the room beside the controls [px]


def collision() -> Explorer:
    """Explore one collision: its sequence, and the two spikes of its force."""
    return CollisionExplorer(
        title="A collision in slow motion, with its forces and its energy",
        controls=[*_TRUCK, *_COLUMN],
        spectra=False,
    )


def full() -> Explorer:
    """Explore everything at once: collision, forces, energy and spectra."""
    return CollisionExplorer(
        title="A collision, its forces and energy, and its position on the spectra",
        controls=[*_TRUCK, *_COLUMN, "impact_height"],
        hidden=list(CRUSH),
        spectra=True,
    )


def spectra() -> Explorer:
    """Explore how both peaks depend on the pier's frequency, set directly."""
    return CollisionExplorer(
        title="A collision and its position on the spectra of engine and cargo",
        controls=[*_PIER, *_TRUCK],
        spectra=True,
        defaults=EXAMPLE,
    )


def pier() -> Explorer:
    """Explore how a column becomes a mass on a spring, Eqs 1–3."""

    def draw(scenario: Scenario) -> Shown:
        struck = scenario.column.struck_at(scenario.impact_height)
        along = explorer_data.by_height(scenario.column)
        here = struck.impact_height
        return readouts.shape(scenario), {
            "shape": ((struck,),),
            "stiffness": ((along.height, along.stiffness, here, struck.stiffness),),
            "mass": ((along.height, along.mass, here, struck.mass),),
        }

    figures = {"shape": LiveFigure("Shape function", _THIRD, shape.shape_panel, shape.draw_shape)}
    layers = shape.along_panel, shape.draw_along
    for quantity in ("stiffness", "mass"):
        name = f"{quantity.capitalize()} against impact height"
        figures[quantity] = LiveFigure(name, _THIRD, *layers, quantity=quantity)
    return Explorer(
        title="The shape function, and the pier’s stiffness and mass against the impact height",
        controls=["impact_height", "column_diameter", "column_height", "base", "top"],
        figures=figures,
        draw=draw,
    )


def reduction() -> Explorer:
    """Explore the reduction to two degrees of freedom: the amplification of either body."""

    def draw(scenario: Scenario) -> Shown:
        values = explorer_data.short_procedure(scenario)
        mu, e = ((values[f"{name}1"], values[f"{name}2"]) for name in ("mu", "e"))
        curves = explorer_data.amplifications(mu, e, scenario.damping_ratio)
        return readouts.amplification(scenario, values), {
            body: ((curves[body],), (curves[body], values[f"beta{i}"], values[f"S{i}"]))
            for i, body in enumerate(BODIES, 1)
        }

    layers = (
        amplification.amplification_panel,
        amplification.draw_amplification,
        amplification.draw_here,
    )
    return Explorer(
        title="The amplification of engine and cargo against the frequency ratio",
        controls=[*_PIER, *_TRUCK],
        figures={
            body: LiveFigure(f"Amplification of the {body}", HALF, *layers, body=body)
            for body in BODIES
        },
        draw=draw,
        defaults=EXAMPLE,
    )


def design() -> Explorer:
    """Explore the design reaction beside the full model and the forces of codes."""

    def draw(scenario: Scenario) -> Shown:
        return readouts.design(scenario), {"bars": ((explorer_data.bars(scenario),),)}

    names = [bar.name for bar in explorer_data.bars(Scenario())]
    size, panel = (720.0, 36.0 + 24.0 * len(names)), partial(comparison.bars_panel, names=names)
    bars = LiveFigure("Reactions and code forces", size, panel, comparison.draw_bars)
    return Explorer(
        title="Design reaction, full model and code forces",
        controls=[*_TRUCK, *_COLUMN, "impact_height"],
        figures={"bars": bars},
        draw=draw,
    )


def sensitivity() -> Explorer:
    """Explore which parameters of the truck matter."""

    def draw(scenario: Scenario) -> Shown:
        changes = explorer_data.influences(scenario)
        figures = {body: ((change,),) for body, change in changes.items()}
        return readouts.influence(scenario, changes), figures

    names = [_short_name(symbol) for symbol in explorer_data.PARAMETERS]
    panel = partial(influence.influence_panel, names=names, change=explorer_data.CHANGE)
    layers, size = (panel, influence.draw_influence), (HALF[0], 360.0)
    words = "Influence of the truck’s parameters on the"
    return Explorer(
        title="Sensitivity of either peak to the parameters of the truck",
        controls=[*_TRUCK, *_COLUMN],
        figures={
            body: LiveFigure(f"{words} {body} peak", size, *layers, body=body) for body in BODIES
        },
        draw=draw,
    )


def _short_name(parameter: Symbol) -> str:
    """Return the name of a truck parameter as a figure has room for it."""
    words, of, spring = parameter.meaning.partition(" of the ")
    name = f"{spring.removesuffix(' spring').capitalize()}: {words}" if of else parameter.heading
    return f"{name} ${parameter.latex}$"
