"""Writes sets of files over and over until it is killed; run by the tests of writing."""

import signal
import sys
from pathlib import Path

from pierimpact.cli.ending import signals_as_interrupts
from pierimpact.files.unchanged import put_unchanged
from pierimpact.files.write import temporary_folder

NAMES = ("a.ipynb", "a.html", "a.pdf")


def write_forever(folder, who):
    """Write sets of files that say which set they are of."""
    number = 0
    while True:
        number += 1
        with temporary_folder(folder) as temporary:
            files = [temporary / name for name in NAMES]
            for file in files:
                file.write_bytes(f"{who} {number}\n".encode() * 20_000)
            put_unchanged(files, folder)
        print(number, flush=True)


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # even where tests run behind a shell
    with signals_as_interrupts():
        write_forever(Path(sys.argv[1]), sys.argv[2])
