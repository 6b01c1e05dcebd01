"""Collisions side by side: structures whose numbers are arrays of shape (n,), and parts of them."""

from collections.abc import Callable, Iterator
from typing import Any, TypeVar

import numpy as np

from pierimpact.collision.regimes import Collision

CHUNK = 2048  # collisions side by side: their arrays stay in the processor's cache

T = TypeVar("T", bound=tuple[Any, ...])


def take(group: T, part: Any) -> T:
    """Return the collisions at an index, a slice or a mask."""
    return _with_each(lambda item: item[part], group)


def join(first: T, second: T) -> T:
    """Return the collisions of both, those of `first` first."""
    return _with_each(lambda *items: np.concatenate(items), first, second)


def chunks(case: Collision) -> Iterator[Collision]:
    """Return collisions in order, CHUNK at a time."""
    for start in range(0, len(case.speed), CHUNK):
        yield take(case, slice(start, start + CHUNK))


def _with_each(change: Callable[..., Any], *groups: T) -> T:
    """Return the structure with a change made to each array and its counterparts."""
    changed = [
        _with_each(change, *items) if isinstance(items[0], tuple) else change(*items)
        for items in zip(*groups, strict=True)
    ]
    return type(groups[0])(*changed)
