"""The truck: two masses that strike the pier through two crush springs."""

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from pierimpact.checks import InputError, brief, not_negative, one_of, positive, told_from
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.spread import Spread, checked_spreads

FRICTION_ENDS = ("road", "pier")
SPRINGS = ("engine_spring", "body_spring")
#: What a truck file gives, and of it what may carry a spread.
PARAMETERS = (
    *("engine_mass", "body_mass", "friction_force", "friction_on"),
    *(f"{spring}.{name}" for spring in SPRINGS for name in CrushSpring.__dataclass_fields__),
)
QUANTITIES = tuple(name for name in PARAMETERS if name != "friction_on")


class MassRangeWarning(UserWarning):
    """A truck is lighter or heavier than its other parameters stand for.

    Examples
    --------
    >>> import warnings
    >>> from pierimpact import load_truck
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     truck = load_truck("single-unit-8t").with_mass(40e3)
    >>> str(caught[0].message).partition(":")[0]
    'A 40 t mass on the springs of single-unit-8t is another truck'
    """


@dataclass(frozen=True, kw_only=True)
class Truck:
    """The truck of the coupled mass-spring-damper (CMSD) model.

    The engine (with other stiff parts) and the rest of the truck (with its cargo) each strike
    the pier through their own spring and are not joined to each other.

    Parameters
    ----------
    name : str
        What the truck is called in results.
    engine_mass : float
        Mass m1 of the engine and the stiff parts around it [kg].
    body_mass : float
        Mass m2 of the rest of the truck, cargo included [kg].
    engine_spring, body_spring : CrushSpring
        Springs 1 and 2, from m1 and from m2 to the pier.
    friction_force : float, optional
        Coulomb force c_s on m2 [N].
    friction_on : {"road", "pier"}, optional
        What the friction acts against: the road at all times, or the pier while spring 2 is
        in contact. The source paper does not say; the road is this project's default.
    source : str
        Where the parameters come from.
    spread : mapping of str to Spread, optional
        How uncertain parameters are, by names as "engine_spring.stiffness"; the others are known.
        Trucks that differ in nothing else are equal.
    mass_range : tuple of float, optional
        Lowest and highest total mass that the other parameters stand for; None where nothing is
        known of it [kg]. As with the spread, it does not make another truck.

    Raises
    ------
    InputError
        When a mass is not positive, the friction is negative, `friction_on` is unknown, a spread
        is of no parameter or lets it be zero, or the mass range does not run upward.

    Examples
    --------
    >>> from pierimpact import load_truck
    >>> truck = load_truck("single-unit-8t")
    >>> truck.engine_mass, truck.body_mass
    (700.0, 7300.0)
    >>> truck.with_mass(10e3).body_mass
    9300.0
    """

    name: str
    engine_mass: float
    body_mass: float
    engine_spring: CrushSpring
    body_spring: CrushSpring
    friction_force: float = 0.0
    friction_on: str = "road"
    source: str = "not given"
    spread: Mapping[str, Spread] = field(default_factory=dict, compare=False, repr=False)
    mass_range: tuple[float, float] | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        rules = {"engine_mass": positive, "body_mass": positive, "friction_force": not_negative}
        for name, rule in rules.items():
            object.__setattr__(self, name, rule(name, getattr(self, name)))
        one_of("friction_on", self.friction_on, FRICTION_ENDS)
        for name in SPRINGS:
            if not isinstance(getattr(self, name), CrushSpring):
                raise InputError(f"{name} must be a CrushSpring, got {brief(getattr(self, name))}")
        object.__setattr__(self, "spread", checked_spreads(self.spread, QUANTITIES))
        if self.mass_range is not None:
            object.__setattr__(self, "mass_range", _upward(self.mass_range))

    @property
    def mass(self) -> float:
        """Total mass m1 + m2 [kg]."""
        return self.engine_mass + self.body_mass

    @property
    def in_mass_range(self) -> bool:
        """Whether the mass is one that the other parameters stand for, as far as is known."""
        return self.mass_range is None or self.mass_range[0] <= self.mass <= self.mass_range[1]

    def with_mass(self, mass: float) -> "Truck":
        """Return the same truck with more or less cargo.

        Arguments, result and errors as in `loaded_to`.

        Warns
        -----
        MassRangeWarning
            Where the springs do not stand for a truck of that mass.
        """
        truck = self.loaded_to(mass)
        if not truck.in_mass_range and truck.mass_range is not None:
            masses = (f"{value / 1e3:.3g} t" for value in (truck.mass, *truck.mass_range))
            warnings.warn(another_truck(self.name, *masses), MassRangeWarning, stacklevel=2)
        return truck

    def loaded_to(self, mass: float) -> "Truck":
        """Return the same truck with more or less cargo, whether or not within its mass range.

        Only m2 changes: springs, engine and friction force stay as they are. A mass that is stated
        is known, so that m2 has no spread any more.

        Parameters
        ----------
        mass : float
            New total mass, above `engine_mass` [kg].

        Raises
        ------
        InputError
            When nothing is left for the body.
        """
        mass = positive("mass", mass)
        if mass <= self.engine_mass:
            raise InputError(
                f"mass must exceed the engine's {self.engine_mass:g} kg, "
                f"got {told_from(mass, self.engine_mass)} kg"
            )
        spread = {name: spread for name, spread in self.spread.items() if name != "body_mass"}
        return replace(self, body_mass=mass - self.engine_mass, spread=spread)


def another_truck(name: str, mass: str, low: str, high: str) -> str:
    """Return the sentence that warns of a mass outside a truck's range, masses with their units."""
    return (
        f"A {mass} mass on the springs of {name} is another truck: they stand for a total of {low} "
        f"to {high}."
    )


def _upward(mass_range: tuple[float, float]) -> tuple[float, float]:
    try:
        low, high = mass_range
    except (TypeError, ValueError):
        message = f"mass_range must be two masses, got {brief(mass_range)}"
        raise InputError(message) from None
    low, high = positive("mass_range", low), positive("mass_range", high)
    if low > high:
        raise InputError(f"mass_range must run upward, got {low:g} kg to {high:g} kg")
    return low, high
