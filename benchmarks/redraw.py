"""Kernel time of a redraw, slider by slider: python benchmarks/redraw.py.

Prints the median and the longest processor time of each explorer's redraws, with every slider moved
through 10 % about its default. A hand that drags a slider does not notice 100 ms.
"""

import statistics
import time

import numpy as np

from pierimpact import widgets

EXPLORERS = ("collision", "pier", "reduction", "spectra", "design", "sensitivity", "full")
FACTORS = np.linspace(0.95, 1.05, 11)


def milliseconds(explorer, name, value):
    """Return the processor time of the redraw after one slider was moved."""
    start = time.process_time()
    explorer.set(**{name: value})
    return 1e3 * (time.process_time() - start)


for title in EXPLORERS:
    explorer = getattr(widgets, title)()
    for name, control in explorer.controls.items():
        if control.variable.choices:
            continue
        default = getattr(explorer.defaults, name)
        times = [milliseconds(explorer, name, factor * default) for factor in FACTORS]
        explorer.set(**{name: default})
        print(f"{title:12} {name:28} {statistics.median(times):5.0f} ms {max(times):5.0f} ms")
