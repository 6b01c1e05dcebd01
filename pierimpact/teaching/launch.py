"""Opening the teaching notebooks: in JupyterLab, or the explorer alone as a Voilà page."""

from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from pierimpact.checks import InputError
from pierimpact.files.write import write_files
from pierimpact.resources import shipped

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
) -> None:
    """Serve the course in JupyterLab, or the explorer alone, until a signal ends it.

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
    _need("voila" if app else "jupyterlab", "anywidget")
    server: Any = import_module("pierimpact.teaching.server")  # slow to import
    folder = copy_notebooks(folder)
    if app:
        server.serve_page(folder / "explorer.ipynb", browser=browser)
    else:
        server.serve_course(folder, "01_collision.ipynb", browser=browser)


def _need(*modules: str) -> None:
    for module in modules:
        if find_spec(module) is None:
            raise TeachError(
                f"the notebooks need {module}: python -m pip install 'pierimpact[teach]'"
            )
