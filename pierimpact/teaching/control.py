"""A control of an explorer: a slider with a box to type in, or a list of choices."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import ipywidgets as ipw

from pierimpact.checks import InputError
from pierimpact.teaching.markup import symbol
from pierimpact.teaching.variables import Variable


class Control:
    """One variable's slider with a box to type in, or its list of choices.

    The box takes any unit of the right dimension. Its value counts, even beyond the slider's ends.

    Parameters
    ----------
    variable : Variable
        The variable that it sets.
    value : float or str
        Its value to begin with, in SI units.
    changed : callable
        Called after every change.
    """

    def __init__(self, variable: Variable, value: float | str, changed: Callable[[], None]) -> None:
        self.variable = variable
        self._value: float | str | InputError = value
        self._changed = changed
        self._busy = False
        name = ipw.HTML(
            f'<span style="font-size:12.5px">{variable.symbol.heading} '
            f"{symbol(variable.symbol.latex)}</span>",
            layout=ipw.Layout(height="22px", margin="0"),
        )
        if variable.choices:
            width = ipw.Layout(width="110px")
            self.choice = ipw.Dropdown(options=variable.choices, value=value, layout=width)
            self.choice.observe(self._chosen, "value")
            name.layout.width = "150px"
            self.widget: ipw.Widget = ipw.HBox([name, self.choice])
            return
        slider, low, high = ipw.FloatSlider, variable.low, variable.high
        if variable.log:
            slider, low, high = ipw.FloatLogSlider, math.log10(low), math.log10(high)
        wide = ipw.Layout(flex="1 1 auto", width="auto")
        shown = float(value) / variable.size
        self.slider = slider(
            value=shown, min=low, max=high, step=variable.step, readout=False, layout=wide
        )
        narrow, words = ipw.Layout(width="96px"), variable.shown(float(value))
        self.box = ipw.Text(value=words, continuous_update=False, layout=narrow)
        self.slider.observe(self._slid, "value")
        self.box.observe(self._typed, "value")
        row = ipw.HBox([self.slider, self.box])
        self.widget = ipw.VBox([name, row], layout=ipw.Layout(margin="0 0 2px 0"))

    @property
    def value(self) -> float | str:
        """The value in SI units, or the choice.

        Raises
        ------
        InputError
            When the text typed is not a value of this kind.
        """
        if isinstance(self._value, InputError):
            raise self._value
        return self._value

    def set(self, value: float | str) -> None:
        """Set the value, and show it."""
        self._value = value
        self._busy = True
        try:
            self._show(value)
        finally:
            self._busy = False
        self._changed()

    def _chosen(self, change: Mapping[str, Any]) -> None:
        if not self._busy:
            self.set(change["new"])

    def _slid(self, change: Mapping[str, Any]) -> None:
        if not self._busy and not self._snapped(change["new"]):
            self.set(change["new"] * self.variable.size)

    def _snapped(self, shown: float) -> bool:
        """Return whether a slider only moved to its nearest step, which JupyterLab makes it do."""
        if isinstance(self._value, InputError):
            return False
        value, step = float(self._value) / self.variable.size, 0.5001 * self.variable.step
        if self.variable.log:
            return abs(math.log10(shown / value)) < step
        return abs(shown - value) < step

    def _typed(self, change: Mapping[str, Any]) -> None:
        if self._busy:
            return
        try:
            self.set(self.variable.parsed(change["new"]))
        except InputError as error:
            self._value = error
            self._changed()

    def _show(self, value: float | str) -> None:
        variable = self.variable
        if variable.choices:
            self.choice.value = value
            return
        self.box.value = variable.shown(float(value))
        shown = min(max(float(value) / variable.size, variable.low), variable.high)
        # A slider that snaps to its step would otherwise overwrite the value typed.
        if abs(self.slider.value - shown) > 1e-9 * abs(shown):
            self.slider.value = shown
