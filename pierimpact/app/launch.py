"""Opening the form: a page of its own, by Voilà, for this machine only."""

import json
from importlib import import_module
from pathlib import Path
from typing import Any

from pierimpact.app.session import Session
from pierimpact.files.scratch import ScratchFolder

_NAME = "pierimpact.ipynb"  # which is the page's title


def open_form(case: str | Path | None = None, *, browser: bool = True) -> None:
    """Serve the form until a signal ends it.

    Parameters
    ----------
    case : str or Path, optional
        Case file to begin with; an example where there is none. Nothing is written to its folder.
    browser : bool, optional
        Whether to open a browser.

    Raises
    ------
    InputError
        When the case file cannot be read.
    ModuleNotFoundError
        When Voilà or the widgets are not installed.
    """
    path = None if case is None else Path(case).absolute()
    Session(path).close()  # an error here is better than one on the page
    import_module("anywidget")
    server: Any = import_module("pierimpact.teaching.server")  # slow to import
    import_module("voila")
    with ScratchFolder() as folder:
        notebook = Path(folder) / _NAME
        notebook.write_text(_notebook(None if path is None else str(path)), encoding="utf-8")
        server.serve_page(notebook, browser=browser)


def _notebook(case: str | None) -> str:
    """Return a notebook that shows the form."""
    cell: dict[str, object] = {
        "cell_type": "code",
        "execution_count": None,
        "id": "form",
        "metadata": {},
        "outputs": [],
        "source": f"from pierimpact.app.page import Form\n\nForm({case!r})",
    }
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}}
    return json.dumps({"cells": [cell], "metadata": metadata, "nbformat": 4, "nbformat_minor": 5})
