import dataclasses
import math
from itertools import pairwise

import numpy as np
import pytest
from generated_columns import GENERATED, arranged_columns, round_column, struck_columns
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from pierimpact import InputError
from pierimpact.pier.arrangement import SUPPORTS, Arrangement, Part
from pierimpact.pier.beam import Elements, beam_pier

# Stiffness and mass are of interest here, for columns of all kinds.
pytestmark = pytest.mark.filterwarnings("ignore::pierimpact.StaticForcesWarning")

# Closed forms.


@pytest.mark.parametrize(
    ("base", "top", "roots"),
    [
        ("fixed", "free", [1.87510407, 4.69409113, 7.85475744, 10.99554073]),
        ("free", "fixed", [1.87510407, 4.69409113, 7.85475744, 10.99554073]),
        ("fixed", "pinned", [3.92660231, 7.06858275, 10.21017612]),
        ("fixed", "fixed", [4.73004074, 7.85320462, 10.99560784]),
        ("pinned", "pinned", [math.pi, 2.0 * math.pi, 3.0 * math.pi]),
    ],
)
def test_slender_column_has_the_frequencies_of_eulers_beam(base, top, roots):
    slender = round_column(500.0, 1.0, base, top)
    found = slender.beam(200.0, modes=len(roots)).frequencies
    per_length = math.sqrt(slender.flexural_rigidity / slender.mass_per_length) / 500.0**2
    expected = np.square(roots) * per_length / (2.0 * math.pi)
    assert found == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("ratio", [0.1, 1.0, 30.0])
def test_slender_cantilever_with_a_mass_at_its_tip(ratio):
    """1 + cos λ cosh λ + r λ (cos λ sinh λ − sin λ cosh λ) = 0 with r the masses' ratio."""
    bare = round_column(500.0, 1.0, "fixed", "free")
    loaded = dataclasses.replace(bare, top_mass=ratio * bare.mass)

    def characteristic(x):
        mass = ratio * x * (math.cos(x) * math.tanh(x) - math.sin(x))
        return 1.0 / math.cosh(x) + math.cos(x) + mass

    # One root in each quarter turn before an odd number of them, whatever the mass.
    roots = [brentq(characteristic, 1e-3, 1.8752), brentq(characteristic, 3.9266, 4.6942)]
    per_length = math.sqrt(bare.flexural_rigidity / bare.mass_per_length) / 500.0**2
    expected = np.square(roots) * per_length / (2.0 * math.pi)
    assert loaded.beam(200.0, modes=2).frequencies == pytest.approx(expected, rel=1e-4)


def test_rigid_column_on_springs_sways_and_rocks():
    """Two degrees of freedom: its centre of mass and its rotation, with the mass at the top."""
    base, rotation, height, cap = 4e8, 9e9, 6.0, 8e3
    springs = {"base_stiffness": base, "base_rotation_stiffness": rotation, "top_mass": cap}
    stiff = round_column(height, 1.0, "free", "free", modulus=28e17, **springs)
    per_length, length = stiff.mass_per_length, np.array([[1.0], [height]])
    inertia = per_length * height**3 / 3.0
    inertia += stiff.density * stiff.section.second_moment * height
    first = per_length * height**2 / 2.0
    mass = np.array([[stiff.mass, first], [first, inertia]]) + cap * length @ length.T
    squares = np.linalg.eigvals(np.linalg.solve(mass, np.diag([base, rotation]))).real
    expected = np.sqrt(np.sort(squares)) / (2.0 * math.pi)
    assert stiff.beam(1.2, modes=2).frequencies == pytest.approx(expected, rel=1e-6)


def timoshenko_pinned(column, modes):
    """Both branches of the pinned–pinned beam, and the mode of uniform rotation [rad/s]."""
    inertia = column.density * column.section.second_moment
    EI, kGA, m = column.flexural_rigidity, column.shear_rigidity, column.mass_per_length
    k = np.arange(1, modes + 1) * math.pi / column.height
    sum_of_roots = kGA / inertia + (kGA / m + EI / inertia) * k**2
    product = kGA * EI * k**4 / (m * inertia)
    lower = 2.0 * product / (sum_of_roots + np.sqrt(sum_of_roots**2 - 4.0 * product))
    squares = np.concatenate((lower, product / lower, [kGA / inertia]))
    return np.sqrt(np.sort(squares)[:modes])


@settings(max_examples=20)
@given(st.floats(3.0, 30.0), st.floats(0.5, 2.5), st.floats(0.1, 0.95))
def test_pinned_column_has_timoshenkos_frequencies(height, diameter, share):
    pinned = round_column(height, diameter, "pinned", "pinned")
    impact_height = share * height
    found = 2.0 * math.pi * pinned.beam(impact_height, modes=40).frequencies
    assert found == pytest.approx(timoshenko_pinned(pinned, 40), rel=1e-9)


@pytest.mark.parametrize(
    ("ends", "quarter_waves"),
    [
        (("fixed", "free"), [1.0, 3.0, 5.0, 7.0]),
        (("fixed", "pinned"), [2.0, 4.0, 6.0, 8.0]),
        (("fixed", "fixed"), [2.0, 4.0, 6.0, 8.0]),
    ],
)
def test_rigid_in_flexure_it_is_a_shear_beam(ends, quarter_waves):
    length, stiff = 4.0, round_column(4.0, 1.0)
    G_A, m = stiff.shear_rigidity, stiff.mass_per_length
    parts = tuple(
        Part(bottom, top, 1e9 * stiff.flexural_rigidity, G_A, m, 1.0)
        for bottom, top in ((0.0, 1.0), (1.0, length))
    )
    arrangement = Arrangement(parts, *(SUPPORTS[end] for end in ends))
    beam = beam_pier(arrangement, 1, stiff.equivalent(1.0), modes=4)
    expected = np.array(quarter_waves) * math.sqrt(G_A / m) / (4.0 * length)
    assert beam.frequencies == pytest.approx(expected, rel=1e-6)


def test_frequencies_do_not_depend_on_the_place_of_the_impact():
    low, high = (round_column(7.0, 1.1, "fixed", "free").beam(z, modes=30) for z in (0.9, 7.0))
    assert low.frequencies == pytest.approx(high.frequencies, rel=1e-10)


@pytest.mark.parametrize("top", ["pinned", "fixed", "free"])
@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-9])
def test_it_is_as_stiff_struck_close_to_a_support(top, distance):
    beam = round_column(5.0, 0.914, top=top).beam(distance)
    flexibility = np.sum((beam.impact_deflection / beam.circular_frequencies) ** 2)
    assert flexibility * beam.equivalent.stiffness == pytest.approx(1.0, rel=1e-9)
    frequencies = round_column(5.0, 0.914, top=top).beam(2.0).frequencies
    np.testing.assert_allclose(beam.frequencies[:8], frequencies[:8], rtol=1e-6)


def test_parts_of_one_section_are_one_beam():
    whole = round_column(6.0, 1.0)
    rigidities = (whole.flexural_rigidity, whole.shear_rigidity, whole.mass_per_length, 120.0)
    one, several = (
        beam_pier(
            whole.arrangement._replace(
                parts=tuple(Part(bottom, top, *rigidities) for bottom, top in pairwise(joints))
            ),
            struck,
            whole.equivalent(2.0),
            modes=12,
        )
        for joints, struck in (([0.0, 2.0, 6.0], 1), ([0.0, 0.5, 2.0, 3.0, 6.0], 2))
    )
    assert several.frequencies == pytest.approx(one.frequencies, rel=1e-10)
    for beam in (one, several):
        flexibility = np.sum((beam.impact_deflection / beam.circular_frequencies) ** 2)
        assert 1.0 / flexibility == pytest.approx(whole.equivalent(2.0).stiffness, rel=1e-12)
    assert several.effective_mass == pytest.approx(one.effective_mass, rel=1e-6)


# A static force.


def round_off(column, impact_height):
    """What round-off may leave of the beam: its condition, however its unknowns are scaled."""
    arrangement, _ = column.arrangement.with_joint(impact_height)
    elements = Elements(arrangement, 5)
    springs = np.where(elements.moves, elements.springs.ravel(), 0.0)
    stiffness = (elements.matrices()[0] + np.diag(springs))[np.ix_(elements.moves, elements.moves)]
    scale = 1.0 / np.sqrt(np.diag(stiffness))
    return 2.0 * np.finfo(float).eps * np.linalg.cond(stiffness * scale * scale[:, None])


@GENERATED
@given(st.one_of(struck_columns(), arranged_columns()))
def test_a_static_force_gives_the_static_member_forces(struck):
    column, impact_height = struck
    # Sections a hundred times as wide as their neighbours and columns as thin as a wire need more.
    tolerance = max(1e-8, round_off(column, impact_height))
    beam = column.beam(impact_height, modes=5)
    coordinates = beam.impact_deflection / beam.circular_frequencies**2  # under a unit force
    flexibility = coordinates @ beam.impact_deflection
    assert 1.0 / flexibility == pytest.approx(beam.equivalent.stiffness, rel=tolerance)
    deflection = coordinates @ beam.deflection
    expected = column.struck_at(impact_height).deflection(beam.z)
    assert deflection == pytest.approx(expected, rel=0.0, abs=tolerance * np.abs(expected).max())
    forces = column.member_forces(1.0, impact_height)
    force = max(1e-6, tolerance)
    size = force * max(1.0, impact_height, column.height - impact_height)
    # Just above the base, on both sides of the impact, and just below the top.
    at_impact = np.flatnonzero(beam.z == impact_height)
    corners = [0, at_impact[0], at_impact[-1], len(beam.z) - 1]
    shear, moment = (coordinates @ field for field in (beam.shear, beam.moment))
    if len(at_impact) == 2:
        assert shear[corners] == pytest.approx(forces.shear, rel=0.0, abs=force)
    assert moment[corners] == pytest.approx(forces.moment, rel=0.0, abs=size)


@GENERATED
@given(arranged_columns().filter(lambda struck: struck[0].steps), st.data())
def test_struck_all_but_at_a_step_it_is_struck_there(struck, data):
    """As at 0.9144 m and 3 × 0.3048 m, which round-off tells apart."""
    column = struck[0]
    step = data.draw(st.sampled_from(column.steps)).height
    close = step * (1.0 + data.draw(st.integers(-64, 64)) * np.finfo(float).eps)
    beams = at, beside = [column.beam(height, modes=3) for height in (step, close)]
    assert [beam.z.shape for beam in beams] == [at.z.shape] * 2
    assert close in beside.z
    tolerance = max(1e-8, round_off(column, step))
    assert beside.equivalent.stiffness == pytest.approx(at.equivalent.stiffness, rel=1e-9)
    static = [np.sum((beam.impact_deflection / beam.circular_frequencies) ** 2) for beam in beams]
    assert static == pytest.approx([1.0 / at.equivalent.stiffness] * 2, rel=tolerance)


def test_shapes_are_those_of_one_beam_wherever_it_is_struck():
    """Reciprocity: a force at one height moves another as a force there moves the first."""
    fixed = round_column(6.0, 1.0, "fixed", "free")
    low, high = fixed.beam(1.5, modes=25), fixed.beam(3.0, modes=25)

    def receptance(beam, height, frequency):
        shape = beam.deflection[:, np.argmin(np.abs(beam.z - height))]
        squares = beam.circular_frequencies**2
        damped = squares * (1.0 + 0.1j * frequency / beam.circular_frequencies)
        return np.sum(shape * beam.impact_deflection / (damped - frequency**2))

    for frequency in (0.0, 100.0, 600.0, 2000.0):
        across, back = receptance(low, 3.0, frequency), receptance(high, 1.5, frequency)
        assert across == pytest.approx(back, rel=1e-4)


def test_modes_are_kept_as_far_as_they_matter():
    short, tall = round_column(4.0, 1.2).beam(1.2), round_column(12.0, 1.2).beam(1.2)
    assert 8 <= len(short.frequencies) < 0.5 * len(tall.frequencies)
    assert tall.frequencies[-2] < 2500.0 <= tall.frequencies[-1]
    assert len(tall.circular_frequencies) == len(tall.frequencies) + 1  # the residual
    assert tall.equivalent == round_column(12.0, 1.2).equivalent(1.2)


@pytest.mark.parametrize("modes", [0, -3, 2.5, True, "3", 201, 10**400])
def test_modes_are_counted(modes):
    with pytest.raises(
        InputError, match=r"^modes must be (at least 1|at most 200|a whole number), got"
    ):
        round_column(5.0, 1.0).beam(1.2, modes=modes)


def test_impact_must_hit_the_column():
    with pytest.raises(InputError, match="impact_height must be above 0 m"):
        round_column(5.0, 1.0).beam(6.0)
    with pytest.raises(InputError, match="damping_ratio must be below 1"):
        round_column(5.0, 1.0).beam(1.2, damping_ratio=1.0)
