"""What a slider can move: names, units and ranges, and the files that the values make."""

from dataclasses import dataclass, fields

from pierimpact.checks import InputError, brief, number
from pierimpact.teaching.scenario import REFERENCE, Scenario
from pierimpact.units import parse


@dataclass(frozen=True, kw_only=True)
class Variable:
    """A value that a control sets.

    Parameters
    ----------
    label : str
        What it is called beside the slider.
    dimension, unit : str
        What it must be, as in `pierimpact.units`, and the unit it is shown in; empty for a plain
        number.
    low, high : float
        Ends of the slider, in that unit.
    step : float
        Step of the slider; of the power of ten where `log`.
    log : bool, optional
        Whether the slider is logarithmic.
    choices : tuple of str, optional
        What there is to choose from, in place of a slider.
    """

    label: str
    dimension: str = ""
    unit: str = ""
    low: float = 0.0
    high: float = 1.0
    step: float = 0.1
    log: bool = False
    choices: tuple[str, ...] = ()

    @property
    def size(self) -> float:
        """Return the unit in SI units."""
        return parse(self.label, f"1 {self.unit}", self.dimension) if self.dimension else 1.0

    def shown(self, value: float) -> str:
        """Return a value in SI units as it would be typed."""
        return f"{value / self.size:.4g} {self.unit}".strip()

    def parsed(self, text: str) -> float:
        """Return what was typed in SI units; a bare number is in the unit shown.

        Raises
        ------
        InputError
            When the text is not such a value.
        """
        try:
            plain = float(text)
        except ValueError:
            if self.dimension:
                return parse(self.label, text.strip(), self.dimension)
            raise InputError(f"{self.label} must be a number, got {brief(text)}") from None
        return number(self.label, plain) * self.size


def _spring(body: str, where: str) -> dict[str, Variable]:
    stiff = {"engine": (20.0, 600.0), "body": (1.0, 100.0)}[body]
    force = {"engine": (20.0, 600.0), "body": (50.0, 1500.0)}[body]
    length = {"engine": (0.05, 1.5), "body": (0.2, 4.0)}[body]
    return {
        f"{body}_plateau_force": Variable(
            label=f"{where}: plateau force P",
            dimension="force",
            unit="kN",
            low=force[0],
            high=force[1],
            step=10.0,
        ),
        f"{body}_plateau_length": Variable(
            label=f"{where}: plateau length d",
            dimension="length",
            unit="m",
            low=length[0],
            high=length[1],
            step=0.05,
        ),
        f"{body}_stiffness": Variable(
            label=f"{where}: steep stiffness k",
            dimension="stiffness",
            unit="MN/m",
            low=stiff[0],
            high=stiff[1],
            step=0.01,
            log=True,
        ),
        f"{body}_unloading_stiffness": Variable(
            label=f"{where}: unloading stiffness k_u",
            dimension="stiffness",
            unit="MN/m",
            low=stiff[0],
            high=10.0 * stiff[1],
            step=0.01,
            log=True,
        ),
    }


CRUSH = {
    "engine_mass": Variable(
        label="Engine mass m₁", dimension="mass", unit="kg", low=200.0, high=2000.0, step=50.0
    ),
    "friction_force": Variable(
        label="Friction c_s on the body",
        dimension="force",
        unit="kN",
        low=0.0,
        high=100.0,
        step=0.5,
    ),
    **_spring("engine", "Engine"),
    **_spring("body", "Body"),
}
ENDS = ("fixed", "pinned", "free")
VARIABLES = {
    "speed": Variable(
        label="Speed V", dimension="speed", unit="km/h", low=10.0, high=130.0, step=1.0
    ),
    "truck_mass": Variable(
        label="Truck mass m₁ + m₂", dimension="mass", unit="t", low=3.0, high=40.0, step=0.5
    ),
    "column_diameter": Variable(
        label="Pier diameter D", dimension="length", unit="m", low=0.4, high=2.5, step=0.02
    ),
    "column_height": Variable(
        label="Pier height H", dimension="length", unit="m", low=2.0, high=15.0, step=0.1
    ),
    "impact_height": Variable(
        label="Impact height z_n", dimension="length", unit="m", low=0.2, high=5.0, step=0.05
    ),
    "base": Variable(label="Base", choices=ENDS),
    "top": Variable(label="Top", choices=ENDS),
    "damping_ratio": Variable(label="Damping ratio ζ", low=0.0, high=0.3, step=0.005),
    "pier_frequency": Variable(
        label="Pier frequency f_p",
        dimension="frequency",
        unit="Hz",
        low=2.0,
        high=200.0,
        step=0.01,
        log=True,
    ),
    "pier_mass": Variable(
        label="Pier mass m_p",
        dimension="mass",
        unit="t",
        low=0.5,
        high=100.0,
        step=0.01,
        log=True,
    ),
    **CRUSH,
}


def case_text(scenario: Scenario, truck_file: str) -> str:
    """Return a scenario with a column as a case file.

    Parameters
    ----------
    scenario : Scenario
        The values.
    truck_file : str
        Name of the truck file that goes with it, for a truck that is not the reference truck.
    """
    truck = REFERENCE.name if _is_reference_truck(scenario) else truck_file
    return "\n".join(
        [
            "column_shape: circular",
            f"column_diameter: {_given('column_diameter', scenario)}",
            f"column_height: {_given('column_height', scenario)}",
            f"elastic_modulus: {scenario.elastic_modulus / 1e9:.12g} GPa",
            f"density: {scenario.density:.12g} kg/m^3",
            f"base: {scenario.base}",
            f"top: {scenario.top}",
            f"truck: {truck}",
            f"truck_mass: {_given('truck_mass', scenario)}",
            f"speed: {_given('speed', scenario)}",
            f"impact_height: {_given('impact_height', scenario)}",
            f"damping_ratio: {scenario.damping_ratio:.12g}",
            "",
        ]
    )


def truck_text(scenario: Scenario) -> str:
    """Return the truck as a truck file; empty where it is the reference truck."""
    if _is_reference_truck(scenario):
        return ""
    source = "set by hand in an explorer"
    lines = [
        f'name = "changed-{REFERENCE.name}"',
        f'description = "{REFERENCE.name} with parameters {source}"',
        f'source = "{source}"',
        'status = "illustrative"',
        *_entry("body_mass", f"{scenario.truck.body_mass:.12g}", "kg", source),
        *_entry("friction_on", f'"{scenario.truck.friction_on}"', "", source),
    ]
    for name in CRUSH:
        body, _, rest = name.partition("_")
        key = name if name in ("engine_mass", "friction_force") else f"{body}_spring.{rest}"
        value, unit = _given(name, scenario).split(" ")
        lines += _entry(key, value, unit, source)
    return "\n".join([*lines, ""])


def _entry(key: str, value: str, unit: str, source: str) -> list[str]:
    units = [f'unit = "{unit}"'] if unit else []
    return ["", f"[{key}]", f"value = {value}", *units, f'source = "{source}"',
            'status = "illustrative"']  # fmt: skip


def _given(name: str, scenario: Scenario) -> str:
    variable = VARIABLES[name]
    return f"{getattr(scenario, name) / variable.size:.12g} {variable.unit}"


def _is_reference_truck(scenario: Scenario) -> bool:
    return all(
        getattr(scenario, field.name) == field.default
        for field in fields(Scenario)
        if field.name in CRUSH
    )
