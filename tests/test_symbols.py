"""The one table of symbols: complete, without clashes, and the source of what is printed."""

import re

import pytest

from pierimpact.files.inputs import PHYSICAL_KEYS
from pierimpact.files.trucks import read_truck_file
from pierimpact.symbols import BY_KEY, SYMBOLS, dimension
from pierimpact.units import CONSISTENT, DIMENSIONS, QUANTITIES


@pytest.mark.parametrize("name", SYMBOLS)
def test_every_symbol_has_meaning_and_kind(name):
    latex, quantity, meaning, _ = SYMBOLS[name]
    assert meaning
    assert meaning == meaning.strip()
    assert meaning.count("$") % 2 == 0
    assert not quantity or quantity in QUANTITIES
    assert latex.count("{") == latex.count("}")
    assert SYMBOLS[name].heading[1:] == meaning[1:]
    assert (dimension(SYMBOLS[name]) in DIMENSIONS) or not BY_KEY.get(name, SYMBOLS[name]).key or (
        not dimension(SYMBOLS[name])
    )  # fmt: skip


def test_no_two_quantities_share_a_symbol_or_a_meaning():
    latex = [symbol.latex for symbol in SYMBOLS.values() if symbol.latex]
    assert sorted(latex) == sorted(set(latex))
    meanings = [symbol.meaning for symbol in SYMBOLS.values()]
    assert sorted(meanings) == sorted(set(meanings))


def test_symbols_that_clashed_do_so_no_more():
    # A force and a displacement, friction and plateaus, area and amplitude: each its own letter.
    of_letter = {}
    for symbol in SYMBOLS.values():
        letter = re.match(r"[A-Za-z]+|\\[a-z]+", symbol.latex)
        if letter and symbol.quantity in ("force", "length", "area"):
            of_letter.setdefault(letter[0], set()).add(symbol.quantity)
    for letter in ("A", "F", "X", "Q"):
        assert len(of_letter[letter]) == 1, (letter, of_letter[letter])
    assert SYMBOLS["Fpl"].latex != SYMBOLS["F_f"].latex


def test_every_key_of_case_and_truck_is_in_the_table():
    assert set(PHYSICAL_KEYS) <= set(BY_KEY)
    truck = {parameter.name for parameter in read_truck_file("single-unit-8t").parameters}
    assert truck <= set(BY_KEY)
    assert set(BY_KEY) == set(PHYSICAL_KEYS) | truck


def test_consistent_units_are_those_of_the_same_dimension():
    for kind, consistent in CONSISTENT.items():
        assert consistent in QUANTITIES
        assert kind in QUANTITIES
