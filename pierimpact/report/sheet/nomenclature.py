"""The last pages: nomenclature, and what the sheet was made from."""

import platform
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

import pierimpact
from pierimpact.report.document.blocks import Block, Nomenclature
from pierimpact.report.document.markup import Code, Inline, Ref, Tex, inline
from pierimpact.report.document.numbered import Table, columns, wide
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import SYMBOLS
from pierimpact.units import rounded

# The Greek alphabet, as LaTeX has it.
_GREEK = (
    *("alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa"),
    *("lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "tau", "upsilon", "varphi"),
    *("chi", "psi", "omega"),
)


@dataclass(frozen=True)
class Closing(Section):
    """The nomenclature of the other sections, and the provenance of the sheet.

    Parameters
    ----------
    calculation : Calculation
        The calculation of the case.
    sections : sequence of Section
        The sections before, in the order of the sheet.
    case_file, case_sha256 : str or None
        Name and SHA-256 of the case file, where it is known.
    """

    sections: Sequence[Section]
    case_file: str | None
    case_sha256: str | None

    def nomenclature(self) -> Block:
        """Return every symbol of the sheet, its meaning and where it stands, by alphabet."""
        labels: dict[str, str] = {}
        for section in self.sections:
            labels = section.symbols() | labels
        symbols = {SYMBOLS[name].latex: (SYMBOLS[name], label) for name, label in labels.items()}
        return Nomenclature(
            [
                (Tex(latex), inline(symbol.meaning), Ref(_kind(label), label))
                for latex, (symbol, label) in sorted(symbols.items(), key=_by_alphabet)
                if latex
            ]
        )

    def provenance(self) -> Block:
        """Return what this sheet was made from and how to make it again."""
        truck_file, history = self.case.truck_file, self.calculation.history
        software = f"pierimpact {pierimpact.__version__}, "
        software += f"Python {platform.python_version()}, NumPy {np.__version__}"
        rows: list[list[Inline]] = [["Software", software]]
        if self.case_file and self.case_sha256:
            rows += [
                ["Case file", Code(self.case_file)],
                ["its SHA-256", Code(self.case_sha256)],
                ["To repeat", Code(f"pierimpact report {self.case_file}")],
            ]
        else:
            rows.append(["Case file", "not recorded: the parameters were set in the notebook"])
        energy = _closes(history.energy_error, "the truck’s initial energy")
        momentum = _closes(history.momentum_error, "the truck’s initial momentum")
        rows += [
            ["Truck file", (Code(truck_file.file_name), f", {truck_file.status.words}")],
            ["its SHA-256", Code(truck_file.sha256)],
            ["Energy balance", energy],
            ["Momentum balance", momentum],
        ]
        return Table(
            label="tab-provenance",
            caption="What this sheet was made from.",
            columns=columns("Item", wide("Value")),
            rows=rows,
        )


def _kind(label: str) -> str:
    return {"tab": "Table", "fig": "Figure"}.get(label[:3], "Eq.")


def _by_alphabet(entry: tuple[str, object]) -> tuple[int, int, str, str]:
    """Return what symbols are sorted by: Latin before Greek before signs, accents last."""
    symbol = re.sub(r"\\(bar|d?dot|hat|mathrm)(?![a-z])|[{} ]", "", entry[0]).lstrip("(")
    if not symbol.startswith("\\"):
        return 0, 0, symbol.lower(), symbol.swapcase() + entry[0]
    name = re.match(r"[a-zA-Z]*", symbol[1:].replace("kappaGA", "kappa"))[0].lower()  # type: ignore[index]
    return (1, _GREEK.index(name), symbol, entry[0]) if name in _GREEK else (2, 0, symbol, "")


def _closes(error: float, whole: str) -> str:
    return f"closes to {rounded(error, 1)} of {whole}, at all times"
