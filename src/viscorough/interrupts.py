"""What an interrupt (Ctrl-C) does while a block of code runs."""

import contextlib
import signal
import threading


@contextlib.contextmanager
def on_interrupt(handler):
    """Context in which an interrupt calls handler(signal number, frame); gives the handler that held before.

    Outside the main thread, which interrupts never reach, nothing is changed and None is given.
    """
    if threading.current_thread() is not threading.main_thread():
        yield None
        return
    before = signal.signal(signal.SIGINT, handler)
    try:
        yield before
    finally:
        signal.signal(signal.SIGINT, before)


@contextlib.contextmanager
def uninterrupted():
    """Context that an interrupt waits for: it is handled at the end.

    In LLVM's callbacks into Python it would be lost or crash the process, and it does crash where a compiled function
    that was interrupted returns its results.
    """
    arrived = []
    before = None
    try:
        with on_interrupt(lambda *arguments: arrived.append(arguments)) as before:
            yield
    finally:
        if arrived and callable(before):
            before(*arrived[-1])
