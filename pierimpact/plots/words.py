"""Values as figures print them, in the characters that their font has."""

import re

from pierimpact.symbols import SYMBOLS
from pierimpact.units import Printed, converted, printed, rounded, unit_size

_POWER = re.compile("(10)?([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)")
_PLAIN = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def shown(value: float, quantity: str, system: str, *, given: bool = False) -> str:
    """Return a value [SI] with its unit; arguments as in `units.printed`.

    One that was given in the other system of units has three figures, as in sentences.
    """
    number, unit = printed(value, quantity, system, given=given)
    if given and converted(value, quantity, system) is not None:
        number = rounded(value / unit_size(quantity, system), 3)
    text = str(Printed(number, unit)).replace("\u202f", " ")
    return _POWER.sub(lambda power: f"${power[1] or ''}^{{{power[2].translate(_PLAIN)}}}$", text)


def named(name: str, value: float, system: str) -> str:
    """Return a value [SI] with the symbol of its name before it, as a drawing shows it."""
    symbol = SYMBOLS[name]
    return f"${symbol.latex}$ = {shown(value, symbol.quantity, system, given=True)}"
