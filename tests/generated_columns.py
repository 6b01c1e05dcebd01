"""Columns for tests over generated inputs."""

import dataclasses

from hypothesis import settings
from hypothesis import strategies as st

from pierimpact import CircularSection, OblongSection, PierColumn, RectangularSection, Step
from pierimpact.files.case import Part

STABLE = [
    ("fixed", "fixed"),
    ("fixed", "pinned"),
    ("fixed", "free"),
    ("pinned", "fixed"),
    ("pinned", "pinned"),
    ("free", "fixed"),
]

SPRINGS = [
    "base_stiffness", "base_rotation_stiffness", "top_stiffness", "top_rotation_stiffness"
]  # fmt: skip

GENERATED = settings(max_examples=150)

sizes = st.floats(0.1, 10.0)
shear_coefficients = st.floats(0.3, 1.0)
sections = st.one_of(
    st.builds(CircularSection, diameter=sizes, shear_coefficient=shear_coefficients),
    st.builds(RectangularSection, width=sizes, depth=sizes, shear_coefficient=shear_coefficients),
    st.builds(OblongSection, width=sizes, depth=sizes),
)


def resisting(column, *resistances):
    """The parts of a column with the shear and moment resistance of each; None for none."""
    names = ("shear", "moment")
    return [
        Part(low, high, section, {n: value for n, value in zip(names, own, strict=True) if value})
        for (section, low, high), own in zip(column.stretches, resistances, strict=True)
    ]


def round_column(height, diameter, base="fixed", top="pinned", modulus=28e9, **extras):
    """A round column of concrete."""
    return PierColumn(
        height=height,
        section=CircularSection(diameter=diameter),
        elastic_modulus=modulus,
        density=2450.0,
        base=base,
        top=top,
        **extras,
    )


@st.composite
def struck_columns(draw):
    """A column, and an impact height on it (at the tip too, where the top is free)."""
    base, top = draw(st.sampled_from(STABLE))
    column = PierColumn(
        height=draw(st.floats(0.5, 60.0)),
        section=draw(sections),
        elastic_modulus=draw(st.floats(1e9, 250e9)),
        poisson_ratio=draw(st.floats(0.0, 0.5)),
        density=draw(st.floats(500.0, 8000.0)),
        base=base,
        top=top,
    )
    fraction = st.floats(0.001, 0.999)
    if top == "free":
        fraction = st.one_of(fraction, st.just(1.0))
    return column, draw(fraction) * column.height


@st.composite
def arranged_columns(draw):
    """A column with any of steps, springs, a top mass and embedment, and an impact height on it."""
    column, impact_height = draw(struck_columns())
    unit = column.flexural_rigidity / column.height**3
    ratio = st.floats(-3.0, 3.0).map(lambda power: 10.0**power)
    springs = {
        name: draw(ratio) * unit * column.height ** (2 * ("rotation" in name))
        for name in draw(st.sets(st.sampled_from(SPRINGS)))
    }
    heights = sorted(draw(st.sets(st.integers(1, 19), max_size=3)))
    steps = [Step(height=0.05 * i * column.height, section=draw(sections)) for i in heights]
    extras = {
        "steps": steps,
        "top_mass": draw(st.floats(0.0, 2.0)) * column.mass,
        "embedment": draw(st.sampled_from([0.0, 0.1, 0.5])) * column.height,
    }
    return dataclasses.replace(column, **springs, **extras), impact_height


def joints(column, impact_height):
    """The heights at which anything changes, in ascending order."""
    heights = {-column.embedment, impact_height, column.height}
    return sorted(heights | {step.height for step in column.steps})
