"""What the commands say besides their output."""

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress


def complain(message: object) -> None:
    """Print a message to the standard error stream."""
    if sys.stderr:
        with suppress(OSError):  # nobody reads it
            print(f"pierimpact: {message}", file=sys.stderr)


def needs(what: str, error: ModuleNotFoundError) -> int:
    """Say which package is missing for what, and return the exit code."""
    complain(f"{what} need {error.name}: pip install 'pierimpact[report]'")
    return 1


@contextmanager
def progress_bar(unit: str) -> Iterator[Callable[[int], object]]:
    """Give the update of a progress bar on a terminal, where tqdm is installed."""
    try:
        from tqdm import tqdm
    except ModuleNotFoundError:
        yield lambda count: None
        return
    with tqdm(unit=f" {unit}", disable=None, leave=False) as bar:
        yield bar.update


@contextmanager
def progress_bars() -> Iterator[Callable[[str, int], Callable[[int], object]]]:
    """Give what starts a bar with rate and time left, of a unit and its total, on a terminal."""
    from tqdm import tqdm

    with ExitStack() as bars:

        def start(unit: str, total: int) -> Callable[[int], object]:
            bar = tqdm(total=total, unit=f" {unit}", disable=None, smoothing=0.05)
            return bars.enter_context(bar).update

        yield start
