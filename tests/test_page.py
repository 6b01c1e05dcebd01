"""The page without Python: its solver against the package's, and the page in a real browser."""

import base64
import dataclasses
import hashlib
import html
import json
import math
import re
import shutil
import time
from pathlib import Path

import numpy as np
import pytest
from generated_collisions import HARD, collisions, side_by_side
from in_node import in_node
from nbformat import v4

from pierimpact import cli, load_truck, peak_reactions, simulate, tables, widgets
from pierimpact.checks import InputError
from pierimpact.collision.parameters import Collision
from pierimpact.files.trucks import read_truck_file, truck_names
from pierimpact.pier.equivalent import EquivalentPier, stiffness_at_frequency
from pierimpact.pier.unit_force import BY_ENDS
from pierimpact.report.exporters import SheetHTMLExporter
from pierimpact.teaching import page as pages
from pierimpact.teaching.scenario import Scenario
from pierimpact.teaching.variables import VARIABLES

HOUSE = Path(__file__).parents[1]
CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
CASES = [*collisions(300, seed=12), *HARD.values()]
OPTIONS = (
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
)  # fmt: skip
PATIENCE = 120  # only a page that hangs takes longer [s]
EXPLORERS = ("collision", "spectra", "full", "pier", "reduction", "design", "sensitivity", "risk")
RANGE = {"low": 5.0, "high": 180.0}
PIER = {"mass": pages.PIER_MASS, "dampingRatio": 0.05}

# The solver's outcomes of cases, [[truck, pier, speed], …].
OUTCOMES = "cases.map(([truck, pier, speed]) => simulate(truck, pier, speed))"


def as_arguments(case):
    pier = {
        "mass": case.pier.mass,
        "stiffness": case.pier.stiffness,
        "dampingRatio": case.pier.damping_ratio,
    }
    return pages.truck_data(case.truck), pier, case.speed


def agree(outcomes):
    """Hold outcomes of CASES, as the page's solver gives them, against the package's."""
    peaks = peak_reactions(**side_by_side(CASES))

    def column(name):
        return np.array([outcome[name] for outcome in outcomes], dtype=float)

    assert np.isnan(peaks.cargo).any()
    assert np.isnan(peaks.engine_contact_time).any()
    for ours, theirs in (
        ("engine", peaks.engine),
        ("cargo", peaks.cargo),
        ("engineContact", peaks.engine_contact_time),
        ("cargoContact", peaks.cargo_contact_time),
    ):
        np.testing.assert_allclose(column(ours), theirs, rtol=1e-5)  # nan where there is none


def test_the_solver_finds_the_packages_peaks_and_contacts():
    agree(in_node(OUTCOMES, [as_arguments(case) for case in CASES]))


def test_an_engines_peak_is_a_peak_after_the_engine_struck():
    """What is called so falls off on both sides; anything else is neither named nor governs."""
    slow = {"pier_mass": 8e3, "pier_frequency": 30.0}
    cases = [
        Scenario(**(slow | {"pier_frequency": f})).history.collision for f in (2.0, 3.0, 3.5, 100.0)
    ]
    cases += [
        Scenario(**slow, speed=v / 3.6).history.collision for v in (35.0, 52.9, 53.2, 55.0, 60.0)
    ]
    cases += CASES[:120]
    program = f"{OUTCOMES}.map((each) => [isEnginePeak(each), sentence(30, each)])"
    found = in_node(program, [as_arguments(case) for case in cases])
    for case, (is_peak, words) in zip(cases, found, strict=True):
        history = simulate(case.truck, case.pier, case.speed)
        reaction, time = history.engine_peak
        around = history.reaction_at(np.array([time - 1e-5, time + 1e-5]))
        falls = bool(np.all(around <= reaction * (1.0 + 1e-9)))
        struck = history.engine_contact_time is not None and time >= history.engine_contact_time
        assert is_peak is (struck and falls)
        if not is_peak:
            assert "engine governs" not in words
    assert not all(is_peak for is_peak, _ in found)


def test_a_column_is_the_packages_pier():
    random = np.random.default_rng(5)
    columns = [
        {
            "height": float(random.uniform(2.0, 15.0)),
            "diameter": float(random.uniform(0.4, 2.5)),
            "place": float(random.uniform(0.05, 0.95)),
            "base": base,
            "top": top,
        }
        for base, top in BY_ENDS
        for _ in range(5)
    ]
    given, expected = [], []
    for each in columns:
        impact = each["place"] * each["height"]
        scenario = Scenario(
            column_height=each["height"], column_diameter=each["diameter"], impact_height=impact,
            base=each["base"], top=each["top"],
        )  # fmt: skip
        material = scenario.column.values
        given.append(
            each
            | {
                "impact": impact,
                "elasticModulus": material["E"],
                "shearModulus": material["kappa"] * material["G"],
                "density": material["rho"],
            }
        )
        expected.append((scenario.pier.stiffness, scenario.pier.mass))
    found = in_node("cases.map(pierOf).map(({ stiffness, mass }) => [stiffness, mass])", given)
    np.testing.assert_allclose(found, expected, rtol=1e-6)


@pytest.mark.parametrize("on", ["road", "pier"])
def test_the_energy_is_where_the_package_has_it(on):
    truck = dataclasses.replace(load_truck("single-unit-8t"), friction_force=2e4, friction_on=on)
    case = Collision(truck, Scenario(pier_mass=8e3, pier_frequency=30.0).pier, 22.0)
    program = (
        "(([truck, pier, speed]) => energyShares("
        "follow(truck, pier, speed, 0.15).rows, truck, pier, speed))(cases[0])"
    )
    shares = in_node(program, [as_arguments(case)])
    time = np.array([share["time"] for share in shares])
    history = simulate(truck, case.pier, 22.0, 0.15)
    both = history.time <= time[-1]
    for ours, theirs in (
        ("motion", "kinetic"), ("pier", "pier_elastic"), ("springs", "truck_elastic"),
        ("crush", "crush"), ("friction", "friction"), ("damping", "damping"),
    ):  # fmt: skip
        drawn = np.interp(history.time[both], time, [share[ours] for share in shares])
        expected = getattr(history.energy, theirs)[both] / case.energy
        np.testing.assert_allclose(drawn, expected, atol=4e-3)


def test_momentum_is_kept_along_the_history():
    # Momentum of truck and pier, and what the pier's spring and damper and the road took.
    truck = load_truck("single-unit-8t")
    stiffness = float(stiffness_at_frequency(PIER["mass"], 40.0))
    damping = 2.0 * 0.05 * math.sqrt(stiffness * PIER["mass"])
    speed, duration = 25.0, 0.12
    pier = PIER | {"stiffness": stiffness}
    times = np.linspace(0.0, duration, 6001).tolist()
    program = (
        "(() => { const h = follow(...cases[0]); return cases[1].map((t) => { "
        "const { v1, v2, xp, vp } = h.at(t); return [v1, v2, xp, vp]; }); })()"
    )
    arguments = [[pages.truck_data(truck), pier, speed, duration], times]
    v1, v2, xp, vp = np.array(in_node(program, arguments)).T
    assert (v2 > 0.0).all()  # the friction on the road acts backward throughout
    taken = stiffness * xp + damping * vp + truck.friction_force
    steps = 0.5 * (taken[1:] + taken[:-1]) * np.diff(times)
    momentum = truck.engine_mass * v1 + truck.body_mass * v2 + PIER["mass"] * vp
    left = truck.mass * speed - np.concatenate(([0.0], np.cumsum(steps)))
    np.testing.assert_allclose(momentum, left, atol=2e-4 * truck.mass * speed)


@pytest.fixture(scope="module")
def spectra():
    """Return refined spectra of trucks and speeds, with their bands."""
    truck = load_truck("single-unit-8t")
    given = [
        {"truck": pages.truck_data(truck.loaded_to(mass)), "pier": PIER, "speed": speed / 3.6}
        for mass, speed in ((5e3, 80.0), (8e3, 60.0), (8e3, 80.0), (8e3, 115.0), (12e3, 95.0))
    ]
    program = (
        "cases[1].map((c) => { const points = coarseSpectrum(cases[0], 33, c); "
        "for (const _ of refine(points, (each) => pointAt(each, c))); "
        "return [points, bandsOf(points, c)]; })"
    )
    trucks = [truck.loaded_to(mass) for mass in (5e3, 8e3, 8e3, 8e3, 12e3)]
    return list(zip(trucks, given, in_node(program, [RANGE, given]), strict=True))


def peaks_at(truck, frequency, speed):
    stiffness = stiffness_at_frequency(PIER["mass"], np.asarray(frequency))
    return peak_reactions(truck, PIER["mass"], stiffness, 0.05, speed)


def test_a_spectrum_is_right_between_its_points(spectra):
    frequency = np.geomspace(RANGE["low"], RANGE["high"], 333)[1:-1]
    for truck, given, (points, _) in spectra:
        peaks = peaks_at(truck, frequency, given["speed"])
        of_points = np.array([point["frequency"] for point in points])
        assert (np.diff(of_points) > 0.0).all()
        for body, exact in (("engine", peaks.engine), ("cargo", peaks.cargo)):
            drawn = np.array([point[body] for point in points], dtype=float)
            line = np.interp(np.log(frequency), np.log(of_points), drawn)
            both = np.isfinite(line) & np.isfinite(exact)
            np.testing.assert_allclose(line[both], exact[both], rtol=5e-3)
            # Where a peak begins or ends, one interval of the line is left out.
            assert np.count_nonzero(np.isfinite(line) != np.isfinite(exact)) <= 2


def test_bands_end_where_the_peaks_are_equal(spectra):
    found = 0
    for truck, given, (_, bands) in spectra:
        for band in bands:
            frequency = math.sqrt(band["low"] * band["high"])
            pier = EquivalentPier.from_frequency(PIER["mass"], frequency, PIER["dampingRatio"])
            middle = simulate(truck, pier, given["speed"])
            struck = middle.engine_contact_time <= middle.engine_peak.time
            governs = "engine" if struck else "sheet metal"
            if middle.cargo_peak and middle.cargo_peak.reaction > middle.engine_peak.reaction:
                governs = "cargo"
            assert band["what"] == governs
            if band["crossing"]:
                there = peaks_at(truck, band["low"], given["speed"])
                assert there.engine == pytest.approx(there.cargo, rel=2e-3)
                found += 1
    assert found >= 4


@pytest.fixture(scope="module")
def content():
    return pages.page([read_truck_file("single-unit-8t")])


def test_only_its_own_script_and_style_may_act(content):
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', content)
    policy = policy.replace("&#39;", "'")
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    for tag, directive in (('script type="module"', "script-src"), ("style", "style-src")):
        (inside,) = re.findall(rf"<{tag}>(.*?)</{tag.split()[0]}>", content, re.DOTALL)
        digest = base64.b64encode(hashlib.sha256(inside.encode()).digest()).decode()
        assert f"{directive} 'sha256-{digest}'" in policy
    assert not re.findall(r"\b(?:src|srcset|style|on\w+)=", content.partition("<script")[0])
    assert set(re.findall(r'href="([^"]*)"', content)) == {"#truck-0"}
    assert "url(" not in content


def test_the_page_says_how_far_to_trust_the_truck(content):
    words = " ".join(re.sub(r"<[^>]*>", " ", content.partition("<script")[0]).split())
    assert "Illustrative truck." in words
    assert "may be off by ±30 % (judgement of this project)" in words
    row = "150 MN/m ±30 %, judgement of this project illustrative round number for an engine block"
    assert f"Steep stiffness of the engine spring {row}" in words
    assert "from 5 t to 12 t" in words


OWN = """\
name = "</script><script>alert(1)</script>"
description = "Own & <b>bold</b>"
source = "nobody"
status = "assumed"
"""


def own_truck(folder, *, name=None):
    """Write a truck file without spreads or range of masses, and friction on the pier."""
    text = (HOUSE / "pierimpact" / "trucks" / "single-unit-8t.toml").read_text(encoding="utf-8")
    text = re.sub(r"(?m)^(spread|spread_source|spread_status) = .*\n", "", text)
    text = re.sub(r"(?s)\[mass_range\].*?\n\n", "", text).replace(
        'value = "road"', 'value = "pier"'
    )
    head = OWN if name is None else OWN.replace("</script><script>alert(1)</script>", name)
    text = head + text[text.index("\n[engine_mass]") :]
    file = folder / "own.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_trucks_of_ones_own(tmp_path, capsys):
    page = tmp_path / "page.html"
    trucks = [*truck_names(), str(own_truck(tmp_path))]
    assert cli.main(["page", str(page), "--truck", *trucks]) == 0
    assert capsys.readouterr().out == f"{page}\n"
    content = page.read_text(encoding="utf-8")
    assert content.count("<script") == content.count("</script>") == 2
    assert "<b>" not in content
    (data,) = re.findall(r'id="data">(.*?)</script>', content)
    given = json.loads(data)["trucks"]
    assert [truck["name"] for truck in given[:2]] == truck_names()
    assert given[2]["name"].startswith("</script>")
    assert given[2]["frictionOnPier"]
    for truck in given:
        masses = truck["masses"]
        assert truck["engine"]["mass"] < masses["low"] <= masses["first"] <= masses["high"]
        for steps in (masses["first"] - masses["low"], masses["high"] - masses["first"]):
            assert steps / masses["step"] == pytest.approx(round(steps / masses["step"]))
    assert "does not say how far its parameters may be off" in content
    assert "does not say for which masses" in content


@pytest.mark.parametrize(
    ("page", "trucks", "words"),
    [
        ("page.yaml", ["single-unit-8t"], "must be the name of an .html file, got "),
        ("nowhere/page.html", ["single-unit-8t"], "there is no folder "),
        ("folder.html", ["single-unit-8t"], "what is there is no file"),
        ("page.html", ["single-unit-8"], "did you mean single-unit-8t?"),
        ("page.html", ["single-unit-8t", "single-unit-8t"], "must have names of their own"),
        ("page.html", ["none.toml"], "cannot be read"),
    ],
)
def test_bad_input_is_one_line_and_leaves_all_as_it_is(page, trucks, words, tmp_path, capsys):
    (tmp_path / "folder.html").mkdir()
    (tmp_path / "page.html").write_text("mine", encoding="utf-8")
    before = sorted(tmp_path.rglob("*"))
    assert cli.main(["page", str(tmp_path / page), "--truck", *trucks]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert words in printed.err
    assert sorted(tmp_path.rglob("*")) == before
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == "mine"


def test_a_page_that_somebody_changed_is_replaced_by_force_alone(tmp_path, capsys):
    page = tmp_path / "page.html"
    assert cli.main(["page", str(page)]) == cli.main(["page", str(page)]) == 0
    page.write_text("mine", encoding="utf-8")
    assert cli.main(["page", str(page)]) == 2
    assert "page.html was not written by pierimpact, or changed" in capsys.readouterr().err
    assert page.read_text(encoding="utf-8") == "mine"
    assert cli.main(["page", str(page), "--force"]) == 0
    assert page.read_text(encoding="utf-8") != "mine"


def test_the_help_names_the_truck_of_a_page(capsys):
    with pytest.raises(SystemExit):
        cli.main(["page", "--help"])
    assert "(default: single-unit-8t)" in " ".join(capsys.readouterr().out.split())


def test_a_page_needs_a_truck():
    with pytest.raises(InputError, match="names of their own, got none"):
        pages.page([])


class Opened:
    """The page in a browser, from a file."""

    def __init__(self, driver, address):
        self.driver, self.address = driver, address

    def load(self, width=1280, height=720, *, forget=True):
        if forget:
            self.driver.get(self.address)
            self.run("localStorage.clear()")
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        self.driver.get(self.address)
        self.until(lambda: self.text("#sentence"))

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def all(self, selector):
        return self.driver.find_elements("css selector", selector)

    def one(self, selector):
        return self.all(selector)[0]

    def text(self, selector):
        return self.one(selector).text

    def until(self, condition):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if found := condition():
                return found
            time.sleep(0.02)
        return pytest.fail(f"waited {PATIENCE} s in vain")

    def changes(self, selector, act):
        """Act, and return the text that is there as soon as it is another."""
        before = self.text(selector)
        act()
        self.until(lambda: self.text(selector) != before)
        return self.text(selector)

    def errors(self):
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def skip(self):
        self.one("#gate .plain").click()


@pytest.fixture(scope="module")
def opened(tmp_path_factory):
    webdriver = pytest.importorskip("selenium.webdriver")
    if not (CHROMIUM and DRIVER):
        pytest.skip("no browser: apt-get install chromium chromium-driver")
    folder = tmp_path_factory.mktemp("page")
    file = pages.write_page(folder / "page.html", truck_names())
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for option in (*OPTIONS, f"--user-data-dir={folder / 'profile'}"):
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(
        options=options, service=webdriver.ChromeService(executable_path=DRIVER)
    )
    yield Opened(driver, file.as_uri())
    driver.quit()


def test_the_page_asks_for_nothing_and_solves_in_the_browser(opened):
    opened.load()
    opened.skip()
    arguments = [as_arguments(case) for case in CASES]
    program = f"const {{ simulate }} = pierimpact, cases = arguments[0]; return {OUTCOMES}"
    agree(opened.run(program, arguments))
    asked = [
        json.loads(entry["message"])["message"]["params"]
        for entry in opened.driver.get_log("performance")
        if '"Network.requestWillBeSent"' in entry["message"]
    ]
    # The browser's own first page is not ours.
    ours = {each["request"]["url"] for each in asked if each["documentURL"] == opened.address}
    assert ours == {opened.address}
    assert opened.errors() == []


def test_a_key_moves_the_slider_and_the_sentence(opened):
    opened.load()
    opened.skip()
    slider = opened.one("#pier_frequency")
    assert slider.get_attribute("aria-valuetext") == "30.0 hertz"
    assert "30.0 Hz the cargo governs: 4.88 MN" in opened.text("#sentence")
    assert opened.text("#engine-peak") == "2.70 MN"
    keys = {
        "pier_frequency": "30.6 hertz",
        "speed": "81 kilometres per hour",
        "truck_mass": "8.5 tonnes",
    }
    for name, words in keys.items():
        opened.run("arguments[0].focus()", opened.one(f"#{name}"))
        key = opened.driver.switch_to.active_element.send_keys
        opened.changes("#sentence", lambda key=key: key("\ue014"))  # arrow to the right
        assert opened.one(f"#{name}").get_attribute("aria-valuetext") == words
    truck = load_truck("single-unit-8t").loaded_to(8.5e3)
    peaks = peaks_at(truck, 5.0 * 36.0 ** (91 / 180), 81.0 / 3.6)
    assert opened.text("#cargo-peak") == f"{peaks.cargo / 1e6:.2f} MN"
    assert opened.errors() == []


def test_every_control_is_reached_by_tab_and_has_a_name(opened):
    opened.load()
    opened.skip()
    opened.run("document.activeElement.blur()")
    names = []
    for _ in range(60):
        opened.driver.switch_to.active_element.send_keys("\ue004")
        at = opened.driver.switch_to.active_element
        if at.tag_name == "body":
            break
        names.append((at.get_attribute("id"), at.accessible_name))
        outline = at.value_of_css_property("outline-style")
        assert outline == "solid", names[-1]
    assert all(name for _, name in names)
    reached = {which for which, _ in names}
    assert {"pier_frequency", "play", "instant", "truck", "speed", "truck_mass", "again"} <= reached


@pytest.mark.parametrize("width", [320, 400])
def test_nothing_is_cut_on_a_phone(opened, width):
    opened.load(width, 800)
    for act in (lambda: None, opened.skip):
        act()
        opened.run("document.querySelectorAll('details').forEach((each) => each.open = true)")
        assert opened.run("return document.documentElement.scrollWidth") <= width
        cut = (
            "return [...document.querySelectorAll('main *')].filter((each) => "
            "!each.closest('.table, .unseen') && "
            "each.getBoundingClientRect().right > innerWidth + 1"
            ").map((each) => each.outerHTML.slice(0, 80))"
        )
        assert opened.run(cut) == []


def test_slider_lines_and_collision_fit_on_one_screen(opened):
    opened.load()
    opened.all("#gate input")[0].click()
    opened.one("#gate .main").click()
    opened.until(lambda: opened.one("#chart").is_displayed())
    for selector in ("#pier_frequency", "#chart", "#picture", "#history", "#play"):
        assert 0.0 < opened.run(
            "return document.querySelector(arguments[0]).getBoundingClientRect().bottom", selector
        ) <= 720.0  # fmt: skip


LABELS = """
function collisions() {
  const found = [];
  for (const svg of document.querySelectorAll("svg")) {
    const room = svg.getBoundingClientRect();
    const labels = [...svg.querySelectorAll("text")].map((each) =>
      [each.textContent, each.getBoundingClientRect(),
        parseFloat(getComputedStyle(each).fontSize) * each.getScreenCTM().a]);
    for (const line of svg.querySelectorAll("line.curve")) {
      const { left, right, top } = line.getBoundingClientRect();
      for (const [words, a] of labels) {
        const struck = Math.min(right, a.right) - Math.max(left, a.left) > 1;
        if (struck && a.top < top && top < a.bottom) found.push(`a line on ${words}`);
      }
    }
    const pier = svg.querySelector("rect.pier")?.getBoundingClientRect();
    for (const [words, a] of pier ? labels : []) {
      const over = Math.min(a.right, pier.right) - Math.max(a.left, pier.left);
      if (words.startsWith("R =") && over > 0) found.push(`${words} on the pier`);
    }
    labels.forEach(([words, a, size], n) => {
      if (size && size < 8) found.push(`${words} is too small`);
      if (a.left < room.left - 1 || a.right > room.right + 1) found.push(`${words} is cut`);
      for (const [others, b] of labels.slice(0, n)) {
        const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
        const along = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        if (across > 1 && along > 3) found.push(`${words} on ${others}`);
      }
    });
  }
  const beyond = document.documentElement.scrollWidth - document.documentElement.clientWidth;
  if (beyond > 0) found.push(`${beyond} px beyond the window`);
  return found;
}
function move(id, share) {
  const each = document.getElementById(id), low = Number(each.min), high = Number(each.max);
  each.value = each.options ? share : low + share * (high - low);
  each.dispatchEvent(new Event(each.options ? "change" : "input"));
}
const picture = () => new Promise(requestAnimationFrame);
const [done] = arguments, found = [];
let count = 0;
for (const truck of [0, 1]) {
  move("truck", truck);
  for (const speed of [0, 0.3, 0.55, 1]) for (const mass of [0, 1]) {
    move("speed", speed);
    move("truck_mass", mass);
    for (const frequency of [0, 0.62, 1]) {
      move("pier_frequency", frequency);
      await picture();
      await picture();
      count += document.querySelectorAll("svg text").length > 30;
      const here = JSON.stringify({ truck, speed, mass, frequency });
      found.push(...collisions().map((words) => `${words}: ${here}`));
    }
  }
}
done([count, found]);
"""


def still(opened, folder, explorer, width=1240):
    """Open what stands for an explorer of a notebook in its frame."""
    page = folder / "still.html"
    inside = html.unescape(re.search('srcdoc="([^"]*)"', explorer.still)[1])
    page.write_text(inside, encoding="utf-8")
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    opened.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    opened.driver.get(page.as_uri())
    opened.until(lambda: opened.all("svg[role=img] text"))


STILL = """
for (const slider of document.querySelectorAll(".slider input[type=range]")) {
  const before = slider.value;
  for (const share of [0, 0.5, 1]) {
    slider.value = share * slider.max;
    slider.dispatchEvent(new Event("input"));
    await picture();
    await picture();
    count += 1;
    found.push(...collisions().map((words) => `${words}: ${slider.id} ${share}`));
  }
  slider.value = before;
  slider.dispatchEvent(new Event("input"));
}
for (const choice of document.querySelectorAll(".slider select")) {
  const before = choice.value;
  for (const { value } of [...choice.options, { value: before }]) {
    choice.value = value;
    choice.dispatchEvent(new Event("change"));
    await picture();
    await picture();
    found.push(...collisions().map((words) => `${words}: ${choice.id} ${value}`));
  }
}
done([count, found]);
"""


@pytest.mark.parametrize("name", EXPLORERS)
def test_labels_keep_clear_of_each_other_in_a_still(opened, tmp_path, name):
    explorer = getattr(widgets, name)()
    numbers = [name for name in explorer.controls if not VARIABLES[name].choices]
    opened.driver.set_script_timeout(PATIENCE)
    head = LABELS.partition("for (const truck")[0]
    program = f"const run = async (...arguments) => {{ {head}{STILL} }}; run(...arguments)"
    for width in (400, 850, 1240):
        still(opened, tmp_path, explorer, width)
        outcome = opened.driver.execute_async_script(program)
        assert outcome == [3 * len(numbers), []]
    assert opened.errors() == []


CONTENT = """
const [done] = arguments, heights = [];
const picture = () => new Promise(requestAnimationFrame);
const drawn = async (slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event("input"));
  await picture();
  await picture();
  heights.push(document.documentElement.scrollHeight);
};
(async () => {
  for (const slider of document.querySelectorAll(".slider input[type=range]")) {
    const before = slider.value;
    for (const value of [0, slider.max, before]) await drawn(slider, value);
  }
  done(Math.max(...heights) - innerHeight);
})();
"""


@pytest.mark.parametrize("name", EXPLORERS)
def test_the_frame_of_a_still_holds_all_that_is_in_it(opened, tmp_path, name):
    page = tmp_path / "page.html"
    still = f'<!doctype html><body style="margin: 0">{getattr(widgets, name)().still}</body>'
    page.write_text(still, encoding="utf-8")
    hidden = {}
    for width in (345, 737, 785, 976, 1240):
        size = {"width": width, "height": 3000, "deviceScaleFactor": 1, "mobile": False}
        opened.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        opened.driver.get(page.as_uri())
        opened.driver.switch_to.frame(opened.one("iframe"))
        opened.until(lambda: opened.all("svg[role=img] text"))
        hidden[width] = opened.driver.execute_async_script(CONTENT)
        opened.driver.switch_to.default_content()
    assert max(hidden.values()) <= 0, hidden


def test_tables_and_formulas_of_a_lesson_do_not_widen_its_page(opened, tmp_path):
    shown = [tables.truck_parameters("single-unit-8t"), tables.code_values()]
    outputs = [v4.new_output("display_data", {"text/html": each.data}) for each in shown]
    formula = f"$$v_1^2 = {' + '.join(['V^2'] * 20)}$$"
    cells = [v4.new_markdown_cell(f"# Lesson\n\n{formula}"), v4.new_code_cell(outputs=outputs)]
    content, _ = SheetHTMLExporter().from_notebook_node(v4.new_notebook(cells=cells))
    page = tmp_path / "lesson.html"
    page.write_text(content, encoding="utf-8")
    size = {"width": 400, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    opened.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    opened.driver.get(page.as_uri())
    assert opened.run("return document.documentElement.scrollWidth") <= 400
    scrolled = "return arguments[0].scrollWidth > arguments[0].clientWidth"
    wide = opened.all("main > p:has(math), .table")
    assert [opened.run(scrolled, each) for each in wide] == [True, True, True]


AXIS = """
const ticks = document.querySelectorAll("[id$=chart] .tick[text-anchor=middle]");
return [ticks[0], [...ticks].at(-1)].map((tick) => Number(tick.textContent));
"""
MOVE = """
const [name, share, done] = arguments, slider = document.querySelector(`[id$=${name}]`);
slider.value = share * slider.max;
slider.dispatchEvent(new Event("input"));
requestAnimationFrame(() => requestAnimationFrame(done));
"""


@pytest.mark.parametrize("explorer", ["page", "spectra"])
def test_spectra_end_where_the_slider_does_wherever_it_was_before(opened, tmp_path, explorer):
    if explorer == "page":
        opened.load()
        opened.skip()
        ends = [5.0, 180.0]
    else:
        still(opened, tmp_path, widgets.spectra())
        ends = [2.0, 200.0]
    for frequency in (1.0, 0.0):
        opened.driver.execute_async_script(MOVE, "pier_frequency", frequency)
        for speed in (0.6, 0.5):
            opened.driver.execute_async_script(MOVE, "speed", speed)
            assert opened.run(AXIS) == ends


def test_spectra_reach_a_pier_that_is_typed_and_come_back(opened, tmp_path):
    still(opened, tmp_path, widgets.spectra())
    (box,) = opened.all("[id$=pier_frequency-value]")
    for typed, ends in (("300", [2.0, 400.0]), ("1.2", [0.5, 200.0]), ("30", [2.0, 200.0])):
        box.send_keys("\ue009a\ue000", typed, "\ue007")  # in place of what there is
        opened.until(lambda ends=ends: opened.run(AXIS) == ends)


@pytest.mark.parametrize("width", [320, 400, 800, 960, 1280])
def test_labels_keep_clear_of_each_other_at_the_ends_of_all_sliders(opened, width):
    opened.load(width, 800)
    opened.skip()
    opened.driver.set_script_timeout(PATIENCE)
    program = f"const run = async (...arguments) => {{ {LABELS} }}; run(...arguments)"
    assert opened.driver.execute_async_script(program) == [48, []]


def test_a_prediction_locks_before_the_lines_are_shown_and_is_remembered(opened):
    opened.load()
    assert not opened.one("#chart").is_displayed()
    lock = opened.one("#gate .main")
    assert not lock.is_enabled()
    opened.all("#gate input")[3].click()
    lock.click()
    opened.until(lambda: opened.one("#chart").is_displayed())
    assert "“What moves more must carry more.”" in opened.text("#lead")
    for load in (lambda: None, lambda: opened.load(forget=False)):
        load()
        choices = opened.all("#question-0 input")
        assert [choice.is_enabled() for choice in choices] == 4 * [False]
        assert [choice.is_selected() for choice in choices] == [False, False, False, True]
        assert opened.text("#question-0 .right").startswith("The engine’s grows several times over")
        assert opened.one("#chart").is_displayed()
    opened.one("#again").click()
    assert not opened.one("#chart").is_displayed()
    assert opened.all("#gate input")[3].is_enabled()


def test_what_a_prediction_came_to_goes_when_it_is_asked_again(opened):
    opened.load()
    introduction = opened.text("#lead")
    opened.all("#gate input")[3].click()
    opened.one("#gate .main").click()
    assert opened.text("#lead") != introduction
    opened.one("#again").click()
    assert opened.text("#lead") == introduction


def test_the_other_predictions_have_the_packages_answers(opened):
    opened.load()
    opened.skip()
    for number, right in ((1, 1), (2, 1)):
        opened.all(f"#question-{number} input")[right].click()
        opened.one(f"#question-{number} .main").click()
        assert opened.text(f"#question-{number} .verdict").startswith("As you predicted.")
    truck = load_truck("single-unit-8t")
    soft, stiff = (peaks_at(truck, frequency, 80.0 / 3.6).engine / 1e6 for frequency in (10, 100))
    assert f"in the pier {soft:.2f} MN and {stiff:.2f} MN" in opened.text("#question-1 .verdict")
    opened.one("#question-2 .buttons button").click()
    opened.until(lambda: opened.text("#truck_mass-value") == "12.0 t")
    loaded = peaks_at(truck.loaded_to(12e3), 5.0 * 36.0 ** (150 / 180), 80.0 / 3.6)
    assert opened.text("#cargo-peak") == f"{loaded.cargo / 1e6:.2f} MN"


def test_it_works_where_nothing_is_remembered(opened):
    forbid = "Object.defineProperty(window, 'localStorage', { get() { throw new Error('no'); } })"
    added = opened.driver.execute_cdp_cmd(
        "Page.addScriptToEvaluateOnNewDocument", {"source": forbid}
    )
    try:
        opened.load(forget=False)
        opened.all("#gate input")[2].click()
        opened.one("#gate .main").click()
        opened.until(lambda: opened.text("#lead").startswith("As you predicted."))
        assert opened.errors() == []
    finally:
        opened.driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)


def test_the_picture_moves_and_can_be_scrubbed(opened):
    opened.load()
    picture = "return document.getElementById('picture').innerHTML"
    opened.one("#instant").send_keys("\ue011")  # home, so that it does not end meanwhile
    before = opened.run(picture)
    opened.one("#play").click()
    opened.until(lambda: opened.run(picture) != before)
    opened.one("#play").click()
    assert opened.text("#play") == "Play"
    still = opened.run(picture)
    opened.one("#instant").send_keys("\ue011")  # home
    opened.until(lambda: opened.text("#instant-value") == "0.0 ms")
    assert opened.run(picture) != still
    assert "first touch" in opened.text("#picture-words")
    opened.all("#moments button")[3].click()
    assert "the cargo is in contact" in opened.text("#picture-words")
    assert "R = 4.88 MN" in opened.text("#picture")


def test_a_picture_says_where_the_pier_moves_farther_than_it_shows(opened):
    opened.load()
    opened.skip()
    assert "10 × too large, time" in opened.text("#picture-scale")
    for name, share in (("truck_mass", 1.0), ("speed", 1.0), ("pier_frequency", 0.0)):
        opened.driver.execute_async_script(MOVE, name, share)
    pier = EquivalentPier.from_frequency(PIER["mass"], RANGE["low"], PIER["dampingRatio"])
    peaks = peaks_at(load_truck("single-unit-8t").loaded_to(12e3), RANGE["low"], 120.0 / 3.6)
    assert 10.0 * peaks.cargo / pier.stiffness > 8.0  # of 7.7 m
    assert "too large (here more than there is room for)" in opened.text("#picture-scale")
