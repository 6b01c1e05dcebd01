"""The page without Python in Firefox, over its own WebDriver BiDi: no other driver is needed."""

import json
import re
import shutil
import subprocess
import time
from itertools import count

import numpy as np
import pytest
from test_page import CASES, LABELS, OUTCOMES, agree, as_arguments, peaks_at

from pierimpact import load_truck
from pierimpact.files.trucks import truck_names
from pierimpact.teaching import page as pages

FIREFOX = shutil.which("firefox-esr") or shutil.which("firefox")
websocket = pytest.importorskip("websocket")  # selenium brings it along
pytestmark = pytest.mark.skipif(not FIREFOX, reason="no Firefox: apt-get install firefox-esr")
PATIENCE = 300  # only a browser that hangs takes longer [s]
ARROW_RIGHT = "\ue014"


class Firefox:
    """A Firefox without a window, with one page."""

    def __init__(self, folder):
        self.log = folder / "log"
        command = [FIREFOX, "--headless", "--no-remote", "--remote-debugging-port=0"]
        with self.log.open("w") as log:
            self.process = subprocess.Popen(
                [*command, "--profile", str(folder)], stdout=log, stderr=log
            )
        end = time.monotonic() + PATIENCE
        while not (said := re.search(r"BiDi listening on (ws://\S+)", self.log.read_text())):
            assert time.monotonic() < end, self.log.read_text()
            time.sleep(0.1)
        self.numbers = count()
        self.socket = websocket.create_connection(
            f"{said[1]}/session", timeout=PATIENCE, suppress_origin=True
        )
        self.ask("session.new", capabilities={})
        self.context = self.ask("browsingContext.getTree")["contexts"][0]["context"]

    def ask(self, method, **parameters):
        """Send a command and return its result."""
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "method": method, "params": parameters}))
        while (answer := json.loads(self.socket.recv())).get("id") != number:
            pass
        assert answer["type"] == "success", answer
        return answer["result"]

    def load(self, address, width=1280, height=720):
        size = {"width": width, "height": height}
        self.ask("browsingContext.setViewport", context=self.context, viewport=size)
        self.ask("browsingContext.navigate", context=self.context, url=address, wait="complete")

    def run(self, body):
        """Return what the body of a function returns in the page."""
        answer = self.ask(
            "script.evaluate",
            expression=f"(async () => {{ {body} }})().then((it) => JSON.stringify(it ?? null))",
            target={"context": self.context},
            awaitPromise=True,
        )
        assert answer["type"] == "success", answer
        return json.loads(answer["result"]["value"])

    def press(self, selector, key):
        self.run(f"document.querySelector('{selector}').focus()")
        actions = [{"type": kind, "value": key} for kind in ("keyDown", "keyUp")]
        source = {"type": "key", "id": "keys", "actions": actions}
        self.ask("input.performActions", context=self.context, actions=[source])

    def close(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait(timeout=PATIENCE)


@pytest.fixture(scope="module")
def firefox(tmp_path_factory):
    driver = Firefox(tmp_path_factory.mktemp("firefox"))
    yield driver
    driver.close()


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    return pages.write_page(folder / "page.html", truck_names()).as_uri()


SKIP = "localStorage.clear(); document.querySelector('#again').click(); "
SKIP += "document.querySelector('#gate .plain').click();"
PICTURE = "await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));"


def test_it_solves_what_the_package_solves(firefox, address):
    firefox.load(address)
    cases = json.dumps([as_arguments(case) for case in CASES])
    agree(firefox.run(f"const {{ simulate }} = pierimpact, cases = {cases}; return {OUTCOMES}"))


def test_a_key_moves_the_slider_and_the_sentence(firefox, address):
    firefox.load(address)
    firefox.run(SKIP)
    firefox.press("#speed", ARROW_RIGHT)
    words = firefox.run(f"{PICTURE} return document.querySelector('#cargo-peak').textContent")
    peaks = peaks_at(load_truck("single-unit-8t"), np.array([30.0]), 81.0 / 3.6)
    assert words == f"{peaks.cargo[0] / 1e6:.2f} MN"


def test_the_lines_show_once_a_prediction_is_locked(firefox, address):
    firefox.load(address)
    firefox.run("localStorage.clear(); document.querySelector('#again').click();")
    shown = "return document.querySelector('#chart').clientHeight > 100"
    assert not firefox.run(shown)
    firefox.run(
        "document.querySelectorAll('#gate input')[2].click();"
        "document.querySelector('#gate .main').click();"
    )
    assert firefox.run(PICTURE + shown)
    assert firefox.run("return document.querySelector('#lead').textContent").startswith("As you")


@pytest.mark.parametrize("width", [400, 1280])
def test_labels_keep_clear_and_nothing_is_cut(firefox, address, width):
    firefox.load(address, width)
    firefox.run(SKIP)
    assert firefox.run("return document.documentElement.scrollWidth") <= width
    found = f"new Promise((done) => (async (...arguments) => {{ {LABELS} }})(done))"
    assert firefox.run(f"return await {found}") == [48, []]
