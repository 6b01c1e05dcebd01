"""Scratch folders among the system's temporary files, gone with the process that made them."""

import os
import shutil
import sys
import tempfile
from contextlib import ExitStack, suppress
from pathlib import Path

from pierimpact.files.locks import held, is_held

_PREFIX = "pierimpact-"
_HELD = ".held-by-pierimpact"  # a file in each, held as long as the process that made it lives


class ScratchFolder(tempfile.TemporaryDirectory[str]):
    """A temporary folder; what killed processes have left of theirs is removed when it is made."""

    def __init__(self) -> None:
        super().__init__(prefix=_PREFIX, ignore_cleanup_errors=True)
        self.path = Path(self.name)
        self._stack = ExitStack()
        self._stack.enter_context(held(self.path / _HELD))
        remove_abandoned(self.path.parent)

    def cleanup(self) -> None:
        """Remove it."""
        self._stack.close()  # Windows removes no open file
        super().cleanup()


def remove_abandoned(folder: Path) -> None:
    """Remove the scratch folders in a folder whose process was killed, and no others."""
    owner = 0 if sys.platform == "win32" else os.geteuid()
    for file in folder.glob(f"{_PREFIX}*/{_HELD}"):
        with suppress(OSError):  # it may have gone meanwhile
            # What another user put there, a link or a device say, is not even opened.
            mine = file.lstat().st_uid == file.parent.lstat().st_uid == owner
            if mine and not is_held(file):
                shutil.rmtree(file.parent, ignore_errors=True)
