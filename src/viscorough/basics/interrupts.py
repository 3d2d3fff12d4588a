"""Handle interrupts (Ctrl-C) while a block of code runs."""

import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from typing import Any


@contextlib.contextmanager
def on_interrupt(handler: Callable[..., Any] | signal.Handlers) -> Iterator[None]:
    """Call handler(signal number, frame) when an interrupt (Ctrl-C) arrives within this context.

    Interrupts reach only the main thread, so this context has no effect in other threads.
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
    """Defer interrupts (Ctrl-C) that arrive within this context to its end.

    An interrupt during a callback of the compiler LLVM into Python would be lost or crash the process. An interrupt
    during a compiled function would crash the process when the function returns its results.
    """
    arrived = []
    try:
        with on_interrupt(lambda *arguments: arrived.append(arguments)):
            yield
    finally:
        if arrived:
            signal.raise_signal(signal.SIGINT)
