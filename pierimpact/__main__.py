"""The command `pierimpact`, and what lets `python -m pierimpact` stand for it."""

import sys
from importlib import import_module
from pathlib import Path


def main() -> int:
    """Run the command line and return its exit code, also when interrupted while it starts."""
    try:
        cli = import_module("pierimpact.cli")
    except KeyboardInterrupt:
        print("pierimpact: interrupted, nothing written", file=sys.stderr)
        return 130
    code: int = cli.main()
    return code


if __name__ == "__main__":
    # With -m, Python looks for modules in the folder at hand first, where some may lie beside a
    # case.
    if not sys.flags.safe_path:
        sys.path[:] = [path for path in sys.path if path not in ("", str(Path.cwd()))]
    sys.exit(main())
