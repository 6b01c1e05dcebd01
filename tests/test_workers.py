"""The processes that share the work: order, losses, and a cluster that is none."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from dask_cluster import dask_cluster

from pierimpact.checks import InputError
from pierimpact.network import workers
from pierimpact.network.workers import LostWorkersError, worker_pool


def slow_square(number: int) -> tuple[int, int]:
    time.sleep(0.02 * (number % 3))  # so that results are ready in another order
    return number * number, os.getpid()


def end_once(task: tuple[str, int]) -> int:
    """End the process at the first call with a mark, whichever process that is."""
    folder, number = task
    mark = Path(folder, "ended")
    if number == 5 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def end_always(number: int) -> int:
    os._exit(number)


def threads(_: int) -> str | None:
    return os.environ.get("OMP_NUM_THREADS")


def fail(number: int) -> int:
    raise InputError(f"number must not be {number}")


def test_without_a_scheduler_processes_here_do_the_work_in_order(tmp_path: Path) -> None:
    said: list[str] = []
    read: list[int] = []

    def tasks() -> Iterator[int]:
        for number in range(20):
            read.append(number)
            yield number

    with worker_pool(workers=2, say=said.append) as run:
        results = run(slow_square, tasks())
        first = next(results)
        assert len(read) == 4  # two under way for each process, and no more
        found = [first, *results]
        assert [square for square, _ in found] == [number**2 for number in range(20)]
        assert os.getpid() not in {process for _, process in found}
        # A process that is lost costs nothing but time, and the pool serves again.
        lossy = [(str(tmp_path), number) for number in range(12)]
        assert list(run(end_once, lossy)) == list(range(12))
        assert (tmp_path / "ended").exists()
        assert set(run(threads, range(4))) == {"1"}
        with pytest.raises(InputError, match="number must not be 3"):
            list(run(fail, [3]))
        with pytest.raises(LostWorkersError, match="ended 3 times"):
            list(run(end_always, [1]))
    (line,) = said
    assert line == "2 processes do the work; --scheduler gives it to a Dask cluster"


def test_a_scheduler_needs_dask(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with (
        pytest.raises(InputError, match=r"scheduler tcp://h:1 needs Dask: pip install"),
        worker_pool(scheduler="tcp://h:1"),
    ):
        pass


def test_there_is_at_least_one_worker() -> None:
    with (
        pytest.raises(InputError, match="workers must be at least 1, got 0"),
        worker_pool(workers=0),
    ):
        pass


def test_a_scheduler_that_does_not_answer_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workers, "PATIENCE", 0.3)
    with (
        pytest.raises(InputError, match=r"^scheduler tcp://127.0.0.1:1 does not answer within"),
        worker_pool(scheduler="tcp://127.0.0.1:1"),
    ):
        pass


def test_on_a_cluster_a_worker_that_is_killed_loses_nothing(tmp_path: Path) -> None:
    said: list[str] = []
    with dask_cluster(tmp_path, 2) as (address, processes):
        with worker_pool(scheduler=address, say=said.append) as run:
            results = run(slow_square, range(60))
            found = [next(results) for _ in range(10)]
            processes[0].kill()
            found += results
        assert [square for square, _ in found] == [number**2 for number in range(60)]
        assert processes[1].poll() is None
        for process in processes[1:]:
            process.kill()
    assert said[0].startswith("Dask dashboard: http")


def test_local_processes_end_with_the_one_that_started_them(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(
        "import os, signal, sys\n"
        "sys.modules['distributed'] = None  # it is not needed here\n"
        "from pierimpact.network.workers import worker_pool\n"
        "from test_workers import slow_square\n"
        "if __name__ == '__main__':\n"
        "    with worker_pool(workers=1) as run:\n"
        "        for _, process in run(slow_square, range(99)):\n"
        "            print(process, flush=True)\n"
        "            os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    here = Path(__file__).parent
    paths = os.pathsep.join([str(here.parent), str(here)])
    ended = subprocess.run(
        [sys.executable, str(script)], env=os.environ | {"PYTHONPATH": paths}, capture_output=True
    )
    process = int(ended.stdout)
    for _ in range(100):
        try:
            os.kill(process, 0)
        except ProcessLookupError:
            return
        time.sleep(0.1)
    pytest.fail(f"process {process} is still there")
