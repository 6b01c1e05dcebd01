"""The explorers in a real browser: JupyterLab on loopback, headless Chromium, sliders that move."""

import contextlib
import hashlib
import math
import os
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from pierimpact.teaching.questions import LESSONS as COURSE
from pierimpact.teaching.questions import questions as questions_of
from pierimpact.teaching.scenario import Scenario
from pierimpact.units import DIMENSIONS, printed

webdriver = pytest.importorskip("selenium.webdriver")
StaleElementReferenceException = pytest.importorskip(
    "selenium.common.exceptions"
).StaleElementReferenceException
CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
pytestmark = pytest.mark.skipif(
    not (CHROMIUM and DRIVER), reason="no browser: apt-get install chromium chromium-driver"
)
HOUSE = Path(__file__).parents[1]
LESSONS = sorted(path.stem for path in (HOUSE / "notebooks").glob("0*.ipynb"))
TOKEN = "for-loopback-only"
PATIENCE = 600  # only a server, a kernel or a page that hangs takes longer [s]
ASK_AGAIN = 20  # for what a page lost [s]
OPTIONS = (
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--window-size=1500,4000",
)  # fmt: skip


def until(condition):
    """Return what `condition` returns as soon as it is true."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        # What the kernel replaces while it is being looked at is looked at again.
        with contextlib.suppress(StaleElementReferenceException):
            if found := condition():
                return found
        time.sleep(0.1)
    pytest.fail(f"waited {PATIENCE} s in vain")


@contextlib.contextmanager
def served(folder, module, *options):
    """Serve copies of the notebooks from a folder by a Jupyter server; give its address."""
    for notebook in (HOUSE / "notebooks").glob("*.ipynb"):
        shutil.copy(notebook, folder)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    private = {
        name: str(folder / f".{name}")
        for name in ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR",
                     "JUPYTERLAB_SETTINGS_DIR", "JUPYTERLAB_WORKSPACES_DIR")
    }  # fmt: skip
    command = [sys.executable, "-m", module, "--no-browser", f"--port={port}", *options]
    address = f"http://127.0.0.1:{port}"

    def answers():
        assert process.poll() is None, (folder / "log").read_text()
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), 5):
            return True
        return False

    with (folder / "log").open("w") as log:
        environment = os.environ | private | {"PYTHONPATH": str(HOUSE)}
        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log)
        try:
            until(answers)
            yield address
        finally:
            process.terminate()
            process.wait(timeout=PATIENCE)


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lab")
    options = ("--allow-root", "--ip=127.0.0.1", f"--IdentityProvider.token={TOKEN}",
               f"--ServerApp.root_dir={folder}")  # fmt: skip
    with served(folder, "jupyterlab", *options) as address:
        yield address


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for option in (*OPTIONS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(option)
    service = webdriver.ChromeService(executable_path=DRIVER)
    driver = webdriver.Chrome(options=options, service=service)
    yield driver
    driver.quit()


class Page:
    """A page with an explorer."""

    def __init__(self, browser):
        self.browser = browser

    def holds_no_error(self):
        for kind in ("error", "stderr"):
            assert not self.all(f"[data-mime-type='application/vnd.jupyter.{kind}']")
        assert not self.all(".jupyter-widgets-error-widget")

    def all(self, selector):
        return self.browser.find_elements("css selector", selector)

    def one(self, selector):
        return until(lambda: self.all(selector))[0]

    def slider(self, words):
        """Return the handle of the slider under these words."""
        return self.browser.find_element(
            "xpath",
            f"//div[contains(@class, 'widget-html')][contains(., '{words}')]"
            "/following-sibling::div//div[contains(@class, 'noUi-handle')]",
        )

    def press(self, slider, key, times):
        """Press a key on a slider's handle; each press has to move it before the next one."""

        def moved():
            return slider().get_attribute("aria-valuenow") != before

        for _ in range(times):
            before = until(lambda: slider().get_attribute("aria-valuenow"))
            until(lambda: self.browser.execute_script("arguments[0].focus()", slider()) is None)
            slider().send_keys(key)
            until(moved)

    def push(self, words):
        """Press the button with these words."""

        def pushed():
            for button in self.all(".pierimpact-live button"):
                if button.text == words:
                    button.click()
                    return True
            return False

        until(pushed)

    def beside(self, words, what):
        """Return the box or list beside these words."""
        return self.browser.find_element(
            "xpath",
            f"//div[contains(@class, 'widget-html')][contains(., '{words}')]"
            f"/following-sibling::div//{what}",
        )

    def choose(self, words, choice):
        self.beside(words, f"option[. = '{choice}']").click()

    def tick(self, choice):
        """Tick the radio button with these words."""

        def ticked():
            for label in self.all(".pierimpact-live .widget-radio-box label"):
                if label.text.strip() == choice:
                    label.click()
                    return True
            return False

        until(ticked)

    def type(self, words, text):
        self.fill(self.beside(words, "input"), text)

    def fill(self, box, text):
        keys = webdriver.Keys
        box.send_keys(keys.CONTROL, "a")
        box.send_keys(text, keys.ENTER)

    def readout(self):
        return until(lambda: self.one(".pierimpact-live").text)

    def alerts(self):
        """Return the sentences shown in place of the figures."""
        return [alert.text for alert in self.all(".pierimpact-live [role=alert]")]

    def figures(self):
        return self.all(".pierimpact-live img")

    def pixels(self):
        """Return a digest of what each of the explorer's figures looks like."""
        return [hashlib.sha256(figure.screenshot_as_png).hexdigest() for figure in self.figures()]


class Lesson(Page):
    """A notebook in JupyterLab, all of it run."""

    def __init__(self, browser, server, name):
        super().__init__(browser)
        browser.get(f"{server}/lab/tree/{name}.ipynb?token={TOKEN}&reset")
        until(lambda: self.all(".jp-NotebookPanel .jp-Cell"))
        self.asked = -math.inf
        until(self.has_run)

    def has_run(self):
        """Return the figures, asking for a run where the kernel rests without having made any.

        A page that is still loading loses a click now and then, and a kernel that dies at its start
        is started anew by JupyterLab: both are asked once more.
        """
        status = self.one(".jp-Notebook-ExecutionIndicator").get_attribute("data-status")
        rests = "idle" in status and time.monotonic() > self.asked + ASK_AGAIN
        if not self.figures() and rests and self.run_all():
            self.asked = time.monotonic()
        return self.figures()

    def run_all(self):
        self.all("body")[0].send_keys(webdriver.Keys.ESCAPE)  # a menu that is open would close
        (menu,) = [item for item in self.all("li.lm-MenuBar-item") if item.text == "Run"]
        menu.click()
        for item in self.all(".lm-Menu-item[data-command='runmenu:run-all']"):
            item.click()
            return True
        return False

    def text(self):
        return until(lambda: self.one(".jp-Notebook").text)


@pytest.fixture(scope="module")
def explorer(browser, server):
    return Lesson(browser, server, "explorer")


@pytest.fixture
def page(explorer):
    """Return the explorer at its defaults, whatever the test before left behind."""
    explorer.push("Reset")
    until(lambda: explorer.readout().count(force(Scenario().history.engine_peak.reaction)))
    until(lambda: all(figure.is_displayed() for figure in explorer.figures()))
    return explorer


def force(value):
    return str(printed(value, "force", "SI"))


def test_the_still_is_hidden_beside_the_live_explorer(page):
    assert not page.one(".pierimpact-still").is_displayed()


def test_the_figures_follow_a_slider_with_the_packages_values(page):
    keys = webdriver.Keys
    before = page.pixels()
    assert len(before) == 5  # picture, forces, energy and two spectra
    assert force(Scenario().history.engine_peak.reaction) in page.readout()
    page.press(lambda: page.slider("Speed at first touch"), keys.ARROW_LEFT, 10)
    history = Scenario(speed=70.0 / 3.6).history
    until(lambda: force(history.engine_peak.reaction) in page.readout())
    assert force(history.cargo_peak.reaction) in page.readout()
    until(lambda: all(old != new for old, new in zip(before, page.pixels(), strict=True)))
    page.press(lambda: page.slider("Speed at first touch"), keys.ARROW_RIGHT, 10)
    until(lambda: force(Scenario().history.engine_peak.reaction) in page.readout())


def test_the_animation_can_be_scrubbed_and_played(page):
    keys = webdriver.Keys
    history = Scenario().history

    def shown(reaction):
        return lambda: f"R = {force(reaction)}." in page.readout()

    page.push("Cargo peak")
    until(shown(history.cargo_peak.reaction))
    assert f"{1e3 * history.cargo_peak.time:.1f} ms" in page.readout()
    picture, forces, engine, energy, cargo = page.pixels()
    handle = ".pierimpact-live .widget-play + .widget-slider .noUi-handle"
    page.press(lambda: page.one(handle), keys.ARROW_LEFT, 20)
    until(lambda: f"R = {force(history.cargo_peak.reaction)}." not in page.readout())
    until(lambda: page.pixels()[0] != picture)
    until(lambda: forces not in page.pixels() and energy not in page.pixels())
    assert engine in page.pixels()  # a spectrum does not show time
    assert cargo in page.pixels()
    page.push("First touch")
    until(shown(0.0))
    picture = page.pixels()[0]
    page.one(".pierimpact-live .widget-play button").click()
    until(lambda: page.pixels()[0] != picture)


def test_a_mechanism_is_said_in_a_sentence_where_the_figures_were(page):
    page.choose("Base", "free")
    until(lambda: any("mechanism" in alert for alert in page.alerts()))
    until(lambda: not any(figure.is_displayed() for figure in page.figures()))
    page.push("Reset")
    until(lambda: all(figure.is_displayed() for figure in page.figures()))


def test_no_contact_is_said_in_a_sentence(page):
    page.type("Speed at first touch", "20 km/h")
    until(lambda: "Neither engine nor cargo reaches the pier" in page.readout())
    page.push("Reset")
    until(lambda: "The engine governs" in page.readout())


def test_nonsense_is_answered_in_a_sentence(page):
    page.type("Speed at first touch", "fast")
    until(lambda: any("must be a speed" in alert for alert in page.alerts()))
    page.push("Reset")
    until(lambda: not page.alerts())


def test_no_error_reached_the_notebook(page):
    page.holds_no_error()


@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_runs_and_its_exercises_answer(browser, server, name):
    lesson = Lesson(browser, server, name)
    subject = name.partition("_")[2]
    questions = questions_of(subject)
    until(lambda: f"0 of {len(questions)} solved" in lesson.text())
    question = next(question for question in questions if not question.choices)
    box = lesson.one(".pierimpact-live input[placeholder*='number']")
    unit = f" {DIMENSIONS[question.dimension].si}" if question.dimension else ""
    lesson.fill(box, f"{1e3 * question.answer:.6g}{unit}")
    until(lambda: "out by 1000" in lesson.text())
    lesson.fill(box, f"{question.answer:.6g}{unit}")
    until(lambda: f"1 of {len(questions)} solved" in lesson.text())
    until(lambda: "solved after 2 tries" in lesson.text())
    assert not any(figure.is_displayed() for figure in lesson.figures()[:1])
    right = COURSE[subject].prediction.answer()
    lesson.tick(right)
    lesson.push("Lock my prediction")
    until(lambda: f"You predicted: {right}" in lesson.text())
    until(lambda: lesson.figures()[0].is_displayed())
    lesson.holds_no_error()


def test_voila_serves_the_explorer_without_code(browser, tmp_path):
    pytest.importorskip("voila")
    with served(tmp_path, "voila", "--Voila.ip=127.0.0.1", "explorer.ipynb") as address:
        browser.get(address)
        app = Page(browser)
        until(app.figures)
        assert not app.all(".jp-CodeCell .jp-InputArea-editor")
        assert not app.one(".pierimpact-still").is_displayed()
        app.type("Speed at first touch", "70 km/h")
        history = Scenario(speed=70.0 / 3.6).history
        until(lambda: force(history.cargo_peak.reaction) in app.readout())
        app.holds_no_error()
