"""Several cases: a report of each, some at a time, and a summary of all of them."""

import logging
import os
import unicodedata
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from importlib import import_module
from pathlib import Path
from threading import Event, Lock
from typing import TYPE_CHECKING, NamedTuple

from tqdm import tqdm

from pierimpact.checks import InputError
from pierimpact.files.find import find_case_files
from pierimpact.files.unchanged import put_unchanged, refuse_changed, written_before
from pierimpact.report.summary import Row, current, summary_blocks, summary_csv
from pierimpact.report.write import (
    Report,
    ReportError,
    files_of,
    folder_for,
    import_libraries,
    reason_of,
    stages,
    start_kernels,
    write_blocks,
    write_report,
)

if TYPE_CHECKING:
    from pierimpact.report.kernel import Kernels

_log = logging.getLogger("pierimpact")
SUMMARY = "summary"  # name of the files of the summary, without ending
BINDER = "binder"  # name of the file of all sheets in one, without ending

# Nearly all the work is the kernels', which are processes of their own.
_AT_ONCE = min(4, os.cpu_count() or 1)


class Failure(NamedTuple):
    """A case without a report."""

    case: Path
    reason: str  #: one line that names the case
    bad_input: bool  #: whether the case file is to blame


class Summary(NamedTuple):
    """The files of the summary."""

    html: Path
    pdf: Path
    csv: Path
    docx: Path | None = None


class Batch(NamedTuple):
    """The reports, failures and summary of several cases, in the order the cases were given."""

    reports: list[Report]
    failures: list[Failure]
    summary: Summary | None
    summary_failure: str = ""  #: why the summary could not be written, in one line
    binder: Path | None = None
    binder_failure: str = ""  #: why the binder could not be written, in one line
    left: Sequence[Path] = ()  #: files of these names by earlier runs, not written again

    @property
    def files(self) -> set[Path]:
        """All files of the batch."""
        whole = [*(self.summary or ()), self.binder]
        return {file for report in self.reports for file in report.files} | set(filter(None, whole))


def find_cases(paths: Iterable[str | Path], *, binder: bool = False) -> list[Path]:
    """Return the case files at the given paths, as `find_case_files`, for a report of each.

    Parameters
    ----------
    paths : iterable of str or Path
        Case files and folders.
    binder : bool, optional
        Whether the cases will be bound, so that none may be called as the binder is.

    Raises
    ------
    InputError
        When there is no case in a folder, or two cases would write the same files.
    """
    cases = find_case_files(paths)
    _refuse_same_names(cases, binder)
    return cases


def write_reports(
    cases: Sequence[Path],
    output_dir: str | Path = "reports",
    *,
    docx: bool = False,
    binder: bool = False,
    force: bool = False,
    progress: bool = True,
) -> Batch:
    """Write the report of each case and, of more than one, summary.html, .pdf and .csv.

    A case that fails stops none of the others, and a summary or a binder that fails leaves the
    reports. There is neither if no case has a report.

    Parameters
    ----------
    cases : sequence of Path
        Case files, from `find_cases`.
    output_dir : str or Path, optional
        Folder to write to; created if it does not exist.
    docx : bool, optional
        Whether to write each sheet, and the summary, as a Word document too.
    binder : bool, optional
        Whether to write binder.pdf too: contents, summary and all sheets in one, bookmarked, but
        for those that another of the cases supersedes.
    force : bool, optional
        Whether to replace files that somebody changed since they were written.
    progress : bool, optional
        Whether to show a progress bar if the output is a terminal.

    Raises
    ------
    InputError
        When somebody changed files that would be replaced, or the folder cannot be written to,
        which is an OutputError; nothing is written.
    KeyboardInterrupt
        When interrupted; it says how many reports were written, if any, each of them whole.
    """
    output_dir = Path(output_dir).absolute()
    _refuse_to_overwrite(cases, output_dir, docx, binder, force)
    results = _write_all(cases, output_dir, docx, force, progress)
    reports = [result for result in results if isinstance(result, Report)]
    failures = [result for result in results if isinstance(result, Failure)]
    batch, rows = Batch(reports, failures, None), _rows(cases, results)
    try:
        if len(cases) > 1 and reports:
            try:
                batch = batch._replace(summary=_write_summary(rows, output_dir, docx, force))
            except Exception as error:
                batch = batch._replace(summary_failure=f"the summary: {_line(reason_of(error))}")
        if binder and reports:
            try:
                batch = batch._replace(binder=_write_binder(rows, reports, output_dir, force))
            except Exception as error:
                batch = batch._replace(binder_failure=f"the binder: {_line(reason_of(error))}")
    except KeyboardInterrupt:
        raise _interrupted(len(reports), len(cases)) from None
    names = {file for case in cases for file in files_of(case.stem, True)}
    names |= {*_summary_files(True), f"{BINDER}.pdf"}
    left = [file for file in written_before(output_dir) if file.name in names]
    return batch._replace(left=[file for file in left if file not in batch.files])


def _interrupted(written: int, cases: int) -> KeyboardInterrupt:
    return KeyboardInterrupt(*([f"{written} of {cases} reports written"] if written else []))


def _refuse_same_names(cases: Sequence[Path], binder: bool) -> None:
    """Refuse cases whose files would overwrite each other's, the summary or the binder."""
    owners: dict[str, Path] = {}
    for case in cases:
        for name in (case.stem, f"{case.stem}.failed"):
            # Not all systems tell upper from lower case, or é from e with an accent.
            other = owners.setdefault(unicodedata.normalize("NFC", name).casefold(), case)
            if other != case:
                raise InputError(
                    f"{other} and {case} would write files of the same name: rename one"
                )
        if len(cases) > 1 and case.stem.casefold() == SUMMARY:
            raise InputError(f"{case} would overwrite the summary of the cases: rename it")
        if binder and case.stem.casefold() == BINDER:
            raise InputError(f"{case} would overwrite the binder of the cases: rename it")


def _refuse_to_overwrite(
    cases: Sequence[Path], output_dir: Path, docx: bool, binder: bool, force: bool
) -> None:
    """Refuse an output folder where anything must not be replaced, or nothing can be written."""
    names = [file for case in cases for file in files_of(case.stem, docx)]
    if len(cases) > 1:
        names += _summary_files(docx)
    if binder:
        names.append(f"{BINDER}.pdf")
    there = next(path for path in (output_dir, *output_dir.parents) if path.exists())
    with folder_for(there):
        pass
    refuse_changed(output_dir, names, force=force)


def _summary_files(docx: bool) -> list[str]:
    return [f"{SUMMARY}.{ending}" for ending in ("html", "pdf", "csv", "docx")[: 3 + docx]]


class _Stopped(BaseException):
    """Ends a report in progress: not an error of its own, and so not kept as one."""


def _write_all(
    cases: Sequence[Path], output_dir: Path, docx: bool, force: bool, progress: bool
) -> list[Report | Failure]:
    """Return the report or failure of each case, in order."""
    stop, lock, stages_of_each = Event(), Lock(), stages(docx)
    results: dict[Path, Report | Failure] = {}

    def write(case: Path) -> None:
        left = stages_of_each

        def on_stage() -> None:
            nonlocal left
            if stop.is_set():
                raise _Stopped
            with lock:
                bar.update()
                left -= 1

        try:
            results[case] = _write_one(case, output_dir, docx, force, kernels, on_stage)
        finally:
            with lock:
                bar.update(left)

    several = len(cases) > 1
    with (
        start_kernels(cases, _AT_ONCE) as kernels,
        tqdm(
            total=len(cases) * stages_of_each,
            desc=f"0 of {len(cases)} cases" if several else cases[0].stem,
            disable=None if progress else True,
            leave=False,
        ) as bar,
        ThreadPoolExecutor(_AT_ONCE) as executor,
    ):
        try:
            if several:
                import_libraries()
            futures = [executor.submit(write, case) for case in cases]
            for done, future in enumerate(as_completed(futures), 1):
                future.result()
                if several:
                    bar.set_description(f"{done} of {len(cases)} cases")
        except BaseException as error:
            stop.set()
            executor.shutdown(cancel_futures=True)
            if isinstance(error, KeyboardInterrupt):
                written = sum(isinstance(result, Report) for result in results.values())
                raise _interrupted(written, len(cases)) from None
            raise
    return [results[case] for case in cases]


def _write_one(
    case: Path,
    output_dir: Path,
    docx: bool,
    force: bool,
    kernels: "Kernels",
    on_stage: Callable[[], object],
) -> Report | Failure:
    """Return the report or failure of a case."""
    try:
        return write_report(
            case, output_dir, docx=docx, force=force, kernels=kernels, on_stage=on_stage
        )
    except (InputError, ReportError) as error:
        _log.debug("%s:", case, exc_info=True)
        return Failure(case, _line(error), bad_input=isinstance(error, InputError))
    except (_Stopped, KeyboardInterrupt, SystemExit):
        raise
    except BaseException as error:  # others derive panics and the like from it
        _log.debug("%s:", case, exc_info=True)
        return Failure(case, f"{case.name}: {_line(reason_of(error))}", bad_input=False)
    finally:
        _close_event_loop()


def _close_event_loop() -> None:
    """Close the event loop that Jupyter opens in each thread and leaves open."""
    from jupyter_core.utils import ensure_event_loop

    ensure_event_loop().close()


def _line(error: Exception | str) -> str:
    """Return a message as one line that can be written as UTF-8, whatever a file is called."""
    return " ".join(str(error).encode("utf-8", "backslashreplace").decode().split())


def _rows(cases: Sequence[Path], results: Sequence[Report | Failure]) -> list[Row]:
    """Return the rows of the summary."""
    later = {
        os.path.realpath(case.parent / result.results.supersedes): case
        for case, result in zip(cases, results, strict=True)
        if isinstance(result, Report) and result.results.supersedes is not None
    }

    def superseded_by(case: Path) -> str:
        """Return the name of the case that supersedes this one, unless they do so in a circle."""
        places = [os.path.realpath(case)]
        while places[-1] in later:
            place = os.path.realpath(later[places[-1]])
            if place in places:
                return ""
            places.append(place)
        return later[places[0]].stem if len(places) > 1 else ""

    return [
        Row(result.html.stem, result.results, result.warnings, superseded_by(case))
        if isinstance(result, Report)
        else Row(_line(case.stem), None, [result.reason])
        for case, result in zip(cases, results, strict=True)
    ]


def _write_summary(rows: Sequence[Row], output_dir: Path, docx: bool, force: bool) -> Summary:
    """Write the summary in all its formats, all or none."""
    with folder_for(output_dir) as folder:
        html, pdf, csv, *word = (folder / file for file in _summary_files(docx))
        write_blocks(summary_blocks(rows), (html, pdf, *word))
        csv.write_bytes(summary_csv(rows).encode("utf-8"))
        return Summary(*put_unchanged((html, pdf, csv, *word), output_dir, force=force))


def _write_binder(
    rows: Sequence[Row], reports: Sequence[Report], output_dir: Path, force: bool
) -> Path:
    """Write the binder of all sheets that no other supersedes, several after their summary."""
    bound = import_module("pierimpact.report.binder").bound_reports  # slow to import
    names = {row.name for row in current(rows)}
    reports = [report for report in reports if report.html.stem in names]
    with folder_for(output_dir) as folder:
        binder = folder / f"{BINDER}.pdf"
        summary = summary_blocks(rows)
        binder.write_bytes(bound(reports, summary, with_summary=len(rows) > 1))
        (in_place,) = put_unchanged((binder,), output_dir, force=force)
        return in_place
