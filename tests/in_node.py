"""Programs of the browser's modules, run in Node."""

import json
import shutil
import subprocess

import pytest

from pierimpact.teaching import browser

NODE = shutil.which("node")
_NAMES = """
const { simulate } = modelModule, { follow, energyShares } = historyModule;
const { bandsOf, coarseSpectrum, isEnginePeak, pointAt, refine } = spectrumModule;
const { pierOf } = columnModule, { contents } = chartsModule, { sentence } = sentencesModule;
const { exactAmplification } = reductionModule, { changes } = influencesModule;
const finite = (name, value) => {
  if (typeof value === "number" && !Number.isFinite(value)) throw new Error(`${name}: ${value}`);
  return value;
};
"""


def in_node(program, value):
    """Return what an expression of the modules is, given a value as `cases`; nan is refused."""
    if not NODE:
        pytest.skip("no Node: apt-get install nodejs")
    script = browser.script(*browser.WIDGET) + _NAMES
    done = subprocess.run(
        [NODE, "--input-type=module", "-"],
        input=f"{script}const cases = {json.dumps(value)};\n"
        f"console.log(JSON.stringify({program}, finite));",
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def contents_of(explorer, *values):
    """Return what an explorer of charts shows at its defaults with each of these values."""
    setup = explorer.widget.setup
    cases = [setup, [setup["defaults"] | each for each in values]]
    return in_node("cases[1].map((values) => contents(values, cases[0]))", cases)
