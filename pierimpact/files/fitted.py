"""Truck files of fitted trucks: every value with where it is from."""

import json
from collections.abc import Sequence

from pierimpact.certainty import Certainty
from pierimpact.design.fit import TruckFit
from pierimpact.files.records import RecordFile
from pierimpact.files.trucks import Parameter, TruckFile
from pierimpact.symbols import BY_KEY, dimension
from pierimpact.units import parse
from pierimpact.vehicle.spread import Lognormal, Spread


def fitted_truck_file(
    fit: TruckFit, records: Sequence[RecordFile], start: TruckFile, name: str
) -> str:
    """Return the text of a truck file for a fit.

    What the records show has the status "calibrated" and the records as its source; the rest has
    the value, source and status of the start, and says that it stays there.

    Parameters
    ----------
    fit : TruckFit
        The fit.
    records : sequence of RecordFile
        The files of its records.
    start : TruckFile
        The file of the truck that the fit started from.
    name : str
        What the truck is to be called.
    """
    of = " and ".join(f"{record.name} (SHA-256 {record.sha256})" for record in records)
    briefly = " and ".join(f"{record.name} ({record.sha256[:12]}…)" for record in records)
    lines = [
        f"name = {_text(name)}",
        f"description = {_text(f'{start.description}, fitted')}",
        f"source = {_text(f'fitted to {of}, from {start.file_name}')}",
        f"status = {_text(Certainty.CALIBRATED)}",
    ]
    for entry in start.parameters:
        lines += ["", f"[{entry.name}]", *_entry(entry, fit, briefly)]
    return "\n".join(lines) + "\n"


def _entry(entry: Parameter, fit: TruckFit, of: str) -> list[str]:
    """Return the lines of one parameter's table."""
    kind = dimension(BY_KEY[entry.name])
    if not kind:
        return [f"value = {_text(str(entry.value))}", *_whence(entry.source, entry.status)]
    value, _, unit = entry.given.partition(" ")
    source, status = entry.source, entry.status
    spread = _spread(entry.spread, float(value), entry.spread_source, entry.spread_status)
    estimate = fit.estimates.get(entry.name)
    if entry.name == "body_mass" and fit.truck.body_mass != entry.value:
        value = _in_unit(fit.truck.body_mass, unit, kind)
        source = f"what is left of {fit.truck.mass:.6g} kg, the truck’s mass as given for {of}"
        status, spread = Certainty.CALIBRATED, []
    elif estimate is not None and estimate.standard_error is not None:
        value = _in_unit(estimate.value, unit, kind)
        share = estimate.standard_error / estimate.value
        source, status = (
            f"fitted to {of}, standard error {100.0 * share:.1f} %",
            Certainty.CALIBRATED,
        )
        spread = _spread(
            Lognormal(share), float(value), "standard error of the fit", Certainty.CALIBRATED
        )
    elif estimate is not None and estimate.value != estimate.start:
        value = _in_unit(estimate.value, unit, kind)
        source, status = f"not identified in {of}: {estimate.reason}", Certainty.CALIBRATED
        spread = _spread(entry.spread, float(value), entry.spread_source, entry.spread_status)
    elif estimate is not None:
        source += f"; not identified, left at its start: {estimate.reason}"
    return [f"value = {value}", f"unit = {_text(unit)}", *_whence(source, status), *spread]


def _spread(
    spread: Spread | None, value: float, source: str, status: Certainty | None
) -> list[str]:
    """Return the lines that say how uncertain a value in its unit is."""
    if spread is None:
        return []
    if isinstance(spread, Lognormal):
        lines = [f"coefficient_of_variation = {spread.coefficient_of_variation:.4g}"]
    else:
        lines = [f"low = {spread.low * value:.6g}", f"high = {spread.high * value:.6g}"]
    if source:
        lines.append(f"spread_source = {_text(source)}")
    return [*lines, f"spread_status = {_text(status)}"] if status else lines


def _whence(source: str, status: Certainty) -> list[str]:
    return [f"source = {_text(source)}", f"status = {_text(status)}"]


def _in_unit(value: float, unit: str, kind: str) -> str:
    """Return a value in SI units as a number of a unit."""
    return f"{value / parse('unit', f'1 {unit}', kind):.6g}"


def _text(words: str) -> str:
    """Return words as a string of TOML, which has JSON's escapes."""
    return json.dumps(str(words), ensure_ascii=False)
