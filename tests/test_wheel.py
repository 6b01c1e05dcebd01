"""The wheel, installed elsewhere, makes the report by itself, and says where it is from."""

import importlib.util
import os
import shutil
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest

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


@pytest.fixture(scope="module")
def addresses():
    spec = importlib.util.spec_from_file_location("addresses", ROOT / ".ci" / "addresses.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    "remote",
    [
        "https://forge.example.org/team/pierimpact.git",
        "https://forge.example.org/team/pierimpact/",
        "https://somebody:secret@forge.example.org:8443/team/pierimpact",
        "git@forge.example.org:team/pierimpact.git",
        "ssh://git@forge.example.org:2222/team/pierimpact.git",
    ],
)
def test_the_address_of_a_public_remote_is_its_page(addresses, remote):
    assert addresses.address(remote) == "https://forge.example.org/team/pierimpact"


@pytest.mark.parametrize(
    "remote",
    [
        "", "/srv/git/pierimpact.git", "../pierimpact", "file:///srv/git/pierimpact",
        "http://localhost:3000/team/pierimpact", "http://10.0.0.7/team/pierimpact",
        "git@forge:team/pierimpact.git",
    ],
)  # fmt: skip
def test_a_remote_that_is_not_public_has_no_address(addresses, remote):
    assert addresses.address(remote) is None


def test_built_from_a_clone_it_names_its_remote_and_so_does_its_archive(addresses, tmp_path):
    if not shutil.which("git"):
        pytest.skip("needs git: apt install git")
    hook = addresses.Addresses(str(tmp_path), {})
    run("git", "init", "-q", tmp_path)
    hook.update(found := {})
    assert found == {"urls": {}}
    run("git", "-C", tmp_path, "remote", "add", "origin", "git@forge.example.org:team/pierimpact")
    hook.update(found)
    home = "https://forge.example.org/team/pierimpact"
    assert found["urls"] == {"Repository": home, "Issues": f"{home}/issues"}
    shutil.rmtree(tmp_path / ".git")
    (tmp_path / "PKG-INFO").write_text(f"Name: pierimpact\nProject-URL: Repository, {home}\n")
    hook.update(found)
    assert found["urls"]["Repository"] == home
