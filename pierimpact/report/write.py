"""From a case file to its report: the executed notebook, and the sheet as HTML, PDF or Word."""

import contextlib
import json
import logging
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from pierimpact.checks import InputError
from pierimpact.files.case import CaseFile, read_case_file
from pierimpact.files.unchanged import (
    ChangedError,
    put_unchanged,
    refuse_changed,
    remove_unchanged,
)
from pierimpact.files.write import temporary_folder
from pierimpact.report.results import Results
from pierimpact.resources import shipped

if TYPE_CHECKING:
    from pierimpact.report.document.blocks import Block
    from pierimpact.report.kernel import Kernels

#: Modules and classes of the exporters by the endings of their files; slow to import.
_EXPORTERS = {
    ".html": ("pierimpact.report.exporters", "SheetHTMLExporter"),
    ".pdf": ("pierimpact.report.exporters", "SheetPDFExporter"),
    ".docx": ("pierimpact.report.word", "SheetWordExporter"),
}


_ANNEX = "annex-"  # of the tags of cells, before the name of their annex


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
    """Return the number of stages of a report: one for each cell of no annex, and each document."""
    cells = json.loads(report_notebook().read_text(encoding="utf-8"))["cells"]
    always = [cell for cell in cells if cell["cell_type"] == "code" and not _annex_of(cell)]
    return len(always) + 3 + docx  # papermill adds a cell


def _annex_of(cell: Mapping[str, Any]) -> str:
    """Return the annex that a cell of the notebook belongs to, or nothing."""
    tags = (tag for tag in cell["metadata"].get("tags", ()) if tag.startswith(_ANNEX))
    return next(tags, "").removeprefix(_ANNEX)


def write_report(
    case_path: str | Path,
    output_dir: str | Path = "reports",
    *,
    docx: bool = False,
    force: bool = False,
    kernels: "Kernels | None" = None,
    on_stage: Callable[[], object] = lambda: None,
) -> Report:
    """Write the report of a case file: NAME.ipynb, .html, .pdf and, if wanted, .docx, all or none.

    A Word document of an earlier report goes where none is wanted, unless somebody changed it.
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
    kernels : Kernels, optional
        Kernels to take one from, and to leave it with for the next report.
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
    if kernels is None:
        with start_kernels([case_path]) as own:
            return write_report(
                case_path, output_dir, docx=docx, force=force, kernels=own, on_stage=on_stage
            )
    case_file = read_case_file(case_path)
    files = files_of(case_path.stem, docx)
    with folder_for(output_dir) as folder:
        _refuse_names(case_path, output_dir, files)
        refuse_changed(output_dir, files, force=force)
        executed, *documents = (folder / file for file in files)
        try:
            notebook = _execute(case_file, case_path.parent, executed, kernels, on_stage)
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
    if not docx:
        remove_unchanged(output_dir / f"{case_path.stem}.docx")
    return Report(executed, html, pdf, warnings, results, *word)


def start_kernels(cases: Sequence[Path], at_once: int = 1) -> "Kernels":
    """Start kernels for the reports of cases, so many at once, before what takes long to import."""
    module = import_module("pierimpact.report.kernel")
    kernels: Kernels = module.Kernels(cases, min(at_once, len(cases)))
    return kernels


def files_of(name: str, docx: bool) -> list[str]:
    """Return the names of the files of a report, that of the notebook first."""
    return [f"{name}.{ending}" for ending in ("ipynb", "html", "pdf", "docx")[: 3 + docx]]


def _failed(file: Path) -> str:
    return f"{file.stem}.failed.ipynb"


def _refuse_names(case_path: Path, output_dir: Path, files: Sequence[str]) -> None:
    """Refuse names that are too long, or cannot be printed in the files."""
    for file in files:
        reason: str | None = None
        try:
            (output_dir / file).lstat()
        except FileNotFoundError:
            pass
        except OSError as error:
            reason = error.strerror
        if not is_utf8(file):
            reason = "Its name is not in UTF-8"
        if reason:
            raise InputError(
                f"{case_path.name}: {file} cannot be written to {output_dir}: {reason}"
            )


def is_utf8(name: str) -> bool:
    """Whether a name is in UTF-8, in which it has no halves of characters."""
    return not any("\ud800" <= letter <= "\udfff" for letter in name)


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
    case_file: CaseFile,
    folder: Path,
    output: Path,
    kernels: "Kernels",
    on_stage: Callable[[], object],
) -> Any:
    """Execute the notebook, without annexes that are not asked for, in the case file's folder."""
    papermill, started = _import_papermill(), False

    def on_cell_executed(cell: Mapping[str, Any], **_: object) -> None:
        nonlocal started
        started = True
        if not _annex_of(cell):
            on_stage()

    def execute() -> Any:
        with kernels.in_folder(folder) as kernel:
            return papermill.execute_notebook(
                notebook,
                _as_papermill_has_it(output),
                case_file.parameters,
                km=kernel,
                kernel_name="python3",
                progress_bar=False,
                request_save_on_cell_execute=False,
                on_cell_executed=on_cell_executed,
            )

    notebook = import_module("nbformat").read(report_notebook(), as_version=4)
    asked = {"", *case_file.case.annexes}
    notebook.cells = [cell for cell in notebook.cells if _annex_of(cell) in asked]
    with ThreadPoolExecutor(1) as executor:
        executor.submit(_import_exporters)  # while the kernel starts and works
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


def write_blocks(blocks: Iterable["Block"], files: Sequence[Path]) -> None:
    """Write a document of these blocks to files, as what their endings say."""
    with _without_grammar():
        notebook_of = import_module("pierimpact.report.exporters").notebook_of
    convert(notebook_of(blocks), files)


def convert(
    notebook: Any, files: Sequence[Path], on_stage: Callable[[], object] = lambda: None
) -> list[str]:
    """Write an executed notebook to files, as what their endings say; return the warnings."""

    def write(file: Path) -> list[str]:
        # What it puts there for a while is gone with that folder, even if this process is killed.
        place = {"temporary_folder": str(file.parent)}
        document, resources = exporter_for(file.suffix).from_notebook_node(notebook, place)
        file.write_bytes(document.encode() if isinstance(document, str) else document)
        on_stage()
        return list(resources.get("warnings", []))

    for file in files:
        exporter_for(file.suffix)  # imported by one thread only
    with ThreadPoolExecutor(len(files)) as executor:
        return [warning for warnings in executor.map(write, files) for warning in warnings]


@cache
def exporter_for(ending: str) -> Any:
    """Return the exporter that writes files of this ending, with its template read."""
    module, name = _EXPORTERS[ending]
    with _without_grammar():
        exporter = getattr(import_module(module), name)()
    assert exporter.template
    return exporter


def _import_exporters() -> None:
    for ending in _EXPORTERS:
        exporter_for(ending)


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
    if not is_utf8(str(output_dir)):
        raise OutputError(f"output {output_dir} must have a name in UTF-8")
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
    logging.getLogger("papermill").addHandler(logging.NullHandler())  # its errors are raised
    logging.getLogger("papermill").propagate = False
    with _without_grammar():
        return import_module("papermill")


@contextlib.contextmanager
def _without_grammar() -> Iterator[None]:
    """Import what checks notebooks in one to two seconds less where JupyterLab is installed.

    There jsonschema, which checks them, finds rfc3987_syntax, which compiles a grammar of web
    addresses on import; notebooks have none to check.
    """
    grammar = "rfc3987_syntax"
    modules: dict[str, Any] = sys.modules
    modules.setdefault(grammar, None)
    try:
        yield
    finally:
        if modules.get(grammar) is None:
            modules.pop(grammar, None)  # another thread may have been here first
