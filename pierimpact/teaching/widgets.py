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
    """Explore one collision: its sequence, and the two spikes of its force.

    Returns
    -------
    Explorer
        Shows in a notebook. `set` moves its sliders, `scenario` returns the collision on show.

    Examples
    --------
    >>> from pierimpact import widgets
    >>> explorer = widgets.collision()
    >>> explorer.set(speed=60.0 / 3.6)  # m/s
    >>> collision = explorer.scenario()
    >>> round(collision.history.governing_peak.reaction / 1e6, 2)  # MN
    3.39
    """
    return CollisionExplorer(
        title="A collision in slow motion, with its forces and its energy",
        controls=[*_TRUCK, *_COLUMN],
        heights=(90, 45, 45),
        spectra=False,
        energy=True,
    )


def full() -> Explorer:
    """Explore everything at once: spectra, collision, forces and energy.

    The pier is the column, until its frequency or mass is set.

    Returns
    -------
    Explorer
        Used as that of `collision`; it has more sliders.

    Examples
    --------
    >>> from pierimpact import widgets
    >>> explorer = widgets.full()
    >>> explorer.set(engine_mass=1000.0)  # kg
    >>> collision = explorer.scenario()
    >>> round(collision.history.engine_peak.reaction / 1e6, 2)  # MN
    10.26
    """
    return CollisionExplorer(
        title="A collision, its forces and energy, and its position on the spectra",
        above=["pier_frequency"],
        controls=[*_TRUCK, "pier_mass", "damping_ratio"],
        heights=(124, 67, 67),
        drawers={
            "The pier as a column": [*_COLUMN[:-1], "impact_height"],
            "The truck’s crush laws": list(CRUSH),
        },
        spectra=True,
        energy=True,
        copies=True,
    )


def spectra() -> Explorer:
    """Explore how both peaks depend on the pier's frequency, set directly.

    Returns
    -------
    Explorer
        Used as that of `collision`; its pier is given by mass and frequency.

    Examples
    --------
    >>> from pierimpact import widgets
    >>> explorer = widgets.spectra()
    >>> explorer.scenario().history.governs
    'cargo'
    >>> explorer.set(pier_frequency=100.0)  # Hz
    >>> explorer.scenario().history.governs
    'engine'
    """
    return CollisionExplorer(
        title="A collision and its position on the spectra of engine and cargo",
        above=["pier_frequency"],
        controls=["pier_mass", "damping_ratio", *_TRUCK],
        heights=(98, 55, 55),
        spectra=True,
        energy=False,
        defaults=EXAMPLE,
    )


def pier() -> Explorer:
    """Explore how a column becomes a mass on a spring, Eqs 1–3.

    Returns
    -------
    Explorer
        Used as that of `collision`; what it shows is the `pier` of its scenario.

    Examples
    --------
    >>> from pierimpact import widgets
    >>> explorer = widgets.pier()
    >>> round(explorer.scenario().pier.mass / 1e3, 1)  # t
    6.4
    >>> explorer.set(top="free")
    >>> round(explorer.scenario().pier.mass / 1e3, 1)  # more than the column's own 7.9 t
    55.5
    """
    return Explorer(
        title="The shape function, and the pier’s stiffness and mass against the impact height",
        controls=["impact_height", "column_diameter", "column_height", "base", "top"],
        heights=(92, 66, 46),
        kind="shape",
        symbols=browser.symbols_data("kp", "mp", "fp"),
    )


def reduction() -> Explorer:
    """Explore the reduction to two degrees of freedom: the amplification of either body.

    Returns
    -------
    Explorer
        Used as that of `collision`; its pier is given by mass and frequency.

    Examples
    --------
    >>> from pierimpact import widgets
    >>> explorer = widgets.reduction()
    >>> values = explorer.scenario().design("short").values
    >>> round(values["beta1"], 2), round(values["S1"], 2)  # frequency ratio, amplification
    (0.41, 0.54)
    """
    return Explorer(
        title="The amplification of engine and cargo against the frequency ratio",
        controls=[*_PIER, *_TRUCK],
        heights=(79, 51, 32),
        defaults=EXAMPLE,
        kind="reduction",
    )


def design() -> Explorer:
    """Explore the design reaction beside the full model and the forces of codes.

    Returns
    -------
    Explorer
        Used as that of `collision`.

    Examples
    --------
    >>> from pierimpact import widgets
    >>> explorer = widgets.design()
    >>> collision = explorer.scenario()
    >>> by_hand = collision.design("short").reaction
    >>> round(by_hand / collision.history.governing_peak.reaction, 2)
    1.04
    """
    return Explorer(
        title="Design reaction, full model and code forces",
        controls=[*_TRUCK, *_COLUMN, "impact_height"],
        heights=(90, 50, 44),
        kind="reactions",
        symbols=browser.symbols_data("fp"),
        codes=browser.codes_data(),
        domain=browser.domain_data(),
    )


def sensitivity() -> Explorer:
    """Explore which parameters of the truck matter.

    Returns
    -------
    Explorer
        Used as that of `collision`.

    Examples
    --------
    >>> from pierimpact import reaction_band, widgets
    >>> explorer = widgets.sensitivity()
    >>> found = explorer.scenario()
    >>> band = reaction_band(found.truck, found.pier, found.speed, spread=0.3, size=64)
    >>> next(iter(band.influence))  # what matters most
    'engine_mass'
    """
    return Explorer(
        title="Sensitivity of either peak to the parameters of the truck",
        controls=[*_TRUCK, *_COLUMN],
        heights=(87, 53, 52),
        kind="influences",
        symbols=browser.symbols_data("fp", "kp", "mp"),
        parameters=browser.parameters_data(),
        change=CHANGE,
    )


def risk() -> Explorer:
    """Explore how often a pier is struck too hard by the traffic, and by which trucks.

    Returns
    -------
    Explorer
        Used as that of `collision`; its scenario has traffic and resistance.

    Examples
    --------
    >>> from pierimpact import widgets
    >>> from pierimpact.teaching.presampled import weights
    >>> explorer = widgets.risk()
    >>> round(float(1.0 / weights(explorer.scenario()).sum()), -1)  # years between two strikes
    840.0
    >>> explorer.set(distance_from_road=12.0)  # m, twice as far away
    >>> round(float(1.0 / weights(explorer.scenario()).sum()), -1)
    1590.0
    """
    return Explorer(
        title="Reactions by how often they are exceeded, and the trucks that bring them about",
        controls=[
            *("traffic_volume", "truck_share", "distance_from_road", "mean_mass", "mean_speed"),
            *("resistance", "risk_pier"),
        ],
        heights=(101, 58, 40),
        kind="risk",
        presampled=presampled.data(),
    )
