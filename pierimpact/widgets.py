"""The explorers of the teaching notebooks: `widgets.collision()` and its siblings."""

from collections.abc import Mapping

import ipywidgets as ipw

from pierimpact.teaching import theory_views, views
from pierimpact.teaching.animation import FRAMES, Animation
from pierimpact.teaching.explorer import Explorer, Views
from pierimpact.teaching.scenario import Scenario
from pierimpact.teaching.variables import CRUSH

_COLUMN = ["column_diameter", "column_height", "base", "top", "damping_ratio"]
# The pier of the notebooks on reduction and spectra: between soft and stiff.
_EXAMPLE = Scenario(pier_mass=8e3, pier_frequency=30.0)
_MOMENTS = (
    ("First touch", lambda history: 0.0),
    ("Engine contact", lambda history: history.engine_contact_time),
    ("Engine peak", lambda history: history.engine_peak.time),
    ("Cargo contact", lambda history: history.cargo_contact_time),
    ("Cargo peak", lambda history: history.cargo_peak and history.cargo_peak.time),
)


class CollisionExplorer(Explorer):
    """The moving picture of a collision, with its forces and energy, and the spectra if wanted.

    Parameters
    ----------
    controls, hidden : list of str
        Names of the variables on show and in the drawer.
    spectra : bool
        Whether the spectra stand beside the forces.
    title : str
        What a still is called.
    defaults : Scenario, optional
        Values to begin with.
    """

    def __init__(
        self,
        *,
        controls: list[str],
        hidden: list[str] | None = None,
        spectra: bool,
        title: str,
        defaults: Scenario | None = None,
    ) -> None:
        self._spectra = spectra
        last = FRAMES - 1
        self.frame = ipw.IntSlider(
            max=last, readout=False, layout=ipw.Layout(flex="1 1 200px", min_width="120px")
        )
        self.play = ipw.Play(max=last, interval=50, show_repeat=False)
        ipw.jslink((self.play, "value"), (self.frame, "value"))
        self._cursor = ipw.HTML()
        super().__init__(
            controls=controls,
            hidden=hidden,
            draw=self._views,
            layout=self._arranged,
            title=title,
            still=self._as_still,
            defaults=defaults,
        )
        self.frame.observe(lambda _: self._show_frame(), "value")
        self.show(self.strike.history.engine_peak.time)
        self.play.value = self.frame.value  # or a page could start from either

    def _views(self, scenario: Scenario) -> Views:
        strike = scenario.strike
        panels = views.TimePanels(strike, beside=not self._spectra)
        shown = {
            "readout": views.readout(strike),
            "time": panels.svg(),
        }
        if self._spectra:
            shown["spectra"] = views.spectra_figure(strike)
        # Nothing of the old collision is replaced before all of the new one is there.
        self.strike, self._panels, self.animation = strike, panels, Animation(strike)
        shown["picture"] = self.animation.svg(self.frame.value)
        self._cursor.value = panels.cursor(self.time)
        return shown

    @property
    def time(self) -> float:
        """The instant that the picture shows [s]."""
        return float(self.animation.times[self.frame.value])

    def show(self, time: float) -> None:
        """Show the instant nearest to a time after first touch [s]."""
        self.frame.value = self.animation.index(time)

    def _show_frame(self) -> None:
        self.views["picture"].value = self.animation.svg(self.frame.value)
        self._cursor.value = self._panels.cursor(self.time)

    def _arranged(self, shown: Mapping[str, ipw.HTML]) -> ipw.Widget:
        wide = {"flex": "1 1 290px", "min_width": "260px"}
        for layer in (shown["time"], self._cursor):
            layer.layout.grid_area = "1 / 1 / 2 / 2"
        charts = [
            ipw.GridBox(
                [shown["time"], self._cursor],
                layout=ipw.Layout(grid_template_columns="100%", **wide),
            )
        ]
        if self._spectra:
            shown["spectra"].layout = ipw.Layout(**wide)
            charts.append(shown["spectra"])
        moments = []
        for words, when in _MOMENTS:
            button = ipw.Button(description=words, layout=ipw.Layout(width="auto"))
            button.on_click(lambda _, when=when: self._jump(when(self.strike.history)))
            moments.append(button)
        flow = {"display": "flex", "flex_flow": "row wrap"}
        return ipw.VBox(
            [
                shown["picture"],
                ipw.HBox([self.play, self.frame]),
                ipw.Box(moments, layout=ipw.Layout(**flow)),
                shown["readout"],
                ipw.Box(charts, layout=ipw.Layout(**flow)),
            ]
        )

    def _jump(self, time: float | None) -> None:
        if time is not None:
            self.show(time)

    def _as_still(self, scenario: Scenario, shown: Views) -> str:
        history = self.strike.history
        peaks = [peak for peak in (history.engine_peak, history.cargo_peak) if peak is not None]
        frames = [self.animation.svg(self.animation.index(peak.time)) for peak in peaks]
        pictures = "".join(f'<div style="flex:1 1 300px">{frame}</div>' for frame in frames)
        charts = "".join(
            f'<div style="flex:1 1 340px">{shown[name]}</div>'
            for name in ("time", "spectra")
            if name in shown
        )
        return (
            f'{pictures}{shown["readout"]}<div style="display:flex;flex-wrap:wrap">{charts}</div>'
        )


def collision() -> Explorer:
    """Explore one collision: what happens when, and what the two spikes are."""
    return CollisionExplorer(
        controls=["speed", "truck_mass", *_COLUMN],
        spectra=False,
        title="A collision in slow motion, with its forces and its energy",
    )


def full() -> Explorer:
    """Explore everything at once: collision, forces, energy and spectra."""
    return CollisionExplorer(
        controls=["speed", "truck_mass", *_COLUMN, "impact_height"],
        hidden=list(CRUSH),
        spectra=True,
        title="A collision, its forces and energy, and its place on the spectra",
    )


def spectra() -> Explorer:
    """Explore how both peaks depend on the pier's frequency, set directly."""
    return CollisionExplorer(
        controls=["pier_frequency", "pier_mass", "damping_ratio", "speed", "truck_mass"],
        spectra=True,
        title="A collision and its place on the spectra of engine and cargo",
        defaults=_EXAMPLE,
    )


def pier() -> Explorer:
    """Explore how a column becomes a mass on a spring, Eqs 1–3."""
    return Explorer(
        controls=["impact_height", "column_diameter", "column_height", "base", "top"],
        draw=lambda scenario: {
            "readout": theory_views.shape_readout(scenario),
            "shape": theory_views.shape_figure(scenario),
        },
        layout=_stacked,
        title="The shape function, and the pier’s stiffness and mass against the impact height",
    )


def reduction() -> Explorer:
    """Explore the reduction to two degrees of freedom: the amplification of either body."""
    return Explorer(
        controls=["pier_frequency", "pier_mass", "damping_ratio", "speed", "truck_mass"],
        draw=lambda scenario: {
            "readout": theory_views.amplification_readout(scenario.strike),
            "amplification": theory_views.amplification_figure(scenario.strike),
        },
        layout=_stacked,
        title="The amplification of engine and cargo against the frequency ratio",
        defaults=_EXAMPLE,
    )


def design() -> Explorer:
    """Explore the design reaction beside the full model and what codes say."""
    return Explorer(
        controls=["speed", "truck_mass", *_COLUMN, "impact_height"],
        draw=lambda scenario: {
            "readout": theory_views.design_readout(scenario.strike),
            "design": theory_views.design_figure(scenario.strike),
        },
        layout=_stacked,
        title="Design reaction, full model and code forces",
    )


def sensitivity() -> Explorer:
    """Explore which of the truck's parameters matter."""
    return Explorer(
        controls=["speed", "truck_mass", *_COLUMN],
        draw=lambda scenario: {
            "readout": views.readout(scenario.strike),
            "sensitivity": theory_views.sensitivity_figure(scenario.strike),
        },
        layout=_stacked,
        title="Sensitivity of either peak to the parameters of the truck",
    )


def _stacked(shown: Mapping[str, ipw.HTML]) -> ipw.Widget:
    return ipw.VBox(list(shown.values()))
