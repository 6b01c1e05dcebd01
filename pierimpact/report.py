"""From a case file to its report: the executed notebook, an HTML page and a PDF."""

import contextlib
import datetime
import os
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from tqdm import tqdm

from pierimpact.casefile import case_values, file_hash, read_case
from pierimpact.checks import InputError

_PACKAGE = Path(__file__).parent


class ReportError(RuntimeError):
    """The report of a good case could not be made; the message says why in one line."""


class Report(NamedTuple):
    """The files of a report, and what is wrong with them."""

    notebook: Path
    html: Path
    pdf: Path
    warnings: list[str]


def report_notebook() -> Path:
    """Return the path of the report's notebook: in an installed package, or in a checkout."""
    installed = _PACKAGE / "notebooks" / "report.ipynb"
    return installed if installed.is_file() else _PACKAGE.parent / "notebooks" / "report.ipynb"


def write_report(
    case_path: str | Path, output_dir: str | Path = "reports", *, progress: bool = True
) -> Report:
    """Write the report of a case file: NAME.ipynb, NAME.html and NAME.pdf, all or none.

    Parameters
    ----------
    case_path : str or Path
        Case file; its name without ending is NAME.
    output_dir : str or Path, optional
        Folder to write to; it is made if there is none.
    progress : bool, optional
        Whether to show a progress bar, where there is a terminal to show it on.

    Raises
    ------
    InputError
        When the case file breaks a rule; nothing is written.
    ReportError
        When the notebook or a conversion fails; the notebook is kept as NAME.failed.ipynb.
    """
    case_path, output_dir = Path(case_path).absolute(), Path(output_dir).absolute()
    read_case(case_path)
    parameters = _parameters(case_path)
    name = case_path.stem
    try:
        output_dir.mkdir(parents=True, exist_ok=True)
        folder = tempfile.TemporaryDirectory(dir=output_dir, prefix=f".{name}-")
    except OSError as error:
        raise InputError(f"output {output_dir} cannot be written to: {error.strerror}") from None
    failed = output_dir / f"{name}.failed.ipynb"
    files = {ending: Path(folder.name) / f"{name}.{ending}" for ending in ("ipynb", "html", "pdf")}
    with folder, tqdm(desc=name, disable=None if progress else True, leave=False) as bar:
        try:
            notebook = _execute(parameters, case_path.parent, files["ipynb"], bar)
            warnings = _convert(notebook, files, bar)
        except Exception as error:
            message = _reason(error)
            if files["ipynb"].is_file():
                files["ipynb"].replace(failed)
                message += f"; the notebook is kept as {failed}"
            raise ReportError(message) from error
        for file in files.values():
            file.replace(output_dir / file.name)
    failed.unlink(missing_ok=True)
    notebook_path, html, pdf = (output_dir / file.name for file in files.values())
    return Report(notebook_path, html, pdf, warnings)


def _parameters(case_path: Path) -> dict[str, Any]:
    """Return the notebook's parameters, as plain values."""
    values = case_values(case_path) | {
        "case_file": case_path.name,
        "case_sha256": file_hash(case_path),
    }
    return {
        key: value.isoformat() if isinstance(value, datetime.date) else value
        for key, value in values.items()
    }


def _execute(parameters: dict[str, Any], folder: Path, output: Path, bar: Any) -> Any:
    """Execute the notebook in the case file's folder and return it."""
    with _without_web_address_grammar():
        papermill = import_module("papermill")
        config = import_module("traitlets.config").Config()
    config.KernelManager.transport_encryption = "auto"  # or else the kernel prints a warning
    # The exporters take a while to import: that is done while the kernel works.
    with ThreadPoolExecutor(1) as executor, _importable_package():
        executor.submit(import_module, "pierimpact.exporters")
        notebook = papermill.iorw.load_notebook_node(str(report_notebook()))
        bar.reset(total=sum(cell.cell_type == "code" for cell in notebook.cells) + 3)
        return papermill.execute_notebook(
            report_notebook(),
            output,
            parameters,
            cwd=folder,
            kernel_name="python3",
            progress_bar=False,
            request_save_on_cell_execute=False,
            shutdown_kernel="immediate",  # it has nothing to put away
            config=config,
            on_cell_executed=lambda **_: bar.update(),
        )


def _convert(notebook: Any, files: dict[str, Path], bar: Any) -> list[str]:
    """Write the executed notebook as HTML and as PDF; return the warnings."""
    exporters = import_module("pierimpact.exporters")

    def write_html() -> None:
        page, _ = exporters.SheetHTMLExporter().from_notebook_node(notebook)
        files["html"].write_text(page, encoding="utf-8")
        bar.update()

    def write_pdf() -> list[str]:
        pdf, resources = exporters.SheetPDFExporter().from_notebook_node(notebook)
        files["pdf"].write_bytes(pdf)
        bar.update()
        return list(resources["warnings"])

    with ThreadPoolExecutor(2) as executor:
        html, pdf = executor.submit(write_html), executor.submit(write_pdf)
        html.result()
        return pdf.result()


def _reason(error: Exception) -> str:
    """Return in one line what failed."""
    if type(error).__name__ == "PapermillExecutionError":
        message = str(error.evalue).partition("\n")[0]  # type: ignore[attr-defined]
        return f"the notebook failed: {error.ename}: {message}"  # type: ignore[attr-defined]
    return f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"


@contextlib.contextmanager
def _importable_package() -> Iterator[None]:
    """Let the kernel, which starts in another folder, import this very package."""
    before = os.environ.get("PYTHONPATH")
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (str(_PACKAGE.parent), before)))
    try:
        yield
    finally:
        if before is None:
            del os.environ["PYTHONPATH"]
        else:
            os.environ["PYTHONPATH"] = before


@contextlib.contextmanager
def _without_web_address_grammar() -> Iterator[None]:
    """Keep jsonschema from an import of one to two seconds that no notebook needs.

    Where JupyterLab is installed, jsonschema finds rfc3987_syntax, which compiles a grammar of
    web addresses on import; papermill imports jsonschema to check notebooks, which have none.
    """
    absent = "rfc3987_syntax"
    if absent in sys.modules:
        yield
        return
    sys.modules[absent] = None  # type: ignore[assignment]
    try:
        yield
    finally:
        del sys.modules[absent]
