"""What lies beside a case, or in the user's surroundings, neither runs nor changes a report."""

import json
import os
import subprocess
import sys
from pathlib import Path

HOUSE = Path(__file__).parents[1]
DATE = "date: 2026-02-03\n"
# Modules that Python, Jupyter or the report look for, and that whoever finds them first runs.
SHADOWS = (
    "ipykernel", "ipykernel_launcher", "numpy", "matplotlib", "IPython", "jinja2", "pydantic",
    "yaml", "papermill", "nbconvert", "typst", "pypandoc", "tqdm", "scipy", "pint", "sitecustomize",
    "usercustomize", "rfc3987_syntax", "debugpy", "zmq", "jupyter_client",
)  # fmt: skip
STYLE = "axes.facecolor: red\nfont.size: 30\nnonsense\nbackend: nothing-of-the-kind\n"


def mine(folder, place):
    """Return Python code that leaves a mark that it ran."""
    return f"open({str(folder / 'ran')!r}, 'a').write({place!r} + '\\n')\nrho = 7\n"


def lay_traps(folder, home):
    """Fill the folder of a case, and the user's home; return the user's environment."""
    for name in SHADOWS:
        (folder / f"{name}.py").write_text(mine(folder, name))
    for place in (folder, home / ".config" / "matplotlib", home / "matplotlib"):
        place.mkdir(parents=True, exist_ok=True)
        (place / "matplotlibrc").write_text(STYLE)
    profile = home / ".ipython" / "profile_default"
    (profile / "startup").mkdir(parents=True)
    (profile / "startup" / "00-mine.py").write_text(mine(folder, "startup"))
    for config in ("ipython_config.py", "ipython_kernel_config.py", "jupyter_config.py"):
        for place in (folder, profile, home / ".jupyter"):
            place.mkdir(exist_ok=True)
            (place / config).write_text(mine(folder, config))
    (home / "startup.py").write_text(mine(folder, "PYTHONSTARTUP"))
    data = home / "jupyter"
    kernel = {"argv": [sys.executable, str(home / "startup.py")], "display_name": "Python 3"}
    (data / "kernels" / "python3").mkdir(parents=True)
    (data / "kernels" / "python3" / "kernel.json").write_text(json.dumps(kernel))
    for name in ("pierimpact-html", "pierimpact-pdf"):
        template = data / "nbconvert" / "templates" / name
        template.mkdir(parents=True)
        reads = {"type": "numpy.float64"}
        (template / "conf.json").write_text(json.dumps({"preprocessors": {"1": reads}}))
    pandoc = home / ".local" / "share" / "pandoc"
    pandoc.mkdir(parents=True)
    (pandoc / "abbreviations").write_text("the\nof\na\n")
    for notebook in ("report.ipynb", "case.failed.ipynb"):
        (folder / notebook).write_text("{}")
    return {
        "HOME": str(home),
        "PYTHONPATH": f":{HOUSE}",  # an empty part of it stands for the folder at hand
        "PYTHONSTARTUP": str(home / "startup.py"),
        "JUPYTER_PATH": str(data),
        "IPYTHONDIR": str(home / ".ipython"),
        "MATPLOTLIBRC": str(home / "matplotlib"),
        "MPLBACKEND": "nothing-of-the-kind",
    }


def written(folder, environment):
    """Return the documents of a report that is made in the folder of its case."""
    case = folder / "case.yaml"
    case.write_text((HOUSE / "notebooks" / "tti-column.yaml").read_text("utf-8") + DATE)
    done = subprocess.run(
        [sys.executable, "-m", "pierimpact", "report", case.name, "--output", "out"],
        cwd=folder, env=os.environ | environment, capture_output=True, encoding="utf-8",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return [(folder / "out" / f"case.{ending}").read_bytes() for ending in ("html", "pdf")]


def test_a_hostile_folder_gives_the_same_bytes(tmp_path):
    clean, hostile, home = (tmp_path / name for name in ("clean", "hostile", "home"))
    for folder in (clean, hostile, home):
        folder.mkdir()
    environment = lay_traps(hostile, home)
    assert written(hostile, environment) == written(clean, {"PYTHONPATH": str(HOUSE)})
    assert not (hostile / "ran").exists()
