"""The command line: where it starts, and what becomes of errors.

Nothing is imported before `main` can catch an interrupt: the commands are in `commands`.
"""

import sys
from collections.abc import Sequence


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 2 for bad input, 1 for any other failure."""
    try:
        from pierimpact.garbage import collect_seldom

        collect_seldom()
        from pierimpact.cli.commands import run

        return run(arguments)
    except KeyboardInterrupt as interrupt:
        print(f"pierimpact: interrupted, {str(interrupt) or 'nothing written'}", file=sys.stderr)
        return 130
