"""The explorer of one collision: its moving picture, forces, energy and place on the spectra."""

from collections.abc import Callable
from functools import partial
from typing import Any

import ipywidgets as ipw

from pierimpact.collision.history import CollisionHistory
from pierimpact.plots import collision, schematic, spectrum
from pierimpact.plots.style import BODIES
from pierimpact.teaching import readouts
from pierimpact.teaching.animation import FRAMES, Animation
from pierimpact.teaching.explorer import HALF, Contents, Explorer, side_by_side
from pierimpact.teaching.live import LiveFigure, LiveWords
from pierimpact.teaching.scenario import Scenario

_MOMENTS: dict[str, Callable[[CollisionHistory], Any]] = {
    "First touch": lambda history: 0.0,
    "Engine contact": lambda history: history.engine_contact_time,
    "Engine peak": lambda history: history.engine_peak.time,
    "Cargo contact": lambda history: history.cargo_contact_time,
    "Cargo peak": lambda history: history.cargo_peak and history.cargo_peak.time,
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
        self.frame = ipw.IntSlider(
            max=last, readout=False, layout=ipw.Layout(flex="1 1 200px", min_width="120px")
        )
        self.play = ipw.Play(max=last, interval=50, show_repeat=False)
        ipw.jslink((self.play, "value"), (self.frame, "value"))
        self._scenario: Scenario | None = None
        charts = {
            "forces": LiveFigure(
                "Forces against time",
                HALF,
                collision.forces_panel,
                collision.draw_forces,
                collision.draw_instant,
            ),
            "energy": LiveFigure(
                "Energy against time",
                HALF,
                collision.energy_panel,
                collision.draw_energy,
                collision.draw_instant,
            ),
        }
        if spectra:
            engine, cargo = (_spectrum_figure(body) for body in BODIES)
            charts = {
                "forces": charts["forces"],
                "engine": engine,
                "energy": charts["energy"],
                "cargo": cargo,
            }
        self._charts = tuple(charts)
        self._picture = LiveFigure(
            "The collision",
            schematic.SIZE,
            schematic.picture,
            schematic.draw_scene,
            schematic.draw_frame,
        )
        super().__init__(
            views={
                "instant": LiveWords(),
                "picture": self._picture,
                "readout": LiveWords(),
                **charts,
            },
            draw=self._contents,
            words=readouts.outcome,
            **options,
        )
        self.play.value = self.frame.value  # or a page could start from either
        self.frame.observe(lambda _: self._redraw_soon(), "value")

    def _contents(self, scenario: Scenario) -> Contents:
        if scenario != self._scenario:
            # Nothing of the old collision is replaced before all of the new one is there.
            self.animation = Animation(scenario)
            self._scenario = scenario
            for words, when in _MOMENTS.items():
                self._moments[words].disabled = when(scenario.history) is None
        # The one drawn first of those that are equal: its history is known.
        scenario = self.animation.scenario
        frame, history = self.animation.frame(self.frame.value), scenario.history
        contents: dict[str, tuple[Any, ...]] = {
            "instant": (readouts.instant(frame, self.animation.phase(frame)),),
            "picture": ((self.animation.scene,), (self.animation.scene, frame)),
            "readout": (readouts.collision_readout(scenario),),
            "forces": ((history,), (frame.time, frame.reaction)),
            "energy": ((history,), (frame.time,)),
        }
        if "engine" in self.views:
            curves = scenario.curves
            for body, peak in scenario.peaks.items():
                spectrum = curves.frequency, curves.full[body], curves.reduced[body]
                reaction = None if peak is None else peak.reaction
                contents[body] = (spectrum, (*spectrum, scenario.pier.frequency, reaction))
        return contents

    @property
    def time(self) -> float:
        """The instant that the picture shows [s]."""
        return float(self.animation.times[self.frame.value])

    def show(self, time: float) -> None:
        """Show the instant nearest to a time after first touch [s]."""
        self.frame.value = self.animation.index(time)

    def _arranged(self) -> ipw.Widget:
        self._moments = {}
        for words, when in _MOMENTS.items():
            button = ipw.Button(description=words, layout=ipw.Layout(width="auto"))
            button.on_click(lambda _, when=when: self.show(when(self.animation.scenario.history)))
            self._moments[words] = button
        shown = {name: view.widget for name, view in self.views.items()}
        whole = ipw.Layout(flex="1 1 100%")
        return side_by_side(
            [
                shown["instant"],
                shown["picture"],
                ipw.HBox([self.play, self.frame], layout=whole),
                *self._moments.values(),
                shown["readout"],
                *(shown[name] for name in self._charts),
            ]
        )

    def _stills(self, words: str) -> str:
        """Return the views as HTML, with a picture at either peak."""
        pictures = ""
        for body, peak in reversed(self.animation.scenario.peaks.items()):
            if peak is not None:
                self.show(peak.time)  # the engine's at last, which stays on show
                self.redraw()
                still = self._picture.still(f"At the {body} peak. {words}", "max(40%, 320px)")
                pictures = still + pictures
        others = ("readout", *self._charts)
        return pictures + "".join(self.views[name].still(words) for name in others)


def _spectrum_figure(body: str) -> LiveFigure:
    return LiveFigure(
        f"{body.capitalize()} peak against pier frequency",
        HALF,
        partial(spectrum.spectrum_panel, body=body),
        partial(spectrum.draw_spectrum, body=body),
        partial(spectrum.draw_place, body=body),
    )
