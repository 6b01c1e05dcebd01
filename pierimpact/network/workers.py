"""The processes that share the work, here or on a Dask cluster; results come in order of the tasks.

What comes out does not depend on how many there are, nor on a worker that is lost: its tasks are
done again by another.
"""

import multiprocessing
import os
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from importlib import import_module
from itertools import islice
from threading import Thread
from typing import Any, Protocol, TypeVar

import numpy as np

import pierimpact
from pierimpact.checks import InputError, whole

Task = TypeVar("Task")
Result = TypeVar("Result")

#: How long a scheduler has to answer, and its first worker to report there [s].
PATIENCE = 10
# Tasks under way for each process: one at work and one waiting, so that none stands idle.
_UNDER_WAY = 2
# How often processes may be lost at the same work before it is to blame; Dask's too.
_MOST_LOSSES = 3
# What a process finds in its environment. One thread of the linear algebra will do: the processes
# share the cores. And glibc keeps the memory of arrays for the next ones: to return it takes as
# long as the collisions.
_ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "VECLIB_MAXIMUM_THREADS": "1",
    "MALLOC_MMAP_THRESHOLD_": str(32 * 1024**2),  # numerical [B]
    "MALLOC_TRIM_THRESHOLD_": str(512 * 1024**2),  # numerical [B]
}


class LostWorkersError(RuntimeError):
    """Processes end whatever is done, as they do where memory runs out."""


class Run(Protocol):
    """Does tasks side by side; given by `worker_pool`."""

    def __call__(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Iterator[Result]:
        """Yield the result of the function for each task, in the order of the tasks.

        Only a few tasks are under way at a time, so that `tasks` may be read as they are needed.
        Function, tasks and results must pickle; the function may be called more than once for a
        task, and so must do nothing but return a result.

        Parameters
        ----------
        function : callable
            A function of a module.
        tasks : iterable
            Its arguments, one each.

        Raises
        ------
        LostWorkersError
            When processes end whatever is done, or the scheduler does.
        """


@contextmanager
def worker_pool(
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    say: Callable[[str], object] = lambda line: None,
) -> Iterator[Run]:
    """Give what does tasks side by side, for as long as the context lasts.

    It is the Dask cluster of a scheduler, or else a pool of processes on this machine. A script
    that calls this must do so below ``if __name__ == "__main__"``, as these processes import it.

    Parameters
    ----------
    workers : int, optional
        Number of processes; one for each core unless given. Without effect with a scheduler.
    scheduler : str, optional
        Address of a Dask scheduler, such as "tcp://10.0.0.1:8786".
    say : callable, optional
        Called with what a user should know: who does the work, or where the dashboard is.

    Raises
    ------
    InputError
        When there is not at least one worker; when the scheduler does not answer within
        `PATIENCE`, or has no worker; when its workers have another pierimpact or none.
    """
    count = _cores() if workers is None else whole("workers", workers, 1)
    if scheduler is None:
        share = "1 process does" if count == 1 else f"{count} processes do"
        say(f"{share} the work; --scheduler gives it to a Dask cluster")
        processes = _LocalProcesses(count)
        try:
            yield processes
        finally:
            processes.close()
        return
    with _client(scheduler) as client:
        say(f"Dask dashboard: {client.dashboard_link}")

        def run(function: Callable[[Task], Result], tasks: Iterable[Task]) -> Iterator[Result]:
            return _on_cluster(client, function, tasks)

        yield run


def _cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class _LocalProcesses:
    """A pool of processes, which is started again where one of them is lost."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._pool: ProcessPoolExecutor | None = None

    def close(self) -> None:
        """End the processes; what is at work is waited for, and all else given up."""
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)
            self._pool = None

    def __call__(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Iterator[Result]:
        left, losses = iter(tasks), 0
        under_way: deque[tuple[Task, Future[Result] | None]] = deque()
        while True:
            under_way.extend(
                (task, None) for task in islice(left, _UNDER_WAY * self._count - len(under_way))
            )
            if not under_way:
                return
            try:
                for place, (task, future) in enumerate(under_way):
                    if future is None:
                        under_way[place] = task, self._submit(function, task)
                first = under_way[0][1]
                assert first is not None
                result = first.result()
            except BrokenProcessPool:
                losses += 1
                self.close()
                if losses == _MOST_LOSSES:
                    raise LostWorkersError(_lost(losses)) from None
                under_way = deque((task, None) for task, _ in under_way)
                continue
            losses = 0
            under_way.popleft()
            yield result

    def _submit(self, function: Callable[[Task], Result], task: Task) -> Future[Result]:
        if self._pool is None:
            context = multiprocessing.get_context("spawn")
            self._pool = ProcessPoolExecutor(self._count, context, _begin)
        with _environment():  # a process that this starts takes it from here
            return self._pool.submit(function, task)


@contextmanager
def _environment() -> Iterator[None]:
    """Give the processes that are started meanwhile their environment."""
    before = {name: os.environ.get(name) for name in _ENVIRONMENT}
    os.environ.update(_ENVIRONMENT)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _begin() -> None:
    """Begin a worker process: leave interrupts to its parent, and end with it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


@contextmanager
def _client(scheduler: str) -> Iterator[Any]:
    """Give the client of a Dask cluster that is ready."""
    try:
        distributed: Any = import_module("distributed")
    except ModuleNotFoundError:
        raise InputError(
            f"scheduler {scheduler} needs Dask: pip install 'pierimpact[network]'"
        ) from None
    try:
        client = distributed.Client(scheduler, timeout=PATIENCE)
    except Exception:  # of any kind, where another program answers
        raise InputError(
            f"scheduler {scheduler} does not answer within {PATIENCE} s as one of Dask does"
        ) from None
    with client:
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            raise InputError(
                f"scheduler {scheduler} has no worker after {PATIENCE} s: start one with "
                f"dask worker {scheduler}"
            ) from None
        _refuse_other_versions(client, scheduler)
        yield client


def _refuse_other_versions(client: Any, scheduler: str) -> None:
    """Refuse a cluster whose workers would not come to the same results."""
    here = _version()
    try:
        others = set(client.run(_version).values()) - {here}
    except ModuleNotFoundError as error:
        raise InputError(f"the workers of scheduler {scheduler} have no {error.name}") from None
    if others:
        raise InputError(
            f"the workers of scheduler {scheduler} have {sorted(others)[0]}, here is {here}"
        )


def _version() -> str:
    """Return what the digits of a result depend on."""
    return f"pierimpact {pierimpact.__version__} with NumPy {np.__version__}"


def _on_cluster(
    client: Any, function: Callable[[Task], Result], tasks: Iterable[Task]
) -> Iterator[Result]:
    from distributed import CancelledError, KilledWorker

    left, under_way = iter(tasks), deque[Any]()
    while True:
        most = _UNDER_WAY * max(sum(client.nthreads().values()), 1)
        for task in islice(left, max(most - len(under_way), 0)):
            under_way.append(client.submit(function, task, pure=False))
        if not under_way:
            return
        try:
            result = under_way.popleft().result()
        except KilledWorker:
            raise LostWorkersError(_lost(_MOST_LOSSES)) from None
        except CancelledError:
            raise LostWorkersError("the scheduler is gone") from None
        yield result


def _lost(times: int) -> str:
    return f"a worker process ended {times} times at the same work: out of memory?"
