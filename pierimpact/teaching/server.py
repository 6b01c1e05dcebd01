"""Servers of the course and of single pages: on this machine only, behind a token, few kernels.

Either runs in this process until SIGINT or SIGTERM ends it, with its kernels. What a user's
configuration says of addresses, tokens and origins does not count.
"""

import os
import secrets
import webbrowser
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from http.client import responses
from pathlib import Path
from typing import Any

from jupyter_server.auth.identity import PasswordIdentityProvider
from jupyter_server.services.kernels.kernelmanager import AsyncMappingKernelManager
from tornado.web import HTTPError
from traitlets.config import Config

from pierimpact.resources import PACKAGE

#: Kernels that live at a time; each takes some 150 MB of memory.
MOST_KERNELS = 10
#: How long a kernel that no page is connected to lives on [s], in the course and on a page, and
#: how long at least while it starts.
COURSE_PATIENCE, PAGE_PATIENCE, STARTING_PATIENCE = 600, 30, 120

_LOOPBACK = "127.0.0.1"
_HOSTS = r"(127\.0\.0\.1|localhost)$"  # names that a browser may call this machine by


class FewKernels(AsyncMappingKernelManager):
    """The kernels of a server, of which no more than MOST_KERNELS live at a time."""

    _starting = 0

    async def start_kernel(self, **options: Any) -> str:  # type: ignore[override]
        """Start a kernel, or answer that there are too many."""
        if len(self) + self._starting >= MOST_KERNELS:
            raise HTTPError(
                503,
                f"no more than {MOST_KERNELS} kernels at a time: close a page and wait a minute",
            )
        self._starting += 1
        try:
            return await self._async_start_kernel(**options)
        finally:
            self._starting -= 1

    async def cull_kernel_if_idle(self, kernel_id: str) -> None:
        """End a kernel that no page is connected to, unless it only starts."""
        kernel: Any = self.get_kernel(kernel_id)
        still = datetime.now(UTC) - kernel.last_activity < timedelta(seconds=STARTING_PATIENCE)
        if not (kernel.execution_state == "starting" and still):
            await super().cull_kernel_if_idle(kernel_id)  # type: ignore[no-untyped-call]


class OwnToken(PasswordIdentityProvider):
    """Asks for a token that is made for this run, whatever a user's configuration says."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self.token, self.hashed_password = secrets.token_hex(24), ""
        self.token_generated = True


def serve_course(folder: Path, notebook: str, *, browser: bool, port: int = 8888) -> None:
    """Serve a folder's notebooks by JupyterLab, one of them open, until a signal ends it."""
    from jupyterlab.labapp import LabApp

    _lead_kernels_here()
    settings = {
        "ServerApp.ip": _LOOPBACK,
        "ServerApp.port": port,
        "ServerApp.open_browser": browser,
        "ServerApp.root_dir": folder,
        "ServerApp.allow_origin": "",
        "ServerApp.allow_origin_pat": "",
        "ServerApp.allow_remote_access": False,
        "ServerApp.disable_check_xsrf": False,
        "ServerApp.answer_yes": True,  # Ctrl-C ends it without a question
        "ServerApp.kernel_manager_class": f"{__name__}.{FewKernels.__name__}",
        "ServerApp.identity_provider_class": f"{__name__}.{OwnToken.__name__}",
        "MappingKernelManager.cull_idle_timeout": COURSE_PATIENCE,
        "MappingKernelManager.cull_interval": COURSE_PATIENCE // 2,
        "MappingKernelManager.cull_connected": False,
    }
    LabApp.launch_instance(
        [*(f"--{name}={value}" for name, value in settings.items()), str(folder / notebook)]
    )


def serve_page(notebook: Path, *, browser: bool, port: int = 8866) -> None:
    """Serve a notebook by Voilà, as a page without code, until a signal ends it."""
    from voila.app import Voila
    from voila.tornado.handler import TornadoVoilaHandler

    class Page(TornadoVoilaHandler):  # type: ignore[misc]
        """The notebook as a page; what goes wrong is a line of text."""

        @property
        def content_security_policy(self) -> str:
            """Let no style sheet come from a network, as Voilà's template asks for."""
            return f"{super().content_security_policy}; style-src 'self' 'unsafe-inline'"

        def write_error(self, status_code: int, **options: Any) -> None:
            reason = getattr(options["exc_info"][1], "log_message", None)
            self.set_header("Content-Type", "text/plain; charset=UTF-8")
            self.finish(reason or responses[status_code])

    class Server(Voila):  # type: ignore[misc]
        """A server of one page, and of nothing else that is in its folder."""

        def init_settings(self) -> dict[str, Any]:
            settings: dict[str, Any] = super().init_settings()
            return settings | {"allow_remote_access": False}

        def init_handlers(self) -> Sequence[Any]:
            """Add the handlers for requests to this machine by its own name; return no others."""
            *handlers, (_, _, page) = super().init_handlers()
            parts = [each for each in handlers if "/voila/files" not in each[0]]
            self.app.add_handlers(_HOSTS, [*parts, ("/", Page, page)])
            return []

        def launch_browser(self) -> None:
            # The token is in a file of the user's, as all can see what a browser is called with.
            page = Path(self.connection_dir) / "open.html"
            page.write_text(f'<meta http-equiv="refresh" content="0; url={self.display_url}">')
            webbrowser.open(page.as_uri())

    _lead_kernels_here()
    os.environ["PYTHONSAFEPATH"] = "1"  # the kernels' own modules, and none beside the notebook
    config = Config()
    config.VoilaConfiguration.allow_template_override = "NO"
    config.VoilaConfiguration.allow_theme_override = "NO"
    config.VoilaConfiguration.multi_kernel_manager_class = FewKernels
    config.MappingKernelManager.cull_idle_timeout = PAGE_PATIENCE
    config.MappingKernelManager.cull_interval = max(1, PAGE_PATIENCE // 2)
    app = Server(
        config=config,
        config_file_paths=[],
        ip=_LOOPBACK,
        port=port,
        open_browser=browser,
        notebook_path=str(notebook),
        identity_provider_class=OwnToken,
    )
    app.initialize([])
    app.start()


def _lead_kernels_here() -> None:
    """Let kernels, which start in the reader's folder, find this very package."""
    paths = [str(PACKAGE.parent), *filter(None, [os.environ.get("PYTHONPATH")])]
    os.environ["PYTHONPATH"] = os.pathsep.join(paths)
