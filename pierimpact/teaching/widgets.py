"""The explorers of the teaching notebooks: `widgets.collision()` and its siblings."""

from pierimpact.teaching import browser, presampled
from pierimpact.teaching.explorer import CollisionExplorer, Explorer
from pierimpact.teaching.scenario import EXAMPLE
from pierimpact.teaching.variables import CRUSH

_TRUCK = ["speed", "truck_mass"]
_COLUMN = ["column_diameter", "column_height", "base", "top", "damping_ratio"]
_PIER = ["pier_frequency", "pier_mass", "damping_ratio"]
#: How far each parameter is moved, as in the parametric study [-].
CHANGE = 0.3


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
        height=62,
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
    return Explorer(
        title="The shape function, and the pier’s stiffness and mass against the impact height",
        controls=["impact_height", "column_diameter", "column_height", "base", "top"],
        height=36,
        kind="shape",
        symbols=browser.symbols_data("kp", "mp", "fp"),
    )


def reduction() -> Explorer:
    """Explore the reduction to two degrees of freedom: the amplification of either body."""
    return Explorer(
        title="The amplification of engine and cargo against the frequency ratio",
        controls=[*_PIER, *_TRUCK],
        defaults=EXAMPLE,
        height=36,
        kind="reduction",
    )


def design() -> Explorer:
    """Explore the design reaction beside the full model and the forces of codes."""
    return Explorer(
        title="Design reaction, full model and code forces",
        controls=[*_TRUCK, *_COLUMN, "impact_height"],
        height=36,
        kind="reactions",
        symbols=browser.symbols_data("fp"),
        codes=browser.codes_data(),
        domain=browser.domain_data(),
    )


def sensitivity() -> Explorer:
    """Explore which parameters of the truck matter."""
    return Explorer(
        title="Sensitivity of either peak to the parameters of the truck",
        controls=[*_TRUCK, *_COLUMN],
        height=52,
        kind="influences",
        symbols=browser.symbols_data("fp", "kp", "mp"),
        parameters=browser.parameters_data(),
        change=CHANGE,
    )


def risk() -> Explorer:
    """Explore how often a pier is struck too hard by the traffic, and by which trucks."""
    return Explorer(
        title="Reactions by how often they are exceeded, and the trucks that bring them about",
        controls=[
            *("traffic_volume", "truck_share", "distance_from_road", "mean_mass", "mean_speed"),
            *("resistance", "risk_pier"),
        ],
        height=40,
        kind="risk",
        presampled=presampled.data(),
    )
