"""The servers of course and explorer: who gets in, what they serve, their kernels and their end."""

import base64
import contextlib
import http.client
import os
import re
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

pytest.importorskip("voila")
pytest.importorskip("jupyterlab")
HOUSE = Path(__file__).parents[1]
PATIENCE = 600  # only a server or a kernel that hangs takes longer [s]
# The command, with few kernels and little patience for those without a page; Ctrl-C ends it even
# where the tests run in the background of a shell, which has its signal ignored.
COMMAND = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
from pierimpact.teaching import server
server.MOST_KERNELS, server.COURSE_PATIENCE, server.PAGE_PATIENCE = 1, 4, 4
from pierimpact.cli import main
sys.exit(main(["teach", "--no-browser", *sys.argv[1:]]))
"""
EVIL = "http://evil.example"


def until(condition):
    """Return what `condition` returns as soon as it is true."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if found := condition():
            return found
        time.sleep(0.1)
    pytest.fail(f"waited {PATIENCE} s in vain")


class Server:
    """A server that runs, with its port and its token."""

    def __init__(self, folder, process, log):
        self.folder, self.process = folder, process

        def address():
            assert process.poll() is None, log.read_text("utf-8")
            return re.search(r"http://127\.0\.0\.1:(\d+)/\S*\?token=(\w+)", log.read_text("utf-8"))

        port, self.token = until(address).groups()
        self.port = int(port)

    def answer(self, path, method="GET", token=True, **headers):
        """Return status, headers and text of an answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        with contextlib.closing(connection):
            query = f"?token={self.token}" if token else ""
            connection.request(method, path + query, headers=headers)
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read().decode()

    @contextlib.contextmanager
    def socket(self, path, **headers):
        """Open a WebSocket; give the status of the answer."""
        headers = {
            "Host": f"127.0.0.1:{self.port}",
            "Upgrade": "websocket",
            "Connection": "Upgrade",
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": base64.b64encode(bytes(16)).decode(),
        } | headers
        lines = [f"GET {path} HTTP/1.1", *(f"{key}: {text}" for key, text in headers.items())]
        with socket.create_connection(("127.0.0.1", self.port), PATIENCE) as connection:
            connection.sendall("".join(f"{line}\r\n" for line in [*lines, ""]).encode())
            yield int(connection.recv(12).split()[1])

    def kernels(self):
        processes = psutil.Process(self.process.pid).children()
        return [each for each in processes if "ipykernel_launcher" in each.cmdline()]

    def end(self, number):
        """Send a signal; return the kernels that there were, once the server has ended."""
        kernels = self.kernels()
        self.process.send_signal(number)
        assert self.process.wait(PATIENCE) == 0
        with pytest.raises(ConnectionRefusedError):
            socket.create_connection(("127.0.0.1", self.port), 5)
        return kernels


@contextlib.contextmanager
def serving(folder, *options):
    (folder / "jupyter").mkdir()
    # A user's configuration that opens the course to all, and lets tests run it as root.
    (folder / "jupyter" / "jupyter_server_config.py").write_text(
        "c.ServerApp.ip = '0.0.0.0'\nc.ServerApp.allow_root = True\nc.IdentityProvider.token = ''\n"
        "c.ServerApp.allow_origin = '*'\nc.ServerApp.allow_remote_access = True\n"
        "c.ServerApp.disable_check_xsrf = True\n"
    )
    (folder / "voila.json").write_text('{"Voila": {"ip": "0.0.0.0", "token": ""}}')
    (folder / "mine.svg").write_text("<svg xmlns='http://www.w3.org/2000/svg'/>")
    places = ("CONFIG_DIR", "DATA_DIR", "RUNTIME_DIR")
    private = {f"JUPYTER_{place}": str(folder / "jupyter") for place in places}
    command = [sys.executable, "-P", "-c", COMMAND, *options, "--folder", "."]
    log = folder / "log"
    with log.open("w") as output:
        process = subprocess.Popen(
            command, cwd=folder, stdout=output, stderr=output, stdin=subprocess.DEVNULL,
            env=os.environ | private | {"PYTHONPATH": str(HOUSE), "TMPDIR": str(folder)},
        )  # fmt: skip
    try:
        yield Server(folder, process, log)
    finally:
        process.kill()
        process.wait()


@pytest.fixture(scope="module")
def app(tmp_path_factory):
    folder = tmp_path_factory.mktemp("app")
    (folder / "ipykernel_launcher.py").write_text(f"open({str(folder / 'ran')!r}, 'w')\n")
    with serving(folder, "--app") as server:
        yield server


def listens_on(server):
    """Return the addresses that a server listens on, as soon as it does."""

    def addresses():
        connections = psutil.Process(server.process.pid).net_connections("tcp")
        return {each.laddr.ip for each in connections if each.status == psutil.CONN_LISTEN}

    return until(addresses)


def test_the_app_asks_for_its_token(app):
    assert listens_on(app) == {"127.0.0.1"}
    status, headers, _ = app.answer("/", token=False)
    assert (status, headers["Location"]) == (302, "/login?next=%2F")
    assert app.answer("/", token=False, Authorization="token wrong")[0] == 302
    assert app.kernels() == []


@pytest.mark.parametrize(
    "path",
    [
        "/explorer.ipynb", "/mine.svg", "/tti-column.yaml", "/files/mine.svg",
        "/voila/files/mine.svg",
        "/voila/files/explorer.ipynb", "/voila/static/mine.svg", "/voila/static/../../mine.svg",
        "/voila/static/%2e%2e/%2e%2e/%2e%2e/%2e%2e/%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/hostname",
        "/voila/render/explorer.ipynb", "/voila/tree", "/voila/api/contents/", "/api/contents",
        "/api/kernels", "/api/sessions", "/api/terminals", "/lab", "/tree",
    ],
)  # fmt: skip
def test_the_app_serves_its_page_only(path, app):
    assert app.answer(path)[0] in (403, 404)
    assert app.kernels() == []


def test_no_other_host_is_answered(app):
    for path in ("/", "/login", "/voila/static/voila.js"):
        for host in ("evil.example", f"evil.example:{app.port}", "127.0.0.1.evil.example"):
            assert app.answer(path, Host=host)[0] == 404
    assert app.kernels() == []


def test_a_kernel_answers_its_own_page_only_and_ends_with_it(app):
    status, headers, page = app.answer("/")
    assert status == 200
    # Its style sheets are its own, although Voilà's template names others.
    assert "style-src 'self' 'unsafe-inline'" in headers["Content-Security-Policy"]
    kernel = re.search(r'"kernelId": "([\w-]+)"', page)[1]
    path, cookie = f"/api/kernels/{kernel}/channels", headers["Set-Cookie"].split(";")[0]
    own = f"http://127.0.0.1:{app.port}"
    refused = [
        {},
        {"Origin": own},
        {"Cookie": cookie, "Origin": EVIL},
        {"Cookie": cookie, "Origin": "null"},
        {"Cookie": cookie, "Origin": EVIL, "Host": "evil.example"},
        {"Cookie": cookie, "Host": "evil.example"},
    ]
    with app.socket(path, Cookie=cookie, Origin=own) as status:
        assert status == 101
        for headers in refused:
            with app.socket(path, **headers) as status:
                assert status in (403, 404), headers
        for method in ("DELETE", "POST"):
            assert app.answer(f"/api/kernels/{kernel}", method, token=False, Cookie=cookie)[0] > 399
        status, _, text = app.answer("/")
        assert (status, text[:35]) == (503, "no more than 1 kernels at a time: c")
        (process,) = app.kernels()
    until(lambda: not process.is_running())
    assert not (app.folder / "ran").exists()


def test_the_app_leaves_nothing_when_it_ends(app):
    until(lambda: app.answer("/")[0] == 200)  # a kernel before may still be counted
    kernels = app.end(signal.SIGTERM)
    assert len(kernels) == 1
    psutil.wait_procs(kernels, PATIENCE)
    assert not list(app.folder.glob("voila_*"))


def test_the_course_is_for_this_machine_and_leaves_nothing(tmp_path):
    with serving(tmp_path) as lab:
        assert listens_on(lab) == {"127.0.0.1"}
        assert lab.answer("/lab", token=False)[0] == 302
        assert lab.answer("/api/contents", token=False)[0] == 403
        assert lab.answer("/lab", Host="evil.example")[0] == 403
        own = {"Authorization": f"token {lab.token}"}
        assert lab.answer("/api/kernels", "POST", **own)[0] == 201
        status, _, text = lab.answer("/api/kernels", "POST", **own)
        assert (status, "no more than 1 kernels at a time" in text) == (503, True)
        (kernel,) = lab.kernels()
        assert lab.end(signal.SIGINT) == [kernel]
        kernel.wait(PATIENCE)
