"""The house rules: style, types, direction of imports, notebooks without output, true README."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

HOUSE = Path(__file__).parents[1]
SCRIPTS = Path(sys.executable).parent

HOOKS = yaml.safe_load((HOUSE / ".pre-commit-config.yaml").read_text("utf-8"))["repos"][0]["hooks"]


@pytest.mark.parametrize("hook", HOOKS, ids=[hook["id"] for hook in HOOKS])
def test_rule_is_kept(hook):
    if hook["id"] == "types" and np.lib.NumpyVersion(np.__version__) < "2.4.0":
        pytest.skip("types follow the annotations of NumPy 2.4: pip install 'numpy>=2.4'")
    command, *arguments = shlex.split(hook["entry"])
    if hook.get("types") == ["jupyter"]:
        arguments += sorted((HOUSE / "notebooks").glob("*.ipynb"))
    elif hook.get("pass_filenames", True):
        arguments.append(".")
    done = subprocess.run(
        [SCRIPTS / command, *arguments],
        cwd=HOUSE,
        env=os.environ | {"RUFF_NO_CACHE": "true", "MYPY_CACHE_DIR": os.devnull},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_import_loads_nothing_heavy():
    heavy = ("scipy", "matplotlib", "IPython", "pint", "pydantic", "nbconvert")
    program = f"import sys, pierimpact; print([m for m in {heavy!r} if m in sys.modules])"
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=HOUSE, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


def test_pint_loads_no_dask_and_works_with_it_all_the_same():
    program = """
import sys
from pierimpact.units import parse
parse("x", "3 ft", "length")
assert "dask" not in sys.modules
import pint
import dask.array
assert "dask.base" in sys.modules
length = pint.UnitRegistry().Quantity(dask.array.ones(3), "m")
print(length.compute().sum(), dask.compute(length)[0].sum(), length.persist().compute().sum())
try:
    pint.UnitRegistry().Quantity(3, "m").compute()
except AttributeError as error:
    print(error)
"""
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=HOUSE, capture_output=True, text=True, check=True
    )
    sums, refused = done.stdout.splitlines()
    assert sums == "3.0 meter 3.0 meter 3.0 meter"
    assert refused.startswith("Method compute only implemented for objects of")


def test_every_public_name_is_there():
    import pierimpact

    for name in pierimpact.__all__:
        assert getattr(pierimpact, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'truk'"):
        pierimpact.truk  # noqa: B018


def test_every_dependency_is_justified():
    project = (HOUSE / "pyproject.toml").read_text(encoding="utf-8")
    asked = set(re.findall(r'^\s*"([a-zA-Z0-9_-]+)(?:\[\w+\])?>=', project, re.MULTILINE))
    asked |= set(re.findall(r'"([a-zA-Z0-9_-]+)>=[\d.]+"', project))
    justified = (HOUSE / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert {name for name in asked if f"`{name}`" not in justified} == set()


def test_links_of_the_readme_lead_somewhere():
    readme = (HOUSE / "README.md").read_text(encoding="utf-8")
    targets = re.findall(r"\]\((?!https?:)([^)#]+)\)", readme)
    assert targets
    assert [target for target in targets if not (HOUSE / target).exists()] == []


def test_python_of_the_start_runs(capsys):
    start = (HOUSE / "docs" / "start.md").read_text(encoding="utf-8")
    for program in re.findall(r"```python\n(.*?)```", start, re.DOTALL):
        exec(compile(program, "start.md", "exec"), {})
    printed = capsys.readouterr().out.strip().splitlines()
    engine_and_cargo, member_forces, governing, *band = printed
    assert len(engine_and_cargo.split()) == 2
    assert member_forces.count("BeamExtreme(value=") == 2
    assert governing.split()[1] in {"engine", "cargo"}
    assert "engine_mass" in " ".join(band)


def test_figures_of_the_evidence_are_those_of_the_study():
    evidence = (HOUSE / "docs" / "evidence.md").read_text(encoding="utf-8")
    study = json.loads((HOUSE / "pierimpact" / "design" / "study.json").read_text(encoding="utf-8"))
    for level in ("short (default)", "long"):
        found = study["predicted over CMSD"][level.split()[0]]["governing"]["all"]
        spread = 100.0 * found["coefficient of variation"]
        row = f"| {level} | {found['mean']:.2f} | {spread:.1f} % | {found['1st percentile']:.2f} |"
        assert row in evidence
