"""The commands for teaching: `teach`, `collect` and `page`."""

import argparse
from pathlib import Path
from typing import Any

from pierimpact.cli.terminal import complain, needs
from pierimpact.files.unchanged import write_unchanged
from pierimpact.teaching.launch import DEFAULT_FOLDER, TeachError, open_notebooks

_COLLECT = """\
Read the answer files (*.answers.json) that the teaching notebooks write, from a folder and all
folders below it, check the answers again, and write a table with a row a student: name or number,
right answers in total, and for each question whether it is right and after how many tries. A table
that is there already is replaced, unless somebody changed it.
"""
_COLLECT_EXIT_CODES = "Exit code: 0 if any file was read; 2 if none was; 1 if anything failed."
_PAGE = """\
Write one HTML file that shows what the pier's frequency does to the peaks of engine and cargo. It
solves the collisions itself and needs neither Python nor a network. A page that is there already is
replaced, unless somebody changed it.
"""


def add_teach(commands: Any) -> None:
    """Add the command `teach` to the parser's."""
    teach = commands.add_parser(
        "teach",
        help="open the teaching notebooks",
        description="Copy the teaching notebooks to your own folder and open them in JupyterLab, "
        "for this machine only, until Ctrl-C ends it.",
    )
    teach.add_argument(
        "--app", action="store_true", help="serve the explorer alone, as a page without code"
    )
    teach.add_argument(
        "--folder",
        metavar="DIR",
        default=DEFAULT_FOLDER,
        help="folder for your copies; files already in it are kept (default: %(default)s)",
    )
    teach.add_argument(
        "--no-browser", dest="browser", action="store_false", help="do not open a browser"
    )
    teach.add_argument(
        "--answers",
        metavar="NAME",
        help="print the teacher's sheet instead: times, misconceptions, and worked answers with "
        'the numbers of the student of this name or number; "" for those who gave none',
    )
    teach.set_defaults(run=_teach)


def add_collect(commands: Any) -> None:
    """Add the command `collect` to the parser's."""
    collect = commands.add_parser(
        "collect",
        help="collect the marks of a class in one table",
        description=_COLLECT,
        epilog=_COLLECT_EXIT_CODES,
        allow_abbrev=False,
    )
    collect.add_argument("folder", metavar="FOLDER", help="folder with the students' answer files")
    collect.add_argument(
        "--csv",
        metavar="FILE",
        default="marks.csv",
        help="table to write (default: %(default)s)",
    )
    collect.add_argument(
        "--force", action="store_true", help="replace a table that somebody changed"
    )
    collect.set_defaults(run=_collect)


def add_page(commands: Any) -> None:
    """Add the command `page` to the parser's."""
    page = commands.add_parser(
        "page", help="write the explorer as one HTML file", description=_PAGE
    )
    page.add_argument("page", metavar="PAGE.html", help="file to write")
    page.add_argument(
        "--truck",
        dest="trucks",
        metavar="TRUCK",
        nargs="+",
        default=["single-unit-8t"],
        help="trucks to choose from: names of the catalogue or truck files (default: "
        "single-unit-8t)",
    )
    page.add_argument("--force", action="store_true", help="replace a file that somebody changed")
    page.set_defaults(run=_page)


def _teach(options: argparse.Namespace) -> int:
    if options.answers is not None:
        from pierimpact.teaching.teacher import teachers_sheet

        print(teachers_sheet(options.answers), end="")
        return 0
    try:
        open_notebooks(options.folder, app=options.app, browser=options.browser)
    except TeachError as error:
        complain(error)
        return 1
    return 0


def _collect(options: argparse.Namespace) -> int:
    from pierimpact.teaching.marks import collect

    marks, table = collect(options.folder), Path(options.csv)
    write_unchanged({table.name: marks.table.encode()}, table.parent, force=options.force)
    print(f"{options.csv}: students {marks.students}, files read {marks.files}", flush=True)
    for remark in marks.remarks:
        complain(remark)
    return 0


def _page(options: argparse.Namespace) -> int:
    try:
        from pierimpact.teaching.page import write_page
    except ModuleNotFoundError as error:
        return needs("pages", error)
    print(write_page(options.page, options.trucks, force=options.force))
    return 0
