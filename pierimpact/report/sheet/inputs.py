"""The tables of inputs, with source and status of each value."""

import re
from typing import Any

from pierimpact.files.inputs import PHYSICAL_KEYS, StepInputs
from pierimpact.files.traffic import OF_TRAFFIC
from pierimpact.plots.crush import draw_crush_curves
from pierimpact.report.document.blocks import Block, Notes
from pierimpact.report.document.markup import Inline, Tex
from pierimpact.report.document.numbered import Figure, Table, columns, decimal, wide
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import BY_KEY, NAMES, Symbol
from pierimpact.units import DIGITS


class Inputs(Section):
    """What the calculation starts from.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(file.case)
    >>> sheet.inputs.truck().rows[0]  # mass [kg], force [kN], length [m], stiffnesses [MN/m]
    ['Engine, 1', '700', '150', '0.5', '150', '900']
    """

    def case_table(self) -> Block:
        """Return the inputs of the case, with source and status."""
        return _table(
            "tab-inputs",
            "Inputs of the case.",
            "Input",
            [self._input_row(key) for key in BY_KEY if key in self._keys()] + self._step_rows(),
        )

    def _step_rows(self) -> list[list[Inline]]:
        """Return dimensions and resistances of each step, with the height it begins at."""
        inputs, rows = self.case.inputs, []
        given: Any = self.case.given.get("steps", ())
        for step, typed in zip(inputs.steps, given, strict=True):
            height = self.shown(step.height, "length", given=True)
            for key in _keys_of(step):
                symbol, value = BY_KEY[key], getattr(step, key)
                symbol = symbol._replace(meaning=f"{symbol.meaning}, from {height} upward")
                source = "case file" + self._as_given(symbol, value, typed[key])
                rows.append(self._row(symbol, value, "given", source))
        return rows

    def _as_given(self, symbol: Symbol, value: float | str, typed: object) -> str:
        """Return how a value was given, if the sheet prints it in another unit."""
        if isinstance(value, str) or not isinstance(typed, str):
            return ""
        unit = self.shown(value, symbol.quantity, given=True).unit
        own = re.sub(rf"^\s*[-+]?{DIGITS}", "", typed)
        return "" if _plain(own) == _plain(unit) else f"; given as {typed}"

    def _keys(self) -> list[str]:
        """Return the keys that the sheet rests on, of those that have a value."""
        keys = [key for key in PHYSICAL_KEYS if key not in OF_TRAFFIC]
        given = self.case.inputs
        return [key for key in keys if getattr(given, key) is not None or key == "truck_mass"]

    def _input_row(self, key: str) -> list[Inline]:
        case, symbol = self.case, BY_KEY[key]
        value = getattr(case.inputs, key)
        status, source = "given", case.inputs.sources.get(key, "case file")
        if key in case.inputs.assumed:
            status, source = "assumed", case.inputs.assumed[key]
        elif key not in case.given:
            status, source = "default", "pierimpact"
        if value is None:  # the mass is the truck's own
            value, source = case.truck.mass, f"truck file {case.truck_file.file_name}"
            status = "given"
        if value == "auto":
            value = "both, of the rule"
        if key in ("base", "top"):
            value = case.column.supports[key == "top"].kind
            source += "" if value == case.given[key] else f"; given as {case.given[key]}"
        source += self._as_given(symbol, value, case.given.get(key))
        return self._row(symbol, value, status, source)

    def notes(self) -> Block | None:
        """Return the notes of the case; None where it has none."""
        notes = self.case.inputs.notes
        return Notes(list(notes)) if notes else None

    def truck(self) -> Block:
        """Return the parameters of the truck in short."""
        case, truck = self.case, self.case.truck
        kinds = ("mass", "force", "length", "stiffness", "stiffness")
        symbols = ("m_i", "P_i", "d_i", "k_i", r"k_{\mathrm{u}i}")
        rows: list[list[Inline]] = []
        for name, mass, spring in (
            ("Engine, 1", truck.engine_mass, truck.engine_spring),
            ("Body and cargo, 2", truck.body_mass, truck.body_spring),
        ):
            values = (
                mass,
                spring.plateau_force,
                spring.plateau_length,
                spring.stiffness,
                spring.unloading_stiffness,
            )
            rows.append(
                [
                    name,
                    *(
                        self.number(value, kind, given=True)
                        for value, kind in zip(values, kinds, strict=True)
                    ),
                ]
            )
        friction = self.shown(truck.friction_force, "force", given=True)
        return Table(
            label="tab-springs",
            caption=f"The truck {truck.name}, {case.truck_file.status.words}: "
            f"{case.truck_file.description}. Masses, plateau forces and lengths, steep and "
            f"unloading stiffnesses; friction {friction} on the body from the {truck.friction_on}.",
            columns=columns(
                "Body",
                *(
                    decimal((Tex(symbol), f" [{self.unit(kind)}]"))
                    for symbol, kind in zip(symbols, kinds, strict=True)
                ),
            ),
            rows=rows,
        )

    def crush_curves(self) -> Block:
        """Return the force of either spring over its crush."""
        truck = self.case.truck
        forces = [
            self.shown(spring.plateau_force, "force", given=True)
            for spring in (truck.engine_spring, truck.body_spring)
        ]
        return Figure(
            label="fig-crush",
            caption="Force of engine and body on the pier over crush: a plateau, a steep rise, and "
            "a steeper line of unloading.",
            alt=f"The crush curves have plateaus of {forces[0]} and {forces[1]}.",
            svg=draw_crush_curves(truck, self.system),
        )

    def truck_table(self) -> Block:
        """Return the parameters of the truck, with source and status."""
        case = self.case
        rows = []
        for parameter in case.truck_file.parameters:
            status, source = parameter.status.words, parameter.source
            value = parameter.value
            if parameter.name == "body_mass" and case.inputs.truck_mass is not None:
                value = case.truck.body_mass
                status, source = "from the case", "total mass of the case less the engine’s"
            else:
                source += self._as_given(BY_KEY[parameter.name], value, parameter.given)
            rows.append(self._row(BY_KEY[parameter.name], value, status, source))
        caption = f"Parameters of the truck {case.truck.name}: {case.truck_file.description}."
        return _table("tab-truck", caption, "Parameter", rows)

    def _row(self, symbol: Symbol, value: float | str, status: str, source: str) -> list[Inline]:
        sign = Tex(symbol.latex) if symbol.latex else ""
        if isinstance(value, str):
            return [symbol.heading, sign, value, "", status, source]
        number, unit = self.shown(value, symbol.quantity, given=True)
        return [symbol.heading, sign, number, unit, status, source]

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of truck and case, by name."""
        truck = [parameter.name for parameter in self.case.truck_file.parameters]
        own = [
            *self._keys(),
            *(key for step in self.case.inputs.steps for key in _keys_of(step)),
        ]
        tables = dict.fromkeys(truck, "tab-springs") | dict.fromkeys(own, "tab-inputs")
        return {NAMES[key]: table for key, table in tables.items()}


def _keys_of(step: StepInputs) -> list[str]:
    """Return the keys of a step that have a value, but for its height."""
    keys = [key for key in type(step).model_fields if key != "height"]
    return [key for key in keys if getattr(step, key) is not None]


def _table(label: str, caption: str, heading: str, rows: list[list[Inline]]) -> Block:
    return Table(
        label=label,
        caption=caption,
        columns=columns(heading, "Symbol", decimal("Value"), "Unit", "Status", wide("Source")),
        rows=rows,
    )


def _plain(unit: str) -> str:
    """Return a unit as typed or printed in one spelling, to tell whether it was converted."""
    return re.sub(r"[\s^*·]", "", unit.translate(str.maketrans("²³⁴", "234")))
