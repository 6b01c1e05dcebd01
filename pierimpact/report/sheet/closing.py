"""The end of the sheet: what it was made from, its symbols, and what changed since the last one."""

import platform
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import yaml

import pierimpact
from pierimpact.report.calculation import calculate
from pierimpact.report.comparison import compare
from pierimpact.report.document.blocks import Block, Group, Listing, Nomenclature, Notes, Paragraph
from pierimpact.report.document.markup import Code, Inline, Piece, Ref, Tex, inline
from pierimpact.report.document.numbered import Table, columns, wide
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import SYMBOLS
from pierimpact.units import rounded

_SHORT = 16  # digits of a checksum that tell it from any other at a glance: this project's choice

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

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(file.case, file.name, file.sha256)
    >>> dict(sheet.closing.provenance().rows)["To repeat"].text
    'pierimpact report tti-column.yaml'
    """

    sections: Sequence[Section]
    case_file: str | None
    case_sha256: str | None

    def made_from(self) -> Block:
        """Return in three lines what the sheet was made from."""
        truck_file = self.case.truck_file
        case_file: list[Piece] = ["no case file: the case was set in the notebook"]
        if self.case_file and self.case_sha256:
            case_file = [
                "case file ",
                Code(self.case_file),
                ", SHA-256 ",
                Code(self.case_sha256[:_SHORT]),
                "…",
            ]
        return Notes(
            [
                (
                    f"Made by {_software()}, from ",
                    *case_file,
                    ", and truck file ",
                    Code(truck_file.file_name),
                    f", {truck_file.status.words}, SHA-256 ",
                    Code(truck_file.sha256[:_SHORT]),
                    f"…. The energy balance {_closes(self.calculation.history.energy_error)}.",
                ),
            ]
        )

    def _shared(self) -> list[list[Inline]]:
        """Return the row on the values that cases of a folder share."""
        sha256 = self.case.shared_sha256
        return [["pierimpact.toml, SHA-256", Code(sha256)]] if sha256 else []

    def nomenclature(self) -> Block | None:
        """Return every symbol of the sheet, its meaning and where it stands, by alphabet.

        None where the case does not ask for it: it takes all the equations of the sheet.
        """
        if "nomenclature" not in self.case.inputs.annexes:
            return None
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
        rows: list[list[Inline]] = [["Software", _software()]]
        if self.case_file and self.case_sha256:
            rows += [
                ["Case file", Code(self.case_file)],
                ["its SHA-256", Code(self.case_sha256)],
                *self._shared(),
                ["To repeat", Code(f"pierimpact report {self.case_file}")],
            ]
        else:
            rows.append(["Case file", "none: the case was set in the notebook"])
        rows += [
            ["Truck file", (Code(truck_file.file_name), f", {truck_file.status.words}")],
            ["its SHA-256", Code(truck_file.sha256)],
            ["Energy balance", _closes(history.energy_error)],
            ["Momentum balance", _closes(history.momentum_error)],
        ]
        return Table(
            label="tab-provenance",
            caption="What this sheet was made from.",
            columns=columns("Item", wide("Value")),
            rows=rows,
        )

    def case_as_read(self) -> Block:
        """Return the case as it was read, key by key."""
        given = yaml.safe_dump(dict(self.case.given), allow_unicode=True, sort_keys=False, width=88)
        return Listing("The case as it was read", given)

    def truck_file(self) -> Block:
        """Return the truck file in full."""
        return Listing("The truck file", self.case.truck_file.text)

    def changes(self) -> Block | None:
        """Return what changed since the case that this one supersedes; None where it has none."""
        earlier = self.case.superseded_file
        if earlier is None:
            return None
        changes = compare(calculate(earlier.case), self.calculation)
        against = Paragraph(
            (
                f"From revision {earlier.case.inputs.revision}, ",
                Code(earlier.name),
                ", SHA-256 ",
                Code(earlier.sha256[:_SHORT]),
                f"…, to revision {self.case.inputs.revision}.",
            )
        )
        return Group([against, *changes.blocks()])


def _kind(label: str) -> str:
    return {"tab": "Table", "fig": "Figure"}.get(label[:3], "Eq.")


def _by_alphabet(entry: tuple[str, object]) -> tuple[int, int, str, str]:
    """Return what symbols are sorted by: Latin before Greek before signs, accents last."""
    symbol = re.sub(r"\\(bar|d?dot|hat|mathrm)(?![a-z])|[{} ]", "", entry[0]).lstrip("(")
    if not symbol.startswith("\\"):
        return 0, 0, symbol.lower(), symbol.swapcase() + entry[0]
    name = re.match(r"[a-zA-Z]*", symbol[1:].replace("kappaGA", "kappa"))[0].lower()  # type: ignore[index]
    return (1, _GREEK.index(name), symbol, entry[0]) if name in _GREEK else (2, 0, symbol, "")


def _software() -> str:
    return (
        f"pierimpact {pierimpact.__version__}, Python {platform.python_version()}, "
        f"NumPy {np.__version__}"
    )


def _closes(error: float) -> str:
    return f"closes to {rounded(error, 1)} of what the truck brings, at all times"
