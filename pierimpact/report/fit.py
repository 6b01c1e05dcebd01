"""From force records to a fitted truck: its table, its truck file and its figure."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple, TypeVar

from pierimpact.checks import InputError
from pierimpact.collision.records import Record
from pierimpact.design.fit import ACCURACY, TruckFit, fit_records
from pierimpact.files.fitted import fitted_truck_file
from pierimpact.files.records import RecordFile, read_record_file
from pierimpact.files.trucks import read_truck_file
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.symbols import BY_KEY
from pierimpact.units import printed

T = TypeVar("T")


class Treatment(NamedTuple):
    """What was done to a record, and what is to be done to it."""

    filter: float | None = None  #: cut-off frequency of a filter that record and model pass [Hz]
    cutoff: float | None = None  #: that of a filter which the record has passed already [Hz]
    window: float | None = None  #: length of the moving average that the record is [s]
    first_touch: float = 0.0  #: time of first touch in the record [s]


class FittedTruck(NamedTuple):
    """A fit, with the files of its records and the text of its truck file."""

    fit: TruckFit
    files: tuple[RecordFile, ...]
    truck_file: str


def fit_files(
    paths: Sequence[str | Path],
    speeds: Sequence[float],
    piers: Sequence[EquivalentPier | None],
    *,
    start: str = "single-unit-8t",
    mass: float | None = None,
    treatment: Treatment = Treatment(),  # noqa: B008
    accuracy: float = ACCURACY,
    name: str = "fitted",
    progress: Callable[[int], object] = lambda count: None,
) -> FittedTruck:
    """Fit one truck to the records of files.

    Parameters
    ----------
    paths : sequence of str or Path
        Files of the records.
    speeds : sequence of float
        Speed at first touch of each, or one for all [m/s].
    piers : sequence of EquivalentPier or None
        Pier of each, or one for all; None is rigid.
    start : str, optional
        Truck to start from: a name of the catalogue, or the path of a truck file.
    mass : float, optional
        Total mass of the truck, unless it is that of the start [kg].
    treatment : Treatment, optional
        What was done and is to be done to the records.
    accuracy, progress
        As in `fit_records`.
    name : str, optional
        What the truck is to be called.

    Raises
    ------
    InputError
        When a file breaks a rule, or the numbers of speeds or piers do not fit.
    """
    start_file = read_truck_file(start)
    truck = start_file.truck if mass is None else start_file.truck.loaded_to(mass)
    files = tuple(read_record_file(path) for path in paths)
    records = []
    for file, speed, pier in zip(
        files,
        _one_each("speed", speeds, len(files)),
        _one_each("pier", piers, len(files)),
        strict=True,
    ):
        try:
            record = Record(
                time=file.time,
                force=file.force,
                speed=speed,
                pier=pier,
                quantity=file.quantity,
                cutoff=treatment.cutoff,
                window=treatment.window,
                first_touch=treatment.first_touch,
            )
            records.append(
                record if treatment.filter is None else record.low_passed(treatment.filter)
            )
        except InputError as error:
            raise InputError(f"{file.name}: {error}") from None
    fit = fit_records(records, truck, accuracy=accuracy, progress=progress)
    return FittedTruck(fit, files, fitted_truck_file(fit, files, start_file, name))


def _one_each(name: str, values: Sequence[T], count: int) -> Sequence[T]:
    if len(values) not in (1, count):
        raise InputError(
            f"{name} must be given once, or once for each of {count} records, got {len(values)}"
        )
    return list(values) * count if len(values) == 1 else values


def fit_table(fit: TruckFit) -> str:
    """Return a fit as a table in plain text: start, value, standard error, and what to know."""
    rows = [("parameter", "start", "fitted", "standard error", "")]
    for name, start, value, error, remark in fit_rows(fit):
        rows.append((name, start, value, error, remark))
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    lines = [
        "  ".join(
            (
                row[0].ljust(widths[0]),
                *(row[column].rjust(widths[column]) for column in (1, 2, 3)),
                row[4],
            )
        ).rstrip()
        for row in rows
    ]
    residual = fit.residual
    lines.append("")
    lines.append(
        f"Residual: {printed(residual.rms, 'force', 'SI')} root mean square, "
        f"{100.0 * residual.share:.1f} % of the largest force."
    )
    return "\n".join(lines)


def fit_rows(fit: TruckFit) -> list[tuple[str, str, str, str, str]]:
    """Return a fit's table as text: parameter, start, value, standard error and remark."""
    rows = []
    for name, estimate in fit.estimates.items():
        symbol = BY_KEY[name]
        start, value = (
            str(printed(x, symbol.quantity, "SI", given=True))
            for x in (estimate.start, estimate.value)
        )
        if estimate.standard_error is None:
            stays = estimate.value == estimate.start
            remark = f"left at its start: {estimate.reason}" if stays else estimate.reason
            rows.append((symbol.heading, start, "–" if stays else value, "–", remark))
            continue
        error = f"{100.0 * estimate.standard_error / estimate.value:.1f} %"
        rows.append((symbol.heading, start, value, error, estimate.reason or "identified"))
    return rows
