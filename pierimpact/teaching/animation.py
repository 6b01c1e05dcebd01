"""The collision in slow motion, frame by frame."""

import math
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.history import hermite
from pierimpact.plots.schematic import SWING, Frame, Scene
from pierimpact.teaching.scenario import Scenario
from pierimpact.vehicle.crush import CrushSpring

Array = NDArray[np.float64]

FRAMES = 201


class Animation:
    """The frames of one collision.

    Parameters
    ----------
    scenario : Scenario
        The collision.
    """

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.times = np.linspace(0.0, float(scenario.history.time[-1]), FRAMES)
        for moment in _moments(scenario):  # each has a frame of its own, to the instant
            self.times[self.index(moment)] = moment

    def index(self, time: float) -> int:
        """Return the frame nearest to a time [s]."""
        return int(np.argmin(np.abs(self.times - time)))

    def frame(self, index: int) -> Frame:
        """Return the moving parts of the picture at one frame."""
        return Frame(*self._frames[index].tolist())

    @cached_property
    def scene(self) -> Scene:
        """The fixed parts of the picture."""
        history = self.scenario.history
        largest = float(np.abs(history.reaction).max())
        raw = SWING / float(np.abs(history.pier_displacement).max())
        unit = 10.0 ** math.floor(math.log10(raw))
        scale = max(unit * n for n in (1.0, 2.0, 5.0) if unit * n <= raw * 1.001)
        return Scene(self.scenario.truck, self.scenario.struck_column, scale, largest)

    @cached_property
    def _frames(self) -> Array:
        history, truck = self.scenario.history, self.scenario.truck
        pier = hermite(history.time, history.pier_displacement, history.pier_velocity, self.times)
        series = [
            history.engine_crush,
            history.body_crush,
            _free_crush(truck.engine_spring, history.engine_crush),
            _free_crush(truck.body_spring, history.body_crush),
            history.engine_force,
            history.body_force,
            history.engine_velocity,
            history.body_velocity,
        ]
        others = (np.interp(self.times, history.time, samples) for samples in series)
        return np.array([self.times, pier, self.scenario.pier.stiffness * pier, *others]).T

    def phase(self, frame: Frame) -> str:
        """Return the phase of the collision at a frame, as a sentence."""
        history = self.scenario.history
        engine, cargo = history.engine_contact_time, history.cargo_contact_time
        t = frame.time
        if frame.engine_force <= 0.0 and frame.body_force <= 0.0:
            after = "The truck has separated from the pier, which vibrates freely."
            return "First touch." if t == 0.0 else after
        if cargo is not None and t >= cargo and frame.body_force > 0.0:
            return "The cargo is in contact with the pier."
        if engine is not None and t >= engine and frame.engine_force > 0.0:
            return "The engine block is in contact with the pier."
        if engine is not None and t >= engine:
            return "The engine has rebounded; the body still presses on the pier, which vibrates."
        return "Sheet metal is being crushed, before any hard contact."


def _moments(scenario: Scenario) -> list[float]:
    """Return the instants of the contacts and peaks [s]."""
    history = scenario.history
    contacts = (history.engine_contact_time, history.cargo_contact_time)
    peaks = [peak.time for peak in scenario.history.peaks.values() if peak is not None]
    return [time for time in contacts if time is not None] + peaks


def _free_crush(spring: CrushSpring, crush: Array) -> Array:
    """Return the crush that remains if the spring is unloaded, at each sample of its crush."""
    largest = np.maximum.accumulate(crush)
    left: Array = np.maximum(largest - spring.envelope(largest) / spring.unloading_stiffness, 0.0)
    return np.maximum(crush, left)
