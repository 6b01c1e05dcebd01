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


@pytest.fixture
def kernel(tmp_path):
    """Return a kernel that has answered."""
    kernel = IsolatedKernelManager(config=Config(KernelManager={"transport_encryption": "auto"}))
    run_sync(kernel.start_kernel)(folders=set())
    run_sync(kernel.enter)(tmp_path)
    yield kernel
    kernel.disconnect()
    if kernel.has_kernel:
        run_sync(kernel.kill)()
    run_sync(kernel.cleanup_resources)()


def test_nothing_of_what_a_kernel_prints_is_lost_to_a_client_that_is_ready(kernel):
    async def printed(number):
        client, words = kernel.client(), ""
        client.start_channels()
        await client.wait_for_ready()
        request = client.execute(f"print({number})")
        while True:
            message = await client.get_iopub_msg(timeout=60.0)
            if message["parent_header"].get("msg_id") == request:
                words += message["content"].get("text", "")
                if message["content"].get("execution_state") == "idle":
                    return words

    for number in range(20):
        assert run_sync(printed)(number) == f"{number}\n"
        kernel.disconnect()


def test_a_client_is_not_ready_when_its_kernel_has_ended(kernel):
    client = kernel.client()
    process = kernel.provisioner.process
    run_sync(kernel.kill)()
    client.start_channels()  # after that, for what it printed before may still come
    assert process.returncode is not None
    assert not kernel.has_kernel
    with pytest.raises(RuntimeError, match="the kernel did not start"):
        run_sync(client.wait_for_ready)()
