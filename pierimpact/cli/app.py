"""The command `app`: the form."""

import argparse
from typing import Any

from pierimpact.cli.terminal import complain

_APP = """\
Open a page in the browser on which a case is described in a form and seen as it is typed: the
drawing, the verdict and the results. There it can be saved as a case file, and its report as PDF,
HTML and Word. The page is for this machine only, until Ctrl-C ends it; nothing is written but what
the browser downloads.
"""
_EXIT_CODES = "Exit code: 0; 2 if the case file cannot be read; 1 if anything else failed."


def add_app(commands: Any) -> None:
    """Add the command `app` to the parser's."""
    app = commands.add_parser(
        "app", help="describe a case in a form", description=_APP, epilog=_EXIT_CODES
    )
    app.add_argument(
        "case", metavar="CASE.yaml", nargs="?", help="case file to begin with (default: an example)"
    )
    app.add_argument(
        "--no-browser", dest="browser", action="store_false", help="do not open a browser"
    )
    app.set_defaults(run=_app)


def _app(options: argparse.Namespace) -> int:
    try:
        from pierimpact.app.launch import open_form

        open_form(options.case, browser=options.browser)
    except ModuleNotFoundError as error:
        complain(f"the form needs {error.name}: python -m pip install 'pierimpact[teach]'")
        return 1
    return 0
