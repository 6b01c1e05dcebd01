"""The process of the report's kernel, as `kernel` starts it."""

import gc
import logging
import os
import shutil
import time
from contextlib import suppress
from importlib import import_module
from threading import Thread
from typing import Any

from ipykernel.kernelapp import IPKernelApp
from IPython import get_ipython
from zmq import ZMQError

from pierimpact.garbage import collect_seldom

_PAUSE = 0.2  # this project's choice: how long a kernel may outlive its starter [s]


class IsolatedKernel(IPKernelApp):
    """A kernel that reads no configuration and runs nothing before its notebook."""

    def load_config_file(self, *_: Any, **__: Any) -> None:
        """Read no configuration."""

    def init_path(self) -> None:
        """Leave the folder at hand out of those where modules are looked for."""

    def init_poller(self) -> None:
        """Leave it to `_end_with` to watch the starter, where that is a process's parent."""
        if os.name == "nt":
            super().init_poller()  # type: ignore[no-untyped-call]

    def init_code(self) -> None:
        """Run no startup file."""


def start(private: str, starter: int) -> None:
    """Become a kernel that has imported what a report needs; return when it ends.

    Parameters
    ----------
    private : str
        Folder of the kernel's own, which is removed if the starter is killed.
    starter : int
        Identifier of the process that started this one, and that it ends with.
    """
    Thread(target=_end_with, args=(starter, private), daemon=True).start()
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # a home may be read-only
    collect_seldom()
    import_module("pierimpact.report.sheet")
    gc.freeze()  # what is imported stays
    with suppress(ZMQError):  # another process took a port first; another kernel will be started
        IsolatedKernel.launch_instance()


def enter(folder: str) -> None:
    """Forget what was run before, and enter a folder."""
    os.chdir(folder)
    get_ipython().reset()


def _end_with(starter: int, private: str) -> None:
    """End this process when its starter ends, be it before this begins to watch it."""
    while os.getppid() == starter:
        time.sleep(_PAUSE)
    if os.name != "nt":
        shutil.rmtree(private, ignore_errors=True)
        os._exit(1)
