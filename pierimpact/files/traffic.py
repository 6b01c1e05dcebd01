"""The traffic of a case: what its file gives, and for the rest the laws of the JCSS model code."""

from dataclasses import dataclass
from pathlib import Path

from pierimpact.checks import InputError
from pierimpact.files.distributions import parse_distribution
from pierimpact.files.inputs import Inputs
from pierimpact.files.limits import BRAKING, POSSIBLE
from pierimpact.files.trucks import TruckFile, read_truck_file, truck_names
from pierimpact.files.weigh_in_motion import read_weigh_in_motion
from pierimpact.risk.traffic import (
    ANGLES,
    ENCROACHMENT_RATE,
    LEAST_WIDTH,
    ROAD_SPEEDS,
    Traffic,
    jcss_angle,
    jcss_deceleration,
    jcss_mass,
    jcss_speed,
)

#: Without any of these nothing can be said of the traffic.
NEEDED = ("traffic_volume", "truck_share", "distance_from_road")
#: The numbers of a case that are for its traffic alone.
OF_TRAFFIC = (*NEEDED, "exposed_width", "encroachment_rate")


@dataclass(frozen=True, kw_only=True)
class CaseTraffic:
    """The traffic of a case, with the files of its trucks."""

    traffic: Traffic
    truck_files: tuple[TruckFile, ...]


def traffic_of(inputs: Inputs, truck_file: TruckFile, folder: Path) -> CaseTraffic | None:
    """Return the traffic of a case; None where it does not give all of NEEDED.

    Parameters
    ----------
    inputs : Inputs
        Inputs of the case.
    truck_file : TruckFile
        Its truck, for the masses that this one stands for.
    folder : Path
        Where paths of files start from.

    Raises
    ------
    InputError
        When a value breaks a rule.
    """
    volume, share, distance = (getattr(inputs, key) for key in NEEDED)
    if volume is None or share is None or distance is None:
        return None
    if inputs.weigh_in_motion and inputs.traffic_mass:
        raise InputError("give one of traffic_mass and weigh_in_motion")
    sample = (
        read_weigh_in_motion(folder / inputs.weigh_in_motion) if inputs.weigh_in_motion else None
    )
    if sample and sample.speed is not None and inputs.traffic_speed:
        raise InputError("traffic_speed must not be given where weigh_in_motion has speeds")
    mass, speed, braking, angle = (
        getattr(inputs, f"traffic_{name}") for name in ("mass", "speed", "deceleration", "angle")
    )
    traffic = Traffic(
        trucks=volume * share,
        distance=distance,
        width=inputs.exposed_width or LEAST_WIDTH,
        encroachment_rate=inputs.encroachment_rate or ENCROACHMENT_RATE,
        mass=sample
        or (
            parse_distribution("traffic_mass", mass, "mass", _up_to("truck_mass"))
            if mass
            else jcss_mass()
        ),
        speed=jcss_speed(speed or "motorway")
        if not speed or speed in ROAD_SPEEDS
        else parse_distribution("traffic_speed", speed, "speed", _up_to("speed")),
        deceleration=parse_distribution(
            "traffic_deceleration", braking, "acceleration", (0.0, BRAKING)
        )
        if braking
        else jcss_deceleration(),
        angle=parse_distribution("traffic_angle", angle, "angle", ANGLES)
        if angle
        else jcss_angle(),
    )
    return CaseTraffic(traffic=traffic, truck_files=_trucks(inputs, truck_file, folder))


def _up_to(key: str) -> tuple[float, float]:
    """Return what the values of a key may be, from zero on."""
    return 0.0, POSSIBLE[key][1]


def _trucks(inputs: Inputs, truck_file: TruckFile, folder: Path) -> tuple[TruckFile, ...]:
    """Return the trucks that are asked for, or else the case's own and those of the catalogue."""
    if inputs.traffic_trucks:
        return tuple(read_truck_file(name, folder) for name in inputs.traffic_trucks)
    others = [read_truck_file(name) for name in truck_names()]
    return (truck_file, *(file for file in others if file.sha256 != truck_file.sha256))
