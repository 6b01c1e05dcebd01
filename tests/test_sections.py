import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pierimpact import (
    CircularSection,
    FilledCircularSection,
    FilledRectangularSection,
    FreeSection,
    HollowCircularSection,
    HollowRectangularSection,
    InputError,
    OblongSection,
    PierColumn,
    RectangularSection,
    RegularPolygonSection,
)

GENERATED = settings(max_examples=40)
sizes, walls, ratios = st.floats(0.2, 5.0), st.floats(0.002, 0.49), st.floats(0.5, 15.0)


def oblong_width(width, depth):
    """Return the width of an oblong at distances from its axis."""
    if depth <= width:
        return lambda y: width - depth + np.sqrt(np.maximum(depth**2 - 4.0 * y**2, 0.0))
    straight = 0.5 * (depth - width)
    beyond = lambda y: np.maximum(np.abs(y) - straight, 0.0)  # noqa: E731
    return lambda y: np.sqrt(np.maximum(width**2 - 4.0 * beyond(y) ** 2, 0.0))


def polygon_width(sides, across_flats):
    """Return the width of a polygon with a side across the travel, between its other sides."""

    def width(y):
        room = np.full_like(y, np.inf)
        for index in range(sides):
            angle = 2.0 * np.pi * index / sides
            if math.sin(angle) > 1e-9:
                limit = (0.5 * across_flats - y * math.cos(angle)) / math.sin(angle)
                room = np.minimum(room, limit)
        return 2.0 * np.maximum(room, 0.0)

    return width


def cut_across(low, high, width_at, points=20_001):
    """Return A, I and ∫ S²/b dy of a solid section, by the trapezoidal rule on dense cuts."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    y = middle - half * np.cos(np.linspace(0.0, np.pi, points))
    width = width_at(y)
    above = np.concatenate([[0.0], np.cumsum(np.diff(y) * _mean(width * y))])
    shear = np.divide(above**2, width, out=np.zeros_like(y), where=width > 1e-6 * width.max())
    return (np.trapezoid(v, y) for v in (width, width * y**2, shear))


def _mean(values):
    return 0.5 * (values[1:] + values[:-1])


@st.composite
def solids(draw):
    """A solid section, from where to where it reaches, and its width in between."""
    width, depth = draw(sizes), draw(sizes)
    half = 0.5 * depth
    kind = draw(st.sampled_from(("circle", "rectangle", "oblong", "polygon")))
    if kind == "circle":
        section = CircularSection(diameter=depth)
        return section, -half, half, oblong_width(depth, depth)
    if kind == "rectangle":
        section = RectangularSection(width=width, depth=depth)
        return section, -half, half, lambda y: np.full_like(y, width)
    if kind == "oblong":
        return OblongSection(width=width, depth=depth), -half, half, oblong_width(width, depth)
    sides = draw(st.integers(3, 40))
    section = RegularPolygonSection(sides=sides, across_flats=depth)
    low = -half if sides % 2 == 0 else -half / math.cos(math.pi / sides)
    return section, low, half, polygon_width(sides, depth)


@GENERATED
@given(solids())
def test_solid_sections_are_the_integrals_over_their_cuts(solid):
    section, low, high, width_at = solid
    area, second_moment, shear = cut_across(low, high, width_at)
    assert section.area == pytest.approx(area, rel=1e-6)
    assert section.second_moment == pytest.approx(second_moment, rel=1e-6)
    coefficient = second_moment**2 / (area * shear)
    assert section.shear_coefficient == pytest.approx(coefficient, rel=1e-5)
    assert section.shear_area == pytest.approx(coefficient * area, rel=1e-5)
    assert section.extent == pytest.approx(high - low, rel=1e-12)


def midpoints(low, high, count):
    """Return the middles of equal parts, and their length."""
    length = (high - low) / count
    return low + (np.arange(count) + 0.5) * length, length


@GENERATED
@given(sizes, walls)
def test_a_hollow_circle_is_the_sum_over_its_sectors(diameter, wall):
    thickness = wall * diameter
    section = HollowCircularSection(diameter=diameter, wall_thickness=thickness)
    radius, step = midpoints(0.5 * diameter - thickness, 0.5 * diameter, 2000)
    angle, turn = midpoints(0.0, 0.5 * np.pi, 2000)  # from the axis of travel; a quarter
    ring = np.sum(radius) * step
    assert section.area == pytest.approx(2.0 * np.pi * ring, rel=1e-6)
    cubed = np.sum(radius**3) * step
    second_moment = 4.0 * cubed * np.sum(np.cos(angle) ** 2) * turn
    assert section.second_moment == pytest.approx(second_moment, rel=1e-6)
    # The stress through the wall at an angle holds the sector beyond, as its mirror image does.
    first_moment = np.sum(radius**2) * step * (np.cumsum(np.cos(angle)) - 0.5 * np.cos(angle))
    stress = first_moment * turn / (second_moment * thickness)
    energy = 4.0 * ring * np.sum(stress**2) * turn
    through_wall = 1.0 / (section.area * energy)
    expected = through_wall if section.values["Di"] > 0.12 * diameter else 0.9
    assert section.shear_coefficient == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("hole", np.linspace(0.25, 0.999, 16))
def test_a_hollow_circle_is_within_3_percent_of_the_exact_stress(hole):
    # At ν = 0 the stress is the gradient of a warping w = (a r + b/r − r³/8) cos θ, for which
    # ∇²w = −y, and whose slope across either edge is zero.
    section = HollowCircularSection(diameter=2.0, wall_thickness=1.0 - hole)
    a, b = 0.375 * (1.0 + hole**2), 0.375 * hole**2
    integral = a * (1.0 - hole**4) / 4.0 + b * (1.0 - hole**2) / 2.0 - (1.0 - hole**6) / 48.0
    exact = section.second_moment**2 / (section.area * np.pi * integral)
    assert section.shear_coefficient == pytest.approx(exact, rel=0.03)


@GENERATED
@given(sizes, sizes, walls)
def test_a_box_is_the_sum_over_webs_and_flanges(width, depth, wall):
    thickness = wall * min(width, depth)
    section = HollowRectangularSection(width=width, depth=depth, wall_thickness=thickness)
    inner_width, inner_depth = width - 2.0 * thickness, depth - 2.0 * thickness
    area = width * depth - inner_width * inner_depth
    second_moment = (width * depth**3 - inner_width * inner_depth**3) / 12.0
    assert section.area == pytest.approx(area, rel=1e-9)
    assert section.second_moment == pytest.approx(second_moment, rel=1e-9)
    shear, beyond = 0.0, 0.0  # of one half: the flange from outside in, the web down to the axis
    for outer, inner, across in (
        (0.5 * depth, 0.5 * inner_depth, width),
        (0.5 * inner_depth, 0.0, 2.0 * thickness),
    ):
        y, step = midpoints(inner, outer, 4000)
        parts = (across * y * step)[::-1]
        first_moment = beyond + np.cumsum(parts) - 0.5 * parts
        shear += 2.0 * np.sum(first_moment**2 / across) * step
        beyond += parts.sum()
    x, step = midpoints(0.0, 0.5 * inner_width, 4000)
    first_moment = x * thickness * 0.5 * (depth - thickness)
    shear += 4.0 * np.sum(first_moment**2 / thickness) * step
    coefficient = second_moment**2 / (area * shear)
    assert section.shear_coefficient == pytest.approx(coefficient, rel=1e-5)


TUBES = {
    "circle": (FilledCircularSection, HollowCircularSection, CircularSection),
    "rectangle": (FilledRectangularSection, HollowRectangularSection, RectangularSection),
}


@st.composite
def tubes(draw):
    """A filled tube, and its tube and core as sections of their own."""
    filled, tube, core = TUBES[draw(st.sampled_from(sorted(TUBES)))]
    names = ("diameter",) if core is CircularSection else ("width", "depth")
    outer = {name: draw(sizes) for name in names}
    thickness = draw(walls) * min(outer.values())
    inner = {name: size - 2.0 * thickness for name, size in outer.items()}
    ratio = {"modular_ratio": draw(ratios), "density_ratio": draw(ratios)}
    return (
        filled(**outer, wall_thickness=thickness, **ratio),
        tube(**outer, wall_thickness=thickness),
        core(**inner),
    )


@GENERATED
@given(tubes())
def test_tube_and_core_add(parts):
    filled, tube, core = parts
    concrete, steel = 30e9, 30e9 * filled.modular_ratio
    density, steel_density = 2400.0, 2400.0 * filled.density_ratio
    column = PierColumn(height=5.0, section=filled, elastic_modulus=concrete, density=density)
    rigidity = concrete * core.second_moment + steel * tube.second_moment
    assert column.flexural_rigidity == pytest.approx(rigidity, rel=1e-9)
    rigidity = (concrete * core.shear_area + steel * tube.shear_area) / 2.4
    assert column.shear_rigidity == pytest.approx(rigidity, rel=1e-9)
    mass = density * core.area + steel_density * tube.area
    assert column.mass_per_length == pytest.approx(mass, rel=1e-9)
    assert density * filled.values["Am"] == pytest.approx(mass, rel=1e-9)
    inertia = density * core.second_moment + steel_density * tube.second_moment
    assert density * filled.mass_second_moment == pytest.approx(inertia, rel=1e-9)


@GENERATED
@given(sizes, sizes)
def test_limits(width, depth):
    def same(section, other, rel):
        for name in ("A", "I", "kappa"):
            assert section.values[name] == pytest.approx(other.values[name], rel=rel), name

    circle = CircularSection(diameter=depth)
    rectangle = RectangularSection(width=width, depth=depth)
    for nearly in (1.0, 1.0 - 1e-9, 1.0 + 1e-9):
        same(OblongSection(width=depth * nearly, depth=depth), circle, 1e-6)
    same(OblongSection(width=1e5 * depth, depth=depth), RectangularSection(
        width=1e5 * depth, depth=depth), 1e-4)  # fmt: skip
    square = RectangularSection(width=depth, depth=depth)
    same(RegularPolygonSection(sides=4, across_flats=depth), square, 1e-9)
    same(RegularPolygonSection(sides=100, across_flats=depth), circle, 1e-3)
    same(HollowCircularSection(diameter=depth, wall_thickness=0.499999 * depth), circle, 1e-5)
    if width <= depth:  # else a slot is left, which carries no shear
        hole = HollowRectangularSection(width=width, depth=depth, wall_thickness=0.4999999 * width)
        same(hole, rectangle, 1e-5)
    thin = {"wall_thickness": 1e-7 * min(width, depth), "modular_ratio": 7.0, "density_ratio": 3.3}
    same(FilledCircularSection(diameter=depth, **thin), circle, 1e-4)
    same(FilledRectangularSection(width=width, depth=depth, **thin), rectangle, 1e-4)
    thin = {"wall_thickness": 1e-6 * depth}
    tube = HollowCircularSection(diameter=depth, **thin)
    assert tube.shear_coefficient == pytest.approx(0.5, rel=1e-5)
    box = HollowRectangularSection(width=depth, depth=depth, **thin)
    assert box.shear_coefficient == pytest.approx(5.0 / 12.0, rel=1e-5)


def test_more_sides_come_nearer_to_the_circle():
    circle = CircularSection(diameter=1.0)
    for name in ("A", "I"):
        off = [
            RegularPolygonSection(sides=n, across_flats=1.0).values[name] / circle.values[name] - 1
            for n in (12, 24, 48, 96)
        ]
        rate = np.array(off[:-1]) / np.array(off[1:])
        assert rate == pytest.approx(4.0, rel=0.05)  # by the square of the number of sides


def test_the_tube_without_contrast_is_solid():
    for wall in (0.01, 0.2):
        filled = FilledCircularSection(
            diameter=1.0,
            wall_thickness=wall,
            modular_ratio=1.0,
            density_ratio=1.0,
            shear_coefficient=0.9,
        )
        solid = CircularSection(diameter=1.0)
        beams = [
            PierColumn(height=5.0, section=s, elastic_modulus=30e9, density=2400.0).beam(1.2)
            for s in (filled, solid)
        ]
        assert beams[0].circular_frequencies == pytest.approx(
            beams[1].circular_frequencies, rel=1e-9
        )


def test_shear_coefficient_can_be_given():
    section = HollowCircularSection(diameter=2.0, wall_thickness=0.2, shear_coefficient=0.53)
    assert section.shear_coefficient == section.values["kappa"] == 0.53
    assert section.shear_area == 0.53 * section.area
    assert dataclasses.replace(section, diameter=3.0).shear_coefficient == 0.53


def test_a_copy_in_another_size_has_the_coefficient_of_its_own_shape():
    section = HollowCircularSection(diameter=2.0, wall_thickness=0.9)
    thinner = dataclasses.replace(section, wall_thickness=0.01)
    assert thinner == HollowCircularSection(diameter=2.0, wall_thickness=0.01)
    assert thinner.shear_coefficient < 0.51 < section.shear_coefficient


def test_a_free_section_is_what_is_given():
    box = HollowRectangularSection(width=2.0, depth=1.5, wall_thickness=0.3)
    free = FreeSection(area=box.area, second_moment=box.second_moment, shear_area=box.shear_area)
    columns = [
        PierColumn(height=7.0, section=section, elastic_modulus=30e9, density=2500.0)
        for section in (box, free)
    ]
    first, second = (column.equivalent(1.2) for column in columns)
    assert first.mass == pytest.approx(second.mass, rel=1e-12)
    assert first.stiffness == pytest.approx(second.stiffness, rel=1e-12)
    assert free.shear_coefficient == pytest.approx(box.shear_coefficient, rel=1e-12)
    plate = RectangularSection(width=2.0, depth=1.5)
    free = FreeSection(area=3.0, second_moment=plate.second_moment, shear_area=2.5)
    assert free.extent == pytest.approx(1.5)


FILLED = {"diameter": 1.0, "modular_ratio": 7.0, "density_ratio": 3.0}


@pytest.mark.parametrize(
    ("section", "arguments", "message"),
    [
        (CircularSection, {"diameter": 0.0}, "diameter must be positive, got 0"),
        (CircularSection, {"diameter": "wide"}, "diameter must be a number, got 'wide'"),
        (RectangularSection, {"width": -1.0, "depth": 1.0}, "width must be positive, got -1"),
        (RectangularSection, {"width": 1.0, "depth": math.inf}, "depth must be finite, got inf"),
        (
            CircularSection,
            {"diameter": 1.0, "shear_coefficient": 1.1},
            r"shear_coefficient must be at most 1, got 1\.1",
        ),
        (
            RectangularSection,
            {"width": 1.0, "depth": 1.0, "shear_coefficient": 0.0},
            "shear_coefficient must be positive, got 0",
        ),
        (
            HollowCircularSection,
            {"diameter": 1.0, "wall_thickness": 0.5},
            r"wall_thickness must be below half the diameter of 1 m, got 0\.5 m",
        ),
        (
            HollowRectangularSection,
            {"width": 1.0, "depth": 0.8, "wall_thickness": 0.45},
            r"wall_thickness must be below half the depth of 0\.8 m, got 0\.45 m",
        ),
        (
            FilledCircularSection,
            FILLED | {"wall_thickness": 0.7},
            r"wall_thickness must be below half the diameter of 1 m, got 0\.7 m",
        ),
        (
            FilledCircularSection,
            FILLED | {"wall_thickness": 0.1, "modular_ratio": 0.0},
            "modular_ratio must be positive, got 0",
        ),
        (
            RegularPolygonSection,
            {"sides": 2, "across_flats": 1.0},
            "sides must be a whole number from 3 to 100, got 2",
        ),
        (
            RegularPolygonSection,
            {"sides": 6.5, "across_flats": 1.0},
            r"sides must be a whole number from 3 to 100, got 6\.5",
        ),
        (
            FreeSection,
            {"area": 1.0, "second_moment": 0.1, "shear_area": 1.2},
            r"shear_area must be at most the area of 1 m², got 1\.2 m²",
        ),
    ],
)
def test_bad_values_are_named(section, arguments, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        section(**arguments)
