"""Lets `python -m pierimpact` stand for `pierimpact`."""

import sys
from importlib import import_module
from pathlib import Path

# With -m, Python looks for modules in the folder at hand first, where some may lie beside a case.
if not sys.flags.safe_path:
    sys.path[:] = [path for path in sys.path if path not in ("", str(Path.cwd()))]

sys.exit(import_module("pierimpact.cli").main())
