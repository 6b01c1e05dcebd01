"""Vehicle impact forces of design codes, one function a clause.

Each number carries where it comes from. Only what is cited in the source paper or was read in a
public copy of the code is taken as sure; all else says so wherever it is printed.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.certainty import Certainty
from pierimpact.checks import broadcast, one_of, positive_array

KIP = 4448.2216152605  # pound-force of exactly 0.45359237 kg × 9.80665 m/s², times 1000 [N]
FOOT = 0.3048  # exactly [m]
JCSS_STIFFNESS = 300e3  # of a vehicle, the mean, as read in the JCSS model code [N/m]


class Sourced(NamedTuple):
    """A value in SI units and how certain it is."""

    value: float
    status: Certainty

    @property
    def verified(self) -> bool:
        """Whether the value is cited in the source paper or was read in the code."""
        return self.status.verified

    @property
    def remark(self) -> str:
        """What is printed beside the value."""
        return self.status.standard_words


class CodeForce(NamedTuple):
    """The equivalent static force of a clause; what is not known here is empty or None."""

    code: str  #: name of the code, and the case it is for
    along: Sourced  #: force along the direction of travel [N]
    clause: str = ""  #: clause, table or annex
    across: Sourced | None = None  #: force across the travel [N]
    height: Sourced | None = None  #: of application above the ground or carriageway [m]
    stiffness: Sourced | None = None  #: of the vehicle, that the force is calculated with [N/m]
    edition: str = ""
    note: str = ""  #: what else the clause says, or what the force does not cover

    @property
    def verified(self) -> bool:
        """Whether every number of the clause that is given here is sure."""
        numbers = (self.along, self.across, self.height)
        return all(number.verified for number in numbers if number is not None)


def aashto_lrfd(system: str = "SI") -> CodeForce:
    """AASHTO LRFD Bridge Design Specifications, 3.6.5: 600 kip at 1.5 m, or 5 ft, above ground.

    Parameters
    ----------
    system : {"SI", "US"}, optional
        Units in which the height is round: in SI as the source paper cites it, in US units as in
        the specifications, which is from memory.
    """
    return CodeForce(
        code="AASHTO LRFD",
        clause="3.6.5",
        along=Sourced(600.0 * KIP, Certainty.CITED),
        height=_height(1.5, 5.0, system),
        note="Based on two full-scale tests. Quoted in kip by the source paper; other units are "
        "converted. The height is cited as 1.5 m; 5 ft is from memory. The clause number is from "
        "memory, and that the force acts within 15° of the travel and, in recent editions, at what "
        "is worst of 2 to 5 ft: unverified. Texas (TxDOT’s manual, read): not needed where the "
        "annual frequency of a hit is below 0.001; trigger distance 30 ft.",
    )


def aashto_lrfd_former(system: str = "SI") -> CodeForce:
    """AASHTO LRFD Bridge Design Specifications before the tests: 400 kip at 1.2 m, or 4 ft.

    Argument as in `aashto_lrfd`.
    """
    return CodeForce(
        code="AASHTO LRFD, former value",
        edition="older",
        clause="3.6.5",
        along=Sourced(400.0 * KIP, Certainty.CITED),
        height=_height(1.2, 4.0, system),
        note="In use for nearly 20 years. Quoted in kip; other units are converted. The height is "
        "cited as 1.2 m; 4 ft and the clause number are from memory.",
    )


def _height(metres: float, feet: float, system: str) -> Sourced:
    """Return a height that the source paper cites in metres and the code has in feet."""
    if system == "SI":
        return Sourced(metres, Certainty.CITED)
    return Sourced(feet * FOOT, Certainty.RECALLED)


def jtg_d60() -> CodeForce:
    """JTG D60, General Code for Design of Highway and Culverts (China).

    The source paper cites the forces; the height and what protection does are of the 2015 edition.
    """
    return CodeForce(
        code="JTG D60",
        along=Sourced(1000e3, Certainty.CITED),
        across=Sourced(500e3, Certainty.CITED),
        height=Sourced(1.2, Certainty.SECONDARY),
        note="The two directions are not considered at the same time. Height: edition of 2015, by "
        "which the force acts on the member hit and may be reduced where there is protection, to "
        "no less than 1/6 (second-hand).",
    )


#: Road classes of EN 1991-1-7 Table 4.1, with forces along and across the travel, from memory [N].
ROAD_CLASSES = {
    "motorway": (1000e3, 500e3),
    "country": (750e3, 375e3),
    "urban": (500e3, 250e3),
    "car park, cars": (50e3, 25e3),
    "car park, lorries": (150e3, 75e3),
}


def en_1991_1_7_table(road_class: str = "motorway") -> CodeForce:
    """EN 1991-1-7, Table 4.1: indicative force by road class.

    Parameters
    ----------
    road_class : str, optional
        One of ROAD_CLASSES; motorways stand for national roads too.

    Raises
    ------
    InputError
        When the class is unknown.
    """
    one_of("road_class", road_class, tuple(ROAD_CLASSES))
    along, across = ROAD_CLASSES[road_class]
    return CodeForce(
        code=f"EN 1991-1-7, {road_class}",
        clause="Table 4.1",
        along=Sourced(along, Certainty.RECALLED),
        across=Sourced(across, Certainty.RECALLED),
        note="That the force depends on the road is cited in the source paper; its amount is not.",
    )


def en_1991_1_7_germany() -> CodeForce:
    """German national annex to EN 1991-1-7: 1500 kN on bridges outside built-up areas."""
    return CodeForce(
        code="EN 1991-1-7, Germany",
        clause="nat. annex",
        along=Sourced(1500e3, Certainty.SECONDARY),
        note="On substructures of bridges outside built-up areas.",
    )


def en_1991_1_7_hard_impact(speed: float, mass: float, stiffness: float | None = None) -> CodeForce:
    """EN 1991-1-7, Annex C (informative): hard impact, F = v √(k m).

    Parameters
    ----------
    speed : float
        Speed v at impact [m/s].
    mass : float
        Mass m of the vehicle [kg].
    stiffness : float, optional
        Stiffness k of the vehicle [N/m]; 300 kN/m, which is second-hand, unless given.

    Raises
    ------
    InputError
        When a value is not positive.
    """
    status = Certainty.SECONDARY if stiffness is None else Certainty.READ
    used = Sourced(300e3 if stiffness is None else stiffness, status)
    return CodeForce(
        code="EN 1991-1-7, hard impact",
        clause="Annex C",
        along=Sourced(float(hard_impact(speed, mass, used.value)), status),
        stiffness=used,
        note="Informative, F = v √(k m). The formula was read in a public copy.",
    )


def jcss_hard_impact(speed: float, mass: float) -> CodeForce:
    """JCSS Probabilistic Model Code, Part 2, 2.18: hard impact of a lorry, F = v √(k m).

    It acts on an area of 0.25 × 1.50 m; k is lognormal, 300 ± 60 kN/m.

    Parameters
    ----------
    speed : float
        Speed v at impact [m/s].
    mass : float
        Mass m of the vehicle [kg].

    Raises
    ------
    InputError
        When a value is not positive.
    """
    stiffness = Sourced(JCSS_STIFFNESS, Certainty.READ)
    force = float(hard_impact(speed, mass, stiffness.value))
    return CodeForce(
        code="JCSS, hard impact",
        clause="Part 2, 2.18",
        along=Sourced(force, Certainty.READ),
        height=Sourced(1.25, Certainty.READ),
        stiffness=stiffness,
        note="Probabilistic Model Code: F = v √(k m); by its own account on the safe side. F is "
        "at most the lower of the yield forces of vehicle and structure, and then lasts m v / F. "
        "k is lognormal with a coefficient of variation of 20 %; here its mean.",
    )


def hard_impact(speed: ArrayLike, mass: ArrayLike, stiffness: ArrayLike) -> NDArray[np.float64]:
    """Return the largest force of a spring that stops a mass, F = v √(k m), as they broadcast [N].

    Speed v [m/s], mass m [kg] and stiffness k [N/m], each above zero.
    """
    v, m, k = broadcast(
        {
            "speed": positive_array("speed", speed),
            "mass": positive_array("mass", mass),
            "stiffness": positive_array("stiffness", stiffness),
        }
    )
    return np.asarray(v * np.sqrt(k * m))


def japan() -> CodeForce:
    """Specifications for highway bridges (Japan): 1000 kN along or 500 kN across, at 1.8 m."""
    return CodeForce(
        code="Japan, highway bridges",
        along=Sourced(1000e3, Certainty.SECONDARY),
        across=Sourced(500e3, Certainty.SECONDARY),
        height=Sourced(1.8, Certainty.SECONDARY),
        note="Along or across, where there is no protective wall. From an engineer’s note of 2012.",
    )


def as_5100_2() -> CodeForce:
    """AS 5100.2, an older edition: 2000 kN, ultimate."""
    force = Sourced(2000e3, Certainty.READ)
    return CodeForce("AS 5100.2", force, edition="older", note="An ultimate load.")


def csa_s6_2000() -> CodeForce:
    """CSA S6-2000: 1400 kN at 1.2 m."""
    force, height = Sourced(1400e3, Certainty.SECONDARY), Sourced(1.2, Certainty.SECONDARY)
    return CodeForce("CSA S6", force, height=height, edition="2000")


def code_forces(speed: float, mass: float, system: str = "SI") -> tuple[CodeForce, ...]:
    """Return every clause, for a vehicle of that speed [m/s] and mass [kg] where it matters.

    What a code gives in either system of units is what it gives in `system`, "SI" or "US".
    """
    return (
        aashto_lrfd(system),
        aashto_lrfd_former(system),
        jtg_d60(),
        *(en_1991_1_7_table(road) for road in ("motorway", "country", "urban")),
        en_1991_1_7_germany(),
        en_1991_1_7_hard_impact(speed, mass),
        jcss_hard_impact(speed, mass),
        japan(),
        as_5100_2(),
        csa_s6_2000(),
    )
