"""The explorer of one collision: its moving picture, forces, energy and place on the spectra."""

from collections.abc import Callable
from typing import Any

import ipywidgets as ipw

from pierimpact.collision.history import CollisionHistory
from pierimpact.plots import collision, schematic, spectrum
from pierimpact.plots.style import BODIES
from pierimpact.teaching import readouts
from pierimpact.teaching.animation import FRAMES, Animation
from pierimpact.teaching.explorer import HALF, Explorer, Shown, side_by_side
from pierimpact.teaching.live import LiveFigure, LiveWords
from pierimpact.teaching.scenario import Scenario

_MOMENTS: dict[str, Callable[[CollisionHistory], Any]] = {
    "First touch": lambda history: 0.0,
    "Engine contact": lambda history: history.engine_contact_time,
    "Engine peak": lambda history: history.engine_peak.time,
    "Cargo contact": lambda history: history.cargo_contact_time,
    "Cargo peak": lambda history: history.cargo_peak and history.cargo_peak.time,
}
# Name, size and layers of the figures that are always there.
_FIGURES: dict[str, tuple[Any, ...]] = {
    "picture": (
        "The collision",
        schematic.SIZE,
        schematic.picture,
        schematic.draw_scene,
        schematic.draw_frame,
    ),
    "forces": (
        "Forces against time",
        HALF,
        collision.forces_panel,
        collision.draw_forces,
        collision.draw_instant,
    ),
    "energy": (
        "Energy against time",
        HALF,
        collision.energy_panel,
        collision.draw_energy,
        collision.draw_instant,
    ),
}


class CollisionExplorer(Explorer):
    """The moving picture of a collision, with its forces and energy, and the spectra if wanted.

    Parameters
    ----------
    spectra : bool
        Whether the spectra stand beside the forces.
    **options
        As for an `Explorer`: title, controls, hidden and defaults.
    """

    def __init__(self, *, spectra: bool, **options: Any) -> None:
        last = FRAMES - 1
        slider = ipw.Layout(flex="1 1 200px", min_width="120px")
        self.frame = ipw.IntSlider(max=last, readout=False, layout=slider)
        self.play = ipw.Play(max=last, interval=50, show_repeat=False)
        ipw.jslink((self.play, "value"), (self.frame, "value"))
        self._moments = {
            words: ipw.Button(description=words, layout=ipw.Layout(width="auto"))
            for words in _MOMENTS
        }
        self._scenario: Scenario | None = None
        self._charts = ("forces", "engine", "energy", "cargo") if spectra else ("forces", "energy")
        figures: dict[str, Any] = {name: LiveFigure(*parts) for name, parts in _FIGURES.items()}
        for body in BODIES if spectra else ():
            layers = spectrum.spectrum_panel, spectrum.draw_spectrum, spectrum.draw_place
            name = f"{body.capitalize()} peak against pier frequency"
            figures[body] = LiveFigure(name, HALF, *layers, body=body)
        super().__init__(figures={"instant": LiveWords()} | figures, draw=self._contents, **options)
        self.play.value = self.frame.value  # or a page could start from either
        self.frame.observe(lambda _: self._redraw_soon(), "value")

    def _contents(self, scenario: Scenario) -> Shown:
        if scenario != self._scenario:
            # Nothing of the old collision is replaced before all of the new one is there.
            self.animation = Animation(scenario)
            self._scenario = scenario
            for words, when in _MOMENTS.items():
                self._moments[words].disabled = when(scenario.history) is None
            name = readouts.first_peak_name(scenario.history)
            self._moments[readouts.ENGINE_PEAK].description = name
        # The one drawn first of those that are equal: its history is known.
        scenario = self.animation.scenario
        frame, history = self.animation.frame(self.frame.value), scenario.history
        contents: dict[str, tuple[Any, ...]] = {
            "instant": (readouts.instant(frame, self.animation.phase(frame)),),
            "picture": ((self.animation.scene,), (self.animation.scene, frame)),
            "forces": ((history,), (frame.time, frame.reaction)),
            "energy": ((history,), (frame.time,)),
        }
        for body, peak in scenario.history.peaks.items() if "engine" in self.views else ():
            curves = scenario.curves
            lines = curves.frequency, curves.full[body], curves.reduced[body]
            contents[body] = lines, (*lines, scenario.pier.frequency, peak and peak.reaction)
        return readouts.collision(scenario), contents

    @property
    def time(self) -> float:
        """The instant that the picture shows [s]."""
        return float(self.animation.times[self.frame.value])

    def show(self, time: float) -> None:
        """Show the instant nearest to a time after first touch [s]."""
        self.frame.value = self.animation.index(time)

    def _arranged(self) -> ipw.Widget:
        for words, when in _MOMENTS.items():
            self._moments[words].on_click(
                lambda _, when=when: self.show(when(self.animation.scenario.history))
            )
        shown = {name: view.widget for name, view in self.views.items()}
        return side_by_side(
            [
                shown["instant"],
                shown["picture"],
                ipw.HBox([self.play, self.frame], layout=ipw.Layout(flex="1 1 100%")),
                *self._moments.values(),
                shown["readout"],
                *(shown[name] for name in self._charts),
            ]
        )

    def _stills(self, words: str) -> str:
        """Return the views as HTML, with a picture at either peak."""
        pictures = ""
        for body, peak in reversed(self.animation.scenario.history.peaks.items()):
            if peak is not None:
                self.show(peak.time)  # the engine's at last, which stays on show
                self.redraw()
                alt = f"At the {body} peak. {words}"
                pictures = self.views["picture"].still(alt, "max(40%, 320px)") + pictures
        return pictures + "".join(
            self.views[name].still(words) for name in ("readout", *self._charts)
        )
