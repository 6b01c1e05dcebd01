"""The results of a portfolio as tables: CSV for a spreadsheet, Parquet for programs."""

import csv
import io
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.checks import no_formula
from pierimpact.design.quick_band import SIZE
from pierimpact.network.piece import Reject
from pierimpact.network.portfolio import Portfolio
from pierimpact.units import unit_of, unit_size

Array: TypeAlias = NDArray[np.float64]

#: Significant figures in a CSV and on the page: this project's choice.
FIGURES = 4
_COUNT, _WORD, _DEGREES = "count", "word", "degrees"


class ResultColumn(NamedTuple):
    """A column of the results."""

    name: str
    quantity: str  #: of `units.QUANTITIES`, or one of those above
    meaning: str

    @property
    def is_word(self) -> bool:
        """Whether its cells are words."""
        return self.quantity == _WORD

    def heading(self, system: str) -> str:
        """Return the name with the unit in brackets, where there is one."""
        unit = "°" if self.quantity == _DEGREES else self._unit(system)
        return f"{self.name} [{unit}]" if unit else self.name

    def _unit(self, system: str) -> str:
        return "" if self.quantity in (_COUNT, _WORD) else unit_of(self.quantity, system)

    def numbers(self, portfolio: Portfolio, system: str) -> Array:
        """Return its values in the unit of the heading, shape (n,)."""
        values = portfolio.numbers[self.name]
        if self.quantity in (_COUNT, _DEGREES):
            return values
        return np.asarray(values / unit_size(self.quantity, system))

    def cells(self, portfolio: Portfolio, system: str) -> list[Any]:
        """Return its cells: words, and numbers as they print; None where there is none."""
        if self.is_word:
            return list(portfolio.words[self.name].tolist())
        values = self.numbers(portfolio, system)
        if self.quantity != _DEGREES:
            values = values if self.quantity == _COUNT else figures(values)
        return [
            None if value != value else int(value) if value.is_integer() else value
            for value in values.tolist()
        ]


#: The columns, in order.
RESULTS = (
    ResultColumn("rank", _COUNT, "1 is the worst: by utilisation, then by reaction"),
    ResultColumn("id", _WORD, "of the pier"),
    ResultColumn("warnings", _WORD, "what to know of it; its sheet has them in full"),
    ResultColumn("row", _COUNT, "of the table of piers, its heading being row 1"),
    ResultColumn("latitude", _DEGREES, "of the pier"),
    ResultColumn("longitude", _DEGREES, "of the pier"),
    ResultColumn("truck", _WORD, "its name"),
    ResultColumn("truck_mass", "mass", "its total mass"),
    ResultColumn("speed", "speed", "at first touch"),
    ResultColumn("impact_height", "length", "nominal impact height"),
    ResultColumn("pier_frequency", "frequency", "of the pier as one degree of freedom"),
    ResultColumn("pier_mass", "mass", "its equivalent mass"),
    ResultColumn("pier_stiffness", "stiffness", "its stiffness at the impact height"),
    ResultColumn("engine_peak", "force", "largest reaction before cargo contact, full model"),
    ResultColumn("cargo_peak", "force", "largest reaction from cargo contact on; empty without"),
    ResultColumn("governs", _WORD, "the larger of the two"),
    ResultColumn("design_reaction", "force", "the larger peak by the full model"),
    ResultColumn(
        "band_low",
        "force",
        f"below which 5 % of {SIZE} sampled trucks stay, of each the larger of both heights",
    ),
    ResultColumn("band_high", "force", "below which 95 % of these stay"),
    ResultColumn("contact_force", "force", "largest force of the truck on the pier"),
    ResultColumn("average_25ms", "force", "largest 25 ms average of the contact force"),
    ResultColumn("code_ratio", "ratio", "that average over the force of AASHTO LRFD, 600 kip"),
    ResultColumn("static_forces", _WORD, "whether static member forces hold"),
    ResultColumn("static_shear", "force", "largest shear under the reaction as a static force"),
    ResultColumn("static_moment", "moment", "largest moment under it"),
    ResultColumn("beam_shear", "force", "largest shear of the column as a beam; empty without"),
    ResultColumn("beam_moment", "moment", "largest moment of it; empty without"),
    ResultColumn("largest_shear", "force", "the shear that is checked"),
    ResultColumn("shear_method", _WORD, "what it is by"),
    ResultColumn("largest_moment", "moment", "the moment that is checked"),
    ResultColumn("moment_method", _WORD, "what it is by"),
    ResultColumn("utilisation_shear", "ratio", "shear over its resistance; empty without one"),
    ResultColumn("utilisation_moment", "ratio", "moment over its resistance; empty without one"),
    ResultColumn("utilisation", "ratio", "the larger of the two"),
    ResultColumn(
        "utilisation_high",
        "ratio",
        "that 95 % of these trucks stay below; by the beam, if there is one, or the static forces",
    ),
)


def figures(values: Array, count: int = FIGURES) -> Array:
    """Return values rounded to so many significant figures, in the shape of `values`."""
    size = np.abs(np.where(np.isfinite(values) & (values != 0.0), values, 1.0))
    power = np.floor(np.log10(size)) - (count - 1)
    # Powers of ten are exact as whole numbers only.
    up, down = 10.0 ** np.maximum(power, 0.0), 10.0 ** np.maximum(-power, 0.0)
    return np.asarray(np.rint(values / up * down) / down * up)


def results_csv(portfolio: Portfolio, system: str) -> bytes:
    """Return the results as CSV, the worst row first, in "SI" or "US" units."""
    columns = [
        [no_formula(cell) for cell in cells] if column.is_word else cells
        for column in RESULTS
        for cells in [column.cells(portfolio, system)]
    ]
    heading = [column.heading(system) for column in RESULTS]
    return _csv(heading, zip(*columns, strict=True))


def rejects_csv(rejects: Sequence[Reject]) -> bytes:
    """Return the rows without results as CSV, with the column to blame and the reason."""
    rows = ((row, *(no_formula(text) for text in words)) for row, *words in rejects)
    return _csv(["row", "id", "column", "reason"], rows)


def _csv(heading: Sequence[str], rows: Iterable[Iterable[Any]]) -> bytes:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(heading)
    writer.writerows(rows)
    return text.getvalue().encode("utf-8", "surrogateescape")


def results_parquet(portfolio: Portfolio, system: str) -> bytes | None:
    """Return the results as Parquet, all figures, as `results_csv`; None without pyarrow."""
    try:
        import pyarrow
        import pyarrow.parquet
    except ModuleNotFoundError:
        return None
    columns = {}
    for column in RESULTS:
        if column.is_word:
            values: Any = pyarrow.array(portfolio.words[column.name].tolist(), pyarrow.string())
        else:
            numbers = column.numbers(portfolio, system)
            kind = "int64" if column.quantity == _COUNT else "float64"
            values = pyarrow.array(numbers.astype(kind), mask=np.isnan(numbers))
        columns[column.heading(system)] = values
    sink = pyarrow.BufferOutputStream()
    pyarrow.parquet.write_table(pyarrow.table(columns), sink)
    return bytes(sink.getvalue())
