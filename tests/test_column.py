import dataclasses
import math
from itertools import pairwise

import numpy as np
import pytest
import stiffness_method
from generated_columns import (
    GENERATED,
    STABLE,
    arranged_columns,
    joints,
    round_column,
    struck_columns,
)
from hypothesis import given
from hypothesis import strategies as st

from pierimpact import (
    CircularSection,
    EquivalentPier,
    InputError,
    PierColumn,
    RectangularSection,
    Step,
)
from pierimpact.pier.unit_force import BY_ENDS

# Stiffness and mass are of interest here, for columns of all kinds.
pytestmark = pytest.mark.filterwarnings("ignore::pierimpact.StaticForcesWarning")

EXAMPLE = {
    "height": 5.0,
    "section": CircularSection(diameter=0.914),
    "elastic_modulus": 25e9,
    "density": 2400.0,
}
# So slender that shear is below round-off: Euler and Bernoulli's beam.
SLENDER = EXAMPLE | {"section": CircularSection(diameter=5e-6)}
inside = st.floats(0.0, 1.0)


def flexural(struck):
    """Return the flexural part of the deflection at the impact."""
    return struck.values["xfb"] + struck.values["xft"]


def column(base, top, **changes):
    return PierColumn(**(EXAMPLE | {"base": base, "top": top} | changes))


# Independent computation


@GENERATED
@given(struck_columns(), st.lists(inside, max_size=3))
def test_deflection_agrees_with_the_stiffness_method(case, fractions):
    column, impact_height = case
    others = [fraction * column.height for fraction in fractions]
    heights = np.unique([0.0, *others, impact_height, column.height])
    exact, _, _, _ = stiffness_method.solve(column, heights, impact_height)
    exact = [float(deflection) for deflection in exact]
    deflection = column.struck_at(impact_height).deflection(heights)
    np.testing.assert_allclose(deflection, exact, rtol=1e-9, atol=1e-100)
    at_impact = exact[list(heights).index(impact_height)]
    assert 1.0 / column.equivalent(impact_height).stiffness == pytest.approx(at_impact, rel=1e-12)


@GENERATED
@given(st.one_of(struck_columns(), arranged_columns()))
def test_equivalent_mass_agrees_with_the_stiffness_method(case):
    column, impact_height = case
    nodes, weights = np.polynomial.legendre.leggauss(5)
    ends = joints(column, impact_height)
    parts = list(pairwise(ends))
    points = [start + (end - start) * (1.0 + nodes) / 2.0 for start, end in parts]
    heights = np.unique(np.concatenate([ends, *points]))
    exact, _, _, _ = stiffness_method.solve(column, heights, impact_height)
    deflection = dict(zip(heights, np.array(exact, dtype=float), strict=True))
    mass = column.top_mass * (deflection[column.height] / deflection[impact_height]) ** 2
    for (start, end), z in zip(parts, points, strict=True):
        shape = np.array([deflection[height] for height in z]) / deflection[impact_height]
        section = column.section
        for step in column.steps:
            section = step.section if step.height <= start else section
        mass += column.density * section.area * (end - start) / 2.0 * (weights @ shape**2)
    assert column.equivalent(impact_height).mass == pytest.approx(mass, rel=1e-9)


@GENERATED
@given(arranged_columns())
def test_any_arrangement_agrees_with_the_stiffness_method(case):
    column, impact_height = case
    heights = joints(column, impact_height)
    exact, _, forces, moments = stiffness_method.solve(column, heights, impact_height)
    exact = np.array(exact, dtype=float)
    struck = column.struck_at(impact_height)
    largest = np.abs(exact).max()
    # Round-off grows with what tells the stiffest part from the softest.
    rigidities = [part.flexural_rigidity for part in column.arrangement.parts]
    near = max(1e-10, 2.0 * np.finfo(float).eps * max(rigidities) / min(rigidities))
    np.testing.assert_allclose(struck.deflection(heights), exact, rtol=0.0, atol=near * largest)
    assert 1.0 / struck.stiffness == pytest.approx(exact[heights.index(impact_height)], rel=near)
    found = struck.member_forces(1.0)
    size = column.height + column.embedment
    # A support moment in the sense of dx/dz puts the far face in tension at the base, and the
    # near face at the top.
    for ours, expected, unit in (
        (found.base_force, -forces[0], 1.0),
        (found.top_force, -forces[1], 1.0),
        (found.base_moment, moments[0], size),
        (found.top_moment, -moments[1], size),
    ):
        assert ours == pytest.approx(float(expected), rel=0.0, abs=near * unit)


@GENERATED
@given(struck_columns())
def test_uniform_columns_agree_with_the_closed_forms(case):
    column, z = case
    rigidity = {name: column.values[name] for name in ("H", "EI", "GA")}
    closed = BY_ENDS[column.base, column.top](z=z, y=column.height - z, **rigidity)
    found = column.struck_at(z).unit_force
    for name, value in (
        ("Rb", found.base_force),
        ("Rt", found.top_force),
        ("Mb", found.base_moment),
        ("Mt", found.top_moment),
        ("xn", found.deflection),
    ):
        rounding = 1e-15 if name[0] == "R" else 1e-300  # a reaction is what the other leaves of one
        assert value == pytest.approx(closed[name], rel=1e-12, abs=rounding)
    mass = column.mass_per_length * (closed["phi2b"] + closed["phi2t"])
    assert found.mass == pytest.approx(mass, rel=1e-9)


@GENERATED
@given(struck_columns())
def test_shear_part_is_what_a_softer_shear_area_adds(case):
    # By Castigliano's theorem dx/d(1/κGA) is the integral of V², with forces left as they are.
    column, impact_height = case
    step = 1e-4
    coefficient = column.section.shear_coefficient * 0.99

    def struck(factor):
        section = dataclasses.replace(column.section, shear_coefficient=coefficient * factor)
        return dataclasses.replace(column, section=section).struck_at(impact_height)

    here = struck(1.0)
    softer, stiffer = (struck(1.0 / (1.0 + change)).values["xn"] for change in (step, -step))
    assert here.values["xs"] == pytest.approx(
        (softer - stiffer) / (2.0 * step), rel=1e-6, abs=1e-10 * here.values["xn"]
    )


# Closed forms


@pytest.mark.parametrize("impact_height", [0.5, 1.2, 5.0])
def test_cantilever(impact_height):
    cantilever = column("fixed", "free")
    bending = 25e9 * math.pi * 0.914**4 / 64.0
    shearing = 25e9 / 2.4 * 0.9 * math.pi * 0.914**2 / 4.0
    assert cantilever.flexural_rigidity == pytest.approx(bending, rel=1e-14)
    assert cantilever.shear_rigidity == pytest.approx(shearing, rel=1e-14)
    struck = cantilever.struck_at(impact_height)
    assert flexural(struck) == pytest.approx(impact_height**3 / (3.0 * bending), rel=1e-13)
    assert struck.values["xs"] == pytest.approx(impact_height / shearing, rel=1e-13)
    z = np.linspace(0.0, 5.0, 41)
    below = z**2 * (3.0 * impact_height - z) / (6.0 * bending) + z / shearing
    tangent = impact_height**2 / (2.0 * bending)
    above = 1.0 / struck.stiffness + tangent * (z - impact_height)
    expected = np.where(z <= impact_height, below, above)
    np.testing.assert_allclose(
        cantilever.struck_at(impact_height).deflection(z), expected, rtol=1e-12
    )


@pytest.mark.parametrize("impact_height", [0.01, 1.2, 2.5, 4.9])
def test_simple_beam(impact_height):
    beam = column("pinned", "pinned")
    a, b = impact_height, 5.0 - impact_height
    struck = beam.struck_at(impact_height)
    flexure = a**2 * b**2 / (3.0 * 5.0 * beam.flexural_rigidity)
    assert flexural(struck) == pytest.approx(flexure, rel=1e-12)
    assert struck.values["xs"] == pytest.approx(a * b / (5.0 * beam.shear_rigidity), rel=1e-12)


def test_fixed_ends_struck_in_the_middle():
    struck = column("fixed", "fixed").struck_at(2.5)
    flexure = 5.0**3 / (192.0 * struck.column.flexural_rigidity)
    assert flexural(struck) == pytest.approx(flexure, rel=1e-12)
    assert struck.values["xs"] == pytest.approx(
        5.0 / (4.0 * struck.column.shear_rigidity), rel=1e-12
    )


@pytest.mark.parametrize("impact_height", [0.5, 1.2, 2.5, 4.5])
def test_slender_columns_meet_the_textbook(impact_height):
    a, b, length = impact_height, 5.0 - impact_height, 5.0
    textbook = {
        ("fixed", "pinned"): a**3 * b**2 * (3.0 * a + 4.0 * b) / (12.0 * length**3),
        ("pinned", "fixed"): b**3 * a**2 * (3.0 * b + 4.0 * a) / (12.0 * length**3),
        ("fixed", "fixed"): a**3 * b**3 / (3.0 * length**3),
        ("pinned", "pinned"): a**2 * b**2 / (3.0 * length),
        ("fixed", "free"): a**3 / 3.0,
        ("free", "fixed"): b**3 / 3.0,
    }
    assert set(textbook) == set(STABLE)
    for (base, top), value in textbook.items():
        struck = column(base, top, **SLENDER).struck_at(impact_height)
        deflection = struck.values["xn"] * struck.column.flexural_rigidity
        assert deflection == pytest.approx(value, rel=1e-10), (base, top)


@pytest.mark.parametrize(
    ("base", "top", "impact_height", "fraction"),
    [
        ("fixed", "free", 5.0, 33.0 / 140.0),
        ("free", "fixed", 0.0, 33.0 / 140.0),
        ("pinned", "pinned", 2.5, 17.0 / 35.0),
        ("fixed", "fixed", 2.5, 13.0 / 35.0),
    ],
)
def test_mass_of_slender_columns_meets_the_textbook(base, top, impact_height, fraction):
    slender = column(base, top, **SLENDER)
    mass = slender.density * slender.section.area * 5.0
    assert slender.mass_per_length * 5.0 == mass
    assert slender.equivalent(impact_height).mass == pytest.approx(fraction * mass, rel=1e-10)


@pytest.mark.parametrize(("base", "top"), STABLE)
def test_squat_columns_deflect_in_straight_lines(base, top):
    # All shear: each supported part is a shear spring, and what lies beyond is carried along.
    squat = column(base, top, section=CircularSection(diameter=5e5))
    supported = [length for end, length in [(base, 2.0), (top, 3.0)] if end != "free"]
    springs = sum(squat.shear_rigidity / length for length in supported)
    assert squat.equivalent(2.0).stiffness == pytest.approx(springs, rel=1e-8)
    z = np.array([0.0, 0.5, 1.0, 2.0, 3.5, 4.5, 5.0])
    below = np.ones(7) if base == "free" else z / 2.0
    above = np.ones(7) if top == "free" else (5.0 - z) / 3.0
    lines = np.where(z <= 2.0, below, above)
    np.testing.assert_allclose(squat.struck_at(2.0).shape(z), lines, rtol=1e-8)
    shape_integral = sum(supported) / 3.0 + (5.0 - sum(supported))
    assert squat.struck_at(2.0).values["phi2"] == pytest.approx(shape_integral, rel=1e-8)


# Invariants


@GENERATED
@given(struck_columns(), inside)
def test_reciprocity(case, fraction):
    column, here = case
    there = (0.001 + 0.998 * fraction) * column.height
    np.testing.assert_allclose(
        column.struck_at(here).deflection(there),
        column.struck_at(there).deflection(here),
        rtol=1e-10,
    )


@GENERATED
@given(struck_columns(), st.lists(inside, min_size=1, max_size=4))
def test_mirrored_column_deflects_in_mirror_image(case, fractions):
    column, impact_height = case
    mirrored = dataclasses.replace(column, base=column.top, top=column.base)
    z = np.array(fractions) * column.height
    shape = column.struck_at(impact_height).shape(z)
    image = mirrored.struck_at(column.height - impact_height).shape(column.height - z)
    np.testing.assert_allclose(shape, image, rtol=1e-9, atol=1e-12)
    here = column.equivalent(impact_height)
    there = mirrored.equivalent(column.height - impact_height)
    assert here.mass == pytest.approx(there.mass, rel=1e-9)
    assert here.stiffness == pytest.approx(there.stiffness, rel=1e-9)


@GENERATED
@given(struck_columns())
def test_energy_of_the_unit_force_gives_the_deflected_shape(case):
    # x(z_n) comes from the energies of flexure and shear, φ from the deflection line: both agree.
    column, impact_height = case
    assert column.struck_at(impact_height).shape(impact_height) == pytest.approx(1.0, rel=1e-11)
    just_above = np.nextafter(impact_height, column.height)
    assert column.struck_at(impact_height).shape(just_above) == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize(("base", "top"), STABLE)
def test_end_conditions_hold(base, top):
    struck = column(base, top).struck_at(1.7)
    ends = dict(zip((base, top), struck.shape([0.0, 5.0]), strict=True))
    for condition, deflection in ends.items():
        assert (deflection == 0.0) == (condition != "free")


def test_stiffer_ends_give_a_stiffer_pier():
    stiffness = [
        column(base, top).equivalent(1.2).stiffness
        for base, top in [("fixed", "free"), ("fixed", "pinned"), ("fixed", "fixed")]
    ]
    assert stiffness == sorted(stiffness)
    assert len(set(stiffness)) == 3


def test_depth_of_a_rectangle_lies_in_the_direction_of_travel():
    along, across = (
        column("fixed", "free", section=RectangularSection(width=width, depth=depth))
        for width, depth in [(0.5, 2.0), (2.0, 0.5)]
    )
    ratio = flexural(along.struck_at(5.0)) / flexural(across.struck_at(5.0))
    assert ratio == pytest.approx(1.0 / 16.0, rel=1e-13)


# Interface


def test_equivalent_pier():
    struck = column("fixed", "pinned").struck_at(1.2)
    pier = column("fixed", "pinned").equivalent(1.2, damping_ratio=0.03)
    assert pier == EquivalentPier(mass=struck.mass, stiffness=struck.stiffness, damping_ratio=0.03)
    assert column("fixed", "pinned").equivalent(impact_height=1.2).damping_ratio == 0.05


def test_deflection_follows_the_shape_of_z_and_the_force():
    pier = column("fixed", "pinned")
    z = np.linspace(0.0, 5.0, 6).reshape(2, 3)
    assert pier.struck_at(1.2).deflection(z).shape == pier.struck_at(1.2).shape(z).shape == (2, 3)
    assert pier.struck_at(1.2).deflection(1.2).shape == ()
    np.testing.assert_allclose(
        pier.struck_at(1.2).deflection(z, force=-3e6),
        -3e6 * pier.struck_at(1.2).deflection(z),
        rtol=1e-14,
    )


@GENERATED
@given(struck_columns(), st.floats(0.05, 1.0))
def test_cracks_divide_flexure_and_nothing_else(case, factor):
    gross, impact_height = case
    cracked = dataclasses.replace(gross, stiffness_factor=factor)
    stiffness = factor * gross.flexural_rigidity
    given = dataclasses.replace(gross, effective_stiffness=stiffness)
    for column in (cracked, given):
        assert column.flexural_rigidity == pytest.approx(stiffness, rel=1e-12)
        assert column.shear_rigidity == gross.shear_rigidity
        assert column.mass_per_length == gross.mass_per_length

    def with_shear(column, kappa):
        section = dataclasses.replace(column.section, shear_coefficient=kappa)
        return dataclasses.replace(column, section=section)

    # A softer material has less stiffness in shear too, which its κ makes good.
    softer = dataclasses.replace(gross, elastic_modulus=factor * gross.elastic_modulus)
    one = with_shear(softer, factor).equivalent(impact_height)
    other = with_shear(cracked, factor**2).equivalent(impact_height)
    assert one.stiffness == pytest.approx(other.stiffness, rel=1e-9)
    assert one.mass == pytest.approx(other.mass, rel=1e-9)


@pytest.mark.parametrize(
    ("base", "top", "springs", "free"),
    [
        ("pinned", "free", {}, "to rotate about its base"),
        ("free", "pinned", {}, "to rotate about its top"),
        ("free", "free", {}, "to move sideways and to rotate"),
        ("free", "free", {"base_rotation_stiffness": 1e9}, "to move sideways"),
        ("free", "free", {"top_stiffness": 1e9}, "to rotate about its top"),
        ("fixed", "pinned", {"base_stiffness": 0.0, "top_stiffness": 0.0}, "to move sideways"),
        ("fixed", "free", {"base_rotation_stiffness": 0.0}, "to rotate about its base"),
    ],
)
def test_mechanisms_are_refused(base, top, springs, free):
    message = f"^base and top leave the column a mechanism, free {free}: one end must be fixed, "
    with pytest.raises(InputError, match=message):
        column(base, top, **springs)


@pytest.mark.parametrize(
    ("base", "top", "springs"),
    [
        ("free", "free", {"base_stiffness": 1e8, "base_rotation_stiffness": 1e9}),
        ("pinned", "free", {"top_stiffness": 1e6}),
        ("pinned", "free", {"base_rotation_stiffness": 1e9}),
    ],
)
def test_springs_hold_what_the_ends_leave_free(base, top, springs):
    assert column(base, top, **springs).equivalent(1.2).stiffness > 0.0


# Other arrangements


def test_rigid_column_on_springs_deflects_in_a_straight_line():
    springs = {"base_stiffness": 3e8, "base_rotation_stiffness": 7e9}
    stiff = round_column(6.0, 1.0, "free", "free", 1e20, **springs)
    z = np.linspace(0.0, 6.0, 7)
    np.testing.assert_allclose(stiff.struck_at(1.2).deflection(z), 1 / 3e8 + z * 1.2 / 7e9)


@GENERATED
@given(struck_columns(), st.floats(0.01, 1.0))
def test_embedded_column_is_a_longer_one(case, share):
    column, impact_height = case
    depth = share * column.height
    embedded = dataclasses.replace(column, embedment=depth)
    longer = dataclasses.replace(column, height=column.height + depth)
    here, there = embedded.struck_at(impact_height), longer.struck_at(impact_height + depth)
    assert here.stiffness == pytest.approx(there.stiffness, rel=1e-9)
    assert here.mass == pytest.approx(there.mass, rel=1e-9)
    here, there = (struck.member_forces(1.0) for struck in (here, there))
    np.testing.assert_allclose(here.z, there.z - depth, atol=1e-9 * column.height)
    np.testing.assert_allclose(here.moment, there.moment, atol=1e-9 * longer.height)


@GENERATED
@given(struck_columns(), st.floats(0.05, 0.95))
def test_step_to_the_same_section_is_no_step(case, share):
    column, impact_height = case
    step = Step(height=share * column.height, section=column.section)
    stepped = dataclasses.replace(column, steps=[step])
    whole = column.equivalent(impact_height)
    parts = stepped.equivalent(impact_height)
    assert parts.stiffness == pytest.approx(whole.stiffness, rel=1e-11)
    assert parts.mass == pytest.approx(whole.mass, rel=1e-9)
    assert stepped.mass == pytest.approx(column.mass, rel=1e-12)


@pytest.mark.parametrize(("named", "spring"), [("fixed", 1e25), ("pinned", 1e-9)])
def test_very_stiff_and_very_soft_springs_are_the_named_ends(named, spring):
    sprung = column("fixed", "pinned", base_rotation_stiffness=spring).equivalent(1.2)
    rigid = column(named, "pinned").equivalent(1.2)
    assert sprung.stiffness == pytest.approx(rigid.stiffness, rel=1e-9)
    assert sprung.mass == pytest.approx(rigid.mass, rel=1e-9)


def test_mass_at_the_top_enters_with_the_square_of_the_shape():
    bare = column("fixed", "free")
    loaded = dataclasses.replace(bare, top_mass=40e3)
    added = loaded.equivalent(1.2).mass - bare.equivalent(1.2).mass
    assert added == pytest.approx(40e3 * bare.struck_at(1.2).shape(5.0) ** 2, rel=1e-9)
    assert loaded.equivalent(1.2).stiffness == bare.equivalent(1.2).stiffness


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"height": 0.0}, "height must be positive, got 0"),
        ({"elastic_modulus": math.nan}, "elastic_modulus must be finite, got nan"),
        ({"density": -1.0}, "density must be positive, got -1"),
        ({"poisson_ratio": -0.1}, r"poisson_ratio must not be negative, got -0\.1"),
        ({"poisson_ratio": 0.6}, r"poisson_ratio must be at most 0\.5, got 0\.6"),
        ({"base": "hinged"}, "base must be one of fixed, pinned, free, got 'hinged'"),
        ({"top": None}, "top must be one of fixed, pinned, free, got None"),
        (
            {"section": 0.9},
            r"section must be a section such as CircularSection\(…\), got 0\.9",
        ),
        ({"stiffness_factor": 0.0}, "stiffness_factor must be positive, got 0"),
        ({"stiffness_factor": 1.2}, r"stiffness_factor must be at most 1, got 1\.2"),
        ({"effective_stiffness": -1e9}, r"effective_stiffness must be positive, got -1e\+09"),
        (
            {"effective_stiffness": 1e9, "stiffness_factor": 0.5},
            r"give only one of stiffness_factor and effective_stiffness, got 0\.5 and 1e\+09 N m²",
        ),
        ({"top_mass": -1.0}, "top_mass must not be negative, got -1"),
        ({"top_stiffness": -5.0}, "top_stiffness must not be negative, got -5"),
        ({"embedment": math.inf}, "embedment must be finite, got inf"),
        ({"steps": [3.0]}, r"steps must be Steps, got 3\.0"),
        ({"steps": None}, "steps must be Steps, got None"),
        ({"steps": 3}, "steps must be Steps, got 3"),
        (
            {"steps": [np.zeros((2, 2))]},
            r"steps must be Steps, got array\(\[\[0\., 0\.\], \[0\., 0\.\]\]\)",
        ),
        ({"base": np.array([1.0, 2.0])}, r"base must be one of .*, got array\(\[1\., 2\.\]\)"),
        (
            {"section": np.zeros((2, 2))},
            r"section must be a section such as .*, got array\(\[\[0\., 0\.\], \[0\., 0\.\]\]\)",
        ),
        (
            {"steps": [Step(height=2.0, section=EXAMPLE["section"])] * 2},
            r"steps\[2\]\.height must be above 2 m and below the height 5 m, got 2 m: no part may "
            "be shorter than 5e-06 m",
        ),
        (
            {"steps": [Step(height=5.0, section=EXAMPLE["section"])]},
            r"steps\[1\]\.height must be above 0 m and below the height 5 m, got 5 m: no part may "
            "be shorter than 5e-06 m",
        ),
    ],
)
def test_bad_values_are_named(changes, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        PierColumn(**(EXAMPLE | changes))


@pytest.mark.parametrize(
    ("base", "top", "impact_height", "rule"),
    [
        ("fixed", "pinned", 5.0, "above 0 m and below the height 5 m"),
        ("fixed", "pinned", 0.0, "above 0 m and below the height 5 m"),
        ("fixed", "free", 5.1, "above 0 m and at most the height 5 m"),
        ("fixed", "free", 0.0, "above 0 m and at most the height 5 m"),
        ("free", "fixed", -0.1, "at least 0 m and below the height 5 m"),
        ("free", "fixed", 5.0, "at least 0 m and below the height 5 m"),
    ],
)
def test_impact_off_the_column_or_on_a_support_is_refused(base, top, impact_height, rule):
    message = (
        f"^impact_height must be {rule} of a column with {base} base and {top} top, "
        f"got {impact_height:g} m$"
    )
    pier = column(base, top)
    for call in (
        pier.equivalent,
        lambda height: pier.struck_at(height).deflection(1.0),
        lambda height: pier.struck_at(height).shape(1.0),
        lambda height: pier.member_forces(1e6, height),
    ):
        with pytest.raises(InputError, match=message):
            call(impact_height)


@pytest.mark.parametrize("z", ["abc", 1j, {}, [1.0, math.nan]])
def test_heights_that_are_no_numbers_are_refused(z):
    struck = column("fixed", "pinned").struck_at(1.2)
    for call in (struck.shape, struck.deflection):
        with pytest.raises(InputError, match=r"^z must be (an array of numbers|finite), got "):
            call(z)


@pytest.mark.parametrize("z", [-0.1, 5.1, [1.0, 5.1]])
def test_heights_off_the_column_are_refused(z):
    with pytest.raises(InputError, match=r"^z must be from 0 m to the height 5 m throughout$"):
        column("fixed", "pinned").struck_at(1.2).deflection(z)


def test_other_bad_arguments_are_named():
    pier = column("fixed", "pinned")
    with pytest.raises(InputError, match=r"^impact_height must be a number, got 'low'$"):
        pier.equivalent("low")
    with pytest.raises(InputError, match=r"^force must be finite, got inf$"):
        pier.struck_at(1.2).deflection(1.0, force=math.inf)
    with pytest.raises(InputError, match=r"^damping_ratio must be below 1, got 1\.5$"):
        pier.equivalent(1.2, damping_ratio=1.5)
