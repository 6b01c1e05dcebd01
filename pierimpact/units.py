"""Units at the edges: quantities are parsed to SI, and printed in SI or US units."""

import math
import re
import sys
from decimal import Decimal
from fractions import Fraction
from functools import cache, partial
from importlib import import_module
from importlib.util import find_spec
from threading import Lock
from typing import Any, NamedTuple

from pierimpact.checks import InputError, brief, did_you_mean

SYSTEMS = ("SI", "US")

# Every unit is spelt out instead of allowing prefixes: mPa for MPa, or mN for MN, would be an
# error of nine orders of magnitude that no check of dimensions can see. Masses and forces are
# kept apart: lb is a mass, lbf and kip are forces.
_DEFINITIONS = """
    m = [length]; mm = 0.001 m; cm = 0.01 m; km = 1000 m
    inch = 0.0254 m = in; ft = 12 inch; yd = 3 ft; mile = 5280 ft = mi
    kg = [mass]; g = 0.001 kg; t = 1000 kg; lb = 0.45359237 kg
    s = [time]; ms = 0.001 s; minute = 60 s = min; h = 3600 s; day = 24 h; Hz = 1 / s
    N = kg * m / s ** 2; kN = 1000 N; MN = 1e6 N; GN = 1e9 N
    lbf = 9.80665 lb * m / s ** 2; kip = 1000 lbf = k
    rad = [angle]; deg = 0.017453292519943295 rad; vehicle = [vehicle] = veh
    Pa = N / m ** 2; kPa = 1000 Pa; MPa = 1e6 Pa; GPa = 1e9 Pa
    psi = lbf / inch ** 2; ksi = kip / inch ** 2; pcf = lb / ft ** 3; kcf = 1000 pcf
    J = N * m; kJ = 1000 J; MJ = 1e6 J; kph = km / h; mph = mile / h = MPH
"""
# Those of them that a value in US units has.
_OF_US = {
    *("inch", "in", "ft", "yd", "mile", "mi", "mph", "MPH"),
    *("lb", "lbf", "kip", "k", "psi", "ksi", "pcf", "kcf"),
}


class Dimension(NamedTuple):
    """What a quantity must be."""

    si: str  #: SI unit
    words: str  #: in words, for errors
    units: str  #: units to suggest


DIMENSIONS = {
    "length": Dimension("m", "a length", "m, mm, ft, in"),
    "area": Dimension("m^2", "an area", "m^2, mm^2, in^2"),
    "second moment": Dimension("m^4", "a second moment of area", "m^4, cm^4, in^4"),
    "mass": Dimension("kg", "a mass", "kg, t, lb"),
    "force": Dimension("N", "a force", "kN, MN, lbf, kip"),
    "moment": Dimension("N*m", "a moment", "kN*m, MN*m, kip*ft"),
    "flexural rigidity": Dimension("N*m^2", "a flexural rigidity", "MN*m^2, kN*m^2, kip*ft^2"),
    "pressure": Dimension("Pa", "a stress", "MPa, GPa, psi, ksi"),
    "density": Dimension("kg/m^3", "a density", "kg/m^3, lb/ft^3"),
    "speed": Dimension("m/s", "a speed", "km/h, m/s, mph"),
    "stiffness": Dimension("N/m", "a stiffness", "kN/m, MN/m, kip/in"),
    "rotational stiffness": Dimension(
        "N*m/rad", "a rotational stiffness", "kN*m/rad, MN*m/rad, kip*ft/rad"
    ),
    "frequency": Dimension("Hz", "a frequency", "Hz"),
    "time": Dimension("s", "a time", "ms, s"),
    "energy": Dimension("J", "an energy", "kJ, MJ"),
    "acceleration": Dimension("m/s^2", "an acceleration", "m/s^2, ft/s^2"),
    "angle": Dimension("rad", "an angle", "deg, rad"),
    "traffic volume": Dimension("vehicle/s", "a number of vehicles in a time", "vehicles/day"),
    "encroachment rate": Dimension(
        "1/vehicle/m", "a chance per vehicle and length of road", "1/vehicle/m, 1/vehicle/km"
    ),
    "momentum": Dimension("N*s", "a momentum", "kN*s, kg*m/s"),
}

#: What to say of a number with a comma.
DECIMALS = "decimals have a point, thousands no comma"
_LONGEST = 200  # characters of a quantity: this project's choice
#: Pattern of a decimal number without its sign.
DIGITS = r"(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
# Spaces that do not break, which documents have before a unit, are as good as others.
_NUMBER = re.compile(
    rf"\s*([-+]?(?:{DIGITS}|(?:nan|inf)\b))[\s\u00a0\u2009\u202f]*(.*?)\s*", re.ASCII
)
_FACTOR = r"[A-Za-z]+(?:(?:\^|\*\*)?-?[1-9])?"
_EXPRESSION = re.compile(rf"(?:1?\s*/\s*)?{_FACTOR}(?:\s*[*/ ]\s*{_FACTOR}){{0,5}}")
_HYPHEN = re.compile(r"(?<=[A-Za-z])-(?=[A-Za-z])")  # of kip-ft
_MARKS = str.maketrans({"·": "*", "²": "^2", "³": "^3", "⁴": "^4", "⁶": "^6"})
# Feet and inches as on drawings: 24'-6 1/2", 24 ft 6.5 in, 6', 36", 3 1/2 in.
_MIXED = r"(\d+(?:\.\d*)?|\.\d+|(?:\d+[\s-]+)?\d+/\d+)"
_FEET_AND_INCHES = re.compile(
    rf"\s*(-?)\s*(?:{_MIXED}\s*(?:ft\.?|'))?\s*-?\s*(?:{_MIXED}\s*(?:inch|in\.?|\"))?\s*", re.ASCII
)
_INCH = Fraction("0.0254")  # [m]
_ONE_IMPORTS = Lock()
_PRIMES = str.maketrans("′’″”", "''\"\"")


@cache
def _pint() -> Any:
    """Import pint, without Dask, which it would load where that is installed, for nothing here."""
    modules: dict[str, Any] = sys.modules
    with _ONE_IMPORTS:  # cases are read in several threads
        if "pint" in modules or "dask" in modules or find_spec("dask") is None:
            return import_module("pint")
        modules["dask"] = None  # the import of such a name fails
        try:
            pint = import_module("pint")
        finally:
            del modules["dask"]
    # What pint knows of Dask in its place, for others in this process who use the two together.
    facet = import_module("pint.facets.dask")
    vars(facet)["dask_array"] = _Later("dask.array")
    for name in ("compute", "persist", "visualize"):
        vars(facet)[name] = partial(_call, "dask", name)
    return pint


class _Later:
    """A module that is imported when something of it is asked for."""

    def __init__(self, module: str) -> None:
        self._module = module

    def __getattr__(self, name: str) -> object:
        return getattr(import_module(self._module), name)


def _call(module: str, name: str, *arguments: object, **more: object) -> object:
    """Call a function of a module, which is imported then."""
    return getattr(import_module(module), name)(*arguments, **more)


@cache
def _registry() -> Any:
    """Return the unit registry, exact; pint is imported on first use."""
    registry = _pint().UnitRegistry(None, non_int_type=Fraction)
    for definition in re.split(r"[;\n]", _DEFINITIONS):
        if definition.strip():
            registry.define(definition.strip())
    return registry


@cache
def _unit(expression: str) -> tuple[Fraction, dict[str, Fraction]] | None:
    """Return a unit's size in SI units and its dimensions, or None where it is not understood."""
    pint = _pint()
    expression = _HYPHEN.sub("*", expression.translate(_MARKS))
    if not _EXPRESSION.fullmatch(expression):
        return None
    expression = re.sub(r"([A-Za-z])(-?\d)", r"\1^\2", expression)
    expression = re.sub(r"^\s*/", "1/", expression)
    try:
        size = (Fraction(1) * _registry().parse_units(expression)).to_base_units()
    # To pint an undefined unit is an AttributeError and nan a number, which is no fraction.
    except (pint.PintError, AttributeError, ValueError):
        return None
    return Fraction(size.magnitude), dict(size.dimensionality)


def parse(name: str, value: object, dimension: str) -> float:
    """Return a quantity such as "36 in", "4 MN*m" or "24 ft 6 in" in SI units.

    Parameters
    ----------
    name : str
        What the value is for, to be named in errors.
    value : object
        The text: a number and a unit; a length may also be in feet and inches, with fractions.
    dimension : str
        What it must be, one of `DIMENSIONS`.

    Raises
    ------
    InputError
        When the text is not a number with a unit, the unit is unknown or of another dimension,
        or the number is not finite.
    """
    _, words, units = DIMENSIONS[dimension]
    shown = brief(value)
    if isinstance(value, str) and len(value) > _LONGEST:
        value = ""  # whatever it is, it is none, and patterns take long over it
    if isinstance(value, int | float) and not isinstance(value, bool):
        raise InputError(f"{name} must have a unit ({units}), got {shown}")
    if dimension == "length" and isinstance(value, str):
        length = _feet_and_inches(name, value)
        if length is not None:
            return length
    match = _NUMBER.fullmatch(value) if isinstance(value, str) else None
    if match is None:
        raise InputError(f"{name} must be {words}, a number with a unit ({units}), got {shown}")
    magnitude, expression = float(match[1]), match[2]
    if not expression:
        raise InputError(f"{name} must have a unit ({units}), got {shown}")
    unit = _unit(expression)
    if unit is None:
        near = units.split(", ")
        if "klb" in expression:  # thousands, of which lb and lbf are none
            near = [each for each in near if "kip" in each]
        hint = did_you_mean(expression.replace("klb", "kip"), near)
        if re.match(r",\d", expression):
            hint = f": {DECIMALS}"
        elif re.match(r"\d", expression):
            hint = ": a number has no spaces in it"
        elif dimension == "mass" and re.match(r"(short |metric )?ton(s|nes?)?\b", expression):
            hint = ": one of 2000 lb is typed in lb, one of 1000 kg in t"
        raise InputError(f"{name} must be {words} ({units}), got unknown unit in {shown}{hint}")
    size, dimensions = unit
    if dimensions != _dimensions(dimension):
        nouns = [
            DIMENSIONS[other].words for other in DIMENSIONS if dimensions == _dimensions(other)
        ]
        which = f", which is {nouns[0]}" if nouns else ""
        raise InputError(f"{name} must be {words} ({units}), got {shown}{which}")
    if magnitude and math.isfinite(magnitude):  # or exact numbers may have any number of digits
        magnitude = _in_si(Decimal(match[1]), size)
    return _finite(name, magnitude, value)


def in_us_units(text: object) -> bool:
    """Return whether a quantity, as `parse` takes it, is typed in US units."""
    return not _OF_US.isdisjoint(re.findall(r"[A-Za-z]+", str(text)))


def _in_si(number: Decimal | Fraction, size: Fraction) -> float:
    """Return a number of units in SI units, rounded once: 3 ft is 36 in to the last bit."""
    above, below = number.as_integer_ratio()
    try:
        return above * size.numerator / (below * size.denominator)
    except OverflowError:
        return math.inf


def _finite(name: str, result: float, value: object) -> float:
    if not math.isfinite(result):
        raise InputError(f"{name} must be finite, got {brief(value)}")
    return result


def _feet_and_inches(name: str, text: str) -> float | None:
    """Return a length in feet and inches [m]; None where it is a number with a unit, or neither."""
    plain = text.translate(_PRIMES)
    match, marked = _FEET_AND_INCHES.fullmatch(plain), "'" in plain or '"' in plain
    sign, feet, inches = match.groups("") if match else ("", "", "")
    if not (marked or (feet and inches) or (match and re.search(r"/|[a-z]\.", plain))):
        return None
    whole, rest = _mixed(feet or "0"), _mixed(inches or "0")
    one = not (feet and inches)
    written = match and not sign and (one or feet.isdigit())
    if not written or whole is None or rest is None or not (one or rest < 12):
        raise InputError(
            f"{name} must have whole feet and inches below 12, as in 24 ft 6 in or 24'-6 1/2\", "
            f"got {brief(text)}"
        )
    return _finite(name, _in_si(12 * whole + rest, _INCH), text)


def _mixed(text: str) -> Fraction | None:
    """Return a number such as "6.5" or "6 1/2"; None where its fraction is not below 1."""
    *whole, last = re.split(r"[\s-]+", text)
    above, slash, below = last.partition("/")
    if slash and int(above) >= int(below):
        return None
    return sum(map(Fraction, whole), Fraction(last))


@cache
def _dimensions(dimension: str) -> dict[str, Fraction] | None:
    unit = _unit(DIMENSIONS[dimension].si)
    return unit[1] if unit else None


def pattern(dimension: str) -> str:
    """Return a regular expression, as JSON Schema has them, for how a quantity is typed.

    It matches all that `parse` takes, no unit that is none, and no single unit of another
    dimension; of several units it does not see the dimension.

    Parameters
    ----------
    dimension : str
        What the quantity is, one of `DIMENSIONS`.
    """
    definitions = [part.split("=") for part in re.split(r"[;\n]", _DEFINITIONS) if part.strip()]
    names = [name.strip() for first, _, *others in definitions for name in (first, *others)]
    fitting = [name for name in names if (_unit(name) or (0, None))[1] == _dimensions(dimension)]
    some, one = (
        "|".join(name if f"{name}s" in names else f"{name}s?" for name in those)  # ms is no plural
        for those in (names, fitting)
    )
    power = r"(?:(?:\^|\*\*)?-?[1-9]|[²³⁴⁶])"
    factor = rf"(?:{some}){power}?"
    more = rf"(?:(?:\s*[*/· ]\s*|-){factor})"
    units = [rf"(?:{some}){power}", rf"{factor}{more}{{1,5}}", rf"1?\s*/\s*{factor}{more}{{0,5}}"]
    if fitting:
        units.insert(0, one)
    ways = [rf"[-+]?{DIGITS}\s*(?:{'|'.join(units)})"]
    if dimension == "length":
        mixed = _FEET_AND_INCHES.pattern.replace(r"\"", '["″”]').replace("'", "['′’]")
        ways.append(rf"(?=.*\d){mixed}")
    return rf"^\s*(?:{'|'.join(ways)})\s*$"


class Quantity(NamedTuple):
    """How a kind of value is printed.

    A step that later steps build on keeps five significant figures, so that a check by hand from
    the printed values comes out at the four printed of a result.
    """

    si: tuple[str, str]  #: unit as it is parsed and as it is printed
    us: tuple[str, str]
    digits: int  #: significant figures

    def unit(self, system: str) -> tuple[str, str]:
        """Return the unit in a system, as it is parsed and as it is printed."""
        return self.si if system == "SI" else self.us


QUANTITIES = {
    "length": Quantity(("m", "m"), ("ft", "ft"), 5),
    "section length": Quantity(("m", "m"), ("in", "in"), 5),
    "area": Quantity(("m^2", "m²"), ("in^2", "in²"), 5),
    "second moment": Quantity(("m^4", "m⁴"), ("in^4", "in⁴"), 5),
    "first moment": Quantity(("m^3", "m³"), ("in^3", "in³"), 5),
    "shear integral": Quantity(("m^6", "m⁶"), ("in^6", "in⁶"), 5),
    "modulus": Quantity(("GPa", "GPa"), ("ksi", "ksi"), 5),
    "strength": Quantity(("MPa", "MPa"), ("ksi", "ksi"), 5),
    "root strength": Quantity(("MPa", "MPa"), ("psi", "psi"), 5),  # in a code's root of a strength
    "density": Quantity(("kg/m^3", "kg/m³"), ("lb/ft^3", "lb/ft³"), 5),
    "mass": Quantity(("kg", "kg"), ("lb", "lb"), 5),
    "mass per length": Quantity(("kg/m", "kg/m"), ("lb/ft", "lb/ft"), 5),
    "flexural rigidity": Quantity(("MN*m^2", "MN·m²"), ("kip*ft^2", "kip·ft²"), 5),
    "shear rigidity": Quantity(("MN", "MN"), ("kip", "kip"), 5),
    "flexibility": Quantity(("m/MN", "m/MN"), ("ft/kip", "ft/kip"), 5),
    "stiffness": Quantity(("MN/m", "MN/m"), ("kip/ft", "kip/ft"), 5),
    "rotational stiffness": Quantity(("MN*m/rad", "MN·m/rad"), ("kip*ft/rad", "kip·ft/rad"), 5),
    "traffic volume": Quantity(("vehicle/day", "vehicles/day"), ("vehicle/day", "vehicles/day"), 5),
    "encroachment rate": Quantity(
        ("1/vehicle/m", "1/vehicle/m"), ("1/vehicle/mile", "1/vehicle/mile"), 5
    ),
    "mass stiffness": Quantity(("kg/s^2", "kg/s²"), ("lb/s^2", "lb/s²"), 5),
    "damping": Quantity(("kN*s/m", "kN·s/m"), ("kip*s/ft", "kip·s/ft"), 4),
    "frequency": Quantity(("Hz", "Hz"), ("Hz", "Hz"), 4),
    "speed": Quantity(("km/h", "km/h"), ("mph", "mph"), 4),
    "energy": Quantity(("MJ", "MJ"), ("kip*ft", "kip·ft"), 4),
    "force": Quantity(("kN", "kN"), ("kip", "kip"), 4),
    "moment": Quantity(("kN*m", "kN·m"), ("kip*ft", "kip·ft"), 4),
    "time": Quantity(("ms", "ms"), ("ms", "ms"), 4),
    # Units of the design procedure, consistent: force is mass times acceleration in either system.
    "dynamic force": Quantity(("kN", "kN"), ("kip", "kip"), 5),
    "dynamic mass": Quantity(("t", "t"), ("kip*s^2/ft", "kip·s²/ft"), 5),
    "dynamic stiffness": Quantity(("kN/m", "kN/m"), ("kip/ft", "kip/ft"), 5),
    "dynamic damping": Quantity(("kN*s/m", "kN·s/m"), ("kip*s/ft", "kip·s/ft"), 5),
    "dynamic speed": Quantity(("m/s", "m/s"), ("ft/s", "ft/s"), 5),
    "dynamic time": Quantity(("s", "s"), ("s", "s"), 5),
    "acceleration": Quantity(("m/s^2", "m/s²"), ("ft/s^2", "ft/s²"), 5),
    "impulse": Quantity(("kN*s", "kN·s"), ("kip*s", "kip·s"), 5),
    "circular frequency": Quantity(("s^-1", "rad/s"), ("s^-1", "rad/s"), 5),
    "decay rate": Quantity(("s^-1", "1/s"), ("s^-1", "1/s"), 5),
    "angle": Quantity(("", "rad"), ("", "rad"), 5),
    "share": Quantity(("", ""), ("", ""), 5),
    "ordinate": Quantity(("", ""), ("", ""), 4),
    "ratio": Quantity(("", ""), ("", ""), 4),
}

#: Kinds in which the values of a calculation go together, by those of a table.
CONSISTENT = {
    kind: f"dynamic {kind}" for kind in ("force", "mass", "stiffness", "damping", "speed", "time")
}


class Printed(NamedTuple):
    """A value as it is printed."""

    number: str
    unit: str

    def __str__(self) -> str:
        return f"{self.number} {self.unit}" if self.unit else self.number


def unit_size(quantity: str, system: str) -> float:
    """Return how large the unit is that a kind of value is printed in, in SI units."""
    expression, _ = QUANTITIES[quantity].unit(system)
    unit = _unit(expression) if expression else (1, {})
    assert unit is not None
    return float(unit[0])


def unit_of(quantity: str, system: str) -> str:
    """Return the unit as it is printed, such as "kN·m"."""
    return QUANTITIES[quantity].unit(system)[1]


def printed(value: float, quantity: str, system: str, *, given: bool = False) -> Printed:
    """Return a value for print, rounded to the significant figures of its kind.

    Parameters
    ----------
    value : float
        Value in SI units.
    quantity : str
        Its kind, one of `QUANTITIES`.
    system : {"SI", "US"}
        Units to print in.
    given : bool, optional
        Whether it is an input: five figures, which all that follows builds on, or up to seven
        where those are all of it, but no zeros that nobody typed.
    """
    number = value / unit_size(quantity, system)
    digits = QUANTITIES[quantity].digits
    if given:
        digits = next((figures for figures in (5, 6, 7) if _has_only(number, figures)), 5)
    text = rounded(number, digits)
    if given and "." in text and "×" not in text:
        text = text.rstrip("0").rstrip(".")
    return Printed(text, unit_of(quantity, system))


def converted(value: float, quantity: str, system: str) -> Printed | None:
    """Return a given value as it was given, where that was in the other system of units.

    A value counts as given in the system in which four figures are all of it, and in `system` if
    in both; None where it was given in `system`, or in neither. Arguments as in `printed`.
    """
    (other,) = (each for each in SYSTEMS if each != system)
    here, there = (value / unit_size(quantity, each) for each in (system, other))
    if _has_only(here, 4) or not _has_only(there, 4):
        return None
    return printed(value, quantity, other, given=True)


def _has_only(number: float, figures: int) -> bool:
    return math.isclose(number, float(f"{number:.{figures - 1}e}"), rel_tol=1e-9)


def stated(value: float, quantity: str, system: str, digits: int = 3) -> str:
    """Return a given value for a sentence, such as "3.44 ft (1.05 m)" where it was given in metres.

    Arguments as in `printed`; `digits` are the significant figures of one that was converted.
    """
    original = converted(value, quantity, system)
    if original is None:
        return str(printed(value, quantity, system, given=True))
    number = rounded(value / unit_size(quantity, system), digits)
    return f"{Printed(number, unit_of(quantity, system))} ({original})"


def placed(height: float, system: str) -> Printed:
    """Return a place along a column [m]: to four figures if it has no more, or to two decimals."""
    number, unit = printed(height, "length", system, given=True)
    own = height / unit_size("length", system)
    if not _has_only(own, 4):
        number = f"{own:z.2f}".rstrip("0").rstrip(".").replace("-", "−")
    return Printed(number, unit)


def stretch(low: float, high: float, system: str) -> str:
    """Return from where to where a part of a column goes [m], such as "2.5 to 9 m"."""
    return f"{placed(low, system).number} to {placed(high, system)}"


def rounded(value: float, digits: int) -> str:
    """Return a number to `digits` significant figures, as "0.07059", "27 150" or "4.2×10⁻⁵".

    Thousands are parted by a narrow space from five figures on, and powers of ten stand where
    the plain number would carry more than two zeros to be counted.
    """
    if value == 0.0:
        return "0"
    mantissa, _, power = f"{value:.{digits - 1}e}".partition("e")
    exponent = int(power)
    if not -3 <= exponent <= digits + 1:
        return f"{mantissa.replace('-', '−')}×10{str(exponent).translate(_SUPERSCRIPTS)}"
    places = max(digits - 1 - exponent, 0)
    text = f"{float(f'{value:.{digits - 1}e}'):,.{places}f}".replace("-", "−")
    return text.replace(",", "" if exponent < 4 else "\u202f")


def compared(ratio: float, digits: int = 3) -> str:
    """Return a ratio to so many figures, or to as many as show on which side of one it is."""
    return rounded(ratio, telling_figures(ratio, digits))


def telling_figures(ratio: float, digits: int) -> int:
    """Return how many figures show on which side of one a ratio is, `digits` or more."""
    while digits < 17 and ratio != 1.0 and float(f"{ratio:.{digits - 1}e}") == 1.0:
        digits += 1
    return digits


_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
