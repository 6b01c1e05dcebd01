import base64
import io
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from pierimpact.plots.style import panel, round_out, round_up
from pierimpact.teaching.live import LiveFigure

drawn = []


def curve(axes, level, top):
    drawn.append("curve")
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, top))
    axes.plot([0.0, 0.5, 1.0], [0.0, level, 0.0], color="blue")
    axes.text(0.2, level, f"{level:g}")


def marker(axes, x):
    drawn.append("marker")
    axes.axvline(x, color="red")


def figure():
    drawn.clear()
    return LiveFigure("A curve", (120.0, 80.0), lambda f: panel(f, "T", "x", "y"), curve, marker)


def dots(live):
    return np.asarray(live._canvas.buffer_rgba()).copy()


STATES = st.tuples(
    st.sampled_from([0.2, 0.5, 0.9]), st.sampled_from([1.0, 2.0]), st.sampled_from([0.1, 0.6])
)


@settings(max_examples=20)
@given(states=st.lists(STATES, min_size=1, max_size=5))
def test_a_figure_redrawn_in_part_is_the_figure_drawn_anew(states):
    live, afresh = figure(), figure()
    for level, top, x in states:
        live.show((level, top), (x,))
    afresh.show(states[-1][:2], (states[-1][2],))
    assert np.array_equal(dots(live), dots(afresh))


def test_what_is_not_new_is_not_drawn_again():
    live = figure()
    level, top, x, y = 0.5, 1.0, 0.25, 0.75
    live.show((level, top), (x,))
    live.show((level, top), (y,))
    assert drawn == ["curve", "marker", "marker"]
    live.show((level, top), (y,))
    assert drawn == ["curve", "marker", "marker"]


def test_a_layer_that_failed_is_drawn_when_it_is_shown_again():
    def failing(axes, value):
        if value < 0.0:
            raise ValueError
        axes.axhline(value)

    live = LiveFigure("Fails", (120.0, 80.0), lambda f: panel(f, "T", "x", "y"), failing)
    good, bad = 0.5, -0.5
    live.show((good,))
    before = dots(live)
    with pytest.raises(ValueError):  # noqa: PT011
        live.show((bad,))
    live.show((good,))
    assert np.array_equal(dots(live), before)


def test_the_picture_is_sharp_and_nearly_what_was_drawn():
    live = figure()
    live.show((0.5, 1.0), (0.25,))
    picture = Image.open(io.BytesIO(live.widget.value))
    assert picture.size == (240, 160)
    wrong = np.abs(np.asarray(picture.convert("RGB")).astype(int) - dots(live)[..., :3])
    assert wrong.max() < 25
    white = (dots(live)[..., :3] == 255).all(axis=2)
    assert np.all(np.asarray(picture.convert("RGB"))[white] == 255)


def test_a_still_is_the_picture_with_its_words():
    live = figure()
    live.show((0.5, 1.0), (0.25,))
    still = live.still("It rises & falls.")
    assert 'alt="A curve. It rises &amp; falls."' in still
    assert base64.b64decode(re.search('base64,(.*?)"', still)[1]) == live.widget.value


@given(value=st.floats(1e-6, 1e9))
def test_an_axis_ends_at_a_round_number_not_far_above(value):
    end = round_up(value)
    assert 0.999 * value <= end <= 1.34 * value
    assert round_up(end) == pytest.approx(end)


@given(value=st.floats(1e-3, 1e5))
def test_a_logarithmic_axis_holds_what_lies_beyond(value):
    low, high = round_out(2.0, 200.0, value)
    assert low < value < high
    assert low <= 2.0
    assert high >= 200.0
    if 2.2 < value < 180.0:
        assert (low, high) == (2.0, 200.0)
