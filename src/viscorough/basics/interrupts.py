"""Handle interrupts (Ctrl-C) while a block of code runs."""

import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from typing import Any


@contextlib.contextmanager
def on_interrupt(handler: Callable[..., Any] | signal.Handlers) -> Iterator[None]:
    """Let an interrupt within this context call handler(signal number, frame).

    Outside the main thread nothing changes, since interrupts never reach other threads.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    previous = signal.signal(signal.SIGINT, handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, previous)


@contextlib.contextmanager
def uninterrupted() -> Iterator[None]:
    """Defer interrupts within this context to its end.

    During the callbacks of LLVM into Python an interrupt would be lost or crash the process. A compiled function that
    was interrupted crashes when it returns its results.
    """
    arrived = []
    try:
        with on_interrupt(lambda *arguments: arrived.append(arguments)):
            yield
    finally:
        if arrived:
            signal.raise_signal(signal.SIGINT)
