"""The last pages: nomenclature, and what the sheet was made from."""

import platform

import numpy as np

import pierimpact
from pierimpact.calculation import Calculation
from pierimpact.sheet.blocks import Block, Nomenclature
from pierimpact.sheet.design_steps import symbols_of_procedure
from pierimpact.sheet.input_tables import STATUS_WORDS, symbols_of_inputs
from pierimpact.sheet.markup import Code, Inline, Tex
from pierimpact.sheet.numbered import Column, Table
from pierimpact.sheet.pier_steps import symbols_of_pier
from pierimpact.units import rounded

_REACTIONS = (
    ("R", "design reaction"),
    (r"R_\mathrm{D}", "reaction of the design procedure"),
    (r"R_\mathrm{M}", "governing peak of the full model"),
    (r"x_\mathrm{p}", "displacement of the pier at the impact height"),
    ("z", "height above the base"),
    (r"\varphi", "shape function"),
)


def nomenclature(calculation: Calculation) -> Block:
    """Return every symbol of the sheet and what it stands for."""
    entries: dict[str, Inline] = dict(_REACTIONS)
    for symbols in (symbols_of_inputs, symbols_of_pier, symbols_of_procedure):
        for symbol, meaning in symbols(calculation):
            entries.setdefault(symbol.source, meaning)
    return Nomenclature([(Tex(symbol), meaning) for symbol, meaning in entries.items()])


def provenance_table(
    calculation: Calculation, case_file: str | None, case_sha256: str | None
) -> Block:
    """Return what this sheet was made from and how to make it again.

    Parameters
    ----------
    calculation : Calculation
        The calculation.
    case_file, case_sha256 : str or None
        Name and SHA-256 of the case file, where it is known.
    """
    truck_file, history = calculation.case.truck_file, calculation.history
    software = f"pierimpact {pierimpact.__version__}, "
    software += f"Python {platform.python_version()}, NumPy {np.__version__}"
    rows: list[list[Inline]] = [["Software", software]]
    if case_file and case_sha256:
        rows += [
            ["Case file", Code(case_file)],
            ["its SHA-256", Code(case_sha256)],
            ["To repeat", Code(f"pierimpact report {case_file}")],
        ]
    else:
        rows.append(["Case file", "not recorded: the parameters were set in the notebook"])
    rows += [
        ["Truck file", (Code(truck_file.file_name), f", {STATUS_WORDS[truck_file.status]}")],
        ["its SHA-256", Code(truck_file.sha256)],
        ["Energy balance", _error_words(history.energy_error, "the truck’s initial energy")],
        ["Momentum balance", _error_words(history.momentum_error, "the truck’s initial momentum")],
    ]
    return Table(
        label="tab-provenance",
        caption="What this sheet was made from.",
        columns=[Column(heading="Item"), Column(heading="Value", wide=True)],
        rows=rows,
    )


def _error_words(error: float, whole: str) -> str:
    return f"closes to {rounded(error, 1)} of {whole}, at all times"
