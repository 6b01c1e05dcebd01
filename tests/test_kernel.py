"""Kernels of reports."""

import socket

import pytest
from jupyter_core.utils import run_sync
from traitlets.config import Config

from pierimpact.report.kernel import IsolatedKernelManager


def test_a_kernel_whose_port_is_taken_ends_without_a_word(tmp_path, capfd):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        config = Config(KernelManager={"transport_encryption": "auto"})
        kernel = IsolatedKernelManager(config=config, cache_ports=False, shell_port=port)
        run_sync(kernel.start_kernel)(folders=set())
        with pytest.raises(RuntimeError, match="the kernel did not start"):
            run_sync(kernel.enter)(tmp_path)
    kernel.disconnect()
    run_sync(kernel.cleanup_resources)()
    assert capfd.readouterr().err == ""
