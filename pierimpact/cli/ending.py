"""What ends a command from outside: Ctrl-C and signals, and output that nobody takes."""

import io
import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, NoReturn

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP")  # not all systems have all
_AGAIN = 0.01  # numerical: after which an interrupt that went astray comes again [s]


class Ending:
    """Which signal ended the command, Ctrl-C unless another did."""

    signal: int = signal.SIGINT


@contextmanager
def signals_as_interrupts() -> Iterator[Ending]:
    """Turn the first signal that ends a process into a KeyboardInterrupt, to clean up after it.

    Those that follow mean the same, and are ignored. A signal that is ignored before, as in the
    background or by nohup, stays so. One that meets the callback of a weak reference or a
    `__del__`, whose exceptions Python drops, comes again a little later.
    """
    ending, numbers = Ending(), [getattr(signal, name) for name in _NAMES if hasattr(signal, name)]

    def end(number: int, _: FrameType | None) -> NoReturn:
        for each in before:
            signal.signal(each, signal.SIG_IGN)
        ending.signal = number
        raise KeyboardInterrupt

    def dropped(unraisable: Any) -> None:
        if unraisable.exc_type is not KeyboardInterrupt:
            hook(unraisable)
            return
        for each in before:
            signal.signal(each, end)
        threading.Timer(_AGAIN, _send, (ending.signal,)).start()

    if threading.current_thread() is not threading.main_thread():
        numbers = []  # only the main thread may, and is interrupted
    before = {n: signal.getsignal(n) for n in numbers if signal.getsignal(n) != signal.SIG_IGN}
    hook = sys.unraisablehook
    try:
        if before:
            sys.unraisablehook = dropped
        for number in before:
            signal.signal(number, end)
        yield ending
    finally:
        sys.unraisablehook = hook
        for number, handler in before.items():
            signal.signal(number, handler)


def _send(number: int) -> None:
    """Send a signal to the main thread of this process, whatever it waits for."""
    if os.name == "nt":
        signal.raise_signal(number)
    else:
        os.kill(os.getpid(), number)


def open_streams() -> None:
    """Lead standard streams that are closed to nowhere, or other files would take their places."""
    for name, mode in {"stdin": "r", "stdout": "w", "stderr": "w"}.items():
        if getattr(sys, name) is None:
            place = os.open(os.devnull, os.O_RDWR)  # the first that is free: the stream's own
            os.set_inheritable(place, True)
            setattr(sys, name, os.fdopen(place, mode, encoding="utf-8"))


def print_anything() -> None:
    """Let all output print what its encoding lacks as escapes."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def drop_output() -> None:
    """Send to nowhere what is still to be printed."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
