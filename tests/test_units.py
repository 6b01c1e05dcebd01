import math
import re
import subprocess
import sys
from decimal import Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pierimpact.checks import InputError
from pierimpact.units import (
    DIMENSIONS,
    QUANTITIES,
    SYSTEMS,
    compared,
    converted,
    parse,
    pattern,
    placed,
    printed,
    rounded,
    stated,
    unit_of,
    unit_size,
)

# The international inch and pound, standard gravity, and what follows from them.
INCH, POUND, GRAVITY = 0.0254, 0.45359237, 9.80665
POUND_FORCE = POUND * GRAVITY


@pytest.mark.parametrize(
    ("text", "dimension", "expected"),
    [
        ("36 in", "length", 36 * INCH),
        ("16.5ft", "length", 16.5 * 12 * INCH),
        ("-1.5e2 mm", "length", -0.15),
        ("80 km/h", "speed", 80 / 3.6),
        ("55 mph", "speed", 55 * 5280 * 12 * INCH / 3600),
        ("8 t", "mass", 8000.0),
        ("36000 lb", "mass", 36000 * POUND),
        ("600 kip", "force", 600e3 * POUND_FORCE),
        ("600e3 lbf", "force", 600e3 * POUND_FORCE),
        ("2.5 MN", "force", 2.5e6),
        ("4 MN*m", "moment", 4e6),
        ("4 MN·m", "moment", 4e6),
        ("4 kip ft", "moment", 4e3 * POUND_FORCE * 12 * INCH),
        ("4 ksi", "pressure", 4e3 * POUND_FORCE / INCH**2),
        ("150 lb/ft^3", "density", 150 * POUND / (12 * INCH) ** 3),
        ("2400 kg/m3", "density", 2400.0),
        ("2400 kg m^-3", "density", 2400.0),
        ("150 MN/m", "stiffness", 150e6),
    ],
)
def test_parse(text, dimension, expected):
    assert parse("value", text, dimension) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "inches"),
    [
        ("24 ft 6 in", 294),
        ("24ft6in", 294),
        ("24 ft. 6 in.", 294),
        ("24'-6\"", 294),
        ("24' - 6\"", 294),
        ("24' 6\"", 294),
        ("24'6\"", 294),
        ("24′-6″", 294),
        ("24’-6”", 294),
        ("24'-6 1/2\"", 294.5),
        ("24'-6-1/2\"", 294.5),
        ("24' 1/2\"", 288.5),
        ("24 ft 6.5 in", 294.5),
        ("24 ft 0 in", 288),
        ("0'-11 15/16\"", 11.9375),
        ("6'", 72),
        ("6.5'", 78),
        ("6 1/2'", 78),
        ('36"', 36),
        ("36 in.", 36),
        ("3 1/2 in", 3.5),
        ("3-1/2 in", 3.5),
        ("1/2 in", 0.5),
        (".5 in", 0.5),
        (" 24 ft  6 in ", 294),
        ("24 ft 6 inch", 294),
    ],
)
def test_feet_and_inches(text, inches):
    assert parse("value", text, "length") == pytest.approx(inches * INCH, rel=1e-15)


SIXTEENTHS = [f"{n // g}/{16 // g}" for n in range(1, 16) for g in [math.gcd(n, 16)]]


@given(
    st.integers(0, 10_000),
    st.integers(0, 11),
    st.none() | st.sampled_from(SIXTEENTHS),
    st.sampled_from([("'", '"'), ("′", "″"), (" ft", " in"), ("ft", "in"), ("’", "”")]),
    st.sampled_from(["-", " ", " - ", " -"]),
    st.sampled_from([" ", "-"]),
)
def test_feet_and_inches_as_written_parse_back(feet, inches, fraction, marks, between, dash):
    text = f"{feet}{marks[0]}{between}{inches}" + (dash + fraction if fraction else "") + marks[1]
    above, _, below = (fraction or "0/1").partition("/")
    expected = (12 * feet + inches + int(above) / int(below)) * INCH
    assert parse("value", text, "length") == pytest.approx(expected, rel=1e-15)


@given(st.floats(0.0, 1e6), st.floats(0.0, 11.9), st.integers(0, 1000))
def test_decimal_inches_parse_back(number, inches, feet):
    assert parse("value", f'{number:.6f}"', "length") == pytest.approx(number * INCH, abs=1e-6)
    found = parse("value", f"{feet} ft {inches:.9f} in", "length")
    assert found == pytest.approx((12 * feet + inches) * INCH, abs=1e-9)


@given(st.integers(0, 10_000), st.integers(0, 11), st.integers(0, 99), st.integers(0, 4))
def test_the_same_in_other_words_is_the_same_to_the_last_bit(feet, inches, hundredths, places):
    total, metres = 12 * feet + inches, Decimal(inches + 12 * hundredths).scaleb(-places)
    for words, others in (
        (f"{total}.{hundredths:02} in", f"{feet} ft {inches}.{hundredths:02} in"),
        (f"{3 * feet} ft", f"{feet} yd"),
        (f"{36 * feet} in", f"{3 * feet} ft"),
        (f"{metres:f} m", f"{1000 * metres:f} mm"),
    ):
        assert parse("value", words, "length") == parse("value", others, "length")
    assert parse("value", f"{metres:f} m", "length") == float(metres)


@pytest.mark.parametrize(
    "text",
    [
        *("24 ft 12 in", "24 ft 13 in", "24'-12\"", "24'-11 16/16\"", "24.5 ft 6 in"),
        *("-24'-6\"", "-24 ft 6 in", "-6'", '-36"', "-3 1/2 in", "24'--6\"", "24' -6 1/2' "),
        *("24 1/2' 6\"", "3 2/1 in", "3 1/0 in", "0/0 in", "6\"-24'", "24'6", "24'6 ft"),
        *('"', "6'6'", '6"6"', "'", "24' 6 m", "24 m 6\"", "it's"),
    ],
)  # fmt: skip
def test_nonsense_in_feet_and_inches(text):
    rule = "value must have whole feet and inches below 12, as in 24 ft 6 in or 24'-6 1/2\", got "
    with pytest.raises(InputError, match=re.escape(rule)) as caught:
        parse("value", text, "length")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "text", ["24 ft 6 m", "24 m 6 in", "24 ft 6", "6 in 24 ft", "1/2 m", "3.5 1/2 in"]
)
def test_other_mixtures_of_units(text):
    with pytest.raises(InputError, match="value must be a length") as caught:
        parse("value", text, "length")
    assert "\n" not in str(caught.value)


def test_feet_and_inches_are_a_length():
    for text in ("24 ft 6 in", "24'-6\""):
        with pytest.raises(InputError, match="must be a mass"):
            parse("value", text, "mass")


# Every unit in SI units, by what it measures.
SIZES = {
    "length": {
        "m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3, "in": INCH, "inch": INCH, "ft": 12 * INCH,
        "yd": 36 * INCH, "mi": 63360 * INCH, "mile": 63360 * INCH,
    },
    "mass": {"kg": 1.0, "g": 1e-3, "t": 1e3, "lb": POUND},
    "time": {"s": 1.0, "ms": 1e-3, "min": 60.0, "minute": 60.0, "h": 3600.0, "day": 86400.0},
    "angle": {"rad": 1.0, "deg": math.pi / 180},
    "traffic volume": {"vehicle/s": 1.0, "vehicles/day": 1 / 86400, "veh/h": 1 / 3600},
    "encroachment rate": {"1/vehicle/m": 1.0, "/vehicle/km": 1e-3},
    "frequency": {"Hz": 1.0},
    "force": {
        "N": 1.0, "kN": 1e3, "MN": 1e6, "GN": 1e9, "lbf": POUND_FORCE, "kip": 1e3 * POUND_FORCE,
    },
    "pressure": {
        "Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "psi": POUND_FORCE / INCH**2,
        "ksi": 1e3 * POUND_FORCE / INCH**2,
    },
    "energy": {"J": 1.0, "kJ": 1e3, "MJ": 1e6},
    "speed": {"kph": 1 / 3.6, "mph": 63360 * INCH / 3600},
    "rotational stiffness": {"N*m/rad": 1.0, "kip*ft/rad": 12e3 * POUND_FORCE * INCH},
}  # fmt: skip


def test_every_unit_has_its_size():
    for dimension, sizes in SIZES.items():
        for unit, size in sizes.items():
            assert parse("value", f"1 {unit}", dimension) == pytest.approx(size, rel=1e-14), unit
    known = {word for sizes in SIZES.values() for unit in sizes for word in unit_words(unit)}
    suggested = {unit for dimension in DIMENSIONS.values() for unit in dimension.units.split(", ")}
    assert {word for unit in suggested for word in unit_words(unit)} <= known


def unit_words(unit):
    """The units that a unit is made of."""
    return re.findall("[A-Za-z]+", unit)


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("quantity", QUANTITIES)
def test_the_printed_unit_is_the_one_divided_by(quantity, system):
    unit = unit_of(quantity, system)
    size = 1.0
    for power, word in re.findall(r"([·/]?)([A-Za-z]+[²³⁴⁶]?)", unit.replace("rad/s", "1/s")):
        name, exponent = word.rstrip("²³⁴⁶"), {"²": 2, "³": 3, "⁴": 4, "⁶": 6}.get(word[-1], 1)
        if name not in ("rad", "vehicle", "vehicles"):
            (factor,) = {sizes[name] for sizes in SIZES.values() if name in sizes}
            size *= factor ** (-exponent if power == "/" else exponent)
    assert unit_size(quantity, system) == pytest.approx(size, rel=1e-14)


def test_results_have_four_figures_and_what_they_rest_on_five():
    four = {"damping", "frequency", "speed", "energy", "force", "moment", "time"}
    four |= {"ordinate", "ratio"}
    assert {name for name, kind in QUANTITIES.items() if kind.digits == 4} == four
    assert {kind.digits for kind in QUANTITIES.values()} == {4, 5}


@pytest.mark.parametrize(
    ("value", "dimension", "message"),
    [
        (36, "length", "value must have a unit (m, mm, ft, in), got 36"),
        ("36", "length", "value must have a unit (m, mm, ft, in), got '36'"),
        (True, "length", "value must be a length, a number with a unit"),
        ("abc", "length", "value must be a length, a number with a unit"),
        ("5 inn", "length", "got unknown unit in '5 inn'; did you mean in?"),
        ("25 mPa", "pressure", "got unknown unit in '25 mPa'; did you mean MPa?"),
        ("25 gpa", "pressure", "did you mean GPa?"),
        ("12,5 m", "length", "unknown unit in '12,5 m'"),
        ("2 400 kg/m^3", "density", "in '2 400 kg/m^3': a number has no spaces in it"),
        ("2\u202f400 kg/m^3", "density", ": a number has no spaces in it"),
        ("1800 klb", "force", "got unknown unit in '1800 klb'; did you mean kip?"),
        ("3 klb/in", "stiffness", "got unknown unit in '3 klb/in'; did you mean kip/in?"),
        ("80 kip", "mass", "value must be a mass (kg, t, lb), got '80 kip', which is a force"),
        (
            "80 lb",
            "force",
            "value must be a force (kN, MN, lbf, kip), got '80 lb', which is",
        ),
        ("80 km", "speed", "got '80 km', which is a length"),
        ("80 nan", "speed", "value must be a speed (km/h, m/s, mph), got unknown unit in '80 nan'"),
        ("5 m/NaN", "speed", "got unknown unit in '5 m/NaN'"),
        ("5 km/h*nan^2", "speed", "got unknown unit in '5 km/h*nan^2'"),
        ("5 m^9*m^9", "length", "value must be a length"),
        ("5 m**999999999", "length", "unknown unit"),
        ("5 m^", "length", "unknown unit"),
        ("nan m", "length", "value must be finite, got 'nan m'"),
        ("-inf m", "length", "value must be finite"),
        ("1e999 m", "length", "value must be finite"),
        ("1e307 km", "length", "value must be finite"),
    ],
)
def test_what_does_not_parse(value, dimension, message):
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        parse("value", value, dimension)
    assert "\n" not in str(caught.value)


@given(
    st.text()
    | st.from_regex(r"[0-9.e+-]{1,5} ?[a-zA-Z*/^0-9 ()-]{1,12}", fullmatch=True)
    | st.from_regex(r"[0-9./ ft'\"in-]{1,16}", fullmatch=True)
)
def test_any_text_is_a_number_or_a_line(text):
    for dimension in DIMENSIONS:
        message = "value is fine"
        try:
            assert math.isfinite(parse("value", text, dimension))
        except InputError as error:
            message = str(error)
        assert message.startswith("value ")
        assert len(message.splitlines()) == 1


@given(
    st.floats(min_value=1e-12, max_value=1e15) | st.floats(min_value=-1e15, max_value=-1e-12),
    st.integers(min_value=2, max_value=6),
)
def test_rounding_keeps_the_significant_figures(value, digits):
    text = rounded(value, digits)
    mantissa, _, power = text.partition("×10")
    figures = mantissa.replace("\u202f", "").replace("−", "-")
    superscripts = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    back = float(figures) * 10.0 ** int(power.translate(superscripts) or 0)
    assert back == pytest.approx(value, rel=0.5000001 * 10.0 ** (1 - digits))
    # As many figures as asked for, but for zeros before a point that is not printed.
    counted = figures.lstrip("-0.").replace(".", "")
    assert len(counted) == digits or ("." not in figures and len(counted) > digits)


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (2702453.0, 4, "2.702×10⁶"),
        (2702453.0, 5, "2\u202f702\u202f500"),
        (27149.6, 4, "27\u202f150"),
        (9999.6, 4, "10\u202f000"),
        (2702.453, 4, "2702"),
        (0.0705949, 4, "0.07059"),
        (-1.25, 3, "−1.25"),
        (4.2e-5, 2, "4.2×10⁻⁵"),
        (0.0, 4, "0"),
        (0.00123, 3, "0.00123"),
        (0.000123, 3, "1.23×10⁻⁴"),
    ],
)
def test_rounded(value, digits, text):
    assert rounded(value, digits) == text


@pytest.mark.parametrize(
    ("value", "quantity", "system", "words"),
    [
        (1.05, "length", "SI", "1.05 m"),
        (1.05, "length", "US", "3.44 ft (1.05 m)"),
        (5 * 12 * INCH, "length", "US", "5 ft"),
        (5 * 12 * INCH, "length", "SI", "1.524 m"),  # four figures are all of it in metres too
        (16.458 * 12 * INCH, "length", "US", "16.458 ft"),  # round in neither
        (600e3 * POUND_FORCE, "force", "US", "600 kip"),
        (600e3 * POUND_FORCE, "force", "SI", "2670 kN (600 kip)"),
        (1000e3, "force", "US", "225 kip (1000 kN)"),
        (36_000 * POUND, "mass", "SI", "16\u202f300 kg (36\u202f000 lb)"),
        (0.05, "ratio", "US", "0.05"),
    ],
)
def test_a_given_value_in_a_sentence(value, quantity, system, words):
    assert stated(value, quantity, system) == words


@pytest.mark.parametrize(
    ("height", "system", "words"),
    [
        (1.35, "SI", "1.35 m"),
        (1.35, "US", "4.43 ft"),
        (8 * 12 * INCH, "US", "8 ft"),
        (0.728871, "SI", "0.73 m"),
        (-0.728871, "SI", "−0.73 m"),
        (12.3004, "SI", "12.3 m"),
        (0.0012345, "SI", "0 m"),
        (-0.0012345, "SI", "0 m"),
    ],
)
def test_a_place_along_a_column(height, system, words):
    assert str(placed(height, system)) == words


@given(st.integers(1, 9999), st.integers(-2, 3), st.sampled_from(SYSTEMS))
def test_what_is_given_in_one_system_is_printed_in_it(digits, power, system):
    (other,) = set(SYSTEMS) - {system}
    value = digits * 10.0**power * unit_size("force", system)
    own = printed(value, "force", system, given=True)
    assert converted(value, "force", system) is None
    assert stated(value, "force", system) == str(own)
    original = converted(value, "force", other)
    assert original in (own, None)
    if original is None:  # by chance round in the other as well
        there = value / unit_size("force", other)
        assert there == pytest.approx(float(f"{there:.3e}"), rel=2e-9)


@given(st.integers(1, 9_999_999), st.integers(0, 3), st.sampled_from(SYSTEMS))
def test_given_values_print_as_typed(digits, places, system):
    typed = f"{digits / 10**places:.{places}f}"
    unit = unit_of("mass", system)
    shown = printed(parse("value", f"{typed} {unit}", "mass"), "mass", system, given=True)
    assert float(shown.number.replace("\u202f", "")) == float(typed)


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("dimension", sorted(DIMENSIONS.keys() & QUANTITIES.keys()))
def test_what_is_printed_parses_back(dimension, system):
    value = 1234.5678
    shown = printed(value, dimension, system)
    digits = QUANTITIES[dimension].digits
    text = (
        str(shown)
        .replace("\u202f", "")
        .replace("×10⁶", "e6")
        .replace("×10⁷", "e7")
        .replace("×10⁸", "e8")
        .replace("×10⁹", "e9")
    )
    assert parse("value", text, dimension) == pytest.approx(value, rel=0.6 * 10 ** (1 - digits))


def test_mass_and_force_are_kept_apart():
    assert printed(POUND, "mass", "US").unit == "lb"
    assert printed(1e3 * POUND_FORCE, "force", "US") == ("1.000", "kip")
    assert printed(1e3 * POUND_FORCE, "force", "US", given=True) == ("1", "kip")


@given(st.one_of(st.floats(0.3, 3.0), st.floats(-1e-6, 1e-6).map(lambda x: 1.0 + x)))
def test_a_compared_ratio_shows_on_which_side_of_one_it_is(ratio):
    shown = float(compared(ratio))
    assert shown == pytest.approx(ratio, rel=5.1e-3)
    # The fifteen figures that any number can be printed to and read again.
    if abs(ratio - 1.0) > 1e-14:
        assert (shown > 1.0, shown < 1.0) == (ratio > 1.0, ratio < 1.0)
    if abs(ratio - 1.0) > 0.01:
        assert compared(ratio) == rounded(ratio, 3)


@pytest.mark.parametrize(
    ("ratio", "text"), [(1.0, "1.00"), (1.003, "1.003"), (0.99996, "0.99996"), (1.45, "1.45")]
)
def test_compared(ratio, text):
    assert compared(ratio) == text


@pytest.mark.parametrize("space", ["", " ", "\u00a0", "\u2009", "\u202f"])
def test_any_space_may_stand_before_a_unit(space):
    assert parse("speed", f"80{space}km/h", "speed") == parse("speed", "80 km/h", "speed")
    assert re.search(pattern("speed"), f"80{space}km/h")


def test_a_thousand_pounds_are_no_pounds():
    with pytest.raises(InputError, match=r"got unknown unit in '18 klb'$"):
        parse("truck_mass", "18 klb", "mass")


FIRST_IN_THREADS = """
import threading
from concurrent.futures import ThreadPoolExecutor
from pierimpact.units import parse
start = threading.Barrier(8)
def first(number):
    start.wait()
    return parse("height", f"{number} ft", "length")
with ThreadPoolExecutor(8) as executor:
    print(sum(executor.map(first, range(8))))
"""


@pytest.mark.parametrize("attempt", range(5))
def test_threads_may_parse_their_first_quantities_at_once(attempt):
    command = [sys.executable, "-c", FIRST_IN_THREADS]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.stderr, float(done.stdout)) == ("", pytest.approx(28 * 0.3048))
