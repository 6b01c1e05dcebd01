"""The truck that a force record shows: crush-law parameters by bounded least squares.

All parameters but the total mass are fitted in their logarithms, r = log(p/p_start). Minimised is

    Σ (F_model − F_record)²/σ² + Σ r²/s²

over bounded r: σ is the record's noise, found from the fit itself, and s the spread that the
start is trusted to. The second sum hardly counts for what the record shows well; what it does not
show stays near its start instead of drifting. The covariance of r is (JᵀJ/σ² + I/s²)⁻¹. Noise that
is correlated in time, filtered noise above all, counts by its power at low frequencies,
σ² (1 + 2 Σ ρ_k), with the autocorrelations ρ_k of the residuals up to the first that is not
positive. Parameters that do not show are then put back to their start, and the others fitted once
more; the covariance still counts the former as uncertain. Derived here.
"""

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pierimpact.checks import InputError, known, positive
from pierimpact.collision.history import CollisionHistory
from pierimpact.collision.records import Record
from pierimpact.collision.regimes import ELASTIC, FREE, STEEP
from pierimpact.pier.beam import BeamPier
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.symbols import BY_KEY
from pierimpact.vehicle.crush import CrushSpring
from pierimpact.vehicle.truck import Truck

Array = NDArray[np.float64]

_SPRINGS = {"engine_spring": "engine", "body_spring": "cargo"}  # with the body that each brings
_LAW = tuple(CrushSpring.__dataclass_fields__)
#: What can be fitted, by the keys of truck files; the body's mass is the rest of the total mass.
PARAMETERS = (
    "engine_mass",
    "friction_force",
    *(f"{spring}.{name}" for spring in _SPRINGS for name in _LAW),
)
#: What counts as shown within, and how well the start is trusted: this project's choices [-].
ACCURACY, SPREAD = 0.05, 0.3
#: Standard errors that must fit in the accuracy asked for, this project's choice; a value is off
#: by more 3 times in 1000.
SURE = 3.0
_WIDEST = math.log(10.0)  # bound of r, this project's choice
_NEVER = math.log(1e3)  # r of a plateau that no crush comes to the end of; numerical
# Random trucks, and steps of r along a parameter, to start from; numerical.
_DRAWS, _APART = 40, 0.05
#: Parameters that set when the spikes occur, the larger first.
_POSITIONS = ("body_spring.plateau_length", "engine_spring.plateau_length")
_FEW = 2000  # samples of a record while looking for the best start
_SEED = 0
_CHANGE, _ASIDE = 1e-6, 1e-4  # of r, for derivatives, and to leave the corners; numerical
# Share of the spread that the error of a parameter shown does not exceed, and correlation from
# which parameters are said to show together: this project's choices.
_GAIN, _TOGETHER = 0.5, 0.9


class Estimate(NamedTuple):
    """What a fit says about one parameter, in SI units."""

    start: float
    value: float  #: as fitted; the start where the records do not show the parameter but allow it
    standard_error: float | None  #: None where the records do not show it
    reason: str  #: why the parameter does not count as identified; empty if it does

    @property
    def shown(self) -> bool:
        """Whether the records show the parameter, be it roughly, so that its value is fitted."""
        return self.standard_error is not None


class Residual(NamedTuple):
    """What is left between record and model."""

    rms: float  #: root mean square [N]
    share: float  #: the same over the largest force recorded [-]


@dataclass(frozen=True, kw_only=True)
class TruckFit:
    """A truck fitted to force records.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from pierimpact import EquivalentPier, fit_truck, load_truck, simulate
    >>> truck, pier = load_truck("single-unit-8t"), EquivalentPier.from_frequency(8e3, 30.0)
    >>> history = simulate(truck, pier, speed=22.2)
    >>> start = replace(truck, engine_mass=600.0, body_mass=7400.0)
    >>> fit = fit_truck(
    ...     history.time,
    ...     history.contact_force,
    ...     start=start,
    ...     speed=22.2,
    ...     pier=pier,
    ...     parameters=["engine_mass"],
    ... )
    >>> round(fit.truck.engine_mass), fit.not_identified
    (700, {})
    >>> bool(fit.residual.share < 0.01)  # of the largest force
    True
    """

    records: tuple[Record, ...]
    start: Truck
    estimates: Mapping[str, Estimate]  #: by parameter
    correlations: Array  #: of the logarithms, in the order of the estimates, shape (n, n)

    @cached_property
    def truck(self) -> Truck:
        """The start with the parameters as fitted that the records show."""
        values = {name: estimate.value for name, estimate in self.estimates.items()}
        truck = with_parameters(self.start, values)
        source = f"fitted to {len(self.records)} force record(s), from: {self.start.source}"
        return replace(truck, name=f"{self.start.name}-fitted", source=source)

    @property
    def standard_errors(self) -> dict[str, float]:
        """Standard errors of the parameters that the records show, in SI units."""
        errors = {name: estimate.standard_error for name, estimate in self.estimates.items()}
        return {name: error for name, error in errors.items() if error is not None}

    @property
    def not_identified(self) -> dict[str, str]:
        """Parameters that do not count as identified, with the reasons.

        Those without a standard error do not show: they stay at their start, or, for a plateau
        that is shorter there than the crush without a contact, at a length that is possible. The
        others show roughly, and are in `truck` as fitted.
        """
        return {name: e.reason for name, e in self.estimates.items() if e.reason}

    @cached_property
    def modelled(self) -> Array:
        """What the records would be with `truck`, one after the other, shape (times,) [N]."""
        return np.concatenate([r.modelled(r.collision(self.truck)) for r in self.records])

    @property
    def residual(self) -> Residual:
        """What is left between the records and `truck`."""
        left = self.modelled - np.concatenate([record.force for record in self.records])
        rms = math.sqrt(float(np.mean(left**2)))
        return Residual(rms, rms / max(record.peak for record in self.records))


def fit_truck(
    time: ArrayLike,
    force: ArrayLike,
    *,
    start: Truck,
    speed: float,
    pier: EquivalentPier | BeamPier | None = None,
    quantity: str = "contact force",
    filter: float | None = None,  # noqa: A002
    cutoff: float | None = None,
    average: float | None = None,
    first_touch: float = 0.0,
    parameters: Collection[str] | None = None,
    accuracy: float = ACCURACY,
    spread: float = SPREAD,
    progress: Callable[[int], object] = lambda count: None,
) -> TruckFit:
    """Fit a truck to a force record.

    Parameters
    ----------
    time, force : array_like, shape (n,)
        The record: times [s] and forces, compression positive [N].
    start : Truck
        Truck to start from. Its total mass is taken as known, and stays.
    speed, pier, quantity, first_touch
        As in `Record`; no pier is a rigid one.
    filter : float, optional
        Cut-off frequency of a low-pass filter that record and model are to pass alike [Hz].
    cutoff, average : float, optional
        What was done to the record already, and is done to the model alone: cut-off frequency of a
        low-pass filter [Hz], length of a moving average [s].
    parameters, accuracy, spread, progress
        As in `fit_records`.

    Raises
    ------
    InputError
        As in `Record` and `fit_records`.

    Examples
    --------
    >>> from pierimpact import EquivalentPier, fit_truck, load_truck, simulate
    >>> truck = load_truck("single-unit-8t")
    >>> pier = EquivalentPier.from_frequency(mass=8e3, frequency=30.0)
    >>> history = simulate(truck, pier, speed=22.2)
    >>> fit = fit_truck(history.time, history.contact_force, start=truck, speed=22.2, pier=pier)
    >>> round(fit.truck.engine_mass)
    700
    """
    record = Record(
        time=np.asarray(time),
        force=np.asarray(force),
        speed=speed,
        pier=pier,
        quantity=quantity,
        cutoff=cutoff,
        window=average,
        first_touch=first_touch,
    )
    return fit_records(
        [record if filter is None else record.low_passed(filter)],
        start,
        parameters=parameters,
        accuracy=accuracy,
        spread=spread,
        progress=progress,
    )


def fit_records(
    records: Sequence[Record],
    start: Truck,
    *,
    parameters: Collection[str] | None = None,
    accuracy: float = ACCURACY,
    spread: float = SPREAD,
    progress: Callable[[int], object] = lambda count: None,
) -> TruckFit:
    """Fit one truck to force records, of several speeds or piers, say.

    Parameters
    ----------
    records : sequence of Record
        The records.
    start : Truck
        Truck to start from. Its total mass is taken as known, and stays.
    parameters : collection of str, optional
        Which of PARAMETERS to fit; all but a friction force of zero unless given.
    accuracy : float, optional
        A parameter counts as identified where three standard errors are at most this share of its
        value.
    spread : float, optional
        Standard deviation that the start is trusted to, of the parameters' logarithms [-].
    progress : callable, optional
        Called now and then with the number of collisions calculated since the last call.

    Raises
    ------
    InputError
        When there is no record, a parameter is unknown or zero at the start, or accuracy or spread
        is not positive.
    """
    if not records:
        raise InputError("records must hold at least one record, got none")
    names = _names(start, parameters)
    accuracy, spread = positive("accuracy", accuracy), positive("spread", spread)
    problem = _Problem(
        tuple(records),
        start,
        names,
        spread,
        [max(1, len(record.time) // _FEW) for record in records],
        progress,
    )
    first_noise = [0.05 * record.peak for record in records]  # to begin with; numerical
    r, noise = problem.solve(problem.starts(), first_noise, tolerance=1e-3)
    problem = replace(problem, strides=[1] * len(records))
    for _ in range(2):  # the second time with the noise that the first has found
        r, noise = problem.solve([r], noise)
    covariance = problem.covariance(r, noise)
    unseen = problem.unseen(r, noise)
    for index, name in enumerate(names):
        if name not in unseen and covariance[index, index] > (_GAIN * spread) ** 2:
            unseen[name] = "the record hardly shows it" + _together(index, names, covariance)
    shown = np.array([name not in unseen for name in names])
    if unseen:
        back = np.where(shown, r, 0.0)
        for index, name in enumerate(names):
            alone = np.where(np.arange(len(r)) == index, 0.0, r)
            plateau = name in unseen and name.endswith("plateau_length")
            if plateau and problem.refuted(alone, r, noise):
                # The crush goes farther than that, and no contact shows.
                back[index] = r[index]
                unseen[name] += "; its plateau is longer than at the start"
        r = back
        if shown.any():
            few = replace(
                problem,
                start=problem.truck(np.where(shown, 0.0, r)),
                names=tuple(name for name in names if name not in unseen),
            )
            r[shown], noise = few.solve([r[shown]], noise)
        covariance = problem.covariance(r, noise)
    truck = problem.truck(r)
    estimates = {}
    for index, name in enumerate(names):
        share = math.sqrt(covariance[index, index])
        start_value, value = parameter(start, name), parameter(truck, name)
        if name in unseen:
            estimates[name] = Estimate(start_value, value, None, unseen[name])
            continue
        reason = ""
        if SURE * share > accuracy:
            width = float(f"{100.0 * SURE * share:.2g}")
            reason = f"shows roughly, to ±{width:g} % at three standard errors"
            reason += _together(index, names, covariance)
        estimates[name] = Estimate(start_value, value, share * value, reason)
    errors = np.sqrt(np.diag(covariance))
    return TruckFit(
        records=tuple(records),
        start=start,
        estimates=estimates,
        correlations=covariance / np.outer(errors, errors),
    )


def with_parameters(truck: Truck, values: Mapping[str, float]) -> Truck:
    """Return a truck of the same total mass with other values of some of PARAMETERS.

    A value that breaks a rule of the crush law with the others is moved to where it just keeps it.
    """
    springs: dict[str, Any] = {}
    for spring in _SPRINGS:
        law = {name: getattr(getattr(truck, spring), name) for name in _LAW}
        law |= {name: values[f"{spring}.{name}"] for name in _LAW if f"{spring}.{name}" in values}
        law["unloading_stiffness"] = max(law["unloading_stiffness"], law["stiffness"])
        limit = law["plateau_force"] / law["unloading_stiffness"]
        law["plateau_length"] = max(law["plateau_length"], limit)
        springs[spring] = CrushSpring(**law)
    engine_mass = min(values.get("engine_mass", truck.engine_mass), 0.99 * truck.mass)  # numerical
    return replace(
        truck,
        engine_mass=engine_mass,
        body_mass=truck.mass - engine_mass,
        friction_force=values.get("friction_force", truck.friction_force),
        **springs,
    )


def parameter(truck: Truck, name: str) -> float:
    """Return one of PARAMETERS of a truck."""
    spring, _, law = name.rpartition(".")
    return float(getattr(getattr(truck, spring) if spring else truck, law))


def _names(start: Truck, parameters: Collection[str] | None) -> tuple[str, ...]:
    """Return the parameters to fit, in the order of PARAMETERS."""
    if parameters is None:
        return tuple(name for name in PARAMETERS if parameter(start, name) > 0.0)
    for name in parameters:
        known(name, PARAMETERS, "a parameter that can be fitted")
        if parameter(start, name) <= 0.0:
            raise InputError(f"{name} must be positive at the start to be fitted, it is zero")
    if not parameters:
        raise InputError("parameters must name at least one, got none")
    return tuple(name for name in PARAMETERS if name in parameters)


@dataclass(frozen=True)
class _Problem:
    """The least squares, with every so many samples of each record."""

    records: tuple[Record, ...]
    start: Truck
    names: tuple[str, ...]
    spread: float
    strides: Sequence[int]
    progress: Callable[[int], object]

    def truck(self, r: Array) -> Truck:
        values = {
            name: parameter(self.start, name) * math.exp(x)
            for name, x in zip(self.names, r, strict=True)
        }
        return with_parameters(self.start, values)

    def left(self, r: Array) -> list[Array]:
        """Return what is left between model and record, for each record [N]."""
        truck = self.truck(r)
        self.progress(len(self.records))
        return [
            record.modelled(record.collision(truck), stride) - record.force[::stride]
            for record, stride in zip(self.records, self.strides, strict=True)
        ]

    def jacobian(self, r: Array) -> list[Array]:
        """Return the derivatives of what is left, for each record of shape (times, parameters)."""
        before = self.left(r)
        inwards = np.where(r > 0.0, -_CHANGE, _CHANGE)  # away from the bounds
        afters = [self.left(r + step) for step in np.diag(inwards)]
        return [
            np.stack([after[k] - before[k] for after in afters], axis=1) / inwards
            for k in range(len(self.records))
        ]

    def solve(
        self, starts: Sequence[Array], noise: Sequence[float], tolerance: float = 1e-6
    ) -> tuple[Array, list[float]]:
        """Return the best r from several starts, and the noise of each record there [N].

        The tolerance is relative and numerical.
        """
        from scipy.optimize import least_squares

        def weighted(r: Array) -> Array:
            left = self.left(r)
            return np.concatenate(
                [*(x / s for x, s in zip(left, weights, strict=True)), r / self.spread]
            )

        def slope(r: Array) -> Array:
            rows = [x / s for x, s in zip(self.jacobian(r), weights, strict=True)]
            return np.concatenate([*rows, np.eye(len(r)) / self.spread])

        # Of every so many samples each stands for that many.
        weights = [s / math.sqrt(k) for s, k in zip(noise, self.strides, strict=True)]
        options: Any = {"ftol": tolerance, "xtol": tolerance, "max_nfev": 40}
        found = [least_squares(weighted, r, slope, (-_WIDEST, _WIDEST), **options) for r in starts]
        best = min(found, key=lambda result: float(result.cost)).x
        noise = [
            _noise(left, record.force, len(best))
            for left, record in zip(self.left(best), self.records, strict=True)
        ]
        return best, noise

    def covariance(self, r: Array, noise: Sequence[float]) -> Array:
        """Return the covariance of r, shape (parameters, parameters).

        The fit likes to put a corner of the force on a sample, where some derivatives are those of
        one side and some of the other. So they are taken a little to either side.
        """
        rows = [np.eye(len(r)) / self.spread]
        for aside in (-_ASIDE, _ASIDE):
            slopes = self.jacobian(r + aside)
            rows += [math.sqrt(0.5) * x / s for x, s in zip(slopes, noise, strict=True)]
        _, size, directions = np.linalg.svd(np.concatenate(rows), full_matrices=False)
        return np.asarray((directions.T / size**2) @ directions, dtype=float)

    def refuted(self, other: Array, r: Array, noise: Sequence[float]) -> bool:
        """Say whether another r is worse than this one by more than `SURE` standard errors."""
        sums = [
            [float(left @ left) / s**2 for left, s in zip(self.left(x), noise, strict=True)]
            for x in (other, r)
        ]
        return sum(sums[0]) - sum(sums[1]) > SURE**2

    def unseen(self, r: Array, noise: Sequence[float]) -> dict[str, str]:
        """Return the parameters that no record shows, with the reasons."""
        truck = self.truck(r)
        reasons = [_unseen_in(record, record.collision(truck)) for record in self.records]
        unseen = {name: reasons[0][name] for name in set.intersection(*map(set, reasons))}
        for spring, body in _SPRINGS.items():
            length, stiffness = f"{spring}.plateau_length", f"{spring}.stiffness"
            if length in unseen or length not in self.names:
                continue
            never = np.where(np.array(self.names) == length, _NEVER, r)
            if not self.refuted(never, r, noise):
                reason = f"the record does not tell whether the {body} reaches the pier"
                unseen |= {length: reason, stiffness: reason}
        return unseen

    def starts(self) -> list[Array]:
        """Return starts in which the spikes lie where the records have them.

        Spikes that do not overlap do not attract each other. So from the start, and from the
        random truck whose impulses up to each time come closest, the plateau lengths are moved in
        turn to where the forces come closest; they set when the spikes occur.
        """
        random = np.random.default_rng(_SEED)
        reach = min(1.5 * self.spread, 0.9 * _WIDEST)  # numerical
        draws = random.uniform(-reach, reach, (_DRAWS, len(self.names)))
        places = np.linspace(-reach, reach, math.ceil(2.0 * reach / _APART))
        starts = [np.zeros(len(self.names)), min(draws, key=lambda r: self.badness(r, np.cumsum))]
        for r in starts:
            for name in _POSITIONS:
                if name in self.names:
                    moved = np.tile(r, (len(places), 1))
                    moved[:, self.names.index(name)] = places
                    r[:] = min(moved, key=self.badness)
        return starts

    def badness(self, r: Array, of: Callable[[Array], Array] = np.asarray) -> float:
        """Return how far model and records are apart, as they are or in a function of them."""
        return sum(
            float(np.sum(of(left) ** 2) / np.sum(of(record.force[::stride]) ** 2))
            for left, record, stride in zip(self.left(r), self.records, self.strides, strict=True)
        )


def _noise(left: Array, force: Array, fitted: int) -> float:
    """Return the noise of a force, given what is `left` after so many values are fitted [N]."""
    square = float(left @ left) + 1e-20 * float(force @ force)  # above zero
    variance, correlation = square / (len(left) - fitted), 0.0
    for lag in range(1, len(left) // 2):
        rho = float(left[lag:] @ left[:-lag]) / square
        if rho <= 0.0:
            break
        correlation += rho
    return math.sqrt(variance * (1.0 + 2.0 * correlation))


def _unseen_in(record: Record, history: CollisionHistory) -> dict[str, str]:
    """Return the parameters that one record does not show whatever its noise, with the reasons."""
    reasons: dict[str, str] = {}
    end = float(record.time[-1]) - record.first_touch
    blur = _blur(record)
    for spring, body in _SPRINGS.items():
        contact, turn, release = _phases(history, spring, end)
        if math.isinf(contact):
            reason = f"the {body} does not reach the pier in the record"
            reasons |= {f"{spring}.plateau_length": reason, f"{spring}.stiffness": reason}
        elif release - contact < record.resolution:
            reasons[f"{spring}.stiffness"] = (
                f"the {body} presses on the pier for {1e3 * (release - contact):.2g} ms, less than "
                f"{blur}: only its impulse shows"
            )
        if math.isinf(turn):
            reasons[f"{spring}.unloading_stiffness"] = (
                f"the {body}’s spring never unloads in the record"
            )
        elif release - turn < record.resolution:
            reasons[f"{spring}.unloading_stiffness"] = (
                f"the {body}’s spring unloads within {1e3 * (release - turn):.2g} ms, less than "
                f"{blur}"
            )
    return reasons


def _blur(record: Record) -> str:
    """Return in words what bounds the resolution of a record."""
    length = f"{1e3 * record.resolution:.3g} ms"
    if record.resolution == record.window:
        return f"the {length} of the moving average"
    if record.cutoff and record.resolution == 0.5 / record.cutoff:
        return f"the {length} of half a period at the filter’s {record.cutoff:g} Hz"
    return f"the {length} between every other sample"


def _phases(history: CollisionHistory, spring: str, end: float) -> tuple[float, float, float]:
    """Return when a body meets the pier, first turns and first leaves it [s].

    Infinite where it does not before the record's end.
    """
    contact = turn = release = math.inf
    limit = getattr(history.truck, spring).elastic_limit
    for state, _, _ in history.steps:
        line = state.engine if spring == "engine_spring" else state.body
        if state.time >= end:
            break
        if line.regime == STEEP:
            contact = min(contact, state.time)
        elif line.regime == ELASTIC and line.largest > limit:
            turn = min(turn, state.time)
        elif line.regime == FREE:
            release = min(release, state.time)
    return contact, turn, release


def _together(index: int, names: Sequence[str], covariance: Array) -> str:
    """Return in words what a parameter can hardly be told apart from, if there is anything."""
    errors = np.sqrt(np.diag(covariance))
    others = np.abs(covariance[index] / (errors[index] * errors))
    others[index] = 0.0
    closest = int(np.argmax(others))
    if others[closest] < _TOGETHER:
        return ""
    return f"; it can hardly be told apart from the {BY_KEY[names[closest]].meaning}"
