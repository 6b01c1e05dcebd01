"""The explorers of the teaching notebooks: `widgets.collision()` and its siblings."""

from functools import partial

from pierimpact.plots import amplification, comparison, influence, shape
from pierimpact.plots.style import BODIES
from pierimpact.symbols import Symbol
from pierimpact.teaching import explorer_data, readouts
from pierimpact.teaching.collision_explorer import CollisionExplorer
from pierimpact.teaching.explorer import HALF, Contents, Explorer
from pierimpact.teaching.live import LiveFigure, LiveWords
from pierimpact.teaching.scenario import EXAMPLE, Scenario
from pierimpact.teaching.variables import CRUSH

_COLUMN = ["column_diameter", "column_height", "base", "top", "damping_ratio"]
_PIER = ["pier_frequency", "pier_mass", "damping_ratio"]
_THIRD = (280.0, 316.0)  # of the room beside the controls [px]


def collision() -> Explorer:
    """Explore one collision: its sequence, and the two spikes of its force."""
    return CollisionExplorer(
        title="A collision in slow motion, with its forces and its energy",
        controls=["speed", "truck_mass", *_COLUMN],
        spectra=False,
    )


def full() -> Explorer:
    """Explore everything at once: collision, forces, energy and spectra."""
    return CollisionExplorer(
        title="A collision, its forces and energy, and its position on the spectra",
        controls=["speed", "truck_mass", *_COLUMN, "impact_height"],
        hidden=list(CRUSH),
        spectra=True,
    )


def spectra() -> Explorer:
    """Explore how both peaks depend on the pier's frequency, set directly."""
    return CollisionExplorer(
        title="A collision and its position on the spectra of engine and cargo",
        controls=[*_PIER, "speed", "truck_mass"],
        spectra=True,
        defaults=EXAMPLE,
    )


def pier() -> Explorer:
    """Explore how a column becomes a mass on a spring, Eqs 1–3."""

    def contents(scenario: Scenario) -> Contents:
        struck = scenario.column.struck_at(scenario.impact_height)
        along = explorer_data.by_height(scenario.column)
        here = struck.impact_height
        return {
            "readout": (readouts.shape_readout(scenario),),
            "shape": ((struck,),),
            "stiffness": ((along.height, 1e-9 * along.stiffness, here, 1e-9 * struck.stiffness),),
            "mass": ((along.height, 1e-3 * along.mass, here, 1e-3 * struck.mass),),
        }

    return Explorer(
        title="The shape function, and the pier’s stiffness and mass against the impact height",
        controls=["impact_height", "column_diameter", "column_height", "base", "top"],
        views={
            "readout": LiveWords(),
            "shape": LiveFigure("Shape function", _THIRD, shape.shape_panel, shape.draw_shape),
            "stiffness": LiveFigure(
                "Stiffness against impact height",
                _THIRD,
                shape.stiffness_panel,
                partial(shape.draw_along, unit="GN/m"),
            ),
            "mass": LiveFigure(
                "Mass against impact height",
                _THIRD,
                shape.mass_panel,
                partial(shape.draw_along, unit="t"),
            ),
        },
        draw=contents,
        words=readouts.shape_words,
    )


def reduction() -> Explorer:
    """Explore the reduction to two degrees of freedom: the amplification of either body."""

    def contents(scenario: Scenario) -> Contents:
        values = explorer_data.short_procedure(scenario)
        mu, e = ((values[f"{name}1"], values[f"{name}2"]) for name in ("mu", "e"))
        curves = explorer_data.amplifications(mu, e, scenario.damping_ratio)
        return {"readout": (readouts.amplification_readout(scenario, values),)} | {
            body: ((curves[body],), (curves[body], values[f"beta{i}"], values[f"S{i}"]))
            for i, body in enumerate(BODIES, 1)
        }

    return Explorer(
        title="The amplification of engine and cargo against the frequency ratio",
        controls=[*_PIER, "speed", "truck_mass"],
        views={"readout": LiveWords()}
        | {
            body: LiveFigure(
                f"Amplification of the {body}",
                HALF,
                partial(amplification.amplification_panel, body=body),
                partial(amplification.draw_amplification, body=body),
                partial(amplification.draw_here, body=body),
            )
            for body in BODIES
        },
        draw=contents,
        words=lambda scenario: readouts.amplification_words(
            scenario, explorer_data.short_procedure(scenario)
        ),
        defaults=EXAMPLE,
    )


def design() -> Explorer:
    """Explore the design reaction beside the full model and the forces of codes."""

    def contents(scenario: Scenario) -> Contents:
        return {
            "readout": (readouts.design_readout(scenario),),
            "bars": ((explorer_data.bars(scenario),),),
        }

    names = [bar.name for bar in explorer_data.bars(Scenario())]
    return Explorer(
        title="Design reaction, full model and code forces",
        controls=["speed", "truck_mass", *_COLUMN, "impact_height"],
        views={
            "readout": LiveWords(),
            "bars": LiveFigure(
                "Reactions and code forces",
                (720.0, 36.0 + 24.0 * len(names)),
                partial(comparison.bars_panel, names=names),
                comparison.draw_bars,
            ),
        },
        draw=contents,
        words=readouts.design_words,
    )


def sensitivity() -> Explorer:
    """Explore which parameters of the truck matter."""

    def contents(scenario: Scenario) -> Contents:
        changes = explorer_data.influences(scenario)
        return {"readout": (readouts.influence_readout(scenario, changes),)} | {
            body: ((changes[body],),) for body in BODIES
        }

    return Explorer(
        title="Sensitivity of either peak to the parameters of the truck",
        controls=["speed", "truck_mass", *_COLUMN],
        views={"readout": LiveWords()}
        | {
            body: LiveFigure(
                f"Influence of the truck’s parameters on the {body} peak",
                (HALF[0], 360.0),
                partial(
                    influence.influence_panel,
                    title=f"{body.capitalize()} peak",
                    names=[_short_name(symbol) for symbol in explorer_data.PARAMETERS],
                    change=explorer_data.CHANGE,
                ),
                partial(influence.draw_influence, body=body),
            )
            for body in BODIES
        },
        draw=contents,
        words=lambda scenario: readouts.influence_words(explorer_data.influences(scenario)),
    )


def _short_name(parameter: Symbol) -> str:
    """Return the name of a truck parameter as a figure has room for it."""
    words, of, spring = parameter.meaning.partition(" of the ")
    name = f"{spring.removesuffix(' spring').capitalize()}: {words}" if of else parameter.heading
    return f"{name} ${parameter.latex}$"
