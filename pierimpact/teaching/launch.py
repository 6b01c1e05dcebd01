"""Opening the teaching notebooks: in JupyterLab, or the explorer alone as a Voilà page."""

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

from pierimpact.checks import InputError
from pierimpact.files.write import write_files
from pierimpact.resources import PACKAGE, shipped

#: Folder for the reader's own copies, unless another is asked for.
DEFAULT_FOLDER = "pierimpact-notebooks"


class TeachError(RuntimeError):
    """The notebooks cannot be opened; the message says why in one line."""


def copy_notebooks(folder: str | Path = DEFAULT_FOLDER) -> Path:
    """Copy the notebooks to a folder of the reader's; what is there already is kept as it is.

    Parameters
    ----------
    folder : str or Path, optional
        Where to; it is made if there is none.

    Returns
    -------
    Path
        The folder, absolute.

    Raises
    ------
    InputError
        When the folder cannot be written to.
    """
    folder, ours = Path(folder).absolute(), shipped("notebooks")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        files = (*ours.glob("0*.ipynb"), ours / "explorer.ipynb", *ours.glob("*.yaml"))
        write_files(
            {
                folder / file.name: file.read_bytes()
                for file in files
                if not (folder / file.name).exists()
            }
        )
    except OSError as error:
        raise InputError(f"folder {folder} cannot be written to: {error.strerror}") from None
    return folder


def open_notebooks(
    folder: str | Path = DEFAULT_FOLDER, *, app: bool = False, browser: bool = True
) -> int:
    """Open the course in JupyterLab, or the explorer alone; return the exit code when it ends.

    Parameters
    ----------
    folder : str or Path, optional
        Where the reader's copies of the notebooks are, or come to be.
    app : bool, optional
        Whether to serve the explorer as a page without code, by Voilà.
    browser : bool, optional
        Whether to open a browser.

    Raises
    ------
    InputError
        When the folder cannot be written to.
    TeachError
        When JupyterLab, or Voilà, or the widgets are not installed.
    """
    program, notebook = ("voila", "explorer") if app else ("jupyterlab", "01_collision")
    _need(program, "anywidget")
    options = [] if browser else ["--no-browser"]
    return _run([program, *options, f"{notebook}.ipynb"], copy_notebooks(folder))


def _need(*modules: str) -> None:
    for module in modules:
        if find_spec(module) is None:
            raise TeachError(
                f"the notebooks need {module}: python -m pip install 'pierimpact[teach]'"
            )


def _run(arguments: list[str], folder: Path) -> int:
    # The kernels start in the reader's folder, where a checkout would not be found.
    paths = [str(PACKAGE.parent), *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(paths)}
    command = [sys.executable, "-m", *arguments]
    if sys.platform != "win32":
        # The server takes this process over, so that whatever signal ends this ends it too.
        sys.stdout.flush()
        os.chdir(folder)
        os.execve(sys.executable, command, environment)
    return subprocess.run(command, cwd=folder, env=environment, check=False).returncode
