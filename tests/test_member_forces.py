import dataclasses
import math

import numpy as np
import pytest
import stiffness_method
from generated_columns import GENERATED, STABLE, struck_columns
from hypothesis import given
from hypothesis import strategies as st

from pierimpact import CircularSection, InputError, PierColumn

HEIGHT = 5.0
IMPACT_HEIGHTS = [0.3, 1.2, 2.5, 4.6]


def column(base, top, diameter=0.914):
    return PierColumn(
        height=HEIGHT,
        section=CircularSection(diameter=diameter),
        elastic_modulus=25e9,
        density=2400.0,
        base=base,
        top=top,
    )


# Independent computation


@GENERATED
@given(struck_columns(), st.floats(-1e8, 1e8))
def test_support_reactions_agree_with_the_stiffness_method(case, reaction):
    column, impact_height = case
    heights = sorted({0.0, impact_height, column.height})
    _, _, support_forces, support_moments = stiffness_method.solve(column, heights, impact_height)
    forces = column.member_forces(reaction, impact_height)
    # A support moment in the sense of dx/dz puts the far face in tension at the base, and the
    # near face at the top.
    pairs = [
        (forces.base_force, -support_forces[0]),
        (forces.top_force, -support_forces[1]),
        (forces.base_moment, support_moments[0]),
        (forces.top_moment, -support_moments[1]),
        (forces.impact_moment, support_moments[0] - support_forces[0] * heights[1]),
    ]
    if impact_height == column.height:
        pairs.pop()
        assert forces.impact_moment == 0.0
    for ours, unit in pairs:
        assert ours == pytest.approx(reaction * float(unit), rel=1e-11, abs=1e-300)


# Closed forms


@pytest.mark.parametrize("z_n", [0.3, 1.2, HEIGHT])
def test_cantilever(z_n):
    forces = column("fixed", "free").member_forces(3e6, z_n)
    assert forces.base_force == pytest.approx(3e6, rel=1e-14)
    assert forces.base_moment == pytest.approx(-3e6 * z_n, rel=1e-14)
    assert (forces.top_force, forces.top_moment, forces.impact_moment) == (0.0, 0.0, 0.0)
    assert not np.signbit(forces.shear).any()


@pytest.mark.parametrize("z_n", [0.0, 0.3, 1.2])
def test_cantilever_from_the_top(z_n):
    forces = column("free", "fixed").member_forces(3e6, z_n)
    assert forces.top_force == pytest.approx(3e6, rel=1e-14)
    assert forces.top_moment == pytest.approx(-3e6 * (HEIGHT - z_n), rel=1e-14)
    assert (forces.base_force, forces.base_moment, forces.impact_moment) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("z_n", IMPACT_HEIGHTS)
def test_simple_beam(z_n):
    forces = column("pinned", "pinned").member_forces(3e6, z_n)
    assert forces.base_force == pytest.approx(3e6 * (HEIGHT - z_n) / HEIGHT, rel=1e-13)
    assert forces.top_force == pytest.approx(3e6 * z_n / HEIGHT, rel=1e-13)
    assert forces.impact_moment == pytest.approx(3e6 * z_n * (HEIGHT - z_n) / HEIGHT, rel=1e-13)
    assert (forces.base_moment, forces.top_moment) == (0.0, 0.0)


@pytest.mark.parametrize("z_n", IMPACT_HEIGHTS)
@pytest.mark.parametrize("diameter", [0.3, 0.914, 4.0])
def test_propped_cantilever_with_shear(z_n, diameter):
    # The prop takes back the deflection that a cantilever would have at its tip.
    propped = column("fixed", "pinned", diameter)
    bending, shearing = propped.flexural_rigidity, propped.shear_rigidity
    tip = z_n**2 * (3.0 * HEIGHT - z_n) / (6.0 * bending) + z_n / shearing
    prop = 3e6 * tip / (HEIGHT**3 / (3.0 * bending) + HEIGHT / shearing)
    forces = propped.member_forces(3e6, z_n)
    assert forces.top_force == pytest.approx(prop, rel=1e-12)
    assert forces.base_force == pytest.approx(3e6 - prop, rel=1e-12)
    assert forces.base_moment == pytest.approx(prop * HEIGHT - 3e6 * z_n, rel=1e-12)
    assert forces.impact_moment == pytest.approx(prop * (HEIGHT - z_n), rel=1e-12)


@pytest.mark.parametrize("z_n", IMPACT_HEIGHTS)
def test_slender_column_fixed_at_both_ends(z_n):
    a, b = z_n, HEIGHT - z_n
    forces = column("fixed", "fixed", diameter=5e-6).member_forces(3e6, z_n)
    assert forces.base_moment == pytest.approx(-3e6 * a * b**2 / HEIGHT**2, rel=1e-9)
    assert forces.top_moment == pytest.approx(-3e6 * a**2 * b / HEIGHT**2, rel=1e-9)
    assert forces.impact_moment == pytest.approx(2.0 * 3e6 * a**2 * b**2 / HEIGHT**3, rel=1e-9)
    base_force = 3e6 * b**2 * (3.0 * a + b) / HEIGHT**3
    assert forces.base_force == pytest.approx(base_force, rel=1e-9)


# Invariants


@GENERATED
@given(struck_columns(), st.floats(1.0, 1e8))
def test_equilibrium(case, reaction):
    column, z_n = case
    forces = column.member_forces(reaction, z_n)
    assert forces.base_force + forces.top_force == pytest.approx(reaction, rel=1e-12)
    about_base = (
        reaction * z_n - forces.top_force * column.height + forces.base_moment - forces.top_moment
    )
    assert abs(about_base) <= 1e-12 * reaction * column.height


@GENERATED
@given(struck_columns(), st.floats(1.0, 1e8))
def test_diagrams(case, reaction):
    column, z_n = case
    forces = column.member_forces(reaction, z_n)
    assert forces.z.tolist() == [0.0, z_n, z_n, column.height]
    assert forces.z.shape == forces.shear.shape == forces.moment.shape == (4,)
    # The shear drops by the force at z_n, the moment has a corner there and no jump.
    assert forces.shear[1] - forces.shear[2] == pytest.approx(reaction, rel=1e-12)
    assert forces.moment[1] == forces.moment[2]
    for start in (0, 2):
        rise = forces.moment[start + 1] - forces.moment[start]
        run = forces.z[start + 1] - forces.z[start]
        assert forces.shear[start] == forces.shear[start + 1]
        assert abs(rise - forces.shear[start] * run) <= 1e-12 * reaction * column.height


@pytest.mark.parametrize(("base", "top"), STABLE)
def test_moment_is_positive_where_the_deflected_column_is_hollow_towards_the_truck(base, top):
    # M = −EI x'' in a column too slender to deflect in shear, by second differences.
    slender = column(base, top, diameter=5e-4)
    forces = slender.member_forces(1.0, 1.2)
    step = 0.01
    z = np.array([0.1, 0.6, 1.1, 1.3, 3.0, 4.9])
    before, here, after = (
        slender.struck_at(1.2).deflection(z + shift) for shift in (-step, 0.0, step)
    )
    curvature = (before - 2.0 * here + after) / step**2
    moment = np.interp(z, forces.z, forces.moment)
    np.testing.assert_allclose(-slender.flexural_rigidity * curvature, moment, atol=1e-6)


@GENERATED
@given(struck_columns())
def test_forces_scale_with_the_reaction(case):
    column, z_n = case
    unit, pull = (column.member_forces(reaction, z_n) for reaction in (1.0, -2.5e6))
    np.testing.assert_allclose(pull.shear, -2.5e6 * unit.shear, rtol=1e-13)
    np.testing.assert_allclose(pull.moment, -2.5e6 * unit.moment, rtol=1e-9, atol=1e-6)
    assert column.struck_at(z_n).member_forces(1.0) == unit


# Extreme values


@GENERATED
@given(struck_columns(), st.sampled_from([1e6, -1e6]))
def test_extremes_are_the_largest_of_the_diagrams_and_stand_where_they_say(case, reaction):
    column, z_n = case
    forces = column.member_forces(reaction, z_n)
    z = np.linspace(0.0, column.height, 1001)
    moment, shear = forces.largest_moment, forces.largest_shear
    assert np.abs(np.interp(z, forces.z, forces.moment)).max() <= abs(moment.value) * (1 + 1e-11)
    assert moment.start == moment.end
    assert np.interp(moment.start, forces.z, forces.moment) == pytest.approx(moment.value)
    assert abs(shear.value) == pytest.approx(np.abs(forces.shear).max(), rel=1e-11)
    below = (0.0, z_n, forces.shear[0])
    above = (z_n, column.height, forces.shear[-1])
    assert (shear.start, shear.end, shear.value) in (below, above)


def test_extremes_of_known_columns():
    cantilever = column("fixed", "free").member_forces(3e6, 1.2)
    assert cantilever.largest_moment == pytest.approx((-3.6e6, 0.0, 0.0))
    assert cantilever.largest_shear == pytest.approx((3e6, 0.0, 1.2))
    high = column("pinned", "pinned").member_forces(3e6, 4.0)
    assert high.largest_moment == pytest.approx((2.4e6, 4.0, 4.0))
    assert high.largest_shear == pytest.approx((-2.4e6, 4.0, 5.0))


def test_lowest_of_equal_extremes():
    forces = column("fixed", "fixed").member_forces(3e6, HEIGHT / 2.0)
    assert forces.largest_shear == pytest.approx((1.5e6, 0.0, HEIGHT / 2.0))
    # Equal but for round-off, whichever way it falls.
    nudged = dataclasses.replace(forces, top_moment=forces.top_moment * (1.0 + 4e-16))
    assert forces.largest_moment.start == nudged.largest_moment.start == 0.0
    assert forces.largest_moment.value == pytest.approx(-3e6 * HEIGHT / 8.0)


def test_no_force_gives_no_forces():
    forces = column("fixed", "pinned").member_forces(0.0, 1.2)
    assert forces.largest_shear.value == forces.largest_moment.value == 0.0


def test_reaction_must_be_a_finite_number():
    with pytest.raises(InputError, match=r"^reaction must be finite, got nan$"):
        column("fixed", "pinned").member_forces(math.nan, 1.2)
