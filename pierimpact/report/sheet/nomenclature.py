"""The last pages: nomenclature, and what the sheet was made from."""

import platform
import re
from collections.abc import Iterator

import numpy as np

import pierimpact
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Block, Nomenclature
from pierimpact.report.document.markup import Code, Inline, Ref, Tex, in_a_sentence
from pierimpact.report.document.numbered import Column, Table
from pierimpact.report.sheet import equivalent_pier, shape_steps
from pierimpact.report.sheet.design_procedure import symbols_of_procedure
from pierimpact.report.sheet.inputs import symbols_of_inputs
from pierimpact.report.sheet.model_steps import symbols_of_model
from pierimpact.units import rounded

# Symbols that no table and no step introduces, and where they stand.
_OTHERS = (
    ("R", "design reaction", "eq-design-reaction"),
    (r"R_\mathrm{D}", "reaction of the design procedure", "tab-check"),
    (r"R_\mathrm{M}", "governing peak of the full model", "tab-check"),
    (r"V_\mathrm{max}", "largest shear", "tab-members"),
    (r"M_\mathrm{max}", "largest moment", "tab-members"),
    ("z", "height above the base", "tab-shape"),
    ("s", "distance from the base or from the top, over the height of the column", "tab-shape"),
    (r"\varphi", "shape function", "tab-shape"),
)
# The Greek alphabet, as LaTeX has it.
_GREEK = (
    *("alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa"),
    *("lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "tau", "upsilon", "varphi"),
    *("chi", "psi", "omega"),
)


def nomenclature(calculation: Calculation) -> Block:
    """Return every symbol of the sheet, what it stands for and where it comes from, by alphabet."""
    entries: dict[str, tuple[Inline, str]] = {}
    for symbol, meaning, label in (
        *_OTHERS,
        *symbols_of_inputs(calculation),
        *_symbols_of_steps(calculation),
        *symbols_of_model(),
        *symbols_of_procedure(calculation),
    ):
        entries.setdefault(symbol, (meaning, label))
    return Nomenclature(
        [
            (Tex(symbol), meaning, Ref("Table" if label.startswith("tab") else "Eq.", label))
            for symbol, (meaning, label) in sorted(entries.items(), key=_by_alphabet)
        ]
    )


def _symbols_of_steps(calculation: Calculation) -> Iterator[tuple[str, Inline, str]]:
    """Yield symbol, meaning and anchor of the values of the pier."""
    for steps in (
        equivalent_pier.section_steps,
        equivalent_pier.unit_force_steps,
        equivalent_pier.stiffness_steps,
        shape_steps.shape_steps,
        shape_steps.mass_steps,
    ):
        for step in steps(calculation).equations:
            yield step.symbol, in_a_sentence(step.name), step.label


def _by_alphabet(entry: tuple[str, object]) -> tuple[int, int, str, str]:
    """Return what symbols are sorted by: Latin before Greek before signs, accents last."""
    symbol = re.sub(r"\\(bar|d?dot|hat|mathrm)(?![a-z])|[{} ]", "", entry[0]).lstrip("(")
    if not symbol.startswith("\\"):
        return 0, 0, symbol.lower(), symbol.swapcase() + entry[0]
    name = re.match(r"[a-z]*", symbol[1:].replace("kappaGA", "kappa"))[0]  # type: ignore[index]
    return (1, _GREEK.index(name), symbol, entry[0]) if name in _GREEK else (2, 0, symbol, "")


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
        ["Truck file", (Code(truck_file.file_name), f", {truck_file.status.words}")],
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
