"""The results of a case as plain values, which the executed notebook carries to the summary."""

import datetime
from typing import Any, Self

from nbformat import NotebookNode
from pydantic import BaseModel, ConfigDict

from pierimpact.certainty import Certainty
from pierimpact.design.domain import Outside
from pierimpact.files.plausible import Unusual, unusual
from pierimpact.report.calculation import Calculation
from pierimpact.symbols import SYMBOLS

#: MIME type of the results in the output of a notebook's cell.
RESULTS_MIME = "application/vnd.pierimpact.report.results+json"


class Results(BaseModel):
    """Identification, inputs and results of a case, in SI units.

    In a notebook it is the output of a cell as JSON, which reads back equal to the last digit.
    """

    model_config = ConfigDict(frozen=True)

    project: str
    job_number: str
    element: str
    prepared_by: str
    checked_by: str
    revision: str
    date: datetime.date
    units: str  #: of the report, "SI" or "US"

    column_shape: str
    column_sizes: tuple[float, ...]  #: diameter, or width and depth, and the like [m]
    column_height: float
    base: str
    top: str
    truck: str  #: its name
    truck_status: Certainty
    truck_mass: float
    speed: float
    unusual: tuple[Unusual, ...]  #: inputs outside what is usual
    assumed: int  #: number of inputs that are assumed

    impact_height: float
    pier_frequency: float
    engine_contact: bool
    engine_peak: float
    cargo_peak: float | None
    design_reaction: float
    governs: str
    utilisations: dict[str, float]  #: by "shear" and "moment", where there is a resistance
    outside: tuple[Outside, ...]  #: values outside the studied domain of the design procedure
    overlapping: bool  #: whether the cargo meets the pier before the engine has separated

    @classmethod
    def of(cls, calculation: Calculation) -> Self:
        """Return the results of a calculation."""
        case, history, short = calculation.case, calculation.history, calculation.short
        inputs, cargo = case.inputs, history.cargo_peak
        section = case.column.section
        calculated = {
            "column_sizes": tuple(
                getattr(section, name)
                for name, symbol in section.dimensions.items()
                if SYMBOLS[symbol].quantity == "section length"
            ),
            "truck": case.truck.name,
            "truck_status": case.truck_file.status,
            "truck_mass": case.truck.mass,
            "unusual": tuple(unusual(inputs)),
            "assumed": len(inputs.assumed),
            "impact_height": calculation.struck.impact_height,
            "pier_frequency": calculation.pier.frequency,
            "engine_contact": history.engine_contact_time is not None,
            "engine_peak": history.engine_peak.reaction,
            "cargo_peak": None if cargo is None else cargo.reaction,
            "design_reaction": calculation.design_force,
            "governs": calculation.governs,
            "utilisations": calculation.utilisations,
            "outside": short.outside,
            "overlapping": short.overlapping,
        }
        return cls.model_validate(inputs.model_dump() | calculated)

    @classmethod
    def in_notebook(cls, notebook: NotebookNode) -> Self:
        """Return the results that an executed notebook carries."""
        (results,) = (
            output.data[RESULTS_MIME]
            for cell in notebook.cells
            for output in cell.get("outputs", [])
            if RESULTS_MIME in output.get("data", {})
        )
        return cls.model_validate(results)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Any]:
        return {RESULTS_MIME: self.model_dump(mode="json"), "text/plain": type(self).__name__}
