"""What a network of bridges costs: python benchmarks/network.py [--rows N] [--share S].

Calculates a portfolio of N piers (100,000) and a share S (1/1000) of 620,000 bridges × 10,000
trucks, with the processes of this machine, and prints cost per row and per collision in seconds of
one core, memory and bytes. CPU time is counted, not the clock, so that other work on the machine
does not spoil it; still, a busy machine makes each second of it do less.
"""

import argparse
import csv
import os
import resource
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from tqdm import tqdm

from pierimpact import load_truck
from pierimpact.collision.groups import select
from pierimpact.collision.parameters import Parameters
from pierimpact.collision.reactions import full_model
from pierimpact.design import domain
from pierimpact.design.band import sampled_factors, spreads_of, with_factors
from pierimpact.design.study import with_truck
from pierimpact.files.piers import read_pier_table
from pierimpact.network.files import write_portfolio
from pierimpact.network.piece import Task, calculate_beams
from pierimpact.network.portfolio import calculate_portfolio
from pierimpact.network.workers import worker_pool

BRIDGES, TRUCKS = 620_000, 10_000
BEAMS = 20  # rows by the beam
QUANTILES = (0.5, 0.95, 0.99, 0.999)  # that are kept of a bridge
HEADING = (
    *("id", "latitude", "longitude", "column_shape", "column_diameter [in]", "column_height [m]"),
    *("elastic_modulus [GPa]", "density [kg/m^3]", "base", "top", "truck", "truck_mass [t]"),
    *("speed [km/h]", "impact_height [m]", "shear_resistance [MN]", "moment_resistance [MN*m]"),
)


class Bridge(NamedTuple):
    """A pier as one degree of freedom, and the seed of its trucks."""

    pier: Parameters  # of one collision, arrays of shape (1,)
    seed: int


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--rows", type=int, default=100_000)
    parser.add_argument("--share", type=float, default=1e-3)
    options = parser.parse_args()
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f} at the start")
    if options.rows:
        portfolio(options.rows)
    if options.share:
        collisions(round(options.share * BRIDGES))
    print(f"load {os.getloadavg()[0]:.1f} at the end")


def processor() -> float:
    """Return the CPU time of this process and of those that it has waited for [s]."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def memory() -> str:
    """Return the most memory that this process, and that a process it waited for, has had."""
    own, largest = (
        resource.getrusage(who).ru_maxrss / 1024
        for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    return f"{own:.0f} MiB in the process that gathers, {largest:.0f} MiB in the largest worker"


def portfolio(rows: int) -> None:
    """Measure a portfolio: all rows by the full model, and some as a beam."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_piers(folder / "piers.csv", rows)
        start, clock = processor(), time.perf_counter()
        table = read_pier_table(folder / "piers.csv")
        print(f"table checked: {processor() - start:.1f} s")
        with tqdm(total=rows, disable=None) as bar:
            found = calculate_portfolio(
                table, folder, beams="asked", progress=lambda unit, total: bar.update
            )
        calculated = processor()
        files = write_portfolio(found, table, folder)
        end, elapsed = processor(), time.perf_counter() - clock
        print(f"{rows:,} rows: {end - start:.0f} s of one core, {elapsed:.0f} s by the clock")
        print(f"of a row: {1e3 * (end - start) / rows:.2f} ms, {memory()}")
        print(f"of it to write the results: {end - calculated:.1f} s, by one process")
        for path in (table.path, *files):
            print(f"{path.name}: {path.stat().st_size / rows:.0f} bytes a row")
        pieces = sum(path.stat().st_size for path in (folder / "pieces").iterdir())
        print(f"pieces: {pieces / rows:.0f} bytes a row")
        task = Task(table.columns, next(table.pieces(BEAMS)), {TRUCK: load_truck(TRUCK)})
        start = processor()
        calculate_beams(task)
        print(f"as a beam: {1e3 * (processor() - start) / BEAMS:.0f} ms more a row")


TRUCK = "single-unit-8t"


def write_piers(path: Path, rows: int) -> None:
    """Write a table of random piers."""
    random = np.random.default_rng(1)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(HEADING)
        for row in range(rows):
            writer.writerow(
                [
                    f"P{row}",
                    round(random.uniform(30, 45), 4),
                    round(random.uniform(-120, -75), 4),
                    "circular",
                    random.choice([36, 42, 48, 60]),
                    round(random.uniform(4, 9), 1),
                    25,
                    2400,
                    "fixed",
                    random.choice(["pinned", "fixed", "free"]),
                    TRUCK,
                    round(random.uniform(6, 20), 1),
                    random.choice([50, 60, 80, 90, 100]),
                    1.2,
                    round(random.uniform(2, 6), 2),
                    round(random.uniform(3, 9), 2),
                ]
            )


def strike(bridge: Bridge) -> list[float]:
    """Return quantiles of the reactions of one bridge under all its trucks."""
    truck = load_truck(TRUCK)
    spreads = spreads_of(truck)
    factors = sampled_factors(spreads, TRUCKS, bridge.seed)[0][:, :TRUCKS]
    same = with_truck(select(bridge.pier, np.zeros(TRUCKS, dtype=int)), truck)
    found = full_model(with_factors(same, spreads, factors)).governing
    return [float(value) for value in np.quantile(found, QUANTILES)]


def bridges(count: int) -> Iterator[Bridge]:
    """Yield random piers of the studied domain."""
    drawn = domain.sample(count, 5)
    for number in range(count):
        yield Bridge(select(drawn, slice(number, number + 1)), number)


def collisions(count: int) -> None:
    """Measure so many bridges, each under 10,000 trucks."""
    clock, done = time.perf_counter(), 0
    with worker_pool() as run, tqdm(total=count, disable=None) as bar:
        for _ in run(strike, bridges(count)):
            done += 1
            bar.update(1)
            if done % 62 == 0:
                print(
                    f"  {done} bridges, {time.perf_counter() - clock:.0f} s by the clock",
                    flush=True,
                )
        before = os.times()
    after = os.times()  # the pool has ended: its time counts now
    used = (
        after.children_user + after.children_system - before.children_user - before.children_system
    )
    total = count * TRUCKS
    print(f"{total:,} collisions: {used:.0f} s of one core")
    print(f"of a collision: {1e6 * used / total:.1f} µs; {memory()}")
    hours = used / count * BRIDGES / 3600.0
    print(f"{BRIDGES:,} bridges: {hours:,.0f} hours of one core")


if __name__ == "__main__":
    main()
