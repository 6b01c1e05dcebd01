"""The explorers in a real browser: JupyterLab on loopback, headless Chromium, sliders that move."""

import contextlib
import json
import math
import os
import shutil
import socket
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path
from urllib.request import Request, urlopen

import pytest

from pierimpact.teaching.questions import LESSONS as COURSE
from pierimpact.teaching.questions import questions as questions_of
from pierimpact.teaching.scenario import Scenario
from pierimpact.units import DIMENSIONS

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

    def control(self, name, part="", explorer=0):
        """Return a control of one of the explorers of the page, by the name of its variable."""
        return self.all(".pierimpact")[explorer].find_element(
            "css selector", f".explorer [id$='-{name}{part}']"
        )

    def press(self, name, key, times=1, explorer=0):
        """Press a key on a slider."""
        for _ in range(times):
            slider = until(lambda: self.control(name, explorer=explorer))
            self.browser.execute_script("arguments[0].focus({preventScroll: true})", slider)
            slider.send_keys(key)

    def push(self, words):
        """Press the button with these words."""

        def pushed():
            for button in self.all(".pierimpact-live button"):
                if button.text == words:
                    button.click()
                    return True
            return False

        until(pushed)

    def tick(self, choice):
        """Tick the radio button with these words."""

        def ticked():
            for label in self.all(".pierimpact-live .widget-radio-box label"):
                if label.text.strip() == choice:
                    label.click()
                    return True
            return False

        until(ticked)

    def choose(self, name, choice):
        self.control(name).find_element("xpath", f"option[. = '{choice}']").click()

    def type(self, name, text):
        self.fill(self.control(name, "-value"), text)

    def fill(self, box, text):
        keys = webdriver.Keys
        box.send_keys(keys.CONTROL, "a")
        box.send_keys(text, keys.ENTER)

    def readout(self):
        """Return the sentence of a collision, or of charts that Python calculates."""
        return until(lambda: self.one(".pierimpact .sentence, .pierimpact .readout").text)

    def alerts(self):
        """Return the sentences shown in place of the figures."""
        alerts = [alert.text for alert in self.all(".pierimpact .refusal")]
        return [words for words in alerts if words]

    def figures(self):
        return self.all(".pierimpact svg[role=img]")

    def drawn(self):
        """Return what each of the explorer's figures consists of."""
        return [figure.get_attribute("innerHTML") for figure in self.figures()]


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
    until(lambda: mega(Scenario().history.engine_peak) in explorer.readout())
    return explorer


def mega(peak):
    return f"{peak.reaction / 1e6:.2f} MN"


def test_the_still_is_hidden_beside_the_live_explorer(page):
    assert not page.one(".pierimpact-still").is_displayed()


def test_the_figures_follow_a_slider_with_the_packages_values(page):
    keys = webdriver.Keys
    before = page.drawn()
    assert len(before) == 4  # spectra, picture, forces and energy
    page.press("speed", keys.ARROW_LEFT, 10)
    history = Scenario(speed=70.0 / 3.6).history
    until(lambda: mega(history.engine_peak) in page.readout())
    assert mega(history.cargo_peak) in page.readout()
    assert all(old != new for old, new in zip(before, page.drawn(), strict=True))


def test_the_pier_is_a_column_until_its_frequency_is_set(page):
    keys = webdriver.Keys
    page.press("pier_frequency", keys.ARROW_LEFT)
    words = page.control("pier_frequency").get_attribute("aria-valuetext")
    frequency = 2.0 * 10.0 ** (
        0.01 * round(100.0 * math.log10(Scenario().pier.frequency / 2.0)) - 0.01
    )
    assert words == f"{frequency:.1f} hertz"
    pier = {"pier_frequency": frequency, "pier_mass": Scenario().pier.mass}
    until(lambda: mega(Scenario(**pier).history.engine_peak) in page.readout())
    for drawer in page.all(".pierimpact summary"):
        drawer.click()
    page.choose("top", "fixed")
    until(lambda: mega(Scenario(top="fixed").history.engine_peak) in page.readout())
    for drawer in page.all(".pierimpact summary"):
        drawer.click()


def test_the_kernel_knows_the_values(page):
    page.type("speed", "45 mph")
    until(lambda: "72.42 km/h" in page.control("speed", "-value").get_attribute("value"))
    page.push("Copy as case file")
    until(lambda: "speed: 72.420480 km/h"[:12] in page.one(".pierimpact pre").text)
    assert "speed: 72.42048 km/h" in page.one(".pierimpact pre").text


def test_the_animation_can_be_scrubbed_and_played(page):
    keys = webdriver.Keys
    page.push("Cargo’s peak")
    history = Scenario().history
    picture = page.one(".picture")
    until(lambda: f"R = {mega(history.cargo_peak)}" in picture.text)
    spectra, *others = page.drawn()
    page.press("instant", keys.ARROW_LEFT, 20)
    until(lambda: all(old != new for old, new in zip(others, page.drawn()[1:], strict=True)))
    assert page.drawn()[0] == spectra  # a spectrum does not show time
    page.press("instant", keys.HOME)
    until(lambda: "R = 0.00 MN" in picture.text)
    page.push("Play")
    until(lambda: "R = 0.00 MN" not in picture.text)
    page.push("Pause")


def test_a_mechanism_is_said_in_a_sentence(page):
    for drawer in page.all(".pierimpact summary"):
        drawer.click()
    page.choose("base", "free")
    until(lambda: any("mechanism" in alert for alert in page.alerts()))
    page.push("Reset")
    until(lambda: not page.alerts())
    for drawer in page.all(".pierimpact summary"):
        drawer.click()


def test_no_contact_is_said_in_a_sentence(page):
    page.type("speed", "20 km/h")
    until(lambda: "neither engine nor cargo arrives" in page.readout())


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("fast", "must be a number with a unit (km/h, m/s, mph)"),
        ("80 kN", "must be a number with a unit"),
        ("-3 km/h", "must be from 1 km/h to 1300 km/h"),
        ("<img src=x>", "“<img src=x>”"),
    ],
)
def test_nonsense_is_answered_in_a_sentence(page, typed, said):
    page.type("speed", typed)
    until(lambda: any(said in alert for alert in page.alerts()))
    page.push("Reset")
    until(lambda: not page.alerts())


def test_no_error_reached_the_notebook(page):
    page.holds_no_error()


AXE = Path(find_spec("axe_core_python").origin).parent / "axe.min.js"
FAULTS = """
const [scope, done] = arguments;
axe.run(scope, { resultTypes: ["violations"] }).then(({ violations }) => done(violations
  .filter(({ impact }) => impact === "serious" || impact === "critical")
  .flatMap(({ help, nodes }) => nodes.map(({ html }) => `${help}: ${html.slice(0, 200)}`))));
"""


def faults(browser, scope="body"):
    """Return what hinders those who do not see or point, as axe-core finds it."""
    browser.set_script_timeout(PATIENCE)
    browser.execute_script(AXE.read_text(encoding="utf-8"))
    return browser.execute_async_script(FAULTS, scope)


# The ground and the text of JupyterLab's themes.
THEMES = {"light": ("true", "#fff", "#000000de"), "dark": ("false", "#111", "#ffffffde")}
PUT_ON = """
const [light, ground, text] = arguments[0];
document.body.dataset.jpThemeLight = light;
document.body.style.setProperty("--jp-layout-color0", ground);
document.body.style.setProperty("--jp-ui-font-color1", text);
"""


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_nothing_hinders_those_who_do_not_see_or_point(page, theme):
    page.browser.execute_script(PUT_ON, THEMES[theme])
    assert faults(page.browser, ".pierimpact-live") == []


def test_a_saved_notebook_shows_its_explorer_without_a_kernel(browser, server, page):
    """After all that uses the explorer: its kernel is shut down."""
    page.all("body")[0].send_keys(webdriver.Keys.CONTROL, "s")
    until(lambda: not page.all(".jp-mod-dirty"))
    headers = {"Authorization": f"token {TOKEN}"}
    with urlopen(Request(f"{server}/api/sessions", headers=headers)) as answer:
        (session,) = json.load(answer)
    urlopen(Request(f"{server}/api/sessions/{session['id']}", headers=headers, method="DELETE"))
    browser.get(f"{server}/lab/tree/explorer.ipynb?token={TOKEN}&reset")
    frame = page.one(".pierimpact-still iframe")
    until(frame.is_displayed)
    assert "not found" not in page.one(".jp-Notebook").text
    browser.switch_to.frame(frame)
    try:
        until(lambda: mega(Scenario().history.engine_peak) in page.readout())
        page.press("speed", webdriver.Keys.ARROW_LEFT, 10)
        until(lambda: mega(Scenario(speed=70.0 / 3.6).history.engine_peak) in page.readout())
    finally:
        browser.switch_to.default_content()


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
    assert not lesson.all(".pierimpact .controls")[0].is_displayed()
    for control in lesson.all(".pierimpact-live :is(input, select, button, summary)"):
        if control.is_displayed():
            name = control.accessible_name
            assert name.isprintable()  # an icon is not
            assert name not in ("", control.get_attribute("placeholder"))
    right = COURSE[subject].prediction.answer()
    lesson.tick(right)
    lesson.push("Lock my prediction")
    until(lambda: f"You predicted: {right}" in lesson.text())
    until(lambda: any(figure.is_displayed() for figure in lesson.figures()))
    lesson.holds_no_error()


def test_voila_serves_the_explorer_without_code(browser, tmp_path):
    pytest.importorskip("voila")
    with served(tmp_path, "voila", "--Voila.ip=127.0.0.1", "explorer.ipynb") as address:
        browser.get(address)
        app = Page(browser)
        until(app.figures)
        assert not app.all(".jp-CodeCell .jp-InputArea-editor")
        assert not app.one(".pierimpact-still").is_displayed()
        app.type("speed", "70 km/h")
        history = Scenario(speed=70.0 / 3.6).history
        until(lambda: mega(history.cargo_peak) in app.readout())
        app.holds_no_error()
        assert faults(browser) == []
        size = {"width": 1280, "height": 720, "deviceScaleFactor": 1, "mobile": False}
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        try:
            bottoms = (
                "return [...document.querySelectorAll('.aligned, .chart, .picture, .player')]"
                ".map((each) => each.getBoundingClientRect().bottom)"
            )
            until(lambda: max(browser.execute_script(bottoms)) <= 720.0)
        finally:
            browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
