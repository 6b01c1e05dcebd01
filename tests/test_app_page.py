"""The form in a real browser: typed in, seen, opened, saved, and its report downloaded."""

import os
import re
import subprocess
import sys

import pytest
import test_browser
from test_browser import HOUSE, PATIENCE, Page, faults, until, webdriver

from pierimpact.files.new_case import new_case
from pierimpact.report.write import write_report

pytest.importorskip("voila")
pytestmark = test_browser.pytestmark
browser = test_browser.browser
SIZES = {"width": 400, "height": 800, "deviceScaleFactor": 1, "mobile": False}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("app")
    (folder / "pier.yaml").write_text(new_case(), encoding="utf-8")
    (folder / "bad.yaml").write_text(f"speeed: 1\n{new_case()}", encoding="utf-8")
    (folder / "down").mkdir()
    return folder


@pytest.fixture(scope="module")
def form(browser, folder):
    places = ("CONFIG_DIR", "DATA_DIR", "RUNTIME_DIR")
    private = {f"JUPYTER_{place}": str(folder / ".jupyter") for place in places}
    command = [sys.executable, "-m", "pierimpact", "app", "--no-browser", "pier.yaml"]
    log = folder / "log"
    with log.open("w") as output:
        process = subprocess.Popen(
            command, cwd=folder, stdout=output, stderr=output,
            env=os.environ | private | {"PYTHONPATH": str(HOUSE)},
        )  # fmt: skip
    try:

        def address():
            assert process.poll() is None, log.read_text("utf-8")
            return re.search(r"http://127\.0\.0\.1:\d+/\S*\?token=\w+", log.read_text("utf-8"))

        browser.get(until(address)[0])
        browser.execute_cdp_cmd(
            "Browser.setDownloadBehavior",
            {"behavior": "allow", "downloadPath": str(folder / "down")},
        )
        form = Form(browser)
        until(form.is_up_to_date)
        yield form
    finally:
        process.terminate()
        process.wait(PATIENCE)


class Form(Page):
    """The page of the form."""

    def status(self):
        return self.one(".right .status").text

    def is_up_to_date(self):
        return self.status() == "Up to date."

    def enter(self, key, text):
        box = self.one(f"#field-{key}")
        box.send_keys(webdriver.Keys.CONTROL, "a")
        box.send_keys(text, webdriver.Keys.TAB)

    def error(self, key):
        return self.one(f"#field-{key}-error").text

    def press_button(self, words):
        until(lambda: [b for b in self.all("button") if b.text == words and b.is_enabled()])[
            0
        ].click()


def test_values_with_their_units_are_calculated_and_downloaded_as_by_report(form, folder):
    form.enter("shear_resistance", "1 MN")
    until(lambda: "does not hold" in form.one(".verdict").text)
    form.enter("column_height", "24'-6\"")
    until(lambda: form.is_up_to_date() and "7.46" in form.one(".results img").get_attribute("alt"))
    form.press_button("Save")
    down = folder / "down"
    case = until(lambda: list(down.glob("*.yaml")))[0]
    text = case.read_text(encoding="utf-8")
    assert "shear_resistance: 1 MN " in text
    assert text.count("#") == new_case().count("#") - 1  # all comments are kept
    for words, ending in {"PDF": "pdf", "HTML": "html", "Word": "docx"}.items():
        form.press_button(words)
        until(lambda ending=ending: (down / f"pier.{ending}").exists())
    report = write_report(case, folder / "reports", docx=True)
    for file in (report.pdf, report.html, report.docx):
        assert (down / file.name).read_bytes() == file.read_bytes()


def test_an_error_is_beside_its_field_and_the_picture_is_said_to_be_earlier(form):
    form.enter("speed", "fast")
    until(lambda: "must be a speed, a number with a unit" in form.error("speed"))
    assert form.one("#field-speed").get_attribute("aria-invalid") == "true"
    assert "speed must be" in form.one("[role=alert]").text
    assert "of the earlier inputs" in form.status()
    assert faults(form.browser) == []
    form.enter("speed", "50 mph")
    until(form.is_up_to_date)
    assert not form.one("[role=alert]").is_displayed()


def test_only_the_fields_of_the_shape_are_shown(form):
    def displayed(key):
        return form.one(f"#field-{key}").is_displayed()

    assert (displayed("column_diameter"), displayed("column_width")) == (True, False)
    form.one("#field-column_shape").find_element("xpath", "option[. = 'oblong']").click()
    until(lambda: "is missing" in form.error("column_width"))
    assert (displayed("column_diameter"), displayed("column_width")) == (False, True)


def test_an_opened_file_shows_its_unknown_keys_until_they_are_emptied(form, folder):
    form.browser.execute_script("window.confirm = () => true")
    form.one("input[type=file]").send_keys(str(folder / "bad.yaml"))
    until(lambda: "did you mean speed?" in form.error("speeed"))
    form.enter("speeed", webdriver.Keys.DELETE)
    until(form.is_up_to_date)
    assert not form.all("#field-speeed")
    assert form.one("#field-file_name").get_attribute("value") == "bad.yaml"


def test_a_case_with_a_refused_name_is_not_saved(form, folder):
    before = sorted((folder / "down").iterdir())
    form.enter("file_name", "Pfeiler Süd/1")
    form.press_button("Save")
    until(lambda: "must be a name without a folder" in form.error("file_name"))
    form.enter("file_name", "Pfeiler Süd 1.yaml")
    until(lambda: form.is_up_to_date() and not form.error("file_name"))
    form.press_button("Save")
    saved = folder / "down" / "Pfeiler Süd 1.yaml"
    until(saved.exists)
    assert sorted((folder / "down").iterdir()) == sorted([*before, saved])


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_is_readable_on_a_narrow_screen_and_named_throughout(form, scheme):
    feature = {"name": "prefers-color-scheme", "value": scheme}
    form.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [feature]})
    form.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", SIZES)
    try:
        width = "return document.querySelector('.pierimpact-app').scrollWidth"
        until(lambda: form.browser.execute_script(width) <= SIZES["width"])
        assert faults(form.browser) == []
    finally:
        form.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        form.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    for control in form.all(".pierimpact-app :is(input, select, textarea, button)"):
        if control.is_displayed():
            assert control.accessible_name.strip()
    form.holds_no_error()
