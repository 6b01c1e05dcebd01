"""What a page asks for when a browser shows it."""

import json
import shutil
import subprocess

import pytest

OPTIONS = """
    chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run
    --disable-background-networking --disable-component-update --disable-sync --dump-dom
"""
needs_browser = pytest.mark.skipif(
    shutil.which("chromium") is None, reason="needs a browser: apt-get install chromium"
)


def shown_by_browser(page, folder):
    """Return a page as it is once its scripts have run, and the addresses that it asks for."""
    log = folder / "net.json"
    options = [f"--user-data-dir={folder / 'profile'}", f"--log-net-log={log}"]
    done = subprocess.run(
        [*OPTIONS.split(), *options, page.as_uri()],
        capture_output=True,
        encoding="utf-8",
        check=True,
        timeout=600,
    )
    events = (event.get("params", {}) for event in json.loads(log.read_text("utf-8"))["events"])
    return done.stdout, {
        event["url"]
        for event in events  # of the page, and not of the browser on its own
        if event.get("initiator", "not an origin") != "not an origin"
    }
