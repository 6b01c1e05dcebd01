"""What the commands say besides their output."""

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from typing import Any

from pierimpact.checks import shortened
from pierimpact.units import SYSTEMS


def system_of(text: str) -> str:
    """Return a system of units, however it is typed; another text as it is, for argparse."""
    return text.upper() if text.upper() in SYSTEMS else text


def complain(message: object) -> None:
    """Print a message as one line to the standard error stream, if anybody reads it."""
    line = " ".join(f"pierimpact: {message}".split())
    with suppress(OSError):  # nobody reads it
        print(line.encode("utf-8", "backslashreplace").decode(), file=sys.stderr, flush=True)


def defect(error: Exception) -> str:
    """Return what to say of an error that nobody foresaw."""
    return (
        f"{type(error).__name__}: {shortened(str(error), 300)}; this is a defect of the program: "
        "run it again with --debug"
    )


def needs(what: str, error: ModuleNotFoundError) -> int:
    """Say which package is missing for what, and return the exit code."""
    complain(f"{what} need {error.name}: pip install 'pierimpact[report]'")
    return 1


@contextmanager
def progress_bar(
    unit: str, total: int | None = None, **options: Any
) -> Iterator[Callable[[int], object]]:
    """Give the update of a progress bar on a terminal, where tqdm is installed."""
    try:
        from tqdm import tqdm
    except ModuleNotFoundError:
        yield lambda count: None
        return
    with tqdm(total=total, unit=f" {unit}", disable=None, **{"leave": False, **options}) as bar:
        yield bar.update


@contextmanager
def progress_bars() -> Iterator[Callable[[str, int], Callable[[int], object]]]:
    """Give what starts a bar with rate and time left, of a unit and its total, on a terminal."""
    with ExitStack() as bars:

        def start(unit: str, total: int) -> Callable[[int], object]:
            return bars.enter_context(progress_bar(unit, total, leave=True, smoothing=0.05))

        yield start
