"""Stills stand for dead widgets, and words can be read in a light and in a dark theme."""

import re

import pytest
from bs4 import BeautifulSoup

from pierimpact import exercises, predictions, widgets
from pierimpact.plots import style
from pierimpact.teaching import markup, work

DEAD = "Error displaying widget: model not found"


def hidden(page):
    """Return the elements that the rules of a still hide, as a browser finds them."""
    soup = BeautifulSoup(page, "html.parser")
    rules = re.findall(r"([^{}]+)\{display:none\}", soup.style.string)
    return soup, [found for rule in rules for found in soup.select(rule)]


def shows(page, text):
    soup, gone = hidden(page)
    element = [e for e in soup.find_all("div") if e.string == text][-1]  # the innermost
    return not any(around is e for around in (element, *element.parents) for e in gone)


def output(content, kind=""):
    """Return an output as JupyterLab wraps it: widgets alone bear no type."""
    typed = f' data-mime-type="{kind}"' if kind else ""
    return (
        f'<div class="lm-Widget jp-OutputArea-child"><div class="jp-OutputPrompt"></div>'
        f'<div class="lm-Widget jp-OutputArea-output"{typed}>{content}</div></div>'
    )


LIVE = output('<div class="lm-Widget widget-vbox pierimpact-live"><div>live</div></div>')
STILL = output(markup.still("<div>still</div>"), "text/html")
OTHER = output("<div>warned</div>", "application/vnd.jupyter.stderr")
GONE = output(f"<div>{DEAD}</div>")


def lab(*areas):
    cells = "".join(f'<div class="jp-OutputArea">{"".join(area)}</div>' for area in areas)
    return f'<body><div class="jp-NotebookPanel">{cells}</div></body>'


def test_in_a_running_notebook_the_widget_shows_and_the_still_does_not():
    page = lab([LIVE, STILL, OTHER])
    assert shows(page, "live")
    assert not shows(page, "still")
    assert shows(page, "warned")


def test_in_a_notebook_opened_again_the_still_shows_and_no_word_on_what_is_missing():
    page = lab([GONE, STILL, OTHER])
    assert shows(page, "still")
    assert not shows(page, DEAD)
    assert shows(page, "warned")


def test_a_widget_that_lost_its_kernel_gives_way_to_its_still():
    lost = LIVE.replace("pierimpact-live", "pierimpact-live jupyter-widgets-disconnected")
    page = lab([lost, STILL])
    assert shows(page, "still")
    assert not shows(page, "live")


def test_one_cell_may_live_while_another_is_dead():
    page = lab([LIVE, STILL.replace("still</div>", "still of the living</div>")], [GONE, STILL])
    assert shows(page, "live")
    assert not shows(page, "still of the living")
    assert shows(page, "still")
    assert not shows(page, DEAD)


def test_widgets_of_others_keep_their_words():
    assert shows(lab([GONE, STILL], [GONE.replace(DEAD, "theirs")]), "theirs")


def test_voila_shows_widgets_and_a_page_of_the_notebook_shows_stills():
    assert not shows(f'<body data-voila="voila">{LIVE}{STILL}</body>', "still")
    page = f'<body class="jp-Notebook"><div class="jp-OutputArea">{LIVE}{STILL}</div></body>'
    assert shows(page, "still")
    assert not shows(page, "live")


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    work.kept_work.cache_clear()


@pytest.fixture
def displayed(monkeypatch):
    """The last still of every output, as the notebook saves it."""
    stills = {}

    class Handle:
        def update(self, bundle, raw):
            stills[self] = bundle["text/html"]

    def display(content, raw=False, display_id=False, exclude=()):
        handle = Handle()
        if raw:
            handle.update(content, raw)
        return handle

    monkeypatch.setattr(markup, "display", display)
    return stills


def test_the_saved_still_has_the_latest_answer_and_score(desk, displayed):
    exercise, score, box = (
        exercises.ask("pier", 4),
        exercises.score("pier"),
        predictions.ask("pier"),
    )
    student = exercises.begin("pier")
    for shown in (student, exercise, score, box):
        shown._ipython_display_()
    assert "To be answered in the live notebook" in "".join(displayed.values())
    student.box.value = "Anna"
    exercise.box.value = exercise.question.answer
    exercise.answer()
    box.choice.value = box.choice.options[0]
    box.lock()
    saved = "".join(displayed.values())
    assert len(displayed) == 4
    for words in ("Anna", "✓", "1 of 4 solved", "Predicted:", "Worked solution"):
        assert words in saved
    assert "To be answered" not in saved


def luminance(colour):
    parts = [int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    light, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def test_all_words_take_the_colours_of_the_theme(desk):
    explorer = widgets.design()
    explorer.set(speed=130.0 / 3.6, truck_mass=40e3)
    exercise = exercises.ask("pier", 3)
    exercise.box.value = "3 Hz"
    pieces = [
        markup.refusal("no"),
        exercise.words.value,
        exercise.feedback.value,
        exercises.score("pier").board.value,
        exercises.begin("pier").message.value,
        predictions.ask("pier").widget.children[0].value,
    ]
    found = set()
    for piece in pieces:
        assert "color:" in piece
        found |= set(re.findall(r"(?:color|background):([^;\"]+)", piece))
    of_theme = {colour for colour in found if colour.startswith("var(--jp-")}
    assert {markup.INK, markup.MUTED, markup.GROUND} <= of_theme
    assert all(re.fullmatch(r"var\(--jp-[\w-]+, #[0-9a-f]{6}\)", colour) for colour in of_theme)
    # Marks and headings of rows, which are large or bold: three to one on white and on dark.
    for colour in found - of_theme:
        assert colour in (style.GREEN, *style.BODIES.values())
        assert min(contrast(colour, ground) for ground in ("#ffffff", "#111111")) > 3.0


def test_words_without_a_theme_can_be_read():
    for colour in (markup.INK, markup.MUTED):
        fallback = re.search("#[0-9a-f]{6}", colour)[0]
        assert contrast(fallback, "#ffffff") > 4.5
        assert contrast(fallback, re.search("#[0-9a-f]{6}", markup.GROUND)[0]) > 4.5
