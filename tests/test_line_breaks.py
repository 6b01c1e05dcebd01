"""Formulas broken into lines for readers of Word files that break none."""

import re

import pytest

from pierimpact.report.document.line_breaks import broken, formula_width, unpaired_as_text

TERMS = " + ".join(rf"{i}.25 \times 10^{{-{i}}} \times \left(x_{i} - 1\right)" for i in range(1, 9))


@pytest.mark.parametrize(
    ("formula", "width"),
    [
        ("12.5", 4.0),
        (r"\frac{1}{\frac{123}{45}}", 3.0),
        (r"x_\mathrm{p}^{2}", 2.4),
        (r"\sin(\omega)", 6.0),
        (r"1\,200\ \text{kN}", 6.6),
        (r"\sqrt{x}", 2.0),
    ],
)
def test_the_width_counts_what_stands_side_by_side(formula, width):
    assert formula_width(formula) == pytest.approx(width)


@pytest.mark.parametrize(
    ("formula", "room", "lines"),
    [
        ("a = b + c", 40, ["a = b + c"]),
        ("abcd = efgh = ijkl", 10, ["abcd = efgh", "= ijkl"]),
        (r"ab = 10^{3} \times 10^{4}", 5, ["ab", r"= 10^{3} \times 10^{4}"]),
        (r"\left[abcd + efgh\right]^{2}", 6, [r"\left[abcd", r"+ efgh\right]^{2}"]),
        (r"\sqrt{abcd + efgh}", 8, [r"\left[abcd", r"+ efgh\right]^{1/2}"]),
        (r"\frac{abcd + efgh}{2}", 8, [r"\left(abcd", r"+ efgh\right) / 2"]),
    ],
)
def test_a_formula_is_broken_before_its_signs(formula, room, lines):
    assert broken(formula, room) == lines


@pytest.mark.parametrize("room", [30, 40, 54])
@pytest.mark.parametrize(
    "formula", [TERMS, rf"\sqrt{{{TERMS}}}", rf"x = \frac{{{TERMS}}}{{2}} = 7\ \text{{m}}"]
)
def test_lines_have_room_and_all_that_was_in_the_formula(formula, room):
    lines = broken(formula, room)
    assert max(map(formula_width, lines)) <= room
    assert len(lines) > 1
    numbers = re.findall(r"\d+\.\d+", formula)
    assert re.findall(r"\d+\.\d+", " ".join(lines)) == numbers


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        (r"a \times [1 - (b", r"a \times \text{[}1 - \text{(}b"),
        (r"+ (c) d)]^{2}", r"+ (c) d\text{)}\text{]}^{2}"),
        (r"\left[a \left(b\right)", r"\text{[}a \left(b\right)"),
        (r"(a) [b]", r"(a) [b]"),
        (r"n\right\rfloor + \lfloor n\rfloor", r"n\text{⌋} + \lfloor n\rfloor"),
    ],
)
def test_a_bracket_without_its_other_is_text(line, expected):
    assert unpaired_as_text(line) == expected
