"""From first touch to the end of a collision, of one or of many side by side.

Each turn coasts as far as it can (`coasting`), then takes a step (`stepping`). Side by side, those
with a stiff pier pass over its cycles (`pairs`); a collision that stays in one regime for long is
looked at by itself (`ringing`).
"""

import math
import warnings
from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.coasting import coast
from pierimpact.collision.groups import CHUNK, join, replace, select, single
from pierimpact.collision.pairs import are_pairs, pass_cycles
from pierimpact.collision.parameters import Parameters
from pierimpact.collision.regimes import LinearMotion, State, linear_motion, start
from pierimpact.collision.ringing import ring
from pierimpact.collision.series import ARRAYS, FLOATS, Flag, Ops, Real
from pierimpact.collision.stepping import advance, finished

# Numerical settings.
STEPS = 200_000  # limit; no collision of the studied domain takes a thousandth of it
TOGETHER = 2_000  # of them side by side; one that takes more goes on alone
LONGER = 100_000  # as many more where a longer history is asked for
SHOWN = 10  # indices in a warning
CYCLES = 2  # steps in one regime from one look for cycles to pass over to the next
PATIENCE, AGAIN = 96, 16  # steps in one regime before it is looked at by itself, and again

Record: TypeAlias = Callable[[State, LinearMotion, float], None]


def propagate(
    parameters: Parameters,
    duration: float = 0.0,
    record: Record = lambda state, motion, h: None,
) -> State:
    """Return the last state of one collision, in which nothing more can happen.

    It is propagated for `duration` at least [s]. After each step `record` is called with the state
    it started from, its equations of motion and its length [s].

    Raises
    ------
    RuntimeError
        When the collision does not come to an end.
    """
    end = _follow(parameters, start(parameters, FLOATS), STEPS, duration, record)
    if end is None:
        raise RuntimeError(f"the collision did not come to an end in {STEPS:,} steps")
    return end


def _follow(
    parameters: Parameters,
    state: State,
    steps: int,
    duration: float = 0.0,
    record: Record = lambda state, motion, h: None,
) -> State | None:
    """Return the last state of one collision that is now in a state; None if so many are too few.

    Duration and record as in `propagate`.
    """
    since, ended = 0, False
    for step in range(steps + LONGER):
        motion = linear_motion(parameters, state, FLOATS)
        since = 0 if state.last_change == state.time else since + 1
        if since >= PATIENCE and since % AGAIN == 0:
            new, h = ring(parameters, state, motion)
            record(state, motion, h)
            state = new
        new, h = coast(parameters, state, motion, FLOATS)
        record(state, motion, h)
        state, h = advance(parameters, new, motion, FLOATS)
        record(new, motion, h)
        ended = finished(parameters, state, FLOATS)
        if ended and state.time >= duration:
            return state
        if not ended and step >= steps - 1:
            return None
    return None


class UnfinishedWarning(UserWarning):
    """Collisions did not come to an end; their results are nan."""


class Outcomes(NamedTuple):
    """Peaks of R/k_p with their times, times of the first contacts, and yielding, by collision.

    All are nan where a collision did not come to an end.
    """

    engine_peak: NDArray[np.float64]
    cargo_peak: NDArray[np.float64]
    engine_peak_time: NDArray[np.float64]
    cargo_peak_time: NDArray[np.float64]
    engine_contact: NDArray[np.float64]
    cargo_contact: NDArray[np.float64]
    largest: NDArray[np.float64]  # as in `Yielding`; zero where no pier can yield
    displacement: NDArray[np.float64]
    path: NDArray[np.float64]


def outcomes_of(state: State, ops: Ops) -> Outcomes:
    """Return what the states of collisions hold of their outcomes."""
    yielding = state.yielding
    largest = displacement = path = 0.0 * state.time
    if yielding is not None:
        more = yielding.beyond(state.position.xp, ops)
        largest = yielding.largest
        displacement, path = yielding.displacement + more, yielding.path + abs(more)
    return Outcomes(
        engine_peak=state.engine_peak,
        cargo_peak=state.cargo_peak,
        engine_peak_time=state.engine_peak_time,
        cargo_peak_time=state.cargo_peak_time,
        engine_contact=state.engine_contact,
        cargo_contact=state.cargo_contact,
        largest=largest,
        displacement=displacement,
        path=path,
    )


class Running(NamedTuple):
    """Collisions being propagated, side by side."""

    parameters: Parameters
    state: State
    column: NDArray[np.int_]  # among the outcomes
    steps: NDArray[np.int_]  # taken so far
    since: NDArray[np.int_]  # of them since the last change


class Recorder(Protocol):
    """Takes down what happens in the collisions that advance side by side."""

    def step(
        self, running: Running, motion: LinearMotion, after: State, h: Real, goes_on: Flag
    ) -> None:
        """Take down a step of length `h` [s] that ends in the states `after`, where one goes on."""

    def pass_over(self, column: NDArray[np.int_]) -> None:
        """Note collisions of which some time is passed over."""


def propagate_all(
    chunks: Iterable[Parameters],
    shape: tuple[int, ...],
    initial_state: Callable[[Parameters, Ops], State] = start,
    progress: Callable[[int], object] = lambda count: None,
    recorder: Recorder | None = None,
) -> Outcomes:
    """Propagate collisions side by side until nothing more can happen in any.

    Finished collisions make room for the next chunk, so that the arrays neither grow with the
    number of collisions nor run almost empty.

    Parameters
    ----------
    chunks : iterable of Parameters
        Some collisions at a time, in all as many as the `shape` has places.
    shape : tuple of int
        Shape of the outcomes.
    initial_state : callable, optional
        From collisions to the states they start from; first touch unless another is given.
    progress : callable, optional
        Called with the number of collisions done since the last call.
    recorder : Recorder, optional
        Told of every step.

    Warns
    -----
    UnfinishedWarning
        When a collision does not come to an end; the others do not suffer.
    """
    outcomes = np.full((len(Outcomes._fields), math.prod(shape)), math.nan)
    unfinished: list[int] = []
    waiting = _running(chunks, initial_state)
    running = next(waiting, None)
    while running and len(running.column):
        parameters, state, column, steps, since = running
        done = np.zeros(len(column), dtype=bool)
        # Removing collisions costs about as much as a step: wait until a fifth of them is done.
        while 5 * np.count_nonzero(done) <= len(done) and not done.all():
            motion = linear_motion(parameters, state, ARRAYS)
            since = np.where(state.last_change == state.time, 0, since + 1)
            if since.max() >= PATIENCE:
                patient = np.flatnonzero((since >= PATIENCE) & (since % AGAIN == 0) & ~done)
                state = _ring(parameters, state, motion, patient)
                if recorder:
                    recorder.pass_over(column[patient])
            if recorder is None:  # such steps are not taken down
                look = are_pairs(state, motion) & (since % CYCLES == 1) & ~done
                state = _pass_cycles(parameters, state, motion, np.flatnonzero(look))
            for move in (coast, advance):
                after, h = move(parameters, state, motion, ARRAYS)
                if recorder:
                    now = Running(parameters, state, column, steps, since)
                    recorder.step(now, motion, after, h, ~done)
                state = after
            steps = steps + 1
            ends = finished(parameters, state, ARRAYS) & ~done
            if ends.any():  # what comes later depends on when it is removed
                outcomes[:, column[ends]] = select(outcomes_of(state, ARRAYS), ends)
                done |= ends
            late = np.flatnonzero((steps >= min(TOGETHER, STEPS)) & ~done)
            for i in late.tolist():
                end = _follow(single(parameters, i), single(state, i), STEPS - TOGETHER)
                if end is None:
                    unfinished.append(int(column[i]))
                else:
                    outcomes[:, column[i]] = outcomes_of(end, FLOATS)
            done[late] = True
            if recorder and len(late):
                recorder.pass_over(column[late])
        progress(int(np.count_nonzero(done)))
        running = select(Running(parameters, state, column, steps, since), ~done)
        if 2 * len(running.column) < CHUNK:
            more = next(waiting, None)
            running = join(running, more) if more else running
    if unfinished:
        warnings.warn(_of_unfinished(unfinished, shape), UnfinishedWarning, stacklevel=3)
    return Outcomes(*outcomes.reshape(len(outcomes), *shape))


def _of_unfinished(columns: list[int], shape: tuple[int, ...]) -> str:
    places = [np.unravel_index(column, shape) for column in sorted(columns)]
    named = [", ".join(map(str, place)) for place in places]
    named = [f"({place})" if len(shape) > 1 else place for place in named]
    more = f" and {len(named) - SHOWN} more" if len(named) > SHOWN else ""
    where = f"at index {', '.join(named[:SHOWN])}{more} " if shape else ""
    return f"collision {where}did not come to an end in {STEPS:,} steps: its results are nan"


def _running(
    chunks: Iterable[Parameters], initial_state: Callable[[Parameters, Ops], State]
) -> Iterator[Running]:
    first = 0
    for parameters in chunks:
        column = np.arange(first, first + len(parameters.speed))
        first += len(column)
        none = 0 * column
        yield Running(parameters, initial_state(parameters, ARRAYS), column, none, none)


def _ring(
    parameters: Parameters, state: State, motion: LinearMotion, indices: NDArray[np.int_]
) -> State:
    """Return the states once those at some indices have rung."""
    for i in indices.tolist():
        new, h = ring(single(parameters, i), single(state, i), single(motion, i))
        state = replace(state, i, new) if h else state
    return state


def _pass_cycles(
    parameters: Parameters, state: State, motion: LinearMotion, indices: NDArray[np.int_]
) -> State:
    """Return the states once the pairs at some indices have passed the cycles that they can."""
    if not len(indices):
        return state
    new = pass_cycles(select(parameters, indices), select(state, indices), select(motion, indices))
    return replace(state, indices, new)
