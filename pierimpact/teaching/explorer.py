"""An explorer: one widget, calculated and drawn in the browser, whose values Python knows."""

import html
import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import anywidget
import traitlets

from pierimpact.checks import InputError
from pierimpact.teaching import browser
from pierimpact.teaching.markup import show, still
from pierimpact.teaching.scenario import FREQUENCIES, REFERENCE, Scenario
from pierimpact.teaching.scenario_files import case_text, truck_text
from pierimpact.teaching.variables import VARIABLES

_WITH_PYTHON = (
    "It calculates here, in the browser. To use it beside Python, install with <code>pip install "
    "'pierimpact[teach]'</code> and run <code>pierimpact teach</code>."
)


@cache
def _script() -> str:
    return browser.script(*browser.WIDGET)


class View(anywidget.AnyWidget):
    """The widget of an explorer."""

    _esm = traitlets.Unicode().tag(sync=True)
    _css = traitlets.Unicode().tag(sync=True)
    setup = traitlets.Dict().tag(sync=True)  #: what never changes
    values = traitlets.Dict().tag(sync=True)  #: of the variables, in SI units
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
    heights : tuple of int
        Of the frame of the still in a narrow, a middling and a wide page [rem].
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
        heights: tuple[int, int, int],
        drawers: Mapping[str, Sequence[str]] | None = None,
        defaults: Scenario | None = None,
        **setup: Any,
    ) -> None:
        self.title, self.heights = title, heights
        self.defaults = defaults or Scenario()
        drawers = {name: list(names) for name, names in (drawers or {}).items()}
        above = setup.get("above", [])
        self.controls = [*above, *controls, *(name for names in drawers.values() for name in names)]
        values = {name: getattr(self.defaults, name) for name in VARIABLES}
        material = Scenario().column.values
        self._setup = {
            "title": title,
            "truck": browser.truck_data(REFERENCE),
            "concrete": {
                "elasticModulus": material["E"],
                "shearModulus": material["kappa"] * material["G"],
                "density": material["rho"],
            },
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

    @property
    def still(self) -> str:
        """The explorer as HTML that needs nothing else, not even a kernel."""
        setup = self._setup | {"values": self._setup["defaults"]}
        return still(_frame(setup, self.title, self.heights))

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
        super().__init__(
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


def _frame(setup: Mapping[str, Any], title: str, heights: tuple[int, int, int]) -> str:
    """Return an explorer as a page in a frame."""
    data = json.dumps(setup).replace("<", "\\u003c")
    start = f"widgetModule.explore(document.getElementById('explorer'), {data});"
    page = (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}'
        "</title><style>:root { color-scheme: light dark; } body { margin: 0; padding: 4px; }"
        f"{browser.stylesheet('explorer')}"
        f'</style></head><body><main id="explorer"></main><script type="module">{_script()}{start}'
        "</script></body></html>"
    )
    narrow, middling, wide = heights
    size = f"--narrow:{narrow}rem;--middling:{middling}rem;--wide:{wide}rem"
    return (
        f'<figure style="margin:0"><iframe title="{html.escape(title)}" sandbox="allow-scripts" '
        f'style="width:100%;border:0;{size}" srcdoc="{html.escape(page)}"></iframe>'
        f"<figcaption>{html.escape(title)}. {_WITH_PYTHON}</figcaption></figure>"
    )
