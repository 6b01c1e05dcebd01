"""The kernels of reports, which nothing beside a case file and nothing of the user's reaches.

A kernel starts while this process still imports what executes notebooks in it, imports what they
need, and serves one case after the other. It starts in Python's isolated mode and in an empty
folder of its own, looks for modules where this process does, but for the folders of the cases, and
reads no configuration, profile or startup file of Jupyter, IPython and matplotlib. Then it enters
the case's folder, from which relative paths start.
"""

import os
import sys
from collections.abc import Awaitable, Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from queue import Empty
from typing import Any, Self

from ipykernel.kernelspec import get_kernel_dict
from jupyter_client.asynchronous.client import AsyncKernelClient
from jupyter_client.kernelspec import KernelSpec
from jupyter_client.manager import AsyncKernelManager
from jupyter_core.utils import run_sync
from traitlets.config import Config

from pierimpact.files.scratch import ScratchFolder
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
start({private}, {starter})
"""
_ENTER = "from pierimpact.report.kernel_process import enter; enter({folder})"
# An error in a cell is in its output; the interrupt that ends the kernel is none. The notebook is
# the history of what was run, and what it returned: there is no other.
_ARGUMENTS = [
    "--log-level=CRITICAL",
    "--HistoryManager.enabled=False",
    "--InteractiveShell.cache_size=0",
]
# A report's matrices are small: threads would only wait for each other, and for those of another.
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")
_PATIENCE = 300  # with a kernel that lives and does not answer, as on a busy machine [s]


class Kernels:
    """Kernels for reports side by side, ended with the block that they are made for.

    Parameters
    ----------
    cases : iterable of Path
        Case files, with absolute paths.
    ahead : int, optional
        How many to start at once.
    """

    def __init__(self, cases: Iterable[Path], ahead: int = 1) -> None:
        self._folders = {case.parent.resolve() for case in cases}
        self._all: list[IsolatedKernelManager] = []
        self._free = [self._start() for _ in range(ahead)]

    def __enter__(self) -> Self:
        """Return the kernels."""
        return self

    def __exit__(self, *_: object) -> None:
        """End them all."""
        for kernel in self._all:
            self._end(kernel)

    @contextmanager
    def in_folder(self, folder: Path) -> Iterator[AsyncKernelManager]:
        """Give a kernel that is in a folder and knows of no notebook before; it has none ended."""
        kernel = self._free.pop() if self._free else self._start()
        try:
            run_sync(kernel.enter)(folder)
            yield kernel
        except BaseException:
            self._end(kernel)
            raise
        finally:
            kernel.disconnect()
        self._free.append(kernel)

    def _start(self) -> "IsolatedKernelManager":
        # Or else the kernel prints a warning.
        config = Config(KernelManager={"transport_encryption": "auto"})
        kernel = IsolatedKernelManager(config=config)
        run_sync(kernel.start_kernel)(folders=self._folders, extra_arguments=_ARGUMENTS)
        self._all.append(kernel)
        return kernel

    @staticmethod
    def _end(kernel: "IsolatedKernelManager") -> None:
        if kernel.has_kernel:
            run_sync(kernel.kill)()  # it has nothing to save
        run_sync(kernel.cleanup_resources)()


class _Client(AsyncKernelClient):
    """A client of a kernel that has answered before."""

    async def wait_for_ready(self, timeout: float | None = None) -> None:
        """Wait until what the kernel prints comes here, and not for its silence as others do.

        Raises
        ------
        RuntimeError
            When nothing comes.
        """

        async def printed(timeout: float) -> None:
            self.kernel_info()  # of which something comes, unless it came before this listened
            await self.get_iopub_msg(timeout=timeout)

        await _answered(printed, self.is_alive)


async def _answered(
    message: Callable[..., Awaitable[object]], is_alive: Callable[[], Awaitable[bool]]
) -> None:
    """Wait for a message of a kernel, which may take long to start.

    Raises
    ------
    RuntimeError
        When it does not come.
    """
    for _ in range(_PATIENCE):
        with suppress(Empty):
            await message(timeout=1.0)
            return
        if not await is_alive():
            break
    raise RuntimeError("the kernel did not start")


class IsolatedKernelManager(AsyncKernelManager):
    """Starts isolated kernels, whatever kernels there are of a name."""

    def __init__(self, **options: Any) -> None:
        super().__init__(client_class=f"{__name__}.{_Client.__name__}", **options)
        self._clients: list[Any] = []

    async def start_kernel(  # type: ignore[override]
        self, *, folders: set[Path], **options: Any
    ) -> None:
        """Start a kernel that takes no module from these folders."""
        self._private = ScratchFolder()
        private = self._private.path
        self.connection_file = str(private / "connection.json")
        (private / "matplotlibrc").touch()  # the first that is looked for
        code = _START.format(
            paths=_literal(_module_paths(folders)),
            home=_literal(str(PACKAGE.parent)),
            private=_literal(str(private)),
            starter=os.getpid(),
        )
        command = [sys.executable, "-I", "-c", code, "-f", "{connection_file}"]
        self._kernel_spec = KernelSpec(**(get_kernel_dict() | {"argv": command}))
        await super().start_kernel(cwd=str(private), env=_environment(private), **options)

    async def enter(self, folder: Path) -> None:
        """Let the kernel forget what it ran, and enter a folder.

        Raises
        ------
        RuntimeError
            When it does not answer.
        """
        client = self.client()
        client.start_channels(iopub=False, stdin=False, hb=False, control=False)
        client.execute(_ENTER.format(folder=_literal(str(folder))), silent=True)
        await _answered(client.get_shell_msg, self.is_alive)

    def client(self, **options: Any) -> Any:
        """Return a client, which lasts until `disconnect`: nbclient leaves its own open."""
        client: Any = super().client(**options)
        self._clients.append(client)
        return client

    def disconnect(self) -> None:
        """Close the channels of all clients."""
        while self._clients:
            self._clients.pop().stop_channels()

    async def kill(self) -> None:
        """Kill the kernel without the tenth of a second in which its manager waits for its end."""
        provisioner: Any = self.provisioner
        await provisioner.kill()
        provisioner.process.wait()
        await provisioner.wait()

    async def cleanup_resources(self, restart: bool = False) -> None:  # type: ignore[override]
        """Remove the kernel's own folder too."""
        await super().cleanup_resources(restart)
        if not restart:
            self._private.cleanup()


def _module_paths(folders: set[Path]) -> list[str]:
    """Return where this process looks for modules, without these folders."""
    paths = map(os.path.abspath, sys.path)
    return [path for path in paths if Path(path).resolve() not in folders]


def _literal(value: str | list[str]) -> str:
    """Return a value in Python, in ASCII and without braces, which Jupyter would fill in."""
    return ascii(value).replace("{", r"\x7b")


def _environment(private: Path) -> dict[str, str]:
    """Return the environment of a kernel with a folder of its own."""
    own = ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR")
    kept = {key: text for key, text in os.environ.items() if not key.startswith(_OF_THE_USER)}
    private_folders = dict.fromkeys(own, str(private))
    return dict.fromkeys(_THREADS, "1") | kept | private_folders | {"MPLBACKEND": "agg"}
