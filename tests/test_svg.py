"""Figures as SVG: the same bytes as matplotlib's own way, whatever was drawn before."""

import io
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from matplotlib import rc_context
from matplotlib.backends.backend_svg import RendererSVG
from matplotlib.figure import Figure

from pierimpact.plots.style import SCREEN, page_figure, sheet_figure
from pierimpact.plots.svg import size_of, to_svg

WORDS = (
    "0", "2 000", "Reaction [kN]", "reaction $R$", "$z_\\mathrm{n}$ = 1.2 m", "two\nlines",
    "$k_{\\mathrm{u}1}$ = 900 MN/m", "×$10^{-3}$", "é, ½ and —", "$\\delta_2$, not to scale",
)  # fmt: skip


def drawn(seed, style=page_figure):
    """Return a figure with words of random sizes and angles, a curve and a picture."""
    random = np.random.default_rng(seed)
    options = {"width": 80.0, "height": 60.0} if style is page_figure else {"height": 3.0}
    with style(**options) as figure:
        axes = figure.add_axes((0.1, 0.1, 0.8, 0.8))
        axes.plot(random.random(9), linestyle=random.choice(["-", ":"]))
        axes.scatter(random.random(9), random.random(9), rasterized=bool(random.integers(2)))
        axes.set_xlabel(random.choice(WORDS))
        for words in random.choice(WORDS, 8):
            place, size = random.random(2), random.choice([7.0, 8.0, 11.0])
            axes.text(*place, words, size=size, rotation=random.choice([0.0, 30.0, 90.0]))
        figure.set_dpi(random.choice([72.0, 100.0, 144.0]))
        return figure


def by_matplotlib(figure):
    file = io.StringIO()
    figure.savefig(file, format="svg", metadata={"Date": None})
    return file.getvalue()


def in_style(figure, write):
    with page_figure(1.0, 1.0):
        return write(figure)


@pytest.mark.parametrize("style", [page_figure, sheet_figure])
@pytest.mark.parametrize("seed", range(20))
def test_a_figure_is_that_of_matplotlib_to_the_byte(seed, style):
    figure = drawn(seed, style)
    dots = figure.dpi
    assert in_style(figure, to_svg) == in_style(figure, by_matplotlib)
    assert figure.dpi == dots


def test_a_figure_is_the_same_again_and_in_another_style_between():
    figure = drawn(1)
    first = in_style(figure, to_svg)
    with rc_context(SCREEN):
        other = Figure()
        other.text(0.5, 0.5, WORDS[4])
        assert to_svg(other) != first
    assert in_style(figure, to_svg) == first


def test_threads_draw_the_same():
    def svg(seed):
        return to_svg(figures[seed])

    with page_figure(1.0, 1.0):
        figures = {seed: drawn(seed) for seed in range(24)}
        expected = [svg(seed) for seed in figures]
        with ThreadPoolExecutor(4) as executor:
            assert list(executor.map(svg, figures)) == expected


@pytest.mark.parametrize("words", WORDS)
def test_words_have_the_size_of_matplotlib_in_points(words):
    for seed, dots in enumerate((72.0, 100.0)):
        figure = drawn(seed)
        figure.set_dpi(dots)
        text = figure.text(0.3, 0.4, words, size=9.0)
        measured = size_of(text)
        alone = RendererSVG(1.0, 1.0, io.StringIO())
        extent = text.get_window_extent(alone, 72.0)
        assert measured == pytest.approx((extent.width, extent.height), rel=1e-9)
