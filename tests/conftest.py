"""Settings of all tests, and their order."""

import os

from hypothesis import settings

# The workers share the cores: threads of their own for small matrices only wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# The same examples every time, so that a run can be repeated, and as slow as the machine is.
settings.register_profile("pierimpact", deadline=None, derandomize=True)
settings.load_profile("pierimpact")

# They start first, so that no worker is left alone with one of them at the end.
SLOWEST = ("test_browser", "test_notebooks", "test_batch", "test_report", "test_by_hand")


def pytest_collection_modifyitems(items):
    """Move the slowest modules to the front."""
    places = {name: place for place, name in enumerate(SLOWEST)}
    items.sort(key=lambda item: places.get(item.path.stem, len(places)))
