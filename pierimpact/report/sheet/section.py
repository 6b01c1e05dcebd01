"""What the parts of a sheet have in common."""

from dataclasses import dataclass

from pierimpact.files.case import Case
from pierimpact.report.calculation import Calculation
from pierimpact.units import Printed, placed, printed, stated, stretch, unit_of


@dataclass(frozen=True)
class Section:
    """A part of the sheet: its methods return the blocks below one heading.

    Parameters
    ----------
    calculation : Calculation
        The calculation of the case.
    """

    calculation: Calculation

    @property
    def case(self) -> Case:
        """The case that is calculated."""
        return self.calculation.case

    @property
    def system(self) -> str:
        """The units that the sheet prints in: "SI" or "US"."""
        return self.case.inputs.units

    def symbols(self) -> dict[str, str]:
        """Return the anchors of what introduces symbols, by the names of the symbols."""
        return {}

    def stretch(self, low: float, high: float) -> str:
        """Return from where to where a part of the column goes."""
        return stretch(low, high, self.system)

    def shown(self, value: float, quantity: str, *, given: bool = False) -> Printed:
        """Return a value as the sheet prints it; arguments as in `units.printed`."""
        return printed(value, quantity, self.system, given=given)

    def stated(self, value: float, quantity: str, digits: int = 3) -> str:
        """Return a given value in the units that it was given in as well; as `units.stated`."""
        return stated(value, quantity, self.system, digits)

    def placed(self, height: float) -> Printed:
        """Return a place along the column as the sheet prints it; as `units.placed`."""
        return placed(height, self.system)

    def number(self, value: float | None, quantity: str, *, given: bool = False) -> str:
        """Return a value without its unit, "none" where there is none."""
        return "none" if value is None else self.shown(value, quantity, given=given).number

    def unit(self, quantity: str) -> str:
        """Return the unit that a kind of quantity prints in."""
        return unit_of(quantity, self.system)
