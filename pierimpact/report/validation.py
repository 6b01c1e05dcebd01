"""The validation notebook's blocks: the design procedure against the full model."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.groups import select
from pierimpact.collision.parameters import Parameters
from pierimpact.collision.reactions import Reactions, full_model
from pierimpact.design import domain
from pierimpact.design.procedure import LEVELS
from pierimpact.design.reaction import predictions
from pierimpact.design.spectra import cargo_spectrum, engine_spectrum
from pierimpact.design.study import (
    ERROR_STATISTICS,
    FOLLOWED,
    SEED,
    SIZE,
    Summary,
    amplification_ratios,
    assessment,
    speed_errors,
    summary,
    with_truck,
)
from pierimpact.pier.equivalent import damping_coefficient, stiffness_at_frequency
from pierimpact.plots import validation as spectrum_figures
from pierimpact.report.document.blocks import Block
from pierimpact.report.document.numbered import Figure, Table, columns, decimal, wide
from pierimpact.symbols import SYMBOLS
from pierimpact.vehicle.truck import Truck

Array = NDArray[np.float64]

_FEW = 2000  # cases are enough for one truck or one way out of the domain
_RATIOS = ("mean", "coefficient of variation", "1st percentile", "smallest", "largest")


@dataclass(frozen=True)
class Validation:
    """Random collisions of the studied domain, by the full model and by the design procedure.

    Parameters
    ----------
    size : int, optional
        Number of collisions.
    seed : int, optional
        Seed of the random numbers; not the one that the formulas were fitted on.
    """

    size: int = SIZE
    seed: int = SEED + 1

    @cached_property
    def _case(self) -> Parameters:
        return domain.sample(self.size, self.seed)

    @cached_property
    def _exact(self) -> Reactions:
        return full_model(self._case)

    def domain_table(self) -> Block:
        """Return the studied values with their limits."""
        return Table(
            label="tab-domain",
            caption="The studied domain: random values between these limits.",
            columns=columns(wide("Value"), decimal("From"), decimal("To"), "Unit"),
            rows=[
                [SYMBOLS[name].heading, f"{low:g}", f"{high:g}", unit]
                for name, (low, high, unit, _) in domain.DOMAIN.items()
            ],
        )

    def scatter(self, level: str) -> Block:
        """Return the predicted reactions against those of the full model."""
        frequency, predicted, accuracy = self._predicted(level)
        return Figure(
            label=f"fig-scatter-{level}",
            caption=f"Predicted reactions ({level} level) against those of the full model. "
            "Dotted lines: 10 % more and less.",
            alt=f"Scatter plot of {self.size} collisions on three panels, engine, cargo and "
            f"governing. {accuracy}",
            svg=spectrum_figures.draw_scatter(frequency, self._exact, predicted, "SI"),
        )

    def ratios(self, level: str) -> Block:
        """Return predicted over full-model reactions against the pier's frequency."""
        frequency, predicted, accuracy = self._predicted(level)
        return Figure(
            label=f"fig-ratios-{level}",
            caption=f"Predicted ({level} level) over full-model reaction against pier frequency.",
            alt="Ratio against pier frequency on three panels, engine, cargo and governing. "
            f"{accuracy}",
            svg=spectrum_figures.draw_ratios(frequency, self._exact, predicted),
        )

    def _predicted(self, level: str) -> tuple[Array, Reactions, str]:
        """Return pier frequencies [Hz], predicted reactions, and in words how good these are."""
        predicted = predictions(self._case, level)
        ratios = summary(predicted.governing / self._exact.governing)
        words = (
            f"The governing reaction is predicted {ratios['mean']:.3f} times as large on average, "
            f"with a coefficient of variation of {ratios['coefficient of variation']:.3f}."
        )
        return domain.values(self._case)["fp"], predicted, words

    def bands(self, level: str, which: str) -> Block:
        """Return the statistics by frequency band.

        Parameters
        ----------
        level : {"short", "long"}
            Level of the procedure.
        which : {"engine", "cargo", "governing"}
            Which reaction.
        """
        found = assessment(self._case, self._exact, predictions(self._case, level))[which]
        return _statistics(
            f"tab-{level}-{which}",
            f"Predicted over full-model reaction: {which}, {level} level.",
            "Pier frequency",
            {name.replace("all", "All"): row for name, row in found.items()},
        )

    def spectrum(self) -> Block:
        """Return how near the closed spectrum is to the exact one, over the domain."""
        return _statistics(
            "tab-spectrum",
            "Closed-form over exact amplification factor.",
            "Body",
            {body.capitalize(): row for body, row in amplification_ratios(self._case).items()},
        )

    def contact_speeds(self) -> Block:
        """Return how far the speeds at contact are off."""
        found = speed_errors(select(self._case, slice(0, FOLLOWED)))
        return _statistics(
            "tab-speeds",
            "Contact speed of the formulas less that of the full model, in per cent of the "
            "truck’s speed.",
            "Body and level",
            {
                f"{body.capitalize()}, {level}": errors
                for level, bodies in found.items()
                for body, errors in bodies.items()
            },
            tuple(ERROR_STATISTICS),
            scale=100.0,
            decimals=2,
        )

    def trucks(self, trucks: Sequence[Truck]) -> Block:
        """Return the statistics of the governing reaction for other trucks, on the same piers."""
        few = select(self._case, slice(0, _FEW))
        return _both_levels(
            "tab-trucks",
            "Predicted over full-model governing reaction: one truck, with piers and speeds of the "
            "domain.",
            "Truck and level",
            {f"{truck.name}, {truck.mass / 1e3:g} t": with_truck(few, truck) for truck in trucks},
        )

    def beyond(self) -> Block:
        """Return the statistics of the governing reaction with one parameter outside the domain."""
        few = select(self._case, slice(0, _FEW))
        random, size = np.random.default_rng(self.seed), len(few.speed)
        found = domain.values(few)
        frequency, damping = found["fp"], found["zeta"]
        quarter = few.body._replace(plateau_length=0.25 * few.body.plateau_length)

        def between(low: float, high: float) -> Array:
            return random.uniform(low, high, size)

        # The ranges are this project's choice.
        return _both_levels(
            "tab-beyond",
            "Predicted over full-model governing reaction with one parameter outside the domain.",
            "Parameter and level",
            {
                "Pier frequency 3–5 Hz": _pier(few, between(3.0, 5.0), damping),
                "Damping 0–2 %": _pier(few, frequency, between(0.0, 0.02)),
                "Damping 7–20 %": _pier(few, frequency, between(0.07, 0.2)),
                "Speed 30–50 km/h": few._replace(speed=between(30.0, 50.0) / 3.6),
                "Speed 110–160 km/h": few._replace(speed=between(110.0, 160.0) / 3.6),
                "Body plateau length reduced to a quarter": few._replace(body=quarter),
            },
        )


def _pier(case: Parameters, frequency: Array, damping_ratio: Array) -> Parameters:
    """Return the collisions with piers of the same mass but another frequency [Hz] and damping."""
    stiffness = stiffness_at_frequency(case.pier_mass, frequency)
    damping = damping_coefficient(case.pier_mass, stiffness, damping_ratio)
    return case._replace(pier_stiffness=stiffness, pier_damping=damping)


def unified_spectrum(mass_ratios: Sequence[float], restitution: float, damping: float) -> Block:
    """Return the unified spectrum, exact and closed; arguments as in `draw_amplification`."""
    return Figure(
        label="fig-amplification",
        caption="The unified spectrum for three mass ratios.",
        alt="Amplification against frequency ratio: it rises in proportion at first, is largest "
        "at a ratio of about two and settles at one; the closed form follows the exact curves.",
        svg=spectrum_figures.draw_amplification(mass_ratios, restitution, damping),
    )


def routes(truck: Truck, speed: float, pier_mass: float) -> Block:
    """Return engine and cargo reaction of a truck against pier frequency, by three methods."""
    engine, cargo = (
        spectrum(truck, speed, pier_mass, level="long")
        for spectrum in (engine_spectrum, cargo_spectrum)
    )
    highest = [
        f"{name} {np.nanmax(spectrum.full_model) / 1e6:.2f} MN"
        for name, spectrum in (("engine", engine), ("cargo", cargo))
        if np.isfinite(spectrum.full_model).any()
    ]
    return Figure(
        label="fig-routes",
        caption=f"Spectra of {truck.name} at {3.6 * speed:.3g} km/h on piers of "
        f"{pier_mass / 1e3:g} t, by three methods.",
        alt="Engine and cargo reaction against pier frequency; highest by the full model: "
        + ", ".join(highest),
        svg=spectrum_figures.draw_routes(engine, cargo, "SI"),
    )


def _both_levels(label: str, caption: str, heading: str, cases: dict[str, Parameters]) -> Table:
    """Return the ratios of the governing reaction for both levels."""
    exact = {name: full_model(case).governing for name, case in cases.items()}
    ratios = {
        f"{name}, {level}": summary(predictions(case, level).governing / exact[name])
        for name, case in cases.items()
        for level in LEVELS
    }
    return _statistics(label, caption, heading, ratios)


def _statistics(
    label: str,
    caption: str,
    heading: str,
    found: Mapping[str, Summary],
    names: Sequence[str] = _RATIOS,
    *,
    scale: float = 1.0,
    decimals: int = 3,
) -> Table:
    """Return a table of the number of cases and the named statistics of each row."""
    return Table(
        label=label,
        caption=caption,
        columns=columns(
            wide(heading),
            decimal("Cases"),
            *(decimal(name[0].upper() + name[1:]) for name in names),
        ),
        rows=[
            [
                name,
                str(row["cases"]),
                *(
                    f"{scale * row[of]:.{decimals}f}".replace("-", "−") if row["cases"] else "–"
                    for of in names
                ),
            ]
            for name, row in found.items()
        ],
        strong=[index for index, name in enumerate(found) if name == "All"],
    )
