"""A scenario written as a case file and a truck file."""

from pierimpact.teaching.scenario import REFERENCE, Scenario
from pierimpact.teaching.variables import CRUSH, VARIABLES

_SOURCE = "set by hand in an explorer"
_EVIDENCE = (f'source = "{_SOURCE}"', 'status = "illustrative"')


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
    lines = [
        f'name = "changed-{REFERENCE.name}"',
        f'description = "{REFERENCE.name} with parameters {_SOURCE}"',
        *_EVIDENCE,
        *_entry("body_mass", f"{scenario.truck.body_mass:.12g}", "kg"),
        *_entry("friction_on", f'"{scenario.truck.friction_on}"'),
    ]
    for name in CRUSH:
        lines += _entry(VARIABLES[name].symbol.key, *_given(name, scenario).split(" "))
    return "\n".join([*lines, ""])


def _entry(key: str, value: str, unit: str = "") -> list[str]:
    units = [f'unit = "{unit}"'] if unit else []
    return ["", f"[{key}]", f"value = {value}", *units, *_EVIDENCE]


def _given(name: str, scenario: Scenario) -> str:
    variable = VARIABLES[name]
    return f"{getattr(scenario, name) / variable.size:.12g} {variable.unit}"


def _is_reference_truck(scenario: Scenario) -> bool:
    return all(getattr(scenario, name) == getattr(Scenario, name) for name in CRUSH)
