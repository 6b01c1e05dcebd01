"""What changed from one revision of a case to the next: inputs, results and warnings.

Values count as equal where they agree to nine figures, so that 1.2 m and 120 cm are no change.
"""

import math
import re
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from pierimpact.files.case import Case
from pierimpact.files.inputs import KEYS, NOT_GIVEN, Inputs, SectionInputs
from pierimpact.plain_text import text_item, text_table
from pierimpact.report.calculation import Calculation
from pierimpact.report.document.blocks import Block, Paragraph
from pierimpact.report.document.numbered import Table, columns, decimal, wide
from pierimpact.report.outcome import DEMANDS
from pierimpact.report.results import Results
from pierimpact.symbols import BY_KEY
from pierimpact.units import compared, printed, rounded

_RETYPED = "The same value, typed in another way"
# Keys that are no values of their own, and that which says what this case is compared with.
_APART = ("assumed", "sources", "notes", "revisions", "steps", "truck", "supersedes")
_WIDEST = (36, 26, 26, 9)  # columns of the table in plain text [characters]


class Change(NamedTuple):
    """A value that is another in the new revision."""

    name: str  #: in words
    old: str
    new: str
    percent: float | None = None  #: of the old value; None where it is no number

    @property
    def change(self) -> str:
        """The change in per cent as it prints, empty where there is none."""
        if self.percent is None:
            return ""
        sign = "−" if self.percent < 0.0 else "+"
        return f"{sign}{rounded(abs(self.percent), 3)} %"


class _Value(NamedTuple):
    """A value of one revision."""

    name: str  #: in words
    value: float | str | None  #: a number in SI units, or a word
    quantity: str = ""  #: of a number; none where it prints as it is typed
    notes: tuple[str, ...] = ()  #: what it rests on; printed where it is another
    typed: object = None  #: as a file has it
    default: bool = False  #: whether a case file leaves it out


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """What changed from an old calculation to a new one, in the units of the new."""

    inputs: Sequence[Change]  #: of the case file and the truck
    results: Sequence[Change]
    came: Sequence[str]  #: warnings of the new alone
    went: Sequence[str]  #: warnings of the old alone
    retyped: Sequence[Change]  #: inputs typed in another way, of the same value

    @property
    def changed(self) -> bool:
        """Whether there is any change; an input that is only typed in another way is none."""
        return bool(self.inputs or self.results or self.came or self.went)

    def text(self) -> str:
        """Return the changes as tables in plain text."""
        parts = [_table_in_text(heading, changes) for heading, changes in self._tables()]
        if self._sentence:
            parts.append(self._sentence)
        lists = {
            "Warnings that came": self.came,
            "Warnings that went": self.went,
            _RETYPED: self._retyped(),
        }
        for heading, texts in lists.items():
            if texts:
                parts.append("\n".join([heading, *map(text_item, texts)]))
        return "\n\n".join(parts)

    def blocks(self) -> list[Block]:
        """Return the changes as the blocks of a sheet."""
        blocks = [_table(heading, changes) for heading, changes in self._tables()]
        if self._sentence:
            blocks.append(Paragraph(self._sentence))
        if self.came or self.went:
            warnings = {"came": self.came, "went": self.went}
            blocks.append(
                Table(
                    label="tab-changed-warnings",
                    caption="Warnings that came or went.",
                    columns=columns("Change", wide("Warning")),
                    rows=[[change, text] for change, texts in warnings.items() for text in texts],
                )
            )
        if self.retyped:
            blocks.append(Paragraph(f"{_RETYPED}: {'; '.join(self._retyped())}."))
        return blocks

    @property
    def _sentence(self) -> str:
        if self.results:
            return ""
        return "No result changed." if self.changed else "No input and no result changed."

    def _tables(self) -> list[tuple[str, Sequence[Change]]]:
        tables = [("Inputs", self.inputs), ("Results", self.results)]
        return [(heading, changes) for heading, changes in tables if changes]

    def _retyped(self) -> list[str]:
        return [f"{name}, {old} before, {new} now" for name, old, new, _ in self.retyped]


def compare(old: Calculation, new: Calculation) -> Comparison:
    """Return what changed from an old calculation to a new one.

    Results whose printed figures are the same count as unchanged.
    """
    system = new.case.inputs.units
    inputs, before = _inputs(new.case), _inputs(old.case)
    results, previous = Results.of(new), Results.of(_in_units(old, system))
    return Comparison(
        inputs=list(_changes(before, inputs, system)),
        results=[
            change
            for change in _changes(_results(previous), _results(results), system)
            if change.old != change.new
        ],
        came=_alone(results.warnings, previous.warnings),
        went=_alone(previous.warnings, results.warnings),
        retyped=list(_retyped(before, inputs)),
    )


def _in_units(calculation: Calculation, system: str) -> Calculation:
    """Return a calculation whose words are in other units."""
    case = calculation.case
    if case.inputs.units == system:
        return calculation
    inputs = case.inputs.model_copy(update={"units": system})
    return replace(calculation, case=replace(case, inputs=inputs))


def _alone(warnings: Sequence[str], others: Sequence[str]) -> list[str]:
    """Return the warnings that are not among the others, whatever numbers are in them."""

    def wording(text: str) -> str:
        return re.sub(r"\d[\d.\u202f]*", "0", text)

    known = {wording(text) for text in others}
    return [text for text in warnings if wording(text) not in known]


def _changes(
    old: Mapping[Hashable, _Value], new: Mapping[Hashable, _Value], system: str
) -> Iterator[Change]:
    """Yield the values that differ, in the order of the new, those of the old alone last."""
    old, new = (
        {key: value for key, value in values.items() if value.value is not None}
        for values in (old, new)
    )
    for key in dict.fromkeys((*new, *old)):
        before, after = old.get(key), new.get(key)
        if before and after:
            if not _equal(before, after) or before.notes != after.notes:
                yield _change(before, after, system)
        elif after:
            yield Change(after.name, NOT_GIVEN, _shown(after, after.notes, system))
        elif before:
            yield Change(before.name, _shown(before, before.notes, system), NOT_GIVEN)


def _change(before: _Value, after: _Value, system: str) -> Change:
    """Return a change, with what the values rest on where that is not the same."""
    both = zip(before.notes, after.notes, strict=True)
    own = [pair for pair in both if pair[0] != pair[1]]
    old, new = (
        _shown(value, [notes[side] for notes in own], system)
        for side, value in enumerate((before, after))
    )
    percent = None
    if isinstance(before.value, float) and isinstance(after.value, float) and before.value:
        percent = 100.0 * (after.value / before.value - 1.0)
    return Change(after.name, old, new, None if _equal(before, after) else percent)


def _equal(before: _Value, after: _Value) -> bool:
    one, other = before.value, after.value
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=1e-9)  # more is round-off of units: numerical
    return one == other


def _shown(value: _Value, notes: Iterable[str], system: str) -> str:
    """Return a value as it prints, with notes in brackets."""
    text = str(value.value)
    if value.quantity == "ratio" and isinstance(value.value, float) and value.typed is None:
        text = compared(value.value, 4)
    elif value.quantity and isinstance(value.value, float):
        text = str(printed(value.value, value.quantity, system, given=value.typed is not None))
    elif value.typed and not value.default:
        text = str(value.typed)
    notes = [*filter(None, notes), *(["default"] if value.default else [])]
    return f"{text} ({'; '.join(notes)})" if notes else text


def _retyped(old: Mapping[Hashable, _Value], new: Mapping[Hashable, _Value]) -> Iterator[Change]:
    """Yield the inputs of the same value that are typed in another way, or not in one file."""
    for key in [key for key in new if key in old]:
        before, after = old[key], new[key]
        if _equal(before, after) and before.typed != after.typed:
            yield Change(after.name, str(before.typed), str(after.typed))


def _inputs(case: Case) -> dict[Hashable, _Value]:
    """Return all that a case starts from, by what tells it from the others."""
    inputs = case.inputs
    values: dict[Hashable, _Value] = {}
    for key in KEYS:
        if key not in _APART:
            values[key] = _input(inputs, key, case.given, _words(key), _origin(inputs, key))
    if inputs.truck_mass is None:
        own = "the truck file’s"
        values["truck_mass"] = _Value(_words("truck_mass"), case.truck.mass, "mass", (own,), own)
    steps: Any = case.given.get("steps", ())
    for number, (step, typed) in enumerate(zip(inputs.steps, steps, strict=True), 1):
        for key in type(step).model_fields:
            name = f"{_words(key)}, step {number}"
            values["steps", number, key] = _input(step, key, typed, name)
    values |= {("notes", note): _Value("Note", note) for note in inputs.notes}
    for one in inputs.revisions:
        line = f"{one.revision}, {one.date}: {one.description}, {one.by}"
        values["revisions", line] = _Value("Line of the table of revisions", line)
    return values | _truck(case)


def _input(
    inputs: SectionInputs, key: str, given: Mapping[str, object], name: str, origin: str = ""
) -> _Value:
    """Return the value of a key, which `given` has as it is typed."""
    value, quantity = getattr(inputs, key), BY_KEY[key].quantity if key in BY_KEY else ""
    if value in (None, (), NOT_GIVEN):
        return _Value(name, None, notes=(origin,))
    if isinstance(value, tuple):
        value = ", ".join(map(str, value))
    if not isinstance(value, float):
        return _Value(name, str(value), notes=(origin,), default=key not in given)
    typed = given.get(key, "the default")
    return _Value(name, value, quantity, (origin,), typed, key not in given)


def _origin(inputs: Inputs, key: str) -> str:
    """Return what the case file says that a value rests on."""
    assumed = inputs.assumed.get(key)
    return f"assumed: {assumed}" if assumed else inputs.sources.get(key, "")


def _words(key: str) -> str:
    """Return a key in words, as they begin a line."""
    return BY_KEY[key].heading if key in BY_KEY else key.replace("_", " ").capitalize()


def _truck(case: Case) -> dict[Hashable, _Value]:
    """Return the truck's file and its parameters as they apply."""
    file, truck = case.truck_file, case.truck
    low, high = truck.mass_range or (None, None)
    values: dict[Hashable, _Value] = {
        "truck": _Value("Truck", truck.name, notes=(f"{file.status.words}: {file.source}",)),
        "truck file": _Value("Truck file", file.file_name),
        "truck sha256": _Value("SHA-256 of the truck file", f"{file.sha256[:12]}…"),
        "truck low": _Value("Least total mass that the springs stand for", low, "mass"),
        "truck high": _Value("Largest total mass that the springs stand for", high, "mass"),
    }
    for own in file.parameters:
        value, origin, typed = own.value, own.status.words, own.given
        if own.name == "body_mass" and case.inputs.truck_mass is not None:
            value, typed = truck.body_mass, (origin := "total mass less the engine’s")
        spread = truck.spread.get(own.name)
        notes = (origin, spread.words if spread else "no spread")
        symbol = BY_KEY[own.name]
        values[own.name] = _Value(symbol.heading, value, symbol.quantity, notes, typed)
    return values


def _results(results: Results) -> dict[Hashable, _Value]:
    """Return the results of a calculation."""
    low, high = results.band or (None, None)
    values = [
        _Value("Resistance", results.resistance),
        _Value("Nominal impact height", results.impact_height, "length"),
        _Value("Stiffness of the pier", results.pier_stiffness, "stiffness"),
        _Value("Equivalent mass of the pier", results.pier_mass, "mass"),
        _Value("Natural frequency of the pier", results.pier_frequency, "frequency"),
        _Value("Engine peak", results.engine_peak, "force"),
        _Value("Cargo peak", results.cargo_peak, "force"),
        _Value("Peak that governs", results.governs),
        _Value("Design reaction", results.design_reaction, "force"),
        _Value("Reaction by hand", results.hand_reaction, "force"),
        _Value("Reaction that 5 % of trucks stay below", low, "force"),
        _Value("Reaction that 95 % of trucks stay below", high, "force"),
        _Value("Largest shear", results.largest_shear, "force", (results.shear_method,)),
        _Value("Largest moment", results.largest_moment, "moment", (results.moment_method,)),
        _Value("25 ms average over AASHTO LRFD", results.code_ratio, "ratio"),
    ]
    for check, quantity in DEMANDS.items():
        _, high = results.member_bands.get(check, (None, None))
        at_upper = results.upper_utilisations.get(check)
        values += [
            _Value(f"{check.capitalize()} that 95 % of trucks stay below", high, quantity),
            _Value(f"Utilisation in {check}", results.utilisations.get(check), "ratio"),
            _Value(f"Utilisation in {check} at 95 %", at_upper, "ratio"),
        ]
    return {value.name: value for value in values}


def _table(heading: str, changes: Sequence[Change]) -> Block:
    """Return changes as a table of a sheet."""
    return Table(
        label=f"tab-changed-{heading.lower()}",
        caption=f"{heading} that changed.",
        columns=columns("Value", wide("Before"), wide("Now"), decimal("Change")),
        rows=[[change.name, change.old, change.new, change.change] for change in changes],
    )


def _table_in_text(heading: str, changes: Sequence[Change]) -> str:
    """Return changes as a table in plain text, long cells in several lines."""
    rows = [(heading, "before", "now", "change"), *((*c[:3], c.change) for c in changes)]
    return text_table(rows, right=(3,), widest=_WIDEST)
