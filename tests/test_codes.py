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
    jcss_hard_impact,
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


@given(some, some)
def test_the_hard_impact_of_the_model_code_is_that_at_its_mean_stiffness(speed, mass):
    force = jcss_hard_impact(speed, mass).along.value
    assert force == pytest.approx(en_1991_1_7_hard_impact(speed, mass, 300e3).along.value, 1e-12)


@given(some, some, some)
def test_hard_impact_stops_the_mass_on_a_spring(speed, mass, stiffness):
    force = en_1991_1_7_hard_impact(speed, mass, stiffness).along.value
    assert 0.5 * force**2 / stiffness == pytest.approx(0.5 * mass * speed**2, rel=1e-12)


CITED, READ = Certainty.CITED, Certainty.READ
SECONDARY, RECALLED = Certainty.SECONDARY, Certainty.RECALLED
SURE = {CITED: "cited in the source paper", READ: "read in a public copy"}

# Force along and across the travel [kN], height [m] and stiffness [kN/m], and how sure each is.
CLAUSES = {
    "AASHTO LRFD": ((2668.933, CITED), None, (1.5, CITED), None),
    "AASHTO LRFD, former value": ((1779.289, CITED), None, (1.2, CITED), None),
    "JTG D60": ((1000, CITED), (500, CITED), (1.2, SECONDARY), None),
    "EN 1991-1-7, motorway": ((1000, RECALLED), (500, RECALLED), None, None),
    "EN 1991-1-7, country": ((750, RECALLED), (375, RECALLED), None, None),
    "EN 1991-1-7, urban": ((500, RECALLED), (250, RECALLED), None, None),
    "EN 1991-1-7, car park, cars": ((50, RECALLED), (25, RECALLED), None, None),
    "EN 1991-1-7, car park, lorries": ((150, RECALLED), (75, RECALLED), None, None),
    "EN 1991-1-7, Germany": ((1500, SECONDARY), None, None, None),
    # 20 m/s and 8 t: 20 √(300e3 × 8e3) N.
    "EN 1991-1-7, hard impact": ((979.7959, SECONDARY), None, None, (300, SECONDARY)),
    "JCSS, hard impact": ((979.7959, READ), None, (1.25, READ), (300, READ)),
    "Japan, highway bridges": ((1000, SECONDARY), (500, SECONDARY), (1.8, SECONDARY), None),
    "AS 5100.2": ((2000, READ), None, None, None),
    "CSA S6": ((1400, SECONDARY), None, (1.2, SECONDARY), None),
}
# What the notes say of amounts, and of how sure those are that the table does not have.
NOTED = {
    "AASHTO LRFD": ("(TxDOT’s manual, read)", "below 0.001;", "30 ft", "worst of 2 to 5 ft: unver"),
    "JTG D60": ("edition of 2015", "no less than 1/6 (second-hand)"),
    "JCSS, hard impact": ("variation of 20 %", "m v / F"),  # 300 ± 60 kN/m
}


def test_every_clause_has_what_is_typed_here():
    codes = {code.code: code for code in code_forces(20.0, 8e3)}
    assert {name for name in CLAUSES if "car park" not in name} == set(codes)
    tables = [en_1991_1_7_table(road) for road in ROAD_CLASSES]
    codes |= {table.code: table for table in tables}
    assert codes.keys() == CLAUSES.keys()
    for name, expected in CLAUSES.items():
        code = codes[name]
        found = code.along, code.across, code.height, code.stiffness
        for number, typed, unit in zip(found, expected, (1e3, 1e3, 1, 1e3), strict=True):
            assert (number is None) == (typed is None), name
            if number is not None:
                assert number.value == pytest.approx(typed[0] * unit, rel=1e-6), name
                assert number.status is typed[1], name
                words = SURE.get(typed[1], "unverified: check against the standard")
                assert number.remark == words, name
        assert code.verified == all(typed[1] in SURE for typed in expected if typed), name
        assert all(words in code.note for words in NOTED.get(name, ())), name


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
