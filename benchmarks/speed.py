"""How fast the collision is, beside its peers: python benchmarks/speed.py.

Measures all in one run, prints the table of docs/speed.md and puts it there between its two marks,
and draws how the cost grows (benchmarks/growth.svg). Needs the test requirements; rows of
OpenSees are left out where it does not load. Takes about three minutes.
"""

import cProfile
import importlib
import math
import pstats
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import EngFormatter
from tqdm import tqdm

from pierimpact import (
    EquivalentPier,
    design_reactions,
    load_truck,
    peak_reactions,
    reaction_band,
    simulate,
)
from pierimpact.pier.equivalent import stiffness_at_frequency

HERE = Path(__file__).parent
PAGE = HERE.parent / "docs" / "speed.md"
sys.path.insert(0, str(HERE.parent / "tests"))  # the independent solutions of the tests

TRUCK, SPEED, MASS, DAMPING = load_truck("single-unit-8t"), 80.0 / 3.6, 8e3, 0.05
FREQUENCY = np.geomspace(2.0, 200.0, 1000)
STIFFNESS = stiffness_at_frequency(MASS, FREQUENCY)
EVERY = slice(10, None, 20)  # the piers that the peers are given
ACCURACY = 1e-6  # wanted of every peak
OPENSEES_STEP = 1e-5  # [s]
COUNTS = [10**power for power in range(7)]
FIRST = """
import numpy as np
from pierimpact import load_truck, peak_reactions
truck = load_truck("single-unit-8t")
peak_reactions(truck, 8e3, np.geomspace(1e6, 1e10, 1000), 0.05, 22.2)
"""
MARKS = ("<!-- what benchmarks/speed.py writes -->\n", "<!-- the end of it -->")


class Row(NamedTuple):
    """A line of the table."""

    work: str
    seconds: float
    remark: str


def seconds(work: Callable[[], Any], runs: int) -> float:
    """Return the median time of some runs after one that does not count."""
    work()
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def process_seconds(code: str, runs: int = 7) -> float:
    """Return the median time of a fresh Python process that runs `code`."""
    return seconds(lambda: subprocess.run([sys.executable, "-c", code], check=True), runs)


def spectrum() -> Any:
    """Return the peaks of the thousand piers."""
    return peak_reactions(TRUCK, MASS, STIFFNESS, DAMPING, SPEED)


def piers() -> list[EquivalentPier]:
    """Return the piers that the peers are given."""
    return [
        EquivalentPier(mass=MASS, stiffness=float(stiffness), damping_ratio=DAMPING)
        for stiffness in STIFFNESS[EVERY]
    ]


def converged() -> np.ndarray:
    """Return the peaks of those piers, from the tests' own solution at its finest."""
    solve = importlib.import_module("reference").solve
    found = [solve(TRUCK, pier, SPEED, 1e-13) for pier in piers()]
    return np.array([(one.engine, one.cargo) for one in found])


def largest_error(peaks: Any, exact: np.ndarray) -> float:
    """Return the largest relative error of engine and cargo peaks."""
    return float(np.nanmax(np.abs(np.asarray(peaks) / exact - 1.0)))


def solve_ivp(exact: np.ndarray) -> tuple[float, float]:
    """Return time for a thousand piers and largest error, at the loosest tolerance that serves."""
    solve = importlib.import_module("reference").solve
    for rtol in 10.0 ** np.arange(-5.0, -10.0, -0.5):
        start = time.perf_counter()
        found = [solve(TRUCK, pier, SPEED, rtol) for pier in piers()]
        spent = time.perf_counter() - start
        error = largest_error([(one.engine, one.cargo) for one in found], exact)
        if error <= ACCURACY:
            break
    return spent * len(FREQUENCY) / len(found), error


def opensees(exact: np.ndarray) -> tuple[float, float]:
    """Return time for a thousand piers and largest error, at a step of 1e-5 s."""
    ops = importlib.import_module("openseespy.opensees")
    solve = importlib.import_module("opensees_model").solve
    ends = [simulate(TRUCK, pier, SPEED).end.time for pier in piers()]
    start = time.perf_counter()
    found = [
        solve(ops, TRUCK, pier, SPEED, end, OPENSEES_STEP)
        for pier, end in zip(piers(), ends, strict=True)
    ]
    spent = time.perf_counter() - start
    return spent * len(FREQUENCY) / len(found), largest_error(found, exact)


def random_piers(count: int) -> dict[str, np.ndarray]:
    """Return random piers and speeds, as arguments of `peak_reactions`."""
    random = np.random.default_rng(count)
    mass = np.exp(random.uniform(math.log(3e3), math.log(1e5), count))
    frequency = np.exp(random.uniform(math.log(2.0), math.log(200.0), count))
    return {
        "pier_mass": mass,
        "pier_stiffness": stiffness_at_frequency(mass, frequency),
        "damping_ratio": random.uniform(0.02, 0.07, count),
        "speed": random.uniform(50.0, 110.0, count) / 3.6,
    }


def growth() -> list[float]:
    """Return the time of 1, 10, … 10⁶ random collisions."""
    spent = []
    for count in COUNTS:
        given = random_piers(count)
        if count <= 10_000:
            spent.append(seconds(lambda given=given: peak_reactions(TRUCK, **given), 3))
            continue
        with tqdm(total=count, desc=f"{count:,} collisions", leave=False) as bar:
            start = time.perf_counter()
            peak_reactions(TRUCK, **given, progress=bar.update)
            spent.append(time.perf_counter() - start)
    return spent


def draw(spent: list[float]) -> None:
    """Draw the cost of a collision against their number."""
    figure = Figure(figsize=(6.0, 3.0), layout="constrained")
    axes = figure.subplots()
    cost = np.array(spent) / COUNTS
    axes.loglog(COUNTS, cost, "o-", color="#0072b2")
    for count, value in zip(COUNTS, cost, strict=True):
        axes.annotate(shown(value), (count, value), (3, 6), textcoords="offset points")
    axes.set(xlabel="Collisions in one call", ylabel="Time of each")
    axes.set(xlim=(0.6, 5 * COUNTS[-1]), ylim=(0.6 * cost.min(), 3.0 * cost.max()))
    axes.xaxis.set_major_formatter("{x:,.0f}")
    axes.yaxis.set_major_formatter(EngFormatter(unit="s"))
    axes.grid(alpha=0.3)
    axes.spines[["top", "right"]].set_visible(False)
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": "growth"}):
        figure.savefig(HERE / "growth.svg", metadata={"Date": None})


def profile(most: int = 6) -> list[str]:
    """Return where the time of the thousand-pier spectrum goes."""
    profiler = cProfile.Profile()
    profiler.runcall(spectrum)
    entries = pstats.Stats(profiler).get_stats_profile().func_profiles
    whole = sum(entry.tottime for entry in entries.values())
    largest = sorted(entries.items(), key=lambda item: -item[1].tottime)[:most]
    return [
        f"`{name.strip('{}<>').split('.')[-1]}` ({entry.tottime / whole:.0%}, {entry.ncalls} calls)"
        for name, entry in largest
    ]


def shown(value: float) -> str:
    """Return a time with two figures."""
    return str(EngFormatter(unit="s", sep=" ")(float(f"{value:.2g}")))


def spectrum_rows(exact: np.ndarray, ours: float) -> Iterator[Row]:
    """Measure the thousand-pier spectrum and its peers."""
    found = spectrum()
    error = largest_error(np.array([found.engine[EVERY], found.cargo[EVERY]]).T, exact)
    yield Row("1,000-pier spectrum by the full model", ours, f"peaks within {error:.0e}")
    peers = [("SciPy’s `solve_ivp` with events", solve_ivp)]
    try:
        importlib.import_module("openseespy.opensees")
        peers.append((f"OpenSees in steps of {shown(OPENSEES_STEP)}", opensees))
    except (ImportError, RuntimeError):
        print("OpenSees does not load here and is left out")
    for name, peer in peers:
        spent, error = peer(exact)
        remark = f"{float(f'{spent / ours:.2g}'):,.0f} times as long, peaks within {error:.0e}"
        yield Row(f"the same by {name}", spent, remark)


def single_rows() -> Iterator[Row]:
    """Measure what is called once at a time."""
    pier = EquivalentPier.from_frequency(MASS, 30.0)
    yield Row(
        "one `simulate`", seconds(lambda: simulate(TRUCK, pier, SPEED), 300), "80 km/h, 30 Hz"
    )
    yield Row(
        "a band of 1,000 sampled trucks, with shares of variance",
        seconds(lambda: reaction_band(TRUCK, pier, SPEED), 7),
        f"{len(TRUCK.spread)} uncertain parameters, 4,095 collisions",
    )
    million = random_piers(10**6)
    spent = seconds(lambda: design_reactions(TRUCK, **million, level="long"), 3)
    yield Row("1,000,000 design reactions", spent, "by the closed formulas, long level")
    python, numpy = process_seconds(""), process_seconds("import numpy")
    yield Row("`import pierimpact`", process_seconds("import pierimpact") - python, "after Python")
    yield Row(
        "a fresh process up to its first such spectrum",
        process_seconds(FIRST),
        f"{shown(numpy)} of it Python and NumPy",
    )


def growth_row() -> Row:
    """Measure how the cost grows, draw it, and return the last."""
    spent = growth()
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024**2
    draw(spent)
    each, before = shown(spent[6] / COUNTS[6]), shown(spent[3] / COUNTS[3])
    return Row(
        "1,000,000 random collisions by the full model",
        spent[6],
        f"{each} each, {before} among 1,000; at most {memory:.2f} GiB",
    )


def main() -> None:
    """Measure, print, and put the table into the page."""
    exact, ours = converged(), seconds(spectrum, 15)
    rows = [*spectrum_rows(exact, ours), *single_rows(), growth_row()]
    few = seconds(lambda: peak_reactions(TRUCK, MASS, STIFFNESS[EVERY], DAMPING, SPEED), 15)
    table = [
        "| work | time | how well |",
        "|---|---|---|",
        *(f"| {row.work} | {shown(row.seconds)} | {row.remark} |" for row in rows),
        "",
        f"Of the {shown(ours)}, {shown(few)} are calls of NumPy: so long takes a spectrum of "
        f"{len(exact)} piers. The rest is arithmetic on the terms of the series. Most time of its "
        f"own takes {', '.join(profile())}.",
    ]
    print("\n".join(table))
    text = PAGE.read_text(encoding="utf-8")
    start, end = (text.index(mark) for mark in MARKS)
    new = [text[: start + len(MARKS[0])], *table, text[end:]]
    PAGE.write_text("\n".join(new), encoding="utf-8")


if __name__ == "__main__":
    main()
