"""No words of a figure of the sheet lie on other words, on lines or beyond its edge."""

from unittest.mock import patch

import pytest
from figure_collisions import collisions
from generated_collisions import collisions as generated
from generated_columns import arranged_columns
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure

from pierimpact import load_truck, simulate
from pierimpact.plots import crush, history, shape, situation

SYSTEMS = st.sampled_from(["SI", "US"])
# Without shrinking, which would take minutes.
SOME = settings(max_examples=10, phases=[Phase.generate])
TRUCKS = [load_truck(name) for name in ("single-unit-8t", "tractor-trailer-36t")]


def figure_of(draw, *arguments):
    """Return the figure that a function draws, instead of its SVG."""
    with patch.dict(draw.__globals__, to_svg=lambda figure: figure):
        return draw(*arguments)


def test_collisions_are_found():
    figure = Figure(figsize=(6.0, 4.0))
    axes = figure.add_subplot()
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    axes.text(0.5, 0.5, "in the clear")
    assert collisions(figure) == []
    axes.plot([0.1, 0.9], [0.2, 0.2])
    axes.text(0.3, 0.18, "on a line")
    axes.text(0.55, 0.52, "over it")
    axes.text(0.99, 0.8, "beyond the edge")
    axes.text(0.1, 0.8, "tiny", fontsize=5.0)
    found = "; ".join(collisions(figure))
    for words in (
        "'on a line' on Line2D",
        "'over it' on 'in",
        "edge' is cut off",
        "tiny' is small",
    ):
        assert words in found


@SOME
@given(arranged_columns(), st.sampled_from(TRUCKS), st.floats(1e4, 9e7), SYSTEMS)
def test_the_situation_is_clear(case, truck, reaction, system):
    column, height = case
    drawn = figure_of(situation.draw_situation, column, height, truck, reaction, system)
    assert collisions(drawn) == []


@SOME
@given(arranged_columns(), SYSTEMS)
def test_the_shape_is_clear(case, system):
    column, height = case
    drawn = figure_of(shape.draw_shape_function, column.struck_at(height), system)
    assert collisions(drawn) == []


@pytest.mark.parametrize("system", ["SI", "US"])
def test_the_crush_curves_are_clear(system):
    for truck in (*TRUCKS, *(case.truck for case in generated(1, seed=1))):
        assert collisions(figure_of(crush.draw_crush_curves, truck, system)) == []


@pytest.mark.parametrize("number", range(6))
def test_the_history_is_clear(number):
    case = generated(6, seed=2)[number]
    found = simulate(case.truck, case.pier, case.speed)
    assert collisions(figure_of(history.draw_history, found, "SI")) == []
