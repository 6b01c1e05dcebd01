"""From a case file to its report: the executed notebook, an HTML page and a PDF."""

import contextlib
import datetime
import json
import logging
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from pierimpact.checks import InputError
from pierimpact.files.case import Case, case_values, file_hash, read_case
from pierimpact.resources import PACKAGE, shipped

_EXPORTERS = "pierimpact.report.exporters"
_KERNEL_ARGUMENTS = [
    # Lets the kernel, which starts in another folder, import this very package.
    f"--IPKernelApp.exec_lines=import sys; sys.path.insert(0, {str(PACKAGE.parent)!r})",
    # What goes wrong in a cell is told by the cell; that it is interrupted at its end, by none.
    "--log-level=CRITICAL",
]


class ReportError(RuntimeError):
    """The report of a good case could not be made; the message says why in one line."""


class OutputError(InputError):
    """The folder to write to cannot be written to, by no report."""


class Report(NamedTuple):
    """The files of a report, what is wrong with them, and the case they report."""

    notebook: Path
    html: Path
    pdf: Path
    warnings: list[str]
    case: Case


def report_notebook() -> Path:
    """Return the path of the report's notebook."""
    return shipped("notebooks") / "report.ipynb"


def stages() -> int:
    """Return how often a report tells of its progress: per cell, and for HTML and PDF."""
    notebook = json.loads(report_notebook().read_text(encoding="utf-8"))
    kinds = [cell["cell_type"] for cell in notebook["cells"]]
    return kinds.count("code") + 3  # papermill adds a cell


def write_report(
    case_path: str | Path,
    output_dir: str | Path = "reports",
    *,
    on_stage: Callable[[], object] = lambda: None,
) -> Report:
    """Write the report of a case file: NAME.ipynb, NAME.html and NAME.pdf, all or none.

    Reports may be written in several threads at a time.

    Parameters
    ----------
    case_path : str or Path
        Case file; its name without ending is NAME.
    output_dir : str or Path, optional
        Folder to write to; it is made if there is none.
    on_stage : callable, optional
        Called after each of its `stages`, perhaps in other threads; what it raises ends the
        report.

    Raises
    ------
    InputError
        When the case file breaks a rule, or the folder cannot be written to, which is an
        OutputError; nothing is written.
    ReportError
        When the notebook or a conversion fails; the notebook is kept as NAME.failed.ipynb.
    """
    case_path, output_dir = Path(case_path).absolute(), Path(output_dir).absolute()
    case = read_case(case_path)
    parameters = _parameters(case_path)
    name = case_path.stem
    failed = output_dir / f"{name}.failed.ipynb"
    with folder_for(output_dir, name) as folder:
        files = {ending: folder / f"{name}.{ending}" for ending in ("ipynb", "html", "pdf")}
        try:
            notebook = _execute(parameters, case_path.parent, files["ipynb"], on_stage)
            warnings = _convert(notebook, files, on_stage)
            put_in_place(files.values(), output_dir)
        except Exception as error:
            message = f"{case_path.name}: {reason_of(error)}"
            if files["ipynb"].is_file():
                files["ipynb"].replace(failed)
                message += f"; the notebook is kept as {failed}"
            raise ReportError(message) from error
    failed.unlink(missing_ok=True)
    notebook_path, html, pdf = (output_dir / file.name for file in files.values())
    return Report(notebook_path, html, pdf, warnings, case)


@contextlib.contextmanager
def folder_for(output_dir: Path, name: str) -> Iterator[Path]:
    """Make a folder in `output_dir` to write files called `name` in; it is gone afterwards.

    Raises
    ------
    OutputError
        When it cannot be made.
    """
    try:
        output_dir.mkdir(parents=True, exist_ok=True)
        folder = tempfile.TemporaryDirectory(dir=output_dir, prefix=f".{name}-")
    except (FileExistsError, NotADirectoryError):
        raise OutputError(f"output {output_dir} must be a folder, and there is a file") from None
    except OSError as error:
        raise OutputError(f"output {output_dir} cannot be written to: {error.strerror}") from None
    with folder:
        yield Path(folder.name)


def put_in_place(files: Iterable[Path], output_dir: Path) -> None:
    """Move finished files to where they belong, the last first.

    That is the one most likely to be open in a viewer that locks it.
    """
    for file in reversed(list(files)):
        file.replace(output_dir / file.name)


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


def import_libraries() -> None:
    """Import what takes a while to import, all of it.

    A single report imports the exporters while its kernel works; before several are written side
    by side, one thread imports it all, and no other meets a module that is half imported.
    """
    _import_papermill()
    import_module(_EXPORTERS)


def _import_papermill() -> Any:
    # What goes wrong is raised, and told once.
    logging.getLogger("papermill").addHandler(logging.NullHandler())
    logging.getLogger("papermill").propagate = False
    with _without_web_address_grammar():
        return import_module("papermill")


def _execute(
    parameters: dict[str, Any], folder: Path, output: Path, on_stage: Callable[[], object]
) -> Any:
    """Execute the notebook in the case file's folder and return it."""
    with _without_web_address_grammar():
        papermill = import_module("papermill")
        config = import_module("traitlets.config").Config()
    config.KernelManager.transport_encryption = "auto"  # or else the kernel prints a warning
    started = False

    def on_cell_executed(**_: object) -> None:
        nonlocal started
        started = True
        on_stage()

    def execute() -> Any:
        return papermill.execute_notebook(
            report_notebook(),
            output,
            parameters,
            # Papermill's own cwd is that of the process, which other reports share.
            resources={"metadata": {"path": str(folder)}},
            extra_arguments=_KERNEL_ARGUMENTS,
            kernel_name="python3",
            progress_bar=False,
            request_save_on_cell_execute=False,
            shutdown_kernel="immediate",  # it has nothing to put away
            config=config,
            on_cell_executed=on_cell_executed,
        )

    # The exporters take a while to import: that is done while the kernel works.
    with ThreadPoolExecutor(1) as executor:
        executor.submit(import_module, _EXPORTERS)
        try:
            return execute()
        except RuntimeError:
            if started:
                raise
            # Somebody else may have taken the ports chosen for the kernel before it had them.
            return execute()


def _convert(notebook: Any, files: dict[str, Path], on_stage: Callable[[], object]) -> list[str]:
    """Write the executed notebook as HTML and as PDF; return the warnings."""
    exporters = import_module(_EXPORTERS)

    def write_html() -> None:
        page, _ = exporters.SheetHTMLExporter().from_notebook_node(notebook)
        files["html"].write_text(page, encoding="utf-8")
        on_stage()

    def write_pdf() -> list[str]:
        pdf, resources = exporters.SheetPDFExporter().from_notebook_node(notebook)
        files["pdf"].write_bytes(pdf)
        on_stage()
        return list(resources["warnings"])

    with ThreadPoolExecutor(2) as executor:
        html, pdf = executor.submit(write_html), executor.submit(write_pdf)
        html.result()
        return pdf.result()


def reason_of(error: Exception) -> str:
    """Return in one line what failed."""
    if type(error).__name__ == "PapermillExecutionError":
        message = str(error.evalue).partition("\n")[0]  # type: ignore[attr-defined]
        return f"the notebook failed: {error.ename}: {message}"  # type: ignore[attr-defined]
    return f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"


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
        sys.modules.pop(absent, None)  # another thread may have been here first
