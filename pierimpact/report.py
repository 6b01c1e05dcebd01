"""From a case file to the executed notebook, an HTML page and a PDF."""

import os
import shutil
import tempfile
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from tqdm import tqdm

from pierimpact.casefile import case_values, file_hash, read_case
from pierimpact.checks import InputError

_PACKAGE = Path(__file__).parent


class ReportError(RuntimeError):
    """A report could not be made; the message says in one line why."""


class Report(NamedTuple):
    """The files of a report."""

    notebook: Path
    html: Path
    pdf: Path


def report_notebook() -> Path:
    """Return the path of the report's notebook: in an installed package, or in a checkout."""
    installed = _PACKAGE / "notebooks" / "report.ipynb"
    return installed if installed.is_file() else _PACKAGE.parent / "notebooks" / "report.ipynb"
