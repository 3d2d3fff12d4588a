"""Refusal of what cannot fit into memory, before any of it is taken."""

import psutil


def require(needed, what):
    """Raise MemoryError, naming the bytes needed and available, unless `needed` bytes are there for `what`."""
    available = psutil.virtual_memory().available
    if needed > available:
        raise MemoryError(f"{what} takes {needed:.3g} bytes of memory, {available:.3g} bytes are available")
