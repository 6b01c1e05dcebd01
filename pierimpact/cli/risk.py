"""The command `risk`."""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pierimpact.checks import InputError, whole
from pierimpact.cli.network import add_workers
from pierimpact.cli.terminal import complain, needs, progress_bar

_RISK = """\
Say how often a year a truck of the traffic strikes the pier of a case, and how often the reaction
exceeds a value: trucks leave the road, brake and strike as in the JCSS Probabilistic Model Code,
each collision by the full model. The case must give traffic_volume, truck_share and
distance_from_road; `pierimpact new` writes all keys of the traffic with what they mean. With
--output, a page and the curve as CSV are written, NAME-risk.html and NAME-risk.csv, unless somebody
changed those that are there.
"""
_EXIT_CODES = """\
Exit code: 0, whatever the risk; 2 if the input is bad; 1 if anything failed. The same seed gives
the same trucks, for any pier and any number of workers.
"""
# Of fewer draws the bands hold less than they say where a rate is small: at 10⁻⁵ a year 92 of 100
# bands of 300 draws held the frequency, 81 of those of 100, and of 1,000 as many as they should.
_FEWEST = 1000
# Below so many blocks processes of their own take longer to begin than they save.
_WORTH_IT = 4


def add_risk(commands: Any) -> None:
    """Add the command to the parser's."""
    risk = commands.add_parser(
        "risk",
        help="say how often a reaction is exceeded, from the traffic beside a pier",
        description=_RISK,
        epilog=_EXIT_CODES,
        allow_abbrev=False,
    )
    risk.add_argument("case", metavar="CASE.yaml", help="case file with the keys of the traffic")
    options: dict[str, dict[str, Any]] = {
        "samples": {
            "metavar": "N",
            "type": int,
            "help": "trucks to draw, 1000 or more (default: 32768)",
        },
        "seed": {"metavar": "S", "type": int, "default": 0, "help": "seed (default: 0)"},
        "output": {"metavar": "DIR", "help": "folder to write the page and the curve to"},
    }
    for name, option in options.items():
        risk.add_argument(f"--{name}", **option)
    add_workers(risk)
    risk.add_argument(
        "--force", action="store_true", help="replace files that somebody changed, too"
    )
    risk.add_argument("--json", action="store_true", help="print a JSON object, in SI units")
    risk.set_defaults(run=_risk)


def _risk(options: argparse.Namespace) -> int:
    try:
        from pierimpact.files.case import read_case_file
        from pierimpact.network.workers import LostWorkersError
        from pierimpact.report.risk import case_risk, missing_traffic, risk_json, risk_text
        from pierimpact.risk.analysis import SIZE
    except ModuleNotFoundError as error:
        return needs("risks", error)
    path = Path(options.case)
    size = SIZE if options.samples is None else whole("--samples", options.samples, _FEWEST)
    seed = whole("--seed", options.seed, 0)
    case = read_case_file(path).case
    if case.traffic is None:
        raise InputError(f"{path.name}: {missing_traffic(case)}")
    output = Path(options.output) if options.output else None
    if output and output.exists() and not output.is_dir():  # before the work, not after it
        raise InputError(f"output {output} must be a folder, and there is a file")
    if output:
        from pierimpact.files.unchanged import refuse_changed
        from pierimpact.report.risk_page import risk_files, write_risk

        refuse_changed(output, risk_files(path.stem), force=options.force)
    try:
        with _run(options, size) as run, progress_bar("collisions", size) as progress:
            result = case_risk(case, size, seed, run=run, progress=progress)
    except LostWorkersError as error:
        complain(f"{error}; nothing is written")
        return 1
    files: list[Path] = []
    if output:
        files = write_risk(path.stem, result, output, force=options.force)
    print((risk_json if options.json else risk_text)(str(path), result))
    if not options.json:
        print(*files, sep="\n")
    return 0


@contextmanager
def _run(options: argparse.Namespace, size: int) -> Iterator[Any]:
    """Give what calculates the blocks."""
    from pierimpact.risk.analysis import in_turn
    from pierimpact.risk.sampling import BLOCK

    workers = None if options.workers is None else whole("--workers", options.workers, 1)
    if options.scheduler is None and (
        workers == 1 or (workers is None and size <= _WORTH_IT * BLOCK)
    ):
        yield in_turn
        return
    from pierimpact.network.workers import worker_pool

    with worker_pool(workers=workers, scheduler=options.scheduler, say=complain) as run:
        yield run
