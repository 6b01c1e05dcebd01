import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pierimpact import InputError
from pierimpact.certainty import Certainty
from pierimpact.design.codes import (
    ROAD_CLASSES,
    aashto_lrfd,
    aashto_lrfd_former,
    code_forces,
    en_1991_1_7_hard_impact,
    en_1991_1_7_table,
)

some = st.floats(1e-3, 1e6)


def test_aashto_force_is_600_kip():
    pound_force = 0.45359237 * 9.80665
    assert aashto_lrfd().along.value == pytest.approx(600_000 * pound_force, rel=1e-12)
    # The source paper rounds both values: "about 2700 kN" and "about 1800 kN".
    assert round(aashto_lrfd().along.value, -5) == 2700e3
    assert round(aashto_lrfd_former().along.value, -5) == 1800e3


@pytest.mark.parametrize(
    ("mass", "speed", "printed"), [(30e3, 90, 2400e3), (30e3, 50, 1300e3), (1.5e3, 20, 120e3)]
)
def test_hard_impact_gives_the_rounded_examples(mass, speed, printed):
    force = en_1991_1_7_hard_impact(speed / 3.6, mass).along.value
    digits = 2 - len(str(int(force)))  # the examples have two significant figures
    assert round(force, digits) == printed


@given(some, some, some)
def test_hard_impact_stops_the_mass_on_a_spring(speed, mass, stiffness):
    force = en_1991_1_7_hard_impact(speed, mass, stiffness).along.value
    assert 0.5 * force**2 / stiffness == pytest.approx(0.5 * mass * speed**2, rel=1e-12)


# Force along and across the travel [kN], height [m], and how sure each is.
CLAUSES = {
    "AASHTO LRFD": ((2668.933, Certainty.CITED), None, (1.5, Certainty.CITED)),
    "AASHTO LRFD, former value": ((1779.289, Certainty.CITED), None, (1.2, Certainty.CITED)),
    "JTG D60": ((1000, Certainty.CITED), (500, Certainty.CITED), (1.2, Certainty.SECONDARY)),
    "EN 1991-1-7, motorway": ((1000, Certainty.RECALLED), (500, Certainty.RECALLED), None),
    "EN 1991-1-7, country": ((750, Certainty.RECALLED), (375, Certainty.RECALLED), None),
    "EN 1991-1-7, urban": ((500, Certainty.RECALLED), (250, Certainty.RECALLED), None),
    "EN 1991-1-7, car park, cars": ((50, Certainty.RECALLED), (25, Certainty.RECALLED), None),
    "EN 1991-1-7, car park, lorries": ((150, Certainty.RECALLED), (75, Certainty.RECALLED), None),
    # 20 m/s, 8 t and the 300 kN/m that are second-hand: 20 √(300e3 × 8e3) N.
    "EN 1991-1-7, hard impact": ((979.7959, Certainty.SECONDARY), None, None),
    "AS 5100.2": ((2000, Certainty.READ), None, None),
    "CSA S6": ((1400, Certainty.SECONDARY), None, (1.2, Certainty.SECONDARY)),
}


def test_every_clause_has_the_amounts_typed_here():
    codes = {code.code: code for code in code_forces(20.0, 8e3)}
    assert {name for name in CLAUSES if "car park" not in name} == set(codes)
    tables = [en_1991_1_7_table(road) for road in ROAD_CLASSES]
    codes |= {table.code: table for table in tables}
    assert codes.keys() == CLAUSES.keys()
    for name, expected in CLAUSES.items():
        code = codes[name]
        numbers = zip((code.along, code.across, code.height), expected, (1e3, 1e3, 1), strict=True)
        for number, typed, unit in numbers:
            assert (number is None) == (typed is None), name
            if typed is not None:
                assert number.value == pytest.approx(typed[0] * unit, rel=1e-6), name
                assert number.status == typed[1], name


def test_what_is_not_sure_says_so():
    codes = code_forces(20.0, 8e3)
    assert {code.along.status for code in codes} <= set(Certainty)
    for code in codes:
        for number in (code.along, code.across, code.height):
            if number is not None:
                assert number.verified != ("unverified" in number.remark)
    unsure = {code.code for code in codes if not code.verified}
    assert unsure == {
        "JTG D60",
        "EN 1991-1-7, motorway",
        "EN 1991-1-7, country",
        "EN 1991-1-7, urban",
        "EN 1991-1-7, hard impact",
        "CSA S6",
    }


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.0, 8e3), "speed must be positive, got 0"),
        ((20.0, -1.0), "mass must be positive, got -1"),
        ((20.0, 8e3, math.inf), "stiffness must be finite, got inf"),
    ],
)
def test_hard_impact_refuses(arguments, message):
    with pytest.raises(InputError, match=message):
        en_1991_1_7_hard_impact(*arguments)


def test_unknown_road_class_is_refused():
    with pytest.raises(InputError, match=r"road_class must be one of motorway, .* got 'lane'"):
        en_1991_1_7_table("lane")
