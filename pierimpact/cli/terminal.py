"""What the commands say besides their output."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager


def complain(message: object) -> None:
    """Print a message to the standard error stream."""
    print(f"pierimpact: {message}", file=sys.stderr)


def needs(what: str, error: ModuleNotFoundError) -> int:
    """Say which package is missing for what, and return the exit code."""
    complain(f"{what} need {error.name}: pip install 'pierimpact[report]'")
    return 1


@contextmanager
def progress_bar(unit: str, total: int | None = None) -> Iterator[Callable[[int], object]]:
    """Give the update of a progress bar on a terminal, where tqdm is installed."""
    try:
        from tqdm import tqdm
    except ModuleNotFoundError:
        yield lambda count: None
        return
    with tqdm(total=total, unit=f" {unit}", disable=None, leave=False) as bar:
        yield bar.update
