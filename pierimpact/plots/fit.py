"""A fitted truck beside the records it is fitted to, before and after."""

import io
from typing import Any

import numpy as np

from pierimpact.collision.records import Record
from pierimpact.design.fit import TruckFit
from pierimpact.plots.style import BLUE, GREY, VERMILION, sheet_figure
from pierimpact.units import unit_of, unit_size

FORMATS = ("pdf", "png", "svg")

_RECORD: Any = {"color": GREY, "linewidth": 0.6}
_START: Any = {"color": VERMILION, "linewidth": 1.0, "dashes": (5, 2)}
_FITTED: Any = {"color": BLUE, "linewidth": 1.3}
_HEIGHT = 3.3  # of one record [in]


def draw_fit(fit: TruckFit, system: str, format: str = "svg") -> bytes:  # noqa: A002
    """Draw each record with the forces of the start and of the fit, and what is left.

    Parameters
    ----------
    fit : TruckFit
        The fit.
    system : {"SI", "US"}
        Units to print in.
    format : {"svg", "png", "pdf"}, optional
        Format of the file whose bytes are returned.
    """
    count = len(fit.records)
    height = _HEIGHT * count
    margins = {"left": 0.105, "right": 0.985, "top": 1.0 - 0.12 / height, "bottom": 0.42 / height}
    with sheet_figure(height, **margins) as figure:
        grid = figure.add_gridspec(count, 1, hspace=0.25)
        for index, record in enumerate(fit.records):
            rows = grid[index].subgridspec(2, 1, height_ratios=(3, 1), hspace=0.12)
            upper = figure.add_subplot(rows[0])
            lower = figure.add_subplot(rows[1], sharex=upper)
            _draw_record(upper, lower, fit, record, system)
            if index == 0:
                upper.legend(loc="best")
        lower.set_xlabel(f"Time after first touch [{unit_of('time', system)}]")
        buffer = io.BytesIO()
        date = {"svg": "Date", "pdf": "CreationDate"}.get(format)
        figure.savefig(buffer, format=format, dpi=200, metadata={date: None} if date else None)
        return buffer.getvalue()


def _draw_record(upper: Any, lower: Any, fit: TruckFit, record: Record, system: str) -> None:
    time = (record.time - record.first_touch) / unit_size("time", system)
    size = unit_size("force", system)
    start, fitted = (record.modelled(record.collision(t)) for t in (fit.start, fit.truck))
    upper.plot(time, record.force / size, label="record", **_RECORD)
    upper.plot(time, start / size, label="start", **_START)
    upper.plot(time, fitted / size, label="fitted", **_FITTED)
    lower.plot(time, (record.force - fitted) / size, **_RECORD)
    for axes in (upper, lower):
        axes.axhline(0.0, color="black", linewidth=0.5)
    upper.tick_params(labelbottom=False)
    upper.set_ylabel(f"{record.quantity.capitalize()} [{unit_of('force', system)}]")
    lower.set_ylabel("Residual")
    lower.set_xlim(float(time[0]), float(time[-1]))
    largest = float(np.max(np.abs(record.force - fitted))) / size
    lower.set_ylim(-1.1 * largest, 1.1 * largest)
    upper.figure.align_ylabels((upper, lower))
