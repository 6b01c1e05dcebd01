"""The process of the report's kernel, as `kernel` starts it."""

import os
from importlib import import_module
from typing import Any

from ipykernel.kernelapp import IPKernelApp
from IPython import get_ipython


class IsolatedKernel(IPKernelApp):
    """A kernel that reads no configuration and runs nothing before its notebook."""

    def load_config_file(self, *_: Any, **__: Any) -> None:
        """Read no configuration."""

    def init_path(self) -> None:
        """Leave the folder at hand out of those where modules are looked for."""

    def init_code(self) -> None:
        """Run no startup file."""


def start() -> None:
    """Become a kernel that has imported what a report needs; return when it ends."""
    import_module("pierimpact.report.sheet")
    IsolatedKernel.launch_instance()


def enter(folder: str) -> None:
    """Forget what was run before, and enter a folder."""
    os.chdir(folder)
    get_ipython().reset()
