"""Columns for tests over generated inputs."""

from hypothesis import settings
from hypothesis import strategies as st

from pierimpact import CircularSection, PierColumn, RectangularSection

STABLE = [
    ("fixed", "fixed"),
    ("fixed", "pinned"),
    ("fixed", "free"),
    ("pinned", "fixed"),
    ("pinned", "pinned"),
    ("free", "fixed"),
]
MECHANISMS = [("pinned", "free"), ("free", "pinned"), ("free", "free")]

GENERATED = settings(max_examples=150)

sizes = st.floats(0.1, 10.0)
shear_coefficients = st.floats(0.3, 1.0)
sections = st.one_of(
    st.builds(CircularSection, diameter=sizes, shear_coefficient=shear_coefficients),
    st.builds(RectangularSection, width=sizes, depth=sizes, shear_coefficient=shear_coefficients),
)


def round_column(height, diameter, base="fixed", top="pinned", modulus=28e9):
    """A round column of concrete."""
    return PierColumn(
        height=height,
        section=CircularSection(diameter=diameter),
        elastic_modulus=modulus,
        density=2450.0,
        base=base,
        top=top,
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
