"""Kernel time of a redraw, slider by slider: python benchmarks/redraw.py.

Prints the median and the longest processor time of each explorer's redraws, with every slider moved
through 10 % about its default, and of the frames of the collision in slow motion. A hand that drags
a slider does not notice 100 ms. The longest are those in which axes take new limits.
"""

import statistics
import time

import numpy as np

from pierimpact import widgets

EXPLORERS = ("collision", "pier", "reduction", "spectra", "design", "sensitivity", "full")
FACTORS = np.linspace(0.95, 1.05, 21)


def milliseconds(redraw, *args, **values):
    """Return the processor time of one redraw."""
    start = time.process_time()
    redraw(*args, **values)
    return 1e3 * (time.process_time() - start)


def report(title, name, times):
    """Print one line, with the median and the longest."""
    print(f"{title:12} {name:28} {statistics.median(times):5.0f} ms {max(times):5.0f} ms")


for title in EXPLORERS:
    explorer = getattr(widgets, title)()
    for name, control in explorer.controls.items():
        if control.variable.choices:
            continue
        default = getattr(explorer.defaults, name)
        values = [float(value) for value in FACTORS * default if value != default]
        explorer.set(**{name: values[-1]})  # the first redraw warms up
        report(title, name, [milliseconds(explorer.set, **{name: value}) for value in values])
        explorer.set(**{name: default})
    if hasattr(explorer, "show"):
        times = np.linspace(0.0, float(explorer.animation.times[-1]), 41)
        report(title, "a frame", [milliseconds(explorer.show, t) for t in times])
