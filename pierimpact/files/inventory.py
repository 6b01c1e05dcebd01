"""The US National Bridge Inventory as a table of piers.

Its published delimited files hold where a bridge is, what passes over and under it and with how
much room, but not its piers: these come from the rules of the user, by kind of structure.

Items and the digits of coordinates are as read in the record format of the Federal Highway
Administration (fhwa.dot.gov/bridge/nbi/format.cfm), commas and single quotes about text on its page
of files (ascii2020.cfm); that coordinates are degrees, minutes, seconds and hundredths, in excerpts
of its coding guide. Headings are not in them: the one that ends in the number of an item, as
LAT_016, is taken for it, and where there is none or more than one, the rules name it. That
longitudes are west is second-hand.
"""

import csv
import io
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from pierimpact.checks import InputError, brief, known, no_formula
from pierimpact.files.csv_lines import decimal
from pierimpact.files.piers import KEYS, REQUIRED
from pierimpact.files.reading import require_regular
from pierimpact.files.toml_table import read_toml

#: What is taken of a bridge, with the number of its item.
ITEMS = {
    "state": "001",
    "structure": "008",
    "record": "005A",
    "latitude": "016",
    "longitude": "017",
    "built": "027",
    "lanes_under": "028B",
    "traffic": "029",
    "truck_share": "109",
    "kind": "043A",
    "type": "043B",
    "vertical_clearance": "054B",
    "right_clearance": "055B",
    "left_clearance": "056",
}
#: What a rule can ask for: a list of codes each, and for the year the first and the last.
CONDITIONS = ("kind", "type", "state", "record", "built")
#: The columns of what the inventory holds, beside the table of piers. Traffic is that of the route
#: of the record: under the bridge, whose trucks can strike its piers, where there is such a record.
HELD = (
    *("id", "latitude [°]", "longitude [°]", "record", "route", "built", "lanes_under"),
    *("traffic [1/day]", "trucks [1/day]", "vertical_clearance [m]"),
    *("right_clearance [m]", "left_clearance [m]"),
)
_DIGITS = {"latitude": 8, "longitude": 9}
#: The code of a record whose route goes over the bridge; all others go under it.
OVER = "1"
_MOST_DEGREES = {"latitude": 90.0, "longitude": 180.0}  # exactly
# Whether cells are quoted by apostrophes is told from so many characters: this project's choice.
_QUOTED, _SAMPLE = re.compile(r"(?:^|,)'[^'\n]*'(?=[,\r\n])", re.MULTILINE), 1_000_000


class Rule(NamedTuple):
    """Keys of a case file for the bridges that meet some conditions."""

    when: Mapping[str, tuple[str, ...]]  #: codes by field; of the year the first and the last
    values: Mapping[str, str]

    def holds(self, bridge: Mapping[str, str]) -> bool:
        """Whether a bridge meets all conditions."""
        for name, codes in self.when.items():
            if name == "built":
                first, last = map(int, codes)
                if not (_is_whole(bridge[name]) and first <= int(bridge[name]) <= last):
                    return False
            elif _code(bridge[name]) not in codes:
                return False
        return True


@dataclass(frozen=True, kw_only=True)
class Rules:
    """What a rules file says."""

    fields: Mapping[str, str]  #: headings that do not end in the number of the item
    east: tuple[str, ...]  #: codes of the states whose longitudes are east
    every: Mapping[str, str]  #: keys of a case file for all bridges
    rules: tuple[Rule, ...]  #: of which the first that holds adds its keys

    @property
    def keys(self) -> list[str]:
        """The keys that any bridge may get, in the order of a case file."""
        given = {*self.every, *(key for rule in self.rules for key in rule.values)}
        return [key for key in KEYS if key in given]


@dataclass(frozen=True, kw_only=True)
class Piers:
    """The piers of an inventory as two tables, and what was left out."""

    piers: bytes  #: CSV for `pierimpact portfolio`
    held: bytes  #: CSV of what the inventory holds, by the same ids
    count: int
    left_out: Counter[str] = field(default_factory=Counter)  #: bridges by reason
    blank: Counter[str] = field(default_factory=Counter)  #: coordinates left blank, by reason


def read_rules(path: Path) -> Rules:
    """Return the rules of a TOML file.

    Its table `fields` names headings that do not end in the number of their item, `east` lists
    states whose longitudes are east, `every` has keys of a case file for all bridges, and each of
    `rules` has under `when` the codes it is for, and keys of a case file.

    Raises
    ------
    InputError
        When it cannot be read or breaks a rule, in one line.
    """
    try:
        table = read_toml(path).table
        for name in table:
            known(name, ("fields", "east", "every", "rules"), "a table of a rules file")
        names = _texts("fields", table.get("fields", {}))
        for name in names:
            known(name, ITEMS, "a field of the inventory")
        listed = table.get("rules", [])
        if not isinstance(listed, list):
            raise InputError("rules must be written as [[rules]], one for each kind of structure")
        every = _keys("every", table.get("every", {}))
        rules = tuple(_rule(f"rules[{n}]", rule) for n, rule in enumerate(listed, 1))
        east = _codes("east", table.get("east", []))
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    return Rules(fields=names, east=east, every=every, rules=rules)


def _rule(name: str, rule: Any) -> Rule:
    if not isinstance(rule, dict):
        raise InputError(f"{name} must be a table, got {brief(rule)}")
    asked = rule.get("when", {})
    if not isinstance(asked, dict):
        raise InputError(f"{name}.when must be a table of codes, got {brief(asked)}")
    when = {}
    for what, codes in asked.items():
        known(what, CONDITIONS, f"a condition ({', '.join(CONDITIONS)})")
        when[what] = _codes(f"{name}.when.{what}", codes)
        if what == "built" and len(when[what]) != 2:
            raise InputError(f"{name}.when.built must be the first and the last year")
    keys = {key: value for key, value in rule.items() if key != "when"}
    return Rule(when, _keys(name, keys))


def _keys(name: str, table: Any) -> dict[str, str]:
    texts = _texts(name, table)
    for key in texts:
        known(key, KEYS, "a key of a case file that a table of piers can have")
    return texts


def _texts(name: str, table: Any) -> dict[str, str]:
    if not isinstance(table, dict):
        raise InputError(f"{name} must be a table, got {brief(table)}")
    for key, value in table.items():
        if isinstance(value, bool) or not isinstance(value, str | int | float):
            raise InputError(f"{name}.{key} must be text or a number, got {brief(value)}")
    return {key: str(value) for key, value in table.items()}


def _codes(name: str, values: Any) -> tuple[str, ...]:
    if not isinstance(values, list) or not all(
        isinstance(value, int | str) and not isinstance(value, bool) and _is_code(value)
        for value in values
    ):
        raise InputError(f"{name} must be a list of codes, got {brief(values)}")
    return tuple(_code(str(value)) for value in values)


def _is_code(value: object) -> bool:
    return bool(str(value).strip())


def _code(text: str) -> str:
    """Return a code without the zeros before it, which some files have and others have not."""
    return text.lstrip("0") or text[-1:]


def piers_of(path: Path, rules: Rules) -> Piers:
    """Return the piers of an inventory file: one for each bridge with lanes under it.

    Of a bridge with several records it is of the first whose route goes under it, or else of the
    first. Coordinates that cannot be read are left blank.

    Raises
    ------
    InputError
        When the file cannot be read, or lacks a field; the message names it and its heading.
    """
    piers, held = io.StringIO(), io.StringIO()
    to_piers, to_held = (csv.writer(file, lineterminator="\n") for file in (piers, held))
    keys = rules.keys
    to_piers.writerow(["id", "latitude", "longitude", *keys])
    to_held.writerow(HELD)
    left_out: Counter[str] = Counter()
    blank: Counter[str] = Counter()
    rows: dict[str, _Bridge] = {}
    try:
        for bridge in _bridges(path, rules.fields, left_out):
            name = f"{_code(bridge['state'])}-{bridge['structure']}"
            try:
                values = _values(bridge, rules)
            except InputError as error:
                left_out[str(error)] += 1
                continue
            if name in rows:
                left_out["another route of a bridge that has a row already"] += 1
                if is_under(bridge) <= is_under(rows[name].items):
                    continue
            rows[name] = _Bridge(bridge, values)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    for name, (items, given) in rows.items():
        degrees = []
        for which in _DIGITS:
            try:
                degrees.append(_degrees(items, which, rules))
            except InputError as error:
                blank[str(error)] += 1
                degrees.append(None)
        place = ["", ""] if None in degrees else [f"{x:.6f}" for x in degrees]
        cells = [no_formula(given.get(key, "")) for key in keys]
        to_piers.writerow([no_formula(name), *place, *cells])
        to_held.writerow([no_formula(name), *place, *_held(items)])
    return Piers(
        piers=piers.getvalue().encode(),
        held=held.getvalue().encode(),
        count=len(rows),
        left_out=left_out,
        blank=blank,
    )


class _Bridge(NamedTuple):
    """A record of a bridge, and the keys of its pier."""

    items: Mapping[str, str]
    values: Mapping[str, str]


def is_under(bridge: Mapping[str, str]) -> bool:
    """Return whether the route of a record goes under the bridge."""
    return bridge["record"] != OVER


def _bridges(
    path: Path, fields: Mapping[str, str], left_out: Counter[str]
) -> Iterator[dict[str, str]]:
    """Yield what is taken of each bridge, as text; count the lines that are no bridges."""
    require_regular(path)
    with path.open(encoding="latin-1", newline="") as file:
        quote = "'" if _QUOTED.search(file.read(_SAMPLE)) else '"'
        file.seek(0)
        rows = csv.reader(file, quotechar=quote)
        heading = [cell.strip().removeprefix("ï»¿") for cell in next(rows, [])]
        places = {what: _place(what, heading, fields.get(what)) for what in ITEMS}
        reason, before = "", rows.line_num
        for row in rows:
            lines, first, before = rows.line_num - before, before + 1, rows.line_num
            if len(row) == len(heading):
                yield {what: row[place].strip() for what, place in places.items()}
            elif row:  # a quote that is not closed takes the lines after it as well
                reason = (
                    reason or f"more or fewer cells than the heading, the first in line {first}"
                )
                left_out[reason] += lines


def _place(what: str, heading: list[str], named: str | None) -> int:
    """Return the place of an item by the heading that the rules name, or else by its number."""
    if named is not None:
        if named not in heading:
            raise InputError(f"has no field {named}, which by the rules is the {what}")
        return heading.index(named)
    places = [n for n, cell in enumerate(heading) if cell.rpartition("_")[2] == ITEMS[what]]
    if len(places) != 1:
        raise InputError(
            f"has {len(places) or 'no'} fields whose heading ends in _{ITEMS[what]}, which is the "
            f'{what}: name its heading in the rules, [fields] {what} = "…"'
        )
    return places[0]


def _values(bridge: Mapping[str, str], rules: Rules) -> dict[str, str]:
    """Return the keys of a bridge's pier."""
    if not _is_whole(lanes := bridge["lanes_under"]) or int(lanes) == 0:
        raise InputError("no lanes under it")
    rule = next((rule for rule in rules.rules if rule.holds(bridge)), None)
    if rules.rules and rule is None:
        kind, kind_of = _code(bridge["kind"]), _code(bridge["type"])
        raise InputError(f"no rule for kind {kind}, type {kind_of}")
    values = {**rules.every, **(rule.values if rule else {})}
    for key in REQUIRED:
        if key != "id" and key not in values:
            raise InputError(f"no rule gives {key}, which the inventory does not hold")
    return values


def _is_whole(text: str) -> bool:
    """Return whether a text is a whole number in plain digits."""
    return text.isascii() and text.isdecimal()


def _degrees(bridge: Mapping[str, str], which: str, rules: Rules) -> float | None:
    """Return a coordinate [°]; None where it is blank or zero.

    Zeros before it may be lost, but none of a degree.
    """
    text, digits = bridge[which], _DIGITS[which]
    if not text.strip("0 "):
        return None
    minutes, seconds = text[-6:-4], text[-4:]
    if not (
        _is_whole(text) and 7 <= len(text) <= digits and int(minutes) < 60 and int(seconds) < 6000
    ):
        raise InputError(f"{which} is not degrees, minutes, seconds and hundredths")
    degrees = int(text[:-6]) + int(minutes) / 60 + int(seconds) / 360_000
    if degrees > _MOST_DEGREES[which]:
        raise InputError(f"{which} is more than {_MOST_DEGREES[which]:g}°")
    west = which == "longitude" and _code(bridge["state"]) not in rules.east
    return -degrees if west else degrees


def _held(bridge: Mapping[str, str]) -> Iterable[str]:
    try:
        volume, share = (float(decimal(key, bridge[key])) for key in ("traffic", "truck_share"))
        trucks = f"{volume * share / 100:.6g}"
    except InputError:  # one of them is not given
        trucks = ""
    return (
        bridge["record"],
        "under" if is_under(bridge) else "over",
        *(bridge[name] for name in ("built", "lanes_under", "traffic")),
        trucks,
        *(bridge[f"{side}_clearance"] for side in ("vertical", "right", "left")),
    )
