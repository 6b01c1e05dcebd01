"""An explorer: controls with units, views that follow them, and a still for print."""

import asyncio
import html
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import ipywidgets as ipw

from pierimpact.checks import InputError
from pierimpact.teaching.control import Control
from pierimpact.teaching.live import LiveFigure, LiveWords
from pierimpact.teaching.markup import GROUND, INK, MUTED, refusal, show, still
from pierimpact.teaching.readouts import Readout
from pierimpact.teaching.scenario import Scenario
from pierimpact.teaching.scenario_files import case_text, truck_text
from pierimpact.teaching.variables import VARIABLES

#: Pause before a redraw, in which the values of a drag that have already arrived are taken in [s].
PAUSE = 0.01

#: Size of a figure that takes half the room beside the controls [px].
HALF = (440.0, 236.0)

_HOW_TO_GET_LIVE = (
    "This is a still picture. For the live explorer, install with "
    "<code>pip install 'pierimpact[teach]'</code> and run <code>pierimpact teach</code>."
)

Views = Mapping[str, LiveFigure | LiveWords]
#: The readout of a scenario, and the contents of the other views by name.
Shown = tuple[Readout, Mapping[str, tuple[Any, ...]]]


class Explorer:
    """Controls on the left, views on the right that follow them.

    Parameters
    ----------
    title : str
        Caption of the still.
    controls, hidden : list of str
        Names of the variables on show and in a drawer below, of `pierimpact.teaching.variables`.
    figures : dict of str to LiveFigure or LiveWords
        The views beside the readout, by name.
    draw : callable
        From a scenario to its readout and the contents of these views, by name. An `InputError`
        that it raises is shown as a sentence in place of the views.
    defaults : Scenario, optional
        Values to begin with.
    """

    def __init__(
        self,
        *,
        title: str,
        controls: list[str],
        hidden: Sequence[str] = (),
        figures: Views,
        draw: Callable[[Scenario], Shown],
        defaults: Scenario | None = None,
    ) -> None:
        self.title = title
        self.defaults = defaults or Scenario()
        self.views: Views = {"readout": LiveWords(), **figures}
        self.redraws = 0
        self._draw = draw
        self._waiting = False
        self._copied = ipw.HTML()
        self.controls = {
            name: Control(VARIABLES[name], getattr(self.defaults, name), self._set)
            for name in (*controls, *hidden)
        }
        self.message = ipw.HTML()
        self._body = self._arranged()
        self.widget = self._assemble(controls, hidden)
        self.redraw()
        self._still = self._stills(self._words)

    def scenario(self) -> Scenario:
        """Return the scenario of the controls.

        Raises
        ------
        InputError
            When the value of one is not valid.
        """
        values: dict[str, Any] = {name: control.value for name, control in self.controls.items()}
        return replace(self.defaults, **values)

    def set(self, **values: float | str) -> None:
        """Set values by name, in SI units, and redraw."""
        self._waiting = True  # one redraw for all of them
        for name, value in values.items():
            self.controls[name].set(value)
        self.redraw()

    def reset(self, *_: Any) -> None:
        """Go back to the defaults."""
        self.set(**{name: getattr(self.defaults, name) for name in self.controls})

    def redraw(self) -> None:
        """Draw all views at the present values, or show why that cannot be done."""
        self._waiting = False
        self.redraws += 1
        try:
            readout, contents = self._draw(self.scenario())
            self._words = readout.words
            for name, content in {"readout": (readout.html,), **contents}.items():
                self.views[name].show(*content)
        except InputError as error:
            self._refuse(f"{error}.")
        except (ArithmeticError, ValueError, RuntimeError):
            # A student must not see a traceback, whatever values break the model.
            self._refuse("The model has no result for these values. Change one of them.")
        else:
            self.message.value = ""
            self._body.layout.display = None

    def _refuse(self, why: str) -> None:
        self.message.value = refusal(why)
        self._body.layout.display = "none"

    def _set(self) -> None:
        """Follow a control."""
        self._copied.value = ""
        self._redraw_soon()

    def _redraw_soon(self) -> None:
        """Redraw; changes that arrive meanwhile are drawn by the same redraw."""
        if self._waiting:
            return
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:  # outside a kernel
            self.redraw()
            return
        self._waiting = True
        loop.call_later(PAUSE, self.redraw)

    def copy(self, *_: Any) -> None:
        """Show the values as a case file, and where needed as a truck file."""
        try:
            scenario = self.scenario()
            truck = truck_text(scenario)
            parts = [("my-case.yaml", case_text(scenario, "my-truck.toml"))]
        except InputError as error:
            self._copied.value = refusal(f"{error}.")
            return
        if truck:
            parts.append(("my-truck.toml", truck))
        self._copied.value = "".join(
            f'<div style="font-size:12px;color:{MUTED}">One click selects; copy into '
            f"<code>{name}</code></div>"
            f'<pre style="user-select:all;color:{INK};background:{GROUND};padding:8px;'
            f'font-size:11px;line-height:1.35;overflow:auto;max-height:220px">{html.escape(content)}</pre>'
            for name, content in parts
        )

    def _assemble(self, controls: Sequence[str], hidden: Sequence[str]) -> ipw.Widget:
        rows = [self.controls[name].widget for name in controls]
        if hidden:
            drawer = ipw.VBox([self.controls[name].widget for name in hidden])
            rows.append(ipw.Accordion([drawer], titles=("The truck’s crush laws",)))
        buttons = [_button("Reset", "undo", "92px", self.reset)]
        if "column_diameter" in self.controls:
            buttons.append(_button("Copy as case file", "copy", "160px", self.copy))
        rows += [ipw.HBox(buttons), self._copied]
        left = ipw.VBox(rows, layout=ipw.Layout(flex="1 1 250px", max_width="300px"))
        right = ipw.Layout(flex="4 1 560px", min_width="0")
        return side_by_side([left, ipw.VBox([self.message, self._body], layout=right)], "20px")

    def _arranged(self) -> ipw.Widget:
        """Return the views in the order of their names, as many side by side as there is room."""
        return side_by_side([view.widget for view in self.views.values()])

    def _stills(self, words: str) -> str:
        """Return the views as HTML that needs nothing else."""
        return "".join(view.still(words) for view in self.views.values())

    @property
    def still(self) -> str:
        """The views at the default values, as HTML that needs nothing else."""
        return still(
            '<figure style="margin:0;max-width:900px"><div '
            f'style="display:flex;flex-wrap:wrap;gap:4px 8px">{self._still}</div>'
            f"<figcaption>{html.escape(self.title)}. {_HOW_TO_GET_LIVE}</figcaption></figure>"
        )

    def _ipython_display_(self) -> None:
        show(self.widget, self.still, self.title)


def side_by_side(widgets: list[ipw.Widget], gap: str = "8px") -> ipw.Widget:
    """Return widgets in rows, as many in each as there is room for."""
    layout = ipw.Layout(display="flex", flex_flow="row wrap", grid_gap=f"4px {gap}")
    return ipw.Box(widgets, layout=layout)


def _button(words: str, icon: str, width: str, pressed: Callable[..., None]) -> ipw.Button:
    button = ipw.Button(description=words, icon=icon, layout=ipw.Layout(width=width))
    button.on_click(pressed)
    return button
