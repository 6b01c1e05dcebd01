"""The explorers of the teaching notebooks: `widgets.collision()` and its siblings."""

from pierimpact.teaching import charts, explorer_data, readouts
from pierimpact.teaching.explorer import Chart, ChartExplorer, CollisionExplorer, Explorer
from pierimpact.teaching.readouts import Readout
from pierimpact.teaching.scenario import EXAMPLE, Scenario
from pierimpact.teaching.variables import CRUSH

_TRUCK = ["speed", "truck_mass"]
_COLUMN = ["column_diameter", "column_height", "base", "top", "damping_ratio"]
_PIER = ["pier_frequency", "pier_mass", "damping_ratio"]


def collision() -> Explorer:
    """Explore one collision: its sequence, and the two spikes of its force."""
    return CollisionExplorer(
        title="A collision in slow motion, with its forces and its energy",
        controls=[*_TRUCK, *_COLUMN],
        spectra=False,
        energy=True,
    )


def full() -> Explorer:
    """Explore everything at once: spectra, collision, forces and energy.

    The pier is the column, until its frequency or mass is set.
    """
    return CollisionExplorer(
        title="A collision, its forces and energy, and its position on the spectra",
        above=["pier_frequency"],
        controls=[*_TRUCK, "pier_mass", "damping_ratio"],
        drawers={
            "The pier as a column": [*_COLUMN[:-1], "impact_height"],
            "The truck’s crush laws": list(CRUSH),
        },
        spectra=True,
        energy=True,
        copies=True,
    )


def spectra() -> Explorer:
    """Explore how both peaks depend on the pier's frequency, set directly."""
    return CollisionExplorer(
        title="A collision and its position on the spectra of engine and cargo",
        above=["pier_frequency"],
        controls=["pier_mass", "damping_ratio", *_TRUCK],
        spectra=True,
        energy=False,
        defaults=EXAMPLE,
    )


def pier() -> Explorer:
    """Explore how a column becomes a mass on a spring, Eqs 1–3."""

    def draw(scenario: Scenario) -> tuple[Readout, list[Chart]]:
        return readouts.shape(scenario), charts.pier(scenario)

    return ChartExplorer(
        title="The shape function, and the pier’s stiffness and mass against the impact height",
        controls=["impact_height", "column_diameter", "column_height", "base", "top"],
        draw=draw,
    )


def reduction() -> Explorer:
    """Explore the reduction to two degrees of freedom: the amplification of either body."""

    def draw(scenario: Scenario) -> tuple[Readout, list[Chart]]:
        values = explorer_data.short_procedure(scenario)
        return readouts.amplification(scenario, values), charts.amplification(scenario, values)

    return ChartExplorer(
        title="The amplification of engine and cargo against the frequency ratio",
        controls=[*_PIER, *_TRUCK],
        draw=draw,
        defaults=EXAMPLE,
    )


def design() -> Explorer:
    """Explore the design reaction beside the full model and the forces of codes."""

    def draw(scenario: Scenario) -> tuple[Readout, list[Chart]]:
        return readouts.design(scenario), charts.reactions(scenario)

    return ChartExplorer(
        title="Design reaction, full model and code forces",
        controls=[*_TRUCK, *_COLUMN, "impact_height"],
        draw=draw,
    )


def sensitivity() -> Explorer:
    """Explore which parameters of the truck matter."""

    def draw(scenario: Scenario) -> tuple[Readout, list[Chart]]:
        changes = explorer_data.influences(scenario)
        return readouts.influence(scenario, changes), charts.influences(changes)

    return ChartExplorer(
        title="Sensitivity of either peak to the parameters of the truck",
        controls=[*_TRUCK, *_COLUMN],
        draw=draw,
    )
