"""How well a truck is found again in records of the model's own with noise: benchmarks/fit.py.

`python benchmarks/fit.py [TRIALS] [SAMPLES A SECOND]` draws trucks within ±30 % of the start and
speeds of 50–110 km/h, adds noise of 5 % of the peak to their contact forces and reactions on rigid
and flexible piers, and fits them. Printed is, for each parameter, how often it counted as
identified, its largest error then, and how often two standard errors covered the truth, then and
wherever it was fitted at all; and the processor time of a fit.
"""

import statistics
import sys
import time
from collections import defaultdict

import numpy as np

from pierimpact import EquivalentPier, fit_truck, load_truck
from pierimpact.collision.records import Record
from pierimpact.design.fit import PARAMETERS, parameter, with_parameters

START = load_truck("single-unit-8t")
NOISE = 0.05  # standard deviation over the peak
DURATION = 0.25  # [s]
KINDS = (("contact force", True), ("contact force", False), ("reaction", False))  # rigid or not


def trial(seed, rate):
    """Return the true truck and what is fitted to its record."""
    random = np.random.default_rng(seed)
    shares = {name: parameter(START, name) * random.uniform(0.7, 1.3) for name in PARAMETERS}
    truth = with_parameters(START, shares)
    quantity, rigid = KINDS[seed % len(KINDS)]
    pier = EquivalentPier.from_frequency(
        mass=float(np.exp(random.uniform(*np.log((3e3, 100e3))))),
        frequency=float(np.exp(random.uniform(*np.log((10.0, 100.0))))),
    )
    given = {
        "speed": random.uniform(50.0, 110.0) / 3.6,
        "pier": None if rigid else pier,
        "quantity": quantity,
    }
    times = np.arange(0.0, DURATION, 1.0 / rate)
    clean = Record(time=times, force=np.ones_like(times), **given)
    force = clean.modelled(clean.collision(truth))
    noisy = force + NOISE * force.max() * random.standard_normal(len(force))
    return truth, fit_truck(times, noisy, start=START, **given)


def main(trials=100, rate=10e3):
    """Run the trials and print the table."""
    errors, durations = defaultdict(list), []
    for seed in range(trials):
        begun = time.process_time()
        truth, fit = trial(seed, rate)
        durations.append(time.process_time() - begun)
        print(f"{seed + 1} of {trials}", end="\r", file=sys.stderr)
        for name, found in fit.estimates.items():
            if found.standard_error is not None:
                true = parameter(truth, name)
                miss = found.value - true
                covered = abs(miss) <= 2.0 * found.standard_error
                errors[name].append((not found.reason, abs(miss) / true, covered))
    heads = ("identified", "largest", "covered", "fitted", "covered")
    print(f"{'of ' + str(trials):34}" + "".join(f"{head:>12}" for head in heads))
    for name in PARAMETERS:
        fitted = errors[name]
        sure = [row for row in fitted if row[0]]
        print(
            f"{name:34}{len(sure):12}"
            f"{100.0 * max((row[1] for row in sure), default=np.nan):10.1f} %"
            f"{100.0 * np.mean([row[2] for row in sure] or [np.nan]):10.0f} %"
            f"{len(fitted):12}{100.0 * np.mean([row[2] for row in fitted] or [np.nan]):10.0f} %"
        )
    sure = [row for rows in errors.values() for row in rows if row[0]]
    print(f"{np.mean([row[1] <= 0.05 for row in sure]):.1%} of {len(sure)} within 5 %, ", end="")
    print(f"{np.mean([row[2] for row in sure]):.1%} within two standard errors")
    print(f"a fit: median {statistics.median(durations):.1f} s, longest {max(durations):.1f} s")


if __name__ == "__main__":
    main(*(int(float(word)) for word in sys.argv[1:]))
