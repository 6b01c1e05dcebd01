"""From a key to the picture, in a real browser: python benchmarks/latency.py [EXPLORER ...].

Serves each explorer by Voilà and presses an arrow key on each of its sliders. Prints the medians of
the milliseconds from the key to the frame with the last changed picture, and to the first; then the
pictures a second while the slider is dragged, and while the collision is played. A hand that moves
a slider does not notice 100 ms. Needs Chromium and its driver.
"""

import os
import shutil
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

import nbformat
from selenium import webdriver

EXPLORERS = ("collision", "pier", "reduction", "spectra", "design", "sensitivity", "full")
PRESSES = 12
QUIET = 0.6  # after which no more changes are expected [s]
PATIENCE = 120.0  # [s]
HOUSE = Path(__file__).parents[1]
ARROWS = ("\ue014", "\ue012")  # right and left

# Notes the time of each key, and of each frame after which a picture has changed.
WATCH = """
window.seen = { key: 0, frames: [] };
document.addEventListener("keydown", () => {
  seen.key = performance.now();
  seen.frames = [];
}, true);
let waiting = false;
new MutationObserver((changes) => {
  const picture = (each) => each.target.closest?.("svg[role=img], img");
  if (waiting || !changes.some(picture)) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    seen.frames.push(performance.now());
  });
}).observe(document.body, { subtree: true, childList: true, attributes: true });
"""

DRAG = """
const [slider, seconds, done] = arguments, start = performance.now();
seen.frames = [];
let step = 0;
const move = () => {
  step += 1;
  slider.value = Number(slider.max) * (0.5 + 0.4 * Math.sin(0.05 * step));
  slider.dispatchEvent(new Event("input"));
  if (performance.now() - start < 1e3 * seconds) setTimeout(move, 16);
  else done(seen.frames.length / seconds);
};
move();
"""


@contextmanager
def served(explorer):
    """Serve a page with one explorer; give its address."""
    with tempfile.TemporaryDirectory() as folder:
        cell = nbformat.v4.new_code_cell(f"from pierimpact import widgets\nwidgets.{explorer}()")
        nbformat.write(nbformat.v4.new_notebook(cells=[cell]), Path(folder) / "page.ipynb")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        command = [sys.executable, "-m", "voila", "--no-browser", f"--port={port}", "page.ipynb"]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        environment = os.environ | {"PYTHONPATH": str(HOUSE)}
        server = subprocess.Popen(command, cwd=folder, env=environment, **quiet)
        try:
            until(lambda: answers(port))
            yield f"http://127.0.0.1:{port}"
        finally:
            server.terminate()
            server.wait()


def answers(port):
    """Return whether a server answers."""
    try:
        socket.create_connection(("127.0.0.1", port), 5).close()
    except OSError:
        return False
    return True


def until(condition):
    """Wait until a condition is true, and return what it is."""
    end = time.monotonic() + PATIENCE
    while not (found := condition()):
        if time.monotonic() > end:
            sys.exit("the page does not answer")
        time.sleep(0.1)
    return found


def press(driver, slider, key):
    """Return the milliseconds from a key to the first and to the last changed picture."""
    driver.execute_script("arguments[0].focus()", slider)
    slider.send_keys(key)
    time.sleep(QUIET)
    start, frames = driver.execute_script("return [seen.key, seen.frames]")
    return (frames[0] - start, frames[-1] - start) if frames else (float("nan"),) * 2


def report(driver, explorer):
    """Measure one explorer, and print it."""
    until(lambda: driver.find_elements("css selector", ".pierimpact svg[role=img] *"))
    time.sleep(2.0)
    driver.execute_script(WATCH)
    for slider in driver.find_elements("css selector", ".pierimpact .slider input[type=range]"):
        if not slider.is_displayed():
            continue
        name = slider.get_attribute("id").partition("-")[2]
        times = [press(driver, slider, ARROWS[n % 2]) for n in range(PRESSES)]
        first, last = (statistics.median(each) for each in zip(*times, strict=True))
        rate = driver.execute_async_script(DRAG, slider, 2)
        print(f"{explorer:12} {name:20} {last:5.0f} ms {first:5.0f} ms {rate:5.0f} /s", flush=True)
        time.sleep(QUIET)
    for play in driver.find_elements("css selector", ".pierimpact .player > button"):
        play.click()
        time.sleep(0.5)
        before = driver.execute_script("seen.frames = []; return performance.now()")
        time.sleep(2.0)
        frames, now = driver.execute_script("return [seen.frames.length, performance.now()]")
        print(f"{explorer:12} {'played':20} {'':17} {1e3 * frames / (now - before):5.0f} /s")


def main():
    """Measure the explorers that are asked for, or all."""
    options = webdriver.ChromeOptions()
    for option in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1280,900"):
        options.add_argument(option)
    options.binary_location = shutil.which("chromium") or ""
    service = webdriver.ChromeService(executable_path=shutil.which("chromedriver"))
    driver = webdriver.Chrome(options=options, service=service)
    print(f"{'explorer':12} {'slider':20} {'last':>8} {'first':>8} {'dragged':>8}")
    try:
        for explorer in sys.argv[1:] or EXPLORERS:
            with served(explorer) as address:
                driver.get(address)
                report(driver, explorer)
    finally:
        driver.quit()


main()
