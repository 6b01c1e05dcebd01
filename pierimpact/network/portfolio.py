"""Portfolios: every pier of a table by the full model, in pieces that survive an interruption.

What a piece comes to is kept in the folder `pieces` beside the results, under a digest of its rows
and of all that its results depend on. A run that finds such pieces goes on from them, and removes
the others in the end. No result depends on the pieces that were done together.
"""

import hashlib
import json
import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

import pierimpact
from pierimpact.checks import InputError, one_of
from pierimpact.files.csv_lines import Row
from pierimpact.files.piers import PierTable
from pierimpact.files.trucks import TruckFile, read_truck_file
from pierimpact.files.write import write_files
from pierimpact.network.piece import (
    NUMBERS,
    WORDS,
    BeamForces,
    BeamFound,
    Found,
    Reject,
    Task,
    calculate_beams,
    calculate_piece,
)
from pierimpact.network.workers import Run, worker_pool
from pierimpact.vehicle.truck import Truck

Array: TypeAlias = NDArray[np.float64]
Progress: TypeAlias = Callable[[int], object]

#: Rows of a piece, and of one by the beam, which costs some hundred times as much a row.
ROWS, BEAM_ROWS = 1000, 20
#: Which rows the column is calculated as a beam for: those that ask by their key member_forces,
#: "larger" or "beam", and by the rule also those whose static member forces may be too low.
BEAMS = ("rule", "asked")
#: What the member forces of a row are by.
BEAM, STATIC, CONTACT = "beam", "static reaction", "static contact force"
PIECES = "pieces"  # the folder


@dataclass(frozen=True, kw_only=True, eq=False)
class Portfolio:
    """The results of a table of piers: arrays of shape (n,), the worst row first.

    The worst is that of the largest utilisation; rows without any resistance follow, by reaction.
    """

    name: str  #: of the table, without its folder
    size: int  #: number of rows of the table
    words: Mapping[str, NDArray[np.str_]]
    numbers: Mapping[str, Array]  #: in SI units; nan where there is none
    rejects: Sequence[Reject]  #: by row
    statuses: Mapping[str, str]  #: of the trucks that nobody verified, in words by their names


def calculate_portfolio(
    table: PierTable,
    folder: Path,
    *,
    beams: str = "rule",
    workers: int | None = None,
    scheduler: str | None = None,
    say: Callable[[str], object] = lambda line: None,
    progress: Callable[[str, int], Progress] = lambda unit, total: lambda count: None,
) -> Portfolio:
    """Return the results of a table of piers; its finished pieces are kept in a folder.

    Parameters
    ----------
    table : PierTable
        The table, from `pierimpact.files.piers.read_pier_table`.
    folder : Path
        Where pieces are kept, in a folder of its own; created if it does not exist.
    beams : {"rule", "asked"}, optional
        Which rows the column is calculated as a beam for, as in `BEAMS`.
    workers, scheduler, say
        As in `pierimpact.network.workers.worker_pool`.
    progress : callable, optional
        Called with what is counted and with how many of it there are; returns what is called with
        the number done since the last call.

    Raises
    ------
    InputError
        As in `worker_pool`, before anything is written; when the folder cannot be written to.
    LostWorkersError
        As in `pierimpact.network.workers.Run`.
    """
    one_of("beams", beams, BEAMS)
    files = {name: _truck_file(name, table.path.parent) for name in table.trucks}
    trucks = {name: file if isinstance(file, str) else file.truck for name, file in files.items()}
    kept = _Kept(folder / PIECES)
    with worker_pool(workers=workers, scheduler=scheduler, say=say) as run:
        kept.open()
        work = _Work(table, trucks, kept, run)
        found = work.rows(progress("rows", table.size))
        wanted = [
            int(row)
            for row, asked, holds in zip(
                found.numbers["row"],
                found.words["asked"],
                found.numbers["static_holds"],
                strict=True,
            )
            if asked in ("larger", "beam") or (beams == "rule" and not asked and not holds)
        ]
        forces: list[BeamForces] = []
        if wanted:
            by_beam = work.beams(wanted, progress("beams", len(wanted)))
            forces = by_beam.forces
            found.rejects.extend(by_beam.rejects)
    kept.remove_others()
    statuses = {
        file.truck.name: file.status.words
        for file in files.values()
        if not isinstance(file, str) and not file.status.verified
    }
    return _portfolio(table, found, forces, statuses)


def _truck_file(name: str, folder: Path) -> TruckFile | str:
    """Return the file of a truck, or what is wrong with it in one line."""
    try:
        return read_truck_file(name, folder)
    except InputError as error:
        return f"truck: {error}" if not str(error).startswith("truck ") else str(error)


class _Kept:
    """Finished pieces in a folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._asked: set[str] = set()

    def open(self) -> None:
        """Make the folder ready."""
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"{self._folder} cannot be written to: {error.strerror}") from None

    def keep(self, name: str, found: object) -> None:
        """Keep something under a name."""
        text = json.dumps(found, ensure_ascii=False).encode("utf-8", "surrogateescape")
        digest = hashlib.sha256(text).hexdigest().encode()
        write_files({self._folder / name: digest + b"\n" + text})

    def found(self, name: str) -> Any:
        """Return what is kept under a name; None where nothing whole is."""
        self._asked.add(name)
        try:
            digest, _, text = (self._folder / name).read_bytes().partition(b"\n")
        except OSError:
            return None
        whole = digest == hashlib.sha256(text).hexdigest().encode()
        return json.loads(text.decode("utf-8", "surrogateescape")) if whole else None

    def remove_others(self) -> None:
        """Remove what was not asked for."""
        for old in self._folder.glob("*.json"):
            if old.name not in self._asked:
                old.unlink(missing_ok=True)


class _Work(NamedTuple):
    """What the pieces of a table are calculated with."""

    table: PierTable
    trucks: Mapping[str, Truck | str]
    kept: _Kept
    run: Run

    def rows(self, progress: Progress) -> Found:
        """Return the results of all rows."""
        pieces = self.table.pieces(ROWS)
        whole = Found({name: [] for name in WORDS}, {name: [] for name in NUMBERS}, [])
        for words, numbers, rejects in self._each("rows", calculate_piece, pieces, progress):
            for name in WORDS:
                whole.words[name].extend(words[name])
            for name in NUMBERS:
                whole.numbers[name].extend(numbers[name])
            whole.rejects.extend(Reject(*reject) for reject in rejects)
        return whole

    def beams(self, wanted: Iterable[int], progress: Progress) -> BeamFound:
        """Return the member forces by the beam of some rows."""
        whole = BeamFound([], [])
        pieces = _chosen(self.table, set(wanted))
        for forces, rejects in self._each("beams", calculate_beams, pieces, progress):
            whole.forces.extend(BeamForces(int(row), *own) for row, *own in forces)
            whole.rejects.extend(Reject(*reject) for reject in rejects)
        return whole

    def _each(
        self,
        kind: str,
        function: Callable[[Task], Any],
        pieces: Iterable[list[Row]],
        progress: Progress,
    ) -> Iterator[Any]:
        """Calculate the pieces that are not kept yet, then yield all in order."""
        names: list[str] = []
        waiting: deque[tuple[str, int]] = deque()

        def tasks() -> Iterator[Task]:
            for rows in pieces:
                task = Task(self.table.columns, rows, self.trucks)
                names.append(f"{kind}-{rows[0].number}-{_digest(task)}.json")
                if self.kept.found(names[-1]) is not None:
                    progress(len(rows))
                    continue
                waiting.append((names[-1], len(rows)))
                yield task

        for result in self.run(function, tasks()):
            name, size = waiting.popleft()
            self.kept.keep(name, result)
            progress(size)
        for name in names:
            yield self.kept.found(name)


def _digest(task: Task) -> str:
    """Return a digest of all that the results of some rows depend on."""
    kept = WORDS, NUMBERS, BeamForces._fields
    place = [column.key for column in task.columns].index("truck")
    named = sorted({row.cells[place].strip() for row in task.rows if place < len(row.cells)})
    trucks = [
        (name, truck, isinstance(truck, Truck) and (truck.spread, truck.mass_range))
        for name, truck in task.trucks.items()
        if name in named
    ]
    parts = pierimpact.__version__, np.__version__, kept, task.columns, task.rows, trucks
    return hashlib.sha256(repr(parts).encode("utf-8", "surrogatepass")).hexdigest()[:32]


def _chosen(table: PierTable, wanted: set[int]) -> Iterator[list[Row]]:
    """Yield the wanted rows, some at a time."""
    chosen: list[Row] = []
    for piece in table.pieces(ROWS):
        for row in piece:
            if row.number in wanted:
                chosen.append(row)
                if len(chosen) == BEAM_ROWS:
                    yield chosen
                    chosen = []
        # No piece goes on in another, so that what one has of them leaves the others as they are.
        if chosen:
            yield chosen
            chosen = []


def _portfolio(
    table: PierTable,
    found: Found,
    forces: Iterable[BeamForces],
    statuses: Mapping[str, str],
) -> Portfolio:
    """Return the portfolio of what was found: member forces that govern, utilisations, ranks."""
    numbers = {name: np.array(found.numbers.pop(name), dtype=float) for name in NUMBERS}
    words = {name: np.array(found.words.pop(name), dtype=str) for name in WORDS}
    size = len(numbers["row"])
    beam = np.full((4, size), math.nan)
    place = {int(row): i for i, row in enumerate(numbers["row"])}
    for row, *own in forces:
        beam[:, place[row]] = own
    asked, holds = words.pop("asked"), numbers.pop("static_holds") > 0.0
    words["static_forces"] = np.where(holds, "hold", "may be too low")
    high: dict[str, Array] = {}
    for which, by_beam, high_by_beam in zip(("shear", "moment"), beam[:2], beam[2:], strict=True):
        static, safe = numbers[f"static_{which}"], numbers.pop(f"safe_{which}")
        known = np.isfinite(by_beam)
        careful = ~known & ~holds & (asked != "static")
        # The larger of both, as in a report, unless the row asks for one.
        by_it = known & ((asked == "beam") | (by_beam > static))
        numbers[f"beam_{which}"] = by_beam
        numbers[f"largest_{which}"] = np.where(by_it, by_beam, np.where(careful, safe, static))
        words[f"{which}_method"] = np.where(by_it, BEAM, np.where(careful, CONTACT, STATIC))
        resistance = numbers.pop(f"{which}_resistance")
        numbers[f"utilisation_{which}"] = numbers[f"largest_{which}"] / resistance
        # The contact force of the trucks at the upper end is taken to grow as their reaction.
        without = numbers.pop(f"high_{which}") * np.where(careful, safe / static, 1.0)
        high[which] = np.where(known, high_by_beam, without) / resistance
    words["warnings"] = _warnings(words, numbers["in_mass_range"] > 0.0, statuses)
    numbers["utilisation"] = np.fmax(numbers["utilisation_shear"], numbers["utilisation_moment"])
    numbers["utilisation_high"] = np.fmax(high["shear"], high["moment"])
    lost = {reject.row for reject in found.rejects}
    kept = np.array([row not in lost for row in numbers["row"]], dtype=bool)
    worst = np.lexsort(
        (
            numbers["row"],
            -numbers["design_reaction"],
            -np.nan_to_num(numbers["utilisation"], nan=-1.0),
        )
    )
    worst = worst[kept[worst]]
    numbers = {name: values[worst] for name, values in numbers.items()}
    numbers["rank"] = np.arange(1.0, len(worst) + 1.0)
    return Portfolio(
        name=table.path.name,
        size=table.size,
        words={name: values[worst] for name, values in words.items()},
        numbers=numbers,
        rejects=sorted(found.rejects),
        statuses=statuses,
    )


def _warnings(
    words: Mapping[str, NDArray[np.str_]], in_range: NDArray[np.bool_], statuses: Mapping[str, str]
) -> NDArray[np.str_]:
    """Return what to know of each row before relying on it, in a few words."""
    rows = []
    for unusual, stands, truck in zip(words["unusual"], in_range, words["truck"], strict=True):
        said = [f"unusual {unusual}"] * bool(unusual)
        said += ["truck_mass beyond what the truck’s springs stand for"] * (not stands)
        said += [f"truck {statuses[truck]}"] * (truck in statuses)
        rows.append("; ".join(said))
    return np.array(rows, dtype=str)
