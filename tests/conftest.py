"""Settings of all tests."""

from hypothesis import settings

# The same examples every time, so that a run can be repeated, and as slow as the machine is.
settings.register_profile("pierimpact", deadline=None, derandomize=True)
settings.load_profile("pierimpact")
