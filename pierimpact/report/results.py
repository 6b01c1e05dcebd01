"""The results of a case as plain values, which the executed notebook carries to the summary."""

import datetime
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, computed_field

from pierimpact.report.calculation import Calculation
from pierimpact.report.outcome import statement
from pierimpact.report.warnings import warnings_of
from pierimpact.symbols import SYMBOLS

#: MIME type of the results in the output of a notebook's cell.
RESULTS_MIME = "application/vnd.pierimpact.report.results+json"

#: What comes of the resistances of a case.
KEPT, AT_UPPER, EXCEEDED = "kept", "exceeded at 95 %", "exceeded"


class Used(BaseModel):
    """The largest shear or moment on the part of the column that uses most of what it resists."""

    model_config = ConfigDict(frozen=True)

    demand: float  #: in SI units, as all
    method: str  #: that it is found by, "beam" or "static"
    resistance: float
    low: float  #: height from which the part goes
    high: float  #: to which


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
    supersedes: str | None  #: case file of the revision before, as the case names it
    sheet_units: str  #: that the sheet prints in, "SI" or "US"

    column_shape: str
    column_sizes: tuple[float, ...]  #: diameter, or width and depth, and the like [m]
    step_heights: tuple[float, ...]  #: at which the section or a resistance changes [m]
    column_height: float
    embedment: float | None  #: as given; None where the column is not embedded [m]
    base: str  #: what holds it: "fixed", "pinned", "free", "on springs" …
    top: str
    top_mass: float | None
    truck: str  #: its name
    truck_mass: float
    speed: float

    impact_height: float
    pier_stiffness: float
    pier_mass: float
    pier_frequency: float
    engine_peak: float
    cargo_peak: float | None
    design_reaction: float
    hand_reaction: float  #: by the spectrum method, short level, the check by hand
    #: Reactions below which 5 and 95 % of trucks stay; None where no parameter carries a spread.
    band: tuple[float, float] | None
    governs: str
    largest_shear: float  #: anywhere on the column
    shear_method: str  #: that it is found by, "beam" or "static"
    largest_moment: float
    moment_method: str
    #: Largest "shear" and "moment" that 5 and 95 % of trucks stay below; empty without a band.
    member_bands: dict[str, tuple[float, float]]
    #: 25 ms average of the contact force over the force of AASHTO LRFD, which is such an average.
    code_ratio: float
    shear_resistance: float | None  #: of the lowest part of the column
    moment_resistance: float | None
    uses: dict[str, Used]  #: what the utilisations are of
    utilisations: dict[str, float]  #: by "shear" and "moment", where there is a resistance
    upper_utilisations: dict[str, float]  #: the same at the band's upper end; empty without a band
    verdict: str  #: in a sentence
    warnings: tuple[str, ...]  #: what is least safe first

    @computed_field  # type: ignore[prop-decorator]
    @property
    def resistance(self) -> str | None:
        """What comes of all resistances together; None where the case gives none."""
        if not self.utilisations:
            return None
        if max(self.utilisations.values()) > 1.0:
            return EXCEEDED
        beyond = max(self.upper_utilisations.values(), default=0.0) > 1.0
        return AT_UPPER if beyond else KEPT

    @classmethod
    def of(cls, calculation: Calculation) -> Self:
        """Return the results of a calculation."""
        case, history = calculation.case, calculation.history
        section, cargo = case.column.section, history.cargo_peak
        shear, moment = (calculation.demands[name] for name in ("shear", "moment"))
        reactions = calculation.reaction_band
        calculated = {
            "sheet_units": case.inputs.units,
            "column_sizes": tuple(
                getattr(section, name)
                for name, symbol in section.dimensions.items()
                if SYMBOLS[symbol].quantity == "section length"
            ),
            "step_heights": tuple(step.height for step in case.column.steps),
            "base": case.column.supports[0].kind,
            "top": case.column.supports[1].kind,
            "truck": case.truck.name,
            "truck_mass": case.truck.mass,
            "impact_height": calculation.struck.impact_height,
            "pier_stiffness": calculation.pier.stiffness,
            "pier_mass": calculation.pier.mass,
            "pier_frequency": calculation.pier.frequency,
            "engine_peak": history.engine_peak.reaction,
            "cargo_peak": None if cargo is None else cargo.reaction,
            "design_reaction": calculation.design_force,
            "hand_reaction": calculation.short.reaction,
            "band": (reactions[0], reactions[-1]) if reactions else None,
            "governs": calculation.governs,
            "largest_shear": shear.value,
            "shear_method": shear.method,
            "largest_moment": moment.value,
            "moment_method": moment.method,
            "member_bands": calculation.demand_bands,
            "code_ratio": calculation.code_ratio,
            "uses": {
                name: Used(
                    demand=use.demand.value,
                    method=use.demand.method,
                    resistance=use.resistance,
                    low=use.part.low,
                    high=use.part.high,
                )
                for name, use in calculation.uses.items()
            },
            "utilisations": calculation.utilisations,
            "upper_utilisations": calculation.upper_utilisations,
            "verdict": statement(calculation),
            "warnings": tuple(warnings_of(calculation)),
        }
        return cls.model_validate(case.inputs.model_dump() | calculated)

    @classmethod
    def in_notebook(cls, notebook: Any) -> Self:
        """Return the results that an executed notebook, as nbformat has it, carries."""
        (results,) = (
            output.data[RESULTS_MIME]
            for cell in notebook.cells
            for output in cell.get("outputs", [])
            if RESULTS_MIME in output.get("data", {})
        )
        return cls.model_validate(results)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Any]:
        return {RESULTS_MIME: self.model_dump(mode="json"), "text/plain": type(self).__name__}
