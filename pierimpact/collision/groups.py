"""Many at a time: structures whose numbers are arrays of shape (n,), and parts of them."""

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

CHUNK = 8192  # collisions side by side: more gain nothing, and fewer lose by the calls of NumPy

T = TypeVar("T", bound=tuple[Any, ...])


def select(group: T, part: Any) -> T:
    """Return those at an index, a slice or a mask."""
    return _with_each(lambda item: item[part], group)


def single(group: T, index: int) -> T:
    """Return the one at an index, in floats."""
    return _with_each(lambda item: item[index].item(), group)


def replace(group: T, part: Any, new: T) -> T:
    """Return the same with others at an index or at many: one of floats, or those of arrays."""

    def replaced(item: Any, value: Any) -> Any:
        item = item.copy()
        item[part] = value
        return item

    return _with_each(replaced, group, new)


def repeat(group: T, size: int) -> T:
    """Return one of floats `size` times over."""
    return _with_each(lambda item: np.full(size, item), group)


def join(first: T, second: T) -> T:
    """Return those of both, in this order."""
    return _with_each(lambda *items: np.concatenate(items), first, second)


def _with_each(change: Callable[..., Any], *groups: T) -> T:
    """Return the structure with a change made to each array and its counterparts, not to None."""

    def changed(*items: Any) -> Any:
        if isinstance(items[0], tuple):
            return _with_each(change, *items)
        return None if items[0] is None else change(*items)

    return type(groups[0])(*map(changed, *groups))
