"""The sheet calculated again from what is printed in it, read off the pages of reports.

What the full model gives cannot be repeated by hand: it is solved again, from the printed truck,
speed and pier, by the integration in small steps of `reference`.
"""

import math
import re
from functools import cached_property
from pathlib import Path
from xml.etree import ElementTree

import beam_reference
import mathml
import numpy as np
import pytest
import reference
import yaml
from sheet_page import US_CASE, page_of

import pierimpact
from pierimpact import (
    CircularSection,
    CrushSpring,
    EquivalentPier,
    PierColumn,
    RectangularSection,
    Truck,
    design_reaction,
    reaction_band,
    simulate,
)
from pierimpact.files.case import case_from
from pierimpact.report.calculation import calculate
from pierimpact.vehicle.truck import QUANTITIES

EXAMPLE = Path(__file__).parent.parent / "notebooks" / "tti-column.yaml"
SLOW_CASE = US_CASE | {  # neither engine nor cargo reaches the pier
    "column_shape": "polygonal",
    "column_width": None,
    "column_depth": None,
    "column_sides": 8,
    "column_across_flats": "0.8 m",
    "base": "pinned",
    "top": "pinned",
    "speed": "20 km/h",
    "impact_height": "1.1 m",
    "units": "SI",
}


# Every other shape, pair of ends and regime.
CASES = {
    "example": yaml.safe_load(EXAMPLE.read_text("utf-8")),
    "us": US_CASE,
    "slow": SLOW_CASE,
    "no cargo": {
        **SLOW_CASE,
        "column_shape": "hollow circular",
        "column_sides": None,
        "column_across_flats": None,
        "column_diameter": "0.95 m",
        "column_wall_thickness": "0.18 m",
        "stiffness_factor": 0.8,
        "speed": "34 km/h",
        "base": "fixed",
        "top": "pinned",
    },
    "soft": {
        **US_CASE,
        "column_shape": "oblong",
        "column_width": "2 ft",
        "column_depth": "2.5 ft",
        "column_height": "25 ft",
        "top": "free",
        "speed": "70 mph",
        "impact_height": "5.5 ft",
    },
    "fast": {
        "column_shape": "circular",
        "column_diameter": "1.35 m",
        "column_height": "7.3 m",
        "elastic_modulus": "31.7 GPa",
        "poisson_ratio": 0.17,
        "density": "2510 kg/m^3",
        "base": "pinned",
        "top": "fixed",
        "truck": "single-unit-8t",
        "truck_mass": "17.3 t",
        "speed": "107 km/h",
        "impact_height": "auto",
        "damping_ratio": 0.021,
        "moment_resistance": "60 MN*m",
    },
    "heavy": {
        "column_shape": "filled rectangular",
        "column_width": "4 ft",
        "column_depth": "42 in",
        "column_wall_thickness": "0.75 in",
        "modular_ratio": 7.4,
        "density_ratio": 3.38,
        "column_height": "22 ft",
        "elastic_modulus": "3900 ksi",
        "density": "145 lb/ft^3",
        "base": "free",
        "top": "fixed",
        "truck": "single-unit-8t",
        "truck_mass": "30000 lb",
        "speed": "47 mph",
        "impact_height": "4 ft",
        "units": "US",
    },
    "on the pier": {
        "column_shape": "rectangular",
        "column_width": "0.8 m",
        "column_depth": "0.8 m",
        "column_height": "6.5 m",
        "concrete_strength": "35 MPa",
        "density": "2450 kg/m^3",
        "base": "fixed",
        "top": "fixed",
        "truck": "on-the-pier.toml",
        "speed": "93 km/h",
        "impact_height": "auto",
        "shear_resistance": "3 MN",
    },
}


class Sheet:
    """The page of a report: its tables, its steps, and the values it prints by symbol."""

    def __init__(self, page):
        self.page = page
        self.values = {}  # value and half a unit in the last place [SI], by symbol
        self.formulas = {}  # right-hand side in symbols, by symbol

    def rows(self, label):
        """Return the cells of a table's rows, as elements."""
        body = re.search(rf'id="{label}">.*?<tbody>(.*?)</tbody>', self.page, re.DOTALL)[1]
        return [list(row) for row in ElementTree.fromstring(f"<b>{unnamed(body)}</b>")]

    def word(self, label, name):
        """Return the word that a table gives for a value without symbol."""
        return next(row[2] for row in map(self.texts, self.rows(label)) if row[0] == name)

    def texts(self, row):
        """Return the texts of a row's cells."""
        return [plain(cell) for cell in row]

    @cached_property
    def truck(self):
        """The truck of the printed parameters."""

        def value(*symbol):
            return self.values[symbol][0]

        def spring(i):
            return CrushSpring(
                plateau_force=value(f"P_{i}"),
                plateau_length=value(f"d_{i}"),
                stiffness=value(f"k_{i}"),
                unloading_stiffness=value(f"k_u{i}"),
            )

        return Truck(
            name="printed",
            engine_mass=value("m_1"),
            body_mass=value("m_2"),
            engine_spring=spring(1),
            body_spring=spring(2),
            friction_force=value("c_s"),
            friction_on=self.word("tab-truck", "Friction acts against the"),
        )

    @cached_property
    def pier(self):
        """The pier of the printed mass, stiffness and damping ratio."""
        mass, stiffness, ratio = (self.values[(name,)][0] for name in ("m_p", "k_p", "ζ"))
        return EquivalentPier(mass=mass, stiffness=stiffness, damping_ratio=ratio)

    @cached_property
    def solution(self):
        """The full model of the printed truck, pier and speed, integrated in small steps."""
        return reference.solve(self.truck, self.pier, self.values[("V",)][0])

    def numbers(self, label):
        """Return the texts of a table's cells, by row heading."""
        rows = [[plain(cell) for cell in row] for row in self.rows(label)]
        return {row[0]: row[1:] for row in rows}

    def steps(self):
        """Yield label and sides of every step, in the order of the page."""
        for label, formula in re.findall(
            r'<div class="step[^"]*" id="([^"]+)">.*?<div class="math">(<math.*?</math>)',
            self.page,
            re.DOTALL,
        ):
            yield label, mathml.rows(formula)

    def learn(self, symbol, number, unit):
        """Take a printed value for that of a symbol."""
        power = re.fullmatch(r"(.*)×10(.*)", number)
        mantissa = power[1] if power else number
        factor = 10.0 ** int(power[2].translate(DIGITS)) if power else 1.0
        factor *= mathml.size(unit)
        value = float(mantissa.replace("−", "-"))
        half = mathml.half_unit(mantissa.lstrip("−"))
        self.values[tuple(symbol)] = value * factor, half * factor


DIGITS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def unnamed(xml):
    """Return XML whose formulas all have the namespace, and no entity that XML lacks."""
    return xml.replace("&nbsp;", " ")


def plain(cell):
    """Return the text of a cell, numbers without their padding and thousands' spaces."""
    text = "".join(cell.itertext())
    return re.sub(r"(?<=\d)\u202f(?=\d)", "", text).strip("\u2007\u2008 \n")


def symbol_of(cell):
    formula = cell.find(f".//{mathml.NAMESPACE}math")
    return None if formula is None else mathml.joined(mathml.tokens(formula))


def number(text):
    """Return a printed number."""
    mantissa, times, power = text.replace("−", "-").partition("×10")
    return float(mantissa) * (10.0 ** int(power.translate(DIGITS)) if times else 1.0)


def half(text, digits=4):
    """Return half a unit in the last place of a number printed to significant figures."""
    if "." in text:
        return 0.5 * 10.0 ** -len(text.partition(".")[2])
    return 0.5 * 10.0 ** max(len(text.lstrip("−")) - digits, 0)


def close(found, text, moved=0.0, digits=4):
    """Check a value against a printed one, as far as the printed figures tell."""
    assert abs(found - number(text)) <= 1.01 * (moved + half(text, digits)), (found, text)


def quotient(above, below, text):
    """Check a printed ratio against the printed numbers that it is of."""
    found = number(above) / number(below)
    moved = half(above) / abs(number(above)) + half(below) / abs(number(below))
    close(found, text, moved * abs(found), digits=3)


@pytest.fixture(scope="module", params=CASES)
def sheet(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("trucks")
    catalogue = Path(pierimpact.__file__).parent / "trucks" / "single-unit-8t.toml"
    truck = re.sub(r'value = "road"', 'value = "pier"', catalogue.read_text("utf-8"))
    (folder / "on-the-pier.toml").write_text(truck, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        page = page_of(CASES[request.param] | {"annexes": "all"})
    result = Sheet(page)
    result.case = CASES[request.param]
    for label in ("tab-inputs", "tab-truck"):
        for row in result.rows(label):
            symbol = symbol_of(row[1])
            if symbol and number_like(plain(row[2])):
                result.learn(symbol, plain(row[2]), plain(row[3]))
    return result


#: By the unit of speed of the sheet: 10 km/h or 5 mph.
SPEED_CHANGES = {"km/h": 10.0 / 3.6, "mph": 5.0 * 1609.344 / 3600.0}
#: A given value, and behind it the one that it was converted from.
STATED = r"([\d.]+) ([^\s().,]+)(?: \(([\d.]+) ([^\s()]+)\))?"


def exactly(number_, unit, original, unit_of_original):
    """Return a value that is STATED in SI units, by what it was converted from if it was."""
    if original:
        assert float(number_) == float(f"{float(number_):.3g}")  # no figures that nobody gave
        number_, unit = original, unit_of_original
    return number(number_) * mathml.size(unit)


def number_like(text):
    return re.match(r"−?\d", text) is not None


def numeric(words):
    """Tell whether an expression has no symbol in it."""
    return all(
        mathml.NUMBER.fullmatch(word)
        or word in mathml.OPERATORS
        or word in ("max", "min")
        or word.startswith(("math.", "unit:"))
        for word in words
    )


@pytest.fixture(scope="module")
def calculated(sheet):
    """Follow the steps of the page in their order, checking each; return the page."""
    found = re.search(r"</math> = ([\d.]+) (ft|m)(?: \([\d.]+ m\))?(?: is given|;)", sheet.page)
    sheet.learn(["z_n"], found[1], found[2])
    unit = re.search(r'id="tab-work">.*?\[([^\]]+)\]', sheet.page, re.DOTALL)[1]
    sheet.learn(["x", "(", "z_n", ")"], sheet.numbers("tab-work")["Sum"][-1], unit)
    for row in sheet.rows("tab-unit-force"):
        sheet.learn(symbol_of(row[1]), plain(row[2]), plain(row[3]))
    values, checked = sheet.values, 0
    for label, sides in sheet.steps():
        if label == "eq-omega":
            check_starting_values(sheet)
        if label.startswith("eq-shape"):
            continue
        symbol, result = tuple(sides[0]), sides[-1]
        shown, rounding = mathml.evaluate(result, {})
        for side in sides[1:-1]:
            if not numeric(side):
                sheet.formulas[label] = symbol, side
                value, moved = mathml.evaluate(side, values)
                expected, allowed = shown, rounding
            else:
                bare = not any(word.startswith("unit:") for word in side)
                value, moved = mathml.evaluate(side, {})
                expected, allowed = mathml.evaluate(
                    [word for word in result if not (bare and word.startswith("unit:"))], {}
                )
            assert abs(value - expected) <= 1.01 * (moved + allowed), (label, side, value, expected)
            checked += 1
        if symbol in values and label != "eq-omega":  # printed before, in a table
            before, half_of_before = values[symbol]
            assert abs(shown - before) <= 1.01 * (rounding + half_of_before), label
        values[symbol] = shown, rounding
    assert checked > 60
    return sheet


def check_starting_values(sheet):
    """Check the table of starting values against inputs and steps, and take them from it."""
    cells = [cell for row in sheet.rows("tab-given") for cell in row]
    for place in range(0, len(cells), 3):
        symbol, number, unit = cells[place : place + 3]
        if symbol_of(symbol) is None:  # the last line is not full
            continue
        symbol = tuple(symbol_of(symbol))
        before, rounding = sheet.values[symbol]
        sheet.learn(symbol, plain(number), plain(unit))
        value, half_of_value = sheet.values[symbol]
        assert abs(value - before) <= 1.01 * (rounding + half_of_value), symbol


def test_every_step_follows_from_what_is_printed_before_it(calculated):
    assert ("R_1",) in calculated.values


def test_the_mass_of_the_body_is_what_the_engine_leaves(calculated):
    values = calculated.values
    whole, engine, body = values[("m_1", "+", "m_2")], values[("m_1",)], values[("m_2",)]
    assert abs(whole[0] - engine[0] - body[0]) <= 1.01 * (whole[1] + engine[1] + body[1])


def test_the_shape_and_its_integral(calculated):
    below, above = (
        sides[2][: sides[2].index("unit:with")]
        for label, sides in calculated.steps()
        if label.startswith("eq-shape")
    )
    height, impact = calculated.values[("H",)][0], calculated.values[("z_n",)][0]
    unit = re.search(r'id="tab-ordinates">.*?\[(m|ft)\]', calculated.page, re.DOTALL)[1]

    def shape(z):
        words, s = (below, z / height) if z < impact else (above, (height - z) / height)
        return mathml.evaluate(words, {("s",): (s, 0.0)})

    for z, phi, square in (
        [plain(cell) for cell in row] for row in calculated.rows("tab-ordinates")
    ):
        found, moved = shape(number(z) * mathml.size(unit))
        slack = 2e-4  # of z, itself rounded
        close(found, phi, moved + slack)
        close(number(phi) ** 2, square, 2.0 * abs(number(phi)) * half(phi))
    total, steps = 0.0, 2000
    for index in range(steps):
        total += shape((index + 0.5) / steps * height)[0] ** 2 * height / steps
    printed_total, rounding = mathml.evaluate(
        next(sides[-1] for label, sides in calculated.steps() if label == "eq-phi2"), {}
    )
    assert total == pytest.approx(printed_total, rel=3e-4, abs=rounding)


def test_masses_and_works_of_the_parts_add_up(calculated):
    shares, works = calculated.numbers("tab-shape"), calculated.numbers("tab-work")
    head = re.search(r'id="tab-shape">.*?</thead>', calculated.page, re.DOTALL)[0]
    length, mass_unit = map(mathml.size, re.findall(r"\[([^\]]+)\]</th>", head))
    per_length = calculated.values[("m_‾",)][0] * length / mass_unit
    whole = shares.pop("Sum")[-1]
    for *_, integral, mass in shares.values():
        found = per_length * number(integral)
        close(found, mass, per_length * half(integral, 5) + 1e-4 * found, digits=5)
    total = sum(number(row[-1]) for row in shares.values())
    assert total == pytest.approx(number(whole), rel=1e-4)
    *parts, last = (number(row[-1]) for row in works.values())
    assert sum(parts) == pytest.approx(last, rel=1e-4)
    for flexure, shear, both in (row for name, row in works.items() if name != "Sum"):
        assert number(flexure) + number(shear) == pytest.approx(number(both), rel=1e-4)


def reaction(calculated):
    """Return the design reaction as printed, and half a unit in its last place [SI]."""
    text = calculated.numbers("tab-check")["Governing"][0]
    return number(text) * force_unit(calculated), half(text) * force_unit(calculated)


def before_cargo(calculated):
    """Return what the sheet says makes the peak before cargo contact: engine or sheet metal."""
    return next(iter(calculated.numbers("tab-peaks")))


def test_the_methods_beside_the_full_model(calculated):
    unit = force_unit(calculated)
    found = [calculated.values.get((symbol,), (0.0, 0.0))[0] for symbol in ("R_1", "R_2")]
    long_level = calculated.numbers("tab-check-long")
    first = before_cargo(calculated)
    close(found[0] / unit, long_level[first][1], 0.1)
    close(max(found) / unit, long_level["Governing"][1], 0.1)
    for label in ("tab-check", "tab-check-long"):
        checks = calculated.numbers(label)
        assert list(checks) == [first, "Cargo", "Governing"]
        for exact, closed, ratio in checks.values():
            if "none" not in (exact, closed):
                quotient(closed, exact, ratio)


def force_unit(calculated):
    return mathml.size(re.search(r"Full model \[(kN|kip)\]", calculated.page)[1])


def test_the_short_level(calculated):
    values = dict(calculated.values)
    for row in calculated.rows("tab-short"):
        sides = mathml.rows(ElementTree.tostring(row[1].find(f".//{mathml.NAMESPACE}math")))
        found, moved = mathml.evaluate(sides[1], values)
        symbol = tuple(sides[0])
        sheet = Sheet("")
        sheet.learn(symbol, plain(row[2]), plain(row[3]))
        values[symbol] = sheet.values[symbol]
        shown, rounding = values[symbol]
        assert abs(found - shown) <= 1.01 * (moved + rounding), symbol
    checks, unit = calculated.numbers("tab-check"), force_unit(calculated)
    for name, symbol in ((before_cargo(calculated), "R_1"), ("Cargo", "R_2")):
        text = checks[name][1]
        if text != "none":
            close(values[(symbol,)][0] / unit, text, 1e-4 * values[(symbol,)][0] / unit)


def test_member_forces_and_utilisations(calculated):
    peak, rounding = reaction(calculated)
    lowest = calculated.numbers("tab-peaks")["Lowest"][1]
    unit = force_unit(calculated)
    names = {
        "Shear at the base": (1.0, "R_b"),
        "Shear at the top": (-1.0, "R_t"),
        "Moment at the base": (1.0, "M_b"),
        "Moment at the impact": (1.0, "M_n"),
        "Moment at the top": (1.0, "M_t"),
    }
    rows = calculated.numbers("tab-members")
    for name, (sign, symbol) in names.items():
        share, half_of_share = calculated.values[(symbol,)]
        _, *shown, _, _, size = rows[name]
        size = mathml.size(size)
        reactions = ((peak, rounding), (number(lowest) * unit, half(lowest) * unit))
        for (force, half_of_force), text in zip(reactions, shown, strict=True):
            moved = abs(force) * half_of_share + abs(share) * half_of_force
            close(sign * force * share / size, text, moved / size)
    for kind in ("shear", "moment"):
        here = [rows[name] for name in names if name.startswith(kind.capitalize())]
        _, static, _, beam, *_ = largest(rows, kind)
        assert ("tab-places" in calculated.page) == ("of both" in " ".join(rows))
        if "tab-places" in calculated.page:
            of_each = list(calculated.numbers("tab-places").values())
            assert len(of_each) == 2
            first = 0 if kind == "shear" else 2
            assert static == max((row[first] for row in of_each), key=number)
            assert beam == max((row[first + 1] for row in of_each), key=number)
        else:
            assert number(static) == max(abs(number(row[1])) for row in here)
        assert number(beam) >= max(
            abs(number(value)) for row in here for value in row[3:5] if value
        )
    if "tab-utilisation" not in calculated.page:
        assert "gives no resistance" in calculated.page
        return
    alone = {
        method: {name: text for text, name in re.findall(r"([\d.]+) in (shear|moment)", words)}
        for method, words in zip(
            ("static", "beam"), re.split("beam alone", at_upper_end(calculated)), strict=False
        )
    }
    for check, cells in calculated.numbers("tab-utilisation").items():
        name = check.split(" ")[0].lower()
        static, beam, by, resistance, ratio, at_upper, verdict = cells
        _, of_static, _, of_beam, *_ = largest(rows, name)
        assert (static, beam) == (of_static, of_beam)
        demand = max(static, beam, key=number)
        assert by == ("column as a beam" if demand != static else "static reaction")
        if resistance == "not given":
            assert (ratio, at_upper, verdict) == ("", "", "not checked")
            continue
        quotient(demand, resistance, ratio)
        if not at_upper:
            assert "Band, 5 to 95 %" not in headline(calculated)
            continue
        upper = number(band_of(calculated)[1]) * unit / peak
        ends = [number(alone[method][name]) for method in ("static", "beam")]
        assert number(at_upper) >= max(ends)
        if "of both" not in " ".join(rows):
            found = number(static) * upper / number(resistance)
            close(found, alone["static"][name], 2e-3 * found, digits=3)
        quotient(members_band(calculated, name)[1], resistance, at_upper)
        if number(ratio) > 1.0:
            assert verdict == "EXCEEDS the resistance"
        elif number(at_upper) > 1.0:
            assert verdict == "within, but EXCEEDS at 95 %"
        else:
            assert verdict == "within the resistance"


def largest(rows, kind):
    """Return the row of the largest shear or moment of all heights."""
    return next(rows[n] for n in (f"Largest {kind} of both", f"Largest {kind}") if n in rows)


def band_of(calculated):
    """Return the printed ends of the band."""
    return headline(calculated)["Band, 5 to 95 %"][0].split("–")


def at_upper_end(calculated):
    """Return what the page says about each method at the upper end of the band."""
    found = re.search(r"by the static reaction alone .*?\.</", calculated.page, re.DOTALL)
    return found[0] if found else ""


def members_band(calculated, kind):
    """Return the printed ends of the band of the largest shear or moment; None without one."""
    found = re.search(r"5 to 95 %: ([\d.]+)–([\d.]+) ", headline(calculated)[f"Largest {kind}"][1])
    return found and found.groups()


def headline(calculated):
    """Return value and remark of the results beside the drawing, by their labels."""
    cells = re.findall(
        r'<dt>([^<]+)</dt>\s*<dd><span class="value">([^<]*)<small>[^<]*</small></span>'
        r'<span class="remark">([^<]*)',
        calculated.page,
    )
    return {
        name: (value.replace("\u202f", ""), remark.replace("\u202f", ""))
        for name, value, remark in cells
    }


def test_the_beam_of_the_example_by_finite_elements(calculated):
    if CASES["example"]["project"] not in calculated.page:
        return
    case = case_from(CASES["example"])
    speed, height = case.inputs.speed, case.inputs.impact_height
    damping = case.inputs.damping_ratio
    found = beam_reference.solve(case.truck, case.column, height, damping, speed, 0.06)
    rows = calculated.numbers("tab-members")
    for kind, values in (("shear", found.shear), ("moment", found.moment)):
        largest = 1e-3 * np.abs(values).max()  # here it is at the base
        assert number(rows[f"Largest {kind}"][3]) == pytest.approx(largest, rel=5e-3)


def test_codes_at_their_own_height(calculated):
    """The sheet's own equations, with the height of the clause for that of this calculation."""
    names = ("delta10", "delta11", "Rt", "Rb", "Mt", "Mb", "Mn")
    steps = [label for label in calculated.formulas if label.removeprefix("eq-") in names]
    caption = re.search(r'id="tab-effects">(.*?)<tbody>', calculated.page, re.DOTALL)[1]
    units = [mathml.size(unit) for unit in re.findall(r"\[([^\]]+)\]</th>", caption)]
    force_size, length, _, moment_size = units
    checked = calculated.numbers("tab-utilisation") if "tab-utilisation" in calculated.page else {}
    resistances = {
        name.split()[0]: row[3] for name, row in checked.items() if row[3] != "not given"
    }
    used = calculated.numbers("tab-code-utilisation") if resistances else {}
    assert len(used) == (len(calculated.numbers("tab-codes")) if resistances else 0)
    rows, given = calculated.numbers("tab-effects"), calculated.numbers("tab-codes")
    assert len(rows) == len(given) + 1 > 8
    for name, (force, height, shear, moment, *ratios) in rows.items():
        if name in given:
            assert force == given[name][2]
            assert height == (given[name][4] if given[name][4] != "—" else height)
            assert height.endswith("*") == (given[name][4] == "—")
        own = rows["This calculation, static"]
        pairs = zip((own[0], *own[2:4]), (force, shear, moment), strict=True)
        for ratio, (mine, other) in zip(ratios, pairs, strict=True):
            if number(other):
                quotient(mine, other, ratio)
            else:
                assert ratio == "—"
        values = dict(calculated.values)
        values[("z_n",)] = number(height.rstrip("*")) * length, 0.0
        for label in steps:
            if label in calculated.formulas:
                symbol, side = calculated.formulas[label]
                values[symbol] = mathml.evaluate(side, values)[0], 0.0
        share = abs(values[("R_b",)][0])
        close(share * number(force), shear, share * (half(force) + 1e-4 * number(force)))
        largest = max(abs(values[(symbol,)][0]) for symbol in ("M_b", "M_n", "M_t"))
        largest *= force_size / moment_size
        close(largest * number(force), moment, largest * (half(force) + 1e-4 * number(force)))
        share = max(abs(values[(symbol,)][0]) for symbol in ("R_b", "R_t"))
        per_force = {"Shear": share, "Moment": largest}
        cells = used.get(name, [])
        pairs = zip(cells[::2], cells[1::2], strict=True)
        for (demand, ratio), (check, resistance) in zip(pairs, resistances.items(), strict=False):
            if demand == "—":
                continue
            found = per_force[check] * number(force)
            close(found, demand, found * 1e-4 + per_force[check] * half(force))
            quotient(demand, resistance, ratio)


@pytest.mark.parametrize(
    ("code", "remark"),
    [("EN 1991-1-7, hard impact", "unverified"), ("JCSS, hard impact", "read in a public copy")],
)
def test_the_hard_impact_force(calculated, code, remark):
    """F = v √(k m) with the stiffness that the note names."""
    force = calculated.numbers("tab-codes")[code][2]
    stiffness = re.search(rf"{code}: [^<]* k = {STATED} \({remark}", calculated.page)
    k = exactly(*stiffness.groups())
    assert k == pytest.approx(300e3, rel=3e-5)
    speed, mass = calculated.values[("V",)][0], calculated.values[("m_1", "+", "m_2")][0]
    found = speed * (k * mass) ** 0.5 / force_unit(calculated)
    close(found, force, 1e-4 * found, digits=5)


def test_sensitivities(calculated):
    rows = calculated.numbers("tab-sensitivity")
    assert len(rows) == 5
    _, _, base, *_ = rows["This case"]
    for name, (value, procedure, model, ratio, over) in rows.items():
        quotient(procedure, model, ratio)
        quotient(model, base, over)
        if name.startswith("Speed"):
            assert value.split()[1] in ("km/h", "mph")
            changed = number(value.split()[0]) * mathml.size(value.split()[1])
            sign = -1.0 if "less" in name else 1.0
            difference = changed - calculated.values[("V",)][0]
            assert difference == pytest.approx(sign * SPEED_CHANGES[value.split()[1]], abs=2e-3)
        if name.startswith("Mass"):
            number_, unit = value.replace("\u202f", "").split()
            share = number(number_) * mathml.size(unit) / calculated.values[("m_1", "+", "m_2")][0]
            assert share == pytest.approx(0.8 if "less" in name else 1.2, rel=1e-4)


def test_the_first_page_repeats_what_is_calculated(calculated):
    cells, checks = headline(calculated), calculated.numbers("tab-check")["Governing"]
    value, remark = cells["Design reaction"]
    assert value == checks[0]
    height = exactly(*re.search(f"at {STATED} above", remark).groups())
    assert height == pytest.approx(calculated.values[("z_n",)][0], rel=2e-5)
    by_hand, ratio = re.search(r"by hand ([\d.]+) (?:kN|kip), ([\d.]+) times", remark).groups()
    assert [by_hand, ratio] == checks[1:]
    governs = next(n for n, row in calculated.numbers("tab-peaks").items() if row[3] == "governs")
    assert remark.startswith(f"{governs.lower()} peak of the full model")
    rows = calculated.numbers("tab-members")
    for name in ("shear", "moment"):
        _, static, _, beam, *_ = largest(rows, name)
        value, remark = cells[f"Largest {name}"]
        assert value == max(static, beam, key=number)
        quotient(static, beam, re.search(r"static over beam ([\d.]+)", remark)[1])
    for symbol, (text, unit) in zip(
        ("k_p", "m_p"), re.findall(r"([\d.]+) ([^\s,]+)", cells["Pier frequency"][1]), strict=True
    ):
        found = calculated.values[(symbol,)][0] / mathml.size(unit)
        close(found, text, 1e-4 * found, digits=5)  # itself rounded in another unit
    value, remark = cells["Largest 25 ms average"]
    assert value == calculated.numbers("tab-averages")["Over 25 ms"][0]
    force = calculated.numbers("tab-codes")["AASHTO LRFD"][2]
    ratio, code = re.search(r"([\d.]+) times the ([\d.]+)", remark).groups()
    assert number(code) == number(force)
    quotient(value, force, ratio)


def spreads(calculated):
    """The spread of the parameters, but of a mass that the case gives."""
    given = "total mass of the case" in calculated.page
    return {name: 0.3 for name in QUANTITIES if not (given and name == "body_mass")}


def sampled(calculated):
    """Return the reactions of the printed truck's spread and what is static under them.

    Each an array of the larger of all impacts, by "reaction", "shear" and "moment".
    """
    speed, peak = calculated.values[("V",)][0], headline(calculated)["Design reaction"][0]
    rows = calculated.numbers("tab-members")
    shares = [{kind: number(largest(rows, kind)[1]) / number(peak) for kind in ("shear", "moment")}]
    piers = [calculated.pier]
    if "Largest shear of both" in rows:  # of the other pier no values are printed
        case = case_from(calculated.case | {"truck": "single-unit-8t"})  # it is the column's
        struck = [case.column.struck_at(height) for height in case.impact_heights]
        piers = [own.equivalent(case.inputs.damping_ratio) for own in struck]
        forces = [own.member_forces(1.0) for own in struck]
        length = 1.0 if "kN" in rows["Largest moment of both"][-1] else 0.3048
        shares = [
            {
                "shear": abs(own.largest_shear.value),
                "moment": abs(own.largest_moment.value) / length,
            }
            for own in forces
        ]
    found = [
        reaction_band(calculated.truck, pier, speed, spread=spreads(calculated)).governing
        for pier in piers
    ]
    return {"reaction": np.max(found, axis=0)} | {
        kind: np.max([share[kind] * own for share, own in zip(shares, found, strict=True)], axis=0)
        for kind in ("shear", "moment")
    }


def test_the_band_is_that_of_the_printed_truck(calculated):
    ends = np.quantile(sampled(calculated)["reaction"], (0.05, 0.95))
    for value, text in zip(ends, band_of(calculated), strict=True):
        close_to_model(value, text, force_unit(calculated))
    speed = calculated.values[("V",)][0]
    band = reaction_band(calculated.truck, calculated.pier, speed, spread=spreads(calculated))
    share = re.search(r"([\d.]+) % of the variance", headline(calculated)["Band, 5 to 95 %"][1])[1]
    most = 100.0 * next(iter(band.influence.values()))
    assert number(share) == pytest.approx(most, abs=1.0)


def test_bands_of_member_forces_hold_those_of_the_static_reaction(calculated):
    rows, static = calculated.numbers("tab-members"), sampled(calculated)
    for kind in ("shear", "moment"):
        ends = members_band(calculated, kind)
        least = np.quantile(static[kind], (0.05, 0.95)) / force_unit(calculated)
        for end, of_static in zip(ends, least, strict=True):
            assert number(end) >= of_static * (1.0 - 1e-3)
        _, nominal, _, beam, *_ = largest(rows, kind)
        assert number(ends[0]) < max(number(nominal), number(beam)) < number(ends[1])


def test_the_verdict(calculated):
    said = re.search(r'<p class="verdict ?(\w*)">(.*?)</p>', calculated.page, re.DOTALL)
    words = re.sub("<[^>]+>|\u202f", "", said[2])
    if "tab-utilisation" not in calculated.page:
        assert "gives no resistance" in words
        assert said[1] == ""
        return
    rows = calculated.numbers("tab-utilisation")
    ratios = {name.split(" ")[0].lower(): row[4] for name, row in rows.items() if row[4]}
    upper = {name.split(" ")[0].lower(): row[5] for name, row in rows.items() if row[4]}
    failing = {name: text for name, text in ratios.items() if number(text) > 1.0}
    beyond = {name: text for name, text in upper.items() if number(text) > 1.0}
    mark = "stop" if failing else "caution" if beyond else ""
    assert said[1] == mark
    assert re.match(r"\s*(?:([A-Z]{2,})\. )?", words)[1] == (mark.upper() or None)
    named = [(name, text) for text, name in re.findall(r"([\d.]+) in (shear|moment)", words)]
    if failing:
        assert "does not hold" in words
        assert dict(named) == failing
        return
    assert "holds this truck" in words
    assert ("not every truck" in words) == bool(beyond)
    assert named == [*ratios.items(), *(beyond or upper).items()]


def test_what_does_not_come_about_or_does_not_hold_is_said_first(calculated):
    first = calculated.page[: calculated.page.index('class="contents"')]
    peaks = calculated.numbers("tab-peaks")
    said = {
        (True, True): "",
        (True, False): "The cargo does not reach the pier",
        (False, True): "The engine does not reach the pier before the cargo",
        (False, False): "Neither engine nor cargo reaches the pier",
    }[peaks[before_cargo(calculated)][0] != "none", peaks["Cargo"][0] != "none"]
    assert said in first
    assert ("reach the pier" in first or "reaches the pier" in first) == bool(said)
    ratios = {}
    if "tab-utilisation" in calculated.page:
        rows = calculated.numbers("tab-utilisation")
        ratios = {name.split(" ")[0].lower(): row[4] for name, row in rows.items()}
    exceeded = [(name, text) for name, text in ratios.items() if text and number(text) > 1.0]
    fails = re.search(r"does not hold: utilisation ((?:[\d.]+ in \w+(?: and )?)+)", first)
    said = re.findall(r"([\d.]+) in (\w+)", fails[1]) if fails else []
    assert [(name, text) for text, name in said] == exceeded
    assert "is illustrative" in calculated.page


def test_the_codes_across_the_travel_are_half_of_those_along(calculated):
    for name, row in calculated.numbers("tab-codes").items():
        halved = re.search("JTG|Japan|motorway|country|urban", name) is not None
        assert (row[3] != "—") == halved
        if halved:
            close(0.5 * number(row[2]), row[3], half(row[2], 5), digits=5)


def test_the_words_for_the_figure_of_sensitivity_have_its_ends(calculated):
    words = re.search(r'id="fig-sensitivity">\s*<img alt="([^"]+)"', calculated.page)[1]
    words = re.sub(r"\s+", " ", words.replace("\u202f", ""))
    found = re.findall(r"([\d.]+) (kN|kip) at ([\d.]+) (km/h|mph)", words)
    for share, (force, unit, speed, speed_unit) in zip((0.5, 1.5), found, strict=True):
        at = share * calculated.values[("V",)][0]
        close(at / mathml.size(speed_unit), speed, 1e-4 * at / mathml.size(speed_unit))
        solved = reference.solve(calculated.truck, calculated.pier, at)
        close_to_model(float(np.fmax(solved.engine, solved.cargo)), force, mathml.size(unit))


def unit_size(calculated, label, heading):
    """Return the size of the unit that a column of a table is headed with."""
    head = re.search(rf'id="{label}">.*?</thead>', calculated.page, re.DOTALL)[0]
    return mathml.size(re.search(rf"{heading} \[([^\]]+)\]", head)[1])


# By how much the rounding of the printed inputs, to five figures, moves what the full model gives.
MOVED = 1e-4


def close_to_model(found, text, unit):
    """Check what the full model gives against what is printed of it; NaN is none."""
    if math.isnan(found):
        assert text in ("none", "")
    else:
        close(found / unit, text, MOVED * abs(found) / unit)


def test_the_full_model_from_the_printed_inputs(calculated):
    found, rows = calculated.solution, calculated.numbers("tab-peaks")
    force = unit_size(calculated, "tab-peaks", "Peak reaction")
    time = unit_size(calculated, "tab-peaks", "Peak after")
    met = found.engine_contact_time
    first = "Engine" if met is not None and met <= found.engine_time else "Sheet metal"
    for name, contact, reaction, peak in (
        (first, found.engine_contact_time, found.engine, found.engine_time),
        ("Cargo", found.cargo_contact_time, found.cargo, found.cargo_time),
    ):
        close_to_model(contact, rows[name][0], time)
        close_to_model(reaction, rows[name][1], force)
        close_to_model(peak, rows[name][2], time)
        assert calculated.numbers("tab-check")[name][0] == rows[name][1]
        assert calculated.numbers("tab-check-long")[name][0] == rows[name][1]
    governs = "Cargo" if found.cargo > found.engine else first
    assert rows[governs][3] == "governs"
    assert calculated.numbers("tab-check")["Governing"][0] == rows[governs][1]


def test_the_spectra_are_marked_with_the_printed_peaks(calculated):
    words = re.search(r'id="fig-spectra">\s*<img alt="([^"]+)"', calculated.page)[1]
    rows = calculated.numbers("tab-peaks")
    shown = [rows[name][1] for name in list(rows)[:2] if rows[name][1] != "none"]
    found = re.findall(r"peak of ([\d\u202f.]+)", words)
    assert [text.replace("\u202f", "") for text in found] == shown


def test_the_moving_averages(calculated):
    unit = unit_size(calculated, "tab-averages", "Contact force")
    history = simulate(calculated.truck, calculated.pier, calculated.values[("V",)][0])
    time = np.linspace(0.0, history.time[-1], 200_001)
    force = np.interp(time, history.time, history.contact_force)
    impulse = np.concatenate(([0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(time))))
    rows = calculated.numbers("tab-averages")
    close(force.max() / unit, rows["At one instant"][0], 3e-4 * force.max() / unit)
    for window in (0.010, 0.025):
        shown, start = rows[f"Over {1e3 * window:g} ms"]
        averages = (np.interp(time + window, time, impulse) - impulse) / window
        averages = averages[time <= time[-1] - window]
        close(averages.max() / unit, shown, 3e-4 * averages.max() / unit)
        begin = np.searchsorted(time, 1e-3 * number(start))
        assert averages[begin] == pytest.approx(averages.max(), rel=1e-3)


def test_both_impact_heights(calculated):
    found = re.search(
        rf"the reaction is ([\d\u202f.]+) (kN|kip) at {STATED} and ([\d\u202f.]+) \S+ at {STATED}",
        calculated.page,
    )
    if found is None:
        assert "is given by the case" in calculated.page
        return
    values = {name: calculated.values[(name,)][0] for name in ("H", "E", "ν", "ρ", "V", "ζ")}
    section = (
        CircularSection(diameter=calculated.values[("D",)][0])
        if ("D",) in calculated.values
        else RectangularSection(
            width=calculated.values[("b",)][0], depth=calculated.values[("h",)][0]
        )
    )
    column = PierColumn(
        height=values["H"],
        section=section,
        elastic_modulus=values["E"],
        poisson_ratio=values["ν"],
        density=values["ρ"],
        base=calculated.word("tab-inputs", "Base of the column"),
        top=calculated.word("tab-inputs", "Top of the column"),
    )
    reactions = {}
    groups = found.groups()
    for stated, text, expected in ((groups[2:6], found[1], 1.05), (groups[7:], found[7], 1.35)):
        z = exactly(*stated)
        assert z == pytest.approx(expected)
        pier = column.struck_at(z).equivalent(values["ζ"])
        solved = reference.solve(calculated.truck, pier, values["V"])
        reactions[z] = float(np.fmax(solved.engine, solved.cargo))
        close_to_model(reactions[z], text.replace("\u202f", ""), mathml.size(found[2]))
    assert calculated.values[("z_n",)][0] == pytest.approx(
        max(reactions, key=reactions.get), rel=2e-5
    )


def test_energy_and_momentum_balance(calculated):
    values, speed, whole = calculated.values, calculated.values[("V",)][0], calculated.truck.mass
    rows, momenta = calculated.numbers("tab-energy"), calculated.numbers("tab-momentum")
    size = unit_size(calculated, "tab-energy", "Peak")
    for column in (0, 1):
        close(
            0.5 * whole * speed**2 / size, rows["Sum"][column], 1e-4 * number(rows["Sum"][column])
        )
        parts = [row[column] for name, row in rows.items() if name != "Sum"]
        total = sum(map(number, parts))
        assert total == pytest.approx(number(rows["Sum"][column]), rel=3e-3)
    peak, _ = reaction(calculated)
    strain = 0.5 * peak**2 / values[("k_p",)][0] / size
    close(strain, rows["Deflection of the pier"][0], 3e-4 * strain)
    size = unit_size(calculated, "tab-momentum", "Value")
    assert number(momenta["Sum"][0]) == pytest.approx(whole * speed / size, rel=1e-4)
    text, unit = re.search(
        r"Momentum at the end, after ([\d.\s]+)\s(m?s),", calculated.page
    ).groups()
    text = text.replace("\u202f", "")
    end = {"ms": 1e-3, "s": 1.0}[unit] * (number(text) + half(text) * np.array([-1.0, 0.0, 1.0]))
    history = simulate(calculated.truck, calculated.pier, speed, duration=end[-1])
    for name, mass, velocity in (
        ("Engine", calculated.truck.engine_mass, history.engine_velocity),
        ("Body and cargo", calculated.truck.body_mass, history.body_velocity),
    ):
        low, found, high = mass * np.interp(end, history.time, velocity) / size
        moved = 2e-3 * abs(found) + abs(high - low)
        close(found, momenta[name][0], moved, digits=5)
    parts = [number(row[0]) for name, row in momenta.items() if name != "Sum"]
    assert sum(parts) == pytest.approx(number(momenta["Sum"][0]), rel=1e-4)


def test_the_reactions_at_other_speeds_and_masses(calculated):
    unit = unit_size(calculated, "tab-sensitivity", "Full model")
    speed, mass = calculated.values[("V",)][0], calculated.truck.mass
    for name, (value, procedure, model, *_) in calculated.numbers("tab-sensitivity").items():
        sign = -1.0 if "less" in name else 1.0
        truck, at = calculated.truck, speed
        if name.startswith("Speed"):
            at = speed + sign * SPEED_CHANGES[re.match(r"Speed \w+ \d+ (\S+)", name)[1]]
        if name.startswith("Mass"):
            truck = truck.loaded_to(mass * (1.0 + sign * 0.2))
        if value == "not possible":
            assert at <= 0.0
            continue
        found = reference.solve(truck, calculated.pier, at)
        close_to_model(float(np.fmax(found.engine, found.cargo)), model, unit)
        close_to_model(design_reaction(truck, calculated.pier, at).reaction, procedure, unit)


def test_the_cases_are_of_every_kind():
    """Contacts made and missed, either peak deciding, the check by hand on either side."""
    kinds = set()
    for values in CASES.values():
        if values["truck"] == "on-the-pier.toml":
            continue
        result = calculate(case_from(values))
        history = result.history
        kinds |= {
            ("engine contact", history.engine_contact_time is not None),
            ("cargo contact", history.cargo_contact_time is not None),
            ("governs", result.governs),
            ("method", result.ratio >= 1.0),
            ("ends", (result.case.inputs.base, result.case.inputs.top)),
        }
    assert len(kinds) == 2 + 2 + 3 + 2 + 6
