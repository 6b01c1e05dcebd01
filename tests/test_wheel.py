"""The wheel, installed elsewhere, makes the report by itself."""

import os
import shutil
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

ROOT = Path(__file__).parent.parent


def run(*command, **options):
    done = subprocess.run(
        [str(part) for part in command],
        capture_output=True,
        encoding="utf-8",
        **options,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_report_from_the_installed_wheel(tmp_path):
    run(
        sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", tmp_path / "dist",
        ROOT,
    )  # fmt: skip
    (wheel,) = (tmp_path / "dist").glob("*.whl")
    environment = tmp_path / "venv"
    venv.create(environment, with_pip=False)
    python = environment / "bin" / "python"
    site = Path(run(python, "-c", "import site; print(site.getsitepackages()[0])").strip())
    run(sys.executable, "-m", "pip", "--python", python, "install", "--no-deps", "-q", wheel)
    # What pierimpact needs is taken from here, which spares installing it all again.
    (site / "here.pth").write_text(sysconfig.get_path("purelib"))

    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    shutil.copy(ROOT / "notebooks" / "tti-column.yaml", elsewhere / "case.yaml")
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    module = run(
        python, "-c", "import pierimpact; print(pierimpact.__file__)", cwd=elsewhere, env=clean
    )
    assert Path(module.strip()).is_relative_to(site)
    printed = run(
        environment / "bin" / "pierimpact", "report", "case.yaml", cwd=elsewhere, env=clean
    )
    files = [Path(line) for line in printed.splitlines()]
    assert [file.name for file in files] == ["case.ipynb", "case.html", "case.pdf"]
    assert all(file.parent == elsewhere / "reports" for file in files)
    assert files[2].read_bytes().startswith(b"%PDF")
    # The exporters are nbconvert's too.
    run(
        python, "-m", "nbconvert", "--to", "pierimpact_pdf", "--output", "again", files[0],
        cwd=elsewhere, env=clean,
    )  # fmt: skip
    assert (elsewhere / "reports" / "again.pdf").read_bytes() == files[2].read_bytes()
