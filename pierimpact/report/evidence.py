"""The evidence notebook's blocks: the model beside published tests and calculations.

Of each finding it says what was read, how certain it is, and what the model gives; or why nothing
can be compared.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np

from pierimpact.certainty import Certainty
from pierimpact.collision.averages import largest_average_force
from pierimpact.collision.history import CollisionHistory
from pierimpact.collision.parameters import Collision
from pierimpact.collision.simulate import peak_reactions, simulate
from pierimpact.design.codes import KIP, Sourced, aashto_lrfd
from pierimpact.design.comparison import (
    RIGID,
    Compared,
    Measured,
    average_bands,
    compare,
    response_words,
)
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.plots import evidence as figures
from pierimpact.report.document.blocks import Block, Notes
from pierimpact.report.document.markup import Inline
from pierimpact.report.document.numbered import Figure, Table, columns, decimal, wide
from pierimpact.resources import shipped
from pierimpact.units import printed, rounded
from pierimpact.vehicle.truck import Truck

#: Published forces of tests and calculations, as a file of responses.
PUBLISHED: Path = shipped("notebooks") / "published.csv"
#: Windows of the averages that are drawn [s]; 50 ms is this project's choice.
WINDOWS = (0.010, 0.025, 0.050)
_MPH = 1609.344 / 3600.0  # exactly [m/s]
_TESTS = 50.0 * _MPH  # speed of the full-scale tests, from memory [m/s]
# Their averages over the first two windows: more than, and just over, as in NCHRP Report 892 [N].
_AVERAGES = Sourced(900.0 * KIP, Certainty.READ), Sourced(600.0 * KIP, Certainty.READ)
_SPEED = 80.0 / 3.6  # at which trends are shown, this project's choice [m/s]
_SPEEDS = np.arange(30.0, 131.0, 2.5) / 3.6  # this project's choice [m/s]
_LIGHT = 6e3  # mass before its cargo doubles, this project's choice [kg]
_RANGE = (55.0 / 3.6, 135.0 / 3.6)  # as read in El-Tawil et al. 2005 [m/s]


class Finding(NamedTuple):
    """What was published without a force, and what the model does or why nothing is compared."""

    words: str
    source: str
    answer: str
    status: Certainty = Certainty.READ


@dataclass(frozen=True)
class Comparison:
    """Forces of others beside those of the model.

    Parameters
    ----------
    measured : sequence of Measured
        The cases, as `pierimpact.files.responses.read_responses` returns them.
    histories : int, optional
        Number of collisions behind the band of a contact force.
    label : str, optional
        Beginning of the anchors of table and figure.
    """

    measured: Sequence[Measured]
    histories: int = 64
    label: str = "compared"

    @cached_property
    def compared(self) -> list[Compared]:
        """Every response beside that of the model."""
        return [one for own in self.measured for one in compare(own, histories=self.histories)]

    def table(self) -> Block:
        """Return every response with that of the model, its band and their ratio."""
        rows: list[list[Inline]] = []
        shown: Measured | None = None
        for own in self.compared:
            case = own.measured
            forces = own.value, own.nominal, own.band[0], own.band[2]
            rows.append(
                [
                    case.name,
                    _short(own.response),
                    *map(_force, forces),
                    f"{own.ratio:.2f}" if np.isfinite(own.ratio) else "–",
                    _source(case.source, case.status) if case is not shown else "",
                ]
            )
            shown = case
        return Table(
            label=f"tab-{self.label}",
            caption="Published forces and those of the model [kN], with what 5 and 95 % of the "
            "trucks of its spread stay below. Averages are the largest moving averages of the "
            "contact force.",
            columns=columns(
                wide("Case"),
                "Force",
                *map(decimal, ("Published", "Model", "5 %", "95 %", "Ratio")),
                wide("Source"),
            ),
            rows=rows,
        )

    def remarks(self) -> Block:
        """Return what else to know of the cases."""
        return Notes([f"{own.name}: {own.remark}" for own in self.measured if own.remark])

    def figure(self) -> Block:
        """Return model over measured with its band, a row for each response."""
        names = [f"{own.measured.name}: {_short(own.response)}" for own in self.compared]
        ratios = np.array([[own.ratio, *own.ratios] for own in self.compared])
        finite = ratios[np.isfinite(ratios[:, 0]), 0]
        span = f"from {finite.min():.2f} to {finite.max():.2f}" if len(finite) else "nowhere"
        return Figure(
            label=f"fig-{self.label}",
            caption="The model over what was published. Dots: parameters at their values; bars: "
            "5 to 95 % of the trucks of their spread, with the median.",
            alt=f"A bar for each of {len(names)} forces; model over published is {span}.",
            svg=figures.draw_agreement(names, ratios),
        )


def double_cargo(truck: Truck, light: float = _LIGHT) -> Block:
    """Return force and impulse of a truck of total mass `light` [kg], and with m2 doubled."""
    one, other = _double_cargo(truck, light)
    names = (f"{own.truck.mass / 1e3:.3g} t" for own in (one, other))
    engine, impulse = _growth(one, other)
    return Figure(
        label="fig-cargo",
        caption=f"Contact force and impulse of {truck.name} at {3.6 * _SPEED:g} km/h on a rigid "
        f"pier, with the mass behind the engine doubled: the engine’s peak is {engine:.2f} times "
        f"as large, the impulse {impulse:.2f} times.",
        alt="Two lines of contact force that agree up to the cargo’s contact; the impulse of the "
        "heavier truck ends higher.",
        svg=figures.draw_cargo(dict(zip(names, (one, other), strict=True)), "SI"),
    )


def first_peak(truck: Truck, masses: Sequence[float]) -> Block:
    """Return the engine's peak on a rigid pier against speed, for total masses [kg]."""
    speeds = _SPEEDS
    # A quicker pier, so that no ringing is seen.
    pier = EquivalentPier.from_frequency(RIGID.mass, 10.0 * RIGID.frequency)
    trucks = [truck.loaded_to(mass) for mass in masses]
    peaks = {
        f"{own.mass / 1e3:.3g} t": peak_reactions(
            own, pier.mass, pier.stiffness, pier.damping_ratio, speeds
        ).engine
        for own in trucks
    }
    spread = np.ptp(list(peaks.values()), axis=0).max() / max(map(np.max, peaks.values()))
    return Figure(
        label="fig-first-peak",
        caption=f"First peak of {truck.name} on a rigid pier against speed, for total masses of "
        f"{', '.join(peaks)}.",
        alt=f"Lines that rise with the speed and lie on each other, within {100 * spread:.1f} % of "
        "the largest.",
        svg=figures.draw_first_peak(speeds, peaks, "SI"),
    )


def averages(truck: Truck, count: int = 32) -> Block:
    """Return averages of the contact force on a rigid pier against speed.

    Parameters
    ----------
    truck : Truck
        The truck.
    count : int, optional
        Number of collisions behind the band, at each speed.
    """
    speeds = _SPEEDS[4::4]
    found = [average_bands(Collision(truck, RIGID, speed), WINDOWS, count) for speed in speeds]
    limit = aashto_lrfd().along.value
    nominal = np.array([values for values, _ in found])
    band = np.array([ends[[0, 2], 1] for _, ends in found])
    crossing = 3.6 * float(np.interp(limit, nominal[:, 1], speeds))
    marks = [
        figures.Mark(_TESTS, force.value, f"tests, {1e3 * window:g} ms")
        for window, force in zip(WINDOWS, _AVERAGES, strict=False)
    ]
    return Figure(
        label="fig-averages",
        caption=f"Largest averages of the contact force of {truck.name} on a rigid pier against "
        "speed; dots: the published averages, to which the truck was fitted.",
        alt=f"Three curves that rise with the speed; the 25 ms average passes 600 kip at "
        f"{crossing:.0f} km/h.",
        svg=figures.draw_averages(speeds, WINDOWS, nominal, band, limit, marks, "SI"),
    )


def statements(single_unit: Truck, tractor_trailer: Truck) -> Block:
    """Return findings that name no force, and what the model does."""
    engine, impulse = _growth(*_double_cargo(single_unit, _LIGHT))
    laden = simulate(tractor_trailer, RIGID, _TESTS)
    assert laden.engine_contact_time is not None
    assert laden.cargo_contact_time is not None
    order = f"{1e3 * laden.engine_contact_time:.0f} ms and {1e3 * laden.cargo_contact_time:.0f} ms"
    ends = [
        " and ".join(
            rounded(_average(truck, speed) / aashto_lrfd().along.value, 2) for speed in _RANGE
        )
        for truck in (single_unit, tractor_trailer)
    ]
    found = [
        Finding(
            "The peak force is governed by the engine’s mass and the speed, the impulse by the "
            "total momentum",
            "Do, Pham & Hao 2018",
            "The same for the first peak: with the mass behind the engine doubled it is "
            f"{engine:.2f} times as large and the impulse {impulse:.2f} times. The cargo’s later "
            "peak, which grows with that mass, may be the larger.",
        ),
        Finding(
            "The first peak, that of the engine on the rigid pole, does not depend on the total "
            "mass",
            "NCHRP Report 892",
            "The same, but no evidence for the model: that engine and body are not joined is "
            "built in.",
        ),
        Finding(
            "Peaks in the order engine, cab, trailer front",
            "NCHRP Report 892",
            f"Engine and trailer front in this order, in contact after {order} at 50 mph, by "
            "assumed lengths. The model has no cab.",
        ),
        Finding(
            "Two or three peaks of a tractor-trailer",
            "International Journal of Protective Structures 2018, abstract",
            "Two, one for each mass. The model cannot have a third.",
        ),
        Finding(
            "Two trucks on two pier systems at 55 to 135 km/h: code provisions may be "
            "unconservative",
            "El-Tawil et al. 2005",
            "Largest 25 ms average over 600 kip, on a rigid pier at 55 and at 135 km/h: "
            f"{ends[0]} for the 8 t truck, {ends[1]} for the tractor-trailer.",
        ),
    ]
    caption = "Findings without a force, and what the model does."
    return _findings("tab-statements", caption, "Model", found)


def not_compared() -> Block:
    """Return findings with which nothing is compared, and why."""
    caption = "Findings with which nothing is compared."
    return _findings("tab-not-compared", caption, "Why not", _NOT_COMPARED)


_NOT_COMPARED = (
    Finding(
        "The model of two masses was calibrated to finite elements; results depend on the truck’s "
        "weight, its speed and the pier",
        "Chen, El-Tawil & Xiao 2016",
        "Its numbers were found in no public copy.",
    ),
    Finding(
        "600 kip is not conservative above 16 t",
        "Abdelkarim & ElGawady 2016, abstract",
        "The abstract does not say at which speed, nor which force is compared with 600 kip.",
    ),
    Finding(
        "Trucks of 3 to 50 t at 40 to 120 km/h, 54 simulations: what governs is the peak dynamic "
        "base shear",
        "Li, Wu, Fang & Wang 2021, abstract",
        "The abstract gives no forces.",
    ),
    Finding(
        "Supporting documentation for the 400 kip “was not extensive”",
        "TTI 9-4973-1",
        "It gives no force of a test.",
    ),
    Finding(
        "The finite-element model of a tractor-semitrailer has not been assessed for full frontal "
        "impact with a bridge pier",
        "makers of that model",
        "It gives no force; it is a caution about comparisons with such calculations.",
    ),
    Finding(
        "Tractor of 6,660 kg with a wheelbase of 5.46 m; tractor-semitrailers of 22.7 and 36.2 t "
        "on barriers at 83 to 85 km/h",
        "barrier tests and the models of their trucks",
        "Masses and lengths only. A barrier deflects the truck, a pier stops it.",
    ),
    Finding(
        "Vehicle classes M 6,800 kg, C7 7,200 kg and H 29,500 kg",
        "ASTM F2656",
        "Masses only; no forces were read.",
    ),
    Finding(
        "A sign gantry struck: inertia adds 90 %, strain rate 50 % to the static result",
        "a German university",
        "Another structure. The model has the inertia of the pier but no strain rate.",
    ),
)


def _findings(label: str, caption: str, heading: str, found: Sequence[Finding]) -> Table:
    return Table(
        label=label,
        caption=caption,
        columns=columns(wide("Finding"), wide("Source"), wide(heading)),
        rows=[[own.words, _source(own.source, own.status), own.answer] for own in found],
    )


def _double_cargo(truck: Truck, light: float) -> tuple[CollisionHistory, CollisionHistory]:
    """Return the collisions of a truck of a total mass [kg], and with its m2 doubled."""
    heavy = 2.0 * light - truck.engine_mass
    one, other = (simulate(truck.loaded_to(mass), RIGID, _SPEED) for mass in (light, heavy))
    return one, other


def _growth(one: CollisionHistory, other: CollisionHistory) -> tuple[float, float]:
    """Return the ratios of the engine's peaks and of the largest impulses."""
    impulse = other.impulse.max() / one.impulse.max()
    return other.engine_peak.reaction / one.engine_peak.reaction, float(impulse)


def _average(truck: Truck, speed: float) -> float:
    return largest_average_force(simulate(truck, RIGID, speed, WINDOWS[1]), WINDOWS[1]).force


def _source(source: str, status: Certainty) -> str:
    return f"{source}; {status.words}"


def _short(response: str) -> str:
    return response_words(response).removesuffix(" of the contact force")


def _force(force: float) -> str:
    return printed(force, "force", "SI").number if np.isfinite(force) else "–"
