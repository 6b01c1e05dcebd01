"""The fit notebook's blocks: records of the model's own, and what a fit makes of them."""

from dataclasses import replace

import numpy as np

from pierimpact.collision.records import Record
from pierimpact.design.fit import TruckFit
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.plots.fit import draw_fit
from pierimpact.report.document.blocks import Block
from pierimpact.report.document.numbered import Figure, Table, columns, decimal, wide
from pierimpact.report.fit import fit_rows
from pierimpact.vehicle.truck import Truck

_SAMPLES, _DURATION = 5e3, 0.25  # a second, and for how long [s]; illustrative


def noisy_record(
    truck: Truck,
    speed: float,
    pier: EquivalentPier | None = None,
    quantity: str = "contact force",
    noise: float = 0.02,
    seed: int = 1,
) -> Record:
    """Return what a truck would leave in a record by the model, with noise.

    Parameters
    ----------
    truck : Truck
        The truck.
    speed, pier, quantity
        As in `Record`.
    noise : float, optional
        Standard deviation of the noise, as a share of the peak; 2 % is illustrative [-].
    seed : int, optional
        Seed of the random numbers.
    """
    time = np.arange(0.0, _DURATION, 1.0 / _SAMPLES)
    clean = Record(time=time, force=np.ones_like(time), speed=speed, pier=pier, quantity=quantity)
    force = clean.modelled(clean.collision(truck))
    scatter = noise * force.max() * np.random.default_rng(seed).standard_normal(len(force))
    return replace(clean, force=force + scatter)


def fit_figure(fit: TruckFit, title: str) -> Block:
    """Return the records of a fit with the forces of start and fitted truck."""
    residual = fit.residual
    return Figure(
        label="fig-fit",
        caption=f"{title}: record, start and fitted truck, and what is left.",
        alt="Force against time: the start has its spikes at other times than the record, the "
        f"fitted truck at the same. What is left is {100.0 * residual.share:.1f} % of the largest "
        "force, root mean square.",
        svg=draw_fit(fit, "SI").decode(),
    )


def fit_block(fit: TruckFit, title: str) -> Block:
    """Return a fit as a table: start, value and standard error, and what to know of each."""
    return Table(
        label="tab-fit",
        caption=f"{title}: the parameters.",
        columns=columns("Parameter", decimal("Start"), decimal("Fitted"), "Error", wide("Remark")),
        rows=fit_rows(fit),
    )
