"""The process of the report's kernel, as `kernel` starts it."""

import os
from importlib import import_module
from typing import Any

from ipykernel.kernelapp import IPKernelApp


class IsolatedKernel(IPKernelApp):
    """A kernel that reads no configuration and runs nothing before its notebook."""

    def load_config_file(self, *_: Any, **__: Any) -> None:
        """Read no configuration."""

    def init_path(self) -> None:
        """Leave the folder at hand out of those where modules are looked for."""

    def init_code(self) -> None:
        """Run no startup file."""


def start(folder: str) -> None:
    """Become a kernel that runs notebooks in a folder; return when it ends."""
    import_module("matplotlib")  # reads its settings, and there may be others in the folder
    os.chdir(folder)
    IsolatedKernel.launch_instance()
