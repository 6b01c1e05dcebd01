"""From a case file to its report: the executed notebook, and the sheet as HTML, PDF or Word."""

import contextlib
import json
import logging
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from pierimpact.checks import InputError
from pierimpact.files.case import read_case_file
from pierimpact.files.unchanged import (
    ChangedError,
    put_unchanged,
    refuse_changed,
    remove_unchanged,
)
from pierimpact.files.write import temporary_folder
from pierimpact.report.results import Results
from pierimpact.resources import shipped

#: Modules and classes of the exporters by the endings of their files; slow to import.
_EXPORTERS = {
    ".html": ("pierimpact.report.exporters", "SheetHTMLExporter"),
    ".pdf": ("pierimpact.report.exporters", "SheetPDFExporter"),
    ".docx": ("pierimpact.report.word", "SheetWordExporter"),
}
# An error in a cell is in its output; the interrupt that ends the kernel is none.
_KERNEL_ARGUMENTS = ["--log-level=CRITICAL"]


class ReportError(RuntimeError):
    """The report of a valid case could not be made; the message says why in one line."""


class OutputError(InputError):
    """The output folder cannot be written to, whatever the case."""


class Report(NamedTuple):
    """The files of a report, warnings about them, and the results of the case."""

    notebook: Path
    html: Path
    pdf: Path
    warnings: list[str]
    results: Results
    docx: Path | None = None

    @property
    def files(self) -> list[Path]:
        """The files of the report."""
        return [file for file in (self.notebook, self.html, self.pdf, self.docx) if file]


def report_notebook() -> Path:
    """Return the path of the report's notebook."""
    return shipped("notebooks") / "report.ipynb"


def stages(docx: bool = False) -> int:
    """Return the number of stages of a report: one for each cell, and for each document."""
    notebook = json.loads(report_notebook().read_text(encoding="utf-8"))
    kinds = [cell["cell_type"] for cell in notebook["cells"]]
    return kinds.count("code") + 3 + docx  # papermill adds a cell


def write_report(
    case_path: str | Path,
    output_dir: str | Path = "reports",
    *,
    docx: bool = False,
    force: bool = False,
    on_stage: Callable[[], object] = lambda: None,
) -> Report:
    """Write the report of a case file: NAME.ipynb, .html, .pdf and, if wanted, .docx, all or none.

    Reports may be written in several threads at a time.

    Parameters
    ----------
    case_path : str or Path
        Case file; its name without ending is NAME.
    output_dir : str or Path, optional
        Folder to write to; created if it does not exist.
    docx : bool, optional
        Whether to write the sheet as a Word document too.
    force : bool, optional
        Whether to replace files that somebody changed since they were written.
    on_stage : callable, optional
        Called after each of its `stages`, possibly in other threads; an exception from it ends
        the report.

    Raises
    ------
    InputError
        When the case file breaks a rule, somebody changed a file that would be replaced, or the
        folder cannot be written to, which is an OutputError; nothing is written.
    ReportError
        When the notebook or a conversion fails; the notebook, if it is whole, is kept as
        NAME.failed.ipynb.
    """
    case_path, output_dir = Path(case_path).absolute(), Path(output_dir).absolute()
    parameters = read_case_file(case_path).parameters
    files = files_of(case_path.stem, docx)
    with folder_for(output_dir) as folder:
        _refuse_long_names(case_path, output_dir, files)
        refuse_changed(output_dir, files, force=force)
        executed, *documents = (folder / file for file in files)
        try:
            notebook = _execute(parameters, case_path.parent, executed, on_stage)
            results = Results.in_notebook(notebook)
            warnings = convert(notebook, documents, on_stage)
            executed, html, pdf, *word = put_unchanged(
                (executed, *documents), output_dir, force=force
            )
        except ChangedError:
            raise
        except Exception as error:
            reason, kept = reason_of(error), _keep(executed, output_dir)
            raise ReportError(f"{case_path.name}: {reason}{kept}") from error
    remove_unchanged(output_dir / _failed(case_path))
    return Report(executed, html, pdf, warnings, results, *word)


def files_of(name: str, docx: bool) -> list[str]:
    """Return the names of the files of a report, that of the notebook first."""
    return [f"{name}.{ending}" for ending in ("ipynb", "html", "pdf", "docx")[: 3 + docx]]


def _failed(file: Path) -> str:
    return f"{file.stem}.failed.ipynb"


def _refuse_long_names(case_path: Path, output_dir: Path, files: Sequence[str]) -> None:
    for file in files:
        try:
            os.lstat(output_dir / file)
        except FileNotFoundError:
            pass
        except OSError as error:
            raise InputError(
                f"{case_path.name}: {file} cannot be written to {output_dir}: {error.strerror}"
            ) from None


def _keep(notebook: Path, output_dir: Path) -> str:
    """Keep the notebook of a report that failed, if it is whole, and say where."""
    try:
        json.loads(notebook.read_bytes())
        (kept,) = put_unchanged(
            [notebook.rename(notebook.with_name(_failed(notebook)))], output_dir
        )
    except (OSError, ValueError):
        return ""
    return f"; the notebook is kept as {kept}"


def _execute(
    parameters: dict[str, Any], folder: Path, output: Path, on_stage: Callable[[], object]
) -> Any:
    """Execute the notebook in the case file's folder and return it."""
    papermill = _import_papermill()
    isolated = import_module("pierimpact.report.kernel").IsolatedKernelManager
    config = import_module("traitlets.config").Config()
    config.KernelManager.transport_encryption = "auto"  # or else the kernel prints a warning
    started = False

    def on_cell_executed(**_: object) -> None:
        nonlocal started
        started = True
        on_stage()

    def execute() -> Any:
        return papermill.execute_notebook(
            _as_papermill_has_it(report_notebook()),
            _as_papermill_has_it(output),
            parameters,
            # Papermill's own cwd is that of the process, which other reports share.
            resources={"metadata": {"path": str(folder)}},
            extra_arguments=_KERNEL_ARGUMENTS,
            kernel_name="python3",
            kernel_manager_class=isolated,
            progress_bar=False,
            request_save_on_cell_execute=False,
            shutdown_kernel="immediate",  # it has nothing to save
            config=config,
            on_cell_executed=on_cell_executed,
        )

    with ThreadPoolExecutor(1) as executor:
        executor.submit(_import_exporters)  # while the kernel works
        try:
            return execute()
        except RuntimeError:
            if started:
                raise
            # Another process may have taken the ports chosen for the kernel before it had them.
            return execute()


def _as_papermill_has_it(path: Path) -> str:
    """Return a path with its braces doubled: papermill fills in what stands in single ones."""
    return str(path).replace("{", "{{").replace("}", "}}")


def convert(
    notebook: Any, files: Sequence[Path], on_stage: Callable[[], object] = lambda: None
) -> list[str]:
    """Write an executed notebook to files, as what their endings say; return the warnings."""

    def write(file: Path) -> list[str]:
        document, resources = exporter_for(file)().from_notebook_node(notebook)
        file.write_bytes(document.encode() if isinstance(document, str) else document)
        on_stage()
        return list(resources.get("warnings", []))

    _import_exporters()
    with ThreadPoolExecutor(len(files)) as executor:
        return [warning for warnings in executor.map(write, files) for warning in warnings]


def exporter_for(file: Path) -> Any:
    """Return the exporter that writes files of this ending."""
    module, name = _EXPORTERS[file.suffix]
    return getattr(import_module(module), name)


def _import_exporters() -> None:
    for module, _ in _EXPORTERS.values():
        import_module(module)


def reason_of(error: BaseException) -> str:
    """Return in one line what failed."""
    if type(error).__name__ == "PapermillExecutionError":
        message = str(error.evalue).partition("\n")[0]  # type: ignore[attr-defined]
        return f"the notebook failed: {error.ename}: {message}"  # type: ignore[attr-defined]
    return f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"


@contextlib.contextmanager
def folder_for(output_dir: Path) -> Iterator[Path]:
    """Make the output folder, and a temporary folder in it for files to be put in place from.

    Raises
    ------
    OutputError
        When it cannot be made.
    """
    with contextlib.ExitStack() as stack:
        try:
            output_dir.mkdir(parents=True, exist_ok=True)
            folder = stack.enter_context(temporary_folder(output_dir))
        except (FileExistsError, NotADirectoryError):
            raise OutputError(
                f"output {output_dir} must be a folder, and there is a file"
            ) from None
        except OSError as error:
            raise OutputError(
                f"output {output_dir} cannot be written to: {error.strerror}"
            ) from None
        yield folder


def import_libraries() -> None:
    """Import all that is slow to import.

    A single report imports the exporters while its kernel works; before several are written side
    by side, one thread imports everything, so that no other meets a half-imported module.
    """
    _import_papermill()
    _import_exporters()


def _import_papermill() -> Any:
    """Import papermill, in one to two seconds less where JupyterLab is installed.

    There jsonschema, with which papermill checks notebooks, finds rfc3987_syntax, which compiles
    a grammar of web addresses on import; notebooks have none to check.
    """
    logging.getLogger("papermill").addHandler(logging.NullHandler())  # its errors are raised
    logging.getLogger("papermill").propagate = False
    grammar = "rfc3987_syntax"
    modules: dict[str, Any] = sys.modules
    modules.setdefault(grammar, None)
    try:
        return import_module("papermill")
    finally:
        if modules.get(grammar) is None:
            modules.pop(grammar, None)  # another thread may have been here first
