"""An explorer: one widget, drawn in the browser, whose values Python knows; and its still."""

import html
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import anywidget
import traitlets

from pierimpact.checks import InputError
from pierimpact.teaching import browser
from pierimpact.teaching.markup import show, still
from pierimpact.teaching.readouts import Readout
from pierimpact.teaching.scenario import FREQUENCIES, REFERENCE, Scenario
from pierimpact.teaching.scenario_files import case_text, truck_text
from pierimpact.teaching.variables import VARIABLES

_HOW_TO_GET_LIVE = (
    "For the live explorer, install with <code>pip install 'pierimpact[teach]'</code> and run "
    "<code>pierimpact teach</code>."
)
# The variables that a column takes the place of, and those of a column.
_PIER = ("pier_frequency", "pier_mass")
_COLUMN = ("column_diameter", "column_height", "impact_height", "base", "top")

#: A chart as `templates/page/figures.mjs` draws it.
Chart = dict[str, Any]


@cache
def _script() -> str:
    return browser.script(*browser.WIDGET)


class View(anywidget.AnyWidget):
    """The widget of an explorer."""

    _esm = traitlets.Unicode().tag(sync=True)
    _css = traitlets.Unicode().tag(sync=True)
    setup = traitlets.Dict().tag(sync=True)  #: what never changes
    values = traitlets.Dict().tag(sync=True)  #: of the variables, in SI units
    contents = traitlets.Dict().tag(sync=True)  #: what is calculated in Python
    copied: Any = traitlets.List().tag(sync=True)  #: names and contents of files to copy

    @traitlets.default("_esm")
    def _default_esm(self) -> str:
        return f"{_script()}export default {{ render: widgetModule.render }};\n"

    @traitlets.default("_css")
    def _default_css(self) -> str:
        return browser.stylesheet("explorer")


class Explorer:
    """An explorer, calculated and drawn in the browser: it needs Python only to know its values.

    Parameters
    ----------
    title : str
        Caption of the still.
    controls : list of str
        Names of the variables on show beside the charts, of `pierimpact.teaching.variables`.
    drawers : mapping of str to sequence of str, optional
        Names of more of them, by the titles of the drawers below.
    defaults : Scenario, optional
        Values to begin with.
    **setup
        What else the browser has to know: see the modules.
    """

    def __init__(
        self,
        *,
        title: str,
        controls: Sequence[str],
        drawers: Mapping[str, Sequence[str]] | None = None,
        defaults: Scenario | None = None,
        **setup: Any,
    ) -> None:
        self.title = title
        self.defaults = defaults or Scenario()
        drawers = {name: list(names) for name, names in (drawers or {}).items()}
        above = setup.get("above", [])
        self.controls = [*above, *controls, *(name for names in drawers.values() for name in names)]
        values = {name: getattr(self.defaults, name) for name in VARIABLES}
        self._setup = {
            "title": title,
            "variables": browser.variables_data(self.controls),
            "side": list(controls),
            "drawers": drawers,
            "defaults": values,
            **setup,
        }
        self.widget = View(setup=self._setup, values=values)

    def scenario(self) -> Scenario:
        """Return the scenario of the controls.

        Raises
        ------
        InputError
            When the value of one is not valid, by the first property that rests on it.
        """
        return replace(self.defaults, **self.widget.values)

    def set(self, **values: float | str | None) -> None:
        """Set values by name, in SI units."""
        self.widget.values = {**self.widget.values, **values}

    def reset(self) -> None:
        """Go back to the defaults."""
        self.set(**self._setup["defaults"])

    @property
    def still(self) -> str:
        """The explorer at its default values, as HTML that needs nothing else."""
        setup = self._setup | {"values": self._setup["defaults"]}
        return still(_frame(setup, self.title, ""))

    def _ipython_display_(self) -> None:
        show(self.widget, self.still, self.title)


class CollisionExplorer(Explorer):
    """The explorer of one collision, with its place on the spectra if wanted.

    Parameters
    ----------
    spectra, energy : bool
        Whether the spectra stand above, and the energy below.
    **options
        As for an `Explorer`.
    """

    def __init__(self, *, spectra: bool, energy: bool, **options: Any) -> None:
        material = Scenario().column.values
        super().__init__(
            truck=browser.truck_data(REFERENCE),
            concrete={
                "elasticModulus": material["E"],
                "shearModulus": material["kappa"] * material["G"],
                "density": material["rho"],
            },
            range={"low": FREQUENCIES[0], "high": FREQUENCIES[1]},
            spectra=spectra,
            energy=energy,
            facts=True,
            **({"above": []} | options),
        )
        self.widget.on_msg(lambda *_: self.copy())
        self.widget.observe(self._forget, "values")

    def copy(self) -> None:
        """Show the values as a case file, and where needed as a truck file."""
        try:
            scenario = self.scenario()
            if scenario.struck_column is None:
                raise InputError("a case file needs a column: move one of its sliders first")
            files = [["my-case.yaml", case_text(scenario, "my-truck.toml")]]
            truck = truck_text(scenario)
        except InputError as error:
            self.widget.copied = [["", f"{error}."]]
            return
        self.widget.copied = [*files, *([["my-truck.toml", truck]] if truck else [])]

    def _forget(self, _: object) -> None:
        self.widget.copied = []


class ChartExplorer(Explorer):
    """An explorer whose charts are calculated in Python.

    Parameters
    ----------
    draw : callable
        From a scenario to its readout and its charts. An `InputError` that it raises is shown as a
        sentence.
    **options
        As for an `Explorer`.
    """

    def __init__(
        self, *, draw: Callable[[Scenario], tuple[Readout, list[Chart]]], **options: Any
    ) -> None:
        super().__init__(contents=True, **options)
        self._draw = draw
        self.redraw()
        self._first = self.widget.contents
        self.widget.observe(lambda _: self.redraw(), "values")

    def redraw(self) -> None:
        """Calculate what is shown at the present values, or say why that cannot be done."""
        refusal = "The model has no result for these values. Change one of them."
        try:
            readout, charts = self._draw(self.scenario())
        except InputError as error:
            self.widget.contents = {"refusal": f"{error}."}
        except (ArithmeticError, ValueError, RuntimeError):
            # A student must not see a traceback, whatever values break the model.
            self.widget.contents = {"refusal": refusal}
        else:
            self.widget.contents = {
                "charts": charts,
                "readout": readout.html,
                "words": readout.words,
                "refusal": "",
            }

    @property
    def still(self) -> str:
        """The charts at the default values, as HTML that needs nothing else."""
        values = {"values": self._setup["defaults"], "contents": self._first}
        return still(_frame(self._setup | values, self.title, self._first["words"]))


def _frame(setup: Mapping[str, Any], title: str, words: str) -> str:
    """Return an explorer as a page in a frame: live where it needs no kernel."""
    data = json.dumps(setup).replace("<", "\\u003c")
    start = f"widgetModule.still(document.getElementById('explorer'), {data});"
    page = (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}'
        f"</title><style>body {{ margin: 0; padding: 4px; }}{browser.stylesheet('explorer')}"
        f'</style></head><body><main id="explorer"></main><script type="module">{_script()}{start}'
        "</script></body></html>"
    )
    return (
        f'<figure style="margin:0"><iframe title="{html.escape(title)}" sandbox="allow-scripts" '
        f'style="width:100%;height:46rem;border:0" srcdoc="{html.escape(page)}"></iframe>'
        f"<figcaption>{html.escape(title)}. {html.escape(words)} {_HOW_TO_GET_LIVE}</figcaption>"
        "</figure>"
    )
