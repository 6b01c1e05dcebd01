"""How often Python looks for garbage in a process of the package's own."""

import gc

_OBJECTS = 50_000  # numerical: new ones before any are looked through


def collect_seldom() -> None:
    """Look for garbage seldom: imports take a quarter longer if it is looked for as they go."""
    gc.set_threshold(_OBJECTS, *gc.get_threshold()[1:])
