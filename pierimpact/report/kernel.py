"""The report's kernel, which nothing beside a case file and nothing of the user's reaches.

It starts in Python's isolated mode and in an empty folder of its own, looks for modules where this
process does, but for the case's folder, and reads no configuration, profile or startup file of
Jupyter, IPython and matplotlib. Then it enters the case's folder, from which relative paths start.
"""

import os
import sys
import tempfile
from pathlib import Path
from typing import Any

from ipykernel.kernelspec import get_kernel_dict
from jupyter_client.kernelspec import KernelSpec
from jupyter_client.manager import AsyncKernelManager

from pierimpact.resources import PACKAGE

#: How the names of environment variables begin that would reach Python or its libraries.
_OF_THE_USER = ("PYTHON", "IPYTHON", "JUPYTER", "JPY_", "MPLBACKEND", "MATPLOTLIB")

# This very package comes from where it is, and nothing else from the folder that it is in.
_START = """\
import sys
sys.path[:] = {paths}
from importlib.machinery import PathFinder
from importlib.util import module_from_spec
spec = PathFinder.find_spec("pierimpact", [{home}])
sys.modules["pierimpact"] = module_from_spec(spec)
spec.loader.exec_module(sys.modules["pierimpact"])
from pierimpact.report.kernel_process import start
start({folder}, {private}, {starter})
"""


class IsolatedKernelManager(AsyncKernelManager):
    """Starts isolated kernels, whatever kernels there are of a name."""

    async def start_kernel(self, *, cwd: str, **options: Any) -> None:  # type: ignore[override]
        """Start a kernel that enters the folder `cwd` once it has begun."""
        self._private = tempfile.TemporaryDirectory(
            prefix="pierimpact-kernel-", ignore_cleanup_errors=True
        )
        private = Path(self._private.name)
        self.connection_file = str(private / "connection.json")
        (private / "matplotlibrc").touch()  # the first that is looked for
        code = _START.format(
            paths=_literal(_module_paths(Path(cwd))),
            home=_literal(str(PACKAGE.parent)),
            folder=_literal(cwd),
            private=_literal(str(private)),
            starter=os.getpid(),
        )
        command = [sys.executable, "-I", "-c", code, "-f", "{connection_file}"]
        self._kernel_spec = KernelSpec(**(get_kernel_dict() | {"argv": command}))
        await super().start_kernel(cwd=str(private), env=_environment(private), **options)

    async def cleanup_resources(self, restart: bool = False) -> None:  # type: ignore[override]
        """Remove the kernel's own folder too."""
        await super().cleanup_resources(restart)
        if not restart:
            self._private.cleanup()


def _module_paths(case_folder: Path) -> list[str]:
    """Return where this process looks for modules, without the case's folder."""
    case_folder = case_folder.resolve()
    paths = map(os.path.abspath, sys.path)
    return [path for path in paths if Path(path).resolve() != case_folder]


def _literal(value: str | list[str]) -> str:
    """Return a value in Python, in ASCII and without braces, which Jupyter would fill in."""
    return ascii(value).replace("{", r"\x7b")


def _environment(private: Path) -> dict[str, str]:
    """Return the environment of a kernel with a folder of its own."""
    own = ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR")
    kept = {key: text for key, text in os.environ.items() if not key.startswith(_OF_THE_USER)}
    return kept | dict.fromkeys(own, str(private)) | {"MPLBACKEND": "agg"}
