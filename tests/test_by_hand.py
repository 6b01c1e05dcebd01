"""The sheet calculated again from what is printed in it, read off the page of executed reports.

What the full model gives cannot be repeated by hand, and is taken as printed.
"""

import re
from pathlib import Path
from xml.etree import ElementTree

import mathml
import pytest
import yaml

from pierimpact.report import write_report

EXAMPLE = Path(__file__).parent.parent / "notebooks" / "tti-column.yaml"
US_CASE = {
    "column_shape": "rectangular",
    "column_width": "4 ft",
    "column_depth": "36 in",
    "column_height": "16.5 ft",
    "concrete_strength": "4 ksi",
    "density": "150 lb/ft^3",
    "base": "fixed",
    "top": "fixed",
    "truck": "single-unit-8t",
    "truck_mass": "36000 lb",
    "speed": "55 mph",
    "impact_height": "auto",
    "damping_ratio": 0.03,
    "units": "US",
    "shear_resistance": "3000 kip",
    "moment_resistance": "2500 kip*ft",
}
SLOW_CASE = US_CASE | {  # neither engine nor cargo reaches the pier
    "column_width": "0.9 m",
    "column_depth": "0.7 m",
    "base": "pinned",
    "top": "pinned",
    "speed": "20 km/h",
    "impact_height": "1.1 m",
    "units": "SI",
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


@pytest.fixture(scope="module", params=["si", "us", "slow"])
def sheet(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param)
    case = folder / "case.yaml"
    cases = {"us": US_CASE, "slow": SLOW_CASE}
    if request.param == "si":
        case.write_text(EXAMPLE.read_text("utf-8"), encoding="utf-8")
    else:
        case.write_text(yaml.safe_dump(cases[request.param]), encoding="utf-8")
    page = write_report(case, folder).html.read_text("utf-8")
    result = Sheet(page)
    for label in ("tab-inputs", "tab-truck"):
        for row in result.rows(label):
            symbol = symbol_of(row[1])
            if symbol and number_like(plain(row[2])):
                result.learn(symbol, plain(row[2]), plain(row[3]))
    return result


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
    found = re.search(r"</math> = ([\d.]+) (ft|m)(?: is given|\.)", sheet.page)
    sheet.learn(["z_n"], found[1], found[2])
    values, checked = sheet.values, 0
    for label, sides in sheet.steps():
        if label == "eq-omega":
            check_starting_values(sheet)
        if label.startswith("eq-shape") or label == "eq-design-reaction":
            continue
        symbol, result = tuple(sides[0]), sides[-1]
        shown, rounding = mathml.evaluate(result, {})
        for side in sides[1:-1]:
            if not numeric(side):
                sheet.formulas[label] = symbol, side
                # The modulus holds in MPa only; the integrals follow from the polynomials.
                if label in ("eq-E", "eq-phi2"):
                    continue
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
        values[symbol] = shown, rounding
        if label == "eq-G":  # the only value without a place of its own
            kappa = re.search(r"κ = (0\.9|5/6) of", sheet.page)[1]
            values[("κ",)] = {"0.9": 0.9, "5/6": 5.0 / 6.0}[kappa], 0.0
    assert checked > 60
    return sheet


def check_starting_values(sheet):
    """Check the table of starting values against inputs and steps, and take them from it."""
    for row in sheet.rows("tab-given"):
        symbol = tuple(symbol_of(row[1]))
        before, rounding = sheet.values[symbol]
        sheet.learn(symbol, plain(row[2]), plain(row[3]))
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
        sides[1][: sides[1].index("unit:with")]
        for label, sides in calculated.steps()
        if label.startswith("eq-shape")
    )
    height, impact = calculated.values[("H",)][0], calculated.values[("z_n",)][0]
    unit = re.search(r'id="tab-shape">.*?\[(m|ft)\]', calculated.page, re.DOTALL)[1]

    def shape(z):
        words, s = (below, z / height) if z < impact else (above, (height - z) / height)
        return mathml.evaluate(words, {("s",): (s, 0.0)})

    for z, phi, square in ([plain(cell) for cell in row] for row in calculated.rows("tab-shape")):
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


def reactions(calculated):
    """Return the design reaction, as printed and in SI units."""
    sides = dict(calculated.steps())["eq-design-reaction"]
    return mathml.evaluate(sides[-1], {}), mathml.evaluate(sides[-2], {})


def test_the_design_reaction_is_the_larger_of_the_two(calculated):
    shown, put_in = reactions(calculated)
    assert shown[0] == pytest.approx(put_in[0], rel=1e-12)
    checks = calculated.numbers("tab-check")
    unit = force_unit(calculated)
    model, procedure = checks["Governing"][:2]
    assert shown[0] == pytest.approx(max(number(model), number(procedure)) * unit, rel=1e-12)
    found = [calculated.values.get((symbol,), (0.0, 0.0))[0] for symbol in ("R_1", "R_2")]
    close(found[0] / unit, checks["Engine"][1], 0.1)
    close(max(found) / unit, procedure, 0.1)
    for name, (exact, closed, of_closed, by_hand, of_hand) in checks.items():
        if "none" not in (exact, closed):
            close(number(closed) / number(exact), of_closed, 2e-4, digits=3)
        if "none" not in (exact, by_hand):
            close(number(by_hand) / number(exact), of_hand, 2e-4, digits=3)
        assert name


def force_unit(calculated):
    return mathml.size(re.search(r"Full model \[(kN|kip)\]", calculated.page)[1])


def test_the_hand_level(calculated):
    values = dict(calculated.values)
    for row in calculated.rows("tab-hand"):
        sides = mathml.rows(ElementTree.tostring(row[1].find(f".//{mathml.NAMESPACE}math")))
        found, moved = mathml.evaluate(sides[1], values)
        symbol = tuple(sides[0])
        sheet = Sheet("")
        sheet.learn(symbol, plain(row[2]), plain(row[3]))
        values[symbol] = sheet.values[symbol]
        shown, rounding = values[symbol]
        assert abs(found - shown) <= 1.01 * (moved + rounding), symbol


def test_member_forces_and_utilisations(calculated):
    (reaction, rounding), _ = reactions(calculated)
    names = {
        "Force on the base": "R_b",
        "Force on the top": "R_t",
        "Moment at the base": "M_b",
        "Moment at the impact": "M_n",
        "Moment at the top": "M_t",
    }
    rows = calculated.numbers("tab-members")
    for name, symbol in names.items():
        share, half_of_share = calculated.values[(symbol,)]
        _, shown, unit = rows[name]
        moved = abs(reaction) * half_of_share + abs(share) * rounding
        close(reaction * share / mathml.size(unit), shown, moved / mathml.size(unit))
    forces = [abs(number(rows[name][1])) for name in list(names)[:2]]
    moments = [abs(number(rows[name][1])) for name in list(names)[2:]]
    assert number(rows["Largest shear"][1]) == max(forces)
    assert number(rows["Largest moment"][1]) == max(moments)
    for name, (demand, resistance, _, ratio, verdict) in calculated.numbers(
        "tab-utilisation"
    ).items():
        assert demand == rows[f"Largest {name.lower()}"][1]
        if resistance == "not given":
            assert (ratio, verdict) == ("", "not checked")
            continue
        close(number(demand) / number(resistance), ratio, 2e-4 * number(ratio), digits=3)
        assert verdict == f"{'within' if number(ratio) <= 1.0 else 'exceeds'} " + "the resistance"


def test_codes_at_their_own_height(calculated):
    """The sheet's own equations, with the height of the clause for that of this calculation."""
    steps = ("eq-freed", "eq-own", "eq-Rt", "eq-Mt", "eq-Rb", "eq-Mb", "eq-Mn")
    caption = re.search(r'id="tab-codes">(.*?)<tbody>', calculated.page, re.DOTALL)[1]
    units = [mathml.size(unit) for unit in re.findall(r"\[([^\]]+)\]</th>", caption)]
    force_size, length, _, moment_size = units
    rows = calculated.numbers("tab-codes")
    assert len(rows) > 8
    for name, (force, height, shear, moment, _) in rows.items():
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
        assert name


def test_the_hard_impact_force(calculated):
    """F = v √(k m) with the 300 kN/m that the note names."""
    rows = calculated.numbers("tab-codes")
    force = rows["EN 1991-1-7, hard impact, Annex C"][0]
    speed, mass = calculated.values[("V",)][0], calculated.values[("m_1", "+", "m_2")][0]
    close(speed * (300e3 * mass) ** 0.5 / force_unit(calculated), force, 0.1)


def test_sensitivities(calculated):
    rows = calculated.numbers("tab-sensitivity")
    assert len(rows) == 5
    _, *base = rows["This case"]
    largest = max(number(base[0]), number(base[1]))
    for name, (value, procedure, model, ratio, over) in rows.items():
        close(number(procedure) / number(model), ratio, 2e-4, digits=3)
        close(max(number(procedure), number(model)) / largest, over, 4e-4, digits=3)
        if name.startswith("Speed"):
            assert value.split()[1] in ("km/h", "mph")
            changed = number(value.split()[0]) * mathml.size(value.split()[1])
            sign = -1.0 if "less" in name else 1.0
            difference = changed - calculated.values[("V",)][0]
            assert difference == pytest.approx(sign * 10.0 / 3.6, abs=2e-3)
        if name.startswith("Mass"):
            number_, unit = value.replace("\u202f", "").split()
            share = number(number_) * mathml.size(unit) / calculated.values[("m_1", "+", "m_2")][0]
            assert share == pytest.approx(0.8 if "less" in name else 1.2, rel=1e-4)


def test_the_headline_repeats_what_is_calculated(calculated):
    cells = dict(
        re.findall(r'<dt>([^<]+)</dt><dd><span class="value">([^<]*)<small>', calculated.page)
    )
    (reaction, _), _ = reactions(calculated)
    unit = force_unit(calculated)
    assert number(cells["Design reaction"].replace("\u202f", "")) * unit == pytest.approx(reaction)
    checks = calculated.numbers("tab-check")["Governing"]
    assert [cells["Full model"], cells["Design procedure"]] == checks[:2]
    rows = calculated.numbers("tab-utilisation")
    for name in ("shear", "moment"):
        ratio = rows[name.capitalize()][3]
        if ratio:
            assert cells[f"Utilisation in {name}"] == ratio
