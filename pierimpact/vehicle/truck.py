"""The truck: two masses that strike the pier through two crush springs."""

from dataclasses import dataclass, replace

from pierimpact.checks import InputError, not_negative, one_of, positive
from pierimpact.vehicle.crush import CrushSpring

FRICTION_ENDS = ("road", "pier")


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

    Raises
    ------
    InputError
        When a mass is not positive, the friction is negative, or `friction_on` is unknown.
    """

    name: str
    engine_mass: float
    body_mass: float
    engine_spring: CrushSpring
    body_spring: CrushSpring
    friction_force: float = 0.0
    friction_on: str = "road"
    source: str = "not given"

    def __post_init__(self) -> None:
        rules = {"engine_mass": positive, "body_mass": positive, "friction_force": not_negative}
        for name, rule in rules.items():
            object.__setattr__(self, name, rule(name, getattr(self, name)))
        one_of("friction_on", self.friction_on, FRICTION_ENDS)
        for name in ("engine_spring", "body_spring"):
            if not isinstance(getattr(self, name), CrushSpring):
                raise InputError(f"{name} must be a CrushSpring, got {getattr(self, name)!r}")

    @property
    def mass(self) -> float:
        """Total mass m1 + m2 [kg]."""
        return self.engine_mass + self.body_mass

    def with_mass(self, mass: float) -> "Truck":
        """Return the same truck with more or less cargo.

        Only m2 changes: springs, engine and friction force stay as they are.

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
                f"mass must exceed the engine's {self.engine_mass:g} kg, got {mass:g} kg"
            )
        return replace(self, body_mass=mass - self.engine_mass)
